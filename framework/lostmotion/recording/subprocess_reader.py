"""Foreign formats are read in a process of their own: a damaged file takes down its reader and nothing else.

A MAT file can crash its reader and an HDF5 file send it round in circles; neither can be caught from within.
"""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.errors import DataError
from lostmotion.recording.table import Table

try:
    import resource
except ImportError:  # a system that is not of the family of Unix: its readers have no bounds but the clock
    resource = None  # type: ignore[assignment]

ALONE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""The environment of a process that has one core to itself."""
REFUSED = 3
"""Exit status of the reader when it says why in a sentence."""
SECONDS, SPEED, MEMORY = 7, 4 * 2**20, 2 * 2**30
"""What the reader may take: so much time of a processor and for so many bytes a second more, so much address space."""
WALL = 600
SLAB = 2**26
"""Bytes that are read at a time where nothing is kept."""
_HEAD = "head"
_READER = (
    "import sys; from pathlib import Path; from lostmotion.recording.subprocess_reader import main; "
    "sys.exit(main(sys.argv[1], Path(sys.argv[2])))"
)
"""Run with -P, so that no module that lies beside a recording is taken for one of Python's."""


def read_in_subprocess(path: Path) -> Table:
    """Return the columns of a file by name, each (n,), as another process has read them; `DataError` if it cannot."""
    return _unpacked(_reader_output(path, "columns"))


def walk_in_subprocess(path: Path) -> None:
    """Have another process read all of an HDF5 file first; `DataError` if that crashes, or has no end."""
    _reader_output(path, "walk")


def _reader_output(path: Path, what: str) -> bytes:
    """Return the standard output of the reader."""
    line = [sys.executable, "-P", "-c", _READER, what, str(Path(path).absolute())]
    try:
        done = subprocess.run(line, capture_output=True, env={**os.environ, **ALONE}, timeout=WALL, check=False)
    except subprocess.TimeoutExpired as err:
        raise _given_up(path, f"no end within {WALL} s") from err
    if done.returncode == 0:
        return done.stdout
    if done.returncode == REFUSED:
        raise DataError(done.stderr.decode("utf-8", "replace"))
    if done.returncode < 0:
        number = -done.returncode
        why = (
            "it takes too long"
            if number == getattr(signal, "SIGXCPU", None)
            else f"its reader died of {signal.Signals(number).name}"
        )
        raise _given_up(path, why)
    said = done.stderr.decode("utf-8", "replace").strip().splitlines()
    raise _given_up(path, said[-1][:120] if said else f"its reader ended with {done.returncode}")


def _given_up(path: Path, why: str) -> DataError:
    ending = path.suffix[1:].lower()
    return DataError(
        f"{path.name} cannot be read as {ending} ({why}): it may be damaged or of another format; export it again, for "
        "instance as csv"
    )


def _packed(table: Table) -> bytes:
    out = io.BytesIO()
    head = json.dumps({"columns": list(table.columns), "units": dict(table.units), "starts": dict(table.starts)})
    held: dict[str, Any] = {f"column_{i}": column for i, column in enumerate(table.columns.values())}
    held[_HEAD] = np.frombuffer(head.encode(), dtype=np.uint8)
    np.savez(out, **held)
    return out.getvalue()


def _unpacked(raw: bytes) -> Table:
    with np.load(io.BytesIO(raw), allow_pickle=False) as archive:
        head = json.loads(archive[_HEAD].tobytes())
        columns = {name: archive[f"column_{i}"] for i, name in enumerate(head["columns"])}
    return Table(columns, head["units"], head["starts"])


def _limit(path: Path) -> None:
    """Bound what this process may take from here on, where the system can."""
    if resource is None:
        return
    used = resource.getrusage(resource.RUSAGE_SELF)
    seconds = int(used.ru_utime + used.ru_stime) + SECONDS + path.stat().st_size // SPEED
    for what, most in ((resource.RLIMIT_CPU, seconds), (resource.RLIMIT_AS, MEMORY), (resource.RLIMIT_CORE, 0)):
        _, hard = resource.getrlimit(what)
        resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))


def _walk(path: Path) -> bytes:
    """Return nothing, after reading every number and attribute of an HDF5 file."""
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


def _columns(path: Path) -> bytes:
    from lostmotion.recording.formats import table_of

    return _packed(table_of(path))


def main(what: str, path: Path) -> int:
    """Return the exit status of the reader, whose standard output is the columns, or nothing after a walk."""
    try:
        _limit(path)
        raw = _walk(path) if what == "walk" else _columns(path)
    except DataError as err:
        sys.stderr.write(str(err))
        return REFUSED
    sys.stdout.buffer.write(raw)
    return 0
