"""What kind of motion it is: periodic, quasiperiodic, chaotic or stochastic, weighed from all that was measured."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.results import Estimate
from lostmotion.signals import base_line, refined_period, return_spread, two_tones
from lostmotion.stages.denoise import Denoised
from lostmotion.stages.surrogates import SurrogateTest
from lostmotion.workflow.source import Source

Motion = Literal["periodic", "quasiperiodic", "chaotic", "stochastic", "undecided"]
SLACK, FLOOR, LOUDEST = 1.4, 0.01, 0.2
"""What repeats to within so many times its noise, and a hundredth of its size, is taken to repeat."""
TONES_FLOOR = 0.02
MOST_PERIODS, DRIFT, DRIFT_FLOOR = 16, 1.15, 0.002
SIGNIFICANT, CYCLES = 0.05, "pseudo_periodic"
MOST_LEFT = 0.5
"""Share of the variance that may not repeat in a motion that is called periodic but for fluctuations."""
FEWEST_PERIODS, ENOUGH_PERIODS = 20, 100
FEWEST_VALUES, FEWEST_SAMPLES = 16, 1000
UNEVEN = 2.0
"""Ratio of the standard deviations of two halves from which on a recording is not taken to be steady."""


@dataclass(frozen=True)
class Beat:
    """The period (s) of a motion and where it comes from; a line that keeps its phase is taken for that of a drive."""

    period: float | None
    source: Literal["excitation", "given", "spectrum", "none"]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the verdict is made of."""

    beat: Beat
    raw: Series
    denoised: Denoised
    exponent: Estimate
    dimension: Estimate
    tests: tuple[SurrogateTest, ...]

    @property
    def noise(self) -> float:
        """The upper end of the noise level, as a share of the standard deviation, no more than can pass for noise."""
        high = self.denoised.before.high
        return min(high, LOUDEST) if math.isfinite(high) else 0.0


@dataclass(frozen=True)
class Verdict:
    """The kind of motion, one or two sentences, and the observations it rests on."""

    motion: Motion
    says: str
    because: tuple[str, ...]


def beat_of(x: Array, source: Source, given: float | None) -> Beat:
    """Return the period of the drive: as given, as measured going in, or as the strongest line of the response."""
    if given is not None:
        return Beat(given, "given")
    if source.excitation is not None:
        period = refined_period(source.excitation, source.dt)
        if period is not None and _fits(period, x, source.dt):
            return Beat(period, "excitation")
        return Beat(None, "none", ("The excitation is not periodic: nothing is said about periods.",))
    line = base_line(x, source.dt)
    if line is None or not _fits(line.period, x, source.dt):
        return Beat(None, "none")
    note = f"The period of {line.period:.6g} s was read from the spectrum: give --period if the drive has another one."
    return Beat(line.period, "spectrum", (note,))


def _fits(period: float, x: Array, dt: float) -> bool:
    return 2.0 * dt < period < 0.2 * len(x) * dt


def judged(evidence: Evidence) -> Verdict:
    """Return the verdict on a motion; the first that holds of periodic, quasiperiodic, chaotic and stochastic."""
    for rule in (_periodic, _quasiperiodic, _coarse, _regular, _jittering):
        if found := rule(evidence):
            return found
    return _ruled_or_random(evidence)


def returns(series: Series, period: float, most: int = MOST_PERIODS) -> Array:
    """Return by how much x(t + k period) misses x(t), k = 1 ... `most`, as a share of the standard deviation."""
    return np.asarray(return_spread(series.x, series.dt, period, most=most) / math.sqrt(2.0))


def returned(raw: Series, period: float, noise: float) -> tuple[int, float]:
    """Return after how many periods a motion comes back, to within its noise, and by how much it misses; 0 for never.

    `noise` and the miss are shares of the standard deviation.
    """
    spread = returns(raw, period, 2 * MOST_PERIODS)
    limit = SLACK * noise + FLOOR
    once, twice = spread[:MOST_PERIODS], spread[1::2]
    # Two frequencies nearly return after some periods, and miss by twice as much after twice as many.
    back = np.flatnonzero((once <= limit) & ~(twice > DRIFT * once + DRIFT_FLOOR))
    return (int(back[0]) + 1, float(spread[back[0]])) if len(back) else (0, float(np.nanmin(once)))


def _periodic(evidence: Evidence) -> Verdict | None:
    """Return the verdict if the motion comes back to itself after some periods, to within its noise."""
    period = evidence.beat.period
    if period is None:
        return None
    times, left = returned(evidence.raw, period, evidence.noise)
    if not times:
        return None
    cycle = "each period" if times == 1 else f"every {times} periods"
    noise = f"{100 * left:.2g} %"
    return Verdict(
        "periodic",
        f"The motion repeats itself {cycle} of {period:.4g} s; {noise} of it does not repeat, no more than noise.",
        (f"return after {times} periods: {noise}, noise at most {100 * evidence.noise:.2g} %",),
    )


def _quasiperiodic(evidence: Evidence) -> Verdict | None:
    """Return the verdict if two frequencies and their combinations explain the motion, to within its noise."""
    period, raw = evidence.beat.period, evidence.raw
    if period is None:
        return None
    tones = two_tones(raw.x, raw.dt, 1.0 / period)
    duration = raw.n * raw.dt
    if tones.left > SLACK * evidence.noise + TONES_FLOOR or tones.second * duration < FEWEST_PERIODS:
        return None
    if evidence.exponent.ok and evidence.exponent.low > 0.0:
        return None
    return Verdict(
        "quasiperiodic",
        f"Two frequencies, {1.0 / period:.4g} Hz and {tones.second:.4g} Hz, and their combinations make up the motion; "
        f"{100 * tones.left:.2g} % of it is left, no more than noise.",
        (f"left by two tones: {100 * tones.left:.2g} %, noise at most {100 * evidence.noise:.2g} %",),
    )


def _coarse(evidence: Evidence) -> Verdict | None:
    """Return that nothing can be told if the sensor shows too few values for near states to be told apart."""
    values = len(np.unique(evidence.raw.x))
    if values >= FEWEST_VALUES:
        return None
    says = (
        f"The recording holds {values} different values only, and near states cannot be told apart: "
        f"{FEWEST_VALUES} are wanted, so use a finer sensor or a larger motion."
    )
    return Verdict("undecided", says, ())


def _regular(evidence: Evidence) -> Verdict | None:
    """Return the verdict if near states do not part, the motion is no noise, and it does not come back either."""
    exponent = evidence.exponent
    tested = bool(evidence.tests) and all(t.rejects(SIGNIFICANT) for t in evidence.tests)
    if exponent.status != "regular" or not math.isfinite(exponent.value) or not tested:
        return None
    says = (
        "Near states do not part, and yet no number of periods brings the motion back: "
        f"the exponent is {exponent.value:.2g} {exponent.unit} [{exponent.low:.2g}, {exponent.high:.2g}]."
    )
    return Verdict("quasiperiodic", says, tuple(t.says for t in evidence.tests))


def _jittering(evidence: Evidence) -> Verdict | None:
    """Return the verdict if most of the motion repeats itself, and what does not shows no sign of being ruled."""
    period = evidence.beat.period
    if period is None:
        return None
    left = float(np.nanmin(returns(evidence.raw, period)))
    cycles = [t for t in evidence.tests if t.method == CYCLES]
    shuffled = bool(cycles) and not any(t.rejects(SIGNIFICANT) for t in cycles)
    if left**2 > MOST_LEFT or not (shuffled or not (_grows(evidence.exponent) or _levels(evidence.dimension))):
        return None
    why = (
        f"cycles in any other order look just like it (p = {cycles[0].p:.2g})"
        if shuffled
        else "neither a growth of small differences nor a dimension can be found in them"
    )
    return Verdict(
        "periodic",
        f"The motion repeats itself with a period of {period:.4g} s but for random fluctuations of {100 * left:.2g} %: "
        f"{why}.",
        tuple(t.says for t in evidence.tests),
    )


def _grows(exponent: Estimate) -> bool:
    return exponent.status in ("ok", "uncertain") and exponent.low > 0.0


def _levels(dimension: Estimate) -> bool:
    return dimension.status in ("ok", "uncertain")


def _ruled_or_random(evidence: Evidence) -> Verdict:
    """Return chaotic, stochastic or undecided, by the tests, the exponent and the dimension together."""
    exponent, dimension = evidence.exponent, evidence.dimension
    rejected = [t.rejects(SIGNIFICANT) for t in evidence.tests]
    ruled = bool(rejected) and all(rejected)
    grows, levels = _grows(exponent), _levels(dimension)
    because = (*(t.says for t in evidence.tests), _said("Largest exponent", exponent), _said("Dimension", dimension))
    if ruled and grows and (levels or dimension.status == "below_noise"):
        return Verdict("chaotic", _chaotic_words(evidence), because)
    if lack := _lack(evidence, any(rejected)):
        return Verdict("undecided", lack, because)
    if not levels and not (grows and any(rejected)):
        return Verdict("stochastic", _stochastic_words(evidence), because)
    return Verdict("undecided", _undecided_words(ruled, grows, levels), because)


def _lack(evidence: Evidence, rejected: bool) -> str:
    """Return what the recording lacks for refusals to speak against chaos, and not only of the recording."""
    if evidence.raw.n < FEWEST_SAMPLES:
        return f"A recording of {evidence.raw.n} samples is too short to tell: {FEWEST_SAMPLES} are wanted at least."
    if not rejected or _grows(evidence.exponent) or _levels(evidence.dimension):
        return ""
    if not _long_enough(evidence):
        return (
            "It is not linear noise, but the recording is too short for an exponent or a dimension: "
            f"{ENOUGH_PERIODS} periods are wanted at least."
        )
    first, second = np.array_split(evidence.raw.x, 2)
    if max(np.std(first), np.std(second)) > UNEVEN * min(np.std(first), np.std(second)):
        return "It is not linear noise, but its size changes along the recording: look at a stretch where it is steady."
    return ""


def _long_enough(evidence: Evidence) -> bool:
    """Return whether there were enough points and periods for an exponent and a dimension."""
    statuses = {evidence.exponent.status, evidence.dimension.status}
    short = statuses & {"too_short", "too_few_neighbours", "failed"}
    period = evidence.beat.period
    periods = math.inf if period is None else evidence.raw.n * evidence.raw.dt / period
    return not short and periods >= ENOUGH_PERIODS


def _said(what: str, found: Estimate) -> str:
    if not math.isfinite(found.value):
        return f"{what}: {found.says}"
    unit = "" if found.unit == "1" else f" {found.unit}"
    return f"{what}: {found.value:.3g}{unit} [{found.low:.3g}, {found.high:.3g}]"


def _chaotic_words(evidence: Evidence) -> str:
    exponent, dimension = evidence.exponent, evidence.dimension
    p = max(t.p for t in evidence.tests)
    level = f", the correlation dimension levels off at {dimension.value:.2f}" if math.isfinite(dimension.value) else ""
    return (
        f"All signs agree: neighbouring states part at {exponent.value:.3g} {exponent.unit} [{exponent.low:.3g}, "
        f"{exponent.high:.3g}]{level}, and noise with the same spectrum and values does not look like it "
        f"(p = {p:.2g})."
    )


def _stochastic_words(evidence: Evidence) -> str:
    p = min((t.p for t in evidence.tests), default=1.0)
    if p > SIGNIFICANT:
        return f"Noise with the same spectrum and values looks just like it (p = {p:.2g}): nothing speaks for chaos."
    return (
        "It is not linear noise, but no separation of near states and no dimension can be found either: "
        f"{evidence.dimension.says or evidence.exponent.says}"
    )


def _undecided_words(ruled: bool, grows: bool, levels: bool) -> str:
    signs = {
        "the surrogate tests": ruled,
        "the exponent": grows,
        "the dimension": levels,
    }
    pro = " and ".join(name for name, yes in signs.items() if yes)
    con = " and ".join(name for name, yes in signs.items() if not yes)
    return (
        f"The signs disagree: {pro or 'nothing'} for chaos, {con} against it. A longer or cleaner recording would tell."
    )
