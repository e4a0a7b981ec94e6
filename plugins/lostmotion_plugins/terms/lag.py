"""First-order lags of an actuator and of a sensor."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, DriveTerm, Input, Param, SensorTerm, TermPrior, Values
from lostmotion.quantities import TIME

_MEMORY = 40.0
"""Input that is older than so many time constants is neglected: its weight is exp(-40) = 4e-18."""
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_BACK, _SHARES = np.polynomial.laguerre.laggauss(12)


@dataclass(frozen=True)
class ActuatorLag(DriveTerm):
    """An actuator of first order: the drive that acts follows the recorded one with a time constant."""

    at: str = "drive"
    name: ClassVar[str] = "actuator_lag"
    physics: ClassVar[str] = "The drive follows the recorded one with a time constant of {time}"
    formula: ClassVar[str] = "w,  time * w' = u - w"
    paper: ClassVar[str] = "Ogata, Modern Control Engineering (2010), section 5.2"
    params = (
        Param("time", "time constant of the actuator", TIME, low=0.0, null=0.0, prior=TermPrior(scan=(0.02, 6.0))),
    )

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        return apply_lag(u, t, p[0], order)


def apply_lag(u: Input, t: Array, tau: float, order: int) -> Array:
    """Return an input after a first-order lag, or its derivative (`order` 1), at times `t` (s).

    It is the integral of exp(-s/tau) u(t - s)/tau over s > 0: by Gauss-Laguerre quadrature where tau is shorter than
    half the distance of the times, else from cell to cell of a grid by Gauss-Legendre quadrature.
    """
    if not tau > 0.0:
        return u(t, order)
    span = float(t.max()) - float(t.min())
    spacing = span / max(t.size - 1, 1)
    if tau < 0.5 * spacing or not span > 0.0:
        w = sum((share * u(t - tau * back, 0) for back, share in zip(_BACK, _SHARES, strict=True)), np.zeros(t.shape))
    else:
        w = _filter_on_grid(u, t, tau, min(tau, 2.0 * spacing))
    return np.asarray(w if order == 0 else (u(t, 0) - w) / tau)


def _filter_on_grid(u: Input, t: Array, tau: float, step: float) -> Array:
    """Return the input after the lag at times `t`, computed recursively on a grid with this step (s)."""
    from scipy.signal import lfilter

    begin = math.floor((float(t.min()) - _MEMORY * tau) / step) * step
    grid = np.asarray(begin + step * np.arange(math.ceil((float(t.max()) - begin) / step) + 1), dtype=float)
    kept, added = math.exp(-step / tau), _integrate_input(u, grid, np.full(len(grid), step), tau)
    first = float(u(grid[:1], 0)[0])
    carried, _ = lfilter([1.0], [1.0, -kept], added, zi=[kept * first])
    at_grid = np.concatenate([[first], carried[:-1]])
    cell = np.clip(((t - begin) / step).astype(int), 0, len(grid) - 1)
    past = t - grid[cell]
    return np.asarray(np.exp(-past / tau) * at_grid[cell] + _integrate_input(u, grid[cell], past, tau))


def _integrate_input(u: Input, start: Array, length: Array, tau: float) -> Array:
    """Return what the input in intervals from `start` with a `length` (s) adds to the lagged input at their ends."""
    total = np.zeros(start.shape)
    for node, weight in zip(_NODES.tolist(), _WEIGHTS.tolist(), strict=True):
        s = 0.5 * (1.0 + node) * length
        total += 0.5 * weight * length / tau * np.exp((s - length) / tau) * u(start + s, 0)
    return total


@dataclass(frozen=True)
class SensorLag(SensorTerm):
    """A sensor of first order: its output follows the true value with a time constant.

    The output is a state of its own. A time constant that is shorter than the finest step of the integration has no
    effect; a delay describes such a lag.
    """

    at: str = "sensor"
    channel: str = "position"
    name: ClassVar[str] = "sensor_lag"
    physics: ClassVar[str] = "The sensor follows the true value with a time constant of {time}"
    formula: ClassVar[str] = "w,  time * w' = z - w"
    paper: ClassVar[str] = "Ogata, Modern Control Engineering (2010), section 5.2"
    params = (Param("time", "time constant of the sensor", TIME, low=0.0, null=0.0, prior=TermPrior(scan=(0.02, 6.0))),)
    states = ("shown",)
    needs = ("finest",)

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        dsdt[0] = (x - s[0]) / max(p[0], p[1])
