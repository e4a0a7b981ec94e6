"""A growing map on the disk: a zarr store whose chunks are complete or absent, written by one process at a time.

`status` is written last in each chunk, so a chunk is complete when its `status` file exists. No other module uses zarr.
"""

from __future__ import annotations

import json
import shutil
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
import zarr
from numpy.typing import NDArray

from lostmotion.codec import to_plain
from lostmotion.errors import DataError
from lostmotion.recording.limits import check_bytes
from lostmotion.recording.subprocess_reader import walk_in_subprocess
from lostmotion.recording.unpacked import RESULT, check_hdf5
from lostmotion.results.background import Origin
from lostmotion.storage import held, save_datasets, writing
from lostmotion_chaos.maps.cells import Columns
from lostmotion_chaos.maps.layout import SCHEMA, MapLayout, read_origin

SUFFIXES = (".zarr", ".nc")
"""The file suffixes of a map, which select its format."""
_LAST_VARIABLE = "status"


@contextmanager
def open_store(path: Path, layout: MapLayout, *, fresh: bool = False) -> Iterator[Store]:
    """Yield the store of a map at `path`, created if it does not exist, and locked for this process.

    Raises `DataError` when `path` holds something else or a map with other settings, unless a `fresh` map is wanted.
    """
    _prepare_place(path, fresh)
    if not path.exists():
        _create_store(path, layout)
    with held(path):
        _require_same(path, read_origin(_require_ours(path), str(path)), layout)
        for rest in path.rglob("*.partial"):
            rest.unlink()
        yield Store(path, layout)


class Store:
    """A growing map: which chunks are pending, and how a finished chunk is written."""

    def __init__(self, path: Path, layout: MapLayout) -> None:
        self.path, self.layout = path, layout
        self._group = zarr.open_group(path, mode="r+", zarr_format=3)

    @property
    def pending(self) -> list[tuple[slice, ...]]:
        """The chunks that have not been written yet, in order."""
        steps = self.layout.block
        return [
            chunk
            for chunk in self.layout.chunks
            if not self._make_chunk_path(
                tuple(piece.start // step for piece, step in zip(chunk, steps, strict=True))
            ).exists()
        ]

    def _make_chunk_path(self, number: tuple[int, ...]) -> Path:
        return self.path.joinpath(_LAST_VARIABLE, "c", *map(str, number), "0")

    def write(self, chunk: tuple[slice, ...], columns: Columns) -> None:
        """Write the columns (cells, starts) of a chunk; `status`, which marks it as complete, comes last."""
        shape = tuple(piece.stop - piece.start for piece in chunk)
        with writing(self.path):
            for name in self.layout.variables:
                values = columns[name]
                self._group[name][chunk] = values.reshape(*shape, *values.shape[1:])  # type: ignore[index]


def has_finished_map(path: Path, layout: MapLayout, *, fresh: bool) -> bool:
    """Return whether the finished map exists at `path`; raise `DataError` when something else is there.

    With `fresh` the answer is no, and an existing map is removed.
    """
    if not path.exists():
        return False
    attrs = _require_ours(path) if path.is_dir() else load(path).attrs
    if fresh:
        shutil.rmtree(path) if path.is_dir() else path.unlink()
        return False
    _require_same(path, read_origin(attrs, str(path)), layout)
    return True


def load(path: Path) -> xr.Dataset:
    """Return the map at `path` (.zarr or .nc), in memory; chunks that are not computed hold NaN and a status flag."""
    if not path.exists():
        raise DataError(f"{path} does not exist: give the path of a map")
    try:
        if path.suffix == ".nc":
            walk_in_subprocess(path)
            check_hdf5(path, RESULT)
            with xr.open_dataset(path, engine="h5netcdf") as stored:
                found = stored.load()
        else:
            _require_ours(path)  # before anything is decoded: zarr stores of version 2 may contain pickles
            lazy = xr.open_zarr(path, consolidated=False, chunks=None, mask_and_scale=False, zarr_format=3)
            check_bytes(lazy.nbytes, path.name, RESULT)
            found = lazy.load()
    except DataError:
        raise
    except Exception as err:  # the readers of HDF5 and zarr raise many types of exceptions
        reason = str(err).partition("\n")[0][:120]
        raise DataError(f"{path} cannot be read as a map ({reason}): give a .zarr or .nc written by `map`") from err
    if found.attrs.get("schema") != SCHEMA:
        raise DataError(
            f"{path} is not a map of lostmotion (its schema is {found.attrs.get('schema')!r}): give another file"
        )
    # The order of files in a folder is not defined, and the order of the variables is part of the bytes of a netCDF.
    coords = {name: found[name].variable for name in sorted(map(str, found.coords))}
    return xr.Dataset({name: found[name].variable for name in sorted(map(str, found.data_vars))}, coords, found.attrs)


def save_netcdf(path: Path, dataset: xr.Dataset) -> None:
    """Write a map to one netCDF file, completely or not at all."""
    stored = dataset.copy()
    for variable in stored.variables.values():
        variable.encoding = {"_FillValue": None}
        if "flag_values" in variable.attrs:
            variable.attrs["flag_values"] = np.array(variable.attrs["flag_values"], dtype=variable.dtype)
    save_datasets(path, {None: stored})


def save_zarr(path: Path, layout: MapLayout, columns: Mapping[str, NDArray[Any]]) -> None:
    """Write a finished map to a zarr store, completely or not at all; an existing store is replaced."""
    spare, old = _make_temporary_path(path), path.with_name(f".{path.name}.old")
    for rest in (spare, old):
        shutil.rmtree(rest, ignore_errors=True)
    with writing(path):
        _fill_store(spare, layout, columns)
        if path.exists():
            path.rename(old)
        spare.rename(path)
    shutil.rmtree(old, ignore_errors=True)


def make_dataset(layout: MapLayout, columns: Mapping[str, NDArray[Any]]) -> xr.Dataset:
    """Return a finished map as a dataset."""
    table = {name: (spec.dims, columns[name], to_plain(spec.attrs)) for name, spec in layout.variables.items()}
    coords = {name: (one.dims, one.values, to_plain(one.attrs)) for name, one in layout.coords.items()}
    return xr.Dataset(table, coords, layout.attrs)


def _create_store(path: Path, layout: MapLayout) -> None:
    """Create the store under a temporary name and rename it when it is complete."""
    spare = _make_temporary_path(path)
    shutil.rmtree(spare, ignore_errors=True)
    with writing(path):
        _fill_store(spare, layout, {})
        spare.rename(path)


def _fill_store(path: Path, layout: MapLayout, columns: Mapping[str, NDArray[Any]]) -> None:
    group = zarr.create_group(path, zarr_format=3, attributes=layout.attrs)
    sizes = dict(zip(layout.dims, zip(layout.shape, layout.block, strict=True), strict=True))
    sizes["start"] = (layout.study.starts, layout.study.starts)
    for name, one in layout.coords.items():
        values, attrs = one.values, to_plain(one.attrs)
        array = group.create_array(
            name, shape=values.shape, dtype=values.dtype, attributes=attrs, dimension_names=one.dims,
            chunks=values.shape,
        )  # fmt: skip
        array[...] = values
    for name, spec in layout.variables.items():
        array = group.create_array(
            name, shape=tuple(sizes[d][0] for d in spec.dims), chunks=tuple(sizes[d][1] for d in spec.dims),
            dtype=spec.kind, fill_value=spec.fill, attributes=to_plain(spec.attrs), dimension_names=spec.dims,
            config={"write_empty_chunks": True},
        )  # fmt: skip
        if columns:
            array[...] = columns[name]
    with warnings.catch_warnings():
        # zarr warns about every consolidated store of version 3, although xarray writes and reads them.
        warnings.filterwarnings("ignore", message="Consolidated metadata")
        zarr.consolidate_metadata(path)


def _make_temporary_path(path: Path) -> Path:
    return path.with_name(f".{path.name}.making")


def _prepare_place(path: Path, fresh: bool) -> None:
    if not path.parent.is_dir():
        raise DataError(f"{path.parent} is not a folder: create it first, or choose another place")
    if path.exists():
        _require_ours(path)
        if fresh:
            shutil.rmtree(path)


def _require_ours(path: Path) -> Mapping[str, object]:
    """Return the attributes of the store at `path`; raise `DataError` when it is not a map of lostmotion."""
    try:
        attrs: Mapping[str, object] = json.loads((path / "zarr.json").read_text(encoding="utf-8"))["attributes"]
    except (OSError, ValueError, KeyError):
        attrs = {}
    if attrs.get("schema") != SCHEMA:
        raise DataError(f"{path} exists and is not a map of lostmotion: choose another place")
    return attrs


def _require_same(path: Path, old: Origin, layout: MapLayout) -> None:
    """Raise `DataError` with the differences when the map at `path` was made with another origin."""
    new = layout.origin
    if old == new:
        return
    differences = [f"seed {old.seed}, now {new.seed}"] if old.seed != new.seed else []
    for what, was, now in (("versions", old.versions, new.versions), ("settings", old.settings, new.settings)):
        if was != now:
            differences.append(f"{what} {_format_differences(was, now)}")
    differences += _list_changed_plugins(old.inputs, new.inputs)
    raise DataError(
        f"{path} holds a map with other settings ({'; '.join(differences)}): give the same settings to continue it,"
        " another --out, or --fresh"
    )


def _list_changed_plugins(was: Mapping[str, str], now: Mapping[str, str]) -> list[str]:
    """Return a text for each third-party plugin that differs from the one used for the map."""
    return [f"plugin {name} has changed" for name in sorted({*was, *now}) if was.get(name) != now.get(name)]


def _format_differences(was: Mapping[str, object], now: Mapping[str, object]) -> str:
    """Return the keys whose values differ, with both values."""
    keys = [key for key in sorted({*was, *now}) if was.get(key) != now.get(key)]
    return ", ".join(f"{key} {was.get(key)}, now {now.get(key)}" for key in keys)
