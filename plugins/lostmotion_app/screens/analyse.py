"""The screen of an analysis: whether the motion is periodic, quasiperiodic, chaotic or noise."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import panel as pn

import lostmotion
from lostmotion.errors import CaseError
from lostmotion.recording.formats import read_table
from lostmotion.report.words import sentence, typeset
from lostmotion_app.desk import Desk
from lostmotion_app.job_view import JobView
from lostmotion_app.jobs import Job
from lostmotion_app.parts import make_html, write_answer, write_heading, write_list, write_note, write_table
from lostmotion_app.screens import PageScreen
from lostmotion_app.sections import write_sections
from lostmotion_chaos.analysis.report.page import SECTIONS
from lostmotion_chaos.analysis.report.view import make_view


class AnalyseScreen(PageScreen):
    """Delay, dimension, exponents, surrogates, and the verdict with its signs."""

    title = "Analyse"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.column = pn.widgets.Select(name="Column (--column)", width=260)
        self.drawn = make_html()
        self.section = pn.widgets.Select(
            name="Figure", options={str(one.title): one.name for one in SECTIONS}, width=320
        )
        self.section.visible = False
        self.folder: Any = None
        self.of = ""
        self.jobs = JobView(desk, "analyse", "Analyse", self._list_options, self._show_result, case=False)
        self.section.param.watch(lambda _: self._draw(), "value")
        self.column.param.watch(lambda _: self.jobs.refresh(), "value")

    def make_view(self) -> Any:
        """Return the column above the verdict and its figures."""
        about = "Is the motion periodic, quasiperiodic, chaotic or noise? It needs no model."
        view = self.jobs.make_view(self.problem.pane, self.section, self.drawn)
        return pn.Column(make_html(write_note(about)), self.column, view, sizing_mode="stretch_width")

    def show(self) -> None:
        """Offer the columns of the recording, and show its newest analysis."""
        with self.problem.watch():
            if self.desk.is_given:
                raise CaseError(f"{self.desk.recording} is a case: choose one of its recordings on the screen Data")
            if self.desk.recording and self.desk.recording != self.of:
                self.of = self.desk.recording
                names = list(read_table(self.desk.folder.find(self.desk.recording)).full_names)
                first = self.desk.content.get("recordings", [{}])[0].get("sensors", [{}])[0].get("column")
                self.column.param.update(options=names, value=first if first in names else names[-1])
            self.folder, self.drawn.object, self.section.visible = None, "", False
            self.jobs.watched = None
            self.jobs.refresh()

    def _list_options(self) -> Sequence[str]:
        return ["--column", str(self.column.value)] if self.column.value else []

    def _show_result(self, job: Job) -> str:
        self.folder = job.folder
        found = lostmotion.load(job.folder)
        signs = [[one.name, one.state, typeset(one.says)] for one in found.result.signs]
        parts = [write_answer([sentence(f"{found.verdict}: {typeset(found.result.says)}")])]
        parts += [write_heading("Signs of chaos"), write_table(["Sign", "Says", "Why"], signs)] if signs else []
        parts.append(write_list(found.result.notes))
        self.section.visible = True
        self._draw()
        return "".join(parts)

    def _draw(self) -> None:
        """Draw the chosen figure of the newest analysis."""
        if self.folder is None:
            return
        with self.problem.watch():
            found = lostmotion.load(self.folder)
            chosen = [one for one in SECTIONS if one.name == self.section.value]
            drawn = write_sections(chosen, make_view(found.result, found.arrays), "rad")
            self.drawn.object = drawn or write_note("This analysis has nothing to show here.")
