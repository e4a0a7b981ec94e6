"""The table of parameters in several recordings, and whether one value is valid for all."""

from __future__ import annotations

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report.pages import Grid
from lostmotion.report.words import (
    chance,
    choose_scale,
    figures,
    format_quantity,
    format_unit,
    interval,
    typeset,
    with_unit,
    words_of,
)
from lostmotion.results import Interval
from lostmotion.results.shared_values import FullComparison, SharedParameter


def write_words(evidence: Evidence) -> str:
    """Return the sentences on the comparison of recordings, and how to read the table; empty for one recording."""
    sharing = evidence.result.sharing
    if sharing is None:
        return ""
    legend = f"Medians with 95 % intervals, by recording; below its name the rms of the {sharing.level_of}."
    return " ".join([*sharing.says, *([legend] if sharing.parameters else [])])


def make_table(evidence: Evidence) -> Grid | None:
    """Return one row for each parameter: its value in each recording, and whether one value is valid for all."""
    sharing = evidence.result.sharing
    if sharing is None:
        return None
    columns = zip(sharing.recordings or (), sharing.levels or (), strict=True)
    heads = [f"{name} ({format_quantity(level, sharing.level_unit or '')})" for name, level in columns]
    rows = [_make_row(name, one) for name, one in sharing.parameters.items()]
    return Grid(["Parameter", *heads, "One value?"], rows)


def _make_row(name: str, parameter: SharedParameter) -> list[str]:
    values = [Interval(one.median, one.low, one.high, one.unit) for one in parameter.by_recording]
    scale = choose_scale(max(abs(value.median) for value in values), values[0].unit)
    cells = [interval(value, scale).removesuffix(format_unit(scale.unit)).rstrip() for value in values]
    return [with_unit(words_of(name), scale.unit), *cells, _format_verdict(parameter.shared)]


def _format_verdict(shared: FullComparison) -> str:
    if shared.holds:
        return typeset(f"yes ({chance(shared.p)})")
    if shared.power_of_level:
        return f"proportional to level to the power {figures(shared.power_of_level.exponent, 2)}"
    odd = shared.differs_in
    return f"no, differs in {odd}" if odd else typeset(f"no ({chance(shared.p)})")
