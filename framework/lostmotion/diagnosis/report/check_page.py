"""What a recording can tell: sentences, tables and bars, for a page of its own and for the page of a diagnosis."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from lostmotion.codec import to_plain
from lostmotion.defaults import USUAL
from lostmotion.diagnosis.report.absent_table import (
    OTHER,
    draw_shares,
    format_amplitude,
    group_unlimited,
    label_absent,
    list_size_cells,
)
from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style
from lostmotion.report.pages import Grid, PageSection, draw_sections, load_template, write_page
from lostmotion.report.words import (
    DASH,
    angles_in,
    figures,
    format_quantity,
    format_size,
    interval,
    percent,
    to_words,
    typeset,
)
from lostmotion.results import Interval
from lostmotion.results.expectation import CaseCheck, Detection, Expectation, Improvement
from lostmotion.storage import load_result

RERUN_HINT = "run `lostmotion check` again"
MOST, SHOWN = 5, 12
"""The number of terms in a sentence, and in the figure of a diagnosis."""


def write_check(folder: Path) -> Path:
    """Return the path of `check.html`, written from `check.json` in the folder."""
    result = load_result(CaseCheck, folder / "check.json", RERUN_HINT)
    return write_page(folder / "check.html", lambda: render_check(result), RERUN_HINT)


def render_check(result: CaseCheck) -> str:
    """Return the page as one self-contained HTML text."""
    with style.use_style(result.angle):
        sections = list(draw_sections(SECTIONS, result))
    return load_template("check.html.j2", __package__).render(
        title=result.title or "Check",
        model=result.model,
        answer=[typeset(one) for one in result.says],
        sections=[one._replace(caption=typeset(one.caption), words=typeset(one.words)) for one in sections],
        notes=result.notes,
        provenance=json.dumps(to_plain(result.provenance), indent=2, ensure_ascii=False),
    )


def summarise_check(expected: Expectation, improvements: Sequence[Improvement], angle: str = "rad") -> tuple[str, ...]:
    """Return the result of a check in sentences, with angles in the unit `angle`."""
    with angles_in(angle):
        says = [*_list_interval_sentences(expected), *list_effect_sentences(expected)]
    for one in improvements:
        change = one.change[:1].lower() + one.change[1:]
        widths, sizes = _compare(one.intervals, "narrower", "wider"), _compare(one.effects, "smaller", "larger")
        says.append(f"It would help to {change}: intervals {widths}, smallest sizes {sizes}.")
    return tuple(says)


def _list_interval_sentences(expected: Expectation) -> Iterator[str]:
    """Yield the sentences on the parameters."""
    rows = [f"{name} {format_quantity(one.median, one.unit)} ± {_compare_width(one)}" for name, one in
            expected.parameters.items()]  # fmt: skip
    if rows:
        yield f"Expected 95 % intervals: {', '.join(rows)}."
    yield from list_pair_sentences(expected)


def list_pair_sentences(expected: Expectation) -> Iterator[str]:
    """Yield a sentence on the pairs of parameters that are hardly told apart, those with the largest correlation."""
    told = [f"{pair.one} from {pair.other} (correlation {figures(pair.correlation, 3)})" for pair in expected.pairs]
    if told:
        yield f"This recording hardly tells {shorten_pairs(told)}."


def shorten_pairs(told: Sequence[str]) -> str:
    """Return the first `MOST` entries of a list of pairs, and the number of the others, in words."""
    more = len(told) - MOST
    rest = [f"and {more} further {'pair' if more == 1 else 'pairs'}"] if more > 0 else []
    return "; ".join([*told[:MOST], *rest])


def _compare_width(one: Interval) -> str:
    """Return the half width of an interval, as a share of the value where there is one."""
    half = 0.5 * (one.high - one.low)
    return percent(half / abs(one.median)) if one.median else format_size(half, one.unit)


def list_effect_sentences(expected: Expectation) -> Iterator[str]:
    """Yield the sentences on the most usual terms, on those that cannot be told apart, and on those not seen."""
    usual = select_usual(expected.effects, MOST)
    if usual:
        yield f"Named with a probability of 90 %: {'; '.join(one.says for one in usual)}."
    pairs = {frozenset((one.mechanism, other)) for one in expected.effects for other in one.confused_with}
    if pairs:
        ranked = sorted(pairs, key=lambda pair: (-len(pair & set(USUAL)), sorted(pair)))
        words = [" from ".join(map(to_words, sorted(pair))) for pair in ranked]
        yield f"This recording does not tell {shorten_pairs(words)}."
    for one in expected.unseen:
        if one.mechanism in USUAL:
            yield one.says


def select_usual(effects: Sequence[Detection], most: int) -> list[Detection]:
    """Return the entries of the most usual terms, at the place where each shows most, the most usual first."""
    first = {one.mechanism: one for name in USUAL for one in reversed(effects) if one.mechanism == name}
    return list(first.values())[:most]


def draw_effects(expected: Expectation, yardstick: str, *, most: int = 0) -> Figure | None:
    """Return one bar for each term, up to the share of the drive from which it is named; of `most` usual ones, or all.

    None without any.
    """
    rows = [one for one in expected.effects if one.share_of_drive]
    if most:
        rows = sorted(select_usual(rows, most), key=lambda one: one.share_of_drive or 0.0)
    if not rows:
        return None
    told = [(label_absent(one, rows), one.share_of_drive or 0.0, format_amplitude(one, one.smallest)) for one in rows]
    return draw_shares(told, f"largest force at the smallest size that is named, in % of {yardstick}", style.AFTER)


def draw_expected(evidence: Evidence) -> Figure | None:
    """Return the bars of the most usual terms, for the page of a diagnosis."""
    result = evidence.result
    return draw_effects(result.expected, result.drive.of, most=SHOWN) if result.expected else None


def caption_expected(evidence: Evidence) -> str:
    """Return the caption of the bars."""
    count = len(evidence.result.expected.effects) if evidence.result.expected else 0
    return f"{EFFECT_CAPTION} The most usual of {count} terms; `lostmotion check` shows all of them."


def make_expected_table(evidence: Evidence) -> Grid | None:
    """Return the expected interval of each parameter."""
    return make_parameter_table(evidence.result.expected) if evidence.result.expected else None


def write_expected(evidence: Evidence) -> str:
    """Return the sentences on terms and on pairs of parameters."""
    expected = evidence.result.expected
    return " ".join([*list_pair_sentences(expected), *list_effect_sentences(expected)]) if expected else ""


def make_parameter_table(expected: Expectation) -> Grid:
    """Return the expected interval of each parameter."""
    rows = [[name, interval(one), f"± {_compare_width(one)}"] for name, one in expected.parameters.items()]
    return Grid(["Parameter", "Expected [95 %]", "Half width"], rows)


def _make_effect_table(result: CaseCheck) -> Grid:
    """Return the smallest size of each term, its share of the drive, and what it cannot be told from."""
    rows = result.expected.effects
    table = [
        [*list_size_cells(one, rows, one.smallest), ", ".join(map(to_words, one.confused_with)) or DASH] for one in rows
    ]
    return Grid(["Term", "Named from", f"Share of {result.yardstick}", OTHER, "Not told from"], table)


def _make_improvement_table(result: CaseCheck) -> Grid:
    """Return the changes that would help."""
    rows = [
        [one.change, _compare(one.intervals, "narrower", "wider"), _compare(one.effects, "smaller", "larger")]
        for one in result.improvements
    ]
    return Grid(["Change", "Expected intervals", "Smallest sizes"], rows)


def _compare(factor: float, less: str, more: str) -> str:
    """Return a factor in words: "3.1 times narrower"; "unchanged" where it rounds to one."""
    times, word = (figures(1.0 / factor, 2), less) if factor < 1.0 else (figures(factor, 2), more)
    return "unchanged" if times == "1" else f"{times} times {word}"


def _make_pair_table(result: CaseCheck) -> Grid:
    """Return the pairs of parameters that are hardly told apart."""
    rows = [[pair.one, pair.other, figures(pair.correlation, 3)] for pair in result.expected.pairs]
    return Grid(["Parameter", "Hardly told from", "Correlation"], rows)


EFFECT_CAPTION = (
    "Each bar ends at the size from which the term would be named with a probability of 90 %, if it alone is missing;"
    " the number beside it is that size. It is computed before any term is fitted, from the information of the nominal"
    " model along this recording and the noise in it."
)

SECTIONS: tuple[PageSection[CaseCheck], ...] = (
    PageSection("parameters", "Expected intervals", table=lambda one: make_parameter_table(one.expected)),
    PageSection(
        "effects",
        "What would be named",
        lambda one: draw_effects(one.expected, one.yardstick),
        lambda _: EFFECT_CAPTION,
        _make_effect_table,
        lambda one: " ".join(group_unlimited(one.expected.unseen, "size")),
    ),
    PageSection("pairs", "Parameters that are hardly told apart", table=_make_pair_table),
    PageSection("improvements", "What would help", table=_make_improvement_table),
)
