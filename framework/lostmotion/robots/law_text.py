"""The law of a term as the text of a function of Python that needs nothing but `math`."""

from __future__ import annotations

import inspect
import math
import textwrap

from lostmotion.contracts import Term


def write_law(term: Term) -> str:
    """Return the function of the force of a term, under its name; empty if it has states or calls functions."""
    force = inspect.getattr_static(type(term), "force", None)
    if not isinstance(force, staticmethod) or term.states:
        return ""
    used = inspect.getclosurevars(force.__func__)
    if used.nonlocals or any(value is not math for value in used.globals.values()):
        return ""
    text = textwrap.dedent(inspect.getsource(force.__func__))
    return text[text.index("def force(") :].replace("def force(", f"def {term.name}(", 1)
