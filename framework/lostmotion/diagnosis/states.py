"""The confidence level of each finding: named, likely or open, with the warnings that lower it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Term
from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.search import SearchResult
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.penalties import is_simpler
from lostmotion.inference.term_sets import SimplestTerms
from lostmotion.quantities import TIME
from lostmotion.report.words import to_words
from lostmotion.results import attach_unit, percent, rounded
from lostmotion.results.diagnosis import Mechanism, OpenTerm
from lostmotion.settings import DEFAULT, NameSettings

NAMED, LIKELY, OPEN = "named", "likely", "open"


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


def list_improbable(d: SearchResult) -> list[str]:
    """Return the found terms that are less probable than a rival is, with their kin; none beside learned curves.

    Held-out data may prefer such a term to the one that the fitted data chose. If all data together speak for something
    else, it is no finding.
    """
    if d.learned:
        return []
    return [key for key in d.named if _compute_equal_probability(d, key) <= d.settings.name.rival]


def _sum_probabilities(d: SearchResult, key: str, is_kin: Callable[[Term, Term], bool]) -> float:
    """Return the posterior probability of a term together with that of its kin, at most 1."""
    term, _ = find_term(d.after.problem, key)
    system = d.before.problem.system
    kin = {k for k, other in zip(system.keys, system.terms, strict=True) if is_kin(term, other)}
    return min(sum(d.selection.inclusion(k) for k in sorted({key} | kin)), 1.0)


def _are_indistinguishable(term: Term, other: Term) -> bool:
    return other.name in term.equals or term.name in other.equals


def list_warnings(d: SearchResult, key: str) -> list[str]:
    """Return the warnings on a found term, in sentences; a term without warnings is named."""
    term, _ = find_term(d.after.problem, key)
    imitates = term.unlikely > 0.0 or term.acts != "motion"
    steady = warn_of_moved_amplitudes(d, key) if imitates else ()
    weak = [
        *_warn_of_probability(d, key),
        *_warn_of_equal_terms(d, key),
        *_warn_of_heldout_decision(d, key),
        *_warn_of_rest(d, key),
    ]
    return [*weak, *steady, *_warn_of_long_delay(d, key), *_warn_of_short_delay(d, key), *_warn_of_early_change(d, key)]


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
    if d.selection.simplest:
        others = _list_simplest_alternatives(d, d.selection.simplest, key)
        good = "any learned curve and predicts held-out data as well as one"
        if not d.selection.simplest.curve:
            good = "the model alone and predicts held-out data better"
        yield (
            f"It explains the fitted data better than {good}; but a small generic smooth force explains about as much,"
            f" so its probability is {rounded(p)}."
            + (f" On these data it cannot be distinguished from: {', '.join(others)}." if others else "")
        )
        return
    if p > d.settings.name.sure:
        return
    others = _list_alternatives(d, key)
    verb = "alternatives are" if len(others) > 1 else "alternative is"
    yield f"Its probability is {rounded(p)}; the {verb} {', '.join(others) or 'a generic smooth force'}."


def _warn_of_equal_terms(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if other terms explain the fitted data as well without this one.

    Such a set is less probable because of its prior penalties or the comparison with a smooth force, not because of
    the data. A law that contains this one is no alternative.
    """
    chosen, problem = d.selection.chosen, d.before.problem
    terms = chosen.problem.active
    if _compute_equal_probability(d, key) <= d.settings.name.sure:
        return
    barred, own = terms | d.selection.declined | d.selection.withdrawn, find_term(problem, key)[0]
    for others, term_set in d.selection.fitted_sets.items():
        fresh = sorted(others - terms)
        if key in others or len(others) > len(terms) or not fresh or (others - terms) & barred:
            continue
        near = chosen.log_evidence - term_set.fit.log_evidence < d.settings.name.related
        if near and not any(
            _are_indistinguishable(own, t) or is_simpler(own, t) for t in (find_term(problem, k)[0] for k in fresh)
        ):
            names = " and ".join(
                [_name_term(d, fresh[0]), *(to_words(find_term(problem, k)[0].name) for k in fresh[1:])]
            )
            yield (
                f"{names} {'explain' if fresh[1:] else 'explains'} the fitted data as well: only the prior odds of the"
                " terms, or the comparison with a smooth force, decide against this alternative."
            )
            return


def _warn_of_heldout_decision(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if held-out data decided between the term and a generic smooth force, or another set of terms."""
    chosen, gains = d.selection.chosen.problem.active, d.selection.heldout_gains
    if chosen not in gains:
        return
    if key in d.selection.tied:
        decide = f"held-out data decide for the term, by {rounded(gains[chosen])} in log score."
        if not gains[chosen] > 0.0:
            decide = "free runs over held-out data decide for the term."
        yield f"On the fitted data a small generic smooth force explains about as much as this term; {decide}"
    elif not replace(d.selection, heldout_gains={}).inclusion(key) > d.settings.name.sure:
        gain = gains[chosen]
        by = f", and their log score is higher by {rounded(gain)}" if gain > 0.0 else ""
        yield f"The fitted data alone do not decide for this term; free runs over held-out data do{by}."


def _warn_of_rest(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if much is unexplained beside a term: a large learned curve or a large random force."""
    limits = d.settings.name
    if d.learned and compute_gain(d, key) < limits.beside * d.learned.gain:
        yield (
            f"It adds {rounded(compute_gain(d, key), 3)} in log evidence, and the unexplained force beside it adds"
            f" {rounded(d.learned.gain, 3)}: the term may be a part of that force."
        )
    elif (share := measure_remains(d)) > limits.remains:
        yield f"With it, {percent(share)} of the missing force is still missing."


def _list_simplest_alternatives(d: SearchResult, simplest: SimplestTerms, key: str) -> list[str]:
    """Return the names of the terms, one of which may be the simplest explanation in place of the chosen terms."""
    found, least, p = d.selection.chosen.problem.active, d.settings.name.rival, simplest.probabilities
    keys = sorted((k for k in p if k not in found and p[k] > least * p.get(key, 0.0)), key=lambda k: -p[k])
    return list(dict.fromkeys(to_words(find_term(d.before.problem, k)[0].name) for k in keys))


def compute_gain(d: SearchResult, key: str) -> float:
    """Return the log weight that a found term adds to the other found terms, or else to the nominal model."""
    fitted_sets, terms = d.selection.fitted_sets, frozenset(d.named)
    here, less = fitted_sets.get(terms), fitted_sets.get(terms - {key})
    return here.weight - less.weight if here and less else d.selection.gain(key)


def _list_alternatives(d: SearchResult, key: str) -> list[str]:
    """Return the names of the terms of alternative sets without this term that have a share of the posterior."""
    found = d.selection.chosen.problem.active
    sets = [terms for terms, p in d.selection.probabilities().items() if key not in terms and p > d.settings.name.rival]
    names = dict.fromkeys(k for terms in sets for k in sorted(terms - found))
    return [to_words(find_term(d.before.problem, k)[0].name) for k in names]


def warn_of_moved_amplitudes(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning for each amplitude of another found term that changes strongly when this one is added."""
    chosen = d.selection.chosen
    without = d.selection.fitted_sets.get(chosen.problem.active - {key})
    if without is None:
        return
    sds, limits = without.fit.sd, d.settings.name
    for f in without.fit.problem.free:
        owner, _, name = f.key.rpartition(".")
        if not owner or f.log or f.key not in chosen.values:
            continue
        old, new = without.fit.values[f.key], chosen.values[f.key]
        if abs(new - old) > max(limits.moved * sds[f.key], limits.moved_share * abs(old)):
            first, then = (attach_unit(rounded(value, 3), f.unit) for value in (old, new))
            yield (
                f"The {name} of {to_words(owner.partition('@')[0])} is {first} without"
                f" {to_words(key.partition('@')[0])} and {then} with it: either"
                " it was not identified, or"
                " the further term is wrong."
            )


def _name_term(d: SearchResult, key: str) -> str:
    """Return the name of a term in words, capitalised."""
    name = to_words(find_term(d.before.problem, key)[0].name)
    return name[:1].upper() + name[1:]


def _warn_of_long_delay(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if a delay is longer than acquisition systems usually have."""
    term, slots = find_term(d.after.problem, key)
    late = [s for s in slots if s.param.dimension == TIME and s.key in d.after.values]
    if term.acts == "motion" or not late:
        return
    period = 2.0 * math.pi * d.after.problem.scales.time
    share = abs(d.after.values[late[0].key]) / period
    if share > d.settings.name.late:
        yield (
            f"A delay of {percent(share)} of a natural period is unusual: measure the delay between"
            " the channels directly."
        )


def _warn_of_short_delay(d: SearchResult, key: str) -> Iterator[str]:
    """Yield a warning if the simplest explanation is a delay as short as in most acquisition systems."""
    samples = delay_in_samples(d.after, key)
    if d.selection.simplest and samples <= d.settings.rival.late:
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


def list_open_terms(d: SearchResult) -> tuple[OpenTerm, ...]:
    """Return the open terms: they would raise the likelihood, but a check failed. Withdrawn terms come first."""
    reasons = [
        (set(d.withdrawn), "with it, held-out data are predicted worse, or it is improbable in view of all data"),
        (d.selection.tied, "a small generic smooth force explains as much"),
        (d.selection.declined, "the residuals are autocorrelated, so this gain is not reliable"),
    ]
    rows: dict[str, OpenTerm] = {}
    for keys, why in reasons:
        for key in sorted(keys - set(d.found) - set(rows)):
            if key not in d.before.problem.system.keys:
                continue
            term, _ = find_term(d.before.problem, key)
            p = d.selection.inclusion(key) if key not in d.withdrawn else 0.0
            says = f"{_name_term(d, key)} would raise the likelihood, but {why}."
            rows[key] = OpenTerm(term.name, term.at, p, says)
    return tuple(rows.values())
