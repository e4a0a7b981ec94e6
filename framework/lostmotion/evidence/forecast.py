"""What a recording can tell before terms are fitted: expected intervals, and the smallest effects that would be named.

The information of the nominal model along the recording predicts both (Fisher information). An effect of size a changes
the log evidence of a hypothesis by a^2 q - o: q is what its coordinates explain of the effect, o its Occam factor. Its
name needs odds of 19 over nothing missing, over each smooth force of the discrepancy and over each other term. The log
odds scatter by sqrt(2 (q - q')) a, so the size with a chance of 90 % is the root of a quadratic equation.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from lostmotion.contracts import Array, Term
from lostmotion.evidence.bounds import DISTINCT, FIRST, Amplitudes, list_bounded, measure_share
from lostmotion.evidence.channel_errors import list_channel_errors
from lostmotion.evidence.discrepancy import make_frame
from lostmotion.evidence.effects import (
    MUTE,
    TermEffect,
    differentiate_term,
    get_usual_shape,
    join_effects,
)
from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.explanations import TIED
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.inference.fit import Fit, choose_first_steps
from lostmotion.inference.natural import compute_size, find_term, sort_slots
from lostmotion.inference.penalties import compute_penalty, compute_unknown_price, is_simpler
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.kernels.threads import each
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.system import Slot
from lostmotion.likelihood.tangents import Tangents, linearise_recordings

CHANCE, SURE = 0.9, 0.95
"""The chance of a name at the stated size, and the probability from which a term is named."""
SLACK = 1.2
"""Sizes are larger by this than the closed form says: a search loses something, by several terms that act together
against one and by local maxima (without it, `benchmarks/check.py` named 4 of 6 effects)."""
Z = float(norm.ppf(CHANCE))
"""The standard score of the chance."""
STEP, MOST_STEPS = 1.1, 40
"""Sizes are tried in these steps, at most so many."""
RAISED = (1.5, 3.0, 4.5, 6.0)
"""The increases of the log random force above the usual that hide a term."""
LINEAR = 1.4
"""The secant and the derivative of an effect that is linear agree within this factor."""
MOST_SHARE = 1.0
"""A term whose force would have to be a larger share of the drive is not named at any usual size."""
FAR = 3.0
"""Terms that are told apart only at this many times the smallest size, or more, are those that cannot be told apart."""


@dataclass(frozen=True)
class Detectable:
    """The smallest amplitude of a term that would be named with a chance of 90 %, in SI units; infinite for none.

    It holds at the values of `shape`. `share` is its largest force as a share of the drive; NaN where that is not
    known. `rivals` are the keys of terms from which this recording cannot tell it, `alike` is an estimated parameter
    that has the same effect, or empty. `linear` tells whether the effect is proportional to a small size.
    """

    key: str
    slots: tuple[Slot, ...]
    shape: Mapping[str, float]
    size: float
    share: float = math.nan
    rivals: tuple[str, ...] = ()
    alike: str = ""
    linear: bool = True


@dataclass(frozen=True)
class _Rival:
    """What another explanation needs: its Occam factor and price together, and the size of what it explains."""

    key: str
    paid: float
    explained: float

    def hide(self, own: _Rival, cost: float, left: float) -> _Rival:
        """Return this explanation with a larger random force, which leaves a share of what tells `own` from it."""
        return _Rival(self.key, self.paid + cost, own.explained - left * (own.explained - self.explained))


@dataclass(frozen=True)
class RandomLevel:
    """A random force above the usual: its cost in log-likelihood where nothing is missing, and what it hides.

    `left` is the share of the information on each term that remains under it, by key; `usual` that of other terms. The
    fit of a model that lacks a term raises the random force, which hides the term in part.
    """

    cost: float
    left: Mapping[str, float]
    usual: float


@dataclass(frozen=True, eq=False)
class _Explainer:
    """Normal coefficients at `places` as an explanation of effects: the `metric` (k, k) of gradients, and the price."""

    key: str
    places: NDArray[np.intp]
    metric: Array
    paid: float

    def explain(self, columns: Array) -> _Rival:
        """Return what the coefficients explain of an effect of unit size.

        `columns` (n, amplitudes) is its gradient: of a wave the mean over its two amplitudes counts.
        """
        pulled = columns[self.places]
        squares = np.einsum("ik,ij,jk->k", pulled, self.metric, pulled)
        return _Rival(self.key, self.paid, 0.5 * float(np.add.reduce(squares) / len(squares)))  # np.mean is slow


@dataclass(frozen=True, eq=False)
class Forecast:
    """The nominal hypothesis at the usual random force, with the effects of terms along the recording.

    `repeated` is the ratio of all samples to those of the expansion. The effects are the last coordinates of `joined`,
    in blocks with the key of their term. `levels` are random forces that the fit without a term may have.
    """

    found: Hypothesis
    joined: Expansion
    effects: Mapping[str, TermEffect]
    filtered: Sequence[Tangents]
    repeated: float
    many: int
    levels: Sequence[RandomLevel] = ()

    def tell(self, key: str) -> float:
        """Return the information on the first amplitude of a term."""
        place = self.joined.blocks[key].start
        return float(self.information[place, place])

    @cached_property
    def information(self) -> Array:
        """The information (n, n) of all samples on smooth forces and effects, the rest integrated; zero elsewhere."""
        whole = self.repeated * self.joined.information
        base = self.found.used
        inner = whole[np.ix_(base, base)] + self.found.precision - self.found.expansion.information[np.ix_(base, base)]
        left = whole - whole[:, base] @ solve_scaled(inner, whole[base])
        left[:, base], left[base] = 0.0, 0.0
        return np.asarray(0.5 * (left + left.T))

    @property
    def valid(self) -> bool:
        """Whether the model can follow the recordings: the filter did not diverge."""
        return bool(np.all(np.isfinite(self.joined.information)))

    def list_detectable(self) -> list[Detectable]:
        """Return the smallest size of each amplitude of each term."""
        rows = each(self._find_sizes, list(self.effects), self.found.frame.posterior.jobs)
        return [one for row in rows for one in row]

    def _find_sizes(self, key: str) -> list[Detectable]:
        posterior, effect = self.found.frame.posterior, self.effects[key]
        found = []
        for group in list_bounded(posterior, key, effect.amplitudes):
            slots = tuple(effect.amplitudes[k] for k in group)
            if parameter := self._find_alike(key, group):
                found.append(Detectable(key, slots, effect.shape, math.inf, alike=parameter))
                continue
            size, rivals = self._find_size(key, group)
            size *= SLACK
            limit = max(compute_size(slot.param, posterior.scales) for slot in slots)
            size = size if size < limit else math.inf
            if math.isfinite(size) and not self._is_linear(key, group, size):
                found.append(Detectable(key, slots, effect.shape, math.inf, linear=False))
                continue
            bounded: Amplitudes = (effect.shape, effect.amplitudes, group)
            share = measure_share(posterior, self.filtered, key, bounded, size) if math.isfinite(size) else math.nan
            size = math.inf if share > MOST_SHARE else size
            found.append(Detectable(key, slots, effect.shape, size, share, rivals))
        return found

    def _is_linear(self, key: str, group: Sequence[int], size: float) -> bool:
        """Return whether the secant to a size changes one-step errors as much as the derivative does."""
        frame, effect = self.found.frame, self.effects[key]
        posterior = frame.bare(frame.start, frame.none)
        sizes = np.array([compute_size(slot.param, posterior.scales) for slot in effect.amplitudes]) * FIRST
        sizes[list(group)] = size / math.sqrt(len(group))
        at = frame.start[: len(posterior.space.free)]
        secant = next(differentiate_term(posterior, at, self.filtered, key, (effect.shape,), sizes), None)
        if secant is None:
            return False
        v = self.joined.here.variances
        told = [float(np.sum(one.errors[list(group)] ** 2 / v)) for one in (secant, effect)]
        return max(told) < LINEAR**2 * min(told)

    def _find_alike(self, key: str, group: Sequence[int]) -> str:
        """Return the estimated parameter that has the same effect as an amplitude; empty where there is none."""
        frame, whole = self.found.frame, self.joined.information
        own = np.arange(frame.own)
        places = self.joined.list_indices(key)[list(group)]
        cross = whole[np.ix_(own, places)]
        told = np.diag(whole)[places]
        if not np.all(told * self.effects[key].widths[list(group)] ** 2 > MUTE):
            return ""
        left = told - np.einsum("ik,ik->k", cross, solve_scaled(whole[np.ix_(own, own)], cross))
        if np.all(left > DISTINCT * told):
            return ""
        with np.errstate(divide="ignore", invalid="ignore"):
            cosines = np.abs(cross[:, 0]) / np.sqrt(np.diag(whole)[own] * told[0])
        physical = [f.physical for f in frame.posterior.space.free[: frame.own]]
        return frame.names[int(np.argmax(np.where(physical, np.nan_to_num(cosines), 0.0)))]

    def _find_size(self, key: str, group: Sequence[int]) -> tuple[float, tuple[str, ...]]:
        """Return the size of an amplitude that is named with the chance, and the terms that cannot be told from it.

        Terms that contain this law, or that it contains, count as this one.
        """
        columns = self.information[:, self.joined.list_indices(key)[list(group)]]
        own, term = self._terms[key].explain(columns), self._laws[key]
        levels = [(0.0, 1.0), *((level.cost, level.left.get(key, level.usual)) for level in self.levels)]

        def solve(rival: _Rival) -> float:
            return max(_solve_size(own, rival.hide(own, *level)) for level in levels)

        plain = [_Rival("", 0.0, 0.0), *(one.explain(columns) for one in self._smooth_forces)]
        least = self._propose(own, max(map(solve, plain)), levels)
        others = {}
        for other, explainer in self._terms.items():
            law = self._laws[other]
            if not (other == key or is_simpler(term, law) or is_simpler(law, term) or law.name in term.equals):
                rival = explainer.explain(columns)
                others[other] = self._part(own, rival, columns, max(solve(rival), least))
        far = tuple(name for name, size in others.items() if size > FAR * least)
        return max([least, *(size for name, size in others.items() if name not in far)]), far

    def _propose(self, own: _Rival, size: float, levels: Sequence[tuple[float, float]]) -> float:
        """Return the size from which score tests beside the fit without a term propose it, at least `size`."""
        fitted = own.explained / self.repeated
        for _ in range(MOST_STEPS if math.isfinite(size) and own.explained > 0.0 else 0):
            left = min(levels, key=lambda level: level[0] + size**2 * own.explained * level[1])[1]
            apart = math.sqrt(2.0 * fitted * left) * size
            if 0.5 * apart**2 - Z * apart > own.paid:
                break
            size *= STEP
        return size

    def _part(self, own: _Rival, rival: _Rival, columns: Array, size: float) -> float:
        """Return the size from which another law does not predict the same readings, at least `size`.

        Laws that do share their probability (`Explanations`). The other law has the smooth force that explains most.
        """
        if rival.explained < 0.5 * own.explained or not math.isfinite(size):
            return size
        both = [rival, *(one.explain(columns) for one in self._get_pairs(rival.key))]
        for _ in range(MOST_STEPS):
            best = max(both, key=lambda one: size**2 * one.explained - one.paid)
            apart = max(own.explained - best.explained, 0.0) / self.repeated
            if math.sqrt(2.0 * apart) * size > math.sqrt(2.0 * TIED) + Z:
                return size
            size *= STEP
        return math.inf

    def _get_pairs(self, key: str) -> Sequence[_Explainer]:
        """Return a term together with each smooth force, as explanations of effects."""
        if key not in self._pairs:
            places, widths = self.joined.list_indices(key), self.effects[key].widths
            self._pairs[key] = [
                self._make_explainer(
                    key,
                    np.append(places, self.joined.list_indices(force.key)),
                    np.append(widths, options),
                    self._price(key) + math.log(len(force.options)),
                )
                for force in self.found.frame.forces
                for options in force.options
            ]
        return self._pairs[key]

    @cached_property
    def _pairs(self) -> dict[str, Sequence[_Explainer]]:
        """What `_get_pairs` has made."""
        return {}

    @cached_property
    def _laws(self) -> Mapping[str, Term]:
        """The term of each key."""
        system = self.found.frame.posterior.system
        return dict(zip(system.keys, system.terms, strict=True))

    @cached_property
    def _terms(self) -> Mapping[str, _Explainer]:
        """Each term as an explanation of effects, by key."""
        return {
            key: self._make_explainer(key, self.joined.list_indices(key), effect.widths, self._price(key))
            for key, effect in self.effects.items()
        }

    @cached_property
    def _smooth_forces(self) -> Sequence[_Explainer]:
        """The smooth forces of the discrepancy, each with each of its sizes and lengths, as explanations of effects."""
        return [
            self._make_explainer(force.key, self.joined.list_indices(force.key), widths, math.log(len(force.options)))
            for force in self.found.frame.forces
            for widths in force.options
        ]

    def _make_explainer(self, key: str, places: NDArray[np.intp], widths: Array, price: float) -> _Explainer:
        """Return normal coefficients at `places` with prior `widths` as an explanation of effects."""
        inner = self.information[np.ix_(places, places)] * np.outer(widths, widths)
        inner.flat[:: len(widths) + 1] += 1.0
        metric = widths[:, None] * np.linalg.solve(inner, np.diag(widths))
        return _Explainer(key, places, metric, price + 0.5 * float(np.linalg.slogdet(inner)[1]))

    def _price(self, key: str) -> float:
        """Return the log prior odds against a term."""
        posterior = self.found.frame.posterior
        return compute_penalty(find_term(posterior, key)[0], self.many, posterior.settings)


def _solve_size(own: _Rival, rival: _Rival) -> float:
    """Return the size at which an effect has the odds over a rival, with the chance; infinity where it has never."""
    apart = own.explained - rival.explained
    z = Z
    wanted = math.log(SURE / (1.0 - SURE)) + own.paid - rival.paid
    if z * z + 2.0 * wanted <= 0.0:
        return 0.0
    return (z + math.sqrt(z * z + 2.0 * wanted)) / math.sqrt(2.0 * apart) if apart > 0.0 else math.inf


def make_forecast(
    nominal: Fit, keys: Sequence[str], recordings: Sequence[Observation], *, repeated: float = 1.0, raised: float = 0.0
) -> Forecast:
    """Return the forecast of a nominal fit for terms `keys`.

    `recordings` are whole ones, `repeated` is their number of samples over that of the fit. The random force is at most
    the usual noise of the drive, because what is missing must not hide itself; its logarithm is increased by `raised`.
    Smooth forces are those of the system of the fit, if it has them.
    """
    posterior, theta = nominal.posterior, nominal.theta.copy()
    for i, f in enumerate(posterior.space.free):
        if f.parameter == RANDOM:
            theta[i] = min(theta[i], f.mean) + raised
    frame = make_frame(posterior, theta, list_channel_errors(nominal, recordings), compute_unknown_price(len(keys)))
    steps = nominal.local.steps if len(nominal.local.steps) == frame.own else choose_first_steps(posterior)
    found = Hypothesis(frame, frame.expand(frame.start, steps, frame.none), frame.none, 0.0, 0.0, 0.0)
    bare = frame.bare(frame.start, frame.none)
    at = frame.start[: len(bare.space.free)]
    filtered = linearise_recordings(bare, at)

    def differentiate(key: str) -> TermEffect | None:
        shape = get_usual_shape(bare, key)
        shapes = () if shape is None or not sort_slots(bare, key)[0] else (shape,)
        return next(differentiate_term(bare, at, filtered, key, shapes), None)

    made = [one for one in each(differentiate, list(keys), posterior.jobs) if one is not None]
    told = {one.key: one for one in made if np.any(one.errors) or np.any(one.variances)}
    return Forecast(found, join_effects(found.expansion, list(told.values())), told, filtered, repeated, len(keys))


def measure_levels(simulated: Fit, keys: Sequence[str], samples: int) -> list[RandomLevel]:
    """Return what larger random forces hide of terms, from a simulated recording in which nothing is missing.

    The fit has the recording and the coordinates with which it was simulated; costs are those of `samples`.
    """
    recordings = simulated.posterior.observations
    first, *others = (make_forecast(simulated, keys, recordings, raised=raised) for raised in (0.0, *RAISED))
    share, levels = samples / max(simulated.posterior.samples, 1), []
    for forecast in others:
        left = {}
        for key in first.effects.keys() & forecast.effects.keys():
            before, after = first.tell(key), forecast.tell(key)
            left[key] = float(np.clip(after / before, 0.0, 1.0)) if before > 0.0 else 1.0
        cost = first.found.expansion.here.log_likelihood - forecast.found.expansion.here.log_likelihood
        levels.append(RandomLevel(max(share * float(cost), 0.0), left, float(np.median(list(left.values()) or [1.0]))))
    return levels
