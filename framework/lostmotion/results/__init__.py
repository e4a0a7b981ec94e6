"""What the stages return: frozen, plain, and holding nothing that computes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.codec import described

Array = NDArray[np.float64]
TINY = 1e-4
"""A share below this is told as less than it."""
SMALL, LARGE = 1e-5, 1e7
"""Between these a number is written with decimals, and else with a power of ten."""


def rounded(value: float, digits: int = 2) -> str:
    """Return a number with so many digits as people write it: 130, and not 1.3e+02."""
    return f"{float(f'{value:.{digits}g}'):g}"


def percent(share: float, digits: int = 2) -> str:
    """Return a share in per cent, with so many digits or, from one on, whole; a tiny one is said to be less."""
    if 0.0 < abs(share) < TINY:
        return f"less than {rounded(100.0 * TINY)} %"
    return f"{rounded(100.0 * share, digits)} %" if abs(share) < 1.0 else f"{100.0 * share:.0f} %"


def decimals_of(median: float, low: float, high: float, least: int) -> int:
    """Return the decimals that show `least` figures of a median and two of the width of its interval."""
    sizes = [abs(median) / 10.0 ** (least - 1)] if median and math.isfinite(median) else []
    width = high - low
    sizes += [width / 30.0] if math.isfinite(width) and width > 0.0 else []
    return min(15, max(0, *(-math.floor(math.log10(size)) for size in sizes))) if sizes else 0


DEGREES: Mapping[str, str] = {"rad": "deg", "rad/s": "deg/s", "rad/s^2": "deg/s^2"}
"""Units of angles and what they are in degrees."""


@dataclass(frozen=True)
class Interval:
    """Median and central 95 % interval of a number, with its unit."""

    median: float = described("median")
    low: float = described("lower end of the central 95 % interval; null where it is withheld")
    high: float = described("upper end of it; null where it is withheld")
    unit: str = described("unit of the three")
    withheld: str | None = described("why the interval is withheld, in a sentence", default=None)

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high

    @classmethod
    def of(cls, told: Mapping[str, Any]) -> Interval:
        """Return the interval that an entry of a result tells; bounds that are withheld are NaN."""
        low, high = (float("nan") if told.get(end) is None else float(told[end]) for end in ("low", "high"))
        return cls(float(told["median"]), low, high, str(told.get("unit", "1")))

    def as_dict(self) -> dict[str, Any]:
        """Return the four fields as they stand in `diagnosis.json`."""
        return {"median": self.median, "low": self.low, "high": self.high, "unit": self.unit}

    def with_angles_in(self, angle: str) -> Interval:
        """Return the interval in degrees where `angle` is deg and its unit one of an angle; else as it is."""
        if angle != "deg" or self.unit not in DEGREES:
            return self
        median, low, high = (math.degrees(x) for x in (self.median, self.low, self.high))
        return replace(self, median=median, low=low, high=high, unit=DEGREES[self.unit])

    def __str__(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        if not SMALL <= abs(self.median) < LARGE:
            return f"{self.median:.4g}{unit} [{self.low:.4g}, {self.high:.4g}]"
        decimals = decimals_of(self.median, self.low, self.high, 4)
        median, low, high = (f"{value:.{decimals}f}" for value in (self.median, self.low, self.high))
        return f"{median}{unit} [{low}, {high}]"


STATUSES: Mapping[str, str] = {
    "ok": "the number and its interval may be used",
    "uncertain": "a number is given, but a condition for its interval does not hold",
    "too_short": "there are too few points for this method",
    "too_few_neighbours": "too few points come close enough to one another",
    "no_scaling_region": "the curve has no straight piece to read a slope from",
    "not_saturating": "the curve does not level off: no separation of scales, as noise has it",
    "regular": "near states do not part: the motion is periodic or quasiperiodic",
    "rising": "the value keeps rising with the embedding dimension, as that of noise does",
    "below_noise": "what could be measured lies below the noise or the resolution of the sensor",
    "diverged": "the motion runs away",
    "jumps": "the force jumps, and the tangent flow across the jump is not treated",
    "failed": "the method broke down",
    "too_stiff": "the fastest motion asks for more and shorter steps than are taken",
}
"""What may be wrong with a number, in words: the vocabulary of `status`."""


@dataclass(frozen=True)
class Embedding:
    """Delay `lag` (samples) and dimension `dim` of an embedding, with the curves they were read from.

    Points closer in time than `theiler` samples are no neighbours. `methods` says how lag and dim were chosen,
    `says` is a sentence where `status` is not "ok".
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
        """The samples that one delay vector spans."""
        return (self.dim - 1) * self.lag + 1


@dataclass(frozen=True)
class Estimate:
    """A number with its central 95 % interval, the curves it was read from, and a status in place of an exception.

    `status` is one of `STATUSES`; when it is not "ok", `says` is a sentence for people, and `value` may be NaN.
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
        """Return an estimate without a number: `status` and `says` stand in its place."""
        nothing = float("nan")
        return cls(nothing, nothing, nothing, status, unit, curve or {}, says, details or {})

    @property
    def ok(self) -> bool:
        """Whether the number may be used."""
        return self.status == "ok"
