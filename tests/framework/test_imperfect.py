"""The blind trial in an imperfect world: what is concealed there, how sure names are judged, what the page says."""

import json
import tomllib
from dataclasses import replace

import answers
import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion.codec import from_plain, to_plain
from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion_trials.blind import judging
from lostmotion_trials.blind import score as proof
from lostmotion_trials.blind.commitment import Blind, conceal_case
from lostmotion_trials.blind.imperfect import (
    CYCLE,
    EFFECT_SIZES,
    FITTED,
    IMPACTS,
    KINDS,
    SMOOTH_SIZES,
    STEPS,
    SWEEP,
    _compute_timed_force,
    draw_effect,
    draw_machine,
    draw_world,
    follow_motion,
    record_imperfect,
)
from lostmotion_trials.blind.mechanisms import NAMES, Pilot
from lostmotion_trials.blind.page import render
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.blind.results import Proof
from lostmotion_trials.blind.sealed import SealedMachine, SealedTruth
from lostmotion_trials.blind.simulator import BlindDrive, Disturbances, simulate_machine
from lostmotion_trials.integrators.hidden import Hidden
from lostmotion_trials.integrators.imperfect import CELLS, REACH
from lostmotion_trials.rates import estimate_rate
from lostmotion_trials.sealing import format_case_name

SHORT = 600
ROUGH = Blind(most=SHORT, world="imperfect")


def sealed(out, number=0):
    return from_plain(
        SealedTruth, json.loads((out / "sealed" / f"{format_case_name(number)}.json").read_text(encoding="utf-8"))
    )


def told(out, number=0):
    return tomllib.loads((out / "cases" / format_case_name(number) / "case.toml").read_text(encoding="utf-8"))


def machine(kind, seed, samples=SHORT):
    """Return a pilot and the flaws of its world, the first of this seed whose motion keeps within bounds."""
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    while True:
        rig = draw_machine(kind, rng, samples)
        pilot = Pilot(rig, simulate_machine(rig, Hidden(), Disturbances(), rng))
        if pilot.rig.model != "lin_backlash" or pilot.contact_sign.any():
            return pilot, draw_world(kind, pilot, rng), rng


@pytest.fixture(scope="module")
def ten(tmp_path_factory):
    """Return the folder of ten cases: two of each kind of drive."""
    out = tmp_path_factory.mktemp("rough")
    for number in range(10):
        conceal_case(ROUGH, out, number)
    return out


@pytest.mark.slow
def test_kinds_of_drives_take_turns(ten):
    kinds = [sealed(ten, number).world.kind for number in range(10)]
    assert kinds == [*KINDS, *KINDS]


@pytest.mark.slow
def test_every_kind_makes_a_case_that_can_be_diagnosed(ten):
    for number in range(10):
        case, truth = told(ten, number), sealed(ten, number)
        table = np.loadtxt(ten / "cases" / format_case_name(number) / "recording.csv", delimiter=",", skiprows=1)
        assert np.isfinite(table).all()
        assert table.shape == (truth.machine.samples, 3)
        assert np.std(table[:, 1]) > 0.0
        assert np.std(table[:, 2]) > 0.0
        assert set(case["model"]["known"]) | set(case["model"]["estimate"]) == set(truth.machine.values)
        assert "world" not in case


@pytest.mark.slow
def test_seed_reproduces_and_another_does_not(ten, tmp_path):
    first = {number: conceal_case(ROUGH, tmp_path / "again", number).digests for number in (3, 7)}
    other = {number: conceal_case(replace(ROUGH, seed=1), tmp_path / "other", number).digests for number in (3, 7)}
    for number in (3, 7):
        for name in ("case.toml", "recording.csv"):
            same = (tmp_path / "again" / "cases" / format_case_name(number) / name).read_bytes()
            assert same == (ten / "cases" / format_case_name(number) / name).read_bytes()
        assert first[number] != other[number]


@pytest.mark.slow
def test_known_values_are_off_by_a_tenth_of_a_per_cent_to_one(ten):
    seen = []
    for number in range(10):
        truth = sealed(ten, number).machine
        for name, value in told(ten, number)["model"]["known"].items():
            if truth.values[name]:
                seen.append(value / truth.values[name] - 1.0)
            else:
                assert value == 0.0
    assert 0.00099 < np.abs(seen).min() < np.abs(seen).max() < 0.0101
    assert min(seen) < 0.0 < max(seen)


@pytest.mark.slow
def test_readings_lie_on_a_lattice(ten):
    for number in range(10):
        truth = sealed(ten, number)
        hidden = [dict(e.parameters)["step"] for e in truth.effects if e.mechanism == "sensor_quantisation"]
        step = hidden[0] if hidden else truth.world.step * truth.machine.measurement_noise
        shown = np.loadtxt(ten / "cases" / format_case_name(number) / "recording.csv", delimiter=",", skiprows=1)[:, 2]
        assert np.abs(shown / step - np.round(shown / step)).max() < 1e-3


@pytest.mark.parametrize("kind", [KINDS[0], *(pytest.param(kind, marks=pytest.mark.slow) for kind in KINDS[1:])])
def test_smooth_forces_over_the_motion_have_their_size_and_no_straight_line(kind):
    """To within 5 %: a curve is constant beyond three deviations of the motion."""
    found = 0
    for seed in range(8):
        pilot, world, _ = machine(kind, seed)
        for over, moves in (("position", pilot.q), ("velocity", pilot.v)):
            for blemish in (b for b in world.smooth if b.over == over):
                z: Array = moves / world.flaws[over]
                force = np.interp(z, np.linspace(-REACH, REACH, CELLS + 1), world.curves[over])
                line = np.polyfit(z, force, 1)
                assert np.std(force) == pytest.approx(blemish.rms, rel=0.05)
                assert np.abs(line).max() < 0.05 * blemish.rms
                found += 1
    assert found >= 5


def test_smooth_forces_have_no_straight_line_over_the_motion_with_what_is_hidden():
    """A drive of which a fifth acts moves the machine five times less; its curves then had a constant of 5 % of it."""
    found = 0
    for seed in range(8):
        pilot, world, rng = machine(KINDS[0], seed)
        small = Pilot(pilot.rig, simulate_machine(pilot.rig, Hidden(), Disturbances(excitation_gain=-0.8), rng))
        told = follow_motion(world, small, rng)
        for blemish in (b for b in world.smooth if b.over == "position"):
            places = np.linspace(-REACH, REACH, CELLS + 1)
            before, after = (
                np.interp(small.q / w.flaws["position"], places, w.curves["position"]) for w in (world, told)
            )
            assert abs(np.mean(after)) < 0.05 * blemish.rms
            assert np.std(after) == pytest.approx(blemish.rms, rel=0.05)
            found += abs(np.mean(before)) > 0.5 * blemish.rms
    assert found >= 2


@pytest.mark.parametrize("kind", [KINDS[0], *(pytest.param(kind, marks=pytest.mark.slow) for kind in KINDS[1:])])
def test_the_level_of_friction_is_one_and_has_no_slope_over_the_speed(kind):
    """Or the true friction and damping would not be defined; the level still changes by a few per cent."""
    for seed in range(8):
        pilot, world, _ = machine(kind, seed)
        z: Array = np.abs(pilot.v) / world.flaws["velocity"]
        level = np.interp(z, np.linspace(-REACH, REACH, CELLS + 1), world.curves["friction"])
        assert np.polyfit(z, level, 1) == pytest.approx([0.0, 1.0], abs=0.02)
        assert 0.002 < np.std(level) < 0.4


def test_smooth_forces_over_phase_have_their_size():
    found = 0
    for seed in range(8):
        pilot, world, _ = machine(CYCLE, seed)
        for blemish in (b for b in world.smooth if b.over == "phase"):
            force = _compute_timed_force(replace(world, smooth=(blemish,)), pilot.rig, pilot.rig.time)
            assert np.sqrt(np.mean(force**2)) == pytest.approx(blemish.rms, rel=0.15)
            found += 1
    assert found >= 2


@pytest.mark.slow
def test_smooth_forces_over_time_have_their_size_and_no_mean_before_nor_in_what_is_held_out():
    found = 0
    for seed in range(20):
        pilot, world, _ = machine(SWEEP, seed, 500)
        for blemish in (b for b in world.smooth if b.over == "time"):
            force = _compute_timed_force(replace(world, smooth=(blemish,)), pilot.rig, pilot.rig.time)
            fitted = round(FITTED * len(force))
            assert np.std(force) == pytest.approx(blemish.rms, rel=0.02)
            assert abs(np.mean(force[:fitted])) < 0.02 * blemish.rms
            assert abs(np.mean(force[fitted:])) < 0.02 * blemish.rms
            found += 1
    assert found >= 5


@pytest.mark.slow
def test_all_smooth_forces_together_are_a_small_share_of_the_drive():
    for kind in KINDS:
        for seed in range(4):
            pilot, world, _ = machine(kind, seed)
            drive = np.inf if pilot.rig.based else pilot.rig.signal.amplitude
            share = np.linalg.norm([b.rms for b in world.smooth]) / min(drive, np.sqrt(2.0) * pilot.inertial_force)
            assert SMOOTH_SIZES[0] <= share * 1.0000001
            assert share <= SMOOTH_SIZES[1] * 1.0000001
            assert kind == CYCLE or "phase" not in {b.over for b in world.smooth}


def test_a_hidden_step_is_that_of_the_recording():
    """Each machine has a step; one that is hidden takes its place, and is what an answer is compared with."""
    pilot, world, rng = machine(CYCLE, 2, 3000)
    step = 0.01 * float(np.std(pilot.q))
    shown, _ = record_imperfect(pilot.rig, pilot.q, world, rng, hidden_step=step)
    assert np.array_equal(shown, step * np.round(shown / step))


def test_noise_has_its_deviation_and_the_sensor_is_bent_by_half_a_per_cent_at_most():
    for kind in (CYCLE, IMPACTS):
        pilot, world, rng = machine(kind, 2, 3000)
        still = replace(world, hum=0.0, step=1e-6, bend=(0.0, 0.0))
        shown, noise = record_imperfect(pilot.rig, pilot.q, still, rng)
        assert np.std(shown - pilot.q) == pytest.approx(noise, rel=0.1)
        silent = replace(pilot.rig, noise=1e-9)
        shown, _ = record_imperfect(silent, pilot.q, replace(world, step=1e-6, bend=(0.005, -0.005)), rng)
        z = (pilot.q - pilot.q.mean()) / (np.sqrt(2.0) * np.std(pilot.q))
        assert np.abs(shown - pilot.q).max() <= 0.0051 * np.sqrt(2.0) * np.std(pilot.q) * np.max(z**2 + np.abs(z) ** 3)
        assert np.abs(shown - pilot.q).max() > 0.001 * np.std(pilot.q)


def test_hidden_force_is_a_share_of_that_of_inertia():
    for kind in (CYCLE, STEPS):
        pilot, _, rng = machine(kind, 1)
        forces = [dict(draw_effect("offset_force", pilot, rng).parameters)["force"] for _ in range(50)]
        shares = np.array(forces) / pilot.inertial_force
        assert EFFECT_SIZES[0] <= np.abs(shares).min()
        assert np.abs(shares).max() <= EFFECT_SIZES[1]
        assert min(shares) < 0.0 < max(shares)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_every_mechanism_can_be_hidden_under_one_cycle(name, tmp_path):
    conceal_case(replace(ROUGH, only=(name,), most=500), tmp_path, 0)
    assert [one.mechanism for one in sealed(tmp_path).effects] == [name]


def test_what_cannot_be_hidden_under_a_drive_is_refused(tmp_path):
    only = replace(ROUGH, only=("parametric_stiffness",))
    conceal_case(only, tmp_path, 0)
    with pytest.raises(DataError, match="parametric_stiffness cannot be hidden in a machine under impacts: name more"):
        conceal_case(only, tmp_path, KINDS.index(IMPACTS))


def test_world_that_does_not_exist_is_refused():
    with pytest.raises(DataError, match="no world is called 'flat': there are perfect, imperfect"):
        Blind(world="flat").check()


def entry(mechanism, at="ground", probability=0.99, **more):
    return answers.entry(mechanism, at, probability, **more)


def effect(mechanism, at="ground"):
    return Effect(mechanism, at, {})


def judge(found, *effects, model="lin_backlash", errors=(0.2, 0.1)):
    machine = SealedMachine(model, {}, (), BlindDrive(((1.0, 1.0, 0.0),)), 1.0, 1, 0.0, measurement_noise=0.0)
    truth = SealedTruth(schema="s", case="000", salt="", variant="plain", effects=effects, machine=machine)
    said = answers.answer(found=list(found), ranking=list(found), errors=errors)
    return judging._score_imperfect(said, truth, CYCLE)


@pytest.mark.parametrize("law", judging.FRICTION_TERMS)
@pytest.mark.parametrize("said", ["coulomb_friction", "bouc_wen_hysteresis"])
def test_any_law_of_friction_names_friction(law, said):
    case = judge([entry(said)], effect(law))
    assert case.sure == ((said, True),)
    assert case.answer.effects[0].outcome == judging.HIT
    assert case.answer.effects[0].sure
    assert case.answer.stated == ((0.99, 1.0),)
    assert case.answer.false == ()


def test_friction_at_another_place_is_not_there():
    case = judge([entry("dahl_friction", "ground")], effect("coulomb_friction", "base"), model="robot_joint")
    assert case.sure == (("dahl_friction", False),)
    assert not case.answer.effects[0].sure


def test_friction_where_a_spring_is_hidden_is_not_there():
    case = judge([entry("coulomb_friction")], effect("cubic_stiffness"))
    assert case.sure == (("coulomb_friction", False),)
    assert case.answer.false == ("coulomb_friction",)
    assert case.answer.stated == ((0.99, 0.0),)


def test_quantisation_is_on_every_machine_and_names_nothing_that_is_hidden():
    case = judge([entry("sensor_quantisation", "sensor")], effect("coulomb_friction"))
    assert case.sure == (("sensor_quantisation", True),)
    assert case.answer.effects[0].outcome != judging.HIT
    assert not case.answer.effects[0].sure


@pytest.mark.parametrize("unsure", [{"probability": 0.94}, {"state": "likely"}, {"state": "open"}])
def test_what_is_not_stated_with_more_than_95_per_cent_is_not_sure(unsure):
    case = judge([entry("coulomb_friction", **unsure)], effect("coulomb_friction"))
    assert case.sure == ()
    assert case.answer.effects[0].outcome == judging.HIT
    assert not case.answer.effects[0].sure


def test_unknown_is_neither_right_nor_false():
    case = judge([entry("unknown"), entry("random_force")], effect("coulomb_friction"))
    assert (case.sure, case.answer.false) == ((), ())
    assert case.answer.effects[0].outcome == judging.NOTICED


def test_rise_of_the_held_out_error_is_told():
    assert judge([], effect("gap_drift"), errors=(0.1, 0.3)).worse == pytest.approx(0.2)
    assert np.isnan(judge([], effect("gap_drift"), errors=(None, 0.3)).worse)


def rows():
    """Return what became of machines, two kinds of drives, in the order of their cases."""
    friction, spring = effect("coulomb_friction"), effect("cubic_stiffness")
    told = [
        (CYCLE, judge([entry("dahl_friction")], friction)),
        (CYCLE, judge([entry("gap_drift")], spring, errors=(0.1, 0.3))),
        (SWEEP, judge([entry("cubic_stiffness"), entry("sensor_quantisation", "sensor")], spring)),
        (SWEEP, judge([entry("unknown")], friction)),
        (SWEEP, judge([entry("unknown")])),
        (SWEEP, judge([entry("offset_force")])),
    ]
    return [replace(case, kind=kind, case=format_case_name(k)) for k, (kind, case) in enumerate(told)]


def test_summary_rates_sure_names_by_kind():
    found = proof.summarise(rows(), [])
    every, cycle, sweep = found.sure
    assert [row.kind for row in found.sure] == ["all", CYCLE, SWEEP]
    assert (every.machines, every.rate.hits, every.rate.of) == (6, 3, 5)
    assert (cycle.machines, cycle.rate.hits, cycle.rate.of) == (2, 1, 2)
    assert (sweep.machines, sweep.rate.hits, sweep.rate.of) == (4, 2, 3)
    assert (every.named.hits, every.named.of) == (2, 4)
    assert (every.worse.hits, every.worse.of) == (1, 6)
    assert every.rate.low == estimate_rate(3, 5).low
    assert {(row.truth, row.answer) for row in found.confusion} == {
        ("coulomb_friction", "dahl_friction"), ("cubic_stiffness", "gap_drift"), ("nothing", "unknown"),
        ("cubic_stiffness", "cubic_stiffness"), ("coulomb_friction", "unknown"), ("nothing", "offset_force"),
    }  # fmt: skip


def test_alarm_on_a_machine_that_hides_nothing_is_a_false_sure_name():
    (alarms,) = proof.summarise(rows(), []).alarms
    assert (alarms.noise, alarms.rate.hits, alarms.rate.of) == ("all", 1, 2)


def test_targets_are_those_of_sure_names():
    targets = proof.summarise(rows(), []).targets
    assert [row.what for row in targets] == [f"sure names that are there, {kind}" for kind in ("all", CYCLE, SWEEP)]
    assert {row.at_least for row in targets} == {0.95}
    many = proof.summarise([row for row in rows() for _ in range(20)], []).targets
    assert many[0].state == "missed"


def test_sentences_count_sure_names():
    says = proof.summarise(rows(), []).says
    assert says[0] == "Of 5 names that were stated with more than 0.95, 3 are correct (60 %, 95 % band 15 to 95 %)."
    assert says[1] == "The hidden effect was named with more than 0.95 on 2 of 4 machines that hide one."
    assert says[2] == "An absent mechanism was named with more than 0.95 on 1 of 2 machines that hide nothing."
    assert says[3] == "The named mechanisms increased the held-out error on 1 of 6 machines."
    assert proof.summarise(rows()[3:5], []).says[0] == "No mechanism was named with more than 0.95."


def page(cases):
    told = Proof("lostmotion.proof/1", "Rough", proof.summarise(cases, []), {})
    return render(from_plain(Proof, json.loads(json.dumps(to_plain(told)))))


def test_page_shows_sure_names_by_drive_and_nothing_that_needs_a_true_model():
    text = page(rows())
    assert "Names stated with more than 0.95" in text
    assert "one cycle, repeated" in text
    assert "3 of 5" in text
    assert 'id="section-reliability"' in text
    for absent in ("section-detection", "section-heldout", "Median gain", "True model", "By size", "no true model"):
        assert absent not in text
    assert "cases/001: cubic stiffness at the ground, misnamed; named was gap drift." in text
    assert "imperfections that no term describes" in text


def test_page_of_a_perfect_world_says_nothing_of_flaws():
    row = rows()[4]
    text = page([replace(row, answer=replace(row.answer, named=()), sure=None, kind=None, worse=None)])
    assert "imperfections that no term describes" not in text
    assert "Names stated with more than 0.95" not in text


@pytest.mark.slow
def test_trial_runs_from_the_command_line(tmp_path):
    line = ["prove", "--world", "imperfect", "--cases", "1", "--samples", str(SHORT), "--jobs", "1", "--quiet"]
    outcome = CliRunner().invoke(main, [*line, "--out", str(tmp_path)], prog_name="lostmotion")
    assert outcome.exit_code == 0, outcome.output
    content = json.loads((tmp_path / "proof.json").read_text(encoding="utf-8"))
    assert [row["kind"] for row in content["sure"]] == ["all", CYCLE]
    assert content["failed"] == []
    assert content["says"][0] in outcome.output
    assert "http" not in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_only_of_something_impossible_is_refused_from_the_command_line(tmp_path):
    line = ["prove", "--world", "imperfect", "--cases", "2", "--samples", "500", "--only", "parametric_stiffness"]
    outcome = CliRunner().invoke(main, [*line, "--jobs", "1", "--quiet", "--out", str(tmp_path)])
    assert outcome.exit_code == 2
    assert "parametric_stiffness cannot be hidden in a machine under multisine" in outcome.output
    assert "Traceback" not in outcome.output
