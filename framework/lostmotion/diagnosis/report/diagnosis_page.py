"""The page of a diagnosis: its sections in order, and the texts above and below them."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from lostmotion.codec import to_plain
from lostmotion.diagnosis.report import (
    absent_table,
    behaviour_table,
    check_page,
    decay_figure,
    friction_figure,
    growth,
    learned_figure,
    missing,
    opening,
    parameter_figure,
    portraits,
    prediction,
    ranking,
    sensor_figure,
    sharing_table,
    strip,
    top_tables,
)
from lostmotion.diagnosis.report.page_data import RERUN_HINT, Evidence, read_evidence
from lostmotion.report import style
from lostmotion.report.pages import PageSection, draw_guests, draw_sections, load_template, write_page
from lostmotion.report.words import split_headline, typeset
from lostmotion.storage import save_datasets, save_json

SECTIONS: tuple[PageSection[Evidence], ...] = (
    PageSection(
        "expected",
        "What this recording can tell",
        check_page.draw_expected,
        check_page.caption_expected,
        check_page.make_expected_table,
        check_page.write_expected,
        requires=("expected",),
    ),
    PageSection(
        "prediction", "Recording and prediction", prediction.draw, prediction.caption, requires=("time", "response")
    ),
    PageSection(
        "decay",
        "Free decay",
        decay_figure.draw,
        decay_figure.caption,
        words=decay_figure.write_words,
        requires=("decay",),
    ),
    PageSection(
        "sensors",
        "All sensors",
        sensor_figure.draw,
        sensor_figure.caption,
        sensor_figure.make_table,
        requires=("response_2",),
    ),
    PageSection("missing", "The force that the model does not explain", missing.draw, missing.caption),
    PageSection("when", "When the model disagrees", strip.draw, strip.caption, strip.make_table),
    PageSection("learned", "The learned force", learned_figure.draw, learned_figure.caption, requires=("found",)),
    PageSection(
        "levels",
        "Friction over the time",
        friction_figure.draw,
        friction_figure.caption,
        requires=("friction_level",),
    ),
    PageSection("ranking", "Ranking of the candidates", ranking.draw, ranking.caption, requires=("ranking",)),
    PageSection(
        "absent",
        "What is not missing",
        absent_table.draw,
        absent_table.caption,
        absent_table.make_table,
        absent_table.write_words,
    ),
    PageSection(
        "parameters", "Parameters", parameter_figure.draw, parameter_figure.caption, parameter_figure.make_table
    ),
    PageSection(
        "sharing",
        "Parameters in each recording",
        table=sharing_table.make_table,
        words=sharing_table.write_words,
        requires=("sharing",),
    ),
    PageSection("portraits", portraits.make_title, portraits.draw, portraits.caption),
    PageSection("show", "Before and after in numbers", table=behaviour_table.make_table, look="prose"),
    PageSection("growth", "Growth of the prediction error", growth.draw, growth.caption, requires=("lead",)),
    PageSection("whiteness", "Are the innovations white?", growth.draw_whiteness, growth.caption_whiteness),
)


Guests = Mapping[str, Callable[[], PageSection[Evidence]]]
"""The sections of third parties, by name, each with the function that loads it."""
NONE: Guests = MappingProxyType({})


def write_report(folder: Path, guests: Guests = NONE) -> Path:
    """Return the path of `report.html`, written from `diagnosis.json` and `arrays.nc` in the folder."""
    evidence = read_evidence(folder)
    return write_page(folder / "report.html", lambda: render(evidence, guests), RERUN_HINT)


def save_diagnosis(evidence: Evidence, folder: Path, guests: Guests = NONE) -> Path:
    """Return the folder after writing `diagnosis.json`, `arrays.nc` and `report.html` into it."""
    save_datasets(folder / "arrays.nc", {None: evidence.data})
    save_json(folder / "diagnosis.json", to_plain(evidence.result))
    write_report(folder, guests)
    return folder


def render(evidence: Evidence, guests: Guests = NONE) -> str:
    """Return the page as one self-contained HTML text; sections of `guests` follow those of the framework."""
    result = evidence.result
    with style.use_style(result.units.angle):
        sections = [*draw_sections(SECTIONS, evidence), *draw_guests(guests, evidence)]
        numbers, mechanisms = top_tables.make_number_table(evidence), top_tables.make_mechanism_table(evidence)
    return load_template("page.html.j2", __package__).render(
        title=result.title,
        badge=opening.make_badge(result),
        answer=[typeset(part) for part in split_headline(result.says)],
        model=result.model,
        numbers=numbers,
        mechanisms=mechanisms,
        sections=[one._replace(caption=typeset(one.caption), words=typeset(one.words)) for one in sections],
        notes=result.notes,
        confused=opening.write_confusions(result),
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False),
    )
