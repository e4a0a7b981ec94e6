"""The page of an analysis: what kind of motion it is, how sure that is, and every curve behind it."""

from __future__ import annotations

import json
from pathlib import Path

from lostmotion.report import analysis_embedding as embedding
from lostmotion.report import analysis_measures as measures
from lostmotion.report import analysis_motion as motion
from lostmotion.report import analysis_surrogates as surrogates
from lostmotion.report import analysis_tables as tables
from lostmotion.report import style
from lostmotion.report.analysis_facts import AGAIN, AnalysisEvidence, read_analysis, whole
from lostmotion.report.pages import PageSection, drawn, template, written

SECTIONS: tuple[PageSection[AnalysisEvidence], ...] = (
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
    evidence = read_analysis(folder)
    return written(folder / "report.html", lambda: render(evidence), AGAIN)


def render(evidence: AnalysisEvidence) -> str:
    """Return the page as one self-contained HTML text."""
    with style.applied():
        figures = list(drawn(SECTIONS, evidence))
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
        figures=figures,
        provenance=json.dumps(evidence.fact("provenance") or {}, indent=2, ensure_ascii=False, default=str),
    )


def _strings(evidence: AnalysisEvidence, key: str) -> list[str]:
    found = evidence.fact(key)
    return [whole(str(part)) for part in found if str(part).strip()] if isinstance(found, list) else []
