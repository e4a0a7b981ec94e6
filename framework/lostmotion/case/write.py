"""A small writer of TOML for the constructs that a case needs."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any


def dump_case(case: Mapping[str, Any], path: Path) -> None:
    """Write a case, given as nested dictionaries with the structure of its TOML, to the file `path`."""
    Path(path).write_text(format_case(case), encoding="utf-8")


def format_case(case: Mapping[str, Any]) -> str:
    """Return a case, given as nested dictionaries with the structure of its TOML, as text."""
    return "\n".join(_write_table(case, ())).lstrip("\n") + "\n"


def _write_table(content: Mapping[str, Any], place: tuple[str, ...]) -> Iterator[str]:
    """Yield the lines of a table: values, lists of tables, tables; below `[a.b]` everything is written inline."""
    heads = {k: v for k, v in content.items() if isinstance(v, Mapping) and len(place) < 2}
    lists = {k: v for k, v in content.items() if not place and _is_tables(v)}
    yield from _write_values({k: v for k, v in content.items() if k not in heads and k not in lists})
    for key, entries in lists.items():
        for entry in entries:
            yield f"\n[[{_format_key(key)}]]"
            yield from _write_values(entry)
    for key, inner in heads.items():
        yield f"\n[{'.'.join(map(_format_key, (*place, key)))}]"
        yield from _write_table(inner, (*place, key))


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and bool(value) and all(isinstance(v, Mapping) for v in value)


def _write_values(content: Mapping[str, Any]) -> Iterator[str]:
    for key, value in content.items():
        if value is not None:
            yield f"{_format_key(key)} = {_format_value(value)}"


def _format_key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key)


def _format_value(value: Any) -> str:
    if isinstance(value, Mapping):
        return (
            "{ " + ", ".join(f"{_format_key(k)} = {_format_value(v)}" for k, v in value.items() if v is not None) + " }"
        )
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_format_value, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, Path)):
        return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, int):
        return str(value)
    return repr(float(value))
