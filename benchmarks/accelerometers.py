"""Machines at random of which only the acceleration was recorded: how often intervals cover, and what is named falsely.

    python benchmarks/accelerometers.py --machines 100 --seed 0 --out FOLDER [--jobs 2] [--numbers 0,3]

Each machine is linear, has a cubic spring, or backlash; it is struck by a hammer several times, or driven by a
multisine. Nothing is hidden: the nominal model is right, so each mechanism that is named is a false alarm. Motions are
made by DOP853 from equations written anew here, driven by the true force at any time; the recording holds the force at
the samples with noise of 0.1 % of its peak, and the acceleration with white noise of 0.5 to 2 % of its deviation.

One line of JSON for each machine goes to a file in FOLDER as it is done: a run that was stopped goes on from there.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import lsim
from scipy.stats import binom

Array = NDArray[np.float64]
Force = Callable[[Any], Any]
KINDS, EXCITATIONS = ("linear", "cubic", "backlash"), ("impact", "multisine")
EXCITATION_NOISE = 1e-3
"""Noise of the measured force as a share of its peak."""
LINES = 24
LEAD = 300
"""A machine under a multisine has been moving for so many samples when the recording begins."""


@dataclass(frozen=True)
class Machine:
    """A machine drawn at random: its values in SI units, the true force, and how it is recorded.

    `priors` holds for each parameter that is estimated the ends of a log-uniform prior of a decade.
    """

    number: int
    kind: str
    excitation: str
    values: dict[str, float]
    priors: dict[str, tuple[float, float]]
    force: Force
    peak: float
    dt: float
    samples: int
    noise: float

    @property
    def model(self) -> str:
        """The name of the nominal model."""
        return "lin_backlash" if self.kind == "backlash" else "duffing"


def make_hammer_blows(t: Any, hits: Array, widths: Array, peaks: Array) -> Any:
    """Return the force of half-sine pulses at the times `t`."""
    share = (np.asarray(t)[..., None] - hits) / widths
    return np.sum(np.where((share > 0.0) & (share < 1.0), peaks * np.sin(math.pi * share), 0.0), axis=-1)


def make_multisine(t: Any, omegas: Array, phases: Array, amplitude: float) -> Any:
    """Return the sum of cosines of one amplitude at the times `t`."""
    return amplitude * np.sum(np.cos(np.asarray(t)[..., None] * omegas + phases), axis=-1)


def draw_machine(seed: int, number: int) -> Machine:
    """Return machine `number` of a campaign: kinds and excitations take turns, all else is drawn."""
    rng = np.random.default_rng([seed, number])
    kind, excitation = KINDS[number % 3], EXCITATIONS[number // 3 % 2]
    mass, _, length = np.exp(rng.uniform(*np.log([[0.3, 1.0, 1e-4], [5.0, 2.0, 5e-3]]))).tolist()
    hertz, zeta, per_period = np.exp(rng.uniform(*np.log([[5.0, 0.005, 20.0], [60.0, 0.05, 100.0]]))).tolist()
    rate, samples = 2.0 * math.pi * hertz, int(rng.integers(3000, 8001))
    dt = 2.0 * math.pi / rate / per_period
    stiffness, damping = mass * rate**2, 2.0 * zeta * mass * rate
    shape = _draw_hammer_blows(rng, dt, per_period, samples) if excitation == "impact" else _draw_multisine(rng, rate)
    t = np.arange(samples) * dt
    alike = lsim(([1.0], [mass, damping, stiffness]), shape(t), t)[1]
    size = length / float(np.abs(alike).max())
    values = {"m": mass, "c": damping}
    if kind == "backlash":
        values |= {"k0": stiffness, "x0": length * rng.uniform(0.05, 0.5)}
        values["k1"] = stiffness * float(rng.choice([0.0, rng.uniform(0.03, 0.3)]))
        free = ("c", "k0", "x0")
    else:
        cubic = stiffness / length**2 * rng.uniform(0.1, 1.0)
        values |= {"k": stiffness, "k3": cubic if kind == "cubic" else 0.0}
        free = ("c", "k", "k3") if kind == "cubic" else ("c", "k")
    priors = {name: _draw_decade(values[name], rng) for name in free}
    noise = rng.uniform(0.005, 0.02)
    force = partial(_scale_force, shape=shape, size=size)
    peak = float(np.abs(force(t)).max())
    return Machine(number, kind, excitation, values, priors, force, peak, dt, samples, noise)


def _scale_force(t: Any, shape: Force, size: float) -> Any:
    return size * shape(t)


def _draw_decade(value: float, rng: np.random.Generator) -> tuple[float, float]:
    """Return the ends of a decade in which a value lies, off its middle by up to 2.2 to either side."""
    middle = value * math.exp(rng.uniform(-0.8, 0.8))
    return middle / math.sqrt(10.0), middle * math.sqrt(10.0)


def _draw_hammer_blows(rng: np.random.Generator, dt: float, per_period: float, samples: int) -> Force:
    """Return three to eight hits, each 6 to 25 samples wide and half a natural period at most."""
    count = int(rng.integers(3, 9))
    gaps = (np.arange(count) + rng.uniform(0.02, 0.7, count)) / count
    widths = np.minimum(np.exp(rng.uniform(math.log(6.0), math.log(25.0), count)), 0.5 * per_period) * dt
    return partial(make_hammer_blows, hits=gaps * samples * dt, widths=widths, peaks=rng.uniform(0.4, 1.0, count))


def _draw_multisine(rng: np.random.Generator, rate: float) -> Force:
    omegas = rate * np.sort(rng.uniform(0.3, 2.0, LINES))
    return partial(make_multisine, omegas=omegas, phases=rng.uniform(0.0, 2.0 * math.pi, LINES), amplitude=1.0)


def make_rates(machine: Machine) -> Callable[[float, Array], list[float]]:
    """Return the derivatives of position and velocity."""
    v, force = machine.values, machine.force
    m, c = v["m"], v["c"]
    if machine.kind == "backlash":
        k1, k0, x0 = v["k1"], v["k0"], v["x0"]

        def pull(x: float) -> float:
            return k1 * x + k0 * (x - min(max(x, -x0), x0))

    else:
        k, k3 = v["k"], v["k3"]

        def pull(x: float) -> float:
            return (k + k3 * x * x) * x

    return lambda t, y: [y[1], (float(force(t)) - c * y[1] - pull(float(y[0]))) / m]


def simulate(machine: Machine) -> Array:
    """Return position, velocity and acceleration (samples, 3).

    A machine that is struck begins at rest, one under a multisine somewhere in its motion.
    """
    rates, t = make_rates(machine), np.arange(machine.samples) * machine.dt
    lead = LEAD * machine.dt if machine.excitation == "multisine" else 0.0
    tiny = 1e-9 * machine.peak / _find_stiffest(machine)
    step = machine.dt / (4.0 if machine.kind == "backlash" else 2.0)
    tight = {
        "rtol": 1e-9,
        "atol": [tiny, tiny * math.sqrt(_find_stiffest(machine) / machine.values["m"])],
        "max_step": step,
    }
    seen = solve_ivp(rates, (-lead, t[-1]), [0.0, 0.0], "DOP853", t_eval=t, **tight).y.T
    return np.column_stack([seen, [rates(now, y)[1] for now, y in zip(t, seen, strict=True)]])


def record(machine: Machine, seed: int) -> tuple[Any, Array]:
    """Return the observation of a machine, and its true states (samples, 3)."""
    from lostmotion.likelihood.observation import Observation, window_force

    rng = np.random.default_rng([seed, machine.number, 1])
    states = simulate(machine)
    t = np.arange(machine.samples) * machine.dt
    force = machine.force(t) + EXCITATION_NOISE * machine.peak * rng.standard_normal(len(t))
    shown = states[:, 2] + machine.noise * states[:, 2].std() * rng.standard_normal(len(t))
    return Observation.of("recording", shown, window_force(force)[:, None], machine.dt, "acceleration"), states


def make_case(machine: Machine) -> Any:
    """Return the case: what is known, and a decade for what is not."""
    from lostmotion.case import CaseFile, Prior

    priors = {name: Prior(low=low, high=high, scale="log") for name, (low, high) in machine.priors.items()}
    known = {name: value for name, value in machine.values.items() if name not in priors}
    return CaseFile("study", Path(), (), machine.model, known, priors, {}, (), "")


def run_machine(seed: int, number: int) -> dict[str, Any]:
    """Return what a diagnosis says of a machine, beside the truth."""
    from lostmotion.diagnosis.outcome import compute_intervals, draw_parameters
    from lostmotion.diagnosis.stages import diagnose
    from lostmotion.likelihood.system import System
    from lostmotion.preparation.candidate_terms import candidates_of
    from lostmotion.registry import default

    machine = draw_machine(seed, number)
    observation, states = record(machine, seed)
    registry = default()
    model = registry.make("model", machine.model)
    system = System(model, candidates_of(model, [registry.load("term", n) for n in registry.names("term")]))
    begin = time.perf_counter()
    d = diagnose(make_case(machine), [observation], system, rng=np.random.default_rng(0), jobs=1)
    known = compute_intervals(d.after, draw_parameters(d.after, np.random.default_rng(1)))
    seconds = time.perf_counter() - begin
    return {
        "number": machine.number,
        "kind": machine.kind,
        "excitation": machine.excitation,
        "samples": machine.samples,
        "per_period": 2.0 * math.pi / machine.dt / math.sqrt(_find_stiffest(machine) / machine.values["m"]),
        "found": [*d.named, *(["unknown"] if d.unknown else [])],
        "random_gain": d.random_gain,
        "unexplained": d.unexplained,
        "estimates": {k: compare_interval(machine.values[k], known[k]) for k in machine.priors},
        "status": d.after.status,
        "seconds": seconds,
    } | _measure_more(d, machine, states, observation)


def _find_stiffest(machine: Machine) -> float:
    return machine.values.get("k", 0.0) or machine.values["k0"]


def _measure_more(d: Any, machine: Machine, states: Array, observation: Any) -> dict[str, Any]:
    """Return levels of noise over their truths, and how often the band of the position holds the true one."""
    from lostmotion.inference.unseen import smooth_body_position

    posterior, theta = d.after.posterior, d.after.theta
    process, white = posterior.recordings[0].random_force(theta), posterior.recordings[0].noise(theta).white
    place = smooth_body_position(d.after, d.shown)
    true, highest = EXCITATION_NOISE * machine.peak, float(np.abs(states[:, 0]).max())
    return {
        "random_over_true": math.sqrt(process / machine.dt) / true,
        "noise_over_true": math.sqrt(white) / (machine.noise * float(states[:, 2].std())),
        "usual_over_true": math.exp(0.5 * posterior.scales.usual) / math.sqrt(machine.dt) / true,
        "length_over_true": posterior.scales.length / highest,
        "band": float(np.mean(np.abs(place.mean - states[:, 0]) <= 2.0 * place.sd)),
        "band_widest": float(2.0 * place.sd.max() / highest),
    }


def compare_interval(truth: float, interval: Any) -> dict[str, Any]:
    """Return truth, median, interval, whether it covers, and how many stated deviations the median is off."""
    sd = (interval.high - interval.low) / (2.0 * 1.96)
    return {
        "truth": truth,
        "median": interval.median,
        "low": interval.low,
        "high": interval.high,
        "covers": bool(interval.low <= truth <= interval.high),
        "z": (interval.median - truth) / sd if sd else math.inf,
    }


def compute_band(count: int, level: float = 0.95) -> tuple[float, float]:
    """Return between which shares the coverage of `count` true 95 % intervals lies in 95 of 100 campaigns."""
    if not count:
        return 0.0, 1.0
    low, high = binom.ppf([0.5 * (1.0 - level), 0.5 * (1.0 + level)], count, 0.95)
    return float(low / count), float(high / count)


def summarise(rows: Sequence[dict[str, Any]]) -> str:
    """Return coverage and rms z of all, by kind and by excitation, and the false alarms."""
    lines = [f"{'':<22}{'machines':>9}{'covered':>12}{'share':>8}   {'limits at 95 %':<16}{'rms z':>6}{'alarms':>8}"]
    groups = {"all": list(rows)}
    groups |= {kind: [r for r in rows if r["kind"] == kind] for kind in KINDS}
    groups |= {e: [r for r in rows if r["excitation"] == e] for e in EXCITATIONS}
    groups |= {f"{kind}, {e}": [r for r in groups[kind] if r["excitation"] == e] for kind in KINDS for e in EXCITATIONS}
    for name, chosen in groups.items():
        told = [e for r in chosen for e in r["estimates"].values()]
        if not told:
            continue
        covered, (low, high) = sum(e["covers"] for e in told), compute_band(len(told))
        size = math.sqrt(float(np.mean([e["z"] ** 2 for e in told])))
        alarms = sum(bool(r["found"]) for r in chosen)
        lines.append(
            f"{name:<22}{len(chosen):9d}{covered:7d}/{len(told):<4d}{covered / len(told):8.1%}   "
            f"{low:.1%} to {high:<8.1%}{size:6.2f}{alarms:8d}"
        )
    random = [r["number"] for r in rows if r["unexplained"]]
    band = float(np.mean([r["band"] for r in rows])) if rows else math.nan
    seconds = float(np.median([r["seconds"] for r in rows])) if rows else math.nan
    lines.append(f"random force beyond the usual: {len(random)} of {len(rows)} {random}")
    lines.append(f"named: { ({r['number']: r['found'] for r in rows if r['found']}) }")
    lines.append(f"true positions within the stated band (2 sd): {band:.1%} of samples; median time {seconds:.0f} s")
    return "\n".join(lines)


def read_rows(path: Path) -> list[dict[str, Any]]:
    """Return the lines of a run so far; one that was cut off is left out."""
    rows = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
        try:
            rows.append(json.loads(line))
        except json.JSONDecodeError:
            continue
    return rows


def run(seed: int, numbers: Iterable[int], path: Path, jobs: int) -> None:
    """Diagnose those machines that are not yet in the file."""
    done = {row["number"] for row in read_rows(path)}
    left = [number for number in numbers if number not in done]
    os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        for future in as_completed([pool.submit(run_machine, seed, number) for number in left]):
            with path.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps(future.result()) + "\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--numbers", default="", help="only these machines, such as 0,3,17")
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    path = asked.out / f"machines-{asked.seed}.jsonl"
    numbers = [int(n) for n in asked.numbers.split(",")] if asked.numbers else range(asked.machines)
    run(asked.seed, numbers, path, asked.jobs)
    rows = sorted((r for r in read_rows(path) if r["number"] in set(numbers)), key=lambda r: r["number"])
    print(" ".join([Path(sys.argv[0]).name, *sys.argv[1:]]))
    print(summarise(rows))


if __name__ == "__main__":
    main()
