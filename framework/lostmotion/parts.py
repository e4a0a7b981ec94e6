"""The parts of models and terms: parameters, places at which forces act, and dimensionless numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.quantities import Dimension

Array = NDArray[np.float64]
Input = Callable[[Array, int], Array]
"""A recorded input: its value (order 0) or its first derivative (order 1) at times (s) of any shape."""
Values = tuple[float, ...]
"""The parameters or states that a term receives: numbers to be read by index; they cannot be assigned."""
Drive = tuple[float, float, float]
"""A harmonic drive: amplitude (SI), angular frequency omega (rad/s) and phase (rad)."""
Motion = Literal["translation", "rotation"]
PSEUDO_NEEDS = (
    "step", "finest", "mobility", "inertia", "omega", "amplitude", "stiffness", "play", "contact", "acceleration",
    "force_input", "shake_input", "angle",
)  # fmt: skip
"""Names that `Term.needs` may list although they are no parameters of the model.

- `step`: the length (s) of the present integration step, which may change from step to step; `finest`: the shortest.
- `mobility`: step / inertia, the velocity that a unit force gives the body in one step. A law that jumps at zero
  velocity is written as a steep line of width `force * mobility`: it sticks, and the integration does not become stiff.
- `inertia`: the mass or moment of inertia that a force at the place moves.
- `omega`: the angular frequency of the drive (rad/s); `amplitude`: sqrt(2) times the rms of the drive.
- `stiffness`, `play`: those of the spring at the place; `contact`: the stiffness of a contact with play there, else 0.
- `acceleration`: the acceleration that all other forces give the body at the place.
- `force_input`, `shake_input`: the index in `u` of the force on that body and of the base acceleration, -1 if none.
- `angle`: the number of radians in the unit of the position, which is 1. Only a rotation has it: the law takes the
  position as an angle.
"""


@dataclass(frozen=True)
class TermPrior:
    """What is known of a parameter of a term before any recording, and the values at which a search tries it.

    `typical` is the width of the prior in natural scales (drive force, rms position and velocity; time of the whole
    recording if `lasting`). `scan` is the smallest and largest multiple of `typical` between which a recording is
    searched for the number, for an amplitude too if the response is far from linear in it; a level of the drive is
    searched up to its largest recorded value at least. `choices` are values that are tried in turn and not fitted,
    `words` what a sentence says in place of each of them; with `scale="log"` a spectrum may find another value, which
    is then fitted. Example: `TermPrior(0.3, scan=(0.1, 10.0))`.
    """

    typical: float = 1.0
    lasting: bool = False
    scan: tuple[float, float] | None = None
    choices: tuple[float, ...] = ()
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class Param:
    """A number that may be known or estimated. `low` and `high` are physical bounds (SI), not a prior.

    With `scale="log"` the number is positive and known by its order of magnitude. Of a term: `null` marks an amplitude,
    and is the value at which the whole term has no effect. With a finite `high` the law is complete there, as a drive
    that saturates, and half of its prior is at that value. Example:
    `Param("coefficient", "viscous damping", DAMPING, low=0.0, null=0.0)`.
    """

    name: str
    meaning: str
    dimension: Dimension
    low: float = -math.inf
    high: float = math.inf
    scale: Literal["linear", "log"] = "linear"
    null: float | None = None
    prior: TermPrior = TermPrior()

    def unit(self, motion: str) -> str:
        """Return the SI unit in translation or in rotation."""
        return self.dimension.unit(motion)


@dataclass(frozen=True)
class Place:
    """A place where a force can act: `motion(y, u)` returns the relative position and velocity there (SI units).

    `y` holds the states and `u` the inputs. `holds` names parameters of the machine that belong to the place, such as
    the gap, and `stiffness` and `play` those of its contact: terms that need them act nowhere else. A `relative` place
    is between two bodies that have places of their own.
    Example: `Place("elbow", motion=lambda y, u: (y[1], y[3]))`.
    """

    name: str
    motion: Callable[..., tuple[float, float]]
    holds: tuple[str, ...] = ()
    stiffness: str | None = None
    play: str | None = None
    relative: bool = False

    @property
    def bodies(self) -> tuple[str | int, ...]:
        """What a force at the place moves; places with the same bodies differ only in their motion."""
        return (self.name,)

    def move(self, states: Array, inputs: Array, lever: Values = ()) -> Array:
        """Return relative position and velocity (2, rows) at `states` (rows, n) and `inputs` (rows, inputs).

        `lever` is the value of the lever of the place, if it has one.
        """
        try:  # most motions are sums, which work on whole columns
            found = np.array(self.motion(states.T, inputs.T, *lever), dtype=float)
            if found.shape == (2, len(states)):
                return found
        except (TypeError, ValueError):
            pass
        rows = zip(states, inputs, strict=True)
        return np.array([self.motion(y, u, *lever) for y, u in rows], dtype=float).reshape(-1, 2).T


@dataclass(frozen=True)
class Interface(Place):
    """A place of a model that is written as equations: the force over the parameter `inertia` is added to `dydt[row]`.

    `against` is row and inertia of a second body, which feels the opposite force, times the parameter `lever` where
    there is one (a gear ratio); `motion(y, u, lever)` then takes its value too.
    Example: `Interface("ground", row=1, inertia="m", motion=lambda y, u: (y[0], y[1]))`.
    """

    row: int = field(kw_only=True)
    inertia: str = field(kw_only=True)
    against: tuple[int, str] | None = field(default=None, kw_only=True)
    lever: str | None = field(default=None, kw_only=True)

    @property
    def bodies(self) -> tuple[str | int, ...]:
        """The rows of the bodies that a force at the place moves."""
        return (self.row, *(self.against or ())[:1])


class Group(NamedTuple):
    """A dimensionless number of a model: setting it sets the parameter `target` to `law(values, number)`.

    `target` may also be "drive.amplitude". `values` holds the parameters in SI units, and "drive.omega" (rad/s).
    Example: `Group("zeta", "damping ratio", "c / (2 sqrt(k m))", "c", lambda v, z: 2.0 * z * (v["k"] * v["m"]) ** 0.5)`
    """

    name: str
    meaning: str
    formula: str
    target: str
    law: Callable[[Mapping[str, float], float], float]
