"""Candidate terms: a score test that costs a few filter runs, and fits with a term added or replaced."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array, place_of
from lostmotion.inference.calls import require_finite
from lostmotion.inference.far_values import hold_shape, try_far_values
from lostmotion.inference.fit import (
    ROUGHLY,
    Fit,
    Sensitivity,
    begin_at,
    compute_sensitivity,
    maximise,
    raise_random_force,
    restart,
)
from lostmotion.inference.late import (
    refine_change,
    refine_onset,
)
from lostmotion.inference.natural import (
    compute_size,
    find_term,
    is_choice,
    is_scanned,
    list_star_points,
    list_tried_values,
    make_free_parameters,
    sort_slots,
)
from lostmotion.inference.rounding import drop_rounding, find_shortest_wave
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.likelihood.posed import LATEST
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import ALWAYS, Slot, onset_key
from lostmotion.quantities import FORCE, TIME

CREEP, FINEST = 0.02, 32
SHARES = (1.0, 0.3, 0.01)
"""Fits begin with these shares of the amplitude that a score test predicts."""
MOST_BEGUN, KEPT = 3, 0.5
"""A law that replaces a simpler one is fitted from so many points at most, until it gains this share of its promise."""
SPREAD = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0)
"""Starting values of the shape of a law that replaces a simpler related law, in units of its typical value."""
RAISED = 2.0
"""The increase of the log random force where a fit begins far from its maximum."""
REFINED = 12
"""The number of shapes of a term at which a score test is computed again with larger differences."""
MUTE = 1e-6
"""An amplitude of typical size with less information than this has no effect while the others are zero."""


@dataclass(frozen=True)
class ScoreTest:
    """The result of a score test of a term: the predicted gain in log-likelihood, and the starting point of its fit.

    `base` are coordinates of the other parameters (n,) from which the fit begins; None for those without the term.
    """

    key: str
    gain: float
    start: Mapping[str, float]
    distinct: float
    base: Array | None = None


def compute_slopes(fit: Fit) -> Sensitivity:
    """Return the sensitivities of a fit, which all its score tests share."""
    return compute_sensitivity(fit.posterior, fit.theta, fit.local.steps)


def run_score_test(fit: Fit, slopes: Sensitivity, key: str, more: Sequence[Mapping[str, float]] = ()) -> ScoreTest:
    """Return the predicted gain of adding the term `key` to a fit, with the base parameters free (Rao's score test).

    `more` are shapes that are tried in addition to the usual ones.
    """
    return max(run_score_tests(fit, slopes, key, more), key=lambda h: h.gain)


def predict_gain(fit: Fit, slopes: Sensitivity, key: str, shape: Mapping[str, float]) -> float:
    """Return the predicted gain of adding the term `key` with one shape to a fit."""
    return max(hint.gain for hint in _test_shapes(fit, slopes, key, [shape]))


def run_score_tests(
    fit: Fit, slopes: Sensitivity, key: str, more: Sequence[Mapping[str, float]] = ()
) -> list[ScoreTest]:
    """Return score tests of a term: at each of its best shapes, and at far values of its amplitude."""
    posterior = fit.posterior
    amplitudes, shapes = sort_slots(posterior, key)
    grids = [list_tried_values(s.param, posterior.scales) for s in shapes]
    usual = [dict(zip((s.key for s in shapes), values, strict=True)) for values in list_star_points(grids)]
    tried = drop_rounding(posterior, key, (*usual, *more)) if shapes else usual
    if not tried:
        return [ScoreTest(key, 0.0, usual[0], 0.0)]
    hints = _test_shapes(fit, slopes, key, tried)
    bounded = find_term(posterior, key)[0].acts == "sensor" and len(posterior.observations[0].sensors) > 1
    late = bounded and amplitudes[0].param.dimension == TIME
    if len(amplitudes) == 1 and not posterior.active and not late and (far := try_far_values(fit, amplitudes[0], key)):
        hints.append(ScoreTest(key, far.gain, {amplitudes[0].key: far.value}, hints[0].distinct, far.base))
    if is_scanned(amplitudes):
        hints += _test_secants(fit, slopes, key, amplitudes[0])
    return hints


def _test_secants(fit: Fit, slopes: Sensitivity, key: str, slot: Slot) -> list[ScoreTest]:
    """Return score tests of a term whose response is strongly nonlinear in its amplitude, at amplitudes of a scan.

    The slope at zero is replaced by the secant to each amplitude, and the estimate is limited to half to one and a half
    times this amplitude.
    """
    posterior = fit.posterior
    reached = list_tried_values(slot.param, posterior.scales)
    wider = posterior.extend((hold_shape(slot),), {key})
    here, seen = slopes.here, wider.innovations(np.vstack([np.append(slopes.theta, a) for a in reached]))
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
        hint = _solve_score_test(fit, key, [slot], {}, joint)
        start = hint.start.get(slot.key, 0.0)
        if not start > 0.0:
            continue
        kept = min(max(start, 0.5 * amplitude), 1.5 * amplitude)
        slack = 1.0 - (kept / start - 1.0) ** 2
        hints.append(replace(hint, gain=hint.gain * slack, start={slot.key: kept}))
    return hints


def add_term(posterior: Posterior, hint: ScoreTest, start: Mapping[str, float]) -> Posterior:
    """Return a posterior with one more term, its choices held at those of the score test."""
    wider = join_term(posterior, hint.key, {**hint.start, **start})
    return wider.stepped(max(wider.dynamics.nsub, count_steps_for_sticking(wider, wider.space.start)))


def join_term(posterior: Posterior, key: str, start: Mapping[str, float]) -> Posterior:
    """Return a posterior with one more term that begins at `start`, its choices held at the values there."""
    _, slots = find_term(posterior, key)
    choices = {s.key: start[s.key] for s in slots if s.key in start and is_choice(s, start)}
    if onset_key(key) in posterior.system.index:
        choices[onset_key(key)] = start.get(onset_key(key), ALWAYS)
    return posterior.hold_values(choices).extend(make_term_parameters(posterior, key, slots, start), {key})


def make_term_parameters(
    posterior: Posterior, key: str, slots: list[Slot], start: Mapping[str, float]
) -> tuple[FreeParameter, ...]:
    """Return the free parameters of a term of a posterior; the delay of one of several sensors is bounded.

    A wave of a sensor is longer than its rounding.
    """
    frees, (term, _) = make_free_parameters(slots, posterior.scales, start), find_term(posterior, key)
    if any(f.log for f in frees) and (least := find_shortest_wave(posterior, key)) > 0.0:
        low = math.log(least)
        frees = tuple(replace(f, low=max(f.low, low), start=max(f.start, low)) if f.log else f for f in frees)
    if term.acts != "sensor" or len(posterior.observations[0].sensors) == 1:
        return frees
    most = LATEST * posterior.scales.time
    late = {s.key for s in slots if s.param.dimension == TIME}
    return tuple(replace(f, high=min(f.high, most), start=min(f.start, most)) if f.key in late else f for f in frees)


def count_steps_for_sticking(posterior: Posterior, theta: Array, *, creep: float = CREEP) -> int:
    """Return the steps between samples at which a law that jumps at rest hardly creeps during sticking.

    Its creep is at most `force * mobility`, which is limited to the share `creep` of the velocity of the motion.
    """
    system, most, full = posterior.system, 1.0, posterior.recordings[0].full(theta)
    for key in posterior.active:
        term, slots = find_term(posterior, key)
        if "mobility" in term.needs:
            inertia = system.inertia(full, place_of(system.model, term))
            force = sum(abs(full[system.index[s.key]]) for s in slots if s.param.dimension == FORCE)
            width = force * max(t.dt for t in posterior.observations) / inertia
            most = max(most, width / (creep * posterior.scales.velocity))
    return min(math.ceil(most), FINEST)


def _test_shapes(fit: Fit, slopes: Sensitivity, key: str, shapes: Sequence[Mapping[str, float]]) -> list[ScoreTest]:
    """Return the score tests of a term at its `REFINED` best shapes, all of them computed together.

    Differences of all shapes are taken over a small amplitude, those of the best over half a standard deviation: small
    differences may miss the whole gain of a dry friction.
    """
    amplitudes, fixed = sort_slots(fit.posterior, key)
    frees = (*make_term_parameters(fit.posterior, key, amplitudes, {}), *(hold_shape(slot) for slot in fixed))
    wider = fit.posterior.extend(frees, {key})
    sizes = np.array([compute_size(s.param, fit.posterior.scales) for s in amplitudes])
    zeros = [np.concatenate([slopes.theta, np.zeros(len(sizes)), [shape[s.key] for s in fixed]]) for shape in shapes]
    joints = _join_sensitivities(slopes, wider, zeros, [0.01 * sizes for _ in shapes], shared=True)
    hints = [_solve_score_test(fit, key, amplitudes, shape, joint) for shape, joint in zip(shapes, joints, strict=True)]
    near = sorted(range(len(hints)), key=lambda i: -hints[i].gain)[:REFINED]
    told = [np.maximum(np.diag(joints[i].information())[-len(sizes) :], 1e-300) for i in near]
    widths = [np.clip(0.5 / np.sqrt(curvature), 1e-9 * sizes, sizes) for curvature in told]
    shared = not find_term(fit.posterior, key)[0].states
    joints = _join_sensitivities(slopes, wider, [zeros[i] for i in near], widths, shared=shared)
    pairs = zip(near, joints, strict=True)
    return [_solve_score_test(fit, key, amplitudes, shapes[i], joint) for i, joint in pairs]


def _join_sensitivities(
    slopes: Sensitivity, wider: Posterior, zeros: Sequence[Array], widths: Sequence[Array], *, shared: bool
) -> list[Sensitivity]:
    """Return the sensitivities of base parameters and amplitudes together, at amplitude zero, for each point.

    The points differ in shapes only. These have no effect at amplitude zero, so one run may serve all points there
    (`shared`); states of the term change the steps of the filter, and with them its errors, by less than 0.01 %.
    """
    base, count = len(slopes.theta), len(widths[0])
    ups = np.stack([np.tile(zero, (count, 1)) for zero in zeros])
    ups[:, :, base : base + count] += np.stack([np.diag(width) for width in widths])
    below = np.array(zeros[:1] if shared else zeros)
    seen, found = wider.innovations(np.vstack([below, ups.reshape(-1, ups.shape[2])])), []
    for k, (zero, width) in enumerate(zip(zeros, widths, strict=True)):
        here = seen[0 if shared else k]
        part = seen[len(below) + k * count : len(below) + (k + 1) * count]
        de = (part.errors - here.errors) / width[:, None]
        dv = (part.variances - here.variances) / width[:, None]
        errors, variances = np.vstack([slopes.errors, de]), np.vstack([slopes.variances, dv])
        steps = np.concatenate([slopes.steps, width])
        found.append(Sensitivity(zero[: base + count], here, errors, variances, steps))
    return found


def _solve_score_test(
    fit: Fit, key: str, amplitudes: Sequence[Slot], shape: Mapping[str, float], joint: Sensitivity
) -> ScoreTest:
    """Return the score test of a term at one shape."""
    return _solve_from_gradient(fit, key, amplitudes, shape, joint.gradient(), joint.information())


def _solve_from_gradient(
    fit: Fit, key: str, amplitudes: Sequence[Slot], shape: Mapping[str, float], gradient: Array, information: Array
) -> ScoreTest:
    """Return the score test of a term from gradient and information of base parameters and amplitudes together."""
    if not (np.all(np.isfinite(gradient)) and np.all(np.isfinite(information))):
        require_finite(fit.posterior, key)
        return ScoreTest(key, 0.0, dict(shape), 0.0)
    k = len(amplitudes)
    base, cross, own = information[:-k, :-k], information[:-k, -k:], information[-k:, -k:]
    base = base + np.diag(list(map(FreeParameter.prior_information, fit.posterior.space.free, fit.theta)))
    pulled = solve_scaled(base, np.column_stack([cross, gradient[:-k]]))
    schur = own - cross.T @ pulled[:, :k]
    force = gradient[-k:] - cross.T @ pulled[:, k]
    sizes = np.array([compute_size(a.param, fit.posterior.scales) for a in amplitudes])
    kept = [i for i in range(k) if own[i, i] * sizes[i] ** 2 > MUTE]
    distinct = min((float(schur[i, i] / own[i, i]) for i in kept), default=0.0)
    while kept:
        estimate = solve_scaled(schur[np.ix_(kept, kept)], force[kept])
        wrong = [i for i, a in zip(kept, estimate, strict=True) if a < amplitudes[i].param.low]
        if not wrong:
            break
        kept = [i for i in kept if i not in wrong]
    if not kept or not np.all(np.isfinite(force)):
        return ScoreTest(key, 0.0, dict(shape), distinct)
    start = {amplitudes[i].key: float(a) for i, a in zip(kept, estimate, strict=True)}
    return ScoreTest(key, 0.5 * float(force[kept] @ estimate), {**shape, **start}, distinct)


def fit_term(fit: Fit, hint: ScoreTest) -> Fit:
    """Return the best fit with one more term, started at the estimate of its score test or at shares of it.

    Without the term the likelihood is that of the given fit; a fit that ends lower has failed.
    """
    _, slots = find_term(fit.posterior, hint.key)
    begun = restart(fit) if hint.base is None else begin_at(fit.posterior, hint.base)
    posteriors = [add_term(begun, hint, _scale_start(hint, slots, factor)) for factor in SHARES]
    log_densities = [p.log_density(p.space.clip(p.space.start)) for p in posteriors[:2]]
    order = (*np.argsort(log_densities)[::-1], *range(2, len(SHARES)))
    fits: list[Fit] = []
    for i in order:
        fits.append(maximise(posteriors[i], tolerance=ROUGHLY))
        if fits[-1].status == "converged" and fits[-1].log_likelihood > fit.log_likelihood - 1.0:
            break
    best = max(fits, key=lambda f: f.local.log_posterior)
    return refine_change(refine_onset(best, hint.key), hint.key)


def replace_term(fit: Fit, key: str, hint: ScoreTest) -> Fit:
    """Return the fit with the term of `hint` in place of the related term `key`, started from shared parameters."""
    values = fit.values
    _, slots = find_term(fit.posterior, hint.key)
    shared = {s.key: values.get(f"{key}.{s.param.name}") for s in slots}
    start = {**hint.start, **{name: value for name, value in shared.items() if value is not None}}
    posterior = add_term(restart(fit).remove_term(key, values), hint, start)
    own = [s for s in slots if shared[s.key] is None]
    begins = np.array(
        [posterior.space.start, *_list_shape_starts(posterior, own), *_list_smaller_starts(posterior, own)]
    )
    begins = posterior.space.clip(
        np.vstack([begins, [raise_random_force(posterior, theta, RAISED) for theta in begins]])
    )
    fits: list[Fit] = []
    for i in np.argsort(-posterior.log_density(begins))[:MOST_BEGUN].tolist():
        fits.append(maximise(posterior, begins[i], tolerance=ROUGHLY))
        if fits[-1].log_likelihood > fit.log_likelihood + max(KEPT * hint.gain, 1.0):
            break
    return max(fits, key=lambda one: one.local.log_posterior)


def _list_shape_starts(posterior: Posterior, slots: Sequence[Slot]) -> Iterator[Array]:
    """Yield the start of a posterior with one of the shapes among `slots` changed over a thousandfold range.

    A shape with a scan is not changed: the scan has covered its range already.
    """
    for slot in slots:
        if (
            slot.param.null is None
            and slot.param.scale == "log"
            and not (slot.param.prior.choices or slot.param.prior.scan)
        ):
            at = posterior.space.keys.index(slot.key)
            for factor in SPREAD:
                theta = posterior.space.start.copy()
                theta[at] = math.log(factor * compute_size(slot.param, posterior.scales))
                yield theta


def _list_smaller_starts(posterior: Posterior, slots: Sequence[Slot]) -> Iterator[Array]:
    """Yield the start of a posterior with smaller amplitudes among `slots`: score tests overestimate some of them."""
    at = [
        posterior.space.keys.index(s.key) for s in slots if s.param.null is not None and s.key in posterior.space.keys
    ]
    for share in SHARES[1:] if at else ():
        theta = posterior.space.start.copy()
        theta[at] *= share
        yield theta


def _scale_start(hint: ScoreTest, slots: list[Slot], factor: float) -> dict[str, float]:
    """Return the starting values of a score test with its amplitudes scaled."""
    shapes = {s.key for s in slots if s.param.null is None} | {onset_key(hint.key)}
    return {name: value if name in shapes else factor * value for name, value in hint.start.items()}
