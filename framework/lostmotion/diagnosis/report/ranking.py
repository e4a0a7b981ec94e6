"""Figure: the candidates, ranked by how much better they explain the recording."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.words import figures, probability, sentence, spoken
from lostmotion.results.diagnosis import Candidate, Mechanism

MOST = 16
MOST_BELOW = 20.0
LIKELY = 0.5


def draw(evidence: Evidence) -> Figure | None:
    """Return the bars of the ranking, or None without a ranking."""
    rows = ranked(evidence)
    if not rows:
        return None
    figure = style.blank(0.75 + 0.27 * len(rows))
    axes = figure.subplots()
    draw_bars(axes, evidence, rows)
    return figure


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure."""
    rows = ranked(evidence)
    hidden = len(evidence.result.ranking) - len(rows)
    check = evidence.result.evidence.says
    rest = f" The {hidden} candidates that rank lowest are not drawn." if hidden > 0 else ""
    rest += f" {check}" if check else ""
    gains = [_gain(one, 0.0) for one in rows]
    cut = " ◂ marks a bar that was cut short." if gains and min(gains) < _reach(gains)[1] else ""
    return (
        "Each candidate was fitted with all parameters of the model set free again. The bar is what the log evidence "
        "gains over the model as it stands; a gain of 5 is strong, and one near zero or below says that the term is "
        "not needed. The column on the right is the posterior probability among all candidates, that is of the best"
        f" sets of terms, each beside a small smooth force that nobody has named{_priced(evidence)}."
        + _beaten(rows)
        + cut
        + rest
    )


def _beaten(rows: list[Candidate]) -> str:
    """Return why a long bar may come with a small probability, where that is seen in the figure."""
    best = max((_gain(one, -math.inf) for one in rows if one.probability > LIKELY), default=math.inf)
    if not any(_gain(one, -math.inf) > best and one.probability <= LIKELY for one in rows):
        return ""
    return (
        " A bar is the gain of a candidate alone: where several act together, one that gains more alone may be in none"
        " of the best sets."
    )


def _priced(evidence: Evidence) -> str:
    """Return what a term costs before the recording is seen, as the end of a sentence."""
    prices = [one.price for one in ranked(evidence) if one.price is not None]
    if not prices:
        return ""
    span = f"{min(prices):.1f}" if max(prices) - min(prices) < 0.05 else f"{min(prices):.1f} to {max(prices):.1f}"
    return (
        f", and less the price of a term, which is {span} of log evidence: one of many, and more with more parameters"
    )


def ranked(evidence: Evidence, most: int = MOST) -> list[Candidate]:
    """Return the entries of the ranking, largest gain first; what was found is among them whatever it gains alone.

    Candidates without a number stand last.
    """
    found = {_key(one) for one in evidence.result.found}
    rows = sorted(evidence.result.ranking, key=lambda one: -_gain(one, -math.inf))
    late = [one for one in rows[most:] if _key(one) in found]
    return rows[: most - len(late)] + late


def draw_bars(axes: Axes, evidence: Evidence, rows: list[Candidate]) -> None:
    """Draw one bar for each candidate, with its gain and its probability written beside it."""
    found = {_key(one) for one in evidence.result.found}
    gains = [_gain(one, 0.0) for one in rows]
    top, left = _reach(gains)
    colours = [style.AFTER if _key(one) in found else style.QUIET for one in rows]
    axes.barh(range(len(rows)), [max(gain, left) for gain in gains], color=colours, height=0.66)
    axes.axvline(0, color=style.RECORDED, linewidth=0.8)
    for row, one in enumerate(rows):
        _write_beside(axes, row, one, (left, 0.012 * (top - left)))
    axes.set_yticks(range(len(rows)), _labels(evidence, rows))
    axes.invert_yaxis()
    axes.set_xlim(min(1.05 * left, 0), top + 0.2 * (top - left))
    axes.set_xlabel("log evidence gain over the model as it stands")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    axes.text(1.02, 1.01, "probability", color="#444444", fontsize=8.5, va="bottom", transform=axes.transAxes)


def _key(one: Candidate | Mechanism) -> tuple[str, str]:
    """Return mechanism and place: the same law may act in two places."""
    return one.mechanism, one.at or "ground"


def _labels(evidence: Evidence, rows: list[Candidate]) -> list[str]:
    """Return the names of the candidates, with their places where there is more than one."""
    several = len({one.at for one in evidence.result.ranking if one.at}) > 1
    named = [(sentence(spoken(one.mechanism)), one.at) for one in rows]
    return [f"{name} ({at})" if several and at else name for name, at in named]


def _reach(gains: list[float]) -> tuple[float, float]:
    """Return the ends of the bars; a hopeless candidate is cut short, lest it dwarf those that matter."""
    top = max(*gains, 1.0)
    return top, min(0.0, max(min(gains), -max(0.25 * top, MOST_BELOW)))


def _write_beside(axes: Axes, row: int, one: Candidate, frame: tuple[float, float]) -> None:
    left, gap = frame
    gain = _gain(one, math.nan)
    words = "not fitted" if math.isnan(gain) else figures(gain, 4 if abs(gain) >= 1000 else 3)
    words = f"◂ {words}" if gain < left else words
    at = max(gain, 0.0) + gap if math.isfinite(gain) else gap
    axes.text(at, row, words, va="center", fontsize=8.5)
    beside = axes.text(1.02, row, probability(one.probability), va="center", fontsize=8.5)
    beside.set_transform(axes.get_yaxis_transform())


def _gain(one: Candidate, absent: float) -> float:
    return one.log_evidence_gain if math.isfinite(one.log_evidence_gain) else absent
