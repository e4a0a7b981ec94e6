"""From a case to a first fit: what is free, what is held out, how large things are, and where to start."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.case import CaseFile, Prior, SensorSpec
from lostmotion.contracts import Array
from lostmotion.errors import CaseError, ContractError
from lostmotion.inference.candidates import CREEP, steps_for_sticking
from lostmotion.inference.fit import Fit, maximise, restarted, warmed
from lostmotion.inference.modes import Tried, distinct
from lostmotion.inference.unseen import with_less_random_force
from lostmotion.kernels.threads import each
from lostmotion.likelihood.drive import substeps
from lostmotion.likelihood.levels import LEVELS_TRIED, noise_frees, own_levels, random_level, usual_of
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import Problem, Scales
from lostmotion.likelihood.space import LEVELS, NOISE, OFFSET, RANDOM, FreeParameter, keys_of
from lostmotion.likelihood.system import Slot, System
from lostmotion.quantities import quantity_of, unit_of
from lostmotion.recording.checks import fill_lost
from lostmotion.settings import DEFAULT, Settings

BLOCKS, ALIVE = 60, 4.0
"""Parts of a recording that are looked at for its motion; noises by which that stands out where there is one."""
SHARED = SensorSpec("shared")
"""A sensor of which nothing is to be split by recording."""
BEGINNING, FEWEST = 3000, 400
"""Starting points are compared on so many samples of one recording; of each of many at least on so few."""

WITHIN = 20.0
"""A mode of which the log evidence is further below the best has no share in the posterior."""
SLACK = 30.0
"""Before the final fits a hill may be this much lower, in log posterior."""

ORDERS = ("position", "velocity", "acceleration")
"""What sensors of motion show, by how often it was differentiated."""
SLOWEST = 4
"""A motion has so many cycles in a recording at least: what is slower in a spectrum leaks there from the window."""
FAR_ABOVE = 20.0
"""So many times the noise floor a line of a spectrum must be to count for the motion: one of 10^6 lines of noise is."""

COARSE, FINE = 0.06, 0.015
"""Final estimates take steps a quarter as long as those of the search: a kink makes RK4 first order."""


def split(
    observations: Sequence[Observation], share: float = DEFAULT.heldout.share
) -> tuple[tuple[Observation, ...], tuple[Observation, ...]]:
    """Return what is fitted and what is held out: the last `share` of one recording, or of several.

    Of a motion that dies away, that share of what stands out of the noise begin what is held out.
    """
    if len(observations) == 1:
        cut = round((1.0 - share) * lasting(observations[0], share))
        return (observations[0].part(0, cut),), (observations[0].part(cut, observations[0].samples),)
    kept = max(1, len(observations) - max(1, round(share * len(observations))))
    return tuple(observations[:kept]), tuple(observations[kept:])


def lasting(observation: Observation, share: float = DEFAULT.heldout.share) -> int:
    """Return how many samples of a recording there are until its motion has died away, or all of them.

    A block of readings lives where its deviation is more than `ALIVE` times the noise, and the motion has died where
    as much of the recording as would be held out does not, or more: nothing could be predicted there.
    """
    sensor = telling(observation)
    blocks = np.array_split(fill_lost(observation.readings[:, sensor]), BLOCKS)
    alive = np.array([float(np.std(block)) for block in blocks]) > ALIVE * observation.noises[sensor]
    last = int(np.flatnonzero(alive)[-1]) + 1 if alive.any() else BLOCKS
    if last > (1.0 - share) * BLOCKS:
        return observation.samples
    return sum(len(block) for block in blocks[:last])


def scales_of(system: System, observations: Sequence[Observation], known: Array) -> Scales:
    """Return the natural sizes of force, length and time of the recorded motion."""
    return replace(_sizes(system, observations, known), span=max(t.samples * t.dt for t in observations))


def _sizes(system: System, observations: Sequence[Observation], known: Array) -> Scales:
    sensor = telling(observations[0])
    rates, lengths = zip(*(_motion(t, sensor) for t in observations), strict=True)
    rate, length = float(np.median(rates)), float(np.median(lengths))
    if quantity_of(observations[0].sensors[sensor].channel) == "force":
        return Scales(length, float(np.median([t.travel for t in observations])), 1.0 / rate)
    inertia = known[system.index[system.model.interfaces[0].inertia]]
    pushes = [_push(system, t, inertia) for t in observations]
    force = float(np.sqrt(np.mean(np.square([varying for varying, _ in pushes]))))
    force = force or float(np.mean([peak for _, peak in pushes])) or inertia * length * rate**2
    return Scales(force, length, 1.0 / rate)


def telling(observation: Observation) -> int:
    """Return the number of the sensor that tells the size of the motion: a position, else the next best there is."""
    order = (*ORDERS, "force")
    kinds = [order.index(quantity_of(sensor.channel)) for sensor in observation.sensors]
    return int(np.argmin(kinds))


def _push(system: System, observation: Observation, inertia: float) -> tuple[float, float]:
    """Return the amplitude (sqrt(2) times the standard deviation) of all forces that drive a machine, and their peak.

    A base that is shaken pushes by its acceleration; one that moves through a joint pushes by an unknown force: zero.
    """
    squares, peak = 0.0, 0.0
    for name, u in zip(system.model.inputs, observation.inputs.T, strict=False):
        weight = inertia if name == "base_acceleration" else float(quantity_of(name) == "force")
        squares += 2.0 * weight**2 * float(np.var(u))
        peak = max(peak, weight * float(np.abs(u).max()))
    return math.sqrt(squares), peak


def _motion(observation: Observation, sensor: int) -> tuple[float, float]:
    """Return the rms angular frequency (rad/s) of the motion a sensor shows, and its amplitude as a position.

    Velocity and acceleration are integrated as spectra, where these stand far above their noise: noise at low
    frequency would be drift, and the spikes of an acceleration are no motion. A force stays a force.
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


def free_of(slot: Slot, prior: Prior) -> FreeParameter:
    """Return the free parameter of a case's prior, where all recordings share it."""
    return _free(slot.key, slot.unit, prior, (slot.param.low, slot.param.high))


def frees_for(slot: Slot, prior: Prior, recordings: Sequence[str]) -> tuple[FreeParameter, ...]:
    """Return the free parameters of a case's prior: one, or with `each` one for each of the named recordings."""
    shared = free_of(slot, prior)
    keys = keys_of(slot.key, recordings) if prior.each else (slot.key,)
    return tuple(replace(shared, key=key) for key in keys)


def _free(key: str, unit: str, prior: Prior, bounds: tuple[float, float]) -> FreeParameter:
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


def known_of(system: System, case: CaseFile) -> Array:
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
    """Refuse values of a parameter that no machine has: outside of its bounds, or an inertia of zero."""
    slot = system.slot(name)
    param = slot.param
    inertia = slot.term is None and slot.key in {place.inertia for place in system.model.interfaces}
    if low < param.low or high > param.high or (inertia and low <= 0.0):
        found = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        wanted = "more than 0" if inertia else f"from {param.low:g} to {param.high:g}"
        raise CaseError(f"{name} ({param.meaning}) is {found}, wanted {wanted}: correct it in the case")


def problem_of(
    system: System,
    case: CaseFile,
    observations: tuple[Observation, ...],
    *,
    jobs: int = 2,
    settings: Settings = DEFAULT,
) -> Problem:
    """Return the problem of a case on the given recordings, with no term active, noise levels shared."""
    known = known_of(system, case)
    scales = scales_of(system, observations, known)
    names = [observation.name for observation in observations]
    frees = [f for name, prior in case.estimate.items() for f in frees_for(system.slot(name), prior, names)]
    problem = Problem(system, observations, scales, known, tuple(frees), jobs=jobs, settings=settings)
    scales = replace(scales, usual=usual_of(problem, rate_of(problem, problem.start)))
    problem = replace(problem, scales=scales, free=(*frees, *noise_frees(observations, scales)))
    return stepped(problem, problem.start)


def rate_of(problem: Problem, theta: Array) -> float:
    """Return the fastest rate (1/s) of the linearised motion over the region that the recording covers."""
    system, scales, observation = problem.system, problem.scales, problem.observations[0]
    grid = np.linspace(-1.5, 1.5, 7)
    states = np.zeros((len(grid) * 3, len(system.model.states)))
    states[:, 0] = np.repeat(grid, 3) * scales.length
    states[:, 1] = np.tile([-1.0, 0.03, 1.0], len(grid)) * scales.velocity
    middle = np.repeat(np.mean(observation.inputs, axis=0)[None], len(states), axis=0)
    alike = all(f.recording is None or f.level in LEVELS for f in problem.free)
    fulls = [problem.full(theta, i) for i in range(1 if alike else len(problem.observations))]
    return max(1.0 / scales.time, *(system.stiffness(full, problem.active, states, middle) for full in fulls))


def stepped(problem: Problem, theta: Array, *, accuracy: float = COARSE) -> Problem:
    """Return the problem with as many steps between samples as the stiffness along the recorded motion asks for."""
    rate = rate_of(problem, theta)
    steps = substeps(rate, max(t.dt for t in problem.observations), accuracy=accuracy)
    return replace(problem, nsub=max(steps, steps_for_sticking(problem, theta, creep=CREEP * accuracy / COARSE)))


def search(problem: Problem, rng: np.random.Generator, *, points: int = 48, finalists: int = 4) -> Fit:
    """Return the best fit of several starts: a Latin hypercube on the beginnings of the recordings, then all of it."""
    beginning = beginnings(problem)
    tried = _tried(problem, beginning, rng, points)
    single = replace(beginning, jobs=1)
    fits = each(
        lambda i: with_less_random_force(maximise(single, tried.starts[i])), tried.best(finalists), problem.jobs
    )
    ranked = sorted(fits, key=lambda f: -f.local.log_posterior)
    chosen = _distinct(ranked)
    return max((_lengthened(problem, f) for f in chosen), key=lambda f: f.local.log_posterior)


def _lengthened(problem: Problem, short: Fit, hopeless: float = -math.inf) -> Fit:
    """Return the fit of whole recordings that begins at one of their beginnings."""
    begun = zip(problem.observations, short.problem.observations, strict=True)
    whole = stepped(problem.on(tuple(replace(t, begun=b.begun) for t, b in begun)), short.theta)
    return with_less_random_force(maximise(whole, warmed(whole, short.theta, 3.0), hopeless=hopeless))


def beginnings(problem: Problem) -> Problem:
    """Return the problem on the beginnings of its recordings, about `BEGINNING` samples of one or twice that of all."""
    several = len(problem.observations) > 1
    samples = max(2 * BEGINNING // len(problem.observations), FEWEST) if several else BEGINNING
    return problem.on(tuple(t.part(0, min(t.samples, samples)) for t in problem.observations))


def _tried(problem: Problem, beginning: Problem, rng: np.random.Generator, points: int) -> Tried:
    """Return a Latin hypercube over the priors, scored with the best of three random forces.

    A parameter that each recording has for itself starts at the same value in all of them.
    """
    names = list(dict.fromkeys(f.parameter for f in problem.free if f.level not in LEVELS))
    starts = np.repeat(problem.start[None], points, axis=0)
    cube = np.full((points, len(names)), 0.5)
    if names:
        rows = rng.permuted(np.tile(np.arange(points - 1)[:, None], (1, len(names))), axis=0)
        cube[1:] = (rows + rng.random(rows.shape)) / (points - 1)
        for i, f in enumerate(problem.free):
            if f.parameter in names:
                starts[1:, i] = [f.quantile(float(share)) for share in cube[1:, names.index(f.parameter)]]
    random = [f.parameter == RANDOM for f in problem.free]
    scores = np.full(points, -np.inf)
    for share in LEVELS_TRIED:
        starts[:, random] = random_level(problem.observations, problem.scales, share)
        scores = np.maximum(scores, beginning.log_likelihoods(problem.clip(starts)))
    starts[:, random] = problem.start[random]
    return Tried(cube, starts, scores)


def _distinct(fits: list[Fit]) -> list[Fit]:
    """Return the best fit, and the next one if it is another mode of about the same height."""
    best = fits[0]
    for other in fits[1:]:
        far = np.abs(other.theta - best.theta) > 10.0 * np.array(list(best.sd.values()))
        if far.any() and other.local.log_posterior > best.local.log_posterior - 20.0:
            return [best, other]
    return [best]


def modes(
    problem: Problem, rng: np.random.Generator, *, points: int = 96, finalists: int = 8, sensor: SensorSpec = SHARED
) -> list[Fit]:
    """Return the distinct maxima of the posterior on all recordings, best first by log evidence.

    It looks more widely than `search`, fits each hill that the beginnings leave within `SLACK` of the best on the whole
    recordings, and keeps those within `WITHIN` in log evidence. All are maxima of one problem, which takes as many
    steps between samples as the stiffest of them asks for. What the `sensor` has of its own in each recording is split
    before the hills are compared: a noise that fits none of the recordings says little of how far hills are apart.
    """
    beginning = beginnings(problem)
    tried = _tried(problem, beginning, rng, points)
    single = replace(beginning, jobs=1)
    peaks = each(
        lambda i: with_less_random_force(maximise(single, tried.starts[i])), tried.peaks(finalists), problem.jobs
    )
    short = distinct(peaks, SLACK)
    whole: list[Fit] = []
    for fit in short:
        hopeless = max((f.local.log_posterior for f in whole), default=-math.inf) - 2.0 * SLACK
        whole.append(_lengthened(problem, fit, hopeless))
    hills = distinct([separated(fit, sensor) for fit in whole], SLACK) or [maximise(problem)]
    return _together(hills, max((f.problem for f in hills), key=lambda p: p.nsub))


def _together(fits: list[Fit], problem: Problem) -> list[Fit]:
    """Return the maxima of `problem` that begin at those of the fits, each hill once, best first."""
    again = [f if f.problem.nsub == problem.nsub else maximise(problem, f.theta) for f in fits]
    hills = [replace(f, problem=problem) for f in distinct(again, SLACK)] or again
    top = max(f.log_evidence for f in hills)
    return sorted((f for f in hills if f.log_evidence >= top - WITHIN), key=lambda f: -f.log_evidence)


def separated(fit: Fit, sensor: SensorSpec) -> Fit:
    """Return the fit with what a case says of the sensor: noise levels of each recording's own, and its zero.

    It begins at the fit with shared levels. Where nothing is to be split, or all is split already, it is that fit.
    """
    problem = restarted(fit)
    own = sensor.noise == "each" and len(problem.observations) > 1 and RANDOM in problem.keys
    zeros = () if any(f.level == OFFSET for f in problem.free) else _offsets(problem, sensor.offset)
    if not own and not zeros:
        return fit
    kept = tuple(f for f in problem.free if f.level not in (RANDOM, NOISE))
    levels = tuple(f for f in problem.free if f.level in (RANDOM, NOISE))
    if own:
        levels = own_levels(problem, float(fit.theta[problem.keys.index(RANDOM)]))
    apart = replace(problem, free=(*kept, *zeros, *levels))
    return maximise(apart, apart.start)


def _offsets(problem: Problem, prior: Prior | None) -> tuple[FreeParameter, ...]:
    """Return the zero of each sensor in each recording; none where it is known."""
    if prior is None:
        return ()
    motion, first = problem.system.model.motion, problem.observations[0]
    names = [observation.name for observation in problem.observations]
    return tuple(
        _free(key, unit_of(sensor.channel, motion), prior, (-math.inf, math.inf))
        for i, sensor in enumerate(first.sensors)
        for key in keys_of(first.level(OFFSET, i), names)
    )


def polish(fit: Fit) -> Fit:
    """Return the fit with finer integration steps."""
    problem = stepped(fit.problem, fit.theta, accuracy=FINE)
    finer = maximise(problem, fit.theta)
    return finer if finer.status in ("converged", "rough") else fit


def polished(fits: list[Fit]) -> list[Fit]:
    """Return the modes with finer integration steps, all of one problem, best first by log evidence."""
    return _together(fits, max((stepped(f.problem, f.theta, accuracy=FINE) for f in fits), key=lambda p: p.nsub))
