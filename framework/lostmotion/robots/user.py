"""A simulation that is a Python function of the user: inverse dynamics of positions, velocities and accelerations."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from lostmotion.errors import CaseError, nearest
from lostmotion.parts import Array
from lostmotion.simulators import Simulator

Function = Callable[[Array, Array, Array], Any]
"""Inverse dynamics: torques (samples, n) of positions, velocities and accelerations (samples, n)."""


@dataclass(frozen=True)
class FunctionSimulator(Simulator):
    """The simulation of a function `inverse(q, v, a)` that returns torques; all arrays are (samples, joints)."""

    function: Function
    names: tuple[str, ...]
    name: ClassVar[str] = "inverse"
    paper: ClassVar[str] = "Featherstone, Rigid Body Dynamics Algorithms (2008), chapter 5"

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints."""
        return self.names

    def inverse(self, q: Array, v: Array, a: Array) -> Array:
        """Return the torques (samples, n) of the function."""
        try:
            found: Array = self.function(q.copy(), v.copy(), a.copy())
        except Exception as err:  # the function of the user may raise anything
            raise CaseError(
                f"the function inverse raised {type(err).__name__}: {' '.join(str(err).split())[:200]}; it is called"
                f" with three arrays {q.shape} (samples, joints) and returns torques of the same shape"
            ) from err
        return found

    @classmethod
    def load(cls, text: str, folder: Path, joints: tuple[str, ...]) -> FunctionSimulator:
        """Return the simulator of `file.py:function`, the file relative to a folder."""
        file, _, word = text.partition(":")
        path = folder / file
        if not path.is_file():
            raise CaseError(
                f"inverse = {text!r}: there is no file {file!r} beside the case; write 'my_model.py:inverse'"
            )
        spec = importlib.util.spec_from_file_location(path.stem, path)
        if spec is None or spec.loader is None:
            raise CaseError(f"inverse = {text!r}: {file!r} is no Python file; write 'my_model.py:inverse'")
        module = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
        except Exception as err:  # code of the user
            raise CaseError(f"{file} cannot be imported ({type(err).__name__}: {err}): correct it") from err
        function = getattr(module, word or "inverse", None)
        if not callable(function):
            names = [name for name in vars(module) if not name.startswith("_")]
            raise CaseError(f"{file} has no function {word!r}{nearest(word, names)}: it has {', '.join(names)}")
        return cls(function, joints)
