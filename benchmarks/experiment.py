"""Whether a proposed experiment separates what the recording at hand cannot, and how much better than a repeat.

Machines whose truth is one of a pair that is easily confused are recorded by an integrator of their own (leapfrog, with
friction that truly sticks; it knows no terms). Both models are fitted to a short and noisy recording, an experiment is
proposed, and the machine is recorded again: as proposed, and as before. Printed is the log Bayes factor in favour of
the truth: of the recording at hand, expected of either experiment, and found in it (mean over noise, and its range).

    python benchmarks/experiment.py [--only NAME] [--draws 3]
"""

from __future__ import annotations

import argparse
import math
import time
from dataclasses import dataclass
from pathlib import Path

import numba
import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.case import CaseFile, Prior
from lostmotion.diagnosis.experiment import compute_bayes_factor, propose
from lostmotion.evidence.effects import propose_start
from lostmotion.inference.candidates import fit_term
from lostmotion.inference.fit import maximise
from lostmotion.inference.setup import make_posterior, search_maximum
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System, key_of
from lostmotion.registry import Registry

FINE = 40
"""Leapfrog steps between samples."""


@dataclass(frozen=True)
class Machine:
    """A machine with its truth, the other term that it is confused with, and how it was recorded (SI units).

    `law` holds k, k0, x0, k3, drag, sliding friction, its excess towards rest, Stribeck velocity, bristle travel.
    """

    name: str
    model: str
    known: dict
    estimate: dict
    truth: str
    other: str
    m: float
    c: float
    law: tuple
    level: float
    frequency: float
    rate: float
    samples: int
    noise: float


@numba.njit
def moved(u, h, fine, m, c, law, state):
    """Return the position (samples,) under the force `u` at the middle of each step."""
    k, k0, x0, k3, drag, friction, excess, slow, travel = law
    x, v, bristle = state
    out = np.empty(len(u) // fine)
    for i in range(len(u)):
        if i % fine == 0:
            out[i // fine] = x
        x += 0.5 * h * v
        contact = k0 * (x - min(max(x, -x0), x0)) if k0 > 0.0 else 0.0
        force = u[i] - k * x - contact - k3 * x**3 - drag * abs(v) * v - c * v
        if travel > 0.0:
            # The bristle law is linear in its own force while the velocity keeps its sign: solved exactly.
            level = friction if v > 0.0 else -friction
            bristle = level + (bristle - level) * math.exp(-abs(v) * h / travel)
            v += h * (force - bristle) / m
        else:
            free = v + h * force / m
            most = h * (friction + excess * math.exp(-((v / slow) ** 2))) / m
            v = 0.0 if abs(free) <= most else free - math.copysign(most, free)
        x += 0.5 * h * v
    return out


GAP = {"m": 1.0, "k0": 4e4, "k1": 0.0}
GAP_FREE = {"c": Prior(low=1.0, high=40.0, scale="log"), "x0": Prior(low=1e-3, high=2e-2, scale="log")}
SPRING_FREE = {"c": Prior(low=0.1, high=40.0, scale="log")}
_NO = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def _law(**values):
    names = ("k", "k0", "x0", "k3", "drag", "friction", "excess", "slow", "travel")
    return tuple(float(values.get(name, was)) for name, was in zip(names, _NO, strict=True))


MACHINES = (
    Machine("stribeck or coulomb, gap", "lin_backlash", GAP, GAP_FREE, "stribeck_friction", "coulomb_friction", 1.0,
            8.0, _law(k0=4e4, x0=5e-3, friction=3.0, excess=0.6, slow=0.1), 100.0, 6.366, 1000.0, 3000, 0.02),
    Machine("dahl or coulomb, spring", "linear_oscillator", {"m": 1.0, "k": 400.0}, SPRING_FREE, "dahl_friction",
            "coulomb_friction", 1.0, 2.0, _law(k=400.0, friction=2.0, travel=5e-4), 20.0, 2.5, 200.0, 600, 0.08),
    Machine("cubic or linear stiffness, spring", "linear_oscillator", {"m": 1.0, "k": 400.0}, SPRING_FREE,
            "cubic_stiffness", "linear_stiffness", 1.0, 4.0, _law(k=400.0, k3=6e3), 10.0, 2.0, 200.0, 1000, 0.05),
    Machine("quadratic damping or coulomb, spring", "linear_oscillator", {"m": 1.0, "k": 400.0}, SPRING_FREE,
            "quadratic_damping", "coulomb_friction", 1.0, 3.0, _law(k=400.0, drag=2.0), 8.0, 3.2, 200.0, 400, 0.2),
)  # fmt: skip


def recorded(machine, inputs, rng, harmonic=None):
    """Return the recording of a machine under a force (samples,), after a run-up under its beginning."""
    dt, n = 1.0 / machine.rate, len(inputs)
    true = CubicSpline(np.arange(n) * dt, inputs)
    middle = (np.arange(n * FINE) + 0.5) * dt / FINE
    u = true(np.minimum(middle, (n - 1) * dt))
    x = moved(u, dt / FINE, FINE, machine.m, machine.c, machine.law, (0.0, 0.0, 0.0))
    seen = x + machine.noise * SIZES[machine.name] * rng.standard_normal(n)
    force = inputs + 1e-3 * math.sqrt(2.0) * float(np.std(inputs)) * rng.standard_normal(n)
    bare = Observation.of("recording", seen, force[:, None], dt, "position")
    period = bare.period
    found = DriveHarmonic(2.0 * math.pi / (period * dt) if period else 0.0, bare.travel)
    return Observation.of("recording", seen, force[:, None], dt, "position", harmonic=harmonic or found)


SIZES = {}
"""The standard deviation of the first motion: the noise of a sensor does not know what it will be used for."""


def first(machine, rng):
    """Return the recording at hand: a sine that begins with the recording."""
    t = np.arange(machine.samples) / machine.rate
    inputs = machine.level * np.sin(2.0 * math.pi * machine.frequency * t)
    SIZES[machine.name] = 0.0
    SIZES[machine.name] = float(np.std(recorded(machine, inputs, rng).response))
    return inputs, recorded(machine, inputs, rng)


def fitted(machine, observation):
    """Return the fits with the true term and with the other one."""
    registry = Registry.discover()
    terms = tuple(registry.make("term", name) for name in (machine.truth, machine.other))
    case = CaseFile(machine.name, Path(), (), machine.model, machine.known, machine.estimate, {}, (), "")
    nominal = search_maximum(
        make_posterior(System(registry.make("model", machine.model), terms), case, (observation,)),
        np.random.default_rng(0),
    )
    fits = [fit_term(nominal, key, propose_start(nominal, key)) for key in map(key_of, terms)]
    # A fit with one term may show the other where to begin.
    return [maximise(f.posterior, f.theta) for f in fits]


def studied(machine, draws=3, seed=0):
    """Return what a study of one machine finds, as numbers; log Bayes factors in favour of the truth."""
    rng = np.random.default_rng(seed)
    inputs, observation = first(machine, rng)
    truth, other = fitted(machine, observation)
    start = time.perf_counter()
    proposal = propose(truth, other, rng=rng)
    taken = time.perf_counter() - start
    if proposal is None:
        return {"name": machine.name, "at_hand": truth.log_evidence - other.log_evidence, "seconds": taken}
    e = proposal.excitation
    asked = CubicSpline(np.arange(len(e.inputs)), e.inputs[:, 0])(np.arange(min(len(inputs), len(e.inputs))))
    new = [compute_bayes_factor(truth, other, recorded(machine, asked, rng)) for _ in range(draws)]
    again = [compute_bayes_factor(truth, other, recorded(machine, inputs, rng)) for _ in range(draws)]
    band = " to ".join(f"{f:.3g}" for f in sorted(set(e.band)))
    return {
        "name": machine.name,
        "at_hand": truth.log_evidence - other.log_evidence,
        "seconds": taken,
        "excitation": f"{e.waveform}, {e.level:.3g} N at {band} Hz",
        "old": f"{machine.level:g} N at {machine.frequency:.3g} Hz",
        "expected": proposal.ways[0],
        "expected_repeat": proposal.repeat_ways[0],
        "found": new,
        "found_repeat": again,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="")
    parser.add_argument("--draws", type=int, default=3)
    args = parser.parse_args()
    for machine in MACHINES:
        if args.only not in machine.name:
            continue
        r = studied(machine, args.draws)
        print(f"{r['name']}: {r['at_hand']:.1f} at hand; proposed in {r['seconds']:.0f} s", flush=True)
        if "found" not in r:
            print("    no excitation got through")
            continue
        print(f"    {r['old']}  ->  {r['excitation']}")
        for word, key in (("proposed", ""), ("repeat", "_repeat")):
            expected, seen = r[f"expected{key}"], r[f"found{key}"]
            ends = f"[{min(seen):.1f}, {max(seen):.1f}]"
            print(f"    {word:9} expected {expected:6.1f}   found {np.mean(seen):6.1f}  {ends}")


if __name__ == "__main__":
    main()
