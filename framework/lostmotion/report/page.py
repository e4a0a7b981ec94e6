"""The page: sections in their order, and the template they are poured into."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from markupsafe import Markup

from lostmotion.report import (
    decay,
    growth,
    learned,
    missing,
    opening,
    portraits,
    posteriors,
    prediction,
    ranking,
    sensors,
    sharing,
    show,
    strip,
    style,
    tables,
)
from lostmotion.report.evidence import Evidence, read_evidence
from lostmotion.report.pages import Section, template, written
from lostmotion.report.words import typeset


class Drawn(NamedTuple):
    """A section as the template takes it: markup is empty where there was nothing to draw."""

    name: str
    title: str
    markup: Markup
    caption: str
    table: tables.Table | None
    kind: str = "tight"
    words: str = ""


TABLES = {
    "parameters": tables.parameters,
    "sensors": sensors.table,
    "when": strip.table,
    "sharing": sharing.table,
    "show": show.table,
}
WORDS = {"decay": decay.words, "sharing": sharing.words}
TITLES = {"portraits": portraits.title}
"""What stands above the figure of a section, and titles that depend on what is drawn."""
PROSE = ("show",)
"""Sections of which the table holds sentences, which have to be broken."""
SECTIONS = (
    Section("prediction", "Recording and prediction", prediction.draw, prediction.caption),
    Section("decay", "Free decay", decay.figure_of, decay.caption_of),
    Section("sensors", "All sensors", sensors.draw, sensors.caption),
    Section("missing", "The force that the model does not explain", missing.draw, missing.caption),
    Section("when", "When the model disagrees", strip.draw, strip.caption),
    Section("learned", "The force that was learned", learned.draw, learned.caption),
    Section("ranking", "Which physics it may be", ranking.draw, ranking.caption),
    Section("parameters", "Parameters", posteriors.draw, posteriors.caption),
    Section("sharing", "What recordings share", sharing.draw, sharing.caption),
    Section("portraits", "Phase portrait and Poincaré section", portraits.draw, portraits.caption),
    Section("show", "Before and after in numbers", show.draw, show.caption),
    Section("growth", "How far ahead predictions hold", growth.draw, growth.caption),
    Section("whiteness", "Are the innovations white?", growth.draw_whiteness, growth.whiteness_caption),
)


def write_report(folder: Path) -> Path:
    """Return the path of `report.html`, written from `diagnosis.json` and `arrays.nc` in the folder."""
    evidence = read_evidence(folder)
    return written(folder / "report.html", lambda: render(evidence), "run `lostmotion diagnose` again")


def render(evidence: Evidence) -> str:
    """Return the page as one self-contained HTML text."""
    with style.applied():
        sections = list(_drawn(evidence))
    return template("diagnosis.html.j2").render(
        title=str(evidence.fact("title") or "Diagnosis"),
        badge=opening.badge(evidence),
        answer=[typeset(part) for part in opening.answer(evidence)],
        model=evidence.fact("model") or {},
        numbers=tables.key_numbers(evidence),
        mechanisms=tables.mechanisms(evidence),
        sections=sections,
        notes=[str(note) for note in evidence.fact("notes") or []],
        confused=opening.confused(evidence),
        provenance=_provenance(evidence),
    )


def _drawn(evidence: Evidence) -> Iterator[Drawn]:
    """Return the sections that have a figure, a table or words."""
    for section in SECTIONS:
        figure = section.draw(evidence)
        table = TABLES[section.name](evidence) if section.name in TABLES else None
        words = WORDS[section.name](evidence) if section.name in WORDS else ""
        if figure is not None or (table and table.rows) or words:
            # The markup is drawn by matplotlib, which escapes the words it is given.
            markup = style.embedded(figure, section.name) if figure else Markup()
            caption = section.caption(evidence) if figure else ""
            kind = "prose" if section.name in PROSE else "tight"
            title = TITLES[section.name](evidence) if section.name in TITLES else section.title
            yield Drawn(section.name, title, markup, typeset(caption), table, kind, typeset(words))


def _provenance(evidence: Evidence) -> str:
    origin = evidence.fact("provenance")
    return json.dumps(origin, indent=2, ensure_ascii=False, default=str) if origin else ""
