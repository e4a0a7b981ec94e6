"""A measured force as the response: read, given to the channel of the model, and where the filter starts from it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import CaseError, DataError
from lostmotion.likelihood.observation import Observation, find_static_equilibrium, make_observation
from lostmotion.recording import Channel, RecordingSpec, load_recording
from lostmotion_plugins.models.basic import RigidDrive
from lostmotion_plugins.models.slider import BacklashSlider

TIME = np.arange(400) / 100.0
BASE, FORCE = np.sin(TIME), np.sign(np.cos(TIME)) + 0.1 * np.cos(7.0 * TIME)
SPEC = RecordingSpec(
    "a.npz", "t", None, (Channel("x", "base_position", "inch"),), (Channel("F", "force", "kip"),), t_end=3.99
)
MODEL = BacklashSlider()
VALUES = np.array([2.0, 0.0, 1000.0, 0.01])
"""m, c, k0, x0."""


def write(folder: Path, **changed: np.ndarray) -> Path:
    np.savez(folder / "a.npz", **{"t": TIME, "x": BASE, "F": FORCE, **changed})
    return folder


def test_a_force_is_a_response_in_any_unit(tmp_path: Path) -> None:
    got = load_recording(SPEC, write(tmp_path)).data
    np.testing.assert_allclose(got.response, 4448.2216 * FORCE, rtol=1e-7)
    np.testing.assert_allclose(got.excitation, 0.0254 * BASE, rtol=1e-12)
    assert (got.response.attrs["units"], got.response.attrs["quantity"]) == ("N", "force")
    pounds = replace(SPEC, sensors=(Channel("F", "force", "lbf"),))
    np.testing.assert_allclose(load_recording(pounds, tmp_path).data.response, 4.4482216 * FORCE, rtol=1e-7)


def test_samples_of_a_measured_force_may_be_lost_and_those_of_a_drive_are_bridged_one_by_one(tmp_path: Path) -> None:
    spoilt = FORCE.copy()
    spoilt[7] = np.nan
    write(tmp_path, F=spoilt)
    assert int(np.isnan(load_recording(SPEC, tmp_path).data.response).sum()) == 1
    drive = replace(SPEC, inputs=(Channel("F", "force", "kip"),), sensors=(Channel("x", "position", "inch"),))
    got = load_recording(drive, tmp_path)
    assert float(got.data.excitation[7]) == pytest.approx(4448.2216 * FORCE[7], rel=1e-3)
    assert any("1 of 400" in note and "interpolated" in note for note in got.notes)
    spoilt[7:12] = np.nan
    with pytest.raises(DataError, match="NaN"):
        load_recording(drive, write(tmp_path, F=spoilt))


@pytest.mark.parametrize(("quantity", "unit"), [("force", "N"), ("torque", "N m")])
def test_force_and_torque_are_the_channel_force(tmp_path: Path, quantity: str, unit: str) -> None:
    spec = replace(SPEC, sensors=(Channel("F", quantity, unit),))
    assert make_observation(load_recording(spec, write(tmp_path)), MODEL).channel == "force"


def test_a_model_that_shows_no_force_is_refused(tmp_path: Path) -> None:
    spec = replace(SPEC, inputs=(Channel("x", "force", "N"),))
    with pytest.raises(CaseError, match="rigid_drive shows position, velocity, acceleration, but the response of a is"):
        make_observation(load_recording(spec, write(tmp_path)), RigidDrive())


def at_rest(force: float) -> Observation:
    """A base that moves by 0.1 m and begins at 0.02 m; the force alternates by 0.001 N, which is taken for noise."""
    ripple = force + 1e-3 * (-1.0) ** np.arange(50)
    base = np.stack([0.02 + np.linspace(0.0, 0.1, 50), np.zeros(50)], axis=1)
    return Observation.of("a", ripple, base, 0.01, "force")


@pytest.mark.parametrize("force", [5.0, -5.0])
def test_in_contact_the_start_is_where_the_model_shows_the_force(force: float) -> None:
    """Contact: position = base - sign (force / k0 + x0), to within ten times the noise over k0."""
    observation = at_rest(force)
    where, spread = find_static_equilibrium(observation, MODEL, VALUES)
    assert where == pytest.approx(0.02 - np.sign(force) * (abs(force) / 1000.0 + 0.01), abs=2e-6)
    assert spread == pytest.approx(10.0 * observation.noise / 1000.0, rel=1e-6)


def test_inside_the_gap_all_of_it_is_possible() -> None:
    observation = replace(at_rest(0.0), readings=np.append(0.0, at_rest(0.0).response[1:])[:, None])
    where, spread = find_static_equilibrium(observation, MODEL, VALUES)
    assert where == pytest.approx(0.02, abs=1e-6)
    assert spread == pytest.approx(0.01 + 10.0 * observation.noise / 1000.0, rel=1e-6)


def test_a_force_that_the_model_cannot_show_leaves_the_start_open() -> None:
    where, spread = find_static_equilibrium(at_rest(1e9), MODEL, VALUES)
    assert (where, spread) == (0.02, pytest.approx(0.1))
