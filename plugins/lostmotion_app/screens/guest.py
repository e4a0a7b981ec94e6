"""A screen of another package, which the hook `lostmotion_screens` adds."""

from __future__ import annotations

from typing import Any

import panel as pn

from lostmotion.errors import LostMotionError
from lostmotion.offers import SCREEN
from lostmotion.report.words import sentence, to_words
from lostmotion_app.desk import Desk
from lostmotion_app.parts import make_html, write_note
from lostmotion_app.screens import PageScreen


class GuestScreen(PageScreen):
    """What the function `name` of a package returns for the desk; one that fails says so, and the page goes on."""

    def __init__(self, desk: Desk, name: str) -> None:
        super().__init__(desk)
        self.name, self.shown = name, pn.Column(sizing_mode="stretch_width", margin=0)

    def make_view(self) -> Any:
        """Return the line of help above what the function returns."""
        about = self.desk.registry.offered(SCREEN)[self.name].about
        return pn.Column(make_html(write_note(about)), self.problem.pane, self.shown, sizing_mode="stretch_width")

    def show(self) -> None:
        """Call the function for the present desk."""
        self.shown[:] = []
        self.problem.tell("" if self.desk.content else "Choose a recording on the screen Data first.")
        if not self.desk.content:
            return
        try:
            self.shown[:] = [pn.panel(self.desk.registry.function(SCREEN, self.name)(self.desk))]
        except Exception as err:  # code of a third party
            said = str(err) if isinstance(err, LostMotionError) else f"{type(err).__name__}: {err}"
            self.problem.tell(f"The screen {self.name!r} cannot be drawn ({said}): inform its author.")


def list_guests(desk: Desk) -> dict[str, str]:
    """Return the names of the screens of other packages by their titles."""
    return {sentence(to_words(name)): name for name in desk.registry.offered(SCREEN)}
