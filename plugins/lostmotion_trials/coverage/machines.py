"""Machines with known parameters, drawn from the priors of a case, and their simulated recordings.

Oscillator and joint with backlash are simulated by an independent integrator: leapfrog, with dry friction that sticks
exactly. Any other model, or one with other terms, is simulated by its own right-hand side, in steps ten times finer
than those of a fit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, DataError
from lostmotion.likelihood.drive import count_substeps
from lostmotion.likelihood.system import Clock, System
from lostmotion.simulation.drive_signals import DriveSignal, signal_of
from lostmotion_trials.integrators.oscillator import rattle

FRICTION = "coulomb_friction"
STEPS_PER_RATE = 0.003
"""Leapfrog steps times the fastest rate: two thousand steps a cycle of the contact."""
MODEL_STEPS_PER_RATE = 0.0015
"""Steps of the model's own right-hand side times its fastest rate: a tenth of those of a final fit."""
LEAST_SUBSTEPS, MOST_SUBSTEPS = 8, 4000
"""Bounds of the integration steps per sample."""
MOST_STEPS = 10_000_000
"""Steps of the right-hand side in all, which is what a gigabyte holds."""
PIECE_SAMPLES = 1000
"""Samples that are computed at a time."""
TRANSIENT = ("step", "sweep")
"""Drives that begin with the recording; before it they are as at their beginning."""
INDEPENDENT = "leapfrog, with friction that sticks"
OWN = "the right-hand side of the model itself, in steps ten times finer than those of the fit"


@dataclass(frozen=True)
class Stand:
    """How a machine is recorded: one recording to each drive, of `duration` s at `rate` Hz, after as long a run-up.

    `noise` is a share of the standard deviation of the response, `excitation_noise` one of the amplitude of the drive,
    sqrt(2) standard deviations: the machine feels the true drive, the recording shows the noisy one.
    """

    drives: tuple[str, ...]
    duration: float
    rate: float
    noise: float
    excitation_noise: float = 1e-3

    @property
    def samples(self) -> int:
        """The number of samples of each recording."""
        return round(self.duration * self.rate)

    def check(self) -> None:
        """Refuse numbers that no recording can have."""
        for what, value in (("duration", self.duration), ("rate", self.rate)):
            if not (0.0 < value < math.inf):
                raise CaseError(f"the {what} is {value:g}: expected a finite number above zero")
        for what, value in (("noise", self.noise), ("excitation noise", self.excitation_noise)):
            if not (0.0 <= value < math.inf):
                raise CaseError(f"the {what} is {value:g}: expected a share such as 0.01")
        if not self.drives:
            raise CaseError("nothing drives the machines: add --drive, such as harmonic:amplitude=1,frequency=2")
        for text in self.drives:
            signal_of(text, duration=2.0 * self.duration, rng=np.random.default_rng(0))


@dataclass(frozen=True)
class SeenMachine:
    """One recording (samples,): excitation and response with their noise, and the deviation of that of the response."""

    excitation: Array
    response: Array
    noise: float


@dataclass(frozen=True)
class _DrivenRun:
    """A drive over run-up and recording, as a function of the time (s) from the beginning of the run-up."""

    drive: DriveSignal
    rate: float
    samples: int

    def pieces(self, fine: int) -> Iterator[Array]:
        """Yield the edges (s) of the steps, `fine` to each sample, in pieces of so many samples."""
        ends = [*range(0, self.samples, PIECE_SAMPLES), self.samples]
        for first, last in pairwise(ends):
            yield np.arange(first * fine, last * fine + 1) / (fine * self.rate)


def record_machine(system: System, full: Array, bench: Stand, drive: str, rng: np.random.Generator) -> SeenMachine:
    """Return the recording of a machine with the parameters `full` under one drive.

    The machine has settled from a random start; the response is its position.
    """
    of_drive, of_start, of_noise = rng.spawn(3)
    signal = signal_of(drive, duration=2.0 * bench.duration, rng=of_drive)
    if drive.partition(":")[0] in TRANSIENT:
        signal = _delay_signal(signal, bench.samples / bench.rate)
    run = _DrivenRun(signal, bench.rate, 2 * bench.samples)
    response = _choose_mover(system)(system, full, run, of_start.uniform(-1.0, 1.0, 2))[bench.samples :]
    if not np.isfinite(response).all():
        raise DataError(f"the simulated motion of {system.model.name} diverges")
    excitation = signal.value(np.arange(bench.samples, run.samples) / bench.rate)
    loud = bench.excitation_noise * math.sqrt(2.0) * float(np.std(excitation))
    noise = bench.noise * float(np.std(response))
    own, other = of_noise.standard_normal((2, bench.samples))
    return SeenMachine(excitation + loud * other, response + noise * own, noise)


def describe_motion(system: System) -> str:
    """Return in words which integrator simulates the machines of a system."""
    return OWN if _choose_mover(system) is _move_by_model else INDEPENDENT


def _delay_signal(signal: DriveSignal, begin: float) -> DriveSignal:
    """Return a signal that begins at the time `begin` (s)."""
    return DriveSignal(
        lambda t: signal.value(np.maximum(t - begin, 0.0)),
        lambda t: np.where(t > begin, signal.slope(np.maximum(t - begin, 0.0)), 0.0),
        signal.top,
    )


_Mover = Callable[[System, Array, _DrivenRun, Array], Array]
"""Makes the position (samples,) from parameters, the run, and two numbers from -1 to 1 that say where it starts."""


def _choose_mover(system: System) -> _Mover:
    frictions = [key for key in system.keys if key.partition("@")[0] == FRICTION]
    if len(frictions) == len(system.keys) < 2 and system.model.name in _LEAPFROG:
        return _LEAPFROG[system.model.name]
    return _move_by_model


def _read_values(system: System, full: Array) -> dict[str, float]:
    """Return the parameters by name; `friction` is that of the term, wherever it acts."""
    values = {key: float(full[i]) for key, i in system.index.items()}
    return {**values, "friction": sum(v for k, v in values.items() if k.startswith(FRICTION) and k.endswith(".force"))}


def _scale_numbers(p: Mapping[str, float], rate: float) -> tuple[int, tuple[float, ...], float]:
    """Return steps between samples, the `numbers` of `rattle`, and the velocity that fills the gap."""
    m, contact = p["m"], p["k0"] / p["m"]
    fastest = math.sqrt(contact + p.get("k1", 0.0) / m) + p["c"] / m
    fine = min(max(math.ceil(fastest / rate / STEPS_PER_RATE), LEAST_SUBSTEPS), MOST_SUBSTEPS)
    own = (p["c"] / m, p.get("k1", 0.0) / m, contact, p["x0"], p["friction"] / m, p.get("mgl", 0.0) / m)
    return fine, (1.0 / (fine * rate), *own), p["x0"] * math.sqrt(contact)


def _move_oscillator(system: System, full: Array, run: _DrivenRun, start: Array) -> Array:
    """Return the motion of the oscillator with backlash."""
    p = _read_values(system, full)
    fine, numbers, quick = _scale_numbers(p, run.rate)
    state = start * np.array([p["x0"], quick])
    seen = []
    for edges in run.pieces(fine):
        push = run.drive.value(0.5 * (edges[1:] + edges[:-1])) / p["m"]
        nothing = np.zeros_like(push)
        seen.append(rattle(push, nothing, nothing, numbers, state, fine))
    return np.concatenate(seen)


def _move_joint(system: System, full: Array, run: _DrivenRun, start: Array) -> Array:
    """Return the motion of the link behind a joint with backlash; it is computed relative to the base."""
    p = _read_values(system, full)
    fine, numbers, quick = _scale_numbers(p, run.rate)
    state = start * np.array([p["x0"], quick])
    grounded = FRICTION in system.keys
    seen = []
    for edges in run.pieces(fine):
        slope = run.drive.slope(edges)
        lean = run.drive.value(0.5 * (edges[1:] + edges[:-1]))
        still = -slope[1:] if grounded else np.zeros_like(lean)
        moved = rattle(-np.diff(slope) / numbers[0], lean, still, numbers, state, fine)
        seen.append(moved + run.drive.value(edges[:-1:fine]))
    return np.concatenate(seen)


_LEAPFROG: Mapping[str, _Mover] = {"lin_backlash": _move_oscillator, "robot_joint": _move_joint}


def _move_by_model(system: System, full: Array, run: _DrivenRun, start: Array) -> Array:
    """Return the motion by the model's own right-hand side, from rest at a random place in its gap if it has one."""
    model, dt = system.model, 1.0 / run.rate
    known = {"force": run.drive.value, "base_position": run.drive.value, "base_velocity": run.drive.slope}
    if strange := [name for name in model.driven if name not in known]:
        raise CaseError(f"{model.name} is driven by {strange[0]}, which a simulation cannot make")
    inputs = [known[name] for name in model.driven]
    y0 = np.zeros(len(model.states))
    y0[0] = start[0] * full[system.index["x0"]] if "x0" in system.index else 0.0
    rough = system.moved(full, y0, inputs, Clock(dt, LEAST_SUBSTEPS, run.samples))
    picked = np.unique(np.linspace(0, max(rough.finite - 1, 0), 200).astype(int))
    u = np.stack([f(picked * dt) for f in inputs], axis=1)
    rate = system.find_fastest_rate(full, system.everything, rough.states[picked, : len(model.states)], u)
    nsub = max(LEAST_SUBSTEPS, count_substeps(rate, dt, accuracy=MODEL_STEPS_PER_RATE, most=MOST_SUBSTEPS))
    if nsub * run.samples > MOST_STEPS:
        raise CaseError(
            f"{run.samples} samples with {nsub} steps between them are more than {MOST_STEPS}: shorten the duration"
        )
    states = system.moved(full, y0, inputs, Clock(dt, nsub, run.samples)).states
    return states[:, _find_position(system)]


def _find_position(system: System) -> int:
    """Return which state is the position that the sensor shows."""
    state = system.channel("position")[1]
    if state < 0:
        raise CaseError(f"the position of {system.model.name} is none of its states, and no other channel is recorded")
    return state
