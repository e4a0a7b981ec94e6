"""Rules for running systems: agreement with plain matrices, and independence of points and calls.

Each rule returns what is wrong, or an empty text. The rules use a small machine with a gap, sticking friction and a
Maxwell element, with channels of each kind: a state, a nonlinear function of the states, and an acceleration, which
depends on the present random force.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from reference import Reference

from lostmotion.contracts import Array, Interface, Model, Param, Term, Values
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points, SensorNoises
from lostmotion.likelihood.running import Random, RunningSystem
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.system import System
from lostmotion.noises import AR1, Noise, NoiseBlock, NoiseParameter, SensorScales, White
from lostmotion.quantities import DAMPING, FORCE, INERTIA, LENGTH, STIFFNESS

TOLERANCE = 1e-7
"""The largest accepted difference from the matrices, in standard deviations."""
SAMPLES, DT, SUBSTEPS = 36, 0.01, 4
MANY = 11


def _ground(y: Array, u: Array) -> tuple[float, float]:
    return y[0], y[1]


@dataclass(frozen=True)
class Rig(Model):
    """A driven body in a gap: m x'' + c x' + F(x) = u, with F zero for |x| < x0 and k (|x| - x0) beyond."""

    name = "rig"
    paper = "Lin (1990)"
    motion = "translation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position", "bent", "acceleration")
    params = (
        Param("m", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping", DAMPING),
        Param("k", "stiffness of the contact", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "half gap", LENGTH, low=0.0, scale="log"),
    )
    interfaces = (Interface("ground", row=1, inertia="m", motion=_ground),)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        """Write the derivatives of the states."""
        contact = 0.0
        if abs(y[0]) > p[3]:
            contact = p[2] * (y[0] - math.copysign(p[3], y[0]))
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - contact) / p[0]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        """Write what each channel shows."""
        seen[0] = y[0]
        seen[1] = math.sin(y[0]) + 0.1 * y[1] * abs(y[1])
        seen[2] = dydt[1]


@dataclass(frozen=True)
class Stick(Term):
    """Dry friction with a steep line at rest."""

    at: str = "ground"
    name = "stick"
    physics = "Dry friction of {size}"
    formula = "-size * sign(v)"
    paper = "Coulomb (1785)"
    params = (Param("size", "friction force", FORCE, null=0.0),)
    needs = ("mobility",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return the friction."""
        width = p[0] * p[1]
        if abs(v) >= width:
            return -p[0] if v > 0.0 else (p[0] if v < 0.0 else 0.0)
        return -p[0] * v / width


@dataclass(frozen=True)
class Creep(Term):
    """A spring and a damper in series; the deflection of the spring is a state."""

    at: str = "ground"
    name = "creep"
    physics = "A Maxwell element of {stiffness}"
    formula = "-stiffness * s, ds/dt = v - rate s"
    paper = "Maxwell (1867)"
    params = (Param("stiffness", "stiffness", STIFFNESS, null=0.0),)
    states = ("deflection",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return the force of the spring."""
        return -p[0] * s[0]

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        """Write the rate of the deflection."""
        dsdt[0] = v - 3.0 * s[0]


@dataclass(frozen=True)
class Swing(Noise):
    """A noise of two states that depend on each other."""

    name = "swing"
    paper = "Harvey, Cambridge (1989)"
    states = ("sine", "cosine")

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return its size."""
        return (NoiseParameter("log_noise_swing", 0.0, -9.0, 9.0),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a damped rotation."""
        turn = np.array([[0.8, -0.5], [0.4, 0.7]])
        first = p[0] ** 2 * np.array([[1.0, 0.2], [0.2, 0.5]])
        return NoiseBlock(shown=np.array([1.0, -0.3]), transition=turn, driving=0.2 * first, first=first)


@dataclass(frozen=True)
class Late(Noise):
    """Stamps that jitter."""

    name = "late"
    paper = "Da Dalt et al. (2002)"

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return the deviation of the stamps (s)."""
        return (NoiseParameter("log_noise_late", 0.0, -9.0, 9.0),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a block without states."""
        return NoiseBlock(clock=p[0] ** 2)


SENSORS = {
    "a state": (Sensor("position"),),
    "a nonlinear channel": (Sensor("bent"),),
    "an acceleration": (Sensor("acceleration"),),
    "several sensors, two of them with noise of their own": (
        Sensor("position", noises=(White(), AR1(), Swing())), Sensor("bent"),
        Sensor("acceleration", noises=(White(), AR1())),
    ),
    "stamps that jitter": (Sensor("position", noises=(White(), Late())), Sensor("bent", noises=(White(), Late()))),
}  # fmt: skip
RANDOM: tuple[Random, ...] = ("white", "held", "latent")
VALUES = {"m": 1.0, "c": 1.5, "k": 900.0, "x0": 0.05, "stick.size": 0.4, "creep.stiffness": 20.0}

Run = Callable[..., RunningSystem]
Arguments = tuple[RunningSystem, Observation, Points]


@cache
def _system() -> System:
    return System(Rig(), (Stick(), Creep()))


def make_arguments(
    sensors: tuple[Sensor, ...], random: Random = "white", count: int = 2, lag: float = 0.0
) -> Arguments:
    """Return a slow system with the arguments of a filter: readings with gaps, and points near the true values.

    The sensors are delayed by `lag` samples.
    """
    system, rng = _system(), np.random.default_rng(3)
    full, t = system.vector(VALUES), DT * np.arange(SAMPLES)
    drive = Drive.smooth([lambda t: 12.0 * np.cos(9.0 * t)], DT, SAMPLES)
    x = 0.07 * np.sin(9.0 * t - 0.4)
    seen = {"position": x, "bent": np.sin(x), "acceleration": np.gradient(np.gradient(x, DT), DT)}
    columns = [seen[s.channel] * (1.0 + 0.05 * rng.standard_normal(SAMPLES)) for s in sensors]
    z = np.stack(columns, axis=1)
    z[9] = np.nan
    z[20, 0] = np.nan
    running = Reference(system, system.everything, SUBSTEPS, random)
    scale = np.nanstd(z, axis=0) * np.ones((count, 1))
    near = full * (1.0 + 0.05 * rng.standard_normal((count, len(full))))
    zero = np.zeros(count, dtype=np.int64)
    points = Points(
        near, np.full(count, 1e-2), np.full(count, 15.0), _make_noise(sensors, scale),
        1.0 + 0.1 * rng.standard_normal(scale.shape), 0.01 * scale,
        lag * DT * np.ones(scale.shape),
        np.tile([x[0], 0.5, 0.0], (count, 1)), np.tile(np.diag([1e-4, 1e-2, 1e-5]), (count, 1, 1)),
        (drive,), zero, zero,
    )  # fmt: skip
    return running, Observation("rig", z, drive.inputs, DT, sensors), points


def _make_noise(sensors: tuple[Sensor, ...], scale: Array) -> SensorNoises:
    """Return noise of sensors whose readings have the deviations `scale` (points, sensors)."""
    sizes = {White: 0.03, AR1: 0.05, Swing: 0.02, Late: 0.1 * DT}
    blocks = []
    for row in scale:
        made = [
            [n.covariance((sizes[type(n)] * (1.0 if isinstance(n, Late) else size), 2.8 * DT), DT) for n in s.noises]
            for s, size in zip(sensors, row.tolist(), strict=True)
        ]
        blocks.append([NoiseBlock.join(one) for one in made])
    return SensorNoises.of(blocks)


def _make(run: Run, slow: RunningSystem) -> RunningSystem:
    """Return the same system, made by another class."""
    return run(slow.system, slow.active, slow.nsub, slow.random)


def _filter(run: Run, given: Arguments) -> Innovations:
    slow, observation, points = given
    return _make(run, slow).filter(observation, points)


def _list_cases() -> Iterator[tuple[str, Arguments]]:
    for (what, sensors), random in itertools.product(SENSORS.items(), RANDOM):
        yield f"{what}, with a random force of the kind {random}", make_arguments(sensors, random)
    for (what, sensors), lag in itertools.product(SENSORS.items(), (0.4, -0.3)):
        yield f"{what}, delayed by {lag} samples", make_arguments(sensors, "held", lag=lag)


def _largest_difference(found: Innovations, wanted: Innovations) -> float:
    """Return the largest difference of two sets of innovations, in standard deviations."""
    sd = np.sqrt(wanted.variances)
    gap = np.maximum(np.abs(found.errors - wanted.errors), np.abs(np.sqrt(found.variances) - sd)) / sd
    return float(gap.max()) if np.isfinite(gap).all() else math.inf


def _are_equal(one: Any, other: Any) -> bool:
    names = ("errors", "variances", "finite")
    return all(np.array_equal(getattr(one, n), getattr(other, n), equal_nan=True) for n in names)


def filter_agrees_with_matrices(run: Run) -> str:
    """Return the one-step errors and variances that `Reference` returns, for sensors of every kind."""
    for what, given in _list_cases():
        found, wanted = _filter(run, given), given[0].filter(*given[1:])
        if found.errors.shape != wanted.errors.shape or found.variances.shape != wanted.errors.shape:
            return f"for {what} it returned {found.errors.shape}, where {wanted.errors.shape} is expected"
        if not (difference := _largest_difference(found, wanted)) < TOLERANCE:
            return f"for {what} it differs by {difference:.2g} standard deviations"
    return ""


def smoother_agrees_with_matrices(run: Run) -> str:
    """Return filtered and smoothed states, with their covariances, as `Reference` does."""
    for what, given in _list_cases():
        slow, observation, points = given
        first = points.select(slice(0, 1))
        found, wanted = (one.smooth(observation, first) for one in (_make(run, slow), slow))
        pairs = ((found.filtered, wanted.filtered, wanted.filtered_covariance),)
        for mine, theirs, covariance in (*pairs, (found.states, wanted.states, wanted.covariance)):
            sd = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)).max(axis=0)
            if mine.shape != theirs.shape or not np.all(np.abs(mine - theirs) < 100.0 * TOLERANCE * sd):
                return f"for {what} its states differ from those of the matrices"
        if not np.allclose(found.covariance, wanted.covariance, rtol=1e-5, atol=1e-5 * wanted.covariance.max()):
            return f"for {what} its covariances differ from those of the matrices"
    return ""


def free_run_agrees_with_matrices(run: Run) -> str:
    """Return the free motion by RK4 with the given steps from the start of each run, as `Reference` does."""
    slow, _, points = make_arguments(SENSORS["a state"], count=3)
    points = replace(points, first=np.array([0, 4, 9]))
    start = np.tile([0.06, -0.1, 0.0], (3, 1))
    kicks = 0.01 * np.random.default_rng(4).standard_normal((3, 20, 3))
    for what, more in (("free motion", None), ("motion with kicks", kicks)):
        found, wanted = (one.simulate(points, start, 20, more) for one in (_make(run, slow), slow))
        if found.shape != wanted.shape or not np.allclose(found, wanted, rtol=1e-9, atol=1e-12):
            return f"its {what} differs from that of the matrices"
    return ""


def points_do_not_know_each_other(run: Run) -> str:
    """Make the result of a point independent of the number and order of points, to the last bit."""
    for sensors, random in ((SENSORS["a state"], "white"), (SENSORS["a nonlinear channel"], "held")):
        slow, observation, points = make_arguments(sensors, random, MANY)  # type: ignore[arg-type]
        running = _make(run, slow)
        together = running.filter(observation, points)
        turned = running.filter(observation, points.select(slice(None, None, -1)))
        if not _are_equal(together, turned[::-1]):
            return "the order of the points changes their results"
        for i in (0, MANY - 1):
            if not _are_equal(together[i : i + 1], running.filter(observation, points.select(slice(i, i + 1)))):
                return "the result of a point alone differs from its result among others"
    return ""


def missing_readings_add_nothing(run: Run) -> str:
    """For a reading that is NaN, return the error 0 and the variance 1 / (2 pi), and continue."""
    slow, observation, points = make_arguments(SENSORS["several sensors, two of them with noise of their own"])
    running = _make(run, slow)
    found, lost = running.filter(observation, points), np.isnan(observation.readings)
    if np.any(found.errors[:, lost] != 0.0) or not np.allclose(found.variances[:, lost], 0.5 / math.pi, rtol=1e-12):
        return "a missing reading changes the likelihood"
    nothing = replace(observation, readings=np.full(observation.readings.shape, np.nan))
    empty = running.filter(nothing, points)
    good = empty.finite.all() and np.allclose(np.asarray(empty.log_likelihood), 0.0)
    return "" if good else "a recording without readings has a likelihood other than one"


def divergence_is_a_status(run: Run) -> str:
    """For a point that diverges, return `finite` false for this point only, and raise no error."""
    slow, observation, points = make_arguments(SENSORS["a state"], count=3)
    running = _make(run, slow)
    wild = points.params.copy()
    wild[1, :2] = 1e-30, math.nan
    with np.errstate(all="ignore"):
        found = running.filter(observation, replace(points, params=wild))
        wanted = running.filter(observation, points)
        free = running.simulate(replace(points, params=wild), np.tile([0.06, 0.0, 0.0], (3, 1)), 5)
    if list(found.finite) != [True, False, True]:
        return f"the second of three points diverges, and `finite` is {list(found.finite)}"
    if np.isfinite(np.asarray(found.log_likelihood)[1]) or np.isfinite(free[1, -1]).any():
        return "a point that diverges has a finite likelihood or motion"
    return "" if _are_equal(found[[0, 2]], wanted[[0, 2]]) else "a point that diverges changes the results of others"


def threads_do_not_disturb_each_other(run: Run) -> str:
    """Store nothing between calls: parallel calls from several threads must give the same results as single calls."""
    given = [make_arguments(sensors, count=count) for sensors, count in itertools.product(SENSORS.values(), (1, 5))]
    alone = [_filter(run, g) for g in given]
    with ThreadPoolExecutor(4) as pool:
        for _ in range(3):
            if not all(
                _are_equal(a, b) for a, b in zip(alone, pool.map(lambda g: _filter(run, g), given), strict=True)
            ):
                return "parallel calls from several threads gave other numbers"
    return ""


RULES = (
    filter_agrees_with_matrices,
    smoother_agrees_with_matrices,
    free_run_agrees_with_matrices,
    points_do_not_know_each_other,
    missing_readings_add_nothing,
    divergence_is_a_status,
    threads_do_not_disturb_each_other,
)
