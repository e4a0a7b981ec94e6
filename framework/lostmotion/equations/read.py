"""Parsing of an equation to a tree of names with primes, numbers, operators and known functions. No code is executed.

Grammar: `a + b`, `a - b`, `a * b`, `a / b`, `a ^ b` (or `**`), `-a`, `f(a, b)`, parentheses, and one `=`. A prime is a
derivative with respect to time: `x'` is the velocity of `x`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite

from lostmotion.errors import CaseError, nearest

FUNCTIONS = {
    "gap": ("x", "k", "x0"), "stop": ("x", "k", "x0"), "sat": ("x", "limit"), "sign": ("x",), "abs": ("x",),
    "min": ("a", "b"), "max": ("a", "b"), "sqrt": ("x",), "exp": ("x",), "log": ("x",), "sin": ("x",), "cos": ("x",),
    "tan": ("x",), "asin": ("x",), "acos": ("x",), "atan": ("x",), "sinh": ("x",), "cosh": ("x",), "tanh": ("x",),
}  # fmt: skip
"""The functions that an equation may use, each with its arguments.

`gap(x, k, x0)` is the force of a spring k beyond a half gap x0 on both sides, `stop(x, k, x0)` that on the positive
side only; `sat(x, limit)` is x limited to the range from -limit to limit.
"""
CONSTANTS = {"pi": 3.141592653589793}
LONGEST, DEEPEST = 2000, 50
"""The greatest number of characters of an equation, and of nested parentheses."""
_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*)(?P<primes>['’′]*)"
    r"|(?P<sign>\*\*|[-+*/^(),=])|(?P<end>$))"
)
_PRECEDENCE = {"+": 1, "-": 1, "*": 2, "/": 2, "^": 4}
_UNARY_PRECEDENCE = 3


@dataclass(frozen=True)
class Node:
    """A part of an equation, at character `at`: `kind` is "number", "name", "call", "negative" or an operator.

    A name has `primes`; a call has its function as `text`.
    """

    kind: str
    at: int
    text: str = ""
    args: tuple[Node, ...] = ()
    primes: int = 0
    value: float = 0.0

    def nodes(self) -> Iterator[Node]:
        """Yield the node itself and all its parts."""
        yield self
        for part in self.args:
            yield from part.nodes()

    @property
    def begin(self) -> int:
        """The position of the first character of the node."""
        return min(node.at for node in self.nodes())

    @property
    def plain(self) -> str:
        """The name with its primes; empty for other nodes."""
        return f"{self.text}{self.primes * chr(39)}" if self.kind == "name" else ""


@dataclass(frozen=True)
class Token:
    """A piece of the text at character `at`: a number, a name with primes, a sign, or the end."""

    kind: str
    text: str
    at: int
    primes: int = 0

    @property
    def shown(self) -> str:
        """The token in the form used in messages."""
        return "the end" if self.kind == "end" else repr(self.text + self.primes * "'")


def error(text: str, at: int, says: str) -> CaseError:
    """Return an error on an equation that shows the place `at` in the text, counted from 0."""
    return CaseError(f"the equation {text!r} {says}, at character {at + 1}: {text[:at]} >>> {text[at:]}")


def read(text: str) -> tuple[Node, Node]:
    """Return the left and the right side of an equation; raise `CaseError` with the place of an error."""
    if len(text) > LONGEST:
        raise CaseError(f"an equation has {len(text)} characters: {LONGEST} are allowed; use shorter names")
    parser = _Parser(text, tuple(_tokenize(text)))
    left = parser.expression()
    parser.take("=", "an operator or '='")
    right = parser.expression()
    parser.take("end", "an operator or the end")
    return left, right


def _tokenize(text: str) -> Iterator[Token]:
    at = 0
    while True:
        found = _TOKEN.match(text, at)
        if found is None:
            place = at + len(text[at:]) - len(text[at:].lstrip())
            raise error(text, place, f"has {text[place]!r}, which is not allowed in an equation")
        kind = str(found.lastgroup if found.lastgroup != "primes" else "name")
        word = found[kind]
        yield Token(kind, "^" if word == "**" else word, found.start(kind), len(found["primes"] or ""))
        if kind == "end":
            return
        at = found.end()


class _Parser:
    """Parses tokens by operator precedence (Pratt 1973)."""

    def __init__(self, text: str, tokens: tuple[Token, ...]) -> None:
        self.text, self.tokens, self.place, self.depth = text, tokens, 0, 0

    @property
    def here(self) -> Token:
        return self.tokens[self.place]

    def take(self, wanted: str, words: str) -> Token:
        """Return the expected token and move on; raise an error if another token is found."""
        token = self.here
        if token.kind != wanted and not (token.kind == "sign" and token.text == wanted):
            raise error(self.text, token.at, f"has {token.shown} where {words} is expected")
        self.place += token.kind != "end"
        return token

    def expression(self, least: int = 0) -> Node:
        """Return the expression of operators with a precedence of at least `least`."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise error(self.text, self.here.at, f"nests more than {DEEPEST} parentheses or signs")
        left = self._operand()
        while self.here.kind == "sign" and _PRECEDENCE.get(self.here.text, -1) >= max(least, 1):
            operator = self.here
            self.place += 1
            strength = _PRECEDENCE[operator.text]
            right = self.expression(_UNARY_PRECEDENCE if operator.text == "^" else strength + 1)
            left = Node(operator.text, operator.at, args=(left, right))
        self.depth -= 1
        return left

    def _operand(self) -> Node:
        token = self.here
        if token.kind == "number":
            self.place += 1
            if not isfinite(value := float(token.text)):
                raise error(self.text, token.at, f"has {token.shown}, which is not a finite number")
            return Node("number", token.at, token.text, value=value)
        if token.kind == "name":
            self.place += 1
            return self._call(token) if self.here.text == "(" else _name_node(token)
        if token.text in ("-", "+") and token.kind == "sign":
            self.place += 1
            inner = self.expression(_UNARY_PRECEDENCE)
            return Node("negative", token.at, args=(inner,)) if token.text == "-" else inner
        self.take("(", "a name, a number or '('")
        inner = self.expression()
        self.take(")", "an operator or ')'")
        return inner

    def _call(self, token: Token) -> Node:
        if token.text not in FUNCTIONS or token.primes:
            known = ", ".join(FUNCTIONS)
            hint = nearest(token.text, FUNCTIONS)
            raise error(self.text, token.at, f"has the unknown function {token.shown}{hint}: known are {known}")
        self.place += 1
        args = [self.expression()]
        while self.here.text == ",":
            self.place += 1
            args.append(self.expression())
        self.take(")", "',' or ')'")
        wanted = FUNCTIONS[token.text]
        if len(args) != len(wanted):
            called = f"{token.text}({', '.join(wanted)})"
            raise error(self.text, token.at, f"gives {len(args)} arguments to {called}")
        return Node("call", token.at, token.text, tuple(args))


def _name_node(token: Token) -> Node:
    if token.text in CONSTANTS and not token.primes:
        return Node("number", token.at, token.text, value=CONSTANTS[token.text])
    return Node("name", token.at, token.text, primes=token.primes)
