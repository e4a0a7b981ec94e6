"""The kernels of `lostmotion.kernels` that are compiled from their text: the filter once for each number of states."""

from __future__ import annotations

import re
from functools import lru_cache
from importlib import resources
from typing import Any

from lostmotion.kernels import plain, vector
from lostmotion.likelihood.adopted import defined, kept_as

_IMPORTS = re.compile(r"^from lostmotion[^\n]*\([^)]*\)[^\n]*\n", re.MULTILINE)
_FUTURE = "from __future__ import annotations\n"
_COMPILED = {name: made for name, made in vars(vector).items() if not name.startswith("_")}


def _source(*names: str) -> str:
    """Return the texts of kernel files as one, without what they import from each other."""
    texts = [resources.files("lostmotion.kernels").joinpath(f"{name}.py").read_text() for name in names]
    first, *others = (_IMPORTS.sub("", text) for text in texts)
    return "\n".join([first, *(text.replace(_FUTURE, "") for text in others)])


def _built(text: str, label: str, compiled: bool) -> dict[str, Any]:
    if not compiled:
        return defined(text, f"<slow twin of {label}>", plain.SPACE)
    return defined(text, str(kept_as(text, _source("vector"))), _COMPILED)


@lru_cache(maxsize=32)
def filter_kernels(states: int, compiled: bool = True) -> dict[str, Any]:
    """Return the functions of the filter for so many states, compiled, or as their plain Python twins."""
    text = _source("inputs", "crossing", "filter").replace("\nN = 2\n", f"\nN = {states}\n")
    return _built(text, f"a filter of {states} states", compiled)


@lru_cache(maxsize=2)
def motion_kernels(compiled: bool = True) -> dict[str, Any]:
    """Return the functions of `kernels/motion.py`, compiled, or as their plain Python twins."""
    return _built(_source("inputs", "motion"), "free motion", compiled)
