"""From a case to a first fit: what is free, what is held out, how large things are, and where to start."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.stats import qmc

from lostmotion.case import Case, Prior
from lostmotion.contracts import Array
from lostmotion.errors import CaseError, ContractError
from lostmotion.inference.fit import Fit, maximise, warmed
from lostmotion.inference.problem import LEVELS, NOISE, RANDOM, USUAL, Free, Problem, Scales
from lostmotion.inference.tracks import Track
from lostmotion.system import Slot, System, substeps

HELD_OUT = 0.3
LEVELS_TRIED = (0.3, 0.05, 0.008)
"""Random forces, as shares of the drive, with which starting points are compared: a large one lets the filter follow
whatever the parameters, a small one tells good parameters from bad ones."""

LEAST = 2.0 * math.log(0.3)
"""The random force is never less than 0.3 of the usual: with less, a filter trusts its linearisation too far, and
intervals from long recordings become too narrow (over 24 recordings, z rms 1.4 with 0.1 and 1.05 with 0.3)."""

FINE = 0.015
"""Final estimates take steps a quarter as long as those of the search: a kink makes RK4 first order."""


def split(tracks: Sequence[Track]) -> tuple[tuple[Track, ...], tuple[Track, ...]]:
    """Return what is fitted and what is held out: the last 30 % of one recording, or the last 30 % of several."""
    if len(tracks) == 1:
        cut = round((1.0 - HELD_OUT) * tracks[0].samples)
        return (tracks[0].part(0, cut),), (tracks[0].part(cut, tracks[0].samples),)
    kept = max(1, len(tracks) - max(1, round(HELD_OUT * len(tracks))))
    return tuple(tracks[:kept]), tuple(tracks[kept:])


def scales_of(system: System, tracks: Sequence[Track], known: Array) -> Scales:
    """Return the natural sizes of force, length and time of the recorded motion."""
    rate = float(np.median([_rate(t) for t in tracks]))
    order = {"position": 0, "velocity": 1, "acceleration": 2}[tracks[0].channel]
    length = float(np.median([t.amplitude for t in tracks])) / rate**order
    if "force" in system.model.inputs:
        force = math.sqrt(2.0) * float(np.sqrt(np.mean([np.var(t.inputs[:, 0]) for t in tracks])))
        force = force or float(np.mean([np.abs(t.inputs[:, 0]).max() for t in tracks]))
    else:
        force = known[system.index[system.model.interfaces[0].inertia]] * length * rate**2
    return Scales(force, length, 1.0 / rate)


def _rate(track: Track) -> float:
    """Return the rms angular frequency (rad/s) of the response above its noise floor."""
    z = np.where(np.isfinite(track.z), track.z, np.nanmean(track.z))
    power = np.abs(np.fft.rfft((z - z.mean()) * np.hanning(len(z)))) ** 2
    floor = 3.0 * float(np.median(power[-len(power) // 5 :]))
    power = np.maximum(power - floor, 0.0)
    omega = 2.0 * math.pi * np.fft.rfftfreq(len(z), track.dt)
    return float(math.sqrt(np.sum(power * omega**2) / max(np.sum(power), 1e-300))) or 2.0 * math.pi / (
        len(z) * track.dt
    )


def free_of(slot: Slot, prior: Prior) -> Free:
    """Return the free parameter of a case's prior."""
    if prior.mean is not None and prior.sd is not None:
        low = max(slot.param.low, prior.mean - 12.0 * prior.sd)
        return Free(slot.key, slot.unit, prior.mean, low, prior.mean + 12.0 * prior.sd, mean=prior.mean, sd=prior.sd)
    log = prior.scale == "log"
    low, high = (math.log(prior.low), math.log(prior.high)) if log else (prior.low, prior.high)
    return Free(slot.key, slot.unit, 0.5 * (low + high), low, high, log=log)


def usual_of(problem: Problem, rate: float) -> float:
    """Return the log intensity of the random force that the usual noise of a measured excitation makes.

    The noise of a base motion enters through the stiffness of the joint, of which `rate` (1/s) is the fastest motion.
    """
    system, track = problem.system, problem.tracks[0]
    size = USUAL * problem.scales.force
    if "force" not in system.model.inputs:
        inertia = problem.known[system.index[system.model.interfaces[0].inertia]]
        size = USUAL * math.sqrt(2.0) * float(np.std(track.inputs[:, 0])) * inertia * rate**2
    return math.log(max(size, 1e-300) ** 2 * track.dt)


def noise_frees(tracks: Sequence[Track], scales: Scales) -> tuple[Free, Free]:
    """Return the two noise levels: the intensity of a random force, and the measurement noise, as logarithms.

    The random force has a broad normal prior about the usual noise of a measured excitation.
    """
    usual = scales.usual
    start = max(random_level(tracks, scales, LEVELS_TRIED[0]), usual + 2.0)
    noise = math.log(float(np.median([t.noise for t in tracks])))
    return (
        Free(RANDOM, "1", start, usual + LEAST, start + 6.0, mean=usual, sd=4.0),
        Free(NOISE, "1", noise, noise - 7.0, noise + 3.0),
    )


def random_level(tracks: Sequence[Track], scales: Scales, share: float) -> float:
    """Return the log intensity of a random force that is the given share of the drive, white from sample to sample."""
    return math.log((share * scales.force) ** 2 * tracks[0].dt)


def known_of(system: System, case: Case) -> Array:
    """Return the full parameter vector of what a case says is known; the rest stands at the middle of its prior."""
    try:
        values = {system.slot(name).key: value for name, value in case.known.items()}
        guesses = {system.slot(name).key: prior.start() for name, prior in case.estimate.items()}
    except ContractError as err:
        raise CaseError(str(err)) from err
    for name, value in case.known.items():
        _check_bounds(system, name, value, value)
    for name, prior in case.estimate.items():
        at = prior.start()
        _check_bounds(system, name, *((prior.low, prior.high) if prior.mean is None else (at, at)))
    if twice := set(values) & set(guesses):
        raise CaseError(f"{sorted(twice)[0]} is both known and to be estimated: keep one of them")
    lacking = [
        s.key for s in system.slots if s.term is None and s.param.scale == "log" and s.key not in {*values, *guesses}
    ]
    if lacking:
        raise CaseError(
            f"{system.model.name} needs {', '.join(lacking)}: give each in [model.known] or in [model.estimate]"
        )
    return system.vector({**values, **guesses})


def _check_bounds(system: System, name: str, low: float, high: float) -> None:
    """Refuse values of a parameter that no machine has: outside of its bounds, or an inertia of zero."""
    slot = system.slot(name)
    param = slot.param
    inertia = slot.term is None and slot.key in {place.inertia for place in system.model.interfaces}
    if low < param.low or high > param.high or (inertia and low <= 0.0):
        found = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        wanted = "more than 0" if inertia else f"from {param.low:g} to {param.high:g}"
        raise CaseError(f"{name} ({param.meaning}) is {found}, wanted {wanted}: correct it in the case")


def problem_of(system: System, case: Case, tracks: tuple[Track, ...], *, jobs: int = 2) -> Problem:
    """Return the problem of a case on the given recordings, with no term active."""
    known = known_of(system, case)
    scales = scales_of(system, tracks, known)
    frees = [free_of(system.slot(name), prior) for name, prior in case.estimate.items()]
    problem = Problem(system, tracks, scales, known, tuple(frees), jobs=jobs)
    scales = replace(scales, usual=usual_of(problem, rate_of(problem, problem.start)))
    problem = replace(problem, scales=scales, free=(*frees, *noise_frees(tracks, scales)))
    return stepped(problem, problem.start)


def rate_of(problem: Problem, theta: Array) -> float:
    """Return the fastest rate (1/s) of the linearised motion over the region that the recording covers."""
    system, scales, track = problem.system, problem.scales, problem.tracks[0]
    grid = np.linspace(-1.5, 1.5, 7)
    states = np.zeros((len(grid) * 3, len(system.model.states)))
    states[:, 0] = np.repeat(grid, 3) * scales.length
    states[:, 1] = np.tile([-1.0, 0.03, 1.0], len(grid)) * scales.velocity
    middle = np.repeat(np.mean(track.inputs, axis=0)[None], len(states), axis=0)
    rate = system.stiffness(problem.full(theta), problem.active, states, middle)
    return max(rate, 1.0 / scales.time)


def stepped(problem: Problem, theta: Array, *, accuracy: float = 0.06) -> Problem:
    """Return the problem with as many steps between samples as the stiffness along the recorded motion asks for."""
    rate = rate_of(problem, theta)
    return replace(problem, nsub=substeps(rate, problem.tracks[0].dt, accuracy=accuracy))


def search(problem: Problem, rng: np.random.Generator, *, points: int = 48, finalists: int = 4) -> Fit:
    """Return the best fit of several starts: a Latin hypercube on the beginning of the recording, then all of it."""
    beginning = problem.on(tuple(t.part(0, min(t.samples, 3000)) for t in problem.tracks[:1]))
    base = [i for i, f in enumerate(problem.free) if f.key not in LEVELS]
    starts = np.repeat(problem.start[None], points, axis=0)
    random = problem.keys.index(RANDOM)
    if base:
        cube = qmc.LatinHypercube(len(base), rng=rng).random(points - 1)
        low, high = (np.array([getattr(problem.free[i], end) for i in base]) for end in ("low", "high"))
        starts[1:, base] = low + cube * (high - low)
    scores = np.full(points, -np.inf)
    for share in LEVELS_TRIED:
        starts[:, random] = random_level(problem.tracks, problem.scales, share)
        at_share = [here.log_likelihood for here in beginning.many(problem.clip(starts))]
        scores = np.maximum(scores, at_share)
    starts[:, random] = problem.start[random]
    best = np.argsort(scores)[::-1][:finalists]
    fits = [maximise(beginning, starts[i]) for i in best]
    ranked = sorted(fits, key=lambda f: -f.local.log_posterior)
    chosen = _distinct(ranked)
    whole = [maximise(stepped(problem, f.theta), warmed(problem, f.theta, 3.0)) for f in chosen]
    return max(whole, key=lambda f: f.local.log_posterior)


def _distinct(fits: list[Fit]) -> list[Fit]:
    """Return the best fit, and the next one if it is another mode of about the same height."""
    best = fits[0]
    for other in fits[1:]:
        far = np.abs(other.theta - best.theta) > 10.0 * np.array(list(best.sd.values()))
        if far.any() and other.local.log_posterior > best.local.log_posterior - 20.0:
            return [best, other]
    return [best]


def polish(fit: Fit) -> Fit:
    """Return the fit with finer integration steps."""
    problem = stepped(fit.problem, fit.theta, accuracy=FINE)
    finer = maximise(problem, fit.theta)
    return finer if finer.status in ("converged", "rough") else fit
