"""Figures of long series: each shows the lowest and the highest value per pixel, and single samples when enlarged."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import panel as pn
from bokeh.events import RangesUpdate
from bokeh.models import BasicTickFormatter, BoxAnnotation, ColumnDataSource, Range1d, Title
from bokeh.plotting import figure
from numpy.typing import NDArray

from lostmotion.report import colours
from lostmotion_app.parts import is_dark

Array = NDArray[np.float64]
PIXELS = 900
"""The number of columns of pixels of which the lowest and highest values are drawn."""
HEIGHT = 150
SMALLEST = -5
"""The power of ten from which numbers at an axis are written without an exponent."""
LETTER, AXIS = 7, 30
"""The width of a letter of a label, and the height of what is below a figure, in pixels."""
TOOLS = "xbox_zoom,xpan,xwheel_zoom,reset,save"
_DARK = {colours.RECORDED: "#e8e8e8", colours.BEFORE: "#ff8c42", colours.AFTER: "#56b4e9", colours.LAW: "#00b37a"}


def colour_of(colour: str) -> str:
    """Return a colour of the reports, or a lighter one that is seen on a dark page."""
    return _DARK.get(colour, colour) if is_dark() else colour


def make_figure(x: str, y: str, *, says: str, height: int = HEIGHT, tools: str = TOOLS, **options: Any) -> Any:
    """Return an empty figure of the page with the labels of its axes; `says` names it for who does not see it.

    A label that is too long for the height of the figure stands above it.
    """
    ink, grid = ("#cccccc", "#3a3f44") if is_dark() else ("#444444", "#e3e3e3")
    beside = len(y) * LETTER < height - AXIS
    made = figure(
        height=height,
        tools=tools,
        sizing_mode="stretch_width",
        x_axis_label=x,
        y_axis_label=y if beside else None,
        title=None if beside else Title(text=y, text_color=ink, text_font_size="12px", text_font_style="normal"),
        html_attributes={"role": "figure", "aria-label": says},
        min_width=260,
        **options,
    )
    made.toolbar.logo, made.toolbar.autohide = None, True
    made.background_fill_color = made.border_fill_color = None
    made.outline_line_color = None
    for axis in made.axis:
        axis.axis_label_text_color = axis.major_label_text_color = axis.axis_line_color = ink
        axis.axis_label_text_font_style, axis.axis_label_text_font_size = "normal", "12px"
        if isinstance(axis.formatter, BasicTickFormatter):
            axis.formatter.power_limit_low = SMALLEST
        axis.major_tick_line_color = axis.minor_tick_line_color = ink
    made.grid.grid_line_color = grid
    return made


def thin(x: Array, y: Array, low: float, high: float, pixels: int = PIXELS) -> tuple[Array, Array]:
    """Return the part of a curve between two values of `x` (n,), which grows: at most four values per pixel.

    Where there are more, each pixel has its lowest and its highest value, in their order.
    """
    first, last = np.searchsorted(x, (low, high))
    first, last = max(int(first) - 1, 0), min(int(last) + 1, len(x))
    if last - first <= 4 * pixels:
        return x[first:last], y[first:last]
    edges = np.linspace(first, last, pixels, endpoint=False).astype(np.intp)
    part, starts = y[first:last], edges - first
    lowest, highest = np.fmin.reduceat(part, starts), np.fmax.reduceat(part, starts)
    rising = part[starts] <= part[np.append(starts[1:], len(part)) - 1]
    both = np.stack([np.where(rising, lowest, highest), np.where(rising, highest, lowest)], axis=1)
    at = x[edges]
    width = 0.5 * (x[last - 1] - x[first]) / pixels
    return np.stack([at, at + width], axis=1).ravel(), both.ravel()


class CurvePanels:
    """CurvePanels over one axis, such as the columns of a recording over time; all panels have the same range."""

    def __init__(self, label: str) -> None:
        self.label, self.range = label, Range1d(0.0, 1.0)
        self._curves: list[tuple[Any, Array, Array]] = []
        self._span: tuple[float, float] | None = None
        self.panels: list[Any] = []

    def add_panel(self, label: str, *, height: int = HEIGHT) -> Any:
        """Return a further panel below the others, with the label of its values."""
        name = f"panel {len(self.panels)}"
        made = make_figure(
            self.label, label, says=f"{label} over {self.label}", height=height, x_range=self.range,
            active_drag="xbox_zoom", name=name,
        )  # fmt: skip
        if self.panels:
            self.panels[-1].xaxis.axis_label = None
        made.on_event(RangesUpdate, lambda event: self._redraw(event.x0, event.x1))
        self.panels.append(made)
        return made

    def add_curve(self, panel: Any, x: Array, y: Array, *, colour: str, name: str = "", width: float = 1.1) -> Any:
        """Return the line of a curve (n,) over `x` (n,), which grows."""
        source = ColumnDataSource({"x": [], "y": []})
        legend = {"legend_label": name} if name else {}
        line = panel.line("x", "y", source=source, color=colour_of(colour), line_width=width, **legend)
        self._curves.append((source, x, y))
        return line

    def fit_range(self, low: float, high: float) -> None:
        """Show the curves between two values."""
        self._span = None
        self.range.update(start=low, end=high, reset_start=low, reset_end=high)
        self._redraw(low, high)

    def shade(self, low: float, high: float) -> Sequence[Any]:
        """Return an area between two values in each panel."""
        boxes = []
        for panel in self.panels:
            box = BoxAnnotation(left=low, right=high, fill_alpha=0.13, fill_color="#7f7f7f", line_color=None)
            panel.add_layout(box)
            boxes.append(box)
        return boxes

    def replace(self, line: Any, x: Array, y: Array) -> None:
        """Exchange the values of a line."""
        self._curves = [(s, x, y) if s is line.data_source else (s, a, b) for s, a, b in self._curves]
        self._draw(line.data_source, x, y)

    def _redraw(self, low: float, high: float) -> None:
        """Draw all curves between two values; each panel tells of a new range, and the first one is sufficient."""
        if self._span == (low, high):
            return
        self._span = (low, high)
        for source, x, y in self._curves:
            self._draw(source, x, y, (low, high))

    def _draw(self, source: Any, x: Array, y: Array, span: tuple[float, float] | None = None) -> None:
        low, high = span or (float(self.range.start), float(self.range.end))
        at, values = thin(x, y, low, high)
        source.data = {"x": at, "y": values}


def format_legend(panel: Any) -> None:
    """Put the legend of a panel above it, in one line; a click hides a curve."""
    for legend in panel.legend:
        legend.ncols = 3  # as many as a phone is wide
        legend.orientation, legend.click_policy, legend.background_fill_alpha = "horizontal", "hide", 0.0
        legend.border_line_color, legend.label_text_font_size, legend.padding = None, "12px", 2
        legend.label_text_color = "#cccccc" if is_dark() else "#222222"
    if panel.legend:
        panel.add_layout(panel.legend[0], "above")


def abreast(*figures: Any) -> Any:
    """Return figures beside each other; below each other on a narrow page."""
    boxes = [pn.Column(pn.pane.Bokeh(one, sizing_mode="stretch_width"), sizing_mode="stretch_width",
                       styles={"flex": "1 1 330px", "min-width": "280px"}) for one in figures]  # fmt: skip
    return pn.FlexBox(*boxes, sizing_mode="stretch_width")
