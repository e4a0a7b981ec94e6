"""What kind of motion it is: periodic, quasiperiodic, chaotic or stochastic, and how firmly its signs bear that."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from lostmotion.analysis.beat import MOST_PERIODS, MotionEvidence, returned, returns
from lostmotion.analysis.signs import FEWEST_SAMPLES, grows, signs_of, turn_of
from lostmotion.contracts import Series
from lostmotion.defaults import SURROGATE_OF_CYCLES
from lostmotion.results import Estimate, percent
from lostmotion.results.analysis import MotionKind, Sign, State, Strength

ENOUGH_PERIODS = 100
FEWEST_VALUES = 16
TOLD_APART = 0.25
"""Frequencies closer than this share of one line of the spectrum are not told apart."""
MEASURED = ("exponent", "dimension", "entropy")
"""What is measured of a motion."""
LINEAR = "surrogates_"
TESTED_CYCLES = LINEAR + SURROGATE_OF_CYCLES


@dataclass(frozen=True)
class Verdict:
    """The kind of motion, how firmly, one or two sentences, what it rests on, and the state of every sign of chaos."""

    motion: MotionKind
    says: str
    because: tuple[str, ...]
    strength: Strength = "open"
    signs: tuple[Sign, ...] = ()


@dataclass(frozen=True, eq=False)
class Weighed:
    """The evidence with its signs."""

    evidence: MotionEvidence
    signs: tuple[Sign, ...]

    def state(self, key: str) -> State:
        """Return the state of one sign, silent where it is absent."""
        return next((s.state for s in self.signs if s.key == key), "silent")

    def those(self, state: State) -> tuple[Sign, ...]:
        """Return the signs in this state."""
        return tuple(s for s in self.signs if s.state == state)

    @property
    def tests(self) -> tuple[Sign, ...]:
        """The surrogate tests."""
        return tuple(s for s in self.signs if s.key.startswith(LINEAR))

    @property
    def linear(self) -> tuple[Sign, ...]:
        """The surrogate tests of linear noise."""
        return tuple(s for s in self.tests if s.key != TESTED_CYCLES)

    def verdict(self, motion: MotionKind, says: str, strength: Strength, first: tuple[str, ...] = ()) -> Verdict:
        """Return a verdict with all signs, and what it rests on: `first`, and what the signs that spoke said."""
        spoken = (f"{s.name}: {s.says}" for s in self.signs if s.state != "silent")
        return Verdict(motion, says, (*first, *spoken), strength, self.signs)


def verdict_on(evidence: MotionEvidence) -> Verdict:
    """Return the verdict on a motion: that of the first rule that holds, else undecided."""
    it = Weighed(evidence, signs_of(evidence))
    for rule in (_unsteady, _periodic, _quasiperiodic, _coarse, _regular, _jittering, _chaotic, _short, _stochastic):
        if found := rule(it):
            return found
    return it.verdict("undecided", _undecided_words(it), "open")


def _unsteady(it: Weighed) -> Verdict | None:
    """Return that nothing can be told of a motion whose size or pace changes, if it is more than slow linear noise."""
    if not any(s.state == "for" for s in it.linear):
        return None
    dt, halves = it.evidence.raw.dt, np.array_split(it.evidence.denoised.series.x, 2)
    size = [float(np.std(half)) for half in halves]
    pace = [float(np.std(np.diff(half))) / (dt * max(s, 1e-300)) for half, s in zip(halves, size, strict=True)]
    for what, unit, (first, second) in (("size", "", size), ("pace", " rad/s", pace)):
        if max(first, second) > it.evidence.limits.uneven * min(first, second):
            says = (
                f"The {what} of the motion changes along the recording, from {first:.3g}{unit} in its first half to "
                f"{second:.3g}{unit} in its second one (root mean square): all signs suppose a steady motion, so look "
                "at a stretch where it is one."
            )
            return it.verdict("undecided", says, "open")
    return None


def _periodic(it: Weighed) -> Verdict | None:
    """Return the verdict if the motion comes back to itself after some periods, to within its noise."""
    period = it.evidence.beat.period
    times, left = (0, 0.0) if period is None else returned(it.evidence.raw, period, it.evidence.noise)
    if not times or period is None:
        return None
    cycle = "each period" if times == 1 else f"every {times} periods"
    noise = f"{percent(left)}"
    says = f"The motion repeats itself {cycle} of {period:.4g} s; {noise} of it does not repeat, no more than noise."
    rests = f"return after {times} periods: {noise}, noise at most {percent(it.evidence.noise)}"
    return it.verdict("periodic", says + _all_the_same(it), _unless_growth(it), (rests,))


def _quasiperiodic(it: Weighed) -> Verdict | None:
    """Return the verdict if two frequencies and their combinations explain the motion, to within its noise."""
    evidence, period = it.evidence, it.evidence.beat.period
    found = next(s.figures for s in it.signs if s.key == "return")
    if period is None or "second" not in found or (evidence.exponent.ok and evidence.exponent.low > 0.0):
        return None
    pair = f"{1.0 / period:.4g} Hz and {found['second']:.4g} Hz"
    duration = evidence.raw.n * evidence.raw.dt
    locked = _locked(found["second"] * period, duration / period)
    if locked and not _drifts(evidence.raw, locked * period):
        says = (
            f"The motion is regular: {pair} make it up. In a recording of {duration / period:.0f} periods it is not "
            f"told whether they have a common period of {locked} of these (periodic) or none (quasiperiodic)."
        )
        return it.verdict("undecided", says, "open")
    says = (
        f"Two frequencies, {pair}, and their combinations make up the motion; "
        f"{percent(found['left'])} of it is left, no more than noise."
    )
    rests = f"left by two tones: {percent(found['left'])}, noise at most {percent(evidence.noise)}"
    return it.verdict("quasiperiodic", says + _all_the_same(it), _unless_growth(it), (rests,))


def _locked(ratio: float, periods: float) -> int:
    """Return after how many periods two frequencies of this ratio may come back together; 0 for never.

    They do after q if the ratio lies within what the length of a recording resolves of a multiple of 1/q.
    """
    for q in range(1, MOST_PERIODS // 2 + 1):
        if abs(ratio - round(ratio * q) / q) < TOLD_APART / periods:
            return q
    return 0


def _drifts(raw: Series, period: float) -> bool:
    """Return whether a motion misses itself by ever more after 1, 2, ... of these periods, as two frequencies do."""
    most = max(2, int(0.5 * raw.n * raw.dt / period))
    spread = returns(raw, period, most)
    return bool(np.nanmax(spread) > 1.0 / TOLD_APART * spread[0])


def _coarse(it: Weighed) -> Verdict | None:
    """Return that nothing can be told if the sensor shows too few values for near states to be told apart."""
    values = len(np.unique(it.evidence.raw.x))
    if values >= FEWEST_VALUES:
        return None
    says = (
        f"The recording holds {values} different values only, and near states cannot be told apart: "
        f"{FEWEST_VALUES} are wanted, so use a finer sensor or a larger motion."
    )
    return it.verdict("undecided", says, "open")


def _regular(it: Weighed) -> Verdict | None:
    """Return the verdict if near states do not part, the motion is no noise, and it does not come back either."""
    exponent = it.evidence.exponent
    tested = bool(it.tests) and all(s.state == "for" for s in it.tests)
    if exponent.status != "regular" or not np.isfinite(exponent.value) or not tested:
        return None
    says = (
        "Near states do not part, and yet no number of periods brings the motion back: "
        f"the exponent is {exponent.value:.2g} {exponent.unit} [{exponent.low:.2g}, {exponent.high:.2g}]."
    )
    return it.verdict("quasiperiodic", says, "likely")


def _jittering(it: Weighed) -> Verdict | None:
    """Return the verdict if most of the motion repeats itself, and what does not shows no sign of being ruled."""
    evidence, period = it.evidence, it.evidence.beat.period
    if period is None:
        return None
    left = float(np.nanmin(returns(evidence.raw, period)))
    shuffled = it.state(TESTED_CYCLES) == "against"
    signs = "for" in (it.state("exponent"), it.state("dimension")) or grows(evidence.exponent)
    if left**2 > it.evidence.limits.left or (signs and not shuffled):
        return None
    p = next((t.p for t in evidence.tests if t.method == SURROGATE_OF_CYCLES), np.nan)
    why = (
        f"cycles in any other order look just like it (p = {p:.2g})"
        if shuffled
        else "neither a growth of small differences nor a dimension can be found in them"
    )
    says = (
        f"The motion repeats itself with a period of {period:.4g} s but for random fluctuations of {percent(left)}: "
        f"{why}."
    )
    return it.verdict("periodic", says + _all_the_same(it), "likely")


def _chaotic(it: Weighed) -> Verdict | None:
    """Return chaotic if all tests and two of growth, dimension and entropy speak for it, and no sign against it.

    It is firm where every sign speaks for it, and likely where some are silent.
    """
    tested = bool(it.tests) and all(s.state == "for" for s in it.tests)
    measured = sum(it.state(key) == "for" for key in MEASURED)
    if it.those("against") or not tested or measured < it.evidence.limits.measured:
        return None
    silent, spoken = it.those("silent"), it.those("for")
    opening = f"{len(spoken)} of {len(it.signs)} signs speak for chaos and none against it; silent: {_named(silent)}."
    opening = opening if silent else f"All {len(it.signs)} signs speak for chaos."
    parts = {"exponent": "near states part at {}", "dimension": "the correlation dimension levels off at {}",
             "entropy": "the entropy is {}"}  # fmt: skip
    found = it.evidence.exponent, it.evidence.dimension, it.evidence.entropy
    told = [parts[k].format(_spanned(f)) for k, f in zip(MEASURED, found, strict=True) if it.state(k) == "for"]
    measured_words = ", and ".join(told[:2])
    says = f"{opening} {measured_words[0].upper()}{measured_words[1:]}."
    return it.verdict("chaotic", says, "likely" if silent else "firm")


def _short(it: Weighed) -> Verdict | None:
    """Return what the recording lacks for silence to say something of the motion, and not only of the recording."""
    evidence = it.evidence
    if evidence.raw.n < FEWEST_SAMPLES:
        says = f"A recording of {evidence.raw.n} samples is too short to tell: {FEWEST_SAMPLES} are wanted at least."
        return it.verdict("undecided", says, "open")
    known = "for" in (it.state("exponent"), it.state("dimension"))
    if known or not any(s.state == "for" for s in it.linear) or _long_enough(evidence):
        return None
    says = (
        "It is not linear noise, but the recording is too short for an exponent or a dimension: "
        f"{ENOUGH_PERIODS} periods are wanted at least."
    )
    return it.verdict("undecided", says, "open")


def _long_enough(evidence: MotionEvidence) -> bool:
    """Return whether there were enough points and turns for an exponent and a dimension."""
    statuses = {evidence.exponent.status, evidence.dimension.status}
    short = statuses & {"too_short", "too_few_neighbours", "failed"}
    return not short and evidence.raw.n * evidence.raw.dt / turn_of(evidence) >= ENOUGH_PERIODS


def _stochastic(it: Weighed) -> Verdict | None:
    """Return stochastic if something speaks for noise: a test that noise passes, a dimension or entropy of noise.

    Silence alone is none: what cannot be read from a recording may be there all the same.
    """
    if "for" in (it.state("exponent"), it.state("dimension")):
        return None
    linear = [s for s in it.linear if s.state == "against"]
    endless = [k for k in ("dimension", "entropy") if it.state(k) == "against"]
    if not linear and not endless:
        return None
    if linear:
        p = min(s.figures["p"] for s in linear)
        says = f"Noise with the same spectrum and values looks just like it (p = {p:.2g}): nothing speaks for chaos."
        return it.verdict("stochastic", says, "firm" if endless else "likely")
    what = " and the ".join(endless)
    says = (
        f"It is not linear noise, yet the {what} rise{'s' if len(endless) == 1 else ''} without end, as that of noise "
        "does, and no separation of near states can be found."
    )
    return it.verdict("stochastic", says, "likely")


def _all_the_same(it: Weighed) -> str:
    return " Near states seem to part all the same, which contradicts it." if it.state("exponent") == "for" else ""


def _unless_growth(it: Weighed) -> Strength:
    return "likely" if it.state("exponent") == "for" else "firm"


def _named(signs: Iterable[Sign]) -> str:
    return ", ".join(s.name[0].lower() + s.name[1:] for s in signs)


def _spanned(found: Estimate) -> str:
    unit = "" if found.unit == "1" else f" {found.unit}"
    return f"{found.value:.3g}{unit} [{found.low:.3g}, {found.high:.3g}]"


def _undecided_words(it: Weighed) -> str:
    """Return how many signs are in which state, and which of them do not speak for chaos."""
    pro, con, silent = it.those("for"), it.those("against"), it.those("silent")
    against = f"{len(con)} against it ({_named(con)})" if con else "none against it"
    rest = f"{len(silent)} silent ({_named(silent)})" if silent else "none silent"
    return (
        f"Of {len(it.signs)} signs {len(pro)} speak{'s' if len(pro) == 1 else ''} for chaos, {against}, and {rest}: "
        "that is not enough for a verdict. A longer or cleaner recording may tell."
    )
