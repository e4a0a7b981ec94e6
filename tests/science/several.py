"""Recordings of one machine at several levels, moved exactly by the matrix exponential, and cheap fits of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.linalg import expm
from scipy.signal import lfilter

from lostmotion.case import CaseFile, Prior
from lostmotion.inference.candidates import add_term
from lostmotion.inference.fit import maximise, restart
from lostmotion.inference.setup import make_posterior, polish_fit
from lostmotion.inference.sharing import compare_recordings
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.registry import default

M, C, K, DT = 2.0, 3.0, 800.0, 0.01
PRIORS = {"c": Prior(0.3, 30.0, "log"), "k": Prior(200.0, 3000.0, "log")}
SLIP, NOISE = 0.02, 2e-5
"""The noise of the measured force as a share of the drive, and that of the sensor for a drive of one (m)."""


def recorded(name, seed, level=1.0, *, samples=600, c=C, k=K, memory=0.0, slip=SLIP):
    """Return a recording of a linear oscillator under a random square wave that is felt with noise.

    The noise is `slip` of the drive, and a share `memory` of it is left after a sample.
    """
    rng = np.random.default_rng(seed)
    a = np.array([[0.0, 1.0, 0.0], [-k / M, -c / M, 1.0 / M], [0.0, 0.0, 0.0]])
    step = expm(a * DT)
    push = level * np.repeat(rng.choice([-1.0, 1.0], samples // 5 + 1), 5)[:samples]
    shaped = lfilter([np.sqrt(1.0 - memory**2)], [1.0, -memory], rng.standard_normal(samples))
    y, seen = np.zeros(2), np.zeros(samples)
    for i, u in enumerate(push):
        seen[i] = y[0]
        y = (step @ np.append(y, u + slip * level * shaped[i]))[:2]
    seen += NOISE * level * rng.standard_normal(samples)
    return Observation.of(name, seen, push[:, None], DT, "position", held=True)


def fitted(observations, *terms):
    """Return the fit of an oscillator with damping and stiffness unknown, begun at the truth; `terms` may be tried."""
    system = System(default().make("model", "linear_oscillator"), terms)
    case = CaseFile("study", Path(), (), "linear_oscillator", {"m": M}, PRIORS, {}, (), "")
    posterior = make_posterior(system, case, tuple(observations), jobs=1)
    start = posterior.space.start.copy()
    for i, key in enumerate(posterior.space.keys):
        start[i] = np.log({"c": C, "k": K}[key]) if key in PRIORS else start[i]
    return maximise(posterior, start)


def rubbed(name, seed, level, *, friction=0.0, c=C, samples=1000, noise=0.005, finer=16):
    """Return a recording of the oscillator with dry friction (N) under a multisine, by leapfrog; it truly sticks.

    `level` is the rms of the force.
    """
    rng = np.random.default_rng(seed)
    tones, phases = rng.uniform(1.0, 6.0, 10), rng.uniform(0.0, 2.0 * np.pi, 10)
    t = np.arange(samples * finer) * DT / finer
    force = np.sum(np.cos(2.0 * np.pi * np.multiply.outer(t, tones) + phases), axis=1)
    force *= level / np.std(force[::finer])
    h, x, v, seen = DT / finer, 0.0, 0.0, np.zeros(samples)
    for i, u in enumerate(force):
        if i % finer == 0:
            seen[i // finer] = x
        x += 0.5 * h * v
        v += h / M * (u - c * v - K * x)
        v = np.sign(v) * max(abs(v) - h / M * friction, 0.0)
        x += 0.5 * h * v
    seen += noise * np.std(seen) * rng.standard_normal(samples)
    return Observation.of(name, seen, force[::finer, None], DT, "position")


def rubbing(observations):
    """Return the fit of an oscillator with dry friction."""
    bare = fitted(observations, default().load("term", "coulomb_friction")())
    return polish_fit(maximise(add_term(restart(bare), "coulomb_friction", {"coulomb_friction.force": 0.5})))


def least(number, memory):
    """Return the least p-value over the parameters of three recordings that differ in nothing but their level."""
    runs = [recorded(f"run {i}", 1000 * number + i, 2.0**i, slip=1.0, memory=memory) for i in range(3)]
    return min(one.p for one in compare_recordings(fitted(runs)).parameters.values())
