"""Decays in a diagnosis: where they begin, what is said of an input that nobody recorded, how far a model is off."""

from __future__ import annotations

import time

import numpy as np
import pytest

from lostmotion.diagnosis import free_decays
from lostmotion.diagnosis.free_decays import compute_largest_error, find_stretches, note_restarts
from lostmotion.likelihood.observation import Observation
from lostmotion.signals.decay import Decay, decay_of

DT = 1e-3


def swing(seconds, damping=0.02, frequency=8.0, phase=0.3):
    t = np.arange(round(seconds / DT)) * DT
    omega = 2.0 * np.pi * frequency
    return np.exp(-damping * omega * t) * np.cos(omega * np.sqrt(1.0 - damping**2) * t + phase)


def observation(response, force=None, driven=()):
    force = np.zeros(len(response)) if force is None else force
    return Observation.of("run", response, force[:, None], DT, "position", driven=driven)


def noisy(response, rng, level=0.01):
    return response + level * rng.standard_normal(len(response))


def test_a_free_recording_is_one_decay_from_its_start():
    one = observation(noisy(swing(6.0), np.random.default_rng(1)))
    assert [tuple(stretch) for stretch in find_stretches(one)] == [(0, 6000)]
    assert not list(note_restarts(one))


def test_clean_decays_are_not_said_to_begin_anew():
    """40 decays of one mode in noise, 20 of two modes: no note for any."""
    rng, notes = np.random.default_rng(2), []
    for number in range(60):
        damping, frequency = 10.0 ** rng.uniform(-3.0, -1.2), rng.uniform(4.0, 40.0)
        response = swing(5.0, damping, frequency, rng.uniform(0.0, 6.0))
        if number >= 40:
            response = response + rng.uniform(0.1, 0.5) * swing(5.0, damping, rng.uniform(2.0, 3.0) * frequency)
        notes += note_restarts(observation(noisy(response, rng, 10.0 ** rng.uniform(-4.0, -1.5))))
    assert notes == []


def test_an_input_that_nobody_recorded_is_said_with_its_time():
    """A second push at 3 s, of any sign and phase: each of 20 is seen, to within one period."""
    rng = np.random.default_rng(3)
    for _ in range(20):
        response = swing(6.0, phase=rng.uniform(0.0, 6.0))
        response[3000:] += rng.choice([-1.0, 1.0]) * swing(3.0, phase=rng.uniform(1.2, 1.9))
        one = observation(noisy(response, rng))
        (note,) = note_restarts(one)
        assert "t_start and t_end" in note
        assert "give it as an input" in note
        at = float(note.partition("starts again at ")[2].partition(" s")[0])
        assert at == pytest.approx(3.0, abs=0.125)
        first, second = find_stretches(one)
        assert first == (0, second.start)
        assert second.stop == 6000


def test_decays_of_a_hammer_test_lie_between_its_hits():
    force = np.zeros(6000)
    pulse = 50.0 * np.sin(np.pi * np.arange(6) / 6.0)
    for start in (500, 3500):
        force[start : start + 6] = pulse
    force += 0.01 * np.random.default_rng(4).standard_normal(6000)
    one = observation(np.concatenate([np.zeros(505), swing(5.495)]), force, driven=("force",))
    (first, second) = find_stretches(one)
    assert abs(first.start - 506) <= 1
    assert abs(first.stop - 3500) <= 1
    assert abs(second.start - 3506) <= 1
    assert second.stop == 6000
    assert not list(note_restarts(one))


@pytest.mark.parametrize("driven", [("base_position",), ("force", "base_force"), None])
def test_other_inputs_than_one_hammer_leave_no_decay(driven):
    force = np.zeros(6000)
    force[500:506] = 50.0
    assert find_stretches(observation(swing(6.0), force, driven=driven)) == ()


def test_a_machine_that_is_driven_has_no_free_decay():
    t = np.arange(6000) * DT
    assert find_stretches(observation(swing(6.0), np.sin(30.0 * t), driven=("force",))) == ()


def decay(amplitude, decrement, frequency):
    ones = np.ones(len(amplitude))
    return Decay(
        np.arange(len(amplitude)) / frequency, amplitude, frequency * ones, decrement * ones, *(0.0 * ones,) * 3, 1e-6
    )


def test_a_model_is_off_by_the_share_of_the_worst_part():
    size = np.geomspace(1.0, 0.1, 40)
    seen = decay(size, 0.1 * np.where(size < 0.2, 2.0, 1.0), 5.0)
    assert compute_largest_error(seen, decay(size, 0.1, 5.05), "frequency") == pytest.approx(0.01)
    assert compute_largest_error(seen, decay(size, 0.1, 5.05), "decrement") == pytest.approx(0.5, abs=0.01)
    assert compute_largest_error(seen, seen, "decrement") == 0.0


def test_only_amplitudes_that_both_have_are_compared():
    seen = decay(np.geomspace(1.0, 0.1, 40), 0.1, 5.0)
    assert np.isnan(compute_largest_error(seen, decay(np.geomspace(10.0, 2.0, 40), 0.1, 5.0), "decrement"))
    assert compute_largest_error(seen, decay(np.geomspace(1.0, 0.5, 10), 0.11, 5.0), "decrement") == pytest.approx(0.1)


class Known:
    """A fit of which the free run is known: `run` (samples, 2), from whatever start."""

    theta = np.zeros(0)

    def __init__(self, run):
        self.run, self.posterior, self.filters = run, self, (self,)

    def on(self, observations):
        return self

    def smooth(self, theta):
        return type("Smoothed", (), {"states": np.zeros((6000, 2))})


@pytest.mark.parametrize(
    ("course", "measured"),
    [
        (swing(6.0), True),
        (swing(6.0) + 1e5 * np.arange(6000.0), False),
        (np.where(np.arange(6000) < 400, swing(6.0), np.inf), False),
        (np.where(np.arange(6000) < 400, swing(6.0), np.nan), False),
        (1e250 * swing(6.0), False),
        (np.exp(-np.arange(6000) / 500.0), False),
        (np.zeros(6000), False),
    ],
)
def test_a_run_that_diverges_or_creeps_is_no_decay(monkeypatch, course, measured):
    monkeypatch.setattr(free_decays, "simulate_run", lambda p, theta, y0, start, steps: p.run[start : start + steps])
    monkeypatch.setattr(free_decays, "observe_states", lambda posterior, theta, states, where: states[:, 0])
    one = observation(noisy(swing(6.0), np.random.default_rng(5)))
    (stretch,) = find_stretches(one)
    seen = decay_of(one.response, DT)
    ((_, made),) = free_decays._measure_model(Known(np.stack([course, course], axis=1)), one, [(stretch, seen)])
    assert (made is not None) == measured
    if measured:
        assert compute_largest_error(seen, made, "decrement") < 0.03


def test_ten_hits_and_a_long_ring_take_less_than_a_second():
    """Cycles are passed over rather than fitted one by one: 3000 cycles, as in ten hits of 300."""
    response = noisy(swing(60.0, damping=2e-4, frequency=50.0), np.random.default_rng(6), 1e-4)
    begun = time.perf_counter()
    found = decay_of(response, DT, most=free_decays.MOST_CYCLES)
    assert time.perf_counter() - begun < 1.0
    assert 100 < found.time.size <= free_decays.MOST_CYCLES
    assert np.median(found.decrement) == pytest.approx(2.0 * np.pi * 2e-4, abs=5e-5)
    assert np.median(found.frequency) == pytest.approx(50.0, rel=1e-4)
