"""Dry friction whose level depends on something: the direction, the load, the time since the start, the way."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Machine, Param, Term, TermPrior, Values
from lostmotion.quantities import FORCE, LENGTH, NUMBER, TIME
from lostmotion_plugins.laws import resist_sliding, subtract_gap
from lostmotion_plugins.terms.friction import NEGLIGIBLE_SHARE

OFFSET_SHARE = 0.25
"""Two levels that differ by less than this share of their sum are reported as one level and a constant force.

The forces are the same at any speed and at rest, and an offset of the drive or of the sensor occurs on every rig."""
SLOWER = Param("slower", "longer time constant", TIME)


@dataclass(frozen=True)
class DirectionalFriction(Term):
    """Two levels of dry friction: one for motion in positive direction, one for motion in negative direction."""

    at: str = "ground"
    name: ClassVar[str] = "directional_friction"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = (
        "Dry friction opposes the motion: {forward} in positive direction, {backward} in negative direction"
    )
    formula: ClassVar[str] = "-forward where v > 0, +backward where v < 0"
    paper: ClassVar[str] = "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138, section 2.1"
    params = (
        Param("forward", "friction in positive direction", FORCE, low=0.0, null=0.0),
        Param("backward", "friction in negative direction", FORCE, low=0.0, null=0.0),
    )
    needs = ("mobility",)

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return Coulomb friction and a constant force, which act in the same way, where the levels differ little."""
        total, difference = values["forward"] + values["backward"], values["forward"] - values["backward"]
        if not abs(difference) < OFFSET_SHARE * total:
            return {}
        return {"coulomb_friction": {"force": 0.5 * total}, "offset_force": {"force": -0.5 * difference}}

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        width = max(p[0], p[1]) * p[2]
        if abs(v) >= width:
            return -p[0] if v > 0.0 else (p[1] if v < 0.0 else 0.0)
        return -0.5 * (p[0] - p[1]) - 0.5 * (p[0] + p[1]) * v / width


@dataclass(frozen=True)
class LoadDependentFriction(Term):
    """Dry friction that is proportional to a load.

    Where the place has a contact with play, the load is the contact force; elsewhere it is the force that drives the
    body.
    """

    at: str = "ground"
    name: ClassVar[str] = "load_dependent_friction"
    physics: ClassVar[str] = "Dry friction of {coefficient} times the load opposes the motion"
    formula: ClassVar[str] = "-coefficient * |load| * sign(v), the load that of a contact with play, else the drive"
    paper: ClassVar[str] = "Hamon, Gautier, Garrec, IEEE/RSJ Int. Conf. Intelligent Robots and Systems (2010) 1609-1614"
    params = (Param("coefficient", "friction over the load", NUMBER, low=0.0, null=0.0, prior=TermPrior(0.1)),)
    needs = ("contact", "play", "force_input", "mobility")

    def fits(self, model: Machine) -> bool:
        """Return whether the term can act in `model`: the place has a contact with play, or the model a force input."""
        contact = any(place.name == self.at and place.play for place in model.places)
        return (contact or "force" in model.inputs) and super().fits(model)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        pushed: float = u[int(p[3])] if p[3] >= 0.0 else 0.0
        pressed = p[1] * subtract_gap(x, p[2])
        level: float = p[0] * abs(pressed if p[1] > 0.0 else pushed)
        return resist_sliding(v, level, level * p[4])


@dataclass(frozen=True)
class FrictionDrift(Term):
    """Dry friction that changes while the machine runs, because it warms up or loses its lubricant."""

    at: str = "ground"
    name: ClassVar[str] = "friction_drift"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = (
        "Dry friction opposes the motion: {force} at the start, and {change} more in the long run, with a time constant"
        " of {time}"
    )
    formula: ClassVar[str] = "-max(force + change * (1 - exp(-t/time)), 0) * sign(v)"
    paper: ClassVar[str] = "Simoni, Beschi, Legnani, Visioli, IEEE/RSJ Int. Conf. Intelligent Robots (2015) 3524-3529"
    params = (
        Param("force", "friction at the start", FORCE, low=0.0, null=0.0),
        Param("change", "change of the friction in the long run", FORCE, null=0.0, prior=TermPrior(0.5)),
        Param(
            "time",
            "time in which it changes by 63 %",
            TIME,
            low=0.0,
            scale="log",
            prior=TermPrior(0.3, lasting=True, scan=(0.1, 10.0)),
        ),
    )
    needs = ("mobility",)

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return Coulomb friction of the level at the start where the change is negligible."""
        level = values["force"]
        return {"coulomb_friction": {"force": level}} if abs(values["change"]) < NEGLIGIBLE_SHARE * level else {}

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        level = max(p[0] + p[1] * (1.0 - math.exp(-t / p[2])), 0.0)
        return resist_sliding(v, level, level * p[3])


@dataclass(frozen=True)
class FrictionDriftTravel(Term):
    """Dry friction that changes with the distance travelled, because surfaces run in or wear; the distance is a state.

    Under a steady motion it resembles a change over time; it rests where the machine rests.
    """

    at: str = "ground"
    name: ClassVar[str] = "friction_drift_travel"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = (
        "Dry friction opposes the motion: {force} at the start, and {change} more after a long way, with a distance of"
        " {distance}"
    )
    formula: ClassVar[str] = "-max(force + change * (1 - exp(-s/distance)), 0) * sign(v),  s' = |v|"
    paper: ClassVar[str] = "Blau, Tribology International 38 (2005) 1007-1012: running-in"
    params = (
        Param("force", "friction at the start", FORCE, low=0.0, null=0.0),
        Param("change", "change of the friction after a long way", FORCE, null=0.0, prior=TermPrior(0.5)),
        Param(
            "distance",
            "way in which it changes by 63 %",
            LENGTH,
            low=0.0,
            scale="log",
            prior=TermPrior(100.0, scan=(0.03, 10.0)),
        ),
    )
    states = ("travelled",)
    needs = ("mobility",)
    commoner = FrictionDrift.commoner

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        level = max(p[0] + p[1] * (1.0 - math.exp(-s[0] / p[2])), 0.0)
        return resist_sliding(v, level, level * p[3])

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        dsdt[0] = abs(v)


@dataclass(frozen=True)
class FrictionDriftTwice(Term):
    """Dry friction that changes over two times: that of the lubricant in the contact, and that of the whole machine."""

    at: str = "ground"
    name: ClassVar[str] = "friction_drift_twice"
    extends: ClassVar[tuple[str, ...]] = ("friction_drift", "coulomb_friction")
    physics: ClassVar[str] = (
        "Dry friction opposes the motion: {force} at the start, {change} more with a time constant of {time}, and"
        " {later} more with one {ratio} times as long"
    )
    formula: ClassVar[str] = (
        "-max(force + change * (1 - exp(-t/time)) + later * (1 - exp(-t/slower)), 0) * sign(v), slower = ratio * time"
    )
    paper: ClassVar[str] = "Simoni, Beschi, Legnani, Visioli, IEEE/RSJ Int. Conf. Intelligent Robots (2015) 3524-3529"
    params = (
        Param("force", "friction at the start", FORCE, low=0.0, null=0.0),
        Param("change", "change with the shorter time", FORCE, null=0.0, prior=TermPrior(0.5)),
        Param("later", "change with the longer time", FORCE, null=0.0, prior=TermPrior(0.5)),
        Param("time", "shorter time constant", TIME, low=0.0, scale="log", prior=TermPrior(0.06, lasting=True)),
        Param(
            "ratio",
            "the longer one over the shorter",
            NUMBER,
            low=1.0,
            scale="log",
            prior=TermPrior(10.0, scan=(0.11, 10.0)),
        ),
    )
    needs = ("mobility",)

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return a change over one time where the other is negligible, or Coulomb friction where both are."""
        force, first, second = values["force"], values["change"], values["later"]
        small = NEGLIGIBLE_SHARE * (force + abs(first) + abs(second))
        if abs(first) < small and abs(second) < small:
            return {"coulomb_friction": {"force": force}}
        if abs(second) < small:
            return {"friction_drift": {"force": force, "change": first, "time": values["time"]}}
        if abs(first) < small:
            return {"friction_drift": {"force": force, "change": second, "time": values["time"] * values["ratio"]}}
        return {}

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        changed = p[1] * (1.0 - math.exp(-t / p[3])) + p[2] * (1.0 - math.exp(-t / (p[3] * p[4])))
        level = max(p[0] + changed, 0.0)
        return resist_sliding(v, level, level * p[5])

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        return {SLOWER: p[3] * p[4]}
