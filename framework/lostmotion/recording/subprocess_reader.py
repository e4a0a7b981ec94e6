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
from lostmotion.recording.table import Table

ALONE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""The environment variables that limit a process to one core."""
REFUSED = 3
"""Exit status of the reader when it has written a message for the user."""
WALL = 600
"""Limit of the elapsed time (s) of the reader."""
_HEAD = "head"
_TOLD = ("units", "starts", "refused", "rates")
_READER = (
    "import sys; from pathlib import Path; from lostmotion.recording.reader_program import main; "
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


def pack_table(table: Table) -> bytes:
    """Return a table as bytes, for `read_in_subprocess`."""
    out = io.BytesIO()
    kept: dict[int, int] = {}  # a column with a second name is written once
    places = [kept.setdefault(id(column), len(kept)) for column in table.columns.values()]
    told = {name: dict(getattr(table, name)) for name in _TOLD}
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
    return Table(columns, line=head["line"], **{name: head[name] for name in _TOLD})
