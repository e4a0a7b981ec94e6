"""The recording of the demo: a robot joint with hidden friction, simulated without the models of the framework.

The motion is computed in degrees and relative to the motor side, with friction that sticks exactly, by time stepping
about forty times finer than any fit. No code is shared with the kernels of the models.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lostmotion.case import dump_case
from lostmotion.contracts import Array
from lostmotion.storage import folder_for, save_table, whole
from lostmotion_trials.integrators.joint import slide

JOINT = {"m": 0.05, "c": 0.15, "k0": 180.0, "x0": math.radians(0.75), "mgl": 0.0}
"""The machine in SI units under the names of `robot_joint`: a light link in the horizontal plane, whose contact
resonates at 9.5 Hz."""
HIDDEN = "coulomb_friction@base.force"
FRICTION = 0.03
"""Hidden friction (N m): 12 % of the peak inertial torque, 2.2 % of the peak torque of the joint."""
FREQUENCY = 1.54
AMPLITUDE = 3.0
"""Base motion (Hz, deg): the link moves chaotically, with an exponent of 1.2 1/s, and of 2.4 without friction."""
ENCODER_COUNT = 360.0 / 2**17
MOTOR_FINER = 5.0
"""One count of the encoder of the link (deg), and how much finer the other encoder is: it is on the motor, before the
gear."""
SUBSTEPS = 200
SETTLING_PERIODS = 30
"""Steps between samples, and drive periods before the recording begins."""
DIGITS = 6
"""Decimal digits of the recorded angles (deg)."""


@dataclass(frozen=True)
class NominalJoint:
    """The nominal model of the joint, in SI units: known values, and ends of log-uniform priors of the others."""

    known: Mapping[str, float]
    estimate: Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Concealed:
    """A recording and its true parameters.

    `time` (s), `base_position` and `position` (deg, as read by the encoders), each (samples,); `stuck` is the share of
    time in which the friction sticks. `truth` is in SI units; `nominal` is the model that the case states.
    """

    time: Array
    base_position: Array
    position: Array
    stuck: float
    truth: Mapping[str, float]
    nominal: NominalJoint


def conceal_joint(
    rng: np.random.Generator,
    *,
    periods: int = 60,
    rate: float = 200.0,
    friction: float = FRICTION,
    noise: float = 0.015,
) -> Concealed:
    """Return a recording (degrees, `rate` in Hz) of a joint that hides `friction` (N m); with 0 nothing is hidden.

    `noise` (deg) is the standard deviation of the noise of the encoder of the link, 0.6 % of that of the motion; the
    encoder of the motor has a fifth of that. Both round to whole counts.
    """
    phase, start = rng.uniform(0.0, 2.0 * math.pi), rng.uniform(-0.5, 0.5)
    settle = round(SETTLING_PERIODS * rate / FREQUENCY)
    samples = settle + round(periods * rate / FREQUENCY)
    base, seen = simulate_joint(phase, start, friction, rate, samples)
    base, seen = base[settle:], seen[settle:]
    return Concealed(
        time=np.arange(len(base)) / rate,
        base_position=_read_encoder(base, 1.0 / MOTOR_FINER, noise, rng),
        position=_read_encoder(base + seen[:, 0], 1.0, noise, rng),
        stuck=float(seen[:, 2].mean()),
        truth={**JOINT, HIDDEN: friction},
        nominal=_make_nominal(),
    )


def simulate_joint(phase: float, start: float, friction: float, rate: float, samples: int) -> tuple[Array, Array]:
    """Return the true base angle (samples,) in deg and the columns of `slide` (samples, 3) from rest at `start` deg."""
    step, omega = 1.0 / (rate * SUBSTEPS), 2.0 * math.pi * FREQUENCY
    base = AMPLITUDE * np.cos(omega * (np.arange(samples * SUBSTEPS) + 0.5) * step + phase)
    m = JOINT["m"]
    forces = math.degrees(friction / m), math.degrees(JOINT["mgl"] / m)
    numbers = (step, JOINT["c"] / m, JOINT["k0"] / m, math.degrees(JOINT["x0"]), *forces)
    seen = slide(omega**2 * base, base, numbers, (start, 0.0), SUBSTEPS)
    return AMPLITUDE * np.cos(omega * np.arange(samples) / rate + phase), seen


def write_case(concealed: Concealed, folder: Path) -> Path:
    """Return the path of `case.toml`, written into `folder` together with `recording.csv`."""
    folder = Path(folder)
    folder_for(folder)
    columns = {"time": concealed.time, "base": concealed.base_position, "link": concealed.position}
    save_table(folder / "recording.csv", columns, {"time": "s", "base": "deg", "link": "deg"}, {})
    path = folder / "case.toml"
    with whole(path) as spare:
        dump_case(
            {
                "title": f"Robot link at {FREQUENCY} Hz behind a joint with backlash",
                "recordings": [
                    {
                        "file": "recording.csv",
                        "time": "time",
                        "excitation": {"column": "base", "quantity": "base_position", "unit": "deg"},
                        "response": {"column": "link", "quantity": "position", "unit": "deg"},
                    }
                ],
                "model": {
                    "name": "robot_joint",
                    "known": concealed.nominal.known,
                    "estimate": {
                        name: {"low": low, "high": high, "scale": "log"}
                        for name, (low, high) in concealed.nominal.estimate.items()
                    },
                },
                "truth": concealed.truth,
            },
            spare,
        )
    return path


def _read_encoder(angle: Array, coarse: float, noise: float, rng: np.random.Generator) -> Array:
    """Return an angle (deg) as read by an encoder whose noise and count are `coarse` times those of the link."""
    count = coarse * ENCODER_COUNT
    shown = count * np.round((angle + coarse * noise * rng.standard_normal(len(angle))) / count)
    return np.round(shown, DIGITS)


def _make_nominal() -> NominalJoint:
    """Return the nominal model: inertia, stiffness and weight are known, as from drawings."""
    return NominalJoint({key: JOINT[key] for key in ("m", "k0", "mgl")}, {"c": (0.01, 2.0), "x0": (0.002, 0.1)})
