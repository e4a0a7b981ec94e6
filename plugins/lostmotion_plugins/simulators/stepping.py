"""A MuJoCo model stepped in time under given torques, and how soft its dry friction is."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lostmotion.parts import Array
from lostmotion_plugins.simulators.mjcf import FINE, STIFF

HEAVY = 1e9
"""The armature (kg m^2) of a joint that is held."""
RUN, SLOW = 0.3, 0.1
"""The time (s) over which a joint creeps, and its speed as a share of the one that friction stops in one step."""


@dataclass(frozen=True, eq=False)
class Stepper:
    """A model, and the positions of the joints that move in its states; the other joints are held."""

    mujoco: Any
    model: Any
    places: Sequence[int]
    dofs: Sequence[int]

    def hold(self) -> None:
        """Hold all other joints, by armatures that no torque moves."""
        held = np.ones(self.model.nv, dtype=bool)
        held[list(self.dofs)] = False
        self.model.dof_armature[held] = HEAVY

    def set_clock(self, dt: float, step: float | None) -> int:
        """Return the number of steps within `dt` s after setting the step; without one the motion is exact."""
        option = self.model.opt
        if step is None:
            option.integrator = int(self.mujoco.mjtIntegrator.mjINT_RK4)
        count = math.ceil(dt / FINE) if step is None else max(1, round(dt / step))
        option.timestep = dt / count
        return count

    def roll(self, q: Array, v: Array, torque: Array, count: int) -> tuple[Array, Array]:
        """Return positions and velocities (runs, samples, n) after each sample of `count` steps under held torques."""
        data, found = self.mujoco.MjData(self.model), np.zeros((2, *torque.shape))
        places, dofs = list(self.places), list(self.dofs)
        for run in range(len(torque)):
            self.mujoco.mj_resetData(self.model, data)
            data.qpos[places], data.qvel[dofs] = q[run], v[run]
            for k, pull in enumerate(torque[run]):
                data.qfrc_applied[dofs] = pull
                self.mujoco.mj_step(self.model, data, nstep=count)
                found[0, run, k], found[1, run, k] = data.qpos[places], data.qvel[dofs]
        return found[0], found[1]


def tell_softness(mujoco: Any, model: Any, dofs: Mapping[str, int], forces: Mapping[str, float]) -> tuple[str, ...]:
    """Return a sentence on the softness of the dry friction (N m or N) of each joint, as the file has it and stiff."""
    found, usual = [], float(model.opt.timestep)
    slide = int(mujoco.mjtJoint.mjJNT_SLIDE)
    for joint, force in forces.items():
        dof = dofs[joint]
        settings = ((tuple(model.dof_solref[dof]), usual), (STIFF, FINE))
        told = [_measure_softness(mujoco, model, dof, force, setting) for setting in settings]
        unit = "m/s" if int(model.jnt_type[model.dof_jntid[dof]]) == slide else "rad/s"
        (file, there), ((creep, kept), (creeps, keeps)) = settings[0], told
        found.append(
            f"MuJoCo's frictionloss is soft, where dry friction holds. With solref {file[0]:g} {file[1]:g} and steps of"
            f" {1e3 * there:g} ms, as in the file, {joint} creeps at {creep:.2g} {unit} under half of its friction, and"
            f" a step leaves {100.0 * kept:.0f} % of a small speed; with solref {STIFF[0]:g} {STIFF[1]:g} and steps of"
            f" {1e3 * FINE:g} ms, as written into the found model, {creeps:.2g} {unit} and {100.0 * keeps:.0f} %."
        )
    return tuple(found)


def _measure_softness(
    mujoco: Any, model: Any, dof: int, force: float, setting: tuple[Sequence[float], float]
) -> tuple[float, float]:
    """Return the speed (SI) at which a joint creeps under half its friction, and what is left of a small speed."""
    model.dof_frictionloss[:] = 0.0
    model.dof_frictionloss[dof], model.dof_solref[dof] = force, setting[0]
    model.opt.timestep = setting[1]
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    unit, momentum = np.zeros((2, model.nv))
    unit[dof] = 1.0
    mujoco.mj_mulM(model, data, momentum, unit)
    small = SLOW * force * setting[1] / float(momentum[dof])
    data.qvel[dof] = small
    mujoco.mj_step(model, data)
    kept = float(data.qvel[dof]) / small
    mujoco.mj_resetData(model, data)
    data.qfrc_applied[dof] = 0.5 * force
    mujoco.mj_step(model, data, nstep=math.ceil(RUN / setting[1]))
    return abs(float(data.qvel[dof])), kept
