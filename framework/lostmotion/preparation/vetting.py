"""Third-party plugins: checked against their contract before use, and set aside where they fail.

Models and terms are compiled into one kernel, in which a faulty one would affect all others. They are checked before
use with the rules of the conformance kit. Methods are checked while they run. Built-in plugins have been tested.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np

from lostmotion.contracts import Array, Term
from lostmotion.errors import ContractError, DataError, LostMotionError, PluginWarning
from lostmotion.inference.calls import list_calls
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import key_of
from lostmotion.registry import Registry
from lostmotion.testing import Finding, check

T = TypeVar("T")
POINTS = 2000
"""The number of points of a recording at which the force of a term is tried."""


@contextmanager
def catch_divergence() -> Iterator[None]:
    """Turn a failure of linear algebra into a `DataError` with one sentence; a decorator of functions that fit."""
    try:
        yield
    except np.linalg.LinAlgError as err:
        raise DataError(
            f"the computation broke down ({err}): where it was tried, the model diverges along the recording;"
            " narrow the priors, check units and signs, or sample a stiff contact faster"
        ) from err


def make_plugin(registry: Registry, kind: str, name: str, **options: Any) -> Any:
    """Return an instance of a plugin; raise `ContractError` where a third-party one breaks its contract."""
    entry, made = registry.entry(kind, name), registry.make(kind, name, **options)
    cls: Any = type(made)
    if not entry.ours and (fault := _find_fault(cls)):
        raise ContractError(
            f"{entry.whose} cannot be used, because it breaks the rule {fault.rule} of its contract: {fault.sentence}"
            f" `lostmotion plugins check {name}` lists all rules",
            name,
        )
    return made


@lru_cache(maxsize=256)
def _find_fault(cls: type[Any]) -> Finding | None:
    """Return the finding of the first broken rule on which the framework relies, or None."""
    return next((finding for finding in check(cls) if finding.fatal), None)


def usable_terms(registry: Registry) -> tuple[list[type[Term]], tuple[str, ...]]:
    """Return all usable terms, and a sentence on each plugin that was set aside."""
    terms, aside = [], [e.why for e in registry.entries() if e.why and e.kind in ("term", "package")]
    for name in registry.names("term"):
        try:
            make_plugin(registry, "term", name)
            terms.append(registry.load("term", name))
        except LostMotionError as err:
            aside.append(str(err))
    return terms, tuple(note_set_aside(why) for why in dict.fromkeys(aside))


def note_set_aside(why: str) -> str:
    """Return the sentence on a plugin that is set aside, after issuing it as a warning."""
    sentence = f"Set aside: {why.rstrip('.')}."
    warnings.warn(sentence, PluginWarning, stacklevel=3)
    return sentence


def third_party_keys(registry: Registry, terms: tuple[Term, ...]) -> tuple[str, ...]:
    """Return the keys of third-party terms."""
    return tuple(key_of(term) for term in terms if not registry.entry("term", term.name).ours)


def find_raising_terms(terms: Iterable[Term], observations: Sequence[Observation]) -> set[str]:
    """Return the keys of terms whose force raises an error somewhere along recorded motions."""
    return {key_of(term) for term in terms if any(_raises_error(term, observation) for observation in observations)}


def _raises_error(term: Term, observation: Observation) -> bool:
    """Return whether the force of a term, of size one, raises an error at one of many points of a recording."""
    try:
        for args in list_calls(term, observation, POINTS):
            term.force(*args)
    except Exception:
        return True
    return False


def name_suspects(registry: Registry, keys: Iterable[str], err: ContractError) -> str:
    """Return the sentence that names the terms, by key, one of which failed."""
    names = sorted({key.partition("@")[0] for key in keys})
    whose = " or ".join(registry.entry("term", name).whose for name in names)
    return f"{whose}: {err}; `lostmotion plugins check {' '.join(names)}` may show the error"


@dataclass
class MethodWatch:
    """Checks third-party methods while they run; `said` contains a sentence for each one that failed."""

    registry: Registry
    said: list[str] = field(default_factory=list)

    def __call__(self, kind: str, name: str, x: Array, work: Callable[[], T]) -> T | None:
        """Return the result of a method for the samples `x`, or None where it breaks its contract."""
        entry = self.registry.entry(kind, name)
        if entry.ours:
            return work()
        found, wrong = _watch_call(x, work)
        if not wrong:
            return found
        self.said.append(note_set_aside(f"{entry.whose} {wrong}: `lostmotion plugins check {name}` shows the errors"))
        return None


def _watch_call(x: Array, work: Callable[[], T]) -> tuple[T | None, str]:
    """Return the result of `work` and an empty string, or None and what was wrong; a changed `x` is restored."""
    held, state = x.copy(), np.random.get_state()  # noqa: NPY002 - only compared, not used
    found, wrong = None, ""
    try:
        found = work()
    except Exception as err:
        verb = "broke its contract" if isinstance(err, ContractError) else f"raised {type(err).__name__}"
        wrong = f"{verb} ({' '.join(str(err).split())})"
    if not np.array_equal(x, held, equal_nan=True):
        x[:] = held
        wrong = wrong or "changed the samples that it was given"
    if not _same_state(state, np.random.get_state()):  # noqa: NPY002
        np.random.set_state(state)  # noqa: NPY002
        wrong = wrong or "drew from NumPy's global generator, so that the same seed would not give the same answer"
    return (None, wrong) if wrong else (found, "")


def _same_state(one: Any, two: Any) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
