"""Dimensionless numbers from parameters: each number is a product of powers, so its logarithm is a weighted sum."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Group, Model
from lostmotion.errors import CaseError

_TRIAL_VALUES = (1.7, 0.6)


@dataclass(frozen=True)
class NumberPower:
    """A dimensionless number: `target` divided by `factor` and by powers of parameters (Buckingham, 1914)."""

    name: str
    target: str
    factor: float
    powers: Mapping[str, float]

    @classmethod
    def of(cls, group: Group, model: Model) -> NumberPower:
        """Return the powers in a group of a model, found by doubling one parameter after the other."""
        ones = {**{param.name: 1.0 for param in model.params}, "drive.omega": 1.0}
        factor = group.law(ones, 1.0)
        raised = {key: math.log2(group.law({**ones, key: 2.0}, 1.0) / factor) for key in ones}
        power = cls(group.name, group.target, factor, {key: p for key, p in raised.items() if abs(p) > 1e-12})
        trial = {key: _TRIAL_VALUES[i % 2] ** (1 + i) for i, key in enumerate(ones)}
        made = 3.0 * factor * math.prod(trial[key] ** p for key, p in power.powers.items())
        if not math.isclose(group.law(trial, 3.0), made, rel_tol=1e-9):
            raise CaseError(f"{group.name} of {model.name} is not a product of powers: it cannot be inverted")
        return power


@dataclass(frozen=True)
class NumberLaw:
    """A number as exp(`constant` + sum of `powers` times the logarithms of the free parameters)."""

    constant: float
    powers: tuple[float, ...]
    of_drive: bool = False

    def __call__(self, logs: Array) -> Array:
        """Return the number (count,) at logarithms (parameters, count)."""
        total = np.full(logs.shape[1], self.constant)
        for power, log in zip(self.powers, logs, strict=True):
            if power:
                total = total + power * log
        return np.asarray(np.exp(total))

    def find_range(self, low: Sequence[float], high: Sequence[float]) -> tuple[float, float]:
        """Return the smallest and the largest number within bounds of the logarithms."""
        ends = [sorted((p * a, p * b)) if p else (0.0, 0.0) for p, a, b in zip(self.powers, low, high, strict=True)]
        return tuple(math.exp(self.constant + sum(e[side] for e in ends)) for side in (0, 1))  # type: ignore[return-value]


def make_law(power: NumberPower, known: Mapping[str, float], free: Sequence[str]) -> NumberLaw:
    """Return the law of a number from values that are `known` and parameters that are `free`.

    A number that is itself free is its own law.
    """
    drive = power.target.startswith("drive.")
    if power.name in free:
        return NumberLaw(0.0, tuple(float(key == power.name) for key in free), drive)
    exponents = {power.target: 1.0, **{key: -p for key, p in power.powers.items()}}
    missing = [key for key in exponents if key not in free and not known.get(key, 0.0) > 0.0]
    if missing:
        raise CaseError(
            f"{power.name} needs {missing[0]}, which is neither known as a positive number nor estimated: give it in "
            "[model.known] or in [model.estimate]"
        )
    constant = sum(p * math.log(known[key]) for key, p in exponents.items() if key not in free)
    return NumberLaw(constant - math.log(power.factor), tuple(exponents.get(key, 0.0) for key in free), drive)
