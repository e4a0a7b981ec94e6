"""The result of a sampled posterior: rows of parameters, levels of the drive, sentences."""

from __future__ import annotations

from collections.abc import Mapping

from lostmotion.case import CaseFile
from lostmotion.identification.sampling import NOISES, SampledPosterior
from lostmotion.likelihood.space import split_key
from lostmotion.results import Interval
from lostmotion.results.background import Origin
from lostmotion.results.identification import (
    Identification,
    Parameter,
    RouteName,
    Sampling,
)

SENSOR_PARAMETERS = (*NOISES.values(), "offset")
"""Parameters that are listed separately from those of the machine: noise levels, and the offset of a sensor."""


def make_result(found: SampledPosterior, route: RouteName, case: CaseFile, origin: Origin) -> Identification:
    """Return the result of the draws, without notes and without the parts that belong to one route only."""
    rows = _make_parameter_rows(found)
    noise = {name for name in rows if split_key(name)[0] in SENSOR_PARAMETERS}
    return Identification(
        route=route,
        converged=found.converged,
        says=write_sentences(found),
        ess_min=float(found.quality.ess.min()),
        ess_tail_min=float(found.quality.ess_tail.min()),
        rhat_max=float(found.quality.rhat.max()),
        parameters={k: row for k, row in rows.items() if k not in noise},
        noise={k: row for k, row in rows.items() if k in noise},
        sampling=_summarise_sampling(found),
        log_likelihood_evaluations=found.evaluations,
        title=case.title,
        model=case.model,
        truth=dict(case.truth),
        notes=(),
        provenance=origin,
    )


def _make_parameter_rows(found: SampledPosterior) -> Mapping[str, Parameter]:
    """Return a row for each parameter; without convergence the rows have no intervals."""
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


def _summarise_sampling(found: SampledPosterior) -> Sampling:
    walkers, steps, _ = found.chain.shape
    return Sampling(
        walkers=walkers,
        steps=steps,
        burn_in=found.burn_in,
        acceptance=found.acceptance,
        autocorrelation_time=found.quality.slowest,
        lacks=found.lacks,
    )


def write_sentences(found: SampledPosterior) -> tuple[str, ...]:
    """Return the first sentences of the report."""
    quality = found.quality
    if not found.converged:
        return (
            "The chain has not converged, so no interval is given.",
            f"Criteria that are not met: {'; '.join(found.lacks)}. Give more steps with --max-steps, or look at the"
            " trace.",
        )
    return (
        f"The chain has converged: {quality.ess.min():.0f} effective draws or more of each parameter.",
        f"R-hat is {quality.rhat.max():.3f} at most, and the longest autocorrelation time is {quality.slowest:.1f} of"
        f" {quality.steps} steps.",
    )


def write_mode_notes(modes: int) -> list[str]:
    """Return a sentence where the posterior has more than one mode."""
    if modes < 2:
        return []
    return [
        f"The posterior has {modes} separate modes: {modes} different sets of parameters explain the recording. The"
        " draws contain each mode with its weight; look at the figure of pairs before you quote a single interval."
    ]
