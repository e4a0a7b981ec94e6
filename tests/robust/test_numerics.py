"""Where numbers grow extreme: rigid contacts, no gap, no damping, long filters, and motions that nobody can follow."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp
from test_units import CASE

from lostmotion.cli import main
from lostmotion.inference.sensitivity import compute_sensitivity
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.noise_levels import LEAST, USUAL
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points, SensorNoises
from lostmotion.likelihood.predict import WORST, FreeRuns, predict_freely
from lostmotion.likelihood.space import FreeParameter, ParameterSpace
from lostmotion.likelihood.system import System
from lostmotion.noises import NoiseBlock
from lostmotion.settings import DEFAULT
from lostmotion_chaos.flows.flow import flow_of, make_stepped_flow
from lostmotion_chaos.maps.cells import CODES
from lostmotion_plugins.models.exact import ExactBacklash
from lostmotion_plugins.models.lin import LinBacklash

MACHINE = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005}
DRIVE = (100.0, 40.0)
START = np.array([0.001, 0.1])


def strobed(flow, periods=1, tangents=0):
    orbit = flow.strobe(START, periods=periods, tangents=tangents)
    assert orbit.status == "ok"
    return orbit.states


def bouncing(periods):
    """Return the state between rigid walls that throw the mass back with the speed it came with, by DOP853."""
    m, c, x0 = MACHINE["m"], MACHINE["c"], MACHINE["x0"]

    def rates(t, y):
        return [y[1], (DRIVE[0] * math.cos(DRIVE[1] * t) - c * y[1]) / m]

    def hits(t, y):
        return x0 - abs(y[0])

    hits.terminal, hits.direction = True, -1.0
    t, y, end, bounces = 0.0, START, periods * 2.0 * math.pi / DRIVE[1], 0
    while t < end:
        done = solve_ivp(rates, (t, end), y, "DOP853", rtol=1e-12, atol=1e-15, events=hits, max_step=1e-3)
        t, y = done.t[-1], done.y[:, -1] * ([1.0 - 1e-13, -1.0] if done.status == 1 else 1.0)
        bounces += done.status == 1
    return y, bounces


def test_a_stiff_contact_becomes_a_rigid_wall():
    """The time in contact, and with it the distance from the rigid limit, falls with the root of the stiffness."""
    wall, bounces = bouncing(1)
    assert bounces >= 2
    stiff = {k0: np.abs(strobed(flow_of(LinBacklash(), {**MACHINE, "k0": k0}, drive=DRIVE))[-1] - wall).max()
             for k0 in (1e10, 1e12, 1e14)}  # fmt: skip
    assert stiff[1e14] < 1e-3
    assert stiff[1e10] / stiff[1e12] == pytest.approx(10.0, rel=0.3)
    assert stiff[1e12] / stiff[1e14] == pytest.approx(10.0, rel=0.3)


@pytest.mark.parametrize("make", [flow_of, make_stepped_flow])
def test_no_gap_is_a_linear_oscillator(make):
    def state(x0, **more):
        machine = LinBacklash() if make is flow_of else System.of(LinBacklash())
        return strobed(make(machine, {**MACHINE, "x0": x0, **more}, drive=DRIVE, start=START), 3)[-1]

    linear = state(0.005, k1=4e4, k0=0.0)
    assert state(0.0) == pytest.approx(linear, rel=1e-9, abs=1e-12)
    assert state(1e-9) == pytest.approx(linear, abs=1e-6)


def test_without_gap_nothing_is_crossed():
    flow = flow_of(LinBacklash(), {**MACHINE, "x0": 0.0, "k0": 1e16}, drive=DRIVE, start=START)
    assert isinstance(flow, ExactBacklash)
    assert flow.crossings(START, periods=1000) == 0


@pytest.mark.parametrize(("make", "most"), [(flow_of, 1e-9), (make_stepped_flow, 1e-3)])
def test_without_damping_no_energy_is_lost(make, most):
    machine = LinBacklash() if make is flow_of else System.of(LinBacklash())
    states = strobed(make(machine, {**MACHINE, "c": 0.0}, drive=(0.0, 40.0), start=START), 200)
    deep = np.maximum(np.abs(states[:, 0]) - MACHINE["x0"], 0.0)
    energy = 0.5 * states[:, 1] ** 2 + 0.5 * MACHINE["k0"] * deep**2
    assert np.ptp(energy) < most * energy[0]


@pytest.mark.parametrize("size", [1e13, 1e140, 1e170, np.inf, np.nan])
def test_a_filter_that_ran_away_has_no_likelihood(size):
    """Errors of 1e140 are numbers still; squares of their derivatives are none, and brought a fit down."""
    errors = np.ones((2, 5, 1))
    errors[1] = size
    seen = Innovations.of(errors, np.ones((2, 5, 1)), np.array([5, 5]))
    assert seen.finite.tolist() == [True, False]
    assert seen.log_likelihood[1] == -math.inf


def test_a_motion_too_stiff_to_follow_has_a_status():
    """It is given up within seconds, and no number is made of what was seen of it."""
    machine, stiff = System.of(LinBacklash()), {**MACHINE, "k0": 1e18, "x0": 1e-12}
    for flow, statuses in (
        (flow_of(LinBacklash(), stiff, drive=DRIVE, start=START), {"too_stiff"}),
        (make_stepped_flow(machine, {**MACHINE, "c": 1e9}, drive=DRIVE, start=START), {"too_stiff"}),
        (make_stepped_flow(machine, stiff, drive=DRIVE, start=START), {"too_stiff", "diverged"}),
    ):
        orbit = flow.strobe(START, periods=200, tangents=1)
        assert orbit.status in statuses
        assert np.isnan(orbit.growth[-1]).all()


def test_a_map_tells_where_a_motion_is_too_stiff(tmp_path):
    import xarray as xr

    line = ["--x", "k0=1e4:1e18:2:log", "--y", "x0=0.001:0.005:2", "--set", "m=1,c=8", "--starts", "1", "--jobs", "1"]
    line += [
        "--term",
        "coulomb_friction",
        "--set",
        "coulomb_friction.force=1",
        "--drive",
        "harmonic:amplitude=100,omega=40",
    ]
    out = tmp_path / "map.nc"
    done = CliRunner().invoke(
        main, ["map", "--model", "lin_backlash", *line, "--periods", "40", "--transient", "20", "--out", str(out)]
    )
    assert done.exit_code == 0, done.output
    with xr.open_dataset(out) as found:
        status = found["status"].sel(start=0).transpose("k0", "x0").values
        lost = [CODES["too_stiff"], CODES["diverged"]]
        assert np.isin(status[1], lost).all()
        assert not np.isin(status[0], lost).any()
        assert np.isnan(found["lyapunov_max"].transpose("k0", "x0", "start").values[1]).all()


@dataclass(frozen=True)
class Filter:
    """A filter with its covariance, run piece by piece: `q` and `r` are intensity and variance of the noises."""

    system: System
    full: np.ndarray
    dt: float
    q: float
    r: float
    pace: float = 0.0

    def run(self, z, drive, y, cov):
        """Return variances, covariances behind the samples, and state and covariance of the machine before the last."""
        running = Lanes(self.system, self.system.everything, 1, "latent" if self.pace else "white")
        observation = Observation.of("long", z, drive.inputs, self.dt, "position")
        one, number = np.ones((1, 1)), np.zeros(1, dtype=np.int64)
        noise = SensorNoises.of([[NoiseBlock(white=self.r)]])
        points = Points(
            self.full[None], np.array([self.q]), np.array([self.pace]), noise, one, 0.0 *
            one, 0.0 * one, y[None], cov[None], (drive,), number, number,
        )  # fmt: skip
        kept = running.make_kept(observation.samples)
        seen = running.filter_and_keep(observation, points, kept)
        assert seen.finite.all()
        return seen.variances[0, :, 0], kept[1], kept[2][-1, :2], kept[3][-1, :2, :2]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("c", "share", "pace", "noise"),
    [(0.0, math.exp(0.5 * LEAST) * USUAL, 0.0, 1e-9), (8.0, 0.3, 0.0, 1e-9), (0.2, 0.3, 5.0, 1e-5)],
    ids=["least", "sharp", "coloured"],
)
def test_covariances_stay_positive_over_ten_million_steps(c, share, pace, noise):
    """Of a chaotic motion: the least random force of any fit and no damping, a sensor of seven digits, a latent force.

    The random force is a `share` of the drive.
    """
    steps, piece, dt = 10_000_000, 250_000, 4e-4
    system = System.of(LinBacklash())
    full = system.vector({**MACHINE, "c": c})
    rng, y0 = np.random.default_rng(1), START
    y, cov = START, np.diag([1e-8, 1e-2])
    kalman = Filter(system, full, dt, (share * 100.0) ** 2 * dt, noise**2, pace)
    drive = Drive.held(100.0 * np.cos(40.0 * dt * np.arange(piece))[:, None], dt)
    for _ in range(steps // piece):
        states = system.simulate(full, (), y0, drive).states
        z = states[:, 0] + noise * rng.standard_normal(piece)
        variances, covs, y, cov = kalman.run(z, drive, y, cov)
        y0 = states[-1]
        assert np.isfinite(variances).all()
        assert variances.min() >= noise**2
        sd = np.sqrt(np.diagonal(covs, axis1=1, axis2=2))
        assert sd.min() > 0.0
        scaled = covs / (sd[:, :, None] * sd[:, None, :])
        assert np.linalg.det(scaled).min() > 0.0


@dataclass(frozen=True)
class Cliff:
    """A likelihood in one coordinate, that of a mean; beyond 1 the filter does not get through."""

    space = ParameterSpace((FreeParameter("mean", "1", 0.0, -5.0, 5.0),))

    def innovations(self, points):
        seen = np.linspace(-1.0, 1.0, 9)
        return Innovations(
            np.where(points > 1.0, np.nan, seen - points), np.ones((len(points), 9)), points[:, 0] <= 1.0
        )


def test_derivatives_at_the_edge_of_a_runaway_are_taken_from_the_safe_side():
    for at in (0.0, 0.9999, 1.0):
        slopes = compute_sensitivity(Cliff(), np.array([at]), np.array([1e-3]))
        assert slopes.gradient() == pytest.approx([-9.0 * at], abs=1e-9)
        assert slopes.information() == pytest.approx(np.array([[9.0]]))


def test_a_free_run_that_leaves_all_bounds_errs_by_the_most(monkeypatch):
    """It is not left out of the mean, which would flatter the model."""
    from lostmotion.likelihood import predict

    class Still:
        settings = DEFAULT
        observations = (Observation.of("still", np.array([1.0, 2.0, 3.0, 5.0]), np.zeros((4, 1)), 1.0, "position"),)

    def observed(posterior, theta, states, where=(0, 0), sensor=0):
        return np.array([0.0, 1e200, np.nan])

    monkeypatch.setattr(predict, "_simulate_runs", lambda *args: np.zeros((1, 3, 2)))
    monkeypatch.setattr(predict, "observe_states", observed)
    (runs,) = predict_freely(Still(), np.zeros(1), np.zeros((4, 2)), np.array([0]), 3)
    assert isinstance(runs, FreeRuns)
    spread = float(np.std(Still.observations[0].response))
    assert runs.growth(spread) == pytest.approx([abs(Still.observations[0].response[0]) / spread, WORST, WORST])


@pytest.mark.slow
def test_a_contact_shorter_than_a_sample_is_doubted(tmp_path):
    """A tenth of a millisecond of contact between samples of 1.6 ms: a verdict with a doubt, and finite numbers."""
    line = ["simulate", "lin_backlash", "--set", "m=1,c=8,k0=1e9,x0=0.005", "--term", "coulomb_friction:force=3"]
    line += ["--drive", "harmonic:amplitude=100,omega=40", "--duration", "3", "--rate", "640", "--noise", "0.01"]
    done = CliRunner().invoke(main, [*line, "--out", str(tmp_path / "recording.csv")])
    assert done.exit_code == 0, done.output
    (tmp_path / "stiff.toml").write_text(CASE.format(force="N", length="m").replace("40000.0", "1e9"))
    done = CliRunner().invoke(
        main, ["diagnose", str(tmp_path / "stiff.toml"), "--out", str(tmp_path / "out"), "--quiet"]
    )
    assert done.exit_code == 0, done.output
    text = (tmp_path / "out" / "diagnosis.json").read_text()
    assert "NaN" not in text
    assert "Infinity" not in text
    assert any("a bounce at the ground lasts 9.9e-05 s" in note for note in json.loads(text)["notes"])
