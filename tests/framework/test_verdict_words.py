"""What the opening sentences of a diagnosis say: of changes either way, of loud noise, of sensors, and of nothing."""

from dataclasses import replace

import numpy as np
import pytest
import report_fixture as made
from made_facts import FRICTION, make_facts, make_found, make_prediction, make_sensor

from lostmotion.diagnosis.diagnosis_run import note_unused
from lostmotion.diagnosis.facts import PriorBound
from lostmotion.diagnosis.notes import note_large_noise, write_notes
from lostmotion.diagnosis.report.opening import make_badge
from lostmotion.diagnosis.stages import _check_moving
from lostmotion.diagnosis.verdict import summarise
from lostmotion.errors import DataError
from lostmotion.inference.setup import count_lasting_samples
from lostmotion.inference.unseen import BodyPosition
from lostmotion.likelihood.observation import Observation, Sensor
from lostmotion.results import Interval, attach_unit
from lostmotion.results.diagnosis import Mechanism
from lostmotion.results.mismatch import UnexplainedForce


def observed(readings, *names):
    """Return an observation of position sensors."""
    readings = np.asarray(readings, dtype=float).reshape(len(readings), -1)
    sensors = tuple(Sensor("position", name) for name in names) or (Sensor("position"),)
    return Observation("seen", readings, np.zeros((len(readings), 1)), 0.01, sensors)


FOUND = Mechanism(mechanism="friction", probability=1.0, state="named", parameters={}, says="Friction acts.")


def summarise_forces(forces, errors):
    """Return the sentence on forces (N rms) and errors before and after a law was found."""
    before, after = (UnexplainedForce(True, force, "N", 0.1) for force in forces)
    predictions = [make_prediction(error) for error in errors]
    facts = make_facts(
        make_found(FRICTION), force_before=before, force_after=after, before=predictions[0], after=predictions[1]
    )
    return summarise(facts, [FOUND])[1]


@pytest.mark.parametrize(
    ("force", "error", "told"),
    [
        ((2.0, 1.0), (0.2, 0.1), "force falls from 2 to 1 N (rms), and * from 20 % to 10 %"),
        ((2.0, 1.0), (0.1, 0.2), "force falls from 2 to 1 N (rms), and * rises from 10 % to 20 %"),
        ((1.0, 2.0), (0.1, 0.2), "With it the free-running * rises from 10 % to 20 %"),
        ((1.0, 2.0), (0.2, 0.1), "With it the free-running * falls from 20 % to 10 %"),
    ],
)
def test_what_grows_is_not_said_to_fall(force, error, told):
    said = summarise_forces(force, error)
    start, end = told.split(" * ")
    assert start in said
    assert f"over one drive period {end} of the response" in said


def test_a_force_on_another_body_is_told_on_the_first_one():
    both = make_facts(make_found(FRICTION), on_other_body=True)
    assert "the unexplained force, if it acts on the first body, falls from 2 to 1 N" in summarise(both, [FOUND])[1]


def make_noisy_drive():
    """Return a recording of noise under a force of 2 N, of which 0.01 N (rms) were left out."""
    force = 2.0 * np.sin(0.1 * np.arange(4000.0))
    seen = np.random.default_rng(0).standard_normal(4000)
    return replace(Observation.of("noisy", seen, force[:, None], 0.01, "position"), gauge_noise=0.01)


def test_noise_that_may_be_motion_is_doubted():
    def doubt(*sensors):
        return note_large_noise.write(make_facts(sensors=sensors))

    assert doubt(make_sensor(sd=0.2, slow=0.2)) == ()
    assert doubt(make_sensor(sd=0.7)) == ()
    assert doubt(make_sensor(sd=0.9))[0].startswith("The estimated noise is 90 % of the held-out readings")
    assert doubt(make_sensor(sd=0.5, slow=0.5))[0].startswith(
        "The estimated noise is autocorrelated and is 50 % of the held-out readings"
    )
    (only,) = doubt(make_sensor(name="front", sd=0.1, slow=0.1), make_sensor(name="rear", sd=0.9, slow=0.9))
    assert only.startswith("The estimated noise of rear is autocorrelated and is 90 %")


def test_sets_that_were_not_extended_are_told_in_words():
    (note,) = write_notes(make_facts(skipped=("coulomb_friction and offset_force", "no term")))
    assert "beside Coulomb friction and offset force or no term was not tried" in note


def test_only_a_named_law_is_left_out_of_the_model_by_words():
    """A learned curve is a part of the augmented model and has no name."""
    curve = Mechanism(mechanism="unknown", probability=1.0, state="open", parameters={}, says="It is learned.")
    facts = make_facts(make_found(FRICTION))
    assert summarise(facts, [FOUND])[0] == "Friction acts, and the model leaves it out."
    assert summarise(facts, [curve])[0] == "It is learned."


@pytest.mark.parametrize(
    ("changes", "start"),
    [
        ({"bounds": (PriorBound("c", 3.0, "N s/m"),)}, "c is at the bound 3 N s/m of its prior"),
        (
            {"after": make_prediction(0.2)},
            "The error of free runs over held-out data is 20 times the",
        ),
        ({"corrected": ("the gain is 1.02",)}, "Usual errors of channels and known values are corrected: the gain is"),
        ({"skipped": ("a", "b"), "explanations": 7}, "The search used up its processor time after 7 explanations"),
        ({"recordings": (make_noisy_drive(),)}, "The drive repeats, but for 0.5 % of its amplitude (rms)."),
        ({"sensors": (make_sensor(words=("Noise drifts.",)),)}, "Noise drifts."),
        ({"contacts": ("A bounce is short.",)}, "A bounce is short."),
        ({"position": BodyPosition(np.array([1.0, -1.0]), np.full(2, 0.05))}, "No sensor measures the position: it is"),
        ({"position": BodyPosition(np.zeros(2), np.full(2, np.inf))}, "No sensor measures the position, and the"),
    ],
)
def test_a_note_is_written_where_its_facts_are_there_and_nowhere_else(changes, start):
    assert write_notes(make_facts()) == ()
    (note,) = write_notes(make_facts(**changes))
    assert note.startswith(start)


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
