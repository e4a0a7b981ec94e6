"""The model discrepancy with which each set of terms is compared: smooth forces, wrong known values, channel errors.

No model of a real machine is exact. A likelihood that ignores this accepts any term that resembles the model error, and
becomes more certain with the length of the recording. Each set of terms is therefore compared together with a
discrepancy (Kennedy, O'Hagan, J. R. Stat. Soc. B 63 (2001) 425-464): reduced-rank Gaussian processes over position,
velocity, phase and time, of the size of unmodelled forces of real machines; known values that are free within the usual
errors; and errors of channels (`channel_errors.py`). One-step errors are nearly linear in all of these, so the evidence
has a closed form around a fit, and costs one run of the filter for each coefficient.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.linalg.lapack import dpotrf, dtrtrs

from lostmotion.contracts import Array, Interface, place_of
from lostmotion.inference.candidates import compute_slopes
from lostmotion.inference.channel_errors import ChannelError, list_channel_errors
from lostmotion.inference.curves import Motions, add_all_curves, add_curve, compute_coefficient_size, smooth_motions
from lostmotion.inference.fit import BLOCKS, Fit, Sensitivity, maximise, restart, solve_scaled
from lostmotion.inference.learned import LearnedTerm, OverPhase, OverPosition, OverTime, OverVelocity, compute_spread
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.problem import FreeParameter, Problem
from lostmotion.likelihood.system import key_of

SMOOTH = (OverPosition, OverVelocity, OverTime, OverPhase)
SIZES = (0.005, 0.015, 0.05, 0.15)
"""Standard deviations of a smooth force that are tried, in units of the drive, as real machines have."""
LENGTHS = (0.15, 0.3, 0.6, 1.2)
"""Correlation lengths that are tried, in half widths of the range."""
MOST_WAVES = 20
"""The largest number of waves of a smooth force: shorter waves have no weight at these correlation lengths."""
NUDGE, STEP = 3e-4, 1e-3
"""Finite-difference steps of a coefficient in units of the drive, and of the logarithm of a known value."""
SHARES = (1.0, 0.5, 0.2, 0.0)
"""Starting points of fits with smooth forces, as shares of the predicted values."""
ROUNDS_SMOOTH, ROUNDS_KNOWN = 3, 20
"""Rounds of a fit with smooth forces, which starts at predicted values, and of one with free known values only; its
rounds cost less."""
SWEEPS = 3
PENALTY = math.log(len(SIZES) * len(LENGTHS))
"""The log prior penalty of a smooth force: one of all sizes and correlation lengths was chosen."""


@dataclass(frozen=True)
class CoefficientGroup:
    """The coefficients of one smooth force: their columns, and the prior widths (count,) that are tried."""

    name: str
    columns: slice
    options: tuple[Array, ...]


@dataclass(frozen=True)
class Discrepancy:
    """A discrepancy: the log evidence that it adds, and the option that was chosen for each group, or -1.

    `widths` (n,) are the prior standard deviations of its coefficients, zero for unused ones; `mean` (n,) are their
    posterior means.
    """

    gain: float
    chosen: tuple[tuple[str, int], ...]
    widths: Array
    mean: Array


@dataclass(frozen=True)
class DiscrepancyExpansion:
    """The quadratic expansion of the log posterior around a fit, in its own coordinates and those of the discrepancy.

    `gradient` (n,) and `information` (n, n) include the priors of the own coordinates, which come first; `own` is their
    number. `widths` (n - own,) are the prior standard deviations of known values (first) and `channel_errors` (last),
    and zero for smooth forces. `inflation` is the factor by which autocorrelation increases the variance of scores over
    blocks, at least 1.
    """

    fit: Fit
    gradient: Array
    information: Array
    own: int
    groups: tuple[CoefficientGroup, ...]
    channel_errors: tuple[ChannelError, ...]
    widths: Array
    inflation: float
    _cache: dict[tuple[object, ...], Discrepancy] = field(default_factory=dict, init=False, repr=False, compare=False)

    def predict_gain(self, dropped: Sequence[int] = (), inflation: float = 0.0) -> float:
        """Return the log evidence that the discrepancy adds to the fit; see `best`."""
        return self.find_best_without(dropped, inflation or self.inflation).gain

    def list_coordinates(self, terms: Collection[str]) -> list[int]:
        """Return the indices of the own coordinates of some terms."""
        return [i for i, key in enumerate(self.fit.problem.keys) if key.rpartition(".")[0] in terms]

    def find_best(self, inflation: float = 0.0) -> Discrepancy:
        """Return the best discrepancy, searched from none and from the one that imitates all terms of the fit."""
        inflation = inflation or self.inflation
        alone = self.find_best_without((), inflation)
        terms = self.list_coordinates(self.fit.problem.active)
        if not terms:
            return alone
        beside = self.find_best_without((), inflation, self.find_best_without(terms, inflation).chosen)
        return max(alone, beside, key=lambda found: found.gain)

    def find_best_without(
        self, dropped: Sequence[int] = (), inflation: float = 1.0, begin: Sequence[tuple[str, int]] = ()
    ) -> Discrepancy:
        """Return the discrepancy with the best smoothness, with log-likelihoods divided by `inflation`.

        Own coordinates in `dropped` are set to zero and the others are re-optimised: this approximates the set without
        a term, as far as one-step errors are linear in it. The loss of log posterior is included. The search starts
        from the options `begin`, by default from no smooth force.
        """
        asked = (*dropped, inflation, *begin)
        if asked not in self._cache:
            self._cache[asked] = self._optimise(
                dropped, inflation, [option for _, option in begin] or [-1] * len(self.groups)
            )
        return self._cache[asked]

    def compute_fixed_gain(self, inflation: float) -> float:
        """Return the log evidence that known values and channel errors add without smooth forces."""
        h, g, _ = self._project((), inflation)
        return compute_log_evidence(h, g, self.widths)

    def compute_channel_information(self) -> Array:
        """Return the information matrix of the channel errors, marginalised over the own coordinates."""
        first = len(self.widths) - len(self.channel_errors)
        return np.asarray(self._project((), 1.0)[0][first:, first:])

    def shift_coordinates(self, sizes: Array) -> Array:
        """Return the predicted own coordinates (own,) for channel errors of given `sizes`."""
        cross = self.information[: self.own, len(self.gradient) - len(self.channel_errors) :]
        return np.asarray(self.fit.theta - solve_scaled(self.information[: self.own, : self.own], cross @ sizes))

    def _optimise(self, dropped: Sequence[int], inflation: float, begin: list[int]) -> Discrepancy:
        h, g, more = self._project(dropped, inflation)
        found = self._optimise_widths(h, g, begin)
        return replace(found, gain=found.gain + more)

    def _project(self, dropped: Sequence[int], inflation: float) -> tuple[Array, Array, float]:
        """Return information and gradient of the discrepancy, own coordinates profiled out, and the gain of these."""
        kept = np.setdiff1d(np.arange(self.own), np.asarray(dropped, dtype=int))
        more = np.arange(self.own, len(self.gradient))
        gradient, lost = self._shift_to_zero(dropped)
        cross = self.information[np.ix_(kept, more)]
        pulled = solve_scaled(self.information[np.ix_(kept, kept)], np.column_stack([cross, gradient[kept]]))
        information = self.information[np.ix_(more, more)] - cross.T @ pulled[:, :-1]
        force = gradient[more] - cross.T @ pulled[:, -1]
        moved = 0.5 * float(gradient[kept] @ pulled[:, -1]) if len(dropped) else 0.0
        return 0.5 * (information + information.T) / inflation, force / inflation, (moved - lost) / inflation

    def _shift_to_zero(self, dropped: Sequence[int]) -> tuple[Array, float]:
        """Return the gradient with some own coordinates set to zero, and the loss of log posterior."""
        away = np.zeros(len(self.gradient))
        away[list(dropped)] = -self.fit.theta[list(dropped)]
        pulled = self.information @ away
        return self.gradient - pulled, 0.5 * float(away @ pulled) - float(self.gradient @ away)

    def _optimise_widths(self, h: Array, g: Array, chosen: list[int]) -> Discrepancy:
        """Return the best discrepancy by coordinate search: each smooth force in turn gets its best width, or none."""
        widths = self.widths.copy()
        for group, option in zip(self.groups, chosen, strict=True):
            if option >= 0:
                widths[group.columns] = group.options[option]
        best = compute_log_evidence(h, g, widths) - PENALTY * sum(option >= 0 for option in chosen)
        for _ in range(SWEEPS):
            before = best
            for k, group in enumerate(self.groups):
                rest = sum(option >= 0 for j, option in enumerate(chosen) if j != k)
                none = np.zeros_like(widths[group.columns])
                for option, wide in itertools.chain([(-1, none)], enumerate(group.options)):
                    trial = widths.copy()
                    trial[group.columns] = wide
                    value = compute_log_evidence(h, g, trial) - PENALTY * (rest + (option >= 0))
                    if value > best:
                        best, chosen[k], widths = value, option, trial
            if best <= before:
                break
        options = tuple((group.name, option) for group, option in zip(self.groups, chosen, strict=True))
        mean = widths * np.linalg.solve(np.eye(len(g)) + h * np.outer(widths, widths), widths * g)
        return Discrepancy(best, options, widths, mean)


def compute_log_evidence(h: Array, g: Array, widths: Array) -> float:
    """Return the log evidence of normal coefficients with information `h` (n, n) and gradient `g` (n,) at zero.

    With D the prior `widths` (n,): (g'D (I + D h D)^-1 D g - log det(I + D h D)) / 2; zero widths are left out.
    """
    used = widths > 0.0
    if not used.any():
        return 0.0
    d = widths[used]
    inner = h[np.ix_(used, used)] * d * d[:, None]
    inner.flat[:: len(d) + 1] += 1.0
    lower, failed = dpotrf(inner, lower=1)
    if failed:
        return -math.inf
    pulled = dtrtrs(lower, d * g[used], lower=1)[0]
    return 0.5 * float(pulled @ pulled) - float(np.sum(np.log(np.diag(lower))))


def expand_fit(fit: Fit) -> DiscrepancyExpansion:
    """Return the expansion of a fit with its discrepancy."""
    slopes, problem, own = compute_slopes(fit), add_all_curves(fit).problem, len(fit.theta)
    known = _free_known_values(problem)
    curves = [(key_of(t), t) for t in problem.system.terms if isinstance(t, SMOOTH)]
    curves = [(key, term) for key, term in curves if key not in problem.active]
    frees, steps = list(known), [STEP] * len(known)
    groups = []
    for key, term in curves:
        size, count = compute_coefficient_size(term, problem), min(term.count, MOST_WAVES)
        options = tuple(s * size * compute_spread(term, length)[:count] for s in SIZES for length in LENGTHS)
        groups.append(CoefficientGroup(key, slice(len(frees), len(frees) + count), options))
        frees += [FreeParameter(f"{key}.v{i}", "", 0.0, -1e3 * size, 1e3 * size, linear=True) for i in range(count)]
        steps += [NUDGE * size] * count
    errors, variances = _compute_derivatives(problem.extend(frees, {key for key, _ in curves}), slopes, np.array(steps))
    _remove_constants(replace(fit, problem=problem), dict(curves), groups, (errors, variances))
    channel_errors = list_channel_errors(fit)
    joint = Sensitivity(
        slopes.theta,
        slopes.here,
        np.vstack([slopes.errors, errors, *(g.errors for g in channel_errors)]),
        np.vstack([slopes.variances, variances, *(g.variances for g in channel_errors)]),
        slopes.steps,
    )
    gradient, information = joint.gradient(), joint.information()
    gradient[own + len(frees) :] += [g.log_jacobian for g in channel_errors]
    gradient[:own] = 0.0  # zero at a maximum; the rest is noise of the differences, large for undetermined levels
    pulls = map(FreeParameter.evidence_information, fit.problem.free, slopes.theta)
    information[np.arange(own), np.arange(own)] += list(pulls)
    exact = [problem.settings.rival.known] * len(known)
    widths = np.array([*exact, *[0.0] * (len(frees) - len(known)), *(g.width for g in channel_errors)])
    return DiscrepancyExpansion(
        fit,
        gradient,
        information,
        own,
        tuple(groups),
        tuple(channel_errors),
        widths,
        _compute_inflation(joint, own, information),
    )


def _remove_constants(
    fit: Fit, terms: dict[str, LearnedTerm], groups: Sequence[CoefficientGroup], rows: tuple[Array, Array]
) -> None:
    """Remove the constant force from the derivatives `rows` (coefficients, readings) of smooth forces, in place.

    A constant force is a term of its own, so smooth forces have no mean along the motion. The derivative with respect
    to a constant is composed of those of the waves over time.
    """
    clocks = [g for g in groups if isinstance(terms[g.name], OverTime)]
    if not clocks:
        return
    first, places = clocks[0], {i.name: i for i in fit.problem.system.model.interfaces}
    z = np.linspace(-1.0, 1.0, 400)
    waves = terms[first.name].basis(z)[:, : first.columns.stop - first.columns.start]
    flat = np.linalg.lstsq(waves, np.ones(len(z)), rcond=1e-6)[0]
    constant = [row[first.columns].T @ flat for row in rows]
    body = places[terms[first.name].at]
    same = [g for g in groups if _act_on_same_bodies(places[terms[g.name].at], body)]
    moved = smooth_motions(fit, [places[terms[g.name].at] for g in same])
    for group in same:
        mean = _average_along_motion(fit, group.name, terms[group.name], moved)[
            : group.columns.stop - group.columns.start
        ]
        for row, of in zip(rows, constant, strict=True):
            row[group.columns] -= np.outer(mean, of)


def _act_on_same_bodies(place: Interface, body: Interface) -> bool:
    """Return whether forces at two places act on the same bodies."""
    return (place.row, place.against) == (body.row, body.against)


def _average_along_motion(fit: Fit, key: str, term: LearnedTerm, moved: Motions) -> Array:
    """Return the mean (count,) of each wave of a smooth force along the recorded motion."""
    if isinstance(term, OverPhase):
        return np.zeros(term.count)
    if isinstance(term, OverTime):
        return np.asarray(term.basis(np.linspace(-1.0, 1.0, 400)).mean(axis=0))
    problem = fit.problem
    middle, half = (float(problem.known[problem.system.index[f"{key}.{name}"]]) for name in ("middle", "half"))
    place = place_of(problem.system.model, term)
    seen = [motion[int(term.over == "velocity")] for motion in moved[place.name]]
    return np.asarray(term.basis((np.concatenate(seen) - middle) / half).mean(axis=0))


def fit_discrepancy(expansion: DiscrepancyExpansion) -> tuple[Fit, float] | None:
    """Return the fit with the smooth forces of the best discrepancy and free known values, and its log penalty.

    None if there are neither. An expansion may predict a gain that a fit does not confirm: one-step errors are not
    linear in forces that are large compared with the random force, nor in known values with large errors.
    """
    return _fit_with_forces(expansion, restart(add_all_curves(expansion.fit)), expansion.find_best())


def fit_imitation(expansion: DiscrepancyExpansion, gone: Collection[str]) -> tuple[Fit, float] | None:
    """Return the fit in which smooth forces and free known values replace some terms, and its log penalty.

    It starts from the replacement that the expansion about the fit with the terms predicts.
    """
    dropped = expansion.list_coordinates(gone)
    problem = restart(add_all_curves(expansion.fit))
    for key in gone:
        problem = problem.remove_term(key, {})
    return _fit_with_forces(expansion, problem, expansion.find_best_without(dropped, expansion.inflation))


def _fit_with_forces(expansion: DiscrepancyExpansion, problem: Problem, best: Discrepancy) -> tuple[Fit, float] | None:
    """Return the fit of a problem with the smooth forces of a discrepancy and free known values, and its penalty."""
    chosen = [group for group, (_, option) in zip(expansion.groups, best.chosen, strict=True) if option >= 0]
    known = _free_known_values(problem)
    if not chosen and not known:
        return None
    trials = []
    for share in SHARES:
        wrong = [replace(f, start=f.mean + share * float(best.mean[i])) for i, f in enumerate(known)]
        trial = problem.extend(wrong, ())
        for group in chosen:
            count = find_term(problem, group.name)[0].count  # type: ignore[attr-defined]
            rows = np.zeros((2, count))
            rows[:, : group.columns.stop - group.columns.start] = best.widths[group.columns], best.mean[group.columns]
            trial = add_curve(trial, group.name, rows[0], share * rows[1])
        trials.append(trial)
    log_densities = [trial.log_posterior(trial.clip(trial.start)) for trial in trials]
    best_start = int(np.argmax(np.where(np.isnan(log_densities), -np.inf, log_densities)))
    return maximise(trials[best_start], rounds=ROUNDS_SMOOTH if chosen else ROUNDS_KNOWN, tolerance=0.3), PENALTY * len(
        chosen
    )


def _compute_derivatives(wider: Problem, slopes: Sensitivity, steps: Array) -> tuple[Array, Array]:
    """Return the derivatives (count, readings) of errors and variances with respect to the additional coordinates."""
    own = len(slopes.theta)
    zero = np.concatenate([slopes.theta, [f.start for f in wider.free[own:]]])
    seen = wider.filter_many(np.vstack([zero[None], zero + np.eye(len(zero))[own:] * steps[:, None]]))
    above = np.where(seen.finite[1:], np.arange(1, len(seen)), 0)
    errors = (seen.errors[above] - seen.errors[0]) / steps[:, None]
    return errors, (seen.variances[above] - seen.variances[0]) / steps[:, None]


def _free_known_values(problem: Problem) -> list[FreeParameter]:
    """Return the positive known values of the model as free parameters (in their logarithm)."""
    estimated, found = {f.parameter for f in problem.free}, []
    for param in problem.system.model.params:
        value = float(problem.known[problem.system.index[param.name]])
        if param.name not in estimated and 0.0 < value < math.inf:
            at, sd = math.log(value), problem.settings.rival.known
            found.append(FreeParameter(param.name, "", at, at - 1.0, at + 1.0, log=True, mean=at, sd=sd))
    return found


def _compute_inflation(joint: Sensitivity, own: int, information: Array) -> float:
    """Return the median factor by which the scatter of block scores exceeds that of independent scores; at least 1."""
    blocks = np.array([part.sum(axis=1) for part in np.array_split(joint.scores()[own:], BLOCKS, axis=1)])
    usual = np.diag(information)[own:]
    informative = usual > 0.0
    return (
        max(1.0, float(np.median(blocks.var(axis=0)[informative] * BLOCKS / usual[informative])))
        if informative.any()
        else 1.0
    )
