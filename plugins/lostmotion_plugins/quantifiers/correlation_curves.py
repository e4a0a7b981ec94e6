"""What is read off correlation sums apart from the plateau: curves for people, Takens' estimate, a fast slope."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.correlation import EIGHTHS, Effort, Sums, correlation_sums, jackknife
from lostmotion_plugins.quantifiers.correlation_plateau import ENOUGH, KEPT, Plateau
from lostmotion_plugins.quantifiers.correlation_ready import ready

LEAST = 500
QUICK = 10_000_000
"""Pairs for the fast slope."""
SHARES = (3e-4, 1e-2)
"""Shares of close pairs between which the fast slope is taken."""


def enough_dims(series: Series, dims: int) -> int:
    """Return the largest embedding dimension: the given one, or three beyond the embedding's, as far as n allows."""
    wanted = dims or min(10, max(7, series.embedding.dim + 3))
    return max(1, min(wanted, 1 + (series.n // 4) // series.embedding.lag))


def refusal(series: Series, dims: int, *, unit: str = "1") -> Estimate | None:
    """Return the refusal of a series that is too short or stands still, or None."""
    free = series.n - (dims - 1) * series.embedding.lag - series.embedding.theiler
    if series.n < LEAST or free < LEAST // 2 or dims < KEPT:
        says = (
            f"{series.n} samples with delay {series.embedding.lag} and Theiler window {series.embedding.theiler} are "
            f"too few for a correlation sum, and {LEAST} beside these are wanted: record longer."
        )
        return Estimate.refused("too_short", says, unit=unit)
    if not np.ptp(series.x) > 0.0:
        return Estimate.refused("failed", "The series is constant: there is no motion to measure.", unit=unit)
    return None


def takens_theiler(total: Array, radii: Array, low: float, high: float) -> float:
    """Return the estimate of Takens (1985), 1 / mean of ln(high/r) over the pairs with low <= r < high.

    The sum of logarithms is C(high) over the integral of C/r (Theiler 1988), a power law between two codes. Pairs below
    `low` (ties, noise) are left out of both, which takes the part of the power law below `low` off again.
    """
    inside = np.flatnonzero((radii >= low) & (radii <= high * (1.0 + 1e-12)) & (total > 0))
    if len(inside) < 2:
        return math.nan
    c, r = total[inside], radii[inside]
    growth, step = np.diff(np.log(c)), np.diff(np.log(r))
    area = np.sum(step * np.where(growth > 1e-9, np.diff(c) / np.maximum(growth, 1e-9), c[1:]))
    return float((c[-1] - c[0]) / area)


def curve_of(sums: Sums, found: Plateau | None) -> dict[str, Array]:
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


def flatness(curve: Mapping[str, Array], found: Plateau) -> tuple[float, float]:
    """Return by how much the local slope changes across a plateau, and how far it scatters there, as shares of it.

    Counted over all radii between its ends and over all dimensions from the first of the plateau on, which a motion of
    that dimension fills alike. The first number is the mean change from one end to the other, with its sign off.
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


def quick_slope(data: Series) -> Estimate:
    """Return the slope between fixed shares of close pairs, in one dimension: there is one for noise too.

    The interval is left open. Only a given period is looked at, so that a series and its surrogates are treated alike.
    """
    dim = min(6, max(4, data.embedding.dim + 1))
    dim = max(1, min(dim, 1 + (data.n // 4) // data.embedding.lag))
    it = ready(data, np.random.default_rng(0), guess=False)
    effort = Effort(pairs=QUICK, near=0, blocks=8, only=(dim,))
    sums = correlation_sums(it.x, it.lag, dim, theiler=data.embedding.theiler, effort=effort)
    log_c = sums.log_correlation[dim - 1]
    ends = math.log(max(SHARES[0], ENOUGH / float(sums.pairs.sum()))), math.log(SHARES[1])
    rising = np.diff(sums.total[dim - 1], prepend=0.0) > 0.0
    if rising.sum() < 2:
        says = "All pairs lie equally far apart: the recording repeats itself, or has one step only."
        return Estimate.refused("no_scaling_region", says)
    low, high = np.interp(ends, log_c[rising], np.log(sums.radii[rising]))
    slope = min(float(dim), float((ends[1] - ends[0]) / max(high - low, 1e-3)))
    says = "A slope at fixed shares of pairs, to compare series with: no dimension, and without an interval."
    details = {"dim": float(dim), "r_low": math.exp(low), "r_high": math.exp(high), "pairs": float(sums.pairs.sum())}
    return Estimate(slope, -math.inf, math.inf, "uncertain", "1", {}, says, details)
