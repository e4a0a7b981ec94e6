"""The entries of `found`: mechanisms with their parameters, and the force that no mechanism explains."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from lostmotion.contracts import SensorTerm
from lostmotion.diagnosis.facts import Facts, FoundTerm
from lostmotion.diagnosis.states import OPEN, choose_state, compute_probability, explain_withheld, list_doubts
from lostmotion.results import Interval, attach_unit, percent, rounded
from lostmotion.results.diagnosis import Mechanism


def list_findings(facts: Facts) -> tuple[Mechanism, ...]:
    """Return the entries of `found`: terms, quantisation of the stored values, and what no term explains."""
    entries, why = [*(_make_entry(facts, one) for one in facts.found), *facts.quantised], explain_withheld(facts)
    if facts.unnamed is not None:
        random = facts.unexplained and not (facts.augmented and facts.structured)
        if facts.learned or random:
            entries.append(facts.unnamed)
        elif why and not facts.augmented:
            entries.append(replace(facts.unnamed, probability=1.0, says=why))
    return tuple(replace(entry, parameters=withhold_intervals(entry.parameters, why)) for entry in entries)


def withhold_intervals(parameters: Mapping[str, Interval], why: str) -> Mapping[str, Interval]:
    """Return parameters for the result; with a reason `why`, the bounds of their intervals are NaN."""
    if not why:
        return parameters
    return {name: replace(one, low=math.nan, high=math.nan, withheld=why) for name, one in parameters.items()}


def _make_entry(facts: Facts, found: FoundTerm) -> Mechanism:
    term, why, p = found.term, explain_withheld(facts), compute_probability(facts, found)
    doubts = (*list_doubts(facts, found), *([why] if why else []))
    size = "" if isinstance(term, SensorTerm) else f", up to {percent(found.share)} of {facts.drive.of}"
    since = f", since {found.since}" if found.since else ""
    state = choose_state(facts, doubts)
    return Mechanism(
        mechanism=term.name,
        at=term.at,
        probability=min(p, facts.settings.name.simplest) if state == OPEN else p,
        state=state,
        doubts=doubts,
        parameters=found.parameters,
        share_of_drive=found.share,
        since=found.since,
        says=f"{_describe_law(facts, found, bare=bool(why))}{since}{size}.",
    )


def _describe_law(facts: Facts, found: FoundTerm, *, bare: bool) -> str:
    """Return the sentence of a term with its numbers; `bare` ones have no intervals, because these are withheld."""
    term, parameters = found.term, found.parameters
    shown = {name: i.with_angles_in(facts.angle) for name, i in parameters.items()}
    numbers = {name: attach_unit(rounded(i.median, 3), i.unit) if bare else str(i) for name, i in shown.items()}
    words = {
        q.name: q.prior.words[q.prior.choices.index(parameters[q.name].median)] for q in term.params if q.prior.words
    }
    turned, phase = dict.fromkeys(found.unlocated or (), "an unknown part"), ""
    if found.unlocated is not None:
        derived = term.derived(tuple(parameters[q.name].median for q in term.params))
        sizes = [f"{q.meaning}: {numbers[q.name]}; " for q in list(derived)[:1]]
        phase = f" ({''.join(sizes)}the phase is unknown, because no sensor shows the position)"
    sensor = f" (sensor {found.sensor!r})" if found.sensor else ""
    place = f" at the place {found.place!r}" if found.place else ""
    return f"{term.physics.format(**(numbers | words | turned))}{sensor}{place}{phase}"
