"""Figure of the force that the model does not explain, over its covariates, before and after."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import Version, list_versions
from lostmotion.report import style
from lostmotion.report.words import Scale, percent, with_unit
from lostmotion.results import Array

VISIBLE = 0.01
"""A figure shows the share that a significant covariate explains from this share on.

A force on another body changes the likelihood, but hardly the force on the first body."""
COVARIATE_NAMES = {"position": "position", "velocity": "velocity", "phase": "drive phase", "time": "slow time"}


def draw(evidence: Evidence) -> Figure | None:
    """Return one panel for each covariate that has a curve, or None without any."""
    shown = [name for name in evidence.labels.get("covariate", ()) if get_curve(evidence, "before_mean", name).size]
    if not shown:
        return None
    rows = -(-len(shown) // 2)
    figure = style.make_figure(2.75 * rows + 0.3)
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
    """Return the caption of the figure."""
    opening = f"The missing force: {evidence.result.where.summary}. "
    body = "Lines are the mean in each bin, bands contain 95 % of the samples. "
    body += _describe_test(evidence) + _describe_body(evidence)
    if len(list_versions(evidence)) == 1 or not evidence.has("after_mean"):
        return f"{opening}{body}A missing force would appear as a curve that differs from zero."
    return f"{opening}{body}" + (
        "A curve that differs from zero shows the dependence of the missing force: vermillion is the force without the "
        "term, blue the remaining force with it"
        + (", and the dashed green line is the fitted law." if evidence.has("law_mean") else ".")
    )


def _describe_body(evidence: Evidence) -> str:
    """Return on which body the force is estimated, for machines of several bodies."""
    several = (evidence.result.where.bodies or 1) > 1
    text = "It is estimated on the first body: a force on another body appears only through its effect there. "
    return text if several else ""


def _describe_test(evidence: Evidence) -> str:
    """Return the meaning of a star, or an empty text where nothing was tested."""
    against = evidence.result.where.against
    return f"A star marks a significant covariate by {against}. " if against else ""


def get_curve(evidence: Evidence, name: str, covariate: str) -> Array:
    """Return the row of a binned array that belongs to a covariate; empty where there is none."""
    covariates = evidence.labels.get("covariate", ())
    if covariate not in covariates or not evidence.has(name):
        return np.array([])
    row = evidence.arrays[name][covariates.index(covariate)]
    return row if np.isfinite(row).any() else np.array([])


def draw_curve(axes: Axes, evidence: Evidence, covariate: str) -> None:
    """Draw the missing force over one covariate: mean and band before and after, and the law."""
    unit = _get_unit(evidence, covariate)
    centre = get_curve(evidence, "bin_center", covariate)
    scale = Scale(1.0, unit) if covariate == "phase" else style.scale_of(centre, unit)
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    for version in list_versions(evidence):
        _draw_band(axes, evidence, (version, covariate), scale.factor * centre)
    law = get_curve(evidence, "law_mean", covariate)
    if law.size:
        axes.plot(scale.factor * centre, law, color=style.LAW, linestyle=(0, (4, 2)), linewidth=1.8, label="fitted law")
    style.few_ticks(axes)
    if unit == "rad" and covariate == "phase":
        axes.set_xticks([0, np.pi / 2, np.pi, 1.5 * np.pi, 2 * np.pi], ["0", "π/2", "π", "3π/2", "2π"])
    axes.set_xlabel(with_unit(COVARIATE_NAMES.get(covariate, covariate), scale.unit))
    axes.set_ylabel(with_unit("missing force", evidence.result.units.force))
    _title_share(axes, evidence, covariate)


def _draw_band(axes: Axes, evidence: Evidence, what: tuple[Version, str], at: Array) -> None:
    version, covariate = what
    mean, low, high = (get_curve(evidence, f"{version.key}_{kind}", covariate) for kind in ("mean", "low", "high"))
    if low.size and high.size:
        axes.fill_between(at, low, high, color=version.colour, alpha=0.18, linewidth=0)
    if mean.size:
        axes.plot(at, mean, color=version.colour, label=version.make_label("missing force"), marker="o", markersize=2.6)


def _title_share(axes: Axes, evidence: Evidence, covariate: str) -> None:
    where = evidence.result.where
    share = where.explained_by.get(covariate, np.nan)
    if not np.isfinite(share):
        return
    name = COVARIATE_NAMES.get(covariate, covariate)
    explained = f"{percent(share)} explained by {name}"
    if covariate in where.significant:
        visible = share >= VISIBLE
        shown = explained if visible else f"{name}: significant by likelihood"
        axes.set_title(f"{shown} *", color="black", fontweight="bold")
    else:
        axes.set_title(f"{explained}: not significant", color="#8c8c8c")


def _get_unit(evidence: Evidence, covariate: str) -> str:
    covariates = evidence.labels.get("covariate", ())
    units = evidence.labels.get("covariate_unit", ())
    return units[covariates.index(covariate)] if len(units) == len(covariates) else ""
