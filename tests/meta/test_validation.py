"""The page of validation says what the stored results say, and the results are what the raw runs say."""

import importlib
import json
from dataclasses import replace
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "benchmarks"
PAGE = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def _beside(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))


def load(name):
    return importlib.import_module(name)


def test_the_page_says_what_the_results_say():
    assert load("validation").check_page(PAGE) == []


def test_a_number_that_is_not_that_of_the_results_and_an_absent_table_are_found():
    validation, results = load("validation"), load("validation_results")
    newest = results.choose_newest(results.read_results())[0]
    said = load("validation_tables").format_rate(results.count_rows(newest.rows).held)
    assert said in PAGE
    wrong = validation.check_page(PAGE.replace(said, "1" + said))
    assert any("'sets'" in sentence for sentence in wrong)
    assert any("no block 'sets'" in one for one in validation.check_page(PAGE.replace("validation.py sets", "")))


def test_a_reason_of_no_miss_is_found():
    tables, results = load("validation_tables"), load("validation_results")
    stored = results.read_results()
    assert tables.find_unused_reasons(stored, results.read_reasons()) == []
    assert tables.find_unused_reasons(stored, {("small", "999 cogging"): "none"}) == ["small: 999 cogging"]


def test_results_are_small_and_name_their_version_and_commands():
    results = load("validation_results").read_results()
    assert len(results) > 5
    assert [r.name for r in results if not (r.code and r.committed and r.commands and r.rows)] == []
    assert [p.name for p in (FOLDER / "results").glob("*.json") if p.stat().st_size > 60_000] == []


def make_row(key, found, truth="coulomb_friction"):
    effect = {"mechanism": truth, "at": "ground", "parameters": {"force": 1.0}, "accept": [truth]}
    interval, doubt = {"median": 1.05, "low": 0.9, "high": 1.2}, "An alternative is likely. It is not excluded."
    entries = [
        {"mechanism": name, "at": "ground", "probability": p, "state": "named" if p > 0.95 else "likely",
         "doubts": [] if p > 0.95 else [doubt], "parameters": {"force": interval}}
        for name, p in found
    ]  # fmt: skip
    ranking = [{**entry, "log_evidence_gain": 9.0, "fitted": True} for entry in entries]
    further = {"effects": [effect], "several": False, "further": {}, "values": {}, "drive": "sweep", "gain": None}
    return {
        "set": "foreign", "key": key, "commit": "abc", "status": "ok", "found": entries, "ranking": ranking,
        "truth": further, "parameters": {}, "cpu": 3.0, "nrmse": [0.2, None],
    }  # fmt: skip


@pytest.fixture
def stored(tmp_path, monkeypatch):
    """The result of a run of four machines: a right name, a false one, a likely one, and a last row that counts."""
    monkeypatch.setattr(load("validation_store"), "RESULTS", tmp_path / "results")
    run = tmp_path / "run"
    run.mkdir()
    rows = [
        make_row("0", [("cogging", 0.99)]),
        make_row("0", [("coulomb_friction", 0.99)]),
        make_row("1", [("cogging", 0.97)]),
        make_row("2", [("coulomb_friction", 0.6)]),
        make_row("3", []),
    ]
    (run / "rows.jsonl").write_text("\n".join(map(json.dumps, rows)))
    path = load("validation_store").store(run, "small", {"fresh": 7})
    return load("validation_results").read_results(path.parent)[0]


def test_a_stored_run_counts_what_its_rows_say(stored):
    counts = load("validation_results").count_rows(stored.rows)
    assert (stored.machines, stored.code, len(stored.rows)) == ("foreign --fresh 7", "abc", 4)
    assert (counts.right.hits, counts.right.of) == (1, 2)
    assert (counts.named.hits, counts.likely.hits, counts.named.of) == (1, 2, 4)
    assert (counts.alarms.hits, counts.held.hits, counts.held.of) == (1, 2, 2)


def test_each_machine_that_is_not_right_is_a_miss_with_a_reason(stored):
    tables = load("validation_tables")
    misses = [row for row in stored.rows if tables.is_miss(row)]
    reasons = {("small", "1 cogging"): "by hand"}
    why = [tables.explain_miss(row, stored.name, reasons) for row in misses]
    assert why == ["by hand", "An alternative is likely", "not examined"]
    assert tables.explain_miss({**misses[0], "gains": [[2.6, True], [9.1, True]]}, "", {}) == (
        "the right law gains 3, the answer 9"
    )
    assert tables.explain_miss({**misses[0], "gains": [None, [9.1, True]]}, "", {}) == (
        "no gain of the right law is among the first ten"
    )
    assert [tables.format_answer(row) for row in misses] == ["cogging", "coulomb_friction 0.60", "nothing"]


def test_an_effect_is_confused_with_the_group_of_the_false_name(stored):
    results = load("validation_results")
    said = [results.describe_outcome(row, row["effects"][0]) for row in stored.rows]
    assert said == ["right", "false: periodic force", "likely, right", "nothing"]


def test_the_cost_of_many_trials_is_the_mean_of_the_stored_times(stored):
    rows = [{**row, "cpu": cpu} for row, cpu in zip(stored.rows, (10.0, 20.0, 60.0, None), strict=True)]
    table = load("validation_tables").write_costs([replace(stored, rows=rows)], {})
    assert table.splitlines()[-1] == "| `foreign --fresh 7` | 3 | 30 (0 to 60) | 83 | 8,300 |"


def test_a_run_of_two_versions_is_refused_until_one_is_chosen(tmp_path):
    rows = [make_row("0", []), {**make_row("1", []), "commit": "def"}]
    (tmp_path / "rows.jsonl").write_text("\n".join(map(json.dumps, rows)))
    with pytest.raises(SystemExit, match="give --code"):
        load("validation_store").condense_judged(tmp_path, {})
    assert len(load("validation_store").condense_judged(tmp_path, {"code": "def"})[1]) == 1


def test_a_case_of_a_blind_trial_is_condensed_to_the_same_row(stored):
    effect = {"mechanism": "cogging", "gain": 80.0, "outcome": "hit", "sure": None}
    case = {
        "case": "000", "verdict": "mismatch", "effects": [effect], "named": ["cogging@ground", "gap_drift"],
        "false": ["gap_drift"], "stated": [[0.99, 1.0], [0.01, 0.0]], "heldout": None,
        "parameters": [{"name": "c", "inside": False}, {"name": "k", "inside": True}],
    }  # fmt: skip
    row = load("validation_store").condense_case(case, {"signal": {"sweep": 0.0}, "channel": "velocity"})
    assert row.keys() == stored.rows[0].keys()
    assert row["names"] == [["cogging", None, True, True], ["gap_drift", None, True, False]]
    counts = load("validation_results").count_rows([row])
    assert (counts.right.hits, counts.right.of, counts.named.hits, counts.held.hits) == (1, 2, 1, 1)
    assert (row["stated"], row["sensor"], row["drive"]) == ([[0.99, True]], "velocity", "tones")


def test_real_machines_are_of_one_version_and_published_values_outside_an_interval_are_said(tmp_path):
    row = {
        "key": "emps", "page": "emps", "published": "dry friction", "found": [True, False], "further": ["cogging"],
        "names": [["coulomb_friction", 0.99, "named"], ["cogging", 0.97, "likely"]], "errors": [0.1, None],
        "compared": [["m", 95.0, 95.5, 94.0, 97.0, "kg"], ["c", 200.0, 210.0, 205.0, 215.0, "N s/m"]], "cpu": 12.4,
    }  # fmt: skip
    rows = [{**row, "code": "old"}, {**row, "cpu": 99.0, "code": "new"}, {**row, "code": "new"}]
    (tmp_path / "rigs.jsonl").write_text("\n".join(map(json.dumps, rows)))
    head, kept = load("validation_store").condense_rigs(tmp_path, {})
    assert (head["code"], head["of"], kept) == ("new", 1, [row])
    result = load("validation_results").Result(
        **{**head, "committed": "", "date": "today", "name": "", "rows": kept}, note=""
    )
    tables = load("validation_rigs")
    said = tables.write_rigs([result], {}).splitlines()[-1]
    assert "| coulomb friction | cogging (0.97, likely) | 1 of 2 | cogging | 10 % to not finite | 12 |" in said
    assert not result.judged
    inside = [line.split(" | ")[-1] for line in tables.write_published([result], {}).splitlines()[2:]]
    assert inside == ["yes |", "no, +5.0 % |"]
