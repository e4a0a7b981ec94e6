"""Predictions of held-out data: free runs and one-step predictions of a fit, and comparisons between fits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.stats import ttest_1samp

from lostmotion.contracts import Array
from lostmotion.diagnosis.predictive import HeldOutStretch, compute_block_scores
from lostmotion.inference.fit import Fit
from lostmotion.inference.locate import compute_autocorrelation, compute_whiteness
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import (
    Filtered,
    FreeRuns,
    Horizon,
    choose_horizon,
    compute_growth_rates,
    filter_recording,
    forecast_pieces,
    predict_freely,
)
from lostmotion.settings import DEFAULT, HeldOutSettings

STARTS = 150
REACH = 8.0
"""Error growth is computed over this many Lyapunov times or periods."""
SEGMENT = 3.0

MUCH_SMALLER = 0.5
"""The error of free runs is much smaller when it falls below this share."""
PARTS = 10
"""Free runs of two models are compared over this number of successive parts of the held-out data."""


@dataclass(frozen=True)
class Prediction:
    """Predictions of one model for held-out data: scores, error growth (steps,), forecasts (samples, sensors).

    `nrmse` is the error of free runs divided by the standard deviations `scales` of the held-out readings, averaged
    over the sensors; `by_sensor` has the values of each. Error growth is that of the first sensor. `expected_score` is
    the log score that a recording simulated by the model would have. `scores` (blocks,) are those of successive blocks,
    and `errors` (PARTS,) those of free runs from successive parts, averaged over the sensors like `nrmse`.
    """

    log_score: float
    expected_score: float
    nrmse: float
    by_sensor: tuple[float, ...]
    scales: tuple[float, ...]
    exponent: float
    rates: Array
    lead: Array
    growth: Array
    valid_time: float
    forecasts: Array
    restarts: Array
    acf: Array
    white: float
    scores: Array = field(default_factory=lambda: np.zeros(0))
    errors: Array = field(default_factory=lambda: np.zeros(0))


def cut_heldout(observations: Sequence[Observation], held: Sequence[Observation]) -> tuple[HeldOutStretch, ...]:
    """Return the held-out parts: the end of a single recording, or whole recordings after a short transient."""
    if len(observations) == 1:
        return (HeldOutStretch(observations[0], observations[0].samples - held[0].samples),)
    return tuple(HeldOutStretch(t, count_transient(t)) for t in held)


def count_transient(observation: Observation) -> int:
    """Return the number of first samples in which a filter finds the state of a machine that moves already."""
    return max(observation.samples // 20, 5)


def compute_rates(fit: Fit, observations: Sequence[Observation]) -> Array:
    """Return the rates (1/s) at which neighbouring runs diverge under the recorded drive, (pieces,)."""
    posterior = fit.posterior.on((observations[0],))
    return compute_growth_rates(posterior, fit.theta, posterior.recordings[0].points(fit.theta[None]).mean[0])


def average_exponent(rates: Array) -> float:
    """Return the largest Lyapunov exponent (1/s), the mean of growth rates; NaN if there are none."""
    return float(np.mean(rates)) if len(rates) else math.nan


def average_exponent_blocks(rates: Array, blocks: int = 10) -> Array:
    """Return the exponent (blocks,), in 1/s, over successive parts of a recording; none if it is too short."""
    return np.array([part.mean() for part in np.array_split(rates, blocks)]) if len(rates) >= blocks else np.zeros(0)


def predict(fit: Fit, pieces: Sequence[HeldOutStretch], horizon: Horizon, rates: Array) -> Prediction:
    """Return the predictions of one model on held-out data, over a horizon; `rates` are those of `compute_rates`."""
    posteriors = [fit.posterior.on((piece.observation,)) for piece in pieces]
    tracked = [filter_recording(posterior, fit.theta) for posterior in posteriors]
    runs, expected, lengths = [], [], [p.observation.samples - p.begin for p in pieces]
    scores = [compute_block_scores(fit, piece) for piece in pieces]
    for piece, posterior, seen in zip(pieces, posteriors, tracked, strict=True):
        held = slice(piece.begin, None)
        expected.append(seen.expected_score(held))
        runs.append(_run_freely(posterior, fit, seen.states, piece, horizon))
    joint = [_join_runs([r[sensor] for r in runs]) for sensor in range(len(runs[0]))]
    scales = [compute_deviation(pieces, sensor) for sensor in range(len(joint))]
    nrmse = [_compute_nrmse(one, horizon, scale) for one, scale in zip(joint, scales, strict=True)]
    first, main = tracked[0], joint[0]
    length = max(int(SEGMENT * horizon.unit_time / pieces[0].observation.dt), horizon.steps, 2)
    forecasts, restarts = forecast_pieces(posteriors[0], fit.theta, first.states, pieces[0].begin, length)
    tail = slice(pieces[0].begin, None)
    return Prediction(
        log_score=float(np.average([np.mean(own) for own in scores], weights=lengths)),
        expected_score=float(np.average(expected, weights=lengths)),
        nrmse=float(np.mean(nrmse)),
        by_sensor=tuple(nrmse),
        scales=tuple(scales),
        exponent=average_exponent(rates),
        rates=rates,
        lead=main.lead,
        growth=main.growth(scales[0]),
        valid_time=main.valid_time(compute_motion_deviation(fit, pieces)),
        forecasts=forecasts,
        restarts=restarts,
        acf=compute_autocorrelation(*_select_used(first, tail, 0)),
        white=_combine_p_values(
            [compute_whiteness(*_select_used(first, tail, sensor)) for sensor in range(len(joint))]
        ),
        scores=np.concatenate(scores),
        errors=_average_by_parts(runs, horizon, scales),
    )


def compute_deviation(pieces: Sequence[HeldOutStretch], sensor: int) -> float:
    """Return the standard deviation of the held-out readings of a sensor."""
    return float(np.nanstd(np.concatenate([p.observation.readings[p.begin :, sensor] for p in pieces])))


def _select_used(seen: Filtered, held: slice, sensor: int) -> tuple[Array, Array]:
    """Return one-step errors and variances of the held-out readings of a sensor, without missing readings."""
    there = seen.taken[held, sensor]
    return seen.errors[held, sensor][there], seen.variances[held, sensor][there]


def _combine_p_values(p_values: Sequence[float]) -> float:
    """Return the smallest of several p-values, corrected for their number (Bonferroni)."""
    return min(1.0, len(p_values) * min(p_values))


def _join_runs(runs: Sequence[FreeRuns]) -> FreeRuns:
    """Return the free runs of all parts, cut to the shortest."""
    shortest = min(r.error.shape[1] for r in runs)
    return replace(runs[0], lead=runs[0].lead[:shortest], error=np.vstack([r.error[:, :shortest] for r in runs]))


def _compute_nrmse(runs: FreeRuns, horizon: Horizon, scale: float) -> float:
    return float(np.sqrt(np.nanmean(runs.error[:, : horizon.steps + 1] ** 2)) / scale)


def is_worse(before: Prediction, after: Prediction, limits: HeldOutSettings = DEFAULT.heldout) -> bool:
    """Return whether a model predicts held-out data worse: free runs have a larger error, or the log score is lower.

    A small increase of the error is allowed (`HeldOutSettings.rise`), and a larger one that is not significant if
    one-step predictions are significantly better: free runs start from estimated states, which differ between models.
    The log score of one-step predictions must not fall significantly, by a t test over blocks of time, nor by more than
    `HeldOutSettings.fall`, unless the error of free runs falls to a small share: a few large one-step errors make the
    scatter large.
    """
    if not math.isfinite(after.nrmse):
        return True
    more = after.scores - before.scores
    if after.nrmse > (1.0 + limits.rise) * before.nrmse and not (
        _is_positive(more, limits.chance) and not is_better(before.errors, after.errors, limits.chance)
    ):
        return True
    if len(more) < 2:
        return False
    fall = -float(np.mean(more))
    if _is_positive(-more, limits.chance):
        return True
    return fall > limits.fall and after.nrmse > MUCH_SMALLER * before.nrmse


def _is_positive(values: Array, chance: float) -> bool:
    """Return whether the mean of values is significantly positive, by a one-sided t test."""
    if len(values) < 3 or not np.any(values):
        return False
    return bool(ttest_1samp(values, 0.0, alternative="greater").pvalue < chance)


def _average_by_parts(runs: Sequence[Sequence[FreeRuns]], horizon: Horizon, scales: Sequence[float]) -> Array:
    """Return the rms error (PARTS,) of the free runs (pieces, sensors) from successive parts of held-out data."""
    found = []
    for piece in runs:
        own = [np.nanmean(run.error[:, : horizon.steps + 1] ** 2, axis=1) for run in piece]
        found.append(np.mean([squares / scale**2 for squares, scale in zip(own, scales, strict=True)], axis=0))
    joint = np.concatenate(found)
    return np.array([math.sqrt(float(np.mean(part))) for part in np.array_split(joint, PARTS) if len(part)])


def is_better(errors: Array, without: Array, chance: float = DEFAULT.heldout.chance) -> bool:
    """Return whether `errors` (PARTS,) of one model are significantly smaller than those of another.

    It is a paired t test of their logarithms at the level `chance`, so parts with little motion have equal weight.
    """
    least = np.finfo(float).tiny
    more = np.log(np.maximum(without, least)) - np.log(np.maximum(errors, least))
    if len(more) < 3 or not np.all(np.isfinite(more)) or not np.any(more):
        return False
    return bool(np.mean(more) > 0.0 and ttest_1samp(more, 0.0).pvalue < chance)


def compute_motion_deviation(fit: Fit, pieces: Sequence[HeldOutStretch]) -> float:
    """Return the standard deviation of the motion of the machine, relative to its base if the base moves."""
    first = pieces[0].observation
    relative = fit.posterior.system.model.inputs[first.lead] == "base_position" and first.channel == "position"
    parts = [p.observation.response[p.begin :] - (p.observation.excitation[p.begin :] * relative) for p in pieces]
    return float(np.nanstd(np.concatenate(parts)))


def _run_freely(
    posterior: Posterior, fit: Fit, states: Array, piece: HeldOutStretch, horizon: Horizon
) -> tuple[FreeRuns, ...]:
    """Return free runs of each sensor from starts that are spread over a held-out part."""
    observation = piece.observation
    left = observation.samples - piece.begin
    steps = int(min(max(REACH * horizon.unit_time / observation.dt, horizon.steps + 1), left // 2))
    last = observation.samples - steps
    starts = np.unique(np.linspace(piece.begin, last, min(STARTS, max(last - piece.begin, 1))).astype(int))
    return predict_freely(posterior, fit.theta, states, starts, steps)


def choose_heldout_horizon(fit: Fit, pieces: Sequence[HeldOutStretch], exponent: float) -> Horizon:
    """Return the horizon of predictions, from the exponent of the better model."""
    return choose_horizon(pieces[0].observation, exponent, fit.posterior.scales.time)
