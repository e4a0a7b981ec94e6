"""Two real machines: a beam with a bolted joint that rings down, and a motor wheel before an encoder that coasts."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.io import loadmat
from scipy.signal import filtfilt, firwin, hilbert

from lostmotion.cli import main

pytestmark = [pytest.mark.real, pytest.mark.slow]

BEAM = """
[[recordings]]
file = "beam.csv"
time = "t"
t_start = 0.3
t_end = 2.0
inputs = []
sensors = [ { channel = "acceleration", column = "a", unit = "m/s^2", name = "acc1" } ]

[model]
name = "linear_oscillator"

[model.known]
m = 1.0

[model.estimate]
c = { median = 2.0, sd_log = 1.0 }
k = { median = 2.5e5, sd_log = 0.3 }
"""
WHEEL = """
[[recordings]]
file = "wheel.csv"
name = "{name}"
time = "t"
t_start = {start}
t_end = {end}
inputs = [ {{ input = "torque", column = "current", unit = "N m" }} ]
sensors = [ {{ channel = "position", column = "angle", unit = "deg", name = "encoder", noise = "quantised" }} ]
"""
DRIVE = """
[model]
name = "rigid_drive"
motion = "rotation"

[model.estimate]
m = { median = 0.05, sd_log = 1.0 }
c = { half_sd = 0.5 }
"""
RUBBING = {"bouc_wen_hysteresis", "dahl_friction", "lugre_friction", "coulomb_friction", "stribeck_friction"}


def diagnosed(folder, text):
    """Return what `diagnose` writes of a case in a folder."""
    (folder / "case.toml").write_text(text)
    done = CliRunner().invoke(
        main, ["diagnose", str(folder / "case.toml"), "--out", str(folder / "out"), "--jobs", "1", "--quiet"]
    )
    assert done.exit_code == 0, done.output
    return json.loads((folder / "out" / "diagnosis.json").read_text())


def written(path, columns):
    """Write columns by name as a table, with fewer digits than would matter."""
    np.savetxt(path, np.stack([*columns.values()], axis=1), delimiter=",", header=",".join(columns), comments="",
               fmt="%.9g")  # fmt: skip


@pytest.fixture(scope="module")
def beam(shared, tmp_path_factory):
    """The diagnosis of the first mode, and its frequency (Hz) and damping ratio by the Hilbert transform.

    Other modes (222 Hz and above) are taken off by a filter of zero phase, as one would before a fit of one mode.
    """
    place = shared / "data" / "brake_reuss_beam" / "HammerImpact.mat"
    if not place.is_file():
        pytest.skip(f"no recording: {place} is absent")
    seen = loadmat(place, simplify_cells=True)["HIdata"]
    low = filtfilt(firwin(801, 150.0, fs=12800.0, window=("kaiser", 8.0)), [1.0], seen["acc1"])
    t, wave = seen["time"][::16], hilbert(low)[::16]
    folder = tmp_path_factory.mktemp("beam")
    written(folder / "beam.csv", {"t": t, "a": wave.real})
    fitted = (t > 0.3) & (t < 1.49)
    omega = np.polyfit(t[fitted], np.unwrap(np.angle(wave[fitted])), 1)[0]
    fade = -np.polyfit(t[fitted], np.log(np.abs(wave[fitted])), 1)[0]
    return diagnosed(folder, BEAM), float(omega / (2.0 * math.pi)), float(fade / omega)


def test_a_ringing_beam_has_the_frequency_and_damping_of_its_signal(beam):
    """The linear model: within 0.1 % and 12 % of the Hilbert transform. One real recording: no chance."""
    found, frequency, ratio = beam
    k, c = (found["parameters"]["before"][key]["median"] for key in ("k", "c"))
    assert frequency == pytest.approx(80.5, rel=3e-3)
    assert math.sqrt(k) / (2.0 * math.pi) == pytest.approx(frequency, rel=1e-3)
    assert c / (2.0 * math.sqrt(k)) == pytest.approx(ratio, rel=0.12)


def test_friction_is_found_in_a_bolted_joint(beam):
    """Known of this beam: it slips in its joint, and softens with amplitude. One real recording: no chance."""
    found, _, ratio = beam
    (only,) = [entry for entry in found["found"] if entry["mechanism"] in RUBBING]
    assert len(found["found"]) == 1
    assert only["at"] == "ground"
    assert found["drive"]["of"] == "the inertial force"
    after = {key: found["parameters"]["after"][key]["median"] for key in ("k", "c")}
    assert after["k"] < found["parameters"]["before"]["k"]["median"]
    assert after["c"] / (2.0 * math.sqrt(after["k"])) < ratio
    assert found["fit"]["after"]["heldout_log_score"] > found["fit"]["before"]["heldout_log_score"]


@pytest.fixture(scope="module")
def wheel(shared, tmp_path_factory):
    """The diagnosis of the wheel that is switched off, and friction (A) and inertia (A s^2) by least squares.

    Nobody knows the torque constant: with 1 N m/A, torques are currents. The spin-up is held out.
    """
    place = shared / "data" / "gear_pair" / "gear.npz"
    if not place.is_file():
        pytest.skip(f"no recording: {place} is absent")
    with np.load(place) as seen:
        t, angle, shunt = seen["t"], -seen["y1"], seen["shunt"].astype(float)
    zero = shunt[t < 0.8].mean()
    current = filtfilt(firwin(501, 200.0, fs=50000.0), [1.0], shunt - zero) / 0.1
    folder = tmp_path_factory.mktemp("wheel")
    written(folder / "wheel.csv", {"t": t[::100], "current": current[::100], "angle": angle[::100]})
    coasting = (t > 3.2) & (t < 3.65)
    speeding = (t > 0.86) & (t < 1.0)
    slope = np.polyfit(t[coasting], np.deg2rad(angle[coasting]), 2)[0] * 2.0
    gained = np.polyfit(t[(t > 0.97) & (t < 1.0)], np.deg2rad(angle[(t > 0.97) & (t < 1.0)]), 1)[0]
    impulse, rested = float(current[speeding].mean() * 0.14), float(current[coasting].mean())
    inertia = impulse / (gained - slope * 0.14)
    pieces = [WHEEL.format(name="coasting", start=2.4, end=3.75), WHEEL.format(name="speeding", start=0.85, end=2.4)]
    return diagnosed(folder, "".join(pieces) + DRIVE), rested - inertia * slope, inertia


def test_friction_is_found_in_a_wheel_that_coasts(wheel):
    """Dry friction, as large as momentum and deceleration have it (30 %). One real recording: no chance."""
    found, friction, inertia = wheel
    (only,) = [entry for entry in found["found"] if entry["mechanism"] in RUBBING]
    force = next(iter(only["parameters"].values()))["median"]
    assert force == pytest.approx(friction, rel=0.3)
    assert found["parameters"]["after"]["m"]["median"] == pytest.approx(inertia, rel=0.3)
    assert found["fit"]["after"]["heldout_nrmse"] < found["fit"]["before"]["heldout_nrmse"]


def test_an_encoder_at_rest_is_no_overload(wheel):
    """The wheel rests before it starts. One real recording: no chance."""
    found, _, _ = wheel
    assert not [note for note in found["notes"] if "overloaded" in note]
    assert found["sensors"][0]["noise_sd"] == pytest.approx(math.radians(0.09) / math.sqrt(12.0), rel=0.6)
