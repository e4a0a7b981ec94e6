"""The recording of the demo: chaotic, with friction that sticks, the same for the same seed, and a case that loads."""

import math

import numpy as np
import pytest

from lostmotion.case import load_case
from lostmotion_trials.demo.conceal import FREQUENCY, FRICTION, HIDDEN, JOINT, conceal_joint, simulate_joint, write_case

RATE = 200.0
PERIOD = round(RATE / FREQUENCY)


@pytest.fixture(scope="module")
def concealed():
    return conceal_joint(np.random.default_rng(3))


def test_encoders_show_a_link_that_rattles_in_the_gap(concealed):
    gap = math.degrees(JOINT["x0"])
    twist = concealed.position - concealed.base_position
    assert len(concealed.time) == pytest.approx(60 * RATE / FREQUENCY, abs=1)
    assert np.diff(concealed.time) == pytest.approx(1.0 / RATE)
    assert twist.min() < -gap < gap < twist.max()
    assert np.mean(np.abs(twist) < gap) > 0.5
    assert 0.005 < 0.015 / concealed.position.std() < 0.01


def test_friction_sticks_and_nothing_sticks_without_it(concealed):
    assert 0.002 < concealed.stuck < 0.2
    assert conceal_joint(np.random.default_rng(3), periods=5, friction=0.0).stuck == 0.0


def test_encoders_add_what_they_are_said_to(concealed):
    quiet = conceal_joint(np.random.default_rng(3), noise=0.0)
    assert np.std(concealed.position - quiet.position) == pytest.approx(0.015, rel=0.05)
    assert np.std(concealed.base_position - quiet.base_position) == pytest.approx(0.003, rel=0.05)


def test_truth_is_complete(concealed):
    assert concealed.truth == {**JOINT, HIDDEN: FRICTION}
    assert set(concealed.nominal.known) | set(concealed.nominal.estimate) == set(JOINT)


def test_one_seed_makes_one_recording(concealed):
    again, other = (conceal_joint(np.random.default_rng(seed)) for seed in (3, 4))
    np.testing.assert_array_equal(again.position, concealed.position)
    assert np.std(other.position - concealed.position) > 0.1


@pytest.mark.parametrize(("friction", "low", "high"), [(FRICTION, 0.8, 1.6), (0.0, 2.0, 2.9)])
def test_two_neighbours_part_exponentially(friction, low, high):
    """Largest exponent (1/s) from pairs 1e-7 deg apart, followed up to 1e-3 deg, which is far below the gap."""
    rates = [divergence(friction, start) for start in np.linspace(-0.4, 0.4, 10)]
    assert low < np.median(rates) < high


def divergence(friction, start):
    """Return the mean growth rate (1/s) of the distance between two neighbours after they have settled."""
    one, two = (simulate_joint(0.0, start + d, friction, RATE, 50 * PERIOD)[1] for d in (0.0, 1e-7))
    away = np.hypot(one[:, 0] - two[:, 0], (one[:, 1] - two[:, 1]) / 60.0)
    apart = np.flatnonzero(away > 1e-3)
    stop = apart[0] if len(apart) else len(away) - 1
    return math.log(max(away[stop], 1e-12) / 1e-7) / (stop / RATE)


def test_case_loads_and_gives_the_recording_back(concealed, tmp_path):
    case = load_case(write_case(concealed, tmp_path / "new"))
    table = np.genfromtxt(tmp_path / "new" / "recording.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["link"], concealed.position)
    assert table.dtype.names == ("time", "base", "link")
    assert (case.model, case.truth) == ("robot_joint", concealed.truth)
    assert set(case.known) | set(case.estimate) == set(JOINT)
    for key, prior in case.estimate.items():
        assert prior.low < JOINT[key] / 3 < 3 * JOINT[key] < prior.high


def test_same_recording_same_bytes(concealed, tmp_path):
    one, two = (write_case(concealed, tmp_path / name).parent for name in ("a", "b"))
    for file in ("recording.csv", "case.toml"):
        assert (one / file).read_bytes() == (two / file).read_bytes()
    assert {p.name for p in one.iterdir()} == {"recording.csv", "case.toml"}
