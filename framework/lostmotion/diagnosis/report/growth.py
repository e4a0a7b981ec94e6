"""Figures of the growth of the prediction error with the lead time, and of the whiteness of the innovations."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import list_versions
from lostmotion.report import style
from lostmotion.report.words import chance, figures, percent, sentence

LABELLED_RANGE = 300.0
LOWEST_SHARE = 1e-5


class LeadAxis(NamedTuple):
    """One second of lead time in the unit of the axis, and the name of that unit."""

    rate: float
    name: str


def draw(evidence: Evidence) -> Figure | None:
    """Return the figure of the growth of the prediction error, or None without its curves."""
    if not evidence.has("lead") or not _list_curves(evidence):
        return None
    figure = style.make_figure(3.4)
    axes = figure.subplots()
    draw_growth(axes, evidence, make_lead_axis(evidence))
    style.legend_above(figure, axes)
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    floor = (
        " The noise floor is the error of the correct model from equally uncertain states: a curve on the noise floor "
        "cannot be improved."
    )
    return (
        "Error of free-running predictions of held-out data over the standard deviation of the response, against the "
        "time since the last filtered state; the dotted lines mark how long each prediction is valid."
    ) + (floor if evidence.has("growth_floor") else "")


def make_lead_axis(evidence: Evidence) -> LeadAxis:
    """Return the unit of the prediction horizon for the axis of lead times."""
    fit = evidence.result.fit
    return LeadAxis(1.0 / fit.horizon_unit_time, fit.horizon_unit)


def draw_growth(axes: Axes, evidence: Evidence, clock: LeadAxis) -> None:
    """Draw the error over the lead time before, after and at the noise floor, on a logarithmic scale."""
    lead = clock.rate * evidence.arrays["lead"]
    for name, colour, words in _list_curves(evidence):
        curve = evidence.arrays[f"growth_{name}"]
        axes.plot(lead, np.where(curve > 0, curve, np.nan), color=colour, label=words, linewidth=1.8)
    axes.set_yscale("log")
    axes.set_xlim(float(lead.min()), float(lead.max()))
    axes.set_xlabel(f"lead ({clock.name})")
    axes.set_ylabel("error / response s.d.")
    axes.yaxis.set_major_formatter(lambda value, _: percent(value))
    axes.yaxis.set_minor_formatter(NullFormatter())
    low, high = axes.get_ylim()
    low = max(low, LOWEST_SHARE * high)
    axes.set_ylim(low, high)
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < LABELLED_RANGE * low else (1.0,)))
    _mark_validity(axes, evidence, clock)
    turns = (lambda lead: np.asarray(lead, float) / clock.rate, lambda at: np.asarray(at, float) * clock.rate)
    above = axes.secondary_xaxis("top", functions=turns)
    above.set_xlabel("lead (s)")


def _list_curves(evidence: Evidence) -> list[tuple[str, str, str]]:
    models = [(version.key, version.colour, version.make_label("error")) for version in list_versions(evidence)]
    return [entry for entry in [("floor", style.QUIET, "noise floor"), *models] if evidence.has(f"growth_{entry[0]}")]


def _mark_validity(axes: Axes, evidence: Evidence, clock: LeadAxis) -> None:
    valid = evidence.result.valid_prediction_time
    times, longer = ({"before": one.before, "after": one.after} for one in (valid, valid.or_longer))
    for row, (name, colour, _) in enumerate(_list_curves(evidence)):
        at = clock.rate * times.get(name, np.nan)
        if not at <= axes.get_xlim()[1] or longer[name]:
            continue
        axes.axvline(at, color=colour, linestyle=":", linewidth=1.5)
        text = axes.text(at, 0.05 + 0.09 * row, f" {figures(at, 2)}", color=colour, fontsize=8.5)
        text.set_transform(axes.get_xaxis_transform())
        text.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.6})


def draw_whiteness(evidence: Evidence) -> Figure | None:
    """Return the autocorrelation of the innovations before and after, or None without it."""
    shown = [version for version in list_versions(evidence) if evidence.has(f"acf_{version.key}")]
    if not shown:
        return None
    figure = style.make_figure(2.2)
    panels = figure.subplots(1, len(shown), squeeze=False, sharey=True)[0]
    for axes, version in zip(panels, shown, strict=True):
        _draw_lags(axes, evidence, version.key, version.colour)
        axes.set_title(version.make_label("model"), color=version.colour)
    panels[0].set_ylabel("autocorrelation")
    return figure


def caption_whiteness(evidence: Evidence) -> str:
    """Return the caption of the figure of the autocorrelations."""
    sentences: list[str] = []
    for version in list_versions(evidence):
        found = version.select(evidence.result.whiteness.before, evidence.result.whiteness.after)
        sentences.append(f"{version.make_label('model')} ({chance(found.p)}): {found.says}")
    opening = "Autocorrelation of the innovations, the part of each sample that the model does not predict."
    band = "White innovations are within the grey band except for one lag in twenty."
    return " ".join([opening, band, *(sentence(part) for part in sentences)])


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
