"""A map on the disk: what it holds, that it is continued and not spoilt, and that its bytes depend on nothing else."""

import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from lostmotion.errors import CaseError, DataError
from lostmotion.registry import default
from lostmotion.results import STATUSES
from lostmotion_chaos.maps.cells import compute_cells, find_period
from lostmotion_chaos.maps.layout import make_grid_layout
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
from lostmotion_chaos.maps.sweep import Workers

SMALL = Request(
    "lin_backlash", ("alpha=0.2:0.6:6:inverse", "zeta=0.01:0.04:5"), periods=60, transient=20, starts=2, seed=3
)
ARGS = [
    "map", "--model", "lin_backlash", "--x", "alpha=0.12:0.6:12:inverse", "--y", "zeta=0.01:0.04:12",
    "--periods", "400", "--transient", "100", "--starts", "2", "--quiet",
]  # fmt: skip


def quiet(done, total):
    """Listen to no progress."""


def study(**changes):
    return make_study(replace(SMALL, **changes), default())


def made(path, how=None, **changes):
    return make_map(study(**changes), path, how or RunOptions(Workers(2)), quiet)


def tree(path):
    """Return the digest of every file below a folder."""
    files = sorted(p for p in path.rglob("*") if p.is_file())
    return {str(p.relative_to(path)): hashlib.sha256(p.read_bytes()).hexdigest() for p in files}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A map that nothing disturbed."""
    path = tmp_path_factory.mktemp("map") / "whole.zarr"
    made(path)
    return path


def test_the_contract_of_the_dataset(whole):
    with xr.open_zarr(whole, mask_and_scale=False) as stored:
        assert stored["lyapunov_max"].dims == ("alpha", "zeta", "start")
        assert stored["lyapunov_max"].attrs["units"] == "1/t_bar"
        assert stored["lyapunov_stderr"].dims == stored["status"].dims == stored["period"].dims
        assert stored["chaotic_fraction"].dims == ("alpha", "zeta")
        assert stored["status"].dtype == np.int8
        flags = stored["status"].attrs
        meanings = dict(zip(flags["flag_values"], flags["flag_meanings"].split(), strict=True))
        assert list(meanings.values()) == [*STATUSES, "not_computed"]
        assert {meanings[int(v)] for v in np.unique(stored["status"])} <= {"ok", "uncertain"}
        assert all(v.attrs["long_name"] for v in stored.variables.values())
        assert np.diff(1.0 / stored["alpha"].to_numpy()) == pytest.approx(np.full(5, -2.0 / 3.0))
        provenance = json.loads(stored.attrs["provenance"])
    assert provenance["seed"] == 3
    assert provenance["settings"]["axes"] == ["alpha=0.2:0.6:6:inverse", "zeta=0.01:0.04:5:linear"]
    assert set(provenance["versions"]) >= {"lostmotion", "numpy", "numba"}


def test_it_opens_without_a_warning(whole):
    code = "import sys, xarray; xarray.open_zarr(sys.argv[1]).load()"
    subprocess.run([sys.executable, "-W", "error::RuntimeWarning", "-c", code, str(whole)], check=True)


def test_the_share_of_chaos_is_that_of_positive_exponents(whole):
    with xr.open_zarr(whole) as stored:
        low = stored["lyapunov_max"] - 2.1 * stored["lyapunov_stderr"]
        share = ((low > 0) & (stored["period"] == 0)).mean("start")
        assert float(np.abs(share - stored["chaotic_fraction"]).max()) <= 0.5
        assert 0.2 < float(stored["chaotic_fraction"].mean()) < 0.9
        assert set(np.unique(stored["chaotic_fraction"])) <= {0.0, 0.5, 1.0}


@pytest.mark.parametrize("jobs", [1, 3])
def test_bytes_do_not_depend_on_the_number_of_workers(whole, tmp_path, jobs):
    made(tmp_path / "other.zarr", RunOptions(Workers(jobs)))
    assert tree(tmp_path / "other.zarr") == tree(whole)


def test_numbers_do_not_depend_on_the_chunks():
    plan = study()
    cells = np.array([[0, 0], [3, 2], [5, 4]])
    together, alone = compute_cells(plan, cells), compute_cells(plan, cells[1:2])
    assert all(np.array_equal(together[name][1:2], alone[name], equal_nan=True) for name in alone)


def test_starts_are_those_of_the_seed():
    cells = np.array([[1, 1]])
    same, other = compute_cells(study(), cells), compute_cells(study(seed=4), cells)
    assert np.array_equal(compute_cells(study(), cells)["lyapunov_max"], same["lyapunov_max"])
    assert not np.array_equal(other["lyapunov_max"], same["lyapunov_max"])
    more = compute_cells(study(starts=5), cells)
    assert np.array_equal(more["lyapunov_max"][:, :2], same["lyapunov_max"])


def test_a_spoilt_store_is_mended(whole, tmp_path):
    """What a kill can leave behind: chunks without their last file, half-written files, a store half made."""
    path = tmp_path / "cut.zarr"
    shutil.copytree(whole, path)
    shutil.rmtree(path / "status" / "c" / "1")
    shutil.rmtree(path / "lyapunov_max" / "c" / "2")
    shutil.rmtree(path / "status" / "c" / "2")
    (path / "period" / "c" / "0" / "0" / "0.1234.partial").write_bytes(b"half")
    (tmp_path / ".cut.zarr.making").mkdir()
    with xr.open_zarr(path, mask_and_scale=False) as stored:
        assert int(stored["status"].min()) == -1
    said = []
    make_map(study(), path, RunOptions(Workers(2)), lambda done, total: said.append((done, total)))
    assert tree(path) == tree(whole)
    assert said[0][0] > 0
    assert said[-1] == (30, 30)


def test_an_error_midway_keeps_what_is_finished(whole, tmp_path):
    def stop(done, total):
        if done > 10:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        make_map(study(), tmp_path / "cut.zarr", RunOptions(Workers(2)), stop)
    begun = len(tree(tmp_path / "cut.zarr"))
    made(tmp_path / "cut.zarr")
    assert begun < len(tree(whole))
    assert tree(tmp_path / "cut.zarr") == tree(whole)


@pytest.mark.slow
def test_killed_at_random_moments_it_ends_in_the_same_bytes(tmp_path):
    command = [sys.executable, "-m", "lostmotion", *ARGS, "--out"]
    subprocess.run([*command, str(tmp_path / "whole.zarr")], check=True, capture_output=True)
    rng, cut = np.random.default_rng(1), tmp_path / "cut.zarr"
    for _ in range(4):
        run = subprocess.Popen([*command, str(cut)], stdout=subprocess.DEVNULL, env=os.environ)
        enough, before = int(rng.integers(0, 12)), files(cut)
        while run.poll() is None and files(cut) <= before + enough:
            time.sleep(0.002)
        time.sleep(float(rng.uniform(0.0, 0.02)))
        run.kill()
        run.wait()
        assert files(cut) >= before
    subprocess.run([*command, str(cut)], check=True, capture_output=True)
    assert tree(cut) == tree(tmp_path / "whole.zarr")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["cut.zarr", "whole.zarr"]


def files(path):
    return len(list(path.rglob("c/*/*/*"))) if path.exists() else 0


def test_a_map_with_other_settings_is_refused_unless_fresh(whole, tmp_path):
    path = tmp_path / "a.zarr"
    shutil.copytree(whole, path)
    with pytest.raises(DataError, match=r"with other settings \(seed 3, now 4\)"):
        made(path, seed=4)
    with pytest.raises(DataError, match="starts 2, now 3"):
        made(path, starts=3)
    assert tree(path) == tree(whole)
    made(path, RunOptions(Workers(2), fresh=True), starts=1)
    assert xr.open_zarr(path).sizes["start"] == 1


def test_what_is_none_of_ours_is_never_touched(tmp_path):
    folder = tmp_path / "photos.zarr"
    folder.mkdir()
    (folder / "holiday.txt").write_text("sun")
    for fresh in (False, True):
        with pytest.raises(DataError, match="not a map of lostmotion"):
            made(folder, RunOptions(Workers(1), fresh=fresh))
    assert (folder / "holiday.txt").read_text() == "sun"
    (tmp_path / "notes.nc").write_text("no netCDF")
    with pytest.raises(DataError, match="cannot be read as"):
        made(tmp_path / "notes.nc", RunOptions(Workers(1), fresh=True))


def test_two_runs_do_not_write_one_map(whole, tmp_path):
    path = tmp_path / "a.zarr"
    shutil.copytree(whole, path)
    shutil.rmtree(path / "status" / "c" / "1")

    def meanwhile(done, total):
        with pytest.raises(DataError, match="being written by another run"):
            made(path)

    make_map(study(), path, RunOptions(Workers(1)), meanwhile)


def test_netcdf_holds_the_same_and_leaves_nothing_beside_it(whole, tmp_path):
    first = made(tmp_path / "a.nc").dataset
    made(tmp_path / "b.nc")
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()
    assert list(first.data_vars) == sorted(first.data_vars)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.nc", "b.nc"]
    with xr.open_zarr(whole, mask_and_scale=False) as stored:
        for name in stored.variables:
            assert np.array_equal(
                stored[name].to_numpy(), first[name].to_numpy(), equal_nan=stored[name].dtype == float
            )
    with xr.open_dataset(tmp_path / "a.nc", mask_and_scale=False) as stored:
        assert stored["status"].attrs["flag_values"].dtype == np.int8
    begun = []
    make_map(study(), tmp_path / "a.nc", RunOptions(Workers(1)), lambda done, total: begun.append(done))
    assert begun == []


@pytest.mark.parametrize(("name", "says"), [("map.csv", r"\.zarr or \.nc"), ("map", r"\.zarr or \.nc")])
def test_another_ending_is_refused(tmp_path, name, says):
    with pytest.raises(DataError, match=says):
        made(tmp_path / name)
    with pytest.raises(CaseError, match="0 to 8"):
        made(tmp_path / "a.zarr", RunOptions(levels=9))


def test_bits_are_what_they_are():
    cells = np.array([[2, 2]])
    nats, bits = compute_cells(study(), cells), compute_cells(study(unit="bit"), cells)
    for name in ("lyapunov_max", "lyapunov_stderr"):
        assert bits[name] == pytest.approx(nats[name] / np.log(2.0))
    assert make_grid_layout(study(unit="bit")).variables["lyapunov_max"].attrs.units == "bit/t_bar"


def test_further_quantities_stand_beside_the_exponent():
    plan = study(quantities=("kaplan_yorke",), periods=200)
    found = compute_cells(plan, np.array([[0, 1]]))
    assert np.isin(found["kaplan_yorke_status"], [0, 1]).all()
    chaotic = found["lyapunov_max"] > 3 * found["lyapunov_stderr"]
    assert chaotic.any()
    assert (found["kaplan_yorke"][chaotic] > 2.0).all()
    plain = compute_cells(study(periods=200), np.array([[0, 1]]))
    assert np.array_equal(plain["lyapunov_max"], found["lyapunov_max"])


@pytest.mark.slow
def test_a_dimension_of_a_series_may_be_asked_for():
    found = compute_cells(study(quantities=("d2",), starts=1, periods=150), np.array([[0, 1]]))
    assert np.isfinite(found["d2"]).all() or (found["d2_status"] > 0).all()


def test_a_start_may_be_an_axis():
    """At 1/alpha = 4.1 and zeta = 0.02 two orbits coexist, mirror images of one another (shared/paper/READING.md)."""
    request = Request(
        "lin_backlash", ("start.position=-2:2:5", "start.velocity=-0.5:0.5:3"), periods=100, transient=100, starts=1,
        sets=("zeta=0.02", f"alpha={1 / 4.1}"),
    )  # fmt: skip
    plan = make_study(request, default())
    cells = np.array([[i, j] for i in range(5) for j in range(3)])
    found = compute_cells(plan, cells)
    assert (found["period"] == 1).all()
    assert (found["chaotic_fraction"] == 0.0).all()


def test_a_model_without_a_closed_form_is_mapped_too():
    request = Request(
        "lin_backlash", ("alpha=0.4:0.6:2",), periods=60, transient=40, starts=1, sets=("zeta=0.02",),
        terms=("cubic_stiffness:coefficient=0.001",),
    )  # fmt: skip
    found = compute_cells(make_study(request, default()), np.array([[0], [1]]))
    assert np.isfinite(found["lyapunov_max"]).all()


@pytest.mark.parametrize("k", [1, 2, 7, 32])
def test_a_period_is_found(k):
    cycle = np.random.default_rng(k).normal(size=(k, 2))
    assert find_period(np.tile(cycle, (200 // k + 1, 1))) == k


def test_no_period_is_no_period():
    rng = np.random.default_rng(0)
    assert find_period(rng.normal(size=(300, 2))) == 0
    assert find_period(np.tile(rng.normal(size=(33, 2)), (9, 1))) == 0
    assert find_period(np.full((300, 2), np.nan)) == 0
    assert find_period(np.ones((20, 2))) == 0
    assert find_period(np.zeros((300, 2))) == 1
