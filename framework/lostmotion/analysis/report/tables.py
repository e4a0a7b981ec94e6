"""The words and numbers with which the page of an analysis opens."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import NamedTuple

from lostmotion.analysis.report.view import AnalysisView, beat, whole
from lostmotion.report.words import (
    figures,
    measured,
    percent,
    pretty,
    probability,
    sentence,
    shortened,
    spoken,
)
from lostmotion.results import STATUSES
from lostmotion.results.analysis import (
    Analysis,
    DriveSource,
    Measure,
    MotionKind,
    Sided,
    State,
    SurrogateOutcome,
)

VERDICTS: Mapping[MotionKind, tuple[str, str]] = {
    "periodic": ("calm", "Periodic"),
    "quasiperiodic": ("calm", "Quasiperiodic"),
    "chaotic": ("chaotic", "Chaotic"),
    "stochastic": ("random", "Stochastic"),
    "undecided": ("unknown", "Undecided"),
}
STATES: Mapping[State, tuple[str, str]] = {
    "for": ("for chaos", "pro"),
    "against": ("against chaos", "con"),
    "silent": ("silent", "mute"),
}
SIGNIFICANT = 0.05
EXPONENT = "lyapunov_"
NO_RANK = "No p-value: the statistic could not be had."
SIDES: Mapping[Sided, str] = {"two": "two-sided", "low": "one-sided, low", "high": "one-sided, high"}
DRIVES: Mapping[DriveSource, str] = {
    "excitation": "from the measured excitation",
    "given": "as given",
    "spectrum": "from the spectrum",
}


class Row(NamedTuple):
    """A quantity, its value, how it was found, and what to mind; `kind` is ok, uncertain or refused."""

    name: str
    value: str
    how: str
    remark: str
    kind: str = "ok"


class SignRow(NamedTuple):
    """A sign of chaos: its name, its state with the style of that, why, and what other explanation it rules out."""

    name: str
    state: str
    kind: str
    says: str
    excludes: str


class Test(NamedTuple):
    """A surrogate test: what was supposed, how it was tried, the p-value, and what follows."""

    null: str
    method: str
    statistic: str
    p: str
    says: str


def verdict(result: Analysis) -> tuple[str, str]:
    """Return kind (a style of the page) and word of the verdict, which says where some signs are silent."""
    kind, word = VERDICTS[result.verdict]
    likely = result.strength == "likely" and kind != "unknown"
    return kind, f"Probably {word[0].lower()}{word[1:]}" if likely else word


def signs(result: Analysis) -> list[SignRow]:
    """Return the rows of the table of signs: those for chaos first, then those against it, then the silent ones."""
    order = list(STATES)
    return [
        SignRow(sentence(_brief(sign.name)), *STATES[sign.state], whole(sign.says), sign.excludes)
        for sign in sorted(result.signs, key=lambda sign: order.index(sign.state))
    ]


def tally(result: Analysis) -> str:
    """Return how many signs are in which state, in words, or nothing without signs."""
    states = [sign.state for sign in result.signs]
    if not states:
        return ""
    return f"{states.count('for')} for chaos, {states.count('against')} against it, {states.count('silent')} silent"


def opening(result: Analysis) -> list[str]:
    """Return what the analysis says: its first sentence, and the rest of it."""
    says = result.says.strip() or "Nothing was said about this recording."
    head, _, tail = re.sub(r"(?<=[.!?])\s+(?=[A-Z])", "\0", says, count=1).partition("\0")
    return [whole(part) for part in (head, tail) if part]


def numbers(view: AnalysisView) -> list[Row]:
    """Return the rows of the table of numbers."""
    result = view.result
    named = [
        ("Largest Lyapunov exponent", result.lyapunov),
        ("Correlation dimension D₂", result.d2),
        ("Correlation entropy K₂", result.k2),
        *((_titled(one), one) for one in result.others),
    ]
    return [*_drive(view), _delay(result), _dimension(result), *_noise(result), *(estimate(*one) for one in named)]


def _titled(found: Measure) -> str:
    name = found.name or found.method
    return "Lyapunov exponent" if name.startswith(EXPONENT) else sentence(_brief(name))


def _method(name: str) -> str:
    return sentence(_brief(name.removeprefix(EXPONENT)))


def _brief(name: str) -> str:
    return shortened(spoken(name), 40)


def estimate(name: str, found: Measure) -> Row:
    """Return the row of one estimate: a number with its interval, or the sentence that stands in its place."""
    status, how = found.status, _method(found.method)
    said = whole(found.says or ("" if status == "ok" else STATUSES.get(status, status)))
    if not math.isfinite(found.value):
        return Row(name, "no number", how, said or "No reason was stated.", "refused")
    return Row(name, _value(found), how, said, "ok" if status == "ok" else "uncertain")


def _value(found: Measure) -> str:
    unit, (value, low, high) = shortened(found.unit, 16), (found.value, found.low, found.high)
    if not (math.isfinite(low) and math.isfinite(high)):
        return measured(value, unit) + ", no interval"
    # Two figures of the width of the interval, as many as the opening sentence has.
    decimals = max(0, min(9, 1 - math.floor(math.log10(high - low)))) if high > low else 3
    text = f"{value:.{decimals}f} [{low:.{decimals}f}, {high:.{decimals}f}]".replace("-", "−")
    return f"{text} {pretty(unit)}".rstrip()


def _drive(view: AnalysisView) -> list[Row]:
    if not math.isfinite(view.period):
        return []
    drive = view.result.drive
    count = drive.samples_per_period
    said = f" ({figures(count, 5)} samples)" if math.isfinite(count) else ""
    how = sentence(DRIVES.get(drive.source, ""))
    return [Row(f"Period of the {beat(view)}", f"{figures(view.period, 6)} s{said}", how, "")]


def _delay(result: Analysis) -> Row:
    delay = result.delay
    said = f" ({delay.samples} sample{'s' if delay.samples != 1 else ''})"
    return Row("Delay", f"{figures(delay.seconds)} s{said}", _method(delay.method), "")


def _dimension(result: Analysis) -> Row:
    dimension = result.dimension
    return Row("Embedding dimension", figures(dimension.value), _method(dimension.method), "")


def _noise(result: Analysis) -> list[Row]:
    noise = result.noise
    return [_level("Noise as recorded", noise.before, "", noise.unit),
            _level("Noise after reduction", noise.after, _method(noise.method), noise.unit)]  # fmt: skip


def _level(name: str, level: float, how: str, unit: str) -> Row:
    if not math.isfinite(level):
        return Row(name, "no number", how, "The noise could not be told from the motion.", "refused")
    return Row(name, percent(level) if level else "none found", how, unit.replace("share of the", "of the", 1))


def tests(result: Analysis) -> list[Test]:
    """Return the rows of the table of surrogate tests."""
    return [_test(row) for row in result.surrogates]


def _test(found: SurrogateOutcome) -> Test:
    default = "Rejected." if found.p <= SIGNIFICANT else "Not rejected."
    return Test(
        null=sentence(found.null),
        method=f"{found.draws} {_brief(found.method)}",
        statistic=f"{_brief(found.statistic)}, {SIDES[found.sided]}",
        p=probability(found.p),
        says=whole(found.says or (default if math.isfinite(found.p) else NO_RANK)),
    )
