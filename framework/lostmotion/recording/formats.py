"""Reading of the columns of a file in any supported format; third-party readers are imported only when needed."""

from __future__ import annotations

import warnings
import zipfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.recording.limits import TEXT, check_bytes
from lostmotion.recording.subprocess_reader import read_in_subprocess
from lostmotion.recording.table import Table, make_table
from lostmotion.recording.text import read_text
from lostmotion.recording.unpacked import check_hdf5, check_mat, check_npz

Array = NDArray[np.float64]
KINDS = "fiub"
"""NumPy kinds of numbers in a column: real, integer, boolean."""


def read_columns(path: Path) -> dict[str, Array]:
    """Return the numeric columns of a file by name, each (n,); foreign formats are read in another process."""
    return dict(read_table(path).columns)


def read_table(path: Path) -> Table:
    """Return the table of a file as `table_of` does; foreign formats are read in another process."""
    path = Path(path)
    if _find_reader(path) in (read_text, _read_npz):
        return table_of(path)
    _require_file(path)
    return read_in_subprocess(path)


def columns_of(path: Path) -> dict[str, Array]:
    """Return the numeric columns of a file by name, each (n,), read in this process."""
    return dict(table_of(path).columns)


def table_of(path: Path) -> Table:
    """Return the numeric columns of a file by name, each (n,), with units where the file gives them.

    Single numbers are left out. A two-dimensional array `a` becomes `a[0]`, `a[1]`, ..., with time along the longer
    axis. A field `b` of a structure or group `a` is named `a.b` (MAT) or `a/b` (netCDF, HDF5). A function in UFF has
    its first id line as name, where that is unique, and its number among the functions: `58[0]`.
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
    if not table.columns:
        raise DataError(f"{path.name} holds no column of numbers: expected at least one series of samples")
    return table


def is_recording(path: str | Path) -> bool:
    """Return whether the ending of a file is that of a recording, and not of a case."""
    return Path(path).suffix[1:].lower() in ENDINGS


def _find_reader(path: Path) -> Callable[[Path], Table]:
    ending = path.suffix[1:].lower()
    if ending not in ENDINGS:
        raise DataError(
            f"{path.name} ends in {ending!r}: expected one of {', '.join(ENDINGS)}; export it for instance as csv"
        )
    return ENDINGS[ending]


def _require_file(path: Path) -> None:
    try:
        _check_place(path)
    except (OSError, ValueError) as err:
        raise DataError(f"{path.name[:80]} cannot be read ({_first_line(err)}): correct the name") from err


def _check_place(path: Path) -> None:
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
        return _make_table({name: _read_member(archive, name, path) for name in archive.files})


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
    return _make_table({k: v for k, v in content.items() if not k.startswith("__")})


def _read_nc(path: Path) -> Table:
    import xarray as xr

    with path.open("rb") as raw:
        classic = raw.read(3) == b"CDF"
    if classic:  # netCDF 3 has no groups
        with xr.open_dataset(path, engine="scipy", decode_times=False) as data:
            return _make_table(
                {str(n): v.values for n, v in data.variables.items()},
                {str(n): _unit_of(v.attrs) for n, v in data.variables.items()},
            )
    check_hdf5(path)
    groups = xr.open_groups(path, engine="h5netcdf", decode_times=False)
    try:
        held = {_path_in_file(g, n): v for g, data in groups.items() for n, v in data.variables.items()}
        found = {name: v.values for name, v in held.items()}
        units = {name: _unit_of(v.attrs) for name, v in held.items()}
    finally:
        for data in groups.values():
            data.close()
    return _make_table(found, units)


def _path_in_file(group: str, name: object) -> str:
    return f"{group.strip('/')}/{name}".lstrip("/")


def _read_h5(path: Path) -> Table:
    import h5py

    check_hdf5(path)
    with h5py.File(path, "r") as file:
        if "_NCProperties" not in file.attrs:
            held: dict[str, Any] = {}  # data sets of h5py, which has no types
            file.visititems(lambda name, item: held.update({name: item} if _is_numeric(item) else {}))
            units = {name: _unit_of(item.attrs) for name, item in held.items()}
            return _make_table({name: item[()] for name, item in held.items()}, units)
    return _read_nc(path)


def _is_numeric(item: Any) -> bool:
    return getattr(item, "dtype", None) is not None and item.dtype.kind in KINDS


def _read_uff(path: Path) -> Table:
    import pyuff

    check_bytes(path.stat().st_size, path.name, TEXT)
    with path.open("rb") as raw:
        if sum(line.rstrip() == b"    -1" for line in raw) % 2:  # pyuff skips a set without an end silently
            raise DataError(f"{path.name}: the last data set has no end: the file is incomplete, export it again")
    file = pyuff.UFF(str(path))
    numbers = [i for i, kind in enumerate(file.get_set_types()) if int(kind) == 58]
    sets = [file.read_sets(i) for i in numbers]
    found = {f"58[{k}]": s["data"] for k, s in enumerate(sets)}
    ids = [str(s.get("id1") or "").strip() for s in sets]
    units = {f"58[{k}]": str(s.get("ordinate_axis_units_lab") or "").strip() for k, s in enumerate(sets)}
    for k, (name, s) in enumerate(zip(ids, sets, strict=True)):
        if name and ids.count(name) == 1:
            found[name], units[name] = s["data"], units[f"58[{k}]"]
    if sets and "time" not in found and all(np.array_equal(s["x"], sets[0]["x"]) for s in sets):
        found["time"] = sets[0]["x"]
        units["time"] = str(sets[0].get("abscissa_axis_units_lab") or "").strip()
    return _make_table(found, {name: unit for name, unit in units.items() if unit.upper() != "NONE"})


def _unit_of(attributes: Any) -> str:
    """Return the unit in the attributes of an array, or an empty text."""
    unit = attributes.get("units", attributes.get("unit", ""))
    word = unit.decode("utf-8", "replace") if isinstance(unit, bytes) else unit
    return word.strip() if isinstance(word, str) else ""


def _make_table(content: Mapping[str, object], units: Mapping[str, str] | None = None) -> Table:
    """Return the table of some arrays; the unit of a two-dimensional array is that of its columns."""
    columns = dict(_flatten_all(content))
    known = {name: (units or {}).get(name) or (units or {}).get(name.rpartition("[")[0], "") for name in columns}
    return make_table(columns, known)


def _flatten_all(content: Mapping[str, object]) -> Iterator[tuple[str, Array]]:
    for name, value in content.items():
        yield from _flatten(name, value)


def _flatten(name: str, value: Any) -> Iterator[tuple[str, Array]]:
    if isinstance(value, Mapping):
        yield from _flatten_all({f"{name}.{key}": item for key, item in value.items()})
    elif isinstance(value, (list, tuple)) and any(np.ndim(item) for item in value if not isinstance(item, Mapping)):
        yield from _flatten_all({f"{name}[{i}]": item for i, item in enumerate(value)})
    elif not isinstance(value, (str, bytes)):
        yield from _list_series(name, np.squeeze(np.asarray(value)))


def _list_series(name: str, array: NDArray[Any]) -> Iterator[tuple[str, Array]]:
    if array.dtype.kind not in KINDS:
        return
    if array.ndim == 1:
        yield name, array.astype(np.float64)
    elif array.ndim == 2:
        rows = array if array.shape[0] < array.shape[1] else array.T
        yield from ((f"{name}[{i}]", row.astype(np.float64)) for i, row in enumerate(rows))


ENDINGS: Mapping[str, Callable[[Path], Table]] = {
    "csv": read_text,
    "tsv": read_text,
    "txt": read_text,
    "lvm": read_text,
    "npz": _read_npz,
    "mat": _read_mat,
    "nc": _read_nc,
    "h5": _read_h5,
    "hdf5": _read_h5,
    "uff": _read_uff,
    "unv": _read_uff,
}
"""The supported file name endings, with their readers."""
