"""One kernel out of a model and its terms: source text is written, kept in a cache folder, and compiled once.

Every term has a switch at run time, so one compilation serves each subset of the terms in it: a diagnosis tries a
whole library without compiling again. The same text runs as plain Python: the slow twin of every kernel.
"""

from __future__ import annotations

import getpass
import hashlib
import inspect
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path
from types import ModuleType
from typing import Any

import numba
import numpy as np

from lostmotion.errors import ContractError
from lostmotion.kernels.stack import slow_square, slow_vector, square, vector
from lostmotion.kernels.views import slow_view, view

BARE: dict[str, Any] = {"error_model": "numpy", "nogil": True, "_nrt": False}
"""Without numba's run time nothing can be allocated in a kernel, and no references are counted: eight times faster."""


@dataclass(frozen=True)
class Place:
    """Where a force acts: the row of `dydt`, the index of the inertia in `p`, and the relative motion there.

    `against` is row and inertia of a body that feels the opposite force.
    """

    row: int
    inertia: int
    motion: Callable[..., Any]
    against: tuple[int, int] | None = None


@dataclass(frozen=True)
class Law:
    """A term as the kernel sees it: where it acts, its functions, and how many of `w` and of `y` are its own."""

    place: int
    width: int
    states: int
    force: Callable[..., Any]
    rate: Callable[..., Any]


@dataclass(frozen=True)
class Blueprint:
    """All that decides the text of a kernel; `n` counts every state, `latent` says that the last is a latent force."""

    n: int
    channels: int
    rhs: Callable[..., Any]
    observe: Callable[..., Any]
    places: tuple[Place, ...]
    laws: tuple[Law, ...]
    latent: bool = False


@dataclass(frozen=True)
class Compiled:
    """The functions of one composed kernel: `derivative`, `track` (filter), `run` (free simulation)."""

    derivative: Callable[..., Any]
    track: Callable[..., Any]
    run: Callable[..., Any]
    source: str


def _parts(plan: Blueprint) -> dict[str, Callable[..., Any]]:
    """Return the functions of the plugins under the names they have in the composed text."""
    parts = {"model_rhs": plan.rhs, "model_observe": plan.observe}
    parts |= {f"motion_{i}": place.motion for i, place in enumerate(plan.places)}
    for i, law in enumerate(plan.laws):
        parts |= {f"force_{i}": law.force, f"rate_{i}": law.rate}
    return parts


def _law_text(index: int, law: Law, place: Place, start: int) -> str:
    """Return the lines that add one law to `dydt`, behind its switch.

    Parameters and states go in as tuples of numbers: a slice counts references, which costs more than the law.
    """
    i = index
    own = "".join(f"w[{start + a}], " for a in range(law.width))
    states = "".join(f"y[at[{i}] + {a}], " for a in range(law.states))
    lines = [
        f"    if on[{i}]:",
        f"        x, v = motion_{law.place}(y, u)",
        f"        push = force_{i}(t, x, v, u, ({own}), ({states}))",
        f"        dydt[{place.row}] += push / p[{place.inertia}]",
    ]
    if place.against:
        lines.append(f"        dydt[{place.against[0]}] -= push / p[{place.against[1]}]")
    if law.states:
        lines.append(f"        rate_{i}(t, x, v, u, ({own}), ({states}), view(dydt, at[{i}], {law.states}))")
    return "\n".join(lines)


def _text(plan: Blueprint, template: str = "template.txt") -> str:
    """Return the source of the composed kernel."""
    first = plan.places[0]
    starts = [sum(law.width for law in plan.laws[:i]) for i in range(len(plan.laws))]
    laws = [_law_text(i, law, plan.places[law.place], starts[i]) for i, law in enumerate(plan.laws)]
    if plan.latent:
        laws.append(f"    dydt[{first.row}] += y[{plan.n - 1}] / p[{first.inertia}]")
        laws.append(f"    dydt[{plan.n - 1}] = -pace * y[{plan.n - 1}]")
    values = {
        "@N@": str(plan.n),
        "@CHANNELS@": str(plan.channels),
        "@WIDE@": str(max(plan.n, plan.channels)),
        "@NOISY@": str(plan.n - 1 if plan.latent else first.row),
        "@NOISE_INERTIA@": "1.0" if plan.latent else f"p[{first.inertia}]",
        "@LAWS@": "\n".join(laws),
        "@FURTHER@": "" if plan.latent else "\n".join(_noise_text(place) for place in _bodies(plan)[1:]),
    }
    text = resources.files("lostmotion.kernels").joinpath(template).read_text()
    for mark, value in values.items():
        text = text.replace(mark, value)
    return text


def _bodies(plan: Blueprint) -> tuple[Place, ...]:
    """Return one place for each row on which forces act, the first one first."""
    return tuple({place.row: place for place in reversed(plan.places)}.values())[::-1]


def _noise_text(place: Place) -> str:
    """Return the lines that add the white force on a further body to the covariance."""
    row = place.row
    lines = [
        "            for a in range(n):",
        f"                fp[a] = soon * (A[a, {row}] + 0.5 * soon * A2[a, {row}])",
        f"                fm[a] = late * (A[a, {row}] + 0.5 * late * A2[a, {row}])",
        f"            fp[{row}] += 1.0",
        f"            fm[{row}] += 1.0",
        "            for a in range(n):",
        "                for b in range(n):",
        f"                    P[a, b] += 0.5 * h * q / (p[{place.inertia}] ** 2) * (fp[a] * fp[b] + fm[a] * fm[b])",
    ]
    return "\n".join(lines)


def _origin(function: Callable[..., Any]) -> bytes:
    """Return what identifies the code of a plugin function: the file it stands in, else its byte code."""
    try:
        path = inspect.getsourcefile(function)
        if path and Path(path).is_file():
            return Path(path).read_bytes() + function.__qualname__.encode()
    except TypeError:
        pass
    code = function.__code__
    return code.co_code + repr((code.co_consts, code.co_names)).encode()


def _folders() -> tuple[Path, ...]:
    """Return where compiled kernels may be kept, best first."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "lostmotion"
    spare = Path(tempfile.gettempdir()) / f"lostmotion-{getpass.getuser()}"
    return (Path(os.environ["LOSTMOTION_CACHE"]), spare) if "LOSTMOTION_CACHE" in os.environ else (home, spare)


def _cached(text: str, parts: dict[str, Callable[..., Any]]) -> Path:
    """Return the file that holds `text`; its name changes with every function that is compiled into it."""
    key = hashlib.sha256(f"{text}{numba.__version__}{BARE}".encode())
    for name in sorted(parts):
        key.update(name.encode() + _origin(parts[name]))
    for folder in _folders():
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if folder.stat().st_uid != os.getuid():  # what others have left there would be run
                continue
            path = folder / f"lostmotion_kernel_{key.hexdigest()[:24]}.py"
            if not path.exists():
                fresh = path.with_suffix(f".{os.getpid()}.tmp")
                fresh.write_text(text)
                fresh.replace(path)
        except OSError:
            continue
        return path
    raise OSError("no folder for compiled kernels can be written: set LOSTMOTION_CACHE to one that can")


@lru_cache(maxsize=64)
def build(plan: Blueprint, compiled: bool = True) -> Compiled:
    """Return the kernel of `plan`, compiled, or as the plain Python twin of the same text."""
    text = _text(plan)
    space = _defined(plan, text, compiled)

    def track(*args: Any) -> int:
        return int(space["track"](*args))

    def run(*args: Any) -> int:
        return int(space["run"](*args))

    def derivative(*args: Any) -> None:
        space["derivative"](*args)

    return Compiled(_told(derivative), _told(track), _told(run), text)


@lru_cache(maxsize=64)
def build_march(plan: Blueprint, compiled: bool = True) -> Callable[..., int]:
    """Return the stroboscopic map of `plan` with tangent vectors, compiled, or as its plain Python twin."""
    space, n = _defined(plan, _text(plan, "tangent.txt"), compiled), plan.n

    def march(*args: Any) -> int:
        return int(space["march"](*args, np.zeros((10, n)), np.zeros((3, n, n))))

    return _told(march)


def _defined(plan: Blueprint, text: str, compiled: bool) -> dict[str, Any]:
    """Return the functions that `text` defines, compiled or plain."""
    parts = _parts(plan)
    if not compiled:
        slow = {"jit": lambda f: f, "view": slow_view, "vector": slow_vector, "square": slow_square}
        return _module(text, "<slow twin>", {**parts, **slow})
    path = _cached(text, parts)
    part = numba.njit(**BARE)
    whole = numba.njit(**BARE, cache=True)
    fast = {"jit": whole, "view": view, "vector": vector, "square": square}
    return _module(text, str(path), {**{name: part(f) for name, f in parts.items()}, **fast})


def _module(text: str, path: str, parts: dict[str, Any]) -> dict[str, Any]:
    """Return the functions of `text`, defined in a module of its own: numba looks it up when it loads its cache."""
    module = ModuleType(Path(path).stem)
    module.__dict__.update(parts)
    sys.modules[module.__name__] = module
    exec(compile(text, path, "exec"), module.__dict__)  # noqa: S102 - our own template, filled with numbers only
    return module.__dict__


def _told(function: Callable[..., Any]) -> Callable[..., Any]:
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
        except (OSError, MemoryError):  # a full disk under the cache is no fault of a model
            raise
        except Exception as err:
            raise ContractError(
                f"a model or term raised {type(err).__name__} ({' '.join(str(err).split())}): let it return a number"
                " for any motion"
            ) from err

    return call
