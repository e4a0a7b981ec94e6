"""Two tones and their combinations are told from one tone, from noise and from chaos."""

import numpy as np
import pytest

from lostmotion_chaos.signals.tones import base_line, two_tones

GOLDEN = (np.sqrt(5) - 1) / 2
T = 0.02 * np.arange(8000)


def torus(second=GOLDEN):
    return np.sin(2 * np.pi * T) + 0.6 * np.sin(2 * np.pi * second * T + 1) + 0.2 * np.cos(2 * np.pi * (1 + second) * T)


def test_a_torus_is_explained_and_its_second_frequency_found():
    found = two_tones(torus(), 0.02, 1.0)
    assert found.left < 0.005
    combinations = [abs(m + n * GOLDEN) for m in range(-3, 4) for n in (-1, 1)]
    assert min(abs(found.second - f) for f in combinations) < 1e-4


@pytest.mark.parametrize("share", [0.02, 0.1])
@pytest.mark.slow
def test_what_is_left_of_a_noisy_torus_is_its_noise(share):
    x = torus()
    noisy = x + share * x.std() * np.random.default_rng(0).normal(size=len(x))
    assert two_tones(noisy, 0.02, 1.0).left == pytest.approx(share, rel=0.1)


@pytest.mark.slow
def test_noise_is_left_as_it_is():
    x = np.random.default_rng(1).normal(size=5000)
    assert two_tones(x, 0.02, 1.0).left == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize("strong", [1, 3, 5])
def test_the_base_of_a_strong_harmonic_is_found(strong):
    x = 0.3 * np.sin(2 * np.pi * 0.5 * T) + 2.0 * np.sin(2 * np.pi * 0.5 * strong * T + 1)
    x += 0.5 * np.random.default_rng(2).normal(size=len(T))
    assert base_line(x, 0.02).period == pytest.approx(2.0, rel=1e-4)


def test_noise_has_no_base():
    assert base_line(np.random.default_rng(3).normal(size=5000), 0.02) is None
