"""Atomic writing of files: a file is complete or absent. This is the only module that uses xarray's writers."""

from __future__ import annotations

import errno
import glob
import io
import json
import math
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from lostmotion.codec import from_plain
from lostmotion.errors import DataError, LostMotionError, PlaceError

try:
    import fcntl
except ImportError:  # not a Unix system
    fcntl = None  # type: ignore[assignment]

if TYPE_CHECKING:
    import xarray as xr

T = TypeVar("T")
ENDINGS = (".csv", ".nc")
"""The file name endings of a table, which select its format."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""The system errors for a full disk, an exhausted quota and a file beyond the size limit."""


def save_table(
    path: Path, columns: Mapping[str, NDArray[np.float64]], units: Mapping[str, str], attrs: Mapping[str, str]
) -> None:
    """Write `columns`, each (rows,), atomically to a .csv or .nc file.

    A netCDF file has the first column as its dimension, `units` as attributes of the variables, and `attrs` as those
    of the file. A CSV file has one header line, and for each number the shortest text that reproduces it exactly.
    """
    require_ending(path)
    if path.suffix == ".nc":
        save_datasets(path, {None: _make_dataset(columns, units, attrs)})
        return
    with whole(path) as temporary:
        _write_csv(temporary, columns)


def require_ending(path: Path) -> None:
    """Raise `DataError` unless `path` ends in .csv or .nc."""
    if path.suffix not in ENDINGS:
        raise DataError(f"{path.name} ends in {path.suffix or 'nothing'!r}: a table is written as .csv or .nc")


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Yield a temporary file beside `path`, which replaces `path` once it is on the disk; an error removes it.

    An existing file stays unchanged until then. Temporary files of processes that were killed are removed.
    """
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    with writing(path):
        _remove_stale(path)
        temporary.unlink(missing_ok=True)  # otherwise a link at this place would be followed
        try:
            yield temporary
            _sync(temporary)
            temporary.replace(path)
            _sync(path.parent)
        finally:
            temporary.unlink(missing_ok=True)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn system errors while `path` is written into a `PlaceError`, with its own message for a full disk."""
    try:
        yield
    except (OSError, RuntimeError) as err:
        number = _error_number(err)
        if isinstance(err, RuntimeError) and number is None:
            raise
        if number in FULL:
            raise PlaceError(
                f"{path} cannot be written, because there is no space left on its disk ({os.strerror(number)}): free "
                "some space and run the same command again; existing files are unchanged"
            ) from err
        said = os.strerror(number) if number else str(err).partition("\n")[0]
        raise PlaceError(f"{path} cannot be written ({said}): choose another place") from err


def _error_number(err: OSError | RuntimeError) -> int | None:
    """Return the number of a system error; HDF5 gives it only in its message when it closes a file."""
    match = re.search(r"errno = (\d+)", str(err))
    return getattr(err, "errno", None) or (int(match[1]) if match else None)


def _remove_stale(path: Path) -> None:
    """Remove the temporary files of processes that have ended."""
    for temporary in path.parent.glob(f".{glob.escape(path.stem)}.*{glob.escape(path.suffix)}"):
        number = temporary.name[len(path.stem) + 2 : len(temporary.name) - len(path.suffix)]
        if number.isdecimal() and not _is_running(int(number)):
            temporary.unlink(missing_ok=True)


def _is_running(process: int) -> bool:
    if os.name == "nt":  # on Windows os.kill with signal 0 would end the process
        return True
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


@contextmanager
def held(place: Path) -> Iterator[None]:
    """Lock a folder or file for this process; the lock ends with the process, however that ends.

    `DataError` is raised where another process has the lock. On a system without `fcntl` nothing is locked.
    """
    if fcntl is None:
        yield
        return
    handle = os.open(place, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError as err:
        raise DataError(f"{place} is being written by another run: wait for it, or stop it") from err
    finally:
        os.close(handle)


def _sync(path: Path) -> None:
    """Write a file or folder through to the disk; Windows cannot do this for a folder."""
    if os.name == "nt" and path.is_dir():
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _write_csv(path: Path, columns: Mapping[str, NDArray[np.float64]]) -> None:
    rows = zip(*(np.asarray(c, dtype=float).tolist() for c in columns.values()), strict=True)
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(",".join(columns) + "\n")
        stream.writelines(",".join(map(repr, row)) + "\n" for row in rows)


def _make_dataset(
    columns: Mapping[str, NDArray[np.float64]], units: Mapping[str, str], attrs: Mapping[str, str]
) -> xr.Dataset:
    import xarray

    index, *rest = columns
    table = {name: (index, columns[name], {"units": units[name]}) for name in rest}
    axis = {index: (index, columns[index], {"units": units[index]})}
    return xarray.Dataset(table, coords=axis, attrs=dict(attrs))


def save_datasets(
    path: Path, groups: Mapping[str | None, xr.Dataset], attrs: Mapping[str, object] | None = None
) -> None:
    """Write datasets atomically to the groups of a netCDF file (None is its root).

    The file is first made in memory: after a full disk during writing, HDF5 would crash the process at its end.
    """
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    memory = io.BytesIO()
    with h5netcdf.File(memory, "w") as file:
        file.attrs.update(attrs or {})
        for name, dataset in groups.items():
            dataset.dump_to_store(H5NetCDFStore(file, group=name, mode="a"))
    save_bytes(path, memory.getvalue())


def save_json(path: Path, content: Mapping[str, object]) -> None:
    """Write `content` atomically as JSON; numbers that are not finite become null."""
    with whole(path) as temporary:
        temporary.write_text(
            json.dumps(finite(content), indent=2, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8"
        )


def finite(value: object) -> object:
    """Return a nested value as plain JSON values: numbers that are not finite become None, arrays become lists."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(k): finite(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [finite(v) for v in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


@dataclass(frozen=True)
class StoredArray:
    """An array to be stored: dimensions, values, SI unit and description (`long_name`); empty texts are not written."""

    dims: tuple[str, ...]
    values: object
    unit: str = ""
    long_name: str = ""


def dataset_of(
    arrays: Mapping[str, StoredArray], coords: Mapping[str, StoredArray], attrs: Mapping[str, str]
) -> xr.Dataset:
    """Return arrays with their dimensions and units as a dataset."""
    import xarray

    def as_variables(table: Mapping[str, StoredArray]) -> dict[str, tuple[tuple[str, ...], object, dict[str, str]]]:
        texts = {k: {"units": c.unit, "long_name": c.long_name} for k, c in table.items()}
        return {k: (c.dims, c.values, {a: v for a, v in texts[k].items() if v}) for k, c in table.items()}

    return xarray.Dataset(as_variables(arrays), as_variables(coords), dict(attrs))


def save_arrays(
    path: Path, arrays: Mapping[str, StoredArray], coords: Mapping[str, StoredArray], attrs: Mapping[str, str]
) -> None:
    """Write arrays with their dimensions and units atomically to a netCDF file."""
    save_datasets(path, {None: dataset_of(arrays, coords, attrs)})


def folder_for(path: Path) -> Path:
    """Return the folder `path`, created where it is missing; raise `PlaceError` at once if it cannot be written."""
    with writing(path):
        path.mkdir(parents=True, exist_ok=True)
        probe = path / f".probe.{os.getpid()}"
        probe.touch()
        probe.unlink()
    return path


def save_text(path: Path, text: str) -> Path:
    """Return `path` after writing the text to it atomically."""
    with whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path


def save_bytes(path: Path, content: bytes) -> Path:
    """Return `path` after writing the bytes to it atomically."""
    with whole(path) as temporary:
        temporary.write_bytes(content)
    return path


def require_files(folder: Path, names: Iterable[str], command: str) -> None:
    """Raise `DataError` where a folder lacks one of the files `names`, which the `command` writes."""
    missing = [name for name in names if not (folder / name).is_file()]
    if missing:
        raise DataError(f"no {missing[0]} in {folder}: run `{command} --out {folder}` first")


def load_json(path: Path, wanted: str) -> dict[str, Any]:
    """Return the object in a JSON file; `wanted` ends the message of the `DataError` for anything else."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except OSError as err:
        raise DataError(f"{path} cannot be read ({err.strerror}): {wanted}") from err
    except (ValueError, RecursionError) as err:
        raise DataError(f"{path} is not JSON, or damaged ({str(err).partition(chr(10))[0]}): {wanted}") from err
    if not isinstance(found, dict):
        raise DataError(f"{path} holds a {type(found).__name__}, not an object: {wanted}")
    return found


def load_result(kind: type[T], path: Path, wanted: str) -> T:
    """Return the result of type `kind` in a JSON file; `wanted` ends the message of the `DataError` otherwise."""
    plain = load_json(path, wanted)
    try:
        return from_plain(kind, plain, str(path))
    except DataError as err:
        raise DataError(f"{err}: {wanted}") from err


def load_arrays(path: Path, wanted: str, group: str | None = None) -> xr.Dataset:
    """Return a netCDF result in memory; `wanted` ends the message of the `DataError` for a damaged file."""
    import xarray

    from lostmotion.recording.unpacked import RESULT, check_hdf5

    try:
        check_hdf5(path, RESULT)
        return xarray.load_dataset(path, group=group, engine="h5netcdf")
    except LostMotionError:
        raise
    except Exception as err:  # HDF5 and its readers raise many types of error
        said = str(err).partition("\n")[0][:120]
        raise DataError(f"{path} cannot be read, or is damaged ({said}): {wanted}") from err
