"""Recordings of an acceleration alone, by DOP853 under forces known at any time: `benchmarks/accelerometers.py`."""

import importlib.util
import math
import re
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from made_facts import make_facts
from reference import Reference
from scipy.stats import binom

from lostmotion.diagnosis.gather_facts import find_position
from lostmotion.diagnosis.notes import note_unknown_position
from lostmotion.inference.fit import maximise
from lostmotion.inference.setup import choose_steps, compute_scales, make_posterior, search_maximum, split_heldout
from lostmotion.inference.unseen import smooth_body_position
from lostmotion.likelihood.noise_levels import compute_usual_level
from lostmotion.likelihood.observation import Observation, window_force
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.system import System
from lostmotion.noises import NOISE
from lostmotion.registry import default

SOURCE = Path(__file__).parents[2] / "benchmarks" / "accelerometers.py"
SPEC = importlib.util.spec_from_file_location("benchmarks_accelerometers", SOURCE)
machines = importlib.util.module_from_spec(SPEC)
sys.modules[SPEC.name] = machines
SPEC.loader.exec_module(machines)


@cache
def recorded(number):
    """Return a machine of the campaign with seed 0, its recording and its true states: they take seconds."""
    machine = machines.draw_machine(0, number)
    return machine, *machines.record(machine, 0)


def posed(number):
    """Return a machine, its posterior on what is fitted, the coordinates of the truth, and the true states."""
    machine, observation, states = recorded(number)
    system = System(default().make("model", machine.model), ())
    posterior = make_posterior(system, machines.make_case(machine), split_heldout([observation])[0])
    levels = {
        RANDOM: math.log((machines.EXCITATION_NOISE * machine.peak) ** 2 * machine.dt),
        NOISE: math.log(machine.noise * states[:, 2].std()),
    }
    true = np.array(
        [levels[f.key] if f.key in levels else math.log(machine.values[f.key]) for f in posterior.space.free]
    )
    return machine, posterior, posterior.space.clip(true), states, observation


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 3, 5])
def test_the_size_of_a_motion_is_told_by_its_acceleration(number):
    """Spikes of hits are most of an acceleration, and none of the motion: taken for it they made it far too small."""
    machine, observation, states = recorded(number)
    system = System(default().make("model", machine.model), ())
    scales = compute_scales(system, (observation,), system.vector(machine.values))
    assert scales.length == pytest.approx(math.sqrt(2.0) * states[:, 0].std(), rel=0.1)
    assert scales.velocity == pytest.approx(math.sqrt(2.0) * states[:, 1].std(), rel=0.1)


@pytest.mark.slow
def test_the_usual_noise_of_a_hammer_goes_with_its_peak():
    machine, posterior, _, _, observation = posed(0)
    size = math.sqrt(math.exp(compute_usual_level(posterior, 1.0)) / machine.dt)
    assert size == pytest.approx(1e-3 * np.abs(posterior.observations[0].inputs).max(), rel=0.01)
    assert size > 3e-3 * np.std(observation.inputs)


def test_between_hits_the_noise_of_a_hammer_is_no_force():
    """A body at rest that does not answer the noise was said to be held by friction, in 4 of 50 machines."""
    t, rng = np.arange(4000.0), np.random.default_rng(3)
    true = machines.make_hammer_blows(t, np.array([200.3, 2100.8]), np.array([8.0, 15.0]), np.array([1.0, 0.6]))
    noise = 1e-3 * rng.standard_normal(len(t))
    kept = window_force(true + noise)
    rest = np.abs(kept - true)[true == 0.0]
    assert np.mean(rest > 1e-4) < 0.01
    np.testing.assert_array_equal(kept[true > 0.01], (true + noise)[true > 0.01])
    wave = np.cos(0.1 * t) + noise
    np.testing.assert_array_equal(window_force(wave), wave)
    slow = true + np.convolve(rng.standard_normal(len(t)), np.ones(20) / 20.0, "same") * 2e-3 + noise
    np.testing.assert_array_equal(window_force(slow), slow)


def test_what_edges_of_hits_do_between_samples_is_told_as_it_is():
    """The mean force between two samples, by the drive and truly: errors are as large as told to within a third.

    Half-sines of 6 to 25 samples, whose integral is known; a wave that is well sampled is told to be known.
    """
    rng, t, told, made = np.random.default_rng(5), np.arange(400.0), 0.0, 0.0
    for _ in range(100):
        begin, width = 200.0 + rng.random(), math.exp(rng.uniform(math.log(6.0), math.log(25.0)))
        share = np.clip((t - begin) / width, 0.0, 1.0)
        true = np.diff(width / math.pi * (1.0 - np.cos(math.pi * share)))
        force = machines.make_hammer_blows(t, np.array([begin]), np.array([width]), np.array([1.0]))
        seen = Observation.of("a", force, force[:, None], 1.0, "acceleration")
        means = seen.drive.cubics[:-1, :, 0] @ (1.0 / np.arange(1.0, 5.0))
        told, made = told + float(np.sum(seen.input_variance)), made + float(np.sum((means - true) ** 2))
    assert math.sqrt(told / made) == pytest.approx(1.0, rel=0.33)
    assert not Observation.of("b", t, np.cos(0.1 * t)[:, None], 1.0, "acceleration").input_variance.any()


def test_the_engines_agree_on_a_recording_with_hits():
    _, posterior, true, _, observation = posed(0)
    struck = int(np.argmax(observation.input_variance > 0.0))
    short = choose_steps(posterior.on((observation.part(max(struck - 300, 0), struck + 300),)), true)
    assert short.observations[0].input_variance.any()
    plain = replace(short, dynamics=Reference(short.system, short.active, short.dynamics.nsub)).innovations(true)
    ours = short.innovations(true)
    np.testing.assert_allclose(plain.errors, ours.errors, rtol=0.0, atol=1e-9 * np.abs(ours.errors).max())
    np.testing.assert_allclose(plain.variances, ours.variances, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("number", [14, 41])
def test_a_search_with_an_accelerometer_reaches_the_truth(number):
    """Begun anywhere, with a large random force, it ended with ten times the true one, 1000 to 2000 below in log.

    Where a body flies free from contact to contact (14), the likelihood still has maxima some tens below the highest.
    """
    machine, posterior, true, states, _ = posed(number)
    fit = search_maximum(posterior, np.random.default_rng(0))
    assert fit.local.log_posterior > fit.posterior.log_density(true) - 50.0
    assert abs(fit.theta[-2] - true[-2]) < 2.0
    mean, covariance = fit.posterior.observations[0].begun
    assert np.all(np.abs(mean - states[0, :2]) < 3.0 * np.sqrt(np.diag(covariance)))
    known = [fit.sd[f.key] for f in fit.posterior.space.free[:3]]
    assert np.all(np.abs(fit.theta - true)[:3] < 5.0 * np.array(known)), machine


@pytest.mark.slow
def test_the_likelihood_is_smooth_where_a_body_creeps_up_to_a_contact():
    """With three points of linearisation it jumped by 300 between values of c that differ by one in ten million."""
    machine, posterior, true, states, _ = posed(56)
    exact = (states[0, :2], np.diag((1e-3 * np.array([posterior.scales.length, posterior.scales.velocity])) ** 2))
    known = posterior.on((replace(posterior.observations[0], begun=exact),))
    thetas = np.repeat(true[None], 16, axis=0)
    thetas[:, 0] += 1e-7 * np.arange(16)
    assert np.ptp(choose_steps(known, true).log_density(thetas)) < 0.05, machine


def test_a_part_of_a_recording_begins_where_it_does():
    begun = (np.zeros(2), np.eye(2))
    whole = Observation.of("a", np.arange(10.0), np.zeros((10, 1)), 0.1, "acceleration", begun=begun)
    assert whole.part(0, 5).begun is begun
    assert whole.part(1, 5).begun is None


def notes_on_position(fit, observation):
    """Return the notes on the position of a fitted machine during a recording."""
    return note_unknown_position.write(make_facts(position=find_position(fit, observation)))


def test_a_position_that_no_sensor_shows_is_told_with_its_band():
    """The position under hits, smoothed at the truth. Errors of neighbours go together, so one recording tells little.

    Over 100 machines the band holds the position in about 95 of 100 samples: `benchmarks/accelerometers.py`.
    """
    machine, posterior, true, states, observation = posed(0)
    fit = maximise(choose_steps(posterior, true), true)
    place = smooth_body_position(fit, observation)
    error = place.mean - states[:, 0]
    assert np.mean(np.abs(error) < 2.0 * place.sd) > 0.9
    assert np.std(error) > 0.3 * np.sqrt(np.mean(place.sd**2))
    assert notes_on_position(fit, observation) == ()
    loud = replace(
        fit, local=replace(fit.local, theta=fit.theta + 10.0 * (np.array(fit.posterior.space.keys) == RANDOM))
    )
    pairs = zip(fit.posterior.space.free, loud.theta, strict=True)
    levels = [replace(f, low=x, high=x) if f.key == RANDOM else f for f, x in pairs]
    (said,) = notes_on_position(replace(loud, posterior=fit.posterior.over(levels)), observation)
    told = re.search(r"known to \+-(\S+) mm only .* (\S+) % of its amplitude", said)
    amplitude = 1e3 * math.sqrt(2.0) * states[:, 0].std()
    assert float(told[1]) / amplitude == pytest.approx(0.01 * float(told[2]), rel=0.15)
    assert float(told[2]) > 1.0
    shown = Observation.of("seen", states[:, 0], observation.inputs, machine.dt, "position")
    assert notes_on_position(fit, shown) == ()


@pytest.mark.slow
def test_intervals_cover_and_nothing_is_named_where_nothing_is_hidden():
    """Six machines, one of each kind under hits and under a multisine: 16 intervals of 95 %.

    Fewer than 13 cover in 1 of 140 draws of six machines; something is named in 1 of 15 or so. The seed is fixed.
    """
    rows = [machines.run_machine(11, number) for number in range(6)]
    covers = [e["covers"] for row in rows for e in row["estimates"].values()]
    assert sum(covers) >= binom.ppf(0.005, len(covers), 0.95)
    assert [row["found"] for row in rows] == [[]] * 6
    assert np.mean([row["band"] for row in rows]) > 0.8
