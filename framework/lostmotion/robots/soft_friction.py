"""Friction with a soft onset, which joints of robots have: of a lubricated gear, and of a simulator that smooths it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Term
from lostmotion.defaults import DRY_FRICTION
from lostmotion.parts import Array, Param, TermPrior, Values
from lostmotion.quantities import FORCE, SPEED


@dataclass(frozen=True)
class SoftFriction(Term):
    """Friction that rises with the speed up to a constant size; it has no place at which it sticks.

    The force is the mean over one step in which it slows its joint down: v' = -w force tanh(v / velocity) is solved
    exactly, so that a step may be longer than the onset; where this is short, the law is dry friction that stops.
    """

    at: str = ""
    name: ClassVar[str] = "soft_friction"
    extends: ClassVar[tuple[str, ...]] = (DRY_FRICTION,)
    physics: ClassVar[str] = (
        "Friction with a soft onset opposes the motion: it reaches {force}, and three quarters of it at {velocity}"
    )
    formula: ClassVar[str] = "-force * tanh(v/velocity)"
    paper: ClassVar[str] = (
        "Makkar, Dixon, Sawyer, Hu, IEEE/ASME Int. Conf. Advanced Intelligent Mechatronics (2005) 600-605, eq. (1)"
    )
    params = (
        Param("force", "friction at high speed", FORCE, low=0.0, null=0.0),
        Param("velocity", "speed at which it has 76 % of this size", SPEED, low=0.0, scale="log", prior=TermPrior(0.1)),
    )
    needs = ("mobility",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return the mean force of a step; the mobility p[2] is the change of speed by a unit force in it."""
        ratio, lost = abs(v) / p[1], p[0] * p[2] / p[1]
        if abs(lost) < 1e-4:  # the change within the step is less than the digits of a difference
            return -p[0] * math.tanh(v / p[1])
        if ratio == 0.0:
            return 0.0
        # sinh(v / velocity) decays exponentially; its logarithm does not overflow.
        after = ratio + math.log(-math.expm1(-2.0 * ratio)) - math.log(2.0) - lost
        left = after + math.log(2.0) if after > 20.0 else math.asinh(math.exp(after))
        size = (ratio - left) * p[1] / p[2]
        return -size if v > 0.0 else size


SOFT_FRICTION = SoftFriction()
