"""The likelihood-ratio bound of a blind trial: the result that a fit of the true model reaches on a recording.

Nominal and true model are fitted with the likelihood of the diagnosis, starting at the truth. The gain of the true
terms is the logarithm of the likelihood ratio, and no test is more powerful than the likelihood-ratio test.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.diagnosis.compare import compute_rates, cut_heldout, predict
from lostmotion.inference.candidates import join_term
from lostmotion.inference.fit import Fit, maximise, raise_random_force, restart
from lostmotion.inference.natural import find_term
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.inference.setup import choose_steps, make_problem, polish_fit, split_heldout
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import Horizon
from lostmotion.likelihood.problem import NOISE, RANDOM, Problem
from lostmotion.likelihood.system import System, key_of
from lostmotion.preparation.prepare import Prepared
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Diagnosis, HeldOutScores, Mechanism
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.blind.sealed import SealedMachine
from lostmotion_trials.blind.simulator import BlindDrive, BlindMachine

ALIKE: tuple[frozenset[str], ...] = (
    frozenset({"excitation_delay", "sensor_delay"}),
    frozenset({"excitation_gain", "sensor_gain"}),
    frozenset({"dahl_friction", "lugre_friction", "bouc_wen_hysteresis"}),
    frozenset({"actuator_lag", "sensor_lag"}),
)
"""Mechanisms that no recording of this kind can distinguish: either name is right."""
SKIPPED = ("sensor_quantisation", "unknown")
"""Mechanisms without a likelihood."""
WARM_STARTS = (0.0, 3.0, 2.0 * math.log(300.0))
"""Fits start with the usual random force and with larger ones (log intensity). With the largest, 0.3 of the drive, the
fit of a model that lacks a term converges from a distant start."""


def alike(one: str, other: str) -> bool:
    """Return whether two names count as one."""
    return one == other or any({one, other} <= same for same in ALIKE)


@dataclass(frozen=True)
class Yardstick:
    """The result of the true model: the gain of each effect (NaN where no term models it), with a status.

    `nrmse` is its error on held-out data over the horizon of the diagnosis, and `margin` by how much log-likelihood it
    is better than the model that was found; NaN where either could not be fitted.
    """

    gains: tuple[float, ...]
    status: tuple[str, ...]
    nrmse: float = math.nan
    margin: float = math.nan


def yardstick(
    prepared: Prepared, machine: SealedMachine, effects: Sequence[Effect], said: Diagnosis | None
) -> Yardstick:
    """Return what the true model of a case reaches, over the horizon of a diagnosis if there is one."""
    train, held = split_heldout(prepared.observations)
    system = System(prepared.model, prepared.terms)
    problem = _start_at_truth(make_problem(system, prepared.case, train, jobs=1), machine)
    effects = [add_library_names(effect, machine) for effect in effects]
    keys = [find_key(system, effect.mechanism, effect.at) for effect in effects]
    status = [_find_status(effect, key) for effect, key in zip(effects, keys, strict=True)]
    acting = {key: effect.parameters for key, effect in zip(keys, effects, strict=True) if key}
    full = _fit_terms(problem, acting)
    gains = [
        max(
            full.log_likelihood - _fit_terms(problem, {k: e for k, e in acting.items() if k != key}).log_likelihood, 0.0
        )
        if key
        else _gain_without_term(full, effect)
        for key, effect in zip(keys, effects, strict=True)
    ]
    known = all(key or effect.mechanism == "random_force" for key, effect in zip(keys, effects, strict=True))
    if said is None or not known:
        return Yardstick(tuple(gains), tuple(status))
    margin = _measure_margin(full, problem, said.found) if acting else math.nan
    error = _predict_heldout(polish_fit(full), prepared, held, said.fit)
    return Yardstick(tuple(gains), tuple(status), error, margin)


def add_library_names(effect: Effect, machine: BlindMachine) -> Effect:
    """Return an effect whose parameters have all further names that they have in the library."""
    return replace(effect, parameters=spelled(effect.parameters, machine.values, machine.signal))


def spelled(truth: Mapping[str, float], values: Mapping[str, float], signal: BlindDrive) -> dict[str, float]:
    """Return the parameters of an effect with all further names they have in the library.

    `values` are those of the machine. A wave of an amplitude and a phase (rad) has a cosine and a sine; one of the
    drive is a share of that. A hidden mass is a share of the moving one, and of a drive that is cut all is lost.
    """
    if "mass" in truth:
        return {**truth, "mass_ratio": truth["mass"] / values["m"]}
    if {"limit", "width"} & set(truth):
        return {**truth, "share": 1.0}
    if "phase" not in truth:
        return dict(truth)
    phase = truth["phase"]
    if "pitch" in truth:
        sized = next(name for name in ("wave", "size", "force") if name in truth)
        phase -= 0.5 * math.pi if sized == "force" else 0.0
        return {**truth, "phase": phase, **_split_wave(truth[sized], phase)}
    drive = math.hypot(*(tone[0] for tone in signal.tones))
    depth = truth["depth"] if "depth" in truth else truth["amplitude"] / drive
    return {**truth, "share": depth, **_split_wave(depth, phase)}


def _split_wave(size: float, phase: float) -> dict[str, float]:
    """Return cosine and sine of size * cos(angle + phase)."""
    return {"cosine": size * math.cos(phase), "sine": -size * math.sin(phase)}


def _measure_margin(full: Fit, problem: Problem, found: Sequence[Mechanism]) -> float:
    """Return by how much log-likelihood the true model is better than one with what was found in place of it."""
    keys = {find_key(problem.system, entry.mechanism, entry.at): entry for entry in found}
    if None in keys or set(keys) == set(full.problem.active):
        return math.nan
    medians = {key: {n: i.median for n, i in entry.parameters.items()} for key, entry in keys.items() if key}
    return float(full.log_likelihood - _fit_terms(problem, medians).log_likelihood)


def find_key(system: System, mechanism: str, at: str) -> str | None:
    """Return the term that stands for a mechanism at a place, or one that equals it; None where there is none."""
    same = [t for t in system.terms if alike(t.name, mechanism) and at in ("", t.at)]
    usable = [t for t in same if not t.marked]
    return next((key_of(t) for t in sorted(usable, key=lambda t: t.name != mechanism)), None)


def _find_status(effect: Effect, key: str | None) -> str:
    if key or effect.mechanism == "random_force":
        return "ok"
    return "no likelihood" if effect.mechanism in SKIPPED else "no term"


def _gain_without_term(fit: Fit, effect: Effect) -> float:
    """Return the gain of what is no term: a random force beyond the usual."""
    return compute_random_force_gain(fit) if effect.mechanism == "random_force" else math.nan


def _start_at_truth(problem: Problem, machine: SealedMachine) -> Problem:
    """Return the problem with the true values, and the usual noise, as its start."""
    free = []
    for f in problem.free:
        if f.level == NOISE:
            free.append(replace(f, start=_clip(math.log(machine.measurement_noise), f.low, f.high)))
        elif f.parameter == RANDOM:
            free.append(replace(f, start=_clip(problem.scales.usual, f.low, f.high)))
        else:
            free.append(replace(f, start=f.coordinate(machine.values[f.parameter])))
    begun = replace(problem, free=tuple(free))
    return choose_steps(begun, begun.start)


def _clip(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


def _fit_terms(problem: Problem, acting: Mapping[str, Mapping[str, float]]) -> Fit:
    """Return the best fit with these terms, begun at the truth with several random forces."""
    for key, parameters in acting.items():
        problem = _add_term(problem, key, parameters)
    fits = [maximise(problem, raise_random_force(problem, problem.start, by)) for by in WARM_STARTS]
    best = max(fits, key=lambda f: f.local.log_posterior)
    again = maximise(restart(best), raise_random_force(problem, best.theta, 1.0))
    return max((best, again), key=lambda f: f.local.log_posterior)


def _add_term(problem: Problem, key: str, truth: Mapping[str, float]) -> Problem:
    """Return the problem with one more term, begun at its true parameters where it has them."""
    _, slots = find_term(problem, key)
    return join_term(problem, key, {s.key: truth[s.param.name] for s in slots if s.param.name in truth})


def _predict_heldout(fit: Fit, prepared: Prepared, held: Sequence[Observation], said: HeldOutScores) -> float:
    """Return the error of free runs of a fit on held-out data, over the horizon that a diagnosis chose."""
    pieces = cut_heldout(prepared.observations, held)
    observation = pieces[0].observation
    unit_time, number = said.horizon_unit_time, said.after.horizon
    steps = int(min(max(round(number * unit_time / observation.dt), 2), observation.samples // 4))
    horizon = Horizon(steps, number, said.horizon_unit, unit_time)
    error = predict(fit, pieces, horizon, compute_rates(fit, prepared.observations)).nrmse
    return float(error) if np.isfinite(error) else math.nan


def is_covered(interval: Interval, truth: float, *, turn: bool = False) -> bool:
    """Return whether an interval holds a truth; with `turn` it is an angle in rad."""
    at = _choose_turn(truth, interval.median) if turn else truth
    return bool(interval.low <= at <= interval.high)


def _choose_turn(angle: float, near: float) -> float:
    return angle + 2.0 * math.pi * round((near - angle) / (2.0 * math.pi))
