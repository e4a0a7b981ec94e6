"""What is believed of a parameter before the recording is seen."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from lostmotion.errors import CaseError

Scale = Literal["linear", "log"]


@dataclass(frozen=True)
class Prior:
    """Uniform or log-uniform between `low` and `high`, or normal with `mean` and `sd`, in the parameter's unit.

    A normal prior has the bounds -inf and inf.
    """

    low: float = -math.inf
    high: float = math.inf
    scale: Scale = "linear"
    mean: float | None = None
    sd: float | None = None

    def __post_init__(self) -> None:
        if (self.mean is None) != (self.sd is None):
            raise CaseError("gives one of mean and sd: give both, or low and high")
        if self.sd is not None:
            self._check_normal(self.sd)
        elif not self.low < self.high:
            raise CaseError(f"has low = {self.low:g} and high = {self.high:g}: low must lie below high")
        elif not math.isfinite(self.high - self.low):
            raise CaseError("has no finite low and high: give both, or mean and sd")
        elif self.scale == "log" and self.low <= 0:
            raise CaseError(f"has low = {self.low:g} on a log scale: low must be positive, or scale = 'linear'")

    def _check_normal(self, sd: float) -> None:
        if not sd > 0:
            raise CaseError(f"has sd = {sd:g}: wanted a positive one")
        if math.isfinite(self.low) or math.isfinite(self.high) or self.scale == "log":
            raise CaseError("gives mean and sd beside low, high or scale: give either one pair or the other")

    def log_density(self, value: float) -> float:
        """Return the natural logarithm of the normalised density at `value`; -inf outside the bounds."""
        if self.mean is not None and self.sd is not None:
            if not math.isfinite(value):
                return -math.inf
            return -0.5 * ((value - self.mean) / self.sd) ** 2 - math.log(self.sd) - 0.5 * math.log(2 * math.pi)
        if not self.low <= value <= self.high:
            return -math.inf
        if self.scale == "log":
            return -math.log(value) - math.log(math.log(self.high / self.low))
        return -math.log(self.high - self.low)

    def start(self) -> float:
        """Return the middle: geometric on a log scale, arithmetic on a linear one, the mean of a normal prior."""
        if self.mean is not None:
            return self.mean
        if self.scale == "log":
            return math.sqrt(self.low) * math.sqrt(self.high)
        return self.low + 0.5 * (self.high - self.low)
