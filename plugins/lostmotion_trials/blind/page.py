"""The page of a blind trial: targets, detection, probabilities, intervals, confusions, and every miss with its case."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from markupsafe import Markup
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion.report.pages import template, written
from lostmotion.report.words import DASH, figures, percent, sentence, spoken, typeset
from lostmotion.storage import load_json, require_files
from lostmotion_trials.blind.figures import CAPTIONS, detection, heldout, reliability

Facts = Mapping[str, Any]
AGAIN = "run `lostmotion prove` again"
IMPERFECT = (
    "Beside what is hidden each machine has flaws that no term describes: small smooth forces, friction of a random"
    " curve over the speed, a foot that gives way, a far mode, known values that are slightly wrong, a bent sensor, and"
    " noise with a memory, hum and steps. So no model is true, and no effect has a size in log-likelihood."
)
DRIVES = {
    "all": "all",
    "cycle": "one cycle, repeated",
    "multisine": "multisine",
    "sweep": "sweep",
    "steps": "steps",
    "impacts": "impacts",
}


class Drawn(NamedTuple):
    """A figure as the template takes it."""

    name: str
    title: str
    markup: Markup
    caption: str


class Listed(NamedTuple):
    """A table as the template takes it: each cell with whether it is out of what was wanted."""

    title: str
    head: list[str]
    rows: list[list[tuple[str, bool]]]
    note: str


def write_proof(folder: Path) -> Path:
    """Return the path of `report.html`, written from `proof.json` in the folder."""
    require_files(folder, ["proof.json"], "lostmotion prove")
    facts = load_json(folder / "proof.json", AGAIN)
    return written(folder / "report.html", lambda: render(facts), AGAIN)


def render(facts: Facts) -> str:
    """Return the page as one self-contained HTML text."""
    with style.applied():
        parts = _figures(facts)
        drawn = [Drawn(name, title, style.embedded(figure, name), CAPTIONS[name]) for name, title, figure in parts]
    states, rough = [row["state"] for row in facts["targets"]], _rough(facts)
    return template("page.html.j2", __package__).render(
        title=str(facts["title"]),
        badge=_badge(states),
        passes="missed" not in states and "met" in states,
        answer=[typeset(str(part)) for part in facts["says"]],
        world=IMPERFECT if rough else "",
        figures=drawn,
        targets=_targets(facts),
        tables=[table for table in _tables(facts) if table.rows],
        lists=[(title, lines) for title, lines in _lists(facts) if lines],
        provenance=json.dumps(facts["provenance"], indent=2, ensure_ascii=False),
    )


def _rough(facts: Facts) -> bool:
    """Return whether machines had flaws that no term describes, so that no model is true and no effect has a gain."""
    return bool(facts.get("sure"))


def _badge(states: list[str]) -> str:
    if "missed" in states:
        return "Targets missed"
    tried = [state for state in states if state != "not tried"]
    return "Targets met" if tried and set(tried) == {"met"} else "Not decided"


def _figures(facts: Facts) -> Iterator[tuple[str, str, Figure]]:
    """Yield name, heading and drawing of each figure that has something to show."""
    if facts["sizes"]:
        yield "detection", "How small may an effect be?", detection(facts)
    if any(row["of"] for row in facts["reliability"]):
        yield "reliability", "Are stated probabilities right?", reliability(facts)
    if facts["heldout"]["ratios"]:
        yield "heldout", "Is the found model as good as the true one?", heldout(facts)


def _plain(*cells: str) -> list[tuple[str, bool]]:
    return [(cell, False) for cell in cells]


def _rate(row: Facts) -> list[str]:
    """Return a share as two cells: the counts, and the share with its band."""
    if not row["of"]:
        return ["0", DASH]
    return [f"{row['hits']} of {row['of']}", f"{percent(row['share'])} [{percent(row['low'])}, {percent(row['high'])}]"]


def _targets(facts: Facts) -> Listed:
    rows = []
    for row in facts["targets"]:
        wanted = f"≥ {percent(row['at_least'])}" if row["at_most"] == 1.0 else _between(row)
        rows.append([*_plain(sentence(row["what"]), wanted, *_rate(row)), (row["state"], row["state"] == "missed")])
    return Listed("", ["Target", "Wanted", "Found", "Share, 95 % band", ""], rows, "")


def _between(row: Facts) -> str:
    if row["at_least"] == 0.0:
        return f"≤ {percent(row['at_most'])}"
    return f"{percent(row['at_least'])} to {percent(row['at_most'])}"


def _tables(facts: Facts) -> Iterator[Listed]:
    """Yield the tables below the figures."""
    yield _sure(facts)
    outcomes = ["Confused", "Noticed", "Misnamed", "Missed"]
    note = (
        "Confused: the diagnosis lists the truth among what it cannot tell from what it named. Noticed: called unknown,"
        " or a random force. Misnamed: something else was named; in brackets how often that fits as well, to within 3"
        " in log-likelihood. Without a term in the library an effect has no gain."
    )
    rows = [_plain(_size(row), *_rate(row), *_outcomes(row)) for row in facts["detection"] if row["of"]]
    yield Listed("By size", ["Gain", "Named", "Share, 95 % band", *outcomes], rows, note)
    yield _mechanisms(facts, outcomes, note)
    rows = [_plain(row["noise"], *_rate(row)) for row in facts["alarms"] if row["of"]]
    title = "False sure names on machines that hide nothing" if _rough(facts) else "False alarms on clean cases"
    yield Listed(title, ["Measurement noise", "Cases", "Share, 95 % band"], rows, "")
    rows = [
        _plain(_words(row["name"]), *_rate(row), percent(row["median_relative_error"]))
        for row in facts["coverage"]
        if row["of"]
    ]
    head = ["Parameter", "Truths inside", "Share, 95 % band", "Median error"]
    yield Listed(
        "Do 95 % intervals hold the truth?",
        head,
        rows,
        "Of cases with white noise in which the parameter, and for those of the machine everything, was named exactly.",
    )
    rows = [_plain(spoken(row["truth"]), spoken(row["answer"]), str(row["cases"])) for row in facts["confusion"]]
    yield Listed("What was taken for what", ["Truth", "Answer", "Times"], rows, "")


def _sure(facts: Facts) -> Listed:
    """Return what became of sure names in an imperfect world, by the kind of drive."""
    rows = [
        _plain(
            DRIVES.get(row["kind"], row["kind"]),
            str(row["machines"]),
            *(", ".join(_rate(part)) for part in (row, row["named"], row["worse"])),
        )
        for row in facts.get("sure", ())
    ]
    head = ["Drive", "Machines", "Names that are there", "Hidden effect named", "Held-out error rose"]
    note = (
        "Shares with exact 95 % bands. Any law of dry friction names friction, for its true curve over the speed is a"
        " random one; quantisation of the sensor is on every machine. Hidden effects that no term of the library"
        " describes are not counted among those that could be named."
    )
    return Listed("Names stated with more than 0.95", head, rows, note)


def _mechanisms(facts: Facts, outcomes: list[str], note: str) -> Listed:
    """Return what became of each mechanism; in an imperfect world none has a gain or a true model."""
    head, counts = ["Named", "Share, 95 % band"], [(row, [*_rate(row), *_outcomes(row)]) for row in facts["mechanisms"]]
    if _rough(facts):
        rows = [_plain(spoken(row["mechanism"]), *cells) for row, cells in counts]
        return Listed("By mechanism", ["Mechanism", *head, *outcomes], rows, note.partition("; in brackets")[0] + ".")
    rows = [
        _plain(spoken(row["mechanism"]), figures(row["median_gain"]), *cells, row["oracle"]) for row, cells in counts
    ]
    return Listed("By mechanism", ["Mechanism", "Median gain", *head, *outcomes, "True model"], rows, "")


def _size(row: Facts) -> str:
    return (
        f"{figures(row['from'])} to {figures(row['to'])}" if row["to"] is not None else f"over {figures(row['from'])}"
    )


def _outcomes(row: Facts) -> list[str]:
    counts = {name: str(count) for name, count in row["outcomes"].items() if name != "hit"}
    if row["misnamed_alike"]:
        counts["misnamed"] += f" ({row['misnamed_alike']})"
    return list(counts.values())


def _words(name: str) -> str:
    mechanism, dot, parameter = name.partition(".")
    return f"{spoken(mechanism)}, {parameter}" if dot else name


def _lists(facts: Facts) -> Iterator[tuple[str, list[str]]]:
    """Yield the lists of single cases at the end of the page."""
    rough = _rough(facts)
    yield "Every effect that was not named", [_missed(one, rough=rough) for one in facts["misses"]]
    yield "Everything that was named and is not there", [_alarm(one) for one in facts["false_alarms"]]
    yield "Cases without a diagnosis", [f"{one['case']}: {sentence(one['says'])}" for one in facts["failed"]]
    yield "Cases without a true model", [f"{one['case']}: {sentence(one['says'])}" for one in facts["unmeasured"]]


def _missed(one: Facts, *, rough: bool) -> str:
    what = one["what"] or spoken(one["mechanism"])
    at = f" at the {one['at']}" if one["at"] else ""
    gain = one["status"] if one["gain"] is None else f"gain {figures(one['gain'])}"
    size = "" if rough else f" ({gain})"
    named = ", ".join(map(spoken, one["named"])) or "nothing"
    margin = "" if one["margin"] is None or not one["named"] else f", which fits worse by {figures(one['margin'], 2)}"
    return f"{one['folder']}: {what}{at}{size}, {one['outcome']}; named was {named}{margin}."


def _alarm(one: Facts) -> str:
    truth = ", ".join(map(spoken, one["truth"])) or "nothing"
    return f"{one['folder']}: {', '.join(map(spoken, one['named']))}; hidden was {truth}."
