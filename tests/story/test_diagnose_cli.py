"""A recording to a report through the command line: what was hidden is found, what is clean stays clean."""

import json
import math

import pytest
from click.testing import CliRunner
from slider_case import CASE, case_in

from lostmotion.cli import main

FRICTION = 3.0


def diagnose(*args):
    """Return the outcome of the command line."""
    return CliRunner().invoke(main, ["diagnose", *map(str, args)], prog_name="lostmotion")


@pytest.fixture(scope="module")
def hidden(tmp_path_factory):
    """Return the folder in which a recording with hidden friction was diagnosed on two cores, and the outcome."""
    folder = tmp_path_factory.mktemp("hidden")
    done = diagnose(case_in(folder, FRICTION), "--out", folder / "out", "--seed", 4, "--jobs", 2)
    assert done.exit_code == 0, done.output
    return folder, done


def said_in(folder):
    return json.loads((folder / "out" / "diagnosis.json").read_text(encoding="utf-8"))


def test_hidden_friction_is_found(hidden):
    folder, done = hidden
    said = said_in(folder)
    (entry,) = said["found"]
    force = entry["parameters"]["force"]
    assert (said["verdict"], entry["mechanism"], entry["at"]) == ("mismatch", "coulomb_friction", "ground")
    assert force["low"] < force["median"] < force["high"]
    assert force["median"] == pytest.approx(FRICTION, abs=0.1)
    assert force["low"] - 0.03 < FRICTION < force["high"] + 0.03
    assert done.stdout.startswith("Dry friction of ")
    assert done.stdout.rstrip().splitlines()[-1] == str(folder / "out" / "report.html")


def test_damping_no_longer_stands_in_for_friction(hidden):
    before, after = (said_in(hidden[0])["parameters"][when]["c"] for when in ("before", "after"))
    assert before["low"] > 8.5
    assert after["median"] == pytest.approx(8.0, abs=0.3)


def test_held_out_prediction_improves(hidden):
    fit = said_in(hidden[0])["fit"]
    assert fit["after"]["heldout_nrmse"] < 0.5 * fit["before"]["heldout_nrmse"]
    assert fit["after"]["heldout_log_score"] > fit["before"]["heldout_log_score"] + 0.1
    assert fit["after"]["heldout_nrmse"] < 1.5 * fit["noise_floor_nrmse"]


def test_keys_and_types_are_those_of_the_contract(hidden):
    said = said_in(hidden[0])
    assert said["schema"] == "lostmotion.diagnosis/1"
    assert said["verdict"] in ("adequate", "mismatch")
    for entry in said["found"]:
        assert_shaped(entry, {"mechanism": str, "probability": float, "parameters": dict, "says": str})
    for row in said["ranking"]:
        assert_shaped(row, {"mechanism": str, "log_evidence_gain": float, "probability": float})
    assert isinstance(said["confused_with"], list)
    assert_shaped(said["unexplained"], {"significant": bool, "rms": float, "unit": str, "share_of_drive": float})
    assert_shaped(said["where"], {"summary": str, "explained_by": dict})
    assert_shaped(said["where"]["explained_by"], dict.fromkeys(("position", "velocity", "phase", "time"), float))
    told = said["where"]["over_time"]
    assert_shaped(told, {"edges": list, "unit": str, "before": list, "after": list, "expected": float, "worst": dict})
    assert len(told["edges"]) == len(told["before"]) + 1 == len(told["after"]) + 1
    for when in ("before", "after"):
        for interval in said["parameters"][when].values():
            assert_shaped(interval, {"median": float, "low": float, "high": float, "unit": str})
        keys = ("heldout_log_score", "heldout_nrmse", "horizon")
        assert_shaped(said["fit"][when], dict.fromkeys(keys, float))
    assert_shaped(said["fit"], {"noise_floor_nrmse": float})
    assert said["provenance"]


def assert_shaped(entry, kinds):
    for key, kind in kinds.items():
        allowed = (int, float) if kind is float else kind
        assert isinstance(entry[key], allowed), (key, entry[key])
        assert kind is not float or (math.isfinite(entry[key]) and not isinstance(entry[key], bool)), (key, entry[key])


def test_what_was_found_is_never_absent(hidden):
    folder, done = hidden
    said = said_in(folder)
    rows = [*said["absent"], *said["unlimited"]]
    present = {(one["mechanism"], one["at"]) for one in [*said["found"], *said["open"]]}
    assert ("coulomb_friction", "ground") in present
    assert not present & {(one["mechanism"], one["at"]) for one in rows}
    assert len(said["absent"]) > 20
    for one in said["absent"]:
        assert_shaped(one, {"mechanism": str, "at": str, "parameter": str, "upper": float, "unit": str, "says": str})
        assert one["upper"] > 0.0
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("Not missing")]
    assert "cubic stiffness above" in line
    assert "Coulomb friction" not in line


def test_bounds_are_in_the_unit_and_as_a_share_of_the_drive(hidden):
    rows = {one["mechanism"]: one for one in said_in(hidden[0])["absent"]}
    offset = rows["offset_force"]
    assert offset["unit"] == "N"
    assert offset["upper"] < 1.0
    assert offset["share_of_drive"] == pytest.approx(offset["upper"] / 100.0, rel=0.05)
    assert rows["stribeck_friction"]["parameter"] == "excess"  # its further amplitude: the level of friction is found


def test_the_first_section_is_what_the_recording_can_tell(hidden):
    page = (hidden[0] / "out" / "report.html").read_text(encoding="utf-8")
    sections = [part.partition('"')[0] for part in page.split('<section id="')[1:]]
    assert sections[:2] == ["section-expected", "section-prediction"]
    assert "section-absent" in sections


def test_probabilities_are_probabilities(hidden):
    said = said_in(hidden[0])
    assert all(0.0 <= row["probability"] <= 1.0 for row in [*said["ranking"], *said["found"]])
    assert said["found"][0]["probability"] > 0.5


def test_everything_is_written(hidden):
    out = hidden[0] / "out"
    assert {p.name for p in out.iterdir()} == {"diagnosis.json", "arrays.nc", "report.html"}
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "ry friction of" in page
    assert 'src="http' not in page


@pytest.mark.slow
def test_one_core_or_two_the_same_bytes(hidden):
    folder, _ = hidden
    done = diagnose(folder / "case.toml", "--out", folder / "again", "--seed", 4, "--jobs", 1)
    assert done.exit_code == 0, done.output
    assert (folder / "again" / "diagnosis.json").read_bytes() == (folder / "out" / "diagnosis.json").read_bytes()


def test_clean_recording_is_adequate(tmp_path):
    done = diagnose(case_in(tmp_path, 0.0), "--out", tmp_path / "out")
    assert done.exit_code == 0, done.output
    said = said_in(tmp_path)
    assert (said["verdict"], said["found"]) == ("adequate", [])
    assert said["parameters"]["after"]["c"]["median"] == pytest.approx(8.0, abs=0.3)


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ('"lin_backlash"', '"lin_backlach"', "did you mean 'lin_backlash'"),
        ("recording.csv", "recordin.csv", "recordin.csv"),
        ('column = "position"', 'column = "postion"', "postion"),
        ("title", "tittle", "did you mean 'title'"),
        ("k0 = 40000.0, ", "", "k0"),
        ('unit = "m"', 'unit = "s"', "s"),
    ],
)
def test_broken_case_is_one_sentence_and_status_2(tmp_path, old, new, word):
    done = diagnose(case_in(tmp_path, FRICTION, CASE.replace(old, new)), "--out", tmp_path / "out")
    assert done.exit_code == 2, done.output
    assert len(done.stderr.strip().splitlines()) == 1
    assert word in done.stderr
    assert "Traceback" not in done.output
    assert not (tmp_path / "out" / "diagnosis.json").exists()
