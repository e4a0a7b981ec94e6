"""The case file of a robot: logs, the user's own simulation, and what is known and estimated."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lostmotion.case import Prior
from lostmotion.case.fields import Fields
from lostmotion.case.reading import parse_case, read_prior
from lostmotion.errors import CaseError, nearest
from lostmotion.parts import Array
from lostmotion.provenance import digest
from lostmotion.quantities import DAMPING, FORCE, INERTIA, STIFFNESS, Dimension, si_factor
from lostmotion.recording.clock import read_time
from lostmotion.recording.formats import read_table
from lostmotion.recording.table import Table
from lostmotion.registry import Registry
from lostmotion.robots.arm_effects import ArmCoordinate
from lostmotion.robots.arm_model import HOLDS, SIDES, TOLERANCE, WHICH_SIDE, RobotModel, make_simulator
from lostmotion.robots.clock_errors import correct_stamps
from lostmotion.robots.log import RobotLog, find_stale, measure_clock, resample
from lostmotion.simulators import INVERSE, Simulator

TOP = ("title", "plugins", "recordings", "model", "truth")
RECORDING = ("file", "time", "rate", "inputs", "sensors", "hold", "t_start", "t_end", "name", "start")
MODEL = ("joints", "torque", "tolerance", "known", "estimate", "gains")
ENTRY = ("column", "unit", "factor")
SETPOINT = "setpoint"
"""The quantity of an input that is the set point of a position controller."""
ORDERS = {"position": 0, "velocity": 1}
KINDS: Mapping[str, Dimension] = {
    "damping": DAMPING, "frictionloss": FORCE, "armature": INERTIA, "stiffness": STIFFNESS, "mass": INERTIA,
}  # fmt: skip
"""The values of a model that may be estimated, with their dimensions."""


@dataclass(frozen=True, eq=False)
class RobotCase:
    """A case of a robot: its log, its model, and values of the model that are known (SI) or estimated.

    `inputs` are digests of its files by name.
    """

    title: str
    log: RobotLog
    model: RobotModel
    known: Mapping[str, float]
    estimate: Mapping[str, Prior]
    inputs: Mapping[str, str]

    def __post_init__(self) -> None:
        simulator = self.model.simulator
        allowed = [*simulator.linear, *(f"{j}.{kind}" for j in simulator.joints for kind in KINDS if kind != "mass")]
        for table, names in (("known", self.known), ("estimate", self.estimate)):
            for name in names:
                if name not in allowed:
                    raise CaseError(
                        f"{table} has the unknown value {name!r}{nearest(name, allowed)}: the model has"
                        f" {', '.join(allowed)}"
                    )
        if both := sorted(set(self.known) & set(self.estimate)):
            raise CaseError(f"{both[0]!r} is both known and estimated: remove it from one of the two")

    @property
    def coordinates(self) -> dict[str, ArmCoordinate]:
        """The coordinates of the estimated values, by name."""
        return {key: make_coordinate(key, prior) for key, prior in self.estimate.items()}


def load_robot_case(path: Path, registry: Registry) -> RobotCase:
    """Return the case of a robot at `path`; raise `CaseError` or `DataError` for anything that cannot be used."""
    top = Fields(path.name, "the case", parse_case(path)).only(TOP)
    for plugin in top.texts("plugins"):
        registry.add_file(path.parent / plugin)
    kinds = (INVERSE, *registry.names("simulator"))
    model = top.table("model").only((*kinds, *MODEL))
    recordings = list(top.tables("recordings"))
    if len(recordings) > 1:
        raise top.error(f"has {len(recordings)} recordings: a robot is diagnosed from one log; give the longest one")
    kind = next(kind for kind in kinds if kind in model.values)
    source = model.text(kind) if kind == INVERSE else model.path(kind)
    simulator = make_simulator(kind, source, model.texts("joints"), registry, folder=path.parent, refuse=model.error)
    if "torque" not in model.values:
        raise model.error(WHICH_SIDE)
    side = model.choice("torque", SIDES)
    tolerance = model.positive("tolerance") if "tolerance" in model.values else TOLERANCE
    gains = {**simulator.gains, **_read_gains(model.maybe_table("gains"), simulator.joints)}
    log, sha = _read_log(recordings[0], path.parent, simulator, gains, side)
    made = RobotModel(simulator, kind, str(path.parent / source), side, tolerance, log.hold)
    fields = model.maybe_table("estimate")
    file = made.file
    return RobotCase(
        top.maybe_text("title") or path.stem,
        log,
        made,
        model.maybe_table("known").numbers(),
        {key: read_prior(fields.table(key)) for key in fields.values},
        {"case": digest(path), log.name: sha} | ({file.name: digest(file)} if file is not None else {}),
    )


def make_coordinate(key: str, prior: Prior) -> ArmCoordinate:
    """Return the coordinate of an estimated value; a uniform prior becomes a normal one with bounds."""
    kind = KINDS[key.rsplit(".", 1)[1]]
    low, high = prior.support
    if prior.kind == "log-uniform":
        spread = math.log(prior.high / prior.low) / 3.0
        return ArmCoordinate(key, 1.0, math.log(prior.start()), spread, True, prior.low, prior.high, False, kind)
    if prior.kind == "log-normal" and prior.bell is not None:
        return ArmCoordinate(key, 1.0, *prior.bell, True, 0.0, math.inf, False, kind)
    if prior.bell is None:
        unit = (prior.high - prior.low) / 3.0
        return ArmCoordinate(key, unit, prior.start() / unit, 1.0, False, low, high, False, kind)
    middle, unit = prior.bell
    return ArmCoordinate(key, unit, middle / unit, 1.0, False, low, high, False, kind)


def _read_gains(fields: Fields, joints: tuple[str, ...]) -> dict[str, tuple[float, float]]:
    """Return the stiffness and damping (SI) of the controller of each joint that a case gives."""
    tables = {joint: fields.only(joints).table(joint).only(("kp", "kd")) for joint in fields.values}
    return {joint: (own.positive("kp"), own.maybe_number("kd") or 0.0) for joint, own in tables.items()}


def _read_log(
    fields: Fields, folder: Path, simulator: Simulator, gains: Mapping[str, tuple[float, float]], side: str
) -> tuple[RobotLog, str]:
    """Return the log of a case on an even grid, and the digest of its file."""
    fields.only(RECORDING)
    path = folder / fields.path("file")
    table = read_table(path)
    torque, readings = _list_inputs(fields, simulator, gains), _list_sensors(fields, simulator)
    columns = np.stack(
        [_read_column(table, entry, path.name) for entry in (*torque, *(r[0] for r in readings))], axis=1
    )
    time, notes = _read_time(fields, table, path.name, len(columns))
    inside = (time >= (fields.maybe_number("t_start") or -np.inf)) & (time <= _or_inf(fields.maybe_number("t_end")))
    time, columns, n = time[inside], columns[inside], len(simulator.joints)
    stale = find_stale(columns[:, n : 2 * n])
    if stale.any():
        notes = (*notes, f"{stale.sum()} samples repeat all readings of the one before and are left out.")
        time, columns = time[~stale], columns[~stale]
    time, corrected = correct_stamps(time, columns[:, n : 2 * n])
    notes = (*notes, *corrected)
    clock = measure_clock(time, path.name, side)
    hold = fields.choice("hold", HOLDS) if "hold" in fields.values else "step"
    u, _ = resample(time, columns[:, :n], clock, step=hold == "step")
    used = np.array([
        gains[joint] if entry.quantity == "position" else (0.0, 0.0)
        for joint, entry in zip(simulator.joints, torque, strict=True)
    ])  # fmt: skip
    u = np.where(used[:, 0] > 0.0, used[:, 0] * u, u)
    z, gaps = resample(time, columns[:, n:], clock, step=False)
    z[gaps] = np.nan
    name = fields.maybe_text("name") or Path(path).stem
    picks = tuple(pick for _, pick in readings)
    log = RobotLog(
        name, simulator.joints, clock.step, u, z, picks, hold, (*notes, *clock.write_notes()),
        used if np.any(used) else None,
    )  # fmt: skip
    return log, digest(path)


def _or_inf(value: float | None) -> float:
    return math.inf if value is None else value


def _read_time(fields: Fields, table: Table, source: str, count: int) -> tuple[Array, tuple[str, ...]]:
    """Return the time stamps (samples,) in s, and notes on their unit."""
    if "rate" in fields.values:
        return np.arange(count) / fields.positive("rate"), ()
    if isinstance(fields.values.get("time"), dict):
        given = fields.table("time").only(("column", "unit"))
        time, _, notes = read_time(table, given.text("column"), given.maybe_text("unit"), source)
    else:
        time, _, notes = read_time(table, fields.text("time"), None, source)
    return time, notes


@dataclass(frozen=True)
class LogColumn:
    """A column of the log: its name, its quantity and unit, and a factor."""

    column: str
    quantity: str
    unit: str
    factor: float


def _read_entry(table: Fields, quantity: str) -> LogColumn:
    factor = table.maybe_number("factor")
    return LogColumn(table.text("column"), quantity, table.text("unit"), 1.0 if factor is None else factor)


def _read_column(table: Table, entry: LogColumn, source: str) -> Array:
    factor, _ = si_factor(entry.unit, entry.quantity)
    return np.asarray(table.column(entry.column, source) * (entry.factor * factor))


def _split(fields: Fields, key: str, default: str, simulator: Simulator) -> tuple[str, str]:
    """Return joint and quantity of an input or a channel such as `shoulder.torque` or `shoulder`."""
    text = fields.text(key)
    if text in simulator.joints:
        return text, default
    joint, _, quantity = text.rpartition(".")
    if joint not in simulator.joints:
        known = ", ".join(simulator.joints)
        raise fields.error(f"has the {key} {text!r}{nearest(joint or text, simulator.joints)}: the joints are {known}")
    return joint, quantity


def _list_inputs(fields: Fields, simulator: Simulator, gains: Mapping[str, tuple[float, float]]) -> list[LogColumn]:
    """Return the column of the torque or the set point of each joint, in the order of the joints."""
    found: dict[str, LogColumn] = {}
    for entry in fields.entries("inputs"):
        entry.only(("input", *ENTRY))
        joint, quantity = _split(entry, "input", "torque", simulator)
        if quantity not in ("torque", "force", SETPOINT):
            raise entry.error(
                f"has the input {entry.text('input')!r}: expected '{joint}.torque', or '{joint}.{SETPOINT}' of a"
                " controller whose gains are known"
            )
        if quantity == SETPOINT and joint not in gains:
            raise entry.error(
                f"has a set point of {joint}, and the gains of its controller are not known: give them in"
                f' [model.gains], "{joint}" = {{ kp = ..., kd = ... }} in N m/rad and N m s/rad'
            )
        found[joint] = _read_entry(entry, "position" if quantity == SETPOINT else "force")
    if missing := [joint for joint in simulator.joints if joint not in found]:
        raise fields.error(
            f"has no torque of {missing[0]}: add {{ input = '{missing[0]}.torque', column = '...', unit = 'N m' }}, or"
            f" '{missing[0]}.{SETPOINT}' if the set points of a controller with known gains are recorded, or leave the"
            " joint out of [model] joints"
        )
    return [found[joint] for joint in simulator.joints]


def _list_sensors(fields: Fields, simulator: Simulator) -> list[tuple[LogColumn, tuple[int, int]]]:
    """Return the readings with joint and order, positions of all joints first."""
    found = []
    for entry in fields.entries("sensors"):
        entry.only(("channel", "name", "noise", "zero", *ENTRY))
        joint, quantity = _split(entry, "channel", "position", simulator)
        if quantity in ORDERS:
            found.append((_read_entry(entry, quantity), (simulator.joints.index(joint), ORDERS[quantity])))
        elif quantity != "acceleration":
            raise entry.error(
                f"has the channel {entry.text('channel')!r}: expected a joint, or one with .velocity or .acceleration"
            )
    have = {j for _, (j, order) in found if order == 0}
    if missing := [joint for j, joint in enumerate(simulator.joints) if j not in have]:
        raise fields.error(
            f"has no position of {missing[0]}: add {{ channel = '{missing[0]}', column = '...', unit = 'rad' }}; a"
            " joint without an encoder cannot be diagnosed"
        )
    return sorted(found, key=lambda pair: (pair[1][1], pair[1][0]))
