"""From curves of divergence to the rate of divergence of infinitesimally close states, with an interval.

The mean logarithm of a distance d grows as lambda (1 - n) + c d, where n is the share of pairs within the noise and c
says how the growth changes with size, be it that pairs saturate or that some are torn apart (finite-size exponents:
Aurell, Boffetta, Crisanti, Paladin, Vulpiani, J. Phys. A 30 (1997) 1-26). All groups of neighbours, from the nearest
to the tenth, share lambda and c, so that the fit extrapolates to d = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import stdtrit

from lostmotion.contracts import Array
from lostmotion_chaos.quantifiers._kernels_divergence import COUNT, FAR, LOG, NEAR
from lostmotion_chaos.quantifiers.divergence import BLOCKS, Indices, Spread, States

WITHIN = 0.393
"""The share of a Gaussian in the plane that lies within one standard deviation: 1 - exp(-1/2)."""
NOISE_CORRECTION = 0.7
"""The share of the loss due to noise that is corrected: in tests with 1 and 2 % noise the full correction was too large
by half."""
NOISE_CORRECTION_ERROR = 0.25
"""Standard deviation of that share."""
STARTS = (0.7, 1.0)
"""The value is the mean over fits that begin after the nearest pairs have grown by so many e-folds. Chosen by
experience; no measurement recorded."""
OTHER_STARTS = (0.7, 1.0, 1.4)
"""The starts of the fits from which the error of the choice is estimated."""
ENDS = ((0.12, 0.18), (0.2, 0.3), (0.45,), (0.6,))
"""The fits end at these shares of the mean distance of unrelated points. The first entry that leaves enough to fit is
used, since growth depends on the distance."""
LEAST_EFOLDS = (1.0, 0.35, 0.35, 0.35)
"""For each entry of `ENDS`, the growth of the nearest pairs (e-folds) within the fit that is enough. Chosen by
experience; no measurement recorded."""
LATER_ENDS = (1.0, 1.5, 2.0)
"""The fits from which the error of the choice is estimated end later by these factors,"""
LATEST_END = 0.45
"""but not beyond this share,"""
LEAST_EFOLDS_SHARE = 0.7
"""and this share of `LEAST_EFOLDS` is enough for them. Chosen by experience; no measurement recorded."""
ERROR_FLOOR = 0.035
"""The least standard error of the choice, as a share of the value: the error found on systems with known exponents."""
MOST_POINTS = 16
"""At most so many points of each curve enter a fit."""
COLLINEAR = 1e-10
"""Two regressors are treated as one where 1 minus their squared correlation is below this."""
LEAST_SAMPLES = 4
"""A region must have at least so many samples."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves (..., g, times), averaged over a period: mean ln of distance, mean distance, share within the noise."""

    log: Array
    far: Array
    near: Array
    raw: Array
    dt: float
    unrelated: float

    @cached_property
    def crowded(self) -> Array:
        """The integral over time (s) of the share within the noise."""
        return _integrate(self.near, self.dt)

    @cached_property
    def parted(self) -> Array:
        """The integral over time (s) of the mean distance over that of unrelated points."""
        return _integrate(self.far, self.dt) / self.unrelated

    @property
    def whole(self) -> Curves:
        """The first of a stack of curves (several, g, times)."""
        return Curves(self.log[0], self.far[0], self.near[0], self.raw[0], self.dt, self.unrelated)


@dataclass(frozen=True)
class Domain:
    """The region of a fit: from sample `begin` to the sample in `ends` for each group."""

    begin: int
    ends: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Growth:
    """A rate (1/s) with standard errors: of the record, of the choice of window, and of the noise."""

    rate: float
    record: float
    windows: float
    noise: float
    domain: Domain
    lost: float

    def interval(self, embedding: float) -> tuple[float, float]:
        """Return the central 95 % interval; `embedding` is the standard error (1/s) of the choice of delay vectors."""
        floor = ERROR_FLOOR * abs(self.rate)
        wide = float(stdtrit(BLOCKS - 1, 0.975)) * float(
            np.sqrt(self.record**2 + max(self.windows, floor) ** 2 + embedding**2 + self.noise**2)
        )
        return self.rate - wide, self.rate + wide


def smooth_curve(curve: Array, width: int) -> Array:
    """Return moving averages (..., times - width + 1) of a curve (..., times)."""
    total = np.concatenate([np.zeros((*curve.shape[:-1], 1)), np.cumsum(curve, axis=-1)], axis=-1)
    moved: Array = (total[..., width:] - total[..., :-width]) / width
    return moved


def compute_curves(sums: Array, made: States, away: float) -> Curves:
    """Return the curves from sums (..., g, 4, times)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = sums[..., :COUNT, :] / sums[..., COUNT:, :]
    width = min(made.smooth, mean.shape[-1] - 1)
    log, far, near = (smooth_curve(mean[..., k, :], width) for k in (LOG, FAR, NEAR))
    return Curves(log, far, np.minimum(near / WITHIN, 1.0), mean[..., LOG, :], made.dt, away)


def choose_domain(c: Curves, made: States, efolds: float, end: float, enough: float) -> Domain | None:
    """Return the region of a fit, or None: pairs have grown by `efolds` and left the delay window, up to `end`."""
    base = float(np.nanmin(c.raw[0, : made.smooth]))
    grown = np.nonzero(c.log[0] >= base + efolds)[0]
    if not len(grown):
        return None
    begin = max(int(grown[0]), made.window - made.smooth // 2)
    if begin >= c.log.shape[1]:
        return None
    ends = []
    for far in c.far:
        over = np.nonzero(~(far[begin:] <= end * c.unrelated))[0]
        ends.append(begin + int(over[0]) if len(over) else len(far))
    parted = float(c.log[0, ends[0] - 1] - c.log[0, begin])
    return Domain(begin, tuple(ends)) if ends[0] - begin >= LEAST_SAMPLES and parted >= enough else None


def fit_line(c: Curves, where: Domain, correction: float) -> tuple[Array, Array]:
    """Return lambda (1/s) and c (1/s) of each curve, by least squares over all groups at once (normal equations).

    The intercepts of the groups are removed by subtracting means.
    """
    uu = uv = vv = uy = vy = np.zeros(c.log.shape[:-2])
    for g, end in enumerate(where.ends):
        if end - where.begin < LEAST_SAMPLES:
            continue
        at = _choose_points(where.begin, end)
        u = _remove_mean(at * c.dt - correction * c.crowded[..., g, at])
        v, y = _remove_mean(c.parted[..., g, at]), _remove_mean(c.log[..., g, at])
        uu, uv, vv = uu + (u * u).sum(axis=-1), uv + (u * v).sum(axis=-1), vv + (v * v).sum(axis=-1)
        uy, vy = uy + (u * y).sum(axis=-1), vy + (v * y).sum(axis=-1)
    free = uu * vv - uv * uv
    good = free > COLLINEAR * uu * vv
    safe = np.where(good, free, 1.0)
    return np.where(good, (uy * vv - vy * uv) / safe, uy / uu), np.where(good, (vy * uu - uy * uv) / safe, 0.0)


def _choose_points(begin: int, end: int) -> Indices:
    many = min(MOST_POINTS, end - begin)
    return begin + np.arange(many) * (end - 1 - begin) // (many - 1)


def _remove_mean(rows: Array) -> Array:
    moved: Array = rows - rows.mean(axis=-1, keepdims=True)
    return moved


def _integrate(curve: Array, dt: float) -> Array:
    total = np.zeros(curve.shape)
    np.cumsum(0.5 * dt * (curve[..., 1:] + curve[..., :-1]), axis=-1, out=total[..., 1:])
    return total


def _choose_domains(c: Curves, made: States) -> tuple[tuple[Domain, ...], tuple[Domain, ...]]:
    """Return the regions of the fits for the value, and those for the error of the choice."""
    for ends, enough in zip(ENDS, LEAST_EFOLDS, strict=True):
        usual = [d for s in STARTS for e in ends if (d := choose_domain(c, made, s, e, enough))]
        if usual:
            late = {min(k * ends[0], max(ends[-1], LATEST_END)) for k in LATER_ENDS}
            also = [
                d
                for s in OTHER_STARTS
                for e in sorted(late)
                if (d := choose_domain(c, made, s, e, LEAST_EFOLDS_SHARE * enough))
            ]
            return tuple(usual), tuple(also)
    return (), ()


def average_fits(c: Curves, where: tuple[Domain, ...], correction: float = NOISE_CORRECTION) -> Array:
    """Return lambda (1/s) of each curve: the mean over the regions."""
    found: Array = np.mean([fit_line(c, d, correction)[0] for d in where], axis=0)
    return found


def read_rate(read: Spread, made: States) -> float:
    """Return lambda (1/s) without errors, NaN where there is no region to fit."""
    c = compute_curves(read.sums.sum(axis=0), made, read.unrelated)
    where, _ = _choose_domains(c, made)
    return float(average_fits(c, where)) if where else float("nan")


def fit_growth(read: Spread, made: States) -> Growth | None:
    """Return the rate of divergence with its errors, or None where there is no region to fit."""
    total = read.sums.sum(axis=0, keepdims=True)
    stack = compute_curves(np.concatenate([total, total - read.sums]), made, read.unrelated)
    c = stack.whole
    where, others = _choose_domains(c, made)
    if not where:
        return None
    found, *left = average_fits(stack, where)
    record = float(np.sqrt((BLOCKS - 1) * np.var(left)))
    variants = [float(fit_line(c, d, NOISE_CORRECTION)[0]) for d in others]
    spread = float(np.std(variants)) if len(variants) > 1 else 2.0 * ERROR_FLOOR * abs(found)
    loss = float(average_fits(c, where, 1.0) - average_fits(c, where, 0.0))
    first = max(where, key=lambda d: d.ends[0] - d.begin)
    lost = float(c.near[0, first.begin : first.ends[0]].mean())
    return Growth(float(found), record, spread, NOISE_CORRECTION_ERROR * loss, first, lost)


def straighten_curve(c: Curves, found: Growth) -> tuple[Array, float]:
    """Return the curve (times,) of the nearest pairs, corrected for size and noise, and its intercept.

    Within the fitted region it follows intercept + rate times the time since the curve began; beyond the region the
    curve continues as measured.
    """
    begin, end = found.domain.begin, found.domain.ends[0]
    at = np.arange(begin, end)
    hidden = found.rate * NOISE_CORRECTION * c.crowded[0]
    size = _remove_mean(c.parted[0, at])
    excess = float(
        (size * _remove_mean(c.log[0, at] + hidden[at] - found.rate * c.dt * at)).sum() / (size * size).sum()
    )
    back = (hidden - excess * c.parted[0])[np.clip(np.arange(c.log.shape[1]), begin, end - 1)]
    curve = c.log[0] + back - back[0]
    return curve, float((curve[at] - found.rate * c.dt * at).mean())


def fit_drift(read: Spread, made: States) -> tuple[float, float]:
    """Return the mean slope (1/s) of the curve of the nearest pairs beyond the delay window, and its standard error.

    The difference between the slopes of its two halves counts as an error.
    """
    total = read.sums.sum(axis=0, keepdims=True)
    stack = compute_curves(np.concatenate([total, total - read.sums]), made, read.unrelated).log[:, 0]
    rows = stack[:, min(made.window, stack.shape[1] // 2) :]
    many = rows.shape[1] // 2
    (mean, *left), halves = (
        _fit_slope(rows, made.dt),
        [_fit_slope(part[:1], made.dt)[0] for part in (rows[:, :many], rows[:, many:])],
    )
    return float(mean), float(np.sqrt((BLOCKS - 1) * np.var(left) + np.var(halves)))


def _fit_slope(rows: Array, dt: float) -> Array:
    t = dt * (np.arange(rows.shape[1]) - 0.5 * (rows.shape[1] - 1))
    found: Array = rows @ t / (t @ t)
    return found
