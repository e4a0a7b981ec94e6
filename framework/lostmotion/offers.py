"""The pluggy host: it collects the names that each plugin offers, and refuses faulty ones with a reason."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import pluggy

from lostmotion import hookspecs
from lostmotion.errors import nearest

KINDS = ("model", "dynamics", "term", "embedder", "quantifier", "surrogate", "denoiser", "noise", "simulator")
COMMAND, FUNCTION, RESULT, ROUTE, MEASURE = "command", "function", "result", "route", "measure"
SECTION, SCREEN, READER = "section", "screen", "reader"
_SAID = {
    **dict.fromkeys((COMMAND, FUNCTION, RESULT, ROUTE, MEASURE, SECTION, SCREEN), "One line of help."),
    READER: "what to install with pip if its library is absent",
}
"""The kinds that are functions; a second text belongs to each of their names."""
ALL_KINDS = (*KINDS, *_SAID)
HOOKS = {f"lostmotion_{kind.removesuffix('s')}s": kind for kind in ALL_KINDS}
FAILURES = (Exception, SystemExit)
"""The exceptions of third-party code during import and in hooks that are handled; Ctrl-C is not."""
_TARGET = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*:[^\W\d]\w*")


class Offer(NamedTuple):
    """One name that a plugin offers; `about` is the help line of a function, or what a reader needs, else empty."""

    kind: str
    name: str
    target: str
    about: str = ""


class RefusedError(Exception):
    """The reason why a plugin is refused, and its state in lists; it is always caught inside the registry."""

    def __init__(self, state: str, why: str) -> None:
        super().__init__(why)
        self.state = state


class Host:
    """Holds the valid plugins, each under its own label."""

    def __init__(self) -> None:
        self._plugins = pluggy.PluginManager(hookspecs.PROJECT)
        self._plugins.add_hookspecs(hookspecs)

    def has_hooks(self, plugin: object) -> bool:
        """Return whether anything in `plugin` is marked with `hookimpl`."""
        return any(self._plugins.parse_hookimpl_opts(plugin, name) is not None for name in dir(plugin))

    def ask(self, plugin: object, owner: str) -> list[Offer]:
        """Return the offers of `plugin`, none if it is registered already; raise `RefusedError` for a fault."""
        if self._plugins.is_registered(plugin):
            return []
        label = f"{owner} {len(self._plugins.get_plugins())}"
        try:
            self._register(plugin, label)
            offers = [offer for hook, kind in HOOKS.items() for offer in self._answers(label, hook, kind)]
            if not offers:
                raise RefusedError("broken", f"it offers no name: implement one of the hooks {', '.join(HOOKS)}")
        except RefusedError:
            if self._plugins.has_plugin(label):
                self._plugins.unregister(name=label)
            raise
        return offers

    def _register(self, plugin: object, label: str) -> None:
        try:
            self._plugins.register(plugin, label)
            self._plugins.check_pending()
        except pluggy.PluginValidationError as err:
            callers = self._plugins.get_hookcallers(plugin) or []
            unknown = [c.name for c in callers if not c.has_spec()]
            if unknown:
                why = f"hook {unknown[0]!r} is not known{nearest(unknown[0], HOOKS)}: rename it"
                raise RefusedError("misspelt hook", why) from err
            raise RefusedError("broken", "one of its hooks has arguments: write it without arguments") from err
        except FAILURES as err:
            raise RefusedError("broken", f"it could not be registered: {first_line(err)}") from err

    def _answers(self, label: str, hook: str, kind: str) -> list[Offer]:
        """Return the offers of the plugin under `label` from one hook."""
        answers: list[Offer] = []
        for impl in getattr(self._plugins.hook, hook).get_hookimpls():
            if impl.plugin_name == label:
                offer = call_guarded(impl.function, f"hook {hook!r} failed")
                answers += _check_offers(offer, hook, kind)
        return answers


def first_line(err: BaseException) -> str:
    """Return the type of an error and the first line of its message."""
    lines = str(err).strip().splitlines()
    return f"{type(err).__name__}: {lines[0]}" if lines else type(err).__name__


def call_guarded(function: Callable[[], Any], complaint: str) -> Any:
    """Return the result of `function`; an exception becomes a `RefusedError` that begins with `complaint`."""
    try:
        return function()
    except FAILURES as err:
        raise RefusedError("broken", f"{complaint}: {first_line(err)}") from err


def _check_offers(offer: Any, hook: str, kind: str) -> Iterator[Offer]:
    """Yield the offers in the result of a hook; raise `RefusedError` unless it is a mapping of names to targets."""
    example = ("package.module:function", _SAID.get(kind, ""))
    wanted = f'return {{"name": {example}}}' if kind in _SAID else 'return {"name": "package.module:Class"}'
    if not isinstance(offer, Mapping):
        raise RefusedError("broken", f"hook {hook!r} returned {type(offer).__name__}: {wanted}")
    for name, value in offer.items():
        parts = tuple(value) if kind in _SAID and isinstance(value, (tuple, list)) else (value,)
        texts = all(isinstance(text, str) for text in (name, *parts))
        if not texts or len(parts) != (2 if kind in _SAID else 1) or not _TARGET.fullmatch(parts[0]):
            raise RefusedError("broken", f"hook {hook!r} returned {{{name!r}: {value!r}}}: {wanted}")
        yield Offer(kind, name, *parts)
