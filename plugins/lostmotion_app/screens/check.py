"""The screen of the check before the fit: what the recording can tell."""

from __future__ import annotations

import math
from typing import Any

import panel as pn

import lostmotion
from lostmotion.case import GUESSED
from lostmotion.diagnosis.report.check_page import SECTIONS
from lostmotion.results.expectation import CaseCheck
from lostmotion_app.desk import Desk
from lostmotion_app.job_view import JobView
from lostmotion_app.jobs import Job
from lostmotion_app.parts import make_html, run_next, write_answer, write_heading, write_list, write_note
from lostmotion_app.remedies import list_warnings
from lostmotion_app.result_warnings import list_check_warnings
from lostmotion_app.screens import PageScreen
from lostmotion_app.sections import write_grid
from lostmotion_app.warning_list import WarningList

CHANGED = "The case has changed since this check: check it again."
DECADES = 4.0
"""The shares of the drive from one down to this power of ten are the length of a bar."""


class CheckScreen(PageScreen):
    """Expected intervals, smallest sizes of terms that would be named, what would help."""

    title = "Check"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.jobs = JobView(desk, "check", "Check", lambda: (), self._show_result)
        self.warnings = WarningList(desk, self._show_changed)
        self.result: CaseCheck | None = None

    def make_view(self) -> Any:
        """Return the button above the result."""
        about = "What this recording can tell, before any term is fitted. It takes seconds."
        view = self.jobs.make_view(self.problem.pane)
        return pn.Column(make_html(write_note(about)), self.warnings.view, view, sizing_mode="stretch_width")

    def show(self) -> None:
        """Show the newest check of the case, and the warnings about the case."""
        self.jobs.watched, self.result = None, None
        self.warnings.forget()
        self.jobs.refresh()
        run_next(self._list_warnings)

    def _show_changed(self) -> None:
        """Show the warnings that are left after a remedy; the result is that of the case before."""
        self.jobs.found.object = write_note(CHANGED)
        self.result = None
        self.desk.tell()
        run_next(self._list_warnings)

    def _list_warnings(self) -> None:
        """Show the warnings about the case, and those of its newest check."""
        with self.problem.watch():
            found = list_warnings(self.desk)
            if self.result is not None:
                found += list_check_warnings(self.result, self.desk.content)
            self.warnings.show(found)

    def _show_result(self, job: Job) -> str:
        result: CaseCheck = lostmotion.load(job.folder).result
        changed = self.desk.has_changed(job.folder)
        self.result = None if changed else result
        run_next(self._list_warnings)
        parts = [write_note(CHANGED) if changed else "", write_answer(result.says)]
        for section in SECTIONS:
            grid, title = section.table(result), section.title
            if grid and grid.rows:
                bars = make_bars(result) if section.name == "effects" else ()
                words = section.words(result)
                parts += [write_heading(str(title)), write_note(words) if words else ""]
                parts.append(write_grid(grid, bars, f"Share, from {10.0 ** (2.0 - DECADES):g} % to 100 %"))
        parts.append(write_heading("Notes"))
        parts.append(write_list([one for one in result.notes if not one.startswith(GUESSED)]))  # they stand above
        return "".join(parts)


def make_bars(result: CaseCheck) -> list[float]:
    """Return for each term the length of a bar: the share of the drive from which it is named, on a log scale."""
    shares = [one.share_of_drive or 0.0 for one in result.expected.effects]
    return [1.0 + math.log10(share) / DECADES if share > 0.0 else 0.0 for share in shares]
