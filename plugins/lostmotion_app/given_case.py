"""A case file of the user on the screen Data: its recordings, the Python files that it runs, and its figures."""

from __future__ import annotations

import panel as pn

from lostmotion.recording.formats import read_table
from lostmotion_app.case_content import list_code, list_recordings
from lostmotion_app.desk import Desk
from lostmotion_app.parts import ProblemBox, make_html, write_heading, write_note, write_table
from lostmotion_app.recorded_figures import RecordedFigures

ABOUT = "The page does not change this file. Check, Run and Results work with it as the commands do."
ROBOT = " Its model is a robot: it is diagnosed on Run, and has no prediction on Model and no Check."


class GivenCase:
    """What a case file contains; its recordings are drawn one at a time."""

    def __init__(self, desk: Desk, figures: RecordedFigures) -> None:
        self.desk, self.figures, self.problem, self.told = desk, figures, ProblemBox(), make_html()
        self.agree = pn.widgets.Checkbox(name="Run them", visible=False)
        self.choice = pn.widgets.Select(name="Recording of the case", width=320)
        self.view = pn.Column(
            self.told, self.agree, self.problem.pane, self.choice, sizing_mode="stretch_width", visible=False, margin=0
        )
        self.agree.param.watch(lambda event: self._agree(agreed=event.new), "value")
        self.choice.param.watch(lambda _: self._draw(), "value")

    def show(self) -> None:
        """Show the case of the desk."""
        content = self.desk.content
        files, rows = list_code(content), list(list_recordings(content))
        parts = [write_heading(str(content.get("title", self.desk.recording)))]
        parts.append(write_note(ABOUT + ROBOT * self.desk.is_robot))
        parts.append(write_table(["Recording", "Drives", "Sensors"], rows))
        if files:
            parts.append(write_note(f"The case runs Python code of this folder: {', '.join(files)}. Do you trust it?"))
        self.told.object = "".join(parts)
        self.agree.param.update(visible=bool(files), value=self.desk.recording in self.desk.agreed)
        names = [row[0] for row in rows]
        self.choice.param.update(options=names, value=None)
        self.choice.value = names[0] if names else None  # which draws it

    def _agree(self, *, agreed: bool) -> None:
        (self.desk.agreed.add if agreed else self.desk.agreed.discard)(self.desk.recording)

    def _draw(self) -> None:
        """Draw the chosen recording, which has to be in the folder of the page."""
        if not self.choice.value or not self.desk.is_given:
            return
        with self.problem.watch():
            path = self.desk.folder.find(str(self.desk.case.parent / self.choice.value))
            self.figures.show_table(read_table(path), path.name)
