"""The comparison of parameters between several recordings, as `diagnosis.json` states it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from lostmotion.diagnosis.stages import SearchResult
from lostmotion.inference.natural import find_term
from lostmotion.inference.sharing import ComparedParameter, SharedValues, compare_recordings
from lostmotion.likelihood.posterior import Posterior
from lostmotion.quantities import unit_of
from lostmotion.report.words import chance, figures, sentence, to_words
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Mechanism
from lostmotion.results.shared_values import (
    Comparison,
    FullComparison,
    OwnParameters,
    OwnValue,
    SharedParameter,
    Sharing,
)

UNNAMED = ("unknown", "random_force")
"""Entries of forces that no term explains: differences between recordings may be their cause."""


def add_sharing(d: SearchResult, found: Sequence[Mechanism]) -> tuple[tuple[Mechanism, ...], Sharing | None]:
    """Return `found` with the comparison of each term between recordings, and `sharing`; None for a single recording.

    A term gets `by_recording` and `shared`. If its values are neither equal nor a power of the level, it gets a
    warning in `doubts`. Only fitted recordings are compared.
    """
    if d.shown is not d.held[0]:
        return tuple(found), None
    sharing = compare_recordings(d.after)
    if sharing is None:
        return tuple(found), _describe_single(len(d.train) + len(d.held))
    posterior = d.after.posterior
    terms = dict(enumerate(d.named))
    entries = [
        _extend_entry(entry, terms[i], posterior, sharing) if i in terms else entry for i, entry in enumerate(found)
    ]
    if sharing.released:
        doubt = _describe_released(sharing, posterior)
        entries = [replace(e, doubts=(*e.doubts, doubt)) if e.mechanism in UNNAMED else e for e in entries]
    return tuple(entries), make_sharing_entry(sharing, posterior)


def _describe_single(many: int) -> Sharing:
    says = f"One of {many} recordings was fitted and the rest is held out, so no values can be compared: record more."
    return Sharing(parameters={}, says=(says,))


def make_sharing_entry(sharing: SharedValues, posterior: Posterior) -> Sharing:
    """Return the content of `sharing`: recordings with their levels, each parameter in each of them, and sentences."""
    motion, levels = posterior.system.model.motion, sharing.levels
    names = {key: name_parameter(key, posterior) for key in sharing.parameters}
    sentences = {key: describe_parameter(one, names, sharing) for key, one in sharing.parameters.items()}
    kept = [names[key] for key, one in sharing.parameters.items() if one.holds]
    opening = [f"Equal in all {len(sharing.recordings)} fitted recordings: {', '.join(kept)}."]
    differ = [sentences[key] for key, one in sharing.parameters.items() if not one.holds]
    released = [_describe_released(sharing, posterior)] if sharing.released else []
    failed = [f"The fit with a {name_parameter(key, posterior)} per recording failed." for key in sharing.failed]
    compared = {
        key: SharedParameter(_list_own_values(one, sharing), _make_comparison(one, sentences[key], sharing))
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


def _list_own_values(one: ComparedParameter, sharing: SharedValues) -> tuple[OwnValue, ...]:
    rows = zip(sharing.recordings, sharing.levels.values, one.values, strict=True)
    return tuple(OwnValue(name, level, v.median, v.low, v.high, v.unit) for name, level, v in rows)


def _describe_released(sharing: SharedValues, posterior: Posterior) -> str:
    """Return the gain in log evidence of one value per recording, and whether a learned curve is still needed."""
    others = " and ".join(name_parameter(key, posterior) for key in sharing.released)
    curve = ", and no learned curve is needed in addition" if sharing.dropped else ""
    return f"One value of {others} per recording raises the log evidence by {figures(sharing.gain)}{curve}."


def _make_comparison(one: ComparedParameter, said: str, sharing: SharedValues) -> FullComparison:
    odd = None if one.odd is None else sharing.recordings[one.odd]
    return FullComparison(one.holds, one.p, said, one.power, odd)


def _extend_entry(entry: Mechanism, key: str, posterior: Posterior, sharing: SharedValues) -> Mechanism:
    """Return the entry of a term with the comparison between recordings; unchanged if no value was compared."""
    slots = {s.key: s.param.name for s in find_term(posterior, key)[1] if s.key in sharing.parameters}
    if not slots:
        return entry
    own = {slot: sharing.parameters[slot] for slot in slots}
    names = {slot: name_parameter(slot, posterior) for slot in sharing.parameters}
    by_recording = tuple(
        OwnParameters(name, sharing.levels.values[i], {slots[slot]: one.values[i] for slot, one in own.items()})
        for i, name in enumerate(sharing.recordings)
    )
    worst = min(own.values(), key=lambda one: one.p)
    sentences = [describe_parameter(one, names, sharing) for one in own.values() if not one.holds] or [
        describe_parameter(worst, names, sharing)
    ]
    doubts = [describe_parameter(one, names, sharing) for one in own.values() if not one.told]
    doubts += [_warn_of_moved_value(one, entry.parameters[slots[slot]], names, sharing) for slot, one in own.items()]
    shared = Comparison(worst.holds, worst.p, " ".join(sentences))
    every = (*entry.doubts, *(doubt for doubt in doubts if doubt))
    return replace(entry, doubts=every, by_recording=by_recording, shared=shared)


def _warn_of_moved_value(
    one: ComparedParameter, before: Interval, names: Mapping[str, str], sharing: SharedValues
) -> str:
    """Return a warning if a common value changes when parameters that differ are released; else an empty string."""
    if math.isnan(before.low):
        return ""
    apart = before.low > one.common.high or before.high < one.common.low
    if not (one.holds and sharing.released and apart):
        return ""
    others = " and ".join(names[key] for key in sharing.released)
    return (
        f"{sentence(names[one.key])} is {one.common} if {others} may differ between recordings, and"
        f" {figures(before.median)} if not."
    )


def name_parameter(key: str, posterior: Posterior) -> str:
    """Return a parameter in words: `c`, or `force of Coulomb friction` for a parameter of a term."""
    term, _, own = key.rpartition(".")
    if not term:
        return key
    law = find_term(posterior, term)[0]
    place = f" at the place {law.at!r}" if "@" in term else ""
    return f"{to_words(own)} of {to_words(law.name)}{place}"


def describe_parameter(one: ComparedParameter, names: Mapping[str, str], sharing: SharedValues) -> str:
    """Return a sentence on one parameter: that its values are equal, or how they differ."""
    name, many = sentence(names[one.key]) if "." in one.key else one.key, len(sharing.recordings)
    if one.holds:
        return f"{name} has the same value in all {many} recordings ({chance(one.p)})."
    return f"{_describe_difference(one, name, sharing)}.{_describe_alternatives(one, names)}"


def _describe_difference(one: ComparedParameter, name: str, sharing: SharedValues) -> str:
    medians = [value.median for value in one.values]
    low, high = (one.values[medians.index(end)] for end in (min(medians), max(medians)))
    if one.power is not None:
        exponent = f"{figures(one.power.exponent)} +- {figures(one.power.error, 1)}"
        return (
            f"{name} is proportional to a power of the level of the {sharing.levels.of}, with the exponent {exponent}:"
            f" from {_format_value(low)} to {_format_value(high)} ({chance(one.p)} for a common value)"
        )
    if one.odd is not None:
        rest = [value for i, value in enumerate(one.values) if i != one.odd]
        ends = sorted(rest, key=lambda value: value.median)
        return (
            f"{name} is {_format_value(one.values[one.odd])} in {sharing.recordings[one.odd]} and"
            f" {figures(ends[0].median)} to {_format_value(ends[-1])} in the others ({chance(one.p)} for a common"
            " value)"
        )
    where = [sharing.recordings[medians.index(value.median)] for value in (low, high)]
    level = "" if len(medians) < 3 else f", independently of the level of the {sharing.levels.of}"
    return (
        f"{name} differs between recordings, from {_format_value(low)} ({where[0]}) to {_format_value(high)}"
        f" ({where[1]}; {chance(one.p)} for a common value){level}"
    )


def _describe_alternatives(one: ComparedParameter, names: Mapping[str, str]) -> str:
    if not one.instead:
        return ""
    others = " or ".join(names[key] for key in one.instead)
    return f" One value of {others} per recording explains as much."


def _format_value(value: Interval) -> str:
    unit = "" if value.unit == "1" else f" {value.unit}"
    return f"{figures(value.median)}{unit}"
