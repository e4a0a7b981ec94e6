"""The user's own simulation of a robot, as a case file names it or as `lostmotion.model` makes it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from lostmotion.arguments import choice, list_texts, path, positive, words
from lostmotion.errors import CaseError, nearest
from lostmotion.registry import Registry, default
from lostmotion.robots.user import Function, FunctionSimulator
from lostmotion.simulators import INVERSE, Simulator

TOLERANCE = 0.02
"""The share (sd) within which values of the model are known."""
SIDES, HOLDS = ("motor", "link"), ("step", "smooth")
WHICH_SIDE = (
    "lacks 'torque': on which side of the gear is the torque measured? Write torque = \"motor\" for motor currents and"
    ' commands, or torque = "link" for a sensor behind the gear'
)


@dataclass(frozen=True, eq=False)
class RobotModel:
    """A simulator, and what a case says about it; `lostmotion.model(mujoco="arm.xml", torque="motor")` makes one.

    `kind` is the key of the simulator ("mujoco", "urdf", "inverse"), `source` its file, or "my_model.py:inverse", or
    empty for a function of this session. `side` tells where torques are measured: "motor", or "link" of each gear.
    Values of the simulator are known within the share `tolerance`. `hold` is "step" where a controller holds the torque
    between samples, else "smooth".
    """

    simulator: Simulator
    kind: str
    source: str
    side: str
    tolerance: float = TOLERANCE
    hold: str = "step"

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints that move."""
        return self.simulator.joints

    @property
    def file(self) -> Path | None:
        """The file of the simulation; None for a function of this session."""
        return Path(self.source.rpartition(":")[0] if self.kind == INVERSE else self.source) if self.source else None

    @property
    def label(self) -> str:
        """The model in words."""
        return self.file.name if self.file is not None else self.kind

    def __repr__(self) -> str:
        return f"<RobotModel {self.label}: joints {', '.join(self.joints)}; torque of the {self.side}>"


def make_simulator(
    kind: str,
    source: str | Function,
    joints: tuple[str, ...],
    registry: Registry,
    *,
    folder: Path = Path(),
    refuse: Callable[[str], CaseError] = lambda says: CaseError(f"the model {says}"),
) -> Simulator:
    """Return the simulator of a kind for a file relative to a folder, or for a function of inverse dynamics.

    `refuse` makes the error of a sentence without its subject.
    """
    if kind == INVERSE:
        if not joints:
            raise refuse('lacks \'joints\': add their names in the order of the columns, ["shoulder", "elbow"]')
        if callable(source):
            return FunctionSimulator(source, joints)
        return FunctionSimulator.load(source, folder, joints)
    file = folder / str(source)
    if not file.is_file():
        raise refuse(
            f"names the file {str(source)!r}, which does not exist in {folder.name or 'this folder'}: correct it"
        )
    made: Simulator = registry.load("simulator", kind)(file=str(file), moving=joints)
    if not made.joints:
        raise refuse(f"names {str(source)!r}, in which no joint moves")
    return made


def make_robot_model(
    *,
    joints: Sequence[str] = (),
    torque: str | None = None,
    tolerance: float = TOLERANCE,
    hold: str = "step",
    registry: Registry | None = None,
    **source: str | Path | Function,
) -> RobotModel:
    """Return the model of a robot from `mujoco` or `urdf`, a path, or `inverse`, a function or "my_model.py:inverse".

    The other arguments are those of a case file. A function contains what the sensor of the torque shows, so that it
    needs no `torque`. Raises `CaseError` for what cannot be used.
    """
    known = registry or default()
    kinds = (INVERSE, *known.names("simulator"))
    for name in source:
        if name not in kinds:
            raise CaseError(
                f"model has the unknown argument {name!r}{nearest(name, kinds)}: expected a name or equations, or one"
                f" of {', '.join(kinds)}"
            )
    if len(source) != 1:
        raise CaseError(f"model has {len(source)} models: give a name or equations, or one of {', '.join(kinds)}")
    ((kind, given),) = source.items()
    if torque is None and kind != INVERSE:
        raise CaseError(f"the model {WHICH_SIDE}")
    side = choice(*SIDES)("motor" if torque is None else torque, "torque")
    names = words(joints, "joints") if joints else ()
    text = given if callable(given) else str(path(given, kind))
    simulator = make_simulator(kind, text, list_texts(names), known)
    share, held = positive(tolerance, "tolerance"), choice(*HOLDS)(hold, "hold")
    return RobotModel(simulator, kind, "" if callable(text) else text, side, share, held)
