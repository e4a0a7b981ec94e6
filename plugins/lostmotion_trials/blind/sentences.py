"""What a blind trial says in sentences."""

from __future__ import annotations

from collections.abc import Iterator

from lostmotion.results import percent
from lostmotion_trials.blind.results import ProofSummary, Rate

FEW = 40
"""With fewer cases the bands are wider than any target."""


def says_of(told: ProofSummary) -> list[str]:
    """Return the sentences that a report opens with."""
    first = _of_sure(told) if told.sure else (_opening(told), _alarms(told))
    return [part for part in (*first, *_rest(told)) if part]


def _of_sure(told: ProofSummary) -> Iterator[str]:
    """Yield what is said of an imperfect world, where no model is true."""
    every, clean = told.sure[0], told.alarms[0].rate
    some = every.rate.of
    yield _share("name that was", "names that were", every.rate) if some else "No name was stated with more than 0.95."
    named, worse = every.named, every.worse
    if named.of:
        yield f"The hidden effect was named so on {named.hits} of {named.of} machines that hide one."
    if clean.of:
        yield f"On {clean.hits} of {clean.of} machines that hide nothing a name was stated so that is not there."
    if worse.of:
        yield f"The held-out error rose by what was found on {worse.hits} of {worse.of} machines."


def _share(one: str, many: str, row: Rate) -> str:
    whose, verb = one if row.of == 1 else many, "is" if row.hits == 1 else "are"
    share, low, high = (f"{100.0 * x:.0f}" for x in (row.share, row.low, row.high))
    return (
        f"Of {row.of} {whose} stated with more than 0.95, {row.hits} {verb} there"
        f" ({share} %, 95 % band {low} to {high} %)."
    )


def _opening(told: ProofSummary) -> str:
    if not told.effects:
        return f"Nothing was hidden in {told.cases} machines."
    strong, weak = told.targets[0].rate, told.targets[1].rate
    named = sum(row.counts.rate.hits for row in told.mechanisms)
    tiers = [(strong, "that gain more than 50 in log-likelihood"), (weak, "that gain 15 to 50")]
    more = [f"{row.hits} of {row.of} {words}" for row, words in tiers if row.of]
    listed = f": {', '.join(more)}" if more else ""
    return f"Of {told.effects} hidden effects {named} were named{listed}."


def _alarms(told: ProofSummary) -> str:
    every = told.alarms[0].rate
    return f"{every.hits} of {every.of} clean cases raised a false alarm." if every.of else ""


def _rest(told: ProofSummary) -> Iterator[str]:
    covered, held = told.coverage[0].rate, told.heldout
    if covered.of:
        yield f"The 95 % intervals hold {covered.hits} of {covered.of} true parameters."
    if held.shares:
        yield f"On held-out data {percent(held.median_share)} of what the true model would win was won (median)."
    if told.failed:
        yield f"{len(told.failed)} cases could not be diagnosed: they are listed, and count as missed."
    if told.unmeasured:
        yield f"Of {len(told.unmeasured)} cases the true model could not be fitted."
    if told.cases < FEW:
        yield f"With {told.cases} cases no target can be decided: take 200."
