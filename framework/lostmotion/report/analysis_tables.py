"""The words and numbers with which the page of an analysis opens."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from lostmotion.report.analysis_facts import AnalysisEvidence, beat, entry, period_of, rows_of, whole
from lostmotion.report.words import (
    DASH,
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

VERDICTS = {
    "periodic": ("calm", "Periodic"),
    "quasiperiodic": ("calm", "Quasiperiodic"),
    "chaotic": ("chaotic", "Chaotic"),
    "stochastic": ("random", "Stochastic"),
}
STATES = {"for": ("for chaos", "pro"), "against": ("against chaos", "con"), "silent": ("silent", "mute")}
SIGNIFICANT = 0.05
EXPONENT = "lyapunov_"
NO_RANK = "No p-value: the statistic could not be had."
SIDES = {"two": "two-sided", "low": "one-sided, low", "high": "one-sided, high"}
DRIVES = {
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


def verdict(evidence: AnalysisEvidence) -> tuple[str, str]:
    """Return kind (a style of the page) and word of the verdict, which says where some signs are silent."""
    kind, word = VERDICTS.get(str(evidence.fact("verdict")), ("unknown", "Undecided"))
    likely = evidence.fact("strength") == "likely" and kind != "unknown"
    return kind, f"Probably {word[0].lower()}{word[1:]}" if likely else word


def signs(evidence: AnalysisEvidence) -> list[SignRow]:
    """Return the rows of the table of signs: those for chaos first, then those against it, then the silent ones."""
    rows = rows_of(evidence, "signs")
    order = list(STATES)
    known = [row for row in rows if row.get("state") in STATES]
    return [
        SignRow(sentence(_brief(str(row.get("name") or row.get("sign") or DASH))), *STATES[str(row["state"])],
                whole(str(row.get("says") or "")), str(row.get("excludes") or ""))
        for row in sorted(known, key=lambda row: order.index(str(row["state"])))
    ]  # fmt: skip


def tally(evidence: AnalysisEvidence) -> str:
    """Return how many signs are in which state, in words, or nothing without signs."""
    states = [str(row.get("state")) for row in rows_of(evidence, "signs")]
    if not states:
        return ""
    return f"{states.count('for')} for chaos, {states.count('against')} against it, {states.count('silent')} silent"


def opening(evidence: AnalysisEvidence) -> list[str]:
    """Return what the analysis says: its first sentence, and the rest of it."""
    says = evidence.fact("says")
    parts = [str(part) for part in says] if isinstance(says, list) else [str(says or "")]
    first, *rest = [part.strip() for part in parts if part.strip()] or ["Nothing was said about this recording."]
    head, _, tail = re.sub(r"(?<=[.!?])\s+(?=[A-Z])", "\0", first, count=1).partition("\0")
    return [whole(part) for part in (head, tail, *rest) if part]


def numbers(evidence: AnalysisEvidence) -> list[Row]:
    """Return the rows of the table of numbers."""
    named = [
        ("Largest Lyapunov exponent", entry(evidence, "lyapunov")),
        ("Correlation dimension D₂", entry(evidence, "d2")),
        ("Correlation entropy K₂", entry(evidence, "k2")),
        *((_titled(row), row) for row in rows_of(evidence, "others")),
    ]
    return [*_drive(evidence), _delay(evidence), _dimension(evidence), *_noise(evidence),
            *(estimate(name, facts) for name, facts in named if facts)]  # fmt: skip


def _titled(facts: Mapping[str, Any]) -> str:
    name = str(facts.get("name") or facts.get("method") or "further estimate")
    return "Lyapunov exponent" if name.startswith(EXPONENT) else sentence(_brief(name))


def _method(facts: Mapping[str, Any]) -> str:
    return sentence(_brief(str(facts.get("method") or "").removeprefix(EXPONENT)))


def _brief(name: str) -> str:
    return shortened(spoken(name), 40)


def estimate(name: str, facts: Mapping[str, Any]) -> Row:
    """Return the row of one estimate: a number with its interval, or the sentence that stands in its place."""
    status, how = str(facts.get("status") or "ok"), _method(facts)
    said = whole(str(facts.get("says") or ("" if status == "ok" else STATUSES.get(status, status))))
    if not _is_number(facts.get("value")):
        return Row(name, "no number", how, said or "No reason was stated.", "refused")
    return Row(name, _value(facts), how, said, "ok" if status == "ok" else "uncertain")


def _value(facts: Mapping[str, Any]) -> str:
    unit = shortened(str(facts.get("unit") or "1"), 16)
    if not (_is_number(facts.get("low")) and _is_number(facts.get("high"))):
        return measured(facts["value"], unit) + ", no interval"
    value, low, high = (float(facts[key]) for key in ("value", "low", "high"))
    # Two figures of the width of the interval, as many as the opening sentence has.
    decimals = max(0, min(9, 1 - math.floor(math.log10(high - low)))) if high > low else 3
    text = f"{value:.{decimals}f} [{low:.{decimals}f}, {high:.{decimals}f}]".replace("-", "−")
    return f"{text} {pretty(unit)}".rstrip()


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)


def _drive(evidence: AnalysisEvidence) -> list[Row]:
    period = period_of(evidence)
    if not math.isfinite(period):
        return []
    source = str(evidence.fact("drive", "source") or "")
    count = evidence.number("drive", "samples_per_period")
    said = f" ({figures(count, 5)} samples)" if math.isfinite(count) else ""
    return [
        Row(
            f"Period of the {beat(evidence)}",
            f"{figures(period, 6)} s{said}",
            sentence(DRIVES.get(source, _brief(source))),
            "",
        )
    ]


def _delay(evidence: AnalysisEvidence) -> Row:
    facts = entry(evidence, "delay")
    how = _method(facts)
    if not _is_number(facts.get("seconds")):
        return Row("Delay", "no number", how, str(facts.get("says") or "No delay was found."), "refused")
    count = facts.get("samples")
    said = f" ({count:g} sample{'s' if count != 1 else ''})" if _is_number(count) else ""
    return Row("Delay", f"{figures(facts['seconds'])} s{said}", how, str(facts.get("says") or ""))


def _dimension(evidence: AnalysisEvidence) -> Row:
    facts = entry(evidence, "dimension")
    how, said = _method(facts), str(facts.get("says") or "")
    if not _is_number(facts.get("value")):
        return Row("Embedding dimension", "no number", how, said or "No dimension was found.", "refused")
    return Row("Embedding dimension", figures(facts["value"]), how, said)


def _noise(evidence: AnalysisEvidence) -> list[Row]:
    facts = entry(evidence, "noise")
    how, said = _method(facts), str(facts.get("says") or "")
    unit = str(facts.get("unit") or "")
    rows = []
    for name, key in (("Noise as recorded", "before"), ("Noise after reduction", "after")):
        value = (
            percent(facts.get(key)) if "share" in unit or not unit else measured(facts.get(key), shortened(unit, 16))
        )
        lacking = value == DASH
        value = "none found" if facts.get(key) == 0 else value
        remark = (said or "The noise could not be told from the motion.") if lacking else unit
        rows.append(Row(name, "no number" if lacking else value, how if key == "after" else "", _of(remark),
                        "refused" if lacking else "ok"))  # fmt: skip
    return rows


def _of(unit: str) -> str:
    return unit.replace("share of the", "of the", 1) if unit.startswith("share of the") else unit


def tests(evidence: AnalysisEvidence) -> list[Test]:
    """Return the rows of the table of surrogate tests."""
    return [_test(row) for row in rows_of(evidence, "surrogates")]


def _test(facts: Mapping[str, Any]) -> Test:
    p = facts.get("p")
    rejected = _is_number(p) and float(p) <= SIGNIFICANT  # type: ignore[arg-type]
    side = SIDES.get(str(facts.get("sided")), "")
    draws = f"{facts['draws']:g}" if _is_number(facts.get("draws")) else "?"
    statistic = ", ".join(part for part in (_brief(str(facts.get("statistic") or DASH)), side) if part)
    default = "Rejected." if rejected else "Not rejected."
    return Test(
        null=sentence(str(facts.get("null") or DASH)),
        method=f"{draws} {_brief(str(facts.get('name') or facts.get('method') or 'surrogates'))}",
        statistic=statistic,
        p=probability(p),
        says=whole(str(facts.get("says") or (default if _is_number(p) else NO_RANK))),
    )
