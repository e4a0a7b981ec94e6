"""The verdict on a motion: periodic, quasiperiodic, chaotic or stochastic, and the strength of its evidence."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Series
from lostmotion.results import decimals_of, percent
from lostmotion_chaos.analysis.motion_options import OPTIONS
from lostmotion_chaos.analysis.period import MAX_RETURN_PERIODS, MotionEvidence, find_return, measure_returns
from lostmotion_chaos.analysis.signs import collect_signs, format_estimate, is_growing, measure_turn
from lostmotion_chaos.defaults import SURROGATE_OF_CYCLES
from lostmotion_chaos.results import MotionKind, Sign, State, Strength
from lostmotion_chaos.signals.tones import base_line

MEASURED_SIGNS = ("exponent", "dimension", "entropy")
"""The keys of the signs that are measured quantities."""
TEST_PREFIX = "surrogates_"
DRIFT_PERIODS = 20
"""Fewest periods of a recording from which a drift of the zero is removed: it is then slow beside the motion."""
FINE = 100
"""With fewer different values, a missing exponent or dimension is blamed on the coarse sensor first."""
CYCLE_TEST = TEST_PREFIX + SURROGATE_OF_CYCLES


@dataclass(frozen=True)
class Verdict:
    """The kind of motion, the strength of the evidence, one or two sentences, the reasons, and all signs of chaos."""

    motion: MotionKind
    says: str
    because: tuple[str, ...]
    strength: Strength = "open"
    signs: tuple[Sign, ...] = ()


@dataclass(frozen=True, eq=False)
class SignedEvidence:
    """The evidence with its signs."""

    evidence: MotionEvidence
    signs: tuple[Sign, ...]

    def get_state(self, key: str) -> State:
        """Return the state of one sign, silent where it is absent."""
        return next((s.state for s in self.signs if s.key == key), "silent")

    def select(self, state: State) -> tuple[Sign, ...]:
        """Return the signs in this state."""
        return tuple(s for s in self.signs if s.state == state)

    @property
    def tests(self) -> tuple[Sign, ...]:
        """The surrogate tests."""
        return tuple(s for s in self.signs if s.key.startswith(TEST_PREFIX))

    @property
    def linear(self) -> tuple[Sign, ...]:
        """The surrogate tests of linear noise."""
        return tuple(s for s in self.tests if s.key != CYCLE_TEST)

    def make_verdict(self, motion: MotionKind, says: str, strength: Strength, first: tuple[str, ...] = ()) -> Verdict:
        """Return a verdict with all signs and its reasons: `first`, then the texts of the signs that are not silent."""
        spoken = (f"{s.name}: {s.says}" for s in self.signs if s.state != "silent")
        return Verdict(motion, says, (*first, *spoken), strength, self.signs)


def judge_motion(evidence: MotionEvidence) -> Verdict:
    """Return the verdict on a motion: that of the first rule that applies, else undecided."""
    it = SignedEvidence(evidence, collect_signs(evidence))
    for rule in (
        _judge_unsteady,
        _judge_periodic,
        _judge_drifting,
        _judge_quasiperiodic,
        _judge_coarse,
        _judge_regular,
        _judge_fluctuating,
        _judge_chaotic,
        _judge_short,
        _judge_stochastic,
    ):
        if found := rule(it):
            return found
    return it.make_verdict("undecided", _write_undecided(it), "open")


def _judge_unsteady(it: SignedEvidence) -> Verdict | None:
    """Return undecided for a motion whose size or speed changes, if it is not slow linear noise."""
    if not any(s.state == "for" for s in it.linear):
        return None
    dt, halves = it.evidence.raw.dt, np.array_split(it.evidence.denoised.series.x, 2)
    size = [float(np.std(half)) for half in halves]
    pace = [float(np.std(np.diff(half))) / (dt * max(s, 1e-300)) for half, s in zip(halves, size, strict=True)]
    for what, unit, (first, second) in (("size", "", size), ("pace", " rad/s", pace)):
        if max(first, second) > OPTIONS.uneven * min(first, second):
            says = (
                f"The {what} of the motion changes along the recording, from {first:.3g}{unit} in its first half to "
                f"{second:.3g}{unit} in its second half (root mean square). All signs assume a stationary motion: "
                "analyse a section in which the motion is stationary."
            )
            return it.make_verdict("undecided", says, "open")
    return None


def _judge_periodic(it: SignedEvidence) -> Verdict | None:
    """Return periodic if the motion repeats after some periods to within its noise."""
    period = it.evidence.base.period
    times, left = (0, 0.0) if period is None else find_return(it.evidence.raw, period, it.evidence.noise)
    if not times or period is None:
        return None
    cycle = "each period" if times == 1 else f"every {times} periods"
    noise = f"{percent(left)}"
    says = f"The motion repeats {cycle} of {period:.4g} s; {noise} of it does not repeat, which is within the noise."
    rests = f"return after {times} periods: {noise}, noise at most {percent(it.evidence.noise)}"
    return it.make_verdict("periodic", says + _note_contradiction(it), _rate_strength(it), (rests,))


def _judge_drifting(it: SignedEvidence) -> Verdict | None:
    """Return periodic if the motion repeats to within its noise after removal of a slow drift of its zero.

    The drift is a cubic over the whole recording, which cannot follow a second frequency.
    """
    evidence, period = it.evidence, it.evidence.base.period
    if period is None or evidence.raw.n * evidence.raw.dt < DRIFT_PERIODS * period:
        return None
    x, time = evidence.raw.x, np.linspace(-1.0, 1.0, evidence.raw.n)
    zero = np.polynomial.Polynomial.fit(time, x, 3)(time)
    rest = x - zero
    if not np.std(rest) > 0.0:
        return None
    noise = evidence.noise * float(np.std(x) / np.std(rest))
    steady = replace(evidence.raw, x=rest)
    line = base_line(rest, steady.dt)
    for found in (period, *((line.period,) if line else ())):
        times, left = find_return(steady, found, noise)
        if times:
            break
    if not times:
        return None
    cycle = "each period" if times == 1 else f"every {times} periods"
    says = (
        f"The motion repeats {cycle} of {found:.4g} s about a zero that drifts by {np.ptp(zero):.3g} over the "
        f"recording; {percent(left)} of it does not repeat, which is within the noise. The drift may be that of the "
        "sensor."
    )
    rests = f"return after {times} periods beside the drift: {percent(left)}, noise at most {percent(noise)}"
    return it.make_verdict("periodic", says, "likely", (rests,))


def _judge_quasiperiodic(it: SignedEvidence) -> Verdict | None:
    """Return quasiperiodic if two frequencies and their combinations explain the motion to within its noise."""
    evidence, period = it.evidence, it.evidence.base.period
    found = next(s.figures for s in it.signs if s.key == "return")
    if period is None or "second" not in found or (evidence.exponent.ok and evidence.exponent.low > 0.0):
        return None
    pair = f"{1.0 / period:.4g} Hz and {found['second']:.4g} Hz"
    duration = evidence.raw.n * evidence.raw.dt
    resolution = OPTIONS.resolution
    locked = _find_common_period(found["second"] * period, resolution / (duration / period))
    if locked and not _has_growing_miss(evidence.raw, locked * period, resolution):
        says = (
            f"The motion is regular and consists of {pair}. A recording of {duration / period:.0f} periods does not "
            f"show whether they have a common period of {locked} of these (periodic) or none (quasiperiodic)."
        )
        return it.make_verdict("undecided", says, "open")
    says = (
        f"The motion consists of two frequencies, {pair}, and their combinations; "
        f"{percent(found['left'])} of it remains, which is within the noise."
    )
    rests = f"remainder beside two tones: {percent(found['left'])}, noise at most {percent(evidence.noise)}"
    return it.make_verdict("quasiperiodic", says + _note_contradiction(it), _rate_strength(it), (rests,))


def _find_common_period(ratio: float, tolerance: float) -> int:
    """Return after how many periods two frequencies of this ratio may repeat together; 0 for never.

    They do after q periods if the ratio lies within `tolerance` of a multiple of 1/q.
    """
    for q in range(1, MAX_RETURN_PERIODS // 2 + 1):
        if abs(ratio - round(ratio * q) / q) < tolerance:
            return q
    return 0


def _has_growing_miss(raw: Series, period: float, resolution: float) -> bool:
    """Return whether the difference grows after 1, 2, ... of these periods, as with two frequencies."""
    most = max(2, int(0.5 * raw.n * raw.dt / period))
    spread = measure_returns(raw, period, most)
    return bool(np.nanmax(spread) > 1.0 / resolution * spread[0])


def _judge_coarse(it: SignedEvidence) -> Verdict | None:
    """Return undecided if the sensor shows too few values to distinguish neighbouring states."""
    values, fewest = len(np.unique(it.evidence.raw.x)), OPTIONS.fewest_values
    if values >= fewest:
        return None
    says = (
        f"The recording has only {values} different values, so neighbouring states cannot be distinguished: "
        f"{fewest:g} are needed. Use a finer sensor or a larger motion."
    )
    return it.make_verdict("undecided", says, "open")


def _judge_regular(it: SignedEvidence) -> Verdict | None:
    """Return quasiperiodic if neighbouring states do not diverge, the motion is not noise, and it does not repeat."""
    exponent = it.evidence.exponent
    tested = bool(it.tests) and all(s.state == "for" for s in it.tests)
    if exponent.status != "regular" or not np.isfinite(exponent.value) or not tested:
        return None
    decimals = decimals_of(exponent.value, exponent.low, exponent.high, 2)
    value, low, high = (f"{number:.{decimals}f}" for number in (exponent.value, exponent.low, exponent.high))
    says = (
        "Neighbouring states do not diverge, but the motion does not repeat after any number of periods: "
        f"the exponent is {value} {exponent.unit} [{low}, {high}]."
    )
    return it.make_verdict("quasiperiodic", says, "likely")


def _judge_fluctuating(it: SignedEvidence) -> Verdict | None:
    """Return periodic if most of the motion repeats, and the rest shows no sign of being deterministic."""
    evidence, period = it.evidence, it.evidence.base.period
    if period is None:
        return None
    left = float(np.nanmin(measure_returns(evidence.raw, period)))
    shuffled = it.get_state(CYCLE_TEST) == "against"
    signs = "for" in (it.get_state("exponent"), it.get_state("dimension")) or is_growing(evidence.exponent)
    if left**2 > OPTIONS.left or (signs and not shuffled):
        return None
    p = next((t.p for t in evidence.tests if t.method == SURROGATE_OF_CYCLES), np.nan)
    why = (
        f"cycles in any other order look the same (p = {p:.2g})"
        if shuffled
        else "they show neither a growth of small differences nor a dimension"
    )
    says = (
        f"The motion repeats with a period of {period:.4g} s except for random fluctuations of {percent(left)}: {why}."
    )
    return it.make_verdict("periodic", says + _note_contradiction(it), "likely")


def _judge_chaotic(it: SignedEvidence) -> Verdict | None:
    """Return chaotic if all tests and two of growth, dimension and entropy indicate chaos, and no sign is against it.

    The verdict is firm where every sign indicates chaos, and likely where some signs are silent.
    """
    tested = bool(it.tests) and all(s.state == "for" for s in it.tests)
    measured = sum(it.get_state(key) == "for" for key in MEASURED_SIGNS)
    if it.select("against") or not tested or measured < it.evidence.limits.measured:
        return None
    silent, spoken = it.select("silent"), it.select("for")
    opening = (
        f"{len(spoken)} of {len(it.signs)} signs speak for chaos and none against it; silent: {_list_names(silent)}."
    )
    opening = opening if silent else f"All {len(it.signs)} signs speak for chaos."
    parts = {"exponent": "neighbouring states diverge at {}", "dimension": "the correlation dimension levels off at {}",
             "entropy": "the entropy is {}"}  # fmt: skip
    found = it.evidence.exponent, it.evidence.dimension, it.evidence.entropy
    parts_found = [
        parts[k].format(format_estimate(f))
        for k, f in zip(MEASURED_SIGNS, found, strict=True)
        if it.get_state(k) == "for"
    ]
    measured_words = ", and ".join(parts_found[:2])
    says = f"{opening} {measured_words[0].upper()}{measured_words[1:]}."
    return it.make_verdict("chaotic", says, "likely" if silent else "firm")


def _judge_short(it: SignedEvidence) -> Verdict | None:
    """Return undecided where the recording is so short that a silent sign says nothing about the motion."""
    evidence, limits = it.evidence, it.evidence.limits
    if evidence.raw.n < limits.fewest_samples:
        says = (
            f"A recording of {evidence.raw.n} samples is too short for a verdict: at least "
            f"{limits.fewest_samples:g} are needed."
        )
        return it.make_verdict("undecided", says, "open")
    known = "for" in (it.get_state("exponent"), it.get_state("dimension"))
    if known or not any(s.state == "for" for s in it.linear) or _is_long_enough(evidence):
        return None
    return it.make_verdict("undecided", f"The motion is not linear noise, but {_why_silent(it)}", "open")


def _why_silent(it: SignedEvidence) -> str:
    """Return why there is neither an exponent nor a dimension: a coarse sensor, few periods, or what both say."""
    evidence = it.evidence
    values, periods = len(np.unique(evidence.raw.x)), evidence.raw.n * evidence.raw.dt / measure_turn(evidence)
    if values < FINE:
        return (
            f"its {values} different values are too coarse for an exponent or a dimension: use a finer sensor or a "
            "larger motion."
        )
    if periods < OPTIONS.enough_periods:
        return (
            f"the recording is too short for an exponent or a dimension: it has {periods:.0f} periods, and at least "
            f"{OPTIONS.enough_periods:g} are needed."
        )
    reasons = dict.fromkeys(one.says for one in (evidence.exponent, evidence.dimension) if one.says)
    return f"neither an exponent nor a dimension could be measured. {' '.join(reasons)}"


def _is_long_enough(evidence: MotionEvidence) -> bool:
    """Return whether there were enough points and turns for an exponent and a dimension."""
    statuses = {evidence.exponent.status, evidence.dimension.status}
    short = statuses & {"too_short", "too_few_neighbours", "failed"}
    return not short and evidence.raw.n * evidence.raw.dt / measure_turn(evidence) >= OPTIONS.enough_periods


def _judge_stochastic(it: SignedEvidence) -> Verdict | None:
    """Return stochastic if there is evidence for noise: a test that noise passes, or a dimension or entropy of noise.

    Silent signs alone are no evidence: what a recording does not show may still be present.
    """
    if "for" in (it.get_state("exponent"), it.get_state("dimension")):
        return None
    linear = [s for s in it.linear if s.state == "against"]
    endless = [k for k in ("dimension", "entropy") if it.get_state(k) == "against"]
    if not linear and not endless:
        return None
    if linear:
        p = min(s.figures["p"] for s in linear)
        says = f"Noise with the same spectrum and values looks the same (p = {p:.2g}): there is no evidence of chaos."
        return it.make_verdict("stochastic", says, "firm" if endless else "likely")
    what = " and the ".join(endless)
    says = (
        f"The motion is not linear noise, but the {what} rise{'s' if len(endless) == 1 else ''} without limit, as for "
        "noise, and there is no divergence of neighbouring states."
    )
    return it.make_verdict("stochastic", says, "likely")


def _note_contradiction(it: SignedEvidence) -> str:
    return (
        " However, neighbouring states seem to diverge, which contradicts it."
        if it.get_state("exponent") == "for"
        else ""
    )


def _rate_strength(it: SignedEvidence) -> Strength:
    return "likely" if it.get_state("exponent") == "for" else "firm"


def _list_names(signs: Iterable[Sign]) -> str:
    return ", ".join(s.name[0].lower() + s.name[1:] for s in signs)


def _write_undecided(it: SignedEvidence) -> str:
    """Return how many signs are in which state, and the names of those that do not indicate chaos."""
    pro, con, silent = it.select("for"), it.select("against"), it.select("silent")
    against = f"{len(con)} against it ({_list_names(con)})" if con else "none against it"
    rest = f"{len(silent)} silent ({_list_names(silent)})" if silent else "none silent"
    return (
        f"Of {len(it.signs)} signs {len(pro)} speak{'s' if len(pro) == 1 else ''} for chaos, {against}, and {rest}: "
        "this is not enough for a verdict. A longer or cleaner recording may decide."
    )
