"""The class of a rule, and the rules for all kinds. The docstring of a rule is the advice when it is broken.

A rule takes a component and returns what is wrong, or an empty string. Rules of declaration are checked first; rules of
behaviour only for a component whose declaration is correct, since they use it. A rule of courtesy concerns readers: a
component that breaks it can be used all the same.

A component may list rules that it breaks on purpose, each with the reason: `known_failures = {"has_a_null": "..."}`.
"""

from __future__ import annotations

import inspect
import pickle
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from lostmotion.contracts import KINDS

Judge = Callable[[Any], str]
SNAKE = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_LONGEST = 240
_RULES: list[Rule] = []


@dataclass(frozen=True)
class Finding:
    """The result of one rule for a component; if it is broken, what was found and what to do.

    `known` is the reason that the component gives for breaking the rule.
    """

    component: str
    rule: str
    ok: bool
    found: str = ""
    advice: str = ""
    courtesy: bool = False
    known: str = ""

    @property
    def fatal(self) -> bool:
        """Whether the framework cannot use the component."""
        return not (self.ok or self.courtesy or self.known)

    @property
    def sentence(self) -> str:
        """What was found and what to do; empty if the rule is fulfilled."""
        return "" if self.ok else f"{self.found}. {self.advice}"

    def __str__(self) -> str:
        return f"{self.component}, {self.rule}: {self.sentence or 'ok'}"


@dataclass(frozen=True)
class Rule:
    """One rule for components of the given kinds."""

    name: str
    kinds: tuple[str, ...]
    judge: Judge
    declaration: bool = False
    courtesy: bool = False

    @property
    def advice(self) -> str:
        """The docstring of the rule, as one paragraph."""
        return " ".join((self.judge.__doc__ or "").split())

    def __call__(self, component: Any) -> Finding:
        """Return the finding for one component; an exception of its code is a finding too."""
        try:
            found = self.judge(component)
        except Exception as err:
            found = format_error(err)
        label = str(getattr(component, "name", type(component).__name__))
        if not found:
            return Finding(label, self.name, True, courtesy=self.courtesy)
        known = known_of(component).get(self.name, "")
        return Finding(label, self.name, False, found, self.advice, self.courtesy, known)


def known_of(component: Any) -> Mapping[str, str]:
    """Return the rules that a component breaks on purpose, with its reasons."""
    known = getattr(component, "known_failures", {})
    good = isinstance(known, Mapping) and all(isinstance(v, str) and v.strip() for v in known.values())
    return known if good else {}


def rule(*kinds: str, declaration: bool = False, courtesy: bool = False) -> Callable[[Judge], Judge]:
    """Return a decorator that makes a function a rule of these kinds."""

    def note(judge: Judge) -> Judge:
        _RULES.append(Rule(judge.__name__, kinds, judge, declaration, courtesy))
        return judge

    return note


def rules_for(kind: str) -> tuple[Rule, ...]:
    """Return the rules of a kind, those of declaration first."""
    return tuple(sorted((r for r in _RULES if kind in r.kinds), key=lambda r: not r.declaration))


def format_error(err: Exception) -> str:
    """Return the type and the message of an error in one line of limited length."""
    words = " ".join(str(err).split())
    return f"it raised {type(err).__name__}: {words[:_LONGEST]}{' ...' if len(words) > _LONGEST else ''}"


def join_words(words: Any) -> str:
    """Return words as a list with commas."""
    return ", ".join(str(w) for w in words)


def _contract_of(component: Any) -> type[Any]:
    return next(base for base in KINDS.values() if isinstance(component, base))


@rule(*KINDS, declaration=True)
def is_frozen_dataclass(component: Any) -> str:
    """Write `@dataclass(frozen=True)` above the class: a component is a value that its fields determine."""
    params = vars(type(component)).get("__dataclass_params__")
    return (
        "" if params is not None and params.frozen else f"{type(component).__name__} is not a frozen dataclass itself"
    )


@rule(*KINDS, declaration=True)
def name_is_snake_case(component: Any) -> str:
    """Give the class a name of lower-case words joined by underscores, such as `name = "coulomb_friction"`."""
    name = getattr(component, "name", None)
    return "" if isinstance(name, str) and SNAKE.fullmatch(name) else f"its name is {name!r}"


@rule(*KINDS, declaration=True, courtesy=True)
def paper_is_cited(component: Any) -> str:
    """Cite in `paper` the source of the law or the method: authors, place and year."""
    paper = getattr(component, "paper", None)
    good = isinstance(paper, str) and len(paper.split()) > 1
    return "" if good else f"its paper is {paper!r}"


@rule(*KINDS, declaration=True, courtesy=True)
def has_docstring(component: Any) -> str:
    """Write a docstring for the class: `lostmotion plugins show` prints it."""
    cls = type(component)
    written = vars(cls).get("__doc__") or ""
    made_by_dataclass = written.startswith(f"{cls.__name__}(")
    return "" if written.strip() and not made_by_dataclass else f"{cls.__name__} has no docstring of its own"


@rule(*KINDS, declaration=True, courtesy=True)
def known_failures_are_named(component: Any) -> str:
    """Map in `known_failures` each broken rule of this kind to its reason: `{"has_a_null": "because ..."}`."""
    known, base = getattr(component, "known_failures", {}), _contract_of(component)
    if known and known_of(component) is not known:
        return f"known_failures is {known!r}"
    names = {r.name for kind, own in KINDS.items() if own is base for r in rules_for(kind)}
    unknown = [name for name in known if name not in names]
    return f"known_failures names {unknown[0]!r}, which is not a rule of this kind" if unknown else ""


@rule(*KINDS, declaration=True)
def attributes_are_complete(component: Any) -> str:
    """Define every class variable of the contract with its type: a tuple of one word is `("position",)`."""
    wanted = {
        "ClassVar[tuple": tuple, "ClassVar[Mapping": Mapping | tuple, "ClassVar[frozenset": frozenset,
        "ClassVar[str": str, "ClassVar[Literal": str,
    }  # fmt: skip
    contract = _contract_of(component)
    notes = {name: note for base in contract.__mro__[::-1] for name, note in inspect.get_annotations(base).items()}
    for name, note in notes.items():
        if not hasattr(component, name):
            return f"{name} is missing"
        for start, kind in wanted.items():
            if str(note).startswith(start) and not isinstance(getattr(component, name), kind):
                return f"{name} is {getattr(component, name)!r}, where a {getattr(kind, '__name__', kind)} is expected"
    return ""


@rule(*KINDS, declaration=True, courtesy=True)
def methods_have_the_arguments_of_the_contract(component: Any) -> str:
    """Copy the line with `def` from the contract: the framework passes exactly these arguments in this order."""
    base = _contract_of(component)
    methods = {name for name in base.__abstractmethods__ if not isinstance(getattr(base, name), property)}
    for name in sorted(methods | (set(vars(base)) & {"rate"})):
        wanted, own = _argument_names(base, name), _argument_names(type(component), name)
        if own != wanted:
            return f"{name} takes ({join_words(own)}), where ({join_words(wanted)}) is expected"
    return ""


def _argument_names(cls: type[Any], name: str) -> list[str]:
    return [name for name in inspect.signature(getattr(cls, name)).parameters if name != "self"]


@rule(*KINDS, courtesy=True)
def can_be_pickled(component: Any) -> str:
    """Use plain data for all fields and define the class at module level: it is sent to other processes."""
    same = pickle.loads(pickle.dumps(component)) == component  # noqa: S301 - our own bytes, made a moment ago
    return "" if same else "it is not equal to itself after pickling"
