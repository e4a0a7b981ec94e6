"""The warnings of a screen, each with its remedies as buttons, and the lines of the case that a remedy has changed."""

from __future__ import annotations

import html
import tomllib
from collections.abc import Callable, Sequence
from typing import Any

import panel as pn

from lostmotion.case import format_case
from lostmotion.report.words import sentence, typeset
from lostmotion_app.case_content import Content
from lostmotion_app.desk import Desk
from lostmotion_app.parts import (
    NumberField,
    ProblemBox,
    make_html,
    write_folded,
    write_heading,
    write_lines,
    write_note,
)  # fmt: skip
from lostmotion_app.remedies import Remedy, WarnedCase, list_changed_lines

WIDTH = 900
"""The largest width (px) of a warning with its buttons."""


class WarningList:
    """Warnings with their remedies; `changed` is called after a remedy has changed the case, and after Undo."""

    def __init__(self, desk: Desk, changed: Callable[[], None]) -> None:
        self.desk, self.changed, self.before = desk, changed, ""
        self.problem, self.told, self.rows = ProblemBox(), make_html(), pn.Column(sizing_mode="stretch_width", margin=0)
        self.undo = pn.widgets.Button(name="Undo", visible=False)
        self.undo.on_click(lambda _: self._undo())
        self.view = pn.Column(self.told, self.undo, self.rows, self.problem.pane, sizing_mode="stretch_width", margin=0)

    def show(self, warnings: Sequence[WarnedCase]) -> None:
        """Show warnings in place of those before."""
        self.problem.tell("")
        rows = [self._make_row(one) for one in warnings]
        self.rows[:] = [make_html(write_heading("Please check")), *rows] if rows else []

    def forget(self) -> None:
        """Show nothing, and forget what was changed: another case is open."""
        self.before, self.told.object, self.undo.visible, self.rows[:] = "", "", False, []
        self.problem.tell("")

    def _make_row(self, one: WarnedCase) -> Any:
        text = f'<div class="lm-warning">{html.escape(typeset(sentence(one.says)))}</div>'
        if self.desk.is_given:
            return make_html(text + "".join(map(self._write_remedy, one.remedies)))
        made = [widget for remedy in one.remedies for widget in self._make_widgets(remedy)]
        words = make_html(text, styles={"flex": "1 1 320px"}, margin=(4, 10))
        return pn.FlexBox(words, *made, align_items="flex-end", max_width=WIDTH, sizing_mode="stretch_width")

    def _write_remedy(self, remedy: Remedy) -> str:
        """Return what a remedy would change in a case file that the page does not change, as HTML."""
        if remedy.parameter:
            return write_note(f"Give {remedy.parameter} a known value in the case file.")
        lines = list_changed_lines(format_case(self.desk.content), format_case(remedy.content))
        return write_folded(f"In the case file: {remedy.says}", write_lines(lines))

    def _make_widgets(self, remedy: Remedy) -> list[Any]:
        """Return the button of a remedy, after the field of the value that it asks for."""
        button = pn.widgets.Button(name=remedy.says)
        if not remedy.parameter:
            button.on_click(lambda _: self._apply(remedy.content, remedy.says))
            return [button]
        button.name = f"Set {remedy.parameter}"
        field = NumberField(f"{remedy.parameter} (SI unit)", "from a data sheet", width=150)
        button.on_click(lambda _: self._set(remedy, field))
        return [field.widget, button]

    def _set(self, remedy: Remedy, field: NumberField) -> None:
        with self.problem.watch():
            if field.value is not None:
                self._apply(remedy.fill(field.value), f"{remedy.parameter} is {field.value:g}")

    def _apply(self, content: Content, says: str) -> None:
        """Write the case, and show the lines that have changed."""
        with self.problem.watch():
            before = self.desk.case.read_text(encoding="utf-8")
            self.desk.change(content)
            self._tell(says, before)

    def _undo(self) -> None:
        with self.problem.watch():
            before = self.desk.case.read_text(encoding="utf-8")
            self.desk.confirm(tomllib.loads(self.before))
            self.desk.case.write_text(self.before, encoding="utf-8")
            self._tell("Undone", before)

    def _tell(self, says: str, before: str) -> None:
        lines = list_changed_lines(before, self.desk.case.read_text(encoding="utf-8"))
        self.before, self.undo.visible = before, True
        self.told.object = (
            f'<div role="status">{write_note(f"Changed in case.toml ({says}):")}{write_lines(lines)}</div>'
        )
        self.changed()
