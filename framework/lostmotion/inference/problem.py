"""What is to be estimated from which recordings: the posterior density that every fit and every sampler sees."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.tracks import Track
from lostmotion.system import Drive, System

RANDOM = "log_random_force"
NOISE = "log_noise"
PACE = "log_random_pace"
LEVELS = (RANDOM, NOISE, PACE)
"""The free parameters that are no physics: intensity and pace of a random force, and the measurement noise."""
USUAL = 1e-3
"""The noise of a measured excitation as a share of the drive that is usual, and no mechanism left out."""
_NONE = np.zeros((1, 1))
_NONE3 = np.zeros((1, 1, 1))


@cache
def _pool(jobs: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(jobs)


@dataclass(frozen=True)
class Free:
    """A parameter to be estimated, in the coordinate in which its prior is simple.

    `log` says that the coordinate is the logarithm. The prior is uniform between `low` and `high` (coordinate), or
    normal with `mean` and `sd` and cut there.
    """

    key: str
    unit: str
    start: float
    low: float
    high: float
    log: bool = False
    mean: float = 0.0
    sd: float = math.inf

    def value(self, coordinate: float) -> float:
        """Return the parameter at a coordinate."""
        return math.exp(coordinate) if self.log else coordinate

    def coordinate(self, value: float) -> float:
        """Return the coordinate of a parameter, clipped into the bounds."""
        raw = math.log(max(value, 1e-300)) if self.log else value
        return min(max(raw, self.low), self.high)

    def log_prior(self, coordinate: float) -> float:
        """Return the log prior density of the coordinate."""
        if not self.low <= coordinate <= self.high:
            return -math.inf
        if math.isinf(self.sd):
            return -math.log(self.high - self.low)
        kept = 0.5 * (
            math.erf((self.high - self.mean) / self.sd / math.sqrt(2))
            - math.erf((self.low - self.mean) / self.sd / math.sqrt(2))
        )
        z = (coordinate - self.mean) / self.sd
        return -0.5 * z * z - math.log(self.sd * math.sqrt(2.0 * math.pi) * max(kept, 1e-300))


@dataclass(frozen=True)
class Scales:
    """The natural sizes of a recorded motion, as amplitudes: generalised force, length, time.

    `usual` is the log intensity (N^2 s) of the random force that the usual noise of a measured excitation makes.
    """

    force: float
    length: float
    time: float
    usual: float = 0.0

    @property
    def velocity(self) -> float:
        """The amplitude of the velocity."""
        return self.length / self.time


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


Kept = tuple[Array, Array, Array, Array, Array]
"""What a smoother needs: states and covariances after and before each sample, and the steps between."""


@dataclass(frozen=True)
class Problem:
    """Recordings, a system, what is known of it (`known`, full vector) and what is free.

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

    @property
    def coloured(self) -> bool:
        """Whether the random force has a memory."""
        return PACE in self.keys

    @property
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

    def full(self, theta: Array) -> Array:
        """Return the full parameter vector of the system at the coordinates `theta`."""
        full = self.known.copy()
        for f, coordinate in zip(self.free, theta, strict=True):
            if f.key not in LEVELS:
                full[self.system.index[f.key]] = f.value(coordinate)
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
        parts = [self._filter(i, theta) for i in range(len(self.tracks))]
        errors = np.concatenate([p[0] for p in parts])
        return Innovations(errors, np.concatenate([p[1] for p in parts]), all(p[2] for p in parts))

    def log_posterior(self, theta: Array) -> float:
        """Return log-likelihood plus log prior at the coordinates `theta`."""
        prior = self.log_prior(theta)
        return prior + self.innovations(theta).log_likelihood if math.isfinite(prior) else -math.inf

    def many(self, thetas: Iterable[Array]) -> list[Innovations]:
        """Return the innovations at several points, computed on `jobs` cores (the kernels release the lock)."""
        points = list(thetas)
        if self.jobs < 2 or len(points) < 2:
            return [self.innovations(p) for p in points]
        return list(_pool(self.jobs).map(self.innovations, points))

    def noise(self, theta: Array) -> tuple[float, float]:
        """Return the intensity of the random force (N^2 s) and the variance of the measurement noise."""
        values = dict(zip(self.keys, theta, strict=True))
        return math.exp(values[RANDOM]), math.exp(2.0 * values[NOISE])

    def initial(self, index: int, n: int) -> tuple[Array, Array]:
        """Return mean (n,) and covariance (n, n) of the state at the first sample of a recording."""
        track, scales = self.tracks[index], self.scales
        y0, cov = np.zeros(n), np.zeros((n, n))
        cov[0, 0], cov[1, 1] = scales.length**2, scales.velocity**2
        if track.channel == "position":
            y0[0], y0[1] = track.first
            cov[0, 0] = min((10.0 * track.noise) ** 2 + (1e-3 * scales.length) ** 2, scales.length**2)
            cov[1, 1] *= 0.25
        return y0, cov

    def random(self, theta: Array) -> tuple[float, float]:
        """Return pace (1/s; zero when white) and noise intensity of the random force as the kernel takes them."""
        intensity, _ = self.noise(theta)
        if not self.coloured:
            return 0.0, intensity
        pace = math.exp(theta[self.keys.index(PACE)])
        return pace, intensity * pace**2

    def _filter(self, index: int, theta: Array) -> tuple[Array, Array, bool]:
        track = self.tracks[index]
        errors, variances = np.zeros(track.samples), np.ones(track.samples)
        done = self.track(index, theta, errors, variances, None)
        return errors, variances, bool(done == track.samples)

    def track(self, index: int, theta: Array, errors: Array, variances: Array, kept: Kept | None) -> int:
        """Run the filter over one recording into the given arrays; return how many samples it got through."""
        track, drive, system = self.tracks[index], self.drives[index], self.system
        base, own = system.pack(self.full(theta), drive.dt / drive.nsub)
        on, at = system.wiring(self.active)
        channel, direct = system.channel(track.channel)
        pace, intensity = self.random(theta)
        y0, cov = self.initial(index, system.states(self.active) + self.coloured)
        if self.coloured:
            cov[-1, -1] = 0.5 * intensity / pace
        arrays = kept or (_NONE, _NONE3, _NONE, _NONE3, _NONE3)
        done: int = system.kernel(self.active, latent=self.coloured).track(
            track.z, drive.u, drive.dt, drive.nsub, base, own, on, at, pace, intensity, self.noise(theta)[1], y0, cov,
            channel, direct, errors, variances, kept is not None, *arrays,
        )  # fmt: skip
        return done

    def extended(self, more: Iterable[Free], active: Iterable[str]) -> Problem:
        """Return the problem with further free parameters and terms."""
        return replace(self, free=(*self.free, *more), active=self.active | frozenset(active))

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
