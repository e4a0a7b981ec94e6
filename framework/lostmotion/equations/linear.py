"""Solution of an equation for a second derivative in which it is linear."""

from __future__ import annotations

from lostmotion.equations.read import Node, error

ZERO = Node("number", 0, "0")
ONE = Node("number", 0, "1", value=1.0)


def contains(node: Node, wanted: str) -> bool:
    """Return whether an expression contains a name with its primes, such as `x''`."""
    return any(part.plain == wanted for part in node.nodes())


def split_linear(text: str, node: Node, wanted: str) -> tuple[Node, Node]:
    """Return `a` and `b` of a node that is `a * wanted + b`; raise an error at the place where it is not linear."""
    if node.plain == wanted:
        return ONE, ZERO
    if not contains(node, wanted):
        return ZERO, node
    if node.kind == "negative":
        a, b = split_linear(text, node.args[0], wanted)
        return negative(a), negative(b)
    if node.kind in ("+", "-"):
        (a, b), (c, d) = (split_linear(text, part, wanted) for part in node.args)
        combine = plus if node.kind == "+" else minus
        return combine(a, c), combine(b, d)
    if node.kind in ("*", "/") and sum(contains(part, wanted) for part in node.args) == 1:
        first, second = node.args
        if contains(first, wanted):
            a, b = split_linear(text, first, wanted)
            combine = times if node.kind == "*" else over
            return combine(a, second), combine(b, second)
        if node.kind == "*":
            a, b = split_linear(text, second, wanted)
            return times(first, a), times(first, b)
    raise error(text, node.at, f"is not linear in {wanted}: write mass * {wanted} as a term of the sum")


def negative(a: Node) -> Node:
    """Return -a."""
    if a == ZERO:
        return ZERO
    return a.args[0] if a.kind == "negative" else Node("negative", a.at, args=(a,))


def plus(a: Node, b: Node) -> Node:
    """Return a + b."""
    if a == ZERO or b == ZERO:
        return b if a == ZERO else a
    return Node("+", b.at, args=(a, b))


def minus(a: Node, b: Node) -> Node:
    """Return a - b."""
    if b == ZERO:
        return a
    return negative(b) if a == ZERO else Node("-", b.at, args=(a, b))


def times(a: Node, b: Node) -> Node:
    """Return a * b."""
    if ZERO in (a, b):
        return ZERO
    if ONE in (a, b):
        return b if a == ONE else a
    return Node("*", b.at, args=(a, b))


def over(a: Node, b: Node) -> Node:
    """Return a / b."""
    return a if a == ZERO or b == ONE else Node("/", b.at, args=(a, b))
