"""How well the terms of the library are named: `python benchmarks/library.py [table|clean] [options]`.

Each term is hidden in a machine by an integrator that shares no code with the framework
(`lostmotion_trials.integrators.hidden.move`), under a multisine, a sweep or a harmonic, measured by a sensor of
position, velocity or acceleration, at a size with a given expected gain in log-likelihood. Every diagnosis is a row in
`OUT/rows.jsonl`, so that a run can be stopped and resumed.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np

from library_rows import DRIVES, LATE, SENSORS, find_rival, print_summary
from lostmotion.case import dump_case
from lostmotion.codec import to_plain
from lostmotion.errors import LostMotionError
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from lostmotion.storage import save_table
from lostmotion_trials.blind.bound import compute_bound, compute_lead
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.mechanisms import NOISY, TABLE, Effect
from lostmotion_trials.blind.pilot import Pilot
from lostmotion_trials.blind.sealed import SealedMachine
from lostmotion_trials.blind.simulator import (
    EXCITATION_NOISE,
    BlindDrive,
    BlindMachine,
    Disturbances,
    draw_log_uniform,
    draw_parameters,
    simulate_machine,
    wide_prior,
)
from lostmotion_trials.integrators.hidden import Hidden

NOISE = float(os.environ.get("NOISE", "0.03"))
UNITS = {"position": "m", "velocity": "m/s", "acceleration": "m/s^2"}
ANGULAR = {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s^2"}
STEPS, SIZES, TOLERANCE = 2, 3.0, 0.4
"""Steps of the size towards the wanted gain, the largest factor of each, and the error of its logarithm at the end."""
LEAST_ERROR, MOST_ERROR = -0.9, 1.0
"""The least relative error of a gain, as in the library, and the largest one: twice the recorded drive."""
ESTIMATED = {"linear_oscillator": ("c", "k"), "rigid_drive": ("m", "c")}


def draw_drive(kind, size, omega, duration, rng):
    """Return a drive whose strongest frequencies are near `omega` (rad/s)."""
    turn = float(rng.uniform(0.0, 2.0 * math.pi))
    if kind == "harmonic":
        return BlindDrive(((size, omega, turn),))
    if kind == "sweep":
        return BlindDrive(((size, 0.4 * omega, turn),), 1.4 * omega / duration)
    lines = np.unique(np.round(np.linspace(0.25, 1.8, 14) * omega * duration / (2.0 * math.pi)))
    phases = rng.uniform(0.0, 2.0 * math.pi, len(lines))
    each = size * math.sqrt(2.0 / len(lines))
    pairs = zip(lines, phases, strict=True)
    return BlindDrive(tuple((each, float(n) * 2.0 * math.pi / duration, float(p)) for n, p in pairs))


def draw_machine(name, kind, rng, samples):
    """Return a random machine in which a mechanism can act."""
    able = [m for m in ("linear_oscillator", "lin_backlash", "robot_joint", "rigid_drive") if m in TABLE[name].models]
    model = able[int(rng.integers(len(able)))]
    natural, mass = draw_log_uniform(rng, 5.0, 100.0), draw_log_uniform(rng, 0.2, 20.0)
    values, amplitude = draw_parameters(model, mass, natural, rng)
    ratio = draw_log_uniform(rng, *((0.15, 0.4) if model == "robot_joint" else (0.5, 1.1)))
    rate = 40.0 * max(ratio, 0.4) * natural / (2.0 * math.pi)
    drive = draw_drive(kind, amplitude, ratio * natural, samples / rate, rng)
    estimated = ESTIMATED.get(model, ("c", "x0"))
    return BlindMachine(
        model, values, estimated, drive, rate, samples, NOISE, {n: wide_prior(values[n], rng) for n in estimated}
    )


@dataclass(frozen=True)
class Draft:
    """A machine before a mechanism is hidden in it; the effect has a size by the linear formula of the pilot run."""

    rig: BlindMachine
    pilot: Pilot
    effect: Callable[[float], Effect] | None
    seed: tuple[int, int]


def draft_effect(name, pilot, gain, rng):
    """Return the mechanism as a function of a factor of the size with this expected gain in log-likelihood."""
    mechanism = TABLE[name]
    at = str(rng.choice(mechanism.find_places(pilot.rig)))
    draft = mechanism.plan(pilot, at, rng)
    if name in NOISY:
        return lambda factor: Effect(name, at, draft.parameters(NOISY[name](pilot, 0.5 * factor)))
    size = math.sqrt(gain / max(pilot.expect_gain(draft), 1e-300))
    size *= rng.choice([-1.0, 1.0]) if mechanism.signed else 1.0
    return lambda factor: Effect(name, at, draft.parameters(float(size * factor)))


def draft_machine(task):
    """Return a random machine for a task in which the mechanism can act."""
    name, channel, kind, seed, gain, samples = task
    order = [*sorted(TABLE), "clean"].index(name)
    for attempt in range(200):
        rng = np.random.default_rng([seed, order, SENSORS.index(channel), DRIVES.index(kind), attempt])
        rig = draw_machine(name if name != "clean" else "coulomb_friction", kind, rng, samples)
        if name != "clean" and not TABLE[name].fits(rig):
            continue
        try:
            pilot = Pilot(rig, simulate_machine(rig, Hidden(), Disturbances(), rng))
            if "x0" in rig.values and not 0.1 < float(np.mean(np.abs(pilot.contact_sign))) < 0.95:
                continue
            effect = None if name == "clean" else draft_effect(name, pilot, gain, rng)
            draft = Draft(rig, pilot, effect, (seed, attempt))
            simulate(draft, channel, 1.0)
        except (ValueError, LostMotionError):
            continue
        return draft
    raise ValueError("no machine in 200 attempts")


def simulate(draft, channel, factor):
    """Return the effects, their parts of the simulator, and the true signal of a sensor (samples,).

    A motion that the hidden effect carries far from that of the pilot run, or a reversed channel, raises ValueError.
    """
    rig, pilot = draft.rig, draft.pilot
    effects = (draft.effect(factor),) if draft.effect else ()
    if not all(LEAST_ERROR <= effect.parameters.get("error", 0.0) <= MOST_ERROR for effect in effects):
        raise ValueError("the drive or the sensor would be reversed, nearly without effect, or more than doubled")
    cycle = 2.0 * math.pi / max(omega for _, omega, _ in rig.signal.tones)
    if any(e.mechanism in LATE and max(e.parameters.values()) > cycle for e in effects):
        raise ValueError("the delay or lag would be longer than a cycle of the drive")
    hidden = convert_effects(rig, effects)
    truth = simulate_machine(BlindMachine(**{**vars(rig), "channel": channel}), *hidden, make_rng(draft))
    own = simulate_machine(rig, *hidden, make_rng(draft))
    gap = rig.values.get("x0")
    if float(np.std(own)) > 3.0 * float(np.std(pilot.q)):
        raise ValueError("the motion is more than three times that without the effect")
    if gap is not None and not 0.05 < float(np.mean(np.abs(own - pilot.u * rig.based) > gap)) < 0.98:
        raise ValueError("the contact is almost never or almost always closed")
    return effects, hidden, truth


def make_rng(draft):
    """Return the random numbers of a machine, the same at every size."""
    return np.random.default_rng(draft.seed)


def write_case(task, draft, factor, folder):
    """Write the case of a task with the effect at a factor of its size; return the effects and the noise."""
    name, channel, kind, seed, _, samples = task
    rig = draft.rig
    effects, hidden, truth = simulate(draft, channel, factor)
    rng = np.random.default_rng([*draft.seed, 1])
    clean = rig.signal.value(rig.time)
    noise = NOISE * float(np.std(truth - clean if rig.based and channel == "position" else truth))
    shown = truth + noise * rng.standard_normal(samples)
    if hidden[1].step:
        shown = hidden[1].step * np.round(shown / hidden[1].step)
    drive = clean + EXCITATION_NOISE * rig.signal.amplitude * rng.standard_normal(samples)
    save_table(folder / "recording.csv", {"time": rig.time, "drive": drive, "shown": shown}, {}, {})
    units = ("rad", ANGULAR[channel]) if rig.based else ("N", UNITS[channel])
    recording = {
        "file": "recording.csv",
        "time": "time",
        "excitation": {"column": "drive", "quantity": "base_position" if rig.based else "force", "unit": units[0]},
        "response": {"column": "shown", "quantity": channel, "unit": units[1]},
    }
    known = {n: v for n, v in rig.values.items() if n not in rig.estimated}
    model = {"name": rig.model, "known": known, "estimate": to_plain(rig.priors)}
    dump_case(
        {"title": f"{name} {channel} {kind} {seed}", "recordings": [recording], "model": model}, folder / "case.toml"
    )
    return effects, noise


def write_sized_case(task, draft, folder):
    """Write the case with the effect at the wanted gain; return the effects, the noise, and the gain that was reached.

    The linear formula of the pilot run ignores that other parameters and the random force explain a part. The size
    follows the measured gain instead, within a factor of `SIZES`, until it is within `TOLERANCE` of the wanted one.
    """
    wanted = task[4]
    effects, noise = write_case(task, draft, 1.0, folder)
    reached = measure_gain(folder, effects, draft.rig, noise) if effects else None
    factor, best = 1.0, 1.0
    for _ in range(STEPS):
        if not isinstance(reached, float) or abs(math.log(max(reached, 1.0) / wanted)) < TOLERANCE:
            break
        factor *= min(max(math.sqrt(wanted / max(reached, 1.0)), 1.0 / SIZES), SIZES)
        try:
            effects, noise = write_case(task, draft, factor, folder)
        except (ValueError, LostMotionError):
            effects, noise = write_case(task, draft, best, folder)
            break
        reached, best = measure_gain(folder, effects, draft.rig, noise), factor
    return effects, noise, reached


def measure(folder, rig, noise, compute):
    """Return what `compute` returns for the prepared case and its machine; None for nan, or why there is no value."""
    machine = SealedMachine(**vars(rig), measurement_noise=noise)
    try:
        value = compute(prepare(folder / "case.toml", default()), machine)
        return None if math.isnan(value) else value
    except (LostMotionError, ValueError, ArithmeticError) as err:
        return f"not reached: {err}"


def measure_gain(folder, effects, rig, noise):
    """Return the gain in log-likelihood of the true term on the fitted data, by our own likelihood from the truth."""
    return measure(folder, rig, noise, lambda case, machine: compute_bound(case, machine, effects, None).gains[0])


def measure_lead(folder, effect, rig, noise, entry):
    """Return the lead in log-likelihood of the hidden law over the one of an entry of `found`, each alone."""
    other = Effect(entry["mechanism"], entry["at"], {k: i["median"] for k, i in entry["parameters"].items()})
    return measure(folder, rig, noise, lambda case, machine: compute_lead(case, machine, effect, other))


def run_task(task):
    """Return the row of one diagnosis."""
    from lostmotion.cli import main as run

    name, channel, kind, seed, gain, _ = task
    row = {"name": name, "sensor": channel, "drive": kind, "seed": seed, "gain": gain}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        try:
            draft = draft_machine(task)
            effects, noise, reached = write_sized_case(task, draft, folder)
        except (ValueError, ArithmeticError, LostMotionError) as err:
            return {**row, "status": f"not made: {err}"}
        rig, begin = draft.rig, time.process_time()
        arguments = ["diagnose", str(folder / "case.toml"), "--out", str(folder / "out"), "--quiet", "--jobs", "1"]
        try:
            code = run.main(args=arguments, standalone_mode=False) or 0
        except SystemExit as end:
            code = end.code
        except click.ClickException as err:  # the effect left nothing to diagnose, for instance a constant reading
            return {**row, "status": f"not made: {err.format_message()}"}
        row |= {"model": rig.model, "dt": 1.0 / rig.rate, "seconds": time.process_time() - begin, "status": code}
        if code:
            return row
        diagnosis = json.loads((folder / "out" / "diagnosis.json").read_text())
        row["machine"] = {"values": dict(rig.values), "signal": {"tones": rig.signal.tones}}
        row["truth"] = [{"name": e.mechanism, "at": e.at, **e.parameters} for e in effects]
        row["found"] = diagnosis["found"]
        row["verdict"] = diagnosis["verdict"]
        row["headline"] = diagnosis.get("headline", "")
        row["ranking"] = diagnosis["ranking"][:6]
        row["nrmse"] = [diagnosis["fit"][k]["heldout_nrmse"] for k in ("before", "after")]
        row |= {"reached": reached} if effects else {}
        if effects and (wrong := find_rival(row)):
            row["lead"] = measure_lead(folder, effects[0], rig, noise, wrong)
    return row


def parse_options():
    """Return the options."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="?", default="table", choices=("table", "clean"))
    parser.add_argument("--terms", default="", help="names, separated by commas (all)")
    parser.add_argument("--sensors", default=",".join(SENSORS))
    parser.add_argument("--drives", default=",".join(DRIVES))
    parser.add_argument("--seeds", default="1", help="numbers, separated by commas")
    parser.add_argument("--gain", type=float, default=0.0, help="log-likelihood (0: 50 to 500, drawn for each machine)")
    parser.add_argument("--samples", type=int, default=1500)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, default=Path("library"))
    return parser.parse_args()


def choose_gain(args, name, sensor, drive, seed):
    """Return the expected gain in log-likelihood of a machine: the option, or a random number from 50 to 500."""
    text = f"{name} {sensor} {drive} {seed}".encode()
    return args.gain or 50.0 * 10.0 ** float(np.random.default_rng(list(text)).random())


def main():
    """Run the machines that are not done yet and print the summary of all."""
    args = parse_options()
    args.out.mkdir(parents=True, exist_ok=True)
    path = args.out / "rows.jsonl"
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    done = {(r["name"], r["sensor"], r["drive"], r["seed"]) for r in rows}
    names = ["clean"] if args.what == "clean" else [t for t in args.terms.split(",") if t] or sorted(TABLE)
    tasks = [
        (name, sensor, drive, int(seed), choose_gain(args, name, sensor, drive, seed), args.samples)
        for seed in args.seeds.split(",")
        for sensor in args.sensors.split(",")
        for drive in args.drives.split(",")
        for name in names
        if (name, sensor, drive, int(seed)) not in done
        and not (name != "clean" and TABLE[name].tone and drive != "harmonic")
    ]
    np.random.default_rng(0).shuffle(tasks)  # what is done after any time is a fair sample of all
    with ProcessPoolExecutor(args.jobs) as pool, path.open("a") as stream:
        for row in pool.map(run_task, tasks):
            print(json.dumps(row), file=stream, flush=True)
            names = [f["mechanism"] for f in row.get("found", [])]
            print(
                row["name"],
                row["sensor"],
                row["drive"],
                row["seed"],
                row.get("model"),
                row["status"],
                f"{row.get('seconds', 0.0):.0f} s",
                names,
                flush=True,
            )
    print_summary([json.loads(line) for line in path.read_text().splitlines()])


if __name__ == "__main__":
    main()
