"""Recordings of models from the field with something hidden in them, made by DOP853 from equations written anew here.

Dry friction is tanh(v / width) with a width of a ten-thousandth of the velocities: far finer than the line by which
the framework lets a body stick. Nothing of lostmotion moves the machine.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from field import elsewhere
from truths import system_of

from lostmotion.case import CaseFile, Prior
from lostmotion.diagnosis.outcome import compute_intervals, draw_parameters
from lostmotion.diagnosis.stages import diagnose
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.observation import Observation


def sign(v, speed):
    """Return the sign of `v`, rounded over a ten-thousandth of `speed`."""
    return math.tanh(1e4 * v / speed)


def beyond(x, gap):
    """Return by how much `x` is outside of |x| < gap."""
    return math.copysign(max(abs(x) - gap, 0.0), x)


def observation_of(rates, push, *, start, omega, periods=25, per_period=100, skip=0, noise=0.01, seed=1):
    """Return the recording of the position y[0] under `push(t)`, `skip` periods after the start, as a observation."""
    dt = 2.0 * math.pi / omega / per_period
    t = np.arange((skip + periods) * per_period) * dt
    seen = elsewhere(rates, t, start, rtol=1e-9, atol=1e-11, max_step=dt)[skip * per_period :, 0]
    rng = np.random.default_rng(seed)
    force = np.array([push(now) for now in t[skip * per_period :]])
    bare = Observation.of(
        "recording", seen + noise * seen.std() * rng.standard_normal(len(seen)), force[:, None], dt, "position"
    )
    return Observation.of(
        bare.name, bare.response, bare.inputs, dt, "position", harmonic=DriveHarmonic(omega, bare.travel)
    )


def case_of(model, values, unknown):
    """Return a case that knows `values` but for `unknown`: log-uniform priors of a decade about what is given there."""
    priors = {k: Prior(low=v / 3.3, high=v * 3.3, scale="log") for k, v in unknown.items()}
    known = {k: v for k, v in values.items() if k not in unknown}
    return CaseFile("study", Path(), (), model, known, priors, {}, (), "")


def diagnosed(model, values, unknown, observation):
    """Return the diagnosis of a recording, and the 95 % intervals of what was estimated."""
    found = diagnose(case_of(model, values, unknown), [observation], system_of(model), rng=np.random.default_rng(0))
    return found, compute_intervals(found.after, draw_parameters(found.after, np.random.default_rng(1)))
