"""Dimensions of parameters and units of recordings. This is the only module that uses pint."""

from __future__ import annotations

import math
import re
import unicodedata
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
    "voltage": "V",
    "current": "A",
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
    "voltage": "V",
    "current": "A",
}
ROTATES = dict.fromkeys(SI.values(), "translation") | dict.fromkeys(ANGULAR.values(), "rotation")
"""The kind of motion to which the unit of a channel or an input belongs."""
_NAMED: dict[tuple[str | float, ...], str] = {
    ("translation", 1, -1, 2, 0, 0): "kg",
    ("rotation", 1, -1, 2, 0, 0): "kg m^2",
    ("rotation", 1, 0, 2, -2, 0): "kg",
    ("translation", 0, 0, 0, 0, 0): "1",
    ("rotation", 0, 0, 0, 0, 0): "1",
    ("translation", 0, 0, -1, 0, 0): "Hz",
    ("rotation", 0, 0, -1, 0, 0): "Hz",
    **{(motion, 1, 1, -1, 0, -1): "V" for motion in ("translation", "rotation")},
    **{(motion, 1, 1, -1, 0, -2): "ohm" for motion in ("translation", "rotation")},
    **{(motion, 1, 1, 0, 0, -2): "H" for motion in ("translation", "rotation")},
}


LONGEST = 60
"""The greatest number of characters of a unit."""
_RAISED = re.compile(r"\*\*|\^")
_POWER = re.compile(r"[^\W\d_]\s*(?:\*\*|\^)\s*\(?\s*[+-]?\d(?:\.\d+)?(?![\d.])")
"""A unit to a power of one digit. Other powers are refused: pint would compute 9 ** 9 ** 9 for hours."""


QUANTITIES = ("position", "velocity", "acceleration", "force", "voltage", "current")
"""The quantities of channels and inputs of a model."""


def quantity_of(name: str) -> str:
    """Return the quantity of a channel or an input from the last part of its name: "second_position" is a position.

    Parts are separated by `_` or `.`, and a torque counts as the force of a rotation. Another name, such as "x2", is a
    coordinate and therefore a position; a name that is almost a quantity (a typing error) raises `DataError`.
    """
    last = re.split(r"[_.]", name)[-1]
    if names_quantity(name):
        return "force" if last == "torque" else last
    if last.isidentifier() and not nearest(last, QUANTITIES):
        return "position"
    raise DataError(
        f"{name!r} ends in none of {', '.join(QUANTITIES)}{nearest(last, QUANTITIES)}: name it for instance"
        " 'second_position'"
    )


def names_quantity(name: str) -> bool:
    """Return whether the last part of a name is a quantity."""
    return re.split(r"[_.]", name)[-1] in (*QUANTITIES, "torque")


def unit_of(name: str, motion: str) -> str:
    """Return the SI unit of a channel or an input: "rad/s^2" for an acceleration where `motion` is "rotation"."""
    return (SI if motion == "translation" else ANGULAR)[quantity_of(name)]


def name_force(motion: str) -> str:
    """Return the word for a force of a kind of motion: "torque" where `motion` is "rotation"."""
    return "force" if motion == "translation" else "torque"


class Dimension(NamedTuple):
    """Powers of generalised force, length and time: `Dimension(1, -1, 1)` is a damping coefficient.

    In rotation, force means torque and length means angle; `metre` is the power of a length in m besides them, and
    `ampere` that of a current: a voltage is force times speed over current. `radian` tells an angular frequency (rad/s)
    from a frequency (Hz).
    """

    force: float = 0
    length: float = 0
    time: float = 0
    metre: float = 0
    ampere: float = 0
    radian: float = 0

    def unit(self, motion: str) -> str:
        """Return the SI unit, for instance `N s/m` in translation and `N m s/rad` in rotation."""
        named = _NAMED.get((motion, *self[:5]))
        if named and not self.radian:
            return named
        symbols = ("N", "m", "s", "m", "A", "rad") if motion == "translation" else ("N m", "rad", "s", "m", "A", "rad")
        powers = list(zip(symbols, self, strict=True))
        above = [_format_power(s, n) for s, n in powers if n > 0] or ["1"]
        below = [_format_power(s, -n) for s, n in powers if n < 0]
        return " ".join(above) + ("/" + "/".join(below) if below else "")

    def scale(self, force: float, length: float, time: float) -> float:
        """Return the natural size of a quantity of this dimension from the natural sizes of force, length and time."""
        return float(force**self.force * length**self.length * time**self.time)


def _format_power(symbol: str, power: float) -> str:
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
ANGULAR_FREQUENCY = Dimension(0, 0, -1, radian=1)
VOLTAGE = Dimension(1, 1, -1, 0, -1)
CURRENT = Dimension(0, 0, 0, 0, 1)
RESISTANCE = Dimension(1, 1, -1, 0, -2)
INDUCTANCE = Dimension(1, 1, 0, 0, -2)
FORCE_PER_CURRENT = Dimension(1, 0, 0, 0, -1)


_NEWTON_METRE = re.compile(r"(?<![^\W\d_])([kmM]?N)([cm]?m)(?!\w)")
"""Units of torque such as Nm, which pint would not read as newton metre."""
_GRAVITY = {"g": "g_0", "mg": "mg_0", "G": "g_0"}
"""Units of acceleration on accelerometers: g is the acceleration of gravity, where pint would read gram."""


_WORDS = {
    "degC": "degC", "°C": "degC", "g_n": "g_0", "gn": "g_0", "g0": "g_0", "Grad": "deg", "град": "deg", "рад": "rad",
    "U/min": "rpm", "1/min": "rpm", "min-1": "rpm", "min^-1": "rpm", "r/min": "rpm", "rev/min": "rpm", "RPM": "rpm",
    "об/мин": "rpm", "Umdr./min": "rpm", "秒": "s", "ミリ秒": "ms", "マイクロ秒": "us", "分": "min", "度": "deg",
    "сек": "s", "В": "V", "А": "A", "Н*м": "N m", "Нм": "N m", "Н м": "N m", "sec": "s", "msec": "ms", "usec": "us",
    "Volt": "V", "Volts": "V", "Newton": "N", "Newtons": "N", "Amp": "A", "Amps": "A", "Sekunde": "s", "Sekunden": "s",
    "gee": "g", "milli-g": "mg", "milli g": "mg", "in.": "inch",
    "m/s/s": "m/s^2", "mm/s/s": "mm/s^2", "rad/s/s": "rad/s^2", "gon": "grad",
    "rps": "rev/s", "dps": "deg/s", "deg/sec": "deg/s", "rad/sec": "rad/s", "m/sec": "m/s", "mm/sec": "mm/s",
    "ips": "inch/s", "mil": "thou", "mils": "thou", "microns": "micron", '"': "inch", "\u2033": "inch", "Å": "angstrom",
    "kp": "kgf", "dyn": "dyne", "kips": "kip", "rev": "turn", "turns": "turn", "rev/s": "turn/s",
    **dict.fromkeys(("lb ft", "lbf ft", "ft lb", "ft lbf", "ft lbs", "lbft", "ftlb"), "lbf*foot"),
    **dict.fromkeys(("lb in", "lbf in", "in lb", "in lbf", "in lbs", "lbin", "inlb"), "lbf*inch"),
    **dict.fromkeys(("oz in", "ozf in", "in oz", "in ozf", "ozin"), "ozf*inch"),
    **dict.fromkeys(("kgf cm", "kg cm", "kgcm", "kgfcm"), "kgf*cm"),
    **dict.fromkeys(("kgf m", "kgfm"), "kgf*m"), "N m": "N m",
    "毫米": "mm", "厘米": "cm", "微米": "um", "米": "m", "牛": "N", "牛顿": "N", "千牛": "kN", "毫秒": "ms",
    "微秒": "us", "牛米": "N m", "牛·米": "N m", "弧度": "rad", "转/分": "rpm", "ニュートン": "N", "ミリ": "mm",
}  # fmt: skip
_CYRILLIC = str.maketrans({"м": "m", "к": "k", "с": "s", "Н": "N", "н": "n", "г": "g"})
_TIMES = re.compile(r"(?<=[A-Za-z])[-.*·](?=[A-Za-z])")
"""The sign between two units that are multiplied, `lb-ft`."""
_TITLE = re.compile(r"\b[A-Z][a-z]{3,}")
"""A word with a capital at its beginning, `Millimeter`."""
_POWERS = re.compile(r"(?<=[a-zA-Zµ])(-?\d)(?!\w)")


@lru_cache(maxsize=512)
def spell_unit(unit: str) -> str:
    """Return a unit in the spelling of this module: `m/s2`, `m/s²` and `м/с²` become `m/s^2`, `U/min` becomes `rpm`."""
    text = unit.strip()
    for sign, plain in (("²", "^2"), ("³", "^3"), ("⁻¹", "^-1"), ("⋅", "*"), ("·", "*"), ("∙", "*"), ("μ", "µ")):
        text = text.replace(sign, plain)
    text = unicodedata.normalize("NFKC", text).replace("μ", "µ")
    text = _WORDS.get(_TIMES.sub(" ", text), _WORDS.get(text, text))
    text = _TITLE.sub(lambda found: found[0].lower(), text)
    text = text.replace("мк", "µ").translate(_CYRILLIC) if not text.isascii() and _is_cyrillic(text) else text
    text = text if text.startswith("g_0") else _POWERS.sub(r"^\1", text)
    return _WORDS.get(text, _NEWTON_METRE.sub(r"\1 \2", text))


def _is_cyrillic(text: str) -> bool:
    return any("\u0400" <= sign <= "\u04ff" for sign in text)


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def unit_powers(unit: str, motion: str) -> tuple[float, float, float, float]:
    """Return the powers of force, length, time and metre of a unit that consists of SI units without a factor.

    In rotation the power of the angle is zero, since a radian is a number. Any other unit raises `DataError`.
    """
    if len(unit) > LONGEST or len(_POWER.findall(unit)) < len(_RAISED.findall(unit)):
        raise DataError(f"{unit[:LONGEST]!r} is no unit: write for instance 'N/m'")
    try:
        base = _registry().Quantity(1.0, spell_unit(unit)).to_base_units()
    except Exception as err:  # pint raises many types of error
        raise DataError(f"{unit!r} is not known as a unit: write for instance 'N/m'") from err
    powers = {name.strip("[]"): float(power) for name, power in base.dimensionality.items()}
    if strange := set(powers) - {"mass", "length", "time"}:
        raise DataError(f"{unit!r} is a unit of {sorted(strange)[0]}: expected one of mechanics, for instance 'N/m'")
    if abs(float(base.magnitude) - 1.0) > 1e-9:
        raise DataError(f"{unit!r} is {base.magnitude:g} times the SI unit: numbers of a case are in SI, write 'N/m'")
    force, time = powers.get("mass", 0.0), powers.get("time", 0.0) + 2.0 * powers.get("mass", 0.0)
    if motion == "translation":
        return force, powers.get("length", 0.0) - force, time, 0.0
    return force, 0.0, time, powers.get("length", 0.0) - 2.0 * force


def si_factor(unit: str, quantity: str) -> tuple[float, str]:
    """Return the factor that turns `unit` into SI, and the SI unit, for a quantity such as "force" or "position".

    A position may have a unit of length or angle, a force a unit of force or torque; any other raises `DataError`.
    """
    if len(unit) > LONGEST or len(_POWER.findall(unit)) < len(_RAISED.findall(unit)):
        raise DataError(f"unit {unit[:LONGEST]!r} of the {quantity} is no unit: write for instance {SI[quantity]!r}")
    targets = tuple(dict.fromkeys((SI[quantity], ANGULAR.get(quantity, SI[quantity]))))
    if unit in targets:
        return 1.0, unit
    registry = _registry()
    unit = spell_unit(unit)
    if quantity.endswith("acceleration"):
        unit = _GRAVITY.get(unit, unit)
    try:
        one = registry.Quantity(1.0, unit)
    except Exception as err:  # pint raises many types of error
        raise DataError(f"unit {unit!r} of the {quantity} is not known: write for instance {SI[quantity]!r}") from err
    for target in targets:
        if one.is_compatible_with(target) and _is_angular(unit) == ("rad" in target):
            return _require_positive(float(one.to(target).magnitude), unit, quantity), target
    raise DataError(f"unit {unit!r} does not measure {quantity}: expected one like {SI[quantity]!r}{_unit_hint(unit)}")


def _unit_hint(unit: str) -> str:
    return {
        "V": "; volts need factor = (N, m, ... per volt) and the unit that results",
    }.get(unit, "")


def _require_positive(factor: float, unit: str, quantity: str) -> float:
    if not 0 < factor < math.inf:
        raise DataError(f"unit {unit!r} of the {quantity} comes to a factor of {factor:g}: expected a positive one")
    return factor


def _is_angular(unit: str) -> bool:
    return any(word in unit.lower() for word in ("rad", "deg", "rev", "turn", "rpm", "°", "arc"))
