"""The next experiment: what is offered, what it is expected to tell, and that it tells so much when it is done."""

import importlib.util
import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_facts import DELAY, FRICTION, make_facts, make_found

from lostmotion.case import Experiment, load_case
from lostmotion.diagnosis import rivals
from lostmotion.diagnosis.excitations import Limits, choose_limits, list_candidates
from lostmotion.diagnosis.experiment import (
    Proposal,
    _select_counted,
    compute_bayes_factor,
    compute_natural_frequency,
    propose,
)
from lostmotion.diagnosis.rehearsal import (
    EvidenceBudget,
    RehearsedModel,
    compute_evidence,
    simulate_recording,
)
from lostmotion.errors import CaseError
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.space import FreeParameter
from lostmotion.noises import AR1_LEVEL, AR1_MEMORY
from lostmotion.results.diagnosis import Confusion

RATE, LEVEL, FREQUENCY = 200.0, 10.0, 2.0
BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "experiment.py"


@pytest.fixture(scope="module")
def bench():
    spec = importlib.util.spec_from_file_location("benchmark_experiment", BENCHMARK)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def springs(bench):
    """The machine with a cubic spring, its recording, and the fits with the true and with the other term."""
    machine = next(m for m in bench.MACHINES if m.truth == "cubic_stiffness")
    rng = np.random.default_rng(0)
    inputs, observation = bench.first(machine, rng)
    return machine, inputs, bench.fitted(machine, observation)


def sine(base=False):
    t = np.arange(2000) / RATE
    omega = 2 * math.pi * FREQUENCY
    value, slope = LEVEL * np.sin(omega * t), LEVEL * omega * np.cos(omega * t)
    inputs = np.stack([value, slope], axis=1) if base else value[:, None]
    return Observation.of("old", np.sin(omega * t), inputs, 1 / RATE, "position", harmonic=DriveHarmonic(omega, LEVEL))


@pytest.mark.parametrize("base", [False, True])
def test_offers_stay_within_the_limits(base):
    observation = sine(base)
    limits = Limits(1.2 * LEVEL, 1.5 * FREQUENCY)
    offered = list_candidates(observation, 800, limits, np.random.default_rng(0))
    assert max(e.level for e in offered) == pytest.approx(1.2 * LEVEL)
    assert max(e.band[1] for e in offered) == pytest.approx(1.5 * FREQUENCY)
    assert {e.waveform for e in offered} == {"harmonic", "two tones", "slow sweep", "random-phase multisine"}
    assert all(e.inputs.shape == (800, 2 if base else 1) for e in offered)


def test_an_offer_has_the_level_that_it_states_and_is_no_repeat():
    observation = sine()
    for e in list_candidates(observation, 2000, choose_limits(observation, FREQUENCY), np.random.default_rng(0)):
        assert math.sqrt(2) * np.std(e.inputs[:, 0]) == pytest.approx(e.level, rel=0.1)
        if e.waveform == "harmonic":
            assert abs(e.level / LEVEL - 1) > 0.05 or abs(e.band[0] / FREQUENCY - 1) > 0.05


def test_the_velocity_of_a_base_is_the_slope_of_its_position():
    for e in list_candidates(sine(base=True), 2000, Limits(2 * LEVEL, 2 * FREQUENCY), np.random.default_rng(0)):
        slope = np.gradient(e.inputs[:, 0], 1 / RATE)[5:-5]
        np.testing.assert_allclose(e.inputs[5:-5, 1], slope, atol=0.02 * np.abs(slope).max())


def test_a_truth_counts_only_where_it_can_show_itself():
    assert _select_counted([(2.0, 60.0), (6.0, 40.0)]) == (1,)
    assert _select_counted([(30.0, 60.0), (6.0, 40.0)]) == (0, 1)
    assert _select_counted([(1.0, 2.0)]) == (0, 1)
    proposal = Proposal(None, (5.0, 60.0), (-1.0, -2.0), (1,))
    assert (proposal.gain, proposal.repeat) == (60.0, 0.0)


@pytest.mark.slow
def test_a_louder_drive_is_taken_to_be_noisier(springs):
    *_, (truth, _) = springs
    observation = truth.posterior.observations[0]
    model = RehearsedModel.of(truth)
    offered = list_candidates(observation, 400, choose_limits(observation, FREQUENCY), np.random.default_rng(0))
    loud = max(offered, key=lambda e: e.level)
    i = truth.posterior.space.keys.index("log_random_force")
    assert model.get_coordinates(loud)[i] - truth.theta[i] == pytest.approx(2 * math.log(2), rel=0.01)
    assert model.pose(loud).space.free[i].low > truth.posterior.space.free[i].low


@pytest.mark.slow
def test_a_model_believes_what_it_has_made(springs):
    """A recording made by either model speaks for it: with a gain of 50 to be expected, no chance."""
    *_, fits = springs
    observation = fits[0].posterior.observations[0]
    models = [RehearsedModel.of(fit) for fit in fits]
    offered = list_candidates(
        observation, observation.samples, choose_limits(observation, FREQUENCY), np.random.default_rng(0)
    )
    loud = next(e for e in offered if e.level > 1.9 * observation.travel and e.waveform == "harmonic")
    for truth, other in (models, models[::-1]):
        z = simulate_recording(truth, loud, np.random.default_rng(1))
        asked = EvidenceBudget(1.0, 4)
        assert compute_evidence(truth, loud, z, asked) > compute_evidence(other, loud, z, asked) + 10.0


@pytest.mark.slow
def test_simulated_noise_has_the_memory_that_was_found(springs):
    """The slow part of the noise fades as it was estimated: 20000 samples know its correlation to 0.01."""
    *_, (truth, _) = springs
    slow = tuple(
        FreeParameter(key, "1", value, -30.0, 30.0) for key, value in ((AR1_LEVEL, 0.0), (AR1_MEMORY, math.log(0.02)))
    )
    observation = replace(sine(), readings=np.zeros((20000, 1)), inputs=np.zeros((20000, 1)))
    posterior = replace(truth.posterior, observations=(observation,)).over((*truth.posterior.space.free, *slow))
    block = replace(posterior.recordings[0].noise(posterior.space.start), white=0.0)
    noise = block.draw(np.zeros(20000), np.random.default_rng(0))
    assert noise.std() == pytest.approx(1.0, abs=0.05)
    assert math.sqrt(block.variance_after(9999)) == pytest.approx(1.0, abs=1e-9)
    assert np.corrcoef(noise[1:], noise[:-1])[0, 1] == pytest.approx(math.exp(-1 / RATE / 0.02), abs=0.02)
    assert not truth.posterior.recordings[0].noise(truth.theta).shown.any()


@pytest.mark.slow
def test_a_machine_that_runs_away_is_not_proposed(springs):
    *_, (truth, _) = springs
    observation = truth.posterior.observations[0]
    offered = list_candidates(observation, 400, choose_limits(observation, FREQUENCY), np.random.default_rng(0))
    mad = replace(offered[0], inputs=1e12 * offered[0].inputs)
    assert simulate_recording(RehearsedModel.of(truth), mad, np.random.default_rng(0)) is None


@pytest.mark.slow
def test_proposed_experiment_separates_springs_and_a_repeat_hardly(bench, springs):
    """Cubic or linear spring: at one level the one stands in for the other. Expected 108 and 15; found 100 and 11."""
    machine, inputs, (truth, other) = springs
    steps = []
    proposal = propose(truth, other, rng=np.random.default_rng(2), say=steps.append)
    assert steps
    assert proposal.excitation.level > 1.3 * machine.level
    assert proposal.gain > 3.0 * proposal.repeat
    rng = np.random.default_rng(3)
    found = compute_bayes_factor(truth, other, bench.recorded(machine, proposal.excitation.inputs[:, 0], rng))
    again = compute_bayes_factor(truth, other, bench.recorded(machine, inputs, rng))
    assert found > 2.0 * max(again, 1.0)
    assert found == pytest.approx(proposal.ways[0], rel=0.5)
    assert compute_natural_frequency(truth) == pytest.approx(machine.frequency, rel=0.5)


@pytest.mark.slow
def test_proposed_experiment_shows_a_stribeck_effect_that_the_recording_does_not(bench):
    """At hand the wrong law is 2 ahead; a repeat adds 0 to 2, the proposed experiment 30 to 36. One fixed machine."""
    r = bench.studied(bench.MACHINES[0], draws=2)
    assert abs(r["at_hand"]) < 6.0
    assert min(r["found"]) > 15.0
    assert np.mean(r["found"]) > 2.5 * np.mean(r["found_repeat"])


CASE = """
[[recordings]]
file = "r.csv"
time = "t"
excitation = { column = "u", quantity = "force", unit = "N" }
response = { column = "x", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[experiment]
"""


def test_limits_are_read_from_the_case(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE + "max_level = 150.0\nmax_frequency = 12\n")
    assert load_case(path).experiment.max_level == 150.0
    assert load_case(path).experiment.max_frequency == 12.0


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("max_levle = 3.0", "did you mean 'max_level'"),
        ("max_level = -1", "positive"),
        ("max_frequency = 'x'", "number"),
    ],
)
def test_limits_that_cannot_be_meant_are_refused(tmp_path, line, says):
    path = tmp_path / "case.toml"
    path.write_text(CASE + line)
    with pytest.raises(CaseError, match=says):
        load_case(path)


RUB, LATE = (frozenset({name}) for name in (FRICTION, DELAY))
DRIVEN = Observation.of(
    "driven",
    np.sin(2.0 * np.pi * FREQUENCY * np.arange(400) / RATE),
    LEVEL * np.cos(2.0 * np.pi * FREQUENCY * np.arange(400) / RATE)[:, None],
    1.0 / RATE,
    "position",
)


def facts_of(sets, **changes):
    """Return the facts of a diagnosis that found friction, with these probabilities of sets."""
    return make_facts(make_found(FRICTION), sets=sets, **changes)


@pytest.mark.parametrize(("share", "named"), [(1.0 / 55.0, True), (1.0 / 148.0, False)])
def test_a_rival_has_a_probability_that_is_worth_telling(share, named):
    """A hundredth is."""
    assert rivals.find_rivals(facts_of({RUB: 1.0 - share, LATE: share})) == ({DELAY: LATE} if named else {})


def test_there_is_no_rival_where_a_curve_was_learned_or_beside_an_unknown_force():
    assert rivals.find_rivals(facts_of({RUB: 0.7, LATE: 0.3}, learned=True)) == {}
    assert rivals.find_rivals(facts_of({RUB: 0.7, LATE | {UNKNOWN}: 0.3})) == {}


def test_a_rival_is_named_with_the_experiment_that_decides():
    offered = list_candidates(DRIVEN, 100, choose_limits(DRIVEN, FREQUENCY), np.random.default_rng(0))
    proposals = {DELAY: Proposal(max(offered, key=lambda e: e.level), (40.0, 50.0), (4.0, 6.0), (0, 1))}
    rows = [Confusion(mechanism=name, at=at, says="") for name, at in ((DELAY, "force"), ("sensor_delay", ""))]
    facts = facts_of({RUB: 0.7, LATE: 0.3})
    rows[0] = replace(rows[0], at=facts.find(DELAY).term.at)
    first, second = rivals.describe_confusions(facts, rows, proposals)
    assert second.mechanism == "sensor_delay"
    assert first.excitation.expected_log_gain == 40.0
    assert first.excitation.unit == "N"
    assert "has a probability of 0.30" in first.says
    assert "Raise the drive to 20 N at" in first.says
    assert first.says.endswith("this should distinguish them by 40 in log evidence, 10 times as much as a repetition.")


def test_without_an_experiment_that_decides_it_says_so():
    offered = list_candidates(DRIVEN, 100, choose_limits(DRIVEN, FREQUENCY), np.random.default_rng(0))
    proposals = {DELAY: Proposal(offered[0], (1.0, 0.5), (0.0, 0.0), (0, 1))}
    (only,) = rivals.describe_confusions(facts_of({RUB: 0.7, LATE: 0.3}), [], proposals)
    assert "No excitation within the limits" in only.says


def test_no_rival_no_experiment():
    facts = facts_of({RUB: 1.0})
    assert rivals.propose_experiments(facts, {}, Experiment(), rng=np.random.default_rng(0)) == {}
