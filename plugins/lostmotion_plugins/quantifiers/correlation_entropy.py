"""The correlation entropy of a recording: how fast close orbits part, from how the correlation sum falls with time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.correlation import Effort, Sums, correlation_sums, jackknife
from lostmotion_plugins.quantifiers.correlation_curves import curve_of, refusal
from lostmotion_plugins.quantifiers.correlation_ready import Ready, ready
from lostmotion_plugins.quantifiers.noise import noise_level

Codes = NDArray[np.int64]
FIRST, PAIRS_FIRST = 8, 20_000_000
"""Dimensions and pairs of a first look, which says how long orbits stay together."""
NEAR = 6_000_000
"""Close pairs that are counted in full."""
EFOLDS = 4.5
"""The correlation sum shall fall by about this (natural logarithm) over the delay window."""
SHRINKS = 0.6
"""The share of the first look that is usually left in the end: the first value lies too high."""
ENOUGH = 300
LARGEST = 0.1
ABOVE_NOISE = 4.0
RISING = 0.25
"""What each dimension may add to the slope over radius: more is noise."""


@dataclass(frozen=True)
class CorrelationEntropy(Quantifier[Series]):
    """K2: the logarithm of the correlation sum falls by K2 in each second that a delay vector is longer.

    A lower bound of the sum of the positive exponents. It is read from the last of `dims` dimensions, with the delay
    stretched until the delay vectors are long enough; the fall from three dimensions before is counted as an error.
    """

    dims: int = 14
    pairs: int = 60_000_000
    name: ClassVar[str] = "correlation_entropy"
    paper: ClassVar[str] = "Grassberger, Procaccia, Phys. Rev. A 28 (1983) 2591-2593"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        if refused := refusal(data, min(self.dims, FIRST), unit=self.unit):
            return refused
        it = ready(data, rng)
        lag = self._stretched(it, data.embedding.theiler)
        marks = (self.dims - 6, self.dims - 3, self.dims)
        effort = Effort(pairs=self.pairs, near=NEAR, only=(2, *marks))
        sums = correlation_sums(it.x, lag, self.dims, theiler=data.embedding.theiler, effort=effort)
        noise = noise_level(data.x, data.embedding).value
        floor = max(3.0 * it.step, ABOVE_NOISE * noise * float(np.std(it.x)))
        curve = curve_of(sums, None)
        radii = _radii(sums, floor)
        details = {"lag": float(lag), "noise": noise, "pairs": float(sums.pairs.sum()), **it.details}
        if len(radii) < 4:
            return _declined(noise, curve, details)
        return _read(sums, radii, lag * it.dt, curve=curve, details=details)

    def _stretched(self, it: Ready, theiler: int) -> int:
        """Return the delay (samples) at which the delay vectors are as long as orbits stay together."""
        longest = max(1, len(it.x) // 8 // (self.dims - 1))
        lag = min(it.lag, longest)
        for dims, shrinks in ((FIRST, SHRINKS), (self.dims, 1.0)):
            dims = min(dims, 1 + len(it.x) // (4 * lag))
            effort = Effort(PAIRS_FIRST, near=0, only=(dims - 2, dims))
            sums = correlation_sums(it.x, lag, dims, theiler=theiler, effort=effort)
            at = int(np.argmax(sums.total[-1] >= 10 * ENOUGH))
            if sums.total[-1, at] < ENOUGH or dims < 3:
                break
            fall = math.log(sums.total[-3, at] / sums.total[-1, at]) / (2 * lag)
            wanted = EFOLDS / (shrinks * max(fall, 1e-9)) / (self.dims - 1)
            lag = max(1, min(longest, max(it.lag, int(wanted))))
        return lag


def _radii(sums: Sums, floor: float) -> Codes:
    """Return the codes (k,) of the radii to read from: two octaves from where there are enough pairs."""
    seen = (sums.total[-1] >= max(ENOUGH, 3.0 * sums.total[-1, 0])) & (sums.radii >= floor)
    found = np.flatnonzero(seen & (sums.radii <= LARGEST * sums.extent))
    return np.asarray(found[:17], dtype=np.int64)


def _falls(total: Array, codes: Codes) -> tuple[Array, Array]:
    """Return how far the logarithm of the sum falls by dimension (..., codes): at the end, and three before."""
    low, middle, high = (np.log(np.maximum(total[..., m, codes], 0.5)) for m in (-7, -4, -1))
    return (middle - high) / 3.0, (low - middle) / 3.0


def _read(sums: Sums, codes: Codes, delay: float, *, curve: dict[str, Array], details: dict[str, float]) -> Estimate:
    """Return the entropy, its error from blocks, radii, and what the last three dimensions still changed."""
    last, before = _falls(sums.total, codes)
    left, _ = _falls(sums.without_one(), codes)
    octaves = np.log(sums.radii[codes[-1]] / sums.radii[codes[0]])
    if (last[0] - last[-1]) / octaves > RISING:
        text = "The entropy rises without end at smaller radii, as that of noise does: there is no rate to read."
        return Estimate.refused("rising", text, unit="1/s", curve=curve, details=details)
    value = float(last.mean()) / delay
    change = abs(float(before.mean()) / delay - value)
    error = math.hypot(float(jackknife(left.mean(axis=-1))) / delay, float(last.std()) / delay, 0.5 * change)
    ends = {"r_low": float(sums.radii[codes[0]]), "r_high": float(sums.radii[codes[-1]]), "change": change}
    return Estimate(value, value - 1.96 * error, value + 1.96 * error, "ok", "1/s", curve, "", {**details, **ends})


def _declined(noise: float, curve: dict[str, Array], details: dict[str, float]) -> Estimate:
    if noise > 0.5:
        says = "Nearly all of it is noise, whose entropy rises without end at smaller radii: there is no rate to read."
        return Estimate.refused("rising", says, unit="1/s", curve=curve, details=details)
    if noise > 0.0:
        says = (
            f"The noise is {100.0 * noise:.2g} % of the motion, and above {ABOVE_NOISE:g} standard deviations of it "
            "too few orbits stay together: reduce the noise first."
        )
        return Estimate.refused("below_noise", says, unit="1/s", curve=curve, details=details)
    says = "Too few pairs of orbits stay together for as long as it takes: record longer."
    return Estimate.refused("too_few_neighbours", says, unit="1/s", curve=curve, details=details)
