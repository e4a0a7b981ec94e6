"""A hypothesis on an arm: a set of effects with the discrepancy, fitted together, and one number for it.

    score = [log Z(fitted data | model + effects + discrepancy) + log p(held-out | fitted data)] / temper - price

Gauss-Newton on levels of noise, estimated values, parameters of effects and coefficients of the discrepancy together.
The derivatives over the last are exact (`TapedArm.differentiate`), those over the others are differences.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Term
from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.heldout import NormalPosterior, average_over_posterior, cut_before
from lostmotion.evidence.hypothesis import UNKNOWN, maximise_within
from lostmotion.likelihood.innovations import Innovations
from lostmotion.parts import Array
from lostmotion.robots.arm import FilteredLog, TapedArm
from lostmotion.robots.arm_discrepancy import Choice, Discrepancy
from lostmotion.robots.arm_effects import ArmCoordinate, ArmEffect, GearEffect, LawEffect, MassEffect
from lostmotion.robots.gears import Gear

NUDGE = 1e-3
"""The step of differences over a coordinate, in units of it; of a small value, this part of its size at least."""
SHARE = 0.02
NEAR = 0.05
"""Logarithms of levels that differ less have the same derivatives of one-step errors over them."""
ROUNDS, CLOSE = 25, 0.05
"""The largest number of rounds of a fit, and the gain of a round after which it ends."""
MOST_STEPS, CHORD, LONGEST_STEP = 8, 0.1, 1.5
"""The largest number of steps with the same derivatives, the share of their gain below which the next one is not worth
it, and the longest step of a coordinate."""
IDLE = 0.1
"""A fit ends as well where a round gains less than this share of what it lacks to be worth finding."""


@dataclass(frozen=True, eq=False)
class ArmFrame:
    """What is fitted: an arm up to sample `last`, effects, levels and estimated values, and the discrepancy."""

    arm: TapedArm
    effects: tuple[ArmEffect, ...]
    base: tuple[ArmCoordinate, ...]
    discrepancy: Discrepancy
    last: int

    @cached_property
    def own(self) -> tuple[ArmCoordinate, ...]:
        """All coordinates before those of the discrepancy."""
        return (*self.base, *(c for effect in self.effects for c in effect.coordinates))

    @property
    def levels(self) -> int:
        """The number of coordinates, the first ones, that are levels of random forces and of noise."""
        return len(self.arm.joints) + len(self.arm.log.picks)

    @property
    def terms(self) -> frozenset[str]:
        """The keys of the effects."""
        return frozenset(effect.key for effect in self.effects)

    @cached_property
    def gears(self) -> tuple[GearEffect, ...]:
        """The effects that are gears."""
        return tuple(e for e in self.effects if isinstance(e, GearEffect))

    @cached_property
    def laws(self) -> tuple[Term, ...]:
        """The terms of the library, at joints and within gears."""
        inner = (replace(e.inner, at=e.at) for e in self.gears if e.inner is not None)  # type: ignore[type-var]
        return (*(e.term for e in self.effects if isinstance(e, LawEffect)), *inner)

    def read(self, at: Array) -> dict[str, float]:
        """Return the values of all coordinates but those of the discrepancy."""
        found = {c.key: c.value(float(x)) for c, x in zip(self.own, at, strict=False)}
        for effect in self.effects:
            if isinstance(effect, LawEffect):
                found |= effect.fixed
        return found

    def run(
        self, at: Array, *, last: int | None = None, keep: bool = False, force: Array | None = None, **more: object
    ) -> FilteredLog:
        """Return the filter at coordinates; `force` is that of the discrepancy, where it is known already."""
        values, count = self.read(at), len(self.arm.joints)
        if force is None:
            force = self.discrepancy.force(at[len(self.own) :])
        levels = np.array([values[c.key] for c in self.own[: self.levels]])
        for effect in self.effects:
            if isinstance(effect, MassEffect):
                values[effect.value] = self.arm.values.get(effect.value, 0.0) + values[effect.coordinates[0].key]
        gears: dict[int, Gear] = {e.joint: e.make(values) for e in self.gears}
        return self.arm.filter(
            values, self.laws, (levels[:count] ** 2 * self.arm.log.dt, levels[count:] ** 2), gears=gears, force=force,
            last=self.last if last is None else last, keep=keep, **more,  # type: ignore[arg-type]
        )  # fmt: skip

    def expand(
        self, at: Array, *, last: int | None = None, near: Expansion | None = None
    ) -> tuple[Expansion, FilteredLog]:
        """Return the expansion of the one-step errors at coordinates; its prior is that of the own ones.

        The derivatives over levels are those of another expansion of the same samples, where one is `near`.
        """
        kept = self.run(at, last=last, keep=True)
        own, force = len(self.own), self.discrepancy.force(at[len(self.own) :])
        errors, variances = np.zeros((2, len(at), kept.seen.errors.size))
        first = self.levels if self.is_near(at, near) else 0
        if near is not None:
            errors[:first], variances[:first] = near.errors[:first], near.variances[:first]
        for i in range(first, own):
            step = max(NUDGE, 0.0 if self.own[i].log else SHARE * abs(float(at[i])))
            step = -step if at[i] + step > self.bounds[1][i] else step
            moved = at.copy()
            moved[i] += step
            seen = self.run(moved, last=last, force=force).seen
            if not seen.finite:
                step = -step
                moved[i] = at[i] + step
                seen = self.run(moved, last=last, force=force).seen
            errors[i] = (seen.errors - kept.seen.errors).ravel() / step
            variances[i] = (seen.variances - kept.seen.variances).ravel() / step
        gears = {e.joint: e.make(self.read(at)) for e in self.gears}
        errors[own:] = self.arm.differentiate(kept, self.discrepancy.columns, gears)
        middle = np.concatenate([[c.mean for c in self.own], np.zeros(len(at) - own)])
        precision = np.concatenate([[1.0 / c.sd**2 for c in self.own], np.zeros(len(at) - own)])
        flat = Innovations(kept.seen.errors.ravel(), kept.seen.variances.ravel(), kept.seen.finite)
        blocks = {"own": slice(0, own), "discrepancy": slice(own, len(at))}
        return Expansion(flat, at, errors, variances, middle, precision, blocks), kept

    def is_near(self, at: Array, near: Expansion | None) -> bool:
        """Return whether an expansion has nearly the same levels as some coordinates."""
        return near is not None and bool(np.all(np.abs(at[: self.levels] - near.at[: self.levels]) < NEAR))

    def follow(self, at: Array) -> ArmFrame:
        """Return the frame whose inertias in the discrepancy have the accelerations at coordinates."""
        a = self.run(at, last=self.arm.log.samples, keep=True).accelerations
        a[-1] = a[-2]
        return replace(self, discrepancy=self.discrepancy.follow(a))

    def weigh(self, choice: Choice) -> Array:
        """Return the prior precision of all coordinates; infinite where a coefficient is absent."""
        widths = np.concatenate([[c.sd for c in self.own], self.discrepancy.widths(choice)])
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / widths**2)

    def log_prior(self, at: Array, choice: Choice) -> float:
        """Return the log prior density of coordinates."""
        own = sum(c.log_prior(float(x)) for c, x in zip(self.own, at, strict=False))
        widths, rest = self.discrepancy.widths(choice), at[len(self.own) :]
        w, c = widths[widths > 0.0], rest[widths > 0.0]
        return own - float(np.sum(0.5 * (c / w) ** 2 + np.log(w) + 0.5 * math.log(2.0 * math.pi)))

    def target(self, at: Array, choice: Choice) -> tuple[float, Innovations]:
        """Return log-likelihood plus log prior density at coordinates, and the one-step errors there."""
        seen = self.run(at).seen
        found = float(seen.log_likelihood)
        return found + self.log_prior(at, choice) if math.isfinite(found) else -math.inf, seen

    @cached_property
    def bounds(self) -> tuple[Array, Array]:
        """The lowest and the highest value of each coordinate; those of the discrepancy have none."""
        low, high = np.full((2, len(self.own) + len(self.discrepancy.columns)), [[-math.inf], [math.inf]])
        for i, c in enumerate(self.own):
            low[i] = c.place(c.low) if math.isfinite(c.low) else -math.inf
            high[i] = c.place(c.high) if math.isfinite(c.high) else math.inf
        return low, high


@dataclass(frozen=True, eq=False)
class ArmHypothesis:
    """A fitted hypothesis: its frame, coordinates `at`, choice of smooth forces, and the parts of its score."""

    frame: ArmFrame
    at: Array
    choice: Choice
    log_evidence: float
    heldout: float
    price: float
    scatter: float
    expansion: Expansion
    kept: FilteredLog
    used: NDArray[np.intp]
    precision: Array
    unknown: bool = False

    @property
    def terms(self) -> frozenset[str]:
        """The keys of the effects, and `UNKNOWN` for a larger smooth force."""
        return self.frame.terms | ({UNKNOWN} if self.unknown else set())

    @property
    def values(self) -> dict[str, float]:
        """The values of all coordinates but those of the discrepancy."""
        return self.frame.read(self.at)

    def score(self, temper: float = 1.0) -> float:
        """Return the number by which hypotheses are compared."""
        return (self.log_evidence + self.heldout) / temper - self.price

    @cached_property
    def covariance(self) -> Array:
        """The posterior covariance of the coordinates in use."""
        return np.asarray(np.linalg.inv(self.precision))

    def deviation(self, key: str) -> float:
        """Return the posterior standard deviation of a coordinate, widened by the scatter of the scores."""
        index = [c.key for c in self.frame.own].index(key)
        place = int(np.flatnonzero(self.used == index)[0])
        return math.sqrt(self.scatter * self.covariance[place, place])

    def is_vague(self, key: str) -> bool:
        """Return whether the 95 % interval of an amplitude holds its null, zero."""
        index = [c.key for c in self.frame.own].index(key)
        return abs(float(self.at[index])) < 1.96 * self.deviation(key)


def fit_hypothesis(
    frame: ArmFrame, start: Array, price: float, choice: Choice | None = None, *, worth: float = -math.inf
) -> ArmHypothesis | None:
    """Return the fitted hypothesis from start coordinates; None where the filter diverges.

    Torques of unknown inertias depend on accelerations, and these on the hypothesis: it is fitted again with its own. A
    hypothesis with less log evidence than `worth` is fitted the less exactly, the more it lacks.
    """
    at, chosen = np.clip(start, *frame.bounds), choice or frame.discrepancy.none
    near: Expansion | None = None
    for again in (True, False):
        climbed = _climb(frame, at, chosen, worth, near)
        if climbed is None:
            return None
        at, chosen, seen, kept = climbed
        near = seen
        if not (again and frame.discrepancy.inertias):
            break
        frame = frame.follow(at)
    used, precision = find_precision(frame, seen, chosen)
    evidence = _compute_log_evidence(frame, seen, chosen, precision)
    if not math.isfinite(evidence):
        return None
    scatter = seen.measure_scatter_of(used[used >= len(frame.own)])
    return ArmHypothesis(frame, at, chosen, evidence, 0.0, price, scatter, seen, kept, used, precision)


def _compute_log_evidence(frame: ArmFrame, seen: Expansion, choice: Choice, precision: Array) -> float:
    """Return the log evidence by Laplace's method at an expansion; -inf where its precision is not positive."""
    target = float(seen.here.log_likelihood) + frame.log_prior(seen.at, choice) - frame.discrepancy.price(choice)
    sign, size = np.linalg.slogdet(precision)
    found = target + 0.5 * len(precision) * math.log(2.0 * math.pi) - 0.5 * float(size)
    return found if sign > 0 and math.isfinite(found) else -math.inf


def _climb(
    frame: ArmFrame, at: Array, chosen: Choice, worth: float, near: Expansion | None
) -> tuple[Array, Choice, Expansion, FilteredLog] | None:
    """Return the coordinates of the maximum, the choice of smooth forces, and the expansion and filter there.

    `near` is an expansion of the frame that may be near the start.
    """
    if not math.isfinite(frame.target(at, chosen)[0]):
        return None
    own = len(frame.own)
    damping = 0.0
    for _ in range(ROUNDS):
        seen, kept = frame.expand(at, near=near)
        near = near if frame.is_near(at, near) else seen
        if not np.isfinite(seen.information).all():
            return None
        chosen = _choose_forces(frame, seen, chosen)
        at = np.where(np.concatenate([np.ones(own, bool), frame.discrepancy.widths(chosen) > 0.0]), at, 0.0)
        used, precision = find_precision(frame, seen, chosen)
        there, gain, damping = _step(frame, (seen, chosen), at, (used, precision), damping)
        if gain < CLOSE:
            break
        at = there
        if gain < IDLE * (worth - _compute_log_evidence(frame, seen, chosen, precision) - gain):
            break
    if not np.array_equal(at, seen.at):
        seen, kept = frame.expand(at, near=near)
    return at, chosen, seen, kept


def _step(
    frame: ArmFrame, around: tuple[Expansion, Choice], at: Array, local: tuple[NDArray[np.intp], Array], damping: float
) -> tuple[Array, float, float]:
    """Return better coordinates, the gain, and the damping of the next step.

    After a damped step of Gauss-Newton, further ones use the same derivatives as long as they gain.
    """
    (seen, choice), (used, precision) = around, local
    own, weights = len(frame.own), frame.weigh(choice)[used]
    longest = np.where(used < own, LONGEST_STEP, math.inf)
    here, errors = frame.target(at, choice)
    total = 0.0
    for _ in range(MOST_STEPS):
        pull = seen.score(errors)[used] - weights * (at[used] - seen.middle[used])
        if not np.isfinite(pull).all():
            break
        low, high = (bound[used] - at[used] for bound in frame.bounds)
        damped = precision + damping * np.diag(np.diag(precision))
        there = at.copy()
        there[used] += maximise_within(pull, damped, np.maximum(low, -longest), np.minimum(high, longest))
        target, then = frame.target(there, choice)
        gain = target - here
        if gain > -1e-6:
            at, here, errors, total = there, target, then, total + gain
            damping *= 0.1
            if gain < max(CLOSE, CHORD * total):
                break
        elif total > 0.0:
            break
        else:
            damping = max(10.0 * damping, 0.1)
    return at, total, damping


def _choose_forces(frame: ArmFrame, seen: Expansion, choice: Choice) -> Choice:
    """Return the best sizes and lengths of the smooth forces, with the own coordinates re-optimised."""
    gradient, information = seen.curvature.profile(np.arange(len(frame.own)), np.arange(len(frame.own), len(seen.at)))
    return frame.discrepancy.choose(gradient, information, choice)


def find_precision(frame: ArmFrame, seen: Expansion, choice: Choice) -> tuple[NDArray[np.intp], Array]:
    """Return the indices of the coordinates in use, and the precision of their posterior."""
    weights = frame.weigh(choice)
    used = np.flatnonzero(np.isfinite(weights))
    return np.asarray(used), seen.information[np.ix_(used, used)] + np.diag(weights[used])


def score_heldout(found: ArmHypothesis, first: int, last: int) -> float:
    """Return the log density of the samples from `first` to `last`, averaged over the posterior of the fitted ones."""
    frame, picks = found.frame, len(found.frame.arm.log.picks)
    near: Expansion | None = None

    def expand(step: Array) -> Expansion:
        nonlocal near
        seen, _ = frame.expand(found.at + step, last=last, near=near)
        near = near or seen
        return cut_before(seen, first * picks)

    def score(step: Array) -> float:
        moved = frame.run(found.at + step, last=last).seen
        return float(replace(moved, errors=moved.errors[first:], variances=moved.variances[first:]).log_likelihood)

    levels = np.arange(len(found.at)) < frame.levels
    low, high = (bound - found.at for bound in frame.bounds)
    return average_over_posterior(NormalPosterior(found.used, found.precision, levels, low, high), expand, score)


def list_base(
    arm: TapedArm, forces: Sequence[float], noises: Sequence[float], estimated: Mapping[str, ArmCoordinate]
) -> tuple[ArmCoordinate, ...]:
    """Return the coordinates of levels, about usual random forces (N m) and noises (SI), and of estimated values."""
    levels = [
        ArmCoordinate(f"{joint}.random_force", 1.0, math.log(size), 3.0, log=True)
        for joint, size in zip(arm.joints, forces, strict=True)
    ]
    words = ("position", "velocity")
    levels += [
        ArmCoordinate(f"{arm.joints[j]}.{words[order]}_noise", 1.0, math.log(size), 3.0, log=True)
        for (j, order), size in zip(arm.log.picks, noises, strict=True)
    ]
    return (*levels, *estimated.values())
