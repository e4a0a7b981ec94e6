"""Explanations that are made by hand: hypotheses with given scores and coordinates, of an oscillator with few terms."""

import math
from types import SimpleNamespace

import numpy as np

from lostmotion.evidence.explanations import Explanations
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import Problem, Scales
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import System
from lostmotion.settings import DEFAULT
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.terms.bodies import InertiaChange
from lostmotion_plugins.terms.drive import ExcitationDelay
from lostmotion_plugins.terms.friction import CoulombFriction, StribeckFriction

TERMS = (CoulombFriction(), StribeckFriction(), ExcitationDelay(), InertiaChange())
FRICTION, STRIBECK, DELAY, CHANGE = System(LinearOscillator(), TERMS).keys
LOGARITHMS = ("time", "velocity")
UNITS = {"force": "N", "delay": "s", "time": "s"}
WIDTH = 0.01
"""The standard deviation of each coordinate."""


def problem_of(values):
    """Return the problem in which these parameters of terms are free, 100 samples of 1 s; a unit of time is 1 s."""
    observation = Observation.of("run", np.zeros(100), np.zeros((100, 1)), 1.0, "position")
    system = System(LinearOscillator(), TERMS)
    free = tuple(_make_free(key, value) for key, value in values.items())
    active = frozenset(f.key.rpartition(".")[0] for f in free)
    known = system.vector({"m": 1.0, "c": 1.0, "k": 1.0})
    scales = Scales(1.0, 1.0, 1.0, usual=0.0, span=100.0)
    return Problem(system, (observation,), scales, known, free, active=active)


def _make_free(key, value):
    name = key.rpartition(".")[2]
    log = name in LOGARITHMS
    return FreeParameter(key, UNITS.get(name, "1"), math.log(value) if log else value, -1e3, 1e3, log=log)


def hypothesis(values, score, *, unknown=False, sd=WIDTH, log_evidence=None, error=None):
    """Return a hypothesis with these values of its terms by key; `sd` is the deviation of each coordinate.

    The error of each of its 100 predictions is `error`, usually the score: those with other scores predict otherwise.
    """
    problem = problem_of(values)
    theta, own = np.array([f.start for f in problem.free]), len(problem.free)
    wrong = score if error is None else error
    return SimpleNamespace(
        terms=problem.active | ({UNKNOWN} if unknown else frozenset()),
        frame=SimpleNamespace(problem=problem, own=own),
        theta=theta,
        values=dict(zip(problem.keys, theta.tolist(), strict=True)),
        covariance=sd**2 * np.eye(own),
        scatter=1.0,
        expansion=SimpleNamespace(here=SimpleNamespace(errors=np.full(100, wrong), variances=np.ones(100))),
        unknown=unknown,
        log_evidence=score if log_evidence is None else log_evidence,
        heldout=0.0,
        price=0.0,
        score=lambda temper=1.0: score / temper,
    )


def fit_of(values, log_evidence=0.0):
    """Return what is asked of the fit of these values."""
    return SimpleNamespace(problem=problem_of(values), values=values, log_evidence=log_evidence)


def explanations(*found, fits=(), discrepancy=0.0):
    """Return explanations of these hypotheses, and of that of nothing missing with the score 0 if it is not given.

    `discrepancy` is the log evidence that it adds to each.
    """
    every = {one.terms: one for one in (hypothesis({}, 0.0), *found)}
    bare = [fit_of({}), *(SimpleNamespace(problem=h.frame.problem, log_evidence=h.log_evidence) for h in found), *fits]
    by_terms = {fit.problem.active: fit for fit in bare}
    for terms, fit in by_terms.items():
        if terms in every and discrepancy:
            fit.log_evidence = every[terms].log_evidence - discrepancy
    return Explanations(by_terms, every)


def missing(size):
    """Return what is said of a force that is missing, here of a given standard deviation."""
    return SimpleNamespace(missing=SimpleNamespace(force=np.array([size, -size])))


def diagnosis(explained, *, left=None, learned=None, withdrawn=()):
    """Return as much of a diagnosis as states of findings need: its best explanation is what was found."""
    best = explained.best
    logs = {f.key: f.log for f in best.frame.problem.free}
    values = {key: math.exp(at) if logs[key] else at for key, at in best.values.items()}
    found = tuple(sorted(explained.terms))
    return SimpleNamespace(
        explained=explained,
        after=fit_of(values),
        before=fit_of({}),
        found=found,
        named=found,
        learned=learned,
        left=left,
        located=missing(1.0),
        unexplained=left is not None,
        withdrawn=withdrawn,
        settings=DEFAULT,
    )
