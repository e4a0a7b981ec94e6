"""The noise level of a recording, from the correlation sum: at radii below the noise, each coordinate adds a dimension.

With a delay of one sample, the dimension of a clean motion hardly increases from 4 to 8 coordinates, and white noise
adds up to one dimension for each coordinate. The increase at a radius depends only on radius over noise.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Embedding, Estimate
from lostmotion_chaos.quantifiers.correlation import Effort, compute_correlation_sums, jackknife
from lostmotion_chaos.quantifiers.correlation_boxes import EIGHTHS

LOW, MIDDLE, HIGH = 4, 6, 8
"""The dimensions that are compared: 4 with 8, and 4 with 6 where pairs are few."""
EXCESS = np.array([0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7])
"""Dimensions that a coordinate adds ..."""
RADIUS = 1.05 * np.array([5.56, 4.32, 3.63, 3.18, 2.86, 2.62, 2.41, 2.23, 2.06, 1.75, 1.46])
"""... at this radius in standard deviations of the noise: a flat piece of attractor with two dimensions under Gaussian
noise (the integral is in the tests), and 5 % more for its folds, as Lorenz and Lin's oscillator have them."""
SYSTEMATIC_ERROR = 0.2
"""The effect of the folds of other attractors on the logarithm of the result (half of a 95 % interval). Chosen by
experience; no measurement recorded."""
LEAST_EXCESS = 0.3
"""Clean motions add up to 0.15 dimensions for a coordinate; an increase of more than this is due to noise."""
SPAN = EIGHTHS // 2
"""The codes over which a slope is taken."""
LEAST_PAIRS = 80
"""Slopes are used at radii within which there are so many pairs, in the larger dimension. Chosen by experience; no
measurement recorded."""
LEAST_SAMPLES = 500
"""A shorter recording is refused. Chosen by experience; no measurement recorded."""
SURE_ERROR = 0.1
"""With a larger standard error (of the logarithm) the close pairs are counted completely as well. Chosen by experience;
no measurement recorded."""
MOST_PAIRS, NEAR_PAIRS = 20_000_000, 8_000_000
"""Pairs that are examined, and close pairs that are counted completely where the first ones are not sufficient."""


def estimate_noise_level(x: Array, embedding: Embedding) -> Estimate:
    """Return the standard deviation of white noise in `x` (n,), as a share of that of `x`.

    Only the Theiler window of `embedding` is used. Where no noise is found, the value is 0, and `high` is the largest
    noise that could remain undetected. Results of the last two series are cached by their samples, since dimension,
    entropy and the framework need the same one.
    """
    need = max(LEAST_SAMPLES, 3 * embedding.theiler)
    if len(x) < need:
        return Estimate.refused(
            "too_short", f"{len(x)} samples are too few to detect noise, and {need} are needed: record longer."
        )
    if not np.ptp(x) > 0.0:
        return Estimate.refused("failed", "The series is constant: it has neither noise nor motion.")
    return _measure(np.ascontiguousarray(x, dtype=np.float64).tobytes(), embedding.theiler)


@lru_cache(maxsize=2)
def _measure(samples: bytes, theiler: int) -> Estimate:
    """Return the noise level of float64 samples, with a dither of fixed seed over the steps of the sensor."""
    x = np.frombuffer(samples)
    step = find_quantisation(x)
    dithered = x + step * (np.random.default_rng(0).random(len(x)) - 0.5) if step > 0.0 else x
    found = _measure_once(dithered, theiler, step, 0)
    sure = found.value > 0.0 and found.details["spread"] < SURE_ERROR
    return found if sure else _measure_once(dithered, theiler, step, NEAR_PAIRS)


def _measure_once(x: Array, theiler: int, step: float, near: int) -> Estimate:
    """Return the noise level, with `near` close pairs counted completely; `step` is that of the sensor."""
    effort = Effort(pairs=MOST_PAIRS, near=near, only=(2, LOW, MIDDLE, HIGH) if near else (LOW, MIDDLE, HIGH))
    sums = compute_correlation_sums(x, 1, HIGH, theiler=theiler, effort=effort)
    sd = float(np.std(x))
    radii, floor = sums.radii / sd, step / sd
    value, most = _read_noise(sums.total, radii, floor)
    curve = {"radius": _select_middle(radii), "excess": _compute_excess(sums.total, HIGH)}
    details = {"pairs": float(sums.pairs.sum()), "quantisation": floor, "spread": 0.0}
    if not value > 0.0:
        says = f"No noise is found: it is at most {100 * most:.2g} % of the motion."
        return Estimate(0.0, 0.0, most, "ok", "1", curve, says, details)
    left = [_read_noise(total, radii, floor)[0] for total in sums.without_one()]
    spread = float(jackknife(np.log([v if v > 0.0 else value for v in left])))
    details["spread"] = spread
    wide = float(np.exp(np.hypot(1.96 * spread, SYSTEMATIC_ERROR)))
    value = float(np.sqrt(max(value**2 - floor**2 / 12.0, (0.2 * value) ** 2)))
    return Estimate(value, value / wide, min(1.2, value * wide), "ok", "1", curve, "", details)


def find_quantisation(x: Array) -> float:
    """Return the step of the least digit of the sensor, or 0 where the samples are not multiples of a step."""
    levels = np.unique(x)
    if not 1 < len(levels) <= len(x) // 2:
        return 0.0
    apart = np.diff(levels)
    step = float(np.median(apart))
    off = apart / step - np.round(apart / step)
    return step if float(np.mean(np.abs(off) < 0.01)) > 0.95 else 0.0


def _select_middle(radii: Array) -> Array:
    """Return the radii (CODES - SPAN,) in the middle of each slope."""
    return radii[SPAN // 2 : -(SPAN // 2)]


def _compute_excess(total: Array, high: int) -> Array:
    """Return the dimensions that a coordinate adds (CODES - SPAN,), from slopes over half an octave; NaN: no pairs."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.log(total[high - 1]) - np.log(total[LOW - 1])
        rise = ratio[SPAN:] - ratio[:-SPAN]
    return np.asarray(np.where(np.isfinite(rise), rise, np.nan) / (np.log(2.0) * SPAN / EIGHTHS * (high - LOW)))


def _read_noise(total: Array, radii: Array, floor: float) -> tuple[float, float]:
    """Return the noise, or 0 where none is found, and the largest noise that could remain undetected."""
    value, most = _find_crossing(total, radii, floor, HIGH)
    if value > 0.0:
        return value, most
    other = _find_crossing(total, radii, floor, MIDDLE)
    return other if other[0] > 0.0 else (0.0, max(most, other[1]))


def _find_crossing(total: Array, radii: Array, floor: float, high: int) -> tuple[float, float]:
    """Return the result of `_read_noise` from dimensions LOW and `high`: where a coordinate adds half a dimension."""
    middle, excess = _select_middle(radii), _compute_excess(total, high)
    fit = np.isfinite(excess) & (total[high - 1][:-SPAN] >= LEAST_PAIRS) & (middle > floor)
    if not fit.any():
        return 1.0, 1.0
    middle, excess = middle[fit], excess[fit]
    first = float(np.mean(excess[:SPAN]))
    most = float(middle[: SPAN // 2].mean() / np.interp(min(first, 0.5) + 0.15, EXCESS, RADIUS))
    if first < LEAST_EXCESS:
        return 0.0, most
    smooth = np.convolve(np.pad(excess, 1, mode="edge"), np.full(3, 1.0 / 3.0), "valid")
    below = np.flatnonzero(smooth < 0.5)
    at = int(below[0]) if len(below) else len(excess) - 1
    near = slice(max(0, at - SPAN), at + SPAN)
    good = (excess[near] > LEAST_EXCESS) & (excess[near] < 0.7)
    if not good.any():
        return float(middle[at] / np.interp(0.5, EXCESS, RADIUS)), most
    return float(np.exp(np.mean(np.log(middle[near] / np.interp(excess[near], EXCESS, RADIUS))[good]))), most


@dataclass(frozen=True)
class NoiseLevel(Quantifier[Series]):
    """Standard deviation of the noise as a share of that of the recording; 0 with a bound where none is found."""

    name: ClassVar[str] = "noise_level"
    paper: ClassVar[str] = "Schreiber, Phys. Rev. E 48 (1993) R13-R16"
    unit: ClassVar[str] = "1"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        return estimate_noise_level(data.x, data.embedding)
