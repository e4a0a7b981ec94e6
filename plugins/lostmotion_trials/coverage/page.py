"""The page of a calibration: whether ranks are uniform and intervals cover, and which machines were hardest."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from lostmotion.codec import from_plain, to_plain
from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.report import style
from lostmotion.report.pages import DrawnSection, template, written
from lostmotion.report.words import DASH, figures, pretty, readable, sentence, spoken, words_of
from lostmotion.storage import load_json, require_files
from lostmotion_trials.coverage.figures import CAPTIONS, Found, ecdf, histograms, intervals
from lostmotion_trials.coverage.results import (
    CalibrationResult,
    CalibrationSummary,
    Coverage,
    HardMachine,
    ParameterCheck,
)

FILES = ("calibration.json", "machines.csv")
AGAIN = "run `lostmotion calibrate` again"


@dataclass(frozen=True)
class Calibration:
    """What a calibration wrote: the facts of its JSON, and its machines, columns by name."""

    facts: CalibrationResult
    columns: Mapping[str, Array]

    @property
    def summary(self) -> CalibrationSummary:
        """What all machines say together."""
        return self.facts.summary

    def found(self, *, drawn: bool) -> list[Found]:
        """Return the parameters that were drawn from a prior, or all of them, with their machines."""
        return [self._found(name, row) for name, row in self.summary.parameters.items() if row.drawn or not drawn]

    def _found(self, name: str, row: ParameterCheck) -> Found:
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
    path = folder / "calibration.json"
    facts = from_plain(CalibrationResult, load_json(path, AGAIN), str(path))
    try:
        with (folder / "machines.csv").open(encoding="utf-8", newline="") as stream:
            head, *lines = csv.reader(stream)
        table = list(zip(head, zip(*lines, strict=True), strict=True))
        return Calibration(facts, {name: _numbers(cells) for name, cells in table if name != "status"})
    except (OSError, ValueError, csv.Error) as err:
        raise DataError(f"{folder / 'machines.csv'} cannot be read, or is damaged ({err}): {AGAIN}") from err


def _numbers(cells: tuple[str, ...]) -> Array:
    return np.array([float(cell) if cell else np.nan for cell in cells])


def render(calibration: Calibration) -> str:
    """Return the page as one self-contained HTML text."""
    facts, summary = calibration.facts, calibration.summary
    with style.applied():
        drawn = [
            DrawnSection(name, title, style.embedded(figure, name), said)
            for name, title, figure, said in _figures(calibration)
        ]
    return template("page.html.j2", __package__).render(
        title=facts.title,
        model=facts.model,
        passes=summary.passes,
        badge=_badge(summary),
        answer=summary.says,
        facts=_facts(facts),
        head=_head(summary),
        rows=[_row(name, row) for name, row in summary.parameters.items()],
        figures=drawn,
        hardest=[_hard(one) for one in summary.hardest],
        lost=list(_lost(summary)),
        provenance=json.dumps(to_plain(facts.provenance), indent=2, ensure_ascii=False),
    )


def _badge(summary: CalibrationSummary) -> str:
    """Return the verdict in two words; of few machines nothing better can be said than that no fault was found."""
    if not summary.passes:
        return "Not calibrated"
    return "No fault found" if summary.few else "Calibrated"


def _figures(calibration: Calibration) -> Iterator[tuple[str, str, Figure, str]]:
    """Yield name, heading, drawing and caption of each figure that has something to show."""
    drawn, bands = calibration.found(drawn=True), calibration.summary.bands
    if drawn and bands.histogram and bands.ecdf:
        yield "ranks", "Are the ranks uniform?", histograms(drawn, bands.histogram), CAPTIONS["ranks"]
        yield "ecdf", "Do they stay in their band?", ecdf(drawn, bands.ecdf), CAPTIONS["ecdf"]
    if everything := calibration.found(drawn=False):
        yield "intervals", "Where do intervals miss?", intervals(everything), CAPTIONS["intervals"]


def _facts(facts: CalibrationResult) -> list[str]:
    hidden = ", ".join(f"{_words(name)} = {figures(value)}" for name, value in facts.hidden.items())
    told = [
        f"{facts.summary.machines} machines, by the {facts.route} route.",
        f"Machines are moved by {facts.moved_by}.",
        f"Hidden in every machine: {hidden}." if hidden else "",
    ]
    return [line for line in told if line]


def _head(summary: CalibrationSummary) -> list[str]:
    shares = next((list(row.coverage) for row in summary.parameters.values()), [])
    wide = [f"In {share} %" for share in shares]
    return ["Parameter", "Of", *wide, "χ² p", "ECDF p", "z mean", "z rms", "Relative sd"]


def _row(name: str, row: ParameterCheck) -> list[tuple[str, bool]]:
    """Return the cells of a parameter, each with whether it is out of its limits."""
    covered = [_covered(one, drawn=row.drawn) for one in row.coverage.values()]
    tests = [(figures(p, 2), False) for p in (row.chi2_p, row.ecdf_p)]
    numbers = [(figures(x, 3), False) for x in (row.mean_z, row.rms_z, row.median_relative_sd)]
    count = str(next(iter(row.coverage.values())).of)
    return [(_words(name), False), (count, False), *covered, *tests, *numbers]


def _covered(one: Coverage, *, drawn: bool) -> tuple[str, bool]:
    """Return how many truths an interval holds, with the limits of that number."""
    text = f"{one.inside} ({one.low}–{one.high})"
    return text, drawn and not one.low <= one.inside <= one.high


def _hard(one: HardMachine) -> list[str]:
    scale = readable(one.truth, one.unit)
    truth, median = (f"{figures(scale.factor * x, 6)} {pretty(scale.unit)}".rstrip() for x in (one.truth, one.median))
    return [str(one.machine), _words(one.parameter), truth, median, figures(one.z) or DASH]


def _lost(summary: CalibrationSummary) -> Iterator[str]:
    for word, machines in summary.lost.items():
        for one in machines:
            yield f"Machine {one.machine}, {word}: {sentence(one.says)}"
