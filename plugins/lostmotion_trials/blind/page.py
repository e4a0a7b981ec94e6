"""The page of a blind trial: targets, detection, probabilities, intervals, confusions, and every miss with its case."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from matplotlib.figure import Figure

from lostmotion.codec import from_plain, to_plain
from lostmotion.report import style
from lostmotion.report.pages import DrawnSection, load_template, write_page
from lostmotion.report.words import DASH, figures, percent, sentence, to_words, typeset
from lostmotion.storage import load_json, require_files
from lostmotion_trials.blind.figures import CAPTIONS, draw_detection, draw_heldout, draw_reliability
from lostmotion_trials.blind.results import (
    FalseAlarm,
    Miss,
    Outcomes,
    Proof,
    ProofSummary,
    SizeBin,
    SureCount,
    Target,
)
from lostmotion_trials.rates import Rate

AGAIN = "run `lostmotion prove` again"
IMPERFECT = (
    "Beside the hidden effect each machine has imperfections that no term describes: small smooth forces, friction with"
    " a random dependence on speed, a compliant foot, a mode far above the band, known values that are slightly wrong,"
    " a nonlinear sensor, and noise with AR(1) part, mains hum and quantisation. So no model is exactly true, and no"
    " effect has a size in log-likelihood."
)
DRIVES = {
    "all": "all",
    "cycle": "one cycle, repeated",
    "multisine": "multisine",
    "sweep": "sweep",
    "steps": "steps",
    "impacts": "impacts",
}


class Listed(NamedTuple):
    """A table for the template: each cell with whether it is outside of its target."""

    title: str
    head: list[str]
    rows: list[list[tuple[str, bool]]]
    note: str


def write_proof(folder: Path) -> Path:
    """Return the path of `report.html`, written from `proof.json` in the folder."""
    require_files(folder, ["proof.json"], "lostmotion prove")
    path = folder / "proof.json"
    proof = from_plain(Proof, load_json(path, AGAIN), str(path))
    return write_page(folder / "report.html", lambda: render(proof), AGAIN)


def render(proof: Proof) -> str:
    """Return the page as one self-contained HTML text."""
    summary = proof.summary
    with style.use_style():
        parts = _list_figures(summary)
        drawn = [
            DrawnSection(name, title, style.embed_figure(figure, name), CAPTIONS[name]) for name, title, figure in parts
        ]
    states = [row.state for row in summary.targets]
    return load_template("page.html.j2", __package__).render(
        title=proof.title,
        badge=_choose_badge(states),
        passes="missed" not in states and "met" in states,
        answer=[typeset(part) for part in summary.says],
        world=IMPERFECT if summary.sure else "",
        figures=drawn,
        targets=_list_targets(summary.targets),
        tables=[table for table in _list_tables(summary) if table.rows],
        lists=[(title, lines) for title, lines in _list_cases(summary) if lines],
        provenance=json.dumps(to_plain(proof.provenance), indent=2, ensure_ascii=False),
    )


def _choose_badge(states: list[str]) -> str:
    if "missed" in states:
        return "Targets missed"
    tried = [state for state in states if state != "not tried"]
    return "Targets met" if tried and set(tried) == {"met"} else "Not decided"


def _list_figures(summary: ProofSummary) -> Iterator[tuple[str, str, Figure]]:
    """Yield name, heading and drawing of each figure that has something to show."""
    if summary.sizes:
        yield "detection", "How small may an effect be?", draw_detection(summary)
    if any(row.rate.of for row in summary.reliability):
        yield "reliability", "Are stated probabilities right?", draw_reliability(summary)
    if summary.heldout.ratios:
        yield "heldout", "Is the found model as good as the true one?", draw_heldout(summary)


def _make_plain_cells(*cells: str) -> list[tuple[str, bool]]:
    return [(cell, False) for cell in cells]


def _format_rate(row: Rate) -> list[str]:
    """Return a share as two cells: the counts, and the share with its band."""
    if not row.of:
        return ["0", DASH]
    return [f"{row.hits} of {row.of}", f"{percent(row.share)} [{percent(row.low)}, {percent(row.high)}]"]


def _list_targets(targets: Sequence[Target]) -> Listed:
    rows = [
        [
            *_make_plain_cells(sentence(row.what), _format_wanted(row), *_format_rate(row.rate)),
            (row.state, row.state == "missed"),
        ]
        for row in targets
    ]
    return Listed("", ["Target", "Wanted", "Found", "Share, 95 % band", ""], rows, "")


def _format_wanted(row: Target) -> str:
    if row.at_most == 1.0:
        return f"≥ {percent(row.at_least)}"
    if row.at_least == 0.0:
        return f"≤ {percent(row.at_most)}"
    return f"{percent(row.at_least)} to {percent(row.at_most)}"


def _list_tables(summary: ProofSummary) -> Iterator[Listed]:
    """Yield the tables below the figures."""
    yield _list_sure(summary.sure)
    outcomes = ["Confused", "Noticed", "Misnamed", "Missed"]
    note = (
        "Confused: the diagnosis lists the truth among the mechanisms that it cannot distinguish from the named one."
        " Noticed: called unknown, or a random force. Misnamed: something else was named; in brackets how often that"
        " fits as well, to within 3 in log-likelihood. Without a term in the library an effect has no gain."
    )
    bins = [row for row in summary.detection if row.counts.rate.of]
    rows = [
        _make_plain_cells(_format_size(row), *_format_rate(row.counts.rate), *_format_outcomes(row.counts))
        for row in bins
    ]
    yield Listed("By size", ["Gain", "Named", "Share, 95 % band", *outcomes], rows, note)
    yield _list_mechanisms(summary, outcomes, note)
    rows = [_make_plain_cells(row.noise, *_format_rate(row.rate)) for row in summary.alarms if row.rate.of]
    title = "False sure names on machines that hide nothing" if summary.sure else "False alarms on clean cases"
    yield Listed(title, ["Measurement noise", "Cases", "Share, 95 % band"], rows, "")
    rows = [
        _make_plain_cells(_format_parameter(row.name), *_format_rate(row.rate), percent(row.median_relative_error))
        for row in summary.coverage
        if row.rate.of
    ]
    head = ["Parameter", "Truths inside", "Share, 95 % band", "Median error"]
    yield Listed(
        "Do 95 % intervals hold the truth?",
        head,
        rows,
        "For parameters of a mechanism: cases with white noise in which it was named exactly. For parameters of the"
        " machine: cases with white noise in which everything was named exactly.",
    )
    rows = [_make_plain_cells(to_words(row.truth), to_words(row.answer), str(row.cases)) for row in summary.confusion]
    yield Listed("What was taken for what", ["Truth", "Answer", "Times"], rows, "")


def _list_sure(counts: Sequence[SureCount]) -> Listed:
    """Return the table of the outcomes of sure names in an imperfect world, by the kind of drive."""
    rows = [
        _make_plain_cells(
            DRIVES.get(row.kind, row.kind),
            str(row.machines),
            *(", ".join(_format_rate(part)) for part in (row.rate, row.named, row.worse)),
        )
        for row in counts
    ]
    head = ["Drive", "Machines", "Names that are there", "Hidden effect named", "Held-out error rose"]
    note = (
        "Shares with exact 95 % bands. Any law of dry friction counts as correct for friction, since its true"
        " dependence on speed is random; every machine has a quantised sensor. Hidden effects that no term of the"
        " library describes are not counted among those that could be named."
    )
    return Listed("Names stated with more than 0.95", head, rows, note)


def _list_mechanisms(summary: ProofSummary, outcomes: list[str], note: str) -> Listed:
    """Return the table of outcomes by mechanism; in an imperfect world none has a gain or a true model."""
    head = ["Named", "Share, 95 % band"]
    counts = [(row, [*_format_rate(row.counts.rate), *_format_outcomes(row.counts)]) for row in summary.mechanisms]
    if summary.sure:
        rows = [_make_plain_cells(to_words(row.mechanism), *cells) for row, cells in counts]
        return Listed("By mechanism", ["Mechanism", *head, *outcomes], rows, note.partition("; in brackets")[0] + ".")
    rows = [
        _make_plain_cells(to_words(row.mechanism), figures(row.median_gain), *cells, row.bound_status)
        for row, cells in counts
    ]
    return Listed("By mechanism", ["Mechanism", "Median gain", *head, *outcomes, "True model"], rows, "")


def _format_size(row: SizeBin) -> str:
    return f"{figures(row.low)} to {figures(row.high)}" if math.isfinite(row.high) else f"over {figures(row.low)}"


def _format_outcomes(row: Outcomes) -> list[str]:
    counts = {name: str(count) for name, count in row.outcomes.items() if name != "hit"}
    if row.misnamed_alike:
        counts["misnamed"] += f" ({row.misnamed_alike})"
    return list(counts.values())


def _format_parameter(name: str) -> str:
    mechanism, dot, parameter = name.partition(".")
    return f"{to_words(mechanism)}, {parameter}" if dot else name


def _list_cases(summary: ProofSummary) -> Iterator[tuple[str, list[str]]]:
    """Yield the lists of single cases at the end of the page."""
    yield "Every effect that was not named", [_describe_miss(one, rough=bool(summary.sure)) for one in summary.misses]
    yield "Everything that was named and is not there", [_describe_alarm(one) for one in summary.false_alarms]
    yield "Cases without a diagnosis", [f"{one.case}: {sentence(one.says)}" for one in summary.failed]
    yield "Cases without a true model", [f"{one.case}: {sentence(one.says)}" for one in summary.unmeasured]


def _describe_miss(one: Miss, *, rough: bool) -> str:
    what = one.what or to_words(one.mechanism)
    at = f" at the {one.at}" if one.at else ""
    gain = one.status if math.isnan(one.gain) else f"gain {figures(one.gain)}"
    size = "" if rough else f" ({gain})"
    named = ", ".join(map(to_words, one.named)) or "nothing"
    margin = "" if math.isnan(one.margin) or not one.named else f", which fits worse by {figures(one.margin, 2)}"
    return f"{one.folder}: {what}{at}{size}, {one.outcome}; named was {named}{margin}."


def _describe_alarm(one: FalseAlarm) -> str:
    truth = ", ".join(map(to_words, one.truth)) or "nothing"
    return f"{one.folder}: {', '.join(map(to_words, one.named))}; hidden was {truth}."
