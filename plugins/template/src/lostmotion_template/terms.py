"""A piece of physics that a model may lack, with a state of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import STIFFNESS, TIME


@dataclass(frozen=True)
class MaxwellElement(Term):
    """A spring and a dashpot in series, such as a rubber bush or a belt that creeps: its force decays at rest.

    The state is the force in the element. The element has no effect where its stiffness is 0, whatever the relaxation
    time. It needs the step, so that an element that relaxes faster than one step does not make the integration
    unstable.
    """

    at: str = "ground"
    name: ClassVar[str] = "maxwell_element"
    physics: ClassVar[str] = (
        "A creeping spring of {stiffness} with a relaxation time of {relaxation} opposes the motion"
    )
    formula: ClassVar[str] = "-f,  f' = stiffness * v - f / relaxation"
    paper: ClassVar[str] = "Maxwell, Philosophical Transactions of the Royal Society 157 (1867) 49-88"
    params = (
        Param("stiffness", "stiffness against fast motion", STIFFNESS, low=0.0, null=0.0),
        Param("relaxation", "relaxation time of the force", TIME, low=0.0, scale="log"),
    )
    states = ("element_force",)
    needs = ("step",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -s[0]

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        dsdt[0] = p[0] * v - s[0] / max(p[1], p[2])
