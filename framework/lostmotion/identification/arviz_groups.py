"""Groups of a posterior for ArviZ: pointwise log-likelihood, observed data, posterior predictive draws, prior draws."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import CaseFile
from lostmotion.contracts import Array
from lostmotion.identification.sampling import SampledPosterior, Task
from lostmotion.likelihood.posterior import Posterior

if TYPE_CHECKING:
    import xarray as xr

Indices = NDArray[np.intp]
BLOCKS = 100
"""Number of blocks of consecutive readings, each with its log-likelihood: `arviz.loo` leaves out one block."""
REPLICATED = 300
"""Number of readings with stored replicates, evenly distributed over the recordings."""
PRIOR_DRAWS = 1000
POINTS_PER_CALL = 256


def make_groups(
    task: Task, result: SampledPosterior, case: CaseFile, rng: np.random.Generator
) -> dict[str, xr.Dataset]:
    """Return the groups `log_likelihood`, `observed_data`, `posterior_predictive` and `prior` of a sampled posterior.

    A replicate is the one-step prediction of a reading from those before it, with a random error: the motion may be
    chaotic, so that readings far ahead cannot be predicted.
    """
    import xarray as xr

    posterior = task.posterior
    if not isinstance(posterior, Posterior):
        return {}
    told = predict_readings(posterior, task.coordinates(result.draws), result.chain.shape[:2], rng)
    prior = xr.Dataset(_draw_prior(case, result, rng))
    return {**told, "prior": prior.assign_coords({str(dim): np.arange(n) for dim, n in prior.sizes.items()})}


def predict_readings(
    posterior: Posterior, thetas: Array, shape: tuple[int, int], rng: np.random.Generator
) -> dict[str, xr.Dataset]:
    """Return the groups `log_likelihood`, `observed_data` and `posterior_predictive` for points in coordinates.

    The points `thetas` (chains * draws, coordinates) are draws of `shape` (chains, draws).
    """
    import xarray as xr

    readings = np.concatenate([observation.readings.ravel() for observation in posterior.observations])
    taken = np.flatnonzero(np.isfinite(readings))
    picked = taken[np.unique(np.linspace(0, len(taken) - 1, REPLICATED).astype(int))]
    edges = np.unique(np.linspace(0, len(readings), BLOCKS + 1).astype(int))[:-1]
    terms, replicates = _predict_blocks(posterior, thetas, readings, (edges, picked), rng)
    groups = {
        "log_likelihood": xr.Dataset({"readings": (("chain", "draw", "block"), terms.reshape(*shape, -1))}),
        "observed_data": xr.Dataset({"readings": (("reading",), readings[picked])}),
        "posterior_predictive": xr.Dataset(
            {"readings": (("chain", "draw", "reading"), replicates.reshape(*shape, -1).astype(np.float32))}
        ),
    }
    return {
        name: data.assign_coords(
            {str(dim): picked if dim == "reading" else np.arange(n) for dim, n in data.sizes.items()}
        )
        for name, data in groups.items()
    }


def _predict_blocks(
    posterior: Posterior, thetas: Array, readings: Array, where: tuple[Indices, Indices], rng: np.random.Generator
) -> tuple[Array, Array]:
    """Return the log-likelihood of each block (draws, blocks), and replicates of some readings (draws, shown)."""
    edges, picked = where
    terms, replicates = [], []
    for first in range(0, len(thetas), POINTS_PER_CALL):
        seen = posterior.innovations(thetas[first : first + POINTS_PER_CALL])
        each = -0.5 * (seen.errors**2 / seen.variances + np.log(2.0 * np.pi * seen.variances))
        terms.append(np.add.reduceat(each, edges, axis=1))
        spread = np.sqrt(seen.variances[:, picked])
        replicates.append(readings[picked] - seen.errors[:, picked] + spread * rng.standard_normal(spread.shape))
    return np.concatenate(terms), np.concatenate(replicates)


def _draw_prior(
    case: CaseFile, result: SampledPosterior, rng: np.random.Generator
) -> Mapping[str, tuple[tuple[str, str], Array]]:
    """Return draws (1, PRIOR_DRAWS) of the parameters with a prior in the case."""
    named = [name for name in result.keys if name in case.estimate]
    shares = rng.uniform(size=(len(named), PRIOR_DRAWS))
    return {
        name: (("chain", "draw"), np.array([[case.estimate[name].quantile(share) for share in row]]))
        for name, row in zip(named, shares, strict=True)
    }
