"""What several recordings share and what is each one's own, as `diagnosis.json` says it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from lostmotion.diagnosis.search import Diagnosed
from lostmotion.inference.natural import find_term
from lostmotion.inference.sharing import ComparedParameter, SharedValues, compare_recordings
from lostmotion.likelihood.problem import Problem
from lostmotion.quantities import unit_of
from lostmotion.report.words import chance, figures, sentence, to_words
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Mechanism
from lostmotion.results.sharing import (
    Comparison,
    FullComparison,
    OwnParameters,
    OwnValue,
    SharedParameter,
    Sharing,
)

UNNAMED = ("unknown", "random_force")
"""Entries of what no term explains: what differs from recording to recording may be all there is to it."""


def shared_in(d: Diagnosed, found: Sequence[Mechanism]) -> tuple[tuple[Mechanism, ...], Sharing | None]:
    """Return `found` with what recordings share of each term, and `sharing`; None where there is one recording.

    A term gets `by_recording` and `shared`; one that holds neither with one value nor with a power of the level gets a
    sentence more in `doubts`. Only recordings that were fitted are compared.
    """
    if d.shown is not d.held[0]:
        return tuple(found), None
    sharing = compare_recordings(d.after)
    if sharing is None:
        return tuple(found), _nothing(len(d.train) + len(d.held))
    problem = d.after.problem
    terms = dict(enumerate(d.named))
    told = [_with_sharing(entry, terms[i], problem, sharing) if i in terms else entry for i, entry in enumerate(found)]
    if sharing.released:
        doubt = _released(sharing, problem)
        told = [replace(e, doubts=(*e.doubts, doubt)) if e.mechanism in UNNAMED else e for e in told]
    return tuple(told), sharing_entry(sharing, problem)


def _nothing(many: int) -> Sharing:
    says = f"Of {many} recordings one was fitted and the rest is held out, so no values can be compared: record more."
    return Sharing(parameters={}, says=(says,))


def sharing_entry(sharing: SharedValues, problem: Problem) -> Sharing:
    """Return the content of `sharing`: recordings with their levels, each parameter in each of them, and sentences."""
    motion, levels = problem.system.model.motion, sharing.levels
    names = {key: name_of(key, problem) for key in sharing.parameters}
    sentences = {key: says(one, names, sharing) for key, one in sharing.parameters.items()}
    kept = [names[key] for key, one in sharing.parameters.items() if one.holds]
    opening = [f"One value holds in all {len(sharing.recordings)} recordings that were fitted: {', '.join(kept)}."]
    differ = [sentences[key] for key, one in sharing.parameters.items() if not one.holds]
    released = [_released(sharing, problem)] if sharing.released else []
    failed = [f"No fit came out with {name_of(key, problem)} of each recording's own." for key in sharing.failed]
    compared = {
        key: SharedParameter(_own_values(one, sharing), _shared(one, sentences[key], sharing))
        for key, one in sharing.parameters.items()
    }
    return Sharing(
        recordings=sharing.recordings,
        levels=levels.values,
        level_of=levels.of,
        level_unit=unit_of(levels.channel, motion),
        parameters=compared,
        says=(*(opening if kept else []), *differ, *failed, *released),
    )


def _own_values(one: ComparedParameter, sharing: SharedValues) -> tuple[OwnValue, ...]:
    rows = zip(sharing.recordings, sharing.levels.values, one.values, strict=True)
    return tuple(OwnValue(name, level, v.median, v.low, v.high, v.unit) for name, level, v in rows)


def _released(sharing: SharedValues, problem: Problem) -> str:
    """Return what values of each recording's own are worth, and whether a learned curve is needed beside them."""
    others = " and ".join(name_of(key, problem) for key in sharing.released)
    curve = ", and no learned curve is needed beside them" if sharing.dropped else ""
    return f"Values of each recording's own for {others} raise the log evidence by {figures(sharing.gain)}{curve}."


def _shared(one: ComparedParameter, said: str, sharing: SharedValues) -> FullComparison:
    odd = None if one.odd is None else sharing.recordings[one.odd]
    return FullComparison(one.holds, one.p, said, one.power, odd)


def _with_sharing(entry: Mechanism, key: str, problem: Problem, sharing: SharedValues) -> Mechanism:
    """Return the entry of a term with what recordings share of it; as it is where none of its values was compared."""
    slots = {s.key: s.param.name for s in find_term(problem, key)[1] if s.key in sharing.parameters}
    if not slots:
        return entry
    own = {slot: sharing.parameters[slot] for slot in slots}
    names = {slot: name_of(slot, problem) for slot in sharing.parameters}
    by_recording = tuple(
        OwnParameters(name, sharing.levels.values[i], {slots[slot]: one.values[i] for slot, one in own.items()})
        for i, name in enumerate(sharing.recordings)
    )
    worst = min(own.values(), key=lambda one: one.p)
    told = [says(one, names, sharing) for one in own.values() if not one.holds] or [says(worst, names, sharing)]
    doubts = [says(one, names, sharing) for one in own.values() if not one.told]
    doubts += [_moved(one, entry.parameters[slots[slot]], names, sharing) for slot, one in own.items()]
    shared = Comparison(worst.holds, worst.p, " ".join(told))
    every = (*entry.doubts, *(doubt for doubt in doubts if doubt))
    return replace(entry, doubts=every, by_recording=by_recording, shared=shared)


def _moved(one: ComparedParameter, before: Interval, names: Mapping[str, str], sharing: SharedValues) -> str:
    """Return that a value which holds is another one once what differs is released; empty where it is not."""
    if math.isnan(before.low):
        return ""
    apart = before.low > one.common.high or before.high < one.common.low
    if not (one.holds and sharing.released and apart):
        return ""
    others = " and ".join(names[key] for key in sharing.released)
    return (
        f"{sentence(names[one.key])} is {one.common} where {others} may differ from recording to recording, and"
        f" {figures(before.median)} where not."
    )


def name_of(key: str, problem: Problem) -> str:
    """Return a parameter as people say it: `c`, or `force of Coulomb friction` for a parameter of a term."""
    term, _, own = key.rpartition(".")
    if not term:
        return key
    law = find_term(problem, term)[0]
    place = f" at the place {law.at!r}" if "@" in term else ""
    return f"{to_words(own)} of {to_words(law.name)}{place}"


def says(one: ComparedParameter, names: Mapping[str, str], sharing: SharedValues) -> str:
    """Return what is said of one parameter: that one value holds, or how values differ."""
    name, many = sentence(names[one.key]) if "." in one.key else one.key, len(sharing.recordings)
    if one.holds:
        return f"{name} holds with one value in all {many} recordings ({chance(one.p)})."
    return f"{_difference(one, name, sharing)}.{_rivals(one, names)}"


def _difference(one: ComparedParameter, name: str, sharing: SharedValues) -> str:
    medians = [value.median for value in one.values]
    low, high = (one.values[medians.index(end)] for end in (min(medians), max(medians)))
    if one.power is not None:
        exponent = f"{figures(one.power.exponent)} +- {figures(one.power.error, 1)}"
        return (
            f"{name} goes with the level of the {sharing.levels.of}, to the power {exponent}: from {_short(low)} to"
            f" {_short(high)} ({chance(one.p)} for one value)"
        )
    if one.odd is not None:
        rest = [value for i, value in enumerate(one.values) if i != one.odd]
        ends = sorted(rest, key=lambda value: value.median)
        return (
            f"{name} is {_short(one.values[one.odd])} in {sharing.recordings[one.odd]} and {figures(ends[0].median)} to"
            f" {_short(ends[-1])} in the others ({chance(one.p)} for one value)"
        )
    where = [sharing.recordings[medians.index(value.median)] for value in (low, high)]
    level = "" if len(medians) < 3 else f", and does not go with the level of the {sharing.levels.of}"
    return (
        f"{name} differs from recording to recording, from {_short(low)} ({where[0]}) to {_short(high)} ({where[1]};"
        f" {chance(one.p)} for one value){level}"
    )


def _rivals(one: ComparedParameter, names: Mapping[str, str]) -> str:
    if not one.instead:
        return ""
    others = " or ".join(names[key] for key in one.instead)
    return f" Values of each recording's own for {others} explain as much."


def _short(value: Interval) -> str:
    unit = "" if value.unit == "1" else f" {value.unit}"
    return f"{figures(value.median)}{unit}"
