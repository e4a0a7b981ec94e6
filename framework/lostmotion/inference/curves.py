"""Learned curves in a fit: smoothness by marginal likelihood, coefficients by the fit, and their bands.

One score test of all coefficients gives the marginal likelihood of any smoothness in closed form, because the
likelihood of the innovations is close to normal in the coefficients.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from lostmotion.contracts import Array, Place, place_of
from lostmotion.inference.fit import Fit, compute_robust_covariance, maximise, restart
from lostmotion.inference.learned import LearnedTerm, compute_spread
from lostmotion.inference.natural import find_term
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.inference.sensitivity import Sensitivity
from lostmotion.inference.surfaces import RICHER, OverHistory, Surface, list_all_curves
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import System, key_of
from lostmotion.likelihood.tangents import Tangents

SIZES = (0.002, 0.006, 0.02, 0.06, 0.2)
"""Standard deviations of a curve that are tried, in units of the drive."""
LENGTHS = (0.06, 0.12, 0.25, 0.5, 1.0)
"""Correlation lengths that are tried, in half widths of the range."""
CHOICES = math.log(len(SIZES) * len(LENGTHS))
"""The log prior penalty of the choice of a smoothness."""
ROUNDS = 6
"""Rounds of scoring: a curve is nearly linear in its coefficients and begins at a score estimate."""
EDGE, BEYOND = 0.02, 0.15
"""The margin of a curve beyond the visited range, as a share of it: larger for one over two variables or a hidden
state, because a motion leaves a plane, or the range of a hidden state, sooner."""
QUANTILES = (np.arange(200) + 0.5) / 200
"""The quantiles that describe where the recorded motion was."""
GRID = (41, 31)
"""Points along both axes of the grid on which a surface is evaluated."""
TIMES = (0.3, 1.0, 3.0, 10.0)
"""Memory times of a learned force that are tried, in units of the natural time of the recording."""
TOLD = 0.1
"""A coefficient is fitted when the information of the data exceeds this share of that of its prior."""
COVERED = 1e-2
"""A direction with less than this share of its information left is explained by the other free parameters."""
NUDGE = 3e-4
"""Finite-difference step of a coefficient in units of the drive."""


@dataclass(frozen=True)
class CurveTest:
    """The score test of a curve: predicted gain in log evidence, prior widths and starting values (count,).

    A coefficient with almost no information in the data has width zero: it is left out. `known` are values of the curve
    that were chosen with it.
    """

    key: str
    gain: float
    widths: Array
    start: Array
    known: Mapping[str, float] = field(default_factory=dict)


def add_all_curves(fit: Fit, until: float = 0.0) -> Fit:
    """Return a fit in a system that has every curve in addition to its terms, with the ranges that the motion visited.

    Curves over the time reach to `until` (s), if that is later than the recordings of the fit end. All terms stay, so
    one kernel serves any active set. A system that has the curves is returned unchanged.
    """
    posterior, old = fit.posterior, fit.posterior.system
    if any(isinstance(term, LearnedTerm) for term in old.terms):
        return fit
    driven = all(observation.harmonic.omega > 0.0 for observation in posterior.observations)
    plain = list_all_curves(old.model, driven=driven)
    moved = smooth_motions(fit, [place_of(old.model, curve) for curve in plain])
    ranges = [_find_ranges(fit, curve, moved, until) for curve in plain]
    curves = [_follow_motion(fit, curve, moved, found) for curve, found in zip(plain, ranges, strict=True)]
    system = replace(old, terms=(*old.terms, *curves))
    known = system.vector({key: posterior.known[old.index[key]] for key in system.index if key in old.index})
    for curve, found in zip(curves, ranges, strict=True):
        for key, value in found.items():
            known[system.index[f"{key_of(curve)}.{key}"]] = value
    return replace(fit, posterior=replace(posterior, dynamics=replace(posterior.dynamics, system=system), known=known))


def drop_all_curves(fit: Fit, system: System) -> Fit:
    """Return a fit whose curves are all absent in a system without them; its values are unchanged."""
    posterior = fit.posterior
    known = system.vector({key: posterior.known[posterior.system.index[key]] for key in system.index})
    return replace(fit, posterior=replace(posterior, dynamics=replace(posterior.dynamics, system=system), known=known))


Motions = dict[str, list[Array]]
"""Position and velocity (2, samples) in each recording, by the names of places of a model."""


def smooth_motions(fit: Fit, places: Sequence[Place]) -> Motions:
    """Return the filtered motion at places of the model in each recording; each recording is filtered once."""
    posterior, distinct = fit.posterior, {place.name: place for place in places}
    found: Motions = {name: [] for name in distinct}
    for observation in posterior.observations:
        single = replace(posterior.on((observation,)), jobs=1)
        states, full = single.filters[0].smooth(fit.theta).filtered, single.recordings[0].full(fit.theta)
        for name, place in distinct.items():
            found[name].append(place.move(states, single.observations[0].inputs, posterior.system.lever(full, place)))
    return found


def _find_ranges(fit: Fit, curve: LearnedTerm, moved: Motions, until: float) -> dict[str, float]:
    """Return middle and half width of the range of a curve's variable, for a surface of both variables."""
    time = fit.posterior.scales.time
    found = _centre_range(*_find_range(fit, curve, curve.over, moved, until))
    if isinstance(curve, Surface):
        found |= {f"{k}2": v for k, v in _centre_range(*_find_range(fit, curve, curve.beside, moved, until)).items()}
    return found | ({"time": time} if isinstance(curve, OverHistory) else {})


def _follow_motion(fit: Fit, curve: LearnedTerm, moved: Motions, found: Mapping[str, float]) -> LearnedTerm:
    """Return a curve whose functions have no constant and no straight line along the recorded motion."""
    if curve.over not in ("position", "velocity") or not curve.plain:
        return curve
    seen = moved[place_of(fit.posterior.system.model, curve).name]
    values = np.concatenate([motion[int(curve.over == "velocity")] for motion in seen])
    places = np.clip((values - found["middle"]) / found["half"], -1.0, 1.0)
    return replace(curve, places=tuple(np.quantile(places, QUANTILES).tolist()))


def _centre_range(low: float, high: float) -> dict[str, float]:
    return {"middle": 0.5 * (low + high), "half": 0.5 * (high - low)}


def _find_range(fit: Fit, curve: LearnedTerm, over: str, moved: Motions, until: float) -> tuple[float, float]:
    """Return the least and the greatest value of a variable in all recordings, with a narrow margin."""
    posterior = fit.posterior
    if over in ("time", "phase"):
        return 0.0, max(until, *(float(observation.time[-1]) for observation in posterior.observations))
    seen = moved[place_of(posterior.system.model, curve).name]
    if over == "history":
        steps = zip(seen, posterior.observations, strict=True)
        values = [
            OverHistory.followed(motion[1], observation.dt, posterior.scales.time) for motion, observation in steps
        ]
    else:
        values = [motion[int(over == "velocity")] for motion in seen]
    ends = [_find_ends(value) for value in values]
    low, high = min(e[0] for e in ends), max(e[1] for e in ends)
    margin = (BEYOND if isinstance(curve, RICHER) else EDGE) * (high - low)
    return low - margin, high + margin


def _find_ends(moved: Array) -> tuple[float, float]:
    low, high = np.quantile(moved[len(moved) // 50 :], [1e-3, 1.0 - 1e-3])
    return float(low), float(high)


def compute_coefficient_size(term: LearnedTerm, posterior: Posterior) -> float:
    """Return the natural size of the coefficients of a curve: the drive, in their dimension."""
    scales = posterior.scales
    return term.params[0].dimension.scale(scales.force, scales.length, scales.time)


def run_curve_test(fit: Fit, slopes: Sensitivity, key: str) -> CurveTest:
    """Return the score test of a curve; one with a memory is tested at each of `TIMES`, at a price for the choice."""
    posterior, term = fit.posterior, _find_curve(fit.posterior, key)
    if not isinstance(term, OverHistory):
        return _choose_smoothness(fit, slopes, key)
    moved, found = smooth_motions(fit, [place_of(posterior.system.model, term)]), []
    for share in TIMES:
        time = share * posterior.scales.time
        held = {"time": time, **_centre_range(*_find_range(fit, term, "history", moved, time))}
        known = {f"{key}.{name}": value for name, value in held.items()}
        best = _choose_smoothness(replace(fit, posterior=posterior.hold_values(known)), slopes, key)
        found.append(replace(best, gain=best.gain - math.log(len(TIMES)), known=known))
    return max(found, key=lambda shape: shape.gain)


def _choose_smoothness(fit: Fit, slopes: Sensitivity, key: str) -> CurveTest:
    """Return the score test of a curve at its best smoothness, with the free parameters of the fit adjusted.

    With gradient g and information H of its coefficients, prior widths D: the evidence gains (g'D (I + D H D)^-1 D g -
    log det(I + D H D)) / 2.
    """
    posterior = fit.posterior
    term = _find_curve(posterior, key)
    gradient, information = project_score(fit, slopes, key)
    options = []
    for size, length in itertools.product(SIZES, LENGTHS):
        widths = size * compute_coefficient_size(term, posterior) * compute_spread(term, length)
        inner = np.eye(term.count) + information * np.outer(widths, widths)
        pull = np.linalg.solve(inner, widths * gradient)
        gain = 0.5 * float(widths * gradient @ pull) - 0.5 * float(np.linalg.slogdet(inner)[1])
        told = widths**2 * np.diag(information) > TOLD
        options.append(CurveTest(key, gain, np.where(told, widths, 0.0), np.where(told, widths * pull, 0.0)))
    return max(options, key=lambda s: s.gain)


def _find_curve(posterior: Posterior, key: str) -> LearnedTerm:
    term, _ = find_term(posterior, key)
    if not isinstance(term, LearnedTerm):
        raise TypeError(f"{key} is no learned curve")
    return term


def project_score(fit: Fit, slopes: Sensitivity, key: str) -> tuple[Array, Array]:
    """Return gradient (count,) and information (count, count) of the coefficients of a curve at zero.

    What the free parameters of the fit explain as well is projected out.
    """
    return project_from(fit, join_curve(fit, slopes, key), len(slopes.theta))[:2]


def join_curve(fit: Fit, slopes: Sensitivity, key: str) -> Sensitivity:
    """Return the sensitivities of a fit, followed by those of the coefficients of a curve at zero.

    They are those of the linearised filter where there is one and the curve has no states.
    """
    posterior, term = fit.posterior, _find_curve(fit.posterior, key)
    width = NUDGE * compute_coefficient_size(term, posterior)
    zero = np.concatenate([slopes.theta, np.zeros(term.count)])
    if fit.filtered and not term.states:
        errors = np.concatenate([_respond(one, key, term.count, width) for one in fit.filtered], axis=1)
        here, variances = slopes.here, np.zeros_like(errors)
    else:
        here, errors, variances = difference_curve(posterior, slopes.theta, key)
    told = np.vstack([slopes.errors, errors]), np.vstack([slopes.variances, variances])
    return Sensitivity(zero, here, *told, np.full(len(zero), width))


def _respond(filtered: Tangents, key: str, count: int, width: float) -> Array:
    """Return the derivatives (count, readings) of the errors in one recording over the coefficients of a curve."""
    index, active = filtered.posterior.system.index, filtered.posterior.active | {key}
    fulls = np.tile(filtered.full, (count, 1))
    fulls[:, [index[f"{key}.v{i}"] for i in range(count)]] = width * np.eye(count)
    return filtered.respond_to_laws(fulls, active, np.full(count, width))


def difference_curve(posterior: Posterior, theta: Array, key: str) -> tuple[Innovations, Array, Array]:
    """Return the innovations at coordinates (n,), and differences of errors and variances over a curve's coefficients.

    Both are (count, readings). It is the slow twin of the linearised filter.
    """
    term = _find_curve(posterior, key)
    width = NUDGE * compute_coefficient_size(term, posterior)
    wider = add_curve(posterior, key, np.full(term.count, math.inf), np.zeros(term.count))
    moved = np.vstack([np.zeros(term.count), width * np.eye(term.count)])
    seen = wider.innovations(np.hstack([np.tile(theta, (1 + term.count, 1)), moved]))
    above = np.where(seen.finite[1:], np.arange(1, len(seen)), 0)
    return seen[0], (seen.errors[above] - seen.errors[0]) / width, (seen.variances[above] - seen.variances[0]) / width


def project_from(fit: Fit, joint: Sensitivity, k: int) -> tuple[Array, Array, Array]:
    """Return gradient, information, and the projection of each score on the first `k` parameters (k, count).

    They are those of `project_score`, from the sensitivities of `join_curve`.
    """
    posterior = fit.posterior
    gradient, information = joint.gradient(), joint.information()
    pull = np.array(list(map(FreeParameter.prior_information, posterior.space.free, joint.theta)))
    gradient[:k] -= pull * (joint.theta[:k] - np.array([f.mean for f in posterior.space.free]))
    pulled = solve_scaled(information[:k, :k] + np.diag(pull), information[:k, k:])
    own = information[k:, k:]
    told = _keep_independent(gradient[k:] - pulled.T @ gradient[:k], own - information[k:, :k] @ pulled, own)
    return *told, pulled


def _keep_independent(gradient: Array, left: Array, own: Array) -> tuple[Array, Array]:
    """Return gradient and information without the directions that the free parameters of the fit explain already.

    In those directions nothing is `left` of the information `own` but errors of the differences. Dividing by them would
    amplify the rest of a gradient that is not quite zero: a curve over velocity would then predict the gain of a change
    of damping.
    """
    values, vectors = np.linalg.eigh(own)
    root = vectors * np.sqrt(np.maximum(values, 1e-9 * values[-1]))
    white = np.linalg.solve(root, np.linalg.solve(root, left).T)
    shares, axes = np.linalg.eigh(0.5 * (white + white.T))
    kept = axes[:, shares > COVERED]
    turned = root @ kept
    return turned @ (kept.T @ np.linalg.solve(root, gradient)), turned * shares[shares > COVERED] @ turned.T


def add_curve(posterior: Posterior, key: str, widths: Array, start: Array) -> Posterior:
    """Return a posterior with one more curve: coefficients normal about zero with `widths` > 0, begun at `start`."""
    term = _find_curve(posterior, key)
    reach = np.where(np.isfinite(widths), 30.0 * widths, 1e3 * compute_coefficient_size(term, posterior))
    unit = term.params[0].dimension.unit(posterior.system.model.motion)
    rows = [(int(i), *(float(row[i]) for row in (start, reach, widths))) for i in np.flatnonzero(widths > 0.0)]
    frees = [FreeParameter(f"{key}.v{i}", unit, at, -far, far, sd=wide, linear=True) for i, at, far, wide in rows]
    return posterior.extend(frees, {key})


def fit_curve(fit: Fit, shape: CurveTest) -> Fit:
    """Return the fit with one more curve, started at the estimate of its score test or at a share of it."""
    base = restart(fit).hold_values(shape.known)
    posteriors = [add_curve(base, shape.key, shape.widths, f * shape.start) for f in (1.0, 0.5, 0.2)]
    log_densities = [p.log_density(p.space.clip(p.space.start)) for p in posteriors]
    return maximise(posteriors[int(np.argmax(log_densities))], rounds=ROUNDS, tolerance=0.3)


@dataclass(frozen=True)
class Band:
    """A learned curve at places `at` (points,): mean, and covariance (points, points) of the mean.

    A surface is given on the grid of `at` and `beside`, with the values (points of both) in rows.
    """

    term: LearnedTerm
    at: Array
    mean: Array
    covariance: Array
    beside: Array | None = None

    @property
    def sd(self) -> Array:
        """The standard deviation (points,) of the curve."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))


def compute_band(fit: Fit, key: str, points: int = 161) -> Band:
    """Return a learned curve over the range of the data, with the robust covariance of its coefficients."""
    posterior, term = fit.posterior, _find_curve(fit.posterior, key)
    places = {name: i for i, name in enumerate(posterior.space.keys)}
    used = [i for i in range(term.count) if f"{key}.v{i}" in places]
    columns = [places[f"{key}.v{i}"] for i in used]
    beside = None
    if isinstance(term, Surface):
        (z, at), (w, beside) = (
            _make_axis(posterior, key, term.over, GRID[0]),
            _make_axis(posterior, key, term.beside, GRID[1], "2"),
        )
        basis = term.grid(z, w).reshape(len(z) * len(w), -1)[:, used]
    else:
        z, at = _make_axis(posterior, key, term.over, points)
        basis = term.basis(z)[:, used]
    covariance = compute_robust_covariance(fit)[np.ix_(columns, columns)]
    return Band(term, at, basis @ fit.theta[columns], basis @ covariance @ basis.T, beside)


def _make_axis(posterior: Posterior, key: str, over: str, points: int, which: str = "") -> tuple[Array, Array]:
    """Return places (points,) in half widths (half periods) of a range, and their values in its unit (periods)."""
    if over == "phase":
        z = np.linspace(0.0, 2.0, points)
        return z, 0.5 * z
    middle, half = (float(posterior.known[posterior.system.index[f"{key}.{n}{which}"]]) for n in ("middle", "half"))
    z = np.linspace(-1.0, 1.0, points)
    return z, middle + half * z
