"""The figures of `docs/validation.md`, from the results of the newest version; `docs/_pictures` shows them.

Each function prints the sentences that its caption ends with, so that these numbers are those of the results too.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from judge_rows import BINS, SURE
from lostmotion_trials.blind.score import GAIN_EDGES
from lostmotion_trials.rates import Rate, estimate_rate
from validation_results import (
    OUTSIDE,
    Result,
    choose_newest,
    count_rows,
    describe_outcome,
    find_family,
    find_oracle,
    list_false,
    names_truth,
    read_results,
    split_rows,
)
from validation_tables import HELD, SECONDS, make_drive_key

BLUE, RED, GREY, SHADE = "#0072b2", "#d55e00", "#555555", "#e8e8e8"
WIDTH = 7.2
SHARE = "hidden force (rms), share of the force of inertia (%)"
PANELS = {
    SHARE: (0.0, 3.0, 6.0, 12.0, 25.0, math.inf),
    "gain of the true law in log-likelihood": GAIN_EDGES,
}
"""Measures of the size of an effect, with the edges of their ranges."""
TICKS = (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000)


def draw_bands(axes: Axes, places: Sequence[float], rates: Sequence[Rate], *, across: bool = False) -> None:
    """Draw shares in per cent with their 95 % bands and counts, at places along x, or along y if `across`."""
    for place, rate in zip(places, rates, strict=True):
        ends = (100.0 * rate.low, 100.0 * rate.high)
        (axes.hlines if across else axes.vlines)(place, *ends, color=BLUE, linewidth=5, alpha=0.25)
        spot = (100.0 * rate.share, place) if across else (place, 100.0 * rate.share)
        axes.plot(*spot, "o", color=BLUE, markersize=4.5)
        text, offset = f"{rate.hits} of {rate.of}", (0, 5) if across else (6, -3)
        axes.annotate(text, spot, offset, textcoords="offset points", fontsize=7.5, ha="center" if across else "left")


def make_note(text: str) -> Figure:
    """Return a low figure with a sentence, where there is nothing to draw."""
    figure = plt.figure(figsize=(WIDTH, 0.8))
    figure.text(0.5, 0.5, text, ha="center", va="center")
    return figure


def draw_detection() -> Figure:
    """Return the share of hidden effects that are named above 0.95 over their size, with that of the oracle.

    There is a panel for the share of the force of inertia, and one for the gain in log-likelihood, if any is stored.
    """
    results = read_results()
    newest = choose_newest(results)
    panels = [(what, own) for what in PANELS if (own := list_sized(newest, what))]
    if not panels:
        return make_note("The newest version has no effects of known size.")
    figure, several = plt.subplots(len(panels), 1, figsize=(WIDTH, 3.0 * len(panels)), squeeze=False)
    for axes, place, (what, sized) in zip(several.flat, ("Above", "Below"), panels, strict=False):
        answers = [(size, find_oracle(results, r).get(row["key"])) for size, _, row, r in sized]
        oracle = [(size, names_truth(stated)) for size, stated in answers if stated is not None]
        draw_sizes(axes, [(size, hit) for size, hit, _, _ in sized], oracle, PANELS[what])
        axes.set(xlabel=what, ylabel="named above 0.95 (%)")
        named, known = sum(hit for _, hit, _, _ in sized), sum(hit for _, hit in oracle)
        beside = f", by the oracle {known} of {len(oracle)}" if oracle else ""
        where = f"{place}: " if len(panels) > 1 else ""
        print(f"{where}{named} of {len(sized)} effects are named{beside}.")
    several[0, 0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, frameon=False, fontsize=8)
    return figure


def list_sized(newest: Sequence[Result], what: str) -> list[tuple[float, bool, dict, Result]]:
    """Return size, whether it is named above 0.95, row and result of each effect with a name and such a size."""
    place, scale = (1, 100.0) if what == SHARE else (2, 1.0)
    every = [(e, row, r) for r in newest for row in r.rows for e in row["effects"] if e[place] and e[5]]
    return [(scale * e[place], e[3], row, r) for e, row, r in every]


def draw_sizes(axes: Axes, sized: Sequence, oracle: Sequence, edges: Sequence[float]) -> None:
    """Draw the share of effects (size, named) that are named in each range of size, and each single effect."""
    if oracle:
        places, rates = zip(*sort_into_bins(oracle, edges), strict=True)
        style = {"color": GREY, "linewidth": 1, "markersize": 4, "markerfacecolor": "none"}
        axes.plot(places, [100.0 * rate.share for rate in rates], "s--", label="oracle", **style)
    draw_bands(axes, *zip(*sort_into_bins(sized, edges), strict=True))
    axes.plot([], [], "o", color=BLUE, markersize=4.5, label="diagnosis, with 95 % band")
    for hit, at, colour in ((True, 108.0, BLUE), (False, -8.0, RED)):
        own = [size for size, one in sized if one is hit]
        axes.plot(own, np.full(len(own), at), "|", color=colour, markersize=7)
    axes.set(xscale="log", ylim=(-14, 114), yticks=(0, 25, 50, 75, 100))
    low, high = axes.get_xlim()
    axes.set_xlim(low, 1.25 * high)
    ticks = [tick for tick in TICKS if low <= tick <= 1.25 * high]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()


def sort_into_bins(sized: Sequence[tuple[float, bool]], edges: Sequence[float]) -> list[tuple[float, Rate]]:
    """Return for each range of size with effects their geometric mean, and the share that is named."""
    groups = [[one for one in sized if low <= one[0] < high] for low, high in pairwise(edges)]
    return [
        (math.exp(float(np.mean([math.log(size) for size, _ in own]))), estimate_rate(sum(h for _, h in own), len(own)))
        for own in groups
        if own
    ]


def draw_confusion() -> Figure:
    """Return a matrix: the group of each hidden effect against what was said of it."""
    rows = [row for r in choose_newest(read_results()) for row in r.rows if row["status"] == "ok"]
    none = ["", None, None, False, False, False]
    pairs = Counter(
        (find_family(e[0]) if e[0] else "nothing hidden", describe_outcome(row, e))
        for row in rows
        for e in row["effects"] or [none]
    )
    hidden = sorted({h for h, _ in pairs}, key=lambda h: (h in (OUTSIDE, "nothing hidden"), h))
    false = sorted({said for _, said in pairs if said.startswith("false")})
    said = ["right", "likely, right", *false, "likely, false", "unknown force", "nothing"]
    table = np.array([[pairs[h, s] for s in said] for h in hidden])
    shares = table / table.sum(axis=1, keepdims=True)
    figure, axes = plt.subplots(figsize=(WIDTH, 1.7 + 0.26 * len(hidden)))
    axes.imshow(np.where(table > 0, shares, np.nan), cmap="Blues", vmin=0.0, vmax=1.4, aspect="auto")
    for (i, j), count in np.ndenumerate(table):
        if count:
            wrong = said[j].startswith("false")
            axes.text(j, i, str(count), ha="center", va="center", fontsize=9, color=RED if wrong else "black",
                      fontweight="bold" if wrong else "normal")  # fmt: skip
    axes.set_xticks(range(len(said)), said, rotation=40, ha="left")
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(hidden)), hidden)
    axes.tick_params(length=0)
    axes.set_xticks(np.arange(len(said) + 1) - 0.5, minor=True)
    axes.set_yticks(np.arange(len(hidden) + 1) - 0.5, minor=True)
    axes.grid(which="minor", color="#dddddd", linewidth=0.6)
    axes.tick_params(which="minor", length=0)
    beside = sum(len(list_false(row)) for row in rows if any(e[3] for e in row["effects"]))
    print(f"{len(rows)} machines; false names above 0.95 beside a right one: {beside}.")
    return figure


def draw_reliability() -> Figure:
    """Return how often stated probabilities are right, with 95 % bands."""
    stated = [tuple(pair) for r in choose_newest(read_results()) for row in r.rows for pair in row["stated"]]
    figure, axes = plt.subplots(figsize=(WIDTH, 3.2))
    axes.plot([0, 1], [0, 100], color=GREY, linewidth=0.8, linestyle="--")
    groups = [[one for one in stated if low < one[0] <= high] for low, high in pairwise(BINS)]
    groups = [own for own in groups if own]
    places = [float(np.mean([p for p, _ in own])) for own in groups]
    draw_bands(axes, places, [estimate_rate(sum(ok for _, ok in own), len(own)) for own in groups])
    axes.set(xlim=(-0.03, 1.13), ylim=(-4, 104), xlabel="stated probability", ylabel="is in the machine (%)")
    above = [ok for p, ok in stated if p > SURE]
    print(f"Of {len(above)} probabilities above {SURE:g}, {sum(above)} are of what is in the machine.")
    return figure


def draw_coverage() -> Figure:
    """Return the share of 95 % intervals that hold the truth, of each stored set and version."""
    results = [r for r in read_results() if r.judged and count_rows(r.rows).held.of]
    newest = {r.name for r in choose_newest(results)}
    labels = [f"{r.code}: {r.machines}" for r in results]
    figure, axes = plt.subplots(figsize=(WIDTH, 0.9 + 0.3 * len(results)))
    axes.axvspan(*(100.0 * end for end in HELD), color=SHADE, zorder=0)
    draw_bands(axes, [-float(i) for i in range(len(results))], [count_rows(r.rows).held for r in results], across=True)
    axes.set_yticks([-float(i) for i in range(len(results))], labels)
    for label, result in zip(axes.get_yticklabels(), results, strict=True):
        label.set_fontweight("bold" if result.name in newest else "normal")
    axes.set(xlabel="95 % intervals that hold the truth (%)", xlim=(40, 101), ylim=(0.4 - len(results), 0.8))
    return figure


def draw_alarms() -> Figure:
    """Return the share of machines with a false name above 0.95, by drive and sensor."""
    rows = [row for r in choose_newest(read_results()) for row in r.rows if row["status"] == "ok"]
    groups = split_rows(rows, make_drive_key(rows))
    rates = [estimate_rate(sum(map(bool, map(list_false, own))), len(own)) for own in groups.values()]
    places = [-float(i) for i in range(len(groups))]
    figure, axes = plt.subplots(figsize=(WIDTH, 0.9 + 0.32 * len(groups)))
    draw_bands(axes, places, rates, across=True)
    axes.set_yticks(places, list(groups))
    axes.set(xlabel="machines with a false name above 0.95 (%)", xlim=(-4, 101), ylim=(0.4 - len(groups), 0.8))
    print(f"{sum(rate.hits for rate in rates)} of {len(rows)} machines have one.")
    return figure


def draw_times() -> Figure:
    """Return the share of machines that are diagnosed within a processor time."""
    newest: list[Result] = [r for r in choose_newest(read_results()) if count_rows(r.rows).seconds]
    if not newest:
        return make_note("The newest version has no processor times.")
    figure, axes = plt.subplots(figsize=(WIDTH, 2.8))
    for limit, word in zip(SECONDS, ("median", "largest"), strict=True):
        axes.axvline(limit, color=GREY, linewidth=0.8, linestyle="--")
        axes.text(limit, 105, f"target, {word}", fontsize=7.5, color=GREY, ha="center")
    for result, colour in zip(newest, plt.get_cmap("tab10")(np.arange(len(newest)) % 10), strict=True):
        times = count_rows(result.rows).seconds
        axes.step(times, 100.0 * np.arange(1, len(times) + 1) / len(times), where="post", color=colour,
                  label=result.machines)  # fmt: skip
    axes.set(xscale="log", ylim=(0, 104), xlabel="processor time of a diagnosis (s)", ylabel="machines (%)")
    axes.set_xticks([2, 5, 10, 20, 50, 100, 200, 500], ["2", "5", "10", "20", "50", "100", "200", "500"])
    axes.minorticks_off()
    axes.legend(loc="lower right", frameon=False, fontsize=8)
    every = sorted(t for r in newest for t in count_rows(r.rows).seconds)
    above = sum(t > SECONDS[1] for t in every)
    print(
        f"Median {np.median(every):.0f} s, largest {every[-1]:.0f} s; {above} of {len(every)} above {SECONDS[1]:g} s."
    )
    return figure


FIGURES = {
    "detection": draw_detection,
    "confusion": draw_confusion,
    "reliability": draw_reliability,
    "coverage": draw_coverage,
    "alarms": draw_alarms,
    "times": draw_times,
}
