"""The common style of all figures: colours, fonts, grids; and the embedding of figures in pages."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from PIL import Image

from lostmotion.report.colours import AFTER as AFTER
from lostmotion.report.colours import BEFORE as BEFORE
from lostmotion.report.colours import LAW as LAW
from lostmotion.report.colours import QUIET as QUIET
from lostmotion.report.colours import RECORDED as RECORDED
from lostmotion.report.colours import SHADE as SHADE
from lostmotion.report.words import Scale, angles_in, choose_scale, figures, power_of_ten
from lostmotion.results import Array
from lostmotion.storage import save_bytes

WIDTH = 9.6
LARGEST_SVG = 300_000
DOT = 30
RC: dict[Any, Any] = {
    "font.family": ["DejaVu Sans"],
    "font.size": 9.5,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.5,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.7,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "legend.frameon": False,
    "legend.fontsize": 9,
    "lines.linewidth": 1.4,
    "lines.solid_joinstyle": "round",
    "path.simplify_threshold": 0.3,
    "figure.facecolor": "white",
    # Names come from files: a dollar sign in a name does not start a formula.
    "text.parse_math": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "lostmotion",
}


@contextmanager
def use_style(angle: str = "rad") -> Iterator[None]:
    """Return a context in which figures are drawn and saved in the common style, independent of user settings.

    `angle` is the unit of angles, rad or deg.
    """
    with mpl.rc_context(), angles_in(angle):
        mpl.rcdefaults()
        mpl.rcParams.update(RC)
        yield


def make_figure(height: float, width: float = WIDTH) -> Figure:
    """Return an empty figure of a height in inches, `width` inches wide."""
    return Figure(figsize=(width, height), layout=ConstrainedLayoutEngine(w_pad=0.08, h_pad=0.06))


def make_note(text: str) -> Figure:
    """Return a low figure that holds a short text, where there is nothing to draw."""
    figure = make_figure(1.0)
    figure.text(0.5, 0.5, text, ha="center", va="center")
    return figure


def scale_of(values: Array, unit: str) -> Scale:
    """Return the scale in which the finite values are easy to read."""
    finite = np.abs(values[np.isfinite(values)])
    return choose_scale(float(finite.max()) if finite.size else 0.0, unit)


def few_ticks(axes: Axes, across: int = 6, up: int = 5) -> None:
    """Limit the ticks of both axes, and format them without an offset."""
    axes.xaxis.set_major_locator(MaxNLocator(across))
    axes.yaxis.set_major_locator(MaxNLocator(up))
    axes.ticklabel_format(useOffset=False)


def log_ticks(axis: Axis, most: int = 6) -> None:
    """Set the ticks of a logarithmic axis to powers of ten, or to 1, 2, 5 where it spans less than two of them."""
    low, high = sorted(axis.get_view_interval())
    plain = low >= 5e-3 and high <= 2e3
    axis.set_major_locator(
        LogLocator(subs=(1.0, 2.0, 5.0) if low > 0.0 and high / low < 100.0 else (1.0,), numticks=most)
    )
    axis.set_major_formatter(FuncFormatter(lambda value, _place: figures(value) if plain else power_of_ten(value)))
    axis.set_minor_formatter(NullFormatter())


def span_of(values: Array, margin: float) -> tuple[float, float]:
    """Return the range of the finite values, widened on both sides by a share of itself."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return -1.0, 1.0
    low, high = float(finite.min()), float(finite.max())
    room = margin * (high - low) or 0.1 * abs(high) or 1.0
    return low - room, high + room


def limits_around(main: Array, others: list[Array], most: float) -> tuple[float, float]:
    """Return axis limits that contain all curves, but at most `most` ranges beyond the main one."""
    bound = span_of(main, most)
    everything = np.concatenate([main, *others]) if others else main
    low, high = span_of(everything, 0.06)
    return max(low, bound[0]), min(high, bound[1])


def legend_above(figure: Figure, axes: Axes) -> None:
    """Place one legend above the whole figure, from the labelled curves of one panel."""
    handles, names = axes.get_legend_handles_labels()
    if names:
        figure.legend(handles, names, loc="outside upper left", ncols=len(names))


def embed_figure(figure: Figure, name: str) -> Markup:
    """Return a figure as self-contained markup: inline SVG, or a PNG where the SVG would be too large.

    Matplotlib escapes all text, and `name` is a constant of this program.
    """
    if _has_many_dots(figure):
        return Markup(_embed_png(figure, name))  # noqa: S704
    drawing = io.StringIO()
    figure.savefig(drawing, format="svg", metadata={"Date": None, "Creator": None})
    text = drawing.getvalue()
    return Markup(_embed_svg(text, name) if len(text) <= LARGEST_SVG else _embed_png(figure, name))  # noqa: S704


def _has_many_dots(figure: Figure) -> bool:
    """Return whether a figure has so many dots, of about `DOT` characters each, that its SVG would be too large."""
    lines = [line for axes in figure.axes for line in axes.lines if line.get_linestyle() == "None"]
    return DOT * sum(len(np.atleast_1d(line.get_xdata())) for line in lines) > LARGEST_SVG


def save(figure: Figure, path: Path) -> Path:
    """Return the path of the PNG into which the figure was saved."""
    pixels = io.BytesIO()
    figure.savefig(pixels, format="png", dpi=160, metadata={"Software": None})
    small = io.BytesIO()
    Image.open(pixels).convert("RGB").quantize(128).save(small, format="png", optimize=True)
    return save_bytes(path, small.getvalue())


def _embed_png(figure: Figure, name: str) -> str:
    pixels = io.BytesIO()
    figure.savefig(pixels, format="png", dpi=150, metadata={"Software": None})
    return f'<img alt="{name}" src="data:image/png;base64,{base64.b64encode(pixels.getvalue()).decode()}">'


def _embed_svg(text: str, name: str) -> str:
    """Return the SVG without addresses, and with unique names, since all figures are on one page."""
    text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
    text = re.sub(r'\s(xmlns(:\w+)?|width|height)="[^"]*"', "", text, count=4)
    # The names by matplotlib contain hashes of digits that differ from run to run, so they are replaced by numbers.
    names = {old: f"{name}-{count}" for count, old in enumerate(dict.fromkeys(re.findall(r'\bid="([^"]+)"', text)))}
    text = re.sub(r'(\bid="|url\(#|href="#)([^")]+)', lambda found: found[1] + names.get(found[2], found[2]), text)
    return text.replace("<svg", f'<svg role="img" aria-label="{name}"', 1)
