"""A small writer of TOML: what a case needs and no more."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any


def dump_case(case: Mapping[str, Any], path: Path) -> None:
    """Write a case, given as the nested dictionaries that its TOML stands for, to the file `path`."""
    Path(path).write_text("\n".join(_table(case, ())).lstrip("\n") + "\n", encoding="utf-8")


def _table(content: Mapping[str, Any], place: tuple[str, ...]) -> Iterator[str]:
    """Yield the lines of a table: values first, then lists of tables, then tables; below `[a.b]` all is inline."""
    heads = {k: v for k, v in content.items() if isinstance(v, Mapping) and len(place) < 2}
    lists = {k: v for k, v in content.items() if not place and _is_tables(v)}
    yield from _values({k: v for k, v in content.items() if k not in heads and k not in lists})
    for key, entries in lists.items():
        for entry in entries:
            yield f"\n[[{_key(key)}]]"
            yield from _values(entry)
    for key, inner in heads.items():
        yield f"\n[{'.'.join(map(_key, (*place, key)))}]"
        yield from _table(inner, (*place, key))


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and bool(value) and all(isinstance(v, Mapping) for v in value)


def _values(content: Mapping[str, Any]) -> Iterator[str]:
    for key, value in content.items():
        if value is not None:
            yield f"{_key(key)} = {_value(value)}"


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key)


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, Path)):
        return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, int):
        return str(value)
    return repr(float(value))
