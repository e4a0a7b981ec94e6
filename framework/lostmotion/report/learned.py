"""Figure: the curve that was learned where no mechanism of the library explains what is missing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion.report.evidence import Evidence
from lostmotion.report.words import with_unit

NAMED = {"phase": "drive phase", "time": "time", "history": "stretch of a spring that forgets"}


def curves_of(evidence: Evidence) -> Sequence[Mapping[str, Any]]:
    """Return the learned curves of a diagnosis; none where the library explains what is missing."""
    return [curve for entry in _unknown(evidence) for curve in entry.get("curves") or [entry.get("curve")] if curve]


def _unknown(evidence: Evidence) -> list[Mapping[str, Any]]:
    found = evidence.fact("found") or []
    return [entry for entry in found if isinstance(entry, Mapping) and entry.get("mechanism") == "unknown"]


def draw(evidence: Evidence) -> Figure | None:
    """Return one panel for each learned curve, or None without any."""
    curves = curves_of(evidence)
    if not curves:
        return None
    figure = style.blank(3.2)
    panels = figure.subplots(1, len(curves), squeeze=False)
    for axes, curve in zip(panels.flat, curves, strict=True):
        drawn = draw_surface if curve.get("over_too") else draw_learned
        drawn(axes, curve, evidence.unit("force"))
    flat = next((axes for axes, curve in zip(panels.flat, curves, strict=True) if not curve.get("over_too")), None)
    if flat is not None:
        style.legend_above(figure, flat)
    return figure


def draw_surface(axes: Axes, curve: Mapping[str, Any], force: str) -> None:
    """Draw a learned force over two things as a map where the motion was, with lines where it is surely not zero."""
    at, beside = (np.asarray(curve[name], dtype=float) for name in ("at", "at_too"))
    mean, low, high = (np.asarray(curve[name], dtype=float) for name in ("force", "low", "high"))
    seen = np.asarray(curve["visited"], dtype=bool)
    scales = [style.scale_of(v, str(curve.get(unit, ""))) for v, unit in ((at, "unit"), (beside, "unit_too"))]
    x, y = scales[0].factor * at, scales[1].factor * beside
    most = float(np.max(np.abs(mean[seen]), initial=1e-300))
    shown = np.where(seen, mean, np.nan).T
    drawn = axes.pcolormesh(x, y, shown, cmap="RdBu_r", vmin=-most, vmax=most, shading="nearest", rasterized=True)
    sure = np.where(seen & ((low > 0.0) | (high < 0.0)), 1.0, 0.0).T
    axes.contour(x, y, sure, levels=[0.5], colors=style.RECORDED, linewidths=0.7)
    over, too = str(curve["over"]), str(curve["over_too"])
    axes.set_xlabel(with_unit(NAMED.get(over, over), scales[0].unit))
    axes.set_ylabel(with_unit(NAMED.get(too, too), scales[1].unit))
    axes.figure.colorbar(drawn, ax=axes).set_label(with_unit("learned force", str(curve.get("force_unit") or force)))


def draw_learned(axes: Axes, curve: Mapping[str, Any], force: str) -> None:
    """Draw a learned curve with its band of 95 %, and zero, where nothing would be missing."""
    at, mean, low, high = (np.asarray(curve[name], dtype=float) for name in ("at", "force", "low", "high"))
    scale = style.scale_of(at, str(curve.get("unit", "")))
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    axes.fill_between(scale.factor * at, low, high, color=style.LAW, alpha=0.18, linewidth=0, label="95 % band")
    axes.plot(scale.factor * at, mean, color=style.LAW, linewidth=1.8, label="learned curve")
    style.few_ticks(axes)
    over = str(curve.get("over", ""))
    axes.set_xlabel(with_unit(NAMED.get(over, over), scale.unit))
    times = str(curve.get("times") or "")
    axes.set_ylabel(
        with_unit("learned force" + (f" over {times}" if times else ""), str(curve.get("force_unit") or force))
    )


def caption(evidence: Evidence) -> str:
    """Return what the curve says, and the formula that was proposed for it, marked as a proposal."""
    body = "The curve that stands for what no mechanism of the library explains, in the model after. "
    if any(curve.get("over_too") for curve in curves_of(evidence)):
        body += "A map is drawn where the motion was; its 95 % band excludes zero within the lines. "
    proposals = [entry.get("proposal") or {} for entry in _unknown(evidence)]
    for proposal in proposals:
        if proposal.get("formula"):
            return f"{body}{proposal.get('says', '')} It reads {proposal['formula']}."
        if proposal.get("says"):
            return f"{body}{proposal['says']}"
    return body.strip()
