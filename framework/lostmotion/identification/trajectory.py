"""From a case with recordings to what is to be sampled: its terms, the maxima, and what speaks against them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.contracts import Term
from lostmotion.errors import CaseError, nearest
from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, Task, identify, task_of
from lostmotion.inference.candidates import compute_slopes, fit_term, run_score_test
from lostmotion.inference.fit import Fit, maximise, restart
from lostmotion.inference.leftovers import significant_random_force
from lostmotion.inference.setup import (
    SHARED,
    find_modes,
    make_case_parameters,
    make_problem,
    polish_modes,
    separate_levels,
)
from lostmotion.likelihood.system import System, key_of
from lostmotion.preparation.prepare import Prepared
from lostmotion.preparation.vetting import sound
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT, Settings


@dataclass(frozen=True)
class SampledCase:
    """A posterior that was sampled, and the fits of its modes, best first."""

    result: SampledPosterior
    fits: tuple[Fit, ...]


def sampled(
    prepared: Prepared,
    terms: tuple[Term, ...],
    plan: SamplingPlan,
    *,
    rng: np.random.Generator,
    jobs: int = 1,
) -> SampledCase:
    """Return the posterior of a case, its model with the terms, from all of its recordings; nothing is written."""
    fits = best_fits(prepared, terms, rng, jobs)
    return SampledCase(identify(task_for(prepared, fits, terms), rng=rng, plan=plan), tuple(fits))


def task_for(prepared: Prepared, fits: Sequence[Fit], terms: tuple[Term, ...]) -> Task:
    """Return the task of sampling around the fits; its digest changes with the case, its recordings and the terms."""
    told = {"inputs": prepared.inputs, "terms": [key_of(term) for term in terms], "steps": fits[0].problem.nsub}
    return task_of(fits, json.dumps(told, sort_keys=True))


def chosen_terms(prepared: Prepared, asked: tuple[str, ...], registry: Registry) -> tuple[Term, ...]:
    """Return the terms asked for and those whose parameters the case names, each once."""
    offered = {key_of(term): term for term in prepared.terms}
    named = [key.rpartition(".")[0] for key in (*prepared.case.known, *prepared.case.estimate) if "." in key]
    keys = dict.fromkeys(text.removesuffix("@ground") for text in (*asked, *named))
    for key in keys:
        sound(registry, "term", key.partition("@")[0])
        if key not in offered:
            raise CaseError(
                f"the term {key!r} has no place in {prepared.case.model}{nearest(key, offered)}:"
                f" the terms that have are {', '.join(offered)}"
            )
    return tuple(offered[key] for key in keys)


def best_fits(
    prepared: Prepared, terms: tuple[Term, ...], rng: np.random.Generator, jobs: int, settings: Settings = DEFAULT
) -> list[Fit]:
    """Return the distinct maxima of the posterior on all recordings, with the terms, best first.

    They are those of one problem in fine integration steps.
    """
    case = prepared.case
    bare = replace(case, estimate={k: v for k, v in case.estimate.items() if "." not in k})
    problem = make_problem(System(prepared.model, terms), bare, prepared.observations, jobs=jobs, settings=settings)
    found = find_modes(problem, rng, sensor=SHARED if terms else case.sensor)
    return polish_modes([_with_terms(fit, terms, case) for fit in found])


def _with_terms(fit: Fit, terms: tuple[Term, ...], case: CaseFile) -> Fit:
    """Return the fit with the terms, and with the priors and the sensor that the case gives."""
    for term in terms:
        fit = fit_term(fit, run_score_test(fit, compute_slopes(fit), key_of(term)))
    if any("." in key for key in (*case.known, *case.estimate)):
        fit = _as_the_case_says(fit, case)
    return separate_levels(fit, case.sensor)


def _as_the_case_says(fit: Fit, case: CaseFile) -> Fit:
    """Return the fit with the priors and the known values that the case gives to parameters of terms."""
    problem = restart(fit)
    names = [observation.name for observation in problem.observations]
    frees = []
    for free in problem.free:
        if free.key in case.estimate and "." in free.key:
            given = make_case_parameters(problem.system.slot(free.key), case.estimate[free.key], names)
            frees += [replace(one, start=one.coordinate(free.value(free.start))) for one in given]
        elif free.key not in case.known:
            frees.append(free)
    return maximise(replace(problem, free=tuple(frees)))


def warnings_of(fit: Fit) -> list[str]:
    """Return what makes the intervals too narrow although the chain has converged."""
    if significant_random_force(fit) <= fit.problem.settings.locate.significant:
        return []
    return [
        "A force is left over that this model does not explain. The intervals hold only if the model is right: they are"
        " then too narrow, and may miss the truth. `lostmotion diagnose` looks for what was left out."
    ]
