"""Contacts that close only beyond some travel: play in a spring that the model has without play, and an end stop."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Machine, Param, Term, TermPrior, Values
from lostmotion.quantities import LENGTH, NUMBER, STIFFNESS

_SIDES = ("at both ends", "on the positive side", "on the negative side")


@dataclass(frozen=True)
class Backlash(Term):
    """Play in a spring that has none in the model: the spring acts only beyond a gap.

    Where the model has a gap of its own, that one is estimated, and this term does not act.
    """

    at: str = "ground"
    name: ClassVar[str] = "backlash"
    physics: ClassVar[str] = "The spring has play: it acts only beyond {gap} to either side"
    formula: ClassVar[str] = "k * clip(x, -gap, gap), which leaves -k * (x - clip(x, -gap, gap)) of the spring -k * x"
    paper: ClassVar[str] = "Nordin, Gutman, Automatica 38 (2002) 1633-1649, section 2.1"
    params = (Param("gap", "half of the play", LENGTH, low=0.0, null=0.0, prior=TermPrior(0.5, scan=(0.02, 4.0))),)
    needs = ("stiffness",)

    def fits(self, model: Machine) -> bool:
        """Return whether the term can act in `model`: its place has a spring without play."""
        tight = any(place.name == self.at and place.play is None for place in model.places)
        return tight and super().fits(model)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return p[1] * min(max(x, -p[0]), p[0])


@dataclass(frozen=True)
class EndStop(Term):
    """A stiff contact beyond a travel, at both ends or at one of them; it is tried from a third of the amplitude on."""

    at: str = "ground"
    name: ClassVar[str] = "end_stop"
    physics: ClassVar[str] = "Beyond {travel} an end stop of {stiffness} is hit {side}"
    formula: ClassVar[str] = "-stiffness * (|x| - travel) * sign(x) where |x| > travel, on one side or both"
    paper: ClassVar[str] = "Shaw, Holmes, J. Sound and Vibration 90 (1983) 129-155, eq. (1)"
    params = (
        Param("stiffness", "stiffness of the stop", STIFFNESS, low=0.0, null=0.0, prior=TermPrior(100.0)),
        Param("travel", "travel to the stop", LENGTH, low=0.0, scale="log", prior=TermPrior(1.0, scan=(0.3, 3.0))),
        Param(
            "side",
            "0 for both ends, 1 or -1 for one of them",
            NUMBER,
            prior=TermPrior(choices=(0.0, 1.0, -1.0), words=_SIDES),
        ),
    )

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        if x > p[1] and p[2] > -0.5:
            return -p[0] * (x - p[1])
        if x < -p[1] and p[2] < 0.5:
            return -p[0] * (x + p[1])
        return 0.0
