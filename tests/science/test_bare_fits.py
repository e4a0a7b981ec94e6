"""Fits of sets of terms without a discrepancy, and the processor time that a search may use."""

import time
from dataclasses import replace

import numpy as np
import pytest
from explained import made_of

from lostmotion.evidence import bare
from lostmotion.evidence.bare import BareFits, Budget, name_terms
from lostmotion.evidence.channel_errors import list_channel_errors
from lostmotion.evidence.load_cell import fit_loads
from lostmotion.inference.candidates import join_term
from lostmotion.inference.commoner import rewrite_term
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import maximise, restart
from lostmotion.inference.penalties import compute_price, compute_unknown_price
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.likelihood.work import count_work

NOTHING, FRICTION, LEVELS = frozenset(), frozenset({"coulomb_friction"}), frozenset({"directional_friction"})
KEYS = ("coulomb_friction", "directional_friction", "offset_force", "cubic_stiffness")


def levels(x, v, t):
    """Return dry friction (N) of 0.9 N forwards and 0.7 N backwards, without sticking."""
    return -(0.8 + 0.1 * np.sign(v)) * np.tanh(v / 1e-3)


@pytest.fixture(scope="module")
def nominal(tmp_path_factory):
    prepared, system = made_of(tmp_path_factory.mktemp("levels"), levels)
    train, _ = split_heldout(prepared.observations)
    return search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))


def begin(nominal, *, seconds=600.0, temper=1.0):
    """Return the bare fits of a few terms, with that of no term."""
    errors = list_channel_errors(nominal, list(nominal.posterior.observations))
    whole = nominal.posterior.observations
    return BareFits(
        add_all_curves(nominal), nominal.posterior.system, KEYS, errors, Budget(seconds=seconds), whole, temper
    )


@pytest.fixture(scope="module")
def climbed(nominal):
    fits = begin(nominal)
    fits.climb(fits.budget)
    return fits


def test_a_climb_ends_at_the_set_with_the_largest_weight(climbed):
    weights = {terms: climbed.weigh(fit) for terms, fit in climbed.fits.items()}
    assert weights[climbed.lead] == max(weights.values())
    assert climbed.lead in climbed.refitted
    assert climbed.lead in (LEVELS, FRICTION | {"offset_force"})
    assert weights[climbed.lead] > weights[NOTHING] + 100.0


def test_a_law_that_contains_a_simpler_one_takes_its_place(climbed):
    assert climbed.find_simpler(FRICTION | {"offset_force"}, "directional_friction") == "coulomb_friction"
    assert climbed.find_simpler(FRICTION, "cubic_stiffness") == ""
    assert FRICTION in climbed.fits
    assert FRICTION | LEVELS not in climbed.fits


def test_a_set_without_a_law_may_have_the_simpler_one_in_its_place(climbed):
    offset = frozenset({"offset_force"})
    assert climbed.reduce(LEVELS | offset, "directional_friction") == [offset, FRICTION | offset]
    assert climbed.reduce(LEVELS | offset, "offset_force") == [LEVELS]
    assert climbed.reduce(FRICTION, "coulomb_friction") == [NOTHING]


def test_a_wave_of_the_drive_is_left_out_and_one_of_the_machine_is_not(climbed, monkeypatch):
    gain = frozenset({"excitation_gain"})
    assert climbed.leave_out_waves(FRICTION) == FRICTION
    monkeypatch.setattr(bare, "find_wave", lambda posterior, key: key)
    assert climbed.leave_out_waves(FRICTION | gain) == FRICTION
    assert climbed.leave_out_waves(gain) == NOTHING


def test_a_rich_law_is_rewritten_as_a_sum_of_simple_ones(nominal):
    """The forces are the same: so is the likelihood, and the values are mean and half difference of the levels."""
    fits = begin(nominal)
    start = {"directional_friction.forward": 0.9, "directional_friction.backward": 0.7}
    fits.keep(maximise(join_term(restart(fits.nominal), "directional_friction", start)))
    fits.refit(LEVELS)
    both = fits.fits[FRICTION | {"offset_force"}]
    assert both.log_likelihood == pytest.approx(fits.fits[LEVELS].log_likelihood, abs=1.0)
    assert both.values["coulomb_friction.force"] == pytest.approx(0.8, rel=0.05)
    assert both.values["offset_force.force"] == pytest.approx(-0.1, rel=0.2)


def test_a_law_is_rewritten_beside_one_that_contains_a_part_of_it(nominal):
    """Directional friction beside Stribeck friction is a constant force: Coulomb friction is in the set already."""
    both = join_term(restart(nominal), "stribeck_friction", {"stribeck_friction.force": 0.3})
    start = {"directional_friction.forward": 0.9, "directional_friction.backward": 0.7}
    fit = maximise(join_term(both, "directional_friction", start), tolerance=1e6)
    made = rewrite_term(fit, "directional_friction", (*KEYS, "stribeck_friction"))
    assert made.active == {"stribeck_friction", "offset_force"}


def test_two_laws_that_contain_the_same_simpler_one_are_not_in_one_set(climbed):
    assert climbed._holds(LEVELS, "stribeck_friction")
    assert not climbed._holds(LEVELS, "cubic_stiffness")
    assert not climbed._holds(frozenset({"friction_drift"}), "friction_drift_twice")
    assert climbed._holds(frozenset({"friction_drift_twice"}), "friction_drift")
    assert not climbed._holds(frozenset({"drive_saturation"}), "drive_dead_zone")


@pytest.mark.parametrize("law", ["drive_dead_zone", "drive_saturation"])
def test_a_zone_and_a_limit_of_the_drive_are_compared_with_a_gain(climbed, law):
    """A zone as wide as the drive loses a share of all of it: a gain of -0.78 was named a dead zone with certainty."""
    wider = replace(climbed, keys=(*KEYS, "excitation_gain", law))
    assert frozenset({"excitation_gain"}) in wider.reduce(frozenset({law}), law)


def raised(fit, by):
    """Return a fit with a higher log posterior."""
    return replace(fit, local=replace(fit.local, log_posterior=fit.local.log_posterior + by))


def test_only_the_best_fit_of_a_set_is_kept_and_none_that_diverged(nominal):
    fits = begin(nominal)
    better = raised(fits.nominal, 1.0)
    for other in (raised(fits.nominal, -1.0), replace(better, status="diverged")):
        fits.keep(other)
        assert fits.fits[NOTHING] is fits.nominal
    fits.keep(better)
    assert fits.fits[NOTHING] is better


def test_on_a_part_of_the_samples_the_evidence_counts_for_all_of_them(climbed, nominal):
    """With a quarter of the samples as the temper the evidence counts fourfold, and the price once."""
    part, fit = begin(nominal, temper=0.25), climbed.fits[FRICTION]
    price = compute_price(fit.posterior, len(KEYS))
    assert price > 0.0
    assert part.weigh(fit) == pytest.approx(4.0 * fit.log_evidence - price)
    assert climbed.weigh(fit) == pytest.approx(fit.log_evidence - price)


def test_what_each_law_alone_promises_is_remembered(climbed):
    assert set(climbed.promised) == set(KEYS)
    assert climbed.promised["coulomb_friction"] > 10.0
    assert climbed.promised["cubic_stiffness"] < 3.0


def test_a_climb_without_time_fits_nothing(nominal):
    fits = begin(nominal, seconds=0.0)
    fits.climb(fits.budget)
    assert set(fits.fits) == {NOTHING}


def test_a_budget_is_used_up_by_processor_time_and_not_by_waiting():
    budget = Budget(seconds=0.05)
    time.sleep(0.1)
    assert not budget.spent
    while time.process_time() - budget.since < 0.06:
        sum(range(1000))
    assert budget.spent


def test_a_budget_of_work_does_not_depend_on_the_load_of_the_machine(nominal):
    budget = Budget(steps=1.5 * count_steps(nominal))
    assert not budget.spent
    nominal.posterior.log_likelihood(nominal.theta[None])
    assert not budget.spent
    nominal.posterior.log_likelihood(nominal.theta[None])
    assert budget.spent


def count_steps(fit):
    before = count_work()
    fit.posterior.log_likelihood(fit.theta[None])
    return count_work() - before


def test_a_part_of_a_budget_begins_with_the_whole():
    for budget in (Budget(seconds=10.0, since=time.process_time() - 7.0), Budget(steps=10.0, begun=count_work() - 7)):
        assert not budget.spent
        assert budget.part(0.6).spent
        assert not budget.part(0.8).spent


def test_terms_are_named_in_order_and_an_unknown_force_costs_as_much_as_one_of_many_laws():
    assert name_terms({"b", "a"}) == "a and b"
    assert name_terms(()) == "no term"
    assert compute_unknown_price(20) - compute_unknown_price(10) == pytest.approx(np.log(2.0))
    assert compute_unknown_price(0) == 1.0


def test_forces_of_a_load_cell_are_tried_for_load_cells_only(nominal):
    assert list(fit_loads(nominal, KEYS, lambda _: None)) == []
