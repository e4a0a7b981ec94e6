"""The common style of the figures: panels, points, colours of exponents, and files in print quality."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from PIL import Image

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion.storage import save_bytes

DPI = 300
"""Resolution of the PNG files and of rasterised parts of the PDF files, in dots per inch."""
COLOURS = ("#1a1a1a", "#0072b2", "#009e73", "#d55e00", "#cc79a7", "#8c6d00")
"""The colours of Okabe and Ito without the lightest."""
MARKS = ("o", "s", "^", "D", "v", "P")
CALM_TO_CHAOS = LinearSegmentedColormap.from_list(
    "calm to chaos", ["#3b6ea5", "#a9c4de", "#f7f7f4", "#f2b48a", "#b2380e"]
)


def save_figure(figure: Figure, folder: Path, name: str) -> list[str]:
    """Save a figure as PNG (300 dpi) and PDF and return the names of the files."""
    pixels, small, page = io.BytesIO(), io.BytesIO(), io.BytesIO()
    figure.savefig(pixels, format="png", dpi=DPI, metadata={"Software": None})
    reduced = Image.open(pixels).convert("RGB").quantize(255, dither=Image.Dither.NONE)
    reduced.save(small, format="png", optimize=True, dpi=(DPI, DPI))
    save_bytes(folder / f"{name}.png", small.getvalue())
    figure.savefig(page, format="pdf", dpi=DPI, metadata={"CreationDate": None, "Creator": None})
    save_bytes(folder / f"{name}.pdf", page.getvalue())
    return [f"{name}.png", f"{name}.pdf"]


def make_panels(rows: int, columns: int, height: float, **options: Any) -> tuple[Figure, list[Axes]]:
    """Return a figure of `height` inches and its panels, row by row."""
    figure = style.make_figure(height)
    made = figure.subplots(rows, columns, squeeze=False, **options)
    return figure, [axes for row in made for axes in row]


def letter_panels(axes: list[Axes], titles: Sequence[str]) -> None:
    """Set the title of each panel, with a letter before it."""
    for k, (panel, title) in enumerate(zip(axes, titles, strict=True)):
        panel.set_title(f"({chr(97 + k)}) {title}")


def draw_orbit(axes: Axes, x: Array, y: Array, *, width: float = 0.35, color: str = style.AFTER) -> None:
    """Draw a trajectory; it is rasterised in a PDF, since it has some ten thousand points."""
    axes.plot(x, y, color=color, lw=width, alpha=0.85, rasterized=True)
    style.few_ticks(axes)


def draw_dots(axes: Axes, x: Array, y: Array, *, size: float = 1.2, color: str = style.AFTER, **options: Any) -> None:
    """Draw points; they are rasterised in a PDF."""
    axes.plot(x, y, ls="", marker="o", ms=size, mew=0, color=color, rasterized=True, **options)
    style.few_ticks(axes)


def make_exponent_norm(values: Array) -> TwoSlopeNorm:
    """Return the colour scale of exponents: zero at the middle, values below -2 times the highest cut off."""
    high = float(np.nanmax(values)) if np.isfinite(values).any() else 1.0
    low = float(np.nanmin(values)) if np.isfinite(values).any() else -1.0
    high = max(high, 1e-6)
    return TwoSlopeNorm(0.0, vmin=min(max(low, -2.0 * high), -1e-6), vmax=high)


def set_whole_ticks(axes: Axes) -> None:
    """Set ticks at whole numbers only on the horizontal axis."""
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
