"""The registry of plugins: names are collected from hooks, and a class is imported only when its name is used.

Each package is queried separately, so that a faulty one does not affect the others; it is listed with the reason.
Listing the names imports neither NumPy nor numba nor the contracts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import nullcontext
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import lru_cache
from importlib import metadata
from pathlib import Path
from types import ModuleType
from typing import Any

from lostmotion.defaults import SOURCES
from lostmotion.errors import LostMotionError, PluginError, nearest
from lostmotion.hookspecs import GROUP
from lostmotion.offers import ALL_KINDS, FAILURES, KINDS, Host, RefusedError, call_guarded, first_line
from lostmotion.provenance import digest
from lostmotion.registry.classes import (
    class_of,
    classes_in,
    import_target,
    import_texts,
    kind_of,
    module_from,
    require_class,
    sources,
    warn_if_slow,
)

__all__ = ["KINDS", "Entry", "Registry", "default", "import_texts", "sources"]

OURS = "lostmotion"
_PACKAGE = "package"


@dataclass(frozen=True)
class Entry:
    """One offered name, or a faulty package that offers nothing (kind "package").

    `state` is "ready", "broken", "clash" or "misspelt hook"; `why` is one sentence when it is not "ready". `about` is
    the help line of a function, or what the library of a reader is called for pip.
    """

    kind: str
    name: str
    owner: str
    version: str
    target: str
    state: str = "ready"
    why: str = ""
    about: str = ""

    @property
    def whose(self) -> str:
        """The name as the subject of a sentence: `term 'drag' of my_package`; of a file without its folders."""
        owner = Path(self.owner).name if self.owner.endswith(".py") else self.owner
        return f"{self.kind} {self.name!r} of {owner}"

    @property
    def ours(self) -> bool:
        """Whether it is part of lostmotion itself."""
        return self.owner == OURS


class Registry:
    """The names of all plugins with their owners, and access from a name to its class."""

    def __init__(self) -> None:
        self._host = Host()
        self._offers: list[Entry] = []
        self._given: dict[Entry, Any] = {}
        self._files: dict[str, str] = {}

    @classmethod
    def discover(cls, files: Iterable[str | Path] = ()) -> Registry:
        """Return a registry of installed packages with entry points in the group `lostmotion.v1`, and of `files`."""
        registry = cls()
        for point in metadata.entry_points(group=GROUP):
            registry._admit(point)
        for file in files:
            registry.add_file(file)
        return registry

    def add(self, obj: object, name: str | None = None) -> Registry:
        """Return this registry after adding `obj`: a module or object with hooks, or a class or instance of a kind.

        `name` is the owner in lists. A class that is added again replaces the earlier one, so that a notebook cell can
        be run again. A faulty plugin raises `PluginError`.
        """
        if not isinstance(obj, ModuleType) and kind_of(obj):
            self._give(obj, name or class_of(obj).__module__)
            return self
        owner = name or str(getattr(obj, "__name__", type(obj).__name__))
        try:
            self._ask(obj, owner, str(getattr(obj, "__version__", "")))
        except RefusedError as err:
            raise PluginError(f"plugin {owner} cannot be used: {err}") from err
        return self

    def add_file(self, path: str | Path) -> Registry:
        """Return this registry after adding a .py file: its hooks, or each Model, Term ... class defined in it."""
        module = module_from(Path(path))
        self._files[Path(path).name] = digest(Path(path))
        if self._host.has_hooks(module):
            return self.add(module, str(path))
        if not (found := classes_in(module)):
            raise PluginError(f"{path} contains no plugin: write a subclass of Model or Term in it, or a hookimpl")
        for component in found:
            self._give(component, str(path))
        return self

    def names(self, kind: str) -> tuple[str, ...]:
        """Return the usable names of this kind, sorted; `entries` also lists the others."""
        _require_kind(kind)
        return tuple(e.name for e in self.entries() if e.kind == kind and e.state == "ready")

    def entries(self) -> tuple[Entry, ...]:
        """Return all offered names, sorted by kind and name, with the reason where one cannot be used."""
        order = {kind: i for i, kind in enumerate((*ALL_KINDS, _PACKAGE))}
        checked = (self._checked_for_clash(e) for e in self._offers)
        return tuple(sorted(checked, key=lambda e: (order[e.kind], e.name, e.owner)))

    def offered(self, kind: str) -> dict[str, Entry]:
        """Return the usable names of a kind of `offers` that packages add, such as `COMMAND`, with their entries."""
        return {e.name: e for e in self.entries() if e.kind == kind and e.state == "ready"}

    def function(self, kind: str, name: str) -> Callable[..., Any]:
        """Return the function of a kind of `offers`; raise `PluginError` where no usable package offers the name."""
        entry = self.offered(kind).get(name)
        if entry is None:
            raise PluginError(self.explain_absence(kind, name))
        found: Callable[..., Any] = import_target(entry.target, entry.whose, Callable)  # type: ignore[arg-type]
        return found

    def explain_absence(self, kind: str, name: str) -> str:
        """Return the sentence on a function that no usable package offers."""
        faulty = [e for e in self.entries() if e.why and ((e.kind, e.name) == (kind, name) or e.kind == _PACKAGE)]
        if faulty:
            return f"the {kind} {name!r} cannot be used: {faulty[0].owner}: {faulty[0].why}"
        source = f"it belongs to {SOURCES[name]}, so install this" if name in SOURCES else "install one that does"
        return f"no installed package offers the {kind} {name!r}: {source}"

    def entry(self, kind: str, name: str) -> Entry:
        """Return the entry of a name; raise `PluginError` when it is unknown or offered twice."""
        return self._find(kind, name)

    def origins(self, *used: tuple[str, str]) -> dict[str, str]:
        """Return the third-party sources: the SHA-256 of each plugin file, and the version of each package.

        Where plugins are given as `used`, each by kind and name, only the sources of these are returned.
        """
        third_party = [e for e in self._offers if not e.ours and (not used or (e.kind, e.name) in used)]
        packages = {e.owner: e.version for e in third_party if e.version}
        files = {Path(e.owner).name for e in third_party}
        return {**packages, **{name: digest for name, digest in self._files.items() if name in files}}

    def load(self, kind: str, name: str) -> type[Any]:
        """Return the class of a name; raise `PluginError` when it is unknown, offered twice or of another kind."""
        return class_of(self._loaded(kind, name))

    def make(self, kind: str, name: str, **options: Any) -> Any:
        """Return an instance with these fields set; for an instance that was added, itself or a changed copy."""
        given = self._loaded(kind, name)
        _require_options(class_of(given), f"{kind} {name!r}", options)
        try:
            if isinstance(given, type):
                return given(**options)
            return replace(given, **options) if options else given
        except LostMotionError:
            raise
        except FAILURES as err:
            raise PluginError(f"{kind} {name!r} cannot be made: {first_line(err)}: check its options") from err

    def _loaded(self, kind: str, name: str) -> Any:
        """Return the class of a name, or the instance that was added under it."""
        entry = self._find(kind, name)
        given = self._given.get(entry)
        if given is None:
            with nullcontext() if entry.ours else warn_if_slow(entry.whose):
                given = import_target(entry.target, entry.whose)
        require_class(class_of(given), kind, name, entry.whose)
        return given

    def _admit(self, point: metadata.EntryPoint) -> None:
        """Add the plugin of one entry point, or an entry with the reason why it cannot be used."""
        owner, version = (point.dist.name, point.dist.version) if point.dist else (point.module, "")
        try:
            self._ask(call_guarded(point.load, "it could not be imported"), owner, version)
        except RefusedError as err:
            self._offers.append(Entry(_PACKAGE, point.name, owner, version, point.value, err.state, str(err)))

    def _ask(self, plugin: object, owner: str, version: str) -> None:
        for offer in self._host.ask(plugin, owner):
            self._offers.append(Entry(offer.kind, offer.name, owner, version, offer.target, about=offer.about))

    def _give(self, obj: Any, owner: str) -> None:
        kind, cls = kind_of(obj), class_of(obj)
        name = getattr(cls, "name", None)
        if not isinstance(name, str):
            raise PluginError(f"{kind} class {cls.__name__} has no name: write `name = ...` in its body")
        entry = Entry(kind, name, owner, "", f"{cls.__module__}:{cls.__qualname__}")
        require_class(cls, kind, name, entry.whose)
        again = (owner, kind, name)
        self._offers = [e for e in self._offers if (e.owner, e.kind, e.name) != again]
        self._offers.append(entry)
        self._given[entry] = obj

    def _checked_for_clash(self, entry: Entry) -> Entry:
        """Return the entry, marked as a clash if another owner offers the same name."""
        same = [e for e in self._offers if (e.kind, e.name) == (entry.kind, entry.name)]
        if entry.kind == _PACKAGE or len(same) == 1:
            return entry
        owners = " and ".join(sorted(f"{e.owner} {e.version}".strip() for e in same))
        why = f"{entry.kind} {entry.name!r} is offered by {owners}: remove one, or ask its author to rename it"
        return replace(entry, state="clash", why=why)

    def _find(self, kind: str, name: str) -> Entry:
        """Return the only entry of this name; raise `PluginError` where there is none or another one."""
        _require_kind(kind)
        same = [e for e in self._offers if e.name == name and e.kind != _PACKAGE]
        for entry in (e for e in same if e.kind == kind):
            if (checked := self._checked_for_clash(entry)).state != "ready":
                raise PluginError(checked.why)
            return entry
        near = nearest(name, self.names(kind))
        if same:
            raise PluginError(f"{name!r} is a {same[0].kind}, and a {kind} was expected{near}")
        raise PluginError(f"no {kind} is called {name!r}{near}: {self._advice(kind)}")

    def _advice(self, kind: str) -> str:
        aside = sorted({e.owner for e in self._offers if e.kind == _PACKAGE})
        known = ", ".join(self.names(kind)) or "none yet"
        return f"there are {known}" + (f"; not usable: {', '.join(aside)}" if aside else "")


@lru_cache(maxsize=1)
def default() -> Registry:
    """Return the registry of this process: the installed plugins, and those that were added to it since."""
    return Registry.discover()


def _require_kind(kind: str) -> None:
    if kind not in KINDS:
        near = nearest(kind, KINDS)
        raise PluginError(f"there is no kind {kind!r} of plugin{near}: the kinds are {', '.join(KINDS)}")


def _require_options(cls: type[Any], what: str, options: dict[str, Any]) -> None:
    known = [f.name for f in fields(cls) if f.init] if is_dataclass(cls) else []
    for option in options:
        if option not in known:
            has = ", ".join(known) or "none"
            raise PluginError(f"{what} has no option {option!r}{nearest(option, known)}: it has {has}")
