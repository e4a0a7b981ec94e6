"""A third set of labelled series, written after the rules; no limit was moved for it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from labelled_series import LabelledSeries, autoregressive, lines, noisy
from labelled_wide import GOLDEN, TURN, Draw, bent, duffing, iterated, settled

Array = NDArray[np.float64]


def chua(_t: float, y: Array) -> Array:
    """Return the rate of Chua's circuit (15.6, 28; -8/7, -5/7): the double scroll."""
    bend = -5.0 / 7.0 * y[0] - 1.5 / 7.0 * (abs(y[0] + 1.0) - abs(y[0] - 1.0))
    return np.array([15.6 * (y[1] - y[0] - bend), y[0] - y[1] + y[2], -28.0 * y[1]])


def halvorsen(_t: float, y: Array) -> Array:
    """Return the rate of Halvorsen's symmetric flow, a = 1.27: Sprott, Chaos and Time-Series Analysis (2003)."""
    a, b, c = y
    return np.array(
        [-1.27 * a - 4 * b - 4 * c - b * b, -1.27 * b - 4 * c - 4 * a - c * c, -1.27 * c - 4 * a - 4 * b - a * a]
    )


def nagumo(_t: float, y: Array) -> Array:
    """Return the rate of the FitzHugh-Nagumo oscillator on its limit cycle."""
    return np.array([y[0] - y[0] ** 3 / 3.0 - y[1] + 0.5, 0.08 * (y[0] + 0.7 - 0.8 * y[1])])


def swing(t: float, y: Array) -> Array:
    """Return the rate of a swing whose length changes at twice its frequency: it answers every two periods."""
    return np.array([y[1], -(1.0 + 0.4 * math.cos(2.0 * t)) * y[0] - 0.1 * y[1] - 0.1 * y[0] ** 3])


def pair(_t: float, y: Array) -> Array:
    """Return the rate of two van der Pol oscillators that are coupled weakly, and do not lock."""
    x, v, z, w = y
    pace = math.sqrt(2.0)
    return np.array(
        [v, 0.3 * (1 - x * x) * v - x + 0.1 * (z - x), w, 0.3 * (1 - z * z) * w - pace**2 * z + 0.1 * (x - z)]
    )


def garch(n: int) -> Draw:
    """Return a maker of noise whose size depends on its past (GARCH(1, 1)), behind a first-order filter."""

    def draw(rng: np.random.Generator) -> Array:
        e, x, h = rng.normal(size=n), np.zeros(n), 1.0
        for k in range(1, n):
            h = 0.05 + 0.15 * x[k - 1] ** 2 + 0.8 * h
            x[k] = math.sqrt(h) * e[k]
        return np.asarray(lfilter([1.0], [1.0, -0.8], x))

    return draw


def halves(n: int) -> Draw:
    """Return a maker of x' = (x + coin) / 2: noise, which backwards in time is the chaotic doubling map."""

    def draw(rng: np.random.Generator) -> Array:
        return np.asarray(lfilter([0.5], [1.0, -0.5], rng.integers(0, 2, n + 100).astype(float))[100:])

    return draw


def slipping(n: int) -> Draw:
    """Return a maker of a sine whose phase jumps at random, with noise."""

    def draw(rng: np.random.Generator) -> Array:
        jumps = np.where(rng.random(n) < 0.01, rng.uniform(-2.0, 2.0, n), 0.0)
        return np.asarray(np.sin(np.cumsum(0.2 + jumps)) + 0.02 * rng.normal(size=n))

    return draw


def bilinear(n: int) -> Draw:
    """Return a maker of a series in which noise multiplies the past."""

    def draw(rng: np.random.Generator) -> Array:
        e, x = rng.normal(size=n + 200), np.zeros(n + 200)
        for k in range(2, n + 200):
            x[k] = 1.2 * x[k - 1] - 0.7 * x[k - 2] + 0.2 * x[k - 1] * e[k - 1] + e[k]
        return x[200:]

    return draw


def starting(n: int) -> Draw:
    """Return a maker of an oscillation that excites itself from rest, with noise."""

    def draw(rng: np.random.Generator) -> Array:
        size = 1.0 / (1.0 + np.exp(-(np.arange(n) / n - 0.75) * 16.0))
        return np.asarray(size * np.sin(0.17 * np.arange(n) + rng.uniform(0.0, TURN)) + 0.003 * rng.normal(size=n))

    return draw


def _henon(y: Array) -> Array:
    return np.array([1.0 - 1.4 * y[0] ** 2 + 0.3 * y[1], y[0]])


def fresh_series(n: int = 10_000) -> list[LabelledSeries]:
    """Return series that were made after the rules were settled, with what each of them is."""
    hard = settled(duffing(12.0, 1.0, 0.1, 0.0), (2.0, 3.0), TURN / 50, n)
    beats = lines(((1.0, 1.0), (0.3, 1.0 + 0.1 * GOLDEN), (0.3, 1.0 - 0.1 * GOLDEN)), n, 0.031)
    ar2 = autoregressive((0.985 * np.exp(0.3j),), n)
    return [
        LabelledSeries("chua", "chaotic", settled(chua, (0.7, 0.0, 0.0), 0.06, n), 0.06),
        LabelledSeries("halvorsen 2 %", "chaotic", noisy(settled(halvorsen, (-5.0, 0.0, 0.0), 0.03, n), 0.02), 0.03),
        LabelledSeries("henon 3 %", "chaotic", noisy(iterated(_henon, (0.1, 0.1), n), 0.03), 1.0),
        LabelledSeries("ueda at 12, 2 %", "chaotic", noisy(hard, 0.02), TURN / 50, TURN),
        LabelledSeries("nagumo 3 %", "periodic", noisy(settled(nagumo, (0.0, 0.0), 0.9, n), 0.03), 0.9),
        LabelledSeries("parametric swing", "periodic", settled(swing, (1.0, 0.0), 0.11, n), 0.11, 0.5 * TURN),
        LabelledSeries("two van der pol", "quasiperiodic", settled(pair, (1.0, 0.0, 0.5, 0.0), 0.15, n), 0.15),
        LabelledSeries("beats 2 %", "quasiperiodic", noisy(beats, 0.02), 0.031),
        LabelledSeries("GARCH", "stochastic", garch(n), 0.01),
        LabelledSeries("halves", "stochastic", halves(n), 0.01),
        LabelledSeries("slipping sine", "stochastic", slipping(n), 0.01),
        LabelledSeries("bilinear", "stochastic", bilinear(n), 0.01),
        LabelledSeries("AR(2) behind a dead band", "stochastic", bent(ar2, lambda x: x - np.clip(x, -0.5, 0.5)), 0.01),
        LabelledSeries("AR(2) hardened", "stochastic", bent(ar2, lambda x: x + 0.3 * x**3), 0.01),
        LabelledSeries("exp of AR(2)", "stochastic", bent(ar2, np.exp), 0.01),
        LabelledSeries("self-excited start", "unsteady", starting(n), 0.01),
    ]  # fmt: skip
