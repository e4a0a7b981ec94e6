"""The table of all that shows whether a model behaves as its machine does: before, after, the noise floor, in words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from matplotlib.figure import Figure

from lostmotion.report.evidence import Evidence
from lostmotion.report.tables import Table
from lostmotion.report.words import DASH, chance, figures, percent, pretty

NAMES = {
    "heldout_log_score": "Held-out log score per sample",
    "free_run_error": "Free-run error",
    "valid_prediction_time": "Valid prediction time",
    "attractor_distance": "Distance between attractors",
    "largest_exponent": "Largest exponent",
    "d2": "Correlation dimension",
    "whiteness": "Whiteness of innovations",
}
COLUMNS = ("before", "after", "noise_floor")


def draw(evidence: Evidence) -> Figure | None:
    """Return None: the section is a table."""
    return None


def caption(evidence: Evidence) -> str:
    """Return nothing: each row has its own sentence."""
    return ""


def table(evidence: Evidence) -> Table:
    """Return a row for each measure: before, after, the noise floor, and what it says."""
    models = ["Before", "After"] if evidence.augmented else ["Model as it stands"]
    rows = [_row(evidence, name) for name in NAMES]
    kept = [row for row in rows if row[-1] or set(row[1:-1]) - {DASH}]
    return Table(["", *models, "Noise floor or recording", "In words"], kept)


def _row(evidence: Evidence, name: str) -> list[str]:
    columns = [c for c in COLUMNS if c != "after" or evidence.augmented]
    cells = [_cell(name, evidence.fact("show", column, name)) for column in columns]
    unit = pretty(str(evidence.fact("show", "units", name) or "1"))
    named = f"{NAMES[name]} ({unit})" if unit in ("1/s", "s") or unit.endswith(("times", "periods")) else NAMES[name]
    return [named, *cells, str(evidence.fact("show", "says", name) or "")]


def _cell(name: str, entry: Any) -> str:
    if entry is None:
        return DASH
    if name == "free_run_error":
        return percent(entry)
    if name == "heldout_log_score":
        return figures(entry, 4)
    if name == "whiteness":
        return chance(entry.get("p"))
    if name == "attractor_distance":
        p = entry.get("p")
        return DASH if p is None else f"{figures(entry.get('value'), 2)} {_whole(f'(p = {figures(p, 2)})')}"
    if name == "valid_prediction_time":
        more = "more than " if entry.get("or_longer") else ""
        return f"{more}{figures(entry.get('value'), 2)}"
    return _between(entry) if entry.get("value") is not None else DASH


def _between(entry: Mapping[str, Any]) -> str:
    """Return `value [low, high]`, with as many decimals as the width of the interval deserves."""
    value, low, high = (entry.get(key) for key in ("value", "low", "high"))
    if low is None or high is None or not high > low:
        return figures(value, 3)
    decimals = max(0, 1 - math.floor(math.log10(high - low)))
    ends = _whole(f"[{low:.{decimals}f}, {high:.{decimals}f}]")
    text = f"{value:.{decimals}f} {ends}".replace("-", "−")
    return f"{text}, uncertain" if entry.get("status") == "uncertain" else text


def _whole(text: str) -> str:
    """Return a text that no line break divides."""
    return text.replace(" ", "\N{NO-BREAK SPACE}")
