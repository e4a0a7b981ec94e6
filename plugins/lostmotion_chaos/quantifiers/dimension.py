"""The correlation dimension of a recording, with an interval that includes systematic errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_chaos.quantifiers.correlation import Effort, Sums, compute_correlation_sums
from lostmotion_chaos.quantifiers.correlation_curves import (
    choose_dims,
    collect_curves,
    estimate_quick_slope,
    estimate_takens,
    measure_flatness,
    refuse_unusable,
)
from lostmotion_chaos.quantifiers.correlation_entropy import CorrelationEntropy
from lostmotion_chaos.quantifiers.correlation_plateau import AGREEING_DIMS, Plateau, find_plateau, measure_rise
from lostmotion_chaos.quantifiers.correlation_ready import PreparedSeries, prepare_series
from lostmotion_chaos.quantifiers.noise import EXCESS, RADIUS, estimate_noise_level

__all__ = ["CorrelationDimension", "CorrelationEntropy"]
OTHER_DELAYS = (0.7, 1.4)
"""Other delays that are tried, as shares of the given one; the differences of the results count as an error. Chosen by
experience; no measurement recorded."""
MOST_BEND = 0.25
"""With a larger bend, as a share of the slope, there is no scaling region. Chosen by experience; no measurement
recorded."""
MOST_TILT = 0.2
"""With a larger change of the slope from one end of the plateau to the other, as a share of the slope, there is no
plateau: the interval of a dimension is seldom wider, so a larger change would look like another dimension."""
MOST_SCATTER = 0.15
"""With a larger scatter of the local slopes within the plateau, as a share of the slope, there is no plateau. On flows,
maps and tori of known dimension they scatter by 0.02 to 0.14: `python benchmarks/verdicts.py --set wide --figures`."""
WIDER_SHARE = 0.2
"""The largest radius as a share of the range, where noise or few pairs leave too little below the usual share. Chosen
by experience; no measurement recorded."""
MOST_RISE_FAR = 0.25
"""The largest increase with each dimension at these radii, where weak noise has no effect yet. Chosen by experience; no
measurement recorded."""
MOST_RISE = 0.12
"""The largest increase with each dimension on a plateau. Chosen by experience; no measurement recorded."""
ABOVE_NOISE = 4.0
"""Where noise is found, the smallest radius in standard deviations of the noise. Chosen by experience; no measurement
recorded."""
NOISE_DIMENSION = float(EXCESS[0] * RADIUS[0] ** 2)
"""The slope that noise adds with one unnecessary coordinate, at a radius of one standard deviation; it falls with the
square of the radius. It counts as an error, since noise increases the slope well before it causes a visible bend."""
NEAR_PAIRS, NEAR_PAIRS_AGAIN = 6_000_000, 2_000_000
"""Close pairs that are counted completely for the given delay, and for each other one."""


@dataclass(frozen=True)
class CorrelationDimension(Quantifier[Series]):
    """The slope of the correlation sum over radius, where it is the same for all radii and all larger dimensions.

    `dims` = 0 uses three dimensions more than the embedding. With `takens` the value is the estimate of Takens over the
    same radii. `fast` gives a slope at a fixed share of pairs in one dimension, which is a test statistic and no
    dimension.
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
        dims = choose_dims(data, self.dims)
        if refused := refuse_unusable(data, dims):
            return refused
        if self.fast:
            return estimate_quick_slope(data)
        it = prepare_series(data, rng)
        sums = compute_correlation_sums(
            it.x, it.lag, dims, theiler=data.embedding.theiler, effort=Effort(self.pairs, NEAR_PAIRS)
        )
        found = find_plateau(sums, smallest=3.0 * it.step)
        noise = 0.0
        if found is None or _is_doubtful(found):
            noise = estimate_noise_level(data.x, data.embedding).value
            floor = max(3.0 * it.step, ABOVE_NOISE * noise * float(np.std(it.x)))
            rest = find_plateau(sums, smallest=floor, largest=WIDER_SHARE)
            found = found if rest is None and noise == 0.0 else rest
        curve = collect_curves(sums, found)
        details = {"pairs": float(sums.pairs.sum()), "ties": sums.ties(1), "noise": noise, **it.details}
        if found is not None:
            details["tilt"], details["scatter"] = measure_flatness(curve, found)
            details["r_low"], details["r_high"] = found.ends
        if found is None or _find_fault(found) or _is_uneven(details):
            return _refuse(found, sums, noise * float(np.std(it.x)), curve, details)
        return self._make_estimate(found, sums, it, curve, details)

    def _make_estimate(
        self, found: Plateau, sums: Sums, it: PreparedSeries, curve: dict[str, Array], details: dict[str, float]
    ) -> Estimate:
        """Return the value with its interval, which includes the change with the delay."""
        apart = [found.change(sums, self._count_again(it, sums, found, share)) for share in OTHER_DELAYS]
        low, high = found.ends
        blur = NOISE_DIMENSION * (details["noise"] * float(np.std(it.x))) ** 2 / (low * high)
        error = math.hypot(found.error, float(np.std([0.0, *apart])), blur)
        total = sums.total[found.dims]
        takens = float(np.mean([estimate_takens(t, sums.radii, low, high) for t in total]))
        value = takens if self.takens and math.isfinite(takens) else found.mean
        details |= {"takens": takens, "dim": float(found.first), "rise": found.rise}
        says = it.says
        return Estimate(value, value - 1.96 * error, value + 1.96 * error, "ok", "1", curve, says, details)

    def _count_again(self, it: PreparedSeries, sums: Sums, found: Plateau, share: float) -> Sums:
        """Return the sums with this share of the delay, and a delay that differs by at least one sample."""
        lag = round(it.lag * share)
        lag = max(1, lag + (lag == it.lag) * (1 if share > 1.0 else -1))
        effort = Effort(
            pairs=self.pairs // 4, near=NEAR_PAIRS_AGAIN, only=(2, *range(found.first, found.first + AGREEING_DIMS))
        )
        return compute_correlation_sums(it.x, lag, sums.dims, theiler=sums.theiler, effort=effort)


def _is_doubtful(found: Plateau) -> bool:
    """Return whether noise may have an effect: there is a bend, a rise, or a wide interval."""
    bend = float(found.bend[found.dims].mean())
    return bend > 0.5 * MOST_BEND * found.mean or abs(found.rise) > 0.5 * MOST_RISE or found.error > 0.08


def _find_fault(found: Plateau) -> str:
    """Return the status of a plateau that is not accepted, or an empty string."""
    if found.rise > MOST_RISE:
        return "rising"
    bent = float(found.bend[found.dims].mean()) > MOST_BEND * found.mean
    return "no_scaling_region" if bent or 1.96 * found.error > MOST_BEND * found.mean else ""


def _is_uneven(details: dict[str, float]) -> bool:
    """Return whether the local slopes within a plateau change or scatter too much."""
    return details["tilt"] > MOST_TILT or details["scatter"] > MOST_SCATTER


def _refuse(
    found: Plateau | None, sums: Sums, noise: float, curve: dict[str, Array], details: dict[str, float]
) -> Estimate:
    """Return the refusal that follows from the slopes, the noise (in the unit of the series) and the ties."""
    if measure_rise(sums, WIDER_SHARE) > MOST_RISE_FAR or (found is not None and found.rise > MOST_RISE):
        says = "The slope rises with every dimension of the embedding, as that of noise does: there is no dimension."
        return Estimate.refused("rising", says, curve=curve, details=details)
    if 8.0 * ABOVE_NOISE * noise > WIDER_SHARE * sums.extent:
        says = (
            f"The noise is {100.0 * details['noise']:.2g} % of the motion, and above {ABOVE_NOISE:g} standard "
            "deviations of it the correlation sum has no scaling region: reduce the noise first."
        )
        return Estimate.refused("below_noise", says, curve=curve, details=details)
    if details["ties"] > 1e-3:
        says = (
            f"{100.0 * details['ties']:.2g} % of the pairs agree to the last digit, as in a motion that repeats itself "
            "exactly or is recorded in coarse steps: no slope can be read."
        )
        return Estimate.refused("no_scaling_region", says, curve=curve, details=details)
    if found is None:
        says = "Too few pairs of points come close in three successive dimensions: record longer."
        return Estimate.refused("too_few_neighbours", says, curve=curve, details=details)
    if _is_uneven(details) and not _find_fault(found):
        low, high = found.ends
        says = (
            f"Between the radii {low:.3g} and {high:.3g} the local slope changes by {100 * details['tilt']:.0f} % and "
            f"scatters by {100 * details['scatter']:.0f} %, where a plateau changes by at most {100 * MOST_TILT:.0f} % "
            f"and scatters by at most {100 * MOST_SCATTER:.0f} %: there is no dimension to read."
        )
        return Estimate.refused("no_scaling_region", says, curve=curve, details=details)
    says = "The slope changes with the radius everywhere: there is no scaling region."
    return Estimate.refused("no_scaling_region", says, curve=curve, details=details)
