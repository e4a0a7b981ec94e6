"""The density of held-out data averaged over the posterior of the fitted data, compared with exact integrals."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.heldout import NormalPosterior, average_over_posterior
from lostmotion.likelihood.innovations import Innovations

READINGS, FORCES = 400, 6


def _make(rng, shift):
    """Return held-out errors that are linear in coefficients of unit width, and a known noise of 0.1."""
    z = np.linspace(0.0, 1.0, READINGS)
    basis = np.sin(np.outer(np.arange(1, FORCES + 1), np.pi * z))
    errors = shift * basis.sum(axis=0) + 0.1 * rng.standard_normal(READINGS)

    def innovations(step):
        variance = 0.01 * np.exp(2.0 * step[-1])
        return Innovations(errors - step[:FORCES] @ basis, np.full(READINGS, variance), np.array(True))

    def expand(step):
        here = innovations(step)
        slopes = np.vstack([-basis, np.zeros(READINGS)])
        variances = np.zeros((FORCES + 1, READINGS))
        variances[-1] = 2.0 * here.variances
        zeros = np.zeros(FORCES + 1)
        return Expansion(here, step, slopes, variances, zeros, zeros, {"all": slice(0, FORCES + 1)})

    return basis, errors, expand, lambda step: float(innovations(step).log_likelihood)


@pytest.mark.parametrize("shift", [0.0, 0.3, 2.0])
def test_the_average_over_a_free_force_is_the_exact_integral(shift):
    basis, errors, expand, score = _make(np.random.default_rng(3), shift)
    precision = np.diag([*np.ones(FORCES), 1e8])  # the noise level is known
    posterior = NormalPosterior(np.arange(FORCES + 1), precision, np.arange(FORCES + 1) == FORCES)
    found = average_over_posterior(posterior, expand, score)
    exact = multivariate_normal.logpdf(errors, np.zeros(READINGS), basis.T @ basis + 0.01 * np.eye(READINGS))
    assert found == pytest.approx(exact, abs=0.05)


def test_a_force_that_is_free_is_not_taken_for_noise():
    """With a level of noise known to 4 %, a force of ten times the noise costs its own prior and nothing else."""
    rng = np.random.default_rng(4)
    basis, errors, expand, score = _make(rng, 2.0)
    precision = np.diag([*np.ones(FORCES), 600.0])
    posterior = NormalPosterior(np.arange(FORCES + 1), precision, np.arange(FORCES + 1) == FORCES)
    levels = np.linspace(-0.25, 0.25, 101)
    prior = 0.5 * np.log(600.0 / (2.0 * np.pi)) - 300.0 * levels**2
    noises = (0.01 * np.exp(2.0 * level) * np.eye(READINGS) for level in levels)
    densities = [multivariate_normal.logpdf(errors, np.zeros(READINGS), basis.T @ basis + noise) for noise in noises]
    exact = np.logaddexp.reduce(densities + prior) + np.log(levels[1] - levels[0])
    assert average_over_posterior(posterior, expand, score) == pytest.approx(exact, abs=0.3)


def test_data_that_cannot_be_predicted_have_no_density():
    _, _, expand, score = _make(np.random.default_rng(5), np.nan)
    posterior = NormalPosterior(np.arange(FORCES + 1), np.eye(FORCES + 1), np.arange(FORCES + 1) == FORCES)
    assert average_over_posterior(posterior, expand, score) == -np.inf
