"""What a first case supposes: the sentences that stand in the answer, and the guesses that are too unlikely to go on.

A guess stands under `guessed` in the case file until a user removes it, and in each result of the case.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping

import numpy as np
from scipy.signal import coherence

from lostmotion.contracts import Array, Model
from lostmotion.errors import CaseError
from lostmotion.parts import Param
from lostmotion.quantities import SI, si_factor
from lostmotion.recording.outline import Outline, OutlinedColumn
from lostmotion.recording.units import RAW, strange_unit
from lostmotion.recording.value_checks import fill_lost
from lostmotion.signals.decay import decay_of

FALLEN = 0.7
"""The rms of the last quarter of a free decay is at most this share of that of the first quarter."""
COHERENT = 0.3
"""A column that may be the drive explains at least this share of the power of the response."""
SEGMENTS = 8
"""The number of parts of a recording over which a coherence is averaged."""
USUAL: Mapping[str, float] = {"force": 1e7, "position": 10.0, "velocity": 300.0, "acceleration": 1e5}
"""The largest values (SI) of a column whose unit is a guess: a larger one shows that the unit is another one."""


def check_guesses(outline: Outline, factors: Mapping[str, float], *, free: bool) -> None:
    """Raise `CaseError` for a guess that the data contradict; `free` tells that a user says that nothing drives.

    A response that does not decay is no free decay, and a column without a unit has no absurd values in the SI unit.
    """
    if outline.drive is None and not free:
        _check_decay(outline)
    for column in filter(None, (outline.drive, outline.response)):
        if column.name not in factors:
            _check_unit(column)
        _check_size(column, factors.get(column.name))


def _check_decay(outline: Outline) -> None:
    response = outline.response
    values = fill_lost(response.values)
    if falls(values, response.kind, outline.dt):
        return
    others = list(find_coherent(outline))
    beside = f"{' and '.join(_format_column(one) for one in others)} may drive it" if others else "nothing else moves"
    motor = "; for a motor write a case with the model dc_motor" if any(o.unit in ("V", "A") for o in others) else ""
    which = shlex.quote(others[0].name) if others else "COLUMN"
    raise CaseError(
        f"no column of {outline.file} is a force or a motion of the base, and {response.name} does not decay, so it is"
        f" no free decay ({beside}): run `lostmotion init` with --drive {which}, and its --unit and --factor, such as"
        f" newtons per volt, or with --drive none if nothing drives the machine{motor}"
    )


def falls(values: Array, kind: str, dt: float) -> bool:
    """Return whether readings (n,) of a kind, sampled every `dt` s, can be those of a free decay.

    A velocity ends at zero, other readings at any value. Their rms falls, or the amplitude of a mode does.
    """
    rest = 0.0 if kind == "velocity" else float(np.mean(values[-max(values.size // 10, 1) :]))
    first, *_, last = (float(np.sqrt(np.mean(part**2))) for part in np.array_split(values - rest, 4))
    return last <= FALLEN * first or decay_of(values, dt) is not None


def find_coherent(outline: Outline) -> Iterator[OutlinedColumn]:
    """Yield the columns that may drive the response: those that are no motion, and explain a share of its power."""
    seen = fill_lost(outline.response.values)
    for column in outline.columns:
        if column.moves and column.name != outline.response.name and column.kind in ("", "force"):
            pushed = fill_lost(column.values)
            if compute_coherent_share(pushed, seen) > COHERENT:
                yield column


def compute_coherent_share(pushed: Array, seen: Array) -> float:
    """Return the share of the power of a response (n,) that a linear response to a column (n,) can explain."""
    length = max(seen.size // SEGMENTS, 8)
    if seen.size < 2 * length or not np.ptp(seen) > 0.0 or not np.ptp(pushed) > 0.0:
        return 0.0
    moved = seen - seen.mean()
    shared = coherence(pushed - pushed.mean(), moved, nperseg=length)[1]
    power = np.abs(np.fft.rfft(moved * np.hanning(moved.size))) ** 2
    bins = np.minimum(np.arange(power.size) * (shared.size - 1) // max(power.size - 1, 1), shared.size - 1)
    return float(np.sum(np.nan_to_num(shared)[bins] * power) / np.sum(power))


def _check_unit(column: OutlinedColumn) -> None:
    """Raise `CaseError` for a column with a unit that is unknown, or that measures no quantity of a machine."""
    word = "" if column.sure else strange_unit(column.name) or (column.unit not in RAW and column.unit)
    if word:
        raise CaseError(
            f"{column.name} has the unit {word}, which is unknown or measures no {column.kind or 'quantity'} of a"
            f" machine: run `lostmotion init` with --unit {shlex.quote(column.name)}=UNIT, such as"
            f" {SI[column.kind or 'force']}"
        )


def _check_size(column: OutlinedColumn, factor: float | None) -> None:
    """Raise `CaseError` for a column whose unit is a guess and whose values are absurd in this unit."""
    if column.sure or not column.kind:
        return
    seen = column.values[np.isfinite(column.values)]
    scale = si_factor(column.stated_unit, column.kind)[0] * (1.0 if factor is None else factor)
    largest = float(np.max(np.abs(seen * scale), initial=0.0))
    if largest > USUAL[column.kind]:
        raise CaseError(
            f"{column.name} has values up to {largest:.3g}, and the file gives no unit of a {column.kind}: in"
            f" {column.stated_unit} that is not possible, run `lostmotion init` with --unit"
            f" {shlex.quote(column.name)}=UNIT"
        )


def list_guesses(outline: Outline, machine: Model, known: Mapping[str, tuple[float, str]]) -> Iterator[str]:
    """Yield a sentence for each guess of a first case; `known` are values of parameters with their reasons."""
    if outline.clock.guessed:
        yield f"{outline.time} is the time in s, since it alone grows evenly"
    if outline.drive is None:
        yield f"nothing drives the machine, and {outline.response.name} is its free decay"
    for column in filter(None, (outline.drive, outline.response)):
        if not column.sure:
            gives = f"has the unit {column.unit}" if column.unit else "has no unit"
            yield f"{column.name} {gives} and is taken for a {column.kind} in {column.stated_unit}"
    params: dict[str, Param] = {param.name: param for param in machine.params}
    for name, (value, why) in known.items():
        if params[name].scale == "log":
            yield f"{name} is {value:g}: {why}"


def _format_column(column: OutlinedColumn) -> str:
    return f"{column.name} ({column.unit})" if column.unit and column.unit not in column.name else column.name
