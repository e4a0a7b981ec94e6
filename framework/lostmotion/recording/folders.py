"""Recordings that are a folder: bags of ROS 2, with their description and files of messages."""

from __future__ import annotations

import hashlib
from pathlib import Path

from lostmotion.provenance import digest


def is_bag_folder(path: Path) -> bool:
    """Return whether a path is the folder of a bag of ROS 2."""
    try:
        return (Path(path) / "metadata.yaml").is_file()
    except (OSError, ValueError):
        return False


def list_parts(path: Path) -> list[Path]:
    """Return the files of a recording in the order of their names: itself, or those of its folder."""
    return sorted(part for part in path.iterdir() if part.is_file()) if path.is_dir() else [path]


def digest_recording(path: Path) -> str:
    """Return the SHA-256 of a recording; of a folder, that of the names and digests of its files."""
    if not is_bag_folder(path):
        return digest(path)
    names = "".join(f"{part.name} {digest(part)}\n" for part in list_parts(path))
    return hashlib.sha256(names.encode()).hexdigest()
