"""The inputs and sensors of a recording in a case: in the short form of one pair, or as lists."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from lostmotion.case.fields import Fields
from lostmotion.errors import CaseError, DataError
from lostmotion.quantities import names_quantity, quantity_of, si_factor
from lostmotion.recording.spec import EXCITATIONS, RESPONSES, Channel

CHANNEL = ("column", "quantity", "unit", "factor")
INPUT = ("input", "column", "unit", "factor")
SENSOR = ("channel", "column", "unit", "factor", "name", "noise", "differences", "zero")
SEPARATORS = "[]:/@."
"""Characters that a name must not contain, because they separate the parts of keys."""
FREE = "none"
"""The word in place of an excitation where nothing drives the machine."""


def inputs_of(fields: Fields) -> tuple[Channel, ...]:
    """Return the inputs of a recording, each once; none in a free decay."""
    _check_form(fields, "excitation", "inputs", "[] where nothing drives the machine")
    if "inputs" not in fields.values:
        return () if fields.values["excitation"] == FREE else (_read_pair(fields, "excitation", EXCITATIONS),)
    found = tuple(_read_input(entry) for entry in fields.entries("inputs"))
    if twice := [name for name, count in Counter(c.target for c in found).items() if count > 1]:
        raise fields.error(f"has the input {twice[0]!r} twice: give each input once")
    return found


def sensors_of(fields: Fields) -> tuple[Channel, ...]:
    """Return the sensors of a recording: one without a name, or several with unique names."""
    _check_form(fields, "response", "sensors", "a list of sensors")
    if "sensors" not in fields.values:
        return (_read_pair(fields, "response", RESPONSES),)
    found = tuple(_read_sensor(entry) for entry in fields.entries("sensors"))
    if not found:
        raise fields.error("has sensors = []: at least one sensor is needed")
    given = Counter(sensor.name for sensor in found if sensor.name)
    if twice := [name for name, count in given.items() if count > 1]:
        raise fields.error(f"has two sensors named {twice[0]!r}: give each its own name")
    return tuple(_fill_names(found, set(given)))


def _check_form(fields: Fields, short: str, long: str, empty: str) -> None:
    """Raise `CaseError` for a recording with both the short and the long form, or with neither."""
    if short in fields.values and long in fields.values:
        raise fields.error(f"has both {short} and {long}: give one of them")
    if short not in fields.values and long not in fields.values:
        raise fields.error(f"lacks {short!r}: add a table, or {long} = {empty}")


def _read_pair(fields: Fields, key: str, quantities: tuple[str, ...]) -> Channel:
    table = fields.table(key).only(CHANNEL)
    return _check_unit(table, Channel(table.text("column"), table.choice("quantity", quantities), table.text("unit")))


def _read_input(table: Fields) -> Channel:
    table.only(INPUT)
    name = table.text("input")
    return _check_unit(
        table, Channel(table.text("column"), _read_quantity(table, "input"), table.text("unit"), of=_model_name(name))
    )


def _model_name(name: str) -> str:
    """Return the name of an input or a channel in a model, where a torque counts as the force of a rotation."""
    return f"{name.removesuffix('torque')}force" if name.endswith("torque") else name


def _read_quantity(table: Fields, key: str) -> str:
    try:
        found = quantity_of(table.text(key))
        if key == "input" and not names_quantity(table.text(key)):
            raise DataError(f"{table.values[key]!r} ends in none of {', '.join(EXCITATIONS)}")
    except DataError as err:
        raise table.error(f"has a wrong {key}: {err}") from err
    return "base_position" if table.values[key] == "base_position" else found


def _read_sensor(table: Fields) -> Channel:
    table.only(SENSOR)
    channel, name = table.text("channel"), table.maybe_text("name") or ""
    if bad := [char for char in SEPARATORS if char in name]:
        raise table.error(f"has the name {name!r} with {bad[0]!r} in it: expected one without {' '.join(SEPARATORS)}")
    noise = table.maybe_text("noise") or "white"
    made = Channel(table.text("column"), _read_quantity(table, "channel"), table.text("unit"), of=_model_name(channel))
    summed = table.flag("differences")
    loose = summed or (table.choice("zero", ("known", "unknown")) if "zero" in table.values else "known") == "unknown"
    if summed and made.quantity != "position":
        raise table.error(f"has differences of a {made.quantity}: only changes of a position are summed")
    return _check_unit(table, replace(made, name=name, noise=noise, differences=summed, loose=loose))


def _check_unit(table: Fields, channel: Channel) -> Channel:
    """Return a channel with its factor; raise `CaseError` for a unit of another quantity."""
    factor = table.maybe_number("factor")
    if factor == 0:
        raise table.wrong("factor", "a number other than zero")
    try:
        si_factor(channel.unit, channel.quantity)
    except DataError as err:
        raise table.error(f"has a wrong unit: {err}") from err
    return replace(channel, factor=1.0 if factor is None else factor)


def _fill_names(sensors: tuple[Channel, ...], taken: set[str]) -> Iterator[Channel]:
    """Yield the sensors; one without a name gets that of its channel, with a number where it is used already."""
    for sensor in sensors:
        plain = sensor.name or sensor.target.replace(".", " ")
        name, k = plain, 1
        while not sensor.name and name in taken:
            k += 1
            name = f"{plain} {k}"
        taken.add(name)
        yield replace(sensor, name=name)


def check_same_sensors(recordings: tuple[tuple[Channel, ...], ...]) -> None:
    """Raise `CaseError` where recordings have different sensors: a fit has one noise level for each sensor name."""
    first = recordings[0]
    for other in recordings[1:]:
        if [(s.target, s.name) for s in other] != [(s.target, s.name) for s in first]:
            lists = " and ".join(", ".join(s.name or s.target for s in one) for one in (first, other))
            raise CaseError(f"the recordings have different sensors ({lists}): put those with the same into one case")
