"""Priors of parameters by their usual names."""

from __future__ import annotations

from lostmotion.case import Prior


def Uniform(low: float, high: float, *, each: bool = False) -> Prior:  # noqa: N802 - named as distributions are
    """Return a uniform prior between two values; with `each` every recording has a value of its own."""
    return Prior(low=low, high=high, each=each)


def LogUniform(low: float, high: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return a prior that is uniform in the logarithm, between two positive values."""
    return Prior(low=low, high=high, scale="log", each=each)


def Normal(mean: float, sd: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return a normal prior."""
    return Prior(mean=mean, sd=sd, each=each)


def LogNormal(median: float, sd_log: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return a log-normal prior; `sd_log` is the standard deviation of the natural logarithm."""
    return Prior(median=median, sd_log=sd_log, each=each)


def HalfNormal(sd: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return the positive half of a normal prior about zero."""
    return Prior(half_sd=sd, each=each)
