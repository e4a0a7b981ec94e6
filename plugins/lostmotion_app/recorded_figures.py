"""The figures of a recording: every column over time, a spectrum, and a phase plane."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource

from lostmotion.errors import DataError
from lostmotion.recording.clock import find_time
from lostmotion.recording.table import Table
from lostmotion.recording.timing import GapError
from lostmotion.recording.units import name_and_unit
from lostmotion.recording.value_checks import fill_lost
from lostmotion.report import colours
from lostmotion_app.curves import Array, CurvePanels, abreast, colour_of, make_figure, thin
from lostmotion_app.parts import make_html, write_note
from lostmotion_app.used_parts import UsedPart

UNITS = (
    "N", "kN", "mN", "N m", "mN m", "N cm", "lbf", "kgf", "m", "mm", "um", "cm", "inch", "rad", "mrad", "deg", "turn",
    "m/s", "mm/s", "rad/s", "deg/s", "rpm", "m/s^2", "g", "mm/s^2", "rad/s^2", "deg/s^2", "V", "mV", "A", "mA",
)  # fmt: skip
"""The units that the page offers; any other that `init` knows may be typed."""
MOST_COLUMNS = 12
"""The number of columns that are drawn."""
SHADES = "Mark a range with the mouse to enlarge it, down to single samples. Blue: held out, in no fit. Grey: not used."
POINTS = 6000
"""The number of points of a phase plane."""
SMOOTHED = 9
"""The number of samples over which a rate of change is fitted."""


class RecordedFigures:
    """The figures of one table."""

    def __init__(self) -> None:
        self.view = pn.Column(sizing_mode="stretch_width", margin=0)
        self.time, self.columns, self.span = np.zeros(0), dict[str, Array](), (0.0, 1.0)
        self.even = slice(None)
        self.curves = CurvePanels("time (s)")
        self.units: dict[str, str] = {}
        self.boxes: list[Sequence[Any]] = []
        tools = "pan,wheel_zoom,box_zoom,reset,save"
        self.spectrum = make_figure(
            "frequency (Hz)", "power spectral density", says="Power spectral density", height=260, tools=tools,
            x_axis_type="log", y_axis_type="log",
        )  # fmt: skip
        self.phase = make_figure("", "", says="Phase plane: rate of change over the value", height=260, tools=tools)
        self.lines = (ColumnDataSource({"x": [], "y": []}), ColumnDataSource({"x": [], "y": []}))
        self.spectrum.line("x", "y", source=self.lines[0], color=colour_of(colours.AFTER))
        self.phase.scatter("x", "y", source=self.lines[1], color=colour_of(colours.AFTER), size=2, alpha=0.5)
        self.column = pn.widgets.Select(name="Spectrum and phase plane of", width=260)
        self.column.param.watch(lambda _: self._show_column(), "value")

    def show_table(self, table: Table, source: str) -> None:
        """Draw the columns of a table over its time, or over the number of the row where it has no time."""
        self.time, label, clock, stretches = find_axis(table, source)
        self.even = slice(*max(stretches, key=lambda rows: rows[1] - rows[0]))
        ends = np.array([last for _, last in stretches[:-1]], dtype=np.intp)  # no line leads over a gap
        at = np.insert(self.time, ends, self.time[ends - 1])
        columns = {name: table.columns[name] for name in table.full_names if name != clock}
        whole = [(name, one) for name, one in columns.items() if one.size == self.time.size]
        self.columns = dict(whole[:MOST_COLUMNS])
        self.units, self.span = dict(table.units), (float(self.time[0]), float(self.time[-1]))
        self.curves, self.boxes = CurvePanels(label), []
        for name, values in self.columns.items():
            panel = self.curves.add_panel(label_of(name, self.units.get(name, "")))
            self.curves.add_curve(panel, at, np.insert(values, ends, np.nan), colour=colours.RECORDED)
        self.curves.fit_range(*self.span)
        names = list(self.columns)
        self.column.options, self.column.value = names, names[-1] if names else None
        self._show_column()
        self.view[:] = [
            make_html(write_note(f"{SHADES}{write_rest(len(whole))}")),
            *(pn.pane.Bokeh(panel, sizing_mode="stretch_width", margin=(0, 2)) for panel in self.curves.panels),
            self.column,
            abreast(self.spectrum, self.phase),
        ]  # fmt: skip

    def mark(self, stretches: Sequence[UsedPart]) -> None:
        """Shade what is not used, and what is held out; the stretches are in the order of their times."""
        low, high = self.span
        edges = [low, *(end for one in stretches for end in (one.start, one.end)), high]
        shades = [(*edges[k : k + 2], "#7f7f7f", 0.35) for k in range(0, len(edges), 2)]
        shades += [(one.held, one.end, colours.AFTER, 0.10) for one in stretches]
        while len(self.boxes) < len(shades):
            self.boxes.append(self.curves.shade(low, low))
        spare = [(low, low, "#7f7f7f", 0.0)] * (len(self.boxes) - len(shades))
        for boxes, (left, right, colour, alpha) in zip(self.boxes, [*shades, *spare], strict=True):
            for box in boxes:
                box.update(left=left, right=right, fill_color=colour, fill_alpha=alpha)

    def _show_column(self) -> None:
        """Draw spectrum and phase plane of the chosen column."""
        values = self.columns.get(self.column.value or "")
        if values is None or np.count_nonzero(np.isfinite(values)) < 3 * SMOOTHED:
            for one in self.lines:
                one.data = {"x": [], "y": []}
            return
        from scipy.signal import savgol_filter

        from lostmotion.signals import spectrum

        even, dt = fill_lost(values[self.even]), float(np.median(np.diff(self.time)))
        found = spectrum(even, dt, segments=8)
        at, density = thin(found.frequency[1:], found.density[1:], 0.0, np.inf)
        self.lines[0].data = {"x": at, "y": np.maximum(density, np.finfo(float).tiny)}
        step = max(1, even.size // POINTS)
        rate = savgol_filter(even, SMOOTHED, 2, deriv=1, delta=dt)
        self.lines[1].data = {"x": even[::step], "y": rate[::step]}
        unit = self.units.get(self.column.value, "")
        self.spectrum.yaxis.axis_label = f"power spectral density ({unit}²/Hz)" if unit else "power spectral density"
        self.phase.xaxis.axis_label = label_of(self.column.value, unit)
        self.phase.yaxis.axis_label = label_of("rate of change", f"{unit}/s" if unit else "")


def label_of(name: str, unit: str) -> str:
    """Return the label of an axis, with its unit if the name has none."""
    return name if not unit or unit in name or name_and_unit(name)[1] else f"{name} ({unit})"


def find_axis(table: Table, source: str) -> tuple[Array, str, str | None, Sequence[tuple[int, int]]]:
    """Return the time (n,) of a table in s, the label of the axis, and the column of the time.

    The last value is (first row, row after the last) of each stretch between gaps. Where the table has no time, it is
    the number of the row.
    """
    try:
        found = find_time(table, source)
    except GapError as gaps:
        return gaps.time, "time (s)", gaps.column, gaps.stretches
    except DataError:
        longest = max(table.columns[name].size for name in table.full_names)
        return np.arange(longest, dtype=float), "row", None, [(0, longest)]
    return found.time, "time (s)", found.column, [(0, found.time.size)]


def write_rest(count: int) -> str:
    """Return a sentence on columns that are not drawn; empty where all of `count` columns are."""
    return f" The first {MOST_COLUMNS} of {count} columns are drawn." if count > MOST_COLUMNS else ""
