"""The page of an analysis: what kind of motion it is, how sure that is, and every curve behind it."""

from __future__ import annotations

import json
from pathlib import Path

from lostmotion.analysis.report import embedding as embedding
from lostmotion.analysis.report import measures as measures
from lostmotion.analysis.report import motion as motion
from lostmotion.analysis.report import surrogates as surrogates
from lostmotion.analysis.report import tables as tables
from lostmotion.analysis.report.view import AGAIN, AnalysisView, read_analysis, whole
from lostmotion.codec import to_plain
from lostmotion.report import style
from lostmotion.report.pages import PageSection, drawn, template, written

SECTIONS: tuple[PageSection[AnalysisView], ...] = (
    PageSection("course", "The motion", motion.course, motion.course_caption),
    PageSection("spectrum", "Spectrum", motion.spectra, motion.spectra_caption),
    PageSection("section", "Poincaré section", motion.sections, motion.sections_caption),
    PageSection("delay", "How the delay was chosen", embedding.delay, embedding.delay_caption),
    PageSection("dimension", "How many dimensions it takes", embedding.dimension, embedding.dimension_caption),
    PageSection("denoised", "What noise reduction did", motion.portraits, lambda _: motion.PORTRAITS),
    PageSection("divergence", "How fast neighbouring states part", measures.divergence, measures.divergence_caption),
    PageSection("correlation", "Correlation dimension", measures.correlation, measures.correlation_caption),
    PageSection("surrogates", "Could it be noise?", surrogates.tests, surrogates.tests_caption),
)


def write_analysis(folder: Path) -> Path:
    """Return the path of `report.html`, written from `analysis.json` and `analysis.nc` in the folder."""
    view = read_analysis(folder)
    return written(folder / "report.html", lambda: render(view), AGAIN)


def render(view: AnalysisView) -> str:
    """Return the page as one self-contained HTML text."""
    result = view.result
    with style.applied():
        figures = list(drawn(SECTIONS, view))
    first, *rest = tables.opening(result)
    kind, word = tables.verdict(result)
    return template("page.html.j2", __package__).render(
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
        figures=figures,
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False, default=str),
    )


def _sentences(parts: tuple[str, ...]) -> list[str]:
    return [whole(part) for part in parts if part.strip()]
