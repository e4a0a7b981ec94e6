"""Compiled functions on disk, at an address that changes with the source of any kernel.

numba keeps compiled code beside each source file. A new copy of the project then compiles everything again, and a
change in a function that another file inlines is not noticed.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import numba
from numba.core import caching

_MARKED: set[Any] = set()


def stored(**options: Any) -> Callable[[Any], Any]:
    """Return a decorator that compiles a function as `numba.njit(**options)` does, and keeps the code on disk."""

    def compile_function(function: Any) -> Any:
        _MARKED.add(function)
        return numba.njit(**{**options, "cache": True})(function)

    return compile_function


def list_cache_folders() -> tuple[Path, ...]:
    """Return the folders in which compiled kernels may be cached, in order of preference."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "lostmotion"
    spare = Path(tempfile.gettempdir()) / f"lostmotion-{Path.home().name}"
    return (Path(os.environ["LOSTMOTION_CACHE"]), spare) if "LOSTMOTION_CACHE" in os.environ else (home, spare)


def make_cache_folders() -> Iterator[Path]:
    """Yield these folders, made where they are missing; not those of other users, whose code would run."""
    for folder in list_cache_folders():
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid():
                yield folder
        except OSError:
            continue


@lru_cache
def compute_address(folder: Path, package: Path) -> str:
    """Return a digest of the sources that a compiled function of a folder of a package may consist of, and of numba.

    These are all kernels of this package and of the given one, and the files of the folder.
    """
    own = Path(__file__).parent
    found = {*own.glob("*.py"), *folder.glob("*.py")}
    if package not in own.parents:
        found |= {*package.rglob("kernels/*.py"), *package.rglob("_kernels*.py")}
    texts = [path.name.encode() + path.read_bytes() for path in found]
    versions = f"{numba.__version__}{sys.version_info[:2]}".encode()
    return hashlib.sha256(b"\0".join([versions, *sorted(texts)])).hexdigest()[:24]


class _StoredLocator(caching._CacheLocator):
    """Where numba finds the compiled code of a function of `stored`."""

    def __init__(self, function: Any, folder: Path, address: str) -> None:
        self.function, self.address, self.folder = function, address, folder / f"lostmotion_kernels_{address}"

    def get_cache_path(self) -> str:
        """Return the folder of all functions with these sources."""
        return str(self.folder)

    def get_source_stamp(self) -> str:
        """Return the address."""
        return self.address

    def get_disambiguator(self) -> str:
        """Return module and line of the function, which numba adds to its name."""
        return f"{self.function.__module__}-{self.function.__code__.co_firstlineno}"

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> _StoredLocator | None:
        """Return the place of a function of `stored`; None for others, and where `NUMBA_CACHE_DIR` names a folder.

        A generated module has no file of its own: its name is an address already.
        """
        source = getattr(sys.modules.get(py_func.__module__.partition(".")[0]), "__file__", None)
        named: Any = numba.config
        if py_func not in _MARKED or named.CACHE_DIR or source is None:
            return None
        address = compute_address(Path(py_file).parent, Path(source).parent)
        for folder in make_cache_folders():
            place: Any = cls(py_func, folder, address)
            try:
                place.ensure_cache_path()
            except OSError:
                continue
            return place  # type: ignore[no-any-return]
        return None


_Cache: Any = getattr(caching, "CacheImpl", None) or getattr(caching, "_CacheImpl")  # noqa: B009 - before numba 0.62
_Cache._locator_classes.insert(0, _StoredLocator)
