"""A share with its confidence interval."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scipy.stats import beta

from lostmotion.codec import described

LEVEL = 0.95
"""The level of the confidence interval."""


@dataclass(frozen=True)
class Rate:
    """A share with its exact 95 % band (Clopper, Pearson 1934)."""

    hits: int = described("how many there are")
    of: int = described("of how many")
    share: float = described("the share; null of nothing")
    low: float = described("lower end of the 95 % band")
    high: float = described("upper end of the 95 % band")


def estimate_rate(hits: int, of: int) -> Rate:
    """Return a rate with its exact 95 % interval (Clopper, Pearson 1934); NaN without tries."""
    if not of:
        return Rate(0, 0, math.nan, math.nan, math.nan)
    tail = 0.5 * (1.0 - LEVEL)
    low = float(beta.ppf(tail, hits, of - hits + 1)) if hits else 0.0
    high = float(beta.ppf(1.0 - tail, hits + 1, of - hits)) if hits < of else 1.0
    return Rate(hits, of, hits / of, low, high)
