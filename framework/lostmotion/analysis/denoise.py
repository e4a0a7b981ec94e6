"""Noise taken off without a model, its level measured before and after."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array, Denoiser, Quantifier, Series
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

    A series in which `meter` finds no noise comes back as it is. What is left of the noise is not measured on the
    cleaned series, where it is no longer white and hides from any meter: noise of the same level is put on the cleaned
    series and cleaned off again, and what is left of that is known. Raises `ContractError` when the denoiser returns
    something that is no series of the same length.
    """
    before = meter.estimate(series, rng=rng)
    if not before.value > 0.0:
        return Denoised(series, before, before)
    size = float(np.std(series.x))
    # A denoiser that may take off less than there is stops short; one that may take off a little more does no harm.
    most = before.high * size
    cleaned = replace(series, x=_cleaned(series, denoiser, most, rng))
    again = replace(cleaned, x=cleaned.x + before.value * size * rng.normal(size=series.n))
    left = float(np.std(_cleaned(again, denoiser, most, rng) - cleaned.x)) / size
    return Denoised(cleaned, before, _scaled(before, left / before.value))


def _cleaned(series: Series, denoiser: Denoiser, noise: float, rng: np.random.Generator) -> Array:
    """Return the cleaned samples (n,), finite."""
    x = np.asarray(denoiser.clean(series, noise=noise, rng=rng), dtype=float)
    if x.shape != series.x.shape or not np.isfinite(x).all():
        raise ContractError(
            f"{denoiser.name} returned an array {x.shape} with {int((~np.isfinite(x)).sum())} values that are not "
            f"finite, and {series.x.shape} finite values were wanted: write to its author"
        )
    return x


def _scaled(before: Estimate, share: float) -> Estimate:
    """Return the level when so much of it is left; it is as uncertain as it was."""
    value, low, high = (share * v for v in (before.value, before.low, before.high))
    return Estimate(value, low, high, before.status, before.unit, says=before.says)
