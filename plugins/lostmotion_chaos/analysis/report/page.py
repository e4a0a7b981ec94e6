"""The page of an analysis: the kind of motion, the evidence for it, and every curve."""

from __future__ import annotations

import json
from pathlib import Path

from lostmotion.codec import to_plain
from lostmotion.report import style
from lostmotion.report.pages import PageSection, draw_sections, load_template, write_page
from lostmotion_chaos.analysis.report import embedding as embedding
from lostmotion_chaos.analysis.report import measures as measures
from lostmotion_chaos.analysis.report import motion as motion
from lostmotion_chaos.analysis.report import surrogates as surrogates
from lostmotion_chaos.analysis.report import tables as tables
from lostmotion_chaos.analysis.report.view import RERUN_HINT, AnalysisView, complete_sentence, read_analysis

SECTIONS: tuple[PageSection[AnalysisView], ...] = (
    PageSection("course", "The motion", motion.draw_course, motion.caption_course),
    PageSection("spectrum", "Spectrum", motion.draw_spectra, motion.caption_spectra),
    PageSection("section", "Poincaré section", motion.draw_sections, motion.caption_sections),
    PageSection("delay", "How the delay was chosen", embedding.draw_delay, embedding.caption_delay),
    PageSection("dimension", "How the dimension was chosen", embedding.draw_dimension, embedding.caption_dimension),
    PageSection("denoised", "Effect of noise reduction", motion.draw_portraits, lambda _: motion.PORTRAITS_CAPTION),
    PageSection(
        "divergence", "Divergence of neighbouring states", measures.draw_divergence_figure, measures.caption_divergence
    ),
    PageSection("correlation", "Correlation dimension", measures.draw_correlation, measures.caption_correlation),
    PageSection("surrogates", "Could it be noise?", surrogates.draw_tests, surrogates.caption_tests),
)


def write_analysis(folder: Path) -> Path:
    """Return the path of `report.html`, written from `analysis.json` and `analysis.nc` in the folder."""
    view = read_analysis(folder)
    return write_page(folder / "report.html", lambda: render(view), RERUN_HINT)


def render(view: AnalysisView) -> str:
    """Return the page as one self-contained HTML text."""
    result = view.result
    with style.use_style():
        figures = list(draw_sections(SECTIONS, view))
    first, *rest = tables.split_opening(result)
    kind, word = tables.name_verdict(result)
    return load_template("page.html.j2", __package__).render(
        title=result.title or "Analysis",
        kind=kind,
        verdict=word,
        answer=first,
        rest=rest,
        signs=tables.make_sign_rows(result),
        tally=tables.count_signs(result),
        because=[] if result.signs else _list_sentences(result.because),
        numbers=tables.make_number_rows(view),
        tests=tables.make_test_rows(result),
        notes=_list_sentences(result.notes),
        figures=figures,
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False, default=str),
    )


def _list_sentences(parts: tuple[str, ...]) -> list[str]:
    return [complete_sentence(part) for part in parts if part.strip()]
