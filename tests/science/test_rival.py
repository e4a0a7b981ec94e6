"""The rival of every name: its evidence against quadrature, and machines whose flaws must not get a name."""

from types import SimpleNamespace

import numpy as np
import pytest
from sensed import case_of, model_of, moved, multisine, noisy

from lostmotion.diagnosis.compare import choose_heldout_horizon, cut_heldout
from lostmotion.diagnosis.confirming import find_unconfirmed
from lostmotion.diagnosis.search import list_fitted_keys
from lostmotion.inference.candidates import compute_slopes, fit_term, run_score_test
from lostmotion.inference.channel_correction import correct_channels
from lostmotion.inference.discrepancy_fits import evaluate_alike, evaluate_fit
from lostmotion.inference.rival import (
    compute_log_evidence,
    expand_fit,
    fit_discrepancy,
)
from lostmotion.inference.selection import Selector
from lostmotion.inference.setup import make_problem, search_maximum, split_heldout
from lostmotion.inference.term_sets import Selection, TermSet
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT

VALUES = {"m": 1.2, "c": 0.8, "k": 300.0}
T = np.arange(0.0, 12.0, 0.02)


FRICTIONS = ("coulomb_friction", "stribeck_friction", "dahl_friction", "lugre_friction", "directional_friction")


def oscillator(force, extra):
    """Return the position (samples,) of an oscillator by DOP853, with a further force of position, velocity, time."""

    def rates(t, y):
        more = extra(y[0], y[1], t)
        return [y[1], (float(force(t)) - VALUES["c"] * y[1] - VALUES["k"] * y[0] + more) / VALUES["m"]]

    return moved(rates, T, [0.0, 0.0])[:, 0]


def nominal_of(folder, extra, *, seed=0, stated=1.0, shown=lambda x: x):
    """Return the nominal fit of a recording under a multisine of 10 N, and what it was made of.

    The sensor has `shown` of the position.
    """
    prepared, system = made_of(folder, extra, seed=seed, stated=stated, shown=shown)
    train, _ = split_heldout(prepared.observations)
    return search_maximum(make_problem(system, prepared.case, train, jobs=1), np.random.default_rng(seed)), system


def made_of(folder, extra, *, seed=0, stated=1.0, shown=lambda x: x):
    """Return the case of such a recording, prepared, and the system of all terms."""
    force = multisine(10.0, 0.5, 5.0, seed)
    x = oscillator(force, extra)
    columns = {"t": T, "F": force(T), "x": noisy(shown(x), 0.003, seed)}
    recording = {
        "excitation": {"column": "F", "quantity": "force", "unit": "N"},
        "response": {"column": "x", "quantity": "position", "unit": "m"},
    }
    model = model_of("linear_oscillator", {**VALUES, "m": stated * VALUES["m"]}, ("c", "k"))
    prepared = prepare(case_of(folder, columns, recording, model), Registry.discover())
    return prepared, System(prepared.model, prepared.terms)


def chosen_of(nominal, system):
    return Selector(nominal, list_fitted_keys(system), lambda _: None).run()


def bend(size):
    """Return a smooth force (N) over the position that no term has: a wave of a few turns that narrows and fades."""
    return lambda x, v, t: size * np.sin(x / 0.012 * (1.0 + 4.0 * x) + 0.7) * (1.0 - 4.0 * x)


@pytest.mark.parametrize("seed", range(5))
def test_evidence_is_the_integral_over_the_coefficients(seed):
    rng = np.random.default_rng(seed)
    root = rng.standard_normal((2, 2))
    h, g, widths = root @ root.T, 3.0 * rng.standard_normal(2), np.exp(rng.standard_normal(2))
    z = np.linspace(-9.0, 9.0, 1201)
    a, b = (w * z for w in widths)
    prior = np.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi)
    grid = np.stack(np.meshgrid(a, b, indexing="ij"), axis=-1)
    height = np.exp(grid @ g - 0.5 * np.einsum("ijk,kl,ijl->ij", grid, h, grid))
    brute = np.log(np.sum(height * np.outer(prior, prior)) * (z[1] - z[0]) ** 2)
    assert compute_log_evidence(h, g, widths) == pytest.approx(brute, abs=1e-4)
    assert compute_log_evidence(h, g, np.array([widths[0], 0.0])) == pytest.approx(
        compute_log_evidence(h[:1, :1], g[:1], widths[:1])
    )


@pytest.mark.slow
def test_a_smooth_force_is_seen_by_the_discrepancy_and_gets_no_name(tmp_path):
    nominal, system = nominal_of(tmp_path, bend(0.25))
    best = expand_fit(nominal).find_best_without((), 1.0)
    assert best.gain > 20.0
    assert dict(best.chosen)["unknown_over_position"] >= 0
    assert chosen_of(nominal, system).chosen.problem.active == frozenset()


def test_what_is_promised_comes_true_when_it_is_fitted(tmp_path):
    nominal, _ = nominal_of(tmp_path, bend(0.25))
    expansion = expand_fit(nominal)
    promised = expansion.find_best_without((), expansion.inflation).gain
    fit, price = fit_discrepancy(expansion)
    won = fit.log_evidence - nominal.log_evidence - price
    assert won > 0.7 * promised


def test_a_clean_machine_has_no_discrepancy(tmp_path):
    nominal, system = nominal_of(tmp_path, lambda x, v, t: 0.0)
    assert expand_fit(nominal).predict_gain() < 3.0
    assert chosen_of(nominal, system).chosen.problem.active == frozenset()


def test_a_known_value_that_is_slightly_wrong_gets_no_name(tmp_path):
    nominal, system = nominal_of(tmp_path, lambda x, v, t: 0.0, stated=1.01)
    course = chosen_of(nominal, system)
    raw = max(v.weight for v in course.fitted_sets.values()) - course.fitted_sets[frozenset()].weight
    assert raw > DEFAULT.select.decisive, "by the evidence alone something would be named"
    assert course.chosen.problem.active == frozenset()
    assert course.tied


@pytest.mark.slow
def test_friction_is_named_beside_a_smooth_force(tmp_path):
    rub = lambda x, v, t: bend(0.2)(x, v, t) - 1.0 * np.tanh(v / 1e-3)  # noqa: E731
    nominal, system = nominal_of(tmp_path, rub)
    course = chosen_of(nominal, system)
    assert len(course.chosen.problem.active) == 1
    assert course.chosen.problem.active <= set(FRICTIONS)


@pytest.mark.slow
def test_leads_are_antisymmetric_and_bounded_by_what_the_larger_set_says(tmp_path):
    nominal, _ = nominal_of(tmp_path, bend(0.25))
    key = "cubic_stiffness"
    more = fit_term(nominal, run_score_test(nominal, compute_slopes(nominal), key))
    course = Selection(nominal, nominal)
    for fit in (nominal, more):
        course.fitted_sets[fit.problem.active] = TermSet(fit.problem.active, fit, fit.log_evidence)
    bare, with_it = (course.fitted_sets[fit.problem.active] for fit in (nominal, more))
    assert course.compute_log_odds(with_it, bare) == -course.compute_log_odds(bare, with_it)
    dropped = [i for i, k in enumerate(more.problem.keys) if k.startswith(key)]
    expansion = course.expansion(with_it)
    assert (
        course.compute_log_odds(with_it, bare)
        <= expansion.predict_gain(inflation=expansion.inflation)
        - expansion.predict_gain(dropped, inflation=expansion.inflation)
        + 1e-9
    )


def test_a_promise_is_also_looked_for_from_what_would_stand_in_for_the_terms(tmp_path):
    rub = lambda x, v, t: -1.0 * np.tanh(v / 1e-3)  # noqa: E731
    nominal, _ = nominal_of(tmp_path, rub)
    more = fit_term(nominal, run_score_test(nominal, compute_slopes(nominal), "coulomb_friction"))
    expansion = expand_fit(more)
    dropped = [i for i, k in enumerate(more.problem.keys) if k.startswith("coulomb_friction")]
    stand_in = expansion.find_best_without(dropped, expansion.inflation)
    beside = expansion.find_best_without((), expansion.inflation, stand_in.chosen)
    assert any(option >= 0 for _, option in stand_in.chosen)
    assert beside.gain >= stand_in.gain, "a set with the term is worth at least what it is worth without"
    assert expansion.find_best().gain == max(expansion.predict_gain(), beside.gain)
    assert expansion.find_best_without((), expansion.inflation) is expansion.find_best_without((), expansion.inflation)


def bent(x):
    """Return what a sensor shows that is bent by 0.8 % of its range, evenly."""
    return x + 0.008 * np.abs(x).max() * (x / np.abs(x).max()) ** 2


def test_a_bent_sensor_is_put_right_and_wins_what_slopes_promise(tmp_path):
    """The flaw has 1.6 times its usual width; what is won counts the change of the density of readings."""
    nominal, _ = nominal_of(tmp_path, lambda x, v, t: 0.0, shown=bent)
    with_known, _ = fit_discrepancy(expand_fit(nominal))
    expansion = expand_fit(with_known)
    promised = expansion.compute_fixed_gain(expansion.inflation)
    once = correct_channels(expansion)
    twice = correct_channels(expand_fit(once.fit), once)
    for right in (once, twice):
        won = right.fit.log_evidence + right.log_jacobian - with_known.log_evidence - right.price
        assert won > 0.7 * promised > 35.0
    square = 1  # scale, square and cube of the sensor come first
    assert twice.sizes[square] == pytest.approx(-0.008, rel=0.1)
    assert np.all(np.abs(np.delete(twice.sizes, square)) < 0.01)


def test_corrections_of_one_set_serve_another(tmp_path):
    """The set that is behind was fitted without corrections: with those of the one ahead it gains as much as by its
    own, so the comparison does not depend on which of the two was corrected first.
    """
    nominal, _ = nominal_of(tmp_path, lambda x, v, t: 0.0, shown=bent)
    own = evaluate_fit(fit_discrepancy(expand_fit(nominal)), nominal)
    assert own.corrected
    evidence, price = own.fit.log_evidence - nominal.log_evidence, own.price - own.corrected.price
    bare = own._replace(evidence=evidence, price=price, corrected=None)
    alike = evaluate_alike(bare, nominal, own.corrected)
    assert alike.corrected.sizes == pytest.approx(own.corrected.sizes)
    assert alike.compute_gain(1.0) == pytest.approx(own.compute_gain(1.0), rel=0.1)
    assert alike.compute_gain(1.0) > bare.compute_gain(1.0) + 20.0


def test_a_channel_is_put_right_as_far_as_flaws_are_usual(tmp_path):
    nominal, _ = nominal_of(tmp_path, lambda x, v, t: 0.0, shown=lambda x: 1.3 * x)
    expansion = expand_fit(nominal)
    once = correct_channels(expansion)
    twice = correct_channels(expand_fit(once.fit), once)
    widths = expansion.widths[-len(once.sizes) :]
    for right in (once, twice):
        assert np.all(np.abs(right.sizes) <= DEFAULT.rival.correction * widths * (1.0 + 1e-12))
    assert np.any(np.abs(twice.sizes) > 0.99 * DEFAULT.rival.correction * widths)


@pytest.mark.parametrize(
    ("key", "extra", "doubted"),
    [
        ("coulomb_friction", bend(0.4), True),
        ("coulomb_friction", lambda x, v, t: bend(0.2)(x, v, t) - 1.0 * np.tanh(v / 1e-3), False),
    ],
)
@pytest.mark.slow
def test_a_term_is_doubted_where_no_model_is_right_and_predictions_do_without_it(tmp_path, key, extra, doubted):
    prepared, system = made_of(tmp_path, extra)
    train, held = split_heldout(prepared.observations)
    nominal = search_maximum(make_problem(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    more = fit_term(nominal, run_score_test(nominal, compute_slopes(nominal), key))
    course = Selection(nominal, more)
    for fit in (nominal, more):
        course.fitted_sets[fit.problem.active] = TermSet(fit.problem.active, fit, fit.log_evidence)
    horizon = choose_heldout_horizon(more, cut_heldout(prepared.observations, held), float("nan"))
    outcome = SimpleNamespace(
        diagnosis=SimpleNamespace(
            selection=course, held=held, named=(key,), after=more, unexplained=False, settings=DEFAULT
        ),
        horizon=horizon,
    )
    told = find_unconfirmed(outcome, prepared.observations)
    assert set(told) == ({key} if doubted else set())
