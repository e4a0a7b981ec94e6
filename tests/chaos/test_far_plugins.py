"""Plugins of a file reach processes that have never seen the file: workers of a cluster, and of a campaign."""

import json
import pickle
import subprocess
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.registry import Registry, sources
from lostmotion_chaos.maps.cells import compute_cells
from lostmotion_chaos.maps.layout import make_grid_layout
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
from lostmotion_chaos.maps.store import _require_same, load
from lostmotion_chaos.maps.sweep import Workers

REQUEST = Request(
    "lin_backlash",
    ("alpha=0.2:0.4:4",),
    sets=("zeta=0.02",),
    quantities=("guest_crest",),
    periods=40,
    transient=10,
    starts=1,
)
FAR = """
import pickle, sys
from lostmotion.campaigns.cluster import _compute_remotely
texts, packed, cells = pickle.load(open(sys.argv[1], "rb"))
assert not set(texts) & set(sys.modules)
columns = _compute_remotely(texts, packed, cells)
assert set(texts) <= set(sys.modules)
print(columns["guest_crest"].tolist())
"""


@pytest.fixture
def study(tmp_path):
    """Return a study with a quantifier that stands in a file that no other process can import."""
    file = tmp_path / "far_guests.py"
    file.write_text(
        (Path(__file__).parents[1] / "framework" / "third_party.py").read_text(encoding="utf-8").partition("GOOD = ")[0]
    )
    yield make_study(REQUEST, Registry.discover().add_file(file))
    sys.modules.pop("far_guests")


@pytest.mark.slow
def test_a_far_process_computes_cells_of_a_plugin_file(study, tmp_path):
    texts = {name: text for name, text in sources().items() if name == "far_guests"}
    (tmp_path / "packed").write_bytes(
        pickle.dumps((texts, pickle.dumps(partial(compute_cells, study)), np.array([[0]])))
    )
    done = subprocess.run(
        [sys.executable, "-c", FAR, tmp_path / "packed"], capture_output=True, text=True, check=False, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    assert np.isfinite(json.loads(done.stdout)).all()


def test_a_map_knows_the_plugin_file_it_was_made_with(study):
    assert set(study.origins) == {"far_guests.py"}
    other = replace(study, origins={"far_guests.py": "0" * 64})
    with pytest.raises(DataError, match=r"with other settings \(plugin far_guests.py has changed\)"):
        _require_same(Path("map.zarr"), make_grid_layout(study).origin, make_grid_layout(other))


@pytest.mark.slow
def test_a_cluster_computes_what_threads_do(study, tmp_path):
    distributed = pytest.importorskip("distributed", reason="pip install lostmotion[cluster]")
    make_map(study, tmp_path / "here.zarr", RunOptions(Workers(1)), lambda done, total: None)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=True, dashboard_address=None, silence_logs=50
    ) as cluster:
        how = RunOptions(Workers(address=cluster.scheduler_address))
        make_map(study, tmp_path / "there.zarr", how, lambda done, total: None)
    assert load(tmp_path / "here.zarr").identical(load(tmp_path / "there.zarr"))
