"""The whole way of an identification: case in, `identification.json`, `posterior.nc` and `report.html` out."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.case import Case
from lostmotion.contracts import Term
from lostmotion.errors import CaseError, nearest
from lostmotion.inference.candidates import fit_with, screen, slopes_of
from lostmotion.inference.fit import Fit, maximise, restarted
from lostmotion.inference.selection import significant_random_force
from lostmotion.inference.setup import free_of, polish, problem_of, search
from lostmotion.provenance import provenance
from lostmotion.registry import Registry
from lostmotion.report.identification import write_identification
from lostmotion.stages.diagnose import SIGNIFICANT
from lostmotion.stages.identify import NOISES, Identification, Plan, Watch, identify
from lostmotion.storage import folder_for, save_json, whole
from lostmotion.system import System, key_of
from lostmotion.workflow.prepare import Prepared, prepare


@dataclass(frozen=True)
class Order:
    """What is asked for beyond the case: terms to add (`NAME` or `NAME@PLACE`), seed, cores, how long to sample."""

    terms: tuple[str, ...] = ()
    seed: int = 0
    jobs: int = 2
    plan: Plan = field(default_factory=Plan)


@dataclass(frozen=True)
class Identified:
    """An identification, the content of its JSON file, and the time (s) that the sampling took."""

    result: Identification
    content: Mapping[str, Any]
    seconds: float


def run_identification(
    path: Path, out: Path, registry: Registry, order: Order, watch: Watch = lambda _steps, _says: None
) -> Identified:
    """Return what was identified after writing it into the folder `out`; all recordings of the case are used."""
    watch(0, "reading the case")
    prepared = prepare(path, registry)
    terms = chosen_terms(prepared, order.terms, registry)
    folder = folder_for(out)
    rng = np.random.default_rng(order.seed)
    watch(0, "looking for the maximum")
    fit = best_fit(prepared, terms, rng, order.jobs)
    begin = time.perf_counter()
    result = identify(fit, rng=rng, plan=order.plan, watch=watch)
    seconds = time.perf_counter() - begin
    watch(0, "report")
    content = {**statement(result), **_background(prepared, fit, order)}
    _write(folder, result, content)
    return Identified(result, content, seconds)


def chosen_terms(prepared: Prepared, asked: tuple[str, ...], registry: Registry) -> tuple[Term, ...]:
    """Return the terms asked for and those whose parameters the case names, each once."""
    offered = {key_of(term): term for term in prepared.terms}
    named = [key.rpartition(".")[0] for key in (*prepared.case.known, *prepared.case.estimate) if "." in key]
    keys = dict.fromkeys(text.removesuffix("@ground") for text in (*asked, *named))
    for key in keys:
        registry.load("term", key.partition("@")[0])
        if key not in offered:
            raise CaseError(
                f"the term {key!r} has no place in {prepared.case.model}{nearest(key, offered)}:"
                f" the terms that have are {', '.join(offered)}"
            )
    return tuple(offered[key] for key in keys)


def best_fit(prepared: Prepared, terms: tuple[Term, ...], rng: np.random.Generator, jobs: int) -> Fit:
    """Return the maximum of the posterior on all recordings, with the terms, in fine integration steps."""
    case = prepared.case
    bare = replace(case, estimate={k: v for k, v in case.estimate.items() if "." not in k})
    fit = search(problem_of(System(prepared.model, terms), bare, prepared.tracks, jobs=jobs), rng)
    for term in terms:
        fit = fit_with(fit, screen(fit, slopes_of(fit), key_of(term)))
    return polish(_as_the_case_says(fit, case) if any("." in k for k in (*case.known, *case.estimate)) else fit)


def _as_the_case_says(fit: Fit, case: Case) -> Fit:
    """Return the fit with the priors and the known values that the case gives to parameters of terms."""
    problem = restarted(fit)
    frees = []
    for free in problem.free:
        if free.key in case.estimate and "." in free.key:
            given = free_of(problem.system.slot(free.key), case.estimate[free.key])
            free = replace(given, start=given.coordinate(free.value(free.start)))
        if free.key not in case.known:
            frees.append(free)
    return maximise(replace(problem, free=tuple(frees)))


def statement(result: Identification) -> dict[str, Any]:
    """Return the content of `identification.json`, title and provenance left out; without convergence no interval."""
    rows = _parameters(result)
    noise = set(NOISES.values())
    return {
        "schema": "lostmotion.identification/1",
        "route": "trajectory",
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


def _background(prepared: Prepared, fit: Fit, order: Order) -> dict[str, Any]:
    case = prepared.case
    settings = {
        "model": case.model,
        "known": dict(case.known),
        "terms": sorted(fit.problem.active),
        "steps_between_samples": fit.problem.nsub,
        **asdict(order.plan),
    }
    return {
        "title": case.title,
        "model": " + ".join([case.model, *sorted(fit.problem.active)]),
        "truth": dict(case.truth),
        "notes": [*prepared.notes, *_doubts(fit)],
        "provenance": provenance("identify", settings, order.seed, prepared.inputs),
    }


def _doubts(fit: Fit) -> list[str]:
    """Return what makes the intervals too narrow although the chain has converged."""
    if significant_random_force(fit) <= SIGNIFICANT:
        return []
    return [
        "A force is left over that this model does not explain. The intervals hold only if the model is right: they are"
        " then too narrow, and may miss the truth. `lostmotion diagnose` looks for what was left out."
    ]


def _write(folder: Path, result: Identification, content: Mapping[str, Any]) -> None:
    attrs = {"title": content["title"], "model": content["model"], "converged": int(result.converged)}
    with whole(folder / "posterior.nc") as spare:
        result.inference_data(attrs).to_netcdf(str(spare), engine="h5netcdf")
    save_json(folder / "identification.json", content)
    write_identification(folder)
