"""The confidence level of each finding: named, likely or open, with the warnings that lower it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Term
from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.stages import SearchResult
from lostmotion.evidence.hypothesis import UNKNOWN, list_vague
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.penalties import is_simpler
from lostmotion.quantities import TIME
from lostmotion.report.words import sentence, to_words
from lostmotion.results import attach_unit, percent, rounded
from lostmotion.results.diagnosis import Mechanism, OpenTerm
from lostmotion.settings import DEFAULT, NameSettings

NAMED, LIKELY, OPEN = "named", "likely", "open"
SHORT = 1.0
"""A delay of no more than this number of samples may be that of the acquisition system."""


def is_valid(after: Prediction, floor: float, limits: NameSettings = DEFAULT.name) -> bool:
    """Return whether a model predicts held-out data; `floor` is the noise as a share of the response."""
    return math.isfinite(after.nrmse) and not after.nrmse > max(limits.error, limits.error_noise * floor)


def compute_probability(d: SearchResult, key: str) -> float:
    """Return the posterior probability of a term, with that of laws at the same place that contain it.

    Where friction drifts, there is friction.
    """
    return _sum_probabilities(d, key, is_simpler)


def _compute_equal_probability(d: SearchResult, key: str) -> float:
    """Return that probability, with that of terms that this kind of recording cannot distinguish from the term."""
    return _sum_probabilities(
        d, key, lambda term, other: is_simpler(term, other) or _are_indistinguishable(term, other)
    )


def _sum_probabilities(d: SearchResult, key: str, is_kin: Callable[[Term, Term], bool]) -> float:
    """Return the posterior probability of a term together with that of its kin, at most 1."""
    term, _ = find_term(d.after.problem, key)
    system = d.before.problem.system
    kin = {k for k, other in zip(system.keys, system.terms, strict=True) if is_kin(term, other)}
    return min(sum(d.explained.inclusion(k) for k in sorted({key} | kin)), 1.0)


def _are_indistinguishable(term: Term, other: Term) -> bool:
    return other.name in term.equals or term.name in other.equals


def list_warnings(d: SearchResult, key: str) -> list[str]:
    """Return the warnings on a found term, in sentences; a term without warnings is named."""
    term, _ = find_term(d.after.problem, key)
    imitates = term.unlikely > 0.0 or term.acts != "motion"
    steady = warn_of_moved_amplitudes(d, key) if imitates else ()
    weak = [*_warn_of_probability(d, key), *_warn_of_vague_size(d, key), *_warn_of_rest(d, key)]
    return [*weak, *steady, *_warn_of_early_change(d, key)]


def measure_remains(d: SearchResult) -> float:
    """Return the share of the missing force that is still missing with all findings; 0 without a random force."""
    if not (d.unexplained and d.left):
        return 0.0
    return float(np.std(d.left.missing.force) / np.std(d.located.missing.force))


def choose_state(d: SearchResult, doubts: Sequence[str], *, valid: bool) -> str:
    """Return the state of a found term: named without doubts, open in a model that is not valid and explains little."""
    if not doubts:
        return NAMED
    return LIKELY if valid or measure_remains(d) <= d.settings.name.remains else OPEN


def _warn_of_probability(d: SearchResult, key: str) -> Iterator[str]:
    p = _compute_equal_probability(d, key)
    if p > d.settings.name.sure:
        return
    others = _list_alternatives(d, key)
    if not others:
        yield f"Its probability is {rounded(p)}; the alternative is a small smooth force without a name."
        return
    names = ["an unknown force" if k == UNKNOWN else _name_law(d, k) for k in others]
    either = sum(share for terms, share in d.explained.probabilities.items() if terms & {key, *others})
    yield (
        f"Its probability is {rounded(p)}; the alternative{'s are' if len(names) > 1 else ' is'} {', '.join(names)}."
        f" Together they have the probability {rounded(min(either, 1.0))}."
    )


def _warn_of_vague_size(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning for each amplitude of a term whose interval reaches zero: then a simpler law may be the name."""
    for name in list_vague(d.explained.best, key):
        yield f"The interval of its {to_words(name)} reaches zero: the recording does not show it."


def _warn_of_rest(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning beside an unknown force, and if a further term adds less than the discrepancy does.

    A further term takes a share of the discrepancy more easily than the one that adds most.
    """
    unknown = d.explained.inclusion(UNKNOWN)
    if unknown > d.settings.name.rival:
        yield (
            "Beside the term, an unknown force that is larger than the usual errors of a model has the probability"
            f" {rounded(unknown)}: the term may be a part of it."
        )
    elif key != _find_first(d) and (left := d.explained.leftover) > (gain := compute_gain(d, key)):
        yield (
            f"Beside the terms, small errors of the model without a name add {rounded(left)} to the log evidence, this"
            f" term {rounded(max(gain, 0.0))}: it may be a part of them."
        )


def _find_first(d: SearchResult) -> str:
    """Return the found term that adds most to the others; empty without any."""
    return max(sorted(d.explained.terms), key=lambda key: compute_gain(d, key), default="")


def compute_gain(d: SearchResult, key: str) -> float:
    """Return the score that a found term adds to the other found terms."""
    return d.explained.gain_beside(key)


def _list_alternatives(d: SearchResult, key: str) -> list[str]:
    """Return the keys of the terms of alternative sets without this term that have a share of the posterior."""
    found, shares = d.explained.terms, d.explained.probabilities
    sets = [terms for terms, p in shares.items() if key not in terms and p > d.settings.name.rival]
    return list(dict.fromkeys(k for terms in sets for k in sorted(terms - found)))


def warn_of_moved_amplitudes(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning for each amplitude of another found term that changes strongly when this one is added."""
    whole = d.explained.best
    less = d.explained.found.get(whole.terms - {key})
    if less is None or key not in whole.terms:
        return
    sds, limits = np.sqrt(np.maximum(np.diag(less.covariance), 0.0)), d.settings.name
    for f, at, sd in zip(less.frame.problem.free[: less.frame.own], less.theta, sds, strict=True):
        owner, _, name = f.key.rpartition(".")
        if not owner or f.log or f.key not in whole.values:
            continue
        new = whole.values[f.key]
        if abs(new - at) > max(limits.moved * float(sd), limits.moved_share * abs(float(at))):
            first, then = (attach_unit(rounded(float(value), 3), f.unit) for value in (at, new))
            yield (
                f"The {name} of {to_words(owner.partition('@')[0])} is {first} without"
                f" {to_words(key.partition('@')[0])} and {then} with it: either it was not identified, or the further"
                " term is wrong."
            )


def _name_law(d: SearchResult, key: str) -> str:
    """Return the name of a term in words."""
    return to_words(find_term(d.before.problem, key)[0].name)


def warn_of_short_delay(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if the simplest explanation is a delay as short as in most acquisition systems."""
    samples = delay_in_samples(d.after, key)
    if samples <= SHORT:
        yield (
            f"A delay of {rounded(samples)} samples is usual in acquisition systems: it may be a property of the"
            " measurement and not of the machine."
        )


def delay_in_samples(fit: Fit, key: str) -> float:
    """Return the delay or the time constant of a channel in samples; infinity for other terms."""
    term, slots = find_term(fit.problem, key)
    late = [s for s in slots if s.param.dimension == TIME and s.key in fit.values]
    if term.acts == "motion" or not late:
        return math.inf
    return abs(fit.values[late[0].key]) / fit.problem.observations[0].dt


def _warn_of_early_change(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if a change is complete close to the start of the recording."""
    problem = d.after.problem
    for slot in find_term(problem, key)[1]:
        if not slot.param.lasting or slot.param.dimension != TIME or slot.key not in d.after.values:
            continue
        fitted = problem.observations[0]
        share = (d.after.values[slot.key] - float(fitted.time[0])) / (fitted.samples * fitted.dt)
        if share < d.settings.name.early:
            yield (
                f"The change is complete within the first {percent(max(share, 0.0))} of the"
                " recording: a wrong known value"
                " has the same effect."
            )


def limit_confidence(entry: Mechanism, sure: float = DEFAULT.name.sure) -> Mechanism:
    """Return an entry of `found`; with a warning it is likely, and its probability is at most `sure`."""
    if not entry.doubts or entry.state not in (NAMED, LIKELY):
        return entry
    return replace(entry, state=LIKELY, probability=min(entry.probability, sure))


def is_uncertain(entry: Mechanism) -> bool:
    """Return whether an entry is a term of the library with doubts, and not an unknown force."""
    return entry.state != NAMED and bool(entry.doubts)


def sort_findings(found: Sequence[Mechanism]) -> tuple[Mechanism, ...]:
    """Return the entries of `found` sorted by state: named, likely, open."""
    order = (NAMED, LIKELY, OPEN)
    return tuple(sorted(found, key=lambda entry: order.index(entry.state)))


def _list_tied(d: SearchResult) -> set[str]:
    """Return the term that alone adds much where smooth forces are absent, and is improbable beside them."""
    alone = {next(iter(terms)): fit.log_evidence for terms, fit in d.explained.fits.items() if len(terms) == 1}
    best = max(alone, key=lambda key: alone[key], default="")
    much = d.explained.nominal.log_evidence + d.settings.rival.much
    tied = best and alone[best] > much and d.explained.inclusion(best) < d.settings.name.rival
    return {best} if tied and not d.learned else set()


def list_open_terms(d: SearchResult) -> tuple[OpenTerm, ...]:
    """Return the open terms: they would raise the likelihood, but are improbable. Withdrawn terms come first."""
    reasons = [
        (set(d.withdrawn), "with it, held-out data are predicted worse"),
        (_list_tied(d), "a small generic smooth force explains as much"),
    ]
    rows: dict[str, OpenTerm] = {}
    for keys, why in reasons:
        for key in sorted(keys - set(d.found) - set(rows)):
            if key not in d.before.problem.system.keys:
                continue
            term, _ = find_term(d.before.problem, key)
            p = d.explained.inclusion(key) if key not in d.withdrawn else 0.0
            says = f"{sentence(_name_law(d, key))} would raise the likelihood, but {why}."
            rows[key] = OpenTerm(term.name, term.at, p, says)
    return tuple(rows.values())
