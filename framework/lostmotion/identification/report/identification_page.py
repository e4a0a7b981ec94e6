"""The page of an identification: parameters, their joint posterior, and the convergence of the chain."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.identification.report import figures as drawing
from lostmotion.identification.report import level_figure as leveled
from lostmotion.identification.report.view import RERUN_HINT, IdentificationView, read_identification
from lostmotion.report import style
from lostmotion.report.pages import DrawnSection, load_template, write_page
from lostmotion.report.words import DASH, Scale, choose_scale, figures, format_unit, interval
from lostmotion.results.identification import Identification

HEADLINE_PARAMETERS = 3
"""Number of parameters in the headline."""


def write_identification(folder: Path) -> Path:
    """Return the path of `report.html`, written from `identification.json` and `posterior.nc` in the folder."""
    view = read_identification(folder)
    return write_page(folder / "report.html", lambda: render(view), RERUN_HINT)


def render(view: IdentificationView) -> str:
    """Return the page as one self-contained HTML text."""
    result = view.result
    with style.use_style():
        drawn = _draw_figures(view)
    return load_template("page.html.j2", __package__).render(
        title=result.title or "Identification",
        model=result.model,
        converged=result.converged,
        answer=_write_answer(view),
        head=_make_header(result),
        rows=[*(_make_row(view, name) for name in result.rows), *_make_derived_rows(result)],
        figures=drawn,
        notes=result.notes,
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False),
    )


def _write_answer(view: IdentificationView) -> list[str]:
    """Return the first sentences of the page; they begin with the parameters if the chain has converged."""
    result = view.result
    rows = dict(list(result.parameters.items())[:HEADLINE_PARAMETERS])
    if not (result.converged and rows):
        return list(result.says)
    values = (f"{view.describe_name(name)} = {interval(row.interval)}" for name, row in rows.items())
    return [", ".join(values), " ".join(result.says)]


def _make_derived_rows(result: Identification) -> list[list[str]]:
    """Return the rows of numbers derived from the parameters."""
    known = [DASH, DASH] if result.truth else []
    rows = result.derived or {}
    return [[f"{name} (derived)", interval(row), *known, DASH, DASH] for name, row in rows.items()]


def _draw_figures(view: IdentificationView) -> list[DrawnSection]:
    result = view.result
    known = any(np.isfinite(view.truth(name)) for name in view.names)
    parts = [("trace", "Did the walkers mix?", drawing.draw_trace(view), drawing.TRACE_CAPTION)]
    if levels := result.levels:
        parts.insert(0, ("levels", "Measured and predicted chaos at each level", leveled.draw(levels), leveled.CAPTION))
    if result.converged and len(view.joint) > 1:
        caption = drawing.CORNER_CAPTION + (" Dashed: the known value." if known else "")
        parts.insert(0, ("corner", "Joint posterior of the parameters", drawing.draw_corner(view), caption))
    return [
        DrawnSection(name, title, style.embed_figure(figure, name), caption) for name, title, figure, caption in parts
    ]


def _make_header(result: Identification) -> list[str]:
    known = ["Known value", "In the interval"] if result.truth else []
    return ["Parameter", "Median [95 %]", *known, "ESS", "R-hat"]


def _make_row(view: IdentificationView, name: str) -> list[str]:
    row = view.result.rows[name]
    scale = choose_scale(row.median if math.isfinite(row.median) else row.at_maximum, row.unit)
    value = interval(row.interval, scale) if view.result.converged else "no interval: not converged"
    reached = [figures(row.ess, 4), f"{row.rhat:.3f}" if math.isfinite(row.rhat) else DASH]
    return [view.describe_name(name), value, *_make_truth_cells(view, name, scale), *reached]


def _make_truth_cells(view: IdentificationView, name: str, scale: Scale) -> list[str]:
    """Return the table cells for the known value; none where the case has no known values."""
    if not view.result.truth:
        return []
    truth = view.truth(name)
    if not np.isfinite(truth):
        return [DASH, DASH]
    text = f"{figures(scale.factor * truth, 4)} {format_unit(scale.unit)}".rstrip()
    if not view.result.converged:
        return [text, DASH]
    return [text, "inside" if truth in view.result.rows[name].interval else "outside"]
