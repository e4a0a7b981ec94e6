"""Files that are whole or not there: tables as CSV or netCDF. The one door to xarray's writers."""

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
except ImportError:  # a system that is not of the family of Unix
    fcntl = None  # type: ignore[assignment]

if TYPE_CHECKING:
    import xarray as xr

T = TypeVar("T")
ENDINGS = (".csv", ".nc")
"""The endings of a table, which tell its format."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""What the system calls a full disk, a used-up share of it, and a file that may not grow."""


def save_table(
    path: Path, columns: Mapping[str, NDArray[np.float64]], units: Mapping[str, str], attrs: Mapping[str, str]
) -> None:
    """Write `columns`, each (rows,), to a .csv or .nc file that appears whole or not at all.

    A netCDF has the first column as its dimension, the `units` on each variable, and `attrs` on the file; a CSV has
    one header line and the shortest text that gives each number back exactly.
    """
    require_ending(path)
    if path.suffix == ".nc":
        save_datasets(path, {None: _dataset(columns, units, attrs)})
        return
    with whole(path) as spare:
        _write_csv(spare, columns)


def require_ending(path: Path) -> None:
    """Raise `DataError` unless the ending of `path` is one that a table can have."""
    if path.suffix not in ENDINGS:
        raise DataError(f"{path.name} ends in {path.suffix or 'nothing'!r}: a table is written as .csv or .nc")


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Yield a spare file beside `path`, which takes its name once it is on the disk, or vanishes after an error.

    What stood there before stays as it was until then. Spare files of processes that were killed are removed.
    """
    spare = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    with writing(path):
        _clear(path)
        spare.unlink(missing_ok=True)  # a link that somebody laid there would be written through
        try:
            yield spare
            _settle(spare)
            spare.replace(path)
            _settle(path.parent)
        finally:
            spare.unlink(missing_ok=True)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn what the system says while `path` is written into a `PlaceError`; a full disk is told as such."""
    try:
        yield
    except (OSError, RuntimeError) as err:
        number = _number_of(err)
        if isinstance(err, RuntimeError) and number is None:
            raise
        if number in FULL:
            raise PlaceError(
                f"{path} cannot be written, for there is no room left on its disk ({os.strerror(number)}): make room "
                "and run the same command again; what stood there before is as it was"
            ) from err
        said = os.strerror(number) if number else str(err).partition("\n")[0]
        raise PlaceError(f"{path} cannot be written ({said}): choose another place") from err


def _number_of(err: OSError | RuntimeError) -> int | None:
    """Return the number of a system error; HDF5 tells it in words when it closes a file."""
    told = re.search(r"errno = (\d+)", str(err))
    return getattr(err, "errno", None) or (int(told[1]) if told else None)


def _clear(path: Path) -> None:
    """Remove the spare files of processes that are no more."""
    for spare in path.parent.glob(f".{glob.escape(path.stem)}.*{glob.escape(path.suffix)}"):
        number = spare.name[len(path.stem) + 2 : len(spare.name) - len(path.suffix)]
        if number.isdecimal() and not _alive(int(number)):
            spare.unlink(missing_ok=True)


def _alive(process: int) -> bool:
    if os.name == "nt":  # there a signal 0 is sent, and ends the process
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
    """Hold a folder or file for this process; the hold ends with the process, however that ends.

    `DataError` where another process has it. A system without such holds goes on without one.
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


def _settle(path: Path) -> None:
    """Wait until a file or folder is on the disk; not every system can open a folder for that."""
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


def _dataset(
    columns: Mapping[str, NDArray[np.float64]], units: Mapping[str, str], attrs: Mapping[str, str]
) -> xr.Dataset:
    import xarray

    index, *rest = columns
    table = {name: (index, columns[name], {"units": units[name]}) for name in rest}
    axis = {index: (index, columns[index], {"units": units[index]})}
    return xarray.Dataset(table, coords=axis, attrs=dict(attrs))


def save_datasets(path: Path, groups: Mapping[str | None, xr.Dataset], attrs: Mapping[str, Any] | None = None) -> None:
    """Write datasets to the groups of a netCDF file (None is its root) that appears whole or not at all.

    The file is made in memory: HDF5 that meets a full disk as it writes brings the process down when it ends.
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
    """Write `content` as JSON that appears whole or not at all; what is not finite becomes null."""
    with whole(path) as spare:
        spare.write_text(
            json.dumps(finite(content), indent=2, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8"
        )


def finite(value: object) -> object:
    """Return a nested value as JSON has it: what is not finite becomes None, and an array a list."""
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
    """An array to be stored: its dimensions, values, SI unit and what it is; what is empty is not written."""

    dims: tuple[str, ...]
    values: object
    unit: str = ""
    long_name: str = ""


def dataset_of(
    arrays: Mapping[str, StoredArray], coords: Mapping[str, StoredArray], attrs: Mapping[str, str]
) -> xr.Dataset:
    """Return arrays with their dimensions and units as a dataset."""
    import xarray

    def laid_out(table: Mapping[str, StoredArray]) -> dict[str, tuple[tuple[str, ...], object, dict[str, str]]]:
        told = {k: {"units": c.unit, "long_name": c.long_name} for k, c in table.items()}
        return {k: (c.dims, c.values, {a: v for a, v in told[k].items() if v}) for k, c in table.items()}

    return xarray.Dataset(laid_out(arrays), laid_out(coords), dict(attrs))


def save_arrays(
    path: Path, arrays: Mapping[str, StoredArray], coords: Mapping[str, StoredArray], attrs: Mapping[str, str]
) -> None:
    """Write arrays with their dimensions and units to a netCDF file that appears whole or not at all."""
    save_datasets(path, {None: dataset_of(arrays, coords, attrs)})


def folder_for(path: Path) -> Path:
    """Return the folder `path`, made if need be; a place that cannot be written is refused before the work begins."""
    with writing(path):
        path.mkdir(parents=True, exist_ok=True)
        probe = path / f".probe.{os.getpid()}"
        probe.touch()
        probe.unlink()
    return path


def save_text(path: Path, text: str) -> Path:
    """Return `path`, with the text in a file that appears whole or not at all."""
    with whole(path) as spare:
        spare.write_text(text, encoding="utf-8")
    return path


def save_bytes(path: Path, content: bytes) -> Path:
    """Return `path`, with the bytes in a file that appears whole or not at all."""
    with whole(path) as spare:
        spare.write_bytes(content)
    return path


def require_files(folder: Path, names: Iterable[str], command: str) -> None:
    """Raise a `DataError` where a file of a folder is missing that the `command` writes."""
    missing = [name for name in names if not (folder / name).is_file()]
    if missing:
        raise DataError(f"no {missing[0]} in {folder}: run `{command} --out {folder}` first")


def load_json(path: Path, wanted: str) -> dict[str, Any]:
    """Return the table that a JSON file holds; `wanted` ends the sentence that refuses anything else."""
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
    """Return the result of a `kind` that a JSON file holds; `wanted` ends the sentence that refuses anything else."""
    plain = load_json(path, wanted)
    try:
        return from_plain(kind, plain, str(path))
    except DataError as err:
        raise DataError(f"{err}: {wanted}") from err


def load_arrays(path: Path, wanted: str, group: str | None = None) -> xr.Dataset:
    """Return what a netCDF of ours holds, in memory; `wanted` ends the sentence that refuses a damaged one."""
    import xarray

    from lostmotion.recording.unpacked import RESULT, check_hdf5

    try:
        check_hdf5(path, RESULT)
        return xarray.load_dataset(path, group=group, engine="h5netcdf")
    except LostMotionError:
        raise
    except Exception as err:  # HDF5 and what reads it fail in every way there is
        said = str(err).partition("\n")[0][:120]
        raise DataError(f"{path} cannot be read, or is damaged ({said}): {wanted}") from err
