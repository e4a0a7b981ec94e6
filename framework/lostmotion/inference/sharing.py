"""Comparison of several recordings: whether one value of a parameter holds in all of them.

Each parameter in turn gets a value for each recording, and the model is fitted once more from the shared optimum. The
values are compared by a chi-square test of homogeneity (Cochran, Biometrics 10 (1954) 101-129) with their covariance by
the sandwich of Huber and White, scores summed over blocks, so that correlated residuals are not taken for a difference.
The p-values are corrected for the number of parameters (Holm, Scand. J. Statist. 6 (1979) 65-70).

One parameter that differs makes others that are shared seem to differ. So the one whose values explain most is
released, and the others are tested again.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtrc

from lostmotion.case import SensorSpec
from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, maximise, raise_random_force, restart
from lostmotion.inference.learned import LearnedTerm
from lostmotion.inference.sensitivity import MANY, compute_sensitivity
from lostmotion.inference.setup import separate_levels
from lostmotion.kernels.threads import each
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter, list_keys
from lostmotion.results import Interval
from lostmotion.results.shared_values import PowerOfLevel
from lostmotion.settings import DEFAULT
from lostmotion.settings import SharedSettings as SharedLimits

ROUNDS = 8
RAISED = 3.0
"""The increase of the log random force where a fit without a curve begins."""
BLOCKS, SHORTEST = 40, 10
"""The number of blocks of each recording over which scores are summed, and their least length in readings."""
SAMPLES = 40_000
"""The beginnings of the recordings are compared, with this many samples together."""
FEWER = 10_000
"""The number of samples with learned curves, which add dozens of coefficients to each fit."""


@dataclass(frozen=True)
class Levels:
    """The level of the motion in each recording: rms about the mean of the `drive`, or of the `response`.

    `channel` is the input or the channel whose unit the `values` have.
    """

    of: str
    channel: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class ComparedParameter:
    """A parameter in each recording: `values` with 95 % intervals, their best `common` value, and whether that holds.

    `chi2` with `dof` degrees of freedom tests that; `p` is corrected for the number of parameters. `power` describes
    the dependence of the values on the level, `odd` is the number of the only recording that differs, where there is
    one. `instead` names parameters that would explain the difference as well. `given` says that the case has a value
    for each recording.
    """

    key: str
    values: tuple[Interval, ...]
    common: Interval
    chi2: float
    dof: int
    p: float
    power: PowerOfLevel | None = None
    odd: int | None = None
    instead: tuple[str, ...] = ()
    given: bool = False
    level: float = DEFAULT.shared.level

    @property
    def holds(self) -> bool:
        """Whether one value holds in all recordings."""
        return self.p > self.level

    @property
    def told(self) -> bool:
        """Whether one value holds, or the values go with the level."""
        return self.holds or self.power is not None


@dataclass(frozen=True)
class SharedValues:
    """The comparison of the `recordings` of a fit, parameter by parameter.

    `released` names those with a value for each recording, in that order, while others are tested; `failed` those whose
    fit failed. `dropped` names learned curves that are not needed once the differing parameters are released, `gain` is
    the log evidence that this adds.
    """

    recordings: tuple[str, ...]
    levels: Levels
    parameters: Mapping[str, ComparedParameter]
    released: tuple[str, ...] = ()
    failed: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()
    gain: float = 0.0


@dataclass(frozen=True)
class SeparateFit:
    """A fit in which a parameter has a value for each recording: coordinates (recordings,), their covariance."""

    key: str
    fit: Fit
    free: FreeParameter
    at: Array
    covariance: Array
    given: bool


def compare_recordings(fit: Fit) -> SharedValues | None:
    """Return the comparison of the recordings of a fit; None where there is one recording.

    Each recording has noise levels of its own. Learned curves are shared and refitted; values are also compared without
    them, since a curve may imitate a difference, and the alternative with the larger evidence is returned.
    """
    if len(fit.posterior.observations) < 2:
        return None
    compared = _fit_beginnings(fit)
    courses = [_release_parameters(separate_levels(compared, SensorSpec()))]
    if curves := list_curves(fit.posterior):
        plain = compared.posterior
        for key in curves:
            plain = plain.remove_term(key, fit.values)
        bare, evidence = _release_parameters(
            separate_levels(maximise(plain, raise_random_force(plain, plain.space.start, RAISED)), SensorSpec())
        )
        courses.append((replace(bare, dropped=curves), evidence))
    return max(courses, key=lambda course: course[1])[0]


def _release_parameters(shared: Fit) -> tuple[SharedValues, float]:
    """Return the comparison of recordings, and the log evidence of the fit with the differing parameters released."""
    base, limits = shared, shared.posterior.settings.shared
    observations, tested = base.posterior.observations, _list_tested(base.posterior)
    levels = measure_levels(observations, limits.spread)
    found: dict[str, ComparedParameter] = {}
    released: list[str] = []
    for turn in range(int(limits.most_own) + 1):
        rest = [key for key in tested if key not in found]
        apart = {one.key: one for one in _fit_each_separately(base, rest)}
        tests = _test_parameters(apart, levels, limits)
        own = _select_best(apart, tests)
        if turn == int(limits.most_own) or own is None:
            found |= tests
            break
        found[own.key] = tests[own.key]
        released.append(own.key)
        base = own.fit
    gain = base.log_evidence - shared.log_evidence
    values = {key: found[key] for key in tested if key in found}
    failed = tuple(key for key in tested if key not in found)
    names = tuple(observation.name for observation in observations)
    return SharedValues(names, levels, values, tuple(released), failed, gain=gain), base.log_evidence


def list_curves(posterior: Posterior) -> tuple[str, ...]:
    """Return the keys of the learned curves that act in a posterior."""
    terms = zip(posterior.system.keys, posterior.system.terms, strict=True)
    return tuple(key for key, term in terms if isinstance(term, LearnedTerm) and key in posterior.active)


def _fit_beginnings(fit: Fit) -> Fit:
    """Return the fit on the beginnings of its recordings, as a posterior that starts at its maximum."""
    posterior = restart(fit)
    samples = SAMPLES if len(posterior.space.free) <= MANY else FEWER
    most = max(samples // len(posterior.observations), 1)
    if all(o.samples <= most for o in posterior.observations):
        return replace(fit, posterior=posterior)
    return maximise(posterior.on(tuple(o.part(0, min(o.samples, most)) for o in posterior.observations)), rounds=ROUNDS)


def _list_tested(posterior: Posterior) -> tuple[str, ...]:
    """Return the names of the parameters that are compared: no noise levels, no coefficients of learned curves."""
    curves = list_curves(posterior)
    names = [f.parameter for f in posterior.space.free if f.physical]
    return tuple(dict.fromkeys(name for name in names if name.rpartition(".")[0] not in curves))


def measure_levels(observations: Sequence[Observation], spread: float = DEFAULT.shared.spread) -> Levels:
    """Return the level of the motion in each recording; of the drive, where that differs between recordings."""
    first = observations[0]
    if not any(observation.free for observation in observations):
        drives = tuple(float(np.nanstd(observation.excitation)) for observation in observations)
        if min(drives) > 0.0 and max(drives) > spread * min(drives):
            return Levels("drive", first.driven[0] if first.driven else "force", drives)
    return Levels("response", first.channel, tuple(float(np.nanstd(o.response)) for o in observations))


def _fit_each_separately(base: Fit, keys: Sequence[str]) -> list[SeparateFit]:
    """Return the fits in which one parameter after the other has a value for each recording."""
    single, jobs = replace(base, posterior=replace(base.posterior, jobs=1)), base.posterior.jobs
    found = each(lambda key: fit_separately(single, key), keys, jobs)
    return [one for one in found if one is not None]


def fit_separately(base: Fit, key: str) -> SeparateFit | None:
    """Return the fit in which a parameter has a value for each recording, from a base where all else is shared.

    None where it diverges. Where the case has a value for each recording already, it is the base itself.
    """
    posterior = restart(base)
    index = next(i for i, f in enumerate(posterior.space.free) if f.parameter == key)
    free, names = posterior.space.free[index], [observation.name for observation in posterior.observations]
    fit = base
    if free.recording is None:
        own = [replace(free, key=name) for name in list_keys(key, names)]
        split = posterior.over((*posterior.space.free[:index], *own, *posterior.space.free[index + 1 :]))
        fit = maximise(split, rounds=ROUNDS)
        if fit.status == "diverged":
            return None
    columns = [fit.posterior.space.keys.index(name) for name in list_keys(key, names)]
    return SeparateFit(
        key,
        fit,
        replace(free, key=key),
        fit.theta[columns],
        compute_covariance(fit, columns),
        free.recording is not None,
    )


def compute_covariance(fit: Fit, columns: Sequence[int]) -> Array:
    """Return the robust covariance (columns, columns) of some coordinates of a fit of several recordings.

    It is the sandwich, with scores summed over blocks of each recording, and in no direction less than the usual one.
    """
    slopes = compute_sensitivity(fit.posterior, fit.theta, fit.local.steps)
    usual = fit.local.covariance
    sandwich = usual @ _compute_scatter(slopes.scores(), fit.posterior.observations) @ usual
    kept = np.ix_(columns, columns)
    return widen_covariance(usual[kept], sandwich[kept])


def _compute_scatter(scores: Array, observations: Sequence[Observation]) -> Array:
    """Return the covariance (n, n) of the sum of scores (n, readings), from blocks about the mean of each recording."""
    scatter, begin = np.zeros((len(scores), len(scores))), 0
    for observation in observations:
        long = observation.readings.size
        count = max(2, min(BLOCKS, long // SHORTEST))
        edges = np.linspace(begin, begin + long, count + 1).astype(int)[:-1]
        sums = np.add.reduceat(scores[:, : begin + long], edges, axis=1)
        sums -= sums.mean(axis=1, keepdims=True)
        scatter += sums @ sums.T * count / (count - 1.0)
        begin += long
    return scatter


def widen_covariance(usual: Array, sandwich: Array) -> Array:
    """Return a covariance (n, n) that is the `sandwich`, but in no direction less than the `usual` one."""
    sd = np.sqrt(np.maximum(np.diag(usual), 1e-300))
    values, vectors = np.linalg.eigh(usual / np.outer(sd, sd))
    root = vectors * np.sqrt(np.maximum(values, 1e-12))
    inverse = vectors / np.sqrt(np.maximum(values, 1e-12))
    ratio, turned = np.linalg.eigh(inverse.T @ (sandwich / np.outer(sd, sd)) @ inverse)
    wide = root @ turned * np.sqrt(np.maximum(ratio, 1.0))
    return np.asarray(np.outer(sd, sd) * (wide @ wide.T))


def compute_homogeneity(values: Array, covariance: Array) -> float:
    """Return the chi-square (n - 1 degrees of freedom) of values (n,) about their best common value."""
    left, ones = np.asarray(values, dtype=float), np.ones(len(values))
    weights = np.linalg.solve(covariance, ones)
    left = left - float(weights @ left) / float(weights @ ones)
    return float(left @ np.linalg.solve(covariance, left))


def adjust_by_holm(p: Sequence[float]) -> list[float]:
    """Return p-values corrected for their number, by Holm's method."""
    order, adjusted, largest = np.argsort(p), [0.0] * len(p), 0.0
    for rank, i in enumerate(order):
        largest = max(largest, min(1.0, (len(p) - rank) * float(p[i])))
        adjusted[i] = largest
    return adjusted


def fit_power(
    values: Array, covariance: Array, levels: Array, limits: SharedLimits = DEFAULT.shared
) -> PowerOfLevel | None:
    """Return the power of the levels (n,) that exp(values), (n,), follow, where a straight line of logarithms fits.

    None for fewer than three values, equal levels, or a poor fit.
    """
    if len(values) < 3 or not np.all(levels > 0.0) or not np.max(levels) > limits.spread * np.min(levels):
        return None
    rows = np.stack([np.ones(len(levels)), np.log(levels)])
    weighted = np.linalg.solve(covariance, rows.T)
    spread = np.linalg.inv(rows @ weighted)
    line = spread @ (weighted.T @ values)
    left = values - line @ rows
    p = float(chdtrc(len(values) - 2, max(float(left @ np.linalg.solve(covariance, left)), 0.0)))
    exponent, error = float(line[1]), math.sqrt(spread[1, 1])
    known = limits.exponent * error < abs(exponent) <= limits.steepest
    return PowerOfLevel(exponent, error, p) if p > limits.fits and known else None


def find_odd_recording(values: Array, covariance: Array, fits: float = DEFAULT.shared.fits) -> int | None:
    """Return the number of the only recording that differs, where the others agree; None where it is not one alone."""
    if len(values) < 3:
        return None
    rest = [np.delete(np.arange(len(values)), i) for i in range(len(values))]
    chi2 = [compute_homogeneity(values[kept], covariance[np.ix_(kept, kept)]) for kept in rest]
    good = [i for i, value in enumerate(chi2) if chdtrc(len(values) - 2, value) > fits]
    return good[0] if len(good) == 1 else None


def _test_parameters(
    apart: Mapping[str, SeparateFit], levels: Levels, limits: SharedLimits
) -> dict[str, ComparedParameter]:
    """Return the test of each parameter, with p-values corrected for the number of them."""
    loose = {key: one.covariance + _make_tolerance(one, limits.alike) for key, one in apart.items()}
    chi2 = {key: compute_homogeneity(one.at, loose[key]) for key, one in apart.items()}
    p = adjust_by_holm([float(chdtrc(len(apart[key].at) - 1, max(value, 0.0))) for key, value in chi2.items()])
    gains = {key: one.fit.log_likelihood for key, one in apart.items()}
    found = {}
    for (key, one), chance in zip(apart.items(), p, strict=True):
        shared = ComparedParameter(
            key,
            _list_intervals(one),
            _compute_common(one),
            chi2[key],
            len(one.at) - 1,
            chance,
            given=one.given,
            level=limits.level,
        )
        if not shared.holds:
            rivals = [k for k, q in zip(apart, p, strict=True) if k != key and q <= limits.level]
            near = tuple(k for k in rivals if gains[k] > gains[key] - limits.instead)
            power = _fit_power_of_level(one, one.covariance + _make_tolerance(one, limits.vague), levels, limits)
            odd = find_odd_recording(one.at, loose[key], limits.fits) if power is None else None
            shared = replace(shared, power=power, odd=odd, instead=near)
        found[key] = shared
    return found


def _make_tolerance(one: SeparateFit, share: float) -> Array:
    """Return the covariance (recordings, recordings) of a scatter of this share of the values."""
    size = 1.0 if one.free.log else float(np.max(np.abs(one.at)))
    return np.asarray((share * size) ** 2 * np.eye(len(one.at)))


def _fit_power_of_level(
    one: SeparateFit, covariance: Array, levels: Levels, limits: SharedLimits
) -> PowerOfLevel | None:
    """Return the dependence of a parameter on the level; only where each value is known to differ from zero."""
    if one.free.log:
        return fit_power(one.at, covariance, np.array(levels.values), limits)
    sd = np.sqrt(np.diag(covariance))
    if not (np.all(one.at > 2.0 * sd) or np.all(one.at < -2.0 * sd)):
        return None
    return fit_power(np.log(np.abs(one.at)), covariance / np.outer(one.at, one.at), np.array(levels.values), limits)


def _list_intervals(one: SeparateFit) -> tuple[Interval, ...]:
    """Return the value of a parameter in each recording with its 95 % interval."""
    sd = np.sqrt(np.diag(one.covariance))
    return tuple(_make_interval(one.free, at, wide) for at, wide in zip(one.at.tolist(), sd.tolist(), strict=True))


def _compute_common(one: SeparateFit) -> Interval:
    """Return the best common value of a parameter with its 95 % interval."""
    weights = np.linalg.solve(one.covariance, np.ones(len(one.at)))
    total = float(np.sum(weights))
    return _make_interval(one.free, float(weights @ one.at) / total, 1.0 / math.sqrt(total))


def _make_interval(free: FreeParameter, at: float, sd: float) -> Interval:
    """Return the interval of a parameter about a coordinate, within its bounds."""
    median, low, high = (free.value(min(max(at + z * sd, free.low), free.high)) for z in (0.0, -1.96, 1.96))
    return Interval(float(median), float(low), float(high), free.unit)


def _select_best(apart: Mapping[str, SeparateFit], tests: Mapping[str, ComparedParameter]) -> SeparateFit | None:
    """Return the fit that explains most among those whose values differ; None where one value holds for all."""
    differ = [one for key, one in apart.items() if not tests[key].holds and not one.given]
    return max(differ, key=lambda one: one.fit.log_likelihood, default=None)
