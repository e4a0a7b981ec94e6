"""The signs of chaos, one by one: what each says of a motion, for it, against it or nothing, and why.

Each sign rules out one other explanation. A sign that could not be read is silent: it counts neither for nor against.
"""

from __future__ import annotations

import math

import numpy as np

from lostmotion.analysis.beat import MOST_PERIODS, SLACK, MotionEvidence, returned
from lostmotion.analysis.surrogates import SurrogateTest
from lostmotion.defaults import SURROGATE_OF_CYCLES
from lostmotion.results import Estimate, percent
from lostmotion.results.analysis import Sign, State
from lostmotion.signals.tones import TwoTones, two_tones

FEWEST_SAMPLES = 1000
"""With fewer samples the rank among surrogates and the slopes depend on single stretches of the orbit."""
FEWEST_PERIODS = 20
"""With fewer periods it is not told whether a motion comes back, nor how many frequencies it has. Within fewer turns
surrogates are like any motion that is a line or two of the spectrum, so that a test they pass is silent."""
TONES_FLOOR = 0.02


def signs_of(evidence: MotionEvidence) -> tuple[Sign, ...]:
    """Return all signs that the evidence holds, each with its state."""
    tests = (_test(test, evidence) for test in evidence.tests)
    return (_return(evidence), *tests, _growth(evidence), _dimension(evidence), _entropy(evidence))


def turn_of(evidence: MotionEvidence) -> float:
    """Return how long one turn of the motion lasts (s): a period, or else that of a sine as fast as this motion."""
    if evidence.beat.period is not None:
        return evidence.beat.period
    x, dt = evidence.raw.x, evidence.raw.dt
    if evidence.raw.embedding.lag == 1:
        return dt
    pace = float(np.diff(evidence.denoised.series.x).std() / dt)
    return 2.0 * math.pi * float(np.std(x)) / pace if pace > 0.0 else math.inf


def tones_of(evidence: MotionEvidence) -> TwoTones | None:
    """Return the two frequencies that explain the motion to within its noise, or None."""
    period, raw = evidence.beat.period, evidence.raw
    if period is None:
        return None
    tones = two_tones(raw.x, raw.dt, 1.0 / period)
    explained = tones.left <= SLACK * evidence.noise + TONES_FLOOR
    return tones if explained and tones.second * raw.n * raw.dt >= FEWEST_PERIODS else None


def grows(exponent: Estimate) -> bool:
    """Return whether an exponent is above zero by its interval."""
    return exponent.status in ("ok", "uncertain") and exponent.low > 0.0


def _return(evidence: MotionEvidence) -> Sign:
    """Return whether the motion comes back to itself, or is made up of two frequencies."""

    def sign(state: State, says: str, **figures: float) -> Sign:
        return Sign("return", "No return", state, says, "periodic and quasiperiodic motion", figures)

    period = evidence.beat.period
    if period is None:
        return sign("silent", "No period is known, so that no return could be looked for.")
    many = evidence.raw.n * evidence.raw.dt / period
    times, left = returned(evidence.raw, period, evidence.noise)
    figures = {"miss": left, "noise": evidence.noise, "periods": many}
    if times:
        cycle = "each period" if times == 1 else f"every {times} periods"
        return sign("against", f"The motion comes back {cycle}, but for {percent(left)} of its size.", **figures)
    if tones := tones_of(evidence):
        says = f"Two frequencies make up the motion, but for {percent(tones.left)} of its size."
        return sign("against", says, second=tones.second, left=tones.left, **figures)
    if many < FEWEST_PERIODS:
        return sign("silent", f"The recording holds {many:.0f} periods, and {FEWEST_PERIODS} are wanted.", **figures)
    says = (
        f"The motion does not come back within {MOST_PERIODS} periods: it misses by {percent(left)} of its size at "
        f"best, and its noise is {percent(evidence.noise)} at most. Noise does not come back either."
    )
    return sign("for", says, **figures)


def _test(test: SurrogateTest, evidence: MotionEvidence) -> Sign:
    cycles = test.method == SURROGATE_OF_CYCLES
    name = "Order of the cycles" if cycles else f"Not linear noise ({test.method.replace('_', ' ')})"
    excludes = "a periodic motion with noise" if cycles else test.null

    def sign(state: State, says: str) -> Sign:
        return Sign(f"surrogates_{test.method}", name, state, says, excludes, {"p": test.p})

    if not math.isfinite(test.p):
        return sign("silent", test.says)
    if evidence.raw.n < FEWEST_SAMPLES:
        return sign("silent", f"{evidence.raw.n} samples are too few for this test: {FEWEST_SAMPLES} are wanted.")
    turns = evidence.raw.n * evidence.raw.dt / turn_of(evidence)
    if not test.rejects(evidence.limits.level) and turns < FEWEST_PERIODS:
        says = f"The surrogates are as easy to predict, but {turns:.0f} turns of the motion are too few to say more."
        return sign("silent", says)
    if test.rejects(evidence.limits.level):
        return sign("for", f"The recording is easier to predict than its surrogates (p = {test.p:.2g}).")
    return sign("against", f"The surrogates are as easy to predict as the recording (p = {test.p:.2g}).")


def _growth(evidence: MotionEvidence) -> Sign:
    """Return what the exponent says: growth counts only over enough e-foldings, and over a turn at least."""
    found, turn = evidence.exponent, turn_of(evidence)
    folds = found.details.get("e_folds", math.nan)
    turns = (found.details.get("fit_end", math.nan) - found.details.get("fit_begin", math.nan)) / turn

    limits = evidence.limits

    def sign(state: State, says: str) -> Sign:
        wanted = {"e_foldings_wanted": limits.efolds, "turns_wanted": limits.turns}
        figures = {"e_foldings": folds, "turns": turns, **wanted}
        name, excludes = "Growth of small differences", "motion that forgets its start"
        return Sign("exponent", name, state, says, excludes, figures)

    if found.status == "regular":
        return sign("against", found.says)
    if not grows(found):
        value = f"The interval of the exponent, {_spanned(found)}, holds zero." if math.isfinite(found.value) else ""
        return sign("silent", value or found.says)
    over = f"Near states part by {folds:.2g} e-foldings within {turns:.2g} turns of the motion"
    if not folds >= limits.efolds:
        says = f"{over}: fewer than {limits.efolds:g} e-foldings are no sign, as noise shows so many too."
        return sign("silent", says)
    if not turns >= limits.turns:
        return sign("silent", f"{over}: within less than {limits.turns:g} turn distances rise and fall by themselves.")
    return sign("for", f"{over}, at {_spanned(found)}.")


def _dimension(evidence: MotionEvidence) -> Sign:
    found = evidence.dimension

    def sign(state: State, says: str) -> Sign:
        figures = {k: found.details[k] for k in ("tilt", "scatter") if k in found.details}
        return Sign("dimension", "Correlation dimension", state, says, "noise, which fills every dimension", figures)

    if found.status in ("rising", "not_saturating"):
        return sign("against", found.says)
    if found.status not in ("ok", "uncertain"):
        return sign("silent", found.says)
    if found.status == "uncertain":
        return sign("silent", found.says or "A condition for the interval of the dimension does not hold.")
    if evidence.raw.embedding.lag > 1 and found.high < evidence.limits.flat:
        return sign("against", f"The dimension is {_spanned(found)}, that of a closed curve.")
    flat = ""
    if {"tilt", "scatter"} <= found.details.keys():
        flat = (
            f"; across the plateau the local slope changes by {100 * found.details['tilt']:.0f} % and scatters by "
            f"{100 * found.details['scatter']:.0f} %"
        )
    return sign("for", f"The dimension levels off at {_spanned(found)}{flat}.")


def _entropy(evidence: MotionEvidence) -> Sign:
    found, turn = evidence.entropy, turn_of(evidence)

    def sign(state: State, says: str) -> Sign:
        figures = {"low": found.low, "high": found.high}
        return Sign("entropy", "Correlation entropy", state, says, "noise, whose entropy has no bound", figures)

    if found.status in ("rising", "not_saturating"):
        return sign("against", found.says)
    if found.status not in ("ok", "uncertain") or not math.isfinite(found.value):
        return sign("silent", found.says)
    if found.high * turn < evidence.limits.still:
        return sign("against", f"The entropy is {_spanned(found)}: next to nothing in one turn of the motion.")
    if not found.low > 0.0:
        return sign("silent", f"The interval of the entropy, {_spanned(found)}, holds zero.")
    return sign("for", f"The entropy is {_spanned(found)}, above zero and finite.")


def _spanned(found: Estimate) -> str:
    unit = "" if found.unit == "1" else f" {found.unit}"
    return f"{found.value:.3g}{unit} [{found.low:.3g}, {found.high:.3g}]"
