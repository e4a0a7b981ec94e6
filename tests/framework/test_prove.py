"""The blind trial: what is concealed and sealed, how answers are judged, and what all cases say together."""

import json
import math
import os
import tomllib
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from answers import answer, entry, interval
from toy_campaign import Maker, whoami

from lostmotion.campaigns.campaign import Campaign
from lostmotion.codec import from_plain, to_plain
from lostmotion.errors import DataError
from lostmotion_trials.blind import judging
from lostmotion_trials.blind import score as proof
from lostmotion_trials.blind.bound import complete_parameters
from lostmotion_trials.blind.commitment import VARIANTS, Blind, conceal_case, open_sealed
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.mechanisms import NAMES, UNKNOWN, Pilot
from lostmotion_trials.blind.page import render
from lostmotion_trials.blind.pilot import EffectDraft
from lostmotion_trials.blind.results import (
    ConfusionCount,
    DiagnosedCase,
    HeldAgainst,
    HeldOutJudged,
    JudgedCase,
    JudgedEffect,
    JudgedParameter,
    Proof,
)
from lostmotion_trials.blind.run import Diagnoser
from lostmotion_trials.blind.sealed import SealedTruth
from lostmotion_trials.blind.simulator import BlindDrive, BlindMachine, Disturbances, draw_rig, simulate_machine
from lostmotion_trials.rates import estimate_rate
from lostmotion_trials.sealing import format_case_name, publish

SHORT = 600
AGREED = {
    "coulomb_friction": {"force"},
    "stribeck_friction": {"force", "excess", "velocity"},
    "lugre_friction": {"force", "excess", "velocity", "deflection"},
    "dahl_friction": {"force", "deflection"},
    "bouc_wen_hysteresis": {"force", "travel"},
    "parametric_stiffness": {"depth", "phase", "ratio"},
    "excitation_harmonic": {"amplitude", "phase", "ratio"},
    "gap_drift": {"rate"},
    "excitation_delay": {"delay"},
    "sensor_gain": {"error"},
    "sensor_quantisation": {"step"},
    "random_force": {"rms"},
}


def sealed(out, number=0):
    return from_plain(
        SealedTruth, json.loads((out / "sealed" / f"{format_case_name(number)}.json").read_text(encoding="utf-8"))
    )


@pytest.mark.parametrize("name", NAMES)
def test_every_mechanism_can_be_hidden(name, tmp_path):
    conceal_case(Blind(only=(name,), most=SHORT), tmp_path, 0)
    (effect,) = sealed(tmp_path).effects
    assert effect.mechanism == name
    assert all(np.isfinite(value) for value in effect.parameters.values())
    assert set(effect.parameters) == AGREED.get(name, set(effect.parameters))
    assert bool(effect.what) == (name == "unknown")
    case = tomllib.loads((tmp_path / "cases" / "000" / "case.toml").read_text(encoding="utf-8"))
    assert "truth" not in case
    assert set(case["model"]["known"]) | set(case["model"]["estimate"]) == set(sealed(tmp_path).machine.values)


@pytest.mark.slow
def test_every_unknown_is_somebodys(tmp_path):
    found = set()
    for number in range(16):
        conceal_case(Blind(only=("unknown",), most=500), tmp_path, number)
        found.add(sealed(tmp_path, number).effects[0].what)
    assert found == set(UNKNOWN)


def test_same_seed_same_bytes(tmp_path):
    first, again, other = (
        conceal_case(Blind(seed, SHORT), tmp_path / name, 3) for name, seed in (("a", 1), ("b", 1), ("c", 2))
    )
    assert first == again
    assert first.digests["truth"] != other.digests["truth"]
    assert sealed(tmp_path / "a", 3).salt == sealed(tmp_path / "b", 3).salt != sealed(tmp_path / "c", 3).salt


def test_case_tells_nothing_of_its_truth(tmp_path):
    conceal_case(Blind(only=("coulomb_friction",), most=SHORT), tmp_path, 0)
    place = tmp_path / "cases" / "000"
    assert sorted(p.name for p in place.iterdir()) == ["case.toml", "recording.csv"]
    text = (place / "case.toml").read_text(encoding="utf-8")
    assert "friction" not in text
    assert repr(sealed(tmp_path).machine.values["c"]) not in text


def test_truth_that_was_changed_is_refused(tmp_path):
    publish(tmp_path, [conceal_case(Blind(most=SHORT), tmp_path, 0)])
    assert open_sealed(tmp_path, 0).case == "000"
    path = tmp_path / "sealed" / "000.json"
    path.write_text(path.read_text(encoding="utf-8").replace('"plain"', '"outliers"'), encoding="utf-8")
    with pytest.raises(DataError, match="truth of case 000 does not match its digest"):
        open_sealed(tmp_path, 0)


def test_recording_that_was_changed_is_refused(tmp_path):
    publish(tmp_path, [conceal_case(Blind(most=SHORT), tmp_path, 0)])
    with (tmp_path / "cases" / "000" / "recording.csv").open("a", encoding="utf-8") as stream:
        stream.write("1.0,1.0,1.0\n")
    with pytest.raises(DataError, match=r"recording\.csv of case 000"):
        open_sealed(tmp_path, 0)


def test_seal_is_enlarged_and_never_replaced(tmp_path):
    publish(tmp_path, [conceal_case(Blind(most=SHORT), tmp_path, 0)])
    content = publish(tmp_path, [conceal_case(Blind(most=SHORT), tmp_path, k) for k in (0, 1)])
    assert set(content.digests) == {"000", "001"}
    with pytest.raises(DataError, match="case 000 is not the one"):
        publish(tmp_path, [conceal_case(Blind(9, SHORT), tmp_path, 0)])


@pytest.mark.slow
def test_clean_study_has_every_kind_of_noise(tmp_path):
    kinds = set()
    for number in range(12):
        conceal_case(Blind(most=500, clean=True), tmp_path, number)
        assert sealed(tmp_path, number).effects == ()
        kinds.add(sealed(tmp_path, number).variant)
    assert kinds == set(VARIANTS)


@pytest.mark.parametrize(
    ("blind", "sentence"),
    [
        (Blind(only=("coulomb_frictoin",)), "no mechanism is called 'coulomb_frictoin'"),
        (Blind(only=("gap_drift",), clean=True), "either --clean or --only"),
    ],
)
def test_wishes_that_cannot_be_are_refused(blind, sentence):
    with pytest.raises(DataError, match=sentence):
        blind.check()


def test_sizes_span_what_can_and_cannot_be_seen():
    """The rough formula gives Coulomb friction the gain it was asked for."""
    gains = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        rig = draw_rig(rng, 500)
        pilot = Pilot(rig, simulate_machine(rig, convert_effects(rig, ())[0], Disturbances(), rng))
        gains.append(pilot.expect_gain(EffectDraft(1e-3 * pilot.inertial_force * np.sign(pilot.v), dict)))
    assert np.all(np.array(gains) > 0.0)


def said(*found, confused=(), ranking=()):
    return answer(found=list(found), confused_with=list(confused), ranking=list(ranking))


def effect(mechanism, at="ground", **parameters):
    return JudgedEffect(mechanism, at, parameters, status="ok", outcome=judging.MISSED)


COULOMB = effect("coulomb_friction", "base")


@pytest.mark.parametrize(
    ("truth", "answer", "several", "outcome"),
    [
        (COULOMB, said(entry("coulomb_friction", "base")), True, judging.HIT),
        (COULOMB, said(entry("coulomb_friction", "ground")), True, judging.MISNAMED),
        (effect("coulomb_friction"), said(entry("coulomb_friction")), False, judging.HIT),
        (COULOMB, said(entry("gap_drift"), confused=[entry("coulomb_friction", "base")]), True, judging.CONFUSED),
        (COULOMB, said(entry("gap_drift"), confused=[entry("coulomb_friction", "ground")]), True, judging.MISNAMED),
        (COULOMB, said(entry("gap_drift"), confused=[{"mechanism": "coulomb_friction"}]), True, judging.CONFUSED),
        (effect("gap_drift", ""), said(entry("offset_force"), confused=[entry("gap_drift")]), True, judging.CONFUSED),
        (COULOMB, said(entry("unknown")), True, judging.NOTICED),
        (COULOMB, said(), True, judging.MISSED),
        (effect("sensor_delay", ""), said(entry("excitation_delay", "drive")), True, judging.HIT),
        (effect("lugre_friction"), said(entry("bouc_wen_hysteresis")), False, judging.HIT),
        (effect("unknown", ""), said(entry("unknown")), False, judging.HIT),
        (effect("unknown", ""), said(entry("gap_drift")), False, judging.MISNAMED),
    ],
)
def test_answers_are_judged(truth, answer, several, outcome):
    assert judging._find_outcome(truth, answer, several=several).outcome == outcome


def test_effect_beside_one_that_was_named_is_missed_and_not_misnamed():
    machine = BlindMachine("lin_backlash", {}, (), BlindDrive(((1.0, 1.0, 0.0),)), 1.0, 1, 0.0)
    effects = [effect("gap_drift", ""), effect("offset_force", "")]
    against = judging._compare_answer(said(entry("gap_drift")), effects, machine, several=False)
    assert [row.outcome for row in against.effects] == [judging.HIT, judging.MISSED]
    assert against.false == ()
    both = said(entry("gap_drift"), entry("viscous_damping"))
    against = judging._compare_answer(both, effects, machine, several=False)
    assert [row.outcome for row in against.effects] == [judging.HIT, judging.MISNAMED]
    assert against.false == ("viscous_damping",)


def test_phase_turns_with_the_sign_of_its_amplitude():
    whole = interval(-0.1, -0.11, -0.09)
    angle = interval(0.4 + np.pi, 0.4 + np.pi - 0.1, 0.4 + np.pi + 0.1)
    truth = effect("parametric_stiffness", "", depth=0.1, phase=0.4 + 2.0 * np.pi, ratio=2.0)
    found = said(entry("parametric_stiffness", parameters={"depth": whole, "phase": angle})).found
    rows = list(judging._judge_effect_parameters(truth, found, several=False))
    assert [row.name for row in rows] == ["parametric_stiffness.depth", "parametric_stiffness.phase"]
    assert all(row.inside for row in rows)


def test_interval_that_is_withheld_is_not_judged():
    found = said(entry("coulomb_friction", parameters={"force": interval(1.0)})).found
    assert list(judging._judge_effect_parameters(effect("coulomb_friction", force=1.0), found, several=False)) == []


def test_wave_has_a_cosine_and_a_sine():
    signal = BlindDrive(((3.0, 1.0, 0.0), (4.0, 2.0, 0.0)))
    found = complete_parameters({"amplitude": 0.5, "phase": 0.3, "ratio": 2.0}, {}, signal)
    angle = np.linspace(0.0, 6.0, 7)
    wave = 5.0 * (found["cosine"] * np.cos(angle) + found["sine"] * np.sin(angle))
    assert np.allclose(wave, 0.5 * np.cos(angle + 0.3))
    assert found["share"] == pytest.approx(0.1)
    assert complete_parameters({"force": 1.0}, {}, signal) == {"force": 1.0}


def test_probabilities_of_what_cannot_be_told_apart_are_added():
    ranking = [
        {"mechanism": name, "at": "ground", "probability": p}
        for name, p in (("dahl_friction", 0.6), ("lugre_friction", 0.3), ("gap_drift", 0.05), ("unknown", 0.05))
    ]
    found = list(judging._list_stated(said(ranking=ranking).ranking, [effect("bouc_wen_hysteresis")], several=False))
    assert found == [(pytest.approx(0.9), 1.0), (0.05, 0.0)]


def case(number, *effects, named=(), false=(), heldout=None, parameters=()):
    return JudgedCase(
        case=format_case_name(number), model="lin_backlash", variant="plain", margin=1.5,
        verdict="mismatch" if named else "adequate",
        answer=HeldAgainst(effects, named, false, parameters, ((0.95, 1.0), (0.001, 0.0))), heldout=heldout,
    )  # fmt: skip


def scored(outcome, gain, mechanism="coulomb_friction", status="ok"):
    return replace(effect(mechanism), gain=gain, outcome=outcome, status=status, probability=0.9)


def rows():
    inside = JudgedParameter("c", 1.0, 0.9, 1.0, 1.1, inside=True, relative_error=0.0)
    won = HeldOutJudged(before=0.3, after=0.011, true=0.01, share=0.997, ratio=1.1)
    return [
        case(0, scored(judging.HIT, 100.0), named=("coulomb_friction",), heldout=won, parameters=(inside,)),
        case(1, scored(judging.MISSED, 7.0)),
        case(2, scored(judging.MISNAMED, 30.0), named=("gap_drift",), false=("gap_drift",)),
        case(3, scored(judging.NOTICED, math.nan, "unknown", "no likelihood"), named=("unknown",)),
        case(4),
        case(5, named=("offset_force",), false=("offset_force",)),
        case(6),
    ]


def test_rows_are_read_back_as_they_were_written():
    for row in rows():
        assert repr(from_plain(JudgedCase, json.loads(json.dumps(to_plain(row))))) == repr(row)


def test_summary_counts():
    found = proof.summarise(rows(), [DiagnosedCase("006", "failed", "it failed")])
    assert (found.cases, found.clean, found.effects) == (7, 2, 4)
    assert [row.counts.rate.hits for row in found.detection] == [0, 0, 0, 1, 0, 0]
    assert [row.counts.rate.of for row in found.detection] == [0, 1, 1, 1, 0, 0]
    assert [row.counts.misnamed_alike for row in found.detection] == [0, 0, 1, 0, 0, 0]
    assert found.alarms[0].rate.hits == 1
    assert found.coverage[0].rate.share == 1.0
    assert found.heldout.within.hits == 0
    assert [one.case for one in found.misses] == ["001", "002", "003"]
    assert [one.case for one in found.false_alarms] == ["002", "005"]
    assert ConfusionCount("coulomb_friction", "gap_drift", 1) in found.confusion
    assert {row.state for row in found.targets} == {"open"}
    assert found.says[0].startswith("Of 4 hidden effects 1 were named")


def test_bands_are_exact():
    assert estimate_rate(0, 10).high == pytest.approx(1.0 - 0.025**0.1)
    assert estimate_rate(10, 10).low == pytest.approx(0.025**0.1)
    assert math.isnan(estimate_rate(0, 0).share)


def test_no_test_does_better_than_its_false_alarms_without_an_effect():
    limit = proof._compute_limit(rows())
    told, many = np.array(limit.informed), np.array(limit.one_of_many)
    assert np.all(np.diff(told) >= 0.0)
    assert np.all(many <= told)
    assert proof.ncx2.sf(proof.chi2.isf(0.02, 1), 1, 1e-9) == pytest.approx(0.02, abs=1e-6)
    assert told[-1] == pytest.approx(1.0)


def test_target_is_missed_only_beyond_chance():
    few = proof._judge_target("a", estimate_rate(2, 3), 0.95, 1.0)
    many = proof._judge_target("a", estimate_rate(10, 30), 0.95, 1.0)
    good = proof._judge_target("a", estimate_rate(30, 30), 0.95, 1.0)
    assert [one.state for one in (few, many, good)] == ["open", "missed", "met"]


def rendered(title, cases):
    """Return the page of a trial, read back from what its file holds."""
    told = Proof("lostmotion.proof/1", title, proof.summarise(cases, []), {"seed": 0})
    return render(from_plain(Proof, json.loads(json.dumps(to_plain(told)))))


def test_page_stands_by_itself():
    page = rendered("Blind <trial>", rows())
    assert "Blind &lt;trial&gt;" in page
    for name in ("detection", "reliability", "heldout"):
        assert f'id="section-{name}"' in page
    assert (
        "cases/002: Coulomb friction at the ground (gain 30), misnamed; named was gap drift, which fits worse by 1.5."
        in page
    )
    assert "cases/005: offset force; hidden was nothing." in page
    assert "http" not in page


def test_page_of_a_clean_study_has_no_curve():
    page = rendered("Clean", [case(k) for k in range(3)])
    assert "Nothing was hidden in 3 machines." in page
    assert "section-detection" not in page


def test_case_that_cannot_be_diagnosed_is_kept_as_failed(tmp_path):
    conceal_case(Blind(most=SHORT), tmp_path, 0)
    (tmp_path / "cases" / "000" / "case.toml").write_text("title = 3\n", encoding="utf-8")
    outcome = Diagnoser(tmp_path / "cases")(0)
    assert outcome.status == "failed"
    assert "lacks 'model'" in outcome.says


def test_single_trial_is_made_apart(tmp_path, monkeypatch):
    """It takes one thread, whatever this process was told to take."""
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "7")
    (apart,) = Campaign(whoami, Maker, 1, {"seed": 0}, apart=True).run(tmp_path / "apart", 1)
    (here,) = Campaign(partial(whoami), Maker, 1, {"seed": 0}).run(tmp_path / "here", 1)
    assert apart.process != os.getpid()
    assert here.process == os.getpid()
    assert (apart.threads, here.threads) == ("1", "7")
