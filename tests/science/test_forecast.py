"""What a recording can tell before the fit: intervals as found, and sizes at which terms are named."""

from types import SimpleNamespace

import numpy as np
import pytest
from explained import explain, made_of

from lostmotion.diagnosis.compare import cut_heldout
from lostmotion.diagnosis.expected_findings import describe_expectation, forecast_recordings
from lostmotion.diagnosis.stages import list_fitted_keys
from lostmotion.evidence import forecast as module
from lostmotion.evidence.bare import Budget
from lostmotion.evidence.forecast import RAISED, Forecast, _Rival, _solve_size, measure_levels
from lostmotion.evidence.search import ExplanationSearch
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout


def rub(size):
    """Return dry friction (N), without sticking, of a size."""
    return lambda x, v, t: -size * np.tanh(v / 1e-3)


def fit_nominal(folder, extra):
    """Return prepared case, held-out part and nominal fit of a recording."""
    folder.mkdir(exist_ok=True)
    prepared, system = made_of(folder, extra)
    train, held = split_heldout(prepared.observations)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    return prepared, held, nominal


@pytest.fixture(scope="module")
def still(tmp_path_factory):
    """Return what a recording of a machine that lacks nothing can tell, and its nominal fit."""
    prepared, _, nominal = fit_nominal(tmp_path_factory.mktemp("still"), rub(0.0))
    return describe_expectation(
        forecast_recordings(nominal, prepared.observations, np.random.default_rng(0)), "the drive"
    ), nominal


def test_the_size_has_the_chance_that_is_stated():
    """The log odds of a true effect of this size are above log 19 in 90 % of draws; 2000 draws, +- 3 deviations."""
    own, rival = _Rival("a", 12.0, 3.0), _Rival("b", 4.0, 1.0)
    size = _solve_size(own, rival)
    mean = size**2 * (own.explained - rival.explained)
    odds = mean + np.sqrt(2.0 * mean) * np.random.default_rng(0).standard_normal(2000) - (own.paid - rival.paid)
    assert np.mean(odds > np.log(19.0)) == pytest.approx(0.9, abs=3.0 * np.sqrt(0.09 / 2000))


def test_expected_intervals_are_those_of_the_weighed_model(still):
    """Both have wrong known values and errors of channels integrated: k follows a mass that is wrong by 1 %."""
    expected, nominal = still
    search = ExplanationSearch(nominal, list_fitted_keys(nominal.posterior.system), (), Budget())
    search.weigh(search.bare.fits[frozenset()])
    found = search.best
    for name, sd in zip(("c", "k"), np.sqrt(np.diag(found.covariance)), strict=False):
        one = expected.parameters[name]
        assert np.log(one.high / one.low) == pytest.approx(2.0 * 1.96 * sd, rel=0.2)
        assert one.low < {"c": 0.8, "k": 300.0}[name] < one.high


def test_damping_is_not_told_from_the_damping_of_the_model(still):
    (row,) = [one for one in still[0].unseen if one.mechanism == "viscous_damping"]
    assert "parameter c has the same effect" in row.says


def test_a_delay_and_a_lag_are_not_told_apart(still):
    rows = {one.mechanism: one for one in still[0].effects}
    assert "actuator_lag" in rows["excitation_delay"].confused_with


@pytest.mark.slow
def test_friction_of_the_stated_size_is_found_and_a_quarter_of_it_is_not(tmp_path, still):
    (row,) = [one for one in still[0].effects if one.mechanism == "coulomb_friction"]
    found = []
    for share in (1.3, 0.25):
        prepared, held, nominal = fit_nominal(tmp_path / str(share), rub(share * row.smallest))
        pieces = [(piece.observation, piece.begin) for piece in cut_heldout(prepared.observations, held)]
        found.append(explain(nominal, list_fitted_keys(nominal.posterior.system), pieces).inclusion("coulomb_friction"))
    assert found[0] > 0.95
    assert found[1] < 0.5


def test_what_a_random_force_hides_is_told_of_the_same_term(monkeypatch):
    """A term without a finite effect in one forecast moves the places of the others there: a diagnosis ended so."""

    def forecast(effects, information):
        blocks = {key: slice(i, i + 1) for i, key in enumerate(effects)}
        made = object.__new__(Forecast)
        here = SimpleNamespace(expansion=SimpleNamespace(here=SimpleNamespace(log_likelihood=0.0)))
        made.__dict__.update(effects=dict.fromkeys(effects), joined=SimpleNamespace(blocks=blocks), found=here)
        made.__dict__["information"] = np.diag(information)
        return made

    told = iter([forecast("ab", [4.0, 9.0]), *(forecast("b", [3.0]) for _ in RAISED)])
    monkeypatch.setattr(module, "make_forecast", lambda *_, **__: next(told))
    simulated = SimpleNamespace(posterior=SimpleNamespace(observations=(None,), samples=1))
    levels = measure_levels(simulated, ("a", "b"), 1)
    assert [level.left for level in levels] == [{"b": pytest.approx(3.0 / 9.0)}] * len(RAISED)
