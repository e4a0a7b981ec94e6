"""How long whole commands take, as a user waits for them: `python benchmarks/seconds.py [WORK ...] --out DIR`.

The recordings come from `lostmotion_trials/integrators/hidden.py`, a leapfrog in 40 steps a sample with friction that
truly sticks: Case 1 of the paper (m 1 kg, c 8 N s/m, contact 4e4 N/m, half gap 5 mm, 100 N at 40 rad/s), 160 samples a
period, 1 % noise. Each command runs as a process of its own, caches as they are; with `--cold` in an empty cache.
Results go to DIR/seconds.jsonl, a line for each run: wall and processor seconds, and what was found.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from lostmotion_trials.integrators.hidden import BOUC_WEN, LUGRE, Body, Hidden, move

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "science"))

from rig_cases import CASES, MULTISINE, SILVERBOX

ROOT = Path(__file__).resolve().parents[1]
BODY = Body(m=1.0, c=8.0, k=0.0, k0=4e4, x0=0.005)
FORCE, OMEGA, EVERY = 100.0, 40.0, 40
STEP = 2.0 * math.pi / OMEGA / 160 / EVERY
NOISE, SETTLING = 0.01, 3200
HIDDEN = {
    "clean": Hidden(),
    "friction": Hidden(friction=3.0),
    "bouc_wen": Hidden(memory=BOUC_WEN, memory_force=4.0, memory_travel=2e-3),
    "lugre": Hidden(memory=LUGRE, memory_force=3.0, memory_excess=1.5, memory_velocity=0.05, memory_travel=1e-4),
    "bump": Hidden(bump=5.0, bump_middle=0.002, bump_width=0.0015),
}
CASE = """title = "{title}"
[[recordings]]
file = "recording.npz"
time = "time"
excitation = {{ column = "force", quantity = "force", unit = "N" }}
response = {{ column = "position", quantity = "position", unit = "m" }}
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
k1 = 0.0
[model.estimate]
c = {{ low = 0.8, high = 80.0, scale = "log" }}
x0 = {{ low = 5e-4, high = 5e-2, scale = "log" }}
"""


def recording(hidden: Hidden, samples: int, seed: int = 900) -> dict[str, np.ndarray]:
    """Return time (s), force (N) and position (m) with noise of a machine that hides something, each (samples,)."""
    rng = np.random.default_rng(seed)
    state, piece, parts = np.array([0.001, 0.0, 0.0, 0.0]), 20_000, []
    for first in range(0, samples + SETTLING, piece):
        count = min(piece, samples + SETTLING - first) * EVERY
        middle = (first * EVERY + np.arange(count) + 0.5) * STEP
        force = FORCE * np.cos(OMEGA * middle)
        parts.append(move(force, np.zeros((3, count)), BODY, hidden, state, (first * EVERY * STEP, STEP), EVERY)[:, 0])
    x = np.concatenate(parts)[SETTLING:]
    t = np.arange(samples) * EVERY * STEP
    seen = x + NOISE * x.std() * rng.standard_normal(samples)
    drive = FORCE * np.cos(OMEGA * (t + SETTLING * EVERY * STEP))
    return {"time": t, "force": drive, "position": seen}


def simulated(folder: Path, name: str, samples: int) -> Path:
    """Return the case of a simulated machine, written into `folder`."""
    np.savez(folder / "recording.npz", **recording(HIDDEN[name], samples))
    (folder / "case.toml").write_text(CASE.format(title=f"{name}, {samples} samples"))
    return folder / "case.toml"


def silverbox(folder: Path, shared: Path) -> Path:
    """Return the case of the Silverbox: 20,000 samples of its multisine, wide priors."""

    table = np.load(shared / "data" / "silverbox" / "SNLS80mV.npz")
    part = slice(MULTISINE.start, MULTISINE.start + 20_000)
    np.savez(folder / "multisine.npz", u=table["V1"].ravel()[part], y=table["V2"].ravel()[part])
    (folder / "case.toml").write_text(SILVERBOX)
    return folder / "case.toml"


def emps(folder: Path, shared: Path) -> Path:
    """Return the case of the EMPS carriage."""
    (folder / "case.toml").write_text(CASES["emps"](shared / "data", folder))
    return folder / "case.toml"


WORK = {
    **{name: ("diagnose", name, 24_000) for name in HIDDEN},
    "identify": ("identify", "friction", 24_000),
    "silverbox": ("diagnose", "silverbox", 0),
    "emps": ("diagnose", "emps", 0),
    "friction_200k": ("diagnose", "friction", 200_000),
    "friction_1m": ("diagnose", "friction", 1_000_000),
}


def timed(work: str, args: argparse.Namespace) -> dict[str, object]:
    """Return one command as a process: wall and processor seconds, memory, and what it found."""
    command, name, samples = WORK[work]
    folder = args.out / work
    folder.mkdir(parents=True, exist_ok=True)
    case = (
        simulated(folder, name, samples)
        if samples
        else {"silverbox": silverbox, "emps": emps}[name](folder, args.shared)
    )
    more = ["--term", "coulomb_friction"] if command == "identify" else []
    if command == "identify":
        more += ["--fresh"]
    line = [sys.executable, "-m", "lostmotion", command, str(case), "--out", str(folder / "out"), "--quiet", *more]
    env = dict(os.environ)
    with tempfile.TemporaryDirectory() as empty:
        if args.cold:
            env |= {"LOSTMOTION_CACHE": empty, "NUMBA_CACHE_DIR": empty}
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        try:
            done = subprocess.run(line, env=env, timeout=args.most, capture_output=True, text=True)
            status: object = done.returncode
        except subprocess.TimeoutExpired:
            status = f"stopped after {args.most:g} s"
        taken, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    row = {"work": work, "cold": args.cold, "status": status, "wall": round(taken, 2), "processor": round(processor, 2)}
    row["peak_mib"] = round(after.ru_maxrss / 1024)
    return {**row, "found": said(folder / "out", command) if status == 0 else None}


def said(out: Path, command: str) -> object:
    """Return what a command found, in short."""
    if command == "identify":
        table = json.loads((out / "identification.json").read_text())
        return {"converged": table["converged"], "ess_min": table["ess_min"]}
    table = json.loads((out / "diagnosis.json").read_text())
    errors = [table["fit"][k]["heldout_nrmse"] for k in ("before", "after")]
    return {"found": [f["mechanism"] for f in table["found"]], "heldout_nrmse": errors}


def main() -> None:
    """Print a line for each piece of work."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", nargs="*", help=f"of {', '.join(WORK)}; all if not given")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--runs", type=int, default=1, help="how often each is run")
    parser.add_argument("--most", type=float, default=1800.0, help="a run is stopped after so many seconds")
    parser.add_argument("--cold", action="store_true", help="compile everything anew")
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="where the recordings lie")
    args = parser.parse_args()
    if unknown := set(args.work) - set(WORK):
        parser.error(f"no work {sorted(unknown)[0]!r}: there is {', '.join(WORK)}")
    args.out.mkdir(parents=True, exist_ok=True)
    for work in args.work or WORK:
        for _ in range(args.runs):
            row = timed(work, args)
            with (args.out / "seconds.jsonl").open("a") as stream:
                stream.write(json.dumps(row) + "\n")
            print(json.dumps(row), flush=True)


if __name__ == "__main__":
    main()
