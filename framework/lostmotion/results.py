"""What the stages return: frozen, plain, and holding nothing that computes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Interval:
    """Median and central 95 % interval of a number, with its unit."""

    median: float
    low: float
    high: float
    unit: str

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high

    def as_dict(self) -> dict[str, Any]:
        """Return the four fields as they stand in `diagnosis.json`."""
        return {"median": self.median, "low": self.low, "high": self.high, "unit": self.unit}

    def __str__(self) -> str:
        return f"{self.median:.4g} {self.unit} [{self.low:.4g}, {self.high:.4g}]"


@dataclass(frozen=True)
class Embedding:
    """Delay `lag` (samples) and dimension `dim` of an embedding, with the curves they were read from."""

    lag: int
    dim: int
    curves: Mapping[str, Array] = field(default_factory=dict)
    status: str = "ok"


@dataclass(frozen=True)
class Estimate:
    """A number with its central 95 % interval, the curve it was read from, and a status in place of an exception."""

    value: float
    low: float
    high: float
    status: str
    unit: str = "1"
    curve: Mapping[str, Array] = field(default_factory=dict)
