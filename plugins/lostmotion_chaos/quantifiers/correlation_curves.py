"""Results from correlation sums other than the plateau: curves to draw, Takens' estimate, a fast slope."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.results import Estimate
from lostmotion_chaos.quantifiers.correlation import Effort, Sums, compute_correlation_sums, jackknife
from lostmotion_chaos.quantifiers.correlation_boxes import EIGHTHS
from lostmotion_chaos.quantifiers.correlation_plateau import AGREEING_DIMS, LEAST_PAIRS, Plateau
from lostmotion_chaos.quantifiers.correlation_ready import prepare_series

LEAST_SAMPLES = 500
"""A shorter recording is refused. Chosen by experience; no measurement recorded."""
QUICK_PAIRS = 10_000_000
"""Pairs for the fast slope."""
QUICK_SHARES = (3e-4, 1e-2)
"""Shares of close pairs between which the fast slope is taken. Chosen by experience; no measurement recorded."""


def choose_dims(series: Series, dims: int) -> int:
    """Return the largest embedding dimension: the given one, or three more than the embedding's, limited by n."""
    wanted = dims or min(10, max(7, series.embedding.dim + 3))
    return max(1, min(wanted, 1 + (series.n // 4) // series.embedding.lag))


def refuse_unusable(series: Series, dims: int, *, unit: str = "1") -> Estimate | None:
    """Return the refusal of a series that is too short or constant, or None."""
    free = series.n - (dims - 1) * series.embedding.lag - series.embedding.theiler
    if series.n < LEAST_SAMPLES or free < LEAST_SAMPLES // 2 or dims < AGREEING_DIMS:
        says = (
            f"{series.n} samples with delay {series.embedding.lag} and Theiler window {series.embedding.theiler} are "
            f"too few for a correlation sum, and {LEAST_SAMPLES} beside these are needed: record longer."
        )
        return Estimate.refused("too_short", says, unit=unit)
    if not np.ptp(series.x) > 0.0:
        return Estimate.refused("failed", "The series is constant: there is no motion to measure.", unit=unit)
    return None


def estimate_takens(total: Array, radii: Array, low: float, high: float) -> float:
    """Return the estimate of Takens (1985), 1 / mean of ln(high/r) over the pairs with low <= r < high.

    The mean of the logarithms is the integral of C/r over C(high) (Theiler 1988), with a power law between two codes.
    Pairs below `low` (ties, noise) are left out of both, so that only the power law above `low` counts.
    """
    inside = np.flatnonzero((radii >= low) & (radii <= high * (1.0 + 1e-12)) & (total > 0))
    if len(inside) < 2:
        return math.nan
    c, r = total[inside], radii[inside]
    growth, step = np.diff(np.log(c)), np.diff(np.log(r))
    area = np.sum(step * np.where(growth > 1e-9, np.diff(c) / np.maximum(growth, 1e-9), c[1:]))
    return float((c[-1] - c[0]) / area)


def collect_curves(sums: Sums, found: Plateau | None) -> dict[str, Array]:
    """Return the curves: radius (radii,), log_correlation and slope (dims, radii), and the slope by dimension."""
    span = EIGHTHS // 2
    last = int(np.argmax(sums.radii >= sums.extent))
    seen = np.arange(int(np.argmax(sums.total[0] > 0)), last + 1)
    log_c, log_r = sums.log_correlation, np.log(sums.radii)
    low, high = np.maximum(seen - span // 2, 0), np.minimum(seen + span // 2, last)
    with np.errstate(invalid="ignore"):
        slope = (log_c[:, high] - log_c[:, low]) / (log_r[high] - log_r[low])
    curve = {
        "radius": sums.radii[seen],
        "log_correlation": np.where(np.isfinite(log_c[:, seen]), log_c[:, seen], np.nan),
        "slope": np.where(np.isfinite(slope), slope, np.nan),
        "dim": np.arange(1.0, sums.dims + 1.0),
    }
    by_dim = np.full((3, sums.dims), np.nan)
    if found is not None:
        count = len(found.value)
        error = 1.96 * np.sqrt(jackknife(found.left) ** 2 + found.scatter**2)
        by_dim[:, :count] = found.value, found.value - error, found.value + error
    return curve | dict(zip(("dimension_by_dim", "low_by_dim", "high_by_dim"), by_dim, strict=True))


def measure_flatness(curve: Mapping[str, Array], found: Plateau) -> tuple[float, float]:
    """Return the change of the local slope across a plateau (absolute), and its rms scatter, as shares of the slope.

    Both use all radii between the ends of the plateau and all dimensions from its first one on, in which the slope of a
    motion of that dimension is the same.
    """
    low, high = found.ends
    inside = (curve["radius"] >= low) & (curve["radius"] <= high)
    rows = curve["slope"][found.first - 1 :, inside]
    rows = rows[np.isfinite(rows).all(axis=1)]
    octaves = np.log2(curve["radius"][inside])
    if rows.size == 0 or len(octaves) < 3:
        return math.inf, math.inf
    lean = float(np.polyfit(octaves, rows.mean(axis=0), 1)[0])
    tilt = abs(lean) * float(octaves[-1] - octaves[0]) / found.mean
    return tilt, float(np.sqrt(np.mean((rows - found.mean) ** 2))) / found.mean


def estimate_quick_slope(data: Series) -> Estimate:
    """Return the slope between fixed shares of close pairs, in one embedding dimension; noise has such a slope, too.

    There is no interval. Only a given period is used, so that a series and its surrogates are treated alike.
    """
    dim = min(6, max(4, data.embedding.dim + 1))
    dim = max(1, min(dim, 1 + (data.n // 4) // data.embedding.lag))
    it = prepare_series(data, np.random.default_rng(0), guess=False)
    effort = Effort(pairs=QUICK_PAIRS, near=0, blocks=8, only=(dim,))
    sums = compute_correlation_sums(it.x, it.lag, dim, theiler=data.embedding.theiler, effort=effort)
    log_c = sums.log_correlation[dim - 1]
    ends = math.log(max(QUICK_SHARES[0], LEAST_PAIRS / float(sums.pairs.sum()))), math.log(QUICK_SHARES[1])
    rising = np.diff(sums.total[dim - 1], prepend=0.0) > 0.0
    if rising.sum() < 2:
        says = "All pairs have the same distance: the recording repeats itself, or has one step only."
        return Estimate.refused("no_scaling_region", says)
    low, high = np.interp(ends, log_c[rising], np.log(sums.radii[rising]))
    slope = min(float(dim), float((ends[1] - ends[0]) / max(high - low, 1e-3)))
    says = "A slope at fixed shares of pairs, to compare series: it is no dimension and has no interval."
    details = {"dim": float(dim), "r_low": math.exp(low), "r_high": math.exp(high), "pairs": float(sums.pairs.sum())}
    return Estimate(slope, -math.inf, math.inf, "uncertain", "1", {}, says, details)
