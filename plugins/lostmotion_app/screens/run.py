"""The screen of a diagnosis that runs: progress by step, cancel, earlier runs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import panel as pn

import lostmotion
from lostmotion.report.words import typeset
from lostmotion_app.desk import Desk
from lostmotion_app.job_view import JobView
from lostmotion_app.jobs import Job, list_jobs
from lostmotion_app.parts import NumberField, make_html, write_answer, write_heading, write_note, write_table
from lostmotion_app.screens import PageScreen


class RunScreen(PageScreen):
    """Begin a diagnosis, follow it, cancel it; it goes on when the page is closed."""

    title = "Run"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.budget = NumberField("Budget in s of processor time (--budget)", "by the length", width=260)
        self.seed = NumberField("Seed (--seed)", "0", width=110)
        self.earlier = make_html()
        self.jobs = JobView(desk, "diagnose", "Diagnose", self._list_options, self._show_result)

    def make_view(self) -> Any:
        """Return the options above the progress."""
        about = "The job is a process of its own: it goes on when this page is closed. Cancel gives the answer so far."
        options = pn.FlexBox(self.budget.widget, self.seed.widget, sizing_mode="stretch_width")
        for field in (self.budget, self.seed):
            field.widget.param.watch(lambda _: self.jobs.refresh(), "value")
        return pn.Column(
            make_html(write_note(about)), options, self.problem.pane, self.jobs.make_view(self.earlier),
            sizing_mode="stretch_width",
        )  # fmt: skip

    def show(self) -> None:
        """Show the newest diagnosis of the case."""
        self.jobs.watched = None
        self.jobs.refresh()
        self._list_earlier()

    def _list_options(self) -> Sequence[str]:
        budget, seed = self.budget.value, self.seed.value
        words = ["--budget", f"{budget:g}"] if budget is not None else []
        return [*words, *(["--seed", f"{seed:g}"] if seed is not None else [])]

    def _show_result(self, job: Job) -> str:
        self._list_earlier()
        return write_answer([typeset(one) for one in lostmotion.load(job.folder).says])

    def _list_earlier(self) -> None:
        jobs = list_jobs(self.desk.place, "diagnose") if self.desk.recording else []
        rows = [[job.name, job.state, f"{job.seconds:.0f}\u00a0s", next(iter(job.output), "")] for job in jobs]
        table = write_table(["Run", "State", "Time", "Answer"], rows) if rows else ""
        self.earlier.object = write_heading("Runs of this recording") + table if rows else ""
