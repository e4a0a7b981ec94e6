"""The folder that the page shows: its recordings and cases, and no path outside of it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from lostmotion.errors import CaseError, DataError
from lostmotion.recording.formats import is_recording
from lostmotion.storage import folder_for, save_bytes

WORK = "lostmotion-app"
"""The folder for what the page writes."""
DEEPEST, MOST_FILES = 3, 500
"""How many folders below the one that is shown are searched, and the most files that are offered."""
MOST_UPLOADED = 200 * 2**20
"""The greatest size (bytes) of an uploaded file."""
MOST_CASE = 2**20
"""The greatest size (bytes) of a case file that is offered."""
_HIDDEN = re.compile(r"^[._]|^node_modules$")


def is_case(name: str) -> bool:
    """Return whether the name of a file is that of a case."""
    return name.lower().endswith(".toml")


def _has_recordings(path: Path) -> bool:
    try:
        return path.stat().st_size < MOST_CASE and "recordings" in path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return False


@dataclass(frozen=True)
class WorkFolder:
    """The folder that the page shows, an absolute path without links."""

    root: Path

    @property
    def work(self) -> Path:
        """The folder for what the page writes."""
        return self.root / WORK

    def find(self, name: str) -> Path:
        """Return the path of a file or folder by its name in this one; raise `DataError` for one outside of it."""
        try:
            path = (self.root / name).resolve()
        except (OSError, ValueError) as err:
            raise DataError(f"{name[:80]!r} is no path: choose a file of {self.root.name}") from err
        if not path.is_relative_to(self.root):
            raise DataError(f"{name[:80]!r} is outside of the folder of this page: open the page for its folder")
        return path

    def name_of(self, path: Path) -> str:
        """Return the name of a path in this folder."""
        return path.relative_to(self.root).as_posix()

    def list_recordings(self) -> list[str]:
        """Return the names of the files that can be recordings, in alphabetical order."""
        return [self.name_of(path) for path in self._walk(self.root, DEEPEST) if is_recording(path)][:MOST_FILES]

    def list_cases(self) -> list[str]:
        """Return the names of the case files, those of the page left out."""
        files = (path for path in self._walk(self.root, DEEPEST) if is_case(path.name))
        return [self.name_of(path) for path in files if _has_recordings(path)][:MOST_FILES]

    def list_robots(self) -> list[str]:
        """Return the names of the files that may be models of robots, MJCF or URDF."""
        files = self._walk(self.root, DEEPEST)
        return [self.name_of(path) for path in files if path.suffix.lower() in (".xml", ".urdf", ".mjcf")][:MOST_FILES]

    def list_results(self, file: str) -> list[Path]:
        """Return the folders that contain a result in this file, newest first; those of the page included."""
        found = [path.parent for path in self._walk(self.root, DEEPEST + 2, also=WORK) if path.name == file]
        return sorted(found, key=lambda folder: -(folder / file).stat().st_mtime)

    def _walk(self, folder: Path, depth: int, also: str = "") -> Iterator[Path]:
        """Yield the files below a folder, without hidden ones and without links that lead out of it."""
        try:
            entries = sorted(folder.iterdir())
        except OSError:
            return
        for path in entries:
            if _HIDDEN.match(path.name) or not path.resolve().is_relative_to(self.root):
                continue
            if path.is_file():
                yield path
            elif depth and path.is_dir() and not path.is_symlink() and (path.name != WORK or also == WORK):
                yield from self._walk(path, depth - 1, also)

    def upload(self, name: str, content: bytes) -> str:
        """Return the name of a file written into this folder; an existing one is not replaced.

        Raises `CaseError` for a name that is none of a recording, and for a file that is too large.
        """
        plain = re.sub(r"[^\w. +-]+", "_", Path(name.replace("\\", "/")).name).strip(". ")
        if not plain or not is_recording(Path(plain)):
            raise CaseError(f"{name[:80]!r} has no ending of a recording: choose a file such as run1.csv")
        if len(content) > MOST_UPLOADED:
            raise CaseError(
                f"{plain} has {len(content) / 2**20:.0f} MiB, and {MOST_UPLOADED // 2**20} MiB is the most: copy it"
                f" into {self.root}, and choose it there"
            )
        path = self.find(plain)
        if path.exists():
            if path.is_file() and path.read_bytes() == content:
                return self.name_of(path)
            raise CaseError(f"{plain} exists already in the folder, with another content: rename the file")
        folder_for(path.parent)
        save_bytes(path, content)
        return self.name_of(path)
