"""Pieces that the laws of several models and terms share. They are compiled into each law that calls them."""

from __future__ import annotations

import math
from collections.abc import Mapping

from lostmotion.parts import Param
from lostmotion.quantities import NUMBER

PHASE = Param("phase", "phase in rad", NUMBER)


def subtract_gap(x: float, half_gap: float) -> float:
    """Return how far `x` lies beyond the gap |x| < `half_gap`, with the sign of `x`; 0 inside the gap."""
    return x - half_gap if x > half_gap else (x + half_gap if x < -half_gap else 0.0)


def resist_sliding(v: float, level: float, width: float) -> float:
    """Return dry friction of size `level` against the velocity `v`: a line through zero where |v| < `width`."""
    if abs(v) >= width:
        return -level if v > 0.0 else (level if v < 0.0 else 0.0)
    return -level * v / width


def describe_wave(size: Param, cosine: float, sine: float) -> Mapping[Param, float]:
    """Return the amplitude of a wave as the number `size`, and its phase (rad): size * cos(angle + phase)."""
    return {size: math.hypot(cosine, sine), PHASE: math.atan2(-sine, cosine)}
