"""The trajectory route from a case with recordings to a sampling task: its terms, the maxima, and warnings."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.contracts import Term
from lostmotion.errors import CaseError, nearest
from lostmotion.evidence.effects import propose_start
from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, Task, identify, make_task
from lostmotion.inference.candidates import fit_term
from lostmotion.inference.fit import Fit, maximise, restart
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.inference.setup import (
    SHARED,
    find_modes,
    make_case_parameters,
    make_posterior,
    polish_modes,
    separate_levels,
)
from lostmotion.likelihood.stepped import make_system
from lostmotion.likelihood.system import key_of
from lostmotion.preparation.prepare import Prepared
from lostmotion.preparation.vetting import make_plugin
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT, Settings


@dataclass(frozen=True)
class SampledCase:
    """A sampled posterior, and the fits of its modes, best first."""

    result: SampledPosterior
    fits: tuple[Fit, ...]


def sample_case(
    prepared: Prepared,
    terms: tuple[Term, ...],
    plan: SamplingPlan,
    *,
    rng: np.random.Generator,
    jobs: int = 1,
) -> SampledCase:
    """Return the sampled posterior of a case with the terms, from all of its recordings; no file is written."""
    fits = find_best_fits(prepared, terms, rng, jobs)
    return SampledCase(identify(make_trajectory_task(prepared, fits, terms), rng=rng, plan=plan), tuple(fits))


def make_trajectory_task(prepared: Prepared, fits: Sequence[Fit], terms: tuple[Term, ...]) -> Task:
    """Return the task of sampling around the fits; its digest changes with the case, its recordings and the terms."""
    used = {
        "inputs": prepared.inputs,
        "terms": [key_of(term) for term in terms],
        "steps": fits[0].posterior.dynamics.nsub,
    }
    return make_task(fits, json.dumps(used, sort_keys=True))


def choose_terms(prepared: Prepared, asked: tuple[str, ...], registry: Registry) -> tuple[Term, ...]:
    """Return the requested terms and those whose parameters appear in the case, each once."""
    offered = {key_of(term): term for term in prepared.terms}
    named = [key.rpartition(".")[0] for key in (*prepared.case.known, *prepared.case.estimate) if "." in key]
    keys = dict.fromkeys(text.removesuffix("@ground") for text in (*asked, *named))
    for key in keys:
        make_plugin(registry, "term", key.partition("@")[0])
        if key not in offered:
            raise CaseError(
                f"the term {key!r} has no place in {prepared.case.model}{nearest(key, offered)}:"
                f" possible terms are {', '.join(offered)}"
            )
    return tuple(offered[key] for key in keys)


def find_best_fits(
    prepared: Prepared, terms: tuple[Term, ...], rng: np.random.Generator, jobs: int, settings: Settings = DEFAULT
) -> list[Fit]:
    """Return the distinct maxima of the posterior on all recordings, with the terms, best first.

    All belong to one posterior with fine integration steps.
    """
    case = prepared.case
    bare = replace(case, estimate={k: v for k, v in case.estimate.items() if "." not in k})
    posterior = make_posterior(
        make_system(prepared.model, terms), bare, prepared.observations, jobs=jobs, settings=settings
    )
    found = find_modes(posterior, rng, sensor=SHARED if terms else case.sensor)
    return polish_modes([_add_terms(fit, terms, case) for fit in found])


def _add_terms(fit: Fit, terms: tuple[Term, ...], case: CaseFile) -> Fit:
    """Return the fit with the terms, and with the priors and the sensor of the case."""
    for key in map(key_of, terms):
        fit = fit_term(fit, key, propose_start(fit, key))
    if any("." in key for key in (*case.known, *case.estimate)):
        fit = _apply_case_priors(fit, case)
    return separate_levels(fit, case.sensor)


def _apply_case_priors(fit: Fit, case: CaseFile) -> Fit:
    """Return the fit with the priors and the known values of the case for parameters of terms."""
    posterior = restart(fit)
    names = [observation.name for observation in posterior.observations]
    frees = []
    for free in posterior.space.free:
        if free.key in case.estimate and "." in free.key:
            given = make_case_parameters(posterior.system.slot(free.key), case.estimate[free.key], names)
            frees += [replace(one, start=one.coordinate(free.value(free.start))) for one in given]
        elif free.key not in case.known:
            frees.append(free)
    return maximise(posterior.over(frees))


def write_warnings(fit: Fit) -> list[str]:
    """Return a warning where the intervals are too narrow although the chain has converged."""
    if compute_random_force_gain(fit) <= fit.posterior.settings.locate.significant:
        return []
    return [
        "A force remains that this model does not explain. The intervals assume that the model is right: here they are"
        " too narrow and may miss the true values. `lostmotion diagnose` searches for the missing physics."
    ]
