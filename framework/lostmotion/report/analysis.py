"""The page of an analysis: what kind of motion it is, how sure that is, and every curve behind it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

from lostmotion.codec import to_plain
from lostmotion.report import analysis_embedding as embedding
from lostmotion.report import analysis_measures as measures
from lostmotion.report import analysis_motion as motion
from lostmotion.report import analysis_surrogates as surrogates
from lostmotion.report import analysis_tables as tables
from lostmotion.report import style
from lostmotion.report.analysis_view import AGAIN, AnalysisView, read_analysis, whole
from lostmotion.report.pages import DrawnFigure, Section, template, written

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
    view = read_analysis(folder)
    return written(folder / "report.html", lambda: render(view), AGAIN)


def render(view: AnalysisView) -> str:
    """Return the page as one self-contained HTML text."""
    result = view.result
    with style.applied():
        drawn = list(_drawn(view))
    first, *rest = tables.opening(result)
    kind, word = tables.verdict(result)
    return template("analysis.html.j2").render(
        title=result.title or "Analysis",
        kind=kind,
        verdict=word,
        answer=first,
        rest=rest,
        signs=tables.signs(result),
        tally=tables.tally(result),
        because=[] if result.signs else _sentences(result.because),
        numbers=tables.numbers(view),
        tests=tables.tests(result),
        notes=_sentences(result.notes),
        figures=drawn,
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False, default=str),
    )


def _sentences(parts: tuple[str, ...]) -> list[str]:
    return [whole(part) for part in parts if part.strip()]


def _drawn(view: AnalysisView) -> Iterator[DrawnFigure]:
    """Return the sections whose arrays are there."""
    for section in SECTIONS:
        figure = section.draw(view)
        if figure is not None:
            # The markup is drawn by matplotlib, which escapes the words it is given.
            markup = style.embedded(figure, section.name)
            yield DrawnFigure(section.name, section.title, markup, section.caption(view))
