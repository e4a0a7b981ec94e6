"""From curves of divergence to the rate at which infinitesimally close states part, with an interval.

The mean logarithm of a distance d grows as lambda (1 - n) + c d, where n is the share of pairs within the noise and c
says how the growth changes with size, be it that pairs saturate or that some are torn apart (finite-size exponents:
Aurell, Boffetta, Crisanti, Paladin, Vulpiani, J. Phys. A 30 (1997) 1-26). All groups of neighbours, from the nearest
to the tenth, share lambda and c, so that the fit looks to d = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from lostmotion.contracts import Array
from lostmotion_plugins.quantifiers._kernels_divergence import COUNT, FAR, LOG, NEAR
from lostmotion_plugins.quantifiers.divergence import BLOCKS, Spread, States

WITHIN = 0.393
"""The share of a Gaussian in the plane that lies within one standard deviation: 1 - exp(-1/2)."""
BELIEVED = 0.7
"""How much of the loss to noise is put back: all of it is too much by half as tests with 1 and 2 % noise have it."""
DOUBT = 0.25
"""Standard deviation of the above."""
STARTS, ENDS = (0.7, 1.0), (0.2, 0.3)
"""The value: mean over fits that begin after this many e-folds, and end at this share of the distance of strangers."""
OTHER_STARTS, OTHER_ENDS = (0.7, 1.0, 1.4), (0.2, 0.3, 0.4)
LATE = (0.45, 0.6)
"""Ends to try where the usual one leaves nothing to fit."""
FLOOR = 0.03
"""Share of the value that is always doubtful: what the method was off by on systems with known exponents."""
POINTS = 16
FEW = 4
PARTED = 0.35
"""Samples, and e-folds, that a region must hold."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves (g, times): mean logarithm of distance, mean distance, share within the noise; averaged over a period."""

    log: Array
    far: Array
    near: Array
    raw: Array
    dt: float
    strangers: float


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
    intercept: float
    lost: float

    def interval(self, embedding: float) -> tuple[float, float]:
        """Return the central 95 % interval; `embedding` is the standard error (1/s) of the choice of delay vectors."""
        floor = FLOOR * abs(self.rate)
        wide = float(student.ppf(0.975, BLOCKS - 1)) * float(
            np.sqrt(self.record**2 + max(self.windows, floor) ** 2 + embedding**2 + self.noise**2)
        )
        return self.rate - wide, self.rate + wide


def smoothed(curve: Array, width: int) -> Array:
    """Return moving averages (..., times - width + 1) of a curve (..., times)."""
    total = np.concatenate([np.zeros((*curve.shape[:-1], 1)), np.cumsum(curve, axis=-1)], axis=-1)
    moved: Array = (total[..., width:] - total[..., :-width]) / width
    return moved


def curves(sums: Array, made: States, away: float) -> Curves:
    """Return the curves behind sums (g, times, 4)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = sums[..., :COUNT] / sums[..., COUNT:]
    width = min(made.smooth, mean.shape[1] - 1)
    log, far, near = (smoothed(mean[..., k], width) for k in (LOG, FAR, NEAR))
    return Curves(log, far, np.minimum(near / WITHIN, 1.0), mean[..., LOG], made.dt, away)


def domain(c: Curves, made: States, efolds: float, end: float) -> Domain | None:
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
    return Domain(begin, tuple(ends)) if ends[0] - begin >= FEW and parted >= PARTED else None


def line(c: Curves, where: Domain, believed: float) -> tuple[float, float]:
    """Return lambda (1/s) and the intercept of the first group, by least squares over all groups at once."""
    rows, values = [], []
    for g, end in enumerate(where.ends):
        if end - where.begin < FEW:
            continue
        at = np.unique(np.linspace(where.begin, end - 1, min(POINTS, end - where.begin)).astype(int))
        row = np.zeros((len(at), len(where.ends) + 2))
        row[:, g] = 1.0
        row[:, -2] = at * c.dt - believed * _integral(c.near[g], c.dt)[at]
        row[:, -1] = _integral(c.far[g], c.dt)[at] / c.strangers
        rows.append(row)
        values.append(c.log[g, at])
    found = np.linalg.lstsq(np.concatenate(rows), np.concatenate(values), rcond=None)[0]
    return float(found[-2]), float(found[0])


def _integral(curve: Array, dt: float) -> Array:
    return np.concatenate([[0.0], np.cumsum(0.5 * (curve[1:] + curve[:-1]) * dt)])


def _domains(c: Curves, made: States) -> tuple[Domain, ...]:
    """Return where the value is read: the usual windows, or where they are empty the first later one that is not."""
    usual: list[Domain] = []
    for end in (*ENDS, *LATE):
        found = [d for start in STARTS if (d := domain(c, made, start, end))]
        usual += found
        if usual and end >= ENDS[-1]:
            break
    return tuple(usual)


def growth(read: Spread, made: States) -> Growth | None:
    """Return the rate at which neighbours part, or None where there is nothing to read it from."""
    total = read.sums.sum(axis=0)
    c = curves(total, made, read.strangers)
    where = _domains(c, made)
    if not where:
        return None

    def value(part: Curves, believed: float = BELIEVED) -> float:
        return float(np.mean([line(part, d, believed)[0] for d in where]))

    left = np.array([value(curves(total - one, made, read.strangers)) for one in read.sums])
    record = float(np.sqrt((BLOCKS - 1) / BLOCKS * ((left - left.mean()) ** 2).sum()))
    others = [d for s in OTHER_STARTS for e in OTHER_ENDS if (d := domain(c, made, s, e))]
    variants = tuple(line(c, d, BELIEVED)[0] for d in others)
    spread = float(np.std(variants)) if len(variants) > 1 else 2.0 * FLOOR * abs(value(c))
    loss = value(c, 1.0) - value(c, 0.0)
    first = max(where, key=lambda d: d.ends[0] - d.begin)
    lost = float(c.near[0, first.begin : first.ends[0]].mean())
    return Growth(value(c), record, spread, DOUBT * loss, first, line(c, first, BELIEVED)[1], lost)
