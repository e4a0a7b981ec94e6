"""Reading of foreign formats in a separate process: a damaged file can crash that process and nothing else.

The readers of MAT and HDF5 files can crash or run forever on damaged files, which cannot be caught in one process.
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
from lostmotion.recording.folders import list_parts
from lostmotion.recording.table import Table

try:
    import resource
except ImportError:  # not a Unix system: there only the time of a reader is limited
    resource = None  # type: ignore[assignment]

ALONE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""The environment variables that limit a process to one core."""
REFUSED = 3
"""Exit status of the reader when it has written a message for the user."""
SECONDS, SPEED, MEMORY = 7, 4 * 2**20, 2 * 2**30
"""Limits of the reader: processor time (s), one more second for this many bytes, and address space (bytes)."""
WALL = 600
"""Limit of the elapsed time (s) of the reader."""
SLAB = 2**26
"""Bytes that are read at once where the values are only checked."""
_HEAD = "head"
_READER = (
    "import sys; from pathlib import Path; from lostmotion.recording.subprocess_reader import main; "
    "sys.exit(main(sys.argv[1], Path(sys.argv[2])))"
)
"""The program of the reader. It is run with -P, so that no module beside a recording can be imported."""


def read_in_subprocess(path: Path) -> Table:
    """Return the table of a file, read in another process; `DataError` if that fails."""
    return _unpack_table(_reader_output(path, "columns"))


def walk_in_subprocess(path: Path) -> None:
    """Read all of an HDF5 file in another process as a check; `DataError` if it crashes or does not end."""
    _reader_output(path, "walk")


def _reader_output(path: Path, what: str) -> bytes:
    """Return the standard output of the reader."""
    line = [sys.executable, "-P", "-c", _READER, what, str(Path(path).absolute())]
    try:
        done = subprocess.run(line, capture_output=True, env={**os.environ, **ALONE}, timeout=WALL, check=False)
    except subprocess.TimeoutExpired as err:
        raise _make_error(path, f"no end within {WALL} s") from err
    if done.returncode == 0:
        return done.stdout
    if done.returncode == REFUSED:
        raise DataError(done.stderr.decode("utf-8", "replace"))
    if done.returncode < 0:
        number = -done.returncode
        why = (
            "it takes too long"
            if number == getattr(signal, "SIGXCPU", None)
            else f"its reader was killed by {signal.Signals(number).name}"
        )
        raise _make_error(path, why)
    said = done.stderr.decode("utf-8", "replace").strip().splitlines()
    raise _make_error(path, said[-1][:120] if said else f"its reader ended with {done.returncode}")


def _make_error(path: Path, why: str) -> DataError:
    ending = path.suffix[1:].lower()
    return DataError(
        f"{path.name} cannot be read as {ending} ({why}): it may be damaged or of another format; export it again, for "
        "instance as csv"
    )


def _pack_table(table: Table) -> bytes:
    out = io.BytesIO()
    kept: dict[int, int] = {}  # a column with a second name is written once
    places = [kept.setdefault(id(column), len(kept)) for column in table.columns.values()]
    told = {"units": dict(table.units), "starts": dict(table.starts), "refused": dict(table.refused)}
    head = json.dumps({"columns": list(table.columns), "places": places, "line": table.line, **told})
    held: dict[str, Any] = {f"column_{i}": c for i, c in zip(places, table.columns.values(), strict=True)}
    held[_HEAD] = np.frombuffer(head.encode(), dtype=np.uint8)
    np.savez(out, **held)
    return out.getvalue()


def _unpack_table(raw: bytes) -> Table:
    with np.load(io.BytesIO(raw), allow_pickle=False) as archive:
        head = json.loads(archive[_HEAD].tobytes())
        arrays = {place: archive[f"column_{place}"] for place in set(head["places"])}
    columns = {name: arrays[place] for name, place in zip(head["columns"], head["places"], strict=True)}
    return Table(columns, head["units"], head["starts"], head["refused"], head["line"])


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


def _read_columns(path: Path) -> bytes:
    from lostmotion.recording.formats import table_of

    return _pack_table(table_of(path))


def main(what: str, path: Path) -> int:
    """Return the exit status of the reader; it writes the columns to standard output, or nothing after a walk."""
    try:
        _limit_resources(path)
        raw = _walk_file(path) if what == "walk" else _read_columns(path)
    except DataError as err:
        sys.stderr.write(str(err))
        return REFUSED
    sys.stdout.buffer.write(raw)
    return 0
