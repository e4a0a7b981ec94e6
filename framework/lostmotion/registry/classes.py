"""Import of plugin classes by target and of plugin files, with clear messages for failures."""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import sys
import tempfile
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

from lostmotion.errors import PluginError, PluginWarning, nearest
from lostmotion.offers import FAILURES, first_line
from lostmotion.registry.declarations import find_misfit

_NAMES: Mapping[type[Any], str] = {type: "class", Callable: "function"}  # type: ignore[dict-item]
SLOW = 2.0
"""The time (s) of an import above which a warning is given."""


def class_of(obj: Any) -> type[Any]:
    """Return `obj` itself if it is a class, else its class."""
    return obj if isinstance(obj, type) else type(obj)


def kind_of(obj: object) -> str:
    """Return the kind of a class or instance, or an empty string; this imports the contracts."""
    from lostmotion import contracts

    return next((kind for kind, base in contracts.KINDS.items() if issubclass(class_of(obj), base)), "")


@contextmanager
def warn_if_slow(whose: str) -> Iterator[None]:
    """Warn if the import in this context takes long; `whose` begins the sentence."""
    from lostmotion import contracts  # noqa: F401 - not counted: every plugin needs it

    begin = time.perf_counter()
    yield
    if (seconds := time.perf_counter() - begin) > SLOW:
        says = (
            f"{whose} took {seconds:.1f} s to import: ask its author to import slow packages only where they are used"
        )
        warnings.warn(says, PluginWarning, stacklevel=3)


def import_target(target: str, whose: str, wanted: type[Any] = type) -> Any:
    """Return the object at `target` ("package.module:name"), which must be a class or another `wanted` type.

    Raise `PluginError` if it cannot be imported; `whose` begins the message.
    """
    module, _, attribute = target.partition(":")
    try:
        found = importlib.import_module(module)
    except FAILURES as err:
        raise PluginError(f"{whose} could not be imported from {module}: {first_line(err)}: inform its author") from err
    if not isinstance(thing := getattr(found, attribute, None), wanted):
        near, what = nearest(attribute, vars(found)), _NAMES.get(wanted, wanted.__name__)
        raise PluginError(f"{whose} points to {target}, and there is no such {what}{near}: correct its hook")
    return thing


def require_class(cls: type[Any], kind: str, name: str, whose: str) -> None:
    """Raise `PluginError` unless `cls` is a complete class of this kind with the name `name`."""
    if (own := kind_of(cls)) != kind:
        what = f"a {own}" if own else "no plugin class"
        raise PluginError(f"{whose} points to {cls.__name__}, which is {what}: subclass {kind.capitalize()}")
    if inspect.isabstract(cls):
        lacking = ", ".join(sorted(cls.__abstractmethods__))
        raise PluginError(f"{whose} is not complete: write the method {lacking} of {cls.__name__}")
    if getattr(cls, "name", None) != name:
        raise PluginError(f"{whose} is called {getattr(cls, 'name', None)!r} in {cls.__name__}: let both names agree")
    if wrong := find_misfit(cls):
        raise PluginError(f"{whose} declares {wrong}")


def classes_in(module: ModuleType) -> list[type[Any]]:
    """Return the plugin classes defined in `module` itself, in order, without abstract bases that have no name."""
    own = [c for c in vars(module).values() if isinstance(c, type) and c.__module__ == module.__name__]
    return [c for c in own if kind_of(c) and (not inspect.isabstract(c) or "name" in vars(c))]


def module_from(path: Path) -> ModuleType:
    """Return the module in a file; it stays importable by name, so that hooks and pickles can refer to it."""
    if path.suffix != ".py" or not path.is_file():
        raise PluginError(f"plugin file {str(path)!r} does not exist or is no .py file: give the path of a Python file")
    place = str(path.resolve())
    for module in list(sys.modules.values()):
        if getattr(module, "__file__", None) == place:
            return module
    return _run_file(_free_name(path.stem), place)


def sources() -> dict[str, str]:
    """Return the text of each imported plugin file, by the name of its module, for workers on other machines."""
    return {name: Path(place).read_text(encoding="utf-8") for name, place in _FILES.items() if name in sys.modules}


def import_texts(texts: Mapping[str, str]) -> None:
    """Import plugin files given as texts, each under the name of its module, unless it is imported already."""
    with _IMPORTING:
        for name, text in texts.items():
            if name not in sys.modules:
                _FOLDERS.append(tempfile.TemporaryDirectory(prefix="lostmotion-"))
                place = Path(_FOLDERS[-1].name) / f"{name}.py"
                place.write_text(text, encoding="utf-8")
                _run_file(name, str(place))


def _free_name(stem: str) -> str:
    """Return the stem of a file if it is a free module name, else a name derived from it."""
    taken = stem in sys.modules or importlib.util.find_spec(stem) is not None if stem.isidentifier() else True
    return f"lostmotion_file_{stem}" if taken else stem


_FILES: dict[str, str] = {}
_FOLDERS: list[tempfile.TemporaryDirectory[str]] = []
_IMPORTING = threading.Lock()


def _run_file(name: str, place: str) -> ModuleType:
    while name in sys.modules:
        name += "_"
    spec = importlib.util.spec_from_file_location(name, place)
    if spec is None or spec.loader is None:
        raise PluginError(f"plugin file {place} cannot be read as Python: give the path of a Python file")
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    try:
        with warn_if_slow(f"plugin file {Path(place).name}"):
            spec.loader.exec_module(module)
    except FAILURES as err:
        del sys.modules[name]
        raise PluginError(f"plugin file {place} could not be loaded: {first_line(err)}: correct the file") from err
    _FILES[name] = place
    return module
