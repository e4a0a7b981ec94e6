"""The tables of the page: headings and rows of words, without columns or rows that say nothing."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lostmotion.report import posteriors
from lostmotion.report.evidence import Evidence
from lostmotion.report.opening import found, horizon
from lostmotion.report.words import (
    DASH,
    figures,
    measured,
    percent,
    pretty,
    probability,
    readable,
    sentence,
    spoken,
    typeset,
)
from lostmotion.report.words import interval as in_words

Row = list[str]


class Table(NamedTuple):
    """Headings, and as many words in each row."""

    head: Row
    rows: list[Row]


def _trimmed(head: Row, rows: list[Row]) -> Table:
    """Return the table without rows and columns in which nothing but the name stands."""
    rows = [row for row in rows if set(row[1:]) - {DASH, ""}]
    kept = [column for column in range(len(head)) if column == 0 or any(row[column] not in (DASH, "") for row in rows)]
    return Table([head[k] for k in kept], [[row[k] for k in kept] for row in rows])


def mechanisms(evidence: Evidence) -> Table:
    """Return mechanism, state, probability, and what is said of it; then what stays open."""
    rows = [
        [_named(entry), str(entry.get("state") or DASH), probability(entry.get("probability")), _in_words(entry)]
        for entry in [*found(evidence), *({**row, "state": "open"} for row in evidence.fact("open") or [])]
    ]
    return _trimmed(["Mechanism", "State", "Probability", "In words"], rows)


def _in_words(entry: Any) -> str:
    """Return what is said of a mechanism, with the doubts that make it no more than likely."""
    return typeset(" ".join([str(entry.get("says") or ""), *entry.get("doubts", ())]))


def key_numbers(evidence: Evidence) -> Table:
    """Return the numbers that carry the answer: before, after, and the noise floor."""
    rows = [
        ["Unexplained force, r.m.s.", *_forces(evidence), DASH],
        [f"Its share of {evidence.fact('drive', 'of') or 'the drive'}", *_shares(evidence), DASH],
        [f"Prediction error{horizon(evidence)}", *_fit(evidence, "heldout_nrmse", percent), _floor(evidence)],
        ["Held-out log score per sample", *_fit(evidence, "heldout_log_score", _score), DASH],
        ["Predictions are valid for", *(_valid(evidence, when) for when in ("before", "after", "floor"))],
        ["Largest Lyapunov exponent", *(_exponent(evidence, when) for when in ("before", "after")), DASH],
    ]
    if not evidence.augmented:
        rows = [[name, before, DASH, floor] for name, before, _, floor in rows]
    return _trimmed(["", "Before" if evidence.augmented else "Model as it stands", "After", "Noise floor"], rows)


def parameters(evidence: Evidence) -> Table:
    """Return each parameter before and after, its known value, and whether the last interval holds it."""
    names = [name for name in posteriors.parameters(evidence) if posteriors.entry_of(evidence, name)]
    head = [
        "Parameter",
        "Before" if evidence.augmented else "Median [95 %]",
        "After",
        "Known value",
        "In the last interval",
    ]
    rows = [_parameter(evidence, name) for name in names]
    return _trimmed(head, rows if evidence.augmented else [[*row[:2], DASH, *row[3:]] for row in rows])


def _parameter(evidence: Evidence, name: str) -> Row:
    entry, truth = posteriors.entry_of(evidence, name), evidence.number("truth", name)
    scale = readable(float(entry.get("median") or 0.0), str(entry.get("unit", "")))
    before, after = (in_words(evidence.fact("parameters", key, name), scale) for key in ("before", "after"))
    if not np.isfinite(truth):
        return [posteriors.words_of(name), before, after, DASH, DASH]
    known = f"{figures(scale.factor * truth, 4)} {pretty(scale.unit)}".rstrip()
    if entry.get("withheld"):
        return [posteriors.words_of(name), before, after, known, DASH]
    held = entry.get("low", truth) <= truth <= entry.get("high", truth)
    return [posteriors.words_of(name), before, after, known, "inside" if held else "outside"]


def _named(entry: Any) -> str:
    where = entry.get("at")
    return sentence(spoken(str(entry.get("mechanism", "?")))) + (f" (at the {where})" if where else "")


def _forces(evidence: Evidence) -> Row:
    """Return the unexplained force before and after."""
    before, after = (
        measured(evidence.number(key, "rms"), str(evidence.fact(key, "unit") or ""))
        for key in ("unexplained_before", "unexplained")
    )
    return _placed(evidence, before, after)


def _shares(evidence: Evidence) -> Row:
    before, after = (percent(evidence.number(key, "share_of_drive")) for key in ("unexplained_before", "unexplained"))
    return _placed(evidence, before, after)


def _placed(evidence: Evidence, before: str, after: str) -> Row:
    """Return what is unexplained before and after; where nothing was added, what is left is left by the one model."""
    return [before, after] if evidence.augmented else [before if after == DASH else after, DASH]


def _fit(evidence: Evidence, key: str, shown: Any) -> Row:
    return [shown(evidence.number("fit", when, key)) for when in ("before", "after")]


def _score(value: float) -> str:
    return figures(value, 4)


def _floor(evidence: Evidence) -> str:
    return percent(evidence.number("fit", "noise_floor_nrmse"))


def _valid(evidence: Evidence, when: str) -> str:
    seconds = evidence.number("valid_prediction_time", when)
    text = measured(seconds, str(evidence.fact("valid_prediction_time", "unit") or "s"))
    if evidence.fact("valid_prediction_time", "or_longer", when):
        return f"more than {text}"
    times = figures(evidence.number("valid_prediction_time", "in_lyapunov_times", when), 2)
    return text if times == DASH else f"{text} ({times} Lyapunov times)"


def _exponent(evidence: Evidence, when: str) -> str:
    return measured(evidence.number("lyapunov", when), str(evidence.fact("lyapunov", "unit") or ""))
