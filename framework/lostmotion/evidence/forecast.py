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

from lostmotion.contracts import Array
from lostmotion.evidence.bounds import DISTINCT, FIRST, Amplitudes, group_amplitudes, measure_share
from lostmotion.evidence.channels import list_channel_errors
from lostmotion.evidence.discrepancy import make_frame
from lostmotion.evidence.effects import (
    MUTE,
    TermEffect,
    differentiate_term,
    get_usual_shape,
    join_effects,
    linearise_all,
)
from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.inference.fit import Fit, choose_first_steps, solve_scaled
from lostmotion.inference.natural import compute_size, find_term, sort_slots
from lostmotion.inference.penalties import compute_penalty, is_simpler
from lostmotion.kernels.threads import each
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import RANDOM
from lostmotion.likelihood.system import Slot
from lostmotion.likelihood.tangents import Tangents

CHANCE, SURE = 0.9, 0.95
"""The chance of a name at the stated size, and the probability from which a term is named."""
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
        return _Rival(self.key, self.paid, 0.5 * float(np.mean(np.einsum("ik,ij,jk->k", pulled, self.metric, pulled))))


@dataclass(frozen=True, eq=False)
class Forecast:
    """The nominal hypothesis at the usual random force, with the effects of terms along the recording.

    `repeated` is the ratio of all samples to those of the expansion. The effects are the last coordinates of `joined`,
    in blocks with the key of their term.
    """

    found: Hypothesis
    joined: Expansion
    effects: Mapping[str, TermEffect]
    filtered: Sequence[Tangents]
    repeated: float
    many: int

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
        rows = each(self._find_sizes, list(self.effects), self.found.frame.problem.jobs)
        return [one for row in rows for one in row]

    def _find_sizes(self, key: str) -> list[Detectable]:
        problem, effect = self.found.frame.problem, self.effects[key]
        found = []
        for group in group_amplitudes(problem, key, effect.amplitudes):
            slots = tuple(effect.amplitudes[k] for k in group)
            if parameter := self._find_alike(key, group):
                found.append(Detectable(key, slots, effect.shape, math.inf, alike=parameter))
                continue
            size, rivals = self._find_size(key, group)
            limit = max(compute_size(slot.param, problem.scales) for slot in slots)
            size = size if size < limit else math.inf
            if math.isfinite(size) and not self._is_linear(key, group, size):
                found.append(Detectable(key, slots, effect.shape, math.inf, linear=False))
                continue
            bounded: Amplitudes = (effect.shape, effect.amplitudes, group)
            share = measure_share(problem, self.filtered, key, bounded, size) if math.isfinite(size) else math.nan
            size = math.inf if share > MOST_SHARE else size
            found.append(Detectable(key, slots, effect.shape, size, share, rivals))
        return found

    def _is_linear(self, key: str, group: Sequence[int], size: float) -> bool:
        """Return whether the secant to a size changes one-step errors as much as the derivative does."""
        frame, effect = self.found.frame, self.effects[key]
        problem = frame.bare(frame.start, frame.none)
        sizes = np.array([compute_size(slot.param, problem.scales) for slot in effect.amplitudes]) * FIRST
        sizes[list(group)] = size / math.sqrt(len(group))
        at = frame.start[: len(problem.free)]
        secant = next(differentiate_term(problem, at, self.filtered, key, (effect.shape,), sizes), None)
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
        physical = [f.physical for f in frame.problem.free[: frame.own]]
        return frame.names[int(np.argmax(np.where(physical, np.nan_to_num(cosines), 0.0)))]

    def _find_size(self, key: str, group: Sequence[int]) -> tuple[float, tuple[str, ...]]:
        """Return the size of an amplitude that is named with the chance, and the terms that cannot be told from it.

        Terms that contain this law, or that it contains, count as this one.
        """
        columns = self.information[:, self.joined.list_indices(key)[list(group)]]
        own, term = self._terms[key].explain(columns), find_term(self.found.frame.problem, key)[0]
        plain = [_Rival("", 0.0, 0.0), *(one.explain(columns) for one in self._smooth_forces)]
        least = max(_solve_size(own, rival) for rival in plain)
        others = {}
        for other, explainer in self._terms.items():
            law = find_term(self.found.frame.problem, other)[0]
            if not (other == key or is_simpler(term, law) or is_simpler(law, term) or law.name in term.equals):
                others[other] = _solve_size(own, explainer.explain(columns))
        far = tuple(name for name, size in others.items() if size > FAR * least)
        return max([least, *(size for name, size in others.items() if name not in far)]), far

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
        problem = self.found.frame.problem
        return compute_penalty(find_term(problem, key)[0], self.many, problem.settings)


def _solve_size(own: _Rival, rival: _Rival) -> float:
    """Return the size at which an effect has the odds over a rival, with the chance; infinity where it has never."""
    apart = own.explained - rival.explained
    z = float(norm.ppf(CHANCE))
    wanted = math.log(SURE / (1.0 - SURE)) + own.paid - rival.paid
    if z * z + 2.0 * wanted <= 0.0:
        return 0.0
    return (z + math.sqrt(z * z + 2.0 * wanted)) / math.sqrt(2.0 * apart) if apart > 0.0 else math.inf


def make_forecast(
    nominal: Fit, keys: Sequence[str], recordings: Sequence[Observation], *, repeated: float = 1.0
) -> Forecast:
    """Return the forecast of a nominal fit for terms `keys`.

    `recordings` are whole ones, `repeated` is their number of samples over that of the fit. The random force is at most
    the usual noise of the drive: what is missing must not hide itself. Smooth forces are those of the system of the
    fit, if it has them.
    """
    problem, theta = nominal.problem, nominal.theta.copy()
    for i, f in enumerate(problem.free):
        if f.parameter == RANDOM:
            theta[i] = min(theta[i], f.mean)
    frame = make_frame(problem, theta, list_channel_errors(nominal, recordings))
    steps = nominal.local.steps if len(nominal.local.steps) == frame.own else choose_first_steps(problem)
    found = Hypothesis(frame, frame.expand(frame.start, steps, frame.none), frame.none, 0.0, 0.0, 0.0)
    bare = frame.bare(frame.start, frame.none)
    at = frame.start[: len(bare.free)]
    filtered = linearise_all(bare, at)

    def differentiate(key: str) -> TermEffect | None:
        shape = get_usual_shape(bare, key)
        shapes = () if shape is None or not sort_slots(bare, key)[0] else (shape,)
        return next(differentiate_term(bare, at, filtered, key, shapes), None)

    made = [one for one in each(differentiate, list(keys), problem.jobs) if one is not None]
    told = {one.key: one for one in made if np.any(one.errors) or np.any(one.variances)}
    return Forecast(found, join_effects(found.expansion, list(told.values())), told, filtered, repeated, len(keys))
