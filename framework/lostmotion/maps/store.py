"""A map on the disk as it grows: a zarr store whose chunks are whole or absent, and which one process writes at a time.

`status` is written last of a chunk, so a chunk is done when its file of `status` is there. The one door to zarr.
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
from lostmotion.maps.cells import Columns
from lostmotion.maps.layout import SCHEMA, MapLayout, origin_in
from lostmotion.recording.limits import check_bytes
from lostmotion.recording.subprocess_reader import walk_in_subprocess
from lostmotion.recording.unpacked import RESULT, check_hdf5
from lostmotion.results.background import Origin
from lostmotion.storage import held, save_datasets, writing

ENDINGS = (".zarr", ".nc")
"""The endings of a map, which tell its format."""
_LAST = "status"


@contextmanager
def opened(path: Path, layout: MapLayout, *, fresh: bool = False) -> Iterator[Store]:
    """Yield the store of a map at `path`, made if it is not there, and held by this process alone.

    Raises `DataError` when something else is there, or a map with other settings, unless a `fresh` one is wanted.
    """
    _clear(path, fresh)
    if not path.exists():
        _make(path, layout)
    with held(path):
        _require_same(path, origin_in(_require_ours(path), str(path)), layout)
        for rest in path.rglob("*.partial"):
            rest.unlink()
        yield Store(path, layout)


class Store:
    """The growing map: which chunks are pending, and where a finished one goes."""

    def __init__(self, path: Path, layout: MapLayout) -> None:
        self.path, self.layout = path, layout
        self._group = zarr.open_group(path, mode="r+", zarr_format=3)

    @property
    def pending(self) -> list[tuple[slice, ...]]:
        """The chunks that are not there yet, in order."""
        steps = self.layout.block
        return [
            chunk
            for chunk in self.layout.chunks
            if not self._file(tuple(piece.start // step for piece, step in zip(chunk, steps, strict=True))).exists()
        ]

    def _file(self, number: tuple[int, ...]) -> Path:
        return self.path.joinpath(_LAST, "c", *map(str, number), "0")

    def write(self, chunk: tuple[slice, ...], columns: Columns) -> None:
        """Write the columns (cells, starts) of a chunk, whatever tells that it is done last."""
        shape = tuple(piece.stop - piece.start for piece in chunk)
        with writing(self.path):
            for name in self.layout.variables:
                values = columns[name]
                self._group[name][chunk] = values.reshape(*shape, *values.shape[1:])  # type: ignore[index]


def holds(path: Path, layout: MapLayout, *, fresh: bool) -> bool:
    """Return whether the finished map is at `path` already; raise `DataError` when something else is.

    A `fresh` one is never there: what is in its place is removed if it is ours.
    """
    if not path.exists():
        return False
    attrs = _require_ours(path) if path.is_dir() else load(path).attrs
    if fresh:
        shutil.rmtree(path) if path.is_dir() else path.unlink()
        return False
    _require_same(path, origin_in(attrs, str(path)), layout)
    return True


def load(path: Path) -> xr.Dataset:
    """Return the map at `path` (.zarr or .nc), in memory; chunks that are not computed hold NaN and flags say so."""
    if not path.exists():
        raise DataError(f"{path} is not there: give the path of a map")
    try:
        if path.suffix == ".nc":
            walk_in_subprocess(path)
            check_hdf5(path, RESULT)
            with xr.open_dataset(path, engine="h5netcdf") as stored:
                found = stored.load()
        else:
            _require_ours(path)  # before anything is decoded: stores of version 2 may hold pickles
            lazy = xr.open_zarr(path, consolidated=False, chunks=None, mask_and_scale=False, zarr_format=3)
            check_bytes(lazy.nbytes, path.name, RESULT)
            found = lazy.load()
    except DataError:
        raise
    except Exception as err:  # HDF5, zarr and what reads them fail in every way there is
        said = str(err).partition("\n")[0][:120]
        raise DataError(f"{path} cannot be read as a map ({said}): give a .zarr or .nc written by `map`") from err
    if found.attrs.get("schema") != SCHEMA:
        raise DataError(f"{path} is no map of ours (its schema is {found.attrs.get('schema')!r}): give another file")
    # A folder lists its files in no order, and the order of the variables is part of the bytes of a netCDF.
    coords = {name: found[name].variable for name in sorted(map(str, found.coords))}
    return xr.Dataset({name: found[name].variable for name in sorted(map(str, found.data_vars))}, coords, found.attrs)


def save_netcdf(path: Path, dataset: xr.Dataset) -> None:
    """Write a map to one netCDF file that appears whole or not at all."""
    told = dataset.copy()
    for variable in told.variables.values():
        variable.encoding = {"_FillValue": None}
        if "flag_values" in variable.attrs:
            variable.attrs["flag_values"] = np.array(variable.attrs["flag_values"], dtype=variable.dtype)
    save_datasets(path, {None: told})


def save_zarr(path: Path, layout: MapLayout, columns: Mapping[str, NDArray[Any]]) -> None:
    """Write a finished map to a zarr store that appears whole or not at all; what was there gives way."""
    spare, old = _spare(path), path.with_name(f".{path.name}.old")
    for rest in (spare, old):
        shutil.rmtree(rest, ignore_errors=True)
    with writing(path):
        _fill_store(spare, layout, columns)
        if path.exists():
            path.rename(old)
        spare.rename(path)
    shutil.rmtree(old, ignore_errors=True)


def as_dataset(layout: MapLayout, columns: Mapping[str, NDArray[Any]]) -> xr.Dataset:
    """Return a finished map as a dataset."""
    table = {name: (spec.dims, columns[name], to_plain(spec.attrs)) for name, spec in layout.variables.items()}
    coords = {name: (one.dims, one.values, to_plain(one.attrs)) for name, one in layout.coords.items()}
    return xr.Dataset(table, coords, layout.attrs)


def _make(path: Path, layout: MapLayout) -> None:
    """Make the store beside its place, and put it there when it is whole."""
    spare = _spare(path)
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
        # Said of any consolidated store of version 3: xarray writes and wants them all the same.
        warnings.filterwarnings("ignore", message="Consolidated metadata")
        zarr.consolidate_metadata(path)


def _spare(path: Path) -> Path:
    return path.with_name(f".{path.name}.making")


def _clear(path: Path, fresh: bool) -> None:
    if not path.parent.is_dir():
        raise DataError(f"{path.parent} is no folder: make it first, or choose another place")
    if path.exists():
        _require_ours(path)
        if fresh:
            shutil.rmtree(path)


def _require_ours(path: Path) -> Mapping[str, object]:
    """Return the attributes of the store at `path`; never touch what is none of ours."""
    try:
        attrs: Mapping[str, object] = json.loads((path / "zarr.json").read_text(encoding="utf-8"))["attributes"]
    except (OSError, ValueError, KeyError):
        attrs = {}
    if attrs.get("schema") != SCHEMA:
        raise DataError(f"{path} is there and is no map of ours: choose another place")
    return attrs


def _require_same(path: Path, old: Origin, layout: MapLayout) -> None:
    new = layout.origin
    if old == new:
        return
    said = [f"seed {old.seed}, now {new.seed}"] if old.seed != new.seed else []
    for what, was, now in (("versions", old.versions, new.versions), ("settings", old.settings, new.settings)):
        if was != now:
            said.append(f"{what} {_differences(was, now)}")
    said += _changed(old.inputs, new.inputs)
    raise DataError(
        f"{path} holds a map made otherwise ({'; '.join(said)}): give the same settings to continue it, another --out,"
        " or --fresh"
    )


def _changed(was: Mapping[str, str], now: Mapping[str, str]) -> list[str]:
    """Return which plugins of other people are not those of the map."""
    return [f"plugin {name} has changed" for name in sorted({*was, *now}) if was.get(name) != now.get(name)]


def _differences(was: Mapping[str, object], now: Mapping[str, object]) -> str:
    keys = [key for key in sorted({*was, *now}) if was.get(key) != now.get(key)]
    return ", ".join(f"{key} {was.get(key)}, now {now.get(key)}" for key in keys)
