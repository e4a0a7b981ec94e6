"""Predictions of held-out data: one step ahead, free runs, and the growth of errors."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.kernels.filter import UNREAD_VARIANCE
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.settings import DEFAULT

WORST = 1e3
"""The largest error, in standard deviations of the response; a run that diverges has this error."""
NEAR = 1e-6
"""The distance of neighbouring runs, as a share of the motion."""
MANY = 2000
"""The number of pieces of a run that are computed at once."""


@dataclass(frozen=True)
class Filtered:
    """A recording filtered at fixed parameters: states (samples, n), innovations and variances (samples, sensors)."""

    states: Array
    errors: Array
    variances: Array

    @property
    def taken(self) -> NDArray[np.bool_]:
        """Which readings (samples, sensors) were taken; for the others a filter stores a fixed variance."""
        return np.abs(self.variances - UNREAD_VARIANCE) > 1e-12

    def expected_score(self, held: slice) -> float:
        """Return the mean log density per sample of one-step predictions, with errors as large as their variances."""
        v = self.variances[held]
        return float(np.mean(np.sum(-0.5 * (self.taken[held] + np.log(2.0 * np.pi * v)), axis=1)))


@dataclass(frozen=True)
class FreeRuns:
    """Free-running predictions from many starts: `lead` (steps,) in s, `error` (starts, steps) in response units."""

    lead: Array
    error: Array
    valid: float = DEFAULT.heldout.valid

    def growth(self, scale: float) -> Array:
        """Return the rms error over the starts at each lead, over `scale`."""
        return np.asarray(np.sqrt(np.nanmean(self.error**2, axis=0)) / scale)

    def valid_time(self, scale: float) -> float:
        """Return the median time (s) until the error exceeds the share `valid` of `scale`."""
        beyond = np.abs(self.error) > self.valid * scale
        first = np.where(beyond.any(axis=1), beyond.argmax(axis=1), len(self.lead) - 1)
        return float(np.median(self.lead[first]))


def filter_recording(posterior: Posterior, theta: Array) -> Filtered:
    """Return the first recording of a posterior, filtered at coordinates."""
    seen = posterior.filters[0].smooth(theta)
    errors, variances = (a[0] for a in (seen.innovations.errors, seen.innovations.variances))
    return Filtered(seen.filtered[:, : posterior.dynamics.states], errors, variances)


def predict_freely(
    posterior: Posterior, theta: Array, states: Array, starts: Array, steps: int, *, index: int = 0
) -> tuple[FreeRuns, ...]:
    """Return free predictions of `steps` samples of a recording, for each sensor.

    They begin at the filtered `states` at the sample numbers `starts`.
    """
    observation = posterior.observations[index]
    runs = _simulate_runs(posterior, theta, states[starts], starts, steps, index)
    lead = np.asarray(np.arange(steps) * observation.dt, dtype=float)
    found = []
    for sensor, z in enumerate(observation.readings.T):
        error = np.full((len(starts), steps), np.nan)
        for row, start in enumerate(starts):
            seen = observe_states(posterior, theta, runs[row], (int(start), index), sensor)
            error[row] = seen - z[start : start + steps]
            error[row, ~np.isfinite(seen)] = math.inf
        worst = WORST * float(np.nanstd(z))
        found.append(FreeRuns(lead, np.clip(error, -worst, worst), posterior.settings.heldout.valid))
    return tuple(found)


def _simulate_runs(
    posterior: Posterior, theta: Array, y0: Array, starts: Array, steps: int, index: int, kicks: Array | None = None
) -> Array:
    """Return the states (runs, steps, n) of free runs from `y0` (runs, n) at the sample numbers `starts`."""
    one = posterior.recordings[index].points(theta[None]).select(np.zeros(len(starts), dtype=np.int64))
    begun = replace(one, first=np.asarray(starts, dtype=np.int64))
    begin = np.ascontiguousarray(y0[:, : posterior.dynamics.states])
    return posterior.dynamics.simulate(begun, begin, steps, kicks)


def simulate_run(posterior: Posterior, theta: Array, y0: Array, start: int, steps: int, index: int = 0) -> Array:
    """Return the states (steps, n) of a free run that begins at sample `start` of a recording."""
    run: Array = _simulate_runs(posterior, theta, y0[None], np.array([start]), steps, index)[0]
    return run


def forecast_pieces(posterior: Posterior, theta: Array, states: Array, begin: int, length: int) -> tuple[Array, Array]:
    """Return free-running predictions (samples, sensors) from sample `begin` on, and where they restart (samples,).

    They restart at the filtered `states` (samples, n) after each `length` samples.
    """
    observation = posterior.observations[0]
    forecast, restarts = np.full(observation.readings.shape, np.nan), np.zeros(observation.samples)
    for start in range(begin, observation.samples - 1, length):
        steps = min(length, observation.samples - start)
        run = simulate_run(posterior, theta, states[start], start, steps)
        for sensor in range(len(observation.sensors)):
            forecast[start : start + steps, sensor] = observe_states(posterior, theta, run, (start, 0), sensor)
        restarts[start] = 1.0
    return forecast, restarts


def simulate_kicked(posterior: Posterior, theta: Array, y0: Array, kicks: Array, index: int = 0) -> Array:
    """Return the states (steps, n) of a run from the first sample, to which `kicks` (steps, n) are added."""
    run: Array = _simulate_runs(
        posterior, theta, y0[None], np.zeros(1, dtype=np.int64), len(kicks), index, kicks[None]
    )[0]
    return run


def observe_states(
    posterior: Posterior, theta: Array, states: Array, where: tuple[int, int] = (0, 0), sensor: int = 0
) -> Array:
    """Return the readings of a sensor for the `states` (steps, n), from sample `where[0]` of a recording."""
    system, (start, index) = posterior.system, where
    recording, observation = posterior.recordings[index], posterior.observations[index]
    shown_by = observation.sensors[sensor]
    full, (gain, offset, lag) = recording.full(theta), recording.gauge(theta, sensor)
    channel, direct = system.shown(shown_by, posterior.active)
    if direct >= 0:
        shown = states[:, direct]
    else:
        drive = recording.drive(full)
        packed = posterior.dynamics.pack(full[None], drive)
        times = drive.begin + (start + np.arange(len(states))) * drive.dt
        inputs = drive.inputs[start : start + len(states)]
        shown = system.compute_derivatives(posterior.active, packed, states, inputs, times)[1][:, channel]
    if lag:
        at = np.arange(len(shown)) - lag / observation.dt
        shown = np.interp(at, np.arange(len(shown)), shown, left=shown[0])
    for term, p in system.at_sensor(full, posterior.active, shown_by.place):
        shown = term.bent(shown, p)
    seen, when = gain * shown + offset, observation.time[0] + (start + np.arange(len(states))) * observation.dt
    for change in system.changes_at_sensor(full, posterior.active, shown_by.place):
        seen = change.apply(seen, when)
    return np.asarray(seen)


def compute_growth_rates(posterior: Posterior, theta: Array, y0: Array, index: int = 0) -> Array:
    """Return the divergence rate (1/s, base e) of neighbouring runs in each piece, (pieces,); empty on failure.

    Runs a millionth of the motion apart are renormalised after each piece (Benettin, Galgani, Giorgilli, Strelcyn,
    Meccanica 15 (1980) 9-20). All pieces of a run from `y0` are computed at once, with one neighbouring run for each
    state, and combined afterwards. The first tenth is not counted.
    """
    observation = posterior.observations[index]
    piece = max(int(posterior.scales.time * 3.0 / observation.dt), 8)
    unit = np.ones(len(y0))
    unit[list(posterior.system.model.first_body)] = posterior.scales.length, posterior.scales.velocity
    starts = np.arange(0, observation.samples - piece, piece)
    if not len(starts):
        return np.zeros(0)
    path = _simulate_runs(posterior, theta, y0[None], np.zeros(1, dtype=np.int64), observation.samples, index)[0]
    maps = [
        _separate_runs(posterior, theta, path[k], k, piece, unit, index)
        for k in np.array_split(starts, len(starts) // MANY + 1)
    ]
    direction, rates = _choose_direction(len(y0)), []
    for start, grown in zip(starts, np.concatenate(maps), strict=True):
        direction = direction @ grown
        gap = float(np.linalg.norm(direction))
        if not math.isfinite(gap) or gap == 0.0:
            return np.zeros(0)
        if start > 0.1 * observation.samples:
            rates.append(math.log(gap) / (piece * observation.dt))
        direction /= gap
    return np.array(rates)


def _separate_runs(
    posterior: Posterior, theta: Array, begun: Array, starts: NDArray[Any], piece: int, unit: Array, index: int
) -> Array:
    """Return the derivatives of the final states of a piece over its initial ones, (starts, states, states).

    They begin at the samples `starts`, from the states `begun` (starts, n); distances are in `unit` (n,).
    """
    n = len(unit)
    shifts = NEAR * np.vstack([np.zeros(n), np.diag(unit)])
    begin = (begun[:, None] + shifts).reshape(-1, n)
    runs = _simulate_runs(posterior, theta, begin, np.repeat(starts, n + 1), piece + 1, index)
    ends = runs[:, -1].reshape(len(starts), n + 1, n)
    return np.asarray((ends[:, 1:] - ends[:, :1]) / (NEAR * unit))


def _choose_direction(n: int) -> Array:
    direction = np.zeros(n)
    direction[0] = direction[1] = math.sqrt(0.5)
    return direction


@dataclass(frozen=True)
class Horizon:
    """The time over which a free prediction is judged: `steps` samples, `number` of `unit` ("Lyapunov times", ...)."""

    steps: int
    number: float
    unit: str
    unit_time: float


def choose_horizon(observation: Observation, exponent: float, natural: float) -> Horizon:
    """Return half a Lyapunov time when the motion is chaotic, else one drive period, else one natural cycle."""
    period = observation.period
    cycle = period * observation.dt if period else 2.0 * math.pi * natural
    if math.isfinite(exponent) and exponent * cycle > 0.1:
        return Horizon(_count_steps(0.5 / exponent, observation), 0.5, "Lyapunov times", 1.0 / exponent)
    unit = "drive periods" if period else "natural periods"
    return Horizon(_count_steps(cycle, observation), 1.0, unit, cycle)


def _count_steps(time: float, observation: Observation) -> int:
    return int(min(max(round(time / observation.dt), 2), observation.samples // 4))
