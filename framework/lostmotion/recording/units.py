"""Units in the header of a table, and the unit of a time column.

A list decides whether a word is a unit, since pint would read the names of columns `t`, `acc`, `link` and `F` as tonne,
volume, length and farad.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.quantities import si_factor
from lostmotion.recording.spec import Channel

Array = NDArray[np.float64]
_PREFIXES = ("", "p", "n", "u", "µ", "μ", "m", "c", "d", "k", "M", "G")
_WITH_PREFIX = (
    "s",
    "m",
    "g",
    "N",
    "Nm",
    "V",
    "A",
    "Hz",
    "Pa",
    "W",
    "J",
    "bar",
    "rad",
    "K",
    "T",
    "C",
    "Ohm",
    "ohm",
    "Ω",
)
_LONG_PREFIXES = ("", "nano", "micro", "milli", "centi", "kilo", "mega")
_LONG = ("newton", "meter", "metre", "second", "gram", "radian", "volt", "ampere", "amp", "hertz", "pascal", "watt",
         "joule")  # fmt: skip
_PLAIN = {
    "sec", "msec", "usec", "min", "minute", "minutes", "h", "hr", "hrs", "hour", "hours", "deg", "degree", "degrees",
    "°", "°C", "degC", "degF", "°F", "celsius", "kelvin", "%", "‰", "percent", "rpm", "rev", "turn", "turns", "in",
    "inch", "inches", "ft", "foot", "feet", "mil", "mph", "lb", "lbf", "lbs", "kip", "psi", "oz", "ozf", "kgf", "kp",
    "gf", "g_0", "g_n", "gn", "g0", "count", "counts", "digit", "digits", "LSB", "dB", "ppm", "arcmin", "arcsec", "gon",
    "pound", "pounds", "pound_force", "force_pound",
}  # fmt: skip
_ATOMS = (
    _PLAIN
    | {prefix + unit for prefix in _PREFIXES for unit in _WITH_PREFIX}
    | {prefix + unit + plural for prefix in _LONG_PREFIXES for unit in _LONG for plural in ("", "s")}
)
_POWER = re.compile(r"(?:\*\*|\^)\s*\(?\s*[+-]?\d\s*\)?|(?<=[^\W\d_])-?\d(?!\w)|[²³⁻¹]")
_BETWEEN = re.compile(r"[*/·⋅()\s]+")
_BRACKETS = re.compile(r"(.*\S)\s*(?:\[([^\[\]]+)\]|\(((?:[^()]|\([^()]*\))+)\))")
_WRAPPED = re.compile(r"\[(.*)\]|\((.*)\)")
LONGEST = 40
"""The greatest number of characters of a unit in a header."""
EMPTY = {"", "-", "--", "1"}
"""Cells of a line of units that mean: no unit."""

PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}
SECONDS = {"min": 60.0, "h": 3600.0}
_ALIASES = {
    "s": ("s", "sec", "secs", "second", "seconds"),
    "ms": ("ms", "msec", "millisecond", "milliseconds"),
    "us": ("us", "µs", "μs", "usec", "microsecond", "microseconds"),
    "ns": ("ns", "nsec", "nanosecond", "nanoseconds"),
    "min": ("min", "minute", "minutes"),
    "h": ("h", "hr", "hrs", "hour", "hours"),
}
TIME_UNITS = {alias: unit for unit, aliases in _ALIASES.items() for alias in aliases}
"""The spellings of units of time, each with its standard name."""
_TAIL = re.compile(r"[_/ .](\w+)$")


def is_unit(text: str) -> bool:
    """Return whether a text is a unit of measurement that a data logger may print, such as `mm` or `m/s^2`."""
    text = text.strip()
    if not text or len(text) > LONGEST:
        return False
    atoms = [atom for atom in _BETWEEN.split(_POWER.sub(" ", text)) if atom]
    if atoms[:1] == ["1"] and "/" in text:
        del atoms[0]
    return bool(atoms) and all(atom in _ATOMS for atom in atoms)


def split_name(name: str) -> tuple[str, str]:
    """Return the name of a column without its unit in brackets, and that unit, which may be empty."""
    found = _BRACKETS.fullmatch(name.strip())
    unit = (found[2] or found[3]).strip() if found else ""
    return (found[1], unit) if found and is_unit(unit) else (name, "")


def unit_line(cells: Sequence[str]) -> list[str] | None:
    """Return the units in a line below the header, empty where a cell has none; None if it is no line of units."""
    found = [_strip_brackets(cell.strip()) for cell in cells]
    filled = [cell for cell in found if cell not in EMPTY]
    if not filled or 2 * sum(map(is_unit, filled)) < len(filled):
        return None
    return ["" if cell in EMPTY else cell for cell in found]


def _strip_brackets(cell: str) -> str:
    found = _WRAPPED.fullmatch(cell)
    return (found[1] or found[2] or "").strip() if found else cell


def seconds(values: Array, unit: str, source: str) -> Array:
    """Return a time column (n,) in s from one in s, ms, us, µs, ns, min or h; `DataError` for another unit."""
    known = TIME_UNITS.get(unit.strip())
    if known is None:
        raise DataError(f"{source}: time in {unit[:LONGEST]!r} is not understood: expected s, ms, us, ns, min or h")
    if known == "s":
        return values
    return values / PER_SECOND[known] if known in PER_SECOND else values * SECONDS[known]


def time_unit(name: str, table_unit: str | None, given: str | None) -> tuple[str, tuple[str, ...]]:
    """Return the unit of a time column (s, ms, us, ns, min or h) and notes on its origin.

    The unit in the case is used; `DataError` is raised where the file contradicts it. Otherwise the unit in the file is
    used, then one at the end of the name (`time_ms`, `Time/ms`), then s.
    """
    found = _time_unit_of_table(name, table_unit) or _time_unit_of_name(name)
    if given is None:
        notes = () if found in ("", "s") else (f"the time column {name!r} is read in {found}",)
        return found or "s", notes
    wanted = TIME_UNITS.get(given.strip())
    if wanted is None:
        raise DataError(
            f"the unit {given[:LONGEST]!r} of the time column {name!r} is not a time: expected s, ms, us, ns, min or h"
        )
    if found and found != wanted:
        raise DataError(
            f"the time column {name!r} is in {found} by its header and in {wanted} by the case: correct the unit "
            "in the case, or the header"
        )
    return wanted, ()


def _time_unit_of_table(name: str, unit: str | None) -> str:
    """Return the unit of time in the file, or an empty text; a unit of another quantity raises `DataError`."""
    word = (unit or "").partition(" since ")[0].strip()
    if word in TIME_UNITS or not is_unit(word):
        return TIME_UNITS.get(word, "")
    raise DataError(
        f"the time column {name!r} is in {word} by its header, which is no time: name the column that holds time, or "
        "give rate (Hz)"
    )


def _time_unit_of_name(name: str) -> str:
    bare, unit = split_name(name)
    if unit in TIME_UNITS:
        return TIME_UNITS[unit]
    found = _TAIL.search(bare)
    return TIME_UNITS.get(found[1], "") if found else ""


def note_unit(channel: Channel, table_unit: str | None, what: str) -> Iterator[str]:
    """Yield a note when the unit of a channel in the case differs from the one in the header of the file.

    A `factor` may account for the difference; with a factor, a unit of another quantity (volts) is accepted.
    """
    unit = normalise_unit(table_unit or "")
    if not is_unit(unit) or unit in (channel.unit, normalise_unit(channel.unit)):
        return
    try:
        factor, si = si_factor(unit, channel.quantity)
    except DataError:
        if channel.factor == 1.0:
            yield (
                f"{what}: the header says {table_unit}, which measures no {channel.quantity.replace('_', ' ')}; the "
                f"case {channel.unit}: correct the unit, or give the factor between them"
            )
        return
    stated, wanted = si_factor(channel.unit, channel.quantity)
    if si != wanted or abs(abs(channel.factor) * stated / factor - 1.0) > 1e-3:
        yield f"{what}: the header says {table_unit}, the case {channel.unit}: correct one of them"


def normalise_unit(unit: str) -> str:
    """Return a unit in the spelling of `quantities`: `m/s2` and `m/s²` become `m/s^2`."""
    text = unit.strip().replace("²", "^2").replace("³", "^3").replace("⋅", "*").replace("·", "*").replace("μ", "µ")
    text = re.sub(r"(?<=[a-zA-Z])(\d)(?!\w)", r"^\1", text) if "g0" not in text else text.replace("g0", "g_0")
    text = re.sub(r"(?<![^\W\d_])([kmM]?N)m(?![\w])", r"\1 m", text)
    return {"degC": "degC", "°C": "degC", "g_n": "g_0", "gn": "g_0"}.get(text, text)
