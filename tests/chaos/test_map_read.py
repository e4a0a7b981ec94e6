"""A map read at a point, refined at the boundary, and drawn; with what is known of the oscillator of the paper."""

import itertools
import math
import shutil

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from lostmotion.errors import DataError
from lostmotion.registry import default
from lostmotion_chaos.maps import figure as map_figure
from lostmotion_chaos.maps.cells import compute_cells
from lostmotion_chaos.maps.map import Map
from lostmotion_chaos.maps.refine import _list_split_cells
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
from lostmotion_chaos.maps.sweep import Workers


def quiet(done, total):
    """Listen to no progress."""


def grid(exponent, share=None, *, spacing="linear", stderr=1e-3):
    """A map of exponents (alpha, zeta, start) over 1, 2, ... and 0.1, 0.2, ..."""
    exponent = np.asarray(exponent, dtype=float)
    dims = ("alpha", "zeta", "start")
    share = (exponent > 0).mean(axis=-1) if share is None else share
    return Map(
        xr.Dataset(
            {
                "lyapunov_max": (dims, exponent, {"units": "1/t_bar"}),
                "lyapunov_stderr": (dims, np.full_like(exponent, stderr)),
                "status": (dims, np.zeros(exponent.shape, np.int8)),
                "chaotic_fraction": (dims[:2], share),
            },
            {
                "alpha": ("alpha", np.arange(1.0, exponent.shape[0] + 1), {"spacing": spacing}),
                "zeta": ("zeta", 0.1 * np.arange(1.0, exponent.shape[1] + 1)),
            },
        )
    )


@pytest.mark.parametrize(
    ("inverse", "value", "chaotic"),
    [(2.0, 0.052, 1.0), (2.6, None, 0.0), (4.1, None, 0.0), (7.5, 0.060, 1.0), (7.7, 0.057, 1.0)],
)
def test_what_careful_integration_found_for_case_1(inverse, value, chaotic):
    """Exponents in bit / t_bar at 2 zeta = 0.04, omega / omega_0 = 0.2: shared/paper/READING.md, table of facts."""
    alpha = f"alpha={1 / inverse}:{1 / inverse}:1"
    request = Request("lin_backlash", (alpha,), 600, 400, 6, sets=("zeta=0.02",), unit="bit")
    found = compute_cells(make_study(request, default()), np.array([[0]]))
    assert found["chaotic_fraction"][0] == chaotic
    if value is None:
        assert (found["lyapunov_max"] < -0.01).all()
        assert (found["period"] >= 1).all()
    else:
        mean, error = found["lyapunov_max"].mean(), np.hypot(found["lyapunov_stderr"].mean() / math.sqrt(6), 0.0005)
        assert abs(mean - value) < 3.0 * error
        assert (found["period"] == 0).all()


def test_a_smooth_map_is_read_between_its_cells_as_a_line():
    alpha, zeta = np.meshgrid(np.arange(1.0, 7.0), 0.1 * np.arange(1.0, 6.0), indexing="ij")
    read = grid(np.repeat((0.1 * alpha - zeta)[..., None], 3, axis=-1)).at(alpha=2.25, zeta=0.25)
    # The cells around pull the mean of a mixture by their small weight, evenly on a plane.
    assert read.value == pytest.approx(0.225 - 0.25, abs=0.005)
    assert read.low < read.value < read.high
    assert read.unit == "1/t_bar"


def test_an_inverse_axis_is_read_in_one_over_it():
    found = grid(np.repeat((1.0 / np.arange(1.0, 7.0))[:, None, None], 4, axis=1), spacing="inverse")
    assert found.at(alpha=1.0 / 0.75, zeta=0.2).value == pytest.approx(0.75, abs=0.03)


def test_an_edge_is_told_as_an_edge():
    """Half-way between a chaotic and a periodic cell nobody knows: the interval holds both."""
    exponent = np.where(np.arange(6)[:, None, None] < 3, 0.05, -0.03) * np.ones((6, 4, 2))
    found = grid(exponent)
    edge, inside = found.at(alpha=3.5, zeta=0.25), found.at(alpha=1.2, zeta=0.25)
    assert edge.chaotic_share == pytest.approx(0.5)
    assert edge.low < -0.03 < 0.05 < edge.high
    assert inside.chaotic_share == 1.0
    assert inside.sd < 0.3 * edge.sd


def test_coexisting_attractors_widen_the_interval():
    exponent = np.full((4, 4, 4), 0.05)
    exponent[..., 0] = -0.03
    read = grid(exponent).at(alpha=2.5, zeta=0.25)
    assert read.chaotic_share == pytest.approx(0.75)
    assert read.low < -0.03 < 0.05 < read.high
    assert read.value == pytest.approx(0.03, abs=1e-9)


def test_a_point_on_a_cell_reads_that_cell():
    rng = np.random.default_rng(0)
    exponent = rng.normal(size=(5, 5, 2))
    read = grid(exponent).at(alpha=5.0, zeta=0.1)
    assert read.low < exponent[4, 0].min()
    assert read.high > exponent[4, 0].max()


@pytest.mark.parametrize(
    ("point", "says"),
    [
        ({"alpha": 0.5, "zeta": 0.2}, "outside of the map, which goes from 1 to 6"),
        ({"alpha": 2.0, "zeta": math.nan}, "outside"),
        ({"alpha": 2.0}, "has alpha, zeta, and alpha was given"),
        ({"alpha": 2.0, "zeta": 0.2, "mass": 1.0}, "has alpha, zeta"),
    ],
)
def test_a_point_outside_is_refused(point, says):
    with pytest.raises(DataError, match=says):
        grid(np.zeros((6, 4, 2))).at(point)


def test_nothing_is_read_where_nothing_was_computed():
    with pytest.raises(DataError, match="has no value of lyapunov_max"):
        grid(np.full((6, 4, 2), np.nan)).at(alpha=2.5, zeta=0.2)
    with pytest.raises(DataError, match="has no 'kaplan_yorke'"):
        grid(np.zeros((6, 4, 2))).at(alpha=2.5, zeta=0.2, quantity="kaplan_yorke")


@pytest.fixture(scope="module")
def fine():
    """A map of 33 x 33 cells across the edge of a window."""
    axes = ("alpha=0.36:0.64:33:inverse", "zeta=0.01:0.05:33")
    return make_study(Request("lin_backlash", axes, 80, 60, 1), default())


@pytest.mark.slow
def test_intervals_hold_what_a_finer_map_shows(fine, tmp_path):
    """Every fourth cell read at the cells between: 95 % are promised; of 300 fewer than 91 % would be chance 0.2 %."""
    whole = make_map(fine, tmp_path / "fine.zarr", RunOptions(Workers(2)), quiet)
    coarse = Map(whole.dataset.isel(alpha=slice(None, None, 4), zeta=slice(None, None, 4)))
    rng = np.random.default_rng(0)
    inside = []
    for _ in range(300):
        cell = whole.dataset.isel(alpha=rng.integers(0, 33), zeta=rng.integers(0, 33), start=0)
        read = coarse.at(alpha=float(cell["alpha"]), zeta=float(cell["zeta"]))
        inside.append(read.low <= float(cell["lyapunov_max"]) <= read.high)
    assert np.mean(inside) > 0.91


def test_a_refined_map_has_the_numbers_of_the_fine_one_where_it_was_computed(fine, tmp_path):
    whole = make_map(fine, tmp_path / "fine.zarr", RunOptions(Workers(2)), quiet).dataset
    axes = ("alpha=0.36:0.64:9:inverse", "zeta=0.01:0.05:9")
    coarse = make_study(Request("lin_backlash", axes, 80, 60, 1), default())
    found = make_map(coarse, tmp_path / "refined.zarr", RunOptions(Workers(2), levels=2), quiet).dataset
    level = found["level"].to_numpy()
    assert level.shape == (33, 33)
    assert (level[::4, ::4] == 0).all()
    assert 81 < (level >= 0).sum() < 700
    assert set(np.unique(level)) == {-1, 0, 1, 2}
    known = level >= 0
    # One over alpha is not the same to the last bit on both grids.
    assert np.abs(found["alpha"] - whole["alpha"]).max() < 1e-15
    apart = np.abs(found["lyapunov_max"].to_numpy() - whole["lyapunov_max"].to_numpy())[known]
    assert np.median(apart) < 1e-3
    wrong = ((found["chaotic_fraction"] > 0.5) != (whole["chaotic_fraction"] > 0.5)).to_numpy()
    assert wrong.mean() < 0.08
    assert sorted(p.name for p in tmp_path.iterdir()) == ["fine.zarr", "refined.zarr"]


def test_a_refined_map_is_continued_level_by_level(fine, tmp_path):
    axes = ("alpha=0.36:0.64:5:inverse", "zeta=0.01:0.05:5")
    study = make_study(Request("lin_backlash", axes, 60, 20, 1), default())
    make_map(study, tmp_path / "whole.nc", RunOptions(Workers(2), levels=2), quiet)

    def stop(done, total):
        if total != 25:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        make_map(study, tmp_path / "cut.nc", RunOptions(Workers(2), levels=2), stop)
    assert (tmp_path / ".cut.nc.levels").is_dir()
    make_map(study, tmp_path / "cut.nc", RunOptions(Workers(1), levels=2), quiet)
    assert (tmp_path / "cut.nc").read_bytes() == (tmp_path / "whole.nc").read_bytes()
    with pytest.raises(DataError, match="with other settings"):
        make_map(study, tmp_path / "cut.nc", RunOptions(Workers(1), levels=1), quiet)
    make_map(study, tmp_path / "cut.nc", RunOptions(Workers(1), levels=1, fresh=True), quiet)


def test_squares_whose_corners_differ_are_halved():
    share, level = np.full((5, 5), np.nan), np.full((5, 5), -1, np.int8)
    share[::2, ::2], level[::2, ::2] = 0.0, 0
    share[0, 0] = 1.0
    assert _list_split_cells(share, level, 2).tolist() == [[0, 1], [1, 0], [1, 1], [1, 2], [2, 1]]
    share[0, 0] = 0.0
    assert len(_list_split_cells(share, level, 2)) == 0
    # A square of side 1 cannot be: those whose corners are not known stay whole.
    assert list(itertools.chain(*_list_split_cells(np.where(level == 0, share, np.nan), level, 4))) == []


def test_the_figure_is_drawn_and_has_its_colours(tmp_path):
    axes = ("alpha=0.36:0.64:12:inverse", "zeta=0.01:0.05:9")
    study = make_study(Request("lin_backlash", axes, 60, 20, 1, unit="bit"), default())
    found = make_map(study, tmp_path / "a.nc", RunOptions(Workers(2)), quiet)
    figure = map_figure.draw(found.dataset)
    assert figure.axes[0].get_xlabel().startswith("1 / alpha (alpha: amplitude of the drive, A / (k0 x0))")
    assert figure.axes[1].get_ylabel() == "largest exponent (bit/t_bar)"
    path = map_figure.save(found.dataset, tmp_path / "a.png")
    with Image.open(path) as image:
        assert image.size[0] > 1000
    again = map_figure.save(found.dataset, tmp_path / "b.png")
    assert path.read_bytes() == again.read_bytes()


def test_a_map_with_holes_is_drawn_and_one_of_one_axis_refused(tmp_path):
    exponent = np.full((6, 4, 2), np.nan)
    assert map_figure.save(grid(exponent, np.full((6, 4), np.nan)).dataset, tmp_path / "holes.png").exists()
    exponent[:3] = -0.1
    assert map_figure.save(grid(exponent).dataset, tmp_path / "half.png").exists()
    with pytest.raises(DataError, match="two axes"):
        map_figure.draw(grid(np.zeros((6, 1, 2))).dataset)


def test_what_is_no_map_is_refused(tmp_path):
    with pytest.raises(DataError, match="does not exist"):
        Map.open(tmp_path / "nothing.zarr")
    xr.Dataset({"a": ("x", [1.0])}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(DataError, match="not a map of lostmotion"):
        Map.open(tmp_path / "other.nc")
    (tmp_path / "empty.zarr").mkdir()
    with pytest.raises(DataError, match="not a map of lostmotion"):
        Map.open(tmp_path / "empty.zarr")
    shutil.rmtree(tmp_path / "empty.zarr")
