"""Rules for engines: agreement with plain matrices, and what holds for many points at once.

They are tried on a small rig with a gap, sticking friction and a creeping spring, which shows channels of every kind:
one that is a state, one that bends over the states, and one that feels the random force of the moment.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from lostmotion.contracts import Array, Engine, Interface, Model, Param, Term, Values
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.engine import Dynamics, Innovations, Points, Random
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.reference import Reference
from lostmotion.likelihood.sensors import AR1, Sensor
from lostmotion.likelihood.system import System
from lostmotion.quantities import DAMPING, FORCE, INERTIA, LENGTH, STIFFNESS
from lostmotion.testing.rules import rule

SLACK = 1e-7
"""By how much of a standard deviation an engine may be off what matrices give."""
SAMPLES, DT, SUBSTEPS = 36, 0.01, 4
MANY = 11


def _ground(y: Array, u: Array) -> tuple[float, float]:
    return y[0], y[1]


@dataclass(frozen=True)
class Rig(Model):
    """A body in a gap, under a force: m x'' + c x' + F(x) = u, with F zero for |x| < x0 and k (|x| - x0) beyond."""

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
    """A spring and a damper in a row: the deflection of the spring is a state."""

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
        """Write the pace of the deflection."""
        dsdt[0] = v - 3.0 * s[0]


SENSORS = {
    "a state": (Sensor("position"),),
    "a bent channel": (Sensor("bent"),),
    "an acceleration": (Sensor("acceleration"),),
    "several sensors, two of them with slow noise": (
        Sensor("position", noise=AR1()), Sensor("bent"), Sensor("acceleration", noise=AR1()),
    ),
}  # fmt: skip
RANDOM: tuple[Random, ...] = ("white", "held", "latent")
VALUES = {"m": 1.0, "c": 1.5, "k": 900.0, "x0": 0.05, "stick.size": 0.4, "creep.stiffness": 20.0}

Asked = tuple[Dynamics, Observation, Points]


@cache
def _system() -> System:
    return System(Rig(), (Stick(), Creep()))


def asked(sensors: tuple[Sensor, ...], random: Random = "white", count: int = 2, lag: float = 0.0) -> Asked:
    """Return what an engine is handed: readings of a wandering rig, with gaps, and points near what made them.

    The sensors are late by `lag` samples.
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
    dynamics = Dynamics(system, system.everything, SUBSTEPS, random)
    scale = np.nanstd(z, axis=0) * np.ones((count, 1))
    near = full * (1.0 + 0.05 * rng.standard_normal((count, len(full))))
    zero = np.zeros(count, dtype=np.int64)
    points = Points(
        near, np.full(count, 1e-2), np.full(count, 15.0), (0.03 * scale) ** 2, (0.05 * scale) ** 2,
        np.full(scale.shape, 0.7), 1.0 + 0.1 * rng.standard_normal(scale.shape), 0.01 * scale,
        lag * DT * np.ones(scale.shape),
        np.tile([x[0], 0.5, 0.0], (count, 1)), np.tile(np.diag([1e-4, 1e-2, 1e-5]), (count, 1, 1)),
        (drive,), zero, zero,
    )  # fmt: skip
    return dynamics, Observation("rig", z, drive.inputs, DT, sensors), points


def _every() -> Iterator[tuple[str, Asked]]:
    for (what, sensors), random in itertools.product(SENSORS.items(), RANDOM):
        yield f"{what}, with a random force that is {random}", asked(sensors, random)
    for (what, sensors), lag in itertools.product(SENSORS.items(), (0.4, -0.3)):
        yield f"{what}, late by {lag} samples", asked(sensors, "held", lag=lag)


def _off(found: Innovations, wanted: Innovations) -> float:
    """Return by how many standard deviations two sets of innovations differ at the most."""
    sd = np.sqrt(wanted.variances)
    gap = np.maximum(np.abs(found.errors - wanted.errors), np.abs(np.sqrt(found.variances) - sd)) / sd
    return float(gap.max()) if np.isfinite(gap).all() else math.inf


def _same(one: Any, other: Any) -> bool:
    names = ("errors", "variances", "finite")
    return all(np.array_equal(getattr(one, n), getattr(other, n), equal_nan=True) for n in names)


@rule("engine")
def filter_agrees_with_matrices(engine: Engine) -> str:
    """Return the one-step errors and variances that the engine `reference` returns, for sensors of every kind."""
    for what, given in _every():
        found, wanted = engine.filter(*given), Reference().filter(*given)
        if found.errors.shape != wanted.errors.shape or found.variances.shape != wanted.errors.shape:
            return f"for {what} it returned {found.errors.shape}, and {wanted.errors.shape} was wanted"
        if not (off := _off(found, wanted)) < SLACK:
            return f"for {what} it is off by {off:.2g} standard deviations"
    return ""


@rule("engine")
def smoother_agrees_with_matrices(engine: Engine) -> str:
    """Return filtered and smoothed states, with their covariances, as the engine `reference` does."""
    for what, given in _every():
        dynamics, observation, points = given
        one = (dynamics, observation, points.select(slice(0, 1)))
        found, wanted = engine.smooth(*one), Reference().smooth(*one)
        pairs = ((found.filtered, wanted.filtered, wanted.filtered_covariance),)
        for mine, theirs, covariance in (*pairs, (found.states, wanted.states, wanted.covariance)):
            sd = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)).max(axis=0)
            if mine.shape != theirs.shape or not np.all(np.abs(mine - theirs) < 100.0 * SLACK * sd):
                return f"for {what} its states are not those of matrices"
        if not np.allclose(found.covariance, wanted.covariance, rtol=1e-5, atol=1e-5 * wanted.covariance.max()):
            return f"for {what} its covariances are not those of matrices"
    return ""


@rule("engine")
def free_run_agrees_with_matrices(engine: Engine) -> str:
    """Return the free motion by RK4 in the given steps, as the engine `reference` does, from where each run begins."""
    dynamics, _, points = asked(SENSORS["a state"], count=3)
    points = replace(points, first=np.array([0, 4, 9]))
    start = np.tile([0.06, -0.1, 0.0], (3, 1))
    kicks = 0.01 * np.random.default_rng(4).standard_normal((3, 20, 3))
    for what, more in (("free motion", None), ("motion with kicks", kicks)):
        found, wanted = (e.simulate(dynamics, points, start, 20, more) for e in (engine, Reference()))
        if found.shape != wanted.shape or not np.allclose(found, wanted, rtol=1e-9, atol=1e-12):
            return f"its {what} is not that of matrices"
    return ""


@rule("engine")
def points_do_not_know_each_other(engine: Engine) -> str:
    """Let what comes out for a point depend on neither the number of points nor their order: the same bits."""
    for sensors, random in ((SENSORS["a state"], "white"), (SENSORS["a bent channel"], "held")):
        dynamics, observation, points = asked(sensors, random, MANY)  # type: ignore[arg-type]
        together = engine.filter(dynamics, observation, points)
        turned = engine.filter(dynamics, observation, points.select(slice(None, None, -1)))
        if not _same(together, turned[::-1]):
            return "the order of the points changes what comes out for them"
        for i in (0, MANY - 1):
            if not _same(together[i : i + 1], engine.filter(dynamics, observation, points.select(slice(i, i + 1)))):
                return "a point alone gives other numbers than among others"
    return ""


@rule("engine")
def missing_readings_add_nothing(engine: Engine) -> str:
    """Where a reading is NaN, note the error 0 and the variance 1 / (2 pi), and go on."""
    dynamics, observation, points = asked(SENSORS["several sensors, two of them with slow noise"])
    found, lost = engine.filter(dynamics, observation, points), np.isnan(observation.readings)
    if np.any(found.errors[:, lost] != 0.0) or not np.allclose(found.variances[:, lost], 0.5 / math.pi, rtol=1e-12):
        return "a reading that is missing adds to the likelihood"
    nothing = replace(observation, readings=np.full(observation.readings.shape, np.nan))
    empty = engine.filter(dynamics, nothing, points)
    good = empty.finite.all() and np.allclose(np.asarray(empty.log_likelihood), 0.0)
    return "" if good else "a recording without readings has a likelihood other than one"


@rule("engine")
def divergence_is_a_status(engine: Engine) -> str:
    """Where a point leaves all numbers, return `finite` false for it alone, and raise nothing."""
    dynamics, observation, points = asked(SENSORS["a state"], count=3)
    wild = points.params.copy()
    wild[1, :2] = 1e-30, math.nan
    with np.errstate(all="ignore"):
        found = engine.filter(dynamics, observation, replace(points, params=wild))
        wanted = engine.filter(dynamics, observation, points)
        run = engine.simulate(dynamics, replace(points, params=wild), np.tile([0.06, 0.0, 0.0], (3, 1)), 5)
    if list(found.finite) != [True, False, True]:
        return f"of three points, of which the second diverges, finite are {list(found.finite)}"
    if np.isfinite(np.asarray(found.log_likelihood)[1]) or np.isfinite(run[1, -1]).any():
        return "a point that diverges has a likelihood, or a motion"
    return "" if _same(found[[0, 2]], wanted[[0, 2]]) else "a point that diverges changes what comes out for others"


@rule("engine")
def threads_do_not_disturb_each_other(engine: Engine) -> str:
    """Keep nothing between calls: calls from several threads at once give what they give one after the other."""
    given = [asked(sensors, count=count) for sensors, count in itertools.product(SENSORS.values(), (1, 5))]
    alone = [engine.filter(*g) for g in given]
    with ThreadPoolExecutor(4) as pool:
        for _ in range(3):
            if not all(_same(a, b) for a, b in zip(alone, pool.map(lambda g: engine.filter(*g), given), strict=True)):
                return "calls from several threads gave other numbers"
    return ""
