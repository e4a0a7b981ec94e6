"""Machines with one small hidden effect, for `benchmarks/absent.py` and `benchmarks/check.py`.

Random machines of the blind trials (`lostmotion_trials.blind`), whose integrator shares no code with the framework. The
effect has one amplitude and no further parameter, so that its size is one number.
"""

from __future__ import annotations

import argparse
import itertools
import json
import math
import multiprocessing
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np

from judge import describe_code, is_timeout, limit_processor
from judge_truth import EXCITATION_NOISE, write_driven_case, write_table
from lostmotion.case import dump_case
from lostmotion.errors import LostMotionError
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.mechanisms import TABLE
from lostmotion_trials.blind.pilot import Effect, Pilot
from lostmotion_trials.blind.simulator import BlindMachine, Disturbances, draw_rig, simulate_machine
from lostmotion_trials.integrators.hidden import Hidden
from lostmotion_trials.rates import estimate_rate

AMPLITUDES: Mapping[str, str] = {
    "coulomb_friction": "force", "offset_force": "force", "linear_stiffness": "coefficient",
    "cubic_stiffness": "coefficient", "quadratic_stiffness": "coefficient", "bilinear_stiffness": "difference",
    "quadratic_damping": "coefficient", "directional_damping": "difference", "damping_drift": "rate",
    "contact_damping": "coefficient", "asymmetric_gap": "shift", "gap_drift": "rate", "hertz_contact": "coefficient",
    "hunt_crossley_contact": "coefficient",
}  # fmt: skip
"""The effects that are hidden, with the name of their amplitude."""
Trial = Callable[[int], Mapping[str, object]]
"""A trial: its row by its number."""
SAMPLES = 2000
"""The largest number of samples of a recording."""
ATTEMPTS = 200
"""The largest number of machines that are drawn for one trial."""


@dataclass(frozen=True)
class SmallMachine:
    """A machine, its motion without an effect, and the effect that can be hidden in it, at a place."""

    rig: BlindMachine
    pilot: Pilot
    mechanism: str
    at: str

    @property
    def parameter(self) -> str:
        """The amplitude of the effect."""
        return AMPLITUDES[self.mechanism]

    @property
    def signed(self) -> bool:
        """Whether the amplitude can be negative."""
        return TABLE[self.mechanism].signed

    def write(self, folder: Path, size: float, rng: np.random.Generator) -> None:
        """Write the case of the machine with the effect at a size (SI units) into a folder; noise comes from `rng`."""
        effects = (Effect(self.mechanism, self.at, {self.parameter: size}),) if size else ()
        motion = simulate_machine(self.rig, *convert_effects(self.rig, effects), rng)
        write_small_case(self.rig, motion, folder, rng)


def write_small_case(rig: BlindMachine, motion: np.ndarray, folder: Path, rng: np.random.Generator) -> None:
    """Write the case of a machine whose reading without noise is `motion` (samples,)."""
    drive, shown = rig.signal.value(rig.time), motion - (rig.signal.value(rig.time) if rig.based else 0.0)
    seen = motion + rig.noise * float(np.std(shown)) * rng.standard_normal(len(motion))
    drive = drive + EXCITATION_NOISE * rig.signal.amplitude * rng.standard_normal(len(drive))
    known = {name: value for name, value in rig.values.items() if name not in rig.estimated}
    priors = {name: {"low": p.low, "high": p.high, "scale": p.scale} for name, p in rig.priors.items()}
    model = {"name": rig.model, "known": known, "estimate": priors}
    columns = {"time": rig.time, "force": drive, "position": seen}
    if not rig.based:
        write_driven_case(folder, "Machine", columns, model)
        return
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / "recording.csv", columns)
    recording = {
        "file": "recording.csv",
        "time": "time",
        "excitation": {"column": "force", "quantity": "base_position", "unit": "rad"},
        "response": {"column": "position", "quantity": "position", "unit": "rad"},
    }
    dump_case({"title": "Machine", "recordings": [recording], "model": model}, folder / "case.toml")


def draw_small_machine(rng: np.random.Generator) -> SmallMachine:
    """Return a random machine with a random effect; a gap is passed in 10 to 95 % of the time."""
    for _ in range(ATTEMPTS):
        rig = draw_rig(rng, SAMPLES)
        names = [name for name in AMPLITUDES if TABLE[name].fits(rig)]
        name = str(rng.choice(names))
        try:
            pilot = Pilot(rig, simulate_machine(rig, Hidden(), Disturbances(), rng))
        except LostMotionError:
            continue
        if "x0" in rig.values and not 0.1 < float(np.mean(np.abs(pilot.contact_sign))) < 0.95:
            continue
        return SmallMachine(rig, pilot, name, str(rng.choice(TABLE[name].find_places(rig))))
    raise ValueError(f"no machine in {ATTEMPTS} attempts")


def run_trials(path: Path, trials: range, run: Trial, limit: float) -> None:
    """Append a row of JSON for each trial that has none yet; a trial depends on its number only.

    Each trial is a process of its own, which ends after `limit` s of processor time with the status "timeout".
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    done, code = {row["trial"] for row in read_rows(path)}, describe_code(Path(__file__).resolve().parents[1])
    for trial in (number for number in trials if number not in done):
        row = {"trial": trial, "commit": code, **run_limited(run, trial, limit)}
        with path.open("a") as stream:
            print(json.dumps(row), file=stream, flush=True)
        print(trial, row["status"], row["cpu"], flush=True)


def run_limited(run: Trial, trial: int, limit: float) -> dict[str, object]:
    """Return the row of a trial, run in a process that may use `limit` s of processor time (`cpu`, s)."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_send_row, args=(there, run, trial, limit), daemon=True)
    process.start()
    there.close()
    try:
        row: dict[str, object] = here.recv()
    except EOFError:
        process.join()
        timed_out = is_timeout(process.exitcode)
        return {"status": "timeout" if timed_out else f"failed: exit status {process.exitcode}", "cpu": limit}
    process.join()
    return row


def _send_row(there: Connection, run: Trial, trial: int, limit: float) -> None:
    limit_processor(limit)
    try:
        row = dict(run(trial))
    except (LostMotionError, ValueError, ArithmeticError) as err:
        row = {"status": f"failed: {err}"}
    there.send({**row, "cpu": round(time.process_time(), 1)})


def run_command(title: str, rows: str, count: int, run: Trial, show: Callable[[Path], None]) -> None:
    """Run the trials that have no row yet, or show the rows, as the command line asks.

    `title` is the help, `rows` the name of the file of rows, `count` the usual number of machines.
    """
    parser = argparse.ArgumentParser(description=title, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "show"))
    parser.add_argument("--machines", type=int, default=count)
    parser.add_argument("--first", type=int, default=0, help="number of the first machine, for other machines")
    parser.add_argument("--out", type=Path, required=True, help="folder of the rows")
    parser.add_argument("--timeout", type=float, default=300.0, help="limit of processor time of a machine, in s")
    args = parser.parse_args()
    path = args.out / rows
    if args.command == "run":
        run_trials(path, range(args.first, args.first + args.machines), run, args.timeout)
    show(path)


def read_rows(path: Path) -> list[dict[str, object]]:
    """Return the rows of a file, or none."""
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def describe_share(hits: int, count: int) -> str:
    """Return a share with its Clopper-Pearson interval of 95 %."""
    rate = estimate_rate(hits, count)
    return f"{hits} of {count} = {100 * rate.share:.1f} % [{100 * rate.low:.1f}, {100 * rate.high:.1f}]"


def split_by(rows: list[dict[str, object]], key: str, edges: list[float]) -> Iterator[tuple[str, list[dict]]]:
    """Yield the rows between successive edges of a number, with the name of the range."""
    for low, high in itertools.pairwise(edges):
        own = [row for row in rows if low <= float(row[key]) < high]
        yield f"{low:g} to {high:g}" if math.isfinite(high) else f"above {low:g}", own
