"""Checks of the size of a file after decompression: a small file can hold gigabytes, and is refused in advance."""

from __future__ import annotations

import struct
import zipfile
import zlib
from pathlib import Path
from typing import Any

from lostmotion.errors import DataError
from lostmotion.recording.limits import NUMBERS, check_bytes, check_count

MOST = 8 * NUMBERS
RESULT = 2**31
"""The greatest size (bytes) of a result file: a chain or a map is larger than a recording."""
_HEADER, _TAG, _COMPRESSED = 128, 8, 15
"""MAT files of version 5: bytes before the first element, bytes of a tag, type of a compressed element."""
_BLOCK = 1 << 20


def check_npz(path: Path) -> None:
    """Raise `DataError` for an archive that is too large after decompression."""
    with zipfile.ZipFile(path) as archive:
        members = archive.infolist()
    check_count(len(members), "arrays", path.name)
    check_bytes(sum(member.file_size for member in members), path.name)


def check_mat(path: Path) -> None:
    """Raise `DataError` for a MAT file of version 5 that is too large after decompression."""
    total = 0
    with path.open("rb") as raw:
        header = raw.read(_HEADER)
        order = "<" if header[126:128] == b"IM" else ">"
        while len(tag := raw.read(_TAG)) == _TAG:
            kind, size = struct.unpack(f"{order}II", tag)
            here = raw.tell()
            total += _decompressed_size(raw, size, MOST - total) if kind == _COMPRESSED else size
            check_bytes(total, path.name)
            raw.seek(here + size)


def _decompressed_size(raw: Any, size: int, most: int) -> int:
    """Return the decompressed size of the next `size` bytes of a stream, counted up to just above `most`."""
    unpacker, count = zlib.decompressobj(), 0
    while size > 0 and count <= most and (block := raw.read(min(size, _BLOCK))):
        size -= len(block)
        while block and count <= most:
            count += len(unpacker.decompress(block, _BLOCK))
            block = unpacker.unconsumed_tail
    return count


def check_hdf5(path: Path, most: int = MOST) -> None:
    """Raise `DataError` for an HDF5 file (netCDF 4, MAT 7.3) that is too large or refers to other files."""
    import h5py

    found: list[Any] = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda _, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
        check_count(len(found), "arrays", path.name)
        check_bytes(sum(item.size * item.dtype.itemsize for item in found if item.size), path.name, most)
        if any(item.external or item.is_virtual for item in found):
            raise DataError(f"{path.name} takes numbers from other files: export it again as one file")
