"""The judge of the diagnosis (`benchmarks/judge.py`): its scores, its limit of time, its integrator and its oracle."""

import importlib
import json
import signal
import sys
from pathlib import Path

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture(scope="module", autouse=True)
def _beside():
    sys.path.insert(0, str(FOLDER))
    yield
    sys.path.remove(str(FOLDER))


def load(name):
    return importlib.import_module(name)


def find(name, probability=0.99, state="named", at="ground", **parameters):
    intervals = {k: {"median": v, "low": v - 0.1, "high": v + 0.1} for k, v in parameters.items()}
    return {"mechanism": name, "at": at, "probability": probability, "state": state, "parameters": intervals}


def make_row(found, *, several=False, world="", accept=("coulomb_friction",)):
    effect = {"mechanism": "coulomb_friction", "at": "ground", "parameters": {"force": 1.0}, "accept": list(accept)}
    truth = {
        "effects": [effect], "several": several, "further": {"world": world}, "values": {"c": 5.0}, "drive": "harmonic",
        "says": "friction", "gain": 100.0,
    }  # fmt: skip
    c = {"c": {"median": 5.2, "low": 5.1, "high": 5.3}}
    return {"key": "a", "status": "ok", "found": found, "truth": truth, "parameters": c, "cpu": 1.0, "ranking": found}


def test_a_name_is_right_where_the_truth_accepts_it_and_false_elsewhere():
    rows = load("judge_rows")
    row = make_row([find("coulomb_friction"), find("cogging"), find("cubic_stiffness", 0.5, "likely"), find("unknown")])
    assert rows.list_false(row) == ["cogging"]
    assert rows.list_false(row, sure=False) == ["cogging", "cubic_stiffness"]
    assert rows.count_hits(row, sure=True) == (1, 1)
    assert rows.count_hits(make_row([find("coulomb_friction", 0.9)]), sure=True) == (0, 1)


def test_a_name_at_another_place_is_false_where_the_machine_has_several():
    rows = load("judge_rows")
    assert rows.list_false(make_row([find("coulomb_friction", at="base")], several=True)) == ["coulomb_friction"]
    assert rows.list_false(make_row([find("coulomb_friction", at="base")])) == []


def test_rounding_is_a_flaw_of_every_machine_of_the_imperfect_world():
    rows = load("judge_rows")
    assert rows.list_false(make_row([find("sensor_quantisation", at="sensor")], world="imperfect")) == []
    assert rows.list_false(make_row([find("sensor_quantisation", at="sensor")])) == ["sensor_quantisation"]


def test_a_flaw_counts_beside_the_oracle_only_where_it_is_what_is_hidden():
    rows, flaw, friction = load("judge_rows"), find("sensor_quantisation", at="sensor"), find("coulomb_friction", 0.9)
    beside = make_row([flaw, friction], world="imperfect")
    assert rows.list_told([beside], sure=False) == [(0.9, True)]
    assert rows.list_told([beside], sure=True) == []
    hidden = make_row([flaw], world="imperfect", accept=("sensor_quantisation",))
    assert rows.list_told([hidden], sure=True) == [(0.99, True)]


def test_intervals_of_the_machine_count_only_where_all_that_is_named_is_right():
    rows = load("judge_rows")
    right = make_row([find("coulomb_friction", force=1.05)])
    assert rows.check_intervals(right) == [("coulomb_friction.force", True), ("c", False)]
    more = make_row([find("coulomb_friction", force=1.2), find("cogging")])
    assert rows.check_intervals(more) == [("coulomb_friction.force", False)]


def test_names_that_are_right_for_one_effect_share_one_statement():
    rows = load("judge_rows")
    found = [find("excitation_delay", 0.6), find("sensor_delay", 0.39), find("cogging", 0.3)]
    told = rows.list_stated([make_row(found, accept=("excitation_delay", "sensor_delay"))])
    assert sorted((round(p, 2), ok) for _, p, ok, _ in told) == [(0.3, False), (0.99, True)]


def test_recall_is_counted_down_to_the_probability_above_which_95_percent_are_right():
    rows = load("judge_rows")
    told = [(0.9 - 0.01 * k, True) for k in range(19)] + [(0.6, False), (0.5, True), (0.4, False)]
    assert rows.find_best_recall(told) == (0.5, 20)
    assert rows.find_best_recall([(0.9, False), (0.8, True)])[1] == 0


def test_the_comparison_is_on_the_machines_that_both_versions_have(tmp_path, capsys):
    rows = load("judge_rows")
    for name, keys in (("old", "ab"), ("new", "a")):
        (tmp_path / name / "foreign").mkdir(parents=True)
        lines = [json.dumps({**make_row([find("cogging")]), "key": key}) for key in keys]
        (tmp_path / name / "foreign" / "rows.jsonl").write_text("\n".join(lines))
    rows.print_comparison(tmp_path / "old", tmp_path / "new")
    said = capsys.readouterr().out
    assert "| foreign laws: false names above 0.95 | 1 in 1 of 1 | 1 in 1 of 1 |" in said
    assert "| b | friction | cogging 0.990 named (!) | 1 | - | - |" in said


def test_a_process_ends_at_its_limit_of_processor_time(tmp_path):
    judge = load("judge")
    status, used, _ = judge.run_command([sys.executable, "-c", "while True: pass"], tmp_path, tmp_path, 1.0)
    assert status == -signal.SIGXCPU
    assert 0.9 < used < 2.5


def test_a_study_has_a_row_for_each_machine_also_for_those_at_the_limit_and_those_that_fail(tmp_path):
    effects, store, path = load("small_effects"), load("validation_store"), tmp_path / "check.jsonl"

    def run(trial):
        while trial == 3:
            pass
        if trial == 4:
            raise ValueError("no machine")
        return {"status": "ok", "named": ["named"], "widths": {"c": 1.2}, "expected": {"c": 1.0}}

    effects.run_trials(path, range(2, 5), run, 1.0)
    rows = effects.read_rows(path)
    assert [row["status"] for row in rows] == ["ok", "timeout", "failed: no machine"]
    effects.run_trials(path, range(2, 6), run, 1.0)
    assert [row["trial"] for row in effects.read_rows(path)] == [2, 3, 4, 5]
    assert effects.read_rows(path)[:3] == rows
    head, rates = store.condense_check(tmp_path, {})
    assert (head["of"], head["commands"][0].split()[-4:]) == (4, ["--first", "2", "--out", "OUT"])
    assert [(row["hits"], row["of"]) for row in rates] == [(2, 2), (2, 2)]


def test_the_judged_process_reads_the_code_of_its_checkout(tmp_path):
    judge = load("judge")
    (tmp_path / "framework" / "lostmotion").mkdir(parents=True)
    (tmp_path / "framework" / "lostmotion" / "__init__.py").write_text("print('another version')")
    status, *_ = judge.run_command([sys.executable, "-c", "import lostmotion"], tmp_path, tmp_path, 20.0)
    assert status == 0
    assert "another version" in (tmp_path / "said.txt").read_text()


def test_the_integrator_of_foreign_laws_agrees_with_that_of_the_trials():
    mine, hidden = load("judge_integrator"), importlib.import_module("lostmotion_trials.integrators.hidden")
    body = hidden.Body(1.0, 5.0, 0.0, 4e4, 5e-3)
    step, every, samples = 1e-5, 100, 1500
    force = 80.0 * np.sin(40.0 * (np.arange(samples * every) + 0.5) * step)
    with_law = mine.move_law(force, body, mine.Law(friction=2.0), np.zeros(4), step, every)
    still = np.zeros((3, len(force)))
    trial = hidden.move(force, still, body, hidden.Hidden(friction=2.0), np.zeros(6), (0.0, step), every)
    assert np.abs(trial[:, 0]).max() > 5e-3
    np.testing.assert_allclose(with_law, trial, atol=1e-9 * np.abs(trial).max())


def test_a_maxwell_element_is_a_spring_when_it_is_slow_and_a_damper_when_it_is_fast():
    mine, hidden = load("judge_integrator"), importlib.import_module("lostmotion_trials.integrators.hidden")
    step, every = 1e-4, 10
    force = np.sin(3.0 * np.arange(40_000) * step)

    def move(law, c, k):
        return mine.move_law(force, hidden.Body(1.0, c, k, 0.0, 0.0), law, np.zeros(4), step, every)[:, 0]

    plain = np.abs(move(mine.Law(), 0.5, 20.0)).max()
    slow = move(mine.Law(mine.MAXWELL, 7.0, 1e6), 0.5, 20.0) - move(mine.Law(), 0.5, 27.0)
    fast = move(mine.Law(mine.MAXWELL, 300.0, 1e-3), 0.5, 20.0) - move(mine.Law(), 0.8, 20.0)
    assert max(np.abs(slow).max(), np.abs(fast).max()) < 5e-3 * plain


def test_the_names_that_are_right_for_a_foreign_law_are_terms_of_the_library():
    foreign, default = load("judge_foreign"), importlib.import_module("lostmotion.registry").default
    assert foreign.KINDS.keys() == foreign.ACCEPT.keys()
    names = {name for accepted in foreign.ACCEPT.values() for name in accepted}
    assert names <= set(default().names("term"))


@pytest.mark.slow
def test_the_oracle_names_a_large_effect_and_says_nothing_of_a_clean_machine(tmp_path):
    sets, oracle = load("judge_sets"), load("judge_oracle")
    trial = importlib.import_module("lostmotion_trials.blind.commitment")
    for name, only in (("rub", ("coulomb_friction",)), ("none", ())):
        blind = trial.Blind(seed=5, most=600, only=only, clean=not only, world=trial.IMPERFECT)
        sets.conceal(blind, 0, tmp_path / name)
    rub, none = (oracle.judge_machine(tmp_path / name) for name in ("rub", "none"))
    assert rub["probability_of_truth"] > 0.9
    assert none["best"].get("nothing_missing", 0.0) > 0.3
    assert max(share for name, share in none["best"].items() if name != "nothing_missing") < 0.5
