"""Figure of the candidates, ranked by their gain in log evidence."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style
from lostmotion.report.words import figures, probability, sentence, to_words
from lostmotion.results.diagnosis import Candidate, Mechanism

CANDIDATES_SHOWN = 16
LARGEST_LOSS = 20.0
LIKELY = 0.5
"""A candidate above this probability is among the best sets of terms."""
STRONG = 5.0
"""The gain in log evidence that the caption calls strong."""


def draw(evidence: Evidence) -> Figure | None:
    """Return the bars of the ranking, or None without a ranking."""
    rows = rank_candidates(evidence)
    if not rows:
        return None
    figure = style.make_figure(0.75 + 0.27 * len(rows))
    axes = figure.subplots()
    draw_bars(axes, evidence, rows)
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    rows = rank_candidates(evidence)
    hidden = len(evidence.result.ranking) - len(rows)
    check = evidence.result.evidence.says
    rest = f" The {hidden} lowest-ranked candidates are not drawn." if hidden > 0 else ""
    rest += f" {check}" if check else ""
    gains = [_get_gain(one, 0.0) for one in rows]
    cut = " ◂ marks a truncated bar." if gains and min(gains) < _find_reach(gains)[1] else ""
    return (
        "Each candidate was fitted with all parameters of the model free. The bar is the gain in log evidence over the "
        f"nominal model; a gain of {STRONG:.0f} is strong, and a gain near zero or below means that the term alone does"
        " not help. The column on the right is the posterior probability among all candidates: that of the best sets of"
        f" terms, each with a small smooth force in addition{_describe_price(evidence)}."
        f"{_explain_order(evidence, rows)}{cut}{rest}"
    )


def _explain_order(evidence: Evidence, rows: list[Candidate]) -> str:
    """Return why a long bar may come with a small probability, or a short one with a large, where the figure has it."""
    found = {_make_key(one) for one in evidence.result.found}
    likely = [one for one in rows if one.probability > LIKELY]
    best = max((_get_gain(one, -math.inf) for one in likely), default=math.inf)
    clauses = []
    if any(_get_gain(one, -math.inf) > best and one.probability <= LIKELY for one in rows):
        clauses.append("one that gains more alone may belong to none of the best sets")
    if len(found) > 1 and any(_make_key(one) in found and _get_gain(one, math.inf) < STRONG for one in likely):
        clauses.append("one that gains little alone may be needed beside another one")
    opening = " A bar is the gain of a candidate alone: where several act together, "
    return f"{opening}{', and '.join(clauses)}." if clauses else ""


def _describe_price(evidence: Evidence) -> str:
    """Return the prior penalty of a term as the end of a sentence."""
    prices = [one.price for one in rank_candidates(evidence) if one.price is not None]
    if not prices:
        return ""
    span = f"{min(prices):.1f}" if max(prices) - min(prices) < 0.05 else f"{min(prices):.1f} to {max(prices):.1f}"
    return (
        f", and with a penalty for each term of {span} in log evidence, for the number of candidates and of parameters"
    )


def rank_candidates(evidence: Evidence, most: int = CANDIDATES_SHOWN) -> list[Candidate]:
    """Return the entries of the ranking, largest gain first; candidates without a gain come last.

    The mechanisms that were found are always among them, whatever each gains alone.
    """
    found = {_make_key(one) for one in evidence.result.found}
    rows = sorted(evidence.result.ranking, key=lambda one: -_get_gain(one, -math.inf))
    late = [one for one in rows[most:] if _make_key(one) in found]
    return rows[: most - len(late)] + late


def draw_bars(axes: Axes, evidence: Evidence, rows: list[Candidate]) -> None:
    """Draw one bar for each candidate, with its gain and its probability beside it."""
    found = {_make_key(one) for one in evidence.result.found}
    gains = [_get_gain(one, 0.0) for one in rows]
    top, left = _find_reach(gains)
    colours = [style.AFTER if _make_key(one) in found else style.QUIET for one in rows]
    axes.barh(range(len(rows)), [max(gain, left) for gain in gains], color=colours, height=0.66)
    axes.axvline(0, color=style.RECORDED, linewidth=0.8)
    for row, one in enumerate(rows):
        _write_beside(axes, row, one, (left, 0.012 * (top - left)))
    axes.set_yticks(range(len(rows)), _make_labels(evidence, rows))
    axes.invert_yaxis()
    axes.set_xlim(min(1.05 * left, 0), top + 0.2 * (top - left))
    axes.set_xlabel("log evidence gain over the nominal model")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    axes.text(1.02, 1.01, "probability", color="#444444", fontsize=8.5, va="bottom", transform=axes.transAxes)


def _make_key(one: Candidate | Mechanism) -> tuple[str, str]:
    """Return mechanism and place: the same term may act at two places."""
    return one.mechanism, one.at or "ground"


def _make_labels(evidence: Evidence, rows: list[Candidate]) -> list[str]:
    """Return the names of the candidates, with their places where there is more than one."""
    several = len({one.at for one in evidence.result.ranking if one.at}) > 1
    named = [(sentence(to_words(one.mechanism)), one.at) for one in rows]
    return [f"{name} ({at})" if several and at else name for name, at in named]


def _find_reach(gains: list[float]) -> tuple[float, float]:
    """Return the ends of the bars; very negative bars are truncated, so that the other bars stay visible."""
    top = max(*gains, 1.0)
    return top, min(0.0, max(min(gains), -max(0.25 * top, LARGEST_LOSS)))


def _write_beside(axes: Axes, row: int, one: Candidate, frame: tuple[float, float]) -> None:
    left, gap = frame
    gain = _get_gain(one, math.nan)
    words = "not fitted" if math.isnan(gain) else figures(gain, 4 if abs(gain) >= 1000 else 3)
    words = f"◂ {words}" if gain < left else words
    at = max(gain, 0.0) + gap if math.isfinite(gain) else gap
    axes.text(at, row, words, va="center", fontsize=8.5)
    beside = axes.text(1.02, row, probability(one.probability), va="center", fontsize=8.5)
    beside.set_transform(axes.get_yaxis_transform())


def _get_gain(one: Candidate, absent: float) -> float:
    return one.log_evidence_gain if math.isfinite(one.log_evidence_gain) else absent
