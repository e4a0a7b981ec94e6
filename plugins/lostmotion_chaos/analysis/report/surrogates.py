"""Figure of the surrogate tests: the statistic of the recording among those of its surrogates."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.report import style
from lostmotion.report.words import probability, shorten, to_words
from lostmotion.results import Array
from lostmotion_chaos.analysis.report.view import AnalysisView

PANELS_PER_ROW = 3
MAX_HISTOGRAM_BINS = 24


def draw_tests(view: AnalysisView) -> Figure | None:
    """Return one panel for each test: the statistic of the surrogates, and that of the recording."""
    values = _get_values(view)
    if values is None:
        return None
    columns = min(PANELS_PER_ROW, len(values))
    rows = math.ceil(len(values) / columns)
    figure = style.make_figure(2.4 * rows + 0.5)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for k, axes in enumerate(panels):
        if k < len(values):
            _draw_test(axes, view, k, values[k])
        else:
            axes.remove()
    style.legend_above(figure, panels[0])
    return figure


def caption_tests(view: AnalysisView) -> str:
    """Return what the figure of the tests shows."""
    refused = int(np.sum(~np.isfinite(view.arrays["surrogate_values"])))
    lost = f" {refused} values could not be computed and are not drawn." if refused else ""
    return (
        "The statistic of each surrogate (bars) and of the recording (line). If the recording lies among the"
        f" surrogates, it agrees with the null hypothesis; the p-value is its rank, and cannot be 0.{lost}"
    )


def _get_values(view: AnalysisView) -> Array | None:
    values = view.arrays.get("surrogate_values")
    if values is None or not values.size or not np.isfinite(values).any():
        return None
    return np.atleast_2d(values)


def _draw_test(axes: Axes, view: AnalysisView, place: int, values: Array) -> None:
    tests = view.result.surrogates
    test = tests[place] if place < len(tests) else None
    original, finite = _get_original(view, place), values[np.isfinite(values)]
    if finite.size:
        cells = min(MAX_HISTOGRAM_BINS, max(6, round(1.6 * math.sqrt(finite.size))))
        counts, edges = np.histogram(finite, bins=cells)
        axes.stairs(counts, edges, fill=True, color="#b8b8b8", label="surrogates")
        axes.set_ylim(0.0, 1.15 * float(counts.max()))
    if math.isfinite(original):
        axes.axvline(original, color=style.BEFORE, linewidth=2.0, label="recording")
    axes.set_xlim(*style.span_of(np.append(finite, original), 0.1))
    style.few_ticks(axes, 4, 4)
    axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
    axes.set_xlabel(shorten(to_words(test.statistic if test else "statistic"), 36))
    axes.set_ylabel("surrogates" if place % PANELS_PER_ROW == 0 else "")
    name = shorten(to_words(test.method if test else f"test {place + 1}"), 26)
    axes.set_title(f"{name}: p = {probability(test.p if test else None)}".replace("= <", "<").replace("= >", ">"))


def _get_original(view: AnalysisView, place: int) -> float:
    found = np.atleast_1d(view.arrays.get("surrogate_original", np.array([])))
    return float(found[place]) if place < found.size else math.nan
