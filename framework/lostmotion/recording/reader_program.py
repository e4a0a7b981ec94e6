"""The program that `subprocess_reader` runs in a process of its own, with limits of time and memory."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from lostmotion.errors import DataError
from lostmotion.recording.folders import list_parts
from lostmotion.recording.formats import table_of
from lostmotion.recording.subprocess_reader import REFUSED, pack_table

try:
    import resource
except ImportError:  # not a Unix system: there only the time of a reader is limited
    resource = None  # type: ignore[assignment]

SECONDS, SPEED, MEMORY = 7, 4 * 2**20, 2 * 2**30
"""Limits of the reader: processor time (s), one more second for this many bytes, and address space (bytes)."""
SLAB = 2**26
"""Bytes that are read at once where the values are only checked."""


def _limit_resources(path: Path) -> None:
    """Limit processor time and memory of this process from now on, where the system supports it."""
    if resource is None:
        return
    used = resource.getrusage(resource.RUSAGE_SELF)
    size = sum(part.stat().st_size for part in list_parts(path))
    seconds = int(used.ru_utime + used.ru_stime) + SECONDS + size // SPEED
    for what, most in ((resource.RLIMIT_CPU, seconds), (resource.RLIMIT_AS, MEMORY), (resource.RLIMIT_CORE, 0)):
        _, hard = resource.getrlimit(what)
        resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))


def _walk_file(path: Path) -> bytes:
    """Read every number and attribute of an HDF5 file; return no bytes."""
    import h5py

    def read(_: str, item: Any) -> None:
        dict(item.attrs)
        if isinstance(item, h5py.Dataset) and item.shape:
            rows = max(1, SLAB // max(1, item.nbytes // max(1, len(item))))
            for first in range(0, len(item), rows):
                item[first : first + rows]

    with h5py.File(path, "r") as file:
        file.visititems(read)
    return b""


def main(what: str, path: Path) -> int:
    """Return the exit status of the reader; it writes the columns to standard output, or nothing after a walk."""
    try:
        _limit_resources(path)
        raw = _walk_file(path) if what == "walk" else pack_table(table_of(path))
    except DataError as err:
        sys.stderr.write(str(err))
        return REFUSED
    sys.stdout.buffer.write(raw)
    return 0
