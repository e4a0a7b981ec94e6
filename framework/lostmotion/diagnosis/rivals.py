"""The alternatives that a recording cannot distinguish from what was found, and experiments that can."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from lostmotion.case import Experiment
from lostmotion.contracts import Term
from lostmotion.diagnosis.experiment import Limits, Proposal, choose_limits, compute_natural_frequency, propose
from lostmotion.diagnosis.facts import Facts
from lostmotion.diagnosis.verdict import name_other_recording
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.inference.fit import Fit
from lostmotion.report.words import sentence, to_words
from lostmotion.results import rounded
from lostmotion.results.diagnosis import Confusion, DecidingExcitation

MOST_RIVALS = 2
"""Experiments are designed for this number of rivals, the most probable ones."""

Proposals = Mapping[str, Proposal | None]


def find_rivals(facts: Facts) -> dict[str, frozenset[str]]:
    """Return the best set with each term that is an alternative to the found terms, by key, most probable term first.

    There is none if a curve was learned beside the selected terms.
    """
    found = {one.key for one in facts.found}
    rows = {}
    for one in facts.candidates:
        sets = [terms for terms in facts.sets if one.key in terms and UNKNOWN not in terms]
        if one.key not in found and sets and facts.inclusion(one.key) > facts.settings.name.worth:
            rows[one.key] = max(sets, key=lambda terms: facts.sets[terms])
    return {} if facts.learned else dict(sorted(rows.items(), key=lambda row: -facts.inclusion(row[0])))


def propose_experiments(
    facts: Facts,
    fits: Mapping[frozenset[str], Fit],
    allowed: Experiment | None,
    *,
    rng: np.random.Generator,
    say: Callable[[str], None] = lambda _: None,
) -> dict[str, Proposal | None]:
    """Return the experiment that best distinguishes the found terms from each of the most probable rivals, by key.

    `fits` are those of the sets of terms. It is None if experiments are not `allowed` or the machine is not driven.
    """
    heaviest = list(find_rivals(facts).items())[:MOST_RIVALS]
    if not heaviest:
        return {}
    chosen = fits[frozenset(one.key for one in facts.found)]
    if allowed is None or chosen.posterior.observations[0].free:
        return {key: None for key, _ in heaviest}
    usual = choose_limits(chosen.posterior.observations[0], compute_natural_frequency(chosen))
    limits = Limits(allowed.max_level or usual.level, allowed.max_frequency or usual.frequency)
    return {
        key: propose(chosen, fits[terms], limits=limits, rng=rng, say=lambda step, key=key: say(f"{key}: {step}"))  # type: ignore[misc]
        for key, terms in heaviest
    }


def describe_confusions(facts: Facts, rows: Sequence[Confusion], proposals: Proposals) -> tuple[Confusion, ...]:
    """Return the `rows` of indistinguishable terms, with the rivals and the experiments that distinguish them."""
    described = {}
    for key, proposal in proposals.items():
        term, p = facts.find(key).term, facts.inclusion(key)
        says = f"{_describe_rival(term, p)} {sentence(name_other_recording(facts))} would decide."
        described[term.name, term.at] = Confusion(
            mechanism=term.name,
            at=term.at,
            probability=p,
            excitation=_make_excitation(facts, proposal) if proposal else None,
            says=_describe_proposal(facts, key, proposal) if proposal else says,
        )
    rest = (row for row in rows if (row.mechanism, row.at) not in described)
    return (*described.values(), *rest)


def _make_excitation(facts: Facts, proposal: Proposal) -> DecidingExcitation:
    e = proposal.excitation
    return DecidingExcitation(
        waveform=e.waveform,
        level=e.level,
        frequency=e.band[1],
        band=e.band,
        unit=facts.input_unit,
        expected_log_gain=proposal.gain,
        repeat_log_gain=proposal.repeat,
        if_found_is_true=proposal.ways[0],
        if_this_is_true=proposal.ways[1],
    )


def _describe_rival(term: Term, p: float) -> str:
    return f"{sentence(_name_term(term))} has a probability of {p:.2f} after this recording."


def _name_term(term: Term) -> str:
    return to_words(term.name)


def _describe_proposal(facts: Facts, key: str, proposal: Proposal) -> str:
    term = facts.find(key).term
    opening = _describe_rival(term, facts.inclusion(key))
    gain, repeat = proposal.gain, proposal.repeat
    if gain < facts.settings.experiment.least:
        return (
            f"{opening} No excitation within the limits is expected to distinguish them by more than"
            f" {max(gain, 0.0):.1f} in log evidence: measure this part of the machine separately."
        )
    against = (
        f"{rounded(gain / repeat)} times as much as a repetition" if repeat >= 1.0 else "a repetition by less than 1"
    )
    whose = ""
    if proposal.counted == (1,):
        whose = f" if it is {_name_term(term)} (if it is not, by {rounded(max(proposal.ways[0], 0.0))})"
    if proposal.counted == (0,):
        whose = f" if it is not {_name_term(term)} (if it is, by {rounded(max(proposal.ways[1], 0.0))})"
    return (
        f"{opening} {_describe_experiment(facts, proposal)}: this should distinguish them by"
        f" {rounded(gain)} in log evidence"
        f"{whose}, {against}."
    )


def _describe_experiment(facts: Facts, proposal: Proposal) -> str:
    """Return the experiment in the imperative."""
    e, old = proposal.excitation, facts.level
    change = e.level / old if old else 1.0
    verb = "Raise the drive to" if change > 1.05 else "Lower the drive to" if change < 0.95 else "Keep the drive at"
    low, high = (f"{rounded(f, 3)}" for f in e.band)
    shape = f"at {low} Hz" if low == high else f"and make it a {e.waveform} from {low} to {high} Hz"
    if e.waveform == "two tones":
        shape = f"and make it two tones, of {low} and {high} Hz"
    return f"{verb} {rounded(e.level, 3)} {facts.input_unit} {shape}"
