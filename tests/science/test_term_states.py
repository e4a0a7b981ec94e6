"""The states of a term at the first sample: a recording begins within a motion, not before it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from truths import fit_oscillator

from lostmotion.inference.candidates import join_term
from lostmotion.inference.fit import maximise, restart
from lostmotion.inference.late import compute_onset_price
from lostmotion.likelihood.observation import Observation
from lostmotion_plugins.terms.memory import BoucWenHysteresis

YIELD, TRAVEL = 0.5, 0.01
"""Yield force (N) and elastic travel (m); the motion has an amplitude of 8 mm, so that the beginning lasts."""


def hysteretic():
    """Return the fit of a linear oscillator (m = 1, c = 0.5, k = 400) with a Bouc-Wen force, from 500 samples.

    Explicit steps, 40 between samples; the recording begins after 200 samples or more of a motion under two tones,
    where the force is largest.
    """
    rng, dt, fine, before, samples = np.random.default_rng(6), 0.02, 40, 300, 500
    step, x, v, f, seen = dt / fine, 0.0, 0.0, 0.0, np.zeros((before + samples, 2))

    def push(t):
        return 1.0 * np.cos(17.0 * t) + 1.0 * np.cos(23.0 * t + 0.7)

    for i in range(len(seen) * fine):
        if i % fine == 0:
            seen[i // fine] = v, f
        v += step * (push(step * (i + 0.5)) - 0.5 * v - 400.0 * x - f)
        f += step * (YIELD * v - (abs(v) * f * abs(f) + v * f * f) / (2.0 * YIELD)) / TRAVEL
        x += step * v
    first = 200 + int(np.argmax(np.abs(seen[200:before, 1])))
    times, shown = dt * np.arange(first, first + samples), seen[first : first + samples, 0]
    shown = shown + 0.01 * shown.std() * rng.standard_normal(samples)
    recording = Observation.of("seen", shown, push(times)[:, None], dt, "velocity")
    return fit_oscillator(recording, rng, terms=("bouc_wen_hysteresis",))


def test_a_hysteresis_begins_at_any_force_up_to_its_yield_force(monkeypatch):
    """At a force of exactly zero the fit needs more noise, and the values are wrong. Seeded; one recording."""
    nominal = hysteretic()
    start = {"bouc_wen_hysteresis.force": YIELD, "bouc_wen_hysteresis.travel": TRAVEL}
    free = maximise(join_term(restart(nominal), "bouc_wen_hysteresis", start))
    assert free.values["bouc_wen_hysteresis.force"] == pytest.approx(YIELD, rel=0.1)
    assert free.values["c"] == pytest.approx(0.5, rel=0.2)
    monkeypatch.setattr(BoucWenHysteresis, "states", tuple(BoucWenHysteresis.states))
    zero = maximise(join_term(restart(nominal), "bouc_wen_hysteresis", start))
    assert free.log_evidence > zero.log_evidence + 3.0


def test_its_variance_at_the_first_sample_is_the_square_of_the_yield_force():
    posterior = hysteretic().posterior
    start = {"bouc_wen_hysteresis.force": YIELD, "bouc_wen_hysteresis.travel": TRAVEL}
    joined = join_term(posterior, "bouc_wen_hysteresis", start)
    twice = joined.space.start.copy()
    twice[joined.space.keys.index("bouc_wen_hysteresis.force")] = 2.0 * YIELD
    points = joined.recordings[0].points(np.stack([joined.space.start, twice]))
    assert np.allclose(points.covariance[:, 2, 2], [YIELD**2, 4.0 * YIELD**2])
    assert math.isclose(points.mean[0, 2], 0.0)


@pytest.mark.parametrize(("since", "price"), [(None, 0.0), (3.0, math.log(24.0) + math.log(100.0))])
def test_an_onset_costs_its_time_and_the_odds_of_a_change(since, price):
    posterior = hysteretic().posterior
    start = {"bouc_wen_hysteresis.force": YIELD, "bouc_wen_hysteresis.travel": TRAVEL}
    late = {"bouc_wen_hysteresis.since": since} if since else {}
    assert compute_onset_price(join_term(posterior, "bouc_wen_hysteresis", {**start, **late})) == pytest.approx(price)
