"""The model discrepancy that every hypothesis contains: smooth forces, wrong known values, errors of channels.

No model of a real machine is exact. A likelihood that ignores this accepts any term that resembles the model error, and
becomes more certain with the length of the recording (Kennedy, O'Hagan, J. R. Stat. Soc. B 63 (2001) 425-464). The
discrepancy consists of

- smooth forces over position, velocity, time and drive phase, or none (`smooth_forces.py`);
- known values that are wrong by `rival.known`;
- errors of the channels: scale and bend of each sensor, scale and delay of each drive (`channel_errors.py`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.evidence.channel_errors import ChannelError
from lostmotion.evidence.expansion import Curvature, Expansion, compute_log_evidence
from lostmotion.evidence.slopes import list_force_slopes
from lostmotion.evidence.smooth_forces import SIZES, SMOOTH, SmoothForce, make_smooth_force
from lostmotion.inference.curves import compute_coefficient_size
from lostmotion.inference.fit import choose_first_steps
from lostmotion.inference.learned import OverPosition
from lostmotion.inference.natural import find_term
from lostmotion.inference.sensitivity import compute_differences, list_stencil_points, make_stencil
from lostmotion.likelihood.innovations import Innovations, join_innovations, join_recordings
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import key_of
from lostmotion.likelihood.tangents import Tangents, linearise_filter

USUAL = 3.0
"""Known values and channels are wrong by at most this many of their standard deviations: a larger error has a name."""
NUDGE, EXACT = 3e-4, 1e-6
"""Finite-difference steps: of a coefficient in units of the drive; of logarithms and shares of what scales a model."""
SWEEPS = 4
"""The largest number of passes in which each smooth force in turn gets its best size and length."""


Choice = tuple[int, ...]
"""The option of each smooth force; -1 where it is absent."""


@dataclass(frozen=True)
class JointFrame:
    """The coordinates of a hypothesis: own parameters, known values, coefficients of smooth forces, channel errors.

    `posterior` has the first three as free parameters. Channel errors are applied to the recordings. `odds` are the log
    odds against a constant or a straight line in a smooth force, those against the term of this form.
    """

    posterior: Posterior
    own: int
    known: slice
    forces: tuple[SmoothForce, ...]
    errors: tuple[ChannelError, ...]
    odds: float

    @cached_property
    def count(self) -> int:
        """The number of all coordinates."""
        return len(self.posterior.space.free) + len(self.errors)

    @cached_property
    def channels(self) -> slice:
        """The coordinates of the channel errors."""
        return slice(len(self.posterior.space.free), self.count)

    @cached_property
    def start(self) -> Array:
        """The coordinates to start from (count,): no discrepancy."""
        return np.concatenate([self.posterior.space.start, np.zeros(len(self.errors))])

    @cached_property
    def first_steps(self) -> Array:
        """The finite-difference steps (own,) of own coordinates where no information is known yet."""
        return choose_first_steps(self.posterior.over(self.posterior.space.free[: self.own]))

    @cached_property
    def terms(self) -> frozenset[str]:
        """The keys of the active terms of the library."""
        return self.posterior.active - {force.key for force in self.forces}

    @property
    def more(self) -> NDArray[np.intp]:
        """The indices of the coordinates of the discrepancy."""
        return np.arange(self.own, self.count)

    @property
    def none(self) -> Choice:
        """The choice without any smooth force."""
        return (-1,) * len(self.forces)

    @cached_property
    def middle(self) -> Array:
        """The prior means (count - own,) of the discrepancy."""
        found = np.zeros(self.count - self.own)
        found[: self.known.stop - self.known.start] = [f.mean for f in self.posterior.space.free[self.known]]
        return found

    @cached_property
    def bounds(self) -> tuple[Array, Array]:
        """The lower and upper bounds (count,) of the coordinates; coefficients of smooth forces have none."""
        low, high = np.full(self.count, -math.inf), np.full(self.count, math.inf)
        free = self.posterior.space.free[: self.own]
        low[: self.own], high[: self.own] = [f.low for f in free], [f.high for f in free]
        widths = USUAL * self.widths(self.none)
        for part in (self.known, self.channels):
            middle, width = (values[part.start - self.own : part.stop - self.own] for values in (self.middle, widths))
            low[part], high[part] = middle - width, middle + width
        return low, high

    def list_pressed(self, at: Array) -> NDArray[np.intp]:
        """Return the indices of the known values and channel errors that are at a bound at coordinates (count,)."""
        low, high = self.bounds
        return self.more[((at <= low) | (at >= high))[self.own :]]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The name of each coordinate."""
        return (*self.posterior.space.keys, *(f"channel error {i}" for i in range(len(self.errors))))

    @cached_property
    def levels(self) -> NDArray[np.bool_]:
        """Which coordinates (count,) are levels of noise and of random forces."""
        return np.array([name.startswith("log_") for name in self.names])

    def transfer(self, values: Mapping[str, float]) -> Array:
        """Return coordinates (count,) from those of another frame by name; others are at their start."""
        return np.array([values.get(name, first) for name, first in zip(self.names, self.start, strict=True)])

    def widths(self, choice: Choice) -> Array:
        """Return the prior standard deviations (count - own,) of the discrepancy; zero where a force is absent."""
        found = np.zeros(self.count)
        found[self.known] = self.posterior.settings.rival.known
        found[self.channels] = [error.width for error in self.errors]
        for force, option in zip(self.forces, choice, strict=True):
            if option >= 0:
                found[force.columns] = force.options[option]
        return found[self.own :]

    def measure_smooth(self, choice: Choice) -> float:
        """Return the standard deviation of all smooth forces of a choice together (N or N m)."""
        return math.hypot(*(f.sizes[option] for f, option in zip(self.forces, choice, strict=True) if option >= 0))

    def make_room(self, choice: Choice) -> list[Choice]:
        """Return choices that leave to a law what smooth forces explain, the given one first.

        They are without one or all of the forces, or without the constants and lines of all, which have each of the
        usual sizes then.
        """
        fewer = [(*choice[:k], -1, *choice[k + 1 :]) for k in range(len(choice))]
        bent = [
            f.bent[option] if option >= 0 else [-1] * len(SIZES) for f, option in zip(self.forces, choice, strict=True)
        ]
        straight = [tuple(map(int, one)) for one in zip(*bent, strict=True)]
        return list(dict.fromkeys((choice, self.none, *fewer, *straight)))

    def price(self, choice: Choice) -> float:
        """Return the log penalty of a choice: each force that is present has one of its options, and its lines."""
        present = [(force, option) for force, option in zip(self.forces, choice, strict=True) if option >= 0]
        return sum(
            math.log(len(force.options)) + self.odds * float(force.straight[option]) for force, option in present
        )

    def place(self, at: Array) -> Posterior:
        """Return the posterior on recordings with the channel errors of coordinates (count,) removed."""
        observations = self.posterior.observations
        for error, size in zip(self.errors, at[self.channels], strict=True):
            if size:
                observations = tuple(error.correct(o, float(size)) for o in observations)
        return self.posterior if observations is self.posterior.observations else self.posterior.on(observations)

    def log_likelihood(self, at: Array, choice: Choice) -> Any:
        """Return the log-likelihood at one point (count,), or at many (points, count) with the same channel errors."""
        bare = self.bare(np.atleast_2d(at)[0], choice)
        return bare.log_likelihood(at[..., : len(self.posterior.space.free)])

    def expand(self, at: Array, steps: Array, choice: Choice) -> Expansion:
        """Return one-step errors and their derivatives at some coordinates; `steps` (own,) are those of own ones.

        They are differences, and those over smooth forces are of the linearised filter (`Tangents`) where no sensor
        needs differences. A change of unit of mass, length or force leaves the errors as they are: steps over what it
        scales are so small that differences show this, or a recording would seem to tell the scales of its channels.
        """
        posterior, width = self.bare(at, choice), self.known.stop
        own, ends = at[: len(self.posterior.space.free)], self._make_stencil(at, steps, width)
        points = list_stencil_points(own, *ends)
        made = [
            linearise_filter(posterior, points, i, [error.correct(o, EXACT) for error in self.errors])
            for i, o in enumerate(posterior.observations)
        ]
        linear = [one for one in made if one is not None]
        if len(linear) == len(made):
            seen = join_recordings([innovations for _, innovations in linear])
            found = compute_differences(own, ends, seen[: len(points)], steps)
            rows = np.concatenate([self._list_slopes(one) for one, _ in linear], axis=1)
            errors = np.vstack([found.errors[:width], rows])
            variances = np.vstack([found.variances[:width], np.zeros_like(rows)])
            errors, variances = _add_channels(errors, variances, seen[0], seen[len(points) :])
        else:
            posterior = self.place(at)
            ends = self._make_stencil(at, steps, len(own))
            seen = posterior.innovations(list_stencil_points(own, *ends))
            moved = [posterior.on(tuple(e.correct(o, EXACT) for o in posterior.observations)) for e in self.errors]
            changed = join_innovations([other.innovations(own[None]) for other in moved]) if moved else seen[:0]
            found = compute_differences(own, ends, seen, steps)
            errors, variances = _add_channels(found.errors, found.variances, seen[0], changed)
        middle, precision = np.zeros(self.count), np.zeros(self.count)
        for i, f in enumerate(posterior.space.free):
            middle[i] = f.mean if math.isfinite(f.sd) else at[i]
            precision[i] = f.evidence_information(float(at[i])) if i < self.own else 0.0
        blocks = {"own": slice(0, self.own), "known": self.known, "channels": self.channels}
        blocks |= {force.key: force.columns for force in self.forces}
        return Expansion(seen[0], at, errors, variances, middle, precision, blocks)

    def _make_stencil(self, at: Array, steps: Array, width: int) -> tuple[Array, Array]:
        """Return coordinates above and below those of the posterior, where the first `width` are changed.

        Differences over own coordinates that are none of the model are central.
        """
        n = len(self.posterior.space.free)
        tuned = np.concatenate([np.where(self._exact > 0.0, self._exact, steps), self._steps])
        up, down = make_stencil(self.posterior, at[:n], tuned)
        central = np.arange(n) < self.own
        central[: self.own] &= (self._exact == 0.0) | (up[: self.own] == at[: self.own])
        down = np.where(central, down, at[:n])
        up[width:] = down[width:] = at[width:n]
        return up, down

    def bare(self, at: Array, choice: Choice) -> Posterior:
        """Return the posterior at coordinates (count,): corrected recordings, and the smooth forces that act."""
        return self._wake(self.place(at), choice)

    def _wake(self, posterior: Posterior, choice: Choice) -> Posterior:
        """Return the posterior with the smooth forces that are present: the others would only cost time."""
        absent = {force.key for force, option in zip(self.forces, choice, strict=True) if option < 0}
        return posterior.acting(posterior.active - absent)

    def _list_slopes(self, filtered: Tangents) -> Array:
        """Return the derivatives (coefficients, readings) of the errors in one recording over smooth forces."""
        forces = [(force.key, force.columns.stop - force.columns.start) for force in self.forces]
        rows = list_force_slopes(filtered, forces)
        return np.vstack(rows) if rows else np.zeros((0, filtered.spread.size))

    @cached_property
    def _steps(self) -> Array:
        """The finite-difference steps of known values and of coefficients."""
        found = np.full(len(self.posterior.space.free) - self.own, EXACT)
        for force in self.forces:
            found[force.columns.start - self.own : force.columns.stop - self.own] = NUDGE * float(
                compute_coefficient_size(self._terms[force.key], self.posterior)
            )
        return found

    @cached_property
    def _exact(self) -> Array:
        """The small finite-difference steps of own parameters that change with a unit (own,); zero for others.

        They are those of the model, and forces and lengths of laws: with longer steps over a kink, derivatives of laws
        would not add up to zero with those of the model. What rounds a sensor has no derivative at a point.
        """
        laws = [find_term(self.posterior, key) for key in self.terms]
        slots = [slot for term, slots in laws if term.acts != "sensor" for slot in slots]
        scaled = {slot.key for slot in slots if slot.param.dimension.force or slot.param.dimension.length}
        scaled |= {p.name for p in self.posterior.system.model.params}
        own = self.posterior.space.free[: self.own]
        units = np.array([1.0 if f.log else min(f.sd, f.high - f.low) for f in own])
        return EXACT * units * [f.parameter in scaled for f in own]

    @cached_property
    def _terms(self) -> dict[str, OverPosition]:
        return {key_of(t): t for t in self.posterior.system.terms if isinstance(t, SMOOTH)}  # type: ignore[misc]


def _add_channels(errors: Array, variances: Array, here: Innovations, changed: Innovations) -> tuple[Array, Array]:
    """Return derivatives (n, readings) with those of changed recordings, zero where the filter diverged."""
    told = changed.finite[:, None] / EXACT
    more = ((changed.errors - here.errors) * told, (changed.variances - here.variances) * told)
    return np.vstack([errors, more[0]]), np.vstack([variances, more[1]])


def make_frame(
    posterior: Posterior,
    theta: Array,
    errors: tuple[ChannelError, ...],
    odds: float,
    sizes: Sequence[float] = SIZES,
) -> JointFrame:
    """Return the coordinates of the hypothesis with the terms of a posterior, begun at its own coordinates `theta`.

    The system of the posterior has every curve (`add_all_curves`), none of which is active. `odds` are
    the log odds against a constant or a straight line in a smooth force.
    """
    curves = [(key_of(t), t) for t in posterior.system.terms if isinstance(t, SMOOTH)]
    own, known = len(theta), list_known_values(posterior)
    frees = [replace(f, start=float(c)) for f, c in zip(posterior.space.free, theta, strict=True)] + known
    forces = []
    for key, term in curves:
        size = compute_coefficient_size(term, posterior)
        forces.append(make_smooth_force(term, len(frees), size, sizes))
        count = forces[-1].options.shape[1]
        frees += [FreeParameter(f"{key}.v{i}", "", 0.0, -1e3 * size, 1e3 * size, linear=True) for i in range(count)]
    wide = posterior.over(frees).acting(posterior.active | {key for key, _ in curves})
    return JointFrame(wide, own, slice(own, own + len(known)), tuple(forces), errors, odds)


def list_known_values(posterior: Posterior) -> list[FreeParameter]:
    """Return the positive known values of the model as free parameters (in their logarithm)."""
    estimated, found = {f.parameter for f in posterior.space.free}, []
    for param in posterior.system.model.params:
        value = float(posterior.known[posterior.system.index[param.name]])
        if param.name not in estimated and 0.0 < value < math.inf:
            at, sd = math.log(value), posterior.settings.rival.known
            found.append(FreeParameter(param.name, "", at, at - 1.0, at + 1.0, log=True, mean=at, sd=sd))
    return found


@dataclass(frozen=True)
class Quadratic:
    """The log-likelihood over the discrepancy, with own coordinates re-optimised: gradient and information at zero.

    Coordinates beyond those of the discrepancy are amplitudes of terms, with prior standard deviations `beside`. Known
    values and channel errors at a bound, with the indices `held`, stay there.
    """

    frame: JointFrame
    gradient: Array
    information: Array
    beside: Array
    held: NDArray[np.intp]

    @classmethod
    def of(cls, frame: JointFrame, curvature: Curvature, beside: Array | None = None) -> Quadratic:
        """Return the quadratic of a curvature, whose last coordinates are those of terms, with these widths."""
        widths = np.zeros(0) if beside is None else beside
        more = np.arange(frame.own, frame.count + len(widths))
        gradient, information = curvature.profile(np.arange(frame.own), more)
        shift = np.concatenate([frame.middle, np.zeros(len(widths))])
        held = frame.list_pressed(curvature.at[: frame.count])
        shift[held - frame.own] = curvature.at[held]
        gradient = gradient - information @ shift
        gradient[held - frame.own] = information[held - frame.own] = information[:, held - frame.own] = 0.0
        return cls(frame, gradient, information, widths, held)

    def evaluate(self, choice: Choice) -> float:
        """Return the log evidence that the discrepancy and the terms add, with some smooth forces."""
        widths = np.concatenate([self.frame.widths(choice), self.beside])
        return compute_log_evidence(self.gradient, self.information, widths) - self.frame.price(choice)

    def choose(self, begin: Choice) -> tuple[Choice, float]:
        """Return the option of each smooth force with the largest evidence, and this log evidence.

        Coordinate search: each smooth force in turn gets its best size and length, or none, starting from `begin`.
        """
        best, chosen = self.evaluate(begin), list(begin)
        for _ in range(SWEEPS):
            before = best
            for k, force in enumerate(self.frame.forces):
                for option in range(-1, len(force.options)):
                    trial = (*chosen[:k], option, *chosen[k + 1 :])
                    if option != chosen[k] and (value := self.evaluate(trial)) > best:
                        best, chosen = value, list(trial)
            if best <= before:
                break
        return tuple(chosen), best

    def choose_anew(self, begin: Choice) -> tuple[Choice, float]:
        """Return the best of the searches from `begin` and from no smooth force."""
        found = [self.choose(one) for one in dict.fromkeys((begin, self.frame.none))]
        return max(found, key=lambda pair: pair[1])
