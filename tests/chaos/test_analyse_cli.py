"""From a recording to what kind of motion it is, on the command line; the recordings come from a foreign integrator."""

import json

import independent
import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner

from lostmotion.cli import main

CASE = """
title = "Rattling slider"
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[model.known]
m = 1.0
"""


def run(*args):
    return CliRunner().invoke(main, ["analyse", *map(str, args)], prog_name="lostmotion")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A case with a chaotic recording of 120 periods at 50 samples, and 2 % noise on its position."""
    made = independent.recording(independent.Machine(), periods=120, per_period=50, noise=0.02, seed=5)
    folder = tmp_path_factory.mktemp("chaos")
    table = np.column_stack([made.time, made.force, made.position])
    np.savetxt(folder / "recording.csv", table, delimiter=",", header="time,force,position", comments="", fmt="%.17g")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def done(folder, tmp_path_factory):
    out = tmp_path_factory.mktemp("out")
    return run(folder / "case.toml", "--out", out, "--draws", 19, "--quiet"), out


def test_the_verdict_is_said_and_the_files_are_there(done):
    result, out = done
    assert result.exit_code == 0, result.output
    assert result.output.startswith("probably chaotic: ")
    assert {p.name for p in out.iterdir()} == {"analysis.json", "analysis.nc", "report.html"}


def test_the_json_keeps_its_contract(done):
    content = json.loads((done[1] / "analysis.json").read_text())
    assert content["schema"] == "lostmotion.analysis/1"
    assert content["verdict"] == "chaotic"
    assert set(content["delay"]) >= {"samples", "seconds", "method"}
    assert content["delay"]["method"] == "ami"
    assert content["dimension"]["method"] == "cao"
    assert content["noise"]["before"] == pytest.approx(0.02, rel=0.5)
    assert set(content["lyapunov"]) >= {"value", "low", "high", "unit", "method", "status"}
    assert content["lyapunov"]["unit"] == "1/s"
    assert set(content["d2"]) >= {"value", "low", "high", "method", "status"}
    assert {t["method"] for t in content["surrogates"]} == {"iaaft", "pseudo_periodic"}
    assert all(t["draws"] == 19 and t["p"] == pytest.approx(0.05) for t in content["surrogates"])
    assert content["provenance"]["inputs"].keys() == {"case", "recording"}


def test_the_drive_is_read_from_what_was_recorded_going_in(done):
    drive = json.loads((done[1] / "analysis.json").read_text())["drive"]
    assert drive["source"] == "excitation"
    assert drive["period"] == pytest.approx(2 * np.pi / 40, rel=1e-6)


def test_the_arrays_have_units(done):
    with xr.open_dataset(done[1] / "analysis.nc") as stored:
        assert stored["time"].attrs["units"] == "s"
        assert stored["x"].attrs["units"] == "m"
        assert {"density", "section", "embedding_e1", "d2_slope", "surrogate_values"} <= set(stored.variables)


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bytes_on_one_core_and_on_two(folder, done, tmp_path):
    again = run(folder / "case.toml", "--out", tmp_path, "--draws", 19, "--quiet", "--jobs", 1)
    assert again.exit_code == 0
    for name in ("analysis.json", "report.html"):
        assert (tmp_path / name).read_bytes() == (done[1] / name).read_bytes()


@pytest.mark.slow
def test_a_bare_recording_is_enough(tmp_path):
    t = 0.01 * np.arange(6000)
    x = np.sin(2 * np.pi * 1.7 * t) + 0.01 * np.random.default_rng(0).normal(size=len(t))
    np.savetxt(tmp_path / "plain.csv", np.column_stack([t, x]), delimiter=",", header="time,angle", comments="")
    result = run(tmp_path / "plain.csv", "--out", tmp_path / "out", "--draws", 19, "--quiet", "--unit", "bit/s")
    assert result.exit_code == 0, result.output
    assert result.output.startswith("periodic: ")
    content = json.loads((tmp_path / "out" / "analysis.json").read_text())
    assert content["drive"]["source"] == "spectrum"
    assert content["drive"]["period"] == pytest.approx(1 / 1.7, rel=1e-3)


@pytest.fixture
def table(tmp_path):
    def write(columns):
        path = tmp_path / "table.csv"
        rows = np.column_stack(list(columns.values()))
        np.savetxt(path, rows, delimiter=",", header=",".join(columns), comments="")
        return path

    return write


NOISE = np.random.default_rng(1).normal(size=500)
TIME = 0.01 * np.arange(500)


@pytest.mark.parametrize(
    ("columns", "args", "says"),
    [
        ({"time": TIME, "a": NOISE, "b": NOISE}, (), "name one with --column"),
        ({"time": TIME, "a": NOISE}, ("--column", "c"), "has no column 'c'"),
        ({"a": NOISE}, (), "no column of table.csv has the name or the unit of a time"),
        ({"time": TIME[:150], "a": NOISE[:150]}, (), "150 samples"),
        ({"time": TIME, "a": np.ones(500)}, (), "constant"),
        ({"time": TIME, "a": np.where(TIME % 1.0 < 0.005, np.nan, NOISE)}, (), "99 samples"),
        ({"time": TIME[::-1], "a": NOISE}, (), "time"),
        ({"time": TIME, "a": NOISE}, ("--embedder", "ami_coa"), "ami_cao"),
        ({"time": TIME, "a": NOISE}, ("--quantifier", "lyapunov_max"), "measures a model"),
        ({"time": TIME, "a": NOISE}, ("--period", "-1"), "period"),
        ({"time": TIME, "a": NOISE}, ("--rate", "0"), "rate"),
    ],
)
def test_what_cannot_be_used_is_one_sentence_and_status_2(table, tmp_path, columns, args, says):
    result = run(table(columns), "--out", tmp_path / "out", "--quiet", *args)
    assert result.exit_code == 2
    assert says in result.output
    assert len(result.output.strip().splitlines()) == 1
