"""The origin of a result, without dates and paths: the same inputs give the same bytes."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lostmotion.codec import to_plain
from lostmotion.errors import DataError

if TYPE_CHECKING:
    from lostmotion.results.background import Origin

PACKAGES = ("lostmotion", "numpy", "numba")
"""The packages whose versions may change numerical results."""


def digest(path: Path) -> str:
    """Return the SHA-256 of a file as 64 hexadecimal digits."""
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as err:
        raise DataError(f"{path.name} cannot be read ({err.strerror}): give the path of a file") from err


def origin_of(component: str, settings: Mapping[str, object], seed: int | None, inputs: Mapping[str, str]) -> Origin:
    """Return the origin of a result: component, versions, settings, seed and digests of the inputs.

    `inputs` maps a name, such as that of the file, to its `digest`. Keys are sorted.
    """
    from lostmotion.results.background import (
        Origin,
    )  # imported late: it loads NumPy, which listing plugins does not need

    versions = {"python": platform.python_version(), **{name: _read_version(name) for name in PACKAGES}}
    return Origin(component, versions, _to_plain(settings), seed, _to_plain(inputs))


def provenance(
    component: str, settings: Mapping[str, object], seed: int | None, inputs: Mapping[str, str]
) -> dict[str, Any]:
    """Return the result of `origin_of` as plain values for JSON and netCDF attributes."""
    made: dict[str, Any] = to_plain(origin_of(component, settings, seed, inputs))
    return made


def _read_version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def _to_plain(value: Any) -> Any:
    """Return `value` as plain JSON values; of a path only the name is kept; other types raise `TypeError`."""
    if isinstance(value, Mapping):
        return {str(k): _to_plain(value[k]) for k in sorted(value, key=str)}
    if isinstance(value, (set, frozenset)):
        return sorted(map(_to_plain, value))
    if isinstance(value, (list, tuple)):
        return [_to_plain(v) for v in value]
    if isinstance(value, Path):
        return value.name
    if hasattr(value, "tolist"):
        return value.tolist()
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    raise TypeError(f"a setting of type {type(value).__name__} cannot be recorded: give numbers, text, lists or tables")
