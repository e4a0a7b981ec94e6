"""First-order lags: of what drives the machine, and of what measures it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, DriveTerm, Input, Param, SensorTerm, Values
from lostmotion.quantities import TIME

MEMORY = 40.0
"""A lag forgets what lies further back than so many time constants."""
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_BACK, _SHARES = np.polynomial.laguerre.laggauss(12)


@dataclass(frozen=True)
class ActuatorLag(DriveTerm):
    """An actuator of first order: the drive that acts follows the recorded one with a time constant."""

    at: str = "drive"
    name: ClassVar[str] = "actuator_lag"
    unlikely: ClassVar[float] = 1.5
    physics: ClassVar[str] = "The drive follows the recorded one with a time constant of {time}"
    formula: ClassVar[str] = "w,  time * w' = u - w"
    paper: ClassVar[str] = "Ogata, Modern Control Engineering (2010), section 5.2"
    params = (Param("time", "time constant of the actuator", TIME, low=0.0, null=0.0, scan=(0.02, 6.0)),)
    resembles = ("sensor_lag", "excitation_delay", "sensor_delay")

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        return lagged(u, t, p[0], order)


def lagged(u: Input, t: Array, tau: float, order: int) -> Array:
    """Return an input behind a lag of first order, or its derivative (`order` 1), at times `t` (s).

    It is the integral of exp(-s/tau) u(t - s)/tau over s > 0: by Laguerre's rule where tau is shorter than half the
    distance of the times, else from cell to cell by Legendre's rule.
    """
    if not tau > 0.0:
        return u(t, order)
    span = float(t.max()) - float(t.min())
    apart = span / max(t.size - 1, 1)
    if tau < 0.5 * apart or not span > 0.0:
        w = sum((share * u(t - tau * back, 0) for back, share in zip(_BACK, _SHARES, strict=True)), np.zeros(t.shape))
    else:
        w = _carried(u, t, tau, min(tau, 2.0 * apart))
    return np.asarray(w if order == 0 else (u(t, 0) - w) / tau)


def _carried(u: Input, t: Array, tau: float, step: float) -> Array:
    """Return the input behind the lag at times `t`, carried from cell to cell of a grid with this step (s)."""
    from scipy.signal import lfilter

    begin = math.floor((float(t.min()) - MEMORY * tau) / step) * step
    grid = np.asarray(begin + step * np.arange(math.ceil((float(t.max()) - begin) / step) + 1), dtype=float)
    kept, added = math.exp(-step / tau), _added(u, grid, np.full(len(grid), step), tau)
    first = float(u(grid[:1], 0)[0])
    carried, _ = lfilter([1.0], [1.0, -kept], added, zi=[kept * first])
    at_grid = np.concatenate([[first], carried[:-1]])
    cell = np.clip(((t - begin) / step).astype(int), 0, len(grid) - 1)
    past = t - grid[cell]
    return np.asarray(np.exp(-past / tau) * at_grid[cell] + _added(u, grid[cell], past, tau))


def _added(u: Input, start: Array, length: Array, tau: float) -> Array:
    """Return what an input adds to its lagged self over intervals that begin at `start` and have a `length` (s)."""
    total = np.zeros(start.shape)
    for node, weight in zip(_NODES.tolist(), _WEIGHTS.tolist(), strict=True):
        s = 0.5 * (1.0 + node) * length
        total += 0.5 * weight * length / tau * np.exp((s - length) / tau) * u(start + s, 0)
    return total


@dataclass(frozen=True)
class SensorLag(SensorTerm):
    """A sensor of first order: what it shows follows what is there with a time constant.

    What it shows is a state of its own. It is no faster than the finest step of the integration.
    """

    at: str = "sensor"
    channel: str = "position"
    name: ClassVar[str] = "sensor_lag"
    unlikely: ClassVar[float] = 1.5
    physics: ClassVar[str] = "The sensor follows what is there with a time constant of {time}"
    formula: ClassVar[str] = "w,  time * w' = z - w"
    paper: ClassVar[str] = "Ogata, Modern Control Engineering (2010), section 5.2"
    params = (Param("time", "time constant of the sensor", TIME, low=0.0, null=0.0, scan=(0.02, 6.0)),)
    states = ("shown",)
    needs = ("finest",)
    resembles = ("actuator_lag", "excitation_delay", "sensor_delay")

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        dsdt[0] = (x - s[0]) / max(p[0], p[1])
