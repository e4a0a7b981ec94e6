"""Chaos measures read from recordings, sections of known dimension, and machines found again from their levels."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import CaseFile, Prior
from lostmotion.case.drive_levels import Level, Measured
from lostmotion.codec import to_plain
from lostmotion.contracts import Orbit
from lostmotion.registry import default
from lostmotion_chaos.flows.flow import Harmonic, flow_of
from lostmotion_chaos.levels.levels import MapGrid, make_inversion
from lostmotion_chaos.levels.reading import read_level
from lostmotion_chaos.levels.rehearsal import RecordingPlan, simulate_levels, simulate_signals
from lostmotion_chaos.levels.route import make_drive_level
from lostmotion_chaos.maps.inversion import predict_levels

REGISTRY = default()
M, K0, OMEGA = 1.0, 4e4, 40.0
QUICK = {"periods": 400, "transient": 150, "starts": 3}


class Henon:
    """The map of Henon as the section of a driven flow; its correlation dimension is 1.22 (Grassberger 1983)."""

    period, driven, states, start = 1.0, True, ("x", "y"), np.array([0.1, 0.1])

    def strobe(self, start, *, periods, tangents):
        states = np.empty((periods + 1, 2))
        states[0] = start
        for n in range(periods):
            x, y = states[n]
            states[n + 1] = 1.0 - 1.4 * x * x + y, 0.3 * x
        return Orbit(states, np.zeros((periods, tangents)))


def dimension(flow, periods, rng=None):
    method = REGISTRY.make("quantifier", "section_dimension", periods=periods, transient=200)
    return method.estimate(flow, rng=rng or np.random.default_rng(0))


def case_1(inverse, zeta=0.02):
    """Lin's oscillator in normalised form at omega / omega_0 = 0.2."""
    values = {"m": 1.0, "c": 2.0 * zeta, "k1": 0.0, "k0": 1.0, "x0": 1.0}
    return flow_of(REGISTRY.make("model", "lin_backlash"), values, drive=Harmonic(1.0 / inverse, 0.2))


def test_dimension_of_henons_map():
    found = dimension(Henon(), 6000)
    assert found.ok
    assert found.low < 2.22 < found.high
    assert found.high - found.low < 0.2


def test_dimension_of_case_1_is_that_of_the_flow():
    """2.43: the value that tests/science/test_dimension.py holds the method for recordings to."""
    found = dimension(case_1(2.0), 6000)
    assert found.low < 2.43 < found.high


def test_interval_of_a_short_section_covers():
    """Of 40 orbits of 600 periods at least 33 cover what long ones give: 95 % would miss so often once in 10^4."""
    flow, rng = case_1(5.0), np.random.default_rng(3)
    truth = dimension(flow, 12000).value
    found = [dimension(replace(flow, start=rng.uniform(-2.0, 2.0, 2)), 600) for _ in range(40)]
    assert sum(one.low < truth < one.high for one in found) >= 33


def test_a_periodic_motion_is_a_closed_line():
    found = dimension(case_1(2.6), 600)
    assert (found.value, found.low, found.high, found.status) == (1.0, 1.0, 1.0, "ok")


def test_a_runaway_is_refused():
    class Away(Henon):
        def strobe(self, start, *, periods, tangents):
            return Orbit(np.full((periods + 1, 2), np.nan), np.zeros((periods, tangents)), "diverged")

    found = dimension(Away(), 600)
    assert found.status == "diverged"
    assert math.isnan(found.value)


@pytest.mark.parametrize(("inverse", "motion"), [(2.0, "chaotic"), (2.6, "periodic")])
def test_a_recording_is_read_as_its_level(inverse, motion):
    model, rng = REGISTRY.make("model", "lin_backlash"), np.random.default_rng(5)
    values = {"m": M, "c": 8.0, "k1": 0.0, "k0": K0, "x0": 0.005}
    beat = Harmonic(K0 * 0.005 / inverse, OMEGA)
    level = read_level(simulate_signals(model, values, beat, RecordingPlan(), rng)[0], REGISTRY, rng).level
    assert (level.motion, level.unit) == (motion, "N")
    assert level.amplitude == pytest.approx(beat.amplitude, rel=1e-3)
    assert level.omega == pytest.approx(OMEGA, rel=1e-5)
    if motion == "chaotic":
        assert level.lyapunov.value == pytest.approx(7.24, abs=3.0 * level.lyapunov.sd)
        assert level.d2.value == pytest.approx(2.43, abs=3.0 * level.d2.sd)
        assert level.d2.sd < 0.2


def oscillator(**estimate):
    """A case of Lin's oscillator with k0 and m known."""
    known = {"m": M, "k0": K0, "k1": 0.0}
    if "zeta" not in estimate:
        known["c"] = 8.0
    return CaseFile("oscillator", Path(), (), "lin_backlash", known, estimate, {}, (), "none")


def grid_of(inversion, counts):
    """Points (n, parameters) over the prior, and their posterior weights."""
    ends = [np.linspace(f.low, f.high, n) for f, n in zip(inversion.space.free, counts, strict=True)]
    points = np.stack(np.meshgrid(*ends, indexing="ij"), axis=-1).reshape(-1, len(ends))
    heights = inversion.log_likelihood(points) + inversion.space.log_prior(points)
    weights = np.exp(heights - heights.max())
    return points, weights / weights.sum()


def interval(values, weights, share=0.95):
    """The central interval of weighted values."""
    order = np.argsort(values)
    below = np.cumsum(weights[order])
    return tuple(values[order][np.searchsorted(below, [0.5 - 0.5 * share, 0.5 + 0.5 * share])])


@pytest.mark.slow
def test_gap_of_a_machine_of_known_damping(tmp_path):
    case = oscillator(x0=Prior(low=0.002, high=0.012))
    truth, amplitudes = {"x0": 0.0047}, (50.0, 75.0, 100.0, 140.0)
    drives = [(a, OMEGA) for a in amplitudes]
    levels = tuple(r.level for r in simulate_levels(case, REGISTRY, truth, drives, np.random.default_rng(7)))
    inversion = make_inversion(case, levels, REGISTRY, tmp_path, MapGrid(alpha=120, zeta=1, **QUICK))
    points, weights = grid_of(inversion, (2000,))
    low, high = interval(points[:, 0], weights)
    assert low < truth["x0"] < high
    assert high - low < 0.004
    expected = predict_levels(inversion, points[np.random.default_rng(1).choice(2000, 400, p=weights)],
                         np.random.default_rng(2))  # fmt: skip
    for level, one in zip(levels, expected, strict=True):
        assert (one.chaotic_share > 0.5) == (level.motion == "chaotic")
        json.dumps(to_plain(make_drive_level(one)))


@pytest.mark.slow
def test_gap_and_damping_of_a_simulated_machine(tmp_path):
    case = oscillator(x0=Prior(low=0.002, high=0.012), zeta=Prior(low=0.01, high=0.06))
    truth, amplitudes = {"x0": 0.0052, "zeta": 0.023}, (40.0, 55.0, 75.0, 100.0, 130.0, 170.0)
    drives = [(a, OMEGA) for a in amplitudes]
    levels = tuple(r.level for r in simulate_levels(case, REGISTRY, truth, drives, np.random.default_rng(8)))
    inversion = make_inversion(case, levels, REGISTRY, tmp_path, MapGrid(alpha=90, zeta=8, **QUICK))
    points, weights = grid_of(inversion, (400, 60))
    for column, name in enumerate(("x0", "zeta")):
        low, high = interval(points[:, column], weights)
        assert low < truth[name] < high


@pytest.mark.slow
def test_dimension_decides_between_two_gaps_that_the_exponents_leave(tmp_path):
    """The levels are those read from recordings of a machine with x0 = 3.1 mm: `benchmarks/levels.py decide`."""
    case = oscillator(x0=Prior(low=0.002, high=0.012), zeta=Prior(low=0.01, high=0.06))
    levels = (
        Level("60 N", 60.0, OMEGA, "chaotic", Measured(6.08, 0.48), Measured(2.34, 0.09)),
        Level("75 N", 75.0, OMEGA, "chaotic", Measured(6.20, 0.48), Measured(2.38, 0.08)),
        Level("100 N", 100.0, OMEGA, "periodic"),
    )
    inversion = make_inversion(case, levels, REGISTRY, tmp_path, MapGrid(alpha=90, zeta=10, **QUICK))
    small = {}
    for name, posterior in (("alone", inversion.without_d2()), ("with", inversion)):
        points, weights = grid_of(posterior, (400, 60))
        small[name] = weights[points[:, 0] < 0.005].sum()
    assert 0.15 < small["alone"] < 0.55
    assert small["with"] > 0.7


@pytest.mark.slow
def test_table_2_of_the_paper_holds_the_joint_that_was_searched_for(tmp_path):
    """Half gap 0.7589 degrees and 2 zeta = 0.1116 (`reproduce/joint.py`), of a machine that no one has seen."""
    from lostmotion_chaos.paper.joint import DAMPING, FREQUENCY, HALF, LEVELS, PAPER, RATIO

    omega = 2.0 * math.pi * FREQUENCY
    levels = tuple(
        Level(f"{a:g} deg", math.radians(a), omega, "periodic", unit="rad") if math.isnan(p) else
        Level(f"{a:g} deg", math.radians(a), omega, "chaotic", Measured(p * math.log(2.0), 0.2 * math.log(2.0)), None,
              "rad")
        for a, p in zip(LEVELS, PAPER, strict=True)
    )  # fmt: skip
    estimate = {"x0": Prior(low=math.radians(0.3), high=math.radians(1.5)), "zeta": Prior(low=0.01, high=0.12)}
    known = {"m": 1.0, "k0": (omega / RATIO) ** 2}
    case = CaseFile("table 2", Path(), (), "robot_joint", known, estimate, {}, (), "none", levels=levels)
    inversion = make_inversion(case, levels, REGISTRY, tmp_path, MapGrid(alpha=80, zeta=10, **QUICK))
    points, weights = grid_of(inversion, (400, 60))
    for column, value in ((0, math.radians(HALF)), (1, 0.5 * DAMPING)):
        low, high = interval(points[:, column], weights)
        assert low < value < high
    low, high = interval(points[:, 0], weights)
    assert high - low < 0.6 * np.ptp(points[:, 0])  # exponents alone leave the damping nearly as open as it was
