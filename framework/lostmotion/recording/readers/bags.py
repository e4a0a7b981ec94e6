"""Logs of robots: MCAP files and bags of ROS. This is the only module that uses mcap and rosbags.

A message becomes one sample of each number in it: `/joint_states.position[0]`. Messages of a topic share the column
`/joint_states.time`, the time (s) since the first message of the file at which they were logged. Where messages have a
header, `/joint_states.header.stamp` is the time of the reading itself, since the first message with a header.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.limits import check_columns, check_numbers
from lostmotion.recording.table import Table

Message = tuple[str, int, Any]
"""Topic, time of the log (ns), content of a message."""
_LONGEST = 64
"""Numbers of one list in a message that are read; a longer list is an image or a cloud of points."""


def read_mcap(path: Path) -> Table:
    """Return the numbers of all messages that are written in JSON or by ROS 2; other messages are left out."""
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    factory = DecoderFactory()

    def decode() -> Iterator[Message]:
        for schema, channel, message in make_reader(stream).iter_messages():
            decoder = factory.decoder_for(channel.message_encoding, schema)
            if decoder is not None:
                yield channel.topic, message.log_time, decoder(message.data)
            elif channel.message_encoding == "json":
                yield channel.topic, message.log_time, json.loads(message.data)

    with path.open("rb") as stream:
        return table_of_messages(decode(), path.name)


def read_bag(path: Path) -> Table:
    """Return the numbers of all messages in a bag of ROS 1, or in the database of a bag of ROS 2."""
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as bag:
        messages = ((one.topic, when, bag.deserialize(raw, one.msgtype)) for one, when, raw in bag.messages())
        return table_of_messages(messages, path.name)


def table_of_messages(messages: Iterable[Message], source: str) -> Table:
    """Return the table of messages in the order of the log; a number that a message lacks is NaN there."""
    times: dict[str, list[int]] = {}
    rows: dict[str, list[dict[str, float]]] = {}
    # stamps are whole nanoseconds until the first one is subtracted: a double resolves 256 ns of a date
    count = 0
    for topic, when, content in messages:
        row = dict(_list_numbers("", content))
        count += len(row)
        check_numbers(count, source)
        times.setdefault(topic, []).append(when)
        rows.setdefault(topic, []).append(row)
    first = min((when[0] for when in times.values()), default=0)
    begin = min((row[_STAMP] for held in rows.values() for row in held if _STAMP in row), default=0)
    columns: dict[str, Any] = {}
    units: dict[str, str] = {}
    for topic, held in rows.items():
        names = dict.fromkeys(name for row in held for name in row)
        if names:
            columns[f"{topic}.time"] = (np.array(times[topic], dtype=np.int64) - first) * 1e-9
        for name in names:
            shift, scale = (begin, 1e-9) if name == _STAMP else (0, 1.0)
            found = [(row[name] - shift) * scale if name in row else np.nan for row in held]
            columns[f"{topic}{name}"] = np.array(found, dtype=float)
        units |= dict.fromkeys((f"{topic}.time", f"{topic}{_STAMP}"), "s")
    check_columns(len(columns), source)
    return table_of_arrays(columns, units)


_STAMP = ".header.stamp"
_HIDDEN = "_"


def _list_numbers(name: str, value: Any) -> Iterator[tuple[str, float]]:
    """Yield each number in a message with its name; a stamp in ns, as one number."""
    if isinstance(value, (bool, int, float, np.number)):
        yield name, float(value)
    elif isinstance(value, Mapping):
        yield from _list_parts(name, value)
    elif isinstance(value, (list, tuple, np.ndarray)):
        for place, item in enumerate(value if len(value) <= _LONGEST else ()):
            yield from _list_numbers(f"{name}[{place}]", item)
    elif not isinstance(value, (str, bytes, bytearray, memoryview)) and value is not None:
        parts = getattr(value, "__dict__", None) or {k: getattr(value, k) for k in getattr(value, "__slots__", ())}
        yield from _list_parts(name, {k: v for k, v in parts.items() if not k.startswith(_HIDDEN)})


def _list_parts(name: str, parts: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    if set(parts) in ({"sec", "nanosec"}, {"sec", "nsec"}):
        yield name, int(parts["sec"]) * 10**9 + int(parts.get("nanosec", parts.get("nsec", 0)))
        return
    for key, item in parts.items():
        yield from _list_numbers(f"{name}.{key}", item)
