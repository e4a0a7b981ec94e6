"""Units of the columns of a table: in their names, below them, or in their attributes; and the unit of time.

One rule applies to every column of every format: `name_and_unit` parts a name from its unit. A list decides whether a
word is a unit, since pint would read the names of columns `t`, `acc`, `link` and `F` as tonne, volume, length and
farad.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.quantities import si_factor, spell_unit
from lostmotion.recording.column_names import KINDS, kind_named, names_time
from lostmotion.recording.spec import Channel

Array = NDArray[np.float64]
_PREFIXES = ("", "p", "n", "u", "µ", "μ", "m", "c", "d", "da", "k", "M", "G")
_WITH_PREFIX = ("s", "m", "g", "N", "Nm", "V", "A", "Hz", "Pa", "W", "J", "bar", "rad", "K", "T", "C", "Ohm", "ohm",
                "Ω")  # fmt: skip
_LONG_PREFIXES = ("", "nano", "micro", "milli", "centi", "kilo", "mega")
_LONG = ("newton", "meter", "metre", "second", "gram", "radian", "volt", "ampere", "amp", "hertz", "pascal", "watt",
         "joule")  # fmt: skip
_PLAIN = {
    "sec", "msec", "usec", "min", "minute", "minutes", "h", "hr", "hrs", "hour", "hours", "deg", "degree", "degrees",
    "°", "°C", "degC", "degF", "°F", "celsius", "kelvin", "%", "‰", "percent", "rpm", "rev", "turn", "turns", "in",
    "inch", "inches", "ft", "foot", "feet", "mil", "mph", "lb", "lbf", "lbs", "kip", "psi", "oz", "ozf", "kgf", "kp",
    "gf", "g_0", "g_n", "gn", "g0", "count", "counts", "digit", "digits", "LSB", "dB", "ppm", "arcmin", "arcsec", "gon",
    "pound", "pounds", "pound_force", "force_pound", "thou", "micron", "angstrom", "grad", "klbf", "dyne", "d", "day",
    "days", "U", "Umdr", "r", "rps", "dps", "gee", "Nmm", "Ncm", "mils",
    "Grad", "Sekunde", "Sekunden", "RPM", "Sec", "SEC", "Secs",
}  # fmt: skip
_ATOMS = (
    _PLAIN
    | {prefix + unit for prefix in _PREFIXES for unit in _WITH_PREFIX}
    | {prefix + unit + plural for prefix in _LONG_PREFIXES for unit in _LONG for plural in ("", "s")}
)
_POWER = re.compile(r"(?:\*\*|\^)\s*\(?\s*[+-]?\d\s*\)?|(?<=[^\W\d_])-?\d(?!\w)|[²³⁻¹]")
_BETWEEN = re.compile(r"[*/·⋅()\s]+")
_GROUPS = re.compile(r"\[([^\[\]]+)\]|\{([^{}]+)\}|<([^<>]+)>|\(((?:[^()]|\([^()]*\))+)\)")
"""A part of a name in brackets."""
_LISTED = re.compile(r"(.*?\S)(?:\s*[,;]\s*|\s+in\s+|\s+[-\u2013]\s+)([^,(\[]+?)\s*(?:\(.*\)|\[.*\])?")
"""A name, a unit behind a comma, a dash or `in`, and perhaps a remark in brackets, as loggers of HOBO write it."""
_CAMEL = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+")
"""The words of a name whose words begin with a capital letter, `positionMm`."""
_SCALED = re.compile(r"(?:[\[(]|[_ (\[](?:x|times|div|by|in)|[*×/]) ?(?:10+|0[.,]0*1|1e-?\d+|10\^-?\d+)(?![\d.])", re.I)
"""A factor beside a unit."""
_CAPITALS = {
    "M": "m", "MM": "mm", "CM": "cm", "UM": "um", "IN": "in", "INCH": "inch", "FT": "ft", "S": "s", "SEC": "s",
    "MS": "ms", "US": "us", "MIN": "min", "KN": "kN", "LBF": "lbf", "KGF": "kgf", "DEG": "deg", "RAD": "rad", "G": "g",
    "NM": "Nm", "MV": "mV", "MA": "mA", "HZ": "Hz", "MILS": "mils", "SECONDS": "s", "KIP": "kip", "LBS": "lbs",
}  # fmt: skip
"""Units in names that consist of capital letters."""
_FORCES = {"lb": "lbf", "lbs": "lbf", "kn": "kN"}
"""Words that are a unit of force in the name of a force."""
_RATES = re.compile(r"(u?m|mm|cm|in|ft|m?rad|deg|rev)(?:_?p|_?per_?)s(?:ec(?:ond)?)?_?(2?)")
_SHORT_RATES = re.compile(r"(m|mm|rad|deg)_?s(_?2)?")
_DOUBTFUL = {"in", "rev", "turn", "turns", "count", "counts", "mil", "foot", "digit", "digits", "cm", "pm", "nm", "dm",
             "cd", "dN", "mg", "kg", "ft", "gon", "kp"}  # fmt: skip
"""Words that may be a unit, or a part of a name."""
_ENDING = {"in", "rev", "turn", "turns", "count", "counts", "mil", "foot", "digit", "digits", "pm", "cd", "dN", "r",
           "U", "grad", "gon", "kp", "min", "h", "d"}  # fmt: skip
"""Units that are read at the end of a name only: elsewhere they are other words."""
_ANGLES = re.compile(r"angle|theta|phi|winkel|^d*q", re.IGNORECASE)
_OTHER = {"mV", "uV", "kV", "mA", "uA", "kA", "Hz", "kHz", "degC", "bar", "kPa", "MPa", "Pa", "psi", "counts"}
_NONE = re.compile(r"(?!)")
RAW = frozenset(("V", "mV", "uV", "µV", "kV", "A", "mA", "uA", "kA", "%", "counts", "count", "digits", "digit", "LSB"))
"""Units of readings that a factor may turn into a quantity of mechanics."""
_ELECTRICAL = {
    "V": re.compile(r"volt|spannung|supply|(^|_)u($|_)|(^|_)v($|_)", re.IGNORECASE),
    "A": re.compile(r"current|strom|amp|(^|_)i($|_)", re.IGNORECASE),
}
_WRAPPED = re.compile(r"\[(.*)\]|\((.*)\)|\{(.*)\}|<(.*)>")
_UNIT_WORD = re.compile(r"(?:units?|einheit(?:en)?)\s*[:=]\s*", re.IGNORECASE)
LONG = 100
"""A longer name has its unit in brackets."""
LONGEST = 40
"""The greatest number of characters of a unit in a header."""
EMPTY = {"", "-", "--", "1"}
"""Cells of a line of units that mean: no unit."""

PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "100ns": 1e7, "ns": 1e9}
SECONDS = {"min": 60.0, "h": 3600.0, "d": 86400.0}
_ALIASES = {
    "s": ("s", "sec", "secs", "second", "seconds", "Second", "Seconds", "Sec", "SEC", "Secs"),
    "ms": ("ms", "msec", "millisecond", "milliseconds", "millis"),
    "us": ("us", "µs", "μs", "usec", "microsecond", "microseconds", "micros"),
    "ns": ("ns", "nsec", "nanosecond", "nanoseconds"),
    "100ns": ("100ns", "100 ns"),
    "min": ("min", "minute", "minutes"),
    "h": ("h", "hr", "hrs", "hour", "hours"),
    "d": ("d", "day", "days"),
}
TIME_UNITS = {alias: unit for unit, aliases in _ALIASES.items() for alias in aliases}
"""The spellings of units of time, each with its standard name."""
_TAIL = re.compile(r"[_/ .](\w+)$")


def is_unit(text: str) -> bool:
    """Return whether a text is a unit of measurement that a data logger may print, such as `mm` or `m/s^2`."""
    text = text.strip()
    if not text or len(text) > LONGEST:
        return False
    text = spell_unit(text)
    atoms = [atom for atom in _BETWEEN.split(_POWER.sub(" ", text)) if atom]
    if atoms[:1] == ["1"] and "/" in text:
        del atoms[0]
    return bool(atoms) and all(atom in _ATOMS for atom in atoms)


def split_name(name: str) -> tuple[str, str]:
    """Return the name of a column without its unit in brackets or behind a comma, and that unit, which may be empty."""
    text = name.strip()
    for found in reversed([*_GROUPS.finditer(text)]):
        bare = f"{text[: found.start()].rstrip(' ,')}{text[found.end() :]}".strip()
        if bare and (unit := _unit_in_name(bare, next(filter(None, found.groups())))):
            return bare, unit
    listed = _LISTED.fullmatch(text)
    unit = _unit_in_name(listed[1], listed[2]) if listed else ""
    return (listed[1], unit) if listed and unit else (name, "")


def strange_unit(name: str) -> str:
    """Return the word in brackets at the end of a name if it is no known unit, or a factor beside a unit; else "".

    In round brackets are often remarks: they count where a part of them is a unit.
    """
    *_, last = (None, *_GROUPS.finditer(name))
    if last is None or name[last.end() :].strip() or split_name(name)[1]:
        return scale_in(name)
    word = next(filter(None, last.groups())).strip()
    remark = last[4] and not any(len(part) > 1 and is_unit(part) for part in re.split(r"[\W\d_]+", word))
    return scale_in(name) if remark or word.isdigit() or word in EMPTY else word


def _unit_in_name(head: str, word: str) -> str:
    """Return the unit that a word beside the name `head` means, or an empty text.

    `MM` is mm, and in a name of capital letters `M` is m. `nm` of a torque is a newton metre, `G` of an acceleration is
    that of gravity, and `lbs` or `lb` of a force is a pound-force.
    """
    word, kind = word.strip(), kind_named(head)
    if word.isupper() and (head.isupper() or len(word) > 1):
        spelt = re.sub(r"[A-Z]+", lambda found: _CAPITALS.get(found[0], found[0]), word)
        word = spelt if is_unit(spelt) else word
    if kind == "force" and (torque := re.fullmatch(r"([mk]?)nm", word)):
        return f"{torque[1]}Nm"
    if kind == "force" and word in _FORCES:
        return _FORCES[word]
    if word not in _ATOMS and (plain := word.lower().rstrip(".")) in _ATOMS and len(plain) > 2:
        return plain
    return "g" if word == "G" and kind == "acceleration" else word if is_unit(word) else ""


@lru_cache(maxsize=4096)
def name_and_unit(name: str) -> tuple[str, str]:
    """Return the name of a column without its unit, and that unit, which may be empty.

    The unit is in brackets, `Force [N]`, behind a comma, `Force, N`, at the end, `force_N`, `Time/ms`, `v_mm_per_s`,
    `positionMm`, or within the name, `mm_pos`, `angle_deg_filtered`. A single letter is a unit only of the quantity
    that the name says: `force_N`, but not `sensor_A`; and so is a word that may have another sense, as in `force_min`,
    and each unit that is not at the end. A name may also be a unit only.
    """
    bare, unit = split_name(name)
    if unit or scale_in(name) or len(name) > LONG:
        return bare, unit
    words = [word for word in _CAMEL.findall(name) if word]
    camel = "_".join(map(_lower_first, words)) if len(words) > 1 and "".join(words) == name else name
    plain = re.sub(r"\s*\([^()]*\)$", "", name)
    for text in dict.fromkeys((name, camel, plain, re.sub(r"-(?=[^\W\d])|(?=°$)", "_", plain))):
        pieces = re.split(r"([_/ .:@])", text)
        for last in range(len(pieces), 0, -2):
            for first in range(max(last - 7, 0), last, 2):  # pieces of the unit, with their separators
                rest = "".join((*pieces[: max(first - 1, 0)], *pieces[last + (first == 0) :]))
                word = _unit_at_end(rest, pieces[first:last])
                if rest and word and _fits(rest, word, (first > 0) + (first > 0 and last == len(pieces))):
                    return rest, word
    alone = name.strip().rstrip("()")
    if len(alone) > 1 and alone not in _ENDING | _DOUBTFUL and (alone in _ATOMS or "/" in alone) and kinds_of(alone):
        return name, alone
    return name, TIME_UNITS.get(alone, "") if alone not in ("d", "h", "min") else ""


def scale_in(name: str) -> str:
    """Return the factor beside a unit in the name of a column, `x10` in `pos_mm_x10`; "" where there is none."""
    found = _SCALED.search(name)
    return found[0].strip("_ ([") if found else ""


def _lower_first(word: str) -> str:
    """Return a word of capitals, or with a capital at its beginning, in lower case; N stays as it is."""
    return word.lower() if word != "N" else word


def _unit_at_end(head: str, tail: Sequence[str]) -> str:
    """Return the unit in some pieces of a name: `m_per_s2`, `m_s2` and `mps2` become `m/s^2`; "" where none is."""
    text, kind = "".join(tail), kind_named(head)
    rate = _RATES.fullmatch(text)
    if rate is None and kind in ("velocity", "acceleration"):
        short = _SHORT_RATES.fullmatch(text)
        rate = short if short and bool(short[2]) == (kind == "acceleration") else None
    if rate:
        return f"{rate[1]}/s^2" if rate[2] else f"{rate[1]}/s"
    return _unit_in_name(head, "/".join(word for word in tail[::2] if word and word != "per"))


def _fits(rest: str, unit: str, place: int) -> bool:
    """Return whether a word of a name is the unit of what the rest says; its place: first, within or last (0 to 2)."""
    if place < 2 and (unit in _ENDING or (place == 0 and unit == "rad")):
        return False
    if unit in TIME_UNITS:
        return names_time(rest)
    if unit == "m" and _ANGLES.search(rest):  # `theta_m`, the angle of a motor
        return False
    kinds, called = kinds_of(unit), kind_named(rest)
    if len(unit) > 1 and unit not in _DOUBTFUL and (place == 2 or not called):
        return bool(kinds) or (place == 2 and unit in _OTHER)
    return called in kinds if kinds else _ELECTRICAL.get(unit, _NONE).search(rest) is not None


@lru_cache(maxsize=4096)
def kinds_of(unit: str) -> tuple[str, ...]:
    """Return the quantities of `KINDS` that a unit measures; none for volts, or for an empty text."""
    return tuple(kind for kind in KINDS if unit and _measures(unit, kind))


def contradict(one: str, other: str) -> bool:
    """Return whether two units cannot both be those of one column; an empty text is no unit."""
    if not one or not other or one == other:
        return False
    if one in TIME_UNITS or other in TIME_UNITS:
        return TIME_UNITS.get(one) != TIME_UNITS.get(other)
    kinds = set(kinds_of(one)), set(kinds_of(other))
    if kinds[0] != kinds[1]:
        return bool(kinds[0] and kinds[1])
    return any(abs(si_factor(one, kind)[0] / si_factor(other, kind)[0] - 1.0) > 1e-6 for kind in kinds[0])


def check_name(name: str, unit: str) -> None:
    """Raise `DataError` for a column whose name states another unit than the line or the attribute beside it."""
    named = spell_unit(name_and_unit(name)[1])
    if contradict(spell_unit(unit), named):
        raise DataError(f"the unit of {name!r} is {named} by its name and {unit} beside it: give the true one of them")


def _measures(unit: str, kind: str) -> bool:
    try:
        si_factor(unit, kind)
    except DataError:
        return False
    return True


def unit_line(cells: Sequence[str]) -> list[str] | None:
    """Return the units in a line below the header, empty where a cell has none; None if it is no line of units."""
    found = [_strip_brackets(_UNIT_WORD.sub("", cell.strip())) for cell in cells]
    if all(cell.upper() == cell for cell in found):
        found = [_unit_in_name("X", cell) or cell for cell in found]
    filled = [cell for cell in found if cell not in EMPTY]
    if not filled or 2 * sum(map(is_unit, filled)) < len(filled):
        return None
    return ["" if cell in EMPTY else cell for cell in found]


def _strip_brackets(cell: str) -> str:
    found = _WRAPPED.fullmatch(cell)
    return next(filter(None, found.groups()), "").strip() if found else cell


def seconds(values: Array, unit: str, source: str) -> Array:
    """Return a time column (n,) in s from one in s, ms, us, µs, ns, min, h or d; `DataError` for another unit."""
    known = TIME_UNITS.get(spell_unit(unit))
    if known is None:
        raise DataError(f"{source}: time in {unit[:LONGEST]!r} is not understood: expected s, ms, us, ns, min, h or d")
    if known == "s":
        return values
    if known == "100ns":  # dates as large as these are resolved to some us only
        return (values - values[:1]) / PER_SECOND[known]
    return values / PER_SECOND[known] if known in PER_SECOND else values * SECONDS[known]


def time_unit(name: str, table_unit: str | None, given: str | None) -> tuple[str, tuple[str, ...]]:
    """Return the unit of a time column (s, ms, us, ns, min, h or d; "" where none is stated), and notes on its origin.

    The unit that is given is used; `DataError` is raised where the file contradicts it. Otherwise the unit in the file
    is used, then the one in the name (`time_ms`, `Time/ms`).
    """
    found = _time_unit_of_table(name, table_unit) or _time_unit_of_name(name)
    if given is None:
        notes = () if found in ("", "s") else (f"the time column {name!r} is read in {found}",)
        return found, notes
    wanted = TIME_UNITS.get(spell_unit(given))
    if wanted is None:
        raise DataError(
            f"the unit {given[:LONGEST]!r} of the time column {name!r} is not a time: expected s, ms, us, ns, min, h or"
            " d"
        )
    if found and found != wanted:
        raise DataError(
            f"the time column {name!r} is in {found} by its header and in {wanted} by the case: correct the unit "
            "in the case, or the header"
        )
    return wanted, ()


def _time_unit_of_table(name: str, unit: str | None) -> str:
    """Return the unit of time in the file, or an empty text; a unit of another quantity raises `DataError`."""
    word = spell_unit((unit or "").partition(" since ")[0])
    if word in TIME_UNITS or not is_unit(word):
        return TIME_UNITS.get(word, "")
    raise DataError(
        f"the time column {name!r} is in {word} by its header, which is no time: name the column that holds time, or "
        "give rate (Hz)"
    )


def _time_unit_of_name(name: str) -> str:
    """Return the unit of time at the end of the name of a column that is known to hold time."""
    bare, unit = split_name(name)
    found = _TAIL.search(bare)
    return TIME_UNITS.get(spell_unit(unit), "") or (TIME_UNITS.get(found[1], "") if found else "")


def note_unit(channel: Channel, table_unit: str | None, what: str) -> Iterator[str]:
    """Yield a note when the unit of a channel in the case differs from the one in the header of the file.

    A `factor` may account for the difference; with a factor, a unit of another quantity (volts) is accepted.
    """
    unit = spell_unit(table_unit or "")
    if not is_unit(unit) or unit == spell_unit(channel.unit):
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
