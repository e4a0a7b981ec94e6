"""Code of models and terms, taken over into modules of ours, compiled, and kept on disk.

What is compiled must not depend on how a plugin was loaded: numba notes in its cache the module in which each function
stands, and cannot read it back when the same file was loaded under another name. So each function is copied into the
module of the kernel that it becomes part of, and a kernel is known by what its functions do, and not by where they
stand. The copy finds quicker functions under `math`, which the compiler can turn into vector instructions.
"""

from __future__ import annotations

import dis
import hashlib
import math
import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numba
import numpy as np

from lostmotion.errors import ContractError
from lostmotion.kernels import elementary
from lostmotion.kernels.vector import BARE

Code = Callable[..., Any]
_part = numba.njit(**BARE, forceinline=True)


def _plain(function: Any) -> Any:
    """Return the Python function behind one that is compiled already."""
    return getattr(function, "py_func", function)


def _names(code: CodeType) -> Iterator[str]:
    """Yield the global names that a function reads."""
    for step in dis.get_instructions(code):
        if step.opname == "LOAD_GLOBAL":
            yield str(step.argval)


def fingerprint(function: Code) -> str:
    """Return a text that changes with whatever a function does: its code, its constants, and what it calls."""
    return "".join(_sources(function, set()))


def _sources(function: Any, known: set[int]) -> Iterator[str]:
    inner = _plain(function)
    if id(inner) in known:
        return
    known.add(id(inner))
    code = inner.__code__
    yield f"{code.co_code.hex()}{code.co_consts!r}{code.co_varnames!r}{code.co_names!r}{inner.__defaults__!r}"
    cells = [cell.cell_contents for cell in inner.__closure__ or ()]
    for value in [*(inner.__globals__.get(name) for name in _names(code)), *cells]:
        if isinstance(_plain(value), FunctionType):
            yield from _sources(value, known)
        elif isinstance(value, int | float | str | tuple | np.ndarray):
            yield repr(value)


def adopted(function: Code, module: str) -> Any:
    """Return a compiled copy of a function, with those that it calls, as a part of a module of ours."""
    return _copied(function, module, {})


def _copied(function: Any, module: str, done: dict[int, Any]) -> Any:
    inner = _plain(function)
    if id(inner) in done:
        return done[id(inner)]
    space: dict[str, Any] = {**inner.__globals__, "__name__": module}
    copy = FunctionType(inner.__code__, space, inner.__name__, inner.__defaults__, inner.__closure__)
    copy.__module__ = module
    done[id(inner)] = made = _part(copy)
    for name in set(_names(inner.__code__)):
        if name in space:
            space[name] = _standing_in(space[name], module, done)
    return made


def _standing_in(value: Any, module: str, done: dict[int, Any]) -> Any:
    """Return what a law finds under a name: quick functions for those of `math`, copies of other Python functions."""
    if value is math:
        return _MATH
    if isinstance(value, type(math.exp)) and value in elementary.QUICK:
        return elementary.QUICK[value]
    return _copied(value, module, done) if isinstance(_plain(value), FunctionType) else value


_MATH = ModuleType("math")
_MATH.__dict__.update({name: elementary.QUICK.get(f, f) if callable(f) else f for name, f in vars(math).items()})


def folders() -> tuple[Path, ...]:
    """Return where compiled kernels may be kept, best first."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "lostmotion"
    spare = Path(tempfile.gettempdir()) / f"lostmotion-{Path.home().name}"
    return (Path(os.environ["LOSTMOTION_CACHE"]), spare) if "LOSTMOTION_CACHE" in os.environ else (home, spare)


def kept_as(text: str, also: str = "") -> Path:
    """Return the file that holds `text`; its name changes with the text, with `also`, and with numba."""
    key = hashlib.sha256(f"{text}{also}{numba.__version__}{sys.version_info[:2]}{BARE}".encode()).hexdigest()[:24]
    for folder in folders():
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if (
                hasattr(os, "getuid") and folder.stat().st_uid != os.getuid()
            ):  # what others have left there would be run
                continue
            path = folder / f"lostmotion_kernel_{key}.py"
            if not path.exists():
                fresh = path.with_suffix(f".{os.getpid()}.tmp")
                fresh.write_text(text)
                fresh.replace(path)
        except OSError:
            continue
        return path
    raise OSError("no folder for compiled kernels can be written: set LOSTMOTION_CACHE to one that can")


def defined(text: str, path: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the names that `text` defines beside those that are `given`, in a module of its own.

    numba looks the module up by its name when it loads what it has kept.
    """
    module = ModuleType(Path(path).stem)
    module.__dict__.update(given)
    sys.modules[module.__name__] = module
    exec(compile(text, path, "exec"), module.__dict__)  # noqa: S102 - our own text, filled with numbers only
    return module.__dict__


def with_clear_errors(function: Code) -> Code:
    """Return the function with an error of the compiler, which works at the first call, told in one sentence."""

    def call(*args: Any) -> Any:
        try:
            return function(*args)
        except numba.core.errors.NumbaError as err:
            lines = [line.strip() for line in str(err).splitlines()]
            why = next((line for line in lines if "rror" in line and "pipeline" not in line), lines[0])
            place = next((line for line in reversed(lines) if line.startswith("File ")), "")
            raise ContractError(
                f"a model or term cannot be compiled ({why.rstrip('.:')}{'; ' * bool(place)}{place.rstrip(':')}): "
                "write it with numbers and the math module only"
            ) from err
        except (OSError, MemoryError, ContractError):  # a full disk under the cache is no fault of a model
            raise
        except Exception as err:
            raise ContractError(
                f"a model or term raised {type(err).__name__} ({' '.join(str(err).split())}): let it return a number"
                " for any motion"
            ) from err

    return call
