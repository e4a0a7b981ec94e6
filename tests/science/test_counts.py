"""Encoders that count: changes since the row before, an arbitrary zero, and readings at a jittering time."""

import math

import numpy as np
import pytest
from independent import FINE, leapfrog

import lostmotion as lm
from lostmotion.errors import CaseError, DataError
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry

RATE, SAMPLES, M, C, K, FRICTION = 500.0, 5000, 1.0, 4.0, 900.0, 1.5
COUNT, LATE = 2e-5, 3e-4
"""A count of the linear encoder (m); the deviation (s) of the time at which it is read."""
WAVES = ((8.0, 2.1), (6.0, 4.7), (5.0, 7.3), (4.0, 11.2))
"""Amplitudes (N) and frequencies (Hz) of the force."""

CASE = """
[[recordings]]
file = "run.csv"
time = "time"
inputs = [{{ input = "force", column = "force", unit = "N" }}]
sensors = [{{ channel = "position", column = "counts", unit = "um", factor = 20, {more} }}]
[model]
equations = ["m*x'' + c*x' + k*x = force"]
[model.known]
m = 1.0
[model.estimate]
c = {{ low = 0.4, high = 40.0, scale = "log" }}
k = {{ low = 300.0, high = 3000.0, scale = "log" }}
"""
CHANGES = 'differences = true, noise = "quantised + jitter"'


def force_at(t):
    return sum(a * np.cos(2.0 * np.pi * f * t + 0.7 * i * i) for i, (a, f) in enumerate(WAVES))


def write_counts(folder, friction, seed=0, more=CHANGES):
    """Write what the counter shows in each row since the row before, and a case; the machine has dry friction (N)."""
    step = 1.0 / RATE / FINE
    middles = (np.arange(SAMPLES * FINE) + 0.5) * step
    states = leapfrog(force_at(middles), (M, C, K, 0.0, 1.0, friction, 0.0, 0.0), (0.011, 0.0), step, FINE)
    rng = np.random.default_rng(seed)
    seen = states[:, 0] + states[:, 1] * LATE * rng.standard_normal(SAMPLES)
    total = np.floor((seen + 0.123) / COUNT)
    t = np.arange(SAMPLES) / RATE
    rows = np.c_[t, force_at(t) + 0.01 * rng.standard_normal(SAMPLES), np.diff(total, prepend=total[0] - 17.0)]
    np.savetxt(folder / "run.csv", rows, delimiter=",", header="time,force,counts", comments="", fmt="%.7g")
    (folder / "case.toml").write_text(CASE.format(more=more))
    return folder / "case.toml"


@pytest.fixture(scope="module")
def counted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("counts")
    return lm.diagnose(lm.Case.read(write_counts(folder, FRICTION)), jobs=1, seed=1)


@pytest.mark.slow
def test_friction_is_found_in_counts(counted):
    """The true force lies in the interval, and the jitter is that of the reading: 0.3 ms."""
    (found,) = (one for one in counted.found if one.state == "named")
    assert found.mechanism == "coulomb_friction"
    interval = found.parameters["force"]
    assert interval.low < FRICTION < interval.high
    assert interval.high - interval.low < 0.3
    assert "The stamps of the sensor jitter by 300 us (sd)." in counted.notes


@pytest.mark.slow
def test_nothing_is_found_in_counts_of_a_machine_without_friction(tmp_path):
    found = lm.diagnose(lm.Case.read(write_counts(tmp_path, 0.0)), jobs=1, seed=1)
    assert found.found == ()


def test_changes_are_summed_and_the_zero_is_free(tmp_path):
    """The first row counts from before the recording: its change is left out."""
    prepared = prepare(write_counts(tmp_path, FRICTION), Registry.discover())
    (sensor,) = prepared.observations[0].sensors
    assert (sensor.loose, [n.name for n in sensor.noises]) == (True, ["quantised", "jitter"])
    x = prepared.observations[0].readings[:, 0]
    steps = np.diff(x) / COUNT
    assert np.abs(steps - np.rint(steps)).max() < 1e-4
    assert abs(x.mean()) < 1e-9
    assert np.ptp(x) == pytest.approx(0.0963, abs=1e-3)


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ("differences = 1", "expected true or false"),
        ('zero = "free"', "expected one of known, unknown"),
        ('noise = "jiter"', "jitter"),
    ],
)
def test_wrong_keys_are_refused(tmp_path, more, says):
    with pytest.raises((CaseError, lm.LostMotionError), match=says):
        prepare(write_counts(tmp_path, 0.0, more=more), Registry.discover())


def test_a_lost_change_is_refused_with_its_row(tmp_path):
    case = write_counts(tmp_path, 0.0)
    lines = (tmp_path / "run.csv").read_text().splitlines()
    lines[40] = ",".join([*lines[40].split(",")[:2], ""])
    (tmp_path / "run.csv").write_text("\n".join(lines) + "\n")
    with pytest.raises(DataError, match=r"sample 39.*unknown: cut the recording there"):
        prepare(case, Registry.discover())


def test_jitter_of_a_sensor_is_the_speed_times_the_time(tmp_path):
    """The modelled speed makes the noise, so readings at the turning points weigh more than those in between."""
    prepared = prepare(write_counts(tmp_path, 0.0), Registry.discover())
    noise = prepared.observations[0].sensors[0].noises[1]
    assert math.sqrt(noise.covariance((LATE,), 1.0 / RATE).clock) == pytest.approx(LATE)
