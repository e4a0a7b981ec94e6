"""The same map from a cluster, also when one of its workers dies midway."""

import os
import signal

import numpy as np
import pytest

from lostmotion.campaigns.cluster import _get_result
from lostmotion.errors import DataError
from lostmotion.registry import default
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
from lostmotion_chaos.maps.store import load
from lostmotion_chaos.maps.sweep import Workers

distributed = pytest.importorskip("distributed", reason="distributed is not installed: pip install lostmotion[cluster]")

REQUEST = Request(
    "lin_backlash", ("alpha=0.12:0.6:12:inverse", "zeta=0.01:0.04:12"), periods=150, transient=50, starts=2, seed=1
)


@pytest.mark.slow
def test_a_worker_killed_midway_changes_nothing(tmp_path):
    study = make_study(REQUEST, default())
    make_map(study, tmp_path / "here.zarr", RunOptions(Workers(2)), lambda done, total: None)
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as cluster:
        with distributed.Client(cluster) as client:
            victims = list(client.run(os.getpid).values())
        shot = []

        def shoot(done, total):
            if 0 < done < total and not shot:
                os.kill(victims[0], signal.SIGKILL)
                shot.append(done)

        address = cluster.scheduler_address
        make_map(study, tmp_path / "there.zarr", RunOptions(Workers(address=address)), shoot)
    assert shot
    assert len(victims) == 2
    here, there = load(tmp_path / "here.zarr"), load(tmp_path / "there.zarr")
    assert here.identical(there)
    assert sorted(files(tmp_path / "here.zarr")) == sorted(files(tmp_path / "there.zarr"))


def test_workers_that_lack_a_plugin_are_told():
    class Lost:
        def result(self, timeout):
            raise ModuleNotFoundError("No module named 'my_terms'")

    with pytest.raises(DataError, match=r"No module named 'my_terms'.*install lostmotion and its plugins"):
        _get_result(None, Lost())


def files(path):
    return [(str(p.relative_to(path)), p.read_bytes()) for p in path.rglob("*") if p.is_file()]


def test_a_cluster_that_does_not_answer_is_told(tmp_path):
    study = make_study(REQUEST, default())
    with pytest.raises(DataError, match="there is no cluster at"):
        make_map(study, tmp_path / "a.zarr", RunOptions(Workers(address="tcp://127.0.0.1:1")), lambda done, total: None)
    assert np.isnan(load(tmp_path / "a.zarr")["lyapunov_max"]).all()
