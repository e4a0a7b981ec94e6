"""Numbers, units and names as a reader meets them."""

from __future__ import annotations

import math

import pytest

from lostmotion.report.words import (
    DASH,
    Scale,
    chance,
    choose_scale,
    figures,
    format_quantity,
    format_unit,
    interval,
    percent,
    probability,
    span,
    to_words,
    typeset,
)
from lostmotion.results import Interval


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (0.05, "0.05"),
        (3.1, "3.1"),
        (2003.1, "2003"),
        (0, "0"),
        (1e-9, "1e-9"),
        (-1.9, "−1.9"),
        (4e8, "4e8"),
        (100.0, "100"),
        (None, DASH),
        (float("nan"), DASH),
        ("x", DASH),
    ],
)
def test_figures(value, said):
    assert figures(value) == said


def test_an_interval_has_as_many_decimals_as_it_deserves():
    assert interval(Interval(1.0184, 0.9902, 1.0531, "N")) == "1.02 [0.99, 1.05] N"


def test_small_lengths_are_read_in_millimetres():
    assert interval(Interval(5e-3, 4.998e-3, 5.002e-3, "m")) == "5.000 [4.998, 5.002] mm"


def test_an_interval_without_width_or_without_numbers_is_borne():
    assert interval(Interval(2.0, 2.0, 2.0, "1")) == "2.000 [2.000, 2.000]"
    assert interval(None) == DASH
    assert interval(Interval(math.nan, math.nan, math.nan, "N")) == DASH


def test_a_median_stands_alone_where_its_interval_is_withheld():
    told = Interval(2.0, math.nan, math.nan, "N", withheld="The model does not hold.")
    assert interval(told) == "2 N, interval withheld"


@pytest.mark.parametrize(
    ("largest", "unit", "scale"),
    [
        (0.02, "m", Scale(1e3, "mm")),
        (3e-6, "m", Scale(1e6, "µm")),
        (2e4, "N", Scale(1e-3, "kN")),
        (3.0, "N", Scale(1, "N")),
        (0.01, "kg", Scale(1, "kg")),
        (0.0, "m", Scale(1, "m")),
        (float("nan"), "m", Scale(1, "m")),
    ],
)
def test_prefixes_stand_only_where_they_help(largest, unit, scale):
    assert choose_scale(largest, unit) == scale


def test_names_units_and_shares():
    assert to_words("bouc_wen_hysteresis") == "Bouc–Wen hysteresis"
    assert format_unit("kg m^2") == "kg m²"
    assert format_quantity(3.0, "1") == "3"
    assert percent(0.012) == "1.2 %"


@pytest.mark.parametrize(("value", "said"), [(1.0, "> 0.999"), (0.0, "< 0.001"), (0.97, "0.970"), (None, DASH)])
def test_a_probability_is_never_rounded_to_certainty(value, said):
    assert probability(value) == said


@pytest.mark.parametrize(
    ("text", "page"),
    [
        ("up to 54 % of it", "up to 54\N{NO-BREAK SPACE}% of it"),
        ("9.992e+05 N/m^3 [9.977e+05, 1e-06]", "9.992·10⁵ N/m³ [9.977·10⁵, 1·10⁻⁶]"),
        ("5.2 N s^2/m^2, 64% +- 10%", "5.2 N s²/m², 64% ± 10%"),
        ("run1e2x and 2^8", "run1e2x and 2^8"),
    ],
)
def test_sentences_are_set_as_on_a_page(text, page):
    assert typeset(text) == page


def test_lengths_and_p_values_are_said_in_words():
    assert span(1.0, "natural periods") == "one natural period"
    assert span(0.5, "Lyapunov times") == "0.5 Lyapunov times"
    assert chance(0.031) == "p = 0.031"
    assert chance(0.0) == "p < 1e-99"
    assert chance(None) == f"p = {DASH}"
