"""The likelihood-ratio bound of a blind trial: the result of a fit of the true model to a recording.

Nominal and true model are fitted with the likelihood of the diagnosis, starting at the truth. The gain of the true
terms is the logarithm of the likelihood ratio. No test is more powerful than the likelihood-ratio test.
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
from lostmotion.inference.setup import choose_steps, make_posterior, polish_fit, search_maximum, split_heldout
from lostmotion.inference.unseen import refit_without_position
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import Horizon
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.system import System, key_of
from lostmotion.noises import NOISE
from lostmotion.preparation.prepare import Prepared
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Diagnosis, HeldOutScores, Mechanism
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.blind.sealed import SealedMachine
from lostmotion_trials.blind.simulator import BlindDrive, BlindMachine

EQUIVALENT: tuple[frozenset[str], ...] = (
    frozenset({"excitation_delay", "sensor_delay"}),
    frozenset({"excitation_gain", "sensor_gain"}),
    frozenset({"dahl_friction", "lugre_friction", "bouc_wen_hysteresis"}),
    frozenset({"actuator_lag", "sensor_lag"}),
)
"""Mechanisms that no recording of this kind can distinguish: each name of a set counts as correct."""
SKIPPED = ("sensor_quantisation", "unknown")
"""Mechanisms without a likelihood."""
WARM_STARTS = (0.0, 3.0, 2.0 * math.log(300.0))
"""Fits start with the usual random force and with larger ones (log intensity). With the largest, 0.3 of the drive, the
fit of a model that lacks a term converges from a distant start."""


def are_equivalent(one: str, other: str) -> bool:
    """Return whether two names are equal or count as the same mechanism."""
    return one == other or any({one, other} <= same for same in EQUIVALENT)


@dataclass(frozen=True)
class LikelihoodBound:
    """The result of the true model: the gain in log-likelihood of each effect (NaN without a term), with a status.

    `nrmse` is its error on held-out data over the horizon of the diagnosis. `margin` is its log-likelihood minus that
    of the model that was found. They are NaN if a model could not be fitted.
    """

    gains: tuple[float, ...]
    status: tuple[str, ...]
    nrmse: float = math.nan
    margin: float = math.nan


def compute_bound(
    prepared: Prepared, machine: SealedMachine, effects: Sequence[Effect], said: Diagnosis | None
) -> LikelihoodBound:
    """Return the result of the true model of a case, with its held-out error if there is a diagnosis."""
    _, held = split_heldout(prepared.observations)
    posterior = _pose_at_truth(prepared, machine)
    system = posterior.system
    effects = [add_library_names(effect, machine) for effect in effects]
    keys = [find_key(system, effect.mechanism, effect.at) for effect in effects]
    status = [_find_status(effect, key) for effect, key in zip(effects, keys, strict=True)]
    acting = {key: effect.parameters for key, effect in zip(keys, effects, strict=True) if key}
    nominal = search_maximum(posterior, np.random.default_rng(0))

    def fit_best(terms: Mapping[str, Mapping[str, float]]) -> Fit:
        """Return the better of the fits that start at the truth and at the best nominal model."""
        fits = [_fit_terms(posterior, terms), _fit_terms(restart(nominal), terms) if terms else nominal]
        return max(fits, key=lambda f: f.local.log_posterior)

    full = fit_best(acting)
    gains = [
        max(full.log_likelihood - fit_best({k: e for k, e in acting.items() if k != key}).log_likelihood, 0.0)
        if key
        else _gain_without_term(full, effect)
        for key, effect in zip(keys, effects, strict=True)
    ]
    known = all(key or effect.mechanism == "random_force" for key, effect in zip(keys, effects, strict=True))
    if said is None or not known:
        return LikelihoodBound(tuple(gains), tuple(status))
    margin = _measure_margin(full, posterior, said.found) if acting else math.nan
    error = _predict_heldout(polish_fit(full), prepared, held, said.fit)
    return LikelihoodBound(tuple(gains), tuple(status), error, margin)


def compute_lead(prepared: Prepared, machine: SealedMachine, effect: Effect, other: Effect) -> float:
    """Return the log-likelihood of the law of an effect less that of another law, each fitted from its parameters.

    Both are fitted to the data that a diagnosis fits. Where the other law is a part of the first one, the lead is the
    gain of what it lacks.
    """
    posterior = _pose_at_truth(prepared, machine)
    laws = (add_library_names(effect, machine), other)
    keys = [(find_key(posterior.system, law.mechanism, law.at), law) for law in laws]
    fits = (_fit_terms(posterior, {key: law.parameters}) if key else None for key, law in keys)
    first, second = (refit_without_position(fit) if fit else None for fit in fits)
    return first.log_likelihood - second.log_likelihood if first and second else math.nan


def add_library_names(effect: Effect, machine: BlindMachine) -> Effect:
    """Return an effect with its parameters under all further names of the library."""
    return replace(effect, parameters=complete_parameters(effect.parameters, machine.values, machine.signal))


def complete_parameters(
    truth: Mapping[str, float], values: Mapping[str, float], signal: BlindDrive
) -> dict[str, float]:
    """Return the parameters of an effect under all further names of the library.

    `values` are those of the machine. A wave with amplitude and phase (rad) also has a cosine and a sine part; a wave
    of the drive is a share of the drive. A hidden mass is a share of the moving mass. The share of a cut drive is 1.
    """
    if "mass" in truth:
        return {**truth, "mass_ratio": truth["mass"] / values["m"]}
    if {"limit", "width"} & set(truth):
        return {**truth, "share": 1.0}
    if "phase" not in truth:
        return dict(truth)
    phase = truth["phase"]
    if "pitch" in truth:
        size_name = next(name for name in ("wave", "size", "force") if name in truth)
        phase -= 0.5 * math.pi if size_name == "force" else 0.0
        return {**truth, "phase": phase, **_split_wave(truth[size_name], phase)}
    drive = math.hypot(*(tone[0] for tone in signal.tones))
    depth = truth["depth"] if "depth" in truth else truth["amplitude"] / drive
    return {**truth, "share": depth, **_split_wave(depth, phase)}


def _split_wave(size: float, phase: float) -> dict[str, float]:
    """Return cosine and sine of size * cos(angle + phase)."""
    return {"cosine": size * math.cos(phase), "sine": -size * math.sin(phase)}


def _measure_margin(full: Fit, posterior: Posterior, found: Sequence[Mechanism]) -> float:
    """Return the log-likelihood of the true model minus that of a model with the found mechanisms instead."""
    keys = {find_key(posterior.system, entry.mechanism, entry.at): entry for entry in found}
    if None in keys or set(keys) == set(full.posterior.active):
        return math.nan
    medians = {key: {n: i.median for n, i in entry.parameters.items()} for key, entry in keys.items() if key}
    return float(full.log_likelihood - _fit_terms(posterior, medians).log_likelihood)


def find_key(system: System, mechanism: str, at: str) -> str | None:
    """Return the key of the term of a mechanism at a place, or of an equivalent term; None if there is none."""
    same = [t for t in system.terms if are_equivalent(t.name, mechanism) and at in ("", t.at)]
    usable = [t for t in same if not t.marked]
    return next((key_of(t) for t in sorted(usable, key=lambda t: t.name != mechanism)), None)


def _find_status(effect: Effect, key: str | None) -> str:
    """Return "ok", or why an effect has no gain."""
    if key or effect.mechanism == "random_force":
        return "ok"
    return "no likelihood" if effect.mechanism in SKIPPED else "no term"


def _gain_without_term(fit: Fit, effect: Effect) -> float:
    """Return the gain of an effect without a term: of a random force above the usual level; otherwise NaN."""
    return compute_random_force_gain(fit) if effect.mechanism == "random_force" else math.nan


def _pose_at_truth(prepared: Prepared, machine: SealedMachine) -> Posterior:
    """Return the posterior of the fitted data, with the true values and the usual noise as its start."""
    train, _ = split_heldout(prepared.observations)
    posterior = make_posterior(System(prepared.model, prepared.terms), prepared.case, train, jobs=1)
    free = []
    for f in posterior.space.free:
        if f.level == NOISE:
            free.append(replace(f, start=_clip(math.log(machine.measurement_noise), f.low, f.high)))
        elif f.parameter == RANDOM:
            free.append(replace(f, start=_clip(posterior.scales.usual, f.low, f.high)))
        else:
            free.append(replace(f, start=f.coordinate(machine.values[f.parameter])))
    begun = posterior.over(free)
    return choose_steps(begun, begun.space.start)


def _clip(value: float, low: float, high: float) -> float:
    """Return the value limited to the range from `low` to `high`."""
    return min(max(value, low), high)


def _fit_terms(posterior: Posterior, acting: Mapping[str, Mapping[str, float]]) -> Fit:
    """Return the best fit with these terms, started at the truth with several levels of the random force."""
    for key, parameters in acting.items():
        posterior = _add_term(posterior, key, parameters)
    fits = [maximise(posterior, raise_random_force(posterior, posterior.space.start, by)) for by in WARM_STARTS]
    best = max(fits, key=lambda f: f.local.log_posterior)
    again = maximise(restart(best), raise_random_force(posterior, best.theta, 1.0))
    return max((best, again), key=lambda f: f.local.log_posterior)


def _add_term(posterior: Posterior, key: str, truth: Mapping[str, float]) -> Posterior:
    """Return the posterior with one more term, started at its true parameters where they are known."""
    _, slots = find_term(posterior, key)
    return join_term(posterior, key, {s.key: truth[s.param.name] for s in slots if s.param.name in truth})


def _predict_heldout(fit: Fit, prepared: Prepared, held: Sequence[Observation], said: HeldOutScores) -> float:
    """Return the error (NRMSE) of free runs of a fit on held-out data over the horizon of a diagnosis."""
    pieces = cut_heldout(prepared.observations, held)
    observation = pieces[0].observation
    unit_time, number = said.horizon_unit_time, said.after.horizon
    steps = int(min(max(round(number * unit_time / observation.dt), 2), observation.samples // 4))
    horizon = Horizon(steps, number, said.horizon_unit, unit_time)
    error = predict(fit, pieces, horizon, compute_rates(fit, prepared.observations)).nrmse
    return float(error) if np.isfinite(error) else math.nan


def is_covered(interval: Interval, truth: float, *, turn: bool = False) -> bool:
    """Return whether an interval contains the truth; with `turn` it is an angle in rad, compared modulo 2 pi."""
    at = _choose_turn(truth, interval.median) if turn else truth
    return bool(interval.low <= at <= interval.high)


def _choose_turn(angle: float, near: float) -> float:
    """Return the angle (rad) plus the whole turns that bring it nearest to another angle."""
    return angle + 2.0 * math.pi * round((near - angle) / (2.0 * math.pi))
