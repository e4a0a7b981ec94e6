"""The table of what several recordings share: each parameter in each of them, and whether one value holds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from lostmotion.report.evidence import Evidence
from lostmotion.report.posteriors import words_of
from lostmotion.report.tables import Table
from lostmotion.report.words import chance, figures, interval, measured, pretty, readable, typeset, with_unit


def draw(evidence: Evidence) -> Figure | None:
    """Return None: the section is a table."""
    return None


def caption(evidence: Evidence) -> str:
    """Return nothing: what is to be said stands above the table."""
    return ""


def words(evidence: Evidence) -> str:
    """Return what recordings share, in sentences, and how the table is to be read; empty for one recording."""
    said = [str(part) for part in evidence.fact("sharing", "says") or ()]
    if not evidence.fact("sharing", "parameters"):
        return " ".join(said)
    level = evidence.fact("sharing", "level_of")
    return " ".join([*said, f"Medians with 95 % intervals, by recording; below its name the rms of the {level}."])


def table(evidence: Evidence) -> Table:
    """Return one row for each parameter: its value in each recording, and whether one value holds."""
    parameters: Mapping[str, Any] = evidence.fact("sharing", "parameters") or {}
    names, levels = (evidence.fact("sharing", key) or () for key in ("recordings", "levels"))
    unit = str(evidence.fact("sharing", "level_unit") or "")
    heads = [f"{name} ({measured(level, unit)})" for name, level in zip(names, levels, strict=True)]
    return Table(["Parameter", *heads, "One value?"], [_row(name, entry) for name, entry in parameters.items()])


def _row(name: str, entry: Mapping[str, Any]) -> list[str]:
    values: Sequence[Mapping[str, Any]] = entry["by_recording"]
    scale = readable(max(abs(float(value["median"])) for value in values), str(values[0]["unit"]))
    cells = [interval(value, scale).removesuffix(pretty(scale.unit)).rstrip() for value in values]
    return [with_unit(words_of(name), scale.unit), *cells, _verdict(entry["shared"])]


def _verdict(shared: Mapping[str, Any]) -> str:
    if shared["holds"]:
        return typeset(f"yes ({chance(shared['p'])})")
    if power := shared.get("power_of_level"):
        return f"goes with level to the power {figures(power['exponent'], 2)}"
    odd = shared.get("differs_in")
    return f"no, differs in {odd}" if odd else typeset(f"no ({chance(shared['p'])})")
