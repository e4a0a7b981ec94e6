"""Headers of instruments that no general rule finds: settings beside the readings, or in a block above them.

Each function returns the header of the files of one program, or None. Their forms are those of files of these programs:
Tektronix TDS, Keysight Infiniium, Rigol, Yokogawa (DL and DLM, and exports of WDF and WVF files), and Beckhoff TwinCAT
Scope.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from lostmotion.errors import DataError
from lostmotion.recording.cells import Columns, Header, Line, cells_of, is_filled, is_number, is_value, keep_units
from lostmotion.recording.numbers import read_number

TOP = 50
"""The most lines in which the settings are searched."""
TIME = "time"
_SINCE_1601 = 1e17
"""Times above this number are steps of 100 ns since 1601."""
_START = re.compile(r"\s*t0\s*=\s*(\S+)\s*")
_INCREMENT = re.compile(r"\s*tinc\s*=\s*(\S+)\s*", re.IGNORECASE)
_UNITY = {"ScaleFactor": 1.0, "Offset": 0.0, "Unit ScaleFactor": 1.0, "Unit Offset": 0.0}
"""Settings of a channel of TwinCAT that leave its numbers as they are."""


def read_instrument(rows: list[Line]) -> Header | None:
    """Return the header of a file of one of these programs, None for any other file."""
    readers: tuple[Callable[[list[Line]], Header | None], ...] = (
        _read_beside, _read_waveform, _read_rigol, _read_increments, _read_yokogawa, _read_twincat,
    )  # fmt: skip
    return next(filter(None, (reader(rows) for reader in readers)), None)


def _read_beside(rows: list[Line]) -> Header | None:
    """Return the header of a table of Tektronix, whose settings stand in the first rows, beside time and readings."""
    cells = [cells_of(line, ",") for _, line in rows[:TOP]]
    if not all(len(row) >= 5 and is_filled(row[3]) and is_filled(row[4]) for row in cells) or not cells[0][0]:
        return None
    stated = {row[0].strip().lower(): row[1].strip() for row in cells}
    if "record length" not in stated:
        return None
    names, units = [""] * len(cells[0]), {TIME: stated.get("horizontal units", "")}
    blocks = [j for j, cell in enumerate(cells[0][:-4]) if cell.strip().lower() == "record length"]
    for begin in blocks:  # for each channel: two columns of settings, an empty one, time and reading
        own = {row[begin].strip().lower(): row[begin + 1].strip() for row in cells if len(row) > begin + 1}
        name = own.get("source") or f"reading {blocks.index(begin) + 1}"
        names[begin + 3 : begin + 5] = ["" if begin else TIME, name]
        units[name] = own.get("vertical units", "")
    return Header(names, keep_units(units), ",", rows[0][0] + 1)


def _read_waveform(rows: list[Line]) -> Header | None:
    """Return the header of a waveform of Keysight: settings, a line `Data:` without names, then time and reading."""
    split = [cells_of(line, ",") for _, line in rows[: TOP + 1]]
    end = next((k for k, cells in enumerate(split[:TOP]) if cells and cells[0].strip() == "Data:"), None)
    if end is None or end + 1 >= len(rows) or not all(is_number(cell) for cell in split[end + 1]):
        return None
    stated = {cells[0].strip(" :").lower(): cells[1].strip() for cells in split[:end] if len(cells) > 1}
    names = [TIME, "reading", *(f"reading {k}" for k in range(2, len(split[end + 1])))][: len(split[end + 1])]
    units = {TIME: stated.get("x units", ""), **dict.fromkeys(names[1:], stated.get("y units", ""))}
    return Header(names, keep_units(units), ",", rows[end + 1][0] + 1)


def _read_increments(rows: list[Line]) -> Header | None:
    """Return the header of a scope of Rigol, whose first row has start and increment of the time beside the names."""
    if len(rows) < 3:
        return None
    names, below = ([cell.strip() for cell in cells_of(line.rstrip(", \r\n"), ",")] for _, line in rows[:2])
    lower = [name.lower() for name in names]
    if not {"start", "increment"} <= set(lower) or len(below) < len(lower) or lower[0] not in ("x", "time", "sequence"):
        return None
    start, step = (read_number(below[lower.index(name)]) for name in ("start", "increment"))
    if start is None or step is None or not step > 0.0:
        return None
    kept = ["" if name in ("start", "increment") else given for name, given in zip(lower, names, strict=True)]
    kept[0] = TIME
    spelt = [unit.title() if unit in ("VOLT", "AMP") else unit for unit in below]
    units = keep_units({TIME: "s"} | dict(zip(kept[1:], spelt[1:], strict=False)))
    columns = len(kept) - (not kept[-1])
    finish = partial(_put_on_grid, start, step)
    return Header(kept[:columns], units, ",", rows[2][0] + 1, trailing=columns < len(kept), finish=finish)


def _put_on_grid(start: float, step: float, found: Columns, units: dict[str, str], refused: dict[str, str]) -> None:
    """Write the times of samples (s) in place of their numbers, or add them where they have none."""
    size = next((column.size for column in found.values()), 0)
    found[TIME], units[TIME] = start + step * found.get(TIME, np.arange(size, dtype=float)), "s"


def _read_rigol(rows: list[Line]) -> Header | None:
    """Return the header `CH1V,CH2V,t0 = -1.0,tInc = 0.01` of a scope of Rigol without a column of the time."""
    names = [cell.strip() for cell in cells_of(rows[0][1], ",")]
    start, step = (next(filter(None, map(form.fullmatch, names)), None) for form in (_START, _INCREMENT))
    if start is None or step is None or len(rows) < 2 or not (read_number(step[1]) or 0.0) > 0.0:
        return None
    kept = [re.sub(r"\(?V\)?$", "", name) for name in names if "=" not in name]
    if any(name.lower().startswith("time") for name in names):
        return None
    width = len(cells_of(rows[1][1], ","))
    finish = partial(_put_on_grid, read_number(start[1]) or 0.0, read_number(step[1]) or 0.0)
    header = Header(kept + [""] * (width - len(kept)), dict.fromkeys(kept, "V"), ",", rows[1][0] + 1, finish=finish)
    return header if kept and width >= len(kept) else None


def _read_yokogawa(rows: list[Line]) -> Header | None:
    """Return the header of a file of Yokogawa: a line for each setting, with one cell for each channel, then rows."""
    separator = next((sign for sign in (",", "\t", ";") if sign in rows[0][1]), ",")
    split = [[cell.strip() for cell in cells_of(line, separator)] for _, line in rows[:TOP]]
    stated = {cells[0].lower(): [cell for cell in cells[1:] if cell] for cells in split if cells and cells[0]}
    names, steps = stated.get("tracename", []), [read_number(cell) for cell in stated.get("hresolution", [])]
    last = next((k for k, cells in enumerate(split) if cells[0].lower() == "hresolution"), len(split))
    first = next((k for k in range(last, len(split)) if _is_row(split[k], len(names))), None)
    if not names or len(steps) != len(names) or first is None or not all(step and step > 0.0 for step in steps):
        return None
    starts = [read_number(cell) or 0.0 for cell in stated.get("hoffset", [])] or [0.0] * len(names)
    units = dict(zip(names, stated.get("vunit", []), strict=False))
    most = max((read_number(cell) or 0.0 for cell in stated.get("blocksize", [])), default=0.0)
    clocks = {name: (start, step or 0.0) for name, start, step in zip(names, starts, steps, strict=False)}
    finish = partial(_time_blocks, clocks, most)
    width = len(split[first])
    ahead = int(width > len(names) and not split[first][0])
    kept = [""] * ahead + names + [""] * (width - ahead - len(names))
    return Header(kept, keep_units(units), separator, rows[first][0] + 1, finish=finish)


def _is_row(cells: Sequence[str], count: int) -> bool:
    """Return whether a row holds so many numbers, and nothing else."""
    return all(map(is_value, cells)) and sum(map(is_filled, cells)) == count


def _time_blocks(
    clocks: Mapping[str, tuple[float, float]],
    most: float,
    found: Columns,
    units: dict[str, str],
    refused: dict[str, str],
) -> None:
    """Add the time (s) of the first channel; another channel with another start or step is refused."""
    first, size = next(iter(clocks)), next((column.size for column in found.values()), 0)
    if 0.0 < most < size:
        raise DataError(
            f"the file holds {size} rows and its BlockSize is {most:g}, so there are several blocks: export one of them"
        )
    for name, (start, step) in clocks.items():
        if (start, step) != clocks[first] and name in found:
            refused[name] = (
                f"{name!r} has samples every {step:g} s from {start:g} s on, and {first!r} every {clocks[first][1]:g} s"
                f" from {clocks[first][0]:g} s on: export channels of one rate"
            )
            del found[name]
    start, step = clocks[first]
    _put_on_grid(start, step, found, units, refused)


def _read_twincat(rows: list[Line]) -> Header | None:
    """Return the header of an export of TwinCAT Scope: settings of each channel, then times (ms) and values.

    The word of a setting stands before each group of channels, above the column of the times of this group.
    """
    separator = next((sign for sign in ("\t", ";", ",") if sign in rows[0][1]), "\t")
    split = [[cell.strip() for cell in cells_of(line, separator)] for _, line in rows[:TOP]]
    block = [cells for cells in split if len(cells) > 1 and cells[0] and not is_value(cells[0])]
    sampled = next((cells for cells in block if cells[0] == "SampleTime[ms]"), None)
    if sampled is None:
        return None
    width = len(sampled)
    stated = {cells[0]: cells for cells in block if len(cells) == width}
    names = stated.get("Name") or stated.get("SymbolName")
    last = max(k for k, cells in enumerate(split) if cells in block and len(cells) == width)
    if names is None or last + 1 >= len(split):
        return None
    groups = [j for j, cell in enumerate(sampled) if cell == sampled[0]]
    kept = [f"{TIME} {groups.index(j) + 1}" if j in groups else name for j, name in enumerate(names)]
    units = dict(zip(kept, stated.get("Unit", []), strict=False)) | {kept[j]: "ms" for j in groups}
    odd = {
        kept[j]: f"{key} {cell}"
        for key, usual in _UNITY.items()
        for j, cell in enumerate(stated.get(key, []))
        if j not in groups and read_number(cell.replace(",", ".")) != usual
    }
    owners = {kept[j]: kept[j + 1 : end] for j, end in zip(groups, [*groups[1:], width], strict=True)}
    finish = partial(_join_groups, owners, odd)
    return Header(kept, keep_units(units), separator, rows[last + 1][0] + 1, finish=finish)


def _join_groups(
    owners: Mapping[str, list[str]],
    odd: Mapping[str, str],
    found: Columns,
    units: dict[str, str],
    refused: dict[str, str],
) -> None:
    """Write the times of the first group in s; a group with other times is refused, and so is a scaled channel."""
    first, *others = owners
    if first not in found:
        return
    for other in others:
        if other in found and not np.array_equal(found[other], found[first]):
            for name in (other, *owners[other]):
                found.pop(name, None)
                refused[name] = (
                    f"{name!r} has other times than {owners[first][0]!r}: export both with one time line, or channels"
                    " of one sample time"
                )
        found.pop(other, None)
    for name, says in odd.items():
        if found.pop(name, None) is not None:
            refused[name] = (
                f"{name!r} has the setting {says}, and whether its numbers contain it is not stated: export it without"
                " a scale, or correct the setting in the file"
            )
    values = found.pop(first)
    since = values[np.isfinite(values)][:1]
    filed = since.size > 0 and since[0] > _SINCE_1601
    found[TIME], units[TIME] = (1e-7 * (values - since[0]) if filed else 1e-3 * values), "s"
