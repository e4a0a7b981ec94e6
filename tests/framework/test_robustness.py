"""Checks of sets of terms against autocorrelated residuals."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.inference import robustness
from lostmotion.inference.robustness import RobustChecks
from lostmotion.inference.selection import Selector
from lostmotion.inference.significance import Significance
from lostmotion.inference.term_sets import TermSet
from lostmotion.likelihood.problem import RANDOM
from lostmotion.settings import DEFAULT


def set_of(terms, log_random_force=9.0, noise=1.0):
    """Return a set of terms; the usual level of its random force is zero, and `noise` the variance of its sensor."""
    problem = SimpleNamespace(
        keys=(RANDOM,),
        free=(SimpleNamespace(parameter=RANDOM, mean=0.0),),
        settings=DEFAULT,
        observations=(SimpleNamespace(sensors=(None,)),),
        measurement=lambda theta, index, sensor: noise,
    )
    return TermSet(frozenset(terms), SimpleNamespace(problem=problem, theta=np.array([log_random_force])), 10.0)


@pytest.mark.parametrize(
    ("deviations", "ratio", "robust"), [(2.3, 1.0, True), (2.3, 1.5, False), (3.5, 1.5, True), (3.5, 2.5, False)]
)
def test_a_vague_amplitude_counts_where_samples_are_independent(monkeypatch, deviations, ratio, robust):
    """The share of a drive that saturates is vague only because its limit goes with it."""
    monkeypatch.setattr(robustness, "measure_significance", lambda fit: Significance({"a": deviations}, ratio))
    assert RobustChecks(DEFAULT.select).is_robust(set_of("a"), set_of("")) == robust


@pytest.mark.parametrize(("log_random_force", "robust"), [(8.9, False), (8.7, True)])
def test_with_autocorrelated_residuals_the_random_force_must_fall(monkeypatch, log_random_force, robust):
    monkeypatch.setattr(robustness, "measure_significance", lambda fit: Significance({"a": 9.0}, 3.0))
    assert RobustChecks(DEFAULT.select).is_robust(set_of("a", log_random_force), set_of("")) == robust


@pytest.mark.parametrize(("level", "noise", "robust"), [(0.0, 0.9, False), (0.0, 0.7, True), (9.0, 0.7, False)])
def test_without_a_random_force_the_noise_of_a_sensor_must_fall(monkeypatch, level, noise, robust):
    """What an accelerometer lacks is in its noise: no term could lower a random force that is not there."""
    monkeypatch.setattr(robustness, "measure_significance", lambda fit: Significance({"a": 9.0}, 3.0))
    assert RobustChecks(DEFAULT.select).is_robust(set_of("a", level, noise), set_of("", level)) == robust


def test_one_vague_term_does_not_refute_another(monkeypatch):
    """A damping by direction makes a constant force vague: the force can be dropped, the damping stays."""
    monkeypatch.setattr(
        robustness, "measure_significance", lambda fit: Significance({"damping": 25.0, "offset": 1.8}, 1.9)
    )
    checks, both = RobustChecks(DEFAULT.select), set_of(("damping", "offset"))
    assert checks.list_vague(both) == ["offset"]
    assert not checks.is_robust(both, set_of(("offset",)))
    assert checks.is_robust(both, set_of(("offset",)), ["damping"])


def test_significance_is_measured_once_for_each_fit(monkeypatch):
    calls = []
    monkeypatch.setattr(robustness, "measure_significance", lambda fit: calls.append(fit) or Significance({}, 1.0))
    checks, first, second = RobustChecks(DEFAULT.select), set_of("a"), set_of("a")
    for term_set in (first, first, second):
        checks.list_vague(term_set)
    assert calls == [first.fit, second.fit]


def selector_of(monkeypatch, deviations, odds):
    """Return a selector with friction and an offset chosen, and damping beside them; the damping makes one vague."""
    weights = {"friction offset": 100.0, "damping friction offset": 140.0, "damping friction": 135.0}
    made = {}
    for names, weight in weights.items():
        terms = frozenset(names.split())
        fit = SimpleNamespace(problem=SimpleNamespace(active=terms, settings=DEFAULT))
        made[terms] = TermSet(terms, fit, weight)
    less = made.pop(frozenset({"damping", "friction"}))
    monkeypatch.setattr(robustness, "measure_significance", lambda fit: Significance(deviations, 1.5))
    selector = object.__new__(Selector)
    selector.limits, selector._built_on, selector._checks = DEFAULT.select, set(), RobustChecks(DEFAULT.select)
    selector._get_without = lambda fit, key: less
    selector.selection = SimpleNamespace(
        fitted_sets=made,
        discrepancy_fits={},
        tied=set(),
        declined=set(),
        chosen=made[frozenset({"friction", "offset"})].fit,
        fit_discrepancy=lambda here: None,
        settle_comparison=lambda one, other, need: None,
        compute_log_odds=lambda one, other: odds[" ".join(sorted(one.terms))],
    )
    return selector, made[frozenset({"friction", "offset"})]


@pytest.mark.parametrize(
    ("offset", "without", "taken"), [(1.0, 9.9, "damping friction"), (1.0, -1.0, ""), (9.0, 9.9, "")]
)
def test_a_term_takes_the_place_of_the_one_that_it_makes_vague(monkeypatch, offset, without, taken):
    """All three are no better than a smooth force; without the vague offset the other two are, as in EMPS."""
    odds = {"damping friction offset": -0.5, "damping friction": without}
    selector, here = selector_of(monkeypatch, {"damping": 30.0, "friction": 40.0, "offset": offset}, odds)
    assert selector._take_best(here) == bool(taken)
    assert " ".join(sorted(selector.selection.chosen.problem.active)) == (taken or "friction offset")
    assert selector.selection.tied == (set() if taken else {"damping"})
