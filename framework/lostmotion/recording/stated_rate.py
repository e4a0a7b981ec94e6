"""A sampling rate that stands beside a table: `# sampling rate: 500 Hz`, `Fs=1000`, `Sample interval 0.002 s`.

Lines above a table, attributes of data frames and data sets, and single numbers in a file are read in the same way.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from lostmotion.recording.numbers import read_number
from lostmotion.recording.units import PER_SECOND, SECONDS, TIME_UNITS, is_unit

SLOWEST, FASTEST = 0.1, 1e7
"""The rates (Hz) between which a number without a unit is believed."""
LONGEST = 1.0
"""The interval below which a number without a unit is in s; a larger one may be in ms."""
_RATE = (
    r"(?:sampl\w*|scan|acquisition|data|log(?:ging)?|recording)[ _-]?(?:rate|freq(?:uency)?)|f_?s(?:ample)?|sr|rate"
    r"|sampling(?=\W+[\d.,]+ ?[kM]?Hz)"
    r"|abtast(?:rate|frequenz)|messrate|(?:taux|fréquence) d.échantillonnage|frecuencia de muestreo"
    r"|サンプリング(?:周波数|レート)|частота дискретизации|采样(?:率|频率)"
)
_STEP = (
    r"(?:sampl\w*|scan|logging|recording|measur\w*)[ _-]?(?:interval|period)|sampl\w*[ _-]?(?:time|step)|d_?t|t_?s"
    r"|delta(?:[ _]?[tx])?|Δt|time[ _]?(?:step|interval|increment)|x[ _]?inc(?:rement)?|t_?inc|interval|h_?resolution"
    r"|(?:abtast|mess)(?:intervall|zeit|periode)|период дискретизации|サンプリング(?:間隔|周期)|采样(?:间隔|周期)"
)
_NUMBER = r"\d+(?:[.,]\d+)?(?:[eE][+-]?\d+)?"
_STATED = re.compile(
    rf"(?:^|[,{{;|\t]) *[\"']?(?:(?P<rate>{_RATE})|(?P<step>{_STEP}))[\"']?(?: ?[\[(](?P<unit>[^\])]+)[\])]"
    rf"|[ _](?P<hertz>[kM]?hz)|_(?P<short>ms|us|s))?[ :=;,\t\"']+(?P<number>{_NUMBER})(?P<rest>.*)",
    re.IGNORECASE,
)
_PER_SECOND = re.compile(r"([kM]?)(?:hz|sa?/s(?:ec)?|sps|samples(?:/s(?:ec)?| per second)|1/s|/s|pts/s)", re.IGNORECASE)
_TIMES = {"": 1.0, "k": 1e3, "m": 1e6}


def rates_in_lines(lines: Iterable[str]) -> dict[str, float]:
    """Return the sampling rates (Hz) that lines of a file state, by the words that say so."""
    found: dict[str, float] = {}
    for number, line in enumerate(lines, start=1):
        text = line.strip().lstrip("#%/*-! \t")
        if rate := _read_rate(text):
            found[f"line {number} states {text[:60]!r}"] = rate
    return found


def rates_in(entries: Mapping[str, object], what: str = "attribute") -> dict[str, float]:
    """Return the sampling rates (Hz) in attributes or single numbers by name, by the words that say so."""
    found = {}
    for name, value in entries.items():
        if isinstance(value, (str, int, float)) and not isinstance(value, bool):
            text = f"{str(name).rpartition('.')[2]} = {value}"
            if rate := _read_rate(text):
                found[f"the {what} {text[:60]!r} states it"] = rate
    return found


def _read_rate(text: str) -> float | None:
    """Return the sampling rate (Hz) that a text states, None where it states none or may be read in two ways."""
    found = _STATED.search(text)
    if found is None:
        return None
    point, comma = read_number(found["number"]), read_number(found["number"], "comma")
    number = comma if point is None else point
    if number is None or not number > 0.0 or (point is not None and comma is not None and point != comma):
        return None
    word, *more = re.split(r"[;,\t]", found["rest"].strip().strip(";,\t ")) or [""]
    further = [read_number(cell) for cell in (word, *more)]
    if any(one is not None and one > 0.0 and one != number for one in further):
        return None  # a rate for each channel
    stated = found["unit"] or found["hertz"] or found["short"] or ""
    return _to_rate(number, stated or word.strip(" \"'})."), step=found["step"] is not None, sure=bool(stated))


def _to_rate(number: float, unit: str, *, step: bool, sure: bool) -> float | None:
    """Return a rate (Hz) from a number and the word behind it; None where the word is a unit of something else."""
    known = TIME_UNITS.get(unit) or TIME_UNITS.get(unit.lower())
    hertz = _PER_SECOND.fullmatch(unit)
    if step and known:
        return PER_SECOND[known] / number if known in PER_SECOND else 1.0 / (number * SECONDS[known])
    if hertz and not step:
        return number * _TIMES[hertz[1].lower()]
    if known or hertz or is_unit(unit) or sure:
        return None
    return number if not step and SLOWEST <= number <= FASTEST else 1.0 / number if step and number < LONGEST else None
