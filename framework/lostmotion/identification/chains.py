"""Convergence diagnostics of a chain: autocorrelation time, effective sample size and split R-hat."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.results import rounded
from lostmotion.settings import DEFAULT, ChainSettings

GROUPS = 4


@dataclass(frozen=True)
class ChainQuality:
    """Autocorrelation times (steps), bulk and tail effective sample sizes and R-hat, each (parameters,)."""

    tau: Array
    ess: Array
    ess_tail: Array
    rhat: Array
    steps: int

    @property
    def slowest(self) -> float:
        """The longest autocorrelation time in steps."""
        return float(np.max(self.tau))

    def find_shortcomings(self, ess: float, before: float, limits: ChainSettings = DEFAULT.chain) -> tuple[str, ...]:
        """Return the convergence criteria that are not met; `before` is the longest autocorrelation time before."""
        slowest = max(self.slowest, 1.0)
        checks = {  # written so that NaN fails too
            f"{self.steps} steps are less than {limits.long:g} autocorrelation times of {rounded(slowest, 3)}": not (
                self.steps >= limits.long * slowest
            ),
            "the autocorrelation time still grows": not self.slowest - before < limits.steady * self.slowest,
            f"the effective sample size is {self.ess.min():.0f}, and {ess:g} is needed": not self.ess.min() >= ess,
            f"R-hat is {self.rhat.max():.3f}, and at most {limits.agreed:g} is allowed": not self.rhat.max()
            <= limits.agreed,
        }
        return tuple(words for words, failed in checks.items() if failed)


def measure_quality(chain: Array) -> ChainQuality:
    """Return the quality of a chain (walkers, steps, parameters) without burn-in."""
    arviz = import_arviz()
    columns = list(np.moveaxis(chain, 2, 0))
    return ChainQuality(
        tau=compute_autocorrelation(chain),
        ess=np.array([float(arviz.ess(c, method="bulk")) for c in columns]),
        ess_tail=np.array([float(arviz.ess(c, method="tail")) for c in columns]),
        rhat=np.array([float(arviz.rhat(group_walkers(c))) for c in columns]),
        steps=chain.shape[1],
    )


def compute_autocorrelation(chain: Array) -> Array:
    """Return the integrated autocorrelation time (parameters,) in steps of a chain (walkers, steps, parameters)."""
    from emcee.autocorr import integrated_time

    with np.errstate(invalid="ignore"):  # a walker that never moved gives NaN, which becomes an infinite time below
        times = np.asarray(integrated_time(np.swapaxes(chain, 0, 1), tol=0, quiet=True), dtype=float)
    return np.where(np.isfinite(times), times, math.inf)


def group_walkers(walks: Array) -> Array:
    """Return walks (walkers, steps) as `GROUPS` chains, each made of several walkers in the order of time.

    Halves of such a chain are halves in time, so their split R-hat is the nested R-hat for many short chains:
    Margossian et al., Bayesian Analysis (2024), doi 10.1214/24-BA1453.
    """
    size = len(walks) // GROUPS
    return np.stack([walks[i::GROUPS][:size].T.ravel() for i in range(GROUPS)])


def import_arviz() -> Any:
    """Return the module arviz, imported without its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import arviz
    return arviz


def make_inference_data(
    variables: Mapping[str, Array], log_density: Array, units: Mapping[str, str], attrs: Mapping[str, str | int]
) -> Any:
    """Return variables and log density, each (walkers, steps), as ArviZ's `InferenceData`, units in the attributes.

    The time of creation is left out, so that the same chain gives the same bytes.
    """
    arviz = import_arviz()
    with warnings.catch_warnings():  # arviz warns about more walkers than steps, which are intended here
        warnings.simplefilter("ignore")
        data = arviz.from_dict(posterior=dict(variables), sample_stats={"lp": log_density})
    for group in (data.posterior, data.sample_stats):
        group.attrs = dict(attrs)
    for name, unit in units.items():
        data.posterior[name].attrs["units"] = unit
    data.sample_stats["lp"].attrs["long_name"] = "log posterior density in the coordinates of the sampler"
    return data
