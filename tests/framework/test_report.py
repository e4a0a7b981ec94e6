"""The page: it opens with the answer, stands by itself, and bears what is absent or hostile."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
import report_fixture as made
import xarray as xr

from lostmotion.diagnosis.report import prediction
from lostmotion.diagnosis.report.diagnosis_page import SECTIONS as PLAN
from lostmotion.diagnosis.report.diagnosis_page import write_report
from lostmotion.diagnosis.report.hero import save_hero
from lostmotion.diagnosis.report.page_data import Evidence, read_evidence
from lostmotion.errors import DataError

BESIDE = {
    "response": ("missing",),
    "portrait_": ("portraits",),
    "section_": ("portraits",),
    "forecast_": ("prediction",),
    "posterior_": ("ranking",),
}
SECTIONS = ("prediction", "missing", "ranking", "parameters", "portraits", "show", "growth", "whiteness")
FIGURES = tuple(name for name in SECTIONS if name != "show")


@pytest.fixture(scope="module")
def data() -> xr.Dataset:
    return made.arrays(periods=20)


@pytest.fixture(scope="module")
def whole(data, tmp_path_factory) -> Evidence:
    return read_evidence(made.write(tmp_path_factory.mktemp("whole"), made.mismatch(), data))


@pytest.fixture(scope="module")
def page(data, tmp_path_factory) -> str:
    return _page(tmp_path_factory.mktemp("report"), made.mismatch(), data)


def _page(folder, facts, data=None) -> str:
    written = write_report(made.write(folder, facts, data))
    assert written == folder / "report.html"
    return written.read_text(encoding="utf-8")


def _drawn(folder, facts, data) -> list[str]:
    evidence = read_evidence(made.write(folder, facts, data))
    return [one.name for one in PLAN if one.draw(evidence) is not None]


def _sections(page) -> list[str]:
    return re.findall(r'<section id="section-(\w+)">', page)


def _heading(page) -> str:
    return re.search(r"<h1>(.*?)</h1>", page)[1]


def test_it_opens_with_the_sentences_of_the_diagnosis(page):
    assert _heading(page) == "Dry friction of 3.01 N [2.97, 3.05] was left out."
    assert "from 3.1 N to 0.05 N" in page


def test_all_figures_stand_in_their_order(page):
    assert _sections(page) == list(SECTIONS)
    assert page.count("<figcaption>") == len(FIGURES)
    assert page.count("<svg") + page.count("<img") == len(FIGURES)


def test_it_refers_to_nothing_outside_itself(page):
    assert "http" not in page
    assert "<script" not in page
    assert not re.search(r'(src|href)="(?!data:image/png;base64,|#)', page)
    assert "@import" not in page


def test_each_name_in_the_page_is_used_once(page):
    names = re.findall(r'\bid="([^"]+)"', page)
    assert len(names) == len(set(names))


def test_each_reference_finds_its_target(page):
    names = set(re.findall(r'\bid="([^"]+)"', page))
    assert set(re.findall(r"url\(#([^)]+)\)", page)) <= names
    assert set(re.findall(r'href="#([^"]+)"', page)) <= names


def test_the_same_results_give_the_same_page(page, data, tmp_path):
    assert _page(tmp_path, made.mismatch(), data) == page


def test_known_values_stand_beside_the_parameters(page):
    assert "Known value" in page
    assert "inside" in page


@pytest.mark.usefixtures("unsaved")
def test_a_known_value_outside_its_interval_is_said(tmp_path):
    page = _page(tmp_path, made.mismatch() | {"truth": {"c": 9.0}})
    assert '<td class="outside">outside</td>' in page


def test_every_string_of_a_file_is_escaped(data, tmp_path):
    hostile = "<script>alert('x')</script>"
    facts = made.mismatch() | {"title": hostile, "says": [hostile], "notes": [hostile]}
    facts |= {
        "model": {"before": hostile, "after": hostile},
        "confused_with": [{"mechanism": hostile, "says": hostile}],
    }
    facts["provenance"]["settings"] = {hostile: hostile}
    facts["open"] = [{"mechanism": hostile, "at": hostile, "probability": 0.3, "says": hostile}]
    facts["show"]["says"]["d2"] = facts["show"]["units"]["d2"] = facts["drive"]["of"] = hostile
    facts["found"][0] |= {"mechanism": hostile, "says": hostile, "at": hostile}
    facts["ranking"][0] |= {"mechanism": hostile}
    facts["whiteness"]["before"]["says"] = facts["where"]["summary"] = facts["response"]["quantity"] = hostile
    facts["units"]["force"] = facts["unexplained"]["unit"] = hostile
    assert "<script" not in _page(tmp_path, facts, data)


def test_dollar_signs_in_names_are_not_taken_for_formulas(tmp_path):
    facts = made.mismatch()
    facts["ranking"][0]["mechanism"] = r"$\nosuch{$"
    assert "section-ranking" in _page(tmp_path, facts)


@pytest.mark.usefixtures("unsaved")
def test_an_adequate_model_has_nothing_missing_and_no_after(data, tmp_path):
    page = _page(tmp_path, made.adequate(), made.alone(data))
    assert _heading(page) == "Nothing is missing that this recording can show."
    assert _sections(page) == list(SECTIONS)
    assert "<th>After</th>" not in page
    assert "<th>State" not in page


@pytest.mark.usefixtures("unsaved")
def test_a_mismatch_without_a_name_is_open(tmp_path):
    page = _page(tmp_path, made.unknown())
    assert _heading(page) == "Something is missing that no mechanism of the library explains."
    assert "Mismatch, open" in page


@pytest.mark.usefixtures("unsaved")
def test_what_was_learned_is_drawn_with_its_band_and_its_proposal(tmp_path):
    facts, at = made.unknown(), [-0.01, 0.0, 0.01]
    low, force, high = [-1.5, -0.2, 0.5], [-1.0, 0.0, 1.0], [-0.5, 0.2, 1.5]
    curve = {"over": "position", "at_place": "ground", "unit": "m", "force_unit": "N", "times": ""}
    facts["found"][0] |= {
        "curves": [curve | {"at": at, "force": force, "low": low, "high": high}],
        "proposal": {"formula": "1e+06 N/m^3 x^3", "says": "A proposal, not a finding."},
    }
    page = _page(tmp_path, facts)
    assert "section-learned" in page
    assert "A proposal, not a finding. The formula is 1·10⁶ N/m³ x³." in page


@pytest.mark.usefixtures("unsaved")
def test_what_noise_would_show_as_well_is_told_from_what_it_would_not(data, tmp_path):
    facts = made.mismatch()
    facts["where"] |= {"significant": ["velocity"], "against": "the likelihood ratio of a curve"}
    page = _page(tmp_path, facts, data)
    assert "A star marks a significant covariate by the likelihood ratio of a curve." in page


@pytest.mark.usefixtures("unsaved")
def test_without_arrays_there_are_still_words_ranking_and_parameters(tmp_path):
    assert _sections(_page(tmp_path, made.mismatch())) == ["ranking", "parameters", "show"]


@pytest.mark.parametrize("key", sorted(made.mismatch().keys() - {"schema"}))
def test_a_key_that_is_absent_is_named(tmp_path, key):
    facts = {name: value for name, value in made.mismatch().items() if name != key}
    with pytest.raises(DataError, match=rf"diagnosis\.json is not what this program writes: '{key}' is absent"):
        write_report(made.write(tmp_path, facts))


def test_a_value_of_another_type_is_told_at_its_key(tmp_path):
    facts = made.mismatch()
    facts["found"][0]["parameters"]["force"]["median"] = "much"
    with pytest.raises(
        DataError, match=r"expected a number, found 'much' @ \.found\[0\]\.parameters\['force'\]\.median"
    ):
        write_report(made.write(tmp_path, facts))


@pytest.mark.parametrize(
    ("prefix", "section"),
    [
        ("response", "prediction"),
        ("before_", "missing"),
        ("portrait_", None),
        ("forecast_", None),
        ("section_", None),
        ("growth_", "growth"),
        ("acf_", "whiteness"),
        ("posterior_", "parameters"),
    ],
)
def test_absent_arrays_leave_out_their_figure_and_spare_its_neighbour(whole, prefix, section):
    less = whole.data.drop_vars([name for name in whole.data.variables if str(name).startswith(prefix)])
    poorer = replace(whole, data=less)
    for part in PLAN:
        if part.name == section:
            assert part.draw(poorer) is None
        elif part.name in BESIDE.get(prefix, ()):
            assert part.draw(poorer) is not None


def test_what_is_left_of_a_poor_result_is_still_one_page(data, tmp_path):
    poor = data[["response", "portrait_recorded_x", "portrait_recorded_v", "acf_after", "posterior_before"]]
    page = _page(tmp_path, made.mismatch(), poor)
    assert _sections(page) == ["prediction", "ranking", "parameters", "portraits", "show", "whiteness"]


def test_arrays_of_nothing_but_nan_are_as_good_as_absent(data, tmp_path):
    empty = data.copy()
    for name in ("before_mean", "growth_before", "growth_after", "growth_floor", "forecast_after"):
        empty[name] = empty[name] * float("nan")
    assert set(FIGURES) - set(_drawn(tmp_path, made.mismatch(), empty)) == {"missing", "growth"}


def test_a_model_that_runs_away_does_not_blow_up_the_figures(data, tmp_path):
    wild = data.copy(deep=True)
    for name in ("forecast_before", "portrait_before_x", "section_before_v", "growth_before"):
        wild[name] = wild[name] * 1e12
    assert _sections(_page(tmp_path, made.mismatch(), wild)) == list(SECTIONS)


@pytest.mark.usefixtures("unsaved")
def test_a_drive_without_period_and_numbers_that_are_null_are_borne(data, tmp_path):
    facts = made.mismatch() | {"lyapunov": {"before": None, "after": None, "unit": "1/s"}}
    facts["unexplained_before"] |= {"rms": None, "share_of_drive": None}
    for when in ("before", "after"):
        facts["fit"][when] |= {"heldout_log_score": None, "heldout_nrmse": None}
    facts["fit"]["noise_floor_nrmse"] = facts["drive"]["frequency"] = None
    assert _sections(_page(tmp_path, facts, data)) == list(SECTIONS)


@pytest.mark.usefixtures("unsaved")
def test_several_recordings_show_the_one_that_was_held_out(data, tmp_path):
    two = data.copy(deep=True)
    half = two.sizes["time"] // 2
    two["record"][half:] = 1
    two = two.assign_coords(time=("time", list(data["time"].values[:half]) * 2, {"units": "s"}))
    evidence = read_evidence(made.write(tmp_path, made.mismatch(), two))
    window = prediction.choose_window(evidence)
    assert window.record[0] == half
    assert window.shown.size > made.PER_PERIOD
    assert prediction.draw(evidence)


def test_a_folder_without_a_diagnosis_is_refused_in_words(tmp_path):
    with pytest.raises(DataError, match=r"no diagnosis\.json in .*: run `lostmotion diagnose"):
        write_report(tmp_path)


@pytest.mark.parametrize("text", ["{", "[]"])
def test_a_broken_diagnosis_is_refused_in_words(tmp_path, text):
    (tmp_path / "diagnosis.json").write_text(text, encoding="utf-8")
    with pytest.raises(DataError, match="again"):
        write_report(tmp_path)


def test_the_hero_is_one_wide_picture(data, tmp_path):
    picture = save_hero(made.write(tmp_path, made.mismatch(), data))
    assert picture.name == "hero.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
