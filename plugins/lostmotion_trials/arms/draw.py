"""Arms with one hidden effect, or none, as case files with a log and a model in MJCF."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lostmotion_trials.integrators.arm import Arm, Log, record_motion

JOINTS = ("shoulder", "elbow")
_MJCF = """<mujoco model="arm">
  <compiler angle="radian"/>
  <option timestep="0.002" gravity="0 0 -9.81"/>
  <worldbody>
    <body name="upper">
      <joint name="shoulder" axis="0 -1 0" armature="{armature[0]!r}" damping="{damping[0]!r}"/>
      <inertial pos="{centre[0]!r} 0 0" mass="{mass[0]!r}" diaginertia="{spin[0]}"/>
      <body name="fore" pos="{length!r} 0 0">
        <joint name="elbow" axis="0 -1 0" armature="{armature[1]!r}" damping="{damping[1]!r}"/>
        <inertial pos="{centre[1]!r} 0 0" mass="{mass[1]!r}" diaginertia="{spin[1]}"/>
        <site name="tip" pos="{reach!r} 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
_CASE = """title = "Arm {number}"
[[recordings]]
file = "log.csv"
time = "t"
inputs = [
  {{ input = "shoulder.torque", column = "tau_shoulder", unit = "N m" }},
  {{ input = "elbow.torque", column = "tau_elbow", unit = "N m" }},
]
sensors = [
  {{ channel = "shoulder", column = "q_shoulder", unit = "rad" }},
  {{ channel = "elbow", column = "q_elbow", unit = "rad" }},
]
[model]
mujoco = "arm.xml"
joints = ["shoulder", "elbow"]
torque = "motor"
tolerance = {known}
"""


@dataclass(frozen=True)
class Truth:
    """What is hidden: a mechanism at a place with its values (SI); "none" where nothing is."""

    mechanism: str
    at: str
    values: Mapping[str, float]


def _size(rng: np.random.Generator, usual: float) -> float:
    """Return a size between a third of the usual one and twice that."""
    return float(usual * math.exp(rng.uniform(math.log(0.33), math.log(2.0))))


def _hide_coulomb(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.friction[j] = _size(rng, (0.8, 0.3)[j])
    return Truth("coulomb_friction", JOINTS[j], {"force": float(arm.friction[j])})


def _hide_stribeck(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.friction[j] = _size(rng, (0.8, 0.3)[j])
    arm.excess[j] = arm.friction[j] * rng.uniform(0.5, 1.0)
    arm.stribeck[j] = rng.uniform(0.05, 0.2)
    values = {"force": float(arm.friction[j]), "excess": float(arm.excess[j]), "velocity": float(arm.stribeck[j])}
    return Truth("stribeck_friction", JOINTS[j], values)


def _hide_directional(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.friction[j] = _size(rng, (0.8, 0.3)[j])
    arm.backward[j] = arm.friction[j] * rng.uniform(0.3, 0.6)
    values = {"forward": float(arm.friction[j]), "backward": float(arm.backward[j])}
    return Truth("directional_friction", JOINTS[j], values)


def _hide_soft(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.friction[j], arm.onset[j] = _size(rng, (0.8, 0.3)[j]), rng.uniform(0.03, 0.15)
    return Truth("soft_friction", JOINTS[j], {"force": float(arm.friction[j]), "velocity": float(arm.onset[j])})


def _hide_dahl(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.bristles[j], arm.travel[j] = _size(rng, (0.8, 0.3)[j]), _size(rng, 5e-3)
    values = {"force": float(arm.bristles[j]), "deflection": float(arm.travel[j])}
    return Truth("dahl_friction", JOINTS[j], values)


def _hide_viscous(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    more = _size(rng, (0.4, 0.2)[j])
    arm.damping[j] += more
    return Truth("viscous_damping", JOINTS[j], {"coefficient": more})


def _hide_ripple(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.ripple[j], arm.order[j] = _size(rng, (0.4, 0.15)[j]), rng.uniform(40.0, 110.0)
    arm.phase[j] = rng.uniform(0.0, 2.0 * math.pi)
    return Truth("cogging", JOINTS[j], {"force": float(arm.ripple[j]), "pitch": 2.0 * math.pi / float(arm.order[j])})


def _hide_spring(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.spring[j] = _size(rng, (1.0, 0.5)[j])
    return Truth("linear_stiffness", JOINTS[j], {"coefficient": float(arm.spring[j])})


def _hide_offset(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.offset[j] = _size(rng, (0.8, 0.3)[j]) * rng.choice([-1.0, 1.0])
    return Truth("offset_force", JOINTS[j], {"force": float(arm.offset[j])})


def _hide_play(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.play[j], arm.stiffness[j], arm.loss[j] = _size(rng, 1e-3), _size(rng, (6e4, 2e4)[j]), (30.0, 10.0)[j]
    return Truth("backlash", f"{JOINTS[j]}.gear", {"gap": float(arm.play[j])})


def _hide_flexible(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.play[j], arm.stiffness[j], arm.loss[j] = 0.0, _size(rng, (3e3, 1e3)[j]), (6.0, 2.0)[j]
    return Truth("joint_elasticity", f"{JOINTS[j]}.gear", {"stiffness": float(arm.stiffness[j])})


def _hide_loop(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    _hide_flexible(arm, j, rng)
    arm.bristles[j], arm.travel[j], arm.within[j] = _size(rng, (3.0, 1.0)[j]), _size(rng, 3e-3), 1.0
    values = {"force": float(arm.bristles[j]), "travel": float(arm.travel[j]), "stiffness": float(arm.stiffness[j])}
    return Truth("bouc_wen_hysteresis", f"{JOINTS[j]}.gear", values)


def _hide_delay(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.delay[j] = _size(rng, 0.004)
    return Truth("excitation_delay", f"{JOINTS[j]}.torque", {"delay": float(arm.delay[j])})


def _hide_payload(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.payload = _size(rng, 0.15)
    return Truth("payload", "tip", {"mass": arm.payload})


def _hide_gain(arm: Arm, j: int, rng: np.random.Generator) -> Truth:
    arm.gain[j] = 1.0 + float(rng.choice([-1.0, 1.0])) * _size(rng, 0.08)
    return Truth("excitation_gain", f"{JOINTS[j]}.torque", {"error": float(arm.gain[j] - 1.0)})


EFFECTS: Mapping[str, Callable[[Arm, int, np.random.Generator], Truth]] = {
    "coulomb_friction": _hide_coulomb, "stribeck_friction": _hide_stribeck, "viscous_damping": _hide_viscous,
    "cogging": _hide_ripple, "backlash": _hide_play, "joint_elasticity": _hide_flexible,
    "excitation_delay": _hide_delay, "payload": _hide_payload, "directional_friction": _hide_directional,
    "linear_stiffness": _hide_spring, "offset_force": _hide_offset, "excitation_gain": _hide_gain,
    "soft_friction": _hide_soft, "dahl_friction": _hide_dahl, "bouc_wen_hysteresis": _hide_loop,
}  # fmt: skip
"""What may be hidden."""


def draw_arm(number: int, seed: int, effect: str, wrong: float = 0.0, samples: int = 5000) -> tuple[Arm, Truth, Log]:
    """Return a random model, what is hidden in its machine, and the log of that machine.

    The masses, centres, inertias, armatures and damping of the machine differ from those of the model by the share
    `wrong` (sd).
    """
    rng = np.random.default_rng([seed, number])
    model = Arm()
    for name in ("mass", "centre", "inertia", "armature", "damping"):
        setattr(model, name, getattr(model, name) * rng.uniform(0.8, 1.25, 2))
    machine = deepcopy(model)
    for name in ("mass", "centre", "inertia", "armature", "damping"):
        setattr(machine, name, getattr(machine, name) * (1.0 + wrong * rng.standard_normal(2)))
    joint = int(rng.integers(2))
    truth = EFFECTS[effect](machine, joint, rng) if effect != "none" else Truth("none", "", {})
    return model, truth, record_motion(machine, model, rng, samples=samples)


def write_case(folder: Path, number: int, model: Arm, log: Log, tolerance: float = 0.02) -> Path:
    """Return the path of the case file, after writing it with its log and model."""
    folder.mkdir(parents=True, exist_ok=True)
    names = ("armature", "damping", "centre", "mass")
    spin = [f"{float(x)!r} {float(x)!r} {float(x)!r}" for x in model.inertia]
    numbers = {name: [float(x) for x in getattr(model, name)] for name in names}
    (folder / "arm.xml").write_text(
        _MJCF.format(length=model.length, reach=model.reach, spin=spin, **numbers), encoding="utf-8"
    )
    columns = np.column_stack([log.time, log.torque, log.encoder])
    head = "t,tau_shoulder,tau_elbow,q_shoulder,q_elbow"
    np.savetxt(folder / "log.csv", columns, delimiter=",", header=head, comments="", fmt="%.9g")
    (folder / "case.toml").write_text(_CASE.format(number=number, known=tolerance), encoding="utf-8")
    return folder / "case.toml"
