"""Reading of the columns of a file: some formats are read here, others by readers that packages offer by ending."""

from __future__ import annotations

import time
import warnings
import zipfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.recording.folders import is_bag_folder, list_parts
from lostmotion.recording.limits import check_bytes, check_numbers
from lostmotion.recording.nested import KINDS, table_of_nested
from lostmotion.recording.offered import find_offered, offered_readers
from lostmotion.recording.subprocess_reader import read_in_subprocess
from lostmotion.recording.table import Table
from lostmotion.recording.text import read_text
from lostmotion.recording.unpacked import check_hdf5, check_mat, check_npz

Array = NDArray[np.float64]
Reader = Callable[[Path], Table]
PACKING = ("_FillValue", "missing_value", "scale_factor", "add_offset")
"""The attributes that say how readings are stored (CF conventions)."""
MOST_KEPT = 2**28
"""The greatest size (bytes) of a table that is kept."""
SETTLED = 2.0
"""Seconds after its last change from which a file is taken as it is."""
BAG = "db3"
"""The ending whose reader takes the folder of a bag of ROS 2, too."""


def read_columns(path: Path) -> dict[str, Array]:
    """Return the numeric columns of a file by name, each (n,); foreign formats are read in another process."""
    return dict(read_table(path).columns)


def read_table(path: Path) -> Table:
    """Return the table of a file as `table_of` does; foreign formats are read in another process.

    The table that was read last is kept: a case, its check and a page read the same file several times.
    """
    path = Path(path)
    reader = _find_reader(path)
    state = _find_state(path, reader)
    if state is None or state not in _LAST:
        _LAST.clear()
        table = _read_file(path, reader)
        if state is None or sum(column.nbytes for column in table.columns.values()) > MOST_KEPT:
            return table
        for column in table.columns.values():
            column.flags.writeable = False
        _LAST[state] = table
    return _LAST[state]


_LAST: dict[tuple[Reader, str, int, int], Table] = {}
"""The table that was read last, by reader, path of the file, time of its last change, and size."""


def _find_state(path: Path, reader: Reader) -> tuple[Reader, str, int, int] | None:
    """Return what changes with the content of a file; None for a folder, and where it was changed just now.

    Two changes within the resolution of the times of a file cannot be told apart.
    """
    with suppress(OSError, ValueError):
        told = path.stat()
        if path.is_file() and time.time() - told.st_mtime > SETTLED:
            return reader, str(path.resolve()), told.st_mtime_ns, told.st_size
    return None


def _read_file(path: Path, reader: Reader) -> Table:
    if reader in (read_text, _read_npz):
        return table_of(path)
    _require_file(path)
    return read_in_subprocess(path)


def table_of(path: Path) -> Table:
    """Return the numeric columns of a file by name, each (n,), with units where the file gives them.

    Single numbers are left out. A two-dimensional array `a` becomes `a[0]`, `a[1]`, ..., with time along the longer
    axis. A field `b` of a structure or group `a` is named `a.b` (MAT) or `a/b` (netCDF, HDF5).
    """
    reader = _find_reader(path)
    try:
        _require_file(path)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            table = reader(path)
    except DataError:
        raise
    except Exception as err:  # readers of foreign formats raise many types of error
        raise DataError(
            f"{path.name} cannot be read as {path.suffix[1:].lower()} ({_first_line(err)}): "
            "it may be incomplete or of another format; export it again, for instance as csv"
        ) from err
    check_numbers(sum(column.size for column in table.columns.values()), path.name)
    if not table.columns:
        raise DataError(f"{path.name} holds no column of numbers: expected at least one series of samples")
    return table


def is_recording(path: str | Path) -> bool:
    """Return whether the ending of a file is that of a recording, and not of a case."""
    ending = Path(path).suffix[1:].lower()
    return is_bag_folder(Path(path)) or ending in ENDINGS or ending in offered_readers()


def _find_reader(path: Path) -> Reader:
    ending = BAG if is_bag_folder(path) else path.suffix[1:].lower()
    if ending in ENDINGS:
        return ENDINGS[ending]
    if reader := find_offered(ending):
        return reader.read
    known = ", ".join((*ENDINGS, *sorted(offered_readers())))
    shown = path.name if path.name.isprintable() else repr(path.name[:80])
    raise DataError(f"{shown} ends in {ending!r}: expected one of {known}; export it for instance as csv")


def _require_file(path: Path) -> None:
    try:
        _check_place(path)
    except (OSError, ValueError) as err:
        raise DataError(f"{path.name[:80]} cannot be read ({_first_line(err)}): correct the name") from err


def _check_place(path: Path) -> None:
    if is_bag_folder(path):
        check_bytes(sum(part.stat().st_size for part in list_parts(path)), path.name)
        return
    if path.is_dir():
        raise DataError(f"{path.name} is a folder: give the recording inside it")
    if not path.exists():
        raise DataError(f"{path.name} does not exist in {path.parent.name or '.'}{_suggest(path)}: correct the name")
    if not path.is_file():
        raise DataError(f"{path.name} is not a regular file: give a file that holds the recording")
    if path.stat().st_size == 0:
        raise DataError(f"{path.name} is empty (0 bytes): record or export it again")
    check_bytes(path.stat().st_size, path.name)


def _suggest(path: Path) -> str:
    return nearest(path.name, sorted(p.name for p in path.parent.iterdir())) if path.parent.is_dir() else ""


def _first_line(err: Exception) -> str:
    return (str(err).splitlines() or [""])[0][:120] or type(err).__name__


def _read_npz(path: Path) -> Table:
    if zipfile.is_zipfile(path):
        check_npz(path)
    archive = np.load(path, allow_pickle=False)
    if not isinstance(archive, np.lib.npyio.NpzFile):
        raise DataError(f"{path.name} holds a single array: expected an archive of named arrays, as np.savez writes it")
    with archive:
        return table_of_nested({name: _read_member(archive, name, path) for name in archive.files})


def _read_member(archive: Any, name: str, path: Path) -> Any:
    try:
        return archive[name]
    except ValueError as err:
        if "allow_pickle" not in str(err):
            raise
        raise DataError(
            f"{path.name}: {name!r} holds Python objects, which could run code when read: save plain numbers"
        ) from err


def _read_mat(path: Path) -> Table:
    import h5py
    import pymatreader

    if h5py.is_hdf5(path):
        with path.open("rb") as raw:
            if raw.read(6) != b"MATLAB":  # an HDF5 file of another program with the ending of MATLAB
                return _read_h5(path)
        check_hdf5(path)
    else:
        check_mat(path)
    content = pymatreader.read_mat(path)
    return table_of_nested({k: v for k, v in content.items() if not k.startswith("__")})


def _read_nc(path: Path) -> Table:
    import xarray as xr

    with path.open("rb") as raw:
        classic = raw.read(3) == b"CDF"
    if classic:  # netCDF 3 has no groups
        with xr.open_dataset(path, engine="scipy", decode_times=False) as data:
            return table_of_nested(
                {str(n): v.values for n, v in data.variables.items()},
                {str(n): _unit_of(v.attrs) for n, v in data.variables.items()},
                data.attrs,
            )
    check_hdf5(path)
    groups = xr.open_groups(path, engine="h5netcdf", decode_times=False)
    try:
        held = {_path_in_file(g, n): v for g, data in groups.items() for n, v in data.variables.items()}
        found = {name: v.values for name, v in held.items()}
        units = {name: _unit_of(v.attrs) for name, v in held.items()}
        told = {key: value for data in groups.values() for key, value in data.attrs.items()}
    finally:
        for data in groups.values():
            data.close()
    return table_of_nested(found, units, told)


def _path_in_file(group: str, name: object) -> str:
    return f"{group.strip('/')}/{name}".lstrip("/")


def _read_h5(path: Path) -> Table:
    import h5py

    check_hdf5(path)
    with h5py.File(path, "r") as file:
        if "_NCProperties" not in file.attrs:
            items: dict[str, Any] = {"": file}  # groups and data sets of h5py, which has no types
            file.visititems(items.__setitem__)
            held = {name: item for name, item in items.items() if _is_numeric(item)}
            units = {name: _unit_of(item.attrs) for name, item in held.items()}
            told = {key: item.attrs[key] for item in items.values() for key in item.attrs}
            return table_of_nested({name: _read_set(item) for name, item in held.items()}, units, told)
    return _read_nc(path)


def _is_numeric(item: Any) -> bool:
    return getattr(item, "dtype", None) is not None and (item.dtype.kind in KINDS or item.dtype.names is not None)


def _read_set(item: Any) -> Any:
    """Return the numbers of a data set of h5py, with fill values as NaN and packed numbers unpacked."""
    import xarray as xr

    given = {key: _plain(item.attrs[key]) for key in PACKING if key in item.attrs}
    if not given or item.dtype.names is not None:
        return item[()]
    held = xr.Variable([f"d{k}" for k in range(item.ndim)], item[()], given)
    return xr.conventions.decode_cf_variable("x", held, decode_times=False).values


def _plain(value: Any) -> Any:
    """Return the only element of an attribute that is an array of one."""
    return np.asarray(value).reshape(-1)[0] if np.size(value) == 1 else value


def _unit_of(attributes: Any) -> str:
    """Return the unit in the attributes of an array, or an empty text."""
    unit = _plain(next((value for key, value in attributes.items() if str(key).lower() in ("units", "unit")), ""))
    word = unit.decode("utf-8", "replace") if isinstance(unit, bytes) else unit
    return word.strip() if isinstance(word, str) else ""


ENDINGS: Mapping[str, Reader] = {
    "csv": read_text,
    "tsv": read_text,
    "txt": read_text,
    "lvm": read_text,
    "npz": _read_npz,
    "mat": _read_mat,
    "nc": _read_nc,
    "h5": _read_h5,
    "hdf5": _read_h5,
}
"""The endings of file names that need no extra, with their readers."""
