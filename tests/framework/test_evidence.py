"""The log evidence by sampling beside Laplace's: exact for a normal posterior, honest for one that is cut."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from lostmotion.inference.fit import Fit, LocalExpansion
from lostmotion.inference.laplace import sample_evidence
from lostmotion.likelihood.space import FreeParameter, ParameterSpace


@dataclass(frozen=True)
class Toy:
    """A posterior whose log-likelihood is a normal bump about `middle` with the spread `sd`."""

    space: ParameterSpace
    middle: np.ndarray
    sd: np.ndarray

    def log_likelihood(self, points):
        return -0.5 * np.sum(((points - self.middle) / self.sd) ** 2, axis=1)

    def log_density(self, points):
        return self.log_likelihood(points) + self.space.log_prior(points)


def fit_of(middle, sd, low, high):
    free = tuple(
        FreeParameter(f"p{i}", "1", m, a, b) for i, (m, a, b) in enumerate(zip(middle, low, high, strict=True))
    )
    toy = Toy(ParameterSpace(free), np.array(middle), np.array(sd))
    top = np.clip(middle, low, high)
    height = float(toy.log_likelihood(top[None])[0])
    local = LocalExpansion(
        top, height, height + toy.space.log_prior(top), np.zeros(2), np.diag(1.0 / np.array(sd) ** 2), np.array(sd)
    )
    return Fit(toy, local, "converged", 1)


def test_a_normal_posterior_gives_what_laplace_gives():
    """Seeded; the standard error that is stated covers the gap within three."""
    fit = fit_of([1.0, -2.0], [0.1, 3.0], [-10.0, -50.0], [10.0, 50.0])
    exact = math.log(2.0 * math.pi * 0.3) - math.log(20.0 * 100.0)
    check = sample_evidence(fit, np.random.default_rng(0), 600)
    assert check.laplace == pytest.approx(exact, abs=1e-9)
    assert abs(check.sampled - exact) < 3.0 * check.error
    assert check.effective > 300


def test_a_posterior_that_is_cut_in_half_has_half_the_evidence():
    """Laplace's method does not see the bound: log 2 too much. Seeded, within three standard errors."""
    fit = fit_of([0.0, 0.0], [1.0, 1.0], [0.0, -30.0], [30.0, 30.0])
    check = sample_evidence(fit, np.random.default_rng(1), 600)
    assert abs(check.laplace - check.sampled - math.log(2.0)) < 3.0 * check.error


def test_where_all_diverges_nothing_is_claimed():
    fit = fit_of([0.0, 0.0], [1.0, 1.0], [-9.0, -9.0], [9.0, 9.0])
    broken = replace(fit, posterior=replace(fit.posterior, middle=np.array([np.inf, 0.0])))
    check = sample_evidence(broken, np.random.default_rng(2), 50)
    assert check.effective == 0.0
    assert math.isinf(check.error)
