"""The likelihood against an exact filter, and what is read off it: score tests, error bars, the missing force."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.stats import chi2
from truths import FORCE, FRICTION, TRUE, observation_of, posterior_for, system_of

from lostmotion.evidence.effects import list_bare_promises
from lostmotion.inference.candidates import fit_term
from lostmotion.inference.fit import maximise
from lostmotion.inference.natural import find_term, make_free_parameters
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.latent import smooth_latent_force
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.noises import NOISE

LINEAR = {"m": 2.0, "c": 3.0, "k": 1100.0}
SAMPLES, DT = 400, 0.01
FORCE_SD, NOISE_SD = 0.3, 1e-3


def linear_posterior(nsub):
    """Return the likelihood of a linear oscillator pushed by a held random force, with known parameters."""
    rng = np.random.default_rng(3)
    push = rng.standard_normal(SAMPLES)
    z = np.cumsum(np.cumsum(push)) * 1e-6 + NOISE_SD * rng.standard_normal(SAMPLES)
    z[[50, 51, 200]] = np.nan
    observation = Observation.of("linear", z, push[:, None], DT, "position", held=True)
    system = replace(system_of("linear_oscillator"), terms=())
    free = tuple(FreeParameter(key, "1", 0.0, -math.inf, math.inf) for key in (RANDOM, NOISE))
    return Posterior(
        ParameterSpace(free), (observation,), Lanes(system, nsub=nsub), Scales(1.0, 1e-2, 0.05), system.vector(LINEAR)
    )


THETA = np.array([math.log(FORCE_SD**2 * DT), math.log(NOISE_SD)])


def kalman(posterior, mean_by, cov_by, noise):
    """Return innovations and variances of a textbook filter (Kalman 1960); one step is `mean_by`, `cov_by`, `noise`."""
    observation, (y, cov) = posterior.observations[0], begun_of(posterior)
    errors, variances = np.zeros(SAMPLES), np.full(SAMPLES, 1.0 / (2.0 * np.pi))
    for k, z in enumerate(observation.response):
        if np.isfinite(z):
            errors[k], variances[k] = z - y[0], cov[0, 0] + NOISE_SD**2
            gain = cov[:, 0] / variances[k]
            y = y + gain * errors[k]
            cov = cov - np.outer(gain, gain) * variances[k]
        for _ in range(posterior.dynamics.nsub):
            y = (mean_by @ np.append(y, observation.inputs[k, 0]))[:2]
            cov = cov_by @ cov @ cov_by.T + noise
    return errors, variances


def begun_of(posterior):
    """Return mean and covariance of the state at the first sample."""
    points = posterior.recordings[0].points(THETA[None])
    return points.mean[0], points.covariance[0]


def dynamics(h):
    """Return h times the matrix of (position, velocity, held force), and the intensity of the random force."""
    m, c, k = LINEAR["m"], LINEAR["c"], LINEAR["k"]
    return h * np.array([[0.0, 1.0, 0.0], [-k / m, -c / m, 1.0 / m], [0.0, 0.0, 0.0]]), FORCE_SD**2 * DT / m**2


def likelihood(errors, variances):
    return -0.5 * np.sum(errors**2 / variances + np.log(2.0 * np.pi * variances))


def test_filter_is_kalmans_for_a_linear_machine():
    """Same two steps a sample, plain NumPy: innovations and variances to 1e-8. No chance.

    Kalman, J. Basic Eng. 82 (1960) 35-45; Taylor's series to fifth order for the mean, to fourth for the covariance,
    and two Gauss points for the noise.
    """
    posterior = linear_posterior(2)
    a, q = dynamics(DT / 2)
    cov_by = np.eye(3) + a @ (np.eye(3) + a / 2 @ (np.eye(3) + a / 3 @ (np.eye(3) + a / 4)))
    mean_by = cov_by + np.linalg.matrix_power(a, 5) / 120
    noise = np.zeros((2, 2))
    for part in (0.5 - math.sqrt(1 / 12), 0.5 + math.sqrt(1 / 12)):
        pushed = (np.eye(3) + part * a + part**2 / 2 * a @ a)[:2, 1]
        noise += 0.5 * q * DT / 2 * np.outer(pushed, pushed)
    errors, variances = kalman(posterior, mean_by, cov_by[:2, :2], noise)
    seen = posterior.innovations(THETA)
    assert np.allclose(seen.errors, errors, rtol=1e-8, atol=1e-8 * NOISE_SD)
    assert np.allclose(seen.variances, variances, rtol=1e-8)
    assert seen.log_likelihood == pytest.approx(likelihood(errors, variances), rel=1e-8)


def test_other_readings_have_the_same_input():
    posterior = linear_posterior(4)
    observation, theta = posterior.observations[0], np.array([0.0, 2.0 * math.log(NOISE_SD)])
    readings = observation.readings + NOISE_SD
    again, plain = observation.read_again(readings=readings), replace(observation, readings=readings)
    assert again.drive is observation.drive
    assert posterior.on((again,)).log_likelihood(theta) == posterior.on((plain,)).log_likelihood(theta)


def test_likelihood_tends_to_the_exact_one():
    """Against matrix exponentials (Van Loan, IEEE TAC 23 (1978) 395-404), the error falls with the third power of the
    step, which is no longer than the motion allows however few are asked for at most. No chance.
    """
    gaps = []
    for nsub in (1, 2):
        posterior = linear_posterior(nsub)
        a, q = dynamics(DT / nsub)
        a2 = a[:2, :2]
        block = expm(np.block([[-a2, np.diag([0.0, q * DT / nsub])], [np.zeros((2, 2)), a2.T]]))
        step = block[2:, 2:].T
        exact = likelihood(*kalman(posterior, expm(a), step, step @ block[:2, 2:]))
        gaps.append(abs(posterior.innovations(THETA).log_likelihood - exact))
    assert gaps[1] < 1e-4
    assert gaps[1] < 0.2 * gaps[0]


@pytest.fixture(scope="module")
def rubbing():
    """A recording with 3 N of hidden friction, its posterior, and coordinates near the truth."""
    observation, states = observation_of(3.0, seed=1)
    return *posterior_for(observation, ("c", "x0")), states


def test_term_that_is_null_changes_no_bit(rubbing):
    """The nominal model is nested in every augmented one, so evidence ratios mean something. No chance.

    A way travelled has a kink at each reversal of the motion, where the filter takes finer steps: 0.002 % here, where a
    friction of 3 N is hidden and the errors are large.
    """
    posterior, theta, _ = rubbing
    bare = posterior.innovations(theta)
    for key in posterior.system.keys:
        null = posterior.acting({key}).innovations(theta)
        if key == "friction_drift_travel":
            assert null.log_likelihood == pytest.approx(bare.log_likelihood, rel=1e-4)
            continue
        assert np.array_equal(null.errors, bare.errors), key
        assert np.array_equal(null.variances, bare.variances), key


def test_smoothed_force_is_the_hidden_one(rubbing):
    """With true base parameters it correlates above 0.8 with what was hidden (a rival's filter: 0.90).

    Alvarez, Luengo, Lawrence (2009). One seeded recording; over seeds the correlation scatters by less than 0.01.
    """
    posterior, theta, states = rubbing
    missing = smooth_latent_force(posterior, theta)
    hidden = -3.0 * np.sign(states[:, 1])
    assert np.corrcoef(missing.force, hidden)[0, 1] > 0.8
    assert missing.force.std() == pytest.approx(3.0, rel=0.2)


@pytest.mark.parametrize("seed", [1, 2])
def test_slopes_promise_what_a_fit_keeps(seed):
    """For a small effect (0.05 N, 0.05 % of the drive) the promised log evidence is that of the fit.

    Rao, Proc. Cambridge Phil. Soc. 44 (1948) 50-57. The two differ by terms of third order in the effect: within 25 %
    or one unit. Both come from the same data, so chance has no part but in how small the effect turns out.
    """
    posterior, theta = posterior_for(observation_of(0.05, seed=seed)[0], ("c", "x0"))
    bare = maximise(posterior, theta)
    (promise,) = list_bare_promises(bare, [FRICTION], {})
    refitted = fit_term(bare, FRICTION, promise.start)
    assert refitted.status == "converged"
    assert promise.gain == pytest.approx(refitted.log_evidence - bare.log_evidence, rel=0.25, abs=1.0)
    assert promise.start[FORCE] == pytest.approx(refitted.values[FORCE], rel=0.25)


@pytest.mark.slow
def test_error_bars_are_as_wide_as_the_scatter():
    """Twelve recordings of ten periods, 1 N hidden: the squares of (estimate - truth) / sd add up to a chi-square.

    Gupta, Mehra, IEEE TAC 19 (1974) 774-783. Three sums with 12 degrees of freedom, each allowed its central
    99.9 %: a correct filter fails with probability 0.003 for new seeds; these are fixed.
    """
    z = np.array([standardised(seed) for seed in range(12)])
    sums = np.sum(z**2, axis=0)
    low, high = chi2.ppf([0.0005, 0.9995], 12)
    assert np.all((sums > low) & (sums < high)), np.sqrt(sums / 12)


def standardised(seed):
    """Return how many standard deviations c, x0 and the friction force lie from the truth in one fit."""
    posterior, theta = posterior_for(observation_of(1.0, seed=40 + seed, periods=10)[0], ("c", "x0"))
    _, slots = find_term(posterior, FRICTION)
    wider = posterior.extend(make_free_parameters(slots, posterior.scales, {FORCE: 1.0}), {FRICTION})
    wider = wider.stepped(8)
    fit = maximise(wider, np.append(theta, 1.0))
    truth = {"c": math.log(TRUE["c"]), "x0": math.log(TRUE["x0"]), FORCE: 1.0}
    estimate, sd = dict(zip(fit.posterior.space.keys, fit.theta, strict=True)), fit.sd
    return [(estimate[k] - value) / sd[k] for k, value in truth.items()]
