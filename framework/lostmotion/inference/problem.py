"""What is to be estimated from which recordings: the posterior density that every fit and every sampler sees."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any, TypeVar

import numpy as np

from lostmotion.contracts import Array
from lostmotion.forcing import Drive
from lostmotion.inference.free import FADE, LEVELS, NOISE, OFFSET, PACE, RANDOM, SLOW, Free, Route, Scales
from lostmotion.inference.tracks import Track, seat
from lostmotion.system import System

__all__ = [
    "LEVELS", "NOISE", "OFFSET", "PACE", "RANDOM", "USUAL", "Free", "Innovations", "Kept", "Problem", "Scales",
]  # fmt: skip

USUAL = 1e-3
"""The noise of a measured excitation as a share of the drive that is usual, and no mechanism left out."""
Out = TypeVar("Out")
_NONE = np.zeros((1, 1))
_NONE3 = np.zeros((1, 1, 1))


@cache
def _pool(jobs: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(jobs)


@dataclass(frozen=True)
class Innovations:
    """One-step errors and their variances, all recordings one after the other; `finite`: it did not diverge."""

    errors: Array
    variances: Array
    finite: bool

    @property
    def log_likelihood(self) -> float:
        """The prediction-error decomposition of the log-likelihood; minus infinity after a divergence."""
        if not self.finite:
            return -math.inf
        return float(-0.5 * np.sum(self.errors**2 / self.variances + np.log(2.0 * np.pi * self.variances)))


Part = tuple[Array, Array, bool]
"""The innovations of one recording, their variances, and whether the filter got through."""
Kept = tuple[Array, Array, Array, Array, Array]
"""What a smoother needs: states and covariances after and before each sample, and the steps between."""


def _joined(parts: Sequence[Part]) -> Innovations:
    errors, variances = (np.concatenate([p[k] for p in parts]) for k in (0, 1))
    return Innovations(errors, variances, all(p[2] for p in parts))


@dataclass(frozen=True)
class Problem:
    """Recordings, a system, what is known of it (`known`, full vector) and what is free.

    A key such as `c[run 1]` is the parameter `c` of the recording "run 1" alone; without brackets all share it.

    The random force is white, or, when `PACE` is among the free parameters, an Ornstein-Uhlenbeck force of the same
    intensity at low frequency: it stands for what no term explains, and keeps slow leftovers from posing as evidence.
    """

    system: System
    tracks: tuple[Track, ...]
    scales: Scales
    known: Array
    free: tuple[Free, ...]
    active: frozenset[str] = frozenset()
    nsub: int = 3
    jobs: int = 2

    @cached_property
    def coloured(self) -> bool:
        """Whether the random force has a memory."""
        return any(f.parameter == PACE for f in self.free)

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of the free parameters."""
        return tuple(f.key for f in self.free)

    @cached_property
    def drives(self) -> tuple[Drive, ...]:
        """The inputs of each recording on the grid of the integrator."""
        return tuple(track.drive(self.nsub) for track in self.tracks)

    @cached_property
    def start(self) -> Array:
        """The coordinates to start from."""
        return np.array([f.start for f in self.free])

    @cached_property
    def routes(self) -> tuple[Route, ...]:
        """Which coordinate stands for what in each recording."""
        return tuple(Route.of(self.keys, track.name) for track in self.tracks)

    @cached_property
    def _slots(self) -> tuple[tuple[int, Free], ...]:
        """Where each free parameter of the system stands in the full vector."""
        frees = {f.parameter: f for f in self.free}
        return tuple((self.system.index[name], f) for name, f in frees.items() if name not in LEVELS)

    def full(self, theta: Array, index: int = 0) -> Array:
        """Return the full parameter vector of the system in a recording at the coordinates `theta`."""
        full, route = self.known.copy(), self.routes[index]
        for slot, f in self._slots:
            full[slot] = f.value(route.at(theta, f.parameter))
        return full

    def values(self, theta: Array) -> dict[str, float]:
        """Return the free parameters by key at the coordinates `theta`."""
        return {f.key: f.value(c) for f, c in zip(self.free, theta, strict=True)}

    def log_prior(self, theta: Array) -> float:
        """Return the log prior density at the coordinates `theta`."""
        return sum(f.log_prior(float(c)) for f, c in zip(self.free, theta, strict=True))

    def clip(self, theta: Array) -> Array:
        """Return the coordinates moved into their bounds."""
        return np.clip(theta, [f.low for f in self.free], [f.high for f in self.free])

    def innovations(self, theta: Array) -> Innovations:
        """Return the one-step prediction errors of the filter at the coordinates `theta`."""
        return _joined([self._filter(i, theta) for i in range(len(self.tracks))])

    def log_posterior(self, theta: Array) -> float:
        """Return log-likelihood plus log prior at the coordinates `theta`."""
        prior = self.log_prior(theta)
        return prior + self.innovations(theta).log_likelihood if math.isfinite(prior) else -math.inf

    def many(self, thetas: Iterable[Array]) -> list[Innovations]:
        """Return the innovations at several points, computed on `jobs` cores (the kernels release the lock)."""
        return self._each(self.innovations, list(thetas))

    def log_likelihoods(self, points: Array) -> Array:
        """Return the log-likelihood (count,) at several `points` (count, n); minus infinity where it diverges."""
        found = np.array(self._each(lambda p: self.innovations(p).log_likelihood, list(points)), dtype=float)
        return np.where(np.isnan(found), -np.inf, found)

    def around(self, theta: Array, points: Sequence[Array]) -> list[Innovations]:
        """Return the innovations at `theta` and then at `points` about it.

        A recording is filtered anew only at those points of which a coordinate that matters to it has moved.
        """
        tasks = [(i, theta) for i in range(len(self.tracks))]
        tasks += [(i, p) for p in points for i, r in enumerate(self.routes) if np.any(p[r.used] != theta[r.used])]
        done = self._each(lambda task: self._filter(*task), tasks)
        here = {i: part for (i, p), part in zip(tasks, done, strict=True) if p is theta}
        table = {(i, id(p)): part for (i, p), part in zip(tasks, done, strict=True)}
        return [_joined([table.get((i, id(p)), here[i]) for i in here]) for p in (theta, *points)]

    def _each(self, function: Callable[[Any], Out], items: Sequence[Any]) -> list[Out]:
        if self.jobs < 2 or len(items) < 2:
            return [function(item) for item in items]
        return list(_pool(self.jobs).map(function, items))

    def noise(self, theta: Array, index: int = 0) -> tuple[float, float]:
        """Return the intensity of the random force (N^2 s) and the variance of the measurement noise."""
        route = self.routes[index]
        return math.exp(route.at(theta, RANDOM)), math.exp(2.0 * route.at(theta, NOISE))

    def slow(self, theta: Array, index: int = 0) -> tuple[float, float]:
        """Return the variance of measurement noise with a memory, and by how much it fades from sample to sample."""
        route = self.routes[index]
        if SLOW not in route.columns:
            return 0.0, 0.0
        return math.exp(2.0 * route.at(theta, SLOW)), math.exp(-self.tracks[index].dt / math.exp(route.at(theta, FADE)))

    def measurement(self, theta: Array, index: int = 0) -> float:
        """Return the variance of all measurement noise, the white and the slow."""
        return self.noise(theta, index)[1] + self.slow(theta, index)[0]

    def offset(self, theta: Array, index: int = 0) -> float:
        """Return what the response sensor shows at zero, in the unit of the channel."""
        route = self.routes[index]
        return route.at(theta, OFFSET) if OFFSET in route.columns else 0.0

    def initial(self, index: int, n: int, theta: Array | None = None) -> tuple[Array, Array]:
        """Return mean (n,) and covariance (n, n) of the state at the first sample of a recording.

        Where a force was measured, the place depends on the parameters: it is that where the model shows this force.
        """
        track, scales = self.tracks[index], self.scales
        offset = 0.0 if theta is None else self.offset(theta, index)
        y0, cov = np.zeros(n), np.zeros((n, n))
        for i, name in enumerate(self.system.model.states):
            cov[i, i] = (scales.velocity if i == 1 or "velocity" in name else scales.length) ** 2
        if track.channel == "position":
            gain = 1.0 if theta is None else self.gain(theta, index)
            y0[0], y0[1] = (track.first[0] - offset) / gain, track.first[1] / gain
            cov[0, 0] = min((10.0 * track.noise) ** 2 + (1e-3 * scales.length) ** 2, scales.length**2)
            cov[1, 1] *= 0.25
        if track.channel == "force":
            y0[:2] = track.inputs[0]
            cov[1, 1] *= 0.25
            if theta is not None:
                level = replace(track, z=track.z - offset) if offset else track
                y0[0], spread = seat(level, self.system.model, self.full(theta, index)[: len(self.system.model.params)])
                cov[0, 0] = spread**2 + (1e-3 * scales.length) ** 2
        return y0, cov

    def random(self, theta: Array, index: int = 0) -> tuple[float, float]:
        """Return pace (1/s; zero when white) and noise intensity of the random force as the kernel takes them."""
        intensity, _ = self.noise(theta, index)
        if not self.coloured:
            return 0.0, intensity
        pace = math.exp(self.routes[index].at(theta, PACE))
        return pace, intensity * pace**2

    def drive(self, index: int, theta: Array) -> Drive:
        """Return the input that acts in a recording at the coordinates `theta`, on the grid of the integrator."""
        plain, track = self.drives[index], self.tracks[index]
        keys = self.system.shaping(self.active)
        if not keys:
            return plain
        full = self.full(theta, index)
        values = tuple(self.system.values(full, key, track.tone) for key in keys)
        known = self._acting.get(index)
        if known and known[0] == values:
            return known[1]
        u = self.system.acting(track.recorded(self.nsub), full, keys, track.tone)
        drive = Drive.acting(u, track.inputs.shape[1], plain, track.held)
        self._acting[index] = (values, drive)
        return drive

    @cached_property
    def _acting(self) -> dict[int, tuple[object, Drive]]:
        """The input that acted last in each recording: most points differ in other parameters."""
        return {}

    def gain(self, theta: Array, index: int = 0) -> float:
        """Return what the sensor of a recording shows of one unit."""
        return self.system.gain(self.full(theta, index), self.active) if self.system.beside else 1.0

    def _filter(self, index: int, theta: Array) -> Part:
        track = self.tracks[index]
        errors, variances = np.zeros(track.samples), np.ones(track.samples)
        done = self.track(index, theta, errors, variances, None)
        whole = done == track.samples and math.isfinite(float(errors @ (errors / variances)))
        return errors, variances, whole

    def track(self, index: int, theta: Array, errors: Array, variances: Array, kept: Kept | None) -> int:
        """Run the filter over one recording into the given arrays; return how many samples it got through."""
        track, drive, system = self.tracks[index], self.drive(index, theta), self.system
        base, own = system.pack(self.full(theta, index), drive.dt / drive.nsub, drive.tone)
        on, at = system.wiring(self.active)
        channel, direct = system.channel(track.channel)
        (pace, intensity), offset = self.random(theta, index), self.offset(theta, index)
        y0, cov = self.initial(index, system.states(self.active) + self.coloured, theta)
        if self.coloured:
            cov[-1, -1] = 0.5 * intensity / pace
        arrays = kept or (_NONE, _NONE3, _NONE, _NONE3, _NONE3)
        gain, (slow, fade) = self.gain(theta, index), self.slow(theta, index)
        z = track.z - offset if offset else track.z
        done: int = system.kernel(self.active, latent=self.coloured).track(
            z if gain == 1.0 else z / gain, drive.u, drive.begin, drive.dt, drive.nsub, base, own, on, at, pace,
            intensity, self.noise(theta, index)[1] / gain**2, slow / gain**2, fade, y0, cov, channel, direct, errors,
            variances, kept is not None, *arrays,
        )  # fmt: skip
        if gain != 1.0:
            errors *= gain
            variances *= gain**2
        return done

    def extended(self, more: Iterable[Free], active: Iterable[str]) -> Problem:
        """Return the problem with further free parameters and terms."""
        return replace(self, free=(*self.free, *more), active=self.active | frozenset(active))

    def knowing(self, values: Mapping[str, float]) -> Problem:
        """Return the problem with further parameters held at `values`."""
        known = self.known.copy()
        known[[self.system.index[key] for key in values]] = list(values.values())
        return replace(self, known=known)

    def reduced(self, key: str, values: Mapping[str, float]) -> Problem:
        """Return the problem without the term `key`; `values` become the new starting points."""
        kept = tuple(
            replace(f, start=f.coordinate(values.get(f.key, f.value(f.start))))
            for f in self.free
            if not f.key.startswith(key + ".")
        )
        return replace(self, free=kept, active=self.active - {key})

    def on(self, tracks: tuple[Track, ...]) -> Problem:
        """Return the same problem on other recordings, or on parts of them."""
        return replace(self, tracks=tracks)
