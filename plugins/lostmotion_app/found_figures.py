"""The figures of a result: held-out predictions with terms switched on and off, and the missing force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource

from lostmotion.diagnosis.report.missing import COVARIATE_NAMES, get_curve
from lostmotion.diagnosis.tried_model import TriedModel
from lostmotion.likelihood.observation import Observation
from lostmotion.notebook.diagnosis_result import DiagnosisResult
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion.report import style
from lostmotion.report.words import sentence
from lostmotion_app.curves import Array, CurvePanels, colour_of, format_legend, make_figure
from lostmotion_app.parts import ProblemBox, make_html, name_key, write_errors, write_heading
from lostmotion_app.recorded_figures import POINTS, label_of

CASE = "case.toml"
NOTHING = np.zeros(0)
TICKED = "with ticked terms"
SHOWN = 800
"""The number of samples that are seen at first."""


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
        self.rest: Any = None
        self.curves = CurvePanels("time (s)")
        self.terms.param.watch(lambda _: self._predict(), "value")

    def show(self, found: DiagnosisResult | None, folder: Path, registry: Registry) -> None:
        """Draw a result; terms can be switched where the case is beside it."""
        self.found, self.tried = found, None
        self.view.visible = found is not None and found.evidence.has("time", "response")
        if found is None or not self.view.visible:
            return
        panels = self._draw(found)
        machine, case = found.result.machine, folder / CASE
        keys = {sentence(name_key(term.key)): term.key for term in machine.terms if term.key not in machine.learned}
        self.terms.visible = bool(keys) and case.is_file()
        self.head.object = write_heading("Prediction of held-out data")
        self.error.object = ""
        if self.terms.visible:
            with self.problem.watch():
                prepared = prepare(case, registry, found.evidence.settings)
                arrays = found.evidence.arrays
                number = find_recording(prepared.observations, arrays["time"], arrays["response"])
                self.terms.param.update(options=keys, value=list(keys.values()))
                self.tried = TriedModel.of(prepared, number=number, end=True)
                self._predict()
        else:
            self._replace(found.evidence.arrays.get("forecast_after", NOTHING))
        self.figure[:] = [pn.pane.Bokeh(one, sizing_mode="stretch_width", margin=(0, 2)) for one in panels]

    def _draw(self, found: DiagnosisResult) -> tuple[Any, Any]:
        """Return figures with the recording and the stored prediction of the nominal model, and their difference."""
        arrays, evidence = found.evidence.arrays, found.evidence
        time, held = arrays["time"], arrays.get("heldout", np.ones_like(arrays["time"])) > 0.0
        self.curves = CurvePanels("time (s)")
        unit, recorded = evidence.response_unit, arrays["response"]
        panel = self.curves.add_panel(label_of(evidence.result.response.quantity, unit), height=230)
        rest = self.curves.add_panel(label_of("difference", unit))
        self.curves.add_curve(panel, time, recorded, colour=style.RECORDED, name="recording", width=2.6)
        if "forecast_before" in arrays:
            before = arrays["forecast_before"]
            self.curves.add_curve(panel, time, before, colour=style.BEFORE, name="nominal model")
            self.curves.add_curve(rest, time, recorded - before, colour=style.BEFORE)
        self.line = self.curves.add_curve(panel, NOTHING, NOTHING, colour=style.AFTER, name=TICKED, width=1.5)
        self.rest = self.curves.add_curve(rest, NOTHING, NOTHING, colour=style.AFTER, width=1.5)
        format_legend(panel)
        first = int(np.argmax(held))
        self.curves.fit_range(float(time[first]), float(time[min(first + SHOWN, len(time) - 1)]))
        return panel, rest

    def _predict(self) -> None:
        """Predict with the terms that are ticked."""
        if self.tried is None or self.found is None:
            return
        with self.problem.watch():
            arrays, machine = self.found.evidence.arrays, self.found.result.machine
            held = float(arrays["time"][find_begin(arrays)])
            start = float(self.tried.posterior.observations[0].time[0])
            chosen = [term.key for term in machine.terms if term.key in self.terms.value]
            known = self.tried.posterior.system.index
            values = {key: value for key, value in machine.values.items() if key in known}
            found = self.tried.predict(values, chosen, begin=max(held - start, 0.0))
            self.curves.replace(self.line, found.time, found.predicted[:, 0])
            self.curves.replace(self.rest, found.time, found.readings[:, 0] - found.predicted[:, 0])
            self.error.object = write_errors({TICKED: float(found.errors[0])})

    def _replace(self, forecast: Array) -> None:
        if forecast.size and self.found is not None:
            time, recorded = self.found.evidence.arrays["time"], self.found.evidence.arrays["response"]
            self.curves.replace(self.line, time, forecast)
            self.curves.replace(self.rest, time, recorded - forecast)


def find_begin(arrays: Mapping[str, Array]) -> int:
    """Return the first held-out sample that is predicted: that of a whole recording lies after a transient."""
    predicted = np.isfinite(arrays["forecast_before"]) if "forecast_before" in arrays else np.ones(1, dtype=bool)
    return int(np.argmax(predicted & (arrays.get("heldout", np.ones(1)) > 0.0)))


def find_recording(observations: Sequence[Observation], time: Array, response: Array) -> int:
    """Return the number of the recording to which readings (n,) of the first sensor belong, at a time (n,) in s."""
    distances = []
    for one in observations:
        first = int(np.searchsorted(one.time, time[0] - 0.5 * one.dt))
        part = one.readings[first : first + len(time), 0]
        distances.append(float(np.nanmean((part - response) ** 2)) if len(part) == len(time) else np.inf)
    return int(np.argmin(distances))


class MissingForce:
    """The force that the nominal model lacks over a coordinate: samples, mean of bins, and the fitted law."""

    def __init__(self) -> None:
        self.coordinate = pn.widgets.Select(name="Missing force over", width=240)
        self.figure = make_figure(
            "", "", says="Missing force over a coordinate", height=280, tools="pan,wheel_zoom,box_zoom,reset,save"
        )
        made = (("missing force", style.BEFORE), ("left over", style.AFTER))
        self.samples = [ColumnDataSource({"x": [], "y": []}) for _ in made]
        self.means = [ColumnDataSource({"x": [], "y": []}) for _ in range(3)]
        for source, (name, colour) in zip(self.samples, made, strict=True):
            self.figure.scatter("x", "y", source=source, color=colour_of(colour), size=2, alpha=0.25, legend_label=name)
        laws = (("mean missing", style.BEFORE), ("mean left over", style.AFTER), ("found law", style.LAW))
        for source, (name, colour) in zip(self.means, laws, strict=True):
            self.figure.line("x", "y", source=source, color=colour_of(colour), line_width=2.2, legend_label=name)
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
