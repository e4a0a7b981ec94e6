"""Statistics that take milliseconds, for surrogate tests."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.special import digamma, stdtrit

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_chaos.kernels import neighbours
from lostmotion_chaos.signals.series import delay_vectors

LEAST_TERMS = 100
"""No statistic is computed from fewer terms. Chosen by experience; no measurement recorded."""
BLOCK_LIMITS = (6, 60)
"""Least and largest number of blocks of a bootstrap. Chosen by experience; no measurement recorded."""


@dataclass(frozen=True)
class MutualInformation(Quantifier[Series]):
    """Average mutual information (nats) of x(t) and x(t + lag), lag that of the embedding. Fraser, Swinney (1986).

    It uses a histogram of `bins` equal bins on each side (0: as many as the length allows, 64 at most), and entropies
    with a negligible bias at small counts (Grassberger 2003); `details["plain"]` is the number without correction.
    """

    bins: int = 0
    name: ClassVar[str] = "mutual_information"
    paper: ClassVar[str] = "Fraser, Swinney, Physical Review A 33 (1986) 1134-1140; Grassberger, arXiv:physics/0307138"
    unit: ClassVar[str] = "nat"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        lag, pairs = data.embedding.lag, data.n - data.embedding.lag
        if pairs < LEAST_TERMS:
            return _refuse_short(pairs, self.unit)
        bins = self.bins or int(np.clip(np.sqrt(data.n / 4.8), 4, 64))
        codes = _assign_bins(data.x, bins)
        cells = codes[:-lag] * bins + codes[lag:]
        counts = np.bincount(cells, minlength=bins * bins).reshape(bins, bins)
        rows, columns = counts.sum(axis=1), counts.sum(axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            local = np.log(counts * float(pairs) / np.outer(rows, columns))
        plain = float((counts * np.where(counts > 0, local, 0.0)).sum()) / pairs
        value = _estimate_entropy(rows) + _estimate_entropy(columns) - _estimate_entropy(counts.ravel())
        return _add_interval(value, local.ravel()[cells] - plain, data, rng, self.unit, plain=plain, bins=bins)


@dataclass(frozen=True)
class TimeReversal(Quantifier[Series]):
    """Skewness of x(t + lag) - x(t), <d^3> / <d^2>^(3/2): zero for a motion that is the same in reversed time.

    Theiler et al., Physica D 58 (1992) 77-94; Schreiber, Schmitz, Physical Review E 55 (1997) 5443-5447.
    """

    name: ClassVar[str] = "time_reversal"
    paper: ClassVar[str] = "Schreiber, Schmitz, Physical Review E 55 (1997) 5443-5447"
    unit: ClassVar[str] = "1"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        lag = data.embedding.lag
        if data.n - lag < LEAST_TERMS:
            return _refuse_short(data.n - lag, self.unit)
        d = data.x[lag:] - data.x[:-lag]
        square, cube = float(np.mean(d**2)), float(np.mean(d**3))
        if square <= (1e-12 * np.ptp(data.x)) ** 2:
            return Estimate.refused("failed", f"the series repeats itself after {lag} samples: choose another lag")
        value = cube / square**1.5
        pull = (d**3 - cube) / square**1.5 - 1.5 * value * (d**2 - square) / square
        return _add_interval(value, pull, data, rng, self.unit)


@dataclass(frozen=True)
class PredictionError(Quantifier[Series]):
    """Error (rms, as a share of the standard deviation) of forecasts one lag ahead from the past of neighbours.

    The forecast of a point is the mean over the successors of its `neighbours` nearest neighbours outside of the
    Theiler window (Farmer, Sidorowich 1987; as a test statistic Theiler et al. 1992, Schreiber, Schmitz 1997).
    `queries` points, spread evenly, are forecast.
    """

    neighbours: int = 5
    queries: int = 4000
    name: ClassVar[str] = "prediction_error"
    paper: ClassVar[str] = "Farmer, Sidorowich, PRL 59 (1987) 845-848; Schreiber, Schmitz, PRE 55 (1997) 5443-5447"
    unit: ClassVar[str] = "1"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        lag, dim, theiler = data.embedding.lag, data.embedding.dim, data.embedding.theiler
        ahead = data.embedding.window - 1 + lag
        rows = data.n - ahead
        if rows < max(LEAST_TERMS, 2 * theiler + 4 * self.neighbours):
            return _refuse_short(rows, self.unit)
        points = delay_vectors(data.x[: data.n - lag], lag, dim)
        future = data.x[ahead:]
        asked = np.arange(0, rows, max(rows // self.queries, 1))
        near, _ = neighbours.several(points, self.neighbours, theiler=theiler, least=-1.0, queries=asked)
        if (near < 0).any():
            return Estimate.refused("too_few_neighbours", "points have no neighbours outside of the Theiler window")
        square = (future[near].mean(axis=1) - future[asked]) ** 2
        spread = float(np.std(data.x))
        value = float(np.sqrt(np.mean(square))) / spread
        pull = (square / spread**2 - value**2) / (2.0 * value) if value > 0.0 else np.zeros(len(square))
        return _add_interval(value, pull, data, rng, self.unit)


def _refuse_short(terms: int, unit: str) -> Estimate:
    """Return the refusal of a series that is too short."""
    says = f"{max(terms, 0)} samples remain after lag and window, at least {LEAST_TERMS} are needed: record longer"
    return Estimate.refused("too_short", says, unit=unit)


def _assign_bins(x: Array, bins: int) -> Array:
    """Return the number of the bin (n,) of each sample, equal bins over the range."""
    low, high = float(x.min()), float(x.max())
    scale = bins / (high - low) if high > low else 0.0
    return np.minimum(((x - low) * scale).astype(np.int64), bins - 1)


def _estimate_entropy(counts: NDArray[Any]) -> float:
    """Return the entropy (nats) of the distribution behind `counts` (k,): Grassberger (2003), eq. (35)."""
    n = counts[counts > 0].astype(np.float64)
    sign = np.where(n % 2 == 0, 0.5, -0.5)
    logs = digamma(n) + sign * (digamma((n + 1.0) / 2.0) - digamma(n / 2.0))
    return float(np.log(n.sum()) - (n * logs).sum() / n.sum())


def _add_interval(
    value: float, pull: Array, data: Series, rng: np.random.Generator, unit: str, **details: float
) -> Estimate:
    """Return the estimate with a central 95 % interval: a bootstrap of the means of blocks of `pull` (m,).

    `pull` is the influence function: by how much each term changes the value, to first order. Blocks are ten times as
    long as the Theiler window, or shorter where that leaves too few; Student's t accounts for the number of blocks.
    """
    fewest, most = BLOCK_LIMITS
    length = 10 * max(data.embedding.theiler, data.embedding.window) * len(pull) / data.n
    blocks = int(np.clip(len(pull) / length, fewest, most))
    size = len(pull) // blocks
    means = pull[: size * blocks].reshape(blocks, size).mean(axis=1)
    shifts = means[rng.integers(blocks, size=(400, blocks))].mean(axis=1) - means.mean()
    wider = float(stdtrit(blocks - 1, 0.975)) / 1.96 * np.sqrt(blocks / (blocks - 1))
    low, high = np.quantile(shifts, [0.025, 0.975]) * wider
    status, says = "ok", ""
    if len(pull) < fewest * length:
        status, says = "uncertain", "the series is short for its correlation time: the interval may be too narrow"
    numbers = {"blocks": float(blocks), **details}
    return Estimate(value, value + min(low, 0.0), value + max(high, 0.0), status, unit, {}, says, numbers)
