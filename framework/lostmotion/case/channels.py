"""What drove the machine and what was measured, as a case says it: in the short form of one pair, or as lists."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import cast

from lostmotion.case.fields import Fields
from lostmotion.errors import CaseError, DataError
from lostmotion.quantities import names_quantity, quantity_of, si_factor
from lostmotion.recording.spec import EXCITATIONS, KINDS, RESPONSES, Channel, Kind

CHANNEL = ("column", "quantity", "unit", "factor")
INPUT = ("input", "column", "unit", "factor")
SENSOR = ("channel", "column", "unit", "factor", "name", "noise")
MARKS = "[]:/@."
"""Characters that a name may not have: keys of results and of parameters are put together with them."""
FREE = "none"
"""What a case writes in place of an excitation where nothing drives the machine."""


def inputs_of(fields: Fields) -> tuple[Channel, ...]:
    """Return what drove the machine in a recording, each input once; nothing in a free decay."""
    _check_form(fields, "excitation", "inputs", "[] where nothing drives the machine")
    if "inputs" not in fields.values:
        return () if fields.values["excitation"] == FREE else (_pair(fields, "excitation", EXCITATIONS),)
    found = tuple(_input(entry) for entry in fields.entries("inputs"))
    if twice := [name for name, count in Counter(c.target for c in found).items() if count > 1]:
        raise fields.error(f"has the input {twice[0]!r} twice: give each input once")
    return found


def sensors_of(fields: Fields) -> tuple[Channel, ...]:
    """Return what was measured in a recording: one sensor without a name, or several with names that differ."""
    _check_form(fields, "response", "sensors", "a list of sensors")
    if "sensors" not in fields.values:
        return (_pair(fields, "response", RESPONSES),)
    found = tuple(_sensor(entry) for entry in fields.entries("sensors"))
    if not found:
        raise fields.error("has sensors = []: at least one sensor is wanted")
    given = Counter(sensor.name for sensor in found if sensor.name)
    if twice := [name for name, count in given.items() if count > 1]:
        raise fields.error(f"has two sensors named {twice[0]!r}: give each its own name")
    return tuple(_named(found, set(given)))


def _check_form(fields: Fields, short: str, long: str, empty: str) -> None:
    """Refuse a recording with both forms of what is meant, or with none of them."""
    if short in fields.values and long in fields.values:
        raise fields.error(f"has both {short} and {long}: give one of them")
    if short not in fields.values and long not in fields.values:
        raise fields.error(f"lacks {short!r}: add a table, or {long} = {empty}")


def _pair(fields: Fields, key: str, quantities: tuple[str, ...]) -> Channel:
    table = fields.table(key).only(CHANNEL)
    return _checked(table, Channel(table.text("column"), table.choice("quantity", quantities), table.text("unit")))


def _input(table: Fields) -> Channel:
    table.only(INPUT)
    name = table.text("input")
    return _checked(table, Channel(table.text("column"), _quantity(table, "input"), table.text("unit"), of=_of(name)))


def _of(name: str) -> str:
    """Return the name of an input or a channel in a model, where a torque is the force of a rotation."""
    return f"{name.removesuffix('torque')}force" if name.endswith("torque") else name


def _quantity(table: Fields, key: str) -> str:
    try:
        found = quantity_of(table.text(key))
        if key == "input" and not names_quantity(table.text(key)):
            raise DataError(f"{table.values[key]!r} ends in none of {', '.join(EXCITATIONS)}")
    except DataError as err:
        raise table.error(f"has a wrong {key}: {err}") from err
    return "base_position" if table.values[key] == "base_position" else found


def _sensor(table: Fields) -> Channel:
    table.only(SENSOR)
    channel, name = table.text("channel"), table.maybe_text("name") or ""
    if bad := [mark for mark in MARKS if mark in name]:
        raise table.error(f"has the name {name!r} with {bad[0]!r} in it: wanted one without {' '.join(MARKS)}")
    noise = table.choice("noise", KINDS) if "noise" in table.values else "white"
    made = Channel(table.text("column"), _quantity(table, "channel"), table.text("unit"), of=_of(channel))
    return _checked(table, replace(made, name=name, noise=cast(Kind, noise)))


def _checked(table: Fields, channel: Channel) -> Channel:
    """Return a channel with its factor; one whose unit does not fit is refused."""
    factor = table.maybe_number("factor")
    if factor == 0:
        raise table.wrong("factor", "a number other than zero")
    try:
        si_factor(channel.unit, channel.quantity)
    except DataError as err:
        raise table.error(f"has a wrong unit: {err}") from err
    return replace(channel, factor=1.0 if factor is None else factor)


def _named(sensors: tuple[Channel, ...], taken: set[str]) -> Iterator[Channel]:
    """Yield the sensors, those without a name under that of their channel, numbered where it is taken."""
    for sensor in sensors:
        plain = sensor.name or sensor.target.replace(".", " ")
        name, k = plain, 1
        while not sensor.name and name in taken:
            k += 1
            name = f"{plain} {k}"
        taken.add(name)
        yield replace(sensor, name=name)


def check_alike(recordings: tuple[tuple[Channel, ...], ...]) -> None:
    """Refuse recordings whose sensors differ: a fit has one noise level for each sensor of a name."""
    first = recordings[0]
    for other in recordings[1:]:
        if [(s.target, s.name) for s in other] != [(s.target, s.name) for s in first]:
            told = " and ".join(", ".join(s.name or s.target for s in one) for one in (first, other))
            raise CaseError(f"the recordings have different sensors ({told}): put those with the same into one case")
