"""The exponent by the recipe of Rosenstein et al. (1993): nearest neighbours, full distances, one straight line."""

from __future__ import annotations

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.kernels.threads import spread
from lostmotion.results import Estimate
from lostmotion_chaos.kernels.neighbours import nearest
from lostmotion_chaos.quantifiers._kernels_divergence import COUNT, LOG, follow
from lostmotion_chaos.quantifiers.divergence import BLOCKS, Indices
from lostmotion_chaos.quantifiers.exponent import UNIT, refuse, refuse_short
from lostmotion_chaos.signals.series import delay_vectors

LEAST_PAIRS = 5 * BLOCKS
"""At least so many pairs are needed: five in each block that is left out in turn."""


def estimate_classically(series: Series, begin: float, end: float) -> Estimate:
    """Return the slope (1/s) of the mean logarithm of distance between the times `begin` and `end` (s).

    Without an `end`, pairs are followed for twenty delay windows and the line is fitted to the first half. The number
    of pairs is the same at all times.
    """
    if no := refuse_short(series):
        return no
    dt, e = series.dt, series.embedding
    last = round(end / dt) if end > 0.0 else min(10 * e.window, series.n // 8)
    steps = min(2 * last, series.n // 4)
    points = delay_vectors(series.x, e.lag, e.dim)
    limit = len(points) - steps
    if last > steps or limit < LEAST_PAIRS:
        return refuse("too_short", f"{series.n} samples are too few to follow pairs for {last} samples.")
    index, _ = nearest(points[:limit], theiler=e.theiler, norm="euclidean")
    return _fit_line(points, index, (round(begin / dt), last, steps), dt)


def _fit_line(points: Array, index: Indices, span: tuple[int, int, int], dt: float) -> Estimate:
    """Return the slope between the samples `first` and `last` of pairs that are followed for `steps` samples."""
    first, last, steps = span
    wanted = np.nonzero(index >= 0)[0]
    paths = np.ascontiguousarray(points.T)
    sums = np.zeros((BLOCKS, 4, steps))
    ends = np.linspace(0, len(wanted), BLOCKS + 1).astype(int)
    pairs = index[wanted][:, None, None]

    def work(a: int, b: int) -> None:
        for k in range(a, b):
            part = slice(ends[k], ends[k + 1])
            follow(paths, paths[:0], wanted[part], pairs[part], (False, False, 0.0, 0.0), sums[k : k + 1])

    spread(work, BLOCKS)
    total = sums.sum(axis=0)
    times = np.arange(steps) * dt
    with np.errstate(invalid="ignore", divide="ignore"):
        curve = total[LOG] / total[COUNT]
        left = (total[LOG] - sums[:, LOG]) / (total[COUNT] - sums[:, COUNT])
    kept = {"time": times, "divergence": curve, "slope": np.gradient(curve, dt)}
    part = slice(first, last + 1)
    if not np.isfinite(left[:, part]).all():
        return refuse("regular", "All neighbours are exact repeats: the motion is periodic.", (kept, {}))
    slope, intercept = np.polyfit(times[part], curve[part], 1)
    others = np.polyfit(times[part], left[:, part].T, 1)[0]
    error = float(np.sqrt((BLOCKS - 1) / BLOCKS * ((others - others.mean()) ** 2).sum()))
    details = {
        "fit_begin": first * dt,
        "fit_end": last * dt,
        "intercept": float(intercept),
        "pairs": float(len(wanted)),
    }
    says = "The classical recipe: its interval is that of the record only, without the bias of the method."
    value, wide = float(slope), 2.09 * error
    return Estimate(value, value - wide, value + wide, "uncertain", UNIT, kept, says, details)
