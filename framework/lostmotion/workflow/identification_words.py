"""What an identification says: rows of parameters, how the sampling went, and sentences."""

from __future__ import annotations

from collections.abc import Mapping

from lostmotion.case import CaseFile
from lostmotion.likelihood.space import parted
from lostmotion.results import Interval
from lostmotion.results.background import Origin
from lostmotion.results.identification import Identification, Parameter, RouteName, Sampling
from lostmotion.stages.identify import NOISES, SampledPosterior

SENSOR = (*NOISES.values(), "offset")
"""What is told apart from the parameters of the machine: noise levels, and the zero of a sensor."""


def statement(found: SampledPosterior, route: RouteName, case: CaseFile, origin: Origin) -> Identification:
    """Return what the draws say of a case, without notes and without what belongs to one route alone."""
    rows = _parameters(found)
    noise = {name for name in rows if parted(name)[0] in SENSOR}
    return Identification(
        route=route,
        converged=found.converged,
        says=says(found),
        ess_min=float(found.quality.ess.min()),
        ess_tail_min=float(found.quality.ess_tail.min()),
        rhat_max=float(found.quality.rhat.max()),
        parameters={k: row for k, row in rows.items() if k not in noise},
        noise={k: row for k, row in rows.items() if k in noise},
        sampling=_sampling(found),
        log_likelihood_evaluations=found.evaluations,
        title=case.title,
        model=case.model,
        truth=dict(case.truth),
        notes=(),
        provenance=origin,
    )


def _parameters(found: SampledPosterior) -> Mapping[str, Parameter]:
    """Return a row for each parameter; without convergence none has an interval."""
    intervals, sd, quality, nothing = found.intervals, found.sd, found.quality, float("nan")
    rows = {}
    for i, (key, unit) in enumerate(zip(found.keys, found.units, strict=True)):
        span = intervals.get(key, Interval(nothing, nothing, nothing, unit))
        rows[key] = Parameter(
            median=span.median,
            low=span.low,
            high=span.high,
            unit=unit,
            sd=sd.get(key, nothing),
            at_maximum=found.maximum[key],
            ess=float(quality.ess[i]),
            rhat=float(quality.rhat[i]),
            tau=float(quality.tau[i]),
        )
    return rows


def _sampling(found: SampledPosterior) -> Sampling:
    walkers, steps, _ = found.chain.shape
    return Sampling(
        walkers=walkers,
        steps=steps,
        burn_in=found.burn_in,
        acceptance=found.acceptance,
        autocorrelation_time=found.quality.slowest,
        lacks=found.lacks,
    )


def says(found: SampledPosterior) -> tuple[str, ...]:
    """Return what the report opens with."""
    quality = found.quality
    if not found.converged:
        return (
            "The chain has not converged, so no interval is given.",
            f"What is missing: {'; '.join(found.lacks)}. Give more steps with --max-steps, or look at the trace.",
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
