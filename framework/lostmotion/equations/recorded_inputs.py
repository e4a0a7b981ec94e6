"""The inputs of equations whose text has a name of its own for what drives the machine, such as `= F` or `= tau`.

A recorded input that the equations do not name would drive nothing, and the force of the machine would be a constant.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from lostmotion.equations.read import Node, read
from lostmotion.equations.structure import find_coordinates, list_inputs, order_inputs
from lostmotion.errors import CaseError


def name_inputs(
    texts: Sequence[str], recorded: Collection[str], params: Collection[str] = ()
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the equations in which each recorded input has its name, and a sentence for a name that stood for one.

    `recorded` are the inputs of the recordings, `params` the names that are known or estimated. One name that is no
    parameter, in a summand without a coordinate, is the one input that the equations lack. `CaseError` is raised where
    there are several such names or none.
    """
    texts = tuple(texts)
    sides = [read(text) for text in texts]
    coordinates = find_coordinates(texts, sides)
    names = [node.text for node in _walk(sides) if node.kind == "name"]
    known = [name for name in list_inputs(names, params) if name not in coordinates]
    acting = order_inputs(known) if known else ()
    lacking = [name for name in dict.fromkeys(recorded) if name not in acting]
    taken = {*coordinates, *known, *params}
    candidates = [name for name in _find_candidates(sides, {*coordinates}) if name not in taken] if lacking else []
    if not lacking or (known and not candidates):
        return texts, ()
    if known or len(lacking) > 1 or len(candidates) != 1:
        raise CaseError(_describe_lack(texts, known, lacking, candidates))
    (old,), (new,) = candidates, lacking
    says = f"{old} in the equation stands for the recorded input {new}: give {old} a value or a prior if it is none"
    return tuple(_rename(text, pair, old, new) for text, pair in zip(texts, sides, strict=True)), (says,)


def _walk(sides: Sequence[tuple[Node, Node]]) -> Iterator[Node]:
    for pair in sides:
        for side in pair:
            yield from side.nodes()


def _find_candidates(sides: Sequence[tuple[Node, Node]], coordinates: set[str]) -> list[str]:
    """Return the names that may be an input: those that are a summand of their own, else factors of such summands.

    A summand with a coordinate is a force of the machine, and a divisor or a mass is a parameter.
    """
    parts = [part for pair in sides for side in pair for part in _list_summands(side)]
    masses = {name for part in parts for name in _list_masses(part)}
    free = [part for part in parts if not _names(part) & coordinates]
    alone = [part.text for part in free if part.kind == "name" and part.text not in masses]
    within = [name for part in free for name in _list_factors(part) if name not in masses]
    return list(dict.fromkeys(alone or within))


def _list_summands(node: Node) -> Iterator[Node]:
    if node.kind in ("+", "-", "negative"):
        for part in node.args:
            yield from _list_summands(part)
    elif node.kind in ("*", "/") and node.args[0].kind in ("+", "-"):
        yield from _list_summands(node.args[0])
    else:
        yield node


def _list_masses(node: Node) -> set[str]:
    """Return the names beside a second derivative in a summand."""
    parts = list(node.nodes())
    return {part.text for part in parts if part.kind == "name"} if any(part.primes == 2 for part in parts) else set()


def _names(node: Node) -> set[str]:
    return {part.text for part in node.nodes() if part.kind == "name"}


def _list_factors(node: Node) -> Iterator[str]:
    """Yield the names in a summand, except those in a divisor."""
    if node.kind == "name":
        yield node.text
    for part in node.args[:1] if node.kind == "/" else node.args:
        yield from _list_factors(part)


def _describe_lack(
    texts: Sequence[str], known: Sequence[str], lacking: Sequence[str], candidates: Sequence[str]
) -> str:
    has = f"has the input {' and '.join(known)}" if known else "has no input"
    recorded = " and ".join(lacking)
    head = f"the equation {'; '.join(texts)!r} {has}, but the recording has {recorded}, which would drive nothing"
    if not candidates:
        return (
            f"{head}: write {lacking[0]} where it acts, for instance {texts[0].partition('=')[0].strip()} = {recorded}"
        )
    first, choice = candidates[0], ", ".join(candidates)
    return f"{head}: write {recorded} for the name that stands for it ({choice}), for instance instead of {first}"


def _rename(text: str, pair: tuple[Node, Node], old: str, new: str) -> str:
    """Return the text with a name exchanged at each of its places."""
    places = sorted({node.at for side in pair for node in side.nodes() if node.kind == "name" and node.text == old})
    for at in reversed(places):
        text = text[:at] + new + text[at + len(old) :]
    return text
