"""What is named in machines whose flaws are usual, and how the explanations are averaged."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from explained import VALUES, bend, explain_machine, made_of

from lostmotion.diagnosis.compare import cut_heldout
from lostmotion.diagnosis.gather_facts import _widen_vague, list_reaching
from lostmotion.diagnosis.nested_laws import find_simpler_set
from lostmotion.diagnosis.stages import diagnose, explain_by
from lostmotion.diagnosis.unknowns import make_learned_entry
from lostmotion.evidence.corrections import find_corrections
from lostmotion.evidence.explanations import Explanations
from lostmotion.evidence.heldout import score_heldout
from lostmotion.evidence.hypothesis import UNKNOWN, list_vague
from lostmotion.inference.candidates import fit_term, join_term
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.setup import split_heldout
from lostmotion.results import Interval

FRICTIONS = {"coulomb_friction", "stribeck_friction", "dahl_friction", "lugre_friction", "directional_friction"}
SURE = 0.95
NOTHING, FRICTION, CURVES = frozenset(), frozenset({"coulomb_friction"}), frozenset({UNKNOWN})
STRIBECK = frozenset({"stribeck_friction"})


def nothing(x, v, t):
    """Return no force (N)."""
    return 0.0


def rub(x, v, t):
    """Return dry friction of 0.8 N (N), without sticking."""
    return -0.8 * np.tanh(v / 1e-3)


def bent(x):
    """Return what a sensor shows that is bent by 0.8 % of its range, evenly."""
    return x + 0.008 * np.abs(x).max() * (x / np.abs(x).max()) ** 2


@pytest.fixture(scope="module")
def rubbing(tmp_path_factory):
    """The explanations of an oscillator with dry friction of 0.8 N."""
    return explain_machine(tmp_path_factory.mktemp("rubbing"), rub)


def with_scores(explained, scores):
    """Return explanations with these scores by set, of hypotheses that are otherwise that of nothing missing."""
    bare = explained.found[NOTHING]
    made = {}
    for terms, score in scores.items():
        frame = replace(bare.frame, posterior=bare.frame.posterior.acting(terms - {UNKNOWN}))
        made[terms] = replace(
            bare, frame=frame, log_evidence=score, heldout=0.0, price=0.0, unknown=UNKNOWN in terms, smooth=0.0
        )
    return Explanations(explained.fits, made)


def test_friction_is_the_best_explanation_and_it_has_the_probability_of_a_name(rubbing):
    assert rubbing.terms == FRICTION
    assert rubbing.inclusion("coulomb_friction") > SURE
    assert rubbing.chosen is rubbing.fits[FRICTION]
    assert rubbing.chosen.values["coulomb_friction.force"] == pytest.approx(0.8, rel=0.1)


def test_probabilities_are_one_in_sum_and_those_of_terms_are_sums_over_sets(rubbing):
    assert sum(rubbing.probabilities.values()) == pytest.approx(1.0)
    for key in {key for terms in rubbing.found for key in terms}:
        wanted = sum(p for terms, p in rubbing.probabilities.items() if key in terms)
        assert rubbing.inclusion(key) == pytest.approx(wanted)
    assert rubbing.inclusion("no_such_term") == 0.0


def test_the_gain_of_a_term_is_its_evidence_beside_a_discrepancy(rubbing):
    alone, bare = rubbing.found[FRICTION], rubbing.found[NOTHING]
    wanted = alone.log_evidence + alone.heldout - bare.log_evidence - bare.heldout
    assert rubbing.gain("coulomb_friction") == pytest.approx(wanted)
    assert rubbing.gain_beside("coulomb_friction") == pytest.approx(alone.score() - bare.score())
    unfitted = next(key for key in rubbing.promised if frozenset({key}) not in rubbing.found)
    assert rubbing.gain(unfitted) == rubbing.promised[unfitted]


@pytest.mark.parametrize("terms", [NOTHING, FRICTION])
def test_the_filter_forgets_what_lies_far_before_held_out_data(rubbing, tmp_path, monkeypatch, terms):
    """Their density is the same whether it begins with the recording, or by a tenth of it before them."""
    prepared, _ = made_of(tmp_path, rub)
    pieces = cut_heldout(prepared.observations, split_heldout(prepared.observations)[1])
    pairs = [(piece.observation, piece.begin) for piece in pieces]
    short = score_heldout(rubbing.found[terms], pairs)
    monkeypatch.setattr("lostmotion.evidence.heldout.LEAD", 1.0)
    assert short == pytest.approx(score_heldout(rubbing.found[terms], pairs), abs=0.1)


@pytest.mark.parametrize(("deviations", "vague"), [(1.0, ["force"]), (4.0, [])])
def test_an_amplitude_whose_region_reaches_zero_is_vague(rubbing, deviations, vague):
    """Its stated interval then reaches zero as well, where draws stop at a bound."""
    best = rubbing.best
    at, place = best.at.copy(), best.frame.names.index("coulomb_friction.force")
    at[place] = deviations * np.sqrt(best.scatter * best.covariance[place, place])
    moved = replace(best, expansion=replace(best.expansion, at=at))
    assert list_vague(moved, "coulomb_friction") == vague
    told = {"coulomb_friction.force": Interval(0.8, 0.1, 1.5, "N"), "c": Interval(8.0, 7.0, 9.0, "N s/m")}
    made = _widen_vague(moved, ["coulomb_friction"], told)
    assert (made["coulomb_friction.force"].low == 0.0) == bool(vague)
    assert made["c"] == told["c"]


@pytest.mark.parametrize(("low", "vague"), [(-0.1, ["force"]), (0.1, [])])
def test_an_amplitude_whose_stated_interval_reaches_zero_is_vague_as_well(rubbing, low, vague):
    told = {"coulomb_friction.force": Interval(0.8, low, 1.5, "N")}
    assert list(list_reaching(rubbing.chosen.posterior, "coulomb_friction", told)) == vague


@pytest.mark.parametrize(("low", "vague"), [(-0.1, ["cosine and sine"]), (0.1, [])])
def test_a_wave_is_vague_where_the_intervals_of_both_amplitudes_reach_zero(rubbing, low, vague):
    told = {"cogging.cosine": Interval(0.1, -0.2, 0.4, "N"), "cogging.sine": Interval(0.3, low, 0.6, "N")}
    assert list(list_reaching(rubbing.chosen.posterior, "cogging", told)) == vague


def test_a_law_gives_its_probability_to_a_simpler_one(rubbing):
    made = with_scores(rubbing, {NOTHING: 0.0, FRICTION: 500.0, STRIBECK: 505.0})
    assert made.terms == STRIBECK
    assert made.is_close(FRICTION, 8.0)
    assert not made.is_close(FRICTION, 3.0)
    less = made.simplify(FRICTION)
    assert less.terms == FRICTION
    assert less.inclusion("coulomb_friction") == pytest.approx(1.0)
    assert less.inclusion("stribeck_friction") == 0.0


@pytest.mark.parametrize(
    ("low", "score", "simpler"),
    [(-1.0, 500.0, FRICTION), (0.5, 500.0, None), (-1.0, 400.0, None)],
    ids=["not told from zero", "told from zero", "the simpler law is refuted"],
)
def test_of_nested_laws_the_simplest_that_is_not_refuted_is_the_name(rubbing, low, score, simpler):
    """All parameters have draws from `low` to 2 in their units, also the excess of Stribeck friction."""
    made = with_scores(rubbing, {NOTHING: 0.0, FRICTION: score, STRIBECK: 505.0})
    posterior = join_term(rubbing.nominal.posterior, "stribeck_friction", {})
    after = SimpleNamespace(posterior=posterior)
    draws = np.tile(np.linspace(low, 2.0, 201)[:, None], (1, len(posterior.space.free)))
    outcome = SimpleNamespace(diagnosis=SimpleNamespace(explained=made, after=after), draws_after=draws)
    assert find_simpler_set(outcome) == simpler


def test_a_refuted_set_has_no_probability_and_the_next_one_is_the_best(rubbing):
    less = rubbing.refute()
    assert FRICTION not in less.probabilities
    assert less.terms != FRICTION
    assert sum(less.probabilities.values()) == pytest.approx(1.0)
    assert less.refute().refuted == {FRICTION, less.terms or CURVES}


def test_curves_beside_no_term_are_refuted_alone(rubbing):
    """That nothing is missing stays an explanation: no term has its probability because a curve failed."""
    made = with_scores(rubbing, {NOTHING: 20.0, FRICTION: 0.0})
    less = made.refute()
    assert less.refuted == {CURVES}
    assert less.probabilities == made.probabilities


def test_a_force_that_a_smooth_force_of_the_usual_size_explains_as_well_is_learned(tmp_path):
    """It has no name, and neither the nominal model nor a term describes it: a curve does."""
    prepared, system = made_of(tmp_path, bend(0.3))
    few = replace(system, terms=tuple(term for term in system.terms if term.name == "coulomb_friction"))
    found = diagnose(prepared.case, prepared.observations, few, rng=np.random.default_rng(0), jobs=1)
    assert found.explained.best.terms == NOTHING
    assert [term.over for term in found.learned.terms] == ["position"]
    assert has_usual_random_force(found.after)
    entry = make_learned_entry(found)
    assert entry.probability == pytest.approx(found.learned.probability, abs=1e-6)
    assert entry.probability > SURE
    assert "as well" not in entry.says
    tied = replace(found, explained=with_scores(found.explained, {NOTHING: math.log(0.6), FRICTION: math.log(0.4)}))
    entry = make_learned_entry(tied)
    assert entry.probability == pytest.approx(0.6, abs=1e-3)
    assert entry.says.endswith("It may be Coulomb friction as well, with the probability 0.4.")
    assert "no term of the library" not in entry.says
    less = explain_by(found.explained.refute(), found, np.random.default_rng(0))
    assert less.learned is None
    assert less.found == ()


def test_an_unknown_force_beside_a_refuted_set_is_refuted_with_it(rubbing):
    made = with_scores(rubbing, {NOTHING: 0.0, FRICTION: 20.0, FRICTION | {UNKNOWN}: 19.0, frozenset({UNKNOWN}): 5.0})
    assert made.terms == FRICTION
    less = made.refute()
    assert set(less.probabilities) == {NOTHING, frozenset({UNKNOWN})}
    assert less.best.terms == {UNKNOWN}
    assert less.terms == NOTHING


def test_the_probability_of_a_set_is_the_softmax_of_scores_over_the_scatter_of_the_best(rubbing):
    made = with_scores(rubbing, {NOTHING: 0.0, FRICTION: 6.0})
    wide = made.found[FRICTION]
    wide.__dict__["scatter"] = 3.0
    assert made.probabilities[FRICTION] == pytest.approx(1.0 / (1.0 + math.exp(-2.0)))


def test_draws_are_averaged_over_hypotheses_by_probability(rubbing):
    """A third of the draws is from a machine with half the damping; 4,000 draws know that to 0.03. Seeded."""
    made = with_scores(rubbing, {NOTHING: math.log(2.0), FRICTION: 0.0})
    free = [f.key for f in made.found[NOTHING].frame.posterior.space.free]
    other = made.found[FRICTION]
    at = other.expansion.at.copy()
    at[free.index("c")] -= math.log(2.0)
    found = {NOTHING: made.found[NOTHING], FRICTION: replace(other, expansion=replace(other.expansion, at=at))}
    for one in found.values():
        one.__dict__["scatter"] = 1.0
    mixed = Explanations(made.fits, found)
    middle = next(f for f in other.frame.posterior.space.free if f.key == "c").value(
        at[free.index("c")] + 0.5 * math.log(2.0)
    )
    drawn = mixed.draw(["c", "coulomb_friction.force"], 4000, np.random.default_rng(0))
    assert np.mean(drawn[:, 0] < middle) == pytest.approx(1.0 / 3.0, abs=0.03)
    assert np.isnan(drawn[:, 1]).all()


def test_a_clean_machine_has_no_term_and_no_correction(tmp_path):
    """One seeded recording. What is not named has no influence on the values of the machine."""
    found = explain_machine(tmp_path, nothing)
    assert found.terms == NOTHING
    assert found.probabilities[NOTHING] > 0.9
    assert not find_corrections(found.best)


def test_a_known_value_that_is_slightly_wrong_gets_no_name(tmp_path):
    """Beside known values and channels that do not err, a gain of the drive would be named."""
    found = explain_machine(tmp_path, nothing, stated=1.01)
    gained = fit_term(found.nominal, "excitation_gain", {"excitation_gain.error": 0.01})
    assert gained.log_likelihood > found.nominal.log_likelihood + 20.0
    assert found.terms == NOTHING
    assert found.probabilities[NOTHING] > SURE


def test_a_bent_sensor_gets_no_name_and_is_corrected(tmp_path):
    """The flaw has 1.6 times its usual width."""
    found = explain_machine(tmp_path, nothing, shown=bent)
    assert found.terms == NOTHING
    right = find_corrections(found.best)
    _, square, cube, *_ = [size for _, size in right.errors]  # the scale of the sensor comes first
    assert square == pytest.approx(-0.008, rel=0.1)
    assert abs(cube) < 0.001
    assert right.refit(found.nominal).log_likelihood > found.nominal.log_likelihood + 35.0
    drawn = found.draw(["c", "k"], 2000, np.random.default_rng(0))
    for column, key in zip(drawn.T, ("c", "k"), strict=True):
        low, high = np.quantile(column, [0.005, 0.995])
        assert low <= VALUES[key] <= high


@pytest.mark.slow
@pytest.mark.parametrize("size", [0.25, 0.4])
def test_a_smooth_force_that_the_library_lacks_gets_no_name(tmp_path, size):
    found = explain_machine(tmp_path, bend(size))
    assert found.found[NOTHING].smooth > 20.0
    assert [key for key in sorted({k for terms in found.found for k in terms} - {UNKNOWN})
            if found.inclusion(key) > SURE] == []  # fmt: skip


@pytest.mark.slow
def test_friction_is_named_beside_a_smooth_force(tmp_path):
    found = explain_machine(tmp_path, lambda x, v, t: bend(0.2)(x, v, t) - 1.0 * np.tanh(v / 1e-3))
    assert found.terms <= FRICTIONS
    assert len(found.terms) == 1
    assert found.inclusion(next(iter(found.terms))) > SURE
