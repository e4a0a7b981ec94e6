"""The sentences of a blind trial."""

from __future__ import annotations

from collections.abc import Iterator

from lostmotion.results import percent
from lostmotion_trials.blind.results import ProofSummary
from lostmotion_trials.rates import Rate

FEW_CASES = 40
"""With fewer cases the 95 % bands are wider than any target."""


def write_sentences(summary: ProofSummary) -> list[str]:
    """Return the sentences that a report opens with."""
    first = _describe_sure(summary) if summary.sure else (_describe_effects(summary), _describe_alarms(summary))
    return [part for part in (*first, *_describe_rest(summary)) if part]


def _describe_sure(summary: ProofSummary) -> Iterator[str]:
    """Yield the sentences on machines of an imperfect world, where no model is exactly true."""
    every, clean = summary.sure[0], summary.alarms[0].rate
    if every.rate.of:
        yield _describe_share("name that was", "names that were", every.rate)
    else:
        yield "No mechanism was named with more than 0.95."
    named, worse = every.named, every.worse
    if named.of:
        yield f"The hidden effect was named with more than 0.95 on {named.hits} of {named.of} machines that hide one."
    if clean.of:
        yield (
            f"An absent mechanism was named with more than 0.95 on {clean.hits} of {clean.of} machines that hide"
            " nothing."
        )
    if worse.of:
        yield f"The named mechanisms increased the held-out error on {worse.hits} of {worse.of} machines."


def _describe_share(one: str, many: str, row: Rate) -> str:
    """Return the sentence on the share of sure names that are correct."""
    whose, verb = one if row.of == 1 else many, "is" if row.hits == 1 else "are"
    share, low, high = (f"{100.0 * x:.0f}" for x in (row.share, row.low, row.high))
    return (
        f"Of {row.of} {whose} stated with more than 0.95, {row.hits} {verb} correct"
        f" ({share} %, 95 % band {low} to {high} %)."
    )


def _describe_effects(summary: ProofSummary) -> str:
    if not summary.effects:
        return f"Nothing was hidden in {summary.cases} machines."
    strong, weak = summary.targets[0].rate, summary.targets[1].rate
    named = sum(row.counts.rate.hits for row in summary.mechanisms)
    tiers = [(strong, "that gain more than 50 in log-likelihood"), (weak, "that gain 15 to 50")]
    more = [f"{row.hits} of {row.of} {words}" for row, words in tiers if row.of]
    listed = f": {', '.join(more)}" if more else ""
    return f"Of {summary.effects} hidden effects {named} were named{listed}."


def _describe_alarms(summary: ProofSummary) -> str:
    every = summary.alarms[0].rate
    return f"{every.hits} of {every.of} clean cases raised a false alarm." if every.of else ""


def _describe_rest(summary: ProofSummary) -> Iterator[str]:
    covered, held = summary.coverage[0].rate, summary.heldout
    if covered.of:
        yield f"The 95 % intervals hold {covered.hits} of {covered.of} true parameters."
    if held.shares:
        yield (
            f"On held-out data the found model reaches {percent(held.median_share)} of the"
            " improvement of the true model"
            " (median)."
        )
    if summary.failed:
        yield f"{len(summary.failed)} cases could not be diagnosed: they are listed, and count as missed."
    if summary.unmeasured:
        yield f"In {len(summary.unmeasured)} cases the true model could not be fitted."
    if summary.cases < FEW_CASES:
        yield f"With {summary.cases} cases no target can be decided: use 200."
