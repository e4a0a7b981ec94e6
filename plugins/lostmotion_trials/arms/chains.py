"""Arms with up to seven joints, one or two hidden effects, or none, as case files with a log and a model in MJCF."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from pathlib import Path

import numpy as np

from lostmotion_trials.arms.draw import Truth
from lostmotion_trials.integrators.arm import Log
from lostmotion_trials.integrators.chain import Chain, draw_chain, plan_chain, record_chain


def _size(rng: np.random.Generator, force: float) -> float:
    """Return a torque between 3 and 20 per cent of that of the joint."""
    return float(force * math.exp(rng.uniform(math.log(0.03), math.log(0.2))))


def _hide_coulomb(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.friction[j] = _size(rng, force)
    return Truth("coulomb_friction", arm.joints[j], {"force": float(arm.friction[j])})


def _hide_stribeck(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.friction[j] = _size(rng, force)
    arm.excess[j], arm.stribeck[j] = arm.friction[j] * rng.uniform(0.5, 1.0), rng.uniform(0.05, 0.2)
    values = {"force": float(arm.friction[j]), "excess": float(arm.excess[j]), "velocity": float(arm.stribeck[j])}
    return Truth("stribeck_friction", arm.joints[j], values)


def _hide_viscous(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    more = _size(rng, force)
    arm.damping[j] += more
    return Truth("viscous_damping", arm.joints[j], {"coefficient": more})


def _hide_ripple(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.ripple[j], arm.order[j] = _size(rng, force), rng.uniform(30.0, 90.0)
    return Truth(
        "cogging", arm.joints[j], {"force": float(arm.ripple[j]), "pitch": 2.0 * math.pi / float(arm.order[j])}
    )


def _hide_spring(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.spring[j] = 2.0 * _size(rng, force)
    return Truth("linear_stiffness", arm.joints[j], {"coefficient": float(arm.spring[j])})


def _hide_offset(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.offset[j] = _size(rng, force) * rng.choice([-1.0, 1.0])
    return Truth("offset_force", arm.joints[j], {"force": float(arm.offset[j])})


def _hide_delay(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.delay[j] = rng.uniform(0.002, 0.008)
    return Truth("excitation_delay", f"{arm.joints[j]}.torque", {"delay": float(arm.delay[j])})


def _hide_gain(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.gain[j] = 1.0 + float(rng.choice([-1.0, 1.0])) * rng.uniform(0.05, 0.15)
    return Truth("excitation_gain", f"{arm.joints[j]}.torque", {"error": float(arm.gain[j] - 1.0)})


def _hide_payload(arm: Chain, j: int, force: float, rng: np.random.Generator) -> Truth:
    arm.payload = rng.uniform(0.05, 0.4)
    return Truth("payload", "tip", {"mass": arm.payload})


CHAIN_EFFECTS: Mapping[str, Callable[[Chain, int, float, np.random.Generator], Truth]] = {
    "coulomb_friction": _hide_coulomb, "viscous_damping": _hide_viscous, "stribeck_friction": _hide_stribeck,
    "excitation_delay": _hide_delay, "cogging": _hide_ripple, "payload": _hide_payload, "offset_force": _hide_offset,
    "linear_stiffness": _hide_spring, "excitation_gain": _hide_gain,
}  # fmt: skip
"""What may be hidden in an arm with many joints."""


def draw_hidden_chain(
    number: int, seed: int, effects: Sequence[str], joints: int, *, wrong: float = 0.0, samples: int = 5000
) -> tuple[Chain, tuple[Truth, ...], Log]:
    """Return a random model, what is hidden at different joints of its machine, and the log of that machine."""
    rng = np.random.default_rng([seed, number, joints])
    model = draw_chain(rng, joints)
    machine = deepcopy(model)
    for name in ("mass", "centre", "inertia", "armature", "damping"):
        own = getattr(machine, name)
        setattr(machine, name, own * (1.0 + wrong * rng.standard_normal(own.shape)))
    probe = np.random.default_rng(0)
    forces = np.std(model.torque(*plan_chain(probe, 500, 0.02, joints)), axis=0)
    places = rng.permutation(joints)
    truths = [CHAIN_EFFECTS[e](machine, j, float(forces[j]), rng) for e, j in zip(effects, places, strict=False)]
    return model, tuple(truths), record_chain(machine, model, rng, samples=samples)


def write_chain_case(folder: Path, title: str, model: Chain, log: Log, tolerance: float = 0.02) -> Path:
    """Return the path of the case file, after writing it with its log and model."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "arm.xml").write_text(format_mjcf(model), encoding="utf-8")
    joints = model.joints
    head = ",".join(["t", *(f"tau_{j}" for j in joints), *(f"q_{j}" for j in joints)])
    columns = np.column_stack([log.time, log.torque, log.encoder])
    np.savetxt(folder / "log.csv", columns, delimiter=",", header=head, comments="", fmt="%.9g")
    inputs = [f'{{ input = "{j}.torque", column = "tau_{j}", unit = "N m" }}' for j in joints]
    sensors = [f'{{ channel = "{j}", column = "q_{j}", unit = "rad" }}' for j in joints]
    text = f"""title = {json.dumps(title)}
[[recordings]]
file = "log.csv"
time = "t"
inputs = [ {", ".join(inputs)} ]
sensors = [ {", ".join(sensors)} ]
[model]
mujoco = "arm.xml"
joints = {json.dumps(list(joints))}
torque = "motor"
tolerance = {tolerance}
"""
    (folder / "case.toml").write_text(text, encoding="utf-8")
    return folder / "case.toml"


def format_mjcf(model: Chain) -> str:
    """Return the MJCF of a chain."""
    rows = []
    for i, joint in enumerate(model.joints):
        half = 0.5 * float(model.turn[i])
        place, centre, inertia = (
            " ".join(f"{float(x)!r}" for x in one) for one in (model.place[i], model.centre[i], model.inertia[i])
        )
        rows.append(
            f'<body name="link{i + 1}" pos="{place}" quat="{math.cos(half)!r} {math.sin(half)!r} 0 0">'
            f'<joint name="{joint}" axis="0 0 1" armature="{float(model.armature[i])!r}"'
            f' damping="{float(model.damping[i])!r}"/>'
            f'<inertial pos="{centre}" mass="{float(model.mass[i])!r}" diaginertia="{inertia}"/>'
        )
    tip = " ".join(f"{float(x)!r}" for x in model.tip)
    end = f'<site name="tip" pos="{tip}"/>' + "</body>" * len(rows)
    head = '<mujoco model="chain">\n<compiler angle="radian"/>\n<option timestep="0.001"/>\n<worldbody>\n'
    return head + "\n".join(rows) + end + "\n</worldbody>\n</mujoco>\n"
