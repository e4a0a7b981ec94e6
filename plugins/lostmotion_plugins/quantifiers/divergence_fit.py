"""From curves of divergence to the rate at which infinitesimally close states part, with an interval.

The mean logarithm of a distance d grows as lambda (1 - n) + c d, where n is the share of pairs within the noise and c
says how the growth changes with size, be it that pairs saturate or that some are torn apart (finite-size exponents:
Aurell, Boffetta, Crisanti, Paladin, Vulpiani, J. Phys. A 30 (1997) 1-26). All groups of neighbours, from the nearest
to the tenth, share lambda and c, so that the fit looks to d = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import stdtrit

from lostmotion.contracts import Array
from lostmotion_plugins.quantifiers._kernels_divergence import COUNT, FAR, LOG, NEAR
from lostmotion_plugins.quantifiers.divergence import BLOCKS, Indices, Spread, States

WITHIN = 0.393
"""The share of a Gaussian in the plane that lies within one standard deviation: 1 - exp(-1/2)."""
BELIEVED = 0.7
"""How much of the loss to noise is put back: all of it is too much by half as tests with 1 and 2 % noise have it."""
DOUBT = 0.25
"""Standard deviation of the above."""
STARTS = (0.7, 1.0)
"""The value: mean over fits that begin after the nearest pairs have grown by this many e-folds."""
OTHER_STARTS = (0.7, 1.0, 1.4)
ENDS = ((0.12, 0.18), (0.2, 0.3), (0.45,), (0.6,))
"""They end at this share of the distance of strangers: early if enough is left to fit, as growth depends on size."""
ENOUGH = (1.0, 0.35, 0.35, 0.35)
"""The e-folds that are enough."""
LATER = (1.0, 1.5, 2.0)
"""How much later the fits may end that say what the choice matters,"""
LAST = 0.45
"""but no later than this,"""
SPARSE = 0.7
"""and the share of the e-folds wanted that is enough for them."""
FLOOR = 0.035
"""Share of the value that is always doubtful: what the method was off by on systems with known exponents."""
POINTS = 16
ALIKE = 1e-10
"""Two regressors whose correlation is as near to one as this are one."""
FEW = 4
"""Samples that a region must hold."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves (..., g, times): mean ln of distance, mean distance, share within the noise; averaged over a period."""

    log: Array
    far: Array
    near: Array
    raw: Array
    dt: float
    strangers: float

    @cached_property
    def crowded(self) -> Array:
        """The share within the noise, summed up from the beginning on (s)."""
        return _integral(self.near, self.dt)

    @cached_property
    def parted(self) -> Array:
        """The mean distance as a share of that of strangers, summed up from the beginning on (s)."""
        return _integral(self.far, self.dt) / self.strangers

    @property
    def whole(self) -> Curves:
        """The first of a stack of curves (several, g, times)."""
        return Curves(self.log[0], self.far[0], self.near[0], self.raw[0], self.dt, self.strangers)


@dataclass(frozen=True)
class Domain:
    """Where to fit: from sample `begin` on, to the sample in `ends` for each group."""

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
        floor = FLOOR * abs(self.rate)
        wide = float(stdtrit(BLOCKS - 1, 0.975)) * float(
            np.sqrt(self.record**2 + max(self.windows, floor) ** 2 + embedding**2 + self.noise**2)
        )
        return self.rate - wide, self.rate + wide


def smoothed(curve: Array, width: int) -> Array:
    """Return moving averages (..., times - width + 1) of a curve (..., times)."""
    total = np.concatenate([np.zeros((*curve.shape[:-1], 1)), np.cumsum(curve, axis=-1)], axis=-1)
    moved: Array = (total[..., width:] - total[..., :-width]) / width
    return moved


def curves(sums: Array, made: States, away: float) -> Curves:
    """Return the curves behind sums (..., g, 4, times)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = sums[..., :COUNT, :] / sums[..., COUNT:, :]
    width = min(made.smooth, mean.shape[-1] - 1)
    log, far, near = (smoothed(mean[..., k, :], width) for k in (LOG, FAR, NEAR))
    return Curves(log, far, np.minimum(near / WITHIN, 1.0), mean[..., LOG, :], made.dt, away)


def domain(c: Curves, made: States, efolds: float, end: float, enough: float) -> Domain | None:
    """Return where to fit: nearest pairs have grown by `efolds`, left the delay window, and are not too far."""
    base = float(np.nanmin(c.raw[0, : made.smooth]))
    grown = np.nonzero(c.log[0] >= base + efolds)[0]
    if not len(grown):
        return None
    begin = max(int(grown[0]), made.window - made.smooth // 2)
    if begin >= c.log.shape[1]:
        return None
    ends = []
    for far in c.far:
        over = np.nonzero(~(far[begin:] <= end * c.strangers))[0]
        ends.append(begin + int(over[0]) if len(over) else len(far))
    parted = float(c.log[0, ends[0] - 1] - c.log[0, begin])
    return Domain(begin, tuple(ends)) if ends[0] - begin >= FEW and parted >= enough else None


def line(c: Curves, where: Domain, believed: float) -> tuple[Array, Array]:
    """Return lambda (1/s) and c (1/s) of each curve, by least squares over all groups at once: the normal equations.

    The intercepts of the groups are taken out as means.
    """
    uu = uv = vv = uy = vy = np.zeros(c.log.shape[:-2])
    for g, end in enumerate(where.ends):
        if end - where.begin < FEW:
            continue
        at = _points(where.begin, end)
        u = _centred(at * c.dt - believed * c.crowded[..., g, at])
        v, y = _centred(c.parted[..., g, at]), _centred(c.log[..., g, at])
        uu, uv, vv = uu + (u * u).sum(axis=-1), uv + (u * v).sum(axis=-1), vv + (v * v).sum(axis=-1)
        uy, vy = uy + (u * y).sum(axis=-1), vy + (v * y).sum(axis=-1)
    free = uu * vv - uv * uv
    good = free > ALIKE * uu * vv
    safe = np.where(good, free, 1.0)
    return np.where(good, (uy * vv - vy * uv) / safe, uy / uu), np.where(good, (vy * uu - uy * uv) / safe, 0.0)


def _points(begin: int, end: int) -> Indices:
    many = min(POINTS, end - begin)
    return begin + np.arange(many) * (end - 1 - begin) // (many - 1)


def _centred(rows: Array) -> Array:
    moved: Array = rows - rows.mean(axis=-1, keepdims=True)
    return moved


def _integral(curve: Array, dt: float) -> Array:
    total = np.zeros(curve.shape)
    np.cumsum(0.5 * dt * (curve[..., 1:] + curve[..., :-1]), axis=-1, out=total[..., 1:])
    return total


def _domains(c: Curves, made: States) -> tuple[tuple[Domain, ...], tuple[Domain, ...]]:
    """Return where the value is read, and where else it might be: the earliest ends that leave enough to fit."""
    for ends, enough in zip(ENDS, ENOUGH, strict=True):
        usual = [d for s in STARTS for e in ends if (d := domain(c, made, s, e, enough))]
        if usual:
            late = {min(k * ends[0], max(ends[-1], LAST)) for k in LATER}
            also = [d for s in OTHER_STARTS for e in sorted(late) if (d := domain(c, made, s, e, SPARSE * enough))]
            return tuple(usual), tuple(also)
    return (), ()


def value(c: Curves, where: tuple[Domain, ...], believed: float = BELIEVED) -> Array:
    """Return lambda (1/s) of each curve: the mean over the windows."""
    found: Array = np.mean([line(c, d, believed)[0] for d in where], axis=0)
    return found


def rate(read: Spread, made: States) -> float:
    """Return lambda (1/s) alone, NaN where there is nothing to read it from."""
    c = curves(read.sums.sum(axis=0), made, read.strangers)
    where, _ = _domains(c, made)
    return float(value(c, where)) if where else float("nan")


def growth(read: Spread, made: States) -> Growth | None:
    """Return the rate at which neighbours part, or None where there is nothing to read it from."""
    total = read.sums.sum(axis=0, keepdims=True)
    stack = curves(np.concatenate([total, total - read.sums]), made, read.strangers)
    c = stack.whole
    where, others = _domains(c, made)
    if not where:
        return None
    found, *left = value(stack, where)
    record = float(np.sqrt((BLOCKS - 1) * np.var(left)))
    variants = [float(line(c, d, BELIEVED)[0]) for d in others]
    spread = float(np.std(variants)) if len(variants) > 1 else 2.0 * FLOOR * abs(found)
    loss = float(value(c, where, 1.0) - value(c, where, 0.0))
    first = max(where, key=lambda d: d.ends[0] - d.begin)
    lost = float(c.near[0, first.begin : first.ends[0]].mean())
    return Growth(float(found), record, spread, DOUBT * loss, first, lost)


def straightened(c: Curves, found: Growth) -> tuple[Array, float]:
    """Return the curve (times,) of the nearest pairs, with what size and noise take off put back, and its intercept.

    Within the region fitted it follows intercept + rate times the time since the curve began; beyond, the curve goes
    on as measured.
    """
    begin, end = found.domain.begin, found.domain.ends[0]
    at = np.arange(begin, end)
    hidden = found.rate * BELIEVED * c.crowded[0]
    size = _centred(c.parted[0, at])
    excess = float((size * _centred(c.log[0, at] + hidden[at] - found.rate * c.dt * at)).sum() / (size * size).sum())
    back = (hidden - excess * c.parted[0])[np.clip(np.arange(c.log.shape[1]), begin, end - 1)]
    curve = c.log[0] + back - back[0]
    return curve, float((curve[at] - found.rate * c.dt * at).mean())


def drift(read: Spread, made: States) -> tuple[float, float]:
    """Return the mean slope (1/s) of the curve of the nearest pairs beyond the delay window, and its standard error.

    What a part of the curve does by itself counts as error.
    """
    total = read.sums.sum(axis=0, keepdims=True)
    stack = curves(np.concatenate([total, total - read.sums]), made, read.strangers).log[:, 0]
    rows = stack[:, min(made.window, stack.shape[1] // 2) :]
    many = rows.shape[1] // 2
    (mean, *left), halves = (
        _slope(rows, made.dt),
        [_slope(part[:1], made.dt)[0] for part in (rows[:, :many], rows[:, many:])],
    )
    return float(mean), float(np.sqrt((BLOCKS - 1) * np.var(left) + np.var(halves)))


def _slope(rows: Array, dt: float) -> Array:
    t = dt * (np.arange(rows.shape[1]) - 0.5 * (rows.shape[1] - 1))
    found: Array = rows @ t / (t @ t)
    return found
