"""The same recording in other units is the same recording: bit for bit as the filter sees it, so in every answer."""

from __future__ import annotations

import numpy as np
import pytest

from lostmotion.codec import to_plain
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.observation import round_values
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion_plugins.models.lin import LinBacklash
from lostmotion_plugins.terms.friction import CoulombFriction

CASE = """
[[recordings]]
file = "recording.csv"
time = "time"
excitation = {{ column = "force", quantity = "force", unit = "{force}" }}
response = {{ column = "position", quantity = "position", unit = "{length}" }}
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
k1 = 0.0
[model.estimate]
c = {{ low = 0.8, high = 80.0, scale = "log" }}
x0 = {{ low = 5e-4, high = 5e-2, scale = "log" }}
"""
UNITS = {"N": 1.0, "kN": 1e3, "lbf": 4.4482216152605, "m": 1.0, "um": 1e-6, "inch": 0.0254}


@pytest.fixture(scope="module")
def recorded():
    """Time, force (N) and position (m) of a machine that rubs."""
    rng, dt, samples = np.random.default_rng(4), 2e-3, 2000
    time = np.arange(samples) * dt
    drive = Drive.smooth([lambda t: 100.0 * np.cos(40.0 * t)], dt, samples)
    system = System.of(LinBacklash() + CoulombFriction())
    full = system.vector({"m": 1.0, "c": 8.0, "k0": 4e4, "x0": 5e-3, "coulomb_friction.force": 3.0})
    x = system.simulate(full, system.everything, np.zeros(2), drive, 16).states[:, 0]
    return time, 100.0 * np.cos(40.0 * time), x + 0.01 * x.std() * rng.standard_normal(samples)


def written(folder, recorded, force, length):
    """Write the recording in these units, and return the path of its case."""
    folder.mkdir(parents=True)
    columns = recorded[0], recorded[1] / UNITS[force], recorded[2] / UNITS[length]
    rows = [",".join(repr(float(value)) for value in row) for row in zip(*columns, strict=True)]
    (folder / "recording.csv").write_text("\n".join(["time,force,position", *rows]))
    (folder / "case.toml").write_text(CASE.format(force=force, length=length))
    return folder / "case.toml"


@pytest.mark.parametrize(("force", "length"), [("kN", "um"), ("lbf", "inch")])
def test_a_change_of_units_changes_no_bit_of_what_is_fitted(tmp_path, recorded, force, length):
    registry = Registry.discover()
    (plain,) = prepare(written(tmp_path / "si", recorded, "N", "m"), registry).observations
    (other,) = prepare(written(tmp_path / "other", recorded, force, length), registry).observations
    assert np.array_equal(plain.response, other.response)
    assert np.array_equal(plain.inputs, other.inputs)
    assert (plain.dt, plain.harmonic) == (other.dt, other.harmonic)


def test_ten_digits_are_kept_and_a_lattice_stays_one():
    values = np.random.default_rng(0).normal(size=1000)
    assert np.max(np.abs(round_values(values) - values)) < 1.2e-10 * np.max(np.abs(values))
    lattice = 5e-8 * np.arange(-4000, 4000)
    steps = np.diff(round_values(lattice)) / 5e-8
    assert np.max(np.abs(steps - 1.0)) < 1e-3
    assert not round_values(np.zeros(3)).any()
    assert np.isnan(round_values(np.array([np.nan, 1.0]))[0])


@pytest.mark.slow
def test_a_diagnosis_is_the_same_in_any_units(tmp_path, recorded):
    """To 1e-6 of each number, found terms and intervals included."""
    registry = Registry.discover()
    cases = [written(tmp_path / f, recorded, f, u) for f, u in (("N", "m"), ("kN", "um"))]
    plain, other = (to_plain(run_diagnosis(c, c.parent / "result", registry, jobs=1, propose=False)) for c in cases)
    for key in ("found", "parameters", "fit", "ranking", "where"):
        assert numbers(plain[key]) == pytest.approx(numbers(other[key]), rel=1e-6), key


def numbers(content):
    """Return all numbers in a part of a result, in order."""
    if isinstance(content, dict):
        return [n for value in content.values() for n in numbers(value)]
    if isinstance(content, list):
        return [n for value in content for n in numbers(value)]
    return [float(content)] if isinstance(content, int | float) and not isinstance(content, bool) else []
