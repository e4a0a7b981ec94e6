"""Figure of a map: the largest exponent over two axes, with zero marked and the contour of half chaotic starts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.errors import DataError
from lostmotion.report import style
from lostmotion.report.words import with_unit
from lostmotion.results import Array
from lostmotion_chaos.defaults import FLOW_EXPONENT

# Blue below zero, white at zero, red above: colour-blind readers can distinguish these.
COLOUR_MAP = LinearSegmentedColormap.from_list(
    "exponent", ["#053061", "#2f79b5", "#a7cfe4", "#ffffff", "#fbc4a4", "#d55e00", "#5f1f00"]
)
LINE_COLOUR = "#111111"
HALF_CHAOTIC = 0.499


def save(dataset: xr.Dataset, path: Path) -> Path:
    """Draw the map into a PNG file and return its path."""
    with style.use_style():
        return style.save(draw(dataset), path)


def draw(dataset: xr.Dataset) -> Figure:
    """Return the figure: mean exponent over starts in colour, and a line where half of the starts are chaotic."""
    names = [str(d) for d in dataset["chaotic_fraction"].dims]
    if len(names) != 2 or min(dataset.sizes[n] for n in names) < 2:
        raise DataError(f"a map over {', '.join(names)} cannot be drawn: two axes of two points or more are needed")
    figure = style.make_figure(5.6)
    axes = figure.subplots()
    across, up = (_scale_axis(dataset, name) for name in names)
    exponent = _average_starts(dataset).T
    mesh = axes.pcolormesh(
        across, up, exponent, cmap=COLOUR_MAP, norm=_make_colour_scale(exponent), shading="nearest", rasterized=True
    )
    _draw_chaos_boundary(axes, (across, up), dataset["chaotic_fraction"].to_numpy().T)
    axes.grid(visible=False)
    axes.set_xlabel(_format_label(dataset, names[0]))
    axes.set_ylabel(_format_label(dataset, names[1]))
    style.few_ticks(axes, 9, 7)
    _draw_colour_bar(figure, axes, mesh, str(dataset[FLOW_EXPONENT].attrs["units"]))
    starts = dataset.sizes["start"]
    axes.set_title(_format_title(starts), fontsize=9.0)
    return figure


def _format_title(starts: int) -> str:
    if starts == 1:
        return "Largest Lyapunov exponent from one start in each cell; black line: edge of chaos"
    return f"Largest Lyapunov exponent, mean of {starts} starts; black line: half of the starts end in chaos"


def _draw_colour_bar(figure: Figure, axes: Axes, mesh: object, unit: str) -> None:
    """Draw the colour bar with a line at zero."""
    bar = figure.colorbar(mesh, ax=axes, pad=0.015, aspect=34)  # type: ignore[arg-type]
    bar.set_label(f"largest exponent ({unit})")
    bar.ax.axhline(0.0, color=LINE_COLOUR, linewidth=1.2)
    bar.locator = MaxNLocator(8)
    bar.update_ticks()
    bar.outline.set_linewidth(0.5)


def _average_starts(dataset: xr.Dataset) -> Array:
    """Return the mean exponent over the starts with a finite value, NaN where there is none."""
    values = dataset[FLOW_EXPONENT].to_numpy()
    good = np.isfinite(values)
    many = good.sum(axis=-1)
    total = np.where(good, values, 0.0).sum(axis=-1)
    mean: Array = np.where(many > 0, total / np.maximum(many, 1), np.nan)
    return mean


def _make_colour_scale(exponent: Array) -> TwoSlopeNorm:
    """Return the colour scale: white at zero, ends at the 1 % and 99.5 % quantiles."""
    finite = exponent[np.isfinite(exponent)]
    low, high = np.quantile(finite, [0.01, 0.995]) if finite.size else (-1.0, 1.0)
    reach = max(abs(float(low)), abs(float(high)), 1e-12)
    return TwoSlopeNorm(0.0, min(float(low), -0.05 * reach), max(float(high), 0.05 * reach))


def _draw_chaos_boundary(axes: Axes, grid: tuple[Array, Array], share: Array) -> None:
    """Draw the line along which half of the starts are chaotic, if there is one."""
    filled = np.nan_to_num(share)
    # A little below one half: many cells have exactly one half, and a contour at that value would fill whole cells.
    if filled.min() < HALF_CHAOTIC < filled.max():
        axes.contour(*grid, filled, levels=[HALF_CHAOTIC], colors=LINE_COLOUR, linewidths=0.8)


def _scale_axis(dataset: xr.Dataset, name: str) -> Array:
    """Return the points of an axis as drawn: logarithms or reciprocals where these are evenly spaced."""
    axis = dataset[name]
    values = np.asarray(axis.to_numpy(), dtype=float)
    if axis.attrs.get("spacing") == "log":
        return np.asarray(np.log10(values))
    return 1.0 / values if axis.attrs.get("spacing") == "inverse" else values


def _format_label(dataset: xr.Dataset, name: str) -> str:
    attrs = dataset[name].attrs
    symbol = {"inverse": f"1 / {name}", "log": f"log10 {name}"}.get(attrs.get("spacing", ""), name)
    unit = str(attrs.get("units", "1"))
    short = symbol if unit == "1" else with_unit(symbol, unit)
    if "long_name" not in attrs:
        return short
    return f"{short}: {attrs['long_name']}" if symbol == name else f"{short} ({name}: {attrs['long_name']})"
