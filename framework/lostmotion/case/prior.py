"""Prior distributions of parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal

from lostmotion.errors import CaseError

Scale = Literal["linear", "log"]
Kind = Literal["uniform", "log-uniform", "normal", "log-normal", "half-normal"]

_UNIT = NormalDist()
_FORMS = "low and high, mean and sd, median and sd_log, or half_sd alone"


@dataclass(frozen=True)
class Prior:
    """One of five prior densities of a parameter, in its unit; the given numbers select the density.

    `low` and `high`: uniform, or log-uniform with `scale = "log"`. `mean` and `sd`: normal. `median` and `sd_log`:
    log-normal, where `sd_log` is the standard deviation of the natural logarithm. `half_sd`: half-normal, the positive
    half of a normal density about zero with that standard deviation. `each`: one value for each recording.
    """

    low: float = -math.inf
    high: float = math.inf
    scale: Scale = "linear"
    mean: float | None = None
    sd: float | None = None
    median: float | None = None
    sd_log: float | None = None
    half_sd: float | None = None
    each: bool = False

    def __repr__(self) -> str:
        each = ", each=True" if self.each else ""
        forms: dict[Kind, str] = {
            "uniform": f"Uniform({self.low}, {self.high}",
            "log-uniform": f"LogUniform({self.low}, {self.high}",
            "normal": f"Normal({self.mean}, {self.sd}",
            "log-normal": f"LogNormal({self.median}, {self.sd_log}",
            "half-normal": f"HalfNormal({self.half_sd}",
        }
        return f"{forms[self.kind]}{each})"

    def __post_init__(self) -> None:
        self._check_pairs()
        for name in ("sd", "median", "sd_log", "half_sd"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise CaseError(f"has {name} = {value:g}: expected a positive one")
        if self.kind in ("uniform", "log-uniform"):
            self._check_span()

    def _check_pairs(self) -> None:
        for one, other in (("mean", "sd"), ("median", "sd_log")):
            if (getattr(self, one) is None) != (getattr(self, other) is None):
                raise CaseError(f"gives one of {one} and {other}: give both, or low and high")
        forms = [name for name in ("mean", "median", "half_sd") if getattr(self, name) is not None]
        bounded = math.isfinite(self.low) or math.isfinite(self.high) or self.scale == "log"
        if len(forms) + bounded > 1:
            other = forms[1] if len(forms) > 1 else "low, high or scale"
            raise CaseError(f"gives {forms[0]} besides {other}: give either one pair or the other ({_FORMS})")

    def _check_span(self) -> None:
        if not self.low < self.high:
            raise CaseError(f"has low = {self.low:g} and high = {self.high:g}: low must lie below high")
        if not math.isfinite(self.high - self.low):
            raise CaseError(f"has no finite low and high: give {_FORMS}")
        if self.scale == "log" and self.low <= 0:
            raise CaseError(f"has low = {self.low:g} on a log scale: low must be positive, or scale = 'linear'")

    @property
    def kind(self) -> Kind:
        """The name of the density."""
        if self.mean is not None:
            return "normal"
        if self.median is not None:
            return "log-normal"
        if self.half_sd is not None:
            return "half-normal"
        return "log-uniform" if self.scale == "log" else "uniform"

    @property
    def support(self) -> tuple[float, float]:
        """The interval outside of which the density is zero."""
        if self.kind in ("log-normal", "half-normal"):
            return 0.0, math.inf
        return self.low, self.high

    @property
    def bell(self) -> tuple[float, float] | None:
        """The mean and the standard deviation of the underlying normal density; None for a uniform prior.

        For a log-normal prior it is the density of the natural logarithm, for a half-normal prior that of both halves.
        """
        if self.mean is not None and self.sd is not None:
            return self.mean, self.sd
        if self.median is not None and self.sd_log is not None:
            return math.log(self.median), self.sd_log
        return None if self.half_sd is None else (0.0, self.half_sd)

    def log_density(self, value: float) -> float:
        """Return the natural logarithm of the normalised density at `value`; -inf outside the support."""
        low, high = self.support
        if not low <= value <= high or not math.isfinite(value):
            return -math.inf
        if self.kind == "uniform":
            return -math.log(high - low)
        if self.bell is None:
            return -math.log(value) - math.log(math.log(high / low))
        if self.kind == "log-normal":
            return _normal_log_density(math.log(value), *self.bell) - math.log(value) if value else -math.inf
        return _normal_log_density(value, *self.bell) + (math.log(2.0) if self.kind == "half-normal" else 0.0)

    def quantile(self, share: float) -> float:
        """Return the quantile of the distribution for a probability `share` from 0 to 1."""
        if self.kind == "uniform":
            return self.low + share * (self.high - self.low)
        if self.bell is None:
            return float(self.low ** (1.0 - share) * self.high**share)
        mean, sd = self.bell
        if self.kind == "half-normal":
            return sd * deviation(0.5 + 0.5 * share)
        value = mean + sd * deviation(share)
        return value if self.kind == "normal" else math.exp(value)

    def start(self) -> float:
        """Return the median, at which a fit starts."""
        if self.kind == "log-uniform":
            return math.sqrt(self.low) * math.sqrt(self.high)
        return self.quantile(0.5)


def _normal_log_density(value: float, mean: float, sd: float) -> float:
    return -0.5 * ((value - mean) / sd) ** 2 - math.log(sd) - 0.5 * math.log(2.0 * math.pi)


def deviation(share: float) -> float:
    """Return the quantile of the standard normal distribution, infinite at 0 and 1."""
    if 0.0 < share < 1.0:
        return _UNIT.inv_cdf(share)
    return math.inf if share >= 1.0 else -math.inf
