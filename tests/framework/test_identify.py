"""Identification: known posteriors are recovered, a seed gives the same bytes, and no interval without convergence."""

from dataclasses import dataclass, field

import arviz_stats
import numpy as np
import pytest
import xarray as xr
from made_fits import MadePosterior, make_fit

from lostmotion.errors import CaseError, DataError
from lostmotion.identification.convergence import group_walkers, measure_quality
from lostmotion.identification.moves import make_state
from lostmotion.identification.sampling import SamplingPlan, ShownCoordinate, Task, TMixture, identify, make_task
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.space import FreeParameter, ParameterSpace
from lostmotion.likelihood.system import System
from lostmotion.storage import save_datasets
from lostmotion_plugins.models.basic import LinearOscillator

MEAN = np.array([1.0, -2.0, 0.3])
COVARIANCE = np.array([[0.04, 0.015, 0.0], [0.015, 0.01, 0.0], [0.0, 0.0, 0.25]])
PRECISION = np.linalg.inv(COVARIANCE)


@dataclass(frozen=True)
class Bell:
    """A posterior whose likelihood is normal, or falls exponentially from the lower bound of its last parameter."""

    free: tuple[FreeParameter, ...] = tuple(FreeParameter(k, "N", 0.0, -40.0, 40.0) for k in "abc")
    pressed: bool = False
    asked: list = field(default_factory=list)

    @property
    def space(self):
        return ParameterSpace(self.free)

    def log_likelihood(self, points):
        self.asked.extend(points)
        return np.array([self.height(t) for t in points])

    def height(self, theta):
        if self.pressed:
            return -3.0 * theta[-1] - 0.5 * float(np.sum(theta[:-1] ** 2))
        d = theta - MEAN
        return -0.5 * float(d @ PRECISION @ d)


def task_at(posterior, theta=MEAN, covariance=COVARIANCE):
    shown = tuple(ShownCoordinate(f.key, f.unit, 1.0 if f.log else 0.0) for f in posterior.space.free)
    return Task(posterior, TMixture.of_modes(theta[None], [covariance], np.ones(1), posterior.space.free), shown, theta)


def fit_of(theta=(0.1, -5.0, 1.0, 2.0, -3.0), log_posterior=0.0, log_evidence=0.0):
    """Return a fit of two recordings of a rotation, as far as a task needs one."""
    values, none = np.sin(np.arange(40.0)), np.zeros((40, 1))
    observations = (
        Observation.of("one", values, none, 0.01, "position"), Observation.of("two", values, none, 0.04, "velocity"),
    )  # fmt: skip
    keys = ("c", "x0", "offset[two]", "log_noise[two]", "log_random_force[two]")
    free = tuple(FreeParameter(k, "?", 0.0, -40.0, 40.0, log=k == "x0") for k in keys)
    posterior = MadePosterior(ParameterSpace(free), observations, System(LinearOscillator("rotation")))
    return make_fit(posterior, theta, log_posterior, evidence=log_evidence)


def draw(seed=0, plan=None, **settings):
    return identify(task_at(Bell(), **settings), rng=np.random.default_rng(seed), plan=plan or SamplingPlan())


@pytest.fixture(scope="module")
def bell():
    return draw(plan=SamplingPlan(ess=3000))


def test_normal_posterior_is_recovered(bell):
    assert bell.converged
    error = np.sqrt(np.diag(COVARIANCE) / bell.quality.ess)
    assert np.all(np.abs(bell.draws.mean(axis=0) - MEAN) < 4.0 * error)
    scale = np.sqrt(np.diag(COVARIANCE))
    assert np.all(np.abs(np.cov(bell.draws.T) - COVARIANCE) < 0.1 * np.outer(scale, scale))
    for i, (key, interval) in enumerate(bell.intervals.items()):
        half = 1.96 * bell.sd[key]
        assert interval.unit == "N"
        assert (interval.low, interval.high) == pytest.approx((MEAN[i] - half, MEAN[i] + half), abs=0.2 * half)


def test_a_poor_start_is_made_good():
    result = draw(theta=MEAN + 0.5, covariance=0.01 * np.eye(3))
    assert result.converged
    assert np.all(np.abs(result.draws.mean(axis=0) - MEAN) < 5.0 * np.sqrt(np.diag(COVARIANCE) / result.quality.ess))
    assert result.sd["c"] == pytest.approx(0.5, rel=0.1)


def test_posterior_that_presses_against_its_bound():
    free = (FreeParameter("a", "N", 0.0, -40.0, 40.0), FreeParameter("b", "N", 0.0, 0.0, 40.0))
    posterior = Bell(free, pressed=True)
    task = task_at(posterior, np.zeros(2), np.diag([1.0, 4.0]))
    result = identify(task, rng=np.random.default_rng(4), plan=SamplingPlan(ess=2000))
    assert result.converged
    assert result.intervals["b"].median == pytest.approx(np.log(2.0) / 3.0, rel=0.1)
    assert result.intervals["b"].high == pytest.approx(-np.log(0.025) / 3.0, rel=0.15)
    assert min(t[1] for t in posterior.asked) >= 0.0


def test_logarithms_become_numbers():
    free = (FreeParameter("a", "m", 0.0, -40.0, 40.0, log=True), *Bell().free[1:])
    task = task_at(Bell(free))
    result = identify(task, rng=np.random.default_rng(0), plan=SamplingPlan(max_steps=20))
    assert result.units == ("m", "N", "N")
    assert result.maximum["a"] == pytest.approx(np.exp(MEAN[0]))
    assert result.chain[..., 0].min() > 0.0


def test_same_seed_same_draws_and_another_seed_others():
    short = SamplingPlan(max_steps=30)
    one, again, other = (draw(seed, short) for seed in (7, 7, 8))
    np.testing.assert_array_equal(one.chain, again.chain)
    assert one.chain.tobytes() == again.chain.tobytes()
    assert not np.array_equal(one.chain, other.chain)


def test_no_interval_without_convergence():
    result = draw(plan=SamplingPlan(max_steps=15))
    assert not result.converged
    assert result.intervals == {}
    assert result.sd == {}
    assert any("effective sample size" in words for words in result.lacks)
    assert result.chain.shape[0] == 16


def test_watch_hears_of_every_step():
    heard = []
    identify(
        task_at(Bell()),
        rng=np.random.default_rng(0),
        plan=SamplingPlan(max_steps=25),
        watch=lambda steps, says: heard.append((steps, says)),
    )
    assert sum(steps for steps, _ in heard) == 25
    assert "ESS" in heard[-1][1]
    assert "tau" in heard[-1][1]


def test_too_few_walkers_and_a_hopeless_fit_are_refused():
    with pytest.raises(CaseError, match="4 walkers are too few for 3 parameters: give 8 or more"):
        draw(plan=SamplingPlan(walkers=4))
    with pytest.raises(DataError, match="cannot follow this recording"):
        make_task([fit_of(log_posterior=-np.inf)])


def test_a_task_tells_each_recording_in_its_own_unit():
    task = make_task([fit_of()])
    assert [one.name for one in task.shown] == ["c", "x0", "offset[two]", "measurement_noise[two]", "random_force[two]"]
    assert [one.unit for one in task.shown] == ["?", "?", "rad/s", "rad/s", "N m"]
    expected = [0.1, np.exp(-5.0), 1.0, np.exp(2.0), np.exp(-1.5) / 0.2]
    np.testing.assert_allclose(task.values(task.maximum), expected)


def test_a_task_weighs_modes_by_their_evidence_and_keeps_all():
    fits = [fit_of(log_evidence=e, log_posterior=p) for e, p in ((1.0, 0.0), (1.0, 2.0), (-50.0, 0.0), (np.nan, 0.0))]
    fits[1] = fit_of((1.0, 1.0, 1.0, 1.0, 1.0), 2.0, 1.0)
    task = make_task([*fits, fit_of(log_posterior=-np.inf)])
    assert task.mixture.kernels == 4
    assert task.mixture.weights[0] == pytest.approx(task.mixture.weights[1])
    assert task.mixture.weights[2] == pytest.approx(task.mixture.weights[3])
    assert 0.03 < task.mixture.weights[2] < 0.06
    np.testing.assert_array_equal(task.maximum, np.ones(5))


def test_evaluations_are_counted():
    posterior = Bell()
    result = identify(task_at(posterior), rng=np.random.default_rng(0), plan=SamplingPlan(max_steps=20))
    assert result.evaluations == len(posterior.asked)


def test_density_of_the_cloud_is_that_of_its_draws():
    free = (FreeParameter("a", "1", 0.0, 0.0, 3.0),)
    cloud = TMixture.of_modes(np.array([[0.0]]), [np.array([[0.2]])], np.ones(1), free)
    points = cloud.draw(40000, np.random.RandomState(3))
    counts, edges = np.histogram(points[:, 0], bins=30, range=(0.05, 2.95), density=True)
    middle = 0.5 * (edges[1:] + edges[:-1])
    density = np.exp(cloud.log_density(middle[:, None]))
    density /= density.sum() * (edges[1] - edges[0])
    np.testing.assert_allclose(counts, density, atol=0.05 * density.max())


def test_a_walker_set_apart_is_seen_by_r_hat():
    rng = np.random.default_rng(5)
    chain = rng.standard_normal((16, 200, 1))
    assert measure_quality(chain).rhat[0] < 1.01
    chain[::4] += 1.0
    assert measure_quality(chain).rhat[0] > 1.05
    drifting = rng.standard_normal((16, 200, 1)) + np.linspace(0.0, 1.5, 200)[None, :, None]
    assert measure_quality(drifting).rhat[0] > 1.05


def test_groups_keep_the_order_of_time():
    walks = np.arange(8)[:, None] + 100.0 * np.arange(6)[None]
    assert group_walkers(walks).shape == (4, 12)
    assert np.all(np.diff(group_walkers(walks) // 100.0, axis=1) >= 0)


def test_a_walker_that_never_moved_is_not_believed():
    chain = np.random.default_rng(1).standard_normal((16, 300, 1))
    chain[3] = 0.5
    assert measure_quality(chain).find_shortcomings(100.0, 1.0)


def test_many_walkers_do_not_make_a_short_chain_long():
    quality = measure_quality(np.random.default_rng(1).standard_normal((200, 20, 1)))
    assert quality.ess[0] > 1000.0
    assert "20 steps are less than 50" in quality.find_shortcomings(100.0, quality.slowest)[0]


def test_state_is_seeded_by_the_generator():
    keys = [make_state(np.zeros((4, 2)), np.zeros(4), np.random.default_rng(s)).random_state[1] for s in (1, 1, 2)]
    np.testing.assert_array_equal(keys[0], keys[1])
    assert not np.array_equal(keys[0], keys[2])


def test_arviz_reads_what_is_stored(tmp_path, bell):
    path = tmp_path / "posterior.nc"
    save_datasets(path, bell.groups({"title": "bell"}), {})
    data = xr.open_datatree(path, engine="h5netcdf")
    assert {"posterior", "sample_stats"} <= set(data.children)
    assert data.posterior.attrs == {"title": "bell"}
    assert data.posterior["a"].attrs["units"] == "N"
    assert data.sample_stats["lp"].shape == bell.chain.shape[:2]
    assert float(arviz_stats.ess(data)["c"]) == pytest.approx(bell.quality.ess[2], rel=1e-6)
