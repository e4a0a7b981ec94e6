"""The page of an identification: the parameters, how they hang together, and whether the chain may be believed."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from lostmotion.report import identification_figures as drawing
from lostmotion.report import identification_levels as leveled
from lostmotion.report import style
from lostmotion.report.identification_facts import AGAIN, Sampled, read_sampled
from lostmotion.report.pages import template, written
from lostmotion.report.words import DASH, Scale, figures, interval, pretty, readable
from lostmotion.results import Interval

LEADING = 3
"""Parameters that are told in the headline."""


class Drawn(NamedTuple):
    """A figure as the template takes it."""

    name: str
    title: str
    markup: Markup
    caption: str


def write_identification(folder: Path) -> Path:
    """Return the path of `report.html`, written from `identification.json` and `posterior.nc` in the folder."""
    sampled = read_sampled(folder)
    return written(folder / "report.html", lambda: render(sampled), AGAIN)


def render(sampled: Sampled) -> str:
    """Return the page as one self-contained HTML text."""
    facts = sampled.facts
    with style.applied():
        drawn = _figures(sampled)
    return template("identification.html.j2").render(
        title=str(facts.get("title") or "Identification"),
        model=str(facts.get("model") or ""),
        converged=sampled.converged,
        answer=_answer(sampled),
        head=_head(sampled),
        rows=[*(_row(sampled, name) for name in sampled.rows), *_derived(sampled)],
        figures=drawn,
        notes=[str(note) for note in facts.get("notes") or []],
        provenance=json.dumps(facts.get("provenance") or {}, indent=2, ensure_ascii=False),
    )


def _answer(sampled: Sampled) -> list[str]:
    """Return the sentences that the page opens with: the parameters first, if the chain may be believed."""
    says = [str(part) for part in sampled.facts.get("says") or []]
    rows = dict(list(sampled.facts["parameters"].items())[:LEADING])
    if not (sampled.converged and rows):
        return says
    return [
        ", ".join(f"{sampled.word(name)} = {interval(Interval.of(row))}" for name, row in rows.items()),
        " ".join(says),
    ]


def _derived(sampled: Sampled) -> list[list[str]]:
    """Return the rows of what follows from the parameters."""
    known = [DASH, DASH] if sampled.facts.get("truth") else []
    rows = sampled.facts.get("derived") or {}
    return [[f"{name} (follows)", interval(Interval.of(row)), *known, DASH, DASH] for name, row in rows.items()]


def _figures(sampled: Sampled) -> list[Drawn]:
    known = any(np.isfinite(sampled.truth(name)) for name in sampled.names)
    parts = [("trace", "Did the walkers mix?", drawing.trace(sampled), drawing.TRACE)]
    if levels := sampled.facts.get("levels"):
        parts.insert(0, ("levels", "What was measured, and what is expected", leveled.draw(levels), leveled.CAPTION))
    if sampled.converged and len(sampled.joint) > 1:
        said = drawing.CORNER + (" Dashed: the known value." if known else "")
        parts.insert(0, ("corner", "How the parameters hang together", drawing.corner(sampled), said))
    return [Drawn(name, title, style.embedded(figure, name), said) for name, title, figure, said in parts]


def _head(sampled: Sampled) -> list[str]:
    known = ["Known value", "In the interval"] if sampled.facts.get("truth") else []
    return ["Parameter", "Median [95 %]", *known, "ESS", "R-hat"]


def _row(sampled: Sampled, name: str) -> list[str]:
    entry = sampled.rows[name]
    scale = readable(float(entry["median"] if entry["median"] is not None else entry["at_maximum"]), entry["unit"])
    said = interval(Interval.of(entry), scale) if sampled.converged else "no interval: not converged"
    reached = [figures(entry["ess"], 4), f"{entry['rhat']:.3f}" if entry["rhat"] is not None else DASH]
    return [sampled.word(name), said, *_known(sampled, name, scale), *reached]


def _known(sampled: Sampled, name: str, scale: Scale) -> list[str]:
    """Return the cells on the known value; none where the case knows no value at all."""
    if not sampled.facts.get("truth"):
        return []
    truth, entry = sampled.truth(name), sampled.rows[name]
    if not np.isfinite(truth):
        return [DASH, DASH]
    text = f"{figures(scale.factor * truth, 4)} {pretty(scale.unit)}".rstrip()
    if not sampled.converged:
        return [text, DASH]
    return [text, "inside" if entry["low"] <= truth <= entry["high"] else "outside"]
