"""Corrections for the usual errors that a hypothesis found, and the course of a search for explanations."""

from dataclasses import replace

import numpy as np
import pytest
from explained import ODDS, VALUES, T, made_of
from sensed import multisine

from lostmotion.diagnosis.stages import find_quantised
from lostmotion.evidence import course as course_module
from lostmotion.evidence.bare import Budget
from lostmotion.evidence.channel_errors import DriveError, SensorError, list_channel_errors
from lostmotion.evidence.corrections import CLEAR, Corrections, find_corrections
from lostmotion.evidence.course import Course
from lostmotion.evidence.discrepancy import make_frame
from lostmotion.evidence.effects import list_promises
from lostmotion.evidence.hypothesis import fit_hypothesis
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import maximise
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.noises import AR1_LEVEL, AR1_MEMORY

KEYS = ("coulomb_friction", "cubic_stiffness")
NOTHING, FRICTION = frozenset(), frozenset({"coulomb_friction"})
FIRST, SAMPLES = 100, 20


def nothing(x, v, t):
    """Return no force (N)."""
    return 0.0


def rub(x, v, t):
    """Return dry friction of 0.8 N (N), without sticking."""
    return -0.8 * np.tanh(v / 1e-3)


def nominal_of(folder, extra, **made):
    """Return the nominal fit of a recording of the oscillator with a further force."""
    prepared, system = made_of(folder, extra, **made)
    train, _ = split_heldout(prepared.observations)
    return search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))


@pytest.fixture(scope="module")
def clean(tmp_path_factory):
    """The nominal fit of an oscillator that hides nothing."""
    return nominal_of(tmp_path_factory.mktemp("clean"), nothing)


def suppose_nothing(nominal):
    """Return the hypothesis that nothing is missing."""
    wide = add_all_curves(nominal)
    errors = list_channel_errors(nominal, list(nominal.posterior.observations))
    frame = make_frame(wide.posterior, wide.theta, errors, ODDS)
    return fit_hypothesis(frame, frame.start, 0.0)


@pytest.fixture(scope="module")
def hypothesis(clean):
    """The hypothesis of nothing missing."""
    return suppose_nothing(clean)


def shifted(found, name, deviations):
    """Return a hypothesis with one coordinate this many posterior standard deviations from its prior mean."""
    i, at = found.frame.names.index(name), found.at.copy()
    sds = dict(zip(found.used.tolist(), np.sqrt(np.diag(np.linalg.inv(found.precision))), strict=True))
    middle = np.concatenate([np.zeros(found.frame.own), found.frame.middle])
    at[i] = middle[i] + deviations * sds[i]
    return replace(found, expansion=replace(found.expansion, at=at)), float(at[i] - middle[i])


def test_a_clean_machine_needs_no_correction(hypothesis, clean):
    none = find_corrections(hypothesis)
    assert not none
    observation = clean.posterior.observations[0]
    assert none.correct(observation) is observation
    assert none.refit(clean) is clean
    assert list(none.describe(observation)) == []


@pytest.mark.parametrize(("late", "found"), [(0.4, True), (0.15, False)])
def test_an_error_beyond_its_bound_is_proposed_as_a_law(tmp_path, late, found):
    """A drive is late by 0.3 samples at most, or has a name: a promise must not assume that more is usual."""
    fit = add_all_curves(nominal_of(tmp_path, nothing, late=late * (T[1] - T[0])))
    frame = make_frame(fit.posterior, fit.theta, list_channel_errors(fit, list(fit.posterior.observations)), ODDS)
    empty = fit_hypothesis(frame, frame.start, 0.0)
    assert (frame.count - 1 in frame.list_pressed(empty.at)) is found
    promises = list_promises(empty, ["excitation_delay"], {}, {"excitation_delay": 0.0}, (), 0.0)
    assert any(one.gain > 10.0 for one in promises) is found


@pytest.mark.parametrize(("deviations", "clear"), [(0.9 * CLEAR, False), (1.1 * CLEAR, True), (-1.1 * CLEAR, True)])
def test_channels_are_corrected_where_one_of_them_is_clearly_wrong(hypothesis, deviations, clear):
    moved, size = shifted(hypothesis, "channel error 1", deviations)
    found = find_corrections(moved)
    assert bool(found.errors) is clear
    assert not found.factors
    if clear:
        assert len(found.errors) == len(hypothesis.frame.errors)
        assert found.errors[1] == (hypothesis.frame.errors[1], pytest.approx(size))


def test_a_known_value_is_corrected_by_its_factor(hypothesis, clean):
    moved, size = shifted(hypothesis, "m", 1.5 * CLEAR)
    found = find_corrections(moved)
    assert not found.errors
    ((name, factor),) = found.factors
    assert name == "m"
    assert factor == pytest.approx(np.exp(size))
    fit = found.refit(clean)
    at = fit.posterior.system.index["m"]
    assert fit.posterior.known[at] == pytest.approx(factor * clean.posterior.known[at])
    assert clean.posterior.known[at] == VALUES["m"], "the fit before is unchanged"
    assert f"m is {factor:.4g} times its known value" in list(found.describe(clean.posterior.observations[0]))


def test_errors_that_only_together_are_clear_are_corrected_and_leave_no_force(tmp_path):
    """A mass that is stated 4.5 % too large has the effect of a wrong scale of the force or of the position."""
    nominal = nominal_of(tmp_path, nothing, stated=1.045)
    found = suppose_nothing(nominal)
    right = find_corrections(found)
    ((name, factor),) = right.factors
    assert name == "m"
    assert factor == pytest.approx(1.0 - 0.015, abs=0.006)
    sds = dict(zip(found.used.tolist(), np.sqrt(np.diag(found.joint_covariance)), strict=True))
    sizes = [size / sds[i] for (_, size), i in zip(right.errors, range(found.frame.channels.start, 99), strict=False)]
    assert max(map(abs, sizes)) < CLEAR
    assert not has_usual_random_force(nominal)
    assert has_usual_random_force(right.refit(nominal))
    said = list(right.describe(nominal.posterior.observations[0]))
    assert [one.startswith(("the scale of", "m is")) for one in said] == [True, True, True, False]
    assert said[-1].startswith("or one of these errors is larger")


def test_a_recording_is_corrected_by_sizes_and_shapes(clean):
    observation = clean.posterior.observations[0].part(FIRST, FIRST + SAMPLES)
    shape = np.arange(float(clean.posterior.observations[0].samples))
    sensor, drive = SensorError(0, 2, {observation.name: (0, shape)}, 0.01), DriveError(0, False, 0.01)
    right = Corrections(((sensor, 2e-6), (drive, 0.05)), clear=(True, True))
    found = right.correct(observation)
    assert found.readings[:, 0] - observation.readings[:, 0] == pytest.approx(2e-6 * np.arange(FIRST, FIRST + SAMPLES))
    assert found.inputs[:, 0] == pytest.approx(1.05 * observation.inputs[:, 0])
    assert list(right.describe(observation)) == [
        f"{observation.sensors[0].label} has a quadratic error of 0.0002 % of its range",
        f"the scale of {observation.driven[0]} is wrong by 5 %",
    ]
    assert list(replace(right, clear=(False, True)).describe(observation)) == list(right.describe(observation))[1:]


def test_quantisation_is_read_from_the_values_as_they_were_stored(clean):
    """A correction, here of hum, moves the values from the multiples of the step."""
    stored = clean.posterior.observations[0]
    step = 0.05 * float(np.std(stored.readings))
    stored = replace(stored, readings=step * np.round(stored.readings / step))
    hum = 0.2 * step * np.sin(2.0 * np.pi * 7.3 * stored.time)
    fit = maximise(clean.posterior.on((replace(stored, readings=stored.readings + hum[:, None]),)), clean.theta)
    ((key, (values, _)),) = find_quantised(fit, (stored,)).items()
    assert key.startswith("sensor_quantisation")
    assert values == pytest.approx([step])
    assert find_quantised(fit, fit.posterior.observations) == {}


def test_a_drive_that_is_late_is_corrected_to_when_it_acted(clean):
    """The linear shift of a smooth force by 0.3 samples; what its curvature adds is below 3 %."""
    force, dt = multisine(10.0, 0.5, 5.0, 0), T[1] - T[0]
    observation = clean.posterior.observations[0]
    shown = replace(observation, inputs=force(observation.time)[:, None])
    late = Corrections(((DriveError(0, True, 0.1), -0.3),), clear=(True,))
    right = late.correct(shown).inputs[:, 0]
    assert right == pytest.approx(force(observation.time - 0.3 * dt), abs=0.3)
    assert np.abs(shown.inputs[:, 0] - force(observation.time - 0.3 * dt)).max() > 0.8
    assert list(late.describe(shown)) == [f"{shown.driven[0]} is late by 0.3 samples"]


def test_a_course_finds_friction_and_keeps_the_model_without_it(tmp_path):
    nominal = nominal_of(tmp_path, rub)
    found = Course(KEYS, (), Budget(seconds=600.0), lambda _: None).find_explanations(nominal)
    assert found.terms == FRICTION
    assert {NOTHING, FRICTION} <= set(found.found) & set(found.fits)
    assert found.nominal.posterior.system is nominal.posterior.system
    assert found.skipped == ()


def test_a_course_without_time_says_what_it_did_not_extend(tmp_path):
    nominal = nominal_of(tmp_path, rub)
    found = Course(KEYS, (), Budget(seconds=0.0), lambda _: None).find_explanations(nominal)
    assert found.terms == NOTHING
    assert found.skipped == ("no term",)


def test_a_long_recording_is_searched_on_stretches_and_weighed_on_all_samples(tmp_path, monkeypatch):
    nominal = nominal_of(tmp_path, rub)
    whole = nominal.posterior.observations[0]
    parts = (whole.part(0, 150), whole.part(whole.samples - 150, whole.samples))
    monkeypatch.setattr(course_module, "cut_stretches", lambda posterior: posterior.on(parts))
    steps = []
    found = Course(KEYS, (), Budget(seconds=600.0), steps.append).find_explanations(nominal)
    assert "search on 300 samples in 2 stretches" in steps
    assert found.terms == FRICTION
    assert all(one.frame.posterior.samples == whole.samples for one in found.found.values())
    assert all(fit.posterior.samples == whole.samples for fit in found.fits.values())
    assert NOTHING in found.found
    assert set(found.promised) == set(KEYS)


def test_noise_with_a_memory_is_no_force_and_is_part_of_every_explanation(tmp_path):
    """Noise of the sensor that lasts for 5 samples, 2 % of the motion. One seeded recording."""
    rng, share = np.random.default_rng(6), np.exp(-1.0 / 5.0)
    slow = np.zeros(len(T))
    for i, step in enumerate(np.sqrt(1.0 - share**2) * rng.standard_normal(len(T))):
        slow[i] = share * slow[i - 1] + step
    nominal = nominal_of(tmp_path, nothing, shown=lambda x: x + 0.02 * x.std() * slow)
    found = Course(KEYS, (), Budget(seconds=600.0), lambda _: None).find_explanations(nominal)
    assert found.terms == NOTHING
    for one in found.found.values():
        assert {AR1_LEVEL, AR1_MEMORY} <= set(one.frame.posterior.space.keys)
    assert np.exp(found.nominal.values[AR1_MEMORY]) == pytest.approx(0.1, rel=0.5)


def test_a_cancelled_search_gives_the_best_explanation_so_far(tmp_path):
    """The user cancels once nothing missing was weighed; before that there is no answer, and the command ends."""
    told, nominal = [], nominal_of(tmp_path, rub)

    def cancel_after(text):
        def say(now):
            told.append(now)
            if told[-2:-1] == [text]:
                raise KeyboardInterrupt

        return say

    found = Course(KEYS, (), Budget(seconds=600.0), cancel_after("weighing no term")).find_explanations(nominal)
    assert found.terms == {"coulomb_friction"}
    assert found.skipped == ("any set",)
    assert told[-1] == "cancelled: the best explanation so far"
    with pytest.raises(KeyboardInterrupt):
        Course(KEYS, (), Budget(seconds=600.0), cancel_after("score tests beside no term")).find_explanations(nominal)
