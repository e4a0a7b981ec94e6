"""The screen to take the work away: case, report, notebook, and the lines that do the same."""

from __future__ import annotations

import io
import json
from typing import Any

import panel as pn

from lostmotion_app.desk import Desk
from lostmotion_app.parts import make_html, write_heading, write_lines, write_note
from lostmotion_app.screens import PageScreen

WRITTEN = ("report.html", "arm_found.xml", "arm_found.py")
"""The files of a result that are offered."""
FORMAT = {"nbformat": 4, "nbformat_minor": 5}
"""The version of the format of notebooks: the oldest with identifiers of cells."""


class TakeAwayScreen(PageScreen):
    """What the page did, as files and as lines for a shell and for Python."""

    title = "Take away"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.files = pn.FlexBox(sizing_mode="stretch_width")
        self.told = make_html()

    def make_view(self) -> Any:
        """Return the files above the lines."""
        return pn.Column(self.problem.pane, self.files, self.told, sizing_mode="stretch_width")

    def show(self) -> None:
        """Show the files and lines of the present case."""
        with self.problem.watch():
            if not self.desk.content:
                self.told.object = write_note("Choose a recording on the screen Data first.")
                return
            text = self.desk.case.read_text(encoding="utf-8")
            lines = list_python_lines(self.desk)
            results = self.desk.list_results()
            given = {"case.toml": text, "diagnosis.ipynb": make_notebook(lines)}
            for name in WRITTEN:
                if results and (results[0] / name).is_file():
                    given[name] = (results[0] / name).read_text(encoding="utf-8")
            self.files[:] = [make_download(name, content) for name, content in given.items()]
            self.told.object = "".join(
                [
                    write_note(f"The case stands in {self.desk.folder.name_of(self.desk.case)}."),
                    write_heading("In a shell"),
                    write_lines(list_shell_lines(self.desk)),
                    write_heading("In Python"),
                    write_lines(lines),
                    write_heading("case.toml"),
                    write_lines(text.splitlines()),
                ]
            )


def make_download(name: str, content: str) -> Any:
    """Return a button that stores a file."""
    return pn.widgets.FileDownload(
        io.BytesIO(content.encode()), filename=name, label=f"Download {name}", button_type="primary", width=220
    )


def list_shell_lines(desk: Desk) -> list[str]:
    """Return the commands that check and diagnose the case."""
    case = desk.folder.name_of(desk.case)
    more = "".join(f" --set {key}={value:g}" for key, value in desk.settings.items())
    check = [] if desk.is_robot else [f"lostmotion check {case} --out checked{more}"]
    return [*check, f"lostmotion diagnose {case} --out result{more}"]


def list_python_lines(desk: Desk) -> list[str]:
    """Return the lines of Python that do the same."""
    more = f", settings={dict(desk.settings)!r}" if desk.settings else ""
    check = [] if desk.is_robot else [f"checked = lm.check(case{more})", "print(checked)"]
    return [
        "import lostmotion as lm",
        "",
        f'case = lm.Case.read("{desk.folder.name_of(desk.case)}")',
        *check,
        f'found = lm.diagnose(case, out="result"{more})',
        "print(found)",
        "found.plot.prediction()",
    ]


def make_notebook(lines: list[str]) -> str:
    """Return a notebook that repeats the work, as the text of its file."""
    cells: list[dict[str, Any]] = [
        {"cell_type": "code", "id": f"cell{number}", "metadata": {}, "outputs": [], "execution_count": None,
         "source": line}
        for number, line in enumerate(line for line in lines if line)
    ]  # fmt: skip
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return json.dumps({**FORMAT, "metadata": kernel, "cells": cells}, indent=1)
