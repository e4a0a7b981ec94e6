"""The first screen: a recording of the folder, the table as it was read, roles and units of its columns, figures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import panel as pn

from lostmotion.errors import CaseError, DataError
from lostmotion.recording.formats import read_table
from lostmotion.recording.outline import GivenRoles
from lostmotion.recording.table import Table
from lostmotion_app import recorded_figures
from lostmotion_app.desk import Desk, choose_model
from lostmotion_app.folder import MOST_UPLOADED
from lostmotion_app.given_case import GivenCase
from lostmotion_app.parts import (
    NumberField,
    beside,
    make_html,
    run_next,
    write_command,
    write_heading,
    write_lines,
    write_list,
    write_note,
)  # fmt: skip
from lostmotion_app.remedies import list_warnings
from lostmotion_app.role_changes import list_role_changes
from lostmotion_app.screens import PageScreen
from lostmotion_app.used_parts import list_used_parts
from lostmotion_app.used_stretch import UsedStretch
from lostmotion_app.warning_list import WarningList

AUTOMATIC, NONE = "(automatic)", "none"
ROBOT = "The case of this log has a robot as its model, see the screen Model. “Use these columns” makes another case."


class DataScreen(PageScreen):
    """Choose a recording, see what was read, assign columns, mark the stretch to use."""

    title = "Data"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.shown = ("", 0.0, False)
        self.file = pn.widgets.Select(name="Recording or case file", sizing_mode="stretch_width")
        self.upload = pn.widgets.FileInput(
            name=f"Or drop a file, to copy it here (at most {MOST_UPLOADED // 2**20} MiB)",
            multiple=False,
            sizing_mode="stretch_width",
        )
        self.given = pn.Column(sizing_mode="stretch_width", margin=0, visible=False)
        self.time = pn.widgets.Select(name="Time (--time)", sizing_mode="stretch_width")
        self.rate = NumberField("Rate in Hz (--rate)", "from the time", width=150)
        self.drive = _Channel("Drive (--drive)")
        self.response = _Channel("Response (--response)")
        self.apply = pn.widgets.Button(name="Use these columns", button_type="primary")
        self.stretch = UsedStretch(desk.hold, self._mark)
        self.found, self.figures, self.same = make_html(), recorded_figures.RecordedFigures(), make_html()
        self.further = pn.widgets.MultiChoice(
            name="Further recordings with the same columns", sizing_mode="stretch_width"
        )
        self.case = GivenCase(desk, self.figures)
        self.warnings = WarningList(desk, self._show_changed)
        self.table: Table | None = None
        self.warned = 0
        self.ways = pn.FlexBox()
        self.further.param.watch(lambda _: self._add(), "value")
        self.file.param.watch(self._choose, "value")
        self.upload.param.watch(self._upload, "value")
        self.apply.on_click(lambda _: self._draft())

    def make_view(self) -> Any:
        """Return the controls beside the figures."""
        self.given[:] = [
            make_html(write_heading("Columns")),
            self.time,
            self.rate.widget,
            *self.drive.widgets,
            *self.response.widgets,
            self.apply,
            self.further,
            make_html(write_heading("Stretch")),
            *self.stretch.widgets,
        ]
        controls = [self.file, self.upload, self.given]
        shown = [
            self.problem.pane, self.ways, self.found, self.case.view, self.warnings.view, self.figures.view, self.same
        ]  # fmt: skip
        return beside(controls, shown)

    def show(self) -> None:
        """List the recordings, and show the chosen one if it is another one or has changed."""
        names = [*self.desk.folder.list_recordings(), *self.desk.folder.list_cases()]
        if self.desk.recording not in names:
            self.desk.recording = ""
            self.found.object = write_beginning(len(names))
        if self.file.value == self.desk.recording:
            self._show_recording()
        options = names if self.desk.recording else ["", *names]
        self.file.param.update(options=options, value=self.desk.recording)  # which shows another one

    def _choose(self, event: Any) -> None:
        self.desk.recording = event.new or ""
        self.shown = ("", 0.0, False)
        self._show_recording()

    def _upload(self, event: Any) -> None:
        if event.new is None:
            return
        with self.problem.watch():
            name = self.desk.folder.upload(self.upload.filename, event.new)
            self.file.options = [*self.file.options, *([] if name in self.file.options else [name])]
            self.file.value = name

    def _show_recording(self) -> None:
        """Show a recording: first its columns, then what `init` says."""
        if not self.desk.recording:
            return
        with self.problem.watch():
            path = self.desk.folder.find(self.desk.recording)
            self.case.view.visible = self.desk.is_given
            now = (self.desk.recording, path.stat().st_mtime, self.desk.is_robot)
            if now == self.shown:
                run_next(self._list_warnings)
                return
            self.shown = now
            self.found.object = write_note(f"Reading {self.desk.recording} ...")
            run_next(lambda: self._read_recording(path))

    def _read_recording(self, path: Path) -> None:
        """Show the columns of a recording, and thereafter what `init` says; or what a case file contains."""
        with self.problem.watch():
            self.found.object = self.same.object = ""
            self.warnings.forget()
            self.ways[:], self.table, self.warned = [], None, 0
            if self.desk.is_given:
                self.given.visible = False
                self.case.show()
                self.desk.tell()
                run_next(self._list_warnings)
                return
            self.table = table = read_table(path)
            self._offer_columns(table)
            self.given.visible = True
            self.figures.show_table(table, path.name)
            if self.desk.is_robot:
                self._offer_stretch()
                self.found.object = write_note(ROBOT)
                self.desk.tell()
                return
            if self.desk.content:
                self._restore()
            self.found.object = write_note("Looking for the roles of the columns ...")
            run_next(lambda: self._draft(keep=True))

    def _offer_columns(self, table: Table) -> None:
        names = list(table.full_names)
        self.time.options, self.time.value = [AUTOMATIC, *names], AUTOMATIC
        self.rate.value = None
        self.drive.offer([AUTOMATIC, NONE, *names])
        self.response.offer([AUTOMATIC, *names])

    def _restore(self) -> None:
        """Set the columns to those of the case."""
        first = self.desk.content["recordings"][0]
        if "rate" in first:
            self.rate.value = first["rate"]
        else:
            time = first["time"]["column"] if isinstance(first["time"], dict) else first["time"]
            self.time.value = time if time in self.time.options else AUTOMATIC
        inputs = first.get("inputs", [])
        self.drive.restore(inputs[0] if inputs else {"column": NONE})
        self.response.restore(first["sensors"][0])

    def _read_roles(self) -> GivenRoles:
        channels = (self.drive, self.response)
        units = {one.column: one.unit.value for one in channels if one.column and one.unit.value}
        time = None if self.time.value == AUTOMATIC else self.time.value
        return GivenRoles(time, self.rate.value, self.drive.column, self.response.column, units)

    def _read_factors(self) -> dict[str, float]:
        channels = ((one.column, one.factor.value) for one in (self.drive, self.response))
        return {name: factor for name, factor in channels if name and factor not in (None, 1.0)}

    def _draft(self, *, keep: bool = False) -> None:
        """Write a first case of the chosen columns, or keep a present one, and show what was found."""
        with self.problem.watch():
            self.found.object = ""
            roles, gains = self._read_roles(), self._read_factors()
            self.ways[:], before = [], self.desk.content
            try:
                draft = self.desk.draft(roles, gains, choose_model(before), keep=keep)
            except (CaseError, DataError) as err:
                self.found.object = ""
                if not (keep and before) and self.desk.content == before:
                    self._offer_ways(roles, gains, str(err))
                    raise
                # the case is there, and its readings cannot be used as they are: a warning tells why
            else:
                self.found.object = "".join([write_heading("What was read"), write_lines(draft.found)])
            self._show_case()
            self._offer_further()
            self.desk.tell()
            run_next(self._list_warnings)

    def _offer_ways(self, roles: GivenRoles, gains: dict[str, float], says: str) -> None:
        """Offer other roles of the columns as buttons, where the case cannot be made of the present ones."""
        for words, other in list_role_changes(self.desk.folder.find(self.desk.recording), roles, gains, says):
            button = pn.widgets.Button(name=words)
            button.on_click(lambda _, other=other: self._take(other))
            self.ways.append(button)

    def _take(self, roles: GivenRoles) -> None:
        """Set the widgets to other roles, and make the case of them."""
        self.rate.value = roles.rate
        self.time.value = roles.time or AUTOMATIC
        self.drive.choice.value = roles.drive or AUTOMATIC
        self._draft()

    def _show_case(self) -> None:
        """Set the widgets to the case, and shade what it does not use."""
        self._restore()
        self.figures.column.value = self.response.choice.value
        self._offer_stretch()
        self._show_command()

    def _show_changed(self) -> None:
        """Show the case after a remedy."""
        self._restore()
        self._draft(keep=True)

    def _list_warnings(self) -> None:
        """List the warnings about the case, unless those of this case are listed already."""
        with self.problem.watch():
            now = self.desk.case.stat().st_mtime_ns if self.desk.content else 0
            if now != self.warned:
                self.warnings.show(list_warnings(self.desk, self.table))
                self.warned = now

    def _offer_stretch(self) -> None:
        """Set the slider of the stretch to that of the case, and shade what is held out or not used."""
        parts = list_used_parts(self.desk.content, self.figures.span, self.desk.hold)
        self.stretch.offer(self.figures.span, parts[0].start, parts[-1].end)
        self.figures.mark(parts)

    def _offer_further(self) -> None:
        """Offer the other recordings of the folder."""
        names = [name for name in self.desk.folder.list_recordings() if name != self.desk.recording]
        self.further.visible = bool(names)
        self.further.param.update(options=names, value=[one for one in self.desk.list_further() if one in names])

    def _add(self) -> None:
        """Write the further recordings into the case."""
        with self.problem.watch():
            if self.desk.content and list(self.further.value) != self.desk.list_further():
                self.desk.add_recordings(list(self.further.value))
                self._offer_stretch()
                self.desk.tell()

    def _mark(self) -> None:
        """Keep the stretch in the case, and shade what is held out or not used."""
        with self.problem.watch():
            ends, limits = self.stretch.read(), self.figures.span
            self.desk.hold = self.stretch.hold.value
            if not self.desk.content or self.table is None:
                return
            start, end = (None if one == limit else float(one) for one, limit in zip(ends, limits, strict=True))
            self.desk.use_stretch(start, end, self.table)
            self.figures.mark(list_used_parts(self.desk.content, limits, self.desk.hold))
            self.desk.tell()
            run_next(self._list_warnings)

    def _show_command(self) -> None:
        roles, gains = self._read_roles(), self._read_factors()
        words = ["lostmotion", "init", self.desk.recording]
        for option, value in (("--time", roles.time), ("--rate", roles.rate), ("--drive", roles.drive),
                              ("--response", roles.response)):  # fmt: skip
            words += [option, f"{value:g}" if isinstance(value, float) else str(value)] if value else []
        for name, unit in (roles.units or {}).items():
            words += ["--unit", f"{name}={unit}"]
        for name, gain in gains.items():
            words += ["--factor", f"{name}={gain:g}"]
        self.same.object = write_command(*words, "--out", self.desk.folder.name_of(self.desk.case))


def write_beginning(count: int) -> str:
    """Return what to do first, in a folder with a number of recordings, as HTML."""
    first = "Choose a recording of this folder." if count else "This folder has no recording yet: drop one here."
    steps = [
        "Data: a table as a data logger wrote it, such as a CSV file. Look at its columns, units and time.",
        "Model: choose a model of the machine, and enter the values that you know.",
        "Check: what this recording can tell. It takes seconds.",
        "Run: a search for the physics that the model leaves out. It takes a minute or more.",
        "Results: the answer, and predictions of data that no fit has used.",
    ]
    return write_note(first) + write_heading("Screens") + write_list(steps)


class _Channel:
    """The widgets of one role: its column, unit and factor."""

    def __init__(self, name: str) -> None:
        role = name.partition(" ")[0].lower()
        self.choice = pn.widgets.Select(name=name, sizing_mode="stretch_width")
        self.unit = pn.widgets.AutocompleteInput(
            name=f"Unit of the {role} (--unit)", options=list(recorded_figures.UNITS), restrict=False, min_characters=1,
            placeholder="from the file", sizing_mode="stretch_width",
        )  # fmt: skip
        self.factor = NumberField(f"{role.capitalize()} factor", "1", width=110)

    @property
    def widgets(self) -> list[Any]:
        """The widgets in their order."""
        return [self.choice, pn.Row(self.unit, self.factor.widget, sizing_mode="stretch_width")]

    @property
    def column(self) -> str | None:
        """The chosen column, "none", or None where it is chosen automatically."""
        return None if self.choice.value in (AUTOMATIC, None) else str(self.choice.value)

    def offer(self, names: list[str]) -> None:
        """Offer the columns of another recording."""
        self.choice.options, self.choice.value = names, AUTOMATIC
        self.unit.value, self.factor.value = "", None

    def restore(self, channel: dict[str, Any]) -> None:
        """Set the widgets to a channel of the case."""
        if channel["column"] in self.choice.options:
            self.choice.value = channel["column"]
        self.unit.value = channel.get("unit", "")
        self.factor.value = channel.get("factor")
