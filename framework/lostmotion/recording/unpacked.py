"""What a file comes to once it is unpacked: a small file can hold gigabytes, and is refused before they are read."""

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
"""Bytes that a result of ours may hold: a chain or a map is larger than a recording."""
_HEADER, _TAG, _COMPRESSED = 128, 8, 15
"""Bytes before the first element of a MAT file of version 5, bytes of a tag, type of a compressed element."""
_BLOCK = 1 << 20


def check_npz(path: Path) -> None:
    """Refuse an archive whose members come to more than is read."""
    with zipfile.ZipFile(path) as archive:
        members = archive.infolist()
    check_count(len(members), "arrays", path.name)
    check_bytes(sum(member.file_size for member in members), path.name)


def check_mat(path: Path) -> None:
    """Refuse a MAT file of version 5 whose compressed elements come to more than is read."""
    total = 0
    with path.open("rb") as raw:
        header = raw.read(_HEADER)
        order = "<" if header[126:128] == b"IM" else ">"
        while len(tag := raw.read(_TAG)) == _TAG:
            kind, size = struct.unpack(f"{order}II", tag)
            here = raw.tell()
            total += _inflated(raw, size, MOST - total) if kind == _COMPRESSED else size
            check_bytes(total, path.name)
            raw.seek(here + size)


def _inflated(raw: Any, size: int, most: int) -> int:
    """Return how many bytes the next `size` of a stream come to, counted until there are more than `most`."""
    unpacker, count = zlib.decompressobj(), 0
    while size > 0 and count <= most and (block := raw.read(min(size, _BLOCK))):
        size -= len(block)
        while block and count <= most:
            count += len(unpacker.decompress(block, _BLOCK))
            block = unpacker.unconsumed_tail
    return count


def check_hdf5(path: Path, most: int = MOST) -> None:
    """Refuse an HDF5 file (netCDF 4, MAT 7.3) of more than is read, or one that takes its numbers from other files."""
    import h5py

    found: list[Any] = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda _, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
        check_count(len(found), "arrays", path.name)
        check_bytes(sum(item.size * item.dtype.itemsize for item in found if item.size), path.name, most)
        if any(item.external or item.is_virtual for item in found):
            raise DataError(f"{path.name} takes numbers from other files: export it again as one file")
