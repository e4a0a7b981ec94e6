"""The entry of a force that no mechanism explains: its covariates, the learned curve, and a proposed formula."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy.ndimage import maximum_filter

from lostmotion.codec import Cells
from lostmotion.contracts import Array, place_of
from lostmotion.diagnosis.stages import ForceLocation, SearchResult
from lostmotion.diagnosis.states import OPEN
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.inference.curves import Band, compute_band, smooth_motions
from lostmotion.inference.fit import Fit
from lostmotion.inference.learned import list_covariates
from lostmotion.inference.likeness import find_likeness
from lostmotion.inference.natural import find_term
from lostmotion.inference.odds import compute_p_values
from lostmotion.inference.proposal import Axis, propose_formula
from lostmotion.inference.shares import SURROGATES
from lostmotion.inference.surfaces import OverHistory, Surface
from lostmotion.inference.unexplained import UnknownForce
from lostmotion.likelihood.space import RANDOM
from lostmotion.quantities import LENGTH, NUMBER, SPEED, TIME, Dimension
from lostmotion.report.words import to_words
from lostmotion.results import Interval, join_names, percent, rounded
from lostmotion.results.diagnosis import LearnedCurve, LookAlike, Mechanism, ProposedFormula
from lostmotion.results.mismatch import ForceDependence

OVER: dict[str, tuple[str, Dimension]] = {
    "position": ("x", LENGTH),
    "velocity": ("v", SPEED),
    "time": ("t", TIME),
    "phase": ("phase", NUMBER),
    "history": ("z", LENGTH),
}
"""Symbol and dimension of each covariate of a curve; the phase is in periods of the drive. The history of a motion is
the elongation of a spring in series with a dashpot."""
NOT_FOUND = "A proposal, not a finding: the finding is the curve, and other formulas may fit it as well."
NONE_FITS = "No short formula fits the curve."
NO_INTERVAL = "A smoothed force is the visible part of the missing one; its rms has no interval."
BAND = 1.96
RATIO = "the robust likelihood ratio of a curve over each covariate in the filter"


def make_learned_entry(d: SearchResult) -> Mechanism:
    """Return the entry of a force that learned curves describe, because no term of the library explains it."""
    unknown = d.learned
    if unknown is None:
        raise ValueError("a diagnosis without learned curves has no entry for them")
    bands = [compute_band(unknown.fit, key) for key in unknown.keys]
    curves = tuple(_make_curve(d, key, band) for key, band in zip(unknown.keys, bands, strict=True))
    rms, sd = _compute_size(d, unknown.keys, bands)
    unit = _find_unit(d, Dimension(1, 0, 0))
    size = Interval(rms, max(rms - BAND * sd, 0.0), rms + BAND * sd, unit)
    depends = list_covariates(unknown.terms)
    share = rms / d.after.posterior.scales.force
    size_of = f"{rounded(rms, 3)} {unit} rms, {percent(share)} of {d.yardstick}"
    alike, share_of_likeness, looks = _compare_with_library(d)
    probability, log_odds = weigh_unknown(d)
    rival = _describe_rival(d)
    text = f"A force of {size_of}, is missing{'' if rival else ' that no term of the library explains'}"
    return Mechanism(
        mechanism="unknown",
        at=unknown.terms[0].at,
        probability=probability,
        state=OPEN,
        log_odds=log_odds,
        depends_on=tuple(depends),
        parameters={"rms": size},
        curve=curves[0],
        curves=curves,
        proposal=_make_proposal(d, bands),
        looks_like=alike,
        share_of_likeness=share_of_likeness,
        share_of_drive=share,
        says=f"{text}: it depends on {join_names(depends)}{looks} and is modelled by a learned curve.{rival}",
    )


def _describe_rival(d: SearchResult) -> str:
    """Return a sentence on laws that explain the data nearly as well as a small force without a name, or nothing."""
    shares = {terms: p for terms, p in d.explained.probabilities.items() if terms and UNKNOWN not in terms}
    terms, p = max(shares.items(), key=lambda pair: pair[1], default=(frozenset(), 0.0))
    if d.explained.terms or p < d.settings.name.rival:
        return ""
    laws = join_names([to_words(find_term(d.after.posterior, key)[0].name) for key in sorted(terms)])
    return f" It may be {laws} as well, with the probability {rounded(p)}."


def _compare_with_library(d: SearchResult) -> tuple[tuple[LookAlike, ...], float | None, str]:
    """Return the terms that a learned force resembles along the motion, their share of its variance, and a clause.

    The share is None if it resembles none.
    """
    if d.learned is None or d.left is None:
        return (), None, ""
    force = np.sum([d.laws[key] for key in d.learned.keys], axis=0)
    posterior = d.after.posterior.on((d.shown,))
    found = find_likeness(posterior, d.after.theta, d.left.missing.states, force)
    if found is None:
        return (), None, ""
    terms = [find_term(posterior, key)[0] for key in found.keys]
    several = len(posterior.system.model.places) > 1
    names = [to_words(term.name) + (f" at {term.at}" if several else "") for term in terms]
    alike = tuple(LookAlike(term.name, term.at) for term in terms)
    return alike, found.share, f", looks like {' and '.join(names)} ({percent(found.share)} of its variance)"


def make_unnamed_entry(d: SearchResult) -> Mechanism:
    """Return the entry of a force that neither a term nor a curve explains: "unknown" with structure, else random."""
    located = d.left or d.located
    depends = [] if d.found else located.structure
    visible, unit = float(np.std(located.missing.force)), _find_unit(d, Dimension(1, 0, 0))
    share = f"{percent(visible / d.after.posterior.scales.force)} of {d.yardstick}"
    if depends:
        size = Interval(visible, math.nan, math.nan, unit, withheld=NO_INTERVAL)
        says = f"A force of {rounded(visible, 3)} {unit} rms, {share}, is missing; no term explains it; it depends on"
        says = f"{says} {join_names(depends)}."
    else:
        size = _compute_random_size(d.after, d.shown.dt, unit)
        says = (
            f"A random force of {size} rms (up to {rounded(0.5 / d.shown.dt, 3)} Hz) acts; no term explains it; it"
            f" depends on nothing that was recorded. The sensors show {rounded(visible, 3)} {unit} rms of it, {share}."
        )
    return Mechanism(
        mechanism="unknown" if depends else "random_force",
        probability=1.0 - math.exp(-d.random_gain),
        state=OPEN,
        depends_on=tuple(depends),
        parameters={"rms": size},
        says=says,
    )


def _compute_random_size(fit: Fit, dt: float, unit: str) -> Interval:
    """Return the rms of the random force of a fit, up to half the sampling rate, with its 95 % interval.

    White noise of intensity I has a variance of I / dt in this band. Where each recording has a random force of its
    own, it is the largest.
    """
    at = max(
        (i for i, f in enumerate(fit.posterior.space.free) if f.parameter == RANDOM), key=lambda i: float(fit.theta[i])
    )
    half = BAND * math.sqrt(max(float(fit.local.covariance[at, at]), 0.0))
    middle, low, high = (math.exp(0.5 * (float(fit.theta[at]) + shift)) for shift in (0.0, -half, half))
    root = math.sqrt(dt)
    return Interval(middle / root, low / root, high / root, unit)


def _find_unit(d: SearchResult, dimension: Dimension) -> str:
    return dimension.unit(d.after.posterior.system.model.motion)


def _compute_size(d: SearchResult, keys: Sequence[str], bands: Sequence[Band]) -> tuple[float, float]:
    """Return the rms of the learned force along the recording, and its standard error: the largest of all curves."""
    law = np.sum([d.laws[key] for key in keys], axis=0)
    rms = float(np.sqrt(np.mean(law**2)))
    return rms, rms * max(_compute_relative_error(band) for band in bands)


def _compute_relative_error(band: Band) -> float:
    """Return the relative standard error of the size of a curve: of its projection onto itself."""
    norm = max(float(np.linalg.norm(band.mean)), 1e-300)
    direction = band.mean / norm
    return math.sqrt(max(float(direction @ band.covariance @ direction), 0.0)) / norm


def _make_curve(d: SearchResult, key: str, band: Band) -> LearnedCurve:
    """Return a learned curve with its 95 % band; a surface as tables, a force with memory with its time constant."""
    term, half = band.term, BAND * band.sd
    curve = LearnedCurve(
        over=term.over,
        at_place=term.at,
        unit=_find_unit(d, OVER[term.over][1]),
        force_unit=_find_unit(d, term.params[0].dimension),
        times=term.times,
        at=tuple(band.at.tolist()),
        force=_make_cells(band, band.mean),
        low=_make_cells(band, band.mean - half),
        high=_make_cells(band, band.mean + half),
    )
    if band.beside is not None and isinstance(term, Surface):
        unit, at_too = _find_unit(d, OVER[term.beside][1]), tuple(band.beside.tolist())
        seen = tuple(map(tuple, _mark_visited(d, band, term).tolist()))
        curve = replace(curve, over_too=term.beside, unit_too=unit, at_too=at_too, visited=seen)
    if isinstance(term, OverHistory):
        posterior = d.after.posterior
        curve = replace(curve, forgets_in=float(posterior.known[posterior.system.index[f"{key}.time"]]))
    return curve


def _make_cells(band: Band, values: Array) -> tuple[Cells, ...]:
    """Return the values of a curve (points,), or those of a surface in rows over its first axis."""
    if band.beside is None:
        return tuple(values.tolist())
    return tuple(map(tuple, values.reshape(len(band.at), -1).tolist()))


def _mark_visited(d: SearchResult, band: Band, term: Surface) -> Array:
    """Return which cells (points, points) of the grid of a surface the motion visited, with their neighbours."""
    posterior, beside = d.after.posterior, np.asarray(band.beside)
    place = place_of(posterior.system.model, term)
    seen = np.zeros((len(band.at), len(beside)), dtype=bool)
    for motion, observation in zip(smooth_motions(d.after, [place])[place.name], posterior.observations, strict=True):
        second = (
            motion[1] if term.beside == "velocity" else observation.time * observation.harmonic.omega / math.tau % 1.0
        )
        cells = [
            np.clip(np.searchsorted(axis, values), 0, len(axis) - 1)
            for axis, values in ((band.at, motion[0]), (beside, second))
        ]
        seen[cells[0], cells[1]] = True
    return np.asarray(maximum_filter(seen, size=3))


def _make_proposal(d: SearchResult, bands: list[Band]) -> ProposedFormula:
    """Return the formula that a sparse regression proposes for the curves, marked as a proposal."""
    parts, shares = [], []
    for band in bands:
        formula = _find_formula(d, band)
        if formula is None:
            return ProposedFormula(formula=None, says=NONE_FITS)
        parts.append(formula[0])
        shares.append(formula[1])
    return ProposedFormula(formula=" + ".join(parts), share_of_curve=min(shares), says=NOT_FOUND)


def _find_formula(d: SearchResult, band: Band) -> tuple[str, float] | None:
    if band.beside is not None or band.term.over == "history":
        return None
    axis = Axis(*OVER[band.term.over], band.term.params[0].dimension, d.after.posterior.system.model.motion)
    found = propose_formula(band.at, band.mean, band.covariance, axis, d.settings.unknown)
    if found is None:
        return None
    return (f"{band.term.times} ({found.text})" if band.term.times else found.text), found.share


def weigh_unknown(d: SearchResult) -> tuple[float, float]:
    """Return the probability of a force that the library does not contain, and its log evidence.

    Curves that were learned beside no term, where a smooth force of the usual size explains as much, share the
    probability of the model without any term.
    """
    if d.learned and UNKNOWN not in d.explained.best.terms:
        return d.learned.probability * d.explained.probabilities[d.explained.best.terms], d.learned.gain
    scores = {terms: one.score() for terms, one in d.explained.found.items()}
    random = d.random_gain if d.unexplained and not d.found else 0.0
    return compute_unknown_odds(d.explained.inclusion(UNKNOWN), scores, random)


def compute_unknown_odds(p: float, scores: Mapping[frozenset[str], float], random_gain: float) -> tuple[float, float]:
    """Return the probability of a force that the library does not contain, and its log evidence.

    It is an unknown smooth force with the probability `p`, in sets of terms with these scores, or a random force that
    adds `random_gain` in log-likelihood.
    """
    random = 1.0 - math.exp(-random_gain)
    if random >= p:
        return random, random_gain
    known = [score for terms, score in scores.items() if UNKNOWN not in terms]
    with_it = [score for terms, score in scores.items() if UNKNOWN in terms]
    return p, max(with_it) - max(known)


def describe_dependence(located: ForceLocation, learned: UnknownForce | None = None) -> ForceDependence:
    """Return what a force depends on: a sentence, shares of its variance, and the significant covariates."""
    explained, summary = located.explained, located.summary
    if learned:
        names = join_names(list_covariates(learned.terms))
        summary = f"a function of {names}, as the learned curve has it; by itself: {summary}"
    by_share = {name: share.p for name, share in explained.items()}
    against = RATIO if located.odds else f"{SURROGATES} phase-randomised surrogates"
    return ForceDependence(
        summary=summary,
        explained_by=located.shares,
        standard_error={name: share.error for name, share in explained.items()},
        log_likelihood_ratio={name: ratio.log for name, ratio in located.odds.items()},
        robust_log_likelihood_ratio={name: ratio.robust for name, ratio in located.odds.items()},
        p_value=compute_p_values(located.odds) if located.odds else by_share,
        p_value_of_share=by_share,
        significant=tuple(located.significant),
        against=f"{against}, at {percent(located.limits.level)} over all covariates together",
    )
