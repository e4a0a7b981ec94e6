"""The screen of the check before the fit: what the recording can tell."""

from __future__ import annotations

import math
from typing import Any

import panel as pn

import lostmotion
from lostmotion.diagnosis.report.check_page import SECTIONS
from lostmotion.results.expectation import CaseCheck
from lostmotion_app.desk import Desk
from lostmotion_app.job_view import JobView
from lostmotion_app.jobs import Job
from lostmotion_app.parts import make_html, write_answer, write_heading, write_list, write_note
from lostmotion_app.screens import PageScreen
from lostmotion_app.sections import write_grid

DECADES = 4.0
"""The shares of the drive from one down to this power of ten are the length of a bar."""


class CheckScreen(PageScreen):
    """Expected intervals, smallest sizes of terms that would be named, what would help."""

    title = "Check"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.jobs = JobView(desk, "check", "Check", lambda: (), self._show_result)

    def make_view(self) -> Any:
        """Return the button above the result."""
        about = "What this recording can tell, before any term is fitted. It takes seconds."
        view = self.jobs.make_view(self.problem.pane)
        return pn.Column(make_html(write_note(about)), view, sizing_mode="stretch_width")

    def show(self) -> None:
        """Show the newest check of the case."""
        self.jobs.watched = None
        self.jobs.refresh()

    def _show_result(self, job: Job) -> str:
        result: CaseCheck = lostmotion.load(job.folder).result
        parts = [write_answer(result.says)]
        for section in SECTIONS:
            grid, title = section.table(result), section.title
            if grid and grid.rows:
                bars = make_bars(result) if section.name == "effects" else ()
                words = section.words(result)
                parts += [write_heading(str(title)), write_note(words) if words else ""]
                parts.append(write_grid(grid, bars))
        parts.append(write_list(result.notes))
        return "".join(parts)


def make_bars(result: CaseCheck) -> list[float]:
    """Return for each term the length of a bar: the share of the drive from which it is named, on a log scale."""
    shares = [one.share_of_drive or 0.0 for one in result.expected.effects]
    return [1.0 + math.log10(share) / DECADES if share > 0.0 else 0.0 for share in shares]
