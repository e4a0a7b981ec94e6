"""The contract of a simulator: a machine with many joints that somebody else has written."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar, NamedTuple

from lostmotion.parts import Array

INVERSE = "inverse"
"""The key of a simulation that is a function of the user, in `[model]` of a case."""


AT_GEAR = ".gear"
"""The end of the name of the place between motor and link: `elbow.gear`."""
RATE = "_rate"
"""The end of the name of the function of rates."""


class FoundMechanism(NamedTuple):
    """A mechanism that a machine lacks: its name, its place, its parameters (SI), and what it is in a sentence.

    `law` is the text of a function of Python, `name(t, x, v, u, p, s)` with the parameters p and after them what it
    `needs` of the machine (`Term.needs`); empty where the mechanism is no law of one joint. `rate` is that of
    `name_rate(t, x, v, u, p, s, dsdt)`, which writes the rate of its inner state; empty without one.
    """

    mechanism: str
    at: str
    values: Mapping[str, float]
    says: str
    law: str = ""
    needs: tuple[str, ...] = ()
    rate: str = ""


class FoundFiles(NamedTuple):
    """The file of a simulator with what was found, notes on it, and a Python file with what it cannot express.

    The function `apply` of this file adds the forces in each step; without any the text is empty.
    """

    model: str
    notes: tuple[str, ...]
    callback: str = ""


class Simulator(ABC):
    """The user's own simulation of a machine with n joints, each with a position that is measured.

    It is only asked for its inverse dynamics, in batches, along a recorded path. `joints` names the joints, `motions`
    is "rotation" (rad, N m) or "translation" (m, N) of each. `taken` are the values of what `inverse` leaves out, so
    that it can be estimated: "elbow.damping", "elbow.frictionloss", "elbow.armature", "elbow.stiffness" and
    "elbow.rest" (the position at which that spring is relaxed), in SI units; what is not listed is zero. `linear` are
    values on which `inverse` depends linearly, such as "fore.mass"; `changed` returns the simulator with others.
    `points` names places at which a mass may be added: "tip.payload" is then a name that `changed` knows as well, as
    are the names of `inertial`.
    """

    name: ClassVar[str]
    paper: ClassVar[str]

    @property
    @abstractmethod
    def joints(self) -> tuple[str, ...]:
        """The names of the joints, in the order of the columns of all arrays."""

    @property
    def moves(self) -> tuple[str, ...]:
        """The kind of motion of each joint: "rotation" or "translation"."""
        return ("rotation",) * len(self.joints)

    @property
    def taken(self) -> Mapping[str, float]:
        """The values of damping, friction, armature and springs that `inverse` leaves out, by `joint.name`."""
        return {}

    @property
    def linear(self) -> Mapping[str, float]:
        """The values on which `inverse` depends linearly, by `body.name`, in SI units."""
        return {}

    @property
    def inertial(self) -> Mapping[str, float]:
        """The usual sizes of first moments and moments of inertia, which a model knows within its tolerance times them.

        `changed` adds an amount to one of them, on which `inverse` depends linearly: "fore.moment_x" (kg m) moves the
        centre of mass, "fore.inertia_yy" (kg m^2) changes the inertia about it.
        """
        return {}

    @property
    def gains(self) -> Mapping[str, tuple[float, float]]:
        """The stiffness (N m/rad) and damping (N m s/rad) of position controllers that the model has, by joint."""
        return {}

    @property
    def points(self) -> tuple[str, ...]:
        """The places at which a payload may be carried."""
        return ()

    @property
    def step(self) -> float | None:
        """The time step (s) at which the simulator integrates; None where it does not integrate."""
        return None

    @abstractmethod
    def inverse(self, q: Array, v: Array, a: Array) -> Array:
        """Return the joint torques (samples, n) that give accelerations `a` at positions `q` and velocities `v`.

        All arrays are (samples, n), in SI units. The result is M(q) a + c(q, v) + g(q), without what is `taken` out.
        """

    def changed(self, values: Mapping[str, float]) -> Simulator:
        """Return the simulator with other values of `linear`, amounts more of `inertial`, or payloads at `points`."""
        raise NotImplementedError(f"{self.name} has no values that can be changed")

    def roll(self, q: Array, v: Array, torque: Array, dt: float, *, step: float | None = None) -> tuple[Array, Array]:
        """Return positions and velocities (runs, samples, n) from states (runs, n) under torques (runs, samples, n).

        A torque is held for `dt` s, after which the state is returned. The simulator takes its usual steps, but of
        `step` s; without it the motion is exact. Dry friction, contacts and limits are left out. Only a simulator with
        a `step` of its own is asked.
        """
        raise NotImplementedError(f"{self.name} has no motion in time")

    def describe_friction(self, q: Array, forces: Mapping[str, float]) -> tuple[str, ...]:
        """Return sentences on how dry friction (N m or N) of joints at positions q (n,) differs from the exact one."""
        return ()

    def with_found(self, found: Sequence[FoundMechanism], known: Mapping[str, float]) -> Simulator | None:
        """Return the simulator of the file that `write_found` writes, whose `roll` keeps friction; None without one.

        Where a gear was found it has one more joint, whose position is that of the link relative to the motor.
        """
        return None

    def write_found(self, found: Sequence[FoundMechanism], known: Mapping[str, float]) -> FoundFiles | None:
        """Return the file of the simulator with what was found in it, and what it cannot express; None without a file.

        `known` are values that a case states in place of those in the file.
        """
        return None
