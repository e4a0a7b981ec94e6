"""Conversion of Lyapunov exponents between units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from lostmotion.errors import DataError, nearest
from lostmotion.results import Estimate

UNITS: Mapping[str, str] = {
    "1/s": "per second, of the natural logarithm",
    "bit/s": "per second, of the logarithm to base 2",
    "1/period": "per period, of the natural logarithm",
    "bit/period": "per period, of the logarithm to base 2",
}
"""The units of an exponent and their meaning: "bit" counts factors of 2, "1" factors of e."""


def exponent_in(estimate: Estimate, unit: str, *, period: float | None = None) -> Estimate:
    """Return an estimate in 1/s converted to another of `UNITS`; `period` is in s; curve and details are unchanged.

    With `period` = 1 / omega_0 and "bit/period" it is the bit per normalised time of Tjahjowidodo, Al-Bender and
    Van Brussel (2007).
    """
    if unit not in UNITS:
        raise DataError(f"an exponent has no unit {unit!r}{nearest(unit, UNITS)}: take one of {', '.join(UNITS)}")
    if estimate.unit != "1/s":
        raise DataError(f"the estimate is in {estimate.unit!r}: only one in '1/s' can be converted")
    time = 1.0
    if unit.endswith("period"):
        if period is None or not 0.0 < period < math.inf:
            raise DataError(f"{unit} needs a period in s above zero, and {period} was given")
        time = period
    factor = time / (math.log(2.0) if unit.startswith("bit") else 1.0)
    value, low, high = (factor * x for x in (estimate.value, estimate.low, estimate.high))
    return replace(estimate, value=value, low=low, high=high, unit=unit)
