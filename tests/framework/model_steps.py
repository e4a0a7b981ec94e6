"""A model that is written as equations as a `Dynamics` in plain NumPy: the slow twin of its compiled kernel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from lostmotion.contracts import Array, Dynamics, Model, Place
from lostmotion.errors import ContractError
from lostmotion.parts import Motion


class ModelSteps(Dynamics):
    """The steps of a model by RK4, each row alone with the Python functions of the model; time does not enter."""

    model: ClassVar[Model]
    fine: ClassVar[int]

    def step(self, x: Array, u: Array, f: Array, p: Array, dt: float) -> Array:
        """Return the states (rows, states) after `dt` s, by `fine` steps of RK4."""
        return np.array([self._step_row(*row, dt / self.fine) for row in zip(x, u, f, p, strict=True)])

    def observe(self, x: Array, u: Array, f: Array, p: Array) -> Array:
        """Return the channels (rows, channels)."""
        seen = np.zeros((len(x), len(self.channels)))
        for row, y, v, force, own in zip(seen, x, u, f, p, strict=True):
            self.model.observe(0.0, y, self._find_rates(y, v, force, own), v, own, row)
        return seen

    def _step_row(self, y: Array, u: Array, f: Array, p: Array, h: float) -> Array:
        for _ in range(self.fine):
            k1 = self._find_rates(y, u, f, p)
            k2 = self._find_rates(y + 0.5 * h * k1, u, f, p)
            k3 = self._find_rates(y + 0.5 * h * k2, u, f, p)
            k4 = self._find_rates(y + h * k3, u, f, p)
            y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        return y

    def _find_rates(self, y: Array, u: Array, f: Array, p: Array) -> Array:
        """Return the derivatives (states,) of one row under forces (places,)."""
        rates, index = np.zeros(len(y)), {q.name: i for i, q in enumerate(self.params)}
        self.model.rhs(0.0, y, u, p, rates)
        for place, force in zip(self.model.interfaces, f, strict=True):
            rates[place.row] += force / p[index[place.inertia]]
            if place.against:
                rates[place.against[0]] -= force / p[index[place.against[1]]]
        return rates


def step_model(model: Model, fine: int = 1) -> ModelSteps:
    """Return the steps of a model, of `fine` steps of RK4 each; `ContractError` for a model with levers."""
    if geared := [place.name for place in model.interfaces if place.lever]:
        raise ContractError(f"{model.name} has a lever at {geared[0]}, which a step does not know: use its equations")
    members: dict[str, Any] = {
        name: getattr(model, name) for name in ("name", "paper", "motion", "states", "inputs", "channels", "params")
    }
    places = tuple(
        Place(i.name, i.motion, i.holds, i.stiffness, i.play, i.against is not None) for i in model.interfaces
    )
    members |= {"model": model, "fine": fine, "places": places, "__module__": __name__}
    members |= {"__annotations__": {"motion": Motion}, "first_body": model.first_body}
    cls: Any = dataclass(frozen=True)(type("ModelSteps", (ModelSteps,), members))
    made: ModelSteps = cls()
    return made
