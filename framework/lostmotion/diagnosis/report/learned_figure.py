"""Figure of the learned curve of a missing force that no mechanism of the library explains."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style
from lostmotion.report.words import with_unit
from lostmotion.results.diagnosis import LearnedCurve, Mechanism

COVARIATE_NAMES = {"phase": "drive phase", "time": "time", "history": "stretch of a relaxing spring"}


def list_curves(evidence: Evidence) -> Sequence[LearnedCurve]:
    """Return the learned curves of a diagnosis; none where the library explains the missing force."""
    return [curve for one in _list_unknown(evidence) for curve in one.curves]


def _list_unknown(evidence: Evidence) -> list[Mechanism]:
    return [one for one in evidence.result.found if one.mechanism == "unknown"]


def draw(evidence: Evidence) -> Figure | None:
    """Return one panel for each learned curve, or None without any."""
    curves = list_curves(evidence)
    if not curves:
        return None
    figure = style.make_figure(3.2)
    panels = figure.subplots(1, len(curves), squeeze=False)
    for axes, curve in zip(panels.flat, curves, strict=True):
        drawn = draw_surface if curve.over_too else draw_learned
        drawn(axes, curve)
    flat = next((axes for axes, curve in zip(panels.flat, curves, strict=True) if not curve.over_too), None)
    if flat is not None:
        style.legend_above(figure, flat)
    return figure


def draw_surface(axes: Axes, curve: LearnedCurve) -> None:
    """Draw a learned force over two quantities where the motion was; lines enclose where its band excludes zero."""
    at, beside = np.array(curve.at), np.array(curve.at_too)
    mean, low, high = (np.array(cells) for cells in (curve.force, curve.low, curve.high))
    seen = np.array(curve.visited)
    scales = [style.scale_of(at, curve.unit), style.scale_of(beside, curve.unit_too or "")]
    x, y = scales[0].factor * at, scales[1].factor * beside
    most = float(np.max(np.abs(mean[seen]), initial=1e-300))
    shown = np.where(seen, mean, np.nan).T
    drawn = axes.pcolormesh(x, y, shown, cmap="RdBu_r", vmin=-most, vmax=most, shading="nearest", rasterized=True)
    sure = np.where(seen & ((low > 0.0) | (high < 0.0)), 1.0, 0.0).T
    axes.contour(x, y, sure, levels=[0.5], colors=style.RECORDED, linewidths=0.7)
    over, too = curve.over, curve.over_too or ""
    axes.set_xlabel(with_unit(COVARIATE_NAMES.get(over, over), scales[0].unit))
    axes.set_ylabel(with_unit(COVARIATE_NAMES.get(too, too), scales[1].unit))
    axes.figure.colorbar(drawn, ax=axes).set_label(with_unit("learned force", curve.force_unit))


def draw_learned(axes: Axes, curve: LearnedCurve) -> None:
    """Draw a learned curve with its 95 % band and a line at zero."""
    at, mean, low, high = (np.array(cells, dtype=float) for cells in (curve.at, curve.force, curve.low, curve.high))
    scale = style.scale_of(at, curve.unit)
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    axes.fill_between(scale.factor * at, low, high, color=style.LAW, alpha=0.18, linewidth=0, label="95 % band")
    axes.plot(scale.factor * at, mean, color=style.LAW, linewidth=1.8, label="learned curve")
    style.few_ticks(axes)
    axes.set_xlabel(with_unit(COVARIATE_NAMES.get(curve.over, curve.over), scale.unit))
    axes.set_ylabel(with_unit("learned force" + (f" over {curve.times}" if curve.times else ""), curve.force_unit))


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure, with the proposed formula, marked as a proposal."""
    body = "The learned curve in the model after, for the force that no mechanism of the library explains. "
    if any(curve.over_too for curve in list_curves(evidence)):
        body += "A map is drawn where the motion was; inside the lines its 95 % band excludes zero. "
    proposal = next((one.proposal for one in _list_unknown(evidence) if one.proposal), None)
    if proposal is None:
        return body.strip()
    return f"{body}{proposal.says}" + (f" The formula is {proposal.formula}." if proposal.formula else "")
