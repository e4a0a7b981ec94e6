"""Convergence diagnostics of a chain: autocorrelation time, effective sample size and split R-hat."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.contracts import Array
from lostmotion.results import rounded
from lostmotion.settings import DEFAULT, ChainSettings

if TYPE_CHECKING:
    import xarray as xr

GROUPS = 4
TAILS = (0.05, 0.95)
"""The quantiles of which the less certain one determines the effective sample size of the tails."""


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
    import arviz_stats

    columns = list(np.moveaxis(chain, 2, 0))
    where = {"chain_axis": 0, "draw_axis": 1}
    return ChainQuality(
        tau=compute_autocorrelation(chain),
        ess=np.array([float(arviz_stats.ess(c, method="bulk", **where)) for c in columns]),
        ess_tail=np.array([float(arviz_stats.ess(c, method="tail", prob=TAILS, **where)) for c in columns]),
        rhat=np.array([float(arviz_stats.rhat(group_walkers(c), **where)) for c in columns]),
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


def make_groups_of_draws(
    variables: Mapping[str, Array], log_density: Array, units: Mapping[str, str], attrs: Mapping[str, str | int]
) -> dict[str, xr.Dataset]:
    """Return the groups `posterior` and `sample_stats` of draws, each variable (chain, draw), in the layout of ArviZ.

    `variables` and `log_density` are (walkers, steps); `attrs` stand on both groups. There is no time of creation, so
    the same chain gives the same bytes.
    """
    import xarray as xr

    walkers, steps = log_density.shape
    dims, coords = ("chain", "draw"), {"chain": np.arange(walkers), "draw": np.arange(steps)}
    rows = {name: (dims, values, {"units": units[name]}) for name, values in variables.items()}
    said = {"long_name": "log posterior density in the coordinates of the sampler"}
    return {
        "posterior": xr.Dataset(rows, coords, attrs),
        "sample_stats": xr.Dataset({"lp": (dims, log_density, said)}, coords, attrs),
    }
