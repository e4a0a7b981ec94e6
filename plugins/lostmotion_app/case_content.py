"""The content of a case file: the paths in it, the Python files that it runs, its recordings in words."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

from lostmotion.simulators import INVERSE


def move_paths(content: Mapping[str, Any], before: Path, after: Path, simulators: Collection[str]) -> dict[str, Any]:
    """Return a content whose paths are relative to the folder `after`, and not to `before`; both are absolute.

    `simulators` are the keys of a model that name a file.
    """
    moved: dict[str, Any] = deepcopy(dict(content))

    def move(path: str) -> str:
        return Path(os.path.relpath(before / path, after)).as_posix()

    for entry in moved.get("recordings", ()):
        entry["file"] = move(entry["file"])
    if plugins := moved.get("plugins"):
        moved["plugins"] = [move(one) for one in plugins]
    model = moved.get("model", {})
    for key in {INVERSE, *simulators} & model.keys():
        file, mark, function = str(model[key]).partition(":")
        model[key] = move(file) + mark + function
    return moved


def list_code(content: Mapping[str, Any]) -> list[str]:
    """Return the Python files that a case runs."""
    inverse = content.get("model", {}).get(INVERSE)
    return [*content.get("plugins", ()), *([str(inverse).partition(":")[0]] if inverse else [])]


def list_recordings(content: Mapping[str, Any]) -> Iterator[list[str]]:
    """Yield file, drives and sensors of each recording."""
    for entry in content.get("recordings", ()):
        drives = [*entry.get("inputs", ()), *([entry["excitation"]] if "excitation" in entry else [])]
        sensors = [*entry.get("sensors", ()), *([entry["response"]] if "response" in entry else [])]
        yield [str(entry.get("file", "")), *(", ".join(map(_name_channel, one)) for one in (drives, sensors))]


def _name_channel(channel: Mapping[str, Any]) -> str:
    """Return the column of a channel with its unit."""
    unit = f" ({channel['unit']})" if "unit" in channel else ""
    return f"{channel.get('column', '')}{unit}"
