"""A hypothesis: a set of terms with its discrepancy, fitted together, and one number for it.

    score = [log Z(fitted data | model + terms + discrepancy) + log p(held-out data | fitted data)] / temper - price

The fit is Gauss-Newton on own parameters, known values, coefficients of smooth forces and errors of channels together.
One-step errors are nearly linear in all but the first, so a few rounds suffice. In each round the size and the length
of each smooth force are those of the largest evidence.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from lostmotion.contracts import Array
from lostmotion.evidence.discrepancy import Choice, JointFrame, Quadratic
from lostmotion.evidence.expansion import Curvature, Expansion
from lostmotion.inference.fit import STRIDE
from lostmotion.inference.natural import find_term, sort_slots
from lostmotion.inference.penalties import is_simpler
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import Slot

UNKNOWN = "unknown"
"""The name of a smooth force that is larger than the usual discrepancy, among the terms of a set."""
WAVE = ("cosine", "sine")
"""The names of the two amplitudes of a wave."""
ROUNDS, TOLERANCE = 10, 0.4
"""The largest number of rounds, and the gain in log posterior below which a fit has converged."""
SHARES = (0.4, 0.1, 0.02)
"""Shares of a Gauss-Newton step that are tried where the whole step does not gain."""
REACHES = (1.0, 3.0, 9.0)
"""The multiples of the step of noise levels that are tried."""
MOST_LOG, MOST_LEVEL = 1.5, 4.0
"""The largest change of a logarithm in one step: of a parameter, and of a noise level."""


@dataclass(frozen=True)
class Hypothesis:
    """The fit of a set of terms with its discrepancy, in the coordinates of a `frame`.

    `at` (count,) is the maximum of the posterior, `choice` the option of each smooth force there, `log_evidence` the
    log marginal likelihood of the fitted data, and `smooth` the part of it that smooth forces add. `price` are the log
    prior odds against the set, `heldout` is the log density of the held-out data.
    """

    frame: JointFrame
    expansion: Expansion
    choice: Choice
    log_evidence: float
    smooth: float
    price: float
    heldout: float = 0.0
    converged: bool = True
    unknown: bool = False

    @property
    def at(self) -> Array:
        """The coordinates (count,) of the maximum."""
        return self.expansion.at

    @property
    def terms(self) -> frozenset[str]:
        """The keys of the terms of the library, and `UNKNOWN` for an unknown force beside them."""
        return self.frame.terms | ({UNKNOWN} if self.unknown else frozenset())

    @cached_property
    def scatter(self) -> float:
        """The factor by which block sums of scores scatter beyond their information; at least 1."""
        return self.expansion.measure_scatter(tuple(force.key for force in self.frame.forces))

    def score(self, temper: float = 1.0) -> float:
        """Return the log posterior weight: the log evidence of all data over the temper, less the price."""
        return (self.log_evidence + self.heldout) / temper - self.price

    @property
    def log_profile(self) -> float:
        """The log evidence of all data at the maximum of own coordinates, without the widths of their priors."""
        free = self.frame.posterior.space.free[: self.frame.own]
        prior = sum(f.log_prior(float(at)) for f, at in zip(free, self.theta, strict=True))
        occam = 0.5 * float(np.linalg.slogdet(2.0 * math.pi * self.covariance)[1])
        return self.log_evidence + self.heldout - prior - occam

    @property
    def theta(self) -> Array:
        """The own coordinates at the maximum."""
        return self.at[: self.frame.own]

    @property
    def values(self) -> dict[str, float]:
        """The coordinates by name."""
        return dict(zip(self.frame.names, map(float, self.at), strict=True))

    @cached_property
    def joint_covariance(self) -> Array:
        """The posterior covariance (used, used) of the free coordinates."""
        return solve_scaled(self.precision, np.eye(len(self.used)))

    @property
    def covariance(self) -> Array:
        """The posterior covariance (own, own) of the own coordinates, with the discrepancy integrated."""
        return self.joint_covariance[: self.frame.own, : self.frame.own]

    @property
    def used(self) -> NDArray[np.intp]:
        """The indices of the coordinates that are free."""
        return _list_used(self.frame, self.choice)

    @cached_property
    def precision(self) -> Array:
        """The posterior precision (used, used) of the free coordinates."""
        prior = _compute_precision(self.frame, self.expansion.precision, self.choice)
        return np.asarray(self.expansion.information[np.ix_(self.used, self.used)] + np.diag(prior[self.used]))

    @cached_property
    def pull(self) -> Array:
        """The gradient (used,) of the log posterior over the free coordinates: close to zero, but for bounds."""
        prior = _compute_precision(self.frame, self.expansion.precision, self.choice)
        return _compute_pull(self.frame, self.expansion, prior)[self.used]


def list_vague(found: Hypothesis, key: str) -> list[str]:
    """Return the amplitudes of a term, by the name of the parameter, whose 95 % region contains zero.

    Those of a wave are one amplitude (`group_amplitudes`).
    """
    free = found.frame.posterior.space.free[: found.frame.own]
    places = {f.key: i for i, f in enumerate(free) if not f.log}
    slots = [s for s in sort_slots(found.frame.posterior, key)[0] if s.key in places]
    rows = [[slots[k] for k in group] for group in group_amplitudes(found.frame.posterior, key, slots)]
    return [
        " and ".join(s.param.name for s in row)
        for row in rows
        if _is_vague(found, [places[s.key] for s in row], [s.param.null or 0.0 for s in row])
    ]


def group_amplitudes(posterior: Posterior, key: str, amplitudes: Sequence[Slot]) -> list[list[int]]:
    """Return the indices of the amplitudes that tell a term from other laws: each alone, those of a wave together.

    Which of the cosine and the sine of a wave is small depends on the phase alone. Of a law that contains simpler ones,
    those count that the simpler ones lack, if there are any.
    """
    term, _ = find_term(posterior, key)
    shared = {param.name for other in posterior.system.terms if is_simpler(other, term) for param in other.params}
    own = [k for k, s in enumerate(amplitudes) if s.param.name not in shared] or list(range(len(amplitudes)))
    waves = [k for k in own if amplitudes[k].param.name in WAVE]
    return [[k] for k in own if k not in waves] + ([waves] if waves else [])


def _is_vague(found: Hypothesis, places: Sequence[int], null: Sequence[float]) -> bool:
    """Return whether the region of 95 % of some own coordinates contains a point: the Wald test, over the scatter."""
    apart = found.theta[list(places)] - np.array(null)
    square = float(apart @ solve_scaled(found.scatter * found.covariance[np.ix_(places, places)], apart))
    return square < float(chi2.ppf(0.95, len(apart)))


def fit_hypothesis(
    frame: JointFrame, begin: Array, price: float, choice: Choice | None = None, *, free: bool = True
) -> Hypothesis:
    """Return the hypothesis of a frame, fitted from coordinates `begin` (count,) with the smooth forces of `choice`.

    With `free` they are chosen again in each round; else they stay.
    Without a choice, errors of channels and known values are fitted first, and then smooth forces beside them: what
    both explain is not left to the more flexible one because of the point where the fit began. Smooth forces that make
    the evidence smaller are left out.
    """
    begin = begin.copy()
    begin[frame.own :][frame.widths(choice or frame.none) == 0.0] = 0.0
    expansion = frame.expand(begin, frame.first_steps, choice or frame.none)
    made = []
    if choice is None:
        expansion, choice, converged = _maximise(frame, expansion, frame.none, free=False)
        made.append(_make_hypothesis(frame, expansion, choice, price, converged=converged))
    expansion, choice, converged = _maximise(frame, expansion, choice, free=free)
    made.append(_make_hypothesis(frame, expansion, choice, price, converged=converged))
    return max(made, key=lambda one: one.log_evidence)


def _make_hypothesis(
    frame: JointFrame, expansion: Expansion, choice: Choice, price: float, *, converged: bool
) -> Hypothesis:
    """Return the hypothesis at the point of an expansion, with its log evidence."""
    quadratic = Quadratic.of(frame, expansion.curvature)
    smooth = quadratic.evaluate(choice) - quadratic.evaluate(frame.none)
    evidence = _compute_log_evidence(frame, expansion, choice)
    return Hypothesis(frame, expansion, choice, evidence, smooth, price, converged=converged)


def _maximise(frame: JointFrame, expansion: Expansion, choice: Choice, *, free: bool) -> tuple[Expansion, Choice, bool]:
    """Return the maximum of the log posterior near a point, its smooth forces, and whether the fit converged.

    With `free` the smooth forces are chosen in each round, until one that seemed superfluous is missed without it.
    """
    for turn in range(ROUNDS):
        if free:
            quadratic = Quadratic.of(frame, expansion.curvature)
            new, _ = quadratic.choose(choice) if turn else quadratic.choose_anew(choice)
            fewer = tuple(one if other >= 0 else -1 for one, other in zip(choice, new, strict=True))
            less = _leave_out_absent(frame, expansion, fewer)
            if less is not expansion:
                told = _compute_log_evidence(frame, expansion, choice)
                free = _compute_log_evidence(frame, less, fewer) > told
            if free:
                expansion, choice = less, new
        step, promise = compute_step(frame, expansion, choice)
        value = _compute_log_posterior(frame, expansion, choice)
        if promise < TOLERANCE:
            return expansion, choice, True
        better = _climb(frame, expansion, step, choice)
        if better is None:
            return expansion, choice, promise < 4.0 * TOLERANCE
        expansion = better
        if _compute_log_posterior(frame, better, choice) - value < TOLERANCE:
            return expansion, choice, True
    return expansion, choice, False


def _leave_out_absent(frame: JointFrame, expansion: Expansion, choice: Choice) -> Expansion:
    """Return an expansion without the smooth forces that a choice leaves out; unchanged where there were none.

    Likelihood and evidence belong to the same forces. The point is the better one of the whole step and of the present
    one with the coefficients of these forces at zero.
    """
    absent = np.flatnonzero(frame.widths(choice) == 0.0) + frame.own
    if not np.any(expansion.at[absent]):
        return expansion
    here, steps = expansion.at.copy(), _tune_steps(frame, expansion)
    here[absent] = 0.0
    there = expansion.at + compute_step(frame, expansion, choice)[0]
    at = max(here, there, key=lambda one: _add_priors(frame, one, frame.log_likelihood(one, choice), choice))
    return frame.expand(at, steps, choice)


def _tune_steps(frame: JointFrame, expansion: Expansion) -> Array:
    """Return finite-difference steps (own,) of a share of conditional standard deviations, within bounds."""
    free = frame.posterior.space.free[: frame.own]
    widths = np.array([min(f.sd, f.high - f.low) for f in free])
    curvature = np.maximum(np.diag(expansion.information)[: frame.own], 1e-300)
    return np.clip(STRIDE / np.sqrt(curvature), 1e-9 * widths, 0.05 * widths)


def _list_used(frame: JointFrame, choice: Choice) -> NDArray[np.intp]:
    """Return the indices of the coordinates that are free: own ones, and those of the discrepancy with a width."""
    return np.concatenate([np.arange(frame.own), frame.more[frame.widths(choice) > 0.0]])


def _compute_precision(frame: JointFrame, precision: Array, choice: Choice) -> Array:
    """Return the prior precision (count,) of all coordinates; zero where a coordinate is not used."""
    widths, found = frame.widths(choice), precision[: frame.count].copy()
    found[frame.own :] = np.where(widths > 0.0, 1.0 / np.where(widths > 0.0, widths, 1.0) ** 2, 0.0)
    return found


def solve_posterior(
    frame: JointFrame, curvature: Curvature, choice: Choice, held: NDArray[np.intp], moved: Array | None = None
) -> Array:
    """Return the step (n,) to the maximum of the quadratic posterior.

    `held` coordinates change by those of `moved` (n,), or stay. Coefficients of smooth forces that are absent go to
    zero. Coordinates beyond those of the frame are amplitudes of terms with the prior of the curvature.
    """
    at, n = curvature.at, len(curvature.at)
    precision, middle = curvature.precision.copy(), curvature.middle.copy()
    precision[: frame.count] = _compute_precision(frame, curvature.precision, choice)
    middle[frame.own : frame.count] = frame.middle
    present = np.append(_list_used(frame, choice), np.arange(frame.count, n))
    used, gone = np.setdiff1d(present, held), np.setdiff1d(np.arange(frame.own, n), present)
    step = np.zeros(n)
    step[held] = 0.0 if moved is None else moved[held]
    step[gone] = -at[gone]
    rest = np.setdiff1d(np.arange(n), used)
    pulled = (curvature.gradient - precision * (at - middle))[used]
    pulled -= curvature.information[np.ix_(used, rest)] @ step[rest]
    inner = curvature.information[np.ix_(used, used)] + np.diag(precision[used])
    step[used] = solve_scaled(inner + 1e-6 * np.diag(np.diag(inner)), pulled)
    return step


def compute_step(frame: JointFrame, expansion: Expansion, choice: Choice) -> tuple[Array, float]:
    """Return the step (count,) to the maximum of the quadratic posterior within the bounds, and its predicted gain.

    Logarithms change by a limited amount.
    """
    precision = _compute_precision(frame, expansion.precision, choice)
    gradient = _compute_pull(frame, expansion, precision)
    low, high = _limit_step(frame, expansion.at)
    curvature = expansion.curvature
    step = solve_within(lambda held, moved: solve_posterior(frame, curvature, choice, held, moved), gradient, low, high)
    curved = float(step @ expansion.information @ step) + float(np.sum(precision * step**2))
    return step, float(gradient @ step) - 0.5 * curved


def solve_within(solve: Callable[[NDArray[np.intp], Array], Array], gradient: Array, low: Array, high: Array) -> Array:
    """Return the step (n,) to the maximum of a quadratic function between `low` and `high`, each (n,), by active sets.

    `solve(held, moved)` returns the step that maximises it while the coordinates `held` change by those of `moved`. One
    that is pressed against its bound by the `gradient` (n,) stays; one that would go beyond a bound goes there, and the
    others are optimised given this: a step that is cut off afterwards may be one in the wrong direction.
    """
    held = np.flatnonzero(((low >= 0.0) & (gradient < 0.0)) | ((high <= 0.0) & (gradient > 0.0)))
    step = solve(held, np.zeros(len(gradient)))
    while len(beyond := np.flatnonzero((step < low) | (step > high))):
        held = np.union1d(held, beyond)
        step = solve(held, np.clip(step, low, high))
    return step


def maximise_within(gradient: Array, precision: Array, low: Array, high: Array) -> Array:
    """Return the step (n,) between `low` and `high` to the maximum of gradient's - s'Q s / 2 with the `precision` Q."""

    def solve(held: NDArray[np.intp], moved: Array) -> Array:
        found, rest = moved.copy(), np.setdiff1d(np.arange(len(gradient)), held)
        told = gradient[rest] - precision[np.ix_(rest, held)] @ moved[held]
        found[rest] = np.linalg.solve(precision[np.ix_(rest, rest)], told)
        return found

    return solve_within(solve, gradient, np.minimum(low, 0.0), np.maximum(high, 0.0))


def _limit_step(frame: JointFrame, at: Array) -> tuple[Array, Array]:
    """Return the lowest and the highest change (count,) of coordinates in one step; zero is within."""
    low, high = (np.asarray(bound - at) for bound in frame.bounds)
    for i, f in enumerate(frame.posterior.space.free[: frame.own]):
        if f.log or f.key.startswith("log_"):
            most = MOST_LOG if f.physical else MOST_LEVEL
            low[i], high[i] = max(low[i], -most), min(high[i], most)
    return np.minimum(low, 0.0), np.maximum(high, 0.0)


def _compute_pull(frame: JointFrame, expansion: Expansion, precision: Array) -> Array:
    """Return the gradient (count,) of the log posterior over all coordinates."""
    middle = np.concatenate([expansion.middle[: frame.own], frame.middle])
    return np.asarray(expansion.gradient - precision * (expansion.at - middle))


def _compute_log_posterior(frame: JointFrame, expansion: Expansion, choice: Choice) -> float:
    """Return the log posterior up to a constant, at the point of an expansion."""
    return _add_priors(frame, expansion.at, float(expansion.here.log_likelihood), choice)


def _add_priors(frame: JointFrame, at: Array, log_likelihood: float, choice: Choice) -> float:
    """Return a log-likelihood of the filter with the log prior of all coordinates."""
    widths = frame.widths(choice)
    used = widths > 0.0
    away = (at[frame.own :] - frame.middle)[used] / widths[used]
    own = sum(f.log_prior(float(c)) for f, c in zip(frame.posterior.space.free[: frame.own], at, strict=False))
    return log_likelihood + own - 0.5 * float(away @ away)


def _climb(frame: JointFrame, expansion: Expansion, step: Array, choice: Choice) -> Expansion | None:
    """Return the expansion after the best whole step, or after the largest share of it that gains; None without any.

    Whole steps differ in how far noise levels go: the information about a level that is too high is too large, and its
    steps are too short.
    """
    at, steps, value = expansion.at, _tune_steps(frame, expansion), _compute_log_posterior(frame, expansion, choice)
    whole = np.clip([at + step * np.where(frame.levels, reach, 1.0) for reach in REACHES], *frame.bounds)
    gained = [_add_priors(frame, *one, choice) for one in zip(whole, frame.log_likelihood(whole, choice), strict=True)]
    if max(gained) > value:
        return frame.expand(whole[int(np.argmax(gained))], steps, choice)
    for share in SHARES:
        trial = at + share * step
        if _add_priors(frame, trial, frame.log_likelihood(trial, choice), choice) > value:
            return frame.expand(trial, steps, choice)
    return None


def _compute_log_evidence(frame: JointFrame, expansion: Expansion, choice: Choice) -> float:
    """Return the log marginal likelihood by Laplace's method, all coordinates of the discrepancy integrated."""
    widths = frame.widths(choice)
    used = _list_used(frame, choice)
    precision = _compute_precision(frame, expansion.precision, choice)
    inner = expansion.information[np.ix_(used, used)] + np.diag(precision[used])
    sign, logdet = np.linalg.slogdet(inner)
    if sign <= 0:
        return -math.inf
    value = _compute_log_posterior(frame, expansion, choice)
    occam = 0.5 * frame.own * math.log(2.0 * math.pi) - 0.5 * float(logdet)
    return value + occam - float(np.sum(np.log(widths[widths > 0.0]))) - frame.price(choice)
