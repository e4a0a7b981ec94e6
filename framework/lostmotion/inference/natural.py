"""Parameters of terms in the natural scales of a recording: sizes, priors, and the values at which shapes are tried."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Param, Term
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter, Scales
from lostmotion.likelihood.system import Slot
from lostmotion.quantities import CURRENT, FORCE, FREQUENCY, LENGTH, SPEED, VOLTAGE, Dimension, quantity_of

SCANNED = 8
"""The number of values of a parameter with a scan that are tried, evenly over the logarithm of its range."""
REACH = 4.0
"""The bounds of a shape without a scan, as a logarithm from its typical value."""
BEYOND = math.log(1.5)
"""A fit may leave the scanned range of a length by this much, as a logarithm: the nominal model, from which the scale
is known, may have another amplitude than the machine."""
TAIL = 4.0
"""The degrees of freedom of the prior of an amplitude, Student's t: natural scales are right within a factor of ten,
and a normal prior would make large effects smaller."""
SHAPES = (0.3, 1.0, 3.0)
"""The values of a shape parameter that are tried, in units of its typical value."""


def find_wave(posterior: Posterior, key: str) -> Slot | None:
    """Return the frequency of the wave of a term; None for a term without one."""
    return next((slot for slot in sort_slots(posterior, key)[1] if _is_wave(slot.param)), None)


def _is_wave(param: Param) -> bool:
    """Return whether a parameter with choices may have any other value, too: the frequency of a wave over the phase."""
    return bool(param.prior.choices) and param.scale == "log"


def compute_size(param: Param, scales: Scales) -> float:
    """Return the typical size of a term's parameter in the natural scales of the recording."""
    time = scales.span if param.prior.lasting else scales.time
    return param.prior.typical * param.dimension.scale(scales.force, scales.length, time)


def make_free_parameters(slots: list[Slot], scales: Scales, start: Mapping[str, float]) -> tuple[FreeParameter, ...]:
    """Return the free parameters of a term: amplitudes by Student's t about zero, shapes lognormal."""
    return tuple(_make_free(slot, scales, start.get(slot.key)) for slot in slots if not is_choice(slot, start))


def is_choice(slot: Slot, start: Mapping[str, float]) -> bool:
    """Return whether a parameter is held at one of its choices, and not fitted from where it starts."""
    chosen = start.get(slot.key, min(slot.param.prior.choices, default=0.0))
    return bool(slot.param.prior.choices) and not (_is_wave(slot.param) and chosen not in slot.param.prior.choices)


def compute_range(param: Param, scales: Scales) -> tuple[float, float]:
    """Return the smallest and largest value of a shape parameter; a frequency is at most half the sampling rate.

    A mode above it would appear as one below it (aliasing), and the filter of an acquisition system removes it.
    """
    low, high = (compute_size(param, scales) * end for end in param.prior.scan or (math.exp(-REACH), math.exp(REACH)))
    return low, max(min(high, scales.nyquist), low) if param.dimension == FREQUENCY else high


def _make_free(slot: Slot, scales: Scales, start: float | None) -> FreeParameter:
    size = compute_size(slot.param, scales)
    if slot.param.scale == "log":
        middle, (low, high) = math.log(size), map(math.log, compute_range(slot.param, scales))
        begin = min(max(middle if start is None else math.log(start), low), high)
        if slot.param.prior.scan and slot.param.dimension == LENGTH:
            low, high = low - BEYOND, high + BEYOND
        return FreeParameter(slot.key, slot.unit, begin, low, high, log=True, mean=middle, sd=1.5)
    low = max(slot.param.low, -30.0 * size)
    high = min(slot.param.high, 30.0 * size)
    return FreeParameter(slot.key, slot.unit, start or 0.0, low, high, mean=0.0, sd=size, tail=TAIL)


def hold_shape(slot: Slot) -> FreeParameter:
    """Return a shape parameter as a coordinate without bounds."""
    return FreeParameter(slot.key, slot.unit, 0.0, -math.inf, math.inf)


def find_term(posterior: Posterior, key: str) -> tuple[Term, list[Slot]]:
    """Return a term of the posterior's system and the slots of its parameters."""
    i = posterior.system.keys.index(key)
    term, slots = posterior.system.terms[i], [s for s in posterior.system.slots if s.term == i]
    return term, slots if term.acts == "motion" else [_convert_dimension(posterior, term, slot) for slot in slots]


SHOWN = {
    "position": LENGTH,
    "velocity": SPEED,
    "acceleration": Dimension(0, 1, -2),
    "force": FORCE,
    "current": CURRENT,
    "voltage": VOLTAGE,
}


def _convert_dimension(posterior: Posterior, term: Term, slot: Slot) -> Slot:
    """Return a parameter of a sensor or drive term: a length stands for the channel, a force for the input."""
    first, inputs = posterior.observations[0], posterior.system.model.inputs
    column = inputs.index(term.at) if term.at in inputs else first.lead
    if term.acts == "sensor":
        stands, name = LENGTH, next((s.channel for s in first.sensors if s.place == term.at), "position")
    else:
        stands, name = FORCE, inputs[column]
    if slot.param.dimension != stands:
        return slot
    dimension = SHOWN[quantity_of(name)]
    if dimension != stands:
        unit = dimension.unit(posterior.system.model.motion)
        slot = replace(slot, param=replace(slot.param, dimension=dimension), unit=unit)
    return slot if term.acts == "sensor" else _reach_largest(posterior, column, slot)


def _reach_largest(posterior: Posterior, column: int, slot: Slot) -> Slot:
    """Return a parameter with a scan that reaches the largest recorded value of an input: impacts exceed their rms."""
    prior = slot.param.prior
    if not prior.scan:
        return slot
    largest = max((float(np.abs(o.inputs[:, column]).max()) for o in posterior.observations if o.samples), default=0.0)
    low, high = prior.scan
    wider = replace(prior, scan=(low, max(high, largest / compute_size(slot.param, posterior.scales))))
    return replace(slot, param=replace(slot.param, prior=wider))


def sort_slots(posterior: Posterior, key: str) -> tuple[list[Slot], list[Slot]]:
    """Return the slots of the amplitudes of a term, and those of its shapes."""
    _, slots = find_term(posterior, key)
    return [s for s in slots if s.param.null is not None], [s for s in slots if s.param.null is None]


def collect_shapes(posterior: Posterior, keys: Iterable[str]) -> list[Slot]:
    """Return the slots of the shapes of some terms, in alphabetical order of the terms."""
    return [slot for key in sorted(keys) for slot in sort_slots(posterior, key)[1]]


def list_star_points(grids: Sequence[Sequence[float]]) -> list[tuple[float, ...]]:
    """Return the points at which shapes are tried: each over its grid while the others stay in the middle of theirs."""
    middle = tuple(grid[len(grid) // 2] for grid in grids)
    points = [(*middle[:i], value, *middle[i + 1 :]) for i, grid in enumerate(grids) for value in grid]
    return list(dict.fromkeys(points)) or [()]


def is_scanned(amplitudes: Sequence[Slot]) -> bool:
    """Return whether the only amplitude of a term has a range to be scanned: its effect is not proportional to it."""
    return len(amplitudes) == 1 and amplitudes[0].param.prior.scan is not None


def list_tried_values(param: Param, scales: Scales) -> tuple[float, ...]:
    """Return the values at which a shape parameter is tried."""
    if param.prior.scan:
        return tuple(np.geomspace(*compute_range(param, scales), SCANNED).tolist())
    return param.prior.choices or tuple(f * compute_size(param, scales) for f in SHAPES)
