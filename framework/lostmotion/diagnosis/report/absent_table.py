"""What is not missing: bars and table of the bounds of absent terms, and a sentence on the most usual ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from lostmotion.defaults import USUAL
from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style
from lostmotion.report.pages import Grid
from lostmotion.report.words import DASH, format_size, percent, sentence, to_words, typeset
from lostmotion.results import join_names
from lostmotion.results.absent import AbsentTerm, UnlimitedTerm
from lostmotion.results.expectation import Detection

OTHER = "Other parameters"
"""The heading of the values of other parameters for which a size holds."""
MOST = 5
"""The number of bounds in a summary."""


def draw(evidence: Evidence) -> Figure | None:
    """Return one bar for each bound with a force, up to its share of the drive, or None without any."""
    rows = [one for one in evidence.result.absent if one.share_of_drive]
    if not rows:
        return None
    told = [(label_absent(one, rows), one.share_of_drive or 0.0, format_amplitude(one, one.upper)) for one in rows]
    return draw_shares(told, f"largest force at the bound, in % of {evidence.result.drive.of}")


def draw_shares(rows: Sequence[tuple[str, float, str]], label: str, colour: str = style.QUIET) -> Figure:
    """Return one bar for each row of name, share of the drive and words beside it; the axis has the label."""
    figure = style.make_figure(0.9 + 0.24 * len(rows))
    axes = figure.subplots()
    shares = [100.0 * share for _, share, _ in rows]
    least = 0.5 * min(shares)
    axes.barh(range(len(rows)), [share - least for share in shares], left=least, color=colour, height=0.66)
    beside: dict[str, Any] = {"xytext": (4, 0), "textcoords": "offset points", "va": "center", "fontsize": 8.5}
    for row, (_, _, words) in enumerate(rows):
        axes.annotate(typeset(words), (shares[row], row), **beside)
    axes.set_xscale("log")
    axes.set_xlim(least, 4.0 * max(shares))
    style.log_ticks(axes.xaxis)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [name for name, _, _ in rows])
    axes.set_xlabel(label)
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    return (
        "Each bar ends at the 95 % upper bound of a term that is not in the model: a larger one would show in this"
        f" recording. Its length is the largest force at that size, as a share of {evidence.result.drive.of};"
        " the number beside it is the size. The bound counts all that is in the model, and the usual errors of a model."
        " It holds for one further term, at the values of its other parameters that the table states."
    )


def make_table(evidence: Evidence) -> Grid | None:
    """Return each bound with its share of the drive, and the values of the other parameters for which it holds."""
    rows = evidence.result.absent
    table = [list_size_cells(one, rows, one.upper) for one in rows]
    return Grid(["Not missing", "Larger than", f"Share of {evidence.result.drive.of}", OTHER], table)


def write_words(evidence: Evidence) -> str:
    """Return the summary, and the terms that the recording does not limit."""
    result = evidence.result
    return " ".join([summarise_absent(result.absent), *group_unlimited(result.unlimited, "bound")]).strip()


def list_size_cells(one: AbsentTerm | Detection, rows: Sequence[AbsentTerm | Detection], size: float) -> list[str]:
    """Return the cells of a term: its name, a size, its share of the drive, and the values for which that holds."""
    share = DASH if one.share_of_drive is None else percent(one.share_of_drive)
    return [label_absent(one, rows), format_amplitude(one, size), share, one.says.partition(", for ")[2] or DASH]


def format_amplitude(one: AbsentTerm | Detection, size: float) -> str:
    """Return a size with its unit; a number without a unit is told with the name of its parameter."""
    text = format_size(size, one.unit)
    return f"{to_words(one.parameter)} {text}" if one.unit == "1" else text


def group_unlimited(rows: Sequence[UnlimitedTerm], what: str) -> list[str]:
    """Return a sentence for each reason why terms have no `what`, such as a bound."""
    reasons: dict[str, dict[str, None]] = {}
    for one in rows:
        reasons.setdefault(one.says.partition(": ")[2].rstrip("."), {})[to_words(one.mechanism)] = None
    return [f"No {what} for {join_names(list(names))}, because {why}." for why, names in reasons.items()]


def label_absent(one: AbsentTerm | Detection, rows: Sequence[AbsentTerm | Detection]) -> str:
    """Return the name of a term, with its parameter and its place where there are several of them."""
    same = [row for row in rows if row.mechanism == one.mechanism]
    parameter = f": {to_words(one.parameter)}" if len({row.parameter for row in same}) > 1 else ""
    place = f" ({one.at})" if len({row.at for row in same}) > 1 else ""
    return f"{sentence(to_words(one.mechanism))}{parameter}{place}"


def summarise_absent(absent: Sequence[AbsentTerm]) -> str:
    """Return a sentence on the most usual absent terms; empty where there are none."""
    first = {one.mechanism: one for name in USUAL for one in reversed(absent) if one.mechanism == name}
    if not first:
        return ""
    return f"Not missing, with 95 % probability each: {'; '.join(one.says for one in list(first.values())[:MOST])}."
