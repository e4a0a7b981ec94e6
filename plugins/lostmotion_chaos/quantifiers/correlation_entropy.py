"""The correlation entropy of a recording: the rate at which the correlation sum falls with the delay window."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_chaos.quantifiers.correlation import Effort, Sums, compute_correlation_sums, jackknife
from lostmotion_chaos.quantifiers.correlation_curves import collect_curves, refuse_unusable
from lostmotion_chaos.quantifiers.correlation_ready import PreparedSeries, prepare_series
from lostmotion_chaos.quantifiers.noise import estimate_noise_level

Codes = NDArray[np.int64]
FIRST_DIMS, FIRST_PAIRS = 8, 20_000_000
"""Dimensions and pairs of a first estimate, from which the delay is chosen."""
NEAR_PAIRS = 6_000_000
"""Close pairs that are counted completely."""
WANTED_EFOLDS = 4.5
"""The delay is chosen such that the correlation sum falls by so much (natural logarithm) over the delay window. Chosen
by experience; no measurement recorded."""
FIRST_EXCESS = 0.6
"""The final rate is usually this share of the first estimate, which is too high. Chosen by experience; no measurement
recorded."""
LEAST_PAIRS = 300
"""Pairs within the smallest radius. Chosen by experience; no measurement recorded."""
LARGEST_SHARE = 0.1
"""The largest radius, as a share of the range of the series. Chosen by experience; no measurement recorded."""
ABOVE_NOISE = 4.0
"""The smallest radius in standard deviations of the noise. Chosen by experience; no measurement recorded."""
MOST_RISE = 0.25
"""A larger increase of the slope over radius with each dimension is due to noise. Chosen by experience; no measurement
recorded."""


@dataclass(frozen=True)
class CorrelationEntropy(Quantifier[Series]):
    """K2: the logarithm of the correlation sum falls by K2 for each second by which a delay vector is longer.

    K2 is a lower bound of the sum of the positive exponents. It is read from the last of `dims` dimensions, with a
    delay that makes the delay vectors long enough; the change over the last three dimensions counts as an error.
    """

    dims: int = 14
    pairs: int = 60_000_000
    name: ClassVar[str] = "correlation_entropy"
    paper: ClassVar[str] = "Grassberger, Procaccia, Phys. Rev. A 28 (1983) 2591-2593"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        if refused := refuse_unusable(data, min(self.dims, FIRST_DIMS), unit=self.unit):
            return refused
        it = prepare_series(data, rng)
        lag = self._stretch_delay(it, data.embedding.theiler)
        marks = (self.dims - 6, self.dims - 3, self.dims)
        effort = Effort(pairs=self.pairs, near=NEAR_PAIRS, only=(2, *marks))
        sums = compute_correlation_sums(it.x, lag, self.dims, theiler=data.embedding.theiler, effort=effort)
        noise = estimate_noise_level(data.x, data.embedding).value
        floor = max(3.0 * it.step, ABOVE_NOISE * noise * float(np.std(it.x)))
        curve = collect_curves(sums, None)
        radii = _choose_radii(sums, floor)
        details = {"lag": float(lag), "noise": noise, "pairs": float(sums.pairs.sum()), **it.details}
        if len(radii) < 4:
            return _refuse(noise, curve, details)
        return _read_entropy(sums, radii, lag * it.dt, curve=curve, details=details)

    def _stretch_delay(self, it: PreparedSeries, theiler: int) -> int:
        """Return the delay (samples) at which the correlation sum falls by `WANTED_EFOLDS` over the delay window."""
        longest = max(1, len(it.x) // 8 // (self.dims - 1))
        lag = min(it.lag, longest)
        for dims, shrinks in ((FIRST_DIMS, FIRST_EXCESS), (self.dims, 1.0)):
            dims = min(dims, 1 + len(it.x) // (4 * lag))
            effort = Effort(FIRST_PAIRS, near=0, only=(dims - 2, dims))
            sums = compute_correlation_sums(it.x, lag, dims, theiler=theiler, effort=effort)
            at = int(np.argmax(sums.total[-1] >= 10 * LEAST_PAIRS))
            if sums.total[-1, at] < LEAST_PAIRS or dims < 3:
                break
            fall = math.log(sums.total[-3, at] / sums.total[-1, at]) / (2 * lag)
            wanted = WANTED_EFOLDS / (shrinks * max(fall, 1e-9)) / (self.dims - 1)
            lag = max(1, min(longest, max(it.lag, int(wanted))))
        return lag


def _choose_radii(sums: Sums, floor: float) -> Codes:
    """Return the codes (k,) of the radii that are used: two octaves, from where there are enough pairs."""
    seen = (sums.total[-1] >= max(LEAST_PAIRS, 3.0 * sums.total[-1, 0])) & (sums.radii >= floor)
    found = np.flatnonzero(seen & (sums.radii <= LARGEST_SHARE * sums.extent))
    return np.asarray(found[:17], dtype=np.int64)


def _measure_falls(total: Array, codes: Codes) -> tuple[Array, Array]:
    """Return the fall of the logarithm of the sum in each dimension (..., codes): over the last three, and before."""
    low, middle, high = (np.log(np.maximum(total[..., m, codes], 0.5)) for m in (-7, -4, -1))
    return (middle - high) / 3.0, (low - middle) / 3.0


def _read_entropy(
    sums: Sums, codes: Codes, delay: float, *, curve: dict[str, Array], details: dict[str, float]
) -> Estimate:
    """Return the entropy with its error from blocks, radii and the change over the last three dimensions."""
    last, before = _measure_falls(sums.total, codes)
    left, _ = _measure_falls(sums.without_one(), codes)
    octaves = np.log(sums.radii[codes[-1]] / sums.radii[codes[0]])
    if (last[0] - last[-1]) / octaves > MOST_RISE:
        text = "The entropy rises without limit at smaller radii, as that of noise does: there is no rate to read."
        return Estimate.refused("rising", text, unit="1/s", curve=curve, details=details)
    value = float(last.mean()) / delay
    change = abs(float(before.mean()) / delay - value)
    error = math.hypot(float(jackknife(left.mean(axis=-1))) / delay, float(last.std()) / delay, 0.5 * change)
    ends = {"r_low": float(sums.radii[codes[0]]), "r_high": float(sums.radii[codes[-1]]), "change": change}
    return Estimate(value, value - 1.96 * error, value + 1.96 * error, "ok", "1/s", curve, "", {**details, **ends})


def _refuse(noise: float, curve: dict[str, Array], details: dict[str, float]) -> Estimate:
    """Return the refusal of a recording with too few radii: because of noise, or of its length."""
    if noise > 0.5:
        says = "The recording is mostly noise, whose entropy rises without limit at smaller radii: no rate can be read."
        return Estimate.refused("rising", says, unit="1/s", curve=curve, details=details)
    if noise > 0.0:
        says = (
            f"The noise is {100.0 * noise:.2g} % of the motion, and above {ABOVE_NOISE:g} standard deviations of it "
            "too few orbits stay together: reduce the noise first."
        )
        return Estimate.refused("below_noise", says, unit="1/s", curve=curve, details=details)
    says = "Too few pairs of orbits stay close over the delay window: record longer."
    return Estimate.refused("too_few_neighbours", says, unit="1/s", curve=curve, details=details)
