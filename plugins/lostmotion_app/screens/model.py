"""The screen of the model: its name or equations, known values, priors, and its prediction of the recording."""

from __future__ import annotations

import html
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn

from lostmotion.cli.sheets import make_sheet
from lostmotion.contracts import Model
from lostmotion.diagnosis.tried_model import TriedModel, TriedPrediction
from lostmotion.errors import CaseError
from lostmotion.preparation.prepare import prepare
from lostmotion.quantities import unit_of
from lostmotion.report import style
from lostmotion.settings import read
from lostmotion.written import model_of
from lostmotion_app.case_content import drop_value_guess, list_recordings
from lostmotion_app.curves import CurvePanels, format_legend
from lostmotion_app.desk import Desk
from lostmotion_app.model_library import ModelLibrary, draw_model, list_models
from lostmotion_app.parameter_rows import ParameterRow
from lostmotion_app.parts import (
    ProblemBox,
    beside,
    make_html,
    run_next,
    write_errors,
    write_heading,
    write_lines,
    write_list,
    write_note,
    write_table,
)  # fmt: skip
from lostmotion_app.recorded_figures import label_of
from lostmotion_app.screens import PageScreen

LIBRARY, EQUATIONS, ROBOT = "Library", "Equations", "Robot"
SIDES = {"Torque of the motor": "motor", "Torque of the link": "link"}
ABOUT_ROBOTS = (
    "The recording is a log with the torque and the position of each joint. Torque of the motor: currents and commands."
    " Torque of the link: a sensor behind the gear. Columns are found by the names or numbers of the joints."
)
EXAMPLE = "m*x'' + c*x' + k*x = force"
CYCLES, NEVER = "after a few cycles", "never"
SHOWN = 800
"""The number of samples that are seen at first."""


class ModelScreen(PageScreen):
    """Choose the model, give known values and priors, and see at once what it predicts."""

    title = "Model"

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self.kind = pn.widgets.RadioButtonGroup(name="Kind", options=[LIBRARY, EQUATIONS, ROBOT], value=LIBRARY)
        self.name = pn.widgets.Select(name="Model", sizing_mode="stretch_width")
        self.library = ModelLibrary(desk.registry, lambda name: setattr(self.name, "value", name))
        self.picture, self.about, self.place = make_html(), make_html(), ProblemBox()
        self.equations = pn.widgets.TextAreaInput(
            name="Equations of motion, one line for each body", placeholder=EXAMPLE, rows=3, auto_grow=True,
            sizing_mode="stretch_width",
        )  # fmt: skip
        self.robot = pn.widgets.Select(name="MJCF or URDF file of the folder", sizing_mode="stretch_width")
        self.torque = pn.widgets.RadioButtonGroup(name="Torque", options=SIDES)
        self.use = pn.widgets.Button(name="Use this model", button_type="primary")
        self.restart = pn.widgets.Select(name="Free runs restart", options=[CYCLES, NEVER], width=200)
        self.rows: list[ParameterRow] = []
        self.table = pn.Column(sizing_mode="stretch_width", margin=0)
        self.figures = pn.Column(sizing_mode="stretch_width", margin=0)
        self.error, self.same = make_html(), make_html()
        self.tried: TriedModel | None = None
        self.shown: tuple[Any, ...] = ()
        self.curves: list[tuple[CurvePanels, Any, Any]] = []
        self.kind.param.watch(lambda _: self._switch(), "value")
        self.name.param.watch(lambda _: self._describe(), "value")
        self.equations.param.watch(lambda event: self._check_equations(event.new), "value_input")
        self.use.on_click(lambda _: self._use())
        self.restart.param.watch(lambda _: self._predict(), "value")

    def make_view(self) -> Any:
        """Return model and parameters beside the prediction."""
        controls = [
            self.kind, self.name, self.library.switch, self.equations, self.robot, self.torque, self.place.pane,
            self.picture, self.use, self.about,
        ]  # fmt: skip
        heading = make_html(write_heading("Nominal model and recording"))
        shown = [
            self.problem.pane, self.library.pictures, self.table, heading, self.restart, self.error, self.figures,
            self.same,
        ]  # fmt: skip
        return beside(controls, shown)

    def show(self) -> None:
        """Show the model of the case, if it has changed."""
        with self.problem.watch():
            content = self.desk.content
            now = (self.desk.recording, self.desk.case.stat().st_mtime_ns if content else 0)
            if now == self.shown:
                return
            self.tried, self.rows, self.same.object = None, [], ""
            self.table[:], self.figures[:] = [], []
            self.error.object = ""
            self._restore(content.get("model", {}))
            self.desk.require_agreed()
            self.shown = now
            if not self.desk.recording:
                self.error.object = write_note("Choose a recording on the screen Data first.")
            elif not content:
                self.error.object = write_note("The columns have no roles yet: assign them on the screen Data.")
            elif self.desk.is_robot:
                self.error.object = write_robot(content)
            else:
                self.error.object = write_note("Reading the case; the first time, kernels are compiled ...")
                run_next(self._load)

    def _restore(self, model: dict[str, Any]) -> None:
        """Set the widgets to the model of the case."""
        self.name.options = list_models(self.desk.registry)
        if "name" in model:
            self.name.value = model["name"]
        lines = model.get("equations", ())
        self.equations.value = lines if isinstance(lines, str) else "\n".join(lines)
        self.robot.options = self.desk.folder.list_robots()
        self.kind.value = EQUATIONS if "equations" in model else ROBOT if self.desk.is_robot else LIBRARY
        for widget in (self.kind, self.use):
            widget.visible = bool(self.desk.recording) and not self.desk.is_given
        self._switch()

    def _switch(self) -> None:
        shown = {
            LIBRARY: (self.name, self.library.switch),
            EQUATIONS: (self.equations,),
            ROBOT: (self.robot, self.torque),
        }
        for kind, widgets in shown.items():
            for widget in widgets:
                widget.visible = self.kind.value == kind and self.use.visible
        if not self.library.switch.visible:
            self.library.switch.value = False
        self.place.tell("")
        self._describe()

    def _describe(self) -> None:
        """Show what the chosen model is, as `lostmotion plugins show` does."""
        self.about.object = write_note(ABOUT_ROBOTS) if self.kind.value == ROBOT else ""
        self.picture.object = ""
        if self.kind.value == EQUATIONS:
            self._check_equations(self.equations.value)
        if self.kind.value == LIBRARY and self.name.value:
            with self.problem.watch():
                registry = self.desk.registry
                made = registry.make("model", self.name.value)
                self._draw_machine(made)
                sheet = make_sheet(registry.entry("model", self.name.value), type(made))
                places = ", ".join(place.name for place in sheet.interfaces or ())
                texts = [sheet.about, f"Places for terms: {places}" if places else "", sheet.paper or ""]
                self.about.object = "".join(f"<p>{html.escape(text)}</p>" for text in texts if text)

    def _draw_machine(self, model: Model) -> None:
        self.picture.object = f'<div class="lm-picture">{draw_model(model)}</div>'

    def _check_equations(self, text: str) -> list[str]:
        """Return equations that can be used, one for each body; none, and the place of the error, if they cannot."""
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        self.picture.object = ""
        with self.place.watch():
            if lines:
                self._draw_machine(model_of(lines)())
            return lines
        return []

    def _use(self) -> None:
        """Write the case with the chosen model, with wide priors about the scales of the recording."""
        with self.problem.watch():
            told: Sequence[str] = ()
            if self.kind.value == LIBRARY:
                self.desk.redraft(str(self.name.value))
            elif self.kind.value == ROBOT:
                if not self.robot.value:
                    raise CaseError("the folder has no MJCF or URDF file: copy one into it")
                told = self.desk.draft_robot(str(self.robot.value), str(self.torque.value))
            elif lines := self._check_equations(self.equations.value):
                self.desk.redraft(";".join(lines))
            self.desk.tell()
            self.show()
            if told:
                self.error.object += write_heading("Joints") + write_list(told)

    def _load(self) -> None:
        """Prepare the case, and show its parameters and the prediction."""
        with self.problem.watch():
            self.error.object = ""
            prepared = prepare(self.desk.case, self.desk.registry, read(self.desk.settings))
            self.tried = TriedModel.of(prepared)
            model, content = prepared.model, self.desk.content["model"]
            self.rows = [ParameterRow(param, model.motion, content, self._change) for param in model.params]
            panels = self._make_panels(self.tried)
            self._predict()
            # A figure that changes in the step in which it is sent may arrive after its change: so it is sent last.
            self.table[:] = [make_html(write_heading("Parameters")), *(row.view for row in self.rows)]
            self.figures[:] = [pn.pane.Bokeh(panel, sizing_mode="stretch_width", margin=(0, 2)) for panel in panels]

    def _change(self) -> None:
        """Keep changed values and priors in the case, and predict again."""
        with self.problem.watch():
            content = self.desk.content
            if self.desk.is_given:
                self._predict()
                return
            entries, before = [row.read() for row in self.rows], content["model"].get("known", {})
            content["model"]["known"] = {name: value for name, value in entries if isinstance(value, float)}
            content["model"]["estimate"] = {name: prior for name, prior in entries if isinstance(prior, dict)}
            for name, value in content["model"]["known"].items():
                if before.get(name) != value:
                    drop_value_guess(content, name)
            if content != self.desk.content:
                self.desk.confirm(content)
                self.desk.save(content)
                self.shown = (self.desk.recording, self.desk.case.stat().st_mtime_ns)
            self._predict()

    def _predict(self) -> None:
        """Draw the prediction at the values that are tried."""
        if self.tried is None:
            return
        with self.problem.watch():
            span = 1e9 if self.restart.value == NEVER else None
            found = self.tried.predict({row.name: row.tried for row in self.rows}, every=span)
            self._draw(found)
            self._show_same()

    def _make_panels(self, tried: TriedModel) -> list[Any]:
        """Return figures for each sensor: recording and prediction, and their difference."""
        observation, motion = tried.posterior.observations[0], tried.posterior.system.model.motion
        empty, panels, self.curves = np.zeros(0), [], []
        curves = CurvePanels("time (s)")
        for number, sensor in enumerate(observation.sensors):
            unit = unit_of(sensor.channel, motion)
            panel = curves.add_panel(label_of(sensor.label, unit), height=230)
            curves.add_curve(panel, observation.time, observation.readings[:, number], colour=style.RECORDED,
                             name="recording", width=2.4)  # fmt: skip
            line = curves.add_curve(panel, empty, empty, colour=style.BEFORE, name="nominal model", width=1.4)
            format_legend(panel)
            rest = curves.add_panel(label_of("difference", unit))
            off = curves.add_curve(rest, empty, empty, colour=style.BEFORE)
            panels += [panel, rest]
            self.curves.append((curves, line, off))
        last = observation.time[0] + min(len(observation.time), SHOWN) * observation.dt
        curves.fit_range(float(observation.time[0]), float(last))
        return panels

    def _draw(self, found: TriedPrediction) -> None:
        for number, (curves, line, off) in enumerate(self.curves):
            curves.replace(line, found.time, found.predicted[:, number])
            curves.replace(off, found.time, found.readings[:, number] - found.predicted[:, number])
        self.error.object = write_errors(
            {sensor.label: float(error) for sensor, error in zip(found.sensors, found.errors, strict=True)}
        )

    def _show_same(self) -> None:
        case = self.desk.folder.name_of(self.desk.case)
        values = ", ".join(f'"{row.name}": {row.tried:.4g}' for row in self.rows)
        lines = [f'case = lm.Case.read("{case}")', f"case.predict({{{values}}})"]
        self.same.object = write_note("The same in Python:") + write_lines(lines)


def write_robot(content: dict[str, Any]) -> str:
    """Return the joints of the case of a robot with their columns, as HTML."""
    rows = [[Path(file).name, *rest] for file, *rest in list_recordings(content)]
    about = "Robots have no prediction here and no check. Run looks at signs, units and clocks before any fit."
    return write_table(["Log", "Torques", "Positions and velocities"], rows) + write_note(about)
