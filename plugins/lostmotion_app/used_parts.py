"""The parts of the first recording of a case that are used: one stretch, or several between gaps in its time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lostmotion.errors import DataError
from lostmotion.recording.load import recording_of
from lostmotion.recording.spec import RecordingSpec
from lostmotion.recording.table import Table
from lostmotion.recording.time_gaps import cut_at_gaps
from lostmotion.recording.timing import GapError
from lostmotion.settings import HeldOutSettings

STRETCH = ("t_start", "t_end")
"""The keys of a recording that say which part of it is used."""
Entry = dict[str, Any]


@dataclass(frozen=True)
class UsedPart:
    """A stretch of a recording that is used, and where in it the held-out part begins (s)."""

    start: float
    end: float
    held: float


def drop_stretch(entry: Mapping[str, Any]) -> Entry:
    """Return the entry of a recording without its stretch."""
    return {key: value for key, value in entry.items() if key not in STRETCH}


def part_entries(content: Mapping[str, Any]) -> tuple[list[Entry], list[Entry]]:
    """Return the entries of the first file of a case, of which there is one for each stretch, and those of others."""
    entries = content["recordings"]
    own = [one for one in entries if one["file"] == entries[0]["file"]]
    return own, [one for one in entries if one["file"] != entries[0]["file"]]


def list_used_parts(content: Mapping[str, Any], span: tuple[float, float], share: float) -> list[UsedPart]:
    """Return the parts of the first file that are used, in the order of their times, of a recording with a `span` (s).

    Of one recording the last `share` is held out, of several the last ones.
    """
    (own, others), parts = part_entries(content), list[UsedPart]()
    fitted = HeldOutSettings(share=share).count_fitted(len(own) + len(others))
    for number, entry in enumerate(own):
        start, end = (float(entry.get(key, limit)) for key, limit in zip(STRETCH, span, strict=True))
        held = end - share * (end - start) if len(own) + len(others) == 1 else start if number >= fitted else end
        parts.append(UsedPart(start, end, held))
    return sorted(parts, key=lambda one: one.start)


def cut_entry(entry: Mapping[str, Any], spec: RecordingSpec, table: Table) -> list[Entry]:
    """Return the entry of a recording, or one for each stretch that can be used where its time has gaps.

    `spec` is the recording that the entry describes, and may have other faults.
    """
    try:
        _read(spec, table)
    except GapError as gaps:
        keys = [one.keys for one in cut_at_gaps(gaps)]
        return [{**entry, **ends} for ends in keys if _can_be_read(cut_spec(spec, ends), table)] or [dict(entry)]
    except DataError:
        pass
    return [dict(entry)]


def cut_spec(spec: RecordingSpec, ends: Mapping[str, float]) -> RecordingSpec:
    """Return a recording with the ends of a stretch of it, where they are others."""
    return replace(spec, t_start=ends.get("t_start", spec.t_start), t_end=ends.get("t_end", spec.t_end))


def _read(spec: RecordingSpec, table: Table) -> None:
    recording_of(spec, table, Path(spec.file).name, "")


def _can_be_read(spec: RecordingSpec, table: Table) -> bool:
    try:
        _read(spec, table)
    except DataError:
        return False
    return True
