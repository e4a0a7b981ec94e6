"""Machines in MJCF or URDF files, through MuJoCo. This is the only module that imports it."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from lostmotion.errors import CaseError, nearest
from lostmotion.parts import Array
from lostmotion.simulators import AT_GEAR, FoundFiles, FoundMechanism, Simulator
from lostmotion_plugins.simulators.callback import calling
from lostmotion_plugins.simulators.inertial import add_amount, add_payload, measure_sizes
from lostmotion_plugins.simulators.mjcf import GEAR, write_findings
from lostmotion_plugins.simulators.stepping import Stepper, tell_softness

EXAMPLE = """
<mujoco model="arm">
  <compiler angle="radian"/>
  <worldbody>
    <body name="upper">
      <joint name="shoulder" axis="0 -1 0" armature="0.3" damping="0.5"/>
      <inertial pos="0.2 0 0" mass="3" diaginertia="0.05 0.05 0.05"/>
      <body name="fore" pos="0.4 0 0">
        <joint name="elbow" axis="0 -1 0" armature="0.1" damping="0.3"/>
        <inertial pos="0.15 0 0" mass="2" diaginertia="0.03 0.03 0.03"/>
        <site name="tip" pos="0.35 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
"""The machine that is used where no file is given: an arm with two joints that moves in a vertical plane."""
_MOTIONS = {2: "translation", 3: "rotation"}
"""The kinds of MuJoCo's slide and hinge joints."""
_PAYLOAD = ".payload"


def _import_mujoco() -> Any:
    try:
        import mujoco
    except ImportError as err:
        raise CaseError('MJCF and URDF files need MuJoCo: install it with pip install "lostmotion[mujoco]"') from err
    return mujoco


@dataclass(frozen=True)
class MujocoSimulator(Simulator):
    """A machine in an MJCF or URDF `file`, or the example arm; `moving` are the joints that move, all if empty.

    The other joints are held at the positions of the file. Contacts, limits, actuators and equality constraints are
    switched off: the recorded torque is that of the joints. `values` are those that were changed.
    """

    file: str = ""
    moving: tuple[str, ...] = ()
    values: tuple[tuple[str, float], ...] = ()
    name: ClassVar[str] = "mujoco"
    paper: ClassVar[str] = "Todorov, Erez, Tassa, IEEE/RSJ Int. Conf. Intelligent Robots and Systems (2012) 5026-5033"

    @cached_property
    def _source(self) -> Any:
        """The model as the file has it."""
        mujoco = _import_mujoco()
        try:
            if self.file:
                return mujoco.MjModel.from_xml_path(str(Path(self.file)))
            return mujoco.MjModel.from_xml_string(EXAMPLE)
        except (ValueError, OSError) as err:
            raise CaseError(f"{self.file} cannot be read by MuJoCo ({' '.join(str(err).split())[:300]})") from err

    @cached_property
    def _model(self) -> Any:
        """The model without damping, friction, armature and springs, with changed values."""
        mujoco, model = _import_mujoco(), copy.copy(self._source)
        self._refuse(model)
        for part in (model.dof_damping, model.dof_frictionloss, model.dof_armature, model.jnt_stiffness):
            part[:] = 0.0
        off = mujoco.mjtDisableBit
        names = ("CONTACT", "LIMIT", "ACTUATION", "FRICTIONLOSS", "EQUALITY", "CONSTRAINT")
        for name in names:
            model.opt.disableflags |= int(getattr(off, f"mjDSBL_{name}", 0))
        for name, value in self.values:
            if name.endswith(_PAYLOAD):
                add_payload(mujoco, model, *self._find_point(name.removesuffix(_PAYLOAD)), value)
                continue
            owner, _, kind = name.rpartition(".")
            body = self._bodies[owner]
            if kind != "mass":
                add_amount(mujoco, model, body, kind, value)
            else:
                model.body_inertia[body] *= value / model.body_mass[body]
                model.body_mass[body] = value
        return model

    @staticmethod
    def _refuse(model: Any) -> None:
        """Raise `CaseError` for a machine that a tape cannot describe."""
        kinds = set(np.asarray(model.jnt_type).tolist())
        if not kinds <= set(_MOTIONS):
            raise CaseError(
                "the model has a free or a ball joint, so its base floats or a joint has no single encoder: only hinge"
                " and slide joints can be diagnosed; fix the base in the file"
            )
        if model.ntendon:
            raise CaseError("the model has tendons, which cannot be diagnosed yet: use a model without them")

    @cached_property
    def _names(self) -> dict[str, int]:
        """The joints of the file with their numbers."""
        return {self._source.joint(i).name or f"joint{i + 1}": i for i in range(self._source.njnt)}

    @cached_property
    def _bodies(self) -> dict[str, int]:
        return {self._source.body(i).name or f"body{i}": i for i in range(1, self._source.nbody)}

    @cached_property
    def _moved(self) -> list[int]:
        """The numbers of the joints that move."""
        for name in self.moving:
            if name not in self._names:
                raise CaseError(
                    f"the model has no joint {name!r}{nearest(name, self._names)}: it has {', '.join(self._names)}"
                )
        return [self._names[name] for name in self.moving or self._names]

    @property
    def joints(self) -> tuple[str, ...]:
        return self.moving or tuple(self._names)

    @property
    def moves(self) -> tuple[str, ...]:
        return tuple(_MOTIONS.get(int(self._source.jnt_type[i]), "rotation") for i in self._moved)

    @property
    def taken(self) -> Mapping[str, float]:
        source = self._source
        found: dict[str, float] = {}
        for name, i in zip(self.joints, self._moved, strict=True):
            dof, at = int(source.jnt_dofadr[i]), int(source.jnt_qposadr[i])
            own = {
                "damping": source.dof_damping[dof],
                "frictionloss": source.dof_frictionloss[dof],
                "armature": source.dof_armature[dof],
                "stiffness": source.jnt_stiffness[i],
                "rest": source.qpos_spring[at],
            }
            found |= {f"{name}.{key}": float(np.ravel(value)[0]) for key, value in own.items()}
        return found

    @property
    def linear(self) -> Mapping[str, float]:
        """The masses of the bodies that the joints move; the inertia about the centre changes in proportion."""
        model, moved = self._source, {int(self._source.jnt_bodyid[i]) for i in self._moved}
        found = dict(self.values)
        for name, body in self._bodies.items():
            at, carried = body, False
            while at > 0:
                carried |= at in moved
                at = int(model.body_parentid[at])
            if carried and model.body_mass[body] > 0.0:
                found.setdefault(f"{name}.mass", float(model.body_mass[body]))
        return {key: value for key, value in found.items() if key.endswith(".mass")}

    @property
    def inertial(self) -> Mapping[str, float]:
        mujoco, bodies = _import_mujoco(), [name.removesuffix(".mass") for name in self.linear]
        return {
            f"{name}.{kind}": size
            for name in bodies
            for kind, size in measure_sizes(mujoco, self._source, self._bodies[name]).items()
        }

    @property
    def gains(self) -> Mapping[str, tuple[float, float]]:
        """The gains of the position actuators of the file that act on one joint each."""
        mujoco, source = _import_mujoco(), self._source
        found = {}
        for name, i in zip(self.joints, self._moved, strict=True):
            for k in np.flatnonzero(np.asarray(source.actuator_trnid)[:, 0] == i):
                stiffness, (_, back, lossy) = float(source.actuator_gainprm[k][0]), source.actuator_biasprm[k][:3]
                joint = int(source.actuator_trntype[k]) == int(mujoco.mjtTrn.mjTRN_JOINT)
                if joint and stiffness > 0.0 and float(back) == -stiffness:
                    found[name] = (stiffness, -float(lossy))
        return found

    @property
    def points(self) -> tuple[str, ...]:
        sites = tuple(self._source.site(i).name for i in range(self._source.nsite) if self._source.site(i).name)
        return sites or (list(self._bodies)[-1],)

    @property
    def step(self) -> float | None:
        return float(self._source.opt.timestep)

    def _find_point(self, name: str) -> tuple[int, Array]:
        """Return the body of a site or a body by name, and the position of the point in its frame."""
        model = self._source
        for i in range(model.nsite):
            if model.site(i).name == name:
                return int(model.site_bodyid[i]), np.array(model.site_pos[i])
        body = self._bodies[name]
        return body, np.array(model.body_ipos[body])

    def inverse(self, q: Array, v: Array, a: Array) -> Array:
        mujoco, model = _import_mujoco(), self._model
        data = mujoco.MjData(model)
        rest, found = np.array(model.qpos0), np.zeros_like(q)
        at = [int(model.jnt_qposadr[i]) for i in self._moved]
        dof = [int(model.jnt_dofadr[i]) for i in self._moved]
        position, speed, pull = np.tile(rest, (len(q), 1)), np.zeros((len(q), model.nv)), np.zeros((len(q), model.nv))
        position[:, at], speed[:, dof], pull[:, dof] = q, v, a
        for k in range(len(q)):
            data.qpos[:], data.qvel[:], data.qacc[:] = position[k], speed[k], pull[k]
            mujoco.mj_inverse(model, data)
            found[k] = data.qfrc_inverse[dof]
        return found

    def roll(self, q: Array, v: Array, torque: Array, dt: float, *, step: float | None = None) -> tuple[Array, Array]:
        model = self._copy_stepped()
        model.dof_frictionloss[:] = 0.0
        model.opt.disableflags |= int(_import_mujoco().mjtDisableBit.mjDSBL_LIMIT)
        return self._roll(model, (q, v), torque, dt, step)

    def _copy_stepped(self) -> Any:
        """Return a copy of the model of the file without contacts, actuators and equality constraints."""
        mujoco, model = _import_mujoco(), copy.copy(self._source)
        self._refuse(model)
        for name in ("CONTACT", "ACTUATION", "EQUALITY"):
            model.opt.disableflags |= int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}", 0))
        return model

    def _roll(
        self, model: Any, state: tuple[Array, Array], torque: Array, dt: float, step: float | None
    ) -> tuple[Array, Array]:
        places = [int(model.jnt_qposadr[i]) for i in self._moved]
        dofs = [int(model.jnt_dofadr[i]) for i in self._moved]
        stepper = Stepper(_import_mujoco(), model, places, dofs)
        stepper.hold()
        count = stepper.set_clock(dt, step)
        return stepper.roll(*state, torque, count)

    def describe_friction(self, q: Array, forces: Mapping[str, float]) -> tuple[str, ...]:
        model = self._copy_stepped()
        places = [int(model.jnt_qposadr[i]) for i in self._moved]
        dofs = dict(zip(self.joints, (int(model.jnt_dofadr[i]) for i in self._moved), strict=True))
        model.qpos0[places], model.opt.gravity[:] = q, 0.0
        return tell_softness(_import_mujoco(), model, dofs, forces)

    def write_found(self, found: Sequence[FoundMechanism], known: Mapping[str, float]) -> FoundFiles:
        """Return the MJCF with what was found, notes, and a callback; a URDF becomes an MJCF."""
        mujoco = _import_mujoco()
        spec = mujoco.MjSpec.from_file(self.file) if self.file else mujoco.MjSpec.from_string(EXAMPLE)
        return write_findings(mujoco, spec, found, known)

    def with_found(self, found: Sequence[FoundMechanism], known: Mapping[str, float]) -> FoundSimulator:
        """Return the changed machine; a gear is one more joint, `elbow_gear`."""
        mujoco = _import_mujoco()
        files = self.write_found(found, known)
        spec = mujoco.MjSpec.from_string(files.model)
        if self.file:
            spec.modelfiledir = str(Path(self.file).parent)
        gears = tuple(f"{joint}{GEAR}" for joint in self.joints if f"{joint}{AT_GEAR}" in {one.at for one in found})
        return FoundSimulator(self.file, (*self.joints, *gears), model=spec.compile(), callback=files.callback)

    def changed(self, values: Mapping[str, float]) -> MujocoSimulator:
        """Return the machine with other masses (kg) of bodies, `fore.mass`, more of `inertial`, or a payload (kg)."""
        known = {*self.linear, *self.inertial, *(f"{point}{_PAYLOAD}" for point in self.points)}
        for name in values:
            if name not in known:
                raise CaseError(f"the model has no value {name!r}{nearest(name, known)}: it has {', '.join(known)}")
        return replace(self, values=tuple((dict(self.values) | dict(values)).items()))


@dataclass(frozen=True)
class FoundSimulator(MujocoSimulator):
    """A machine with what was found in it, which is stepped with its own dry friction, limits and `callback`."""

    model: Any = None
    callback: str = ""

    @cached_property
    def _source(self) -> Any:
        return self.model

    def roll(self, q: Array, v: Array, torque: Array, dt: float, *, step: float | None = None) -> tuple[Array, Array]:
        with calling(_import_mujoco(), self.callback):
            return self._roll(self._copy_stepped(), (q, v), torque, dt, step)


@dataclass(frozen=True)
class UrdfSimulator(MujocoSimulator):
    """A machine in a URDF `file`, read by MuJoCo's loader; without a file it is the example arm."""

    name: ClassVar[str] = "urdf"
