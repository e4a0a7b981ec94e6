"""What the opening sentences of a diagnosis say: of changes either way, of loud noise, of sensors, and of nothing."""

from types import SimpleNamespace

import numpy as np
import pytest
import report_fixture as made

from lostmotion.diagnosis import verdict
from lostmotion.diagnosis.diagnosis_run import note_unused
from lostmotion.diagnosis.notes import note_large_noise
from lostmotion.diagnosis.report.opening import make_badge
from lostmotion.diagnosis.stages import _check_moving
from lostmotion.errors import DataError
from lostmotion.inference.setup import count_lasting_samples
from lostmotion.likelihood.observation import Observation, Sensor
from lostmotion.noises import AR1
from lostmotion.results import Interval, attach_unit
from lostmotion.results.diagnosis import Mechanism
from lostmotion.results.mismatch import UnexplainedForce
from lostmotion.settings import DEFAULT
from lostmotion_plugins.models.basic import LinearOscillator


def observed(readings, *names):
    """Return an observation of position sensors."""
    readings = np.asarray(readings, dtype=float).reshape(len(readings), -1)
    sensors = tuple(Sensor("position", name) for name in names) or (Sensor("position"),)
    return Observation("seen", readings, np.zeros((len(readings), 1)), 0.01, sensors)


def diagnosed(slow, *names, white=0.0):
    """Return as much of an outcome as sentences need: sensors that read a sine, of which so much passes for noise."""
    wave = np.sqrt(2.0) * np.sin(0.1 * np.arange(6283))
    shown = observed(np.stack([wave] * max(len(names), 1), axis=1), *names)
    problem = SimpleNamespace(
        observations=(shown,),
        noise=lambda theta, index, sensor: AR1().covariance((slow[sensor], 0.03), 0.01),
        measurement=lambda theta, index, sensor: slow[sensor] ** 2 + white**2,
    )
    after = SimpleNamespace(problem=problem, theta=np.zeros(0))
    problem.system = SimpleNamespace(model=LinearOscillator())
    diagnosis = SimpleNamespace(
        after=after, shown=shown, found=("friction",), named=(), unexplained=False, settings=DEFAULT
    )
    scales, horizon = [1.0] * len(shown.sensors), SimpleNamespace(number=1, unit="drive periods")
    return SimpleNamespace(diagnosis=diagnosis, after=SimpleNamespace(scales=scales), horizon=horizon)


@pytest.mark.parametrize(
    ("force", "error", "told"),
    [
        ((2.0, 1.0), (0.2, 0.1), "force falls from 2 to 1 N (rms), and * from 20 % to 10 %"),
        ((2.0, 1.0), (0.1, 0.2), "force falls from 2 to 1 N (rms), and * rises from 10 % to 20 %"),
        ((1.0, 2.0), (0.1, 0.2), "With it the free-running * rises from 10 % to 20 %"),
        ((1.0, 2.0), (0.2, 0.1), "With it the free-running * falls from 20 % to 10 %"),
    ],
)
def test_what_grows_is_not_said_to_fall(monkeypatch, force, error, told):
    outcome = diagnosed([0.0])
    outcome.before, outcome.after.nrmse = SimpleNamespace(nrmse=error[0]), error[1]
    monkeypatch.setattr(verdict, "compute_noise_floor", lambda _: 0.01)
    monkeypatch.setattr(verdict, "measure_unexplained", lambda _, after: UnexplainedForce(True, force[after], "N", 0.1))
    friction = Mechanism(mechanism="friction", probability=1.0, state="named", parameters={}, says="Friction acts.")
    said = verdict.summarise(outcome, [friction])[1]
    start, end = told.split(" * ")
    assert start in said
    assert f"over one drive period {end} of the response" in said


def test_a_force_within_the_noise_is_not_said_to_rise(monkeypatch):
    outcome = diagnosed([0.0])
    outcome.before, outcome.after.nrmse = SimpleNamespace(nrmse=0.2), 0.1
    monkeypatch.setattr(verdict, "compute_noise_floor", lambda _: 0.01)
    monkeypatch.setattr(
        verdict, "measure_unexplained", lambda _, after: UnexplainedForce(not after, 2.0 if after else 1.0, "N", 0.1)
    )
    friction = Mechanism(mechanism="friction", probability=1.0, state="named", parameters={}, says="Friction acts.")
    assert verdict.summarise(outcome, [friction])[1].startswith(
        "With it the free-running prediction error of held-out data over one drive period falls from 20 % to 10 %"
    )


def test_noise_that_may_be_motion_is_doubted():
    assert note_large_noise(diagnosed([0.2])) == []
    assert note_large_noise(diagnosed([0.0], white=0.7)) == []
    assert note_large_noise(diagnosed([0.0], white=0.9))[0].startswith(
        "The estimated noise is 90 % of the held-out readings"
    )
    assert note_large_noise(diagnosed([0.5]))[0].startswith(
        "The estimated noise is autocorrelated and is 50 % of the held-out readings"
    )
    (only,) = note_large_noise(diagnosed([0.1, 0.9], "front", "rear"))
    assert only.startswith("The estimated noise of rear is autocorrelated and is 90 %")


@pytest.mark.parametrize(("mechanism", "words"), [("random_force", "open"), ("unknown", "open"),
                                                  ("coulomb_friction", "named")])  # fmt: skip
def test_a_force_without_a_name_is_not_called_explained(mechanism, words):
    facts = made.mismatch()
    facts["found"][0] |= {"mechanism": mechanism, "state": words}
    assert make_badge(made.evidence(facts).result).words == f"Mismatch, {words}"


def test_a_number_without_a_dimension_has_no_unit():
    assert str(Interval(1.068, 0.888, 1.258, "1")) == "1.068 [0.888, 1.258]"
    assert str(Interval(1.068, 0.888, 1.258, "N")) == "1.068 N [0.888, 1.258]"


def test_a_sensor_that_stands_still_where_it_is_to_be_predicted_is_refused():
    """It was an error of division after minutes of work."""
    moving, still = np.arange(50.0), np.full(50, 3.0)
    _check_moving((observed(np.stack([moving, moving], axis=1), "front", "rear"),))
    with pytest.raises(DataError, match=r"^seen: the sensor 'rear' is constant in the held-out part.* t_end"):
        _check_moving((observed(np.stack([moving, still], axis=1), "front", "rear"),))


@pytest.mark.parametrize("rests", [0.28, 0.31, 0.5])
def test_what_is_held_out_still_moves(rests):
    """A machine that stops: the part at rest is held out beside a part of the motion, never alone."""
    t = np.linspace(0.0, 1.0, 3000)
    turned = 0.09 * np.round(500.0 * np.minimum(t, 1.0 - rests) / 0.09)
    cut = round(0.7 * count_lasting_samples(observed(turned)))
    assert t[cut] < 1.0 - rests


def test_known_values_of_terms_are_not_passed_over_in_silence():
    (note,) = note_unused(["m", "sensor_delay@load encoder.delay"])
    assert "sensor_delay@load encoder.delay" in note
    assert "not used" in note
    assert note_unused(["m", "k"]) == []


def test_pure_numbers_have_no_unit():
    """A report said `a further mass of 0.112 1 of the moving one` where intervals are withheld."""
    assert attach_unit("0.112", "1") == "0.112"
    assert attach_unit("3.1", "N") == "3.1 N"
