"""Recordings of a machine whose parameters are known, made to be read again: the truth that an inversion is held to.

The motion is that of the exact flow where the model knows it, else of RK4 with many steps. A map of the same machine
starts elsewhere, and reads tangent vectors and sections; here a sampled position with noise is all there is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.contracts import Array, Model
from lostmotion.flow import Harmonic, flow_of
from lostmotion.identification.reading import Read, Signals, read_level
from lostmotion.maps.rig import measure_extent
from lostmotion.preparation.vetting import sound
from lostmotion.quantities import unit_of
from lostmotion.registry import Registry

SETTLING, WIDE = 300, 2.0
"""Periods before the recording begins; starts are drawn from a box so many times as large as the motion from rest."""


@dataclass(frozen=True)
class Bench:
    """How recordings are made: periods, samples in a period, and noise of response and drive as shares of their sd."""

    periods: int = 150
    looks: int = 80
    noise: float = 0.005
    drive_noise: float = 1e-3


def rehearsed(
    model: Model, values: Mapping[str, float], beat: Harmonic, bench: Bench, rng: np.random.Generator
) -> tuple[Signals, Array]:
    """Return the recording of a machine under a harmonic drive from a random start, and its first state."""
    flow = flow_of(model, values, drive=beat)
    box = WIDE * measure_extent(flow, 40)
    begin = flow.strobe(rng.uniform(-box, box), periods=SETTLING, tangents=0).states[-1]
    seen = flow.sample(begin, periods=bench.periods, looks=bench.looks)[:-1, 0]  # type: ignore[attr-defined]
    dt = flow.period / bench.looks
    u = beat.amplitude * np.cos(beat.omega * dt * np.arange(len(seen)) + beat.phase)
    noisy = [x + share * float(np.std(x)) * rng.standard_normal(len(x)) for x, share in
             ((seen, bench.noise), (u, bench.drive_noise))]  # fmt: skip
    return Signals(f"{beat.amplitude:g}", noisy[0], noisy[1], dt, unit_of(model.inputs[0], model.motion)), begin


def rehearsed_levels(
    case: CaseFile,
    registry: Registry,
    truth: Mapping[str, float],
    drives: Sequence[tuple[float, float]],
    rng: np.random.Generator,
    *,
    bench: Bench | None = None,
) -> tuple[Read, ...]:
    """Return levels read from recordings of a case's machine with true parameters at drives (amplitude, omega).

    `truth` holds values of what the case estimates, the damping ratio `zeta` among them if that is free.
    """
    model: Model = sound(registry, "model", case.model)
    values = true_values(model, {**case.known, **truth})
    found = []
    for (amplitude, omega), own in zip(drives, rng.spawn(len(drives)), strict=True):
        signals, _ = rehearsed(model, values, Harmonic(amplitude, omega), bench or Bench(), own)
        found.append(read_level(signals, registry, own))
    return tuple(found)


def true_values(model: Model, values: Mapping[str, float]) -> dict[str, float]:
    """Return parameters with the damping ratio `zeta`, where it is told, turned into damping."""
    own = {key: value for key, value in values.items() if key not in {group.name for group in model.groups}}
    for group in model.groups:
        if group.name in values and not group.target.startswith("drive."):
            own[group.target] = group.law(own, values[group.name])
    return own
