"""Changes of a case that may remove a warning about a recording: other units, another sign, a sound stretch."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.quantities import si_factor, spell_unit
from lostmotion.recording.clock import read_time
from lostmotion.recording.spec import Channel, RecordingSpec
from lostmotion.recording.table import Table
from lostmotion.recording.time_gaps import describe_ends
from lostmotion.recording.units import is_unit
from lostmotion.recording.value_checks import LARGEST, runs_of
from lostmotion.recording.warnings import BACKWARD, list_far, list_frozen
from lostmotion.settings import DEFAULT, RecordingSettings
from lostmotion_app.case_content import Content, list_channels
from lostmotion_app.used_parts import cut_entry

Array = NDArray[np.float64]
Change = Callable[[Content], None]
"""What changes the content of a case, in place."""
KEPT = 0.5
"""The least share of a recording that is left after a cut."""
OTHER_ANGLE: Mapping[str, str] = {"rad": "deg", "deg": "rad", "rad/s": "deg/s", "deg/s": "rad/s"}


def list_changes(number: int, spec: RecordingSpec, table: Table, notes: Sequence[str]) -> Iterator[tuple[str, Change]]:
    """Yield changes of the recording with a `number` in a case, each with its words; `notes` are its warnings."""
    signs = any(note.startswith(BACKWARD) for note in notes)
    for channel in (*spec.inputs, *spec.sensors):
        other_sign = [("other sign", {"factor": -channel.factor})] if signs else []
        for says, entries in (*_list_units(channel, table), *other_sign):
            yield f"{channel.column}: {says}", _make_channel_change(channel.column, entries)
    if len(parts := cut_entry({}, spec, table)) > 1:
        yield f"Cut it at its gaps into {len(parts)} recordings", _make_cut(number, parts)
    for stretch in filter(None, (parts[0], find_sound_stretch(spec, table))):
        yield f"Use it {describe_ends(stretch)}", _make_cut(number, [stretch])


def _list_units(channel: Channel, table: Table) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield other units of a channel: that in the header of its file, and the other one of an angle.

    Where the header states the unit of the case, a factor corrects both.
    """
    stated = spell_unit(table.units.get(channel.column) or "")
    if is_unit(stated) and stated != spell_unit(channel.unit) and _has_same_dimension(stated, channel):
        yield f"unit {stated}", {"unit": stated}
    other = OTHER_ANGLE.get(channel.unit, "")
    if other and stated == channel.unit:
        ratio = si_factor(other, channel.quantity)[0] / si_factor(stated, channel.quantity)[0]
        yield f"numbers in {other}", {"factor": float(f"{channel.factor * ratio:.12g}")}
    elif other and other != stated:
        yield f"unit {other}", {"unit": other}


def _make_cut(number: int, parts: Sequence[Mapping[str, Any]]) -> Change:
    """Return a change that puts a recording for each stretch, given by its ends, in the place of one."""

    def change(content: Content) -> None:
        whole = content["recordings"][number]
        entries = [{**whole, **keys} for keys in parts]
        if "name" in whole and len(entries) > 1:
            entries = [{**one, "name": f"{whole['name']} {k}"} for k, one in enumerate(entries, 1)]
        content["recordings"][number : number + 1] = entries

    return change


def _has_same_dimension(unit: str, channel: Channel) -> bool:
    try:
        return si_factor(unit, channel.quantity)[1] == si_factor(channel.unit, channel.quantity)[1]
    except DataError:
        return False


def _make_channel_change(column: str, entries: Mapping[str, Any]) -> Change:
    """Return a change of a column in all recordings: those of one case have the same columns."""

    def change(content: Content) -> None:
        for channel in list_channels(content, column):
            channel.update(entries)
            if channel.get("factor") == 1.0:
                del channel["factor"]

    return change


def find_sound_stretch(
    spec: RecordingSpec, table: Table, limits: RecordingSettings = DEFAULT.recording
) -> dict[str, float]:
    """Return where (s) to cut a recording, by the keys of a case, so that its longest stretch without faults is left.

    Empty where nothing is faulty, or too little would be left.
    """
    time = _read_times(spec, table)
    if time is None:
        return {}
    low = -np.inf if spec.t_start is None else spec.t_start
    high = np.inf if spec.t_end is None else spec.t_end
    inside = (time >= low) & (time <= high)
    faulty = np.zeros(time.size, dtype=bool)
    for channel in spec.inputs:
        values = table.columns[channel.column]
        faulty |= np.isnan(values) | mark_faulty(values, limits)
    for channel in spec.sensors:
        faulty |= mark_faulty(table.columns[channel.column], limits)
    runs = runs_of(inside & ~faulty)
    if not (faulty & inside).any() or not runs.size:
        return {}
    first, last = max(runs.tolist(), key=lambda run: run[1] - run[0])
    if last - first < KEPT * np.count_nonzero(inside):
        return {}
    start = {"t_start": float(time[first])} if inside[:first].any() else {}
    end = {"t_end": float(time[last - 1])} if inside[last:].any() else {}
    return start | end


def _read_times(spec: RecordingSpec, table: Table) -> Array | None:
    """Return the times (n,) of the rows in s; None where the columns differ in length or the time cannot be read."""
    sizes = {table.columns[channel.column].size for channel in (*spec.inputs, *spec.sensors)}
    try:
        time = np.arange(max(sizes)) / spec.rate if spec.rate else read_time(
            table, str(spec.time), spec.time_unit, spec.file
        )[0]  # fmt: skip
    except DataError:
        return None
    return np.asarray(time) if sizes == {time.size} else None


def mark_faulty(values: Array, limits: RecordingSettings) -> NDArray[np.bool_]:
    """Return which samples (n,) are no readings: absurd values, values far from all others, long runs of one value."""
    seen = np.isfinite(values) & (np.abs(values) <= LARGEST)
    faulty = ~seen & ~np.isnan(values)
    if seen.any():
        for far in list_far(values[seen], limits):
            faulty |= values == far
    with np.errstate(invalid="ignore"):
        for first, last in list_frozen(values, limits):
            faulty[first:last] = True
    return faulty
