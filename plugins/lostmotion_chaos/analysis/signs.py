"""The signs of chaos: each is for chaos, against it or silent, with its reason.

Each sign excludes one other explanation. A sign that could not be measured is silent: it counts neither for nor against
chaos.
"""

from __future__ import annotations

import math

import numpy as np

from lostmotion.results import Estimate, percent
from lostmotion_chaos.analysis.motion_options import OPTIONS
from lostmotion_chaos.analysis.period import MAX_RETURN_PERIODS, MotionEvidence, find_return
from lostmotion_chaos.analysis.surrogates import SurrogateTest
from lostmotion_chaos.defaults import SURROGATE_OF_CYCLES
from lostmotion_chaos.results import Sign, State
from lostmotion_chaos.signals.tones import TwoTones, two_tones


def collect_signs(evidence: MotionEvidence) -> tuple[Sign, ...]:
    """Return all signs in the evidence, each with its state."""
    tests = (_assess_test(test, evidence) for test in evidence.tests)
    return (
        _assess_return(evidence),
        *tests,
        _assess_growth(evidence),
        _assess_dimension(evidence),
        _assess_entropy(evidence),
    )


def measure_turn(evidence: MotionEvidence) -> float:
    """Return the duration (s) of one cycle of the motion: its period, or that of a sine with the same speed."""
    if evidence.base.period is not None:
        return evidence.base.period
    x, dt = evidence.raw.x, evidence.raw.dt
    if evidence.raw.embedding.lag == 1:
        return dt
    pace = float(np.diff(evidence.denoised.series.x).std() / dt)
    return 2.0 * math.pi * float(np.std(x)) / pace if pace > 0.0 else math.inf


def find_tones(evidence: MotionEvidence) -> TwoTones | None:
    """Return the two frequencies that explain the motion to within its noise, or None."""
    period, raw = evidence.base.period, evidence.raw
    if period is None:
        return None
    tones = two_tones(raw.x, raw.dt, 1.0 / period)
    limits = evidence.limits
    explained = tones.left <= OPTIONS.slack * evidence.noise + OPTIONS.tones_floor
    return tones if explained and tones.second * raw.n * raw.dt >= limits.fewest_periods else None


def is_growing(exponent: Estimate) -> bool:
    """Return whether the interval of an exponent lies above zero."""
    return exponent.status in ("ok", "uncertain") and exponent.low > 0.0


def _assess_return(evidence: MotionEvidence) -> Sign:
    """Return the sign for a motion that repeats, or that consists of two frequencies."""

    def sign(state: State, says: str, **figures: float) -> Sign:
        return Sign("return", "No return", state, says, "periodic and quasiperiodic motion", figures)

    period = evidence.base.period
    if period is None:
        return sign("silent", "No period is known, so a return could not be searched for.")
    many = evidence.raw.n * evidence.raw.dt / period
    fewest = evidence.limits.fewest_periods
    times, left = find_return(evidence.raw, period, evidence.noise)
    figures = {"miss": left, "noise": evidence.noise, "periods": many}
    if times:
        cycle = "each period" if times == 1 else f"every {times} periods"
        return sign("against", f"The motion repeats {cycle}, except for {percent(left)} of its size.", **figures)
    if tones := find_tones(evidence):
        says = f"The motion consists of two frequencies, except for {percent(tones.left)} of its size."
        return sign("against", says, second=tones.second, left=tones.left, **figures)
    if many < fewest:
        return sign("silent", f"The recording has {many:.0f} periods, and {fewest:g} are needed.", **figures)
    says = (
        f"The motion does not repeat within {MAX_RETURN_PERIODS} periods: the smallest difference is {percent(left)} "
        f"of its size, and its noise is {percent(evidence.noise)} at most. Noise does not repeat either."
    )
    return sign("for", says, **figures)


def _assess_test(test: SurrogateTest, evidence: MotionEvidence) -> Sign:
    cycles = test.method == SURROGATE_OF_CYCLES
    name = "Order of the cycles" if cycles else f"Not linear noise ({test.method.replace('_', ' ')})"
    excludes = "a periodic motion with noise" if cycles else test.null

    def sign(state: State, says: str) -> Sign:
        return Sign(f"surrogates_{test.method}", name, state, says, excludes, {"p": test.p})

    if not math.isfinite(test.p):
        return sign("silent", test.says)
    limits, fewest = evidence.limits, evidence.limits.fewest_samples
    if evidence.raw.n < fewest:
        return sign("silent", f"{evidence.raw.n} samples are too few for this test: {fewest:g} are needed.")
    turns = evidence.raw.n * evidence.raw.dt / measure_turn(evidence)
    if not test.rejects(limits.level) and turns < limits.fewest_periods:
        says = f"The surrogates are as easy to predict, but {turns:.0f} cycles of the motion are too few to decide."
        return sign("silent", says)
    if test.rejects(limits.level):
        return sign("for", f"The recording is easier to predict than its surrogates (p = {test.p:.2g}).")
    return sign("against", f"The surrogates are as easy to predict as the recording (p = {test.p:.2g}).")


def _assess_growth(evidence: MotionEvidence) -> Sign:
    """Return the sign of the exponent: growth counts only over enough e-foldings, and over at least one cycle."""
    found, turn = evidence.exponent, measure_turn(evidence)
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
    if not is_growing(found):
        value = (
            f"The interval of the exponent, {format_estimate(found)}, includes zero."
            if math.isfinite(found.value)
            else ""
        )
        return sign("silent", value or found.says)
    over = f"Neighbouring states diverge by {folds:.2g} e-foldings within {turns:.2g} cycles of the motion"
    if not folds >= limits.efolds:
        says = f"{over}: fewer than {limits.efolds:g} e-foldings are no evidence, as noise shows as many."
        return sign("silent", says)
    if not turns >= limits.turns:
        return sign(
            "silent", f"{over}: within less than {limits.turns:g} cycle, distances rise and fall in any motion."
        )
    return sign("for", f"{over}, at {format_estimate(found)}.")


def _assess_dimension(evidence: MotionEvidence) -> Sign:
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
        return sign("against", f"The dimension is {format_estimate(found)}, that of a closed curve.")
    flat = ""
    if {"tilt", "scatter"} <= found.details.keys():
        flat = (
            f"; across the plateau the local slope changes by {100 * found.details['tilt']:.0f} % and scatters by "
            f"{100 * found.details['scatter']:.0f} %"
        )
    return sign("for", f"The dimension levels off at {format_estimate(found)}{flat}.")


def _assess_entropy(evidence: MotionEvidence) -> Sign:
    found, turn = evidence.entropy, measure_turn(evidence)

    def sign(state: State, says: str) -> Sign:
        figures = {"low": found.low, "high": found.high}
        return Sign("entropy", "Correlation entropy", state, says, "noise, whose entropy has no bound", figures)

    if found.status in ("rising", "not_saturating"):
        return sign("against", found.says)
    if found.status not in ("ok", "uncertain") or not math.isfinite(found.value):
        return sign("silent", found.says)
    if found.high * turn < OPTIONS.still:
        return sign("against", f"The entropy is {format_estimate(found)}: practically zero in one cycle of the motion.")
    if not found.low > 0.0:
        return sign("silent", f"The interval of the entropy, {format_estimate(found)}, includes zero.")
    return sign("for", f"The entropy is {format_estimate(found)}, above zero and finite.")


def format_estimate(found: Estimate) -> str:
    """Return value, unit and interval of an estimate as text."""
    unit = "" if found.unit == "1" else f" {found.unit}"
    return f"{found.value:.3g}{unit} [{found.low:.3g}, {found.high:.3g}]"
