"""What an identification says, ready for JSON: rows of parameters, how the sampling went, and sentences."""

from __future__ import annotations

from typing import Any

from lostmotion.likelihood.space import parted
from lostmotion.stages.identify import NOISES, Identification

SENSOR = (*NOISES.values(), "offset")
"""What is told apart from the parameters of the machine: noise levels, and the zero of a sensor."""


def statement(result: Identification, route: str) -> dict[str, Any]:
    """Return the content of `identification.json`, title and provenance left out; without convergence no interval."""
    rows = _parameters(result)
    noise = {name for name in rows if parted(name)[0] in SENSOR}
    return {
        "schema": "lostmotion.identification/1",
        "route": route,
        "converged": result.converged,
        "says": list(says(result)),
        "ess_min": float(result.quality.ess.min()),
        "ess_tail_min": float(result.quality.ess_tail.min()),
        "rhat_max": float(result.quality.rhat.max()),
        "parameters": {k: row for k, row in rows.items() if k not in noise},
        "noise": {k: row for k, row in rows.items() if k in noise},
        "sampling": _sampling(result),
        "log_likelihood_evaluations": result.evaluations,
    }


def _parameters(result: Identification) -> dict[str, dict[str, Any]]:
    intervals, sd, quality = result.intervals, result.sd, result.quality
    nothing = {"median": None, "low": None, "high": None}
    rows = {}
    for i, (key, unit) in enumerate(zip(result.keys, result.units, strict=True)):
        given = intervals[key].as_dict() if key in intervals else nothing
        reached = {"ess": float(quality.ess[i]), "rhat": float(quality.rhat[i]), "tau": float(quality.tau[i])}
        rows[key] = {**given, "sd": sd.get(key), "unit": unit, "at_maximum": result.maximum[key], **reached}
    return rows


def _sampling(result: Identification) -> dict[str, Any]:
    walkers, steps, _ = result.chain.shape
    return {
        "walkers": walkers,
        "steps": steps,
        "burn_in": result.burn_in,
        "acceptance": result.acceptance,
        "autocorrelation_time": result.quality.slowest,
        "lacks": list(result.lacks),
    }


def says(result: Identification) -> tuple[str, ...]:
    """Return what the report opens with."""
    quality = result.quality
    if not result.converged:
        return (
            "The chain has not converged, so no interval is given.",
            f"What is missing: {'; '.join(result.lacks)}. Give more steps with --max-steps, or look at the trace.",
        )
    return (
        f"The chain has converged: {quality.ess.min():.0f} effective draws or more of each parameter.",
        f"R-hat is {quality.rhat.max():.3f} at most, and the longest autocorrelation time is {quality.slowest:.1f} of"
        f" {quality.steps} steps.",
    )


def modes_said(modes: int) -> list[str]:
    """Return a sentence where the posterior has more than one mode."""
    if modes < 2:
        return []
    return [
        f"The posterior has {modes} separate modes: the recording is explained by {modes} sets of parameters. The draws"
        " hold each with its weight; look at the figure of pairs before you quote a single interval."
    ]
