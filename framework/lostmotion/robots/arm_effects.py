"""What an arm may lack: terms of the library at a joint or at its drive, a gear, and masses.

An effect names its place, its parameters with their priors, and how it changes the arguments of `TapedArm.filter`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from lostmotion.contracts import DriveTerm, Term
from lostmotion.defaults import RARE_IN_JOINTS
from lostmotion.inference.penalties import compute_own_penalty
from lostmotion.kernels.inner_states import follow_path
from lostmotion.kernels.joint_laws import evaluate_law
from lostmotion.likelihood.compose import compile_law
from lostmotion.parts import Array, Param
from lostmotion.quantities import FORCE, INERTIA, LENGTH, NUMBER, STIFFNESS, TIME, Dimension
from lostmotion.robots.arm import KNOWN_NEEDS, Column, TapedArm, make_law
from lostmotion.robots.gears import ELASTICITY, USUAL_DAMPING, Gear, GearLaw
from lostmotion.robots.tape import Path
from lostmotion.simulators import AT_GEAR

UNSURE = 1.5
"""Standard deviation of the logarithm of a parameter that is known by its order of magnitude."""
GRID = 5
"""The number of values of a shape parameter at which an effect is tried."""
PITCH = "pitch"
"""The parameter whose values are found by a scan of waves over the position of the joint."""
NUDGE = 1e-3
"""The amplitude at which the force of a unit amplitude is found, in units of its scale."""
GAINS = (0.4, 2.5)
"""The gains of a torque that are tried. Others are a wrong unit, which is refused before any fit; with a gain near zero
nothing would drive a joint, and the friction that its torque overcomes would seem to be missing in both."""
CALIBRATED = (0.8, 1.25)
"""Those of a torque sensor behind the gear, which is calibrated, where that of a motor follows from its current."""
GAIN_ERROR = "error"
"""The parameter of a gain: its relative error."""
FURTHER = 0.5
"""The log prior odds against each parameter of a law beyond the first."""
USUAL_GAP, USUAL_MESH, USUAL_LOOP = 1e-3, 60.0, 0.1
"""The usual half play (rad or m), the usual frequency (Hz) of a motor on its gear, and the usual size of hysteresis in
it, as a share of the torque (rms)."""


@dataclass(frozen=True)
class JointScales:
    """The natural scales of a joint: torque (N m), angle (rad), speed (rad/s), or N, m, m/s; `span` of the log (s)."""

    force: float
    length: float
    speed: float
    span: float

    def size(self, param: Param) -> float:
        """Return the typical size of a parameter; one that is `lasting` has the time scale of the whole log."""
        time = self.span if param.prior.lasting else self.length / self.speed
        return param.prior.typical * param.dimension.scale(self.force, self.length, time)


def measure_scales(arm: TapedArm) -> tuple[JointScales, ...]:
    """Return the natural scales of each joint, from its torque and its motion."""
    torque, path, span = arm.torque, arm.tape.path, arm.log.samples * arm.log.dt
    rms = np.sqrt(np.mean(path.v**2, axis=0))
    sizes = zip(np.std(torque, axis=0), np.std(path.q, axis=0), rms, strict=True)
    return tuple(JointScales(*(max(float(x), 1e-12) for x in (*size, span))) for size in sizes)


@dataclass(frozen=True)
class ArmCoordinate:
    """A number that a hypothesis estimates: value = exp(x) if `log`, else `unit` * x, with x normal by the prior.

    `low` and `high` bound the value. `amplitude` marks one at whose null the effect is absent.
    """

    key: str
    unit: float
    mean: float
    sd: float
    log: bool = False
    low: float = -math.inf
    high: float = math.inf
    amplitude: bool = False
    dimension: Dimension | None = None

    def value(self, x: float) -> float:
        """Return the value of a coordinate."""
        return min(max(math.exp(min(x, 300.0)) if self.log else self.unit * x, self.low), self.high)

    def place(self, value: float) -> float:
        """Return the coordinate of a value."""
        return math.log(max(value, 1e-300)) if self.log else value / self.unit

    def log_prior(self, x: float) -> float:
        """Return the log prior density; an amplitude that cannot be negative has half a normal density."""
        half = math.log(2.0) if not self.log and self.low == 0.0 else 0.0
        return half - 0.5 * ((x - self.mean) / self.sd) ** 2 - math.log(self.sd) - 0.5 * math.log(2.0 * math.pi)


@dataclass(frozen=True)
class Shape:
    """One form of an effect: values of its parameters that are no amplitude, and columns of unit amplitudes."""

    values: Mapping[str, float]
    columns: tuple[Column, ...]
    amplitudes: tuple[str, ...]


class ArmEffect(Protocol):
    """An effect that an arm may lack."""

    @property
    def key(self) -> str:
        """The name and the place: `coulomb_friction@elbow`."""

    @property
    def coordinates(self) -> tuple[ArmCoordinate, ...]:
        """Its parameters."""

    @property
    def price(self) -> float:
        """The log prior odds against it beyond those of any effect."""

    @property
    def extends(self) -> tuple[str, ...]:
        """The keys of simpler effects that it contains."""

    def list_shapes(self, path: Path, accelerations: Array) -> Sequence[Shape]:
        """Return its forms along a path; none for an effect that is no force."""


@dataclass(frozen=True, eq=False)
class LawEffect:
    """A term of the library at a joint, or at the drive of a joint (`elbow.torque`)."""

    term: Term
    arm: TapedArm
    joint: int
    scales: JointScales
    pitches: tuple[float, ...] = ()
    chosen: tuple[float, ...] = ()

    @property
    def fixed(self) -> dict[str, float]:
        """The values of the parameters that are tried in turn and not fitted, by key."""
        tried = [q for q in self.term.params if q.prior.choices]
        values = self.chosen or tuple(q.prior.choices[0] for q in tried)
        return {f"{self.key}.{q.name}": value for q, value in zip(tried, values, strict=True)}

    def choose(self, values: Mapping[str, float]) -> LawEffect:
        """Return the effect with the values of a shape for the parameters that are not fitted."""
        return replace(self, chosen=tuple(values[key] for key in self.fixed))

    @property
    def key(self) -> str:
        """The name and the place."""
        return f"{self.term.name}@{self.term.at}"

    @property
    def extends(self) -> tuple[str, ...]:
        """The keys of simpler laws at the same place."""
        return tuple(f"{name}@{self.term.at}" for name in self.term.extends)

    @property
    def price(self) -> float:
        """The log odds against it."""
        return RARE_IN_JOINTS.get(self.term.name, 0.0) + compute_own_penalty(self.term, FURTHER)

    @property
    def coordinates(self) -> tuple[ArmCoordinate, ...]:
        """The parameters that are fitted."""
        return tuple(self._make_coordinate(q) for q in self.term.params if not q.prior.choices)

    def _make_coordinate(self, q: Param) -> ArmCoordinate:
        unit = self.scales.size(q)
        causal = isinstance(self.term, DriveTerm) and q.dimension == TIME
        low = max(q.low, 0.0) if causal else q.low  # a torque from the future holds the noise of a later reading
        key = f"{self.key}.{q.name}"
        if isinstance(self.term, DriveTerm) and q.name == GAIN_ERROR:
            gains = CALIBRATED if self.arm.side == "link" else GAINS
            bounds = (gains[0] - 1.0, gains[1] - 1.0)
            return ArmCoordinate(key, unit, 0.0, 1.0, False, *bounds, q.null is not None, q.dimension)
        if q.null is None and q.scale == "log":
            return ArmCoordinate(key, 1.0, math.log(unit), UNSURE, True, low, q.high, dimension=q.dimension)
        return ArmCoordinate(key, unit, 0.0, 1.0, False, low, q.high, q.null is not None, q.dimension)

    def _list_grid(self, q: Param) -> tuple[float, ...]:
        unit = self.scales.size(q)
        if q.prior.choices:
            return q.prior.choices
        if q.name == PITCH:
            return self.pitches
        if q.prior.scan is None:
            return (0.3 * unit, unit, 3.0 * unit)
        return tuple((unit * np.geomspace(*q.prior.scan, GRID)).tolist())

    def list_shapes(self, path: Path, accelerations: Array) -> Sequence[Shape]:
        """Return its forms along a path."""
        params = self.term.params
        fixed = [q for q in params if q.null is None]
        free = [q for q in params if q.null is not None]
        grids = [self._list_grid(q) for q in fixed]
        found = []
        for values in itertools.product(*grids):
            shape = {f"{self.key}.{q.name}": v for q, v in zip(fixed, values, strict=True)}
            columns = tuple(self._make_column(q, shape, path) for q in free)
            found.append(Shape(shape, columns, tuple(f"{self.key}.{q.name}" for q in free)))
        return found

    def _make_column(self, amplitude: Param, shape: Mapping[str, float], path: Path) -> Column:
        """Return the force of one unit of an amplitude, in units of its scale."""
        unit = self.scales.size(amplitude)
        size = (
            NUDGE * unit if not isinstance(self.term, DriveTerm) or amplitude.name == "share" else 0.1 * self.arm.log.dt
        )
        values = {f"{self.key}.{q.name}": size if q is amplitude else (q.null or 0.0) for q in self.term.params}
        values |= shape
        if isinstance(self.term, DriveTerm):
            log = self.arm.log
            force = (log.drive([self.term], values) - log.drive([], {}))[:, self.joint]
        else:
            force = self._evaluate(values, path)
        return Column(self.key, self.joint, force * (unit / size))

    def _evaluate(self, values: Mapping[str, float], path: Path) -> Array:
        numbers = [values[f"{self.key}.{q.name}"] for q in self.term.params]
        known = {"mobility": 1e-9, "step": self.arm.log.dt, "finest": self.arm.log.dt, "inertia": 1.0, **KNOWN_NEEDS}
        numbers += [known[name] for name in self.term.needs]
        found = np.zeros(len(path.q))
        time = self.arm.log.dt * np.arange(len(found))
        q, v = (np.ascontiguousarray(x[:, self.joint]) for x in (path.q, path.v))
        evaluate = follow_path if self.term.states else evaluate_law
        evaluate(compile_law(make_law(self.term), 0)[0], np.array(numbers), time, q, v, found)
        return found


@dataclass(frozen=True, eq=False)
class GearEffect:
    """Play or flexibility between motor and link of a joint; beside the latter an `inner` law may act there."""

    law: GearLaw
    arm: TapedArm
    joint: int
    inner: Term | None = None

    @property
    def at(self) -> str:
        """The place."""
        return f"{self.arm.joints[self.joint]}{AT_GEAR}"

    @property
    def key(self) -> str:
        """The name and the place."""
        return f"{self.law.name}@{self.at}"

    @property
    def extends(self) -> tuple[str, ...]:
        """The flexibility that play and hysteresis contain as well."""
        return () if self.law is ELASTICITY else (f"{ELASTICITY.name}@{self.at}",)

    @property
    def price(self) -> float:
        """The log odds against it."""
        return FURTHER * (len(self.law.params) - 2)

    @property
    def inertia(self) -> float:
        """The inertia of the motor (kg m^2)."""
        return self.arm.values.get(f"{self.arm.joints[self.joint]}.armature", 0.0)

    @property
    def coordinates(self) -> tuple[ArmCoordinate, ...]:
        """Its parameters, by their orders of magnitude."""
        mesh = (2.0 * math.pi * USUAL_MESH) ** 2 * self.inertia
        usual = {"gap": USUAL_GAP, "stiffness": mesh, "damping_ratio": USUAL_DAMPING, "travel": USUAL_GAP}
        usual["force"] = USUAL_LOOP * float(np.std(self.arm.torque[:, self.joint]))
        kinds = {"gap": LENGTH, "stiffness": STIFFNESS, "damping_ratio": NUMBER, "travel": LENGTH, "force": FORCE}
        return tuple(
            ArmCoordinate(f"{self.key}.{name}", 1.0, math.log(usual[name]), UNSURE, log=True, dimension=kinds[name])
            for name in self.law.params
        )

    def list_shapes(self, path: Path, accelerations: Array) -> Sequence[Shape]:
        """Return nothing: a gear is no force on the chain."""
        return ()

    def list_starts(self, known: Mapping[str, float]) -> list[dict[str, float]]:
        """Return values at which the gear is tried: the resonance of one without play may be sharp.

        An inner law is tried beside the flexibility that is `known`.
        """
        stiff = tuple(np.linspace(-3.5, 1.0, 10).tolist()) if self.law is ELASTICITY else (-1.0, 1.0)
        tried = {"gap": (-1.5, 0.0, 1.5), "stiffness": stiff, "damping_ratio": (0.0,)}
        tried |= {"force": (-1.5, 0.0, 1.5), "travel": (-1.5, 0.0, 1.5)}
        places = {
            c.key: [math.exp(c.mean + s) for s in tried[n]]
            for n, c in zip(self.law.params, self.coordinates, strict=True)
        }
        if self.inner is not None:
            places |= {f"{self.key}.{n}": [known[f"{ELASTICITY.name}@{self.at}.{n}"]] for n in ELASTICITY.params}
        return [dict(zip(places, values, strict=True)) for values in itertools.product(*places.values())]

    def make(self, values: Mapping[str, float]) -> Gear:
        """Return the gear."""
        return self.law.make(tuple(values[c.key] for c in self.coordinates))


@dataclass(frozen=True, eq=False)
class MassEffect:
    """A mass: a payload at a point, a mass of a body or an armature that differs from the model; `value` is its name.

    `name` is `payload` or `inertia_change`, `at` a point, a body or a joint.
    """

    name: str
    at: str
    value: str
    arm: TapedArm
    unit: float

    @property
    def key(self) -> str:
        """The name and the place."""
        return f"{self.name}@{self.at}"

    @property
    def extends(self) -> tuple[str, ...]:
        """Nothing."""
        return ()

    @property
    def price(self) -> float:
        """The log odds against it: a payload is more common than a wrong mass of a body."""
        return 0.0 if self.name == "payload" else 0.5

    @property
    def coordinates(self) -> tuple[ArmCoordinate, ...]:
        """The mass, or the change of the mass or of the moment of inertia."""
        word = "mass" if self.name == "payload" else "change"
        least = 0.0 if self.name == "payload" else -0.9 * self.arm.values.get(self.value, 0.0)
        return (ArmCoordinate(f"{self.key}.{word}", self.unit, 0.0, 1.0, low=least, amplitude=True, dimension=INERTIA),)

    def list_shapes(self, path: Path, accelerations: Array) -> Sequence[Shape]:
        """Return the torque of one unit of the mass along a path."""
        key = self.coordinates[0].key
        if self.value.endswith(".armature"):
            j = self.arm.joints.index(self.at)
            column = Column(self.key, j, -self.unit * accelerations[:, j])
        else:
            column = Column(self.key, -1, -self.unit * self.arm.parts[self.value].weigh(accelerations))
        return (Shape({}, (column,), (key,)),)
