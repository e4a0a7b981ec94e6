"""The content of a case file: the paths in it, the Python files that it runs, its recordings in words."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

from lostmotion.simulators import INVERSE

Content = dict[str, Any]
_VALUE_GUESSED = re.compile(r"(\w+) is [-+.\de]+: ")


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


def list_channels(content: Content, column: str) -> list[dict[str, Any]]:
    """Return the entries of the inputs and sensors that read a column, in all recordings."""
    found = []
    for recording in content["recordings"]:
        single = [recording[key] for key in ("excitation", "response") if isinstance(recording.get(key), Mapping)]
        found += [*recording.get("inputs", ()), *recording.get("sensors", ()), *single]
    return [channel for channel in found if channel["column"] == column]


def multiply_column(content: Content, column: str, factor: float) -> Content:
    """Return a content with the values of a column multiplied by a further factor, in all recordings."""
    changed = deepcopy(content)
    for channel in list_channels(changed, column):
        channel["factor"] = float(f"{float(channel.get('factor', 1.0)) * factor:.12g}")
    return changed


def find_guessed_value(says: str) -> str:
    """Return the parameter whose value a sentence of a first case supposes; empty for other sentences."""
    named = _VALUE_GUESSED.match(says)
    return named[1] if named else ""


def drop_value_guess(content: Content, parameter: str) -> None:
    """Remove the sentence that the value of a parameter was supposed: the user has given it."""
    kept = [says for says in content.pop("guessed", ()) if find_guessed_value(says) != parameter]
    if kept:
        content["guessed"] = kept
