"""Twelve recordings with known truth for `benchmarks/judge.py`: easy cases, two effects, and laws without a name.

They are like those on which earlier versions failed (one name in place of two simple laws, false names for a contact
law that the library lacks, long searches). All but the pendulum are `lin_backlash` under one frequency with 24,000
samples. Integrators that share no code with the framework simulate them with at least ten times finer steps than a fit.
Two more (13, 14) are easy cases with more noise, in which friction gains about 800 and 500 in log-likelihood.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from judge_integrator import EXPONENTIAL, HUMPS, PATCH, PENDULUM, Law, move_law
from judge_truth import (
    EXCITATION_NOISE,
    Hiding,
    Truth,
    is_complete,
    record,
    save_truth,
    widen,
    write_driven_case,
    write_table,
)
from lostmotion.case import dump_case
from lostmotion_trials.blind.simulator import (
    STEPS_PER_RATE,
    BlindDrive,
    BlindMachine,
    Disturbances,
    bound_pace,
    simulate_machine,
    simulate_pieces,
)
from lostmotion_trials.integrators.hidden import BOUC_WEN, Body, Hidden

SAMPLES, SEED = 24_000, 44
PACE = 16.0
"""Samples per second over the angular frequency of the drive: about a hundred in a period."""
DRY = ("coulomb_friction",)
ANY_DRY = ("coulomb_friction", "stribeck_friction", "position_dependent_friction")
BRISTLES = ("bouc_wen_hysteresis", "dahl_friction", "lugre_friction")
DELAYS = ("excitation_delay", "sensor_delay")


@dataclass(frozen=True)
class Row:
    """A machine: m, c, k0, x0, amplitude (N) and frequency (rad/s) of its drive, noise, and what is hidden."""

    key: str
    says: str
    numbers: tuple[float, float, float, float, float, float]
    noise: float
    effects: tuple[Hiding, ...] = ()
    hidden: Hidden = field(default_factory=Hidden)
    disturbances: Disturbances = field(default_factory=Disturbances)
    law: Law | None = None


def hide(mechanism: str, accept: tuple[str, ...] = (), at: str = "ground", **parameters: float) -> Hiding:
    """Return a hidden effect; a name of the library is right for itself."""
    return Hiding(mechanism, at, parameters, accept or (mechanism,))


PULSE = 5.3
ROWS = (
    Row("01_nothing", "nothing hidden", (1.0, 8.0, 4e4, 5e-3, 100.0, 40.0), 0.005),
    Row(
        "02_friction", "friction of 2 % of the drive", (1.0, 5.1, 4e4, 5e-3, 65.0, 40.0), 0.005,
        (hide("coulomb_friction", DRY, force=1.3),), Hidden(friction=1.3),
    ),
    Row(
        "03_weak_friction", "friction of 0.5 N", (1.0, 8.0, 4e4, 5e-3, 100.0, 40.0), 0.005,
        (hide("coulomb_friction", DRY, force=0.5),), Hidden(friction=0.5),
    ),
    Row(
        "04_delay", "a delay of 0.9 ms", (1.2, 9.0, 3.5e4, 4e-3, 90.0, 37.0), 0.005,
        (hide("excitation_delay", DELAYS, "", delay=9e-4),), disturbances=Disturbances(excitation_delay=9e-4),
    ),
    Row(
        "05_three_simple", "friction, offset and a spring", (0.9, 6.5, 4.5e4, 4e-3, 110.0, 43.0), 0.004,
        (
            hide("coulomb_friction", DRY, force=1.6),
            hide("offset_force", force=-1.2),
            hide("linear_stiffness", coefficient=350.0),
        ),
        Hidden(friction=1.6, push=-1.2, spring=350.0),
    ),
    Row(
        "06_contact_law", "a contact that hardens exponentially", (1.0, 7.0, 3.8e4, 5e-3, 85.0, 40.0), 0.004,
        (hide("exponential contact", ("hertz_contact",), size=2.0, length=2e-3),), law=Law(EXPONENTIAL, 2.0, 2e-3),
    ),
    Row(
        "07_fast_pulsation", "a stiffness pulsating faster than the drive", (0.8, 6.0, 4e4, 4e-3, 90.0, 38.0), 0.005,
        (hide("parametric_stiffness", cosine=0.06 * math.cos(0.7), sine=-0.06 * math.sin(0.7), ratio=PULSE),),
        Hidden(depth=0.06, pace=PULSE * 38.0, phase=0.7),
    ),
    Row(
        "08_bouc_wen", "Bouc-Wen hysteresis", (1.1, 7.0, 4e4, 5e-3, 95.0, 39.0), 0.004,
        (hide("bouc_wen_hysteresis", BRISTLES, force=3.0, travel=1.2e-3),),
        Hidden(memory=BOUC_WEN, memory_force=3.0, memory_travel=1.2e-3),
    ),
    Row(
        "09_friction_patch", "a patch of friction over position", (1.0, 6.0, 4.2e4, 5e-3, 90.0, 41.0), 0.004,
        (hide("patch of friction", ANY_DRY, size=5.0, middle=2e-3, half=1.5e-3),),
        law=Law(PATCH, 5.0, 2e-3, 1.5e-3, 2e-4),
    ),
    Row("10_pendulum", "a pendulum that swings out with dry friction", (0.02, 5e-4, 0.0, 0.0, 0.0, 0.0), 0.004,
        (hide("coulomb_friction", DRY, force=0.01),)),
    Row(
        "11_friction_and_wear", "friction and a gap that grows", (1.0, 6.0, 4e4, 5e-3, 80.0, 40.0), 0.004,
        (hide("coulomb_friction", DRY, force=1.1), hide("gap_drift", at="", rate=3e-6)),
        Hidden(friction=1.1, drift=3e-6),
    ),
    Row(
        "12_left_over", "a smooth force over position without a term", (1.0, 7.5, 4e4, 5e-3, 100.0, 42.0), 0.004,
        (hide("two humps over position", ("unknown",), size=1.5, length=5e-3),), law=Law(HUMPS, 1.5, 5e-3),
    ),
    Row(
        "13_friction_in_noise", "friction of 2 % of the drive, more noise", (1.0, 5.1, 4e4, 5e-3, 65.0, 40.0), 0.025,
        (hide("coulomb_friction", DRY, force=1.3),), Hidden(friction=1.3),
    ),
    Row(
        "14_weak_friction_in_noise", "friction of 0.5 N, more noise", (1.0, 8.0, 4e4, 5e-3, 100.0, 40.0), 0.0125,
        (hide("coulomb_friction", DRY, force=0.5),), Hidden(friction=0.5),
    ),
)  # fmt: skip
MGL = 1.2
"""Gravity torque of the pendulum (N m)."""


def simulate_law(rig: BlindMachine, law: Law, state: np.ndarray) -> np.ndarray:
    """Return the position (samples,) of a machine with a law that the library lacks, after it has settled."""

    def follow(force, base, clock, every):
        return move_law(force, rig.body, law, state, clock[1], every)[:, 0]

    pace = bound_pace(rig) / STEPS_PER_RATE
    return simulate_pieces(rig, Disturbances(), np.random.default_rng(0), pace, follow)


def make_row(row: Row, folder: Path, rng: np.random.Generator, gauge: float) -> Mapping[str, float]:
    """Write the case of a driven machine, with such noise of its force; return its true parameters."""
    m, c, k0, x0, amplitude, omega = row.numbers
    values = {"m": m, "c": c, "k1": 0.0, "k0": k0, "x0": x0}
    drive = BlindDrive(((amplitude, omega, float(rng.uniform(0.0, 2.0 * math.pi))),))
    rig = BlindMachine("lin_backlash", values, ("c", "x0"), drive, PACE * omega, SAMPLES, row.noise)
    if row.law is None:
        motion = simulate_machine(rig, row.hidden, row.disturbances, rng)
    else:
        motion = simulate_law(rig, row.law, np.zeros(4))
    shown, seen = record(drive.value(rig.time), motion, row.noise, rng, gauge=gauge)
    estimate = {name: widen(values[name], rng) for name in rig.estimated}
    model = {"name": "lin_backlash", "known": {"m": m, "k0": k0, "k1": 0.0}, "estimate": estimate}
    write_driven_case(folder, f"Machine {row.key[:2]}", {"time": rig.time, "force": shown, "position": seen}, model)
    return values


def make_pendulum(row: Row, folder: Path, rng: np.random.Generator) -> Mapping[str, float]:
    """Write the case of a pendulum that is released at rest and swings out; return its true parameters."""
    inertia, damping = row.numbers[:2]
    rate, samples, every = 200.0, 6000, 400
    law = Law(PENDULUM, MGL, friction=dict(row.effects[0].parameters)["force"])
    state = np.array([1.3, 0.0, 0.0, 0.0])
    force = np.zeros(samples * every)
    motion = move_law(force, Body(inertia, damping, 0.0, 0.0, 0.0), law, state, 1.0 / (rate * every), every)[:, 0]
    seen = motion + row.noise * float(np.std(motion)) * rng.standard_normal(samples)
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / "recording.csv", {"time": np.arange(samples) / rate, "angle": seen})
    recording = {
        "file": "recording.csv",
        "time": "time",
        "inputs": [],
        "sensors": [{"channel": "position", "column": "angle", "unit": "rad"}],
    }
    values = {"J": inertia, "b": damping, "mgl": MGL}
    model = {
        "motion": "rotation",
        "equations": ["J*a'' + b*a' + mgl*sin(a) = 0"],
        "known": {"J": inertia},
        "estimate": {name: widen(values[name], rng) for name in ("b", "mgl")},
    }
    case = {"title": f"Machine {row.key[:2]}", "recordings": [recording], "model": model}
    dump_case(case, folder / "case.toml")
    return values


def make_exact(out: Path, limit: int = 0, fresh: int = 0) -> list[Path]:
    """Return the folders of the twelve machines with forces that are recorded without noise."""
    return make_twelve(out, limit, fresh, gauge=0.0)


def make_twelve(out: Path, limit: int = 0, fresh: int = 0, gauge: float = EXCITATION_NOISE) -> list[Path]:
    """Return the folders of the twelve machines; those that are missing are written first."""
    folders = []
    for number, row in enumerate(ROWS[: limit or None]):
        folder = out / row.key
        folders.append(folder)
        if is_complete(folder):
            continue
        rng = np.random.default_rng([SEED + fresh, number])
        free = row.key == "10_pendulum"
        values = make_pendulum(row, folder, rng) if free else make_row(row, folder, rng, gauge)
        dt = 1.0 / 200.0 if free else 1.0 / (PACE * row.numbers[5])
        save_truth(folder, Truth(row.key, row.effects, values, "free" if free else "harmonic", row.says, dt))
    return folders
