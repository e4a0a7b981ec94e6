"""The effect of each candidate term on the one-step errors of a hypothesis, and what it promises.

A term is proposed by slopes: the derivatives of the errors over its amplitudes, at several values of its shape.
Together with the expansion of the hypothesis they predict the evidence of the larger set, in which the term may take
the place of a smooth force. A prediction costs time at most, never a name: every proposal is fitted.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.evidence.channel_errors import ChannelError
from lostmotion.evidence.discrepancy import Choice, Quadratic, make_frame
from lostmotion.evidence.expansion import Curvature, Expansion, compute_cross_information, differentiate_density
from lostmotion.evidence.hypothesis import Hypothesis, solve_posterior
from lostmotion.inference.calls import require_finite
from lostmotion.inference.candidates import make_term_parameters
from lostmotion.inference.fit import Fit
from lostmotion.inference.late import can_have_onset
from lostmotion.inference.natural import (
    compute_size,
    find_term,
    hold_shape,
    is_scanned,
    list_star_points,
    list_tried_values,
    sort_slots,
)
from lostmotion.inference.rounding import drop_rounding
from lostmotion.kernels.threads import each
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import Slot, onset_key
from lostmotion.likelihood.tangents import Tangents, linearise_recordings

Shapes = Mapping[str, Sequence[Mapping[str, float]]]
"""Shapes of terms that are tried beside their usual ones."""
MOST_LATE = 8
"""The number of terms, best first, that are also tried from an onset on."""
SMALL = 0.01
"""Derivatives are taken over this share of the typical size of an amplitude."""
REACHED = (0.4, 1.6)
"""A secant holds for amplitudes between these shares of the one that it leads to."""
MUTE = 1e-6
"""An amplitude of typical size with less information than this has no effect."""


@dataclass(frozen=True)
class TermEffect:
    """The derivatives (amplitudes, readings) of the errors over the amplitudes of a term at one shape.

    They are secants to the `sizes` (amplitudes,).
    """

    key: str
    shape: Mapping[str, float]
    amplitudes: tuple[Slot, ...]
    sizes: Array
    widths: Array
    errors: Array
    variances: Array


@dataclass(frozen=True)
class Promise:
    """A term that a hypothesis may lack: its predicted gain in score, and values from which its fit begins.

    `step` (count,) is the predicted change of the coordinates of the hypothesis.
    """

    key: str
    gain: float
    start: Mapping[str, float]
    step: Array
    choice: Choice


def hold_bare(fit: Fit, errors: tuple[ChannelError, ...], odds: float) -> Hypothesis:
    """Return a fit as a hypothesis without a discrepancy; `errors` are those of channels."""
    frame = make_frame(fit.posterior, fit.theta, errors, odds)
    return Hypothesis(frame, frame.expand(frame.start, fit.local.steps, frame.none), frame.none, 0.0, 0.0, 0.0)


def list_bare_promises(fit: Fit, keys: Sequence[str], shapes: Shapes) -> list[Promise]:
    """Return what each term promises beside a fit without a discrepancy, at no price, best first."""
    return list_promises(hold_bare(fit, (), 0.0), keys, shapes, dict.fromkeys(keys, 0.0), (), 0.0)


def propose_start(fit: Fit, key: str) -> Mapping[str, float]:
    """Return the values of a term that promise most beside a fit, from which the fit with it begins."""
    promises = list_bare_promises(fit, [key], {})
    return promises[0].start if promises else get_usual_shape(fit.posterior, key) or {}


def list_promises(
    found: Hypothesis,
    keys: Sequence[str],
    shapes: Shapes,
    prices: Mapping[str, float],
    onsets: Sequence[float],
    dearer: float,
) -> list[Promise]:
    """Return what each term promises beside a hypothesis, best first; `shapes` are tried beside the usual ones.

    A term may act from one of the `onsets` (s) on; its price is larger by `dearer` then.
    """
    posterior = found.frame.bare(found.at, found.choice)
    theta = found.at[: len(posterior.space.free)]
    filtered = linearise_recordings(posterior, theta)
    before = Quadratic.of(found.frame, found.expansion.curvature).evaluate(found.choice)

    def test(key: str) -> tuple[Promise, TermEffect] | None:
        effects = list(_list_effects(posterior, theta, filtered, key, shapes.get(key, ())))
        tested = zip(_predict_each(found, effects, before + prices[key]), effects, strict=True)
        return max(tested, key=lambda one: one[0].gain, default=None)

    tested = [one for one in each(test, list(keys), posterior.jobs) if one is not None]
    tested.sort(key=lambda one: -one[0].gain)
    late = [_test_onsets(found, *one, before + prices[one[0].key] + dearer, onsets) for one in tested[:MOST_LATE]]
    promises = [*late, *(promise for promise, _ in tested[MOST_LATE:])]
    return sorted((one for one in promises if math.isfinite(one.gain)), key=lambda one: -one.gain)


def _test_onsets(found: Hypothesis, ever: Promise, effect: TermEffect, less: float, onsets: Sequence[float]) -> Promise:
    """Return what a term promises if it acts from an onset on, where that is more than what it promises as it is.

    A filter forgets earlier samples within a few cycles. So the derivatives of the errors after an onset are those of a
    term that acts from the beginning.
    """
    posterior = found.frame.posterior
    if not can_have_onset(posterior, effect.key):
        return ever
    times = np.concatenate([np.repeat(o.time, len(o.sensors)) for o in posterior.observations])
    after = [times >= onset for onset in onsets]
    cuts = [replace(effect, errors=effect.errors * late, variances=effect.variances * late) for late in after]
    late = [
        replace(promise, start={**promise.start, onset_key(effect.key): onset})
        for onset, promise in zip(onsets, _predict_each(found, cuts, less), strict=True)
    ]
    return max((ever, *late), key=lambda one: one.gain)


def _list_effects(
    posterior: Posterior, theta: Array, filtered: Sequence[Tangents], key: str, more: Sequence[Mapping[str, float]]
) -> Iterator[TermEffect]:
    """Yield the effect of a term at each shape.

    Where the only amplitude has a range to be scanned, such as the time of a lag, the effect is not proportional to it:
    secants to the values of the range are effects too.
    """
    amplitudes, shapes = sort_slots(posterior, key)
    if is_scanned(amplitudes) and not shapes:
        param = amplitudes[0].param
        sizes = (SMALL * compute_size(param, posterior.scales), *list_tried_values(param, posterior.scales))
        yield from differentiate_term(posterior, theta, filtered, key, [{}] * len(sizes), np.array(sizes)[:, None])
        return
    usual = _list_star_shapes(posterior, shapes)
    tried = drop_rounding(posterior, key, (*usual, *more)) if shapes else usual
    yield from differentiate_term(posterior, theta, filtered, key, tried)


def get_usual_shape(posterior: Posterior, key: str) -> Mapping[str, float] | None:
    """Return the values of the shapes of a term in the middle of their ranges; None where rounding hides it."""
    shapes = sort_slots(posterior, key)[1]
    grids = [list_tried_values(s.param, posterior.scales) for s in shapes]
    usual = {s.key: grid[len(grid) // 2] for s, grid in zip(shapes, grids, strict=True)}
    return usual if not shapes or drop_rounding(posterior, key, (usual,)) else None


def _list_star_shapes(posterior: Posterior, shapes: Sequence[Slot]) -> list[dict[str, float]]:
    """Return the values of shapes that are tried: each over its grid while the others are in their middle."""
    grids = [list_tried_values(s.param, posterior.scales) for s in shapes]
    return [dict(zip((s.key for s in shapes), values, strict=True)) for values in list_star_points(grids)]


def differentiate_term(
    posterior: Posterior,
    theta: Array,
    filtered: Sequence[Tangents],
    key: str,
    tried: Sequence[Mapping[str, float]],
    sizes: Array | None = None,
) -> Iterator[TermEffect]:
    """Yield the effect of a term at each of some shapes, where it is finite; `ContractError` if the term itself is not.

    Derivatives are secants over `sizes`, (amplitudes,) or (shapes, amplitudes), by default a small share of the typical
    ones. `filtered` has the linearised filter of each recording; without it, and for terms with states, the filter runs
    again.
    """
    if not tried:
        return
    term, amplitudes = find_term(posterior, key)[0], sort_slots(posterior, key)[0]
    widths = np.array([f.sd for f in make_term_parameters(posterior, key, amplitudes, {})])
    if sizes is None:
        sizes = SMALL * np.array([compute_size(s.param, posterior.scales) for s in amplitudes])
    sizes = np.broadcast_to(sizes, (len(tried), len(amplitudes)))
    if filtered and not term.states and term.acts in ("motion", "drive"):
        errors = np.concatenate([_respond(one, key, tried, amplitudes, sizes) for one in filtered], axis=2)
        variances = np.zeros_like(errors)
    else:
        errors, variances = _compute_differences(posterior, theta, key, tried, sizes)
    for shape, size, e, v in zip(tried, sizes, errors, variances, strict=True):
        if np.all(np.isfinite(e)) and np.all(np.isfinite(v)):
            yield TermEffect(key, shape, tuple(amplitudes), size, widths, e, v)
        else:
            require_finite(posterior, key)


def _respond(
    filtered: Tangents, key: str, shapes: Sequence[Mapping[str, float]], amplitudes: Sequence[Slot], sizes: Array
) -> Array:
    """Return the derivatives (shapes, amplitudes, readings) of the errors over the amplitudes of a static term."""
    posterior, scale = filtered.posterior, sizes.ravel()
    rows = [(shape, a) for shape in shapes for a in range(len(amplitudes))]
    fulls = np.array(
        [set_amplitude(filtered, shape, amplitudes, a, size) for (shape, a), size in zip(rows, scale, strict=True)]
    )
    if find_term(posterior, key)[0].acts == "drive":
        acting = posterior.acting(posterior.active | {key})
        moved = [(acting.recordings[0].drive(full).inputs[: len(filtered.states)] - filtered.inputs) for full in fulls]
        found = np.concatenate([filtered.respond_to_input(m / s) for m, s in zip(moved, scale, strict=True)])
    else:
        found = filtered.respond_to_laws(fulls, posterior.active | {key}, scale)
    return np.asarray(found.reshape(*sizes.shape, -1))


def set_amplitude(
    filtered: Tangents, shape: Mapping[str, float], amplitudes: Sequence[Slot], which: int, size: float
) -> Array:
    """Return the full parameter vector with one amplitude of a term at a distance `size` from its null."""
    index, full = filtered.posterior.system.index, filtered.full.copy()
    for slot in amplitudes:
        full[index[slot.key]] = float(slot.param.null or 0.0)
    for name, value in shape.items():
        full[index[name]] = value
    full[index[amplitudes[which].key]] += size
    return full


def _compute_differences(
    posterior: Posterior, theta: Array, key: str, shapes: Sequence[Mapping[str, float]], sizes: Array
) -> tuple[Array, Array]:
    """Return the derivatives (shapes, amplitudes, readings) of errors and variances by runs of the filter."""
    amplitudes, fixed = sort_slots(posterior, key)
    frees = (*make_term_parameters(posterior, key, amplitudes, {}), *(hold_shape(slot) for slot in fixed))
    wider, own, count = posterior.extend(frees, {key}), len(theta), len(amplitudes)
    held = [tuple(shape[s.key] for s in fixed) for shape in shapes]
    nulls = {values: np.concatenate([theta, np.zeros(count), values]) for values in held}
    moved = [
        nulls[values] + np.eye(own + count + len(fixed))[own + a] * size[a]
        for values, size in zip(held, sizes, strict=True)
        for a in range(count)
    ]
    seen = wider.innovations(np.array([*nulls.values(), *moved]))
    of_null = np.repeat([list(nulls).index(values) for values in held], count)
    finite = seen.finite[len(nulls) :] & seen.finite[of_null]
    with np.errstate(invalid="ignore"):
        slopes = [
            np.where(finite[:, None], (e[len(nulls) :] - e[of_null]) / sizes.reshape(-1, 1), np.nan)
            for e in (seen.errors, seen.variances)
        ]
    return slopes[0].reshape(*sizes.shape, -1), slopes[1].reshape(*sizes.shape, -1)


def join_effects(expansion: Expansion, effects: Sequence[TermEffect]) -> Expansion:
    """Return an expansion with the amplitudes of terms as its last coordinates, in blocks with their keys."""
    ends = len(expansion.at) + np.cumsum([0, *(len(effect.amplitudes) for effect in effects)])
    more = np.zeros(ends[-1] - ends[0])
    widths = np.concatenate([more[:0], *(effect.widths for effect in effects)])
    blocks = {effect.key: slice(int(a), int(b)) for effect, a, b in zip(effects, ends[:-1], ends[1:], strict=True)}
    return replace(
        expansion,
        at=np.append(expansion.at, more),
        errors=np.vstack([expansion.errors, *(effect.errors for effect in effects)]),
        variances=np.vstack([expansion.variances, *(effect.variances for effect in effects)]),
        middle=np.append(expansion.middle, more),
        precision=np.append(expansion.precision, 1.0 / widths**2),
        blocks={**expansion.blocks, **blocks},
    )


def _border(expansion: Expansion, effects: Sequence[TermEffect]) -> list[Curvature]:
    """Return the curvature with the amplitudes of each effect in turn as last coordinates.

    The large block is known already: only the rows of the effects are computed, those of all effects at once.
    """
    here = expansion.here
    errors, variances = np.vstack([e.errors for e in effects]), np.vstack([e.variances for e in effects])
    over_errors, over_variances = differentiate_density(here)
    gradient = errors @ over_errors + variances @ over_variances
    cross = compute_cross_information(here, errors, variances, expansion.errors, expansion.variances)
    found, first = [], 0
    for effect in effects:
        count = len(effect.widths)
        rows = slice(first, first + count)
        own = compute_cross_information(here, effect.errors, effect.variances, effect.errors, effect.variances)
        information = np.block([[expansion.information, cross[rows].T], [cross[rows], own]])
        middle = np.append(expansion.middle, np.zeros(count))
        precision = np.append(expansion.precision, 1.0 / effect.widths**2)
        at, slope = np.append(expansion.at, np.zeros(count)), np.append(expansion.gradient, gradient[rows])
        found.append(Curvature(at, slope, information, middle, precision))
        first += count
    return found


def _predict_each(found: Hypothesis, effects: Sequence[TermEffect], less: float) -> list[Promise]:
    """Return what a term promises at each of some shapes; `less` is paid.

    It stands beside the present smooth forces, in the place of one or of all, or in that of their constants and lines.
    """
    if not effects:
        return []
    curvatures, room = _border(found.expansion, effects), found.frame.make_room(found.choice)
    return [_predict(found, *pair, room, less) for pair in zip(effects, curvatures, strict=True)]


def _predict(found: Hypothesis, effect: TermEffect, joined: Curvature, room: Sequence[Choice], less: float) -> Promise:
    """Return what a term promises at one shape, beside the best choice in `room`; `less` is paid."""
    frame, n = found.frame, len(found.at)
    told = np.diag(joined.information)[n:] * effect.widths**2
    lost = Promise(effect.key, -math.inf, effect.shape, np.zeros(n), found.choice)
    if not np.any(told > MUTE):
        return lost
    quadratic = Quadratic.of(frame, joined, effect.widths)
    choice = max(room, key=quadratic.evaluate)
    step = solve_posterior(frame, joined, choice, quadratic.held)
    sizes, low = step[n:], np.array([slot.param.low for slot in effect.amplitudes])
    if np.all(sizes < low):
        return lost
    if is_scanned(effect.amplitudes) and not REACHED[0] < (sizes / effect.sizes).item() < REACHED[1]:
        return lost
    start = {s.key: float(a) for s, a in zip(effect.amplitudes, np.maximum(sizes, low), strict=True)}
    return Promise(effect.key, quadratic.evaluate(choice) - less, {**effect.shape, **start}, step[:n], choice)
