"""The experimental analysis chain of the paper: embedding, correlation sums, surrogates, noise reduction."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion_chaos.analysis.embed import embed
from lostmotion_chaos.analysis.quantify import quantify
from lostmotion_chaos.paper.lab import Lab

DIMS = 8
"""Largest embedding dimension of the correlation sums."""
SHARES = (1e-4, 3e-3)
"""Shares of pairs between which the slope is measured; the same in every dimension, for recording and surrogates."""
SIGMAS = 3.0
"""Standard deviations of the surrogates beyond which a recording differs from them: the criterion of the paper."""


@dataclass(frozen=True, eq=False)
class Slopes:
    """Slopes of the correlation sum (dims,) of a recording; mean and standard deviation (dims,) of its surrogates."""

    dims: Array
    recorded: Array
    mean: Array
    spread: Array

    @property
    def separation(self) -> Array:
        """Return by how many standard deviations (dims,) the recording lies below its surrogates."""
        return np.asarray((self.mean - self.recorded) / np.maximum(self.spread, 1e-3))

    @property
    def differs(self) -> bool:
        """Return whether the separation exceeds three standard deviations at most of the dimensions above 2."""
        return bool(np.mean(np.abs(self.separation[2:]) > SIGMAS) > 0.5)


def embed_recording(lab: Lab, x: Array, dt: float, period: float) -> Series:
    """Return a recording embedded with the delay from mutual information and the dimension from Cao's method."""
    return embed(x, lab.make("embedder", "ami_cao"), dt=dt, period=period)


def find_first_minimum(curves: Mapping[str, Array], within: float) -> float:
    """Return the first lag (s) whose mutual information is the lowest of all lags within `within` s of it.

    Local minima on a shorter scale are ripples caused by the bins. The result is NaN if there is no such lag.
    """
    lag, ami = curves["lag"], curves["ami"]
    reach = max(round(within / float(lag[1] - lag[0])), 1)
    for k in range(reach, len(ami) - reach):
        if ami[k] <= ami[k - reach : k + reach + 1].min():
            return float(lag[k])
    return math.nan


def measure_slopes(lab: Lab, series: Series, draws: int, stream: str) -> Slopes:
    """Return the slopes of a recording and of its Fourier surrogates, the null hypothesis of the paper."""
    surrogate, rng = lab.make("surrogate", "fourier"), lab.make_rng(stream)
    drawn = surrogate.draw(series, draws=draws, rng=rng)
    part = surrogate.piece(series)
    values = np.array([_measure_slope(lab, replace(series, x=x), rng) for x in (series.x[part], *drawn)])
    return Slopes(np.arange(1.0, DIMS + 1.0), values[0], values[1:].mean(axis=0), values[1:].std(axis=0, ddof=1))


def _measure_slope(lab: Lab, series: Series, rng: np.random.Generator) -> Array:
    """Return the slope (dims,) of the log correlation sum over log radius between the two shares of pairs."""
    method = lab.make("quantifier", "correlation_dimension", dims=DIMS, pairs=lab.pick(20_000_000, 6_000_000))
    curve = quantify(series, method, rng=rng).curve
    found = np.full(DIMS, math.nan)
    if "log_correlation" not in curve:
        return found
    ends, radii = np.log(SHARES), np.log(curve["radius"])
    for k, row in enumerate(curve["log_correlation"][:DIMS]):
        seen = np.isfinite(row) & (np.diff(row, prepend=-np.inf) > 0.0)
        if seen.sum() > 3:
            low, high = np.interp(ends, row[seen], radii[seen])
            found[k] = (ends[1] - ends[0]) / max(high - low, 1e-9)
    return found


def clean_recording(lab: Lab, series: Series, noise: float) -> Array:
    """Return the recording (n,) after simple non-linear noise reduction; `noise` is in the unit of x."""
    return np.asarray(lab.make("denoiser", "simple_nonlinear").clean(series, noise=noise, rng=lab.make_rng("clean")))


def compute_std(x: Array) -> float:
    """Return the standard deviation of x."""
    return float(np.std(x))
