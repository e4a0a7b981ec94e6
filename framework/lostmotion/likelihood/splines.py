"""A smoothing spline for long, evenly sampled series."""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline, make_lsq_spline

from lostmotion.contracts import Array

DEGREE = 5
ENOUGH = 8000


def fit_smoothing_spline(x: Array, dt: float) -> BSpline:
    """Return a quintic spline through the series `x` (n,), with even knots; Akaike's criterion chooses their number.

    The knots are chosen on the first samples, since the cost grows faster than n. Short series are interpolated.
    """
    t: Array = np.arange(len(x), dtype=float) * dt
    spacing = _choose_spacing(t[:ENOUGH], x[:ENOUGH])
    if spacing is None:
        return make_interp_spline(t, x, k=DEGREE)
    return make_lsq_spline(t, x, _place_knots(t, spacing), k=DEGREE)


def _choose_spacing(t: Array, x: Array) -> int | None:
    """Return the best spacing of the knots in samples; the search goes from fine to coarse. None for short series."""
    best, chosen, worse = math.inf, None, 0
    floor = 1e-12 * float(np.var(x))
    for spacing in _list_spacings(len(x)):
        spline = make_lsq_spline(t, x, _place_knots(t, spacing), k=DEGREE)
        left = float(np.mean((spline(t) - x) ** 2)) + floor
        score = len(x) * math.log(left) + 2.0 * len(x) / spacing
        worse = 0 if score < best else worse + 1
        if score < best:
            best, chosen = score, spacing
        if worse == 3:
            break
    return chosen


def _list_spacings(n: int) -> list[int]:
    """Return knot spacings in samples, from 3 up in steps of about 1.4, that leave at least 8 pieces."""
    spacings = sorted({round(3 * 1.4**i) for i in range(20)})
    return [s for s in spacings if n >= 8 * s]


def _place_knots(t: Array, spacing: int) -> Array:
    """Return even knots every `spacing` samples, with the ends repeated for a quintic spline."""
    inner = t[spacing : -spacing // 2 : spacing]
    return np.concatenate([np.repeat(t[0], DEGREE + 1), inner, np.repeat(t[-1], DEGREE + 1)])
