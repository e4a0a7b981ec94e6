"""Plugins of other people: held against their contract before they are relied upon, and set aside where they fail.

Models and terms are compiled into one kernel, so a bad one would take all others down: they are tried beforehand, by
the rules of the conformance kit. Methods are watched while they work. What comes with lostmotion has been tested.
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
LOOKS = 2000


@contextmanager
def within_numbers() -> Iterator[None]:
    """Tell in one sentence that a computation left all numbers: as a decorator of what fits a model."""
    try:
        yield
    except np.linalg.LinAlgError as err:
        raise DataError(
            f"the computation broke down ({err}): where it was tried, the model leaves all bounds along the recording;"
            " narrow the priors, check units and signs, or sample a stiff contact faster"
        ) from err


def sound(registry: Registry, kind: str, name: str, **options: Any) -> Any:
    """Return an instance of a plugin; raise `ContractError` where one of other people breaks its contract."""
    entry, made = registry.entry(kind, name), registry.make(kind, name, **options)
    cls: Any = type(made)
    if not entry.ours and (fault := _fault(cls)):
        raise ContractError(
            f"{entry.whose} cannot be used, for it breaks the rule {fault.rule} of its contract: {fault.sentence}"
            f" `lostmotion plugins check {name}` tells all",
            name,
        )
    return made


@lru_cache(maxsize=256)
def _fault(cls: type[Any]) -> Finding | None:
    """Return the first rule that a class breaks and that a host relies upon, or None."""
    return next((finding for finding in check(cls) if finding.fatal), None)


def usable_terms(registry: Registry) -> tuple[list[type[Term]], tuple[str, ...]]:
    """Return all terms that can be relied upon, and a sentence on each plugin that was set aside."""
    terms, aside = [], [e.why for e in registry.entries() if e.why and e.kind in ("term", "package")]
    for name in registry.names("term"):
        try:
            sound(registry, "term", name)
            terms.append(registry.load("term", name))
        except LostMotionError as err:
            aside.append(str(err))
    return terms, tuple(note_set_aside(why) for why in dict.fromkeys(aside))


def note_set_aside(why: str) -> str:
    """Return the sentence on a plugin that is set aside, having warned with it."""
    sentence = f"Set aside: {why.rstrip('.')}."
    warnings.warn(sentence, PluginWarning, stacklevel=3)
    return sentence


def theirs(registry: Registry, terms: tuple[Term, ...]) -> tuple[str, ...]:
    """Return the keys of those terms that other people brought."""
    return tuple(key_of(term) for term in terms if not registry.entry("term", term.name).ours)


def raising(terms: Iterable[Term], observations: Sequence[Observation]) -> set[str]:
    """Return the keys of those terms whose force raises somewhere along recorded motions."""
    return {key_of(term) for term in terms if any(_raises(term, observation) for observation in observations)}


def _raises(term: Term, observation: Observation) -> bool:
    """Return whether the force of a term, of size one, raises at one of many points of a recording."""
    try:
        for told in list_calls(term, observation, LOOKS):
            term.force(*told)
    except Exception:
        return True
    return False


def blamed(registry: Registry, keys: Iterable[str], err: ContractError) -> str:
    """Return the sentence that names the terms, by key, one of which broke down."""
    names = sorted({key.partition("@")[0] for key in keys})
    whose = " or ".join(registry.entry("term", name).whose for name in names)
    return f"{whose}: {err}; `lostmotion plugins check {' '.join(names)}` may tell what to mend"


@dataclass
class Guests:
    """Watches the methods of other people at work; `said` grows by a sentence for each one that fails."""

    registry: Registry
    said: list[str] = field(default_factory=list)

    def __call__(self, kind: str, name: str, x: Array, work: Callable[[], T]) -> T | None:
        """Return what a method makes of the samples `x`, or None where it breaks its contract."""
        entry = self.registry.entry(kind, name)
        if entry.ours:
            return work()
        found, wrong = _watched(x, work)
        if not wrong:
            return found
        self.said.append(note_set_aside(f"{entry.whose} {wrong}: `lostmotion plugins check {name}` tells what to mend"))
        return None


def _watched(x: Array, work: Callable[[], T]) -> tuple[T | None, str]:
    """Return what `work` returns and an empty string, or None and what was wrong; `x` is as it was afterwards."""
    held, state = x.copy(), np.random.get_state()  # noqa: NPY002 - it is watched, not used
    found, wrong = None, ""
    try:
        found = work()
    except Exception as err:
        verb = "broke its contract" if isinstance(err, ContractError) else f"raised {type(err).__name__}"
        wrong = f"{verb} ({' '.join(str(err).split())})"
    if not np.array_equal(x, held, equal_nan=True):
        x[:] = held
        wrong = wrong or "changed the samples that it was given"
    if not _same(state, np.random.get_state()):  # noqa: NPY002
        np.random.set_state(state)  # noqa: NPY002
        wrong = wrong or "drew from NumPy's global generator, so that the same seed would not give the same answer"
    return (None, wrong) if wrong else (found, "")


def _same(one: Any, two: Any) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
