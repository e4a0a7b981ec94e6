"""The page of a diagnosis: its sections in their order, and what stands above and below them."""

from __future__ import annotations

import json
from pathlib import Path

from lostmotion.codec import to_plain
from lostmotion.diagnosis.report import (
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
    tables,
)
from lostmotion.diagnosis.report.evidence import AGAIN, Evidence, read_evidence
from lostmotion.report import style
from lostmotion.report.pages import PageSection, drawn, template, written
from lostmotion.report.words import headed, typeset

SECTIONS: tuple[PageSection[Evidence], ...] = (
    PageSection("prediction", "Recording and prediction", prediction.draw, prediction.caption),
    PageSection("decay", "Free decay", decay.draw, decay.caption, words=decay.words),
    PageSection("sensors", "All sensors", sensors.draw, sensors.caption, sensors.table),
    PageSection("missing", "The force that the model does not explain", missing.draw, missing.caption),
    PageSection("when", "When the model disagrees", strip.draw, strip.caption, strip.table),
    PageSection("learned", "The force that was learned", learned.draw, learned.caption),
    PageSection("ranking", "Which physics it may be", ranking.draw, ranking.caption),
    PageSection("parameters", "Parameters", posteriors.draw, posteriors.caption, posteriors.table),
    PageSection("sharing", "What recordings share", table=sharing.table, words=sharing.words),
    PageSection("portraits", portraits.title, portraits.draw, portraits.caption),
    PageSection("show", "Before and after in numbers", table=show.table, look="prose"),
    PageSection("growth", "How far ahead predictions hold", growth.draw, growth.caption),
    PageSection("whiteness", "Are the innovations white?", growth.draw_whiteness, growth.whiteness_caption),
)


def write_report(folder: Path) -> Path:
    """Return the path of `report.html`, written from `diagnosis.json` and `arrays.nc` in the folder."""
    evidence = read_evidence(folder)
    return written(folder / "report.html", lambda: render(evidence), AGAIN)


def render(evidence: Evidence) -> str:
    """Return the page as one self-contained HTML text."""
    result = evidence.result
    with style.applied(result.units.angle):
        sections = list(drawn(SECTIONS, evidence))
        numbers, mechanisms = tables.key_numbers(evidence), tables.mechanisms(evidence)
    return template("page.html.j2", __package__).render(
        title=result.title,
        badge=opening.badge(result),
        answer=[typeset(part) for part in headed(result.says)],
        model=result.model,
        numbers=numbers,
        mechanisms=mechanisms,
        sections=[one._replace(caption=typeset(one.caption), words=typeset(one.words)) for one in sections],
        notes=result.notes,
        confused=opening.confused(result),
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False),
    )
