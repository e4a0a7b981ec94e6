"""Surrogates and cheap statistics against plain NumPy and SciPy, on Lorenz x with N = 20,000."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from lostmotion.contracts import Series
from lostmotion.results import Embedding
from lostmotion_chaos.quantifiers.cheap import MutualInformation, PredictionError, TimeReversal
from lostmotion_chaos.surrogates.cycles import PseudoPeriodic
from lostmotion_chaos.surrogates.iterated import Iaaft
from lostmotion_chaos.surrogates.spectral import Aaft, Fourier
from yardstick import Array, Case, lorenz

DRAWS = 39
LAG, DIM, THEILER = 8, 4, 100


def series() -> Series:
    """Return the Lorenz recording with its embedding, driven every 50 samples where that is asked for."""
    x = lorenz()
    return Series(x - x.mean(), 0.02, Embedding(LAG, DIM, THEILER))


def plain_iaaft(turns: int = 100) -> Array:
    """Return 39 surrogates (39, n) by `rfft` and two `argsort` in each of a hundred turns, as most programs do it."""
    x, rng = lorenz(), np.random.default_rng(0)
    ordered, wanted = np.sort(x), np.abs(np.fft.rfft(x))
    out = np.array([rng.permutation(x) for _ in range(DRAWS)])
    for row in out:
        for _ in range(turns):
            spectrum = np.fft.rfft(row)
            smooth = np.fft.irfft(wanted * np.exp(1j * np.angle(spectrum)), n=len(x))
            row[:] = ordered[np.argsort(np.argsort(smooth))]
    return out


def plain_fourier() -> Array:
    """Return 39 phase-randomised surrogates (39, n)."""
    x, rng = lorenz(), np.random.default_rng(0)
    spectrum = np.fft.rfft(x)
    return np.array(
        [np.fft.irfft(spectrum * np.exp(2j * np.pi * rng.random(len(spectrum))), n=len(x)) for _ in range(DRAWS)]
    )


def plain_walks() -> Array:
    """Return one pseudo-periodic surrogate (n,) with all distances worked out at every step, as published."""
    x, rng = lorenz(), np.random.default_rng(0)
    points = np.stack([x[k * LAG : len(x) - (DIM - 1 - k) * LAG] for k in range(DIM)], axis=1)[:-1]
    at, out = 0, np.empty(len(x) // 20)
    for t in range(len(out)):
        out[t] = points[at, 0]
        weight = np.exp(-np.linalg.norm(points[:-1] - points[at], axis=1) / 0.1)
        at = int(np.searchsorted(np.cumsum(weight), rng.random() * weight.sum())) + 1
    return out


def plain_information() -> float:
    """Return the average mutual information (nats) by `histogram2d`."""
    x = lorenz()
    joint = np.histogram2d(x[:-LAG], x[LAG:], 64)[0] / (len(x) - LAG)
    product = np.outer(joint.sum(axis=1), joint.sum(axis=0))
    full = joint > 0
    return float((joint[full] * np.log(joint[full] / product[full])).sum())


def plain_prediction() -> float:
    """Return the prediction error of 4000 points from a tree with enough neighbours to step over the window."""
    x = lorenz()
    ahead = DIM * LAG
    points = np.stack([x[k * LAG : len(x) - ahead + k * LAG] for k in range(DIM)], axis=1)
    future, asked = x[ahead:], np.arange(0, len(points), 5)
    near = cKDTree(points).query(points[asked], k=2 * THEILER + 6, p=np.inf)[1]
    good = np.abs(near - asked[:, None]) > THEILER
    forecast = np.array([future[row[ok][:5]].mean() for row, ok in zip(near, good, strict=True)])
    return float(np.sqrt(np.mean((forecast - future[asked]) ** 2)) / x.std())


def _drawn(surrogate: Fourier | Aaft | Iaaft | PseudoPeriodic, draws: int = DRAWS) -> Array:
    return surrogate.draw(series(), draws=draws, rng=np.random.default_rng(0))


CASES = [
    Case("39 IAAFT surrogates", lambda: _drawn(Iaaft(match_ends=False)), plain_iaaft, 0.5),
    Case("39 IAAFT surrogates, ends matched", lambda: _drawn(Iaaft()), plain_iaaft, 0.5),
    Case("39 Fourier surrogates", lambda: _drawn(Fourier()), plain_fourier),
    Case("39 AAFT surrogates", lambda: _drawn(Aaft()), None),
    Case("39 pseudo-periodic walks (plain: a twentieth of one)", lambda: _drawn(PseudoPeriodic()), plain_walks),
    Case(
        "mutual information at one lag",
        lambda: MutualInformation().estimate(series(), rng=np.random.default_rng(0)),
        plain_information,
        0.005,
    ),
    Case("time reversal", lambda: TimeReversal().estimate(series(), rng=np.random.default_rng(0)), None, 0.005),
    Case(
        "prediction error",
        lambda: PredictionError().estimate(series(), rng=np.random.default_rng(0)),
        plain_prediction,
        0.05,
    ),
]
