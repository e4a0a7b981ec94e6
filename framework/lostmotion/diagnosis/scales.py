"""A column whose scale does not fit the model: a wrong unit, a sign, or a gear ratio, found before terms are searched.

Such an error leaves a missing force as large as the drive or larger, for which some term of the library always stands.
Where that much is missing, the nominal model is fitted again with each input and each sensor multiplied by the usual
factors between units, by -1, and by the ratio of two measured positions. A factor that removes most of the missing
force is said in the first line of the result. A sign may be wrong beside a law that the model lacks, so that no factor
removes the missing force: then power that flows from the machine to its drive tells it, whatever law is missing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from lostmotion.case import CaseFile
from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.inference.fit import Fit
from lostmotion.inference.setup import make_posterior, search_maximum
from lostmotion.likelihood.latent import smooth_latent_force
from lostmotion.likelihood.observation import Observation, find_harmonic
from lostmotion.quantities import quantity_of
from lostmotion.recording import Recording
from lostmotion.recording.warnings import BACKWARD
from lostmotion.results import percent, rounded
from lostmotion.results.expectation import WrongScale

LARGE = 0.4
"""The rms of the missing force, as a share of the amplitude of the drive, from which scales are tried: where the drive
seems to do nothing, all of it is missing, which is 0.7."""
LEFT = 0.2
"""The share of the missing force, of its drive, that may be left with another scale."""
GAIN = 50.0
"""The least gain in log-likelihood: a hundred thousand recordings would not give it by chance for one factor."""
RATIO = 1.5
"""Positions whose amplitudes differ by more than this factor may be those of both sides of a gear."""
CLEAR = 10.0
"""The gain in log-likelihood by which a ratio has to be better than a factor between two usual units."""
WIDE, STEPS, SEED = 0.5, 16, 0
"""The natural logarithm by which a ratio is changed at most, the greatest number of fits, and their seed."""
GEAR = "the ratio of a gear"
RADIAN, RPM, GRAVITY = 180.0 / math.pi, 30.0 / math.pi, 9.80665
Reading = tuple[float, str]
"""A factor, and what it says."""


@dataclass(frozen=True)
class _Scaled:
    """A channel (an input, or a sensor, by its number) with a factor, and what the factor says."""

    sensor: bool
    number: int
    factor: float
    says: str

    def apply(self, observation: Observation) -> Observation:
        """Return the recording with the channel multiplied by the factor; a base velocity goes with its position."""
        if self.sensor:
            readings = observation.readings.copy()
            readings[:, self.number] *= self.factor
            return replace(observation, readings=readings, begun=None)
        inputs, columns = observation.inputs.copy(), [self.number]
        if self.number == observation.lead and observation.slope is not None:
            columns.append(observation.slope)
        inputs[:, columns] *= self.factor
        scaled = replace(observation, inputs=inputs, begun=None)
        return replace(scaled, harmonic=find_harmonic(scaled))

    def measure(self, observations: Sequence[Observation]) -> float:
        """Return what the log-likelihood of the scaled readings gains by their unit alone."""
        if not self.sensor:
            return 0.0
        taken = sum(int(np.isfinite(one.readings[:, self.number]).sum()) for one in observations)
        return -taken * math.log(abs(self.factor))


@dataclass(frozen=True)
class _Trial:
    """A scale that was tried: the gain in log-likelihood, and the missing force as a share of the drive.

    Only the missing force of a gain that is large enough is measured; others are infinite.
    """

    scaled: _Scaled
    gain: float
    missing: float


def find_wrong_scales(nominal: Fit, case: CaseFile, rng: np.random.Generator) -> tuple[WrongScale, ...]:
    """Return the columns whose scale does not fit the model, with their factors; none where nothing repairs it.

    `nominal` is the fit of the model alone. Free motions have no drive to compare with, and are not examined.
    """
    observations = nominal.posterior.observations
    if observations[0].free or not (before := _measure_missing(nominal)) > LARGE:
        return ()
    tried = [_try_scale(nominal, case, scaled, rng.spawn(1)[0]) for scaled in _list_scales(nominal)]
    for ratio in _list_ratios(nominal):
        tried.append(_refine_ratio(nominal, case, ratio, SEED))
    good = [one for one in tried if one.missing < LEFT * before and one.gain > GAIN]
    if not good:
        return ()
    best = max(good, key=lambda one: one.gain)
    usual = [one for one in good if one.scaled.says != GEAR and one.gain > best.gain - CLEAR]
    return tuple(
        WrongScale(
            column=_find_column(one.scaled, case, observations[0]),
            factor=float(one.scaled.factor),
            says=one.scaled.says,
            left=float(one.missing / before),
        )
        for one in sorted(usual or [best], key=lambda one: -one.gain)
    )


def describe_wrong_scales(wrong: Sequence[WrongScale]) -> tuple[str, ...]:
    """Return a sentence on the columns whose scale does not fit the model; none where there are none."""
    if not wrong:
        return ()
    ways = ", or ".join(map(_describe_scale, wrong))
    return (
        f"The scale of a column does not fit the model: {ways} leaves {percent(wrong[0].left)} of the missing force."
        " Check units, signs and gear ratio before the findings below.",
    )


def describe_wrong_sign(recordings: Iterable[Recording]) -> tuple[str, ...]:
    """Return a sentence on a recording in which power flows from the machine to its drive; none for all others."""
    for recording in recordings:
        for note in recording.notes:
            if note.startswith(BACKWARD):
                return (f"The sign of a column is wrong: {note}. Check it before the findings below.",)
    return ()


def _try_scale(nominal: Fit, case: CaseFile, scaled: _Scaled, rng: np.random.Generator) -> _Trial:
    """Return the fit of the model with a channel multiplied by a factor."""
    posterior, observations = nominal.posterior, nominal.posterior.observations
    changed = make_posterior(
        posterior.system, case, tuple(map(scaled.apply, observations)), jobs=posterior.jobs, settings=posterior.settings
    )
    try:
        fit = search_maximum(changed, rng)
        gain = fit.log_likelihood - scaled.measure(observations) - nominal.log_likelihood
        return _Trial(scaled, gain, _measure_missing(fit) if gain > GAIN else math.inf)
    except (np.linalg.LinAlgError, DataError):  # the model diverges with this scale
        return _Trial(scaled, -math.inf, math.inf)


def _refine_ratio(nominal: Fit, case: CaseFile, scaled: _Scaled, seed: int) -> _Trial:
    """Return the trial of the most likely ratio about one that was read from two positions."""
    trials: list[_Trial] = []

    def lose(step: float) -> float:
        changed = replace(scaled, factor=scaled.factor * math.exp(step))
        trials.append(_try_scale(nominal, case, changed, np.random.default_rng(seed)))
        return -trials[-1].gain

    minimize_scalar(lose, bounds=(-WIDE, WIDE), method="bounded", options={"maxiter": STEPS, "xatol": 1e-3})
    return max(trials, key=lambda one: one.gain)


def _measure_missing(fit: Fit) -> float:
    """Return the rms of the missing force of a fit, as a share of the drive; infinite where the fit diverged."""
    with np.errstate(invalid="ignore", over="ignore"):  # a model with a wrong scale may diverge
        missing = smooth_latent_force(fit.posterior.on(fit.posterior.observations[:1]), fit.theta).force
    size = float(np.std(missing)) / fit.posterior.scales.force
    return size if math.isfinite(size) else math.inf


def _list_scales(nominal: Fit) -> Iterator[_Scaled]:
    """Yield the channels with each factor that is usual for their quantity."""
    first, model = nominal.posterior.observations[0], nominal.posterior.system.model
    rotates = model.motion == "rotation"
    inputs = [name for name in model.inputs if name in (first.driven or ())]
    for name in inputs:
        for factor, says in _list_factors(name, rotates):
            yield _Scaled(False, model.inputs.index(name), factor, says)
    for number, sensor in enumerate(first.sensors):
        for factor, says in _list_factors(sensor.channel, rotates):
            yield _Scaled(True, number, factor, says)


def _list_ratios(nominal: Fit) -> Iterator[_Scaled]:
    """Yield the ratio of the measured position to the position of a base that drives the machine."""
    first, inputs = nominal.posterior.observations[0], nominal.posterior.system.model.inputs
    if "base_position" in inputs and "base_position" in (first.driven or ()):
        number = inputs.index("base_position")
        if ratio := _find_ratio(first, number):
            yield _Scaled(False, number, ratio, GEAR)


def _list_factors(channel: str, rotates: bool) -> Iterator[Reading]:
    """Yield the factors that repair the usual errors of a channel, and what each says."""
    yield -1.0, "the sign"
    quantity = quantity_of(channel)
    pairs: list[Reading] = [(1e-3, "thousandths of the unit")]
    if quantity == "velocity" and rotates:
        pairs = [(1.0 / RPM, "rpm for rad/s"), (1.0 / RADIAN, "degrees for radians"), (2.0 * math.pi, "turns for rad")]
    elif quantity in ("position", "acceleration") and rotates:
        pairs = [(1.0 / RADIAN, "degrees for radians"), (2.0 * math.pi, "turns for radians")]
    elif quantity == "acceleration":
        pairs += [(GRAVITY, "g for m/s^2")]
    elif quantity == "force":
        pairs += [(GRAVITY, "kgf for N"), (4.448, "lbf for N")]
    else:
        pairs += [(0.0254, "inches for m")]
    for factor, says in pairs:
        wanted, _, found = says.partition(" for ")
        yield factor, f"{wanted} read as {found}" if found else says
        yield 1.0 / factor, f"{found} read as {wanted}" if found else "the unit with a factor of 1000"


def _find_ratio(observation: Observation, base: int) -> float:
    """Return the ratio of the first measured position to the base position; 0 where both have the same size."""
    for number, sensor in enumerate(observation.sensors):
        if quantity_of(sensor.channel) == "position":
            ratio = _compute_slope(observation.inputs[:, base], observation.readings[:, number])
            return ratio if ratio and not 1.0 / RATIO < abs(ratio) < RATIO else 0.0
    return 0.0


def _compute_slope(x: Array, y: Array) -> float:
    """Return the slope of a line through points (n,), of which missing ones are NaN; 0 where x does not change."""
    there = np.isfinite(y)
    a, b = x[there] - x[there].mean(), y[there] - y[there].mean()
    return float(a @ b / (a @ a)) if there.any() and float(a @ a) > 0.0 else 0.0


def _describe_scale(wrong: WrongScale) -> str:
    factor = f"{rounded(wrong.factor, 3)}"
    if abs(wrong.factor) < 1.0:
        factor += f", 1/{rounded(1.0 / abs(wrong.factor), 3)}"
    return f"{wrong.column!r} multiplied by {factor} ({wrong.says})"


def _find_column(scaled: _Scaled, case: CaseFile, observation: Observation) -> str:
    """Return the name of the column in the case, or that of the channel where the case has no files."""
    spec = next((one for one in case.recordings if one.label == observation.name), None)
    if scaled.sensor:
        column = spec.sensors[scaled.number].column if spec else observation.sensors[scaled.number].label
    else:
        target = (observation.driven or ())[0] if scaled.number == observation.lead else ""
        named = [one.column for one in (spec.inputs if spec else ()) if one.target == target]
        column = named[0] if named else target or "the input"
    return column
