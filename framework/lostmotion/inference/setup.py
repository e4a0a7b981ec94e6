"""From a case to a first fit: free parameters, held-out data, natural sizes, and starting points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.case import CaseFile, Prior, SensorSpec
from lostmotion.contracts import Array
from lostmotion.errors import CaseError, ContractError
from lostmotion.inference.candidates import CREEP, count_steps_for_sticking
from lostmotion.inference.fit import Fit, maximise, raise_random_force, restart
from lostmotion.inference.modes import StartingPoints, select_modes
from lostmotion.inference.unseen import refit_without_position
from lostmotion.kernels.threads import each
from lostmotion.likelihood.noise_levels import (
    LEVELS_TRIED,
    compute_random_level,
    compute_usual_level,
    make_noise_levels,
    make_own_levels,
)
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import OFFSET, RANDOM, FreeParameter, ParameterSpace, Scales, list_keys
from lostmotion.likelihood.steps import run_system
from lostmotion.likelihood.system import Slot, System
from lostmotion.noises import NOISE
from lostmotion.quantities import quantity_of, unit_of
from lostmotion.recording.value_checks import fill_lost
from lostmotion.settings import DEFAULT, HeldOutSettings, Settings

BLOCKS = 60
"""Parts of a recording in which its motion is compared with the noise."""
SHARED = SensorSpec("shared")
"""A sensor whose noise levels are shared by all recordings."""
BEGINNING, FEWEST = 3000, 400
"""The samples of one recording on which starting points are compared, and the least number of each of several."""

SLACK = 30.0
"""The range of log posterior below the best within which modes are kept before the final fits."""

ORDERS = ("position", "velocity", "acceleration")
"""The quantities of motion sensors, by the order of differentiation."""
SLOWEST = 4
"""The least number of cycles of a motion in a recording: a lower frequency in a spectrum is leakage of the window."""
FAR_ABOVE = 20.0
"""A spectral line counts as motion above this multiple of the noise floor, which one of 10^6 lines of noise exceeds."""

COARSE, FINE = 0.06, 0.015
"""Step times fastest rate in the search and in the final fit: steps of the final fit are a quarter as long, because RK4
is of first order at a kink."""


def split_heldout(
    observations: Sequence[Observation], limits: HeldOutSettings = DEFAULT.heldout
) -> tuple[tuple[Observation, ...], tuple[Observation, ...]]:
    """Return the fitted and the held-out data: the last `limits.share` of one recording, or of several.

    If a motion decays, the share refers to the samples before it has decayed.
    """
    if len(observations) == 1:
        cut = round((1.0 - limits.share) * count_lasting_samples(observations[0], limits))
        return (observations[0].part(0, cut),), (observations[0].part(cut, observations[0].samples),)
    kept = limits.count_fitted(len(observations))
    return tuple(observations[:kept]), tuple(observations[kept:])


def count_lasting_samples(observation: Observation, limits: HeldOutSettings = DEFAULT.heldout) -> int:
    """Return the number of samples of a recording until its motion has decayed, or all of them.

    A block of readings contains motion where its deviation is more than `limits.alive` times the noise. The motion has
    decayed where at least half of what would be held out contains none: predictions of a machine at rest neither
    confirm nor refute a model.
    """
    sensor = choose_main_sensor(observation)
    blocks = np.array_split(fill_lost(observation.readings[:, sensor]), BLOCKS)
    alive = np.array([float(np.std(block)) for block in blocks]) > limits.alive * observation.noises[sensor]
    last = int(np.flatnonzero(alive)[-1]) + 1 if alive.any() else BLOCKS
    if last > (1.0 - 0.5 * limits.share) * BLOCKS:
        return observation.samples
    return sum(len(block) for block in blocks[:last])


def compute_scales(system: System, observations: Sequence[Observation], known: Array) -> Scales:
    """Return the natural sizes of force, length and time of the recorded motion."""
    span, nyquist = max(t.samples * t.dt for t in observations), 0.5 / max(t.dt for t in observations)
    return replace(_compute_sizes(system, observations, known), span=span, nyquist=nyquist)


def _compute_sizes(system: System, observations: Sequence[Observation], known: Array) -> Scales:
    sensor = choose_main_sensor(observations[0])
    rates, lengths = zip(*(_measure_motion(t, sensor) for t in observations), strict=True)
    rate, length = float(np.median(rates)), float(np.median(lengths))
    if quantity_of(observations[0].sensors[sensor].channel) == "force":
        return Scales(length, float(np.median([t.travel for t in observations])), 1.0 / rate)
    inertia = system.own_inertia(known, system.model.first_place)
    pushes = [_measure_push(system, t, inertia) for t in observations]
    force = float(np.sqrt(np.mean(np.square([varying for varying, _ in pushes]))))
    force = force or float(np.mean([peak for _, peak in pushes])) or inertia * length * rate**2
    return Scales(force, length, 1.0 / rate)


def choose_main_sensor(observation: Observation) -> int:
    """Return the number of the sensor that gives the size of the motion: a position, else the next best there is."""
    order = (*ORDERS, "force", "current", "voltage")
    kinds = [order.index(quantity_of(sensor.channel)) for sensor in observation.sensors]
    return int(np.argmin(kinds))


def _measure_push(system: System, observation: Observation, inertia: float) -> tuple[float, float]:
    """Return the amplitude (sqrt(2) times the standard deviation) of all driving forces, and their peak.

    A base that is shaken acts by its acceleration; one that moves through a joint acts by an unknown force: zero.
    """
    squares, peak = 0.0, 0.0
    for name, u in zip(system.model.inputs, observation.inputs.T, strict=False):
        weight = inertia if name == "base_acceleration" else float(quantity_of(name) == "force")
        squares += 2.0 * weight**2 * float(np.var(u))
        peak = max(peak, weight * float(np.abs(u).max()))
    return math.sqrt(squares), peak


def _measure_motion(observation: Observation, sensor: int) -> tuple[float, float]:
    """Return the rms angular frequency (rad/s) of the motion a sensor shows, and its amplitude as a position.

    Velocity and acceleration are integrated as spectra, where these are far above their noise: noise at low frequency
    would be drift, and the spikes of an acceleration are no motion. A force stays a force.
    """
    quantity, readings = quantity_of(observation.sensors[sensor].channel), observation.readings[:, sensor]
    order = ORDERS.index(quantity) if quantity in ORDERS else 0
    z, amplitude = fill_lost(readings), math.sqrt(2.0) * float(np.nanstd(readings))
    power = np.abs(np.fft.rfft((z - z.mean()) * np.hanning(len(z)))) ** 2
    floor, whole = float(np.median(power[-len(power) // 5 :])), float(np.sum(power))
    power = np.where(power > FAR_ABOVE * floor, power, 0.0) if order else np.maximum(power - 3.0 * floor, 0.0)
    omega = 2.0 * math.pi * np.fft.rfftfreq(len(z), observation.dt)
    first = SLOWEST if order else 1
    moved = np.zeros_like(power)
    moved[first:] = power[first:] / omega[first:] ** (2 * order)
    rate = math.sqrt(np.sum(moved * omega**2) / max(np.sum(moved), 1e-300)) or 2.0 * math.pi / (len(z) * observation.dt)
    if not order:
        return rate, amplitude
    share = math.sqrt(np.sum(moved) / max(whole, 1e-300)) or rate**-order
    return rate, amplitude * share


def make_free_parameter(slot: Slot, prior: Prior) -> FreeParameter:
    """Return the free parameter of a case's prior, where all recordings share it."""
    return _make_free(slot.key, slot.unit, prior, (slot.param.low, slot.param.high))


def make_case_parameters(slot: Slot, prior: Prior, recordings: Sequence[str]) -> tuple[FreeParameter, ...]:
    """Return the free parameters of a case's prior: one, or with `each` one for each of the named recordings."""
    shared = make_free_parameter(slot, prior)
    keys = list_keys(slot.key, recordings) if prior.each else (slot.key,)
    return tuple(replace(shared, key=key) for key in keys)


def _make_free(key: str, unit: str, prior: Prior, bounds: tuple[float, float]) -> FreeParameter:
    """Return the free parameter with a prior, cut at the bounds (value) and 12 standard deviations from its middle."""
    log = prior.kind in ("log-uniform", "log-normal")
    if prior.bell is None:
        low, high = (math.log(prior.low), math.log(prior.high)) if log else (prior.low, prior.high)
        return FreeParameter(key, unit, 0.5 * (low + high), low, high, log=log)
    mean, sd = prior.bell
    ends = [math.log(max(end, 1e-300)) for end in bounds] if log else [*bounds]
    low, high = max(ends[0], mean - 12.0 * sd), min(ends[1], mean + 12.0 * sd)
    if prior.kind == "half-normal":
        low = max(low, 0.0)
    start = math.log(prior.start()) if log else prior.start()
    return FreeParameter(key, unit, min(max(start, low), high), low, high, log=log, mean=mean, sd=sd)


def make_known(system: System, case: CaseFile) -> Array:
    """Return the full parameter vector of the known values of a case; the rest is at the middle of its prior."""
    try:
        values = {system.slot(name).key: value for name, value in case.known.items()}
        guesses = {system.slot(name).key: prior.start() for name, prior in case.estimate.items()}
    except ContractError as err:
        raise CaseError(str(err)) from err
    for name, value in case.known.items():
        _check_bounds(system, name, value, value)
    for name, prior in case.estimate.items():
        at = prior.start()
        _check_bounds(system, name, *((prior.low, prior.high) if prior.bell is None else (at, at)))
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
    """Raise a `CaseError` for values of a parameter outside of its bounds, or for an inertia of zero."""
    slot = system.slot(name)
    param = slot.param
    inertia = slot.term is None and slot.key in system.inertia_keys
    if low < param.low or high > param.high or (inertia and low <= 0.0):
        found = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        wanted = "more than 0" if inertia else f"from {param.low:g} to {param.high:g}"
        raise CaseError(f"{name} ({param.meaning}) is {found}, expected {wanted}: correct it in the case")


def make_posterior(
    system: System,
    case: CaseFile,
    observations: tuple[Observation, ...],
    *,
    jobs: int = 2,
    settings: Settings = DEFAULT,
) -> Posterior:
    """Return the posterior of a case on the given recordings, with no term active, noise levels shared.

    The zero of each loose sensor is free in each recording.
    """
    known = make_known(system, case)
    scales = compute_scales(system, observations, known)
    names = [observation.name for observation in observations]
    frees = [f for name, prior in case.estimate.items() for f in make_case_parameters(system.slot(name), prior, names)]
    space = ParameterSpace(tuple(frees))
    posterior = Posterior(space, observations, run_system(system), scales, known, jobs=jobs, settings=settings)
    scales = replace(scales, usual=compute_usual_level(posterior, find_fastest_rate(posterior, posterior.space.start)))
    levels = (*_make_offsets(posterior, None), *make_noise_levels(observations, scales))
    posterior = replace(posterior, scales=scales).over((*frees, *levels))
    return choose_steps(posterior, posterior.space.start)


def find_fastest_rate(posterior: Posterior, theta: Array) -> float:
    """Return the fastest rate (1/s) of the linearised motion over the region that the recording covers."""
    system, scales, observation = posterior.system, posterior.scales, posterior.observations[0]
    grid = np.linspace(-1.5, 1.5, 7)
    speeds = np.tile([-1.0, 0.03, 1.0], len(grid))
    states = system.spread_states(np.repeat(grid, 3) * scales.length, speeds * scales.velocity)
    middle = np.repeat(np.mean(observation.inputs, axis=0)[None], len(states), axis=0)
    alike = all(f.recording is None or not f.physical for f in posterior.space.free)
    fulls = [posterior.recordings[i].full(theta) for i in range(1 if alike else len(posterior.observations))]
    dt, active = observation.dt, posterior.active
    return max(1.0 / scales.time, *(system.find_fastest_rate(full, active, states, middle, dt) for full in fulls))


def choose_steps(posterior: Posterior, theta: Array, *, accuracy: float = COARSE) -> Posterior:
    """Return the posterior with the number of steps between samples for the stiffness along the recorded motion."""
    rate = find_fastest_rate(posterior, theta)
    dt, held = max(t.dt for t in posterior.observations), all(t.held for t in posterior.observations)
    steps = posterior.system.count_substeps(rate, dt, accuracy, active=posterior.active, held=held)
    return posterior.stepped(max(steps, count_steps_for_sticking(posterior, theta, creep=CREEP * accuracy / COARSE)))


def search_maximum(posterior: Posterior, rng: np.random.Generator, *, points: int = 48, finalists: int = 4) -> Fit:
    """Return the best fit of several starts: a Latin hypercube on the beginnings of recordings, then all samples."""
    beginning = cut_beginnings(posterior)
    tried = _draw_starts(posterior, beginning, rng, points)
    single = replace(beginning, jobs=1)
    fits = each(
        lambda i: refit_without_position(maximise(single, tried.starts[i])), tried.best(finalists), posterior.jobs
    )
    ranked = sorted(fits, key=lambda f: -f.local.log_posterior)
    chosen = _select_finalists(ranked)
    return max((_extend_to_whole(posterior, f) for f in chosen), key=lambda f: f.local.log_posterior)


def _extend_to_whole(posterior: Posterior, short: Fit, hopeless: float = -math.inf) -> Fit:
    """Return the fit of whole recordings, started from a fit of their beginnings."""
    begun = zip(posterior.observations, short.posterior.observations, strict=True)
    whole = choose_steps(posterior.on(tuple(replace(t, begun=b.begun) for t, b in begun)), short.theta)
    return refit_without_position(maximise(whole, raise_random_force(whole, short.theta, 3.0), hopeless=hopeless))


def cut_beginnings(posterior: Posterior) -> Posterior:
    """Return the posterior on the beginnings of recordings, about `BEGINNING` samples of one or twice that of all."""
    several = len(posterior.observations) > 1
    samples = max(2 * BEGINNING // len(posterior.observations), FEWEST) if several else BEGINNING
    return posterior.on(tuple(t.part(0, min(t.samples, samples)) for t in posterior.observations))


def _draw_starts(posterior: Posterior, beginning: Posterior, rng: np.random.Generator, points: int) -> StartingPoints:
    """Return a Latin hypercube over the priors, scored with the best of three random forces.

    A parameter with a value for each recording starts at the same value in all of them.
    """
    names = list(dict.fromkeys(f.parameter for f in posterior.space.free if f.physical))
    starts = np.repeat(posterior.space.start[None], points, axis=0)
    cube = np.full((points, len(names)), 0.5)
    if names:
        rows = rng.permuted(np.tile(np.arange(points - 1)[:, None], (1, len(names))), axis=0)
        cube[1:] = (rows + rng.random(rows.shape)) / (points - 1)
        for i, f in enumerate(posterior.space.free):
            if f.parameter in names:
                starts[1:, i] = [f.quantile(float(share)) for share in cube[1:, names.index(f.parameter)]]
    random = [f.parameter == RANDOM for f in posterior.space.free]
    scores = np.full(points, -np.inf)
    for share in LEVELS_TRIED:
        starts[:, random] = compute_random_level(posterior.observations, posterior.scales, share)
        scores = np.maximum(scores, beginning.log_likelihood(posterior.space.clip(starts)))
    starts[:, random] = posterior.space.start[random]
    return StartingPoints(cube, starts, scores)


def _select_finalists(fits: list[Fit]) -> list[Fit]:
    """Return the best fit, and the next one if it is another mode of about the same log posterior."""
    best = fits[0]
    for other in fits[1:]:
        far = np.abs(other.theta - best.theta) > 10.0 * np.array(list(best.sd.values()))
        if far.any() and other.local.log_posterior > best.local.log_posterior - 20.0:
            return [best, other]
    return [best]


def find_modes(
    posterior: Posterior, rng: np.random.Generator, *, points: int = 96, finalists: int = 8, sensor: SensorSpec = SHARED
) -> list[Fit]:
    """Return the distinct maxima of the posterior on all recordings, best first by log evidence.

    It searches more widely than `search_maximum`, fits each mode of the beginnings within `SLACK` of the best on the
    whole recordings, and keeps those within `mode.within` in log evidence. All are maxima of one posterior, with the
    steps between samples of the stiffest of them. Parameters that the `sensor` has for each recording are split before
    the modes are compared: with a noise level that fits none of the recordings, distances between modes are not
    meaningful.
    """
    beginning = cut_beginnings(posterior)
    tried = _draw_starts(posterior, beginning, rng, points)
    single = replace(beginning, jobs=1)
    peaks = each(
        lambda i: refit_without_position(maximise(single, tried.starts[i])), tried.peaks(finalists), posterior.jobs
    )
    short = select_modes(peaks, SLACK)
    whole: list[Fit] = []
    for fit in short:
        hopeless = max((f.local.log_posterior for f in whole), default=-math.inf) - 2.0 * SLACK
        whole.append(_extend_to_whole(posterior, fit, hopeless))
    hills = select_modes([separate_levels(fit, sensor) for fit in whole], SLACK) or [maximise(posterior)]
    return _unify_modes(hills, max((f.posterior for f in hills), key=lambda p: p.dynamics.nsub))


def _unify_modes(fits: list[Fit], posterior: Posterior) -> list[Fit]:
    """Return the maxima of `posterior` that begin at those of the fits, each mode once, best first."""
    again = [f if f.posterior.dynamics.nsub == posterior.dynamics.nsub else maximise(posterior, f.theta) for f in fits]
    hills = [replace(f, posterior=posterior) for f in select_modes(again, SLACK)] or again
    top = max(f.log_evidence for f in hills)
    return sorted(
        (f for f in hills if f.log_evidence >= top - posterior.settings.mode.within), key=lambda f: -f.log_evidence
    )


def separate_levels(fit: Fit, sensor: SensorSpec) -> Fit:
    """Return the fit with the sensor of a case: noise levels of each recording's own, and its offset.

    It begins at the fit with shared levels. Where nothing is to be split, or all is split already, it is that fit.
    """
    posterior = restart(fit)
    own = sensor.noise == "each" and len(posterior.observations) > 1 and RANDOM in posterior.space.keys
    zeros = () if any(f.level == OFFSET for f in posterior.space.free) else _make_offsets(posterior, sensor.offset)
    if not own and not zeros:
        return fit
    kept = tuple(f for f in posterior.space.free if f.level not in (RANDOM, NOISE))
    levels = tuple(f for f in posterior.space.free if f.level in (RANDOM, NOISE))
    if own:
        levels = make_own_levels(posterior, float(fit.theta[posterior.space.keys.index(RANDOM)]))
    apart = posterior.over((*kept, *zeros, *levels))
    return maximise(apart, apart.space.start)


def _make_offsets(posterior: Posterior, prior: Prior | None) -> tuple[FreeParameter, ...]:
    """Return the offset of each sensor in each recording whose zero is unknown: of all, or of loose ones."""
    motion, first = posterior.system.model.motion, posterior.observations[0]
    names = [observation.name for observation in posterior.observations]
    return tuple(
        _make_free(
            key,
            unit_of(sensor.channel, motion),
            prior or Prior(mean=0.0, sd=first.amplitude_of(sensor.label)),
            (-math.inf, math.inf),
        )
        for i, sensor in enumerate(first.sensors)
        if prior or sensor.loose
        for key in list_keys(first.level(OFFSET, i), names)
    )


def polish_fit(fit: Fit) -> Fit:
    """Return the fit with finer integration steps."""
    posterior = choose_steps(fit.posterior, fit.theta, accuracy=FINE)
    finer = maximise(posterior.stepped(max(posterior.dynamics.nsub, fit.posterior.dynamics.nsub)), fit.theta)
    return finer if finer.status in ("converged", "rough") else fit


def polish_modes(fits: list[Fit]) -> list[Fit]:
    """Return the modes with finer integration steps, all of one posterior, best first by log evidence."""
    return _unify_modes(
        fits, max((choose_steps(f.posterior, f.theta, accuracy=FINE) for f in fits), key=lambda p: p.dynamics.nsub)
    )
