"""Other maxima of a posterior: a wave over position fits at several pitches, a stop at one end or at both."""

from __future__ import annotations

import math

import numpy as np
import pytest
from explained import explain
from truths import fit_oscillator

from lostmotion.inference.candidates import join_term
from lostmotion.inference.fit import maximise, restart
from lostmotion.inference.other_shapes import (
    find_modes,
    has_other_shapes,
    list_scanned_shapes,
    refit_shapes,
)
from lostmotion.likelihood.observation import Observation


def driven(force, term, noise=0.01, lost=lambda u: 0.0):
    """Return the fit of a linear oscillator (m = 1, c = 2, k = 400) whose position shows a hidden `force(x)`.

    The part `lost(u)` of the drive does not arrive.
    The drive is a harmonic force of 4 N at 12 rad/s; leapfrog with 40 steps between samples, 900 samples, seeded.
    """
    rng, dt, fine, samples = np.random.default_rng(3), 0.02, 40, 900
    x, v, seen, step = 0.0, 0.0, np.zeros(samples), dt / fine
    for i in range(samples * fine):
        if i % fine == 0:
            seen[i // fine] = x
        u = 4.0 * math.cos(12.0 * step * (i + 0.5))
        v += step * (u - lost(u) - 2.0 * v - 400.0 * x + force(x))
        x += step * v
    drive = 4.0 * np.cos(12.0 * dt * np.arange(samples))[:, None]
    shown = seen + noise * seen.std() * rng.standard_normal(samples)
    return fit_oscillator(Observation.of("seen", shown, drive, dt, "position"), rng, terms=(term,))


def with_term(fit, key, start):
    """Return the fit with one more term that starts at some values."""
    posterior = join_term(restart(fit), key, {f"{key}.{name}": value for name, value in start.items()})
    return maximise(posterior)


@pytest.fixture(scope="module")
def stopped():
    """An oscillator with a spring of 600 N/m beyond +8 mm."""
    return driven(lambda x: -600.0 * max(x - 0.008, 0.0), "end_stop")


@pytest.fixture(scope="module")
def waved():
    """An oscillator with a force of 0.3 N that repeats with every 9 mm, three times over the travel."""
    return driven(lambda x: -0.3 * math.sin(2.0 * math.pi * x / 0.009), "cogging")


def test_a_stop_at_the_wrong_end_is_found_at_the_right_one(stopped):
    wrong = with_term(stopped, "end_stop", {"stiffness": 300.0, "travel": 0.008, "side": 0.0})
    best = refit_shapes(wrong)
    side = best.posterior.recordings[0].full(best.theta)[best.posterior.system.index["end_stop.side"]]
    assert side == 1.0
    assert best.log_evidence > wrong.log_evidence + 10.0
    assert best.values["end_stop.travel"] == pytest.approx(0.008, rel=0.05)


def test_a_wave_at_a_wrong_pitch_is_found_at_the_right_one(waved):
    wrong = with_term(waved, "cogging", {"cosine": 0.05, "sine": -0.15, "pitch": 0.006})
    assert abs(math.log(wrong.values["cogging.pitch"] / 0.009)) > 0.1
    modes = find_modes(wrong)
    assert modes[0].values["cogging.pitch"] == pytest.approx(0.009, rel=0.03)
    assert [m.log_evidence for m in modes] == sorted((m.log_evidence for m in modes), reverse=True)
    assert find_modes(wrong, reach=4.0)[0].log_evidence == pytest.approx(modes[0].log_evidence, abs=0.1)


def test_the_search_goes_on_from_a_better_maximum(waved):
    """From 4.5 mm the next maxima are at 6.9 and then at 9 mm."""
    far = with_term(waved, "cogging", {"cosine": 0.0, "sine": -0.15, "pitch": 0.0045})
    assert find_modes(far)[0].values["cogging.pitch"] < 0.008
    assert refit_shapes(far).values["cogging.pitch"] == pytest.approx(0.009, rel=0.03)


def test_maxima_far_below_the_best_are_left_out(waved):
    best = refit_shapes(with_term(waved, "cogging", {"cosine": 0.0, "sine": -0.3, "pitch": 0.009}))
    near = find_modes(best, reach=4.0)
    assert all(mode.log_evidence > near[0].log_evidence - 4.0 for mode in near)
    assert best in near


def test_a_fit_without_shapes_is_returned_alone(waved):
    assert not has_other_shapes(waved.posterior)
    assert list_scanned_shapes(waved.posterior) == []
    assert find_modes(waved) == [waved]


@pytest.mark.parametrize(("share", "complete"), [(1.0, (0.3, 1.0)), (0.5, (0.0, 0.02))])
def test_a_drive_that_saturates_completely_is_among_the_draws(share, complete):
    """The interval contains a share of 1 where the drive passes nothing more, and not where half passes. Seeded."""
    noise = 0.03 if share == 1.0 else 0.003
    fit = driven(lambda x: 0.0, "drive_saturation", noise, lambda u: share * (u - min(max(u, -2.5), 2.5)))
    found = explain(fit, ("drive_saturation",))
    assert found.terms == {"drive_saturation"}
    shares = found.draw(["drive_saturation.share"], 2000, np.random.default_rng(4))[:, 0]
    assert complete[0] <= np.mean(shares == 1.0) <= complete[1]
    low, high = np.quantile(shares, [0.005, 0.995])
    assert low <= share <= high


@pytest.mark.slow
def test_a_wave_is_explained_at_its_pitch(waved):
    """The force repeats three times over the travel; other pitches are maxima, too."""
    found = explain(waved, ("cogging",))
    assert found.terms == {"cogging"}
    drawn = found.draw(["cogging.pitch"], 2000, np.random.default_rng(4))[:, 0]
    low, high = np.quantile(drawn, [0.005, 0.995])
    assert low <= 0.009 <= high
