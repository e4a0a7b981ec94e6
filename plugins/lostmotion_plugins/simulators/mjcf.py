"""Findings written back into an MJCF file: damping, friction, springs, masses, delays and gears as MuJoCo has them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from lostmotion.defaults import HYSTERETIC
from lostmotion.errors import ContractError
from lostmotion.simulators import AT_GEAR, FoundFiles, FoundMechanism
from lostmotion_plugins.simulators.callback import write_callback

FINE = 5e-4
"""The longest step (s) at which stiff friction and limits hold."""
STIFF = (2.0 * FINE, 1.0)
"""Time constant (s) and damping ratio of friction and limits: MuJoCo takes two steps for the shortest time constant."""
MARK = "found by lostmotion"
GEAR = "_gear"
"""The end of the name of a joint between motor and link."""


def write_findings(mujoco: Any, spec: Any, found: Sequence[FoundMechanism], known: Mapping[str, float]) -> FoundFiles:
    """Return the changed MJCF, notes on what was changed, and a callback with the laws that MJCF cannot express.

    `spec` is an `MjSpec` of the file; `known` are values of joints and bodies that a case states in place of its own.
    """
    writer = _Writer(mujoco, spec)
    for name, value in known.items():
        writer.set_value(name, value)
    for one in found:
        writer.apply(one)
    try:
        spec.compile()
    except ValueError as err:
        raise ContractError(f"the changed model cannot be compiled by MuJoCo ({' '.join(str(err).split())})") from err
    notes = "\n".join(f"  {MARK}: {note}" for note in writer.notes).replace("--", "- -")
    text = str(spec.to_xml())
    told = text.replace("\n", f"\n<!--\n{notes}\n-->\n", 1) if notes else text
    return FoundFiles(told, tuple(writer.notes), write_callback(writer.called))


class _Writer:
    """Changes of a spec, with a note on each."""

    def __init__(self, mujoco: Any, spec: Any) -> None:
        self.mujoco, self.spec = mujoco, spec
        self.notes: list[str] = []
        self.called: list[FoundMechanism] = []

    def set_value(self, name: str, value: float) -> None:
        """Set a value of a joint or a body, such as `elbow.damping`."""
        owner, kind = name.rsplit(".", 1)
        if kind == "mass":
            self._scale_body(owner, value)
        elif kind in ("damping", "stiffness"):
            _set_first(self.spec.joint(owner), kind, value)
        elif kind in ("armature", "frictionloss"):
            setattr(self.spec.joint(owner), kind, value)
        self.notes.append(f"{name} = {value:.6g}, as the case states.")

    def apply(self, one: FoundMechanism) -> None:
        """Change the spec by one finding, or note that MJCF cannot express it."""
        within = one.at.endswith(AT_GEAR) and one.mechanism == HYSTERETIC
        change = self._add_hysteretic_gear if within else getattr(self, f"_add_{one.mechanism}", None)
        if change is None and one.law and self.spec.joint(one.at) is not None:
            self.called.append(one)
            self._refine()
            self.notes.append(f"in arm_found.py, because MJCF has no such law: {one.says}")
            return
        if change is None:
            self.notes.append(f"not written, because MJCF has no such law: {one.says}")
            return
        change(one)
        self.notes.append(one.says)

    def _refine(self) -> None:
        if self.spec.option.timestep > FINE:
            self.spec.option.timestep = FINE
            self.notes.append(
                f"the step is {1e3 * FINE:g} ms now: with a longer one friction, limits and callbacks are soft."
            )

    def _add_viscous_damping(self, one: FoundMechanism) -> None:
        joint = self.spec.joint(one.at)
        _set_first(joint, "damping", _get_first(joint.damping) + one.values["coefficient"])

    def _add_coulomb_friction(self, one: FoundMechanism) -> None:
        joint = self.spec.joint(one.at)
        joint.frictionloss = joint.frictionloss + one.values["force"]
        joint.solref_friction = STIFF
        self._refine()

    def _add_stribeck_friction(self, one: FoundMechanism) -> None:
        self._add_coulomb_friction(one)
        self.notes.append("MJCF has no friction that rises towards rest: only its sliding level is written.")

    def _add_linear_stiffness(self, one: FoundMechanism) -> None:
        joint, more = self.spec.joint(one.at), one.values["coefficient"]
        own = _get_first(joint.stiffness)
        if own + more != 0.0:
            joint.springref = own * joint.springref / (own + more)
        _set_first(joint, "stiffness", own + more)

    def _add_inertia_change(self, one: FoundMechanism) -> None:
        joint = self.spec.joint(one.at)
        if joint is not None:
            joint.armature = joint.armature + one.values["change"]
        else:
            self._scale_body(one.at, float(self.spec.body(one.at).mass) + one.values["change"])

    def _scale_body(self, name: str, mass: float) -> None:
        body = self.spec.body(name)
        share = mass / float(body.mass)
        body.mass, body.inertia = mass, np.array(body.inertia) * share
        if np.isfinite(body.fullinertia).all():
            body.fullinertia = np.array(body.fullinertia) * share

    def _add_payload(self, one: FoundMechanism) -> None:
        site = self.spec.site(one.at)
        parent, place = (site.parent, site.pos) if site is not None else (self.spec.body(one.at), [0.0, 0.0, 0.0])
        parent.add_body(
            name=f"{one.at}_payload", pos=place, mass=one.values["mass"], inertia=[1e-9] * 3, ipos=[0.0, 0.0, 0.0],
            explicitinertial=True,
        )  # fmt: skip

    def _list_actuators(self, joint: str) -> list[Any]:
        found = [one for one in self.spec.actuators if one.target == joint]
        if not found:
            self.notes.append(f"the file has no actuator at {joint}: the next line is not written.")
        return found

    def _add_excitation_delay(self, one: FoundMechanism) -> None:
        delay = one.values["delay"]
        for actuator in self._list_actuators(one.at.removesuffix(".torque")):
            actuator.delay = delay
            actuator.nsample = math.ceil(delay / self.spec.option.timestep) + 1

    def _add_excitation_gain(self, one: FoundMechanism) -> None:
        for actuator in self._list_actuators(one.at.removesuffix(".torque")):
            actuator.gear = np.array(actuator.gear) * (1.0 + one.values["error"])

    def _add_gear(self, one: FoundMechanism) -> Any:
        """Return a second joint between motor and link, with the axis of the first one."""
        motor = self.spec.joint(one.at.removesuffix(AT_GEAR))
        self._refine()
        return motor.parent.add_joint(
            name=f"{motor.name}{GEAR}", type=motor.type, axis=motor.axis, pos=motor.pos, armature=0.0
        )

    def _add_joint_elasticity(self, one: FoundMechanism) -> Any:
        motor, gear = self.spec.joint(one.at.removesuffix(AT_GEAR)), self._add_gear(one)
        _set_first(gear, "stiffness", one.values["stiffness"])
        loss = 2.0 * one.values["damping_ratio"] * math.sqrt(one.values["stiffness"] * motor.armature)
        _set_first(gear, "damping", loss)
        return gear

    def _add_hysteretic_gear(self, one: FoundMechanism) -> None:
        gear = self._add_joint_elasticity(one)
        gear.frictionloss, gear.solref_friction = one.values["force"], STIFF
        self.notes.append("MJCF has no hysteresis: dry friction in the gear of the same force takes its place.")

    def _add_backlash(self, one: FoundMechanism) -> None:
        gear = self._add_gear(one)
        gear.limited, gear.range = self.mujoco.mjtLimited.mjLIMITED_TRUE, (-one.values["gap"], one.values["gap"])
        gear.solref_limit = STIFF


def _get_first(value: Any) -> float:
    """Return a coefficient that newer versions of MuJoCo hold as the first of a polynomial."""
    return float(np.ravel(value)[0])


def _set_first(joint: Any, kind: str, value: float) -> None:
    own = getattr(joint, kind)
    if np.ndim(own) == 0:
        setattr(joint, kind, value)
    else:
        changed = np.array(own)
        changed[0] = value
        setattr(joint, kind, changed)
