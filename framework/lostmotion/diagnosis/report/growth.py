"""Figures: how the error of a prediction grows with its lead, and whether the innovations are white."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from lostmotion.diagnosis.report.cast import versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.words import chance, figures, percent, sentence

FEW_DECADES = 300.0
LOWEST = 1e-5


class LeadAxis(NamedTuple):
    """What one second of lead is in the unit of the axis, and the name of that unit."""

    rate: float
    name: str


def draw(evidence: Evidence) -> Figure | None:
    """Return the growth of the prediction error, or None without its curves."""
    if not evidence.has("lead") or not _curves(evidence):
        return None
    figure = style.blank(3.4)
    axes = figure.subplots()
    draw_growth(axes, evidence, clock_of(evidence))
    style.legend_above(figure, axes)
    return figure


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure."""
    floor = (
        " The noise floor is what the right model would reach from states known no better than these: a curve that "
        "keeps to it has nothing left to gain."
    )
    return (
        "Error of free-running predictions of held-out data over the standard deviation of the response, against the "
        "time since the last filtered state; the dotted lines mark how long each prediction is valid."
    ) + (floor if evidence.has("growth_floor") else "")


def clock_of(evidence: Evidence) -> LeadAxis:
    """Return the unit of the horizon."""
    fit = evidence.result.fit
    return LeadAxis(1.0 / fit.horizon_unit_time, fit.horizon_unit)


def draw_growth(axes: Axes, evidence: Evidence, clock: LeadAxis) -> None:
    """Draw the error over the lead before, after and at the noise floor, on a logarithmic scale."""
    lead = clock.rate * evidence.arrays["lead"]
    for name, colour, words in _curves(evidence):
        curve = evidence.arrays[f"growth_{name}"]
        axes.plot(lead, np.where(curve > 0, curve, np.nan), color=colour, label=words, linewidth=1.8)
    axes.set_yscale("log")
    axes.set_xlim(float(lead.min()), float(lead.max()))
    axes.set_xlabel(f"lead ({clock.name})")
    axes.set_ylabel("error / response s.d.")
    axes.yaxis.set_major_formatter(lambda value, _: percent(value))
    axes.yaxis.set_minor_formatter(NullFormatter())
    low, high = axes.get_ylim()
    low = max(low, LOWEST * high)
    axes.set_ylim(low, high)
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < FEW_DECADES * low else (1.0,)))
    _mark_validity(axes, evidence, clock)
    turns = (lambda lead: np.asarray(lead, float) / clock.rate, lambda at: np.asarray(at, float) * clock.rate)
    above = axes.secondary_xaxis("top", functions=turns)
    above.set_xlabel("lead (s)")


def _curves(evidence: Evidence) -> list[tuple[str, str, str]]:
    models = [(who.key, who.colour, who.named("error")) for who in versions(evidence)]
    return [entry for entry in [("floor", style.QUIET, "noise floor"), *models] if evidence.has(f"growth_{entry[0]}")]


def _mark_validity(axes: Axes, evidence: Evidence, clock: LeadAxis) -> None:
    valid = evidence.result.valid_prediction_time
    times, longer = ({"before": told.before, "after": told.after} for told in (valid, valid.or_longer))
    for row, (name, colour, _) in enumerate(_curves(evidence)):
        at = clock.rate * times.get(name, np.nan)
        if not at <= axes.get_xlim()[1] or longer[name]:
            continue
        axes.axvline(at, color=colour, linestyle=":", linewidth=1.5)
        text = axes.text(at, 0.05 + 0.09 * row, f" {figures(at, 2)}", color=colour, fontsize=8.5)
        text.set_transform(axes.get_xaxis_transform())
        text.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.6})


def draw_whiteness(evidence: Evidence) -> Figure | None:
    """Return the autocorrelation of the innovations before and after, or None without it."""
    shown = [who for who in versions(evidence) if evidence.has(f"acf_{who.key}")]
    if not shown:
        return None
    figure = style.blank(2.2)
    panels = figure.subplots(1, len(shown), squeeze=False, sharey=True)[0]
    for axes, who in zip(panels, shown, strict=True):
        _draw_lags(axes, evidence, who.key, who.colour)
        axes.set_title(who.named("model"), color=who.colour)
    panels[0].set_ylabel("autocorrelation")
    return figure


def whiteness_caption(evidence: Evidence) -> str:
    """Return what to see in the autocorrelations."""
    said = []
    for who in versions(evidence):
        told = who.of(evidence.result.whiteness.before, evidence.result.whiteness.after)
        said.append(f"{who.named('model')} ({chance(told.p)}): {told.says}")
    opening = "Autocorrelation of the innovations, the part of each sample that the model did not expect."
    return " ".join(
        [opening, "White ones stay within the grey band but for one lag in twenty.", *(sentence(part) for part in said)]
    )


def _draw_lags(axes: Axes, evidence: Evidence, name: str, colour: str) -> None:
    values = evidence.arrays[f"acf_{name}"]
    lags = evidence.arrays.get("lag", np.arange(float(values.size)))
    kept = lags > 0
    if evidence.has("acf_limit"):
        limit = float(evidence.arrays["acf_limit"])
        axes.axhspan(-limit, limit, color="#dddddd", zorder=0)
    axes.vlines(lags[kept], 0, values[kept], color=colour, linewidth=2)
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    style.few_ticks(axes, 8, 4)
    axes.set_xlabel("lag (samples)")
