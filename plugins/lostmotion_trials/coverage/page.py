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
from lostmotion.report.pages import DrawnSection, load_template, write_page
from lostmotion.report.words import DASH, choose_scale, figures, format_unit, sentence, to_words, words_of
from lostmotion.storage import load_json, require_files
from lostmotion_trials.coverage.figures import CAPTIONS, Found, draw_ecdf, draw_histograms, draw_intervals
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
        return Found(_format_name(name), row, columns)


def _format_name(name: str) -> str:
    """Return the name of a parameter in words, followed by that of its recording."""
    own, bracket, rest = name.partition("[")
    return (words_of(own) if "." in own else to_words(own)) + bracket + rest


def write_calibration(folder: Path) -> Path:
    """Return the path of `report.html`, written from `calibration.json` and `machines.csv` in the folder."""
    calibration = read_calibration(folder)
    return write_page(folder / "report.html", lambda: render(calibration), AGAIN)


def read_calibration(folder: Path) -> Calibration:
    """Return what `lostmotion calibrate` wrote into a folder."""
    require_files(folder, FILES, "lostmotion calibrate CASE.toml")
    path = folder / "calibration.json"
    facts = from_plain(CalibrationResult, load_json(path, AGAIN), str(path))
    try:
        with (folder / "machines.csv").open(encoding="utf-8", newline="") as stream:
            head, *lines = csv.reader(stream)
        table = list(zip(head, zip(*lines, strict=True), strict=True))
        return Calibration(facts, {name: _read_numbers(cells) for name, cells in table if name != "status"})
    except (OSError, ValueError, csv.Error) as err:
        raise DataError(f"{folder / 'machines.csv'} cannot be read, or is damaged ({err}): {AGAIN}") from err


def _read_numbers(cells: tuple[str, ...]) -> Array:
    return np.array([float(cell) if cell else np.nan for cell in cells])


def render(calibration: Calibration) -> str:
    """Return the page as one self-contained HTML text."""
    facts, summary = calibration.facts, calibration.summary
    with style.use_style():
        drawn = [
            DrawnSection(name, title, style.embed_figure(figure, name), said)
            for name, title, figure, said in _list_figures(calibration)
        ]
    return load_template("page.html.j2", __package__).render(
        title=facts.title,
        model=facts.model,
        passes=summary.passes,
        badge=_choose_badge(summary),
        answer=summary.says,
        facts=_list_facts(facts),
        head=_make_head(summary),
        rows=[_make_row(name, row) for name, row in summary.parameters.items()],
        figures=drawn,
        hardest=[_format_hardest(one) for one in summary.hardest],
        lost=list(_list_lost(summary)),
        provenance=json.dumps(to_plain(facts.provenance), indent=2, ensure_ascii=False),
    )


def _choose_badge(summary: CalibrationSummary) -> str:
    """Return the verdict in two words; with few machines the best verdict is that no fault was found."""
    if not summary.passes:
        return "Not calibrated"
    return "No fault found" if summary.few else "Calibrated"


def _list_figures(calibration: Calibration) -> Iterator[tuple[str, str, Figure, str]]:
    """Yield name, heading, drawing and caption of each figure that has something to show."""
    drawn, bands = calibration.found(drawn=True), calibration.summary.bands
    if drawn and bands.histogram and bands.ecdf:
        yield "ranks", "Are the ranks uniform?", draw_histograms(drawn, bands.histogram), CAPTIONS["ranks"]
        yield "ecdf", "Is their distribution within its band?", draw_ecdf(drawn, bands.ecdf), CAPTIONS["ecdf"]
    if everything := calibration.found(drawn=False):
        yield "intervals", "Which intervals miss the truth?", draw_intervals(everything), CAPTIONS["intervals"]


def _list_facts(facts: CalibrationResult) -> list[str]:
    hidden = ", ".join(f"{_format_name(name)} = {figures(value)}" for name, value in facts.hidden.items())
    told = [
        f"{facts.summary.machines} machines, by the {facts.route} route.",
        f"Machines are simulated by {facts.moved_by}.",
        f"Hidden in every machine: {hidden}." if hidden else "",
    ]
    return [line for line in told if line]


def _make_head(summary: CalibrationSummary) -> list[str]:
    shares = next((list(row.coverage) for row in summary.parameters.values()), [])
    wide = [f"In {share} %" for share in shares]
    return ["Parameter", "Of", *wide, "χ² p", "ECDF p", "z mean", "z rms", "Relative sd"]


def _make_row(name: str, row: ParameterCheck) -> list[tuple[str, bool]]:
    """Return the cells of a parameter, each with whether it is out of its limits."""
    covered = [_format_coverage(one, drawn=row.drawn) for one in row.coverage.values()]
    tests = [(figures(p, 2), False) for p in (row.chi2_p, row.ecdf_p)]
    numbers = [(figures(x, 3), False) for x in (row.mean_z, row.rms_z, row.median_relative_sd)]
    count = str(next(iter(row.coverage.values())).of)
    return [(_format_name(name), False), (count, False), *covered, *tests, *numbers]


def _format_coverage(one: Coverage, *, drawn: bool) -> tuple[str, bool]:
    """Return how many truths an interval covers, with the limits of that number."""
    text = f"{one.inside} ({one.low}–{one.high})"
    return text, drawn and not one.low <= one.inside <= one.high


def _format_hardest(one: HardMachine) -> list[str]:
    scale = choose_scale(one.truth, one.unit)
    truth, median = (
        f"{figures(scale.factor * x, 6)} {format_unit(scale.unit)}".rstrip() for x in (one.truth, one.median)
    )
    return [str(one.machine), _format_name(one.parameter), truth, median, figures(one.z) or DASH]


def _list_lost(summary: CalibrationSummary) -> Iterator[str]:
    for word, machines in summary.lost.items():
        for one in machines:
            yield f"Machine {one.machine}, {word}: {sentence(one.says)}"
