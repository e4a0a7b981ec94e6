"""Waves of a sensor that are no longer than a few steps of its stored values: they are its rounding."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TypeVar

from lostmotion.contracts import SensorTerm
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.posterior import Posterior

Shape = TypeVar("Shape", bound=Mapping[str, float])

ROUNDED = 1.5
"""A wave of a sensor that is no longer than so many steps of its stored values is not tried."""


def find_shortest_wave(posterior: Posterior, key: str) -> float:
    """Return the length below which a wave of a sensor is the rounding of its stored values; 0 for other terms.

    A wave that repeats with every step, or several times in one, predicts that all readings are whole steps.
    """
    term = find_term(posterior, key)[0]
    if not isinstance(term, SensorTerm):
        return 0.0
    beside, observation = posterior.system.channel_terms.values(), posterior.observations[0]
    marked = [t for t in beside if isinstance(t, SensorTerm) and t.marked and t.at == term.at]
    shown = [observation.readings[:, i] for i, s in enumerate(observation.sensors) if s.place == term.at]
    steps = [math.sqrt(12.0) * t.scatter(p) for t in marked for z in shown if (p := t.quantisation(z)[0])]
    return ROUNDED * max(steps, default=0.0)


def drop_rounding(posterior: Posterior, key: str, shapes: Sequence[Shape]) -> list[Shape]:
    """Return the shapes of a term without those that are the rounding of its sensor."""
    least = find_shortest_wave(posterior, key)
    return [shape for shape in shapes if not least > 0.0 or min(shape.values(), default=math.inf) > least]
