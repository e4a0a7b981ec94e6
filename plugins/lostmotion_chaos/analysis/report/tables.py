"""The texts and tables at the top of the page of an analysis."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import NamedTuple

from lostmotion.report.words import (
    figures,
    format_quantity,
    format_unit,
    percent,
    probability,
    sentence,
    shorten,
    to_words,
)
from lostmotion.results import STATUSES
from lostmotion.settings import DEFAULT
from lostmotion_chaos.analysis.report.view import AnalysisView, complete_sentence, name_period_source
from lostmotion_chaos.results import (
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
EXPONENT_PREFIX = "lyapunov_"
NO_P_VALUE = "No p-value: the statistic could not be computed."
SIDES: Mapping[Sided, str] = {"two": "two-sided", "low": "one-sided, low", "high": "one-sided, high"}
DRIVE_SOURCES: Mapping[DriveSource, str] = {
    "excitation": "from the measured excitation",
    "given": "as given",
    "spectrum": "from the spectrum",
}


class Row(NamedTuple):
    """A quantity, its value, its method, and a remark; `kind` is ok, uncertain or refused."""

    name: str
    value: str
    how: str
    remark: str
    kind: str = "ok"


class SignRow(NamedTuple):
    """A sign of chaos: its name, its state with its style, the reason, and the explanation that it excludes."""

    name: str
    state: str
    kind: str
    says: str
    excludes: str


class TestRow(NamedTuple):
    """A surrogate test: null hypothesis, method, statistic, p-value, and conclusion."""

    null: str
    method: str
    statistic: str
    p: str
    says: str


def name_verdict(result: Analysis) -> tuple[str, str]:
    """Return the style and the word of the verdict; it begins with "Probably" where some signs are silent."""
    kind, word = VERDICTS[result.verdict]
    likely = result.strength == "likely" and kind != "unknown"
    return kind, f"Probably {word[0].lower()}{word[1:]}" if likely else word


def make_sign_rows(result: Analysis) -> list[SignRow]:
    """Return the rows of the table of signs: first those for chaos, then those against it, then the silent ones."""
    order = list(STATES)
    return [
        SignRow(sentence(_shorten_name(sign.name)), *STATES[sign.state], complete_sentence(sign.says), sign.excludes)
        for sign in sorted(result.signs, key=lambda sign: order.index(sign.state))
    ]


def count_signs(result: Analysis) -> str:
    """Return the number of signs in each state in words, or an empty text without signs."""
    states = [sign.state for sign in result.signs]
    if not states:
        return ""
    return f"{states.count('for')} for chaos, {states.count('against')} against it, {states.count('silent')} silent"


def split_opening(result: Analysis) -> list[str]:
    """Return the first sentence of the verdict, and the rest of it."""
    says = result.says.strip() or "The analysis has no sentence about this recording."
    head, _, tail = re.sub(r"(?<=[.!?])\s+(?=[A-Z])", "\0", says, count=1).partition("\0")
    return [complete_sentence(part) for part in (head, tail) if part]


def make_number_rows(view: AnalysisView) -> list[Row]:
    """Return the rows of the table of numbers."""
    result = view.result
    named = [
        ("Largest Lyapunov exponent", result.lyapunov),
        ("Correlation dimension D₂", result.d2),
        ("Correlation entropy K₂", result.k2),
        *((_title_measure(one), one) for one in result.others),
    ]
    return [
        *_make_drive_rows(view),
        _make_delay_row(result),
        _make_dimension_row(result),
        *_make_noise_rows(result),
        *(make_estimate_row(*one) for one in named),
    ]


def _title_measure(found: Measure) -> str:
    name = found.name or found.method
    return "Lyapunov exponent" if name.startswith(EXPONENT_PREFIX) else sentence(_shorten_name(name))


def _name_method(name: str) -> str:
    return sentence(_shorten_name(name.removeprefix(EXPONENT_PREFIX)))


def _shorten_name(name: str) -> str:
    return shorten(to_words(name), 40)


def make_estimate_row(name: str, found: Measure) -> Row:
    """Return the row of one estimate: a value with its interval, or the reason why there is none."""
    status, how = found.status, _name_method(found.method)
    remark = complete_sentence(found.says or ("" if status == "ok" else STATUSES.get(status, status)))
    if not math.isfinite(found.value):
        return Row(name, "no number", how, remark or "No reason was stated.", "refused")
    return Row(name, _format_value(found), how, remark, "ok" if status == "ok" else "uncertain")


def _format_value(found: Measure) -> str:
    unit, (value, low, high) = shorten(found.unit, 16), (found.value, found.low, found.high)
    if not (math.isfinite(low) and math.isfinite(high)):
        return format_quantity(value, unit) + ", no interval"
    # Two figures of the width of the interval, as many as the opening sentence has.
    decimals = max(0, min(9, 1 - math.floor(math.log10(high - low)))) if high > low else 3
    text = f"{value:.{decimals}f} [{low:.{decimals}f}, {high:.{decimals}f}]".replace("-", "−")
    return f"{text} {format_unit(unit)}".rstrip()


def _make_drive_rows(view: AnalysisView) -> list[Row]:
    if not math.isfinite(view.period):
        return []
    drive = view.result.drive
    count = drive.samples_per_period
    samples = f" ({figures(count, 5)} samples)" if math.isfinite(count) else ""
    how = sentence(DRIVE_SOURCES.get(drive.source, ""))
    return [Row(f"Period of the {name_period_source(view)}", f"{figures(view.period, 6)} s{samples}", how, "")]


def _make_delay_row(result: Analysis) -> Row:
    delay = result.delay
    samples = f" ({delay.samples} sample{'s' if delay.samples != 1 else ''})"
    return Row("Delay", f"{figures(delay.seconds)} s{samples}", _name_method(delay.method), "")


def _make_dimension_row(result: Analysis) -> Row:
    dimension = result.dimension
    return Row("Embedding dimension", figures(dimension.value), _name_method(dimension.method), "")


def _make_noise_rows(result: Analysis) -> list[Row]:
    noise = result.noise
    return [_make_level_row("Noise as recorded", noise.before, "", noise.unit),
            _make_level_row("Noise after reduction", noise.after, _name_method(noise.method), noise.unit)]  # fmt: skip


def _make_level_row(name: str, level: float, how: str, unit: str) -> Row:
    if not math.isfinite(level):
        return Row(name, "no number", how, "The noise could not be separated from the motion.", "refused")
    return Row(name, percent(level) if level else "none found", how, unit.replace("share of the", "of the", 1))


def make_test_rows(result: Analysis) -> list[TestRow]:
    """Return the rows of the table of surrogate tests."""
    return [_make_test_row(row) for row in result.surrogates]


def _make_test_row(found: SurrogateOutcome) -> TestRow:
    default = "Rejected." if found.p <= DEFAULT.motion.level else "Not rejected."
    return TestRow(
        null=sentence(found.null),
        method=f"{found.draws} {_shorten_name(found.method)}",
        statistic=f"{_shorten_name(found.statistic)}, {SIDES[found.sided]}",
        p=probability(found.p),
        says=complete_sentence(found.says or (default if math.isfinite(found.p) else NO_P_VALUE)),
    )
