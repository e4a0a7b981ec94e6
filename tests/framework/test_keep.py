"""A chain on the disk: a run that was cut short or killed goes on to the same bytes, and no other case's chain does."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
from scipy.stats import norm
from toys import Toy, free_of, task_at

from lostmotion.errors import DataError
from lostmotion.identification.sampling import SamplingPlan, identify

SCRIPT = """
import sys, time
import numpy as np
from pathlib import Path
sys.path.insert(0, {here!r})
import lostmotion.identification.sampling as stage
from test_keep import slow_task, SamplingPlan
stage.SAVE_INTERVAL = 0.0
result = stage.identify(slow_task(), rng=np.random.default_rng(3), plan=SamplingPlan(ess=300), keep=Path(sys.argv[1]))
np.save(sys.argv[2], result.chain)
"""


def slow_task():
    """Return a task whose likelihood takes long enough to be killed in."""

    def height(points):
        time.sleep(0.005)
        return np.sum(norm.logpdf(points), axis=1)

    return task_at(Toy(height, free_of(2)), [np.zeros(2)], [np.eye(2)])


def quick_task(digest="", size=2, at=0.0):
    toy = Toy(lambda points: np.sum(norm.logpdf(points, at), axis=1), free_of(size))
    return replace(task_at(toy, [np.zeros(size)], [np.eye(size)]), digest=digest)


def steps_in(path):
    """Return how many steps the kept chain has, or -1 while there is none."""
    if not path.exists():
        return -1
    with h5py.File(path) as file:
        return int(file["mcmc"].attrs["iteration"])


@pytest.mark.slow
def test_killed_at_any_moment_it_ends_with_the_same_bytes(tmp_path):
    """Killed as soon as it is kept, and a little after so many steps, at whatever it then does; then left alone."""
    begin = [sys.executable, "-c", SCRIPT.format(here=str(Path(__file__).parent))]
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    one, other, rng = tmp_path / "a.h5", tmp_path / "b.h5", np.random.default_rng(9)
    subprocess.run([*begin, str(one), str(tmp_path / "a.npy")], check=True, env=environment)
    for target in (0, 10, 30, 40):
        child = subprocess.Popen([*begin, str(other), str(tmp_path / "b.npy")], env=environment)
        while steps_in(other) < target and child.poll() is None:
            time.sleep(0.002)
        time.sleep(rng.uniform(0.0, 0.1))
        child.send_signal(signal.SIGKILL)
        assert child.wait() == -signal.SIGKILL
        assert target <= steps_in(other) < steps_in(one)
    subprocess.run([*begin, str(other), str(tmp_path / "b.npy")], check=True, env=environment)
    assert np.load(tmp_path / "a.npy").tobytes() == np.load(tmp_path / "b.npy").tobytes()
    with h5py.File(one) as a, h5py.File(other) as b:
        assert a["mcmc/chain"][...].tobytes() == b["mcmc/chain"][...].tobytes()
        assert a["lostmotion"].attrs["evaluations"] == b["lostmotion"].attrs["evaluations"]
    assert not [p.name for p in tmp_path.iterdir() if p.name.startswith(".")]


class CutError(Exception):
    """The run is over before its end."""


def cut_after(calls):
    count = iter(range(10**9))

    def watch(_steps, _says):
        if next(count) >= calls:
            raise CutError

    return watch


@pytest.mark.slow
def test_cut_short_after_any_block_it_ends_the_same(tmp_path, monkeypatch):
    """The same with an exception in place of a kill, so that every place is visited: pilots, start, each block."""
    monkeypatch.setattr("lostmotion.identification.sampling.SAVE_INTERVAL", 0.0)
    plan = SamplingPlan(ess=500)
    rng = np.random.default_rng(1)
    undisturbed = identify(quick_task(), rng=rng, plan=plan)
    after = rng.integers(2**60)
    for calls in range(0, 16, 3):
        path, rng = tmp_path / f"{calls}.h5", np.random.default_rng(1)
        with pytest.raises(CutError):
            identify(quick_task(), rng=np.random.default_rng(1), plan=plan, watch=cut_after(calls), keep=path)
        there = path.exists()
        result = identify(quick_task(), rng=rng, plan=plan, keep=path)
        assert result.resumed == there
        assert result.chain.tobytes() == undisturbed.chain.tobytes()
        assert result.log_density.tobytes() == undisturbed.log_density.tobytes()
        assert (result.evaluations, result.acceptance) == (undisturbed.evaluations, undisturbed.acceptance)
        assert result.lacks == undisturbed.lacks
        assert rng.integers(2**60) == after


def test_a_finished_chain_goes_on_when_more_is_wanted(tmp_path):
    path = tmp_path / "chain.h5"
    short = identify(quick_task(), rng=np.random.default_rng(1), plan=SamplingPlan(max_steps=33), keep=path)
    assert not short.converged
    longer = identify(quick_task(), rng=np.random.default_rng(1), plan=SamplingPlan(ess=900), keep=path)
    once = identify(quick_task(), rng=np.random.default_rng(1), plan=SamplingPlan(ess=900))
    assert longer.resumed
    assert longer.converged
    assert longer.chain.tobytes() == once.chain.tobytes()
    assert longer.evaluations == once.evaluations
    again = identify(quick_task(), rng=np.random.default_rng(1), plan=SamplingPlan(ess=900), keep=path)
    assert again.chain.tobytes() == once.chain.tobytes()


@pytest.mark.parametrize(
    ("task", "seed"), [(quick_task("other"), 1), (quick_task(), 2), (quick_task(size=3), 1), (quick_task(at=0.1), 1)]
)
def test_a_chain_of_another_case_is_not_continued(tmp_path, task, seed):
    path, plan = tmp_path / "chain.h5", SamplingPlan(max_steps=20)
    identify(quick_task(), rng=np.random.default_rng(1), plan=plan, keep=path)
    result = identify(task, rng=np.random.default_rng(seed), plan=plan, keep=path)
    assert (result.resumed, result.replaced) == (False, True)
    fresh = identify(task, rng=np.random.default_rng(seed), plan=plan)
    assert result.chain.tobytes() == fresh.chain.tobytes()


def test_a_file_that_is_no_chain_is_left_alone(tmp_path):
    path = tmp_path / "chain.h5"
    path.write_text("notes")
    with pytest.raises(DataError, match="not a readable chain of an identification"):
        identify(quick_task(), rng=np.random.default_rng(1), keep=path)
    assert path.read_text() == "notes"


def test_emcee_reads_the_kept_chain(tmp_path):
    from emcee.backends import HDFBackend

    path = tmp_path / "chain.h5"
    result = identify(quick_task(), rng=np.random.default_rng(1), plan=SamplingPlan(max_steps=40), keep=path)
    backend = HDFBackend(str(path), read_only=True)
    chain = np.swapaxes(backend.get_chain(discard=result.burn_in), 0, 1)
    np.testing.assert_array_equal(chain, result.chain)
    np.testing.assert_array_equal(backend.get_log_prob(discard=result.burn_in).T, result.log_density)
    assert backend.get_last_sample().random_state[0] == "MT19937"
    assert np.mean(backend.accepted / backend.iteration) == pytest.approx(result.acceptance)
