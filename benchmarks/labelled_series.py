"""Series whose nature is known, for the verdict of `analyse`: made by integrators that share nothing with ours."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Array = NDArray[np.float64]
CASE_1 = (1.0, 8.0, 4e4, 0.005, 40.0)
"""m (kg), c (N s/m), k0 (N/m), x0 (m), omega (rad/s) of the oscillator with backlash; Table 1 of the paper, case 1."""


@dataclass(frozen=True)
class LabelledSeries:
    """A series by name, what it is, its sampling step (s), and the period (s) of its drive if it has one."""

    name: str
    nature: str
    draw: Callable[[np.random.Generator], Array]
    dt: float
    period: float | None = None


@numba.njit(cache=True)
def backlash(numbers, amplitude, start, per_period, keep):  # type: ignore[no-untyped-def]
    """Return the position (keep,) after 300 periods of transient, `per_period` samples a period, by fine leapfrog."""
    m, c, k0, x0, omega = numbers
    fine = max(1, 4000 // per_period)
    h = 2.0 * math.pi / omega / (per_period * fine)
    x, v = start
    out = np.empty(keep)
    transient = 300 * per_period
    t = 0.0
    for i in range(transient + keep):
        if i >= transient:
            out[i - transient] = x
        for j in range(fine):
            t = (i * fine + j) * h
            x += 0.5 * h * v
            contact = k0 * (x - min(max(x, -x0), x0))
            push = amplitude * math.cos(omega * (t + 0.5 * h)) - contact
            v = (v * (1.0 - 0.5 * h * c / m) + h * push / m) / (1.0 + 0.5 * h * c / m)
            x += 0.5 * h * v
    return out


@numba.njit(cache=True)
def roessler(n, dt, start, transient):  # type: ignore[no-untyped-def]
    """Return x (n,) of the Roessler system (0.2, 0.2, 5.7) by RK4 in steps of dt / 20."""
    y = start.copy()
    k = np.zeros((4, 3))
    out = np.empty(n)
    h = dt / 20
    for i in range(transient + n):
        if i >= transient:
            out[i - transient] = y[0]
        for _ in range(20):
            for s in range(4):
                w = y.copy()
                if s == 1 or s == 2:
                    w = y + 0.5 * h * k[s - 1]
                elif s == 3:
                    w = y + h * k[2]
                k[s, 0] = -w[1] - w[2]
                k[s, 1] = w[0] + 0.2 * w[1]
                k[s, 2] = 0.2 + w[2] * (w[0] - 5.7)
            y = y + h / 6.0 * (k[0] + 2.0 * k[1] + 2.0 * k[2] + k[3])
    return out


def lin(amplitude: float, per_period: int, n: int) -> Callable[[np.random.Generator], Array]:
    """Return a maker of the position of the oscillator with backlash under a drive of `amplitude` (N)."""

    def draw(rng: np.random.Generator) -> Array:
        start = (rng.uniform(-0.01, 0.01), rng.uniform(-0.5, 0.5))
        return np.asarray(backlash(CASE_1, amplitude, start, per_period, n))

    return draw


def noisy(maker: Callable[[np.random.Generator], Array], share: float) -> Callable[[np.random.Generator], Array]:
    """Return a maker with white noise of `share` of the standard deviation on top."""

    def draw(rng: np.random.Generator) -> Array:
        x = maker(rng)
        return x + share * np.std(x) * rng.normal(size=len(x))

    return draw


def quantised(maker: Callable[[np.random.Generator], Array], bits: int) -> Callable[[np.random.Generator], Array]:
    """Return a maker as seen by a converter of so many bits."""

    def draw(rng: np.random.Generator) -> Array:
        x = maker(rng)
        step = np.ptp(x) / 2**bits
        return np.asarray(step * np.round(x / step))

    return draw


def autoregressive(poles: tuple[complex, ...], n: int) -> Callable[[np.random.Generator], Array]:
    """Return a maker of linear Gaussian noise with these poles (and their conjugates)."""
    both = [z for p in poles for z in ({p, complex(p).conjugate()})]
    filt = np.real(np.poly(both))

    def draw(rng: np.random.Generator) -> Array:
        return np.asarray(lfilter([1.0], filt, rng.normal(size=n + 2000))[2000:])

    return draw


def lines(parts: tuple[tuple[float, float], ...], n: int, dt: float) -> Callable[[np.random.Generator], Array]:
    """Return a maker of a sum of sines, (amplitude, frequency in Hz), with random phases."""

    def draw(rng: np.random.Generator) -> Array:
        t = dt * np.arange(n)
        return np.sum([a * np.sin(2 * np.pi * (f * t + rng.uniform())) for a, f in parts], axis=0)

    return draw


def summed(*makers: Callable[[np.random.Generator], Array]) -> Callable[[np.random.Generator], Array]:
    """Return a maker of the sum of series."""

    def draw(rng: np.random.Generator) -> Array:
        return np.sum([m(rng) for m in makers], axis=0)

    return draw


def _shaped(maker: Callable[[np.random.Generator], Array]) -> Callable[[np.random.Generator], Array]:
    def draw(rng: np.random.Generator) -> Array:
        x = maker(rng)
        return np.sinh(1.5 * x / np.std(x))

    return draw


def surrogate(maker: Callable[[np.random.Generator], Array]) -> Callable[[np.random.Generator], Array]:
    """Return a maker of noise with the spectrum and, nearly, the values of a series: amplitude-adjusted twice."""

    def draw(rng: np.random.Generator) -> Array:
        x = maker(rng)
        wanted, ranks = np.abs(np.fft.rfft(x)), np.sort(x)
        y = rng.permutation(x)
        for _ in range(60):
            z = np.fft.irfft(wanted * np.exp(1j * np.angle(np.fft.rfft(y))), len(x))
            y = ranks[np.argsort(np.argsort(z))]
        return np.asarray(y)

    return draw


def scaled(maker: Callable[[np.random.Generator], Array], size: float) -> Callable[[np.random.Generator], Array]:
    """Return a maker of a series with this standard deviation."""

    def draw(rng: np.random.Generator) -> Array:
        x = maker(rng)
        return np.asarray(size * x / np.std(x))

    return draw


def _roessler(n: int, dt: float) -> Callable[[np.random.Generator], Array]:
    return lambda rng: np.asarray(roessler(n, dt, np.array([1.0, 1.0, 0.0]) + rng.normal(size=3), 2000))


def rule_series(n: int = 10_000) -> list[LabelledSeries]:
    """Return the series with what each of them is."""
    period = 2 * math.pi / CASE_1[4]
    fifty, two = period / 50, period / 200
    chaos, twist = lin(100.0, 50, n), lin(100.0 * 2.0 / 2.6, 50, n)
    near = autoregressive((0.97 * np.exp(0.3j),), n)
    tone = lines(((1.0, 1.0),), n, 0.0213)
    golden = (math.sqrt(5) - 1) / 2
    torus = lines(((1.0, 1.0), (0.6, golden), (0.2, 1.0 + golden), (0.1, 2.0 - golden)), n, 0.02)
    return [
        LabelledSeries("lin chaos", "chaotic", chaos, fifty, period),
        LabelledSeries("lin chaos 200", "chaotic", lin(100.0, 200, 2 * n), two, period),
        LabelledSeries("lin chaos 2 %", "chaotic", noisy(chaos, 0.02), fifty, period),
        LabelledSeries("lin chaos 5 %", "chaotic", noisy(chaos, 0.05), fifty, period),
        LabelledSeries("lin chaos 10 %", "chaotic", noisy(chaos, 0.10), fifty, period),
        LabelledSeries("lin chaos 8 bit", "chaotic", quantised(chaos, 8), fifty, period),
        LabelledSeries("lin 1/alpha 5", "chaotic", lin(40.0, 50, n), fifty, period),
        LabelledSeries("lin 1/alpha 9.3", "chaotic", lin(200.0 / 9.3, 50, n), fifty, period),
        LabelledSeries("roessler", "chaotic", _roessler(n, 0.1), 0.1),
        LabelledSeries("roessler 5 %", "chaotic", noisy(_roessler(n, 0.1), 0.05), 0.1),
        LabelledSeries("lin periodic", "periodic", twist, fifty, period),
        LabelledSeries("lin periodic 2 %", "periodic", noisy(twist, 0.02), fifty, period),
        LabelledSeries("lin periodic 10 %", "periodic", noisy(twist, 0.10), fifty, period),
        LabelledSeries("lin 1/alpha 4.1", "periodic", lin(200.0 / 4.1, 50, n), fifty, period),
        LabelledSeries("lin 1/alpha 4.1 8 bit", "periodic", quantised(lin(200.0 / 4.1, 50, n), 8), fifty, period),
        LabelledSeries("sine and noise", "periodic", noisy(tone, 0.05), 0.0213),
        LabelledSeries("torus", "quasiperiodic", torus, 0.02),
        LabelledSeries("torus 5 %", "quasiperiodic", noisy(torus, 0.05), 0.02),
        LabelledSeries("white noise", "stochastic", lambda rng: rng.normal(size=n), 0.01),
        LabelledSeries("red noise", "stochastic", autoregressive((0.95,), n), 0.01),
        LabelledSeries("random walk", "stochastic", lambda rng: np.cumsum(rng.normal(size=n)), 0.01),
        LabelledSeries("resonance in noise", "stochastic", near, 0.01),
        LabelledSeries("resonance, bent", "stochastic", _shaped(near), 0.01),
        LabelledSeries("narrow resonance", "stochastic", autoregressive((0.995 * np.exp(0.2j),), n), 0.01),
        LabelledSeries("chaos made noise", "stochastic", surrogate(chaos), fifty),
        LabelledSeries("lin period 3, 5 %", "periodic", noisy(lin(66.0, 50, n), 0.05), fifty, period),
        LabelledSeries("sine, resonating floor", "periodic", summed(tone, scaled(near, 0.15)), 0.0213),
        LabelledSeries("two resonances", "stochastic", summed(near, autoregressive((0.98 * np.exp(0.9j),), n)), 0.01),
    ]
