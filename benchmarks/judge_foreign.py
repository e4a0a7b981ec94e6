"""Forty machines with a hidden law that the library lacks, for `benchmarks/judge.py`: every name is suspect.

`ACCEPT` was written before any result was seen. It lists for each law the names of the physically nearest family, which
an engineer would accept as a description; any other name of the library is false. Sizes are chosen so that the law
raises the log-likelihood by 60 to 1200: the recording with the law is fitted by the nominal model, and so is the same
recording (with the same noise) without it. The difference is what a true model could gain.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.signal import lfilter

import judge_integrator as laws
from judge_integrator import Law, compute_force, compute_level
from judge_machines import simulate_law
from judge_truth import Hiding, Truth, is_complete, record, save_truth, widen, write_driven_case
from library import ESTIMATED, draw_drive
from lostmotion.errors import LostMotionError
from lostmotion.inference.setup import choose_steps, make_posterior, search_maximum, split_heldout
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from lostmotion_trials.blind.pilot import EffectDraft, Pilot
from lostmotion_trials.blind.simulator import BlindMachine, draw_log_uniform, draw_parameters

SEED, SAMPLES = 4410, 3000
GAIN = (60.0, 1200.0)
"""Range of the gain in log-likelihood of a true model."""
TOLERANCE, TRIES = 0.35, 5
"""The error of the logarithm of a gain that is small enough, and how often the size is changed towards it."""
GAPPED, SPRUNG = ("lin_backlash",), ("linear_oscillator",)
BOTH = (*GAPPED, *SPRUNG)
DRIVES = ("harmonic", "multisine", "sweep", "harmonic")
DRY = ("coulomb_friction", "stribeck_friction", "position_dependent_friction")

KINDS: Mapping[str, tuple[int, tuple[str, ...]]] = {
    "exponential contact": (laws.EXPONENTIAL, GAPPED),
    "one-sided spring with exponent 1.5": (laws.ONE_SIDED, BOTH),
    "damping with exponent 1.5": (laws.POWER_DRAG, BOTH),
    "friction on a patch": (laws.PATCH, BOTH),
    "friction proportional to the deflection": (laws.SPRING_RUB, SPRUNG),
    "spring with a limited force": (laws.CLIPPED, BOTH),
    "Maxwell element": (laws.MAXWELL, BOTH),
    "contact with a soft edge": (laws.SOFT_EDGE, GAPPED),
    "tanh spring": (laws.SATURATED, BOTH),
    "damping with the square of position": (laws.SQUEEZE, BOTH),
}
"""The kind of the integrator, and the models in which a law can be hidden."""
ACCEPT: Mapping[str, tuple[str, ...]] = {
    "exponential contact": ("hertz_contact",),
    "one-sided spring with exponent 1.5": ("bilinear_stiffness", "quadratic_stiffness"),
    "damping with exponent 1.5": ("quadratic_damping",),
    "friction on a patch": DRY,
    "friction proportional to the deflection": (*DRY, "load_dependent_friction"),
    "spring with a limited force": ("cubic_stiffness", "linear_stiffness", "end_stop"),
    "Maxwell element": (),
    "contact with a soft edge": ("hertz_contact",),
    "tanh spring": ("cubic_stiffness", "linear_stiffness"),
    "damping with the square of position": ("hunt_crossley_contact", "contact_damping"),
}
"""Names that describe a law to an engineer: a hardening contact, a spring stiffer on one side, damping that grows with
speed, dry friction, a softening spring, damping that grows with the depth. A Maxwell element has no relative."""


def draw_machine(number: int, attempt: int, first: int = SEED) -> tuple[str, str, BlindMachine, np.random.Generator]:
    """Return law and drive of a machine, a random machine for them, and its random numbers."""
    name = list(KINDS)[number % len(KINDS)]
    drive = DRIVES[number // len(KINDS) % len(DRIVES)]
    rng = np.random.default_rng([first, number, attempt])
    model = str(rng.choice(KINDS[name][1]))
    natural, mass = draw_log_uniform(rng, 5.0, 100.0), draw_log_uniform(rng, 0.2, 20.0)
    values, amplitude = draw_parameters(model, mass, natural, rng)
    ratio = draw_log_uniform(rng, 0.4, 1.1)
    rate = 40.0 * ratio * natural / (2.0 * math.pi)
    signal = draw_drive(drive, amplitude, ratio * natural, SAMPLES / rate, rng)
    noise = draw_log_uniform(rng, 0.002, 0.01)
    return (
        name,
        drive,
        BlindMachine(model, values, ESTIMATED.get(model, ("c", "x0")), signal, rate, SAMPLES, noise),
        rng,
    )


def draw_law(name: str, pilot: Pilot, rng: np.random.Generator) -> Law:
    """Return a law of unit size whose lengths fit the motion without it."""
    x, gap = pilot.q, pilot.rig.body.x0
    deep = max(float(np.quantile(np.abs(x), 0.95)) - gap, 0.05 * float(np.std(x)))
    kind, spread, middle = KINDS[name][0], float(np.std(x)), float(np.mean(x))
    if kind == laws.EXPONENTIAL:
        return Law(kind, 1.0, deep * float(rng.uniform(0.3, 0.8)))
    if kind == laws.SOFT_EDGE:
        return Law(kind, 1.0, min(deep, 0.5 * gap) * float(rng.uniform(0.1, 0.4)))
    if kind == laws.PATCH:
        place, half = middle + spread * float(rng.uniform(-0.8, 0.8)), spread * float(rng.uniform(0.2, 0.5))
        return Law(kind, 1.0, place, half, 0.1 * half)
    if kind == laws.MAXWELL:
        return Law(kind, 1.0, float(rng.uniform(0.4, 2.0)) * spread / float(np.std(pilot.v)))
    return Law(kind, 1.0, spread * float(rng.uniform(0.3, 0.9)))


def compute_along(law: Law, pilot: Pilot) -> np.ndarray:
    """Return the force (samples,) of a law along the motion without it."""
    body, x, v = pilot.rig.body, pilot.q, pilot.v
    fade = math.exp(-1.0 / (pilot.rig.rate * law.a))
    z = lfilter([law.a * (1.0 - fade)], [1.0, -fade], v) if law.kind == laws.MAXWELL else np.zeros(len(x))
    rows = zip(x, v, z, strict=True)
    return np.array([compute_force(a, b, c, body, law) - compute_level(a, law) * np.sign(b) for a, b, c in rows])


def write_machine(rig: BlindMachine, motion: np.ndarray, folder: Path, seed: tuple[int, ...]) -> None:
    """Write the case of a machine; drive noise, sensor noise and priors depend only on the seed."""
    rng = np.random.default_rng(seed)
    shown, seen = record(rig.signal.value(rig.time), motion, rig.noise, rng)
    known = {n: v for n, v in rig.values.items() if n not in rig.estimated}
    estimate = {name: widen(rig.values[name], rng) for name in rig.estimated}
    model = {"name": rig.model, "known": known, "estimate": estimate}
    write_driven_case(folder, f"Machine {seed[-2]}", {"time": rig.time, "force": shown, "position": seen}, model)


def fit_nominal(folder: Path) -> float:
    """Return the log-likelihood of the nominal model, fitted to the part of a recording that a diagnosis fits."""
    prepared = prepare(folder / "case.toml", default())
    train, _ = split_heldout(prepared.observations)
    posterior = make_posterior(System(prepared.model, prepared.terms), prepared.case, train, jobs=1)
    return search_maximum(choose_steps(posterior, posterior.space.start), np.random.default_rng(0)).log_likelihood


def check_motion(rig: BlindMachine, motion: np.ndarray, pilot: Pilot) -> None:
    """Raise ValueError where a law changes the motion much, or where there is almost always or never contact."""
    ratio = float(np.std(motion)) / float(np.std(pilot.q))
    if not 0.4 < ratio < 2.5:
        raise ValueError("the law changes the motion too much")
    if "x0" in rig.values and not 0.1 < float(np.mean(np.abs(motion) > rig.body.x0)) < 0.95:
        raise ValueError("the contact is almost never or almost always closed")


def fit_size(rig: BlindMachine, pilot: Pilot, unit: Law, wanted: float, seed: tuple[int, ...]) -> tuple[Law, float]:
    """Return the law at the size whose gain is nearest to the wanted one, and its gain."""
    expected = pilot.expect_gain(EffectDraft(compute_along(unit, pilot), lambda size: {"size": size}))
    size = math.sqrt(wanted / max(expected, 1e-300))
    best: tuple[float, Law, float] | None = None
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        write_machine(rig, pilot.q, place, seed)
        clean = fit_nominal(place)
        for _ in range(TRIES):
            law = unit._replace(size=unit.size * size)
            motion = simulate_law(rig, law, np.zeros(4))
            check_motion(rig, motion, pilot)
            write_machine(rig, motion, place, seed)
            gain = max(clean - fit_nominal(place), 1.0)
            error = abs(math.log(gain / wanted))
            best = min(filter(None, (best, (error, law, gain))), key=lambda one: one[0])
            if error < TOLERANCE:
                break
            size *= min(max(math.sqrt(wanted / gain), 0.25), 4.0)
    if not 0.8 * GAIN[0] < best[2] < 1.25 * GAIN[1]:
        raise ValueError("no size has a gain in the range")
    return best[1], best[2]


def make_machine(number: int, folder: Path, first: int = SEED) -> Truth:
    """Write the first random machine of a number in which its law can act; return its truth."""
    for attempt in range(60):
        name, drive, rig, rng = draw_machine(number, attempt, first)
        wanted = draw_log_uniform(rng, *GAIN)
        seed = (first, number, attempt)
        try:
            pilot = Pilot(rig, simulate_law(rig, Law(), np.zeros(4)))
            check_motion(rig, pilot.q, pilot)
            law, gain = fit_size(rig, pilot, draw_law(name, pilot, rng), wanted, seed)
            motion = simulate_law(rig, law, np.zeros(4))
        except (ValueError, ArithmeticError, LostMotionError):
            continue
        write_machine(replace(rig), motion, folder, seed)
        parameters = {"size": law.size, "a": law.a, "b": law.b, "c": law.c}
        effect = Hiding(name, "ground", parameters, ACCEPT[name])
        says = f"{name} in {rig.model}"
        return Truth(folder.name, (effect,), rig.values, drive, says, 1.0 / rig.rate, gain=gain)
    raise ValueError(f"machine {number}: no machine in 60 attempts")


def make_foreign(out: Path, limit: int = 0, fresh: int = 0) -> list[Path]:
    """Return the folders of the machines; those that are missing are written first."""
    folders = []
    for number in range(limit or 40):
        folder = out / f"{number:03d}"
        folders.append(folder)
        if not is_complete(folder):
            save_truth(folder, make_machine(number, folder, SEED + fresh))
            print(folder, flush=True)
    return folders
