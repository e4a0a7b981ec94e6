"""Rules for noises of sensors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from lostmotion.contracts import Array, NoiseBlock, SensorScales
from lostmotion.testing.rules import rule

SENSORS = (SensorScales(-7.0, 0.01, 0.4, 1e-3, 0.05, 10.0), SensorScales(-2.0, 30.0, 5.0, 0.5, 3.0, 4e3))
"""A displacement of a centimetre at 1 kHz, and slow readings of 30 units."""
_LEAST = -1e-9


def _list_blocks(component: Any) -> list[NoiseBlock]:
    """Return the blocks at the starts and at the bounds of the parameters."""
    blocks = []
    for sensor in SENSORS:
        levels = component.parameters(sensor)
        for row in zip(*((q.start, q.low, q.high) for q in levels), strict=True) if levels else [()]:
            blocks.append(component.covariance(tuple(math.exp(number) for number in row), sensor.dt))
    return blocks


@rule("noise")
def parameters_have_bounds(component: Any) -> str:
    """Begin the name of each parameter with "log_noise", and let low <= start <= high, all finite logarithms."""
    for sensor in SENSORS:
        for q in component.parameters(sensor):
            if not q.name.startswith("log_noise") and q.name != "log_slow_noise":
                return f"a parameter is called {q.name!r}"
            if not -math.inf < q.low <= q.start <= q.high < math.inf or not q.low < q.high:
                return f"{q.name} starts at {q.start} between {q.low} and {q.high}"
    return ""


@rule("noise")
def matrices_have_the_size_of_the_states(component: Any) -> str:
    """Return `shown` (m,) and matrices (m, m) of finite numbers for m states; without states leave them out."""
    m = len(component.states)
    for block in _list_blocks(component):
        shapes = [np.shape(block.shown)] + [np.shape(a) for a in (block.transition, block.driving, block.first)]
        if shapes != [(m,), (m, m), (m, m), (m, m)]:
            return f"the shapes are {shapes} for {m} states"
        numbers: list[Array] = [block.shown, block.transition, block.driving, block.first]
        if not all(np.isfinite(a).all() for a in numbers) or not math.isfinite(block.white + block.clock):
            return "a number is not finite"
    return ""


@rule("noise")
def variances_are_not_negative(component: Any) -> str:
    """Return symmetric covariances without negative eigenvalues, and variances of at least zero."""
    for block in _list_blocks(component):
        if min(block.white, block.clock) < 0.0:
            return "a variance is negative"
        for name in ("driving", "first"):
            matrix = np.asarray(getattr(block, name))
            size = float(np.abs(matrix).max(initial=0.0))
            if not np.allclose(matrix, matrix.T, atol=1e-12 * size):
                return f"{name} is not symmetric"
            if matrix.size and float(np.linalg.eigvalsh(matrix).min()) < _LEAST * size:
                return f"{name} has a negative eigenvalue"
    return ""


@rule("noise")
def variance_does_not_explode(component: Any) -> str:
    """Let the states fade, or at most walk: no eigenvalue of `transition` is larger than one."""
    for block in _list_blocks(component):
        sizes = np.abs(np.linalg.eigvals(block.transition)) if len(block.shown) else np.zeros(0)
        if np.any(sizes > 1.0 + 1e-9):
            return f"transition has an eigenvalue of size {sizes.max():.6g}"
    return ""
