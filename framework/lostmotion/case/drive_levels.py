"""Levels of a drive with measures of chaos, entered in the case where no recording is available."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, cast

from lostmotion.case.fields import Fields
from lostmotion.errors import DataError
from lostmotion.quantities import si_factor

Motion = Literal["periodic", "chaotic"]
LEVEL = ("amplitude", "unit", "frequency", "omega", "name", "motion", "lyapunov", "d2")
MEASURED = ("value", "sd", "low", "high")
UNITS = {"1/s": 1.0, "bit/s": math.log(2.0)}
"""The factors that convert an exponent to 1/s, base e."""
WIDTH = 2.0 * 1.959963984540054
"""The width of a 95 % interval in standard deviations of a normal distribution."""


@dataclass(frozen=True)
class Measured:
    """A measured quantity and its standard deviation; an exponent in 1/s, base e."""

    value: float
    sd: float


@dataclass(frozen=True)
class Level:
    """One level of a sinusoidal drive, `amplitude` (N, N m, m or rad, as `unit` says) and `omega` (rad/s).

    The results measured there, as far as known: kind of motion, largest Lyapunov exponent, correlation dimension.
    """

    name: str
    amplitude: float
    omega: float
    motion: Motion | None = None
    lyapunov: Measured | None = None
    d2: Measured | None = None
    unit: str = "N"


def levels_of(top: Fields) -> tuple[Level, ...]:
    """Return the levels of a case, with unique names; none where it has no [[levels]]."""
    if "levels" not in top.values:
        return ()
    return tuple(_number_names([_read_level(fields) for fields in top.tables("levels")]))


def _read_level(fields: Fields) -> Level:
    fields.only(LEVEL)
    amplitude, unit = fields.positive("amplitude"), fields.text("unit")
    factor, si = _read_drive_unit(fields, unit)
    level = Level(
        name=fields.maybe_text("name") or f"{amplitude:g} {unit}",
        amplitude=amplitude * factor,
        omega=_read_omega(fields),
        motion=cast(Motion, fields.choice("motion", ("periodic", "chaotic"))) if "motion" in fields.values else None,
        lyapunov=_read_exponent(fields),
        d2=_read_dimension(fields),
        unit=si,
    )
    if level.motion is None and level.lyapunov is None and level.d2 is None:
        raise fields.error("has none of motion, lyapunov and d2: give what was measured at this level")
    return level


def _read_drive_unit(fields: Fields, unit: str) -> tuple[float, str]:
    """Return the factor and the SI unit of a drive, which is a force, a torque or a motion of the base."""
    try:
        return si_factor(unit, "force")
    except DataError:
        pass
    try:
        return si_factor(unit, "base_position")
    except DataError as err:
        raise fields.error(
            f"has unit = {unit!r}: expected the unit of a force (N, N m) or of a base motion (m, rad, deg)"
        ) from err


def _read_omega(fields: Fields) -> float:
    """Return the angular frequency of the drive in rad/s."""
    if ("frequency" in fields.values) == ("omega" in fields.values):
        found = "both frequency and omega" if "omega" in fields.values else "neither frequency nor omega"
        raise fields.error(f"has {found}: give one, frequency in Hz or omega in rad/s")
    return fields.positive("omega") if "omega" in fields.values else 2.0 * math.pi * fields.positive("frequency")


def _read_exponent(fields: Fields) -> Measured | None:
    if "lyapunov" not in fields.values:
        return None
    table = fields.table("lyapunov").only((*MEASURED, "unit"))
    factor = UNITS[table.choice("unit", UNITS)] if "unit" in table.values else 1.0
    found = _read_measured(table)
    return Measured(found.value * factor, found.sd * factor)


def _read_dimension(fields: Fields) -> Measured | None:
    if "d2" not in fields.values:
        return None
    table = fields.table("d2").only(MEASURED)
    if table.number("value") < 0:
        raise table.wrong("value", "a dimension, which is not negative")
    return _read_measured(table)


def _read_measured(table: Fields) -> Measured:
    """Return a value with its standard deviation, which is given or computed from a 95 % interval."""
    value, interval = table.number("value"), {"low", "high"} & table.values.keys()
    if bool(interval) == ("sd" in table.values) or len(interval) == 1:
        found = ", ".join(key for key in MEASURED[1:] if key in table.values) or "no error"
        raise table.error(f"has {found} besides the value: give sd, or low and high of a 95 % interval")
    if not interval:
        return Measured(value, table.positive("sd"))
    low, high = table.number("low"), table.number("high")
    if not low <= value <= high or low == high:
        raise table.error(
            f"has value = {value:g} with low = {low:g} and high = {high:g}: the value must lie between them"
        )
    return Measured(value, (high - low) / WIDTH)


def _number_names(levels: list[Level]) -> Iterator[Level]:
    """Yield the levels with unique names: a repeated name gets a number."""
    taken: set[str] = set()
    for level in levels:
        name, k = level.name, 1
        while name in taken:
            k += 1
            name = f"{level.name} {k}"
        taken.add(name)
        yield replace(level, name=name)
