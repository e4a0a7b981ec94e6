"""The correlation dimension of a recording, with an interval that counts what is unknown about it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.correlation import Effort, Sums, correlation_sums
from lostmotion_plugins.quantifiers.correlation_curves import (
    curve_of,
    enough_dims,
    flatness,
    quick_slope,
    refusal,
    takens_theiler,
)
from lostmotion_plugins.quantifiers.correlation_entropy import CorrelationEntropy
from lostmotion_plugins.quantifiers.correlation_plateau import KEPT, Plateau, plateau, rise_at
from lostmotion_plugins.quantifiers.correlation_ready import Ready, ready
from lostmotion_plugins.quantifiers.noise import EXCESS, RADIUS, noise_level

__all__ = ["CorrelationDimension", "CorrelationEntropy"]
OTHER_DELAYS = (0.7, 1.4)
"""Delays that are tried beside the given one, as shares of it: what they disagree about is an error too."""
BENT = 0.25
"""A bend of this share of the slope is no straight piece."""
TILT = 0.2
"""A slope that changes by more than this share from one end of the plateau to the other is none: an interval of a
dimension is seldom wider than that, so a larger change would be seen as another dimension."""
SCATTER = 0.15
"""Local slopes that scatter by more than this share within the plateau make none. On flows, maps and tori of known
dimension they scatter by 0.02 to 0.14: `python benchmarks/verdicts.py --set wide --figures`."""
WIDER = 0.2
"""Radii go up to this share of the range where noise or want of pairs leaves too little below the usual share."""
RISING_FAR = 0.25
"""What a dimension may add at these radii, where a little noise is not felt yet."""
RISING = 0.12
"""What a dimension may add where the value should have settled."""
ABOVE_NOISE = 4.0
"""Standard deviations of the noise below which no radius is looked at, once noise is seen."""
SPARE = float(EXCESS[0] * RADIUS[0] ** 2)
"""What noise adds for one coordinate too many, at a radius of one standard deviation; it falls with the square of the
radius. So much is counted as an error: noise shows up as a slope that is too large long before it shows as a bend."""
NEAR, NEAR_AGAIN = 6_000_000, 2_000_000
"""Close pairs that are counted in full for the delay that is given, and for another one."""


@dataclass(frozen=True)
class CorrelationDimension(Quantifier[Series]):
    """The slope of the correlation sum over radius, where it is the same for all radii and all larger dimensions.

    `dims` = 0 takes three beyond the embedding's. `takens` gives the estimate of Takens over the same radii as the
    value. `fast` gives a slope at a fixed share of pairs and one dimension, noise or not: a statistic, no dimension.
    """

    dims: int = 0
    takens: bool = False
    fast: bool = False
    pairs: int = 60_000_000
    name: ClassVar[str] = "correlation_dimension"
    paper: ClassVar[str] = (
        "Grassberger, Procaccia, Physica D 9 (1983) 189-208; Theiler, Phys. Rev. A 34 (1986) 2427-2432; "
        "Takens, Lect. Notes Math. 1125 (1985) 99-106"
    )
    unit: ClassVar[str] = "1"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        dims = enough_dims(data, self.dims)
        if refused := refusal(data, dims):
            return refused
        if self.fast:
            return quick_slope(data)
        it = ready(data, rng)
        sums = correlation_sums(it.x, it.lag, dims, theiler=data.embedding.theiler, effort=Effort(self.pairs, NEAR))
        found = plateau(sums, smallest=3.0 * it.step)
        noise = 0.0
        if found is None or _doubtful(found):
            noise = noise_level(data.x, data.embedding).value
            floor = max(3.0 * it.step, ABOVE_NOISE * noise * float(np.std(it.x)))
            rest = plateau(sums, smallest=floor, largest=WIDER)
            found = found if rest is None and noise == 0.0 else rest
        curve = curve_of(sums, found)
        details = {"pairs": float(sums.pairs.sum()), "ties": sums.ties(1), "noise": noise, **it.details}
        if found is not None:
            details["tilt"], details["scatter"] = flatness(curve, found)
            details["r_low"], details["r_high"] = found.ends
        if found is None or _status(found) or _uneven(details):
            return _declined(found, sums, noise * float(np.std(it.x)), curve, details)
        return self._estimate(found, sums, it, curve, details)

    def _estimate(
        self, found: Plateau, sums: Sums, it: Ready, curve: dict[str, Array], details: dict[str, float]
    ) -> Estimate:
        """Return the value with its interval: the delay is varied too, and what that changes is counted."""
        apart = [found.change(sums, self._again(it, sums, found, share)) for share in OTHER_DELAYS]
        low, high = found.ends
        blur = SPARE * (details["noise"] * float(np.std(it.x))) ** 2 / (low * high)
        error = math.hypot(found.error, float(np.std([0.0, *apart])), blur)
        total = sums.total[found.dims]
        takens = float(np.mean([takens_theiler(t, sums.radii, low, high) for t in total]))
        value = takens if self.takens and math.isfinite(takens) else found.mean
        details |= {"takens": takens, "dim": float(found.first), "rise": found.rise}
        says = it.says
        return Estimate(value, value - 1.96 * error, value + 1.96 * error, "ok", "1", curve, says, details)

    def _again(self, it: Ready, sums: Sums, found: Plateau, share: float) -> Sums:
        lag = round(it.lag * share)
        lag = max(1, lag + (lag == it.lag) * (1 if share > 1.0 else -1))
        effort = Effort(pairs=self.pairs // 4, near=NEAR_AGAIN, only=(2, *range(found.first, found.first + KEPT)))
        return correlation_sums(it.x, lag, sums.dims, theiler=sums.theiler, effort=effort)


def _doubtful(found: Plateau) -> bool:
    """Return whether noise may be in the way: a bend, a rise, or a wide interval."""
    bend = float(found.bend[found.dims].mean())
    return bend > 0.5 * BENT * found.mean or abs(found.rise) > 0.5 * RISING or found.error > 0.08


def _status(found: Plateau) -> str:
    """Return what is wrong with a plateau, or nothing."""
    if found.rise > RISING:
        return "rising"
    bent = float(found.bend[found.dims].mean()) > BENT * found.mean
    return "no_scaling_region" if bent or 1.96 * found.error > BENT * found.mean else ""


def _uneven(details: dict[str, float]) -> bool:
    """Return whether the local slopes within a plateau change or scatter too much for one."""
    return details["tilt"] > TILT or details["scatter"] > SCATTER


def _declined(
    found: Plateau | None, sums: Sums, noise: float, curve: dict[str, Array], details: dict[str, float]
) -> Estimate:
    """Return the refusal that the slopes, the noise (in the unit of the series) and the ties call for."""
    if rise_at(sums, WIDER) > RISING_FAR or (found is not None and found.rise > RISING):
        says = "The slope rises with every dimension of the embedding, as that of noise does: there is no dimension."
        return Estimate.refused("rising", says, curve=curve, details=details)
    if 8.0 * ABOVE_NOISE * noise > WIDER * sums.extent:
        says = (
            f"The noise is {100.0 * details['noise']:.2g} % of the motion, and above {ABOVE_NOISE:g} standard "
            "deviations of it no straight piece of the correlation sum is left: reduce the noise first."
        )
        return Estimate.refused("below_noise", says, curve=curve, details=details)
    if details["ties"] > 1e-3:
        says = (
            f"{100.0 * details['ties']:.2g} % of the pairs agree to the last digit, as in a motion that repeats itself "
            "exactly or is recorded in coarse steps: no slope can be read between these."
        )
        return Estimate.refused("no_scaling_region", says, curve=curve, details=details)
    if found is None:
        says = "Too few pairs of points come close in three successive dimensions: record longer."
        return Estimate.refused("too_few_neighbours", says, curve=curve, details=details)
    if _uneven(details) and not _status(found):
        low, high = found.ends
        says = (
            f"Between the radii {low:.3g} and {high:.3g} the local slope changes by {100 * details['tilt']:.0f} % and "
            f"scatters by {100 * details['scatter']:.0f} %, and a plateau changes by {100 * TILT:.0f} % and scatters "
            f"by {100 * SCATTER:.0f} % at most: there is no dimension to read."
        )
        return Estimate.refused("no_scaling_region", says, curve=curve, details=details)
    says = "The slope changes with the radius everywhere: there is no straight piece to read a dimension from."
    return Estimate.refused("no_scaling_region", says, curve=curve, details=details)
