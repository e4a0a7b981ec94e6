"""The screen of results: the answer, predictions with terms switched on and off, missing force, report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

import panel as pn

import lostmotion
from lostmotion.diagnosis.guest_sections import find_sections
from lostmotion.diagnosis.report import diagnosis_page, opening
from lostmotion.diagnosis.report.top_tables import make_mechanism_table, make_number_table
from lostmotion.notebook.diagnosis_result import DiagnosisResult
from lostmotion.notebook.robot_objects import RobotResult
from lostmotion.report import style
from lostmotion.report.pages import Grid, PageSection
from lostmotion.report.words import format_quantity, percent, sentence, to_words, typeset
from lostmotion.robots import arm_page
from lostmotion.storage import load_json
from lostmotion_app.desk import CASE, DIAGNOSIS, Desk
from lostmotion_app.found_figures import MissingForce, SwitchedPrediction
from lostmotion_app.parts import (
    make_html,
    run_next,
    write_answer,
    write_command,
    write_heading,
    write_list,
    write_note,
    write_table,
)  # fmt: skip
from lostmotion_app.remedies import WarnedCase
from lostmotion_app.result_warnings import list_result_warnings
from lostmotion_app.screens import PageScreen
from lostmotion_app.sections import write_grid, write_sections
from lostmotion_app.warning_list import WarningList

ELSEWHERE = ("prediction", "missing")
"""Sections of the report that this screen has in another form."""
FIRST = ("joints", "ranking")
"""The section that is seen first, for machines and for robots."""
MOST_EARLIER = 30
CHANGED = "The case has changed since this diagnosis: run it again."


class ResultsScreen(PageScreen):
    """What a diagnosis found."""

    title = "Results"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.choice = pn.widgets.Select(name="Result", sizing_mode="stretch_width", max_width=520)
        self.section = pn.widgets.Select(name="Section of the report", width=320)
        self.answer, self.drawn, self.earlier, self.same, self.stale = (make_html() for _ in range(5))
        self.warnings = WarningList(desk, self._show_changed)
        self.prediction, self.missing = SwitchedPrediction(), MissingForce()
        self.found: DiagnosisResult | RobotResult | None = None
        self.sections: tuple[PageSection[Any], ...] = ()
        self.shown: tuple[str, float] = ("", 0.0)
        self.choice.param.watch(lambda _: self._open(), "value")
        self.section.param.watch(lambda _: self._draw_section(), "value")

    def make_view(self) -> Any:
        """Return the parts of the screen below each other."""
        return pn.Column(
            self.choice, self.problem.pane, self.earlier, self.stale, self.warnings.view, self.answer,
            self.prediction.view, self.missing.view, self.section, self.drawn, self.same, sizing_mode="stretch_width",
        )  # fmt: skip

    def show(self) -> None:
        """List the results of the folder, those of this recording first, and show the newest one."""
        folders, own = self.desk.folder.list_results(DIAGNOSIS), self.desk.list_results()
        names = [self.desk.folder.name_of(one) for one in (*own, *(one for one in folders if one not in own))]
        self._compare(names)
        newest = names[0] if names else None
        if names != self.choice.options:
            self.choice.options = names
        if not names:
            self.answer.object = write_note("This folder has no result yet: begin one on the screen Run.")
        elif self.choice.value != newest and newest != self.shown[0]:
            self.choice.value = newest
        else:
            self._open()

    def _open(self) -> None:
        """Show the chosen result, if it is another one or has changed."""
        name = self.choice.value
        if not name:
            return
        with self.problem.watch():
            folder = self.desk.folder.find(name)
            now = (name, (folder / DIAGNOSIS).stat().st_mtime)
            if now == self.shown:
                self._list_warnings()
            else:
                self.shown = now
                self.warnings.forget()
                self.answer.object = write_note(f"Reading {name} ...")
                run_next(lambda: self._show_result(folder))

    def _show_result(self, folder: Path) -> None:
        self.found, self.sections = None, ()
        guests: tuple[str, ...] = ()
        with self.problem.watch():
            self.found = found = lostmotion.load(folder)
            self.answer.object = write_answer([typeset(one) for one in found.says])
            plain = found if isinstance(found, DiagnosisResult) else None
            if plain is None:
                self.sections = arm_page.SECTIONS
            else:
                self.answer.object += write_summary(plain)
                self.sections = tuple(one for one in diagnosis_page.SECTIONS if one.name not in ELSEWHERE)
                guests = tuple(find_sections(self.desk.registry))
            self.prediction.show(plain, folder, self.desk.registry)
            self.missing.show(plain)
        titles = {one.title if isinstance(one.title, str) else one.name: one.name for one in self.sections}
        titles |= {sentence(to_words(guest)): guest for guest in guests}
        self.section.visible = bool(titles)
        self.section.options = titles
        self.section.value = next((name for name in FIRST if name in titles.values()), None)
        self.same.object = write_command(
            "lostmotion", "diagnose", "CASE.toml", "--out", self.desk.folder.name_of(folder)
        )
        self._draw_section()
        run_next(self._list_warnings)

    def _show_changed(self) -> None:
        """Show what is left of the warnings after a remedy; the result is that of the case before."""
        self.desk.tell()
        run_next(self._list_warnings)

    def _list_warnings(self) -> None:
        """Show the warnings of a result about the case of this recording, if the case is still that of the result."""
        with self.problem.watch():
            folder, found = self.desk.folder.find(self.shown[0]), self.found
            own = folder in self.desk.list_results() and (folder / CASE).is_file() and bool(self.desk.content)
            changed = own and self.desk.has_changed(folder)
            self.stale.object = write_note(CHANGED) if changed else ""
            warned: list[WarnedCase] = []
            if isinstance(found, DiagnosisResult) and own and not changed:
                warned += list_result_warnings(found.result, self.desk)
            self.warnings.show(warned)

    def _draw_section(self) -> None:
        self.drawn.object = ""
        if self.found is None or not self.section.value:
            return
        with self.problem.watch():
            found, name = self.found, str(self.section.value)
            chosen = [one for one in self.sections if one.name == name]
            guests = {name: find_sections(self.desk.registry)[name]} if not chosen else {}
            angle = found.result.units.angle if isinstance(found, DiagnosisResult) else "rad"
            evidence: Any = found.evidence
            drawn = write_sections(chosen, evidence, angle, guests)
            self.drawn.object = drawn or write_note("This result has nothing to show here.")

    def _compare(self, names: Sequence[str]) -> None:
        """Show the results of the folder side by side."""
        rows = []
        for name in names[:MOST_EARLIER]:
            with self.problem.watch():
                file = self.desk.folder.find(name) / DIAGNOSIS
                content = load_json(file, "run `lostmotion diagnose` again")
                made = datetime.fromtimestamp(file.stat().st_mtime).strftime("%d %b %H:%M")
                rows.append([name, made, *describe_result(content)])
        head = ["Result", "Made", "Verdict", "Found", "Parameters", "Error before", "Error after"]
        several = len(rows) > 1
        title = write_heading("Results in this folder, side by side")
        self.earlier.object = title + write_table(head, rows) if several else ""


def write_summary(found: DiagnosisResult) -> str:
    """Return the tables at the top of the report, what cannot be told apart, and the notes, as HTML."""
    with style.use_style(found.result.units.angle):
        tables = [make_mechanism_table(found.evidence), make_number_table(found.evidence)]
    confused = opening.write_confusions(found.result)
    tables[0] = Grid(tables[0].head[:-1], [row[:-1] for row in tables[0].rows])  # the answer has the sentences
    parts = [write_grid(table) for table in tables if table.rows]
    parts += [write_heading("Not told apart, and the next experiment"), write_list(confused)] if confused else []
    parts += [write_heading("Notes"), write_list(found.notes)] if found.notes else []
    return "".join(parts)


def describe_result(content: Any) -> list[str]:
    """Return verdict, findings, parameters and errors of free runs of a stored result, in words."""
    found = [
        f"{sentence(to_words(str(one.get('mechanism', ''))))}: {list_medians(one.get('parameters', {}))}"
        for one in content.get("found", ())
    ]
    after = content.get("parameters", {}).get("after", {})
    own = list_medians({name: one for name, one in after.items() if "." not in name})
    fit = content.get("fit", {})
    errors = [fit.get(key, {}).get("heldout_nrmse") for key in ("before", "after")]
    return [
        str(content.get("verdict", "")), "; ".join(found) or "nothing", own,
        *(percent(one) if one is not None else "" for one in errors),
    ]  # fmt: skip


def list_medians(parameters: Mapping[str, Any]) -> str:
    """Return the medians of parameters with their units, in words."""
    told = (f"{to_words(name)} {format_quantity(one['median'], one['unit'])}" for name, one in parameters.items()
            if isinstance(one, Mapping))  # fmt: skip
    return ", ".join(told)
