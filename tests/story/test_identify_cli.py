"""From a recording with hidden friction to a posterior that ArviZ reads, on the command line."""

import importlib
import json
import sys
from pathlib import Path

import arviz_stats
import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion.identification.trajectory import choose_terms, find_best_fits
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default

CASE = """
title = "Small Lin"
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
k1 = 0.0
[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
x0 = { low = 5e-4, high = 5e-2, scale = "log" }
"""
TRUTH = {"c": 8.0, "x0": 0.005, "coulomb_friction.force": 1.0}
FRICTION = "coulomb_friction.force"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A case whose recording hides 1 N of dry friction, 1,500 samples long."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "science"))
    made = importlib.import_module("independent")
    recording = made.recording(made.Machine(coulomb=1.0), periods=15, per_period=100, seed=3)
    folder = tmp_path_factory.mktemp("small")
    table = np.column_stack([recording.time, recording.force, recording.position])
    np.savetxt(folder / "recording.csv", table, delimiter=",", header="time,force,position", comments="", fmt="%.17g")
    known = "\n".join(f'"{name}" = {value}' for name, value in TRUTH.items())
    (folder / "case.toml").write_text(f"{CASE}\n[truth]\n{known}\n", encoding="utf-8")
    return folder


def run(folder, out, *args):
    """Return the outcome of `lostmotion identify` with the term that the recording hides."""
    line = ["identify", str(folder / "case.toml"), "--out", str(out), "--term", "coulomb_friction", *args]
    return CliRunner().invoke(main, line, prog_name="lostmotion")


@pytest.fixture(scope="module")
def done(folder, tmp_path_factory):
    out = tmp_path_factory.mktemp("out")
    return run(folder, out, "--seed", "1", "--ess", "700"), out


def test_intervals_hold_the_truth(done):
    outcome, out = done
    assert outcome.exit_code == 0, outcome.output
    content = json.loads((out / "identification.json").read_text(encoding="utf-8"))
    assert content["schema"] == "lostmotion.identification/1"
    assert content["route"] == "trajectory"
    assert content["converged"]
    assert content["ess_min"] >= 700
    assert content["rhat_max"] <= 1.01
    assert set(content["parameters"]) == set(TRUTH)
    for name, value in TRUTH.items():
        row = content["parameters"][name]
        assert row["low"] < value < row["high"], name
        assert row["low"] < row["median"] < row["high"]
    assert content["parameters"]["x0"]["unit"] == "m"
    assert content["log_likelihood_evaluations"] > 700
    assert "seconds" not in json.dumps(content)
    assert content["provenance"]["seed"] == 1


def test_what_is_printed(done):
    outcome, out = done
    assert f"{FRICTION}  " in outcome.output
    assert "R-hat" in outcome.output
    assert "effective draws per second" in outcome.output
    assert outcome.output.rstrip().endswith(str(out / "report.html"))


def test_arviz_reads_the_posterior(done):
    _, out = done
    data = xr.open_datatree(out / "posterior.nc", engine="h5netcdf")
    assert {"posterior", "sample_stats"} <= set(data.children)
    assert data.posterior["x0"].attrs["units"] == "m"
    table = arviz_stats.summary(data, round_to="none")
    assert table.loc[FRICTION, "r_hat"] < 1.05
    content = json.loads((out / "identification.json").read_text(encoding="utf-8"))
    assert float(data.posterior["c"].median()) == pytest.approx(content["parameters"]["c"]["median"])


def test_report_stands_by_itself(done):
    _, out = done
    page = (out / "report.html").read_text(encoding="utf-8")
    for heading in ("Converged", "Joint posterior of the parameters", "Did the walkers mix?", "inside"):
        assert heading in page
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "<script" not in page


def test_chain_agrees_with_the_normal_approximation(folder, done):
    prepared = prepare(folder / "case.toml", default())
    terms = choose_terms(prepared, ("coulomb_friction",), default())
    fit = find_best_fits(prepared, terms, np.random.default_rng(2), 2)[0]
    posterior = xr.open_datatree(done[1] / "posterior.nc", engine="h5netcdf").posterior
    # The maximum lies at the least random force there may be; more of it widens the gap, which no normal can follow.
    near = (posterior["random_force"] < posterior["random_force"].quantile(0.35)).values
    for key, spread in (("c", np.log), ("x0", np.log), (FRICTION, np.asarray)):
        assert spread(posterior[key].values[near]).std() == pytest.approx(fit.sd[key], rel=0.2), key


def test_same_seed_same_bytes_on_any_number_of_cores(folder, tmp_path):
    for name, jobs in (("one", "1"), ("two", "2")):
        assert run(folder, tmp_path / name, "--max-steps", "10", "--jobs", jobs).exit_code == 0
    for file in ("identification.json", "posterior.nc", "report.html"):
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes(), file


def test_no_interval_from_a_chain_that_has_not_converged(folder, tmp_path):
    outcome = run(folder, tmp_path, "--max-steps", "20")
    assert outcome.exit_code == 0
    assert "has not converged, so no interval is given" in outcome.output
    content = json.loads((tmp_path / "identification.json").read_text(encoding="utf-8"))
    assert content["converged"] is False
    for row in (*content["parameters"].values(), *content["noise"].values()):
        assert [row[key] for key in ("median", "low", "high", "sd")] == [None] * 4
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Not converged" in page
    assert "section-corner" not in page


@pytest.mark.parametrize(
    ("term", "sentence"),
    [
        ("coulomb_frictoin", "did you mean 'coulomb_friction'"),
        ("coulomb_friction@base", "has no place in lin_backlash"),
    ],
)
def test_terms_that_cannot_be_are_refused(folder, tmp_path, term, sentence):
    outcome = run(folder, tmp_path / "never", "--term", term)
    assert outcome.exit_code == 2
    assert sentence in outcome.output
    assert not (tmp_path / "never").exists()


def test_a_case_gives_the_prior_of_a_term(folder, tmp_path):
    text = (folder / "case.toml").read_text(encoding="utf-8")
    for name, line in (("known", f'"{FRICTION}" = 1.0'), ("estimate", f'"{FRICTION}" = {{ mean = 1.0, sd = 1e-4 }}')):
        case = tmp_path / f"{name}.toml"
        case.write_text(text.replace(f"[model.{name}]", f"[model.{name}]\n{line}"), encoding="utf-8")
        (tmp_path / "recording.csv").write_bytes((folder / "recording.csv").read_bytes())
        prepared = prepare(case, default())
        terms = choose_terms(prepared, (), default())
        assert [t.name for t in terms] == ["coulomb_friction"]
        fit = find_best_fits(prepared, terms, np.random.default_rng(0), 2)[0]
        assert (FRICTION in fit.posterior.space.keys) == (name == "estimate")
        assert fit.posterior.active == {"coulomb_friction"}
        if name == "estimate":
            assert fit.sd[FRICTION] == pytest.approx(1e-4, rel=0.01)
        else:
            assert fit.posterior.recordings[0].full(fit.theta)[fit.posterior.system.index[FRICTION]] == 1.0
