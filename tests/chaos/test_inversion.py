"""Levels inverted through a map whose answer is known: what is looked up where, and what counts for what."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import CaseFile, Prior
from lostmotion.case.drive_levels import Level, Measured
from lostmotion.codec import to_plain
from lostmotion.errors import CaseError, DataError
from lostmotion.likelihood.space import FreeParameter, ParameterSpace
from lostmotion.registry import default
from lostmotion.settings import DEFAULT
from lostmotion_chaos.levels.levels import (
    MapGrid,
    _make_free_parameter,
    compute_derived,
    make_inversion,
    make_level_numbers,
    make_quantifier_task,
)
from lostmotion_chaos.levels.route import make_drive_level
from lostmotion_chaos.maps.atlas import CHAOTIC, PERIODIC, Atlas
from lostmotion_chaos.maps.inversion import Inversion, compute_likelihood, group_levels, predict_levels
from lostmotion_chaos.maps.map import RING_WEIGHT, Map
from lostmotion_chaos.maps.numbers import NumberLaw, NumberPower, make_law
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study

ALPHA, ZETA = np.linspace(0.2, 2.0, 37), np.linspace(0.01, 0.1, 10)


def atlas(exponent, dimension=None, *, starts=2):
    """An atlas over 1/alpha in [0.5, 5] and zeta, from functions of alpha and zeta; chaotic where positive."""
    inverse = np.linspace(0.5, 5.0, 46)
    alpha, zeta = np.meshgrid(1.0 / inverse[::-1], ZETA, indexing="ij")
    value = np.repeat(exponent(alpha, zeta).reshape(-1, 1), starts, axis=1)
    d2 = np.full_like(value, 2.2) if dimension is None else np.repeat(dimension(alpha, zeta).reshape(-1, 1), starts, 1)
    kind = np.where(value > 0.0, CHAOTIC, PERIODIC).astype(np.int8)
    nothing = np.zeros_like(value)
    points = (-inverse[::-1], ZETA)
    return Atlas(("alpha", "zeta"), ("inverse", "linear"), points, kind, value, nothing, d2, nothing + 0.02)


def inversion(levels, made, *, known=None):
    """An inversion for x0 and zeta of a machine with k0 = 1: alpha = amplitude / x0."""
    free = (FreeParameter("x0", "m", 1.0, 0.4, 2.0), FreeParameter("zeta", "1", 0.05, 0.01, 0.1))
    laws = tuple(
        {"alpha": NumberLaw(math.log(level.amplitude), (-1.0, 0.0), True), "zeta": NumberLaw(0.0, (0.0, 1.0))}
        for level in levels
    )
    return Inversion(tuple(levels), (made,), (0,) * len(levels), laws, ParameterSpace(free))


def window(alpha, zeta):
    """Chaos where 1/alpha lies between 1.5 and 2.5, faster in its middle and with less damping."""
    return np.where(np.abs(1.0 / alpha - 2.0) < 0.5, 0.2 - 0.2 * (1.0 / alpha - 2.0) ** 2 - zeta, -0.05)


def posterior(made, x0, zeta):
    """The posterior (x0, zeta) on a grid, normalised."""
    points = np.stack(np.meshgrid(x0, zeta, indexing="ij"), axis=-1).reshape(-1, 2)
    heights = made.log_likelihood(points)
    weights = np.exp(heights - heights.max())
    return (weights / weights.sum()).reshape(len(x0), len(zeta))


def test_kinds_of_motion_alone_bracket_the_gap():
    amplitudes = (0.3, 0.42, 0.5, 0.6, 0.75)
    levels = [Level(f"{a}", a, 1.0, "chaotic" if 1.5 < 1.0 / a < 2.5 else "periodic") for a in amplitudes]
    found = posterior(inversion(levels, atlas(window)), x0 := np.linspace(0.4, 2.0, 161), ZETA)
    share = found.sum(axis=1)
    # All of 0.42 ... 0.6 within the window, 0.3 and 0.75 without: x0 from 0.9 to 1.05 and no other.
    assert share[(x0 > 0.88) & (x0 < 1.07)].sum() > 0.9


def test_exponents_find_gap_and_damping():
    truth, omega = (1.02, 0.04), 3.0
    levels = []
    for a in (0.45, 0.5, 0.6):
        value = omega * float(window(np.array(a / truth[0]), truth[1]))
        levels.append(Level(f"{a}", a, omega, "chaotic", Measured(value, 0.02 * value)))
    x0, zeta = np.linspace(0.4, 2.0, 321), np.linspace(0.01, 0.1, 91)
    found = posterior(inversion(levels, atlas(window)), x0, zeta)
    best = np.unravel_index(found.argmax(), found.shape)
    assert x0[best[0]] == pytest.approx(truth[0], abs=0.03)
    assert zeta[best[1]] == pytest.approx(truth[1], abs=0.012)


def test_dimension_tells_two_gaps_of_one_exponent_apart():
    level = Level("a", 0.5, 1.0, "chaotic", Measured(0.12, 0.003), Measured(2.1, 0.03))
    made = atlas(lambda a, z: np.full_like(a, 0.12), lambda a, z: np.where(1.0 / a < 2.0, 2.1, 2.5))
    x0 = np.linspace(0.4, 2.0, 161)
    with_d2 = posterior(inversion([level], made), x0, ZETA).sum(axis=1)
    without = posterior(inversion([level], made).without_d2(), x0, ZETA).sum(axis=1)
    assert without[x0 < 1.0].sum() < 0.45
    assert with_d2[x0 < 1.0].sum() > 0.9


def test_coexisting_attractors_leave_both_motions_possible():
    made = atlas(window, starts=4)
    kind = made.kind.copy()
    kind[:, 0] = PERIODIC
    mixed = Atlas(made.names, made.spacings, made.points, kind, *(getattr(made, k) for k in
                  ("exponent", "exponent_sd", "dimension", "dimension_sd")))  # fmt: skip
    inside = np.flatnonzero((2.0 * math.pi * made.exponent > DEFAULT.levels.weak).all(axis=1))
    seen = {
        motion: compute_likelihood(Level("a", 1.0, 1.0, motion), mixed)[inside] for motion in ("periodic", "chaotic")
    }
    assert np.allclose(seen["periodic"] / seen["chaotic"], 1.0 / 3.0, atol=0.15)


def test_a_misread_level_is_unlikely_but_not_impossible():
    levels = [Level("a", 0.5, 1.0, "chaotic"), Level("b", 0.5, 1.0, "periodic")]
    heights = inversion(levels, atlas(window)).log_likelihood(np.array([[1.0, 0.05], [2.0, 0.05]]))
    assert np.isfinite(heights).all()


def test_outside_of_the_map_nothing_is_possible():
    found = inversion([Level("a", 0.5, 1.0, "chaotic")], atlas(window))
    assert found.log_likelihood(np.array([[1.0, 0.05], [1.0, 0.2], [4.0, 0.05]])).tolist()[1:] == [-math.inf] * 2


def test_blending_is_linear_between_cells_and_mixes_in_the_ring():
    made = atlas(window)
    inverse, zeta = -made.points[0], made.points[1]
    table = (np.repeat(inverse[:, None], len(zeta), axis=1) + 10.0 * zeta).ravel()
    at = made.locate({"alpha": np.array([1.0 / 2.04]), "zeta": np.array([0.055])})
    # On a plane the mean of the ring is the middle of the square.
    ring = made.average_ring(table)
    assert made.interpolate(table, ring, at)[0] == pytest.approx(
        (1 - RING_WEIGHT) * 2.59 + RING_WEIGHT * (2.05 + 0.55), abs=1e-9
    )


def test_the_ring_leaves_the_square_out_at_the_edges_too():
    made = atlas(window)
    shape, rng = made.shape, np.random.default_rng(0)
    table = rng.random(shape)
    ring = made.average_ring(table.ravel()).reshape(shape)
    for i, j in ((0, 0), (5, 3), (shape[0] - 2, shape[1] - 2), (0, 4)):
        cells = {(a, b) for a in range(i - 1, i + 3) for b in range(j - 1, j + 3)}
        inside = {c for c in cells if 0 <= c[0] < shape[0] and 0 <= c[1] < shape[1]}
        kept = inside - {(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)}
        assert ring[i, j] == pytest.approx(np.mean([table[c] for c in kept]))


def test_predictions_are_those_of_the_map():
    level = Level("a", 0.5, 2.0, "chaotic")
    found = predict_levels(inversion([level], atlas(window)), np.tile([1.0, 0.05], (200, 1)), np.random.default_rng(1))[
        0
    ]
    assert found.chaotic_share == 1.0
    assert found.lyapunov.median == pytest.approx(2.0 * 0.15, rel=0.05)
    assert found.lyapunov.low <= found.lyapunov.median <= found.lyapunov.high
    told = to_plain(make_drive_level(replace(found, level=replace(level, lyapunov=Measured(0.3, 0.1)))))
    assert told["predicted"]["chaotic_share"] == 1.0
    assert {"low", "median", "high"} == told["predicted"]["lyapunov"].keys()
    assert told["lyapunov"] == {"value": 0.3, "low": pytest.approx(0.104), "high": pytest.approx(0.496), "unit": "1/s"}
    assert "d2" not in told


@pytest.mark.parametrize("name", ["lin_backlash", "robot_joint"])
def test_powers_are_those_of_the_groups(name):
    model = default().make("model", name)
    values = {"m": 2.0, "c": 3.0, "k0": 50.0, "x0": 0.2, "k1": 5.0, "drive.amplitude": 4.0, "drive.omega": 2.0}
    truth = {"zeta": 0.15, "frequency_ratio": 0.4, "alpha": 0.4 if name == "lin_backlash" else 20.0}
    for group in model.groups:
        if group.name in truth:
            law = make_law(NumberPower.of(group, model), values, ["x0"])
            assert law(np.log([[0.2]]))[0] == pytest.approx(truth[group.name])


def test_ends_of_a_number_over_a_box():
    assert NumberLaw(0.0, (1.0, -2.0)).find_range((0.0, 0.0), (math.log(2.0), math.log(3.0))) == pytest.approx(
        (1 / 9, 2.0)
    )


def test_levels_of_one_frequency_share_a_map():
    levels = [Level(str(k), 1.0, omega, "chaotic") for k, omega in enumerate((2.0, 1.0, 1.0005, 2.001))]
    assert group_levels(levels) == [[1, 2], [0, 3]]


def test_priors_are_cut_where_a_map_must_end():
    model = default().make("model", "lin_backlash")
    half = _make_free_parameter("c", Prior(half_sd=2.0), model)
    assert 0.0 < half.low < 0.05
    assert 6.0 < half.high < 8.0
    log = _make_free_parameter("x0", Prior(median=0.5, sd_log=0.1), model)
    assert log.log
    assert math.exp(log.low) == pytest.approx(0.5 * math.exp(-0.329), rel=1e-3)


def test_a_parameter_that_is_neither_known_nor_free_is_named():
    model = default().make("model", "lin_backlash")
    power = next(NumberPower.of(group, model) for group in model.groups if group.name == "alpha")
    with pytest.raises(CaseError, match="alpha needs k0"):
        make_law(power, {"x0": 1.0, "drive.amplitude": 2.0}, [])


def test_a_map_without_dimensions_is_refused(tmp_path):
    request = Request("lin_backlash", ("alpha=0.3:0.6:2", "zeta=0.02:0.05:2"), 100, 20, 1)
    make_map(make_study(request, default()), tmp_path / "map.nc", RunOptions(), lambda _done, _all: None)
    with pytest.raises(DataError, match="section_dimension"):
        Atlas.of(Map.open(tmp_path / "map.nc"))


def test_an_open_stiffness_adds_the_frequency_ratio_to_the_map(tmp_path):
    levels = (Level("a", 0.5, 0.2, "chaotic", unit="N"), Level("b", 0.4, 0.2, "periodic", unit="N"))
    estimate = {"x0": Prior(low=0.8, high=1.3), "c": Prior(low=0.03, high=0.06), "k0": Prior(median=1.0, sd_log=0.02)}
    case = CaseFile("open", Path(), (), "lin_backlash", {"m": 1.0}, estimate, {}, (), "none", levels=levels)
    survey = MapGrid(alpha=16, zeta=4, ratios=3, periods=100, transient=60, starts=1)
    made = make_inversion(case, levels, default(), tmp_path, survey)
    assert made.atlases[0].names == ("alpha", "zeta", "frequency_ratio")
    assert made.atlases[0].shape == (8, 2, 3)
    inside = made.log_likelihood(np.array([[1.0, 0.04, 0.0], [0.8, 0.03, made.space.free[2].low]]))
    assert np.isfinite(inside).all()
    assert set(made.compute_numbers(np.array([[1.0, 0.04, 0.0]]))) == {"zeta"}
    again = make_inversion(case, levels, default(), tmp_path, MapGrid(maps=tuple(tmp_path.glob("*.nc"))))
    assert np.array_equal(again.log_likelihood(np.array([[1.0, 0.04, 0.0]])), inside[:1])
    wide = replace(case, estimate={**estimate, "x0": Prior(low=0.5, high=1.3)})
    with pytest.raises(DataError, match="priors ask for"):
        make_inversion(wide, levels, default(), tmp_path, MapGrid(maps=tuple(tmp_path.glob("*.nc"))))


def test_a_task_is_ready_to_be_sampled_and_changes_with_what_was_seen(tmp_path):
    levels = (Level("a", 0.5, 0.2, "chaotic", unit="N"), Level("b", 0.39, 0.2, "periodic", unit="N"))
    estimate = {"x0": Prior(low=0.8, high=1.3, scale="log"), "zeta": Prior(low=0.015, high=0.03)}
    case = CaseFile("task", Path(), (), "lin_backlash", {"m": 1.0, "k0": 1.0}, estimate, {}, (), "none", levels=levels)
    survey = MapGrid(alpha=16, zeta=4, periods=100, transient=60, starts=1)
    told = []
    task = make_quantifier_task(
        case, default(), tmp_path, np.random.default_rng(1), survey, say=lambda *x: told.append(x)
    )
    assert told[-1] == (64, 64)
    assert [(s.name, s.unit, s.power) for s in task.shown] == [("x0", "m", 1.0), ("zeta", "1", 0.0)]
    assert np.isfinite(task.posterior.log_likelihood(task.maximum[None])).all()
    assert np.allclose(compute_derived(task.posterior, task.maximum[None]).get("zeta", 0.0), 0.0)
    other = replace(case, levels=(levels[0],))
    again = make_quantifier_task(
        other, default(), tmp_path, np.random.default_rng(1), MapGrid(maps=(*tmp_path.glob("*.nc"),))
    )
    assert again.digest != task.digest


def test_a_case_without_levels_is_told_what_is_wanted(tmp_path):
    case = CaseFile("none", Path(), (), "lin_backlash", {}, {}, {}, (), "none")
    with pytest.raises(CaseError, match=r"neither \[\[levels\]\] nor"):
        make_quantifier_task(case, default(), tmp_path, np.random.default_rng(1))


@pytest.mark.parametrize(
    ("known", "estimate", "unit", "says"),
    [
        ({"m": 1.0, "k0": 1.0, "c": 0.1}, {"x0": Prior(low=0.5, high=1.0), "k1": Prior(low=0.1, high=0.2)}, "N", "k1"),
        ({"m": 1.0, "k0": 1.0, "c": 0.1}, {"x0": Prior(low=0.5, high=1.0)}, "rad", "is in N"),
        ({"m": 1.0, "c": 0.1}, {"x0": Prior(low=0.5, high=1.0)}, "N", "needs k0"),
        ({"m": 1.0, "k0": 1.0, "c": 0.1}, {"x0": Prior(low=-2.0, high=-1.0)}, "N", "positive values"),
        (
            {"m": 1.0, "k0": 1.0, "c": 0.1},
            {"x0": Prior(low=0.5, high=1.0), "zeta": Prior(low=0.1, high=0.2)},
            "N",
            "both c and zeta",
        ),
    ],
)
def test_cases_that_cannot_be_inverted_are_refused_in_a_sentence(known, estimate, unit, says):
    levels = (Level("a", 0.5, 0.2, "chaotic", unit=unit),)
    case = CaseFile("bad", Path(), (), "lin_backlash", known, estimate, {}, (), "none", levels=levels)
    with pytest.raises(CaseError, match=says):
        make_level_numbers(case, levels, default())
