"""Unknown is an answer: curves that are learned, their kernels, their smoothness, and the formula that is proposed."""

import math
import re

import numpy as np
import pytest
from made_facts import FRICTION, make_facts, make_prediction

from lostmotion.diagnosis import unknowns
from lostmotion.diagnosis.verdict import rank_candidates
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.inference.curves import _keep_independent
from lostmotion.inference.learned import OverPhase, OverPosition, compute_spread, list_covariates
from lostmotion.inference.proposal import Axis, propose_formula
from lostmotion.inference.surfaces import KINDS, OverHistory, Surface, list_all_curves
from lostmotion.quantities import DAMPING, FORCE, LENGTH, SPEED
from lostmotion.registry import default
from lostmotion.results.diagnosis import Mechanism

RUB = frozenset({FRICTION})
X = Axis("x", LENGTH, FORCE, "translation")
INPUT = np.zeros(1)


def force(term, weights, at, velocity=1.0, needs=()):
    """Return the force of a curve with range -1 to 1 at one place."""
    own = tuple(term.prepared(np.array([[*weights, 0.0, 1.0, *needs]]))[0].tolist())
    return term.force(at if term.over == "time" else 0.3, at, velocity, INPUT, own, ())


def curves():
    return list_all_curves(default().make("model", "robot_joint"), driven=True)


def test_there_is_a_curve_of_each_kind_at_each_place():
    assert len(curves()) == 2 * (len(KINDS) + 2) + 3
    assert not any("omega" in t.needs for t in list_all_curves(default().make("model", "lin_backlash"), driven=False))


ALL = list_all_curves(default().make("model", "lin_backlash"), driven=True)


@pytest.mark.parametrize("term", [t for t in ALL if not isinstance(t, Surface | OverHistory)], ids=lambda t: t.name)
def test_a_curve_without_weights_does_nothing_and_with_them_is_its_basis(term):
    rng = np.random.default_rng(0)
    needs = {"mobility": 1e-6, "omega": 2.0}
    given = [needs[n] for n in term.needs]
    assert force(term, np.zeros(term.count), 0.4, needs=given) == 0.0
    weights = rng.standard_normal(term.count)
    for at in (-0.8, 0.0, 0.4, 1.0, 3.0):
        velocity = at if term.over == "velocity" else 1.0
        z = 2.0 * 0.3 / (2.0 * np.pi) * 2.0 if term.over == "phase" else at
        expected = float((term.basis(np.array([z])) @ weights)[0])
        sign = -1.0 if term.times else 1.0
        size = np.abs(weights).sum()
        assert force(term, weights, at, velocity, given) == pytest.approx(sign * expected, abs=1e-4 * size)


@pytest.mark.parametrize("term", [t for t in ALL if isinstance(t, Surface)], ids=lambda t: t.name)
def test_a_surface_is_its_basis(term):
    """The kernel makes its sines one from another, the basis each for itself."""
    weights = np.random.default_rng(1).standard_normal(term.count)
    omega, t = 2.0, 0.7
    for x, v in ((0.1, -0.3), (-0.9, 0.8), (2.0, 0.0), (0.4, -5.0)):
        own = (*weights, 0.1, 0.8, -0.2, 1.5, *((omega,) if term.needs else ()))
        second = (v + 0.2) / 1.5 if term.beside == "velocity" else omega * t / np.pi
        expected = float(term.grid(np.array([(x - 0.1) / 0.8]), np.array([second]))[0, 0] @ weights)
        assert term.force(t, x, v, INPUT, own, ()) == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_a_force_with_a_memory_is_its_curve_over_what_it_has_not_forgotten():
    """Under a constant velocity the state settles at velocity times time; `followed` has the exact exponential."""
    term, time = OverHistory(), 0.5
    weights = np.random.default_rng(2).standard_normal(term.count)
    own = term.prepared(np.array([[*weights, 0.0, 1.0, time]]))[0]
    expected = float((term.basis(np.array([0.35])) @ weights)[0])
    assert term.force(0.0, 9.0, 9.0, INPUT, own, (0.35,)) == pytest.approx(expected, abs=1e-4 * np.abs(weights).sum())
    change = np.zeros(1)
    term.rate(0.0, 0.0, 0.7, INPUT, own, (0.35,), change)
    assert change[0] == pytest.approx(0.0, abs=1e-12)
    t = np.arange(0.0, 3.0, 0.01)
    assert term.followed(np.full(len(t), 0.7), 0.01, time) == pytest.approx(0.35 * (1.0 - np.exp(-t / time)), abs=1e-3)


def test_friction_of_a_place_opposes_the_motion_and_sticks():
    term = next(t for t in curves() if t.name == "unknown_friction_over_position")
    weights = np.eye(term.count)[0]
    fast, back, slow = (force(term, weights, 0.1, v, (1e-3,)) for v in (1.0, -1.0, 1e-6))
    assert fast == -back < 0.0
    assert abs(slow) < 0.01 * abs(fast)


def test_prior_widths_are_those_of_a_force_of_unit_size():
    for term in (OverPosition(), OverPhase()):
        z = np.linspace(-0.6, 0.6, 50)
        for length in (0.12, 0.5):
            variance = term.basis(z) ** 2 @ compute_spread(term, length) ** 2
            assert np.mean(variance) == pytest.approx(1.0, rel=0.35)


def test_a_longer_correlation_makes_a_smoother_curve():
    short, long_ = (compute_spread(OverPosition(), length) for length in (0.06, 1.0))
    assert long_[-1] / long_[0] < 1e-2 * short[-1] / short[0]


def test_what_a_sum_depends_on_is_named_once():
    over = {t.name + t.at: t for t in curves()}
    both = [over["unknown_over_positionground"], over["unknown_drag_over_positionground"]]
    assert list_covariates(both) == ["position", "velocity"]
    assert list_covariates([over["unknown_over_positionbase"]]) == ["position at base"]


def curve(law, sd=0.02, seed=0):
    """Return places (m), a noisy curve of a law there, and its covariance."""
    at = np.linspace(-0.01, 0.012, 81)
    rng = np.random.default_rng(seed)
    smooth = sd**2 * np.exp(-0.5 * ((at[:, None] - at) / 0.0008) ** 2)
    root = np.linalg.cholesky(smooth + 1e-9 * np.eye(len(at)))
    return at, law(at) + root @ rng.standard_normal(len(at)), smooth


@pytest.mark.parametrize(
    ("law", "text"),
    [
        (lambda x: 2e6 * x**3, r"^\S+ N/m\^3 x\^3$"),
        (lambda x: np.sin(2.0 * np.pi * x / 0.004), r"^\S+ N sin\(2 pi x / 0\.00\d+ m "),
        (lambda x: 2.0 * np.exp(-(((x - 0.003) / 0.0009) ** 2)), r"exp\(-\(\(x -0\.00\d+ m\) / "),
        (lambda x: 1.5 * np.sign(x), r"^1\.\d+ N sign\(x\)"),
    ],
)
def test_a_formula_is_proposed_for_a_curve_that_has_one(law, text):
    found = propose_formula(*curve(law), X)
    assert found.share > 0.9
    assert re.search(text, found.text), found.text


def test_no_formula_is_proposed_for_noise():
    at, mean, covariance = curve(lambda x: 0.0 * x, seed=3)
    found = propose_formula(at, mean, covariance, X)
    assert found is None or len(found.text.split(" + ")) <= 3


def test_a_formula_carries_the_units_of_its_curve():
    axis = Axis("v", SPEED, DAMPING, "translation")
    found = propose_formula(*curve(lambda x: 2e4 * x**2), axis)
    assert "N s^3/m^3 v^2" in found.text


def test_what_free_parameters_cover_promises_nothing():
    """Of the first direction a millionth of its information is left: a gradient there would promise a gain of 5e5."""
    own = np.diag([1.0, 4.0])
    left = np.diag([1e-6, 3.0])
    gradient, information = _keep_independent(np.array([1.0, 6.0]), left, own)
    assert gradient == pytest.approx([0.0, 6.0], abs=1e-9)
    assert information == pytest.approx(np.diag([0.0, 3.0]), abs=1e-9)


def test_the_odds_of_an_unknown_force_are_those_of_the_explanations_that_have_it():
    """Scores 5 and 3 with it, 4 without: log odds of 1."""
    sets = {frozenset(): 0.0, RUB: 4.0, frozenset({UNKNOWN}): 5.0, RUB | {UNKNOWN}: 3.0}
    assert unknowns.compute_unknown_odds(0.6, sets, 0.0) == (0.6, 1.0)


@pytest.mark.parametrize(("random_gain", "p"), [(0.0, 0.0), (3.0, 1.0 - math.exp(-3.0))])
def test_a_random_force_beyond_the_usual_is_an_unknown_force_if_nothing_was_found(random_gain, p):
    assert unknowns.compute_unknown_odds(0.0, {frozenset(): 0.0}, random_gain) == pytest.approx((p, random_gain))


@pytest.mark.parametrize("random_gain", [0.0, 3.0, 30.0])
@pytest.mark.parametrize("smooth", [0.0, 2e-9, 1.0 - 2e-9])
def test_nothing_missing_and_something_unknown_are_not_both_probable(random_gain, smooth):
    """Also where an unknown smooth force is improbable, and a random force is not."""
    sets = {frozenset(): 1.0 - smooth, frozenset({UNKNOWN}): smooth}
    unknown, gain = unknowns.compute_unknown_odds(smooth, {terms: math.log(p or 1e-99) for terms, p in sets.items()},
                                                  random_gain)  # fmt: skip
    ranking = rank_candidates(make_facts(sets=sets, unknown=unknown, unknown_gain=gain), ())
    rows = {row.mechanism: row.probability for row in ranking}
    assert rows["nothing_missing"] + rows["unknown"] <= 1.0 + 1e-9
    assert rows["unknown"] == pytest.approx(max(smooth, 1.0 - math.exp(-random_gain)))


def test_the_ranking_has_the_probability_of_every_finding():
    """Also of quantisation, which is seen in the stored values and not found by likelihood."""
    seen = Mechanism(mechanism=FRICTION, at="ground", probability=1.0, state="named", parameters={}, says="It is seen.")
    rows = rank_candidates(make_facts(), (seen,))
    assert next(row.probability for row in rows if row.mechanism == FRICTION) == 1.0


def test_a_model_that_does_not_predict_lacks_something_whatever_the_evidence_says():
    rows = rank_candidates(make_facts(after=make_prediction(0.9)), ())
    assert {row.mechanism: row.probability for row in rows if row.probability} == {"unknown": 1.0}
