"""The figures of a result: held-out predictions with terms switched on and off, and the missing force."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource

from lostmotion.diagnosis.report.missing import COVARIATE_NAMES, get_curve
from lostmotion.diagnosis.tried_model import TriedModel
from lostmotion.notebook.diagnosis_result import DiagnosisResult
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion.report import style
from lostmotion_app.curves import Array, CurvePanels, colour_of, format_legend, make_figure
from lostmotion_app.parts import ProblemBox, make_html, write_heading, write_note
from lostmotion_app.recorded_figures import POINTS, label_of

CASE = "case.toml"
NOTHING = np.zeros(0)


class SwitchedPrediction:
    """Held-out data, the stored prediction of the nominal model, and that of the model with the chosen terms."""

    def __init__(self) -> None:
        self.terms = pn.widgets.CheckBoxGroup(name="Terms", inline=True)
        self.head, self.error, self.problem = make_html(), make_html(), ProblemBox()
        self.figure = pn.Column(sizing_mode="stretch_width", margin=0)
        self.view = pn.Column(
            self.head,
            self.terms,
            self.problem.pane,
            self.error,
            self.figure,
            sizing_mode="stretch_width",
            visible=False,
        )
        self.tried: TriedModel | None = None
        self.found: DiagnosisResult | None = None
        self.line: Any = None
        self.curves = CurvePanels("time (s)")
        self.terms.param.watch(lambda _: self._predict(), "value")

    def show(self, found: DiagnosisResult | None, folder: Path, registry: Registry) -> None:
        """Draw a result; terms can be switched where the case is beside it."""
        self.found, self.tried = found, None
        self.view.visible = found is not None and found.evidence.has("time", "response")
        if found is None or not self.view.visible:
            return
        self._draw(found)
        machine, case = found.result.machine, folder / CASE
        keys = [term.key for term in machine.terms if term.key not in machine.learned]
        self.terms.visible = bool(keys) and case.is_file()
        self.head.object = write_heading("Prediction of held-out data")
        self.error.object = ""
        if self.terms.visible:
            with self.problem.watch():
                self.tried = TriedModel.of(prepare(case, registry, found.evidence.settings), end=True)
                self.terms.param.update(options=keys, value=keys)
                self._predict()
        else:
            self._replace(found.evidence.arrays.get("forecast_after", NOTHING))

    def _draw(self, found: DiagnosisResult) -> None:
        """Draw the recording and the stored prediction of the nominal model."""
        arrays, evidence = found.evidence.arrays, found.evidence
        time, held = arrays["time"], arrays.get("heldout", np.ones_like(arrays["time"])) > 0.0
        self.curves = CurvePanels("time (s)")
        panel = self.curves.add_panel(label_of(evidence.result.response.quantity, evidence.response_unit), height=250)
        self.curves.add_curve(panel, time, arrays["response"], colour=style.RECORDED, name="recording", width=2.6)
        if "forecast_before" in arrays:
            self.curves.add_curve(panel, time, arrays["forecast_before"], colour=style.BEFORE, name="nominal model")
        name = "with the terms that are ticked"
        self.line = self.curves.add_curve(panel, NOTHING, NOTHING, colour=style.AFTER, name=name, width=1.5)
        format_legend(panel)
        first = int(np.argmax(held))
        self.curves.fit_range(float(time[first]), float(time[min(first + 1500, len(time) - 1)]))
        self.figure[:] = [pn.pane.Bokeh(panel, sizing_mode="stretch_width")]

    def _predict(self) -> None:
        """Predict with the terms that are ticked."""
        if self.tried is None or self.found is None:
            return
        with self.problem.watch():
            arrays, machine = self.found.evidence.arrays, self.found.result.machine
            held = float(arrays["time"][int(np.argmax(arrays.get("heldout", np.ones(1)) > 0.0))])
            start = float(self.tried.problem.observations[0].time[0])
            chosen = [term.key for term in machine.terms if term.key in self.terms.value]
            known = self.tried.problem.system.index
            values = {key: value for key, value in machine.values.items() if key in known}
            found = self.tried.predict(values, chosen, begin=max(held - start, 0.0))
            self.curves.replace(self.line, found.time, found.predicted[:, 0])
            self.error.object = write_note(
                f"Error of free runs over the standard deviation of the readings: {found.errors[0]:.3g}"
            )

    def _replace(self, forecast: Array) -> None:
        if forecast.size and self.found is not None:
            self.curves.replace(self.line, self.found.evidence.arrays["time"], forecast)


class MissingForce:
    """The force that the nominal model lacks over a coordinate: samples, mean of bins, and the fitted law."""

    def __init__(self) -> None:
        self.coordinate = pn.widgets.Select(name="Missing force over", width=240)
        self.figure = make_figure("", "", height=280, tools="pan,wheel_zoom,box_zoom,reset,save")
        made = (("missing force", style.BEFORE), ("left with the found terms", style.AFTER))
        self.samples = [ColumnDataSource({"x": [], "y": []}) for _ in made]
        self.means = [ColumnDataSource({"x": [], "y": []}) for _ in range(3)]
        for source, (name, colour) in zip(self.samples, made, strict=True):
            self.figure.scatter("x", "y", source=source, color=colour_of(colour), size=2, alpha=0.25, legend_label=name)
        for source, colour in zip(self.means, (style.BEFORE, style.AFTER, style.LAW), strict=True):
            self.figure.line("x", "y", source=source, color=colour_of(colour), line_width=2.2)
        format_legend(self.figure)
        self.view = pn.Column(
            make_html(write_heading("Missing force")), self.coordinate,
            pn.pane.Bokeh(self.figure, sizing_mode="stretch_width"), sizing_mode="stretch_width", visible=False,
        )  # fmt: skip
        self.found: DiagnosisResult | None = None
        self.coordinate.param.watch(lambda _: self._draw(), "value")

    def show(self, found: DiagnosisResult | None) -> None:
        """Offer the coordinates of a result, and draw the missing force over one of them."""
        self.found = found
        self.view.visible = found is not None and found.evidence.has("time", "missing_force")
        if found is None or not self.view.visible:
            return
        names = {COVARIATE_NAMES[name]: name for name in ("velocity", "position") if found.evidence.has(name)}
        self.coordinate.options = {**names, "time": "time"}
        self.coordinate.value = next(iter(self.coordinate.options.values()))
        self._draw()

    def _draw(self) -> None:
        if self.found is None or not self.coordinate.value:
            return
        evidence, name = self.found.evidence, str(self.coordinate.value)
        at = evidence.arrays[name]
        picked = np.unique(np.linspace(0, len(at) - 1, POINTS).astype(np.intp))
        for source, key in zip(self.samples, ("missing_force", "left_force"), strict=True):
            values = evidence.arrays.get(key, NOTHING)
            source.data = {"x": at[picked], "y": values[picked]} if values.size else {"x": [], "y": []}
        centre = get_curve(evidence, "bin_center", name)
        for source, key in zip(self.means, ("before_mean", "after_mean", "law_mean"), strict=True):
            mean = get_curve(evidence, key, name)
            source.data = {"x": centre, "y": mean} if mean.size and centre.size else {"x": [], "y": []}
        self.figure.xaxis.axis_label = label_of(name, evidence.units.get(name, ""))
        self.figure.yaxis.axis_label = label_of("missing force", evidence.result.units.force)
