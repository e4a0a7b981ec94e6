"""The page of an analysis: what kind of motion it is, how sure that is, and every curve behind it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from markupsafe import Markup

from lostmotion.report import analysis_embedding as embedding
from lostmotion.report import analysis_measures as measures
from lostmotion.report import analysis_motion as motion
from lostmotion.report import analysis_surrogates as surrogates
from lostmotion.report import analysis_tables as tables
from lostmotion.report import style
from lostmotion.report.analysis_facts import read_analysis, whole
from lostmotion.report.evidence import Evidence
from lostmotion.report.pages import Section, template, written


class Drawn(NamedTuple):
    """A section as the template takes it."""

    name: str
    title: str
    markup: Markup
    caption: str


SECTIONS = (
    Section("course", "The motion", motion.course, motion.course_caption),
    Section("spectrum", "Spectrum", motion.spectra, motion.spectra_caption),
    Section("section", "Poincaré section", motion.sections, motion.sections_caption),
    Section("delay", "How the delay was chosen", embedding.delay, embedding.delay_caption),
    Section("dimension", "How many dimensions it takes", embedding.dimension, embedding.dimension_caption),
    Section("denoised", "What noise reduction did", motion.portraits, lambda _: motion.PORTRAITS),
    Section("divergence", "How fast neighbouring states part", measures.divergence, measures.divergence_caption),
    Section("correlation", "Correlation dimension", measures.correlation, measures.correlation_caption),
    Section("surrogates", "Could it be noise?", surrogates.tests, surrogates.tests_caption),
)


def write_analysis(folder: Path) -> Path:
    """Return the path of `report.html`, written from `analysis.json` and `analysis.nc` in the folder."""
    evidence = read_analysis(folder)
    return written(folder / "report.html", lambda: render(evidence), "run `lostmotion analyse` again")


def render(evidence: Evidence) -> str:
    """Return the page as one self-contained HTML text."""
    with style.applied():
        drawn = list(_drawn(evidence))
    first, *rest = tables.opening(evidence)
    kind, word = tables.verdict(evidence)
    return template("analysis.html.j2").render(
        title=str(evidence.fact("title") or "Analysis"),
        kind=kind,
        verdict=word,
        answer=first,
        rest=rest,
        signs=tables.signs(evidence),
        tally=tables.tally(evidence),
        because=[] if tables.signs(evidence) else _strings(evidence, "because"),
        numbers=tables.numbers(evidence),
        tests=tables.tests(evidence),
        notes=_strings(evidence, "notes"),
        figures=drawn,
        provenance=json.dumps(evidence.fact("provenance") or {}, indent=2, ensure_ascii=False, default=str),
    )


def _strings(evidence: Evidence, key: str) -> list[str]:
    found = evidence.fact(key)
    return [whole(str(part)) for part in found if str(part).strip()] if isinstance(found, list) else []


def _drawn(evidence: Evidence) -> Iterator[Drawn]:
    """Return the sections whose arrays are there."""
    for section in SECTIONS:
        figure = section.draw(evidence)
        if figure is not None:
            # The markup is drawn by matplotlib, which escapes the words it is given.
            markup = style.embedded(figure, section.name)
            yield Drawn(section.name, section.title, markup, section.caption(evidence))
