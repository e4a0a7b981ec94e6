"""The terms that engineers leave out: each is found in a recording by another integrator, and so is its onset."""

import json
import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from explained import ODDS, explain, made_of
from sensed import case_of, model_of, moved, multisine, noisy

from lostmotion.evidence.discrepancy import make_frame
from lostmotion.evidence.effects import list_bare_promises, list_promises
from lostmotion.evidence.hypothesis import fit_hypothesis
from lostmotion.inference.candidates import fit_term, join_term, make_term_parameters
from lostmotion.inference.late import (
    TIMES,
    can_have_onset,
    estimate_onset,
    find_onset,
    list_onsets,
    onset_key,
    refine_onset,
)
from lostmotion.inference.likeness import find_likeness
from lostmotion.inference.natural import hold_shape, list_star_points, list_tried_values, sort_slots
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.inference.shape_scan import scan_shapes
from lostmotion.likelihood.bends import correct_bends, rescale_innovations
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import ALWAYS, System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry, default
from lostmotion_plugins.terms.elastic import CubicStiffness, LinearStiffness, OffsetForce
from lostmotion_plugins.terms.friction import CoulombFriction
from lostmotion_plugins.terms.friction_kinds import DirectionalFriction
from lostmotion_plugins.terms.lag import ActuatorLag, SensorLag, apply_lag
from lostmotion_plugins.terms.play import Backlash, EndStop
from lostmotion_plugins.terms.sensor import PositionRipple, SensorGain
from lostmotion_plugins.terms.viscous import QuadraticDamping
from lostmotion_trials.blind.bound import are_equivalent, complete_parameters
from lostmotion_trials.blind.mechanisms import TABLE
from lostmotion_trials.blind.simulator import BlindDrive

VALUES = {"m": 1.2, "c": 0.8, "k": 300.0}
T = np.arange(0.0, 12.0, 0.02)
RUBBED, LATE = 1.5, 3.1
"""Dry friction in N, and when it sets in (s)."""
LIBRARY = Path(__file__).parents[2] / "benchmarks"
NEW = (
    "backlash", "bilinear_stiffness", "cogging", "damping_drift", "directional_damping", "directional_friction",
    "drive_dead_zone", "drive_saturation", "end_stop", "friction_drift", "hertz_contact", "hidden_mode",
    "hunt_crossley_contact", "inertia_change", "load_dependent_friction", "position_dependent_friction",
    "position_ripple",
)  # fmt: skip


def nominal_of(folder, terms, *, extra=lambda x, v, t: 0.0, spring=lambda x: x, seed=0, shown=lambda x: x):
    """Return the nominal fit of an oscillator under a multisine, by DOP853, in a system of some terms."""
    force = multisine(10.0, 0.5, 5.0, seed)

    def rates(t, y):
        pull = float(force(t)) - VALUES["c"] * y[1] - VALUES["k"] * spring(y[0]) + extra(y[0], y[1], t)
        return [y[1], pull / VALUES["m"]]

    x = moved(rates, T, [0.0, 0.0])[:, 0]
    columns = {"t": T, "F": force(T), "x": noisy(shown(x), 0.003, seed)}
    recording = {
        "excitation": {"column": "F", "quantity": "force", "unit": "N"},
        "response": {"column": "x", "quantity": "position", "unit": "m"},
    }
    model = model_of("linear_oscillator", VALUES, ("c", "k"))
    prepared = prepare(case_of(folder, columns, recording, model), Registry.discover())
    train, _ = split_heldout(prepared.observations)
    system = System(prepared.model, tuple(terms))
    return search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(seed))


def late_rub(x, v, t):
    return -RUBBED * math.tanh(v / 1e-3) if t > LATE else 0.0


@pytest.mark.slow
def test_play_of_a_spring_is_found_from_afar(tmp_path):
    """Play of a third of the travel: from the nominal model the slope of the likelihood says little of it."""
    gap = 0.012
    fit = nominal_of(tmp_path, [Backlash(), CoulombFriction()], spring=lambda x: x - min(max(x, -gap), gap))
    explained = explain(fit, ("backlash", "coulomb_friction"))
    assert explained.terms == {"backlash"}
    assert explained.chosen.values["backlash.gap"] == pytest.approx(gap, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("share", "names"), [(0.8, {"coulomb_friction", "offset_force"}), (0.4, {"directional_friction"})]
)
def test_levels_of_friction_that_differ_little_are_told_as_friction_and_an_offset(tmp_path, share, names):
    """The forces are the same at any speed; every rig has an offset, and few have a friction with a direction."""
    levels = (RUBBED, share * RUBBED)
    rub = lambda x, v, t: -levels[int(v < 0.0)] * abs(math.tanh(v / 1e-3)) * (1.0 if v > 0.0 else -1.0)  # noqa: E731
    fit = nominal_of(tmp_path, [CoulombFriction(), OffsetForce(), DirectionalFriction()], extra=rub)
    explained = explain(fit, ("coulomb_friction", "offset_force", "directional_friction"))
    found = explained.chosen.values
    assert explained.terms == names
    if "offset_force" in names:
        assert found["coulomb_friction.force"] == pytest.approx(0.5 * sum(levels), rel=0.03)
        assert found["offset_force.force"] == pytest.approx(0.5 * (levels[1] - levels[0]), rel=0.15)


@pytest.mark.slow
def test_friction_that_sets_in_late_is_named_with_its_onset(tmp_path):
    terms = [CoulombFriction(), QuadraticDamping(), LinearStiffness()]
    fit = nominal_of(tmp_path, terms, extra=late_rub)
    explained = explain(fit, ("coulomb_friction", "quadratic_damping"))
    assert explained.terms == {"coulomb_friction"}
    told = estimate_onset(explained.chosen, "coulomb_friction")
    assert told.low <= LATE <= told.high
    assert told.high - told.low < 0.1
    assert explained.chosen.values["coulomb_friction.force"] == pytest.approx(RUBBED, rel=0.05)


def begin_late(fit, key, amplitude, start, onset):
    """Return the fit with one more term, begun at an amplitude and at an onset (s)."""
    return fit_term(fit, key, {f"{key}.{amplitude}": start, onset_key(key): onset})


def test_an_onset_is_found_over_several_cycles(tmp_path):
    """A spring that breaks: the likelihood of its time has a maximum in every half cycle of 0.2 s."""
    broken = lambda x, v, t: 60.0 * x if t > LATE else 0.0  # noqa: E731
    found = begin_late(
        nominal_of(tmp_path, [LinearStiffness()], extra=broken), "linear_stiffness", "coefficient", -10.0, LATE + 1.2
    )
    assert find_onset(found.posterior, "linear_stiffness") == pytest.approx(LATE, abs=0.02)
    assert found.values["linear_stiffness.coefficient"] == pytest.approx(-60.0, rel=0.03)
    told = estimate_onset(found, "linear_stiffness")
    assert told.low <= find_onset(found.posterior, "linear_stiffness") <= told.high


def test_a_term_that_promised_more_from_an_onset_acts_from_the_beginning_if_that_explains_as_much(tmp_path):
    fit = nominal_of(tmp_path, [CoulombFriction()], extra=lambda x, v, t: -RUBBED * math.tanh(v / 1e-3))
    found = begin_late(fit, "coulomb_friction", "force", 1.0, 0.5)
    assert find_onset(found.posterior, "coulomb_friction") == ALWAYS
    assert found.values["coulomb_friction.force"] == pytest.approx(RUBBED, rel=0.05)


def test_friction_from_the_beginning_has_no_onset(tmp_path):
    fit = nominal_of(tmp_path, [CoulombFriction()], extra=lambda x, v, t: -RUBBED * math.tanh(v / 1e-3))
    explained = explain(fit, ("coulomb_friction",))
    assert explained.terms == {"coulomb_friction"}
    assert find_onset(explained.chosen.posterior, "coulomb_friction") == ALWAYS
    assert estimate_onset(explained.chosen, "coulomb_friction") is None
    assert refine_onset(explained.chosen, "coulomb_friction") is explained.chosen


def test_a_gain_that_sets_in_is_named_with_its_time(tmp_path):
    """A gain of a sensor that rises by 8 % between the samples at 3.10 and 3.12 s."""
    fit = nominal_of(tmp_path, [SensorGain(), CoulombFriction()], shown=lambda x: x * np.where(T > LATE, 1.08, 1.0))
    explained = explain(fit, ("sensor_gain", "coulomb_friction"))
    assert explained.terms == {"sensor_gain"}
    assert explained.chosen.values["sensor_gain.error"] == pytest.approx(0.08, abs=0.001)
    told = estimate_onset(explained.chosen, "sensor_gain")
    assert told.low <= LATE + 0.02
    assert told.high >= LATE
    assert told.high - told.low < 0.05


def test_a_gain_from_the_beginning_has_no_time(tmp_path):
    fit = nominal_of(tmp_path, [SensorGain()], shown=lambda x: 1.08 * x)
    explained = explain(fit, ("sensor_gain",))
    assert estimate_onset(explained.chosen, "sensor_gain") is None


def test_the_likelihood_of_a_sensor_that_changes_is_that_of_corrected_readings(tmp_path):
    """The slow twin: readings divided by hand; the density of what was read is wider by the gain.

    The prior of the first state is as wide as the readings are, which makes a difference of 0.02.
    """
    fit = nominal_of(tmp_path, [SensorGain()], shown=lambda x: x * np.where(T > LATE, 1.08, 1.0))
    posterior = fit.posterior.hold_values({"sensor_gain.error": 0.08, onset_key("sensor_gain"): LATE + 0.01})
    changed = posterior.acting({"sensor_gain"})
    (observation,) = fit.posterior.observations
    late = observation.time > LATE
    right = replace(observation, readings=np.where(late, observation.response / 1.08, observation.response)[:, None])
    by_hand = fit.posterior.on((right,)).log_likelihood(fit.theta[None]) - np.sum(late) * math.log(1.08)
    assert changed.log_likelihood(fit.theta[None]) == pytest.approx(by_hand, abs=0.05)


def test_cut_sensitivities_are_those_of_a_term_that_sets_in(tmp_path):
    """The slow twin: the gradient by a small amplitude with the term switched on at each onset, by the filter itself.

    A term acts on readings before its onset as little as on any that the filter has forgotten.
    """
    fit = nominal_of(tmp_path, [LinearStiffness()], extra=lambda x, v, t: -5.0 * x * (t > LATE))
    assert can_have_onset(fit.posterior, "linear_stiffness")
    key, small = "linear_stiffness.coefficient", 1e-3
    held = FreeParameter(key, "", 0.0, -math.inf, math.inf)
    wider = fit.posterior.extend((held,), {"linear_stiffness"})
    zero, one = np.append(fit.theta, 0.0), np.append(fit.theta, small)
    slopes = fit.slopes
    seen = wider.innovations(np.array([zero, one]))
    joint = type(slopes)(
        zero,
        seen[0],
        np.vstack([slopes.errors, (seen.errors[1] - seen.errors[0])[None] / small]),
        np.vstack([slopes.variances, (seen.variances[1] - seen.variances[0])[None] / small]),
        np.append(slopes.steps, small),
    )
    scores, times = joint.scores()[-1], fit.posterior.observations[0].time
    found = np.array([scores[times[: len(scores)] >= onset].sum() for onset in list_onsets(fit.posterior)])
    twin = []
    for time in list_onsets(fit.posterior):
        late = wider.hold_values({onset_key("linear_stiffness"): float(time)})
        low, high = late.log_likelihood(np.array([zero, one]))
        twin.append((high - low) / small)
    assert len(twin) == TIMES
    assert np.abs(found - twin).max() < 0.1 * np.abs(twin).max()


def test_ripple_of_a_sensor_is_scouted_and_found(tmp_path):
    """An error of 0.4 mm that repeats every 13 mm, over a travel of 0.1 m and noise of 0.1 mm."""
    pitch, size = 0.013, 4e-4
    fit = nominal_of(tmp_path, [PositionRipple()], shown=lambda x: x + size * np.cos(2.0 * np.pi * x / pitch + 0.4))
    found = scan_shapes(fit)
    assert found["position_ripple"][0]["position_ripple.pitch"] == pytest.approx(pitch, rel=0.03)
    explained = explain(fit, ("position_ripple",))
    values = explained.chosen.values
    assert math.hypot(values["position_ripple.cosine"], values["position_ripple.sine"]) == pytest.approx(size, rel=0.1)
    assert values["position_ripple.pitch"] == pytest.approx(pitch, rel=0.002)


def test_readings_that_are_put_right_are_bent_to_what_was_read(tmp_path):
    fit = nominal_of(tmp_path, [PositionRipple()])
    seen, p = fit.posterior.observations[0], (3e-4, -2e-4, 0.02)
    right, slopes = correct_bends(seen, [(0, PositionRipple(), p)])
    assert np.allclose(PositionRipple.bent(right.readings[:, 0], p), seen.readings[:, 0], atol=1e-9)
    step = 1e-7
    ends = [PositionRipple.bent(right.readings[:, 0] + h, p) for h in (step, -step)]
    assert np.allclose(slopes[:, 0], 2.0 * step / (ends[0] - ends[1]), rtol=1e-3)


def test_density_of_bent_readings_is_that_of_the_readings():
    """Of z = bent(x) with x normal, by the rule for densities: p(z) = p(x) |dx/dz|."""
    errors, variances = np.array([[[0.3], [-1.2]]]), np.array([[[0.5], [2.0]]])
    slopes = np.array([[0.8], [1.3]])
    bare = Innovations.of(errors, variances, np.array([2]))
    found = rescale_innovations(bare, 1.0 / slopes)
    wanted = bare.log_likelihood[0] + math.log(1.0 / 0.8) + math.log(1.0 / 1.3)
    assert found.log_likelihood[0] == pytest.approx(wanted)


@pytest.mark.parametrize("time", [1e-5, 0.004, 0.03, 0.5, 4.0])
def test_lag_of_a_drive_is_that_of_the_linear_answer(time):
    t, omega = np.linspace(0.0, 20.0, 2001), 3.0
    seen = apply_lag(lambda t, order: np.cos(omega * t), t, time, 0)
    wanted = np.real(np.exp(1j * omega * t) / (1.0 + 1j * omega * time))
    assert np.abs(seen - wanted).max() < 1e-9


@pytest.mark.slow
def test_lags_of_drive_and_sensor_promise_the_same_of_a_linear_machine(tmp_path):
    """What lags a linear machine on its way in lags it on its way out; both are found by their secants."""
    late = 0.02
    fit = nominal_of(tmp_path, [ActuatorLag(), SensorLag()], shown=lambda x: lagging(x, late))
    promises = list_bare_promises(fit, ("actuator_lag", "sensor_lag"), {})
    assert min(promise.gain for promise in promises) > 30.0
    explained = explain(fit, ("actuator_lag", "sensor_lag"))
    (key,) = explained.terms
    assert explained.chosen.values[f"{key}.time"] == pytest.approx(late, rel=0.05)


def test_what_a_lag_promises_is_that_of_its_secants(tmp_path):
    """The slope at no lag is that of a sensor whose own state is shorter than a step: it promises nothing."""
    late = 0.03
    fit = nominal_of(tmp_path, [ActuatorLag(), SensorLag()], shown=lambda x: lagging(x, late))
    frame = make_frame(fit.posterior, fit.theta, (), ODDS)
    keys = ("actuator_lag", "sensor_lag")
    told = list_promises(fit_hypothesis(frame, frame.start, 0.0), keys, {}, dict.fromkeys(keys, 0.0), (), 0.0)
    assert {one.key for one in told} == set(keys)
    for one in told:
        assert one.gain > 30.0
        assert 0.5 * late < one.start[f"{one.key}.time"] < 2.0 * late


@pytest.mark.parametrize(("steps", "same"), [(0.9, True), (1.1, False)])
def test_a_lag_that_is_shorter_than_a_step_of_the_integration_has_no_effect(tmp_path, steps, same):
    fit = nominal_of(tmp_path, [SensorLag()])
    step = (T[1] - T[0]) / fit.posterior.dynamics.nsub
    lagged = join_term(fit.posterior, "sensor_lag", {"sensor_lag.time": steps * step})
    told = lagged.log_likelihood(np.append(fit.theta, steps * step))
    assert (told == pytest.approx(fit.log_likelihood, abs=1e-6)) is same


def test_a_delay_of_most_of_a_cycle_is_found_and_so_are_its_parameters(tmp_path):
    """Far from its null: only a secant promises it, and its first fit ends in another maximum."""
    late = 0.25
    prepared, system = made_of(tmp_path, lambda x, v, t: 0.0, late=late)
    train, _ = split_heldout(prepared.observations)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    explained = explain(nominal, ("excitation_delay", "sensor_lag", "inertia_change"))
    assert explained.terms == {"excitation_delay"}
    assert explained.chosen.values["excitation_delay.delay"] == pytest.approx(late, rel=0.01)


def lagging(x, time):
    """Return samples behind a lag of first order, through a fine grid."""
    fine = np.linspace(0.0, len(x) - 1.0, 50 * len(x))
    dense, out = np.interp(fine, np.arange(len(x)), x), np.zeros(50 * len(x))
    share = -math.expm1(-(fine[1] - fine[0]) * (T[1] - T[0]) / time)
    out[0] = dense[0]
    for i in range(1, len(out)):
        out[i] = out[i - 1] + share * (dense[i] - out[i - 1])
    return np.interp(np.arange(len(x)), fine, out)


def test_a_learned_force_is_said_to_look_like_the_law_it_came_from(tmp_path):
    """A force along the motion by formula: one law at a shape of its own, the sum of two, and one of no law."""
    terms = [EndStop(), QuadraticDamping(), CoulombFriction(), CubicStiffness()]
    fit = nominal_of(tmp_path, terms)
    states = np.ascontiguousarray(fit.posterior.filters[0].smooth(fit.theta).states[:, :2])
    x, v = states.T
    stop = -np.sign(x) * np.maximum(np.abs(x) - 0.031, 0.0)
    found = find_likeness(fit.posterior, fit.theta, states, 40.0 * stop)
    assert found.keys == ("end_stop",)
    assert found.share > 0.98
    both = stop / np.std(stop) - v * np.abs(v) / np.std(v * np.abs(v))
    found = find_likeness(fit.posterior, fit.theta, states, both)
    assert set(found.keys) == {"end_stop", "quadratic_damping"}
    noise = np.random.default_rng(0).standard_normal(len(x))
    assert find_likeness(fit.posterior, fit.theta, states, noise) is None


@pytest.fixture
def library(monkeypatch):
    monkeypatch.syspath_prepend(str(LIBRARY))
    import library

    yield library
    sys.modules.pop("library", None)


@pytest.mark.slow
@pytest.mark.parametrize("name", NEW)
def test_each_is_named_in_a_recording_by_another_integrator(library, tmp_path, name):
    """Under a multisine, at 3 % noise and a size that gains about 340 in log-likelihood; one seed each.

    Three times the half width of an interval of 95 % is left for one trial in 10^8 to fail.
    """
    gain = 340.0 if name != "hidden_mode" else 3000.0
    row = library.run_task((name, "position", "multisine", 1, gain, 1500))
    (truth,) = row["truth"]
    found = [entry for entry in row["found"] if are_equivalent(entry["mechanism"], name)]
    assert found, json.dumps(row["found"])
    known = complete_parameters(
        {k: v for k, v in truth.items() if k not in ("name", "at")},
        row["machine"]["values"],
        BlindDrive(row["machine"]["signal"]["tones"]),
    )
    for parameter, interval in found[0]["parameters"].items():
        if parameter in known and interval["low"] is not None:
            width = 1.5 * (interval["high"] - interval["low"])
            assert abs(interval["median"] - known[parameter]) <= width + 1e-12, parameter


@pytest.mark.parametrize(("sensor", "distinct"), [("velocity", False), ("position", True)])
def test_two_levels_of_friction_show_in_a_position_only(library, tmp_path, sensor, distinct):
    """Their difference shifts the middle of the motion of a spring-held mass; the velocity has no middle."""
    from library_rows import is_simpler_enough

    gain = library.choose_gain(type("Options", (), {"gain": 0.0}), "directional_friction", sensor, "multisine", 14)
    task = ("directional_friction", sensor, "multisine", 14, gain, 1500)
    draft = library.draft_machine(task)
    (effect,), noise = library.write_case(task, draft, 1.0, tmp_path)
    mean = 0.5 * (effect.parameters["forward"] + effect.parameters["backward"])
    entry = {"mechanism": "coulomb_friction", "at": effect.at, "parameters": {"force": {"median": mean}}}
    row = {"name": effect.mechanism, "lead": library.measure_lead(tmp_path, effect, draft.rig, noise, entry)}
    assert draft.rig.model == "linear_oscillator"
    assert is_simpler_enough(row) is not distinct


def test_a_clean_machine_with_play_begins_where_no_random_force_is_needed(library, tmp_path):
    """The velocity of a joint under a sweep: smoothed back only, its initial position was 1.3 deviations off.

    The fit was 22 lower in log-likelihood, and a shift of the gap was named with a probability of 0.999.
    """
    draft = library.draft_machine(("clean", "velocity", "sweep", 126, 0.0, 1500))
    library.write_case(("clean", "velocity", "sweep", 126, 0.0, 1500), draft, 1.0, tmp_path)
    prepared = prepare(tmp_path / "case.toml", default())
    train, _ = split_heldout(prepared.observations)
    posterior = make_posterior(System(prepared.model, prepared.terms), prepared.case, train, jobs=1)
    fit = search_maximum(posterior, np.random.default_rng(0))
    assert has_usual_random_force(fit)
    assert draft.rig.model == "robot_joint"
    assert fit.values["x0"] == pytest.approx(draft.rig.values["x0"], rel=0.01)


def test_every_name_of_the_contract_can_be_hidden():
    assert set(NEW) | {"actuator_lag", "sensor_lag", "quadratic_stiffness"} <= set(TABLE)


def test_shapes_have_no_effect_at_amplitude_zero(tmp_path):
    """So their effects share one run of the filter there, for a term without states."""
    registry = Registry.discover()
    kinds = [registry.load("term", name) for name in ("cogging", "end_stop", "position_ripple", "stribeck_friction")]
    terms = [kind(at=kind.at) if hasattr(kind, "at") else kind() for kind in kinds]
    fit = nominal_of(tmp_path, terms)
    for key in fit.posterior.system.keys:
        amplitudes, shapes = sort_slots(fit.posterior, key)
        frees = [*make_term_parameters(fit.posterior, key, amplitudes, {}), *map(hold_shape, shapes)]
        wider = fit.posterior.extend(frees, {key})
        tried = list_star_points([list_tried_values(s.param, fit.posterior.scales) for s in shapes])
        points = [np.concatenate([fit.theta, np.zeros(len(amplitudes)), values]) for values in tried]
        found = wider.innovations(np.array(points))
        plain = fit.posterior.innovations(fit.theta)
        assert len(points) > 2
        assert np.allclose(found.errors, plain.errors, rtol=0.0, atol=1e-9 * np.std(plain.errors)), key
        assert np.allclose(found.variances, plain.variances, rtol=1e-9)
