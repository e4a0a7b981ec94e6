"""A free decay and a hammer test to a report: the mechanism is named, and the decay shows it cycle by cycle."""

import json
import re
from itertools import pairwise

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp

from lostmotion.cli import main

OMEGA, ZETA, RATE, NOISE = 20.0, 0.015, 400.0, 3e-5
FRICTION, CUBIC = 0.02, 1e6
CASE = """
title = "Free decay"

[[recordings]]
file = "recording.csv"
time = "t"
inputs = {inputs}
sensors = [{{ channel = "position", column = "x", unit = "mm" }}]

[model]
name = "linear_oscillator"
known = {{ m = 1.0 }}

[model.estimate]
c = {{ low = 0.05, high = 5.0, scale = "log" }}
k = {{ low = 100.0, high = 1600.0, scale = "log" }}
"""
FORCE = '[{ input = "force", column = "F", unit = "N" }]'


def motion(seconds, *, friction=0.0, cubic=0.0, begun=(0.012, 0.05), force=None):
    """Return time (s) and position (m) of a mass of 1 kg by DOP853, ten steps a sample at most, and its force (N)."""
    push = force or (lambda _: 0.0)

    def rates(t, y):
        pull = OMEGA**2 * y[0] + 2.0 * ZETA * OMEGA * y[1] + friction * np.tanh(y[1] / 1e-5) + cubic * y[0] ** 3
        return [y[1], push(t) - pull]

    t = np.arange(round(seconds * RATE)) / RATE
    solved = solve_ivp(rates, (0.0, t[-1]), begun, "DOP853", t_eval=t, rtol=1e-9, atol=1e-12, max_step=0.1 / RATE)
    return t, solved.y[0] + NOISE * np.random.default_rng(1).standard_normal(t.size), np.array([push(at) for at in t])


def diagnosed(folder, made, inputs="[]"):
    """Return the facts and the page of a diagnosis by the command line."""
    t, x, force = made
    table = np.column_stack([t, 1e3 * x, force])
    np.savetxt(folder / "recording.csv", table, delimiter=",", header="t,x,F", comments="", fmt="%.9g")
    (folder / "case.toml").write_text(CASE.format(inputs=inputs), encoding="utf-8")
    done = CliRunner().invoke(main, ["diagnose", str(folder / "case.toml"), "--out", str(folder / "out")])
    assert done.exit_code == 0, done.output
    said = json.loads((folder / "out" / "diagnosis.json").read_text(encoding="utf-8"))
    return said, (folder / "out" / "report.html").read_text(encoding="utf-8")


def only(said, name):
    (one,) = said["decay"][name]
    return {key: np.array(values) for key, values in one.items()}


def words_of(page):
    """Return what a reader of the page reads, figures and the record of its making left out."""
    return re.sub(r"<style>.*?</style>|<svg.*?</svg>|<details>.*|<[^>]*>", " ", page, flags=re.DOTALL)


@pytest.mark.slow
def test_dry_friction_shows_as_a_decrement_that_rises_as_the_motion_dies(tmp_path):
    said, page = diagnosed(tmp_path, motion(6.0, friction=FRICTION))
    (entry,) = said["found"]
    force = entry["parameters"]["force"]
    assert entry["mechanism"] == "coulomb_friction"
    assert force["low"] < FRICTION < force["high"]
    assert force["high"] - force["low"] < 0.1 * FRICTION
    measured, before, after = (only(said, name) for name in ("measured", "before", "after"))
    assert all(len(values) == len(measured["time"]) for values in measured.values())
    assert np.all(np.diff(measured["decrement"]) > 0.0)
    assert measured["decrement"][-1] > 3.0 * measured["decrement"][0]
    assert np.ptp(before["decrement"]) < 0.01 * np.mean(before["decrement"])
    expected = np.interp(measured["amplitude"], after["amplitude"][::-1], after["decrement"][::-1])
    assert measured["decrement"] == pytest.approx(expected, rel=0.05)
    assert "as with dry friction" in said["decay"]["says"]
    assert "the model with Coulomb friction has the recorded decrement to within" in said["decay"]["says"]
    assert said["notes"] == []
    words = words_of(page)
    assert "Free decay" in words
    assert "Poincaré" not in words
    assert "the recorded drive" not in words
    assert "share of the inertial force" in words


@pytest.mark.slow
def test_a_hardening_spring_shows_as_a_frequency_that_falls_as_the_motion_dies(tmp_path):
    said, _ = diagnosed(tmp_path, motion(6.0, cubic=CUBIC))
    (entry,) = said["found"]
    (spring,) = entry["parameters"].values()
    assert entry["mechanism"] == "cubic_stiffness"
    assert spring["low"] < CUBIC < spring["high"]
    measured, before, after = (only(said, name) for name in ("measured", "before", "after"))
    assert np.all(np.diff(measured["frequency"]) < 0.0)
    # Harmonic balance: the frequency at amplitude a is that of the stiffness k + 3/4 k3 a^2.
    balance = np.sqrt(OMEGA**2 + 0.75 * CUBIC * measured["amplitude"] ** 2) / (2.0 * np.pi)
    assert measured["frequency"] == pytest.approx(balance, rel=0.01)
    assert np.ptp(before["frequency"]) < 1e-3 * np.mean(before["frequency"])
    expected = np.interp(measured["amplitude"], after["amplitude"][::-1], after["frequency"][::-1])
    assert measured["frequency"] == pytest.approx(expected, rel=2e-3)
    assert "(hardening)" in said["decay"]["says"]


@pytest.mark.slow
def test_a_hammer_test_has_a_decay_after_each_hit(tmp_path):
    hits = (0.2, 4.2)

    def force(t):
        since = next((t - start for start in hits if start <= t < start + 0.02), None)
        return 0.0 if since is None else 20.0 * np.sin(np.pi * since / 0.02) ** 2

    made = motion(8.0, cubic=CUBIC, begun=(0.0, 0.0), force=force)
    said, page = diagnosed(tmp_path, made, FORCE)
    assert [entry["mechanism"] for entry in said["found"]] == ["cubic_stiffness"]
    for name in ("measured", "before", "after"):
        starts = [one["time"][0] for one in said["decay"][name]]
        assert len(starts) == 2
        assert all(hit < start < hit + 1.0 for hit, start in zip(hits, starts, strict=True))
        assert all(a["time"][-1] < b["time"][0] for a, b in pairwise(said["decay"][name]))
    assert said["decay"]["says"].startswith("Of 2 decays, that from ")
    (note,) = said["notes"]
    assert note.startswith("The held-out part repeats the motion of the fitted part (")
    assert note.endswith("are a test for this motion only.")
    assert "2 decays, one after each hit" in words_of(page)
