"""Whether a chain may be believed: autocorrelation time, effective sample size and split R-hat."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.settings import DEFAULT, ChainSettings

GROUPS = 4


@dataclass(frozen=True)
class Quality:
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

    def lacks(self, ess: float, before: float, limits: ChainSettings = DEFAULT.chain) -> tuple[str, ...]:
        """Return what keeps the chain from being believed; `before` is the longest time at the last check."""
        slowest = max(self.slowest, 1.0)
        checks = {  # written so that what is not a number fails too
            f"{self.steps} steps are less than {limits.long:g} autocorrelation times of {slowest:.3g}": not (
                self.steps >= limits.long * slowest
            ),
            "the autocorrelation time still grows": not self.slowest - before < limits.steady * self.slowest,
            f"the effective sample size is {self.ess.min():.0f}, and {ess:g} is wanted": not self.ess.min() >= ess,
            f"R-hat is {self.rhat.max():.3f}, and {limits.agreed:g} at most is wanted": not self.rhat.max()
            <= limits.agreed,
        }
        return tuple(words for words, failed in checks.items() if failed)


def quality_of(chain: Array) -> Quality:
    """Return the quality of a chain (walkers, steps, parameters) from which the burn-in is gone."""
    arviz = quiet_arviz()
    columns = list(np.moveaxis(chain, 2, 0))
    return Quality(
        tau=autocorrelation(chain),
        ess=np.array([float(arviz.ess(c, method="bulk")) for c in columns]),
        ess_tail=np.array([float(arviz.ess(c, method="tail")) for c in columns]),
        rhat=np.array([float(arviz.rhat(grouped(c))) for c in columns]),
        steps=chain.shape[1],
    )


def autocorrelation(chain: Array) -> Array:
    """Return the integrated autocorrelation time (parameters,) in steps of a chain (walkers, steps, parameters)."""
    from emcee.autocorr import integrated_time

    with np.errstate(invalid="ignore"):  # a walker that never moved has no correlation: its time is infinite
        times = np.asarray(integrated_time(np.swapaxes(chain, 0, 1), tol=0, quiet=True), dtype=float)
    return np.where(np.isfinite(times), times, math.inf)


def grouped(walks: Array) -> Array:
    """Return walks (walkers, steps) as `GROUPS` chains, each of several walkers in the order of time.

    Halves of such a chain are halves in time, so that their split R-hat is the nested one for many short chains:
    Margossian et al., Bayesian Analysis (2024), doi 10.1214/24-BA1453.
    """
    size = len(walks) // GROUPS
    return np.stack([walks[i::GROUPS][:size].T.ravel() for i in range(GROUPS)])


def quiet_arviz() -> Any:
    """Return the module arviz, imported without its announcements."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import arviz
    return arviz


def inference_data(
    variables: Mapping[str, Array], log_density: Array, units: Mapping[str, str], attrs: Mapping[str, str | int]
) -> Any:
    """Return variables and log density, each (walkers, steps), as ArviZ's `InferenceData`, units in the attributes.

    The moment of its making is left out, so that the same chain gives the same bytes.
    """
    arviz = quiet_arviz()
    with warnings.catch_warnings():  # more walkers than steps are no mistake here
        warnings.simplefilter("ignore")
        data = arviz.from_dict(posterior=dict(variables), sample_stats={"lp": log_density})
    for group in (data.posterior, data.sample_stats):
        group.attrs = dict(attrs)
    for name, unit in units.items():
        data.posterior[name].attrs["units"] = unit
    data.sample_stats["lp"].attrs["long_name"] = "log posterior density in the coordinates of the sampler"
    return data
