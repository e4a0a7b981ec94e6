"""The laws of terms at the places of a machine that can only be stepped.

The compiled kernel of a frame computes them: a model without motion of its own, whose states are position and velocity
at each place, so that every term acts as it does in a model that is written as equations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, ClassVar

import numpy as np

from lostmotion.contracts import Array, Dynamics, Interface, Model, Param, SensorTerm
from lostmotion.kernels.vector import STRIDE
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.kernel_calls import make_block, make_model_wires, require_no_failure
from lostmotion.likelihood.kernels import build_motion
from lostmotion.likelihood.system import System
from lostmotion.parts import Motion
from lostmotion.quantities import INERTIA


class PlaceFrame(Model):
    """The places of a machine as a model: two states for each of them, and the channels of the machine as inputs."""

    name: ClassVar[str] = "place_frame"
    paper: ClassVar[str] = "the places of a machine that is stepped"


def make_frame(machine: Dynamics) -> PlaceFrame:
    """Return the frame of a machine; the inertias at its places are parameters behind those of the machine."""
    functions = _define_functions(len(machine.places), len(machine.inputs), len(machine.channels))
    inertias = tuple(Param(f"inertia_{i}_", f"inertia at {p.name}", INERTIA) for i, p in enumerate(machine.places))
    interfaces = tuple(
        Interface(
            place.name, functions[f"place_{i}"], place.holds, place.stiffness, place.play,
            row=2 * i + 1, inertia=inertias[i].name,
        )
        for i, place in enumerate(machine.places)
    )  # fmt: skip
    members = {
        "__module__": __name__,
        "__annotations__": {"motion": Motion},
        "motion": machine.motion,
        "states": tuple(f"{place.name}.{kind}" for place in machine.places for kind in ("position", "velocity")),
        "inputs": (*machine.inputs, *(f"shown_{name}" for name in machine.channels)),
        "channels": machine.channels,
        "params": (*machine.params, *inertias),
        "interfaces": interfaces,
        "rhs": staticmethod(functions["rhs"]),
        "observe": staticmethod(functions["observe"]),
    }
    cls: Any = dataclass(frozen=True)(type("PlaceFrame", (PlaceFrame,), members))
    made: PlaceFrame = cls()
    return made


@lru_cache(maxsize=32)
def _define_functions(places: int, inputs: int, channels: int) -> dict[str, Callable[..., Any]]:
    """Return `rhs` and `observe` of a frame, and the motion at each place, from text of indices only."""
    lines = ["def rhs(t, y, u, p, dydt):", *(f"    dydt[{i}] = 0.0" for i in range(2 * places))]
    lines += ["def observe(t, y, dydt, u, p, seen):"]
    lines += [f"    seen[{c}] = u[{inputs + c}]" for c in range(channels)]
    for i in range(places):
        lines += [f"def place_{i}(y, u):", f"    return y[{2 * i}], y[{2 * i + 1}]"]
    space: dict[str, Any] = {}
    exec(compile("\n".join(lines), "<places>", "exec"), space)  # noqa: S102 - generated text of indices only
    return space


@dataclass(frozen=True)
class PlaceLaws:
    """The active terms of a machine at given parameters: forces at its places, and derivatives of their states.

    `packed` (rows, params) are the parameters of the frame, one row for each row of states that is asked for.
    """

    frame: System
    active: frozenset[str]
    packed: Array
    muted: str | None = None

    @cached_property
    def senses(self) -> bool:
        """Whether a sensor has states, whose derivatives depend on the channels."""
        return any(key in self.active and isinstance(term, SensorTerm) for key, term in self.frame.forces)

    @cached_property
    def _blocks(self) -> list[Array]:
        rows, made = self.frame.blueprint.rows, []
        for begin in range(0, len(self.packed), STRIDE):
            part = self.packed[begin : begin + STRIDE]
            block = make_block(rows.total)
            block[rows.params :] = part[np.minimum(np.arange(STRIDE), len(part) - 1)].T
            made.append(block)
        return made

    @cached_property
    def _wires(self) -> Any:
        return make_model_wires(self.frame, self.active, muted=self.muted)

    def evaluate(self, times: Array, moved: Array, own: Array, inputs: Array) -> tuple[Array, Array]:
        """Return forces (rows, places) and derivatives (rows, own states) of the states of terms.

        `times` is (rows,) in s, `moved` (rows, places, 2) position and velocity at each place, `own` (rows, own states)
        the states of terms, and `inputs` (rows, inputs + channels) those of the frame.
        """
        rows, places, _ = moved.shape
        states = np.ascontiguousarray(np.concatenate([moved.reshape(rows, -1), own], axis=1))
        rates, seen = np.zeros_like(states), np.zeros((rows, len(self.frame.model.channels)))
        made, kernel = self.frame.functions(), build_motion()["evaluate"]
        for number, block in enumerate(self._blocks):
            part = slice(number * STRIDE, (number + 1) * STRIDE)
            told = (times[part], states[part], inputs[part], rates[part], seen[part])
            failed = kernel((made.derive, made.observe), (block,), self._wires, *told)
            require_no_failure(failed, self.frame, block, self._wires)
        first = len(self.frame.model.params) - places
        return rates[:, 1 : 2 * places : 2] * self.packed[:, first : first + places], rates[:, 2 * places :]


def pack_frame(
    frame: System, fulls: Array, inertias: Array, step: float, harmonic: DriveHarmonic, *, line: int = 1
) -> Array:
    """Return the packed parameters (rows, params) of a frame.

    `fulls` (rows, parameters) are those of the machine, `inertias` (rows, places) in kg or kg m^2.
    """
    own = len(frame.model.params) - inertias.shape[1]
    return frame.pack(np.concatenate([fulls[:, :own], inertias, fulls[:, own:]], axis=1), step, harmonic, line=line)
