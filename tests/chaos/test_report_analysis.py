"""The page of an analysis: it opens with the verdict, says what was refused, and bears what is absent or hostile."""

from __future__ import annotations

import html
import importlib.util
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.codec import to_plain
from lostmotion.errors import DataError
from lostmotion.report.words import power_of_ten, shorten
from lostmotion_chaos.analysis.report.measures import convert_to_natural
from lostmotion_chaos.analysis.report.page import SECTIONS, render, write_analysis
from lostmotion_chaos.analysis.report.tables import make_estimate_row, name_verdict, split_opening
from lostmotion_chaos.analysis.report.view import read_analysis
from lostmotion_chaos.results import DrivePeriod, Measure, Sign

ALL = [section.name for section in SECTIONS]
NEEDS = {
    "x": ("course", "denoised"),
    "density": ("spectrum",),
    "section": ("section",),
    "embedding_": ("delay", "dimension"),
    "lyapunov_": ("divergence",),
    "d2_": ("correlation",),
    "surrogate_values": ("surrogates",),
}


def _load():
    place = Path(__file__).with_name("analysis_fixture.py")
    spec = importlib.util.spec_from_file_location("analysis_fixture", place)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


made = _load()


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    root = tmp_path_factory.mktemp("analyses")
    return {kind: made.write(root / kind, *make()) for kind, make in made.KINDS.items()}


@pytest.fixture(scope="module")
def pages(folders):
    return {kind: write_analysis(folder).read_text(encoding="utf-8") for kind, folder in folders.items()}


@pytest.fixture(scope="module")
def whole(folders):
    return read_analysis(folders["chaotic"])


def _sections(page):
    return re.findall(r'<section id="section-(\w+)">', page)


def _words(page):
    """Return the text of a page without its figures."""
    return html.unescape(re.sub(r"<[^>]+>", " ", re.sub(r"<(svg|style).*?</\1>", "", page, flags=re.DOTALL)))


def _said(view, **facts):
    return replace(view, result=replace(view.result, **facts), arrays={})


def measure(value, low=np.nan, high=np.nan, **told):
    """Return the facts on a number, without a word where none is given."""
    return Measure(**{"value": value, "low": low, "high": high, "unit": "1", "method": "", "status": "ok", "says": "",
                      "details": {}, **told})  # fmt: skip


def test_page_is_written_into_the_folder(folders):
    assert write_analysis(folders["periodic"]) == folders["periodic"] / "report.html"


def test_it_opens_with_the_verdict_and_its_first_sentence(pages):
    page = pages["chaotic"]
    assert '<p class="badge chaotic">Chaotic</p>' in page
    assert re.search(r"<h1>(.*?)</h1>", page)[1].startswith("Neighbouring states part at 7.3 1/s [6.6, 8.1]")
    assert page.index("<h1>") < page.index("Largest Lyapunov exponent") < page.index("Limitations")
    assert page.index("Limitations") < page.index("<figure>")


@pytest.mark.parametrize(
    ("says", "parts"),
    [
        ("It is 0.5 s. No more is known.", ["It is 0.5 s.", "No more is known."]),
        ("p = 0.02 vs. noise", ["P = 0.02 vs. noise."]),
        ("", ["The analysis has no sentence about this recording."]),
        (" ", ["The analysis has no sentence about this recording."]),
    ],
)
def test_sentences_are_told_apart(whole, says, parts):
    assert split_opening(replace(whole.result, says=says)) == parts


def test_all_figures_stand_in_their_order(pages):
    assert _sections(pages["chaotic"]) == ALL
    assert pages["chaotic"].count("<figcaption>") == len(ALL)


@pytest.mark.parametrize(
    ("kind", "absent"),
    [
        ("undriven", {"section", "denoised"}),
        ("periodic", {"denoised", "divergence", "correlation", "surrogates"}),
        ("refused", {"section", "denoised", "surrogates"}),
    ],
)
def test_figures_without_arrays_are_left_out(pages, kind, absent):
    assert _sections(pages[kind]) == [name for name in ALL if name not in absent]


@pytest.mark.parametrize("start", NEEDS)
def test_any_group_of_arrays_may_be_absent(whole, start):
    exact = start in ("x", "section")
    gone = [name for name in whole.arrays if name == start or (not exact and name.startswith(start))]
    less = replace(whole, arrays={name: v for name, v in whole.arrays.items() if name not in gone})
    drawn = [section.name for section in SECTIONS if section.draw(less) is not None]
    assert gone
    assert [name for name in ALL if name not in drawn] == [n for n in ALL if n in NEEDS[start] and n != "section"]


def test_facts_alone_make_a_page(whole):
    assert _sections(render(replace(whole, arrays={}))) == []
    assert "Undecided" in render(_said(whole, verdict="undecided"))


def test_numbers_stand_with_their_interval_and_unit(pages):
    words = _words(pages["chaotic"])
    for text in (
        "7.3 [6.6, 8.1] 1/s",
        "6.9 [5.2, 9.0] 1/s",
        "2.41 [2.20, 2.60]",
        "0.0393 s (12 samples)",
        "3.1 %",
        "0.5 %",
        "< 0.001",
        "99 IAAFT",
        "two-sided",
    ):
        assert text in words
    assert "1.30 [1.10, 1.45] bit/s" in _words(pages["undriven"])
    assert "Period of the drive" in words
    assert "Period of the strongest line" in _words(pages["periodic"])


def test_refusals_are_said_in_place_of_a_number(pages):
    words = _words(pages["refused"])
    assert words.count("no number") == 5, "exponent, dimension, entropy, and noise before and after"
    assert "keeps rising with the embedding dimension" in words
    assert "No p-value" in words
    assert "nan" not in words.lower()
    assert "None" not in words


@pytest.mark.parametrize(
    ("facts", "value", "kind"),
    [
        (measure(2.0, 1.9, 2.1), "2.00 [1.90, 2.10]", "ok"),
        (measure(2.0, status="uncertain"), "2, no interval", "uncertain"),
        (measure(np.nan, status="too_short"), "no number", "refused"),
        (measure(np.nan), "no number", "refused"),
    ],
)
def test_one_estimate_in_words(facts, value, kind):
    row = make_estimate_row("It", facts)
    assert (row.value, row.kind) == (value, kind)
    assert kind == "ok" or row.remark.endswith(".")


@pytest.mark.parametrize("kind", list(made.KINDS))
def test_it_stands_by_itself_and_names_nothing_twice(pages, kind):
    page = pages[kind]
    names = re.findall(r'\bid="([^"]+)"', page)
    assert "http" not in page
    assert not re.search(r'<[^>]*\s(src|href)="(?!data:image/png;base64,|#)', page)
    assert len(names) == len(set(names))
    assert set(re.findall(r"url\(#([^)]+)\)", page)) | set(re.findall(r'href="#([^"]+)"', page)) <= set(names)


def test_every_text_of_a_file_is_escaped(pages):
    assert "<script" not in pages["hostile"]
    assert "&lt;script&gt;" in pages["hostile"]
    assert _sections(pages["hostile"]) == ALL


def test_same_results_give_the_same_page(folders, pages):
    assert render(read_analysis(folders["chaotic"])) == pages["chaotic"]


def test_single_points_and_nothing_but_nan_are_borne(whole):
    empty = {name: np.full_like(values, np.nan) for name, values in whole.arrays.items()}
    assert _sections(render(replace(whole, arrays=empty))) == []
    short = {name: values[..., :1] for name, values in whole.arrays.items() if name.startswith(("d2", "lyap", "emb"))}
    assert render(replace(whole, arrays=short))


def test_folder_without_an_analysis_is_refused(tmp_path):
    with pytest.raises(DataError, match="run `lostmotion analyse RECORDING --out"):
        write_analysis(tmp_path)
    (tmp_path / "analysis.json").write_text("{", encoding="utf-8")
    with pytest.raises(DataError, match="run `lostmotion analyse` again"):
        write_analysis(tmp_path)


@pytest.mark.parametrize(
    ("facts", "says"),
    [
        ({"signs": [{"sign": "a", "name": "a", "state": "odd", "says": "", "excludes": ""}]}, "found 'odd' @ .signs"),
        ({"signs": ["text"]}, "signs"),
        ({"says": ["One.", "Two."]}, "expected a text"),
        ({"delay": None}, "delay"),
        ({"strength": None}, "strength"),
    ],
)
def test_facts_that_no_command_wrote_are_refused(tmp_path, facts, says):
    made.write(tmp_path, made.facts("It", 0.1, 1) | facts, {"x": made.StoredArray(("time",), np.zeros(3))})
    with pytest.raises(DataError, match=r"is not what this program writes.*run `lostmotion analyse` again") as caught:
        write_analysis(tmp_path)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("unit", "value"),
    [("1/s", 2.0), ("bit/s", 2.0 * np.log(2)), ("1/period", 4.0), ("bit/period", 4.0 * np.log(2))],
)
def test_line_has_the_slope_of_the_exponent_in_any_unit(whole, unit, value):
    drive = DrivePeriod(period=0.5, samples_per_period=50.0, source="given")
    said = _said(whole, lyapunov=measure(2.0, unit=unit), drive=drive)
    assert convert_to_natural(said, 2.0) == pytest.approx(value)


def test_ticks_and_cut_words():
    assert [power_of_ten(v) for v in (1.0, 1e-5, 2e-5, 10.0, 1e6)] == ["1", "10⁻⁵", "2·10⁻⁵", "10¹", "10⁶"]
    assert shorten("a  b\nc", 10) == "a b c"
    assert shorten("abcdefgh", 4) == "abc…"


def test_facts_are_those_of_the_contract(folders, whole):
    keys = {"schema", "verdict", "says", "delay", "dimension", "noise", "lyapunov", "d2", "surrogates"}
    plain = to_plain(whole.result)
    assert keys <= set(plain)
    assert plain == json.loads((folders["chaotic"] / "analysis.json").read_text(encoding="utf-8"))


def signed(state, name="growth"):
    return Sign(name, name, state, f"it is {state} & <b>", "noise")


def test_each_sign_stands_with_its_state_and_why(whole):
    page = _words(render(_said(whole, signs=(signed("silent", "a"), signed("against", "b"), signed("for", "c")))))
    assert "1 for chaos, 1 against it, 1 silent" in page
    assert page.index("It is for & <b>.") < page.index("It is against & <b>.") < page.index("It is silent & <b>.")
    assert "<b>" not in render(_said(whole, signs=(signed("for"),)))


@pytest.mark.parametrize(
    ("strength", "word"), [("firm", "Chaotic"), ("likely", "Probably chaotic"), ("open", "Chaotic")]
)
def test_the_badge_is_as_firm_as_the_signs(whole, strength, word):
    assert name_verdict(replace(whole.result, strength=strength)) == ("chaotic", word)
