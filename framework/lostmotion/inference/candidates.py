"""Terms as candidates: their priors in natural scales, a score test that costs a few filter runs, and their fits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array, Term, Values, place_of
from lostmotion.errors import ContractError
from lostmotion.inference.fit import Fit, Sensitivity, maximise, restarted, sensitivity, solved, warmed
from lostmotion.inference.late import PRICE, at_any_time, can_be_late, cut, refined, times_of
from lostmotion.inference.natural import frees_of, size_of, sorted_slots, star, term_of, tried_of
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.plan import handed
from lostmotion.likelihood.problem import LATEST, NOISE, RANDOM, FreeParameter, Problem
from lostmotion.likelihood.system import ALWAYS, Slot, since_of
from lostmotion.quantities import FORCE, TIME

CREEP, FINEST = 0.02, 32
SHORT, CLEAR = 1500, 8.0
"""Values far off are tried on so many samples, and count when the log-likelihood gains so much there."""
SHARES = (1.0, 0.3, 0.01)
"""Fits begin with these shares of what a score test promises."""
CALM, LARGE = 0.05, 0.7
"""Noise of a calm start in amplitudes of the response, and a large force in amplitudes of the measured one."""
ONSET = PRICE + 3.0
"""A term is taken for late when that promises so much more gain."""
LOOKS = 200
"""Places of a recording at which a force is looked at, when a filter with it does not get through."""
SPREAD = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0)
"""Where the shape of a law begins that takes the place of a simpler relative, in units of its typical value."""
RAISED = 2.0
"""By how much the log random force is raised where a fit begins far from its maximum."""
ROUGHLY = 0.1
"""A fit that is to be compared with others has converged when a step promises less log posterior than this."""
MUTE = 1e-6
"""An amplitude of typical size that carries less information than this says nothing while the others are zero."""
FARTHEST = 4
"""So many of the values far off are refitted: those at which the likelihood is highest to begin with."""


Shapes = Mapping[str, Sequence[Mapping[str, float]]]
"""For a term by key, the values of its shape parameters that are tried beyond the usual."""


@dataclass(frozen=True)
class Hint:
    """What a score test says of a term: the gain in log-likelihood it promises, and where to start its fit."""

    key: str
    gain: float
    start: Mapping[str, float]
    distinct: float

    @property
    def late(self) -> bool:
        """Whether the term acts from an onset on, and not from the beginning."""
        return since_of(self.key) in self.start


def slopes_of(fit: Fit) -> Sensitivity:
    """Return the sensitivities of a fit, which all its score tests share."""
    return sensitivity(fit.problem, fit.theta, fit.local.steps)


def screen(fit: Fit, slopes: Sensitivity, key: str, more: Sequence[Mapping[str, float]] = ()) -> Hint:
    """Return what adding the term `key` to a fit promises, the base parameters moving along (Rao's score test).

    `more` are shapes to be tried beyond the usual.
    """
    return max(screened(fit, slopes, key, more), key=lambda h: h.gain)


def screened(fit: Fit, slopes: Sensitivity, key: str, more: Sequence[Mapping[str, float]] = ()) -> list[Hint]:
    """Return what a term promises that acts from the beginning, and what one with an onset does if that is more."""
    problem = fit.problem
    amplitudes, shapes = sorted_slots(problem, key)
    grids = [tried_of(s.param, problem.scales) for s in shapes]
    usual = [dict(zip((s.key for s in shapes), values, strict=True)) for values in star(grids)]
    hints = _scored(fit, slopes, key, (*usual, *more))
    bounded = term_of(problem, key)[0].acts == "sensor" and len(problem.observations[0].sensors) > 1
    late = bounded and amplitudes[0].param.dimension == TIME
    if len(amplitudes) == 1 and amplitudes[0].param.far and not problem.active and not late:
        hints.append(_afar(fit, amplitudes[0], key, hints[0].distinct))
    if len(amplitudes) == 1 and amplitudes[0].param.scan:
        hints += _stretched(fit, slopes, key, amplitudes[0])
    ever = [h for h in hints if not h.late]
    return [max(kind, key=lambda h: h.gain) for kind in (ever, [h for h in hints if h.late]) if kind]


def _late(fit: Fit, key: str, amplitudes: Sequence[Slot], always: Hint, joint: Sensitivity) -> Hint:
    """Return what a term promises that acts from some time on, if that is decisively more than what it `always` did."""
    best = always
    shape = {name: value for name, value in always.start.items() if name not in {a.key for a in amplitudes}}
    for time, gradient, information in cut(fit.problem, joint, len(amplitudes)):
        hint = _hint_from(fit, key, amplitudes, shape, gradient, information)
        if hint.gain > best.gain + (ONSET if best is always else 0.0):
            best = replace(hint, start={**hint.start, since_of(key): time})
    return best


def _refine_onset(fit: Fit, hint: Hint) -> Hint:
    """Return the hint of a sensor term with its onset at the best sample between the neighbouring tried onsets.

    A gain or an offset that sets in makes the reading jump: a fit that begins at a wrong sample does not find the time.
    """
    wider, times = joined(restarted(fit), hint.key, hint.start), times_of(fit.problem)
    dt, near = fit.problem.observations[0].dt, hint.start[since_of(hint.key)]
    grid = np.arange(near - (times[1] - times[0]), near + (times[1] - times[0]), dt)
    held = wider.extended((at_any_time(fit.problem, hint.key, near),), ())
    best = int(np.argmax(held.log_likelihoods(np.array([np.append(wider.start, t) for t in grid]))))
    return replace(hint, start={**hint.start, since_of(hint.key): float(grid[best])})


def _afar(fit: Fit, slot: Slot, key: str, distinct: float) -> Hint:
    """Return the best of the values of an amplitude that are tried beyond the reach of a score test.

    For each the other parameters are refitted roughly, on the beginning of the recording. It is done for the nominal
    model alone: what is so far off is missed by it at once.
    """
    short = fit.problem.on(tuple(t.part(0, min(t.samples, SHORT)) for t in fit.problem.observations))
    size = size_of(slot.param, fit.problem.scales)
    best, gain, bottom = 0.0, 0.0, maximise(restarted(replace(fit, problem=short)), fit.theta, rounds=2)
    wider = short.extended((_held(slot),), {key})
    theta = warmed(short, bottom.theta, RAISED)
    log_densities = wider.log_likelihoods(np.array([np.append(theta, factor * size) for factor in slot.param.far]))
    for i in np.argsort(-log_densities)[:FARTHEST]:
        value = slot.param.far[i] * size
        trial = short.knowing({slot.key: value})
        found = maximise(replace(trial, active=trial.active | {key}), bottom.theta, rounds=3, tolerance=1.0)
        if found.log_likelihood - bottom.log_likelihood > gain:
            best, gain = value, found.log_likelihood - bottom.log_likelihood
    return Hint(key, gain if gain > CLEAR else 0.0, {slot.key: best}, distinct)


def _stretched(fit: Fit, slopes: Sensitivity, key: str, slot: Slot) -> list[Hint]:
    """Return what a term promises whose response is far from linear in its amplitude, at amplitudes of a scan.

    In place of the slope at zero stands that of the secant to each amplitude, and no more of it is believed than half
    or one and a half times this amplitude.
    """
    problem = fit.problem
    reached = tried_of(slot.param, problem.scales)
    wider = problem.extended((_held(slot),), {key})
    here, seen = slopes.here, wider.many(np.vstack([np.append(slopes.theta, a) for a in reached]))
    hints = []
    for i, amplitude in enumerate(reached):
        if not seen.finite[i]:
            continue
        de = (seen.errors[i] - here.errors) / amplitude
        dv = (seen.variances[i] - here.variances) / amplitude
        joint = Sensitivity(
            np.append(slopes.theta, 0.0),
            here,
            np.vstack([slopes.errors, de]),
            np.vstack([slopes.variances, dv]),
            np.append(slopes.steps, amplitude),
        )
        hint = _hint(fit, key, [slot], {}, joint)
        start = hint.start.get(slot.key, 0.0)
        if not start > 0.0:
            continue
        kept = min(max(start, 0.5 * amplitude), 1.5 * amplitude)
        slack = 1.0 - (kept / start - 1.0) ** 2
        hints.append(replace(hint, gain=hint.gain * slack, start={slot.key: kept}))
    return hints


def with_term(problem: Problem, hint: Hint, start: Mapping[str, float]) -> Problem:
    """Return a problem with one more term, its choices held at what the score test chose."""
    wider = joined(problem, hint.key, {**hint.start, **start})
    return replace(wider, nsub=max(wider.nsub, steps_for_sticking(wider, wider.start)))


def joined(problem: Problem, key: str, start: Mapping[str, float]) -> Problem:
    """Return a problem with one more term, begun at `start`, its choices held at what is said there."""
    _, slots = term_of(problem, key)
    choices = {s.key: start[s.key] for s in slots if s.param.choices and s.key in start}
    if since_of(key) in problem.system.index:
        choices[since_of(key)] = start.get(since_of(key), ALWAYS)
    return problem.knowing(choices).extended(frees_in(problem, key, slots, start), {key})


def frees_in(problem: Problem, key: str, slots: list[Slot], start: Mapping[str, float]) -> tuple[FreeParameter, ...]:
    """Return the free parameters of a term of a problem; one of several sensors is late by no more than is allowed."""
    frees, (term, _) = frees_of(slots, problem.scales, start), term_of(problem, key)
    if term.acts != "sensor" or len(problem.observations[0].sensors) == 1:
        return frees
    most = LATEST * problem.scales.time
    late = {s.key for s in slots if s.param.dimension == TIME}
    return tuple(replace(f, high=min(f.high, most), start=min(f.start, most)) if f.key in late else f for f in frees)


def steps_for_sticking(problem: Problem, theta: Array, *, creep: float = CREEP) -> int:
    """Return how many steps between samples a law needs that jumps at rest, so that it hardly creeps where it sticks.

    It creeps by at most `force * mobility`, which is to be the share `creep` of the velocity of the motion.
    """
    system, most, full = problem.system, 1.0, problem.full(theta)
    for key in problem.active:
        term, slots = term_of(problem, key)
        if "mobility" in term.needs:
            inertia = system.inertia(full, place_of(system.model, term))
            force = sum(abs(full[system.index[s.key]]) for s in slots if s.param.dimension == FORCE)
            width = force * max(t.dt for t in problem.observations) / inertia
            most = max(most, width / (creep * problem.scales.velocity))
    return min(math.ceil(most), FINEST)


def _scored(fit: Fit, slopes: Sensitivity, key: str, shapes: Sequence[Mapping[str, float]]) -> list[Hint]:
    """Return what a term promises at several shapes, all of them computed together."""
    amplitudes, fixed = sorted_slots(fit.problem, key)
    frees = (*frees_in(fit.problem, key, amplitudes, {}), *(_held(slot) for slot in fixed))
    wider = fit.problem.extended(frees, {key})
    sizes = np.array([size_of(s.param, fit.problem.scales) for s in amplitudes])
    zeros = [np.concatenate([slopes.theta, np.zeros(len(sizes)), [shape[s.key] for s in fixed]]) for shape in shapes]
    widths = [1e-3 * sizes for _ in shapes]
    joints: list[Sensitivity] = []
    for _ in range(2):
        joints = _joint(slopes, wider, zeros, widths)
        told = [np.maximum(np.diag(joint.information())[-len(sizes) :], 1e-300) for joint in joints]
        widths = [np.clip(0.5 / np.sqrt(curvature), 1e-9 * sizes, sizes) for curvature in told]
    hints = [_hint(fit, key, amplitudes, shape, joint) for shape, joint in zip(shapes, joints, strict=True)]
    if can_be_late(fit.problem, key):
        best = max(range(len(hints)), key=lambda i: hints[i].gain)
        late = _late(fit, key, amplitudes, hints[best], joints[best])
        if late.late:
            hints.append(_refine_onset(fit, late) if key in fit.problem.system.rescaling else late)
    return hints


def _held(slot: Slot) -> FreeParameter:
    """Return a shape parameter as a coordinate that stays where it is put."""
    return FreeParameter(slot.key, slot.unit, 0.0, -math.inf, math.inf)


def _joint(slopes: Sensitivity, wider: Problem, zeros: Sequence[Array], widths: Sequence[Array]) -> list[Sensitivity]:
    """Return the sensitivities of base parameters and amplitudes together, at amplitude zero, for each point."""
    base, count = len(slopes.theta), len(widths[0])
    rows = []
    for zero, width in zip(zeros, widths, strict=True):
        above = np.zeros((count, len(zero)))
        above[:, base : base + count] = np.diag(width)
        rows += [zero[None], zero + above]
    seen, found = wider.many(np.vstack(rows)), []
    for k, (zero, width) in enumerate(zip(zeros, widths, strict=True)):
        part = seen[k * (1 + count) : (k + 1) * (1 + count)]
        de = (part.errors[1:] - part.errors[0]) / width[:, None]
        dv = (part.variances[1:] - part.variances[0]) / width[:, None]
        errors, variances = np.vstack([slopes.errors, de]), np.vstack([slopes.variances, dv])
        found.append(
            Sensitivity(zero[: base + count], part[0], errors, variances, np.concatenate([slopes.steps, width]))
        )
    return found


def _hint(fit: Fit, key: str, amplitudes: Sequence[Slot], shape: Mapping[str, float], joint: Sensitivity) -> Hint:
    """Return what a score test says of a term at one shape."""
    return _hint_from(fit, key, amplitudes, shape, joint.gradient(), joint.information())


def _hint_from(
    fit: Fit, key: str, amplitudes: Sequence[Slot], shape: Mapping[str, float], gradient: Array, information: Array
) -> Hint:
    """Return what gradient and information of base parameters and amplitudes together say of a term."""
    if not (np.all(np.isfinite(gradient)) and np.all(np.isfinite(information))):
        _require_finite(fit.problem, key)
        return Hint(key, 0.0, dict(shape), 0.0)
    k = len(amplitudes)
    base, cross, own = information[:-k, :-k], information[:-k, -k:], information[-k:, -k:]
    base = base + np.diag([f.pull for f in fit.problem.free])
    pulled = solved(base, np.column_stack([cross, gradient[:-k]]))
    schur = own - cross.T @ pulled[:, :k]
    force = gradient[-k:] - cross.T @ pulled[:, k]
    sizes = np.array([size_of(a.param, fit.problem.scales) for a in amplitudes])
    kept = [i for i in range(k) if own[i, i] * sizes[i] ** 2 > MUTE]
    distinct = min((float(schur[i, i] / own[i, i]) for i in kept), default=0.0)
    while kept:
        estimate = solved(schur[np.ix_(kept, kept)], force[kept])
        wrong = [i for i, a in zip(kept, estimate, strict=True) if a < amplitudes[i].param.low]
        if not wrong:
            break
        kept = [i for i in kept if i not in wrong]
    if not kept or not np.all(np.isfinite(force)):
        return Hint(key, 0.0, dict(shape), distinct)
    start = {amplitudes[i].key: float(a) for i, a in zip(kept, estimate, strict=True)}
    return Hint(key, 0.5 * float(force[kept] @ estimate), {**shape, **start}, distinct)


def _require_finite(problem: Problem, key: str) -> None:
    """Raise a `ContractError` if force or rates of a term, all its numbers one, are not finite along a recording."""
    term, _ = term_of(problem, key)
    if term.acts == "motion" and not all(_finite(term, observation) for observation in problem.observations):
        raise ContractError(
            f"the force of {key} is not a finite number along the recorded motion: mend the term, or leave it out", key
        )


def _finite(term: Term, observation: Observation) -> bool:
    change = np.zeros(len(term.states))
    for told in called_with(term, observation, LOOKS):
        if math.isfinite(told[1]) and math.isfinite(told[2]):
            term.rate(*told, change)
            if not (math.isfinite(term.force(*told)) and np.all(np.isfinite(change))):
                return False
    return True


def called_with(
    term: Term, observation: Observation, looks: int
) -> Iterator[tuple[float, float, float, Array, Values, Values]]:
    """Yield what the force of a term is told at about `looks` points of a recording, all its numbers one at rest."""
    p = handed(term, np.ones(len(term.params) + len(term.needs)))
    s, u = (0.0,) * len(term.states), np.zeros(max(2, observation.inputs.shape[1]))
    speed = np.gradient(observation.response, observation.dt)
    for k in range(0, observation.samples, max(1, observation.samples // looks)):
        yield k * observation.dt, float(observation.response[k]), float(speed[k]), u, p, s


def fit_with(fit: Fit, hint: Hint, *, hopeless: float = -math.inf) -> Fit:
    """Return the fit with one more term, started where its score test points, or with less of it: the best one.

    With nothing of the term the likelihood is that of the fit; one that ends lower has lost its way.
    """
    _, slots = term_of(fit.problem, hint.key)
    problems = [with_term(restarted(fit), hint, _scaled(hint, slots, factor)) for factor in SHARES]
    log_densities = [p.log_posterior(p.clip(p.start)) for p in problems[:2]]
    order = (*np.argsort(log_densities)[::-1], *range(2, len(SHARES)))
    fits: list[Fit] = []
    for i in order:
        fits.append(maximise(problems[i], hopeless=hopeless, tolerance=ROUGHLY))
        if fits[-1].status in ("converged", "abandoned") and fits[-1].log_likelihood > fit.log_likelihood - 1.0:
            break
    return refined(max(fits, key=lambda f: f.local.log_posterior), hint.key)


def calmed(fit: Fit) -> Fit:
    """Return the fit begun anew with what is missing taken for noise of the sensor, and not for a random force."""
    problem, theta = fit.problem, fit.theta.copy()
    for i, free in enumerate(problem.free):
        if free.level == NOISE:
            theta[i] = math.log(CALM * problem.observations[0].amplitude_of(free.sensor))
        elif free.parameter == RANDOM:
            theta[i] = problem.scales.usual
    return maximise(problem, theta)


def large(problem: Problem, key: str) -> Hint | None:
    """Return a hint that a term is most of the measured force; None for one that is no force of one amplitude."""
    amplitudes, shapes = sorted_slots(problem, key)
    if len(amplitudes) != 1 or amplitudes[0].param.dimension != FORCE or amplitudes[0].param.low < 0.0:
        return None
    usual = {s.key: size_of(s.param, problem.scales) for s in shapes}
    return Hint(key, 0.0, {amplitudes[0].key: LARGE * problem.scales.force, **usual}, 1.0)


def fit_in_place(fit: Fit, key: str, hint: Hint, *, hopeless: float = -math.inf) -> Fit:
    """Return the fit with the term of `hint` in place of its relative `key`, starting from what both of them have."""
    values = fit.values
    _, slots = term_of(fit.problem, hint.key)
    shared = {s.key: values.get(f"{key}.{s.param.name}") for s in slots}
    start = {**hint.start, **{name: value for name, value in shared.items() if value is not None}}
    problem = with_term(restarted(fit).reduced(key, values), hint, start)
    own = [s for s in slots if shared[s.key] is None]
    begins = np.array([problem.start, *_reshaped(problem, own), *_lessened(problem, own)])
    begins = problem.clip(np.vstack([begins, [warmed(problem, theta, RAISED) for theta in begins]]))
    log_densities = problem.log_posteriors(begins)
    return maximise(problem, begins[int(np.argmax(log_densities))], hopeless=hopeless, tolerance=ROUGHLY)


def _reshaped(problem: Problem, slots: Sequence[Slot]) -> Iterator[Array]:
    """Yield the start of a problem with one of the shapes among `slots` put elsewhere: a thousandfold range of each.

    A shape with a scan stays: it was looked for already.
    """
    for slot in slots:
        if slot.param.null is None and slot.param.scale == "log" and not (slot.param.choices or slot.param.scan):
            at = problem.keys.index(slot.key)
            for factor in SPREAD:
                theta = problem.start.copy()
                theta[at] = math.log(factor * size_of(slot.param, problem.scales))
                yield theta


def _lessened(problem: Problem, slots: Sequence[Slot]) -> Iterator[Array]:
    """Yield the start of a problem with less of the amplitudes among `slots`: score tests promise too much of some."""
    at = [problem.keys.index(s.key) for s in slots if s.param.null is not None and s.key in problem.keys]
    for share in SHARES[1:] if at else ():
        theta = problem.start.copy()
        theta[at] *= share
        yield theta


def _scaled(hint: Hint, slots: list[Slot], factor: float) -> dict[str, float]:
    """Return the starting values of a hint with its amplitudes scaled."""
    shapes = {s.key for s in slots if s.param.null is None} | {since_of(hint.key)}
    return {name: value if name in shapes else factor * value for name, value in hint.start.items()}
