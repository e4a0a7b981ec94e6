"""The motion of a recording and free runs of both models, from the same first state."""

from __future__ import annotations

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.stages import SearchResult
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import filter_recording, simulate_run


def list_motions(d: SearchResult) -> dict[str, Array]:
    """Return the states (samples, n) of the recording, smoothed, and of a free run of each model, by name."""
    runs = {"recorded": (d.left or d.located).missing.states, "before": _run_freely(d.before, d.shown)}
    if d.found:
        runs["after"] = _run_freely(d.after, d.shown)
    return runs


def _run_freely(fit: Fit, observation: Observation) -> Array:
    """Return the states (samples, n) of a free run over a whole recording, from its first filtered state."""
    posterior = fit.posterior.on((observation,))
    first = min(20, observation.samples - 1)
    states = filter_recording(posterior, fit.theta).states
    run = simulate_run(posterior, fit.theta, states[first], first, observation.samples - first)
    return np.vstack([states[:first], run])


def take_section(states: Array, period: float, phase: float = 0.0) -> Array:
    """Return position and velocity (points, 2) once each `period` (samples) at a `phase` of it, interpolated."""
    at = np.arange(phase * period, len(states) - 1, period)
    grid = np.arange(len(states))
    return np.stack([np.interp(at, grid, states[:, i]) for i in (0, 1)], axis=1)
