"""What a rule is, and the rules that hold for every kind; a rule's docstring is the advice it gives when broken.

A rule takes a component and returns what it found to be wrong, or an empty string. Rules of declaration come first;
the rules of behaviour are tried only on a component whose declaration is right, since they read it. A rule of courtesy
is for people: a component that breaks it can be relied upon all the same.

A component may name rules that it is known to break, each with the reason: `known_failures = {"has_a_null": "..."}`.
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
    """Whether a component keeps one rule; if not, what was found and what to do about it.

    `known` is the reason that the component itself gives for breaking the rule.
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
        """Whether a host cannot rely on the component."""
        return not (self.ok or self.courtesy or self.known)

    @property
    def sentence(self) -> str:
        """What was found and what to do, empty when all is well."""
        return "" if self.ok else f"{self.found}. {self.advice}"

    def __str__(self) -> str:
        return f"{self.component}, {self.rule}: {self.sentence or 'ok'}"


@dataclass(frozen=True)
class Rule:
    """One thing that a component of the given kinds must keep."""

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
        """Return the finding for one component; whatever its code raises is a finding too."""
        try:
            found = self.judge(component)
        except Exception as err:
            found = raised(err)
        label = str(getattr(component, "name", type(component).__name__))
        if not found:
            return Finding(label, self.name, True, courtesy=self.courtesy)
        known = known_of(component).get(self.name, "")
        return Finding(label, self.name, False, found, self.advice, self.courtesy, known)


def known_of(component: Any) -> Mapping[str, str]:
    """Return the rules that a component is known to break, with its reasons."""
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


def raised(err: Exception) -> str:
    """Return what an error says, in one line and not longer than people read."""
    words = " ".join(str(err).split())
    return f"it raised {type(err).__name__}: {words[:_LONGEST]}{' ...' if len(words) > _LONGEST else ''}"


def listed(words: Any) -> str:
    """Return words as people list them."""
    return ", ".join(str(w) for w in words)


def _base(component: Any) -> type[Any]:
    return next(base for base in KINDS.values() if isinstance(component, base))


@rule(*KINDS, declaration=True)
def is_frozen_dataclass(component: Any) -> str:
    """Write `@dataclass(frozen=True)` above the class: a component is a value, and what it does is in its fields."""
    params = vars(type(component)).get("__dataclass_params__")
    return "" if params is not None and params.frozen else f"{type(component).__name__} is no frozen dataclass itself"


@rule(*KINDS, declaration=True)
def name_is_snake_case(component: Any) -> str:
    """Give the class a name of lower-case words joined by underscores, such as `name = "coulomb_friction"`."""
    name = getattr(component, "name", None)
    return "" if isinstance(name, str) and SNAKE.fullmatch(name) else f"its name is {name!r}"


@rule(*KINDS, declaration=True, courtesy=True)
def paper_is_cited(component: Any) -> str:
    """Say in `paper` where the law or the method is written down: authors, place and year."""
    paper = getattr(component, "paper", None)
    good = isinstance(paper, str) and len(paper.split()) > 1
    return "" if good else f"its paper is {paper!r}"


@rule(*KINDS, declaration=True, courtesy=True)
def has_docstring(component: Any) -> str:
    """Write a docstring under the class line: `lostmotion plugins show` prints it."""
    cls = type(component)
    written = vars(cls).get("__doc__") or ""
    made_by_dataclass = written.startswith(f"{cls.__name__}(")
    return "" if written.strip() and not made_by_dataclass else f"{cls.__name__} has no docstring of its own"


@rule(*KINDS, declaration=True, courtesy=True)
def known_failures_are_named(component: Any) -> str:
    """Map in `known_failures` rules of this kind to the reason why each is broken: `{"has_a_null": "because ..."}`."""
    known, base = getattr(component, "known_failures", {}), _base(component)
    if known and known_of(component) is not known:
        return f"known_failures is {known!r}"
    names = {r.name for kind, own in KINDS.items() if own is base for r in rules_for(kind)}
    unknown = [name for name in known if name not in names]
    return f"known_failures names {unknown[0]!r}, which is no rule of this kind" if unknown else ""


@rule(*KINDS, declaration=True)
def attributes_are_complete(component: Any) -> str:
    """Give every class variable that the contract names, in its type: one word in a tuple is `("position",)`."""
    wanted = {"ClassVar[tuple": tuple, "ClassVar[frozenset": frozenset, "ClassVar[str": str, "ClassVar[Literal": str}
    for name, note in inspect.get_annotations(_base(component)).items():
        if not hasattr(component, name):
            return f"{name} is missing"
        for start, kind in wanted.items():
            if str(note).startswith(start) and not isinstance(getattr(component, name), kind):
                return f"{name} is {getattr(component, name)!r}, and a {kind.__name__} was wanted"
    return ""


@rule(*KINDS, declaration=True, courtesy=True)
def methods_have_the_arguments_of_the_contract(component: Any) -> str:
    """Copy the line with `def` from the contract: the host passes exactly these arguments, in this order."""
    base = _base(component)
    for name in sorted(base.__abstractmethods__ | (set(vars(base)) & {"rate"})):
        wanted, own = _arguments(base, name), _arguments(type(component), name)
        if own != wanted:
            return f"{name} takes ({listed(own)}), and ({listed(wanted)}) was wanted"
    return ""


def _arguments(cls: type[Any], name: str) -> list[str]:
    return [name for name in inspect.signature(getattr(cls, name)).parameters if name != "self"]


@rule(*KINDS, courtesy=True)
def can_be_pickled(component: Any) -> str:
    """Let every field be plain data and the class stand at the top of its module: it is sent to other processes."""
    same = pickle.loads(pickle.dumps(component)) == component  # noqa: S301 - our own bytes, made a moment ago
    return "" if same else "it comes back from pickling as something else"
