"""Noise reduction without a model, with the noise level before and after."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lostmotion.arguments import checked, instance, random
from lostmotion.contracts import Array, Denoiser, Quantifier, Series
from lostmotion.errors import ContractError
from lostmotion.results import Estimate


@dataclass(frozen=True, eq=False)
class Denoised:
    """A cleaned series with the noise level (share of the signal's standard deviation) before and after."""

    series: Series
    before: Estimate
    after: Estimate


@checked(
    series=instance(Series, "a Series, as lm.embed returns it"),
    denoiser=instance(Denoiser, "a denoiser, such as lm.registry.default().make('denoiser', NAME)"),
    meter=instance(Quantifier, "a quantifier, such as lm.registry.default().make('quantifier', NAME)"),
    rng=random,
)
def denoise(series: Series, denoiser: Denoiser, meter: Quantifier[Series], *, rng: np.random.Generator) -> Denoised:
    """Return the cleaned series; `meter` measures the noise, as a share of the signal's standard deviation.

    A series without measurable noise is returned unchanged. The remaining noise is not measured on the cleaned series,
    because it is no longer white there and no meter detects it. Instead, noise of the same level is added to the
    cleaned series and removed again; the remainder of this known noise gives the level. Raises `ContractError` when the
    denoiser does not return finite samples of the same length.
    """
    before = meter.estimate(series, rng=rng)
    if not before.value > 0.0:
        return Denoised(series, before, before)
    size = float(np.std(series.x))
    # With too low a limit a denoiser removes too little; a limit that is a little too high does no harm.
    most = before.high * size
    cleaned = replace(series, x=_clean_samples(series, denoiser, most, rng))
    again = replace(cleaned, x=cleaned.x + before.value * size * rng.normal(size=series.n))
    left = float(np.std(_clean_samples(again, denoiser, most, rng) - cleaned.x)) / size
    return Denoised(cleaned, before, _scale_level(before, left / before.value))


def _clean_samples(series: Series, denoiser: Denoiser, noise: float, rng: np.random.Generator) -> Array:
    """Return the cleaned samples (n,), finite."""
    x = np.asarray(denoiser.clean(series, noise=noise, rng=rng), dtype=float)
    if x.shape != series.x.shape or not np.isfinite(x).all():
        raise ContractError(
            f"{denoiser.name} returned an array {x.shape} with {int((~np.isfinite(x)).sum())} values that are not "
            f"finite, and {series.x.shape} finite values were expected: write to its author"
        )
    return x


def _scale_level(before: Estimate, share: float) -> Estimate:
    """Return the level multiplied by a share, with the same relative uncertainty."""
    value, low, high = (share * v for v in (before.value, before.low, before.high))
    return Estimate(value, low, high, before.status, before.unit, says=before.says)
