"""Formatting of numbers, units and names for readers."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple

from lostmotion.results import DEGREES, TINY, Interval, decimals_of

RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
PREFIXED = {"m", "rad", "N", "N m", "m/s", "rad/s", "m/s^2", "V", "A"}
PROPER = {
    "coulomb": "Coulomb",
    "stribeck": "Stribeck",
    "bouc": "Bouc",
    "wen": "Wen",
    "dahl": "Dahl",
    "lugre": "LuGre",
    "lyapunov": "Lyapunov",
    "rosenstein": "Rosenstein",
    "kantz": "Kantz",
    "wolf": "Wolf",
    "grassberger": "Grassberger",
    "procaccia": "Procaccia",
    "takens": "Takens",
    "theiler": "Theiler",
    "schreiber": "Schreiber",
    "cao": "Cao",
    "fourier": "Fourier",
    "ami": "AMI",
    "knn": "k-nearest-neighbour",
    "fnn": "FNN",
    "aaft": "AAFT",
    "iaaft": "IAAFT",
    "ghkss": "GHKSS",
}
DASH = "–"
ANGLE: ContextVar[str] = ContextVar("ANGLE", default="rad")
"""The unit in which angles are shown."""
SMALLEST = 1e-99
"""A smaller p-value is reported as below this value."""


class Scale(NamedTuple):
    """The factor from SI to the displayed unit, and that unit."""

    factor: float
    unit: str


@contextmanager
def angles_in(unit: str) -> Iterator[None]:
    """Show angles in `unit`, rad or deg, within the context."""
    before = ANGLE.set(unit)
    try:
        yield
    finally:
        ANGLE.reset(before)


def choose_scale(largest: float, unit: str) -> Scale:
    """Return a readable scale for values up to `largest`: SI, or with the prefix milli, micro or kilo.

    Within `angles_in("deg")`, angles are in degrees.
    """
    if ANGLE.get() == "deg" and unit in DEGREES:
        return Scale(180.0 / math.pi, DEGREES[unit])
    if unit not in PREFIXED or not math.isfinite(largest) or largest == 0 or 0.1 <= abs(largest) < 1e4:
        return Scale(1.0, unit)
    for factor, prefix in ((1e-3, "k"), (1e3, "m"), (1e6, "µ")):
        if 0.1 <= abs(largest) * factor < 1e4:
            return Scale(factor, prefix + unit)
    return Scale(1.0, unit)


def format_unit(unit: str) -> str:
    """Return a unit with superscript powers; the unit of pure numbers is an empty string."""
    return "" if unit == "1" else re.sub(r"\^(-?\d+)", lambda match: match[1].translate(RAISED), unit)


def with_unit(name: str, unit: str) -> str:
    """Return an axis label such as `velocity (m/s)`."""
    return f"{name} ({format_unit(unit)})" if format_unit(unit) else name


def typeset(text: str) -> str:
    """Return a sentence for a page: superscript powers, powers of ten, and no line break before "%"."""
    powers = re.sub(r"(?<=\d)e([+-]?)0*(\d+)\b", lambda m: f"·10{(m[1].strip('+') + m[2]).translate(RAISED)}", text)
    raised = re.sub(r"(?<=[A-Za-z])\^(-?\d+)", lambda m: m[1].translate(RAISED), powers)
    return raised.replace(" +- ", " ± ").replace(" %", "\N{NO-BREAK SPACE}%")


def split_headline(says: Sequence[str], longest: int = 160) -> list[str]:
    """Return the parts of an answer, the first of which is the headline: of a long one its first sentence alone."""
    first, *rest = says
    head, stop, tail = first.partition(". ") if len(first) > longest else (first, "", "")
    return [f"{head}.", tail, *rest] if stop else [first, *rest]


def to_words(name: str) -> str:
    """Return a name such as `coulomb_friction` as words: `Coulomb friction`."""
    return (
        " ".join(PROPER.get(word, word) for word in name.split("_"))
        .replace("Bouc Wen", "Bouc–Wen")
        .replace("Grassberger Procaccia", "Grassberger–Procaccia")
    )


def sentence(text: str) -> str:
    """Return `text` with a capital at its start."""
    return text[:1].upper() + text[1:]


def figures(value: Any, digits: int = 3) -> str:
    """Return a number with at most `digits` significant figures, or a dash where there is none."""
    if not isinstance(value, int | float) or not math.isfinite(value):
        return DASH
    if value == 0:
        return "0"
    power = math.floor(math.log10(abs(value)))
    if power < -4 or power > 6:
        mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
        return f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}e{int(exponent)}"
    text = _signed(f"{value:.{max(0, digits - 1 - power)}f}")
    return text.rstrip("0").rstrip(".") if "." in text else text


def span(number: float, unit: str) -> str:
    """Return a number with a unit given in the plural: "one natural period", "0.5 Lyapunov times"."""
    return f"{number:g} {unit}" if number != 1 else f"one {unit.rstrip('s')}"


def power_of_ten(value: float) -> str:
    """Return a positive number as a tick label of a logarithmic axis: `1`, `10⁻⁵`, `2·10⁻⁵`."""
    power = math.floor(math.log10(value) + 1e-9)
    factor = figures(float(value) / 10.0**power, 2)
    if power == 0:
        return factor
    raised = f"10{str(power).translate(RAISED)}"
    return raised if factor == "1" else f"{factor}·{raised}"


def shorten(text: str, most: int = 48) -> str:
    """Return a text on one line, cut where it is too long for a figure."""
    line = " ".join(text.split())
    return line if len(line) <= most else line[: most - 1].rstrip() + "…"


def format_quantity(value: Any, unit: str) -> str:
    """Return a number with its unit, such as `3.1 N`, or a dash."""
    text = figures(value)
    return text if text == DASH else f"{text} {format_unit(unit)}".rstrip()


def format_size(value: float, unit: str) -> str:
    """Return a positive number of two figures with its unit, with a prefix where that is easier to read: 4 µm, 0.3 ms.

    A number without a unit is one: 0.02.
    """
    times = {"s": ((1.0, "s"), (1e3, "ms"), (1e6, "µs"))}
    if unit in times:
        factor, shown = next((one for one in times[unit] if value * one[0] >= 0.1), times[unit][-1])
    else:
        factor, shown = choose_scale(value, unit)
    return f"{figures(float(f'{factor * value:.2g}'), 2)} {format_unit(shown)}".rstrip()


def percent(value: Any) -> str:
    """Return a share as a percentage with at most two figures, or a dash; a tiny one is said to be less."""
    if not isinstance(value, int | float) or not math.isfinite(value):
        return DASH
    return f"< {figures(100.0 * TINY)} %" if 0.0 < abs(value) < TINY else figures(100 * value, 2) + " %"


def probability(value: Any) -> str:
    """Return a probability with three decimals, or as "> 0.999" or "< 0.001"."""
    if not isinstance(value, int | float) or not math.isfinite(value):
        return DASH
    if value > 0.999:
        return "> 0.999"
    return "< 0.001" if value < 0.001 else f"{value:.3f}"


def chance(p: Any) -> str:
    """Return a p-value as `p = 0.03`, or as `p < ...` where it is as small as rounding errors."""
    known = isinstance(p, int | float) and math.isfinite(p)
    return f"p < {figures(SMALLEST)}" if known and p < SMALLEST else f"p = {figures(p, 2)}"


def interval(told: Interval | None, shown: Scale | None = None) -> str:
    """Return `median [low, high] unit`, with decimals according to the width of the interval.

    Where the interval is withheld, the median is followed by "interval withheld".
    """
    if told is None or not math.isfinite(told.median):
        return DASH
    factor, unit = shown or choose_scale(told.median, told.unit)
    if told.withheld:
        return f"{figures(factor * told.median, 3)} {format_unit(unit)}".rstrip() + ", interval withheld"
    ends = [factor * end for end in (told.median, told.low, told.high)]
    decimals = max(_decimals(ends[2] - ends[1], ends[0]), decimals_of(ends[0], math.nan, math.nan, 2))
    median, low, high = (_signed(f"{end:.{decimals}f}") for end in ends)
    return f"{median} [{low}, {high}] {format_unit(unit)}".rstrip()


def _signed(text: str) -> str:
    """Return a number with a typographic minus sign."""
    return "−" + text[1:] if text.startswith("-") else text


def _decimals(width: float, value: float) -> int:
    """Return the number of decimals for two digits of the width, or four of the value where there is no width."""
    size = width / 30 if width > 0 and math.isfinite(width) else abs(value) / 1e4
    return min(12, max(0, -math.floor(math.log10(size)) - 1)) if size > 0 else 1


def words_of(name: str) -> str:
    """Return the name of a parameter in words; for a parameter of a term, preceded by the name of the term."""
    term, _, own = name.rpartition(".")
    mechanism, _, place = term.partition("@")
    where = f" ({place})" if place else ""
    return f"{to_words(mechanism)}{where}: {to_words(own)}" if term else name
