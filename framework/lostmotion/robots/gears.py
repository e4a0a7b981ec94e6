"""What lies between the motor and the link of a joint: play, the flexibility of a gear, and hysteresis in it.

Each splits a joint in two: the motor with its armature, and the link. The encoder and the torque are those of the
motor (Spong, J. Dynamic Systems, Measurement, and Control 109 (1987) 310-319; Nordin, Gutman, Automatica 38 (2002)).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from lostmotion.defaults import HYSTERETIC, PLAY

USUAL_DAMPING = 0.05
"""Usual damping ratio of the motor on the stiffness of its gear."""


@dataclass(frozen=True)
class Gear:
    """A gear: half of its `play` (rad or m), its `stiffness` (N m/rad or N/m), and the damping ratio of the motor."""

    play: float
    stiffness: float
    damping: float = USUAL_DAMPING

    def damp(self, inertia: float) -> float:
        """Return the damping (N m s/rad) in contact for a motor of this inertia (kg m^2)."""
        return 2.0 * self.damping * math.sqrt(self.stiffness * inertia)


class GearLaw(NamedTuple):
    """A mechanism between motor and link: its name, its parameters, and a sentence with these in braces."""

    name: str
    params: tuple[str, ...]
    physics: str
    paper: str

    def make(self, values: tuple[float, ...]) -> Gear:
        """Return the gear for values of `params`."""
        told = dict(zip(self.params, values, strict=True))
        return Gear(told.get("gap", 0.0), told["stiffness"], told["damping_ratio"])


BACKLASH = GearLaw(
    PLAY,
    ("gap", "stiffness", "damping_ratio"),
    "The gear has play: motor and link are free over {gap} to either side, then meet with a stiffness of {stiffness}",
    "Nordin, Gutman, Automatica 38 (2002) 1633-1649, section 2.1",
)
ELASTICITY = GearLaw(
    "joint_elasticity",
    ("stiffness", "damping_ratio"),
    "The gear is flexible: motor and link are joined by a stiffness of {stiffness}",
    "Spong, J. Dynamic Systems, Measurement, and Control 109 (1987) 310-319",
)
HYSTERESIS = GearLaw(
    HYSTERETIC,
    ("stiffness", "damping_ratio", "force", "travel"),
    "The gear is flexible, with a stiffness of {stiffness}, and a hysteretic torque in it yields at {force} after"
    " {travel} of travel",
    "Ruderman, Bertram, Iwasaki, Mechatronics 24 (2014) 407-415",
)
"""A flexible gear beside a law of the library with an inner state, which acts on the motion of motor against link."""
GEARS = (BACKLASH, ELASTICITY)
