"""The page of an identification: the parameters, how they hang together, and whether the chain may be believed."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.identification.report import figures as drawing
from lostmotion.identification.report import levels as leveled
from lostmotion.identification.report.view import AGAIN, IdentificationView, read_identification
from lostmotion.report import style
from lostmotion.report.pages import DrawnSection, template, written
from lostmotion.report.words import DASH, Scale, figures, interval, pretty, readable
from lostmotion.results.identification import Identification

LEADING = 3
"""Parameters that are told in the headline."""


def write_identification(folder: Path) -> Path:
    """Return the path of `report.html`, written from `identification.json` and `posterior.nc` in the folder."""
    view = read_identification(folder)
    return written(folder / "report.html", lambda: render(view), AGAIN)


def render(view: IdentificationView) -> str:
    """Return the page as one self-contained HTML text."""
    result = view.result
    with style.applied():
        drawn = _figures(view)
    return template("page.html.j2", __package__).render(
        title=result.title or "Identification",
        model=result.model,
        converged=result.converged,
        answer=_answer(view),
        head=_head(result),
        rows=[*(_row(view, name) for name in result.rows), *_derived(result)],
        figures=drawn,
        notes=result.notes,
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False),
    )


def _answer(view: IdentificationView) -> list[str]:
    """Return the sentences that the page opens with: the parameters first, if the chain may be believed."""
    result = view.result
    rows = dict(list(result.parameters.items())[:LEADING])
    if not (result.converged and rows):
        return list(result.says)
    told = (f"{view.word(name)} = {interval(row.interval)}" for name, row in rows.items())
    return [", ".join(told), " ".join(result.says)]


def _derived(result: Identification) -> list[list[str]]:
    """Return the rows of what follows from the parameters."""
    known = [DASH, DASH] if result.truth else []
    rows = result.derived or {}
    return [[f"{name} (follows)", interval(row), *known, DASH, DASH] for name, row in rows.items()]


def _figures(view: IdentificationView) -> list[DrawnSection]:
    result = view.result
    known = any(np.isfinite(view.truth(name)) for name in view.names)
    parts = [("trace", "Did the walkers mix?", drawing.trace(view), drawing.TRACE)]
    if levels := result.levels:
        parts.insert(0, ("levels", "What was measured, and what is expected", leveled.draw(levels), leveled.CAPTION))
    if result.converged and len(view.joint) > 1:
        said = drawing.CORNER + (" Dashed: the known value." if known else "")
        parts.insert(0, ("corner", "How the parameters hang together", drawing.corner(view), said))
    return [DrawnSection(name, title, style.embedded(figure, name), said) for name, title, figure, said in parts]


def _head(result: Identification) -> list[str]:
    known = ["Known value", "In the interval"] if result.truth else []
    return ["Parameter", "Median [95 %]", *known, "ESS", "R-hat"]


def _row(view: IdentificationView, name: str) -> list[str]:
    row = view.result.rows[name]
    scale = readable(row.median if math.isfinite(row.median) else row.at_maximum, row.unit)
    said = interval(row.interval, scale) if view.result.converged else "no interval: not converged"
    reached = [figures(row.ess, 4), f"{row.rhat:.3f}" if math.isfinite(row.rhat) else DASH]
    return [view.word(name), said, *_known(view, name, scale), *reached]


def _known(view: IdentificationView, name: str, scale: Scale) -> list[str]:
    """Return the cells on the known value; none where the case knows no value at all."""
    if not view.result.truth:
        return []
    truth = view.truth(name)
    if not np.isfinite(truth):
        return [DASH, DASH]
    text = f"{figures(scale.factor * truth, 4)} {pretty(scale.unit)}".rstrip()
    if not view.result.converged:
        return [text, DASH]
    return [text, "inside" if truth in view.result.rows[name].interval else "outside"]
