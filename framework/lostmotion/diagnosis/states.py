"""The state of each finding: named, likely or open, with the doubts that lower it, and the terms that remain open."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from lostmotion.contracts import Term
from lostmotion.diagnosis.facts import Doubt, Facts, FoundTerm, doubt, write_doubts
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.inference.penalties import is_simpler, weigh_rarity
from lostmotion.report.words import sentence, to_words
from lostmotion.results import attach_unit, percent, rounded
from lostmotion.results.diagnosis import Mechanism, OpenTerm
from lostmotion.settings import DEFAULT

NAMED, LIKELY, OPEN = "named", "likely", "open"
ABOVE_NOISE = 5.0
"""A model that does not predict has errors of free runs that exceed this many times the noise."""
MOVED = 0.2
"""An amplitude that was not identified moves by this share of itself."""
SHORT = 1.0
"""A delay of no more than this number of samples may be that of the acquisition system."""


def is_valid(facts: Facts) -> bool:
    """Return whether the last model predicts held-out data."""
    limits, error = facts.settings.name, facts.after.nrmse
    return math.isfinite(error) and not error > max(limits.error, ABOVE_NOISE * facts.noise_floor)


def explain_withheld(facts: Facts) -> str:
    """Return the reason why intervals are withheld: the model does not predict held-out data; empty if it does."""
    if is_valid(facts):
        return ""
    model = "model" if facts.augmented else "nominal model"
    return (
        f"The {model} is not valid: the error of its free runs over held-out data is"
        f" {percent(facts.after.nrmse)} of the"
        f" response, and the noise is {percent(facts.noise_floor)}. What is missing remains open, and intervals are"
        " withheld."
    )


def compute_probability(facts: Facts, found: FoundTerm) -> float:
    """Return the posterior probability of a found term, with that of laws at the same place that contain it.

    Where friction drifts, there is friction.
    """
    return _sum_probabilities(facts, found, is_simpler)


def _sum_probabilities(facts: Facts, found: FoundTerm, is_kin: Callable[[Term, Term], bool]) -> float:
    """Return the posterior probability of a found term together with that of its kin, at most 1."""
    kin = {one.key for one in facts.candidates if is_kin(found.term, one.term)}
    return min(sum(facts.inclusion(key) for key in sorted({found.key} | kin)), 1.0)


def _is_equal(term: Term, other: Term) -> bool:
    """Return whether a law contains a term, or no recording of this kind can tell the two apart."""
    return is_simpler(term, other) or other.name in term.equals or term.name in other.equals


def _list_alternatives(facts: Facts, found: FoundTerm) -> list[str]:
    """Return the keys of the laws of other sets without this term that have a share of the posterior."""
    named = {one.key for one in facts.found}
    sets = [terms for terms, p in facts.sets.items() if found.key not in terms and p > facts.settings.name.rival]
    return list(dict.fromkeys(key for terms in sets for key in sorted(terms - named)))


@doubt()
def doubt_probability(facts: Facts, found: FoundTerm) -> Iterator[str]:
    """Yield a doubt if other laws are nearly as probable as the term and those that no recording can tell from it."""
    p = _sum_probabilities(facts, found, _is_equal)
    if p > facts.settings.name.sure:
        return
    others = _list_alternatives(facts, found)
    if not others:
        yield f"Its probability is {rounded(p)}; the alternative is a small smooth force without a name."
        return
    names = ["an unknown force" if key == UNKNOWN else to_words(facts.find(key).term.name) for key in others]
    either = sum(share for terms, share in facts.sets.items() if terms & {found.key, *others})
    yield (
        f"Its probability is {rounded(p)}; the alternative{'s are' if len(names) > 1 else ' is'} {', '.join(names)}."
        f" Together they have the probability {rounded(min(either, 1.0))}."
    )


@doubt("vague")
def doubt_vague_size(_: Facts, found: FoundTerm) -> Iterator[str]:
    """Yield a doubt for each amplitude whose interval reaches zero: then a simpler law may be the name."""
    for name in found.support.vague:
        yield f"The interval of its {to_words(name)} reaches zero: the recording does not show it."


@doubt()
def doubt_rest(facts: Facts, _: FoundTerm) -> Iterator[str]:
    """Yield a doubt beside an unknown force."""
    unknown = facts.inclusion(UNKNOWN)
    if unknown > facts.settings.name.rival:
        yield (
            "Beside the term, an unknown force that is larger than the usual errors of a model has the probability"
            f" {rounded(unknown)}: the term may be a part of it."
        )


@doubt()
def doubt_free_runs(facts: Facts, _: FoundTerm) -> Iterator[str]:
    """Yield a doubt if free runs over held-out data are worse with all that was found, as far as the page shows it.

    Of a model that is not valid the error is given already.
    """
    before, after = facts.before.nrmse, facts.after.nrmse
    if is_valid(facts) and after > before and percent(after) != percent(before):
        yield (
            f"With all that was found, the error of free runs over held-out data rises from {percent(before)} to"
            f" {percent(after)}: one-step predictions support the term, longer ones do not."
        )


@doubt("moved")
def doubt_moved_amplitudes(facts: Facts, found: FoundTerm) -> Iterator[str]:
    """Yield a doubt for each amplitude of another found term that changes strongly when this one is added."""
    limits = facts.settings.name
    for one in found.support.moved:
        if abs(one.beside - one.alone) > max(limits.moved * one.sd, MOVED * abs(one.alone)):
            first, then = (attach_unit(rounded(value, 3), one.unit) for value in (one.alone, one.beside))
            yield (
                f"The {one.name} of {one.term} is {first} without {to_words(found.term.name)} and {then} with it:"
                " either it was not identified, or the further term is wrong."
            )


@doubt("delay")
def doubt_short_delay(_: Facts, found: FoundTerm) -> Iterator[str]:
    """Yield a doubt if the simplest explanation is a delay as short as in most acquisition systems."""
    samples = found.support.delay
    if samples is not None and samples <= SHORT:
        count = f"{rounded(samples)} {'sample' if rounded(samples) == '1' else 'samples'}"
        yield (
            f"A delay of {count} is usual in acquisition systems: it may be a property of the measurement and not of"
            " the machine."
        )


@doubt("complete")
def doubt_early_change(facts: Facts, found: FoundTerm) -> Iterator[str]:
    """Yield a doubt if a change is complete close to the start of the recording."""
    for share in found.support.complete:
        if share < facts.settings.name.early:
            yield (
                f"The change is complete within the first {percent(max(share, 0.0))} of the"
                " recording: a wrong known value"
                " has the same effect."
            )


WEAK: tuple[Doubt, ...] = (doubt_probability, doubt_vague_size, doubt_rest, doubt_free_runs)
"""The doubts about any found term."""


def list_doubts(facts: Facts, found: FoundTerm) -> tuple[str, ...]:
    """Return the doubts about a found term, in sentences; a term without doubts is named.

    Only terms that are rare, or act on a channel, are doubted because they change the amplitudes of others.
    """
    imitates = weigh_rarity(found.term) > 0.0 or found.term.acts != "motion"
    rules = (*WEAK, *((doubt_moved_amplitudes,) if imitates else ()), doubt_early_change)
    return write_doubts(rules, facts, found)


def choose_state(facts: Facts, doubts: Sequence[str]) -> str:
    """Return the state of a found term: named without doubts, open in a model that is not valid and explains little."""
    if not doubts:
        return NAMED
    return LIKELY if is_valid(facts) or facts.remains <= facts.settings.name.remains else OPEN


def limit_confidence(entry: Mechanism, sure: float = DEFAULT.name.sure) -> Mechanism:
    """Return an entry of `found`; with a doubt it is likely, and its probability is at most `sure`."""
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


def list_open_terms(facts: Facts) -> tuple[OpenTerm, ...]:
    """Return the open terms: they would raise the likelihood, but are improbable. Withdrawn terms come first."""
    found, rows = {one.key for one in facts.found}, dict[str, OpenTerm]()
    reasons = [
        (set(facts.withdrawn), "with it, held-out data are predicted worse"),
        (_list_tied(facts), "a small generic smooth force explains as much"),
    ]
    for keys, why in reasons:
        for one in sorted(facts.candidates, key=lambda one: one.key):
            if one.key in keys - found - set(rows):
                p = 0.0 if one.key in facts.withdrawn else facts.inclusion(one.key)
                says = f"{sentence(to_words(one.term.name))} would raise the likelihood, but {why}."
                rows[one.key] = OpenTerm(one.term.name, one.term.at, p, says)
    return tuple(rows.values())


def _list_tied(facts: Facts) -> set[str]:
    """Return the term that alone adds much where smooth forces are absent, and is improbable beside them.

    One that contains a found law is not told from it.
    """
    alone = {one.key: one for one in facts.candidates if one.alone is not None}
    best = max(alone.values(), key=lambda one: one.alone or 0.0, default=None)
    if best is None or facts.learned or not (best.alone or 0.0) > facts.settings.rival.much:
        return set()
    told = any(is_simpler(one.term, best.term) for one in facts.found)
    return {best.key} if facts.inclusion(best.key) < facts.settings.name.rival and not told else set()
