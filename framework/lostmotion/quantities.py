"""Dimensions of parameters and units of recordings; pint is the only door to unit names."""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import Any, NamedTuple

from lostmotion.errors import DataError, nearest

SI = {
    "force": "N",
    "torque": "N m",
    "position": "m",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "base_position": "m",
    "base_acceleration": "m/s^2",
    "time": "s",
}
ANGULAR = {
    "position": "rad",
    "velocity": "rad/s",
    "acceleration": "rad/s^2",
    "base_position": "rad",
    "base_acceleration": "rad/s^2",
    "force": "N m",
    "torque": "N m",
}
ROTATES = dict.fromkeys(SI.values(), "translation") | dict.fromkeys(ANGULAR.values(), "rotation")
"""What motion a unit of a channel or an input belongs to."""
_NAMED: dict[tuple[str, float, float, float, float], str] = {
    ("translation", 1, -1, 2, 0): "kg",
    ("rotation", 1, -1, 2, 0): "kg m^2",
    ("rotation", 1, 0, 2, -2): "kg",
    ("translation", 0, 0, 0, 0): "1",
    ("rotation", 0, 0, 0, 0): "1",
    ("translation", 0, 0, -1, 0): "Hz",
    ("rotation", 0, 0, -1, 0): "Hz",
}


LONGEST = 60
"""Characters of a unit."""
_RAISED = re.compile(r"\*\*|\^")
_POWER = re.compile(r"[^\W\d_]\s*(?:\*\*|\^)\s*\(?\s*[+-]?\d(?:\.\d+)?(?![\d.])")
"""A unit to the power of one digit: pint would work out 9 ** 9 ** 9 as well, for hours."""


QUANTITIES = ("position", "velocity", "acceleration", "force")
"""What channels and inputs of a model can be."""


def quantity_of(name: str) -> str:
    """Return what a channel or an input is, by the last part of its name: "second_position" is a position.

    Parts are divided by `_` or `.`, and a torque is the force of a rotation. A plain name such as "x2" is that of a
    coordinate, which is a position; one that resembles a quantity raises `DataError`.
    """
    last = re.split(r"[_.]", name)[-1]
    if names_quantity(name):
        return "force" if last == "torque" else last
    if last.isidentifier() and not nearest(last, QUANTITIES):
        return "position"
    raise DataError(
        f"{name!r} ends in none of {', '.join(QUANTITIES)}{nearest(last, QUANTITIES)}: name it so, for instance"
        " 'second_position'"
    )


def names_quantity(name: str) -> bool:
    """Return whether the last part of a name is a quantity."""
    return re.split(r"[_.]", name)[-1] in (*QUANTITIES, "torque")


def unit_of(name: str, motion: str) -> str:
    """Return the SI unit of a channel or an input in a kind of motion: "rad/s^2" of an acceleration in rotation."""
    return (SI if motion == "translation" else ANGULAR)[quantity_of(name)]


class Dimension(NamedTuple):
    """Powers of generalised force, length and time: `Dimension(1, -1, 1)` is a damping coefficient.

    In rotation, force is torque and length is angle; `metre` counts the length of a lever beside them.
    """

    force: float = 0
    length: float = 0
    time: float = 0
    metre: float = 0

    def unit(self, motion: str) -> str:
        """Return the SI unit, for instance `N s/m` in translation and `N m s/rad` in rotation."""
        named = _NAMED.get((motion, *self))
        if named:
            return named
        symbols = ("N", "m", "s", "m") if motion == "translation" else ("N m", "rad", "s", "m")
        powers = list(zip(symbols, self, strict=True))
        above = [_power(s, n) for s, n in powers if n > 0] or ["1"]
        below = [_power(s, -n) for s, n in powers if n < 0]
        return " ".join(above) + ("/" + "/".join(below) if below else "")

    def scale(self, force: float, length: float, time: float) -> float:
        """Return the natural size of such a quantity from the natural sizes of force, length and time."""
        return float(force**self.force * length**self.length * time**self.time)


def _power(symbol: str, power: float) -> str:
    return symbol if power == 1 else f"{symbol}^{power:g}"


FORCE = Dimension(1, 0, 0)
LENGTH = Dimension(0, 1, 0)
TIME = Dimension(0, 0, 1)
SPEED = VELOCITY = Dimension(0, 1, -1)
INERTIA = Dimension(1, -1, 2)
DAMPING = Dimension(1, -1, 1)
STIFFNESS = Dimension(1, -1, 0)
NUMBER = Dimension(0, 0, 0)
FREQUENCY = Dimension(0, 0, -1)


_NEWTON_METRE = re.compile(r"(?<![^\W\d_])([kmM]?N)m(?!\w)")
"""Torques as they are mostly written, Nm, where pint reads numbers of metres."""
_GRAVITY = {"g": "g_0", "mg": "mg_0", "G": "g_0"}
"""How accelerations are written by those who make accelerometers, where pint reads grams."""


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def unit_powers(unit: str, motion: str) -> tuple[float, float, float, float]:
    """Return the powers of force, length, time and metre of a unit that is made of SI units without a factor.

    In rotation no power of an angle is told, since a radian is a number. `DataError` for any other unit.
    """
    if len(unit) > LONGEST or len(_POWER.findall(unit)) < len(_RAISED.findall(unit)):
        raise DataError(f"{unit[:LONGEST]!r} is no unit: write for instance 'N/m'")
    try:
        base = _registry().Quantity(1.0, _NEWTON_METRE.sub(r"\1 m", unit)).to_base_units()
    except Exception as err:  # pint fails in every way there is
        raise DataError(f"{unit!r} is not known as a unit: write for instance 'N/m'") from err
    powers = {name.strip("[]"): float(power) for name, power in base.dimensionality.items()}
    if strange := set(powers) - {"mass", "length", "time"}:
        raise DataError(f"{unit!r} is a unit of {sorted(strange)[0]}: wanted one of mechanics, for instance 'N/m'")
    if abs(float(base.magnitude) - 1.0) > 1e-9:
        raise DataError(f"{unit!r} is {base.magnitude:g} times the SI unit: numbers of a case are in SI, write 'N/m'")
    force, time = powers.get("mass", 0.0), powers.get("time", 0.0) + 2.0 * powers.get("mass", 0.0)
    if motion == "translation":
        return force, powers.get("length", 0.0) - force, time, 0.0
    return force, 0.0, time, powers.get("length", 0.0) - 2.0 * force


def si_factor(unit: str, quantity: str) -> tuple[float, str]:
    """Return the factor that turns `unit` into SI, and the SI unit, for a quantity such as "force" or "position".

    A length or an angle is taken for a position, a force or a torque for a force; anything else raises `DataError`.
    """
    if len(unit) > LONGEST or len(_POWER.findall(unit)) < len(_RAISED.findall(unit)):
        raise DataError(f"unit {unit[:LONGEST]!r} of the {quantity} is no unit: write for instance {SI[quantity]!r}")
    targets = tuple(dict.fromkeys((SI[quantity], ANGULAR.get(quantity, SI[quantity]))))
    if unit in targets:
        return 1.0, unit
    registry = _registry()
    unit = _NEWTON_METRE.sub(r"\1 m", unit)
    if quantity.endswith("acceleration"):
        unit = _GRAVITY.get(unit, unit)
    try:
        one = registry.Quantity(1.0, unit)
    except Exception as err:  # pint fails in every way there is
        raise DataError(f"unit {unit!r} of the {quantity} is not known: write for instance {SI[quantity]!r}") from err
    for target in targets:
        if one.is_compatible_with(target) and _angular(unit) == ("rad" in target):
            return _positive(float(one.to(target).magnitude), unit, quantity), target
    raise DataError(f"unit {unit!r} does not measure {quantity}: wanted one like {SI[quantity]!r}{_hint(unit)}")


def _hint(unit: str) -> str:
    return {
        "V": "; volts need factor = (N, m, ... per volt) and the unit that comes of it",
    }.get(unit, "")


def _positive(factor: float, unit: str, quantity: str) -> float:
    if not 0 < factor < math.inf:
        raise DataError(f"unit {unit!r} of the {quantity} comes to a factor of {factor:g}: wanted a positive one")
    return factor


def _angular(unit: str) -> bool:
    return any(word in unit.lower() for word in ("rad", "deg", "rev", "turn", "rpm", "°", "arc"))
