"""How much of a recording is noise, from the correlation sum: below the noise, each new coordinate costs a dimension.

With a delay of one sample a clean motion adds next to nothing to its dimension from 4 to 8 coordinates, and white
noise adds up to one dimension for each. How much it adds at a radius depends on radius over noise only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Embedding, Estimate
from lostmotion_plugins.quantifiers.correlation import EIGHTHS, Effort, correlation_sums, jackknife

LOW, MIDDLE, HIGH = 4, 6, 8
"""The dimensions that are compared: 4 with 8, and 4 with 6 where pairs are few."""
EXCESS = np.array([0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7])
"""Dimensions added by a coordinate ..."""
RADIUS = 1.05 * np.array([5.56, 4.32, 3.63, 3.18, 2.86, 2.62, 2.41, 2.23, 2.06, 1.75, 1.46])
"""... at this radius in standard deviations of the noise: a flat piece of attractor with two dimensions under Gaussian
noise (the integral is in the tests), and 5 % more for its folds, as Lorenz and Lin's oscillator have them."""
SYSTEMATIC = 0.2
"""By how much (a 95 % share) the folds of other attractors move the result."""
SEEN = 0.3
"""Clean motions add up to 0.15 dimensions for a coordinate: more than this is noise."""
SPAN = EIGHTHS // 2
"""The codes over which a slope is taken."""
ENOUGH = 80
"""Pairs within a radius, in the larger dimension, from which on its slope is believed."""
LEAST = 500
SURE = 0.1
"""Standard error (of the logarithm) above which a first look is not enough."""
PAIRS, NEAR = 20_000_000, 8_000_000
"""Pairs that are looked at, and where they show no noise, close pairs that are counted in full."""


def noise_level(x: Array, embedding: Embedding) -> Estimate:
    """Return the standard deviation of white noise in `x` (n,), as a share of that of `x`.

    Only the Theiler window of `embedding` is used. Where no noise is seen the value is 0, and `high` is the most that
    could hide. The last two series are remembered by their samples: dimension, entropy and the host ask for the same.
    """
    need = max(LEAST, 3 * embedding.theiler)
    if len(x) < need:
        return Estimate.refused(
            "too_short", f"{len(x)} samples are too few to see noise in, and {need} are wanted: record longer."
        )
    if not np.ptp(x) > 0.0:
        return Estimate.refused("failed", "The series is constant: there is no noise in it, and no motion.")
    return _measured(np.ascontiguousarray(x, dtype=np.float64).tobytes(), embedding.theiler)


@lru_cache(maxsize=2)
def _measured(samples: bytes, theiler: int) -> Estimate:
    """Return the noise level of float64 samples, steps of the sensor made even by a dither that is always the same."""
    x = np.frombuffer(samples)
    step = quantisation(x)
    dithered = x + step * (np.random.default_rng(0).random(len(x)) - 0.5) if step > 0.0 else x
    found = _looked(dithered, theiler, step, 0)
    sure = found.value > 0.0 and found.details["spread"] < SURE
    return found if sure else _looked(dithered, theiler, step, NEAR)


def _looked(x: Array, theiler: int, step: float, near: int) -> Estimate:
    """Return the noise level, with so many close pairs counted in full; `step` is that of the sensor."""
    effort = Effort(pairs=PAIRS, near=near, only=(2, LOW, MIDDLE, HIGH) if near else (LOW, MIDDLE, HIGH))
    sums = correlation_sums(x, 1, HIGH, theiler=theiler, effort=effort)
    sd = float(np.std(x))
    radii, floor = sums.radii / sd, step / sd
    value, most = _read(sums.total, radii, floor)
    curve = {"radius": _middle(radii), "excess": _excess(sums.total, HIGH)}
    details = {"pairs": float(sums.pairs.sum()), "quantisation": floor, "spread": 0.0}
    if not value > 0.0:
        says = f"No noise is seen: it is at most {100 * most:.2g} % of the motion."
        return Estimate(0.0, 0.0, most, "ok", "1", curve, says, details)
    left = [_read(total, radii, floor)[0] for total in sums.without_one()]
    spread = float(jackknife(np.log([v if v > 0.0 else value for v in left])))
    details["spread"] = spread
    wide = float(np.exp(np.hypot(1.96 * spread, SYSTEMATIC)))
    value = float(np.sqrt(max(value**2 - floor**2 / 12.0, (0.2 * value) ** 2)))
    return Estimate(value, value / wide, min(1.2, value * wide), "ok", "1", curve, "", details)


def quantisation(x: Array) -> float:
    """Return the step of the sensor's least digit, or 0 where the samples do not lie on even steps."""
    levels = np.unique(x)
    if not 1 < len(levels) <= len(x) // 2:
        return 0.0
    apart = np.diff(levels)
    step = float(np.median(apart))
    off = apart / step - np.round(apart / step)
    return step if float(np.mean(np.abs(off) < 0.01)) > 0.95 else 0.0


def _middle(radii: Array) -> Array:
    return radii[SPAN // 2 : -(SPAN // 2)]


def _excess(total: Array, high: int) -> Array:
    """Return the dimensions that a coordinate adds (CODES - SPAN,), from slopes over half an octave; NaN: no pairs."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.log(total[high - 1]) - np.log(total[LOW - 1])
        rise = ratio[SPAN:] - ratio[:-SPAN]
    return np.asarray(np.where(np.isfinite(rise), rise, np.nan) / (np.log(2.0) * SPAN / EIGHTHS * (high - LOW)))


def _read(total: Array, radii: Array, floor: float) -> tuple[float, float]:
    """Return the noise, or 0 where there is none to be seen, and the most that may hide."""
    value, most = _crossing(total, radii, floor, HIGH)
    if value > 0.0:
        return value, most
    other = _crossing(total, radii, floor, MIDDLE)
    return other if other[0] > 0.0 else (0.0, max(most, other[1]))


def _crossing(total: Array, radii: Array, floor: float, high: int) -> tuple[float, float]:
    """Return what `_read` does, from dimensions LOW and `high`: where a coordinate adds half a dimension."""
    middle, excess = _middle(radii), _excess(total, high)
    fit = np.isfinite(excess) & (total[high - 1][:-SPAN] >= ENOUGH) & (middle > floor)
    if not fit.any():
        return 1.0, 1.0
    middle, excess = middle[fit], excess[fit]
    first = float(np.mean(excess[:SPAN]))
    most = float(middle[: SPAN // 2].mean() / np.interp(min(first, 0.5) + 0.15, EXCESS, RADIUS))
    if first < SEEN:
        return 0.0, most
    smooth = np.convolve(np.pad(excess, 1, mode="edge"), np.full(3, 1.0 / 3.0), "valid")
    below = np.flatnonzero(smooth < 0.5)
    at = int(below[0]) if len(below) else len(excess) - 1
    near = slice(max(0, at - SPAN), at + SPAN)
    good = (excess[near] > SEEN) & (excess[near] < 0.7)
    if not good.any():
        return float(middle[at] / np.interp(0.5, EXCESS, RADIUS)), most
    return float(np.exp(np.mean(np.log(middle[near] / np.interp(excess[near], EXCESS, RADIUS))[good]))), most


@dataclass(frozen=True)
class NoiseLevel(Quantifier[Series]):
    """Standard deviation of the noise as a share of that of the recording; 0 with a bound where none is seen."""

    name: ClassVar[str] = "noise_level"
    paper: ClassVar[str] = "Schreiber, Phys. Rev. E 48 (1993) R13-R16"
    unit: ClassVar[str] = "1"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        return noise_level(data.x, data.embedding)
