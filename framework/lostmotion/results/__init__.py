"""The results of the stages: frozen dataclasses of plain values, without computations."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.codec import described

Array = NDArray[np.float64]
TINY = 1e-4
"""A share below this is told as less than it."""
SMALL, LARGE = 1e-5, 1e7
"""Between these a number is written with decimals, and else with a power of ten."""


def rounded(value: float, digits: int = 2) -> str:
    """Return a number with this many significant digits in decimal notation: 130, not 1.3e+02."""
    return f"{float(f'{value:.{digits}g}'):g}"


def percent(share: float, digits: int = 2) -> str:
    """Return a share in per cent, with so many significant digits, or as a whole number from 100 % on.

    One below `TINY` is said to be less than that.
    """
    if 0.0 < abs(share) < TINY:
        return f"less than {rounded(100.0 * TINY)} %"
    return f"{rounded(100.0 * share, digits)} %" if abs(share) < 1.0 else f"{100.0 * share:.0f} %"


def join_names(names: Sequence[str]) -> str:
    """Return names as they stand in a sentence: "a, b and c"."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def attach_unit(number: str, unit: str) -> str:
    """Return a number with its unit; a pure number, whose unit is 1, has none."""
    return number if unit == "1" else f"{number} {unit}"


def decimals_of(median: float, low: float, high: float, least: int) -> int:
    """Return the decimals that show `least` figures of a median and two of the width of its interval."""
    sizes = [abs(median) / 10.0 ** (least - 1)] if median and math.isfinite(median) else []
    width = high - low
    sizes += [width / 30.0] if math.isfinite(width) and width > 0.0 else []
    return min(15, max(0, *(-math.floor(math.log10(size)) for size in sizes))) if sizes else 0


DEGREES: Mapping[str, str] = {"rad": "deg", "rad/s": "deg/s", "rad/s^2": "deg/s^2"}
"""Units of angles in radians, with the corresponding units in degrees."""


@dataclass(frozen=True)
class Interval:
    """Median and central 95 % interval of a number, with its unit."""

    median: float = described("median")
    low: float = described("lower end of the central 95 % interval; null where it is withheld")
    high: float = described("upper end of the interval; null where it is withheld")
    unit: str = described("unit of these three values")
    withheld: str | None = described("why the interval is withheld, in a sentence", default=None)

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high

    def with_angles_in(self, angle: str) -> Interval:
        """Return the interval in degrees where `angle` is deg and its unit is one of an angle; else unchanged."""
        if angle != "deg" or self.unit not in DEGREES:
            return self
        median, low, high = (math.degrees(x) for x in (self.median, self.low, self.high))
        return replace(self, median=median, low=low, high=high, unit=DEGREES[self.unit])

    def __str__(self) -> str:
        if not SMALL <= abs(self.median) < LARGE:
            return f"{attach_unit(f'{self.median:.4g}', self.unit)} [{self.low:.4g}, {self.high:.4g}]"
        decimals = decimals_of(self.median, self.low, self.high, 4)
        median, low, high = (f"{value:.{decimals}f}" for value in (self.median, self.low, self.high))
        return f"{attach_unit(median, self.unit)} [{low}, {high}]"


STATUSES: Mapping[str, str] = {
    "ok": "the value and its interval may be used",
    "uncertain": "a value is given, but a condition for its interval does not hold",
    "too_short": "there are too few points for this method",
    "too_few_neighbours": "too few points are close enough to each other",
    "no_scaling_region": "the curve has no scaling region: no straight section from which a slope can be taken",
    "not_saturating": "the curve does not level off: there is no separation of scales, as with noise",
    "regular": "neighbouring states do not diverge: the motion is periodic or quasiperiodic",
    "rising": "the value keeps rising with the embedding dimension, as with noise",
    "below_noise": "the measurable effect is below the noise or the resolution of the sensor",
    "diverged": "the motion diverges",
    "jumps": "the force jumps, and the tangent flow across the jump is not computed",
    "failed": "the method failed",
    "too_stiff": "the fastest motion needs more and shorter steps than are taken",
}
"""The values of `status`, with their meanings."""


@dataclass(frozen=True)
class Embedding:
    """Delay `lag` (samples) and dimension `dim` of an embedding, with the curves they are based on.

    Points closer in time than `theiler` samples are not counted as neighbours. `methods` names how lag and dim were
    chosen; `says` is a sentence where `status` is not "ok".
    """

    lag: int
    dim: int
    theiler: int = 1
    curves: Mapping[str, Array] = field(default_factory=dict)
    methods: tuple[str, str] = ("given", "given")
    status: str = "ok"
    says: str = ""

    @property
    def window(self) -> int:
        """The number of samples that one delay vector spans."""
        return (self.dim - 1) * self.lag + 1


@dataclass(frozen=True)
class Estimate:
    """A value with its central 95 % interval, the curves it is based on, and a status instead of an exception.

    `status` is one of `STATUSES`; when it is not "ok", `says` explains it in a sentence, and `value` may be NaN.
    `details` are further numbers, such as the ends of the scaling region.
    """

    value: float
    low: float
    high: float
    status: str
    unit: str = "1"
    curve: Mapping[str, Array] = field(default_factory=dict)
    says: str = ""
    details: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def refused(
        cls,
        status: str,
        says: str,
        *,
        unit: str = "1",
        curve: Mapping[str, Array] | None = None,
        details: Mapping[str, float] | None = None,
    ) -> Estimate:
        """Return an estimate without a value; `status` and `says` give the reason."""
        nothing = float("nan")
        return cls(nothing, nothing, nothing, status, unit, curve or {}, says, details or {})

    @property
    def ok(self) -> bool:
        """Whether the value may be used."""
        return self.status == "ok"
