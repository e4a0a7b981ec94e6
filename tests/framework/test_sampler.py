"""The sampler: modes get their weights, awkward shapes are recovered, rugged posteriors are found."""

import math

import numpy as np
import pytest
from scipy.stats import norm
from toys import Toy, free_of, task_at

from lostmotion.identification.normal_scores import Scores
from lostmotion.identification.population import count_effective, temper_weights
from lostmotion.identification.sampling import SamplingPlan, ShownCoordinate, Task, identify
from lostmotion.identification.t_mixture import TMixture
from lostmotion.likelihood.space import FreeParameter
from lostmotion_chaos.levels.incremental_mixture import find_mixture


def two_modes(size, share):
    """Return a posterior of two modes of weights `share` and 1 - `share`: a normal one, and one with heavy tails.

    The second is a product of logistic densities, so that neither Laplace's evidence nor its covariance is right.
    """

    def height(points):
        one = np.sum(norm.logpdf(points, -5.0, 0.5), axis=1)
        z = np.abs((points - 5.0) / 0.6)
        other = np.sum(-z - 2.0 * np.log1p(np.exp(-z)) - math.log(0.6), axis=1)
        return np.logaddexp(math.log(share) + one, math.log(1.0 - share) + other)

    return Toy(height, free_of(size))


@pytest.mark.parametrize("size", [1, 2, 6])
def test_two_modes_get_their_weights(size):
    """False alarm: 1 in 15 000 for each size; the guesses of the weights are wrong by a factor of sixteen."""
    modes = np.array([np.full(size, -5.0), np.full(size, 5.0)])
    task = task_at(two_modes(size, 0.8), modes, [0.25 * np.eye(size), np.eye(size)], [0.2, 0.8])
    result = identify(task, rng=np.random.default_rng(11), plan=SamplingPlan(ess=2000))
    assert result.converged
    left = result.draws[:, 0] < 0.0
    assert abs(left.mean() - 0.8) < 4.0 * math.sqrt(0.16 / 2000)
    assert result.draws[left].mean(axis=0) == pytest.approx(np.full(size, -5.0), abs=0.08)
    assert result.draws[~left].std(axis=0) == pytest.approx(np.full(size, 0.6 * math.pi / math.sqrt(3)), rel=0.25)
    hops = np.mean(np.diff(result.chain[:, :, 0] < 0.0, axis=1) != 0)
    assert hops > 0.05  # walkers themselves change the mode


def test_a_mode_that_is_nothing_gets_nothing():
    task = task_at(two_modes(2, 1.0 - 1e-9), [[-5.0, -5.0], [5.0, 5.0]], [0.25 * np.eye(2), np.eye(2)])
    result = identify(task, rng=np.random.default_rng(3))
    assert result.converged
    assert np.all(result.draws < 0.0)


@pytest.mark.slow
def test_banana():
    """Rosenbrock's valley: x normal, y normal about x^2; the start is the normal approximation at one end of it."""

    def height(points):
        return norm.logpdf(points[:, 0], 0.0, 1.0) + norm.logpdf(points[:, 1], points[:, 0] ** 2, 0.2)

    task = task_at(Toy(height, free_of(2)), [[1.0, 1.0]], [np.array([[0.5, 1.0], [1.0, 2.04]])])
    result = identify(task, rng=np.random.default_rng(5), plan=SamplingPlan(ess=1000))
    assert result.converged
    x, y = result.draws.T
    assert abs(x.mean()) < 4.0 / math.sqrt(1000)
    assert abs(x.var() - 1.0) < 4.0 * math.sqrt(2.0 / 1000)
    assert abs(y.mean() - 1.0) < 4.0 * math.sqrt(2.04 / 1000)
    assert abs(np.mean(y - x**2)) < 4.0 * 0.2 / math.sqrt(1000)


def test_piled_up_on_a_bound_and_a_wide_prior():
    """As the random force does: an exponential of scale 0.5 at the lower bound, 40 wide, that widens another one."""
    free = (*free_of(1), FreeParameter("force", "N", -14.0, -14.0, 26.0))

    def height(points):
        up = points[:, 1] + 14.0
        return norm.logpdf(points[:, 0], 0.0, np.exp(0.5 * up)) - 2.0 * up

    task = task_at(Toy(height, free), [[0.0, -14.0]], [np.diag([1.0, 0.5])])
    result = identify(task, rng=np.random.default_rng(8), plan=SamplingPlan(ess=2000))
    assert result.converged
    up = result.draws[:, 1] + 14.0
    for share in (0.1, 0.5, 0.9):
        assert abs(np.mean(up < -0.5 * math.log(1.0 - share)) - share) < 4.0 * math.sqrt(share * (1 - share) / 2000)
    assert up.min() >= 0.0
    assert result.evaluations < 7500


@pytest.mark.slow
def test_ten_recordings_with_levels_of_their_own():
    """Twenty-one parameters, half of them piled up on a bound: slower, but it gets there from Laplace's guess."""
    free = (*free_of(11), *(FreeParameter(f"f{i}", "N", 0.0, 0.0, 20.0) for i in range(10)))

    def height(points):
        return np.sum(norm.logpdf(points[:, :11]), axis=1) - np.sum(2.0 * points[:, 11:], axis=1)

    task = task_at(Toy(height, free), [np.zeros(21)], [np.diag([1.0] * 11 + [0.5] * 10)])
    result = identify(task, rng=np.random.default_rng(2), plan=SamplingPlan(ess=400))
    assert result.converged
    assert np.abs(result.draws[:, :11].mean(axis=0)).max() < 5.0 / math.sqrt(400)
    assert np.abs(result.draws[:, 11:].mean(axis=0) - 0.5).max() < 5.0 * 0.5 / math.sqrt(400)


def rugged(points):
    """Return a comb of some forty narrow ridges and bumps under a broad hill, in the unit square."""
    x, y = points.T
    ripple = 6.0 * (np.cos(40.0 * x + 9.0 * y) + np.cos(13.0 * y - 5.0 * x**2))
    return ripple - 8.0 * ((x - 0.4) ** 2 + (y - 0.6) ** 2)


@pytest.fixture(scope="module")
def sampled():
    toy = Toy(rugged, free_of(2, 0.0, 1.0))
    return toy, find_mixture(toy, np.random.default_rng(4))


def exact(bins):
    """Return the shares of the square's `bins` by `bins` fields under the rugged posterior, from a fine grid."""
    fine = (np.arange(50 * bins) + 0.5) / (50 * bins)
    grid = np.stack(np.meshgrid(fine, fine, indexing="ij"), axis=-1).reshape(-1, 2)
    density = np.exp(rugged(grid)).reshape(bins, 50, bins, 50).sum(axis=(1, 3))
    return density / density.sum()


def test_importance_sampling_finds_a_rugged_posterior(sampled):
    """Fields of a ten by ten grid against the exact shares: at most 1.5 times as far off as independent draws."""
    toy, mixture = sampled
    shown = tuple(ShownCoordinate(f.key, f.unit, 0.0) for f in toy.free)
    task = Task(toy, mixture, shown, np.array([0.3, 0.6]))
    result = identify(task, rng=np.random.default_rng(6), plan=SamplingPlan(ess=2000))
    assert result.converged
    truth = exact(10)
    found, *_ = np.histogram2d(*result.draws.T, bins=10, range=((0, 1), (0, 1)))
    expected = np.sum(np.sqrt(truth * (1 - truth) / 2000) * math.sqrt(2 / math.pi))
    assert np.abs(found / found.sum() - truth).sum() < 1.5 * expected
    middle = (np.arange(10) + 0.5) / 10
    assert result.draws[:, 0].mean() == pytest.approx(float(middle @ truth.sum(axis=1)), abs=0.02)
    assert result.acceptance > 0.4
    assert 10 < mixture.kernels <= 200


def test_importance_sampling_keeps_the_whole_prior_in_sight(sampled):
    toy, mixture = sampled
    corners = np.array([[x, y] for x in (0.001, 0.5, 0.999) for y in (0.001, 0.5, 0.999)])
    prior = toy.space.log_prior(corners)
    assert np.all(mixture.log_density(corners) > prior + math.log(0.02))


def test_density_of_a_cloud_is_that_of_its_draws():
    """Each coordinate near a bound at which scores are piled, or far from it; the integral over a grid is one."""
    free = (FreeParameter("a", "1", 0.0, 0.0, 3.0), FreeParameter("b", "1", 0.0, -30.0, 30.0))
    points = np.array([[0.0, 1.0], [2.0, -1.0]])
    mixture = TMixture.of_modes(points, [np.diag([0.2, 1.0])] * 2, np.array([0.7, 0.3]), free)
    a, b = np.linspace(0.0, 3.0, 802)[1:-1], np.linspace(-30.0, 30.0, 1202)[1:-1]
    grid = np.stack(np.meshgrid(a, b, indexing="ij"), axis=-1).reshape(-1, 2)
    density = np.exp(mixture.log_density(grid)).reshape(800, 1200) * (a[1] - a[0]) * (b[1] - b[0])
    assert density.sum() == pytest.approx(1.0, abs=0.02)
    draws = mixture.draw(40000, np.random.default_rng(3))
    for share in (0.05, 0.5, 0.95):
        edge = np.quantile(draws[:, 0], share)
        assert density[a < edge].sum() == pytest.approx(share, abs=0.02)


def test_scores_go_to_and_fro():
    low, high = np.array([0.0, -14.0]), np.array([1.0, 6.0])
    for scale in (Scores.flat(low, high), Scores.piled(low, high, low, np.array([0.1, 0.5]))):
        points = low + (high - low) * np.random.default_rng(1).random((500, 2))
        np.testing.assert_allclose(scale.to_points(scale.to_scores(points)), points, rtol=1e-6)
        step = 1e-6 * (high - low)
        slope = (scale.to_scores(points + step / 2) - scale.to_scores(points - step / 2)) / step
        np.testing.assert_allclose(np.log(slope), scale.compute_log_slopes(points), atol=1e-3)


def test_weights_are_flattened_no_more_than_needed():
    log_weights = np.array([0.0, -1.0, -2.0, -50.0, -math.inf])
    assert count_effective(temper_weights(log_weights, 1.0)) < 3.0
    assert count_effective(temper_weights(log_weights, 3.5)) == pytest.approx(3.5, rel=1e-3)
    np.testing.assert_allclose(temper_weights(log_weights, 9.0), [0.25, 0.25, 0.25, 0.25, 0.0])
