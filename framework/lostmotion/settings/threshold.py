"""A field of a class of settings: the default of a threshold with its reason, source, unit and allowed range."""

from __future__ import annotations

import math
from dataclasses import field
from typing import Any


def threshold(
    value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf, *, unit: str = "1"
) -> Any:
    """Return a dataclass field with its default, its reason, its source, its allowed range and its unit.

    The unit is SI, "1" for a share or another pure number, "nat" for a difference of log-likelihoods, "sd" for a number
    of standard deviations or errors.
    """
    metadata = {"default": value, "unit": unit, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=metadata)
