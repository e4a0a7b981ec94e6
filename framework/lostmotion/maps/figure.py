"""Figure: the largest exponent over two axes of a map, zero marked, with the contour of the share of chaos."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.defaults import FLOW_EXPONENT
from lostmotion.errors import DataError
from lostmotion.report import style
from lostmotion.report.words import with_unit
from lostmotion.results import Array

# From the blue of the house through white at zero to its red: told apart by colour-blind readers.
COLOURS = LinearSegmentedColormap.from_list(
    "exponent", ["#053061", "#2f79b5", "#a7cfe4", "#ffffff", "#fbc4a4", "#d55e00", "#5f1f00"]
)
EDGE = "#111111"
HALF = 0.499


def save(dataset: xr.Dataset, path: Path) -> Path:
    """Return the path of the PNG into which the map was drawn."""
    with style.applied():
        return style.save(draw(dataset), path)


def draw(dataset: xr.Dataset) -> Figure:
    """Return the map: mean exponent over starts in colour, and a line where half of the starts end in chaos."""
    names = [str(d) for d in dataset["chaotic_fraction"].dims]
    if len(names) != 2 or min(dataset.sizes[n] for n in names) < 2:
        raise DataError(f"a map over {', '.join(names)} cannot be drawn: two axes of two points or more are wanted")
    figure = style.blank(5.6)
    axes = figure.subplots()
    across, up = (_scale(dataset, name) for name in names)
    exponent = _mean(dataset).T
    mesh = axes.pcolormesh(across, up, exponent, cmap=COLOURS, norm=_norm(exponent), shading="nearest", rasterized=True)
    _edge(axes, (across, up), dataset["chaotic_fraction"].to_numpy().T)
    axes.grid(visible=False)
    axes.set_xlabel(_label(dataset, names[0]))
    axes.set_ylabel(_label(dataset, names[1]))
    style.few_ticks(axes, 9, 7)
    _bar(figure, axes, mesh, str(dataset[FLOW_EXPONENT].attrs["units"]))
    starts = dataset.sizes["start"]
    axes.set_title(_title(starts), fontsize=9.0)
    return figure


def _title(starts: int) -> str:
    if starts == 1:
        return "Largest Lyapunov exponent from one start in each cell; black line: edge of chaos"
    return f"Largest Lyapunov exponent, mean of {starts} starts; black line: half of the starts end in chaos"


def _bar(figure: Figure, axes: Axes, mesh: object, unit: str) -> None:
    """Draw the colour bar with a line at zero."""
    bar = figure.colorbar(mesh, ax=axes, pad=0.015, aspect=34)  # type: ignore[arg-type]
    bar.set_label(f"largest exponent ({unit})")
    bar.ax.axhline(0.0, color=EDGE, linewidth=1.2)
    bar.locator = MaxNLocator(8)
    bar.update_ticks()
    bar.outline.set_linewidth(0.5)


def _mean(dataset: xr.Dataset) -> Array:
    """Return the mean over the starts that gave a number, NaN where none did."""
    values = dataset[FLOW_EXPONENT].to_numpy()
    good = np.isfinite(values)
    many = good.sum(axis=-1)
    total = np.where(good, values, 0.0).sum(axis=-1)
    mean: Array = np.where(many > 0, total / np.maximum(many, 1), np.nan)
    return mean


def _norm(exponent: Array) -> TwoSlopeNorm:
    """Return the scale of the colours: white at zero, its ends such that few cells lie beyond."""
    finite = exponent[np.isfinite(exponent)]
    low, high = np.quantile(finite, [0.01, 0.995]) if finite.size else (-1.0, 1.0)
    reach = max(abs(float(low)), abs(float(high)), 1e-12)
    return TwoSlopeNorm(0.0, min(float(low), -0.05 * reach), max(float(high), 0.05 * reach))


def _edge(axes: Axes, grid: tuple[Array, Array], share: Array) -> None:
    """Draw the line along which half of the starts end in chaos, if there is one."""
    filled = np.nan_to_num(share)
    # A little below one half, which is itself a share that cells have: a contour through whole cells is no line.
    if filled.min() < HALF < filled.max():
        axes.contour(*grid, filled, levels=[HALF], colors=EDGE, linewidths=0.8)


def _scale(dataset: xr.Dataset, name: str) -> Array:
    """Return the points of an axis as they are drawn: one over them where they are even in that."""
    axis = dataset[name]
    values = np.asarray(axis.to_numpy(), dtype=float)
    if axis.attrs.get("spacing") == "log":
        return np.asarray(np.log10(values))
    return 1.0 / values if axis.attrs.get("spacing") == "inverse" else values


def _label(dataset: xr.Dataset, name: str) -> str:
    attrs = dataset[name].attrs
    said = {"inverse": f"1 / {name}", "log": f"log10 {name}"}.get(attrs.get("spacing", ""), name)
    unit = str(attrs.get("units", "1"))
    short = said if unit == "1" else with_unit(said, unit)
    if "long_name" not in attrs:
        return short
    return f"{short}: {attrs['long_name']}" if said == name else f"{short} ({name}: {attrs['long_name']})"
