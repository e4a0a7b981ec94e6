"""A field of a class of settings: the default of a threshold with its reason, its source and its allowed range."""

from __future__ import annotations

import math
from dataclasses import field
from typing import Any


def threshold(value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf) -> Any:
    """Return a dataclass field with its default, its reason, its source and its allowed range."""
    metadata = {"default": value, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=metadata)
