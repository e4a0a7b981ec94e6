"""Noise taken off without a model, its level measured before and after."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Denoiser, Quantifier, Series
from lostmotion.errors import ContractError
from lostmotion.results import Estimate


@dataclass(frozen=True, eq=False)
class Denoised:
    """A cleaned series with the noise level (share of the signal's standard deviation) before and after."""

    series: Series
    before: Estimate
    after: Estimate


def denoise(series: Series, denoiser: Denoiser, meter: Quantifier[Series], *, rng: np.random.Generator) -> Denoised:
    """Return the cleaned series; `meter` measures the noise, as a share of the signal's standard deviation.

    A series in which `meter` finds no noise comes back as it is. Raises `ContractError` when the denoiser returns
    something that is no series of the same length.
    """
    before = meter.estimate(series, rng=rng)
    if not before.value > 0.0:
        return Denoised(series, before, before)
    noise = before.value * float(np.std(series.x))
    x = np.asarray(denoiser.clean(series, noise=noise, rng=rng), dtype=float)
    if x.shape != series.x.shape or not np.isfinite(x).all():
        raise ContractError(
            f"{denoiser.name} returned an array {x.shape} with {int((~np.isfinite(x)).sum())} values that are not "
            f"finite, and {series.x.shape} finite values were wanted: write to its author"
        )
    cleaned = replace(series, x=x)
    return Denoised(cleaned, before, meter.estimate(cleaned, rng=rng))
