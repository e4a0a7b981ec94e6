"""Ours against a plain NumPy/SciPy version in one run: absolute times are noise on a shared machine, ratios are not."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """One comparison: `ours` and `plain` take nothing and return a result; `goal` is the time (s) that is wanted."""

    name: str
    ours: Callable[[], Any]
    plain: Callable[[], Any] | None
    goal: float | None = None


def clocked(work: Callable[[], Any], repeats: int) -> float:
    """Return the median time (s) of some runs, after one that compiles and warms up."""
    work()
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return float(np.median(times))


def ratio_of(ours: Callable[[], Any], plain: Callable[[], Any], *, rounds: int = 5, budget: float = 6.0) -> float:
    """Return the least processor time of ours over that of the plain version, after one run of each that warms up.

    They run in turn, so that a machine that is busy for a while is busy for both. Processor time counts all threads of
    this process and nothing of others. Within the `budget` (s) there are so many `rounds`, and one at least.
    """
    ours()
    best, spent, turns = [float("inf"), float("inf")], 0.0, 0
    while turns < 1 or (turns < rounds and spent < budget):
        for i, work in enumerate((ours, plain)):
            begin = time.process_time()
            work()
            took = time.process_time() - begin
            best[i], spent = min(best[i], took), spent + took
        turns += 1
    return best[0] / best[1]


@lru_cache(maxsize=4)
def lorenz(n: int = 20_000, dt: float = 0.02, seed: int = 0) -> Array:
    """Return x (n,) of the Lorenz system (10, 28, 8/3), transient cut off, by DOP853 at 1e-10."""

    def rates(_: float, y: Array) -> list[float]:
        return [10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3.0 * y[2]]

    start = np.array([1.0, 1.0, 20.0]) + np.random.default_rng(seed).normal(size=3)
    times = 50.0 + dt * np.arange(n)
    solved = solve_ivp(rates, (0.0, times[-1]), start, "DOP853", t_eval=times, rtol=1e-10, atol=1e-10)
    return np.ascontiguousarray(solved.y[0])
