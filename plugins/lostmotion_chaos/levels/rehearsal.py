"""Simulated recordings of a machine with known parameters, from which levels are read to test an inversion.

The motion comes from the exact flow where the model offers it, else from RK4 with many steps. A map of the same machine
starts elsewhere and uses tangent vectors and sections; here only a sampled position with noise is available.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.contracts import Array, Model
from lostmotion.preparation.vetting import make_plugin
from lostmotion.quantities import unit_of
from lostmotion.registry import Registry
from lostmotion_chaos.flows.flow import Harmonic, flow_of
from lostmotion_chaos.levels.reading import ReadLevel, Signals, read_level
from lostmotion_chaos.maps.rig import measure_extent

SETTLING_PERIODS, START_BOX = 300, 2.0
"""Periods before the recording begins, and size of the box of initial states relative to the motion from rest."""


@dataclass(frozen=True)
class RecordingPlan:
    """How recordings are simulated: periods, samples per period, noise of response and drive as shares of their sd."""

    periods: int = 150
    looks: int = 80
    noise: float = 0.005
    drive_noise: float = 1e-3


def simulate_signals(
    model: Model, values: Mapping[str, float], drive: Harmonic, plan: RecordingPlan, rng: np.random.Generator
) -> tuple[Signals, Array]:
    """Return the signals of a machine under a harmonic drive from a random initial state, and the first state."""
    flow = flow_of(model, values, drive=drive)
    box = START_BOX * measure_extent(flow, 40)
    begin = flow.strobe(rng.uniform(-box, box), periods=SETTLING_PERIODS, tangents=0).states[-1]
    seen = flow.sample(begin, periods=plan.periods, looks=plan.looks)[:-1, 0]  # type: ignore[attr-defined]
    dt = flow.period / plan.looks
    u = drive.amplitude * np.cos(drive.omega * dt * np.arange(len(seen)) + drive.phase)
    noisy = [x + share * float(np.std(x)) * rng.standard_normal(len(x)) for x, share in
             ((seen, plan.noise), (u, plan.drive_noise))]  # fmt: skip
    return Signals(f"{drive.amplitude:g}", noisy[0], noisy[1], dt, unit_of(model.inputs[0], model.motion)), begin


def simulate_levels(
    case: CaseFile,
    registry: Registry,
    truth: Mapping[str, float],
    drives: Sequence[tuple[float, float]],
    rng: np.random.Generator,
    *,
    plan: RecordingPlan | None = None,
) -> tuple[ReadLevel, ...]:
    """Return levels read from simulated recordings of a case's machine at drives (amplitude, omega).

    `truth` holds the true values of the estimated parameters, the damping ratio `zeta` included if it is free.
    """
    model: Model = make_plugin(registry, "model", case.model)
    values = convert_damping(model, {**case.known, **truth})
    found = []
    for (amplitude, omega), own in zip(drives, rng.spawn(len(drives)), strict=True):
        signals, _ = simulate_signals(model, values, Harmonic(amplitude, omega), plan or RecordingPlan(), own)
        found.append(read_level(signals, registry, own))
    return tuple(found)


def convert_damping(model: Model, values: Mapping[str, float]) -> dict[str, float]:
    """Return parameters in which the damping ratio `zeta`, where given, is converted to damping."""
    own = {key: value for key, value in values.items() if key not in {group.name for group in model.groups}}
    for group in model.groups:
        if group.name in values and not group.target.startswith("drive."):
            own[group.target] = group.law(own, values[group.name])
    return own
