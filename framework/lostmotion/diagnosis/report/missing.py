"""Figure: the force the model does not explain, over what it may depend on, before and after."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.cast import Version, versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.words import Scale, percent, with_unit
from lostmotion.results import Array

NAMES = {"position": "position", "velocity": "velocity", "phase": "drive phase", "time": "slow time"}


def draw(evidence: Evidence) -> Figure | None:
    """Return one panel for each covariate that has a curve, or None without any."""
    shown = [name for name in evidence.labels.get("covariate", ()) if curve_of(evidence, "before_mean", name).size]
    if not shown:
        return None
    rows = -(-len(shown) // 2)
    figure = style.blank(2.75 * rows + 0.3)
    panels = figure.subplots(rows, min(2, len(shown)), squeeze=False, sharey=True)
    for axes, name in zip(panels.flat, shown, strict=False):
        draw_curve(axes, evidence, name)
    for axes in panels.flat[len(shown) :]:
        axes.remove()
    for axes in panels[:, 1:].flat:
        axes.set_ylabel("")
    style.legend_above(
        figure, max(panels.flat[: len(shown)], key=lambda axes: len(axes.get_legend_handles_labels()[1]))
    )
    return figure


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure."""
    opening = f"The missing force: {evidence.result.where.summary}. "
    body = f"Lines are the mean in each bin, bands hold 95 % of the samples. {_tested(evidence)}{_sought(evidence)}"
    if len(versions(evidence)) == 1 or not evidence.has("after_mean"):
        return f"{opening}{body}A force that was left out would show as a curve that leaves zero."
    return f"{opening}{body}" + (
        "A curve that leaves zero tells what the missing force depends on: vermillion is the force when the term is "
        "taken out, blue what is left with it"
        + (", and the dashed green line is the law that was learnt." if evidence.has("law_mean") else ".")
    )


def _sought(evidence: Evidence) -> str:
    """Return where the force is sought, for machines of several bodies."""
    several = (evidence.result.where.bodies or 1) > 1
    said = "It is sought on the first body: a force that acts elsewhere shows only through what it does there. "
    return said if several else ""


def _tested(evidence: Evidence) -> str:
    """Return what a star means, or an empty string where nothing was tested."""
    against = evidence.result.where.against
    return f"A star marks what is beyond chance by {against}. " if against else ""


def curve_of(evidence: Evidence, name: str, covariate: str) -> Array:
    """Return the row of a binned array that belongs to a covariate; empty where there is none."""
    covariates = evidence.labels.get("covariate", ())
    if covariate not in covariates or not evidence.has(name):
        return np.array([])
    row = evidence.arrays[name][covariates.index(covariate)]
    return row if np.isfinite(row).any() else np.array([])


def draw_curve(axes: Axes, evidence: Evidence, covariate: str) -> None:
    """Draw the missing force over one covariate: mean and band before and after, and the law."""
    unit = _unit(evidence, covariate)
    centre = curve_of(evidence, "bin_center", covariate)
    scale = Scale(1.0, unit) if covariate == "phase" else style.scale_of(centre, unit)
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    for who in versions(evidence):
        _draw_band(axes, evidence, (who, covariate), scale.factor * centre)
    law = curve_of(evidence, "law_mean", covariate)
    if law.size:
        axes.plot(scale.factor * centre, law, color=style.LAW, linestyle=(0, (4, 2)), linewidth=1.8, label="learnt law")
    style.few_ticks(axes)
    if unit == "rad" and covariate == "phase":
        axes.set_xticks([0, np.pi / 2, np.pi, 1.5 * np.pi, 2 * np.pi], ["0", "π/2", "π", "3π/2", "2π"])
    axes.set_xlabel(with_unit(NAMES.get(covariate, covariate), scale.unit))
    axes.set_ylabel(with_unit("missing force", evidence.result.units.force))
    _name_share(axes, evidence, covariate)


def _draw_band(axes: Axes, evidence: Evidence, what: tuple[Version, str], at: Array) -> None:
    who, covariate = what
    mean, low, high = (curve_of(evidence, f"{who.key}_{kind}", covariate) for kind in ("mean", "low", "high"))
    if low.size and high.size:
        axes.fill_between(at, low, high, color=who.colour, alpha=0.18, linewidth=0)
    if mean.size:
        axes.plot(at, mean, color=who.colour, label=who.named("missing force"), marker="o", markersize=2.6)


SHOWN = 0.01
"""A share of the force that is smaller is not told beside a star: what acts on another body hardly shows in the force
on the first one, and yet in the likelihood."""


def _name_share(axes: Axes, evidence: Evidence, covariate: str) -> None:
    where = evidence.result.where
    share = where.explained_by.get(covariate, np.nan)
    if not np.isfinite(share):
        return
    name = NAMES.get(covariate, covariate)
    said = f"{percent(share)} explained by {name}"
    if covariate in where.significant:
        shown = said if share >= SHOWN else f"{name}: beyond chance by likelihood"
        axes.set_title(f"{shown} *", color="black", fontweight="bold")
    else:
        axes.set_title(f"{said}: not beyond chance", color="#8c8c8c")


def _unit(evidence: Evidence, covariate: str) -> str:
    covariates = evidence.labels.get("covariate", ())
    units = evidence.labels.get("covariate_unit", ())
    return units[covariates.index(covariate)] if len(units) == len(covariates) else ""
