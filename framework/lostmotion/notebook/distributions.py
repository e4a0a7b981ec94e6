"""Priors of parameters, with the usual names of their distributions."""

from __future__ import annotations

from typing import Any, Literal

from lostmotion.arguments import flag, number
from lostmotion.case import Prior
from lostmotion.errors import CaseError


def _make_prior(*, each: bool, scale: Literal["linear", "log"] = "linear", **numbers: float) -> Prior:
    given: dict[str, Any] = {name: number(value, f"the {name} of a prior") for name, value in numbers.items()}
    try:
        return Prior(**given, scale=scale, each=flag(each, "each"))
    except CaseError as err:
        raise CaseError(f"the prior {err}") from err


def Uniform(low: float, high: float, *, each: bool = False) -> Prior:  # noqa: N802 - named as distributions are
    """Return a uniform prior between two values; with `each` every recording has a value of its own."""
    return _make_prior(low=low, high=high, each=each)


def LogUniform(low: float, high: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return a prior that is uniform in the logarithm, between two positive values."""
    return _make_prior(low=low, high=high, scale="log", each=each)


def Normal(mean: float, sd: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return a normal prior."""
    return _make_prior(mean=mean, sd=sd, each=each)


def LogNormal(median: float, sd_log: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return a log-normal prior; `sd_log` is the standard deviation of the natural logarithm."""
    return _make_prior(median=median, sd_log=sd_log, each=each)


def HalfNormal(sd: float, *, each: bool = False) -> Prior:  # noqa: N802
    """Return the positive half of a normal prior about zero."""
    return _make_prior(half_sd=sd, each=each)
