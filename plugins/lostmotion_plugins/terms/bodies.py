"""Masses that the model lacks: one on a spring of its own, and one that is added or removed during the recording."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Machine, Param, Term, TermPrior, Values
from lostmotion.quantities import FREQUENCY, INERTIA, LENGTH, NUMBER, SPEED, TIME, Dimension


def _is_single_body(at: str, model: Machine) -> bool:
    """Return whether a place belongs to one body; a place between two bodies has no mass of its own."""
    return any(place.name == at and len(place.bodies) == 1 for place in model.places)


@dataclass(frozen=True)
class HiddenMode(Term):
    """A further mass on a spring and a damper of its own: a loose cover, a second mode, a tuned absorber.

    The states are position and velocity of that mass, relative to the same frame as those of the body that carries it.
    """

    at: str = "ground"
    name: ClassVar[str] = "hidden_mode"
    physics: ClassVar[str] = (
        "A further mass of {mass_ratio} of the moving one vibrates on it at {frequency} with {damping} of critical"
        " damping"
    )
    formula: ClassVar[str] = (
        "m_h (w^2 (z - x) + 2 damping w (z' - v)),  z'' = -w^2 (z - x) - 2 damping w (z' - v),"
        "  w = 2 pi frequency,  m_h = mass_ratio * inertia"
    )
    paper: ClassVar[str] = "Den Hartog, Mechanical Vibrations (1956), section 3.3"
    params = (
        Param("mass_ratio", "hidden mass over that of the body", NUMBER, low=0.0, null=0.0, prior=TermPrior(0.1)),
        Param(
            "frequency",
            "frequency of the hidden mass on the body held still",
            FREQUENCY,
            low=0.0,
            scale="log",
            prior=TermPrior(0.5 / math.pi, scan=(0.1, 10.0)),
        ),
        Param("damping", "damping ratio of the hidden mass", NUMBER, low=0.0, scale="log", prior=TermPrior(0.03)),
    )
    states: ClassVar[Mapping[str, Dimension]] = {"hidden_place": LENGTH, "hidden_speed": SPEED}
    needs = ("inertia", "shake_input")

    def fits(self, model: Machine) -> bool:
        """Return whether the term can act in `model`: at a body, and not between two."""
        return _is_single_body(self.at, model) and super().fits(model)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        w = 2.0 * math.pi * p[1]
        return p[0] * p[3] * w * (w * (s[0] - x) + 2.0 * p[2] * (s[1] - v))

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        w = 2.0 * math.pi * p[1]
        shake = u[int(p[4])] if p[4] >= 0.0 else 0.0
        dsdt[0] = s[1]
        dsdt[1] = -w * (w * (s[0] - x) + 2.0 * p[2] * (s[1] - v)) - shake


@dataclass(frozen=True)
class InertiaChange(Term):
    """A mass that is added or removed at some time: a load is picked up, or a part comes off.

    The force is the one that turns the acceleration a by all other forces into that of the changed mass.
    """

    at: str = "ground"
    name: ClassVar[str] = "inertia_change"
    physics: ClassVar[str] = "The moving mass changes by {change} at {time}"
    formula: ClassVar[str] = "-change * m / (m + change) * a from `time` on, a the acceleration by all other forces"
    paper: ClassVar[str] = "Isermann, Fault-Diagnosis Systems (2006), section 5.1: additive and multiplicative faults"
    params = (
        Param("change", "change of the moving mass", INERTIA, null=0.0, prior=TermPrior(0.2)),
        Param(
            "time", "when it changes", TIME, low=0.0, scale="log", prior=TermPrior(0.35, lasting=True, scan=(0.05, 2.8))
        ),
    )
    needs = ("inertia", "acceleration", "shake_input")

    def fits(self, model: Machine) -> bool:
        """Return whether the term can act in `model`: at a body, and not between two."""
        return _is_single_body(self.at, model) and super().fits(model)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        if t < p[1]:
            return 0.0
        shake = u[int(p[4])] if p[4] >= 0.0 else 0.0
        changed = max(p[2] + p[0], 0.1 * p[2])
        return (p[2] / changed - 1.0) * p[2] * (p[3] + shake)
