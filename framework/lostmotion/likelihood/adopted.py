"""Functions of models and terms, copied into kernel modules, compiled, and cached on disk.

The compiled code must not depend on how a plugin was loaded: numba stores in its cache the module of each function, and
cannot load it again when the same file was imported under another name. So each function is copied into the module of
the kernel that it becomes part of, and a kernel is identified by what its functions do, and not by their location. The
copy uses faster functions in place of those of `math`, which the compiler can turn into vector instructions.
"""

from __future__ import annotations

import dis
import hashlib
import math
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numba
import numpy as np

from lostmotion.errors import ContractError
from lostmotion.kernels import elementary
from lostmotion.kernels.stored import make_cache_folders
from lostmotion.kernels.vector import BARE

Code = Callable[..., Any]
_part = numba.njit(**BARE, forceinline=True)


def _unwrap(function: Any) -> Any:
    """Return the Python function behind a compiled one."""
    return getattr(function, "py_func", function)


def _list_globals(code: CodeType) -> Iterator[str]:
    """Yield the names of the globals that a function reads."""
    for step in dis.get_instructions(code):
        if step.opname == "LOAD_GLOBAL":
            yield str(step.argval)


def compute_fingerprint(function: Code) -> str:
    """Return a text that changes with the behaviour of a function: its code, its constants, and what it calls."""
    return "".join(_list_sources(function, set()))


def _list_sources(function: Any, known: set[int]) -> Iterator[str]:
    inner = _unwrap(function)
    if id(inner) in known:
        return
    known.add(id(inner))
    code = inner.__code__
    yield f"{code.co_code.hex()}{code.co_consts!r}{code.co_varnames!r}{code.co_names!r}{inner.__defaults__!r}"
    cells = [cell.cell_contents for cell in inner.__closure__ or ()]
    for value in [*(inner.__globals__.get(name) for name in _list_globals(code)), *cells]:
        if isinstance(_unwrap(value), FunctionType):
            yield from _list_sources(value, known)
        elif isinstance(value, int | float | str | tuple | np.ndarray):
            yield repr(value)


def adopt_function(function: Code, module: str) -> Any:
    """Return a compiled copy of a function, and of those that it calls, in the module of a kernel."""
    return _copy_function(function, module, {})


def _copy_function(function: Any, module: str, done: dict[int, Any]) -> Any:
    inner = _unwrap(function)
    if id(inner) in done:
        return done[id(inner)]
    space: dict[str, Any] = {**inner.__globals__, "__name__": module}
    copy = FunctionType(inner.__code__, space, inner.__name__, inner.__defaults__, inner.__closure__)
    copy.__module__ = module
    done[id(inner)] = made = _part(copy)
    for name in set(_list_globals(inner.__code__)):
        if name in space:
            space[name] = _find_substitute(space[name], module, done)
    return made


def _find_substitute(value: Any, module: str, done: dict[int, Any]) -> Any:
    """Return the object for a global name of a law: fast functions for `math`, copies of other Python functions."""
    if value is math:
        return _MATH
    if isinstance(value, type(math.exp)) and value in elementary.QUICK:
        return elementary.QUICK[value]
    return _copy_function(value, module, done) if isinstance(_unwrap(value), FunctionType) else value


_MATH = ModuleType("math")
_MATH.__dict__.update({name: elementary.QUICK.get(f, f) if callable(f) else f for name, f in vars(math).items()})


def store_text(text: str, also: str = "") -> Path:
    """Return the file that holds `text`; its name changes with the text, with `also`, and with numba."""
    key = hashlib.sha256(f"{text}{also}{numba.__version__}{sys.version_info[:2]}{BARE}".encode()).hexdigest()[:24]
    for folder in make_cache_folders():
        try:
            path = folder / f"lostmotion_kernel_{key}.py"
            if not path.exists():
                fresh = path.with_suffix(f".{os.getpid()}.tmp")
                fresh.write_text(text)
                fresh.replace(path)
        except OSError:
            continue
        return path
    raise OSError("no folder for compiled kernels can be written: set LOSTMOTION_CACHE to one that can")


def define_module(text: str, path: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the names that `text` defines, and those that are `given`, in a module of its own.

    numba finds the module by its name when it loads its cache.
    """
    module = ModuleType(Path(path).stem)
    module.__dict__.update(given)
    sys.modules[module.__name__] = module
    exec(compile(text, path, "exec"), module.__dict__)  # noqa: S102 - our own text, filled with numbers only
    return module.__dict__


def explain_errors(function: Code) -> Code:
    """Return the function with errors of the compiler, which runs at the first call, turned into one sentence."""

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
