"""The page of a calibration: whether ranks are uniform and intervals cover, and which machines were hardest."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from lostmotion.errors import DataError
from lostmotion.report import style
from lostmotion.report.pages import template, written
from lostmotion.report.posteriors import words_of
from lostmotion.report.words import DASH, figures, pretty, readable, sentence, spoken
from lostmotion.storage import load_json, require_files
from lostmotion_trials.coverage.figures import CAPTIONS, Found, ecdf, histograms, intervals

FILES = ("calibration.json", "machines.csv")
AGAIN = "run `lostmotion calibrate` again"


class Drawn(NamedTuple):
    """A figure as the template takes it."""

    name: str
    title: str
    markup: Markup
    caption: str


@dataclass(frozen=True)
class Calibration:
    """What a calibration wrote: the facts of its JSON, and its machines, columns by name."""

    facts: Mapping[str, Any]
    columns: Mapping[str, np.ndarray[Any, np.dtype[np.float64]]]

    @property
    def rows(self) -> Mapping[str, Mapping[str, Any]]:
        """What is said of each parameter."""
        rows: Mapping[str, Mapping[str, Any]] = self.facts["parameters"]
        return rows

    def found(self, *, drawn: bool) -> list[Found]:
        """Return the parameters that were drawn from a prior, or all of them, with their machines."""
        return [self._found(name, row) for name, row in self.rows.items() if row["drawn"] or not drawn]

    def _found(self, name: str, row: Mapping[str, Any]) -> Found:
        columns = {key: self.columns[f"{name}.{key}"] for key in ("truth", "low", "median", "high", "sd")}
        return Found(_words(name), row, columns)


def _words(name: str) -> str:
    """Return the name of a parameter as a reader meets it; the recording it belongs to stays behind it."""
    own, bracket, rest = name.partition("[")
    return (words_of(own) if "." in own else spoken(own)) + bracket + rest


def write_calibration(folder: Path) -> Path:
    """Return the path of `report.html`, written from `calibration.json` and `machines.csv` in the folder."""
    calibration = read_calibration(folder)
    return written(folder / "report.html", lambda: render(calibration), AGAIN)


def read_calibration(folder: Path) -> Calibration:
    """Return what `lostmotion calibrate` wrote into a folder."""
    require_files(folder, FILES, "lostmotion calibrate CASE.toml")
    facts = load_json(folder / "calibration.json", AGAIN)
    try:
        with (folder / "machines.csv").open(encoding="utf-8", newline="") as stream:
            head, *lines = csv.reader(stream)
        table = list(zip(head, zip(*lines, strict=True), strict=True))
        return Calibration(facts, {name: _numbers(cells) for name, cells in table if name != "status"})
    except (OSError, ValueError, csv.Error) as err:
        raise DataError(f"{folder / 'machines.csv'} cannot be read, or is damaged ({err}): {AGAIN}") from err


def _numbers(cells: tuple[str, ...]) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([float(cell) if cell else np.nan for cell in cells])


def render(calibration: Calibration) -> str:
    """Return the page as one self-contained HTML text."""
    facts = calibration.facts
    with style.applied():
        drawn = [
            Drawn(name, title, style.embedded(figure, name), said)
            for name, title, figure, said in _figures(calibration)
        ]
    return template("page.html.j2", __package__).render(
        title=str(facts["title"]),
        model=str(facts["model"]),
        passes=bool(facts["passes"]),
        badge=_badge(facts),
        answer=[str(part) for part in facts["says"]],
        facts=_facts(calibration),
        head=_head(calibration),
        rows=[_row(name, row) for name, row in calibration.rows.items()],
        figures=drawn,
        hardest=[_hard(one) for one in facts["hardest"]],
        lost=list(_lost(facts)),
        provenance=json.dumps(facts["provenance"], indent=2, ensure_ascii=False),
    )


def _badge(facts: Mapping[str, Any]) -> str:
    """Return the verdict in two words; of few machines nothing better can be said than that no fault was found."""
    if not facts["passes"]:
        return "Not calibrated"
    return "No fault found" if facts["few"] else "Calibrated"


def _figures(calibration: Calibration) -> Iterator[tuple[str, str, Figure, str]]:
    """Yield name, heading, drawing and caption of each figure that has something to show."""
    drawn, bands = calibration.found(drawn=True), calibration.facts["bands"]
    if drawn:
        yield "ranks", "Are the ranks uniform?", histograms(drawn, bands["histogram"]), CAPTIONS["ranks"]
        yield "ecdf", "Do they stay in their band?", ecdf(drawn, bands["ecdf"]), CAPTIONS["ecdf"]
    if everything := calibration.found(drawn=False):
        yield "intervals", "Where do intervals miss?", intervals(everything), CAPTIONS["intervals"]


def _facts(calibration: Calibration) -> list[str]:
    facts = calibration.facts
    hidden = ", ".join(f"{_words(name)} = {figures(value)}" for name, value in facts["hidden"].items())
    told = [
        f"{facts['machines']} machines, by the {facts['route']} route.",
        f"Machines are moved by {facts['moved_by']}.",
        f"Hidden in every machine: {hidden}." if hidden else "",
    ]
    return [line for line in told if line]


def _shares(calibration: Calibration) -> list[str]:
    return list(next(iter(calibration.rows.values()))["coverage"]) if calibration.rows else []


def _head(calibration: Calibration) -> list[str]:
    wide = [f"In {share} %" for share in _shares(calibration)]
    return ["Parameter", "Of", *wide, "χ² p", "ECDF p", "z mean", "z rms", "Relative sd"]


def _row(name: str, row: Mapping[str, Any]) -> list[tuple[str, bool]]:
    """Return the cells of a parameter, each with whether it is out of its limits."""
    covered = [_covered(one, drawn=row["drawn"]) for one in row["coverage"].values()]
    tests = [(figures(row[key], 2), False) for key in ("chi2_p", "ecdf_p")]
    numbers = [(figures(row[key], 3), False) for key in ("mean_z", "rms_z", "median_relative_sd")]
    count = str(next(iter(row["coverage"].values()))["of"])
    return [(_words(name), False), (count, False), *covered, *tests, *numbers]


def _covered(one: Mapping[str, int], *, drawn: bool) -> tuple[str, bool]:
    """Return how many truths an interval holds, with the limits of that number."""
    text = f"{one['inside']} ({one['low']}–{one['high']})"
    return text, drawn and not one["low"] <= one["inside"] <= one["high"]


def _hard(one: Mapping[str, Any]) -> list[str]:
    scale = readable(one["truth"], one["unit"])
    truth, median = (
        f"{figures(scale.factor * one[key], 6)} {pretty(scale.unit)}".rstrip() for key in ("truth", "median")
    )
    return [str(one["machine"]), _words(one["parameter"]), truth, median, figures(one["z"]) or DASH]


def _lost(facts: Mapping[str, Any]) -> Iterator[str]:
    for word in ("unconverged", "failed"):
        for one in facts[word]:
            yield f"Machine {one['machine']}, {word}: {sentence(str(one['says']))}"
