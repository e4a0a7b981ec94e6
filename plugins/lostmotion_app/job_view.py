"""The view of the jobs of one command: begin, progress by step, cancel, and what became of earlier ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import panel as pn

from lostmotion.report.words import sentence
from lostmotion_app.desk import CASE, Desk
from lostmotion_app.jobs import OUT, Job, Progress, begin_job, list_jobs
from lostmotion_app.parts import (
    ProblemBox,
    make_html,
    name_key,
    run_next,
    write_command,
    write_folded,
    write_heading,
    write_lines,
    write_note,
    write_table,
)  # fmt: skip

PERIOD = 1000
"""Milliseconds between two looks at a job: an answer costs less than a thousandth of a core."""
SHOWN = 6
"""The number of steps that are shown, the last ones."""
BEST = 10
"""The number of sets of terms that are shown, those with the largest scores."""
_SAID = {
    "running": "running",
    "done": "done",
    "cancelled": "ended before there was an answer",
    "failed": "failed",
    "killed": "its process was killed",
}


class JobView:
    """The jobs of a `command` on the case of a desk; `words` returns what follows the command, `done` a result as HTML.

    Jobs are found again by their folders after a reload of the page, and after the server was killed.
    """

    def __init__(
        self,
        desk: Desk,
        command: str,
        label: str,
        words: Callable[[], Sequence[str]],
        done: Callable[[Job], str],
        *,
        case: bool = True,
    ) -> None:
        self.desk, self.command, self.words, self.done, self.case = desk, command, words, done, case
        self.problem = ProblemBox()
        self.start = pn.widgets.Button(name=label, button_type="primary")
        self.cancel = pn.widgets.Button(name="Cancel", visible=False)
        self.told, self.found, self.same = make_html(), make_html(), make_html()
        self.watched: Job | None = None
        self.timer: Any = None
        self.start.on_click(lambda _: self._begin())
        self.cancel.on_click(lambda _: self._cancel())

    def make_view(self, *more: Any) -> Any:
        """Return the view, with `more` below the buttons and the progress."""
        return pn.Column(
            pn.Row(self.start, self.cancel), self.problem.pane, self.told, self.found, *more, self.same,
            sizing_mode="stretch_width",
        )  # fmt: skip

    def refresh(self) -> None:
        """Show the newest job of the case, whoever began it, and follow it while it runs."""
        with self.problem.watch():
            jobs = list_jobs(self.desk.place, self.command) if self.desk.recording else []
            newest = jobs[0] if jobs else None
            if newest is None or self.watched is None or newest.folder != self.watched.folder:
                self.watched = newest
                self._look(fresh=True)
            ready = bool(self.desk.content if self.case else self.desk.recording and not self.desk.is_given)
            self.start.disabled, self.same.object = not ready, ""
            if ready:
                what = self.desk.folder.name_of(self.desk.case) if self.case else self.desk.recording
                self.same.object = write_command("lostmotion", *self._list_words(what, "DIR"))

    def _list_words(self, what: str, out: str) -> list[str]:
        """Return the words of the command on a case or a recording, with a folder for its results."""
        plugins = [word for file in self.desk.plugins for word in ("--plugin", file)]
        settings = [word for key, value in self.desk.settings.items() for word in ("--set", f"{key}={value:g}")]
        return [*plugins, self.command, what, "--out", out, *settings, *self.words()]

    def _begin(self) -> None:
        with self.problem.watch():
            if self.case:
                self.desk.require_agreed()
            what = f"{OUT}/{CASE}" if self.case else str(self.desk.folder.find(self.desk.recording))
            self.watched = begin_job(self.desk.place, self.command, self._list_words(what, OUT), self.desk.copy_case)
            self._look(fresh=True)

    def _cancel(self) -> None:
        if self.watched is not None:
            self.watched.cancel()
            self.cancel.disabled = True

    def _look(self, *, fresh: bool = False) -> None:
        """Show the state of the job; show its result once, when it is done."""
        job = self.watched
        running = job is not None and job.state == "running"
        self.cancel.visible = running
        if fresh or not running:
            self.cancel.disabled = False
        self._follow(running)
        if fresh:
            self.found.object = ""
        if job is None:
            self.told.object = ""
            return
        self.told.object = write_job(job)
        if job.state == "done":
            run_next(lambda: self._show_result(job))

    def _show_result(self, job: Job) -> None:
        with self.problem.watch():
            self.found.object = self.done(job)

    def _follow(self, running: bool) -> None:
        if running and self.timer is None:
            self.timer = pn.state.add_periodic_callback(self._look, period=PERIOD)
        elif not running and self.timer is not None:
            self.timer.stop()
            self.timer = None


def write_job(job: Job) -> str:
    """Return what a job does or did as HTML: state, times, steps or output."""
    state, times = job.state, [f"{job.seconds:.0f} s"]
    if job.processor is not None:
        times.append(f"{job.processor:.0f} s of processor time")
    head = f"{job.name}: {_SAID[state]}, {', '.join(times)}"
    if state == "running":
        return write_progress(head, job.progress)
    output = write_lines(job.output)
    return write_note(head) + (write_folded("Output of the command", output) if state == "done" else output)


def write_progress(head: str, progress: Progress) -> str:
    """Return the progress of a job as HTML: the budget that is used, the last steps, the sets that were weighed."""
    parts = [write_note(head)]
    if progress.used is not None:
        told = f"{100.0 * progress.used:.0f} % of the budget of the search"
        bar = f'<progress value="{progress.used:.3f}" aria-label="used budget"></progress>'
        parts.append(f"<p>{bar} {told}</p>")
    steps = [f"{seconds:7.1f} s  {step}" for seconds, step in progress.steps[-SHOWN:]]
    parts.append(write_lines(steps or ["starting"]))
    return "".join([*parts, write_weighed(progress.weighed)])


def write_weighed(weighed: Mapping[tuple[str, ...], float]) -> str:
    """Return the best sets of terms with their scores over that of no term, as HTML; empty before the first one."""
    if not weighed:
        return ""
    base, over = (weighed[()], "nothing") if () in weighed else (min(weighed.values()), "the lowest")
    best = sorted(weighed, key=lambda terms: -weighed[terms])[:BEST]
    gains = [weighed[terms] - base for terms in best]
    rows = [[name_set(terms), f"{gain:+.1f}" if terms else "0"] for terms, gain in zip(best, gains, strict=True)]
    bars = [max(gain, 0.0) / max(*gains, 1e-9) for gain in gains]
    about = "The score of an explanation is its log evidence with that of held-out data, less a price for each term."
    note = write_note(f"{about} An explanation that leads by 3 is 20 times as probable.")
    return write_heading("Explanations so far") + write_table(["Missing", f"Score over {over}"], rows, bars) + note


def name_set(terms: Sequence[str]) -> str:
    """Return a set of terms in words."""
    return sentence(" and ".join(map(name_key, terms))) or "Nothing"
