"""Upper bounds of the terms that a hypothesis does not have: how large they may be, given all that is in it.

One-step errors are nearly linear in a small amplitude, so its posterior has a closed form: normal, with own parameters,
known values, smooth forces and errors of channels integrated, and as wide as scores scatter. The derivative is the
secant to the bound itself. A term whose secants do not settle has no bound.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.stats import norm

from lostmotion.contracts import Array, Term
from lostmotion.evidence.effects import (
    TermEffect,
    differentiate_term,
    get_usual_shape,
    set_amplitude,
)
from lostmotion.evidence.expansion import compute_cross_information, differentiate_density
from lostmotion.evidence.hypothesis import Hypothesis, group_amplitudes
from lostmotion.inference.natural import compute_size, find_term, sort_slots
from lostmotion.inference.penalties import is_simpler
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.kernels.threads import each
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import Slot
from lostmotion.likelihood.tangents import Tangents, linearise_recordings
from lostmotion.quantities import FORCE

LEVEL = 0.95
"""The probability that an amplitude is below its bound."""
FIRST, ROUNDS, SETTLED = 0.01, 3, 0.1
"""The first secant in typical sizes, the largest number of secants, and the relative change of a bound that settled."""
DRAWS = 4000
"""The number of fixed normal draws from which the bound of a wave, of two amplitudes, is found."""
DISTINCT = 0.007
"""The share of the information on an amplitude that own coordinates leave, at least: derivatives are not more exact."""
UNSEEN, ALIKE, NONLINEAR = "unseen", "alike", "nonlinear"
"""Why a term has no bound: the recording does not limit it, the model imitates it, its effect is far from linear."""


@dataclass(frozen=True)
class SizeBound:
    """The bound of one amplitude of an absent term, or of the two of a wave, in SI units.

    It holds at the values of `shape`. `force` is the largest force of the term at this size as a share of the drive;
    NaN where it exerts none that is known. `why` is one of `UNSEEN`, `ALIKE`, `NONLINEAR`, or empty for a valid bound.
    """

    key: str
    slots: tuple[Slot, ...]
    shape: Mapping[str, float]
    upper: float
    force: float = math.nan
    why: str = ""


@dataclass(frozen=True)
class AmplitudePosterior:
    """The normal posterior of the amplitudes of a term beside a hypothesis: `mean` (k,) and `covariance` (k, k).

    `alike` (k,) tells which amplitudes other amplitudes or the own coordinates of the hypothesis imitate.
    """

    mean: Array
    covariance: Array
    alike: NDArray[np.bool_]


def bound_absent(found: Hypothesis, keys: Sequence[str]) -> list[SizeBound]:
    """Return the bounds of the amplitudes of terms that a hypothesis does not have; those of no effect are left out."""
    posterior = found.frame.bare(found.at, found.choice)
    theta = found.at[: len(posterior.space.free)]
    filtered = linearise_recordings(posterior, theta)
    rows = each(lambda key: list(_bound_term(found, posterior, filtered, key)), list(keys), posterior.jobs)
    return [bound for row in rows for bound in row]


def compute_amplitudes(found: Hypothesis, effect: TermEffect) -> AmplitudePosterior:
    """Return the posterior of the amplitudes of a term beside a hypothesis, with a flat prior."""
    expansion, used = found.expansion, found.used
    here = expansion.here
    own = compute_cross_information(here, effect.errors, effect.variances, effect.errors, effect.variances)
    beside = expansion.errors[used], expansion.variances[used]
    cross = compute_cross_information(here, effect.errors, effect.variances, *beside)
    over_errors, over_variances = differentiate_density(here)
    gradient = effect.errors @ over_errors + effect.variances @ over_variances
    told = np.diag(own)
    scale = 1.0 / np.sqrt(np.where(told > 0.0, told, 1.0))
    covariance = _invert(own - cross @ found.joint_covariance @ cross.T, scale)
    mean = covariance @ (gradient - cross @ found.joint_covariance @ found.pull)
    mine = cross[:, : found.frame.own]
    known = expansion.information[: found.frame.own, : found.frame.own]
    alone = _invert(own - mine @ solve_scaled(known, mine.T), scale)
    alike = told * np.diag(alone) > 1.0 / DISTINCT
    return AmplitudePosterior(mean, found.scatter * covariance, alike)


def _invert(left: Array, scale: Array) -> Array:
    """Return the inverse (k, k) of what is left of an information, whose rows times `scale` are of the order of one."""
    values, vectors = np.linalg.eigh(left * np.outer(scale, scale))
    return np.asarray((vectors / np.maximum(values, 1e-12)) @ vectors.T * np.outer(scale, scale))


def _bound_term(found: Hypothesis, posterior: Posterior, filtered: Sequence[Tangents], key: str) -> Iterator[SizeBound]:
    """Yield the bounds of the amplitudes of a term at its usual shape."""
    shape, (amplitudes, _) = get_usual_shape(posterior, key), sort_slots(posterior, key)
    groups = list_bounded(posterior, key, amplitudes)
    if shape is None or not groups:
        return
    theta = found.at[: len(posterior.space.free)]
    typical = np.array([compute_size(s.param, posterior.scales) for s in amplitudes])
    most = np.array([float(np.max(typical[group])) for group in groups])
    sizes, last = FIRST * typical, np.zeros(len(groups))
    uppers, why = last, [NONLINEAR] * len(groups)
    for _ in range(ROUNDS):
        effect = next(differentiate_term(posterior, theta, filtered, key, (shape,), sizes), None)
        if effect is None:
            break
        told = compute_amplitudes(found, effect)
        uppers = np.array([_bound_group(told, amplitudes, group) for group in groups])
        why = [
            "" if abs(upper - before) < SETTLED * before else NONLINEAR if upper < limit
            else ALIKE if np.any(told.alike[group]) else UNSEEN
            for group, upper, before, limit in zip(groups, uppers, last, most, strict=True)
        ]  # fmt: skip
        if NONLINEAR not in why:
            break
        last = np.minimum(uppers, most)
        for group, upper in zip(groups, last, strict=True):
            sizes[group] = upper / math.sqrt(len(group))
    for group, upper, reason in zip(groups, uppers, why, strict=True):
        slots = tuple(amplitudes[k] for k in group)
        share = math.nan if reason else measure_share(posterior, filtered, key, (shape, amplitudes, group), upper)
        yield SizeBound(key, slots, shape, math.inf if reason else float(upper), share, reason)


def list_bounded(posterior: Posterior, key: str, amplitudes: Sequence[Slot]) -> list[list[int]]:
    """Return the indices of the amplitudes that are bounded, in groups (`group_amplitudes`).

    Beside a simpler law of the model that it contains, a richer law has its further amplitudes only; without any, it
    has none.
    """
    term, system = find_term(posterior, key)[0], posterior.system
    groups = group_amplitudes(posterior, key, amplitudes)
    beside = any(k in posterior.active for k, t in zip(system.keys, system.terms, strict=True) if is_simpler(t, term))
    return [] if beside and sum(map(len, groups)) == len(amplitudes) else groups


def _bound_group(posterior: AmplitudePosterior, amplitudes: Sequence[Slot], group: Sequence[int]) -> float:
    """Return the bound of an amplitude, or of the size of a wave; infinity where the model imitates it."""
    if np.any(posterior.alike[list(group)]):
        return math.inf
    covariance = posterior.covariance[np.ix_(group, group)]
    if len(group) > 1:
        values, vectors = np.linalg.eigh(covariance)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        drawn = np.random.default_rng(0).standard_normal((DRAWS, len(group))) @ root.T + posterior.mean[list(group)]
        return float(np.quantile(np.linalg.norm(drawn, axis=1), LEVEL))
    param = amplitudes[group[0]].param
    mean, sd = float(posterior.mean[group[0]]), math.sqrt(float(covariance[0, 0]))
    if not (math.isfinite(mean) and 0.0 < sd < math.inf):
        return math.inf
    return bound_positive(mean, sd) if param.low >= (param.null or 0.0) else bound_absolute(mean, sd)


def bound_positive(mean: float, sd: float) -> float:
    """Return the 95 % quantile of a normal number that is known to be positive."""
    return mean - sd * float(norm.ppf((1.0 - LEVEL) * norm.cdf(mean / sd))) if mean > -30.0 * sd else sd


def bound_absolute(mean: float, sd: float) -> float:
    """Return the 95 % quantile of the absolute value of a normal number."""

    def excess(upper: float) -> float:
        return float(norm.cdf((upper - mean) / sd) - norm.cdf((-upper - mean) / sd)) - LEVEL

    return float(brentq(excess, 0.0, abs(mean) + 5.0 * sd))


Amplitudes = tuple[Mapping[str, float], Sequence[Slot], Sequence[int]]
"""The shape of a term, its amplitudes, and the indices of those that are bounded."""


def measure_share(
    posterior: Posterior, filtered: Sequence[Tangents], key: str, bounded: Amplitudes, upper: float
) -> float:
    """Return the largest force of a term at its bound over that of the drive; NaN for a sensor, or where none is known.

    That of a drive term is the largest change of the input over its amplitude.
    """
    term, (shape, amplitudes, group) = find_term(posterior, key)[0], bounded
    if term.acts == "sensor":
        return math.nan
    if term.states:
        return upper / posterior.scales.force if amplitudes[group[0]].param.dimension == FORCE else math.nan
    size = upper / math.sqrt(len(group))
    pairs = [(one, set_amplitude(one, shape, amplitudes, k, size)) for one in filtered for k in group]
    shares = [_measure_one(one, key, term, full) for one, full in pairs]
    return math.sqrt(len(group)) * max(shares) if shares else math.nan


def _measure_one(filtered: Tangents, key: str, term: Term, full: Array) -> float:
    """Return the largest force of a term with the parameters `full` in one recording, as a share of the drive."""
    posterior = filtered.posterior
    active = posterior.active | {key}
    if term.acts == "drive":
        changed = posterior.acting(active).recordings[0].drive(full).inputs[: len(filtered.states)] - filtered.inputs
        return float(np.max(np.abs(changed[:, filtered.observation.lead]))) / max(filtered.observation.travel, 1e-300)
    observation, system = filtered.observation, posterior.system
    packed = posterior.dynamics.pack(full[None], observation)
    force = system.compute_force(key, active, packed, (filtered.states, filtered.inputs, observation.time))
    return float(np.max(np.abs(force))) / posterior.scales.force
