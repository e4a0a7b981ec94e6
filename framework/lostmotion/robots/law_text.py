"""The law of a term as the text of a function of Python that needs nothing but `math`."""

from __future__ import annotations

import inspect
import math
import textwrap

from lostmotion.contracts import Term
from lostmotion.simulators import RATE


def write_law(term: Term) -> str:
    """Return the function of the force of a term, under its name; empty if it calls other functions."""
    return _write_function(term, "force", term.name)


def write_rate(term: Term) -> str:
    """Return the function of the rates of its states, under its name with `_rate`; empty without states."""
    return _write_function(term, "rate", f"{term.name}{RATE}") if term.states else ""


def _write_function(term: Term, part: str, name: str) -> str:
    function = inspect.getattr_static(type(term), part, None)
    if not isinstance(function, staticmethod):
        return ""
    used = inspect.getclosurevars(function.__func__)
    if used.nonlocals or any(value is not math for value in used.globals.values()):
        return ""
    text = textwrap.dedent(inspect.getsource(function.__func__))
    return text[text.index(f"def {part}(") :].replace(f"def {part}(", f"def {name}(", 1)
