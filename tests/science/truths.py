"""Posteriors with known truth for the tests of the inference, from recordings that the framework had no part in."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from independent import Machine, recording

from lostmotion.case import CaseFile, Prior
from lostmotion.inference.setup import make_noise_levels, make_posterior, search_maximum
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.preparation.candidate_terms import candidates_of
from lostmotion.registry import default

TRUE = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005}
FRICTION, FORCE = "coulomb_friction", "coulomb_friction.force"
PRIORS = {"c": (0.8, 80.0), "x0": (5e-4, 5e-2), "k0": (4e3, 4e5)}


def observation_of(force, *, seed, periods=29, noise=0.01):
    """Return a recording of Case 1 with dry friction of `force` N hidden in it, and the true states (samples, 2)."""
    seen = recording(Machine(coulomb=force), periods=periods, noise=noise, seed=seed)
    return Observation.of("recording", seen.position, seen.force[:, None], float(seen.time[1]), "position"), seen.states


def case_of(unknown):
    """Return a case with log-uniform priors over two decades for what is unknown."""
    known = {k: v for k, v in TRUE.items() if k not in unknown}
    priors = {k: Prior(low=PRIORS[k][0], high=PRIORS[k][1], scale="log") for k in unknown}
    return CaseFile("study", Path(), (), "lin_backlash", known, priors, {}, (), "")


def fit_oscillator(observation, rng, *, m=1.0, c=(0.2, 20.0), k=(40.0, 4e3), terms=()):
    """Return the fit of a linear oscillator of mass `m` to a recording; `terms` may act, `c` and `k` are ranges."""
    registry = default()
    model = registry.make("model", "linear_oscillator")
    priors = {key: Prior(low=low, high=high, scale="log") for key, (low, high) in (("c", c), ("k", k))}
    case = CaseFile("study", Path(), (), model.name, {"m": m}, priors, {}, (), "")
    system = System(model, candidates_of(model, [registry.load("term", name) for name in terms]))
    return search_maximum(make_posterior(system, case, (observation,)), rng, points=24, finalists=2)


def system_of(name="lin_backlash"):
    """Return the system of a model with every term of the library that can act in it."""
    registry = default()
    model = registry.make("model", name)
    return System(model, candidates_of(model, [registry.load("term", n) for n in registry.names("term")]))


def posterior_for(observation, unknown, *, noise=0.01):
    """Return the posterior of a recording with its unknown parameters and noise levels started near the truth."""
    posterior = make_posterior(system_of(), case_of(unknown), (observation,))
    levels = make_noise_levels((observation,), posterior.scales)
    start = {k: np.log(TRUE[k]) for k in unknown}
    start |= {levels[0].key: levels[0].mean, levels[1].key: np.log(noise * np.std(observation.response))}
    return posterior, np.array([start[k] for k in posterior.space.keys])
