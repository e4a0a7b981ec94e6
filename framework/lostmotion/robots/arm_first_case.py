"""A first case for the log of a robot: the joints of a model are matched with columns by their names."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lostmotion.errors import DataError, nearest
from lostmotion.recording.column_names import kind_named, names_time
from lostmotion.recording.formats import read_table
from lostmotion.recording.table import Table
from lostmotion.recording.units import kinds_of
from lostmotion.registry import Registry
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_model import make_simulator
from lostmotion.simulators import Simulator

ROLES = {"force": "torque", "position": "position", "velocity": "velocity"}
"""The quantities of columns that a case of a robot uses, with their words."""
WORDS = {
    "force": re.compile(r"tau|torque|trq|effort|current", re.IGNORECASE),
    "velocity": re.compile(r"^(dq|qd|qdot|q_dot|dtheta|vel|v|w)$|velocity|speed|qvel", re.IGNORECASE),
    "position": re.compile(r"^(q|pos|p|theta|phi|x|enc|angle)$|position|angle|encoder|qpos", re.IGNORECASE),
}
"""Words for quantities in logs of robots, beyond those of other logs."""
WISHED = re.compile(
    r"set ?point|desired|target|ref(erence)?([_ .\d\[]|$)|goal|_d(es)?([_ .\d\[]|$)|^(set|des)[_ .]", re.IGNORECASE
)
"""Names of columns that a controller wishes: they are no readings."""
WIDE = 7.0
"""Positions (rad) that travel farther may be in degrees."""


@dataclass(frozen=True)
class RobotRoles:
    """What a user says about a log: the column of time or the rate (Hz), the side of the torque, units and factors."""

    time: str | None = None
    rate: float | None = None
    torque: str | None = None
    units: Mapping[str, str] = field(default_factory=dict)
    factors: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class RobotDraft:
    """A first case: its text, and sentences on what was found and on what to check."""

    text: str
    found: tuple[str, ...]
    notes: tuple[str, ...]


def write_robot_case(log: Path, out: Path, kind: str, model: Path, roles: RobotRoles, registry: Registry) -> RobotDraft:
    """Return the draft of a case for a log and a model of a `kind` ("mujoco", "urdf"), after writing it to `out`.

    Raises `DataError` where no column belongs to a joint, and what reading the case raises, if the side of the torque
    is given.
    """
    table = read_table(log)
    simulator = make_simulator(kind, str(model.absolute()), (), registry)
    time = _find_time(table, roles, log.name)
    names = [name for name in table.full_names if name != time and name not in _list_same(table, time)]
    matched = match_columns(names, simulator.joints, {**table.units, **roles.units})
    joints, notes = _choose_joints(matched, simulator.joints, log.name, names)
    notes += _list_doubts(table, matched, joints, {**table.units, **roles.units})
    text = _format_case(log, out, (kind, model), (table, time, roles), simulator, matched, joints)
    out.write_text(text, encoding="utf-8")
    if roles.torque is not None:
        load_robot_case(out, registry)
    found = [f"time: {time}" if time else f"rate: {roles.rate:g} Hz"]
    for joint in joints:
        have = [
            f"{word} {matched[joint, quantity]!r}" for quantity, word in ROLES.items() if (joint, quantity) in matched
        ]
        found.append(f"{joint}: {', '.join(have)}")
    return RobotDraft(text, tuple(found), tuple(notes))


def match_columns(names: Sequence[str], joints: Sequence[str], units: Mapping[str, str]) -> dict[tuple[str, str], str]:
    """Return the column of each joint and quantity: by the name of the joint in it, or else by its number.

    Where several columns fit, the shortest name counts.
    """
    found: dict[tuple[str, str], str] = {}
    numbered: dict[tuple[str, int], str] = {}
    for name in sorted(names, key=lambda one: (bool(WISHED.search(one)), len(one), one)):
        joint = _find_joint(name, joints)
        rest = re.sub(re.escape(joint), " ", name, count=1, flags=re.IGNORECASE) if joint else name
        quantity = next(iter(kinds_of(units.get(name, ""))), "") or _find_quantity(rest)
        if quantity not in ROLES or WISHED.search(rest):
            continue
        number = re.findall(r"\d+", rest)
        if joint:
            found.setdefault((joint, quantity), name)
        elif number:
            numbered.setdefault((quantity, int(number[-1])), name)
    for quantity in ROLES:
        own = {number: name for (kind, number), name in numbered.items() if kind == quantity}
        for joint, name in _match_numbers(own, joints).items():
            found.setdefault((joint, quantity), name)
    return found


def _find_joint(name: str, joints: Sequence[str]) -> str:
    """Return the joint whose name stands in that of a column, the longest one; "" without any."""
    held = [j for j in joints if re.search(rf"(?<![a-z]){re.escape(j)}(?![a-z0-9])", name, re.IGNORECASE)]
    return max(held, key=len, default="")


def _find_quantity(text: str) -> str:
    """Return the quantity that the name of a column says, without that of its joint."""
    plain = re.sub(r"[\s_./\[\]()\d-]+", " ", text).strip()
    for quantity, words in WORDS.items():
        if any(words.search(word) for word in plain.split()):
            return quantity
    return kind_named(plain)


def _match_numbers(own: Mapping[int, str], joints: Sequence[str]) -> dict[str, str]:
    """Return the column of each joint by its number: that in the name of the joint, or its place."""
    ends = [re.findall(r"\d+", joint) for joint in joints]
    numbers = [int(end[-1]) for end in ends if end]
    if len(set(numbers)) == len(joints) and set(own) <= set(numbers):
        return {joint: own[number] for joint, number in zip(joints, numbers, strict=True) if number in own}
    if len(own) == len(joints):
        return dict(zip(joints, (own[number] for number in sorted(own)), strict=True))
    return {}


def _find_time(table: Table, roles: RobotRoles, source: str) -> str | None:
    """Return the column of time; None where the rate is given."""
    if roles.rate is not None:
        return None
    if roles.time is not None:
        table.column(roles.time, source)
        return roles.time
    named = [n for n in table.full_names if n in table.starts or names_time(n)]
    if not named:
        raise DataError(f"{source} has no column of time: give --time COLUMN, or --rate HZ")
    return named[0]


def _list_same(table: Table, time: str | None) -> list[str]:
    """Return all names of the column of time."""
    return [] if time is None else [n for n in table.columns if table.columns[n] is table.columns[time]]


def _choose_joints(
    matched: Mapping[tuple[str, str], str], joints: Sequence[str], source: str, names: Sequence[str]
) -> tuple[list[str], list[str]]:
    """Return the joints with torque and position, and notes on the others; raise `DataError` where there is a gap."""
    kept = [j for j in joints if {(j, "force"), (j, "position")} <= matched.keys()]
    for joint in joints:
        have = {quantity for quantity in ROLES if (joint, quantity) in matched}
        if joint not in kept and have & {"force", "position"}:
            lost = "position" if "force" in have else "force"
            wished = [name for name in names if lost == "force" and WISHED.search(name)]
            other = (
                f"; if {wished[0]!r} and the like are set points of a controller with known gains, its input is"
                f" '{joint}.setpoint', with [model.gains]"
                if wished
                else ""
            )
            raise DataError(
                f"{source} has no {ROLES[lost]} of {joint} that its name tells{nearest(joint, names)}: name the column"
                f" {'tau' if lost == 'force' else 'q'}_{joint}, or write the case by hand{other}"
            )
    if not kept:
        raise DataError(
            f"{source}: no column belongs to a joint of the model by its name: the joints are {', '.join(joints)}, the"
            f" columns {', '.join(names[:20])}; name them tau_{joints[0]} and q_{joints[0]}"
        )
    held = [j for j in joints if j not in kept]
    return kept, [f"{', '.join(held)} are not in the log, and are held where the model puts them"] if held else []


def _list_doubts(
    table: Table, matched: Mapping[tuple[str, str], str], joints: Sequence[str], units: Mapping[str, str]
) -> list[str]:
    """Return sentences on units that are supposed."""
    used = [matched[joint, quantity] for joint in joints for quantity in ROLES if (joint, quantity) in matched]
    supposed = [name for name in used if not kinds_of(units.get(name, ""))]
    found = [f"the units of {', '.join(supposed)} are supposed to be those of SI"] if supposed else []
    wide = [n for j in joints if (n := matched[j, "position"]) in supposed and np.ptp(table.columns[n]) > WIDE]
    if wide:
        found.append(f'{", ".join(wide)} travel more than {WIDE:g}: if they are in degrees, write unit = "deg"')
    return found


def _format_case(
    log: Path, out: Path, model: tuple[str, Path], read: tuple[Table, str | None, RobotRoles], simulator: Simulator,
    matched: Mapping[tuple[str, str], str], joints: Sequence[str],
) -> str:  # fmt: skip
    """Return the text of the case file."""
    (kind, file), (table, time, roles) = model, read
    moves = dict(zip(simulator.joints, simulator.moves, strict=True))
    stated = {**table.units, **roles.units}

    def write(key: str, joint: str, quantity: str) -> str:
        name = matched[joint, quantity]
        usual = {"force": ("N m", "N"), "position": ("rad", "m"), "velocity": ("rad/s", "m/s")}
        known = stated.get(name, "")
        unit = known if quantity in kinds_of(known) else usual[quantity][moves[joint] == "translation"]
        place = joint if quantity == "position" else f"{joint}.{ROLES[quantity]}"
        factor = f", factor = {roles.factors[name]!r}" if name in roles.factors else ""
        return f"  {{ {key} = {json.dumps(place)}, column = {json.dumps(name)}, unit = {json.dumps(unit)}{factor} }},"

    quantities = [q for q in ("position", "velocity") if all((joint, q) in matched for joint in joints)]
    place = Path(os.path.relpath(log, out.parent)).as_posix()
    lines = [
        f"title = {json.dumps(log.stem)}",
        "[[recordings]]",
        f"file = {json.dumps(place)}",
        f"time = {json.dumps(time)}" if time is not None else f"rate = {roles.rate!r}",
        "inputs = [",
        *(write("input", joint, "force") for joint in joints),
        "]",
        "sensors = [",
        *(write("channel", joint, q) for q in quantities for joint in joints),
        "]",
        "",
        "[model]",
        f"{kind} = {json.dumps(Path(os.path.relpath(file, out.parent)).as_posix())}",
        f"joints = {json.dumps(list(joints))}  # those that move and are measured; the others are held",
        f'torque = "{roles.torque}"'
        if roles.torque
        else '# torque = "motor"  # motor currents and commands; or "link": a sensor behind the gear',
        "tolerance = 0.02  # values of the model are known within this share (sd)",
        "",
        "[model.estimate]  # values that are not known, such as",
        f'# "{joints[0]}.damping" = {{ low = 0.01, high = 10.0, scale = "log" }}',
        "",
    ]
    return "\n".join(lines)
