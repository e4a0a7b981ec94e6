"""Checks of sets of terms against autocorrelated residuals."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.inference import robustness
from lostmotion.inference.robustness import RobustChecks
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
