"""The kernels of `lostmotion.kernels` that are compiled from their text: the filter once for each number of states."""

from __future__ import annotations

import re
from functools import lru_cache
from importlib import resources
from typing import Any

from lostmotion.kernels import plain, vector
from lostmotion.likelihood.adopted import define_module, store_text

_IMPORTS = re.compile(r"^from lostmotion[^\n]*\([^)]*\)[^\n]*\n", re.MULTILINE)
_FUTURE = "from __future__ import annotations\n"
_COMPILED = {name: made for name, made in vars(vector).items() if not name.startswith("_")}


@lru_cache(maxsize=8)
def read_source(*names: str) -> str:
    """Return the texts of kernel files as one, without their imports from each other."""
    texts = [resources.files("lostmotion.kernels").joinpath(f"{name}.py").read_text() for name in names]
    first, *others = (_IMPORTS.sub("", text) for text in texts)
    return "\n".join([first, *(text.replace(_FUTURE, "") for text in others)])


def _build_kernels(text: str, label: str, compiled: bool) -> dict[str, Any]:
    if not compiled:
        return define_module(text, f"<slow twin of {label}>", plain.SPACE)
    return define_module(text, str(store_text(text, read_source("vector"))), _COMPILED)


@lru_cache(maxsize=32)
def build_filter(states: int, compiled: bool = True) -> dict[str, Any]:
    """Return the functions of the filter for a number of states, compiled or as plain Python."""
    text = read_source("inputs", "crossing", "propagation", "noise_states", "filter")
    text = text.replace("\nN = 2\n", f"\nN = {states}\n")
    return _build_kernels(text, f"a filter of {states} states", compiled)


@lru_cache(maxsize=2)
def build_motion(compiled: bool = True) -> dict[str, Any]:
    """Return the functions of `kernels/motion.py`, compiled or as plain Python."""
    return _build_kernels(read_source("inputs", "motion"), "free motion", compiled)
