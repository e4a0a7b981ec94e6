"""Commands killed at random moments: `python benchmarks/killed.py [--kills 50] [--only COMMAND] [--seed 0]`.

Each command runs once undisturbed. Then it is started, killed with all its children by SIGKILL at a random moment, and
started again, as often as is asked for; the last start is left alone. It must end with exit status 0 and leave the same
files with the same bytes, and nothing beside them. At every kill each file that is there under its own name must be
whole: JSON that parses, pages with an end, HDF5 that opens. Exit status 1 when anything differed.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

LINE = [sys.executable, "-m", "lostmotion"]
DRIVE = ["--drive", "harmonic:amplitude=100,omega=40", "--duration", "1.6", "--rate", "640", "--noise", "0.01"]
MACHINE = "m=1,c=8,k0=4e4,x0=0.005"
CASE = """
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
k1 = 0.0
[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
x0 = { low = 1e-3, high = 2e-2, scale = "log" }
"""
MAP = "--model lin_backlash --x alpha=0.1:0.6:24:inverse --y zeta=0.01:0.06:24 --periods 400 --transient 100 --starts 2"
COMMANDS = {
    "map": ["map", *MAP.split(), "--out", "map.zarr"],
    "identify": ["identify", "../../case.toml", "--out", "found", "--ess", "400"],
    "calibrate": ["calibrate", "../../case.toml", *DRIVE, "--machines", "6", "--ess", "100", "--out", "campaign"],
    "prove": ["prove", "--cases", "3", "--only", "coulomb_friction", "--samples", "2000", "--out", "proof"],
    "diagnose": ["diagnose", "../../case.toml", "--out", "result"],
}
"""What is run, each in a folder of its own beside the case."""
ROUND = 5
"""Kills of one run before it is left to end."""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=50, help="in all")
    parser.add_argument("--only", choices=COMMANDS, action="append")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    names = options.only or list(COMMANDS)
    with tempfile.TemporaryDirectory() as held:
        place = Path(held)
        prepared(place)
        wrong = sum(tortured(place, name, -(-options.kills // len(names)), options.seed) for name in names)
    print(f"{wrong} findings")
    return int(wrong > 0)


def prepared(place):
    """Lay a case and its recording into a folder."""
    (place / "case.toml").write_text(CASE, encoding="utf-8")
    line = ["simulate", "lin_backlash", "--set", MACHINE, "--term", "coulomb_friction:force=3", *DRIVE]
    subprocess.run([*LINE, *line, "--out", "recording.csv"], cwd=place, check=True, capture_output=True)


def tortured(place, name, kills, seed):
    """Return how often a command that was killed did not end as it does undisturbed."""
    left(place / name / "warm", name)
    begun = time.perf_counter()
    wanted = left(place / name / "alone", name)
    lasts = time.perf_counter() - begun
    rng, wrong, done, stale, rounds = np.random.default_rng([seed, list(COMMANDS).index(name)]), 0, 0, 0, 0
    while done < kills:
        folder, rounds = place / name / f"round {rounds}", rounds + 1
        for _ in range(min(ROUND, kills - done)):
            if not shot(folder, name, float(rng.uniform(0.0, lasts))):
                break  # what was left took less than that
            done += 1
            stale += len(halves(folder)) > 0
        got = left(folder, name)
        if got != wanted or halves(folder):
            wrong += 1
            told = sorted({f for f in {*got, *wanted} if got.get(f) != wanted.get(f)})
            print(f"  {name}, round {rounds}: differs in {told[:5]}, halves {halves(folder)[:3]}", flush=True)
    print(
        f"{name:<10} {lasts:5.1f} s  {done:>3} kills  {stale} half-written files seen  {wrong} runs ended otherwise",
        flush=True,
    )
    return wrong + stale


def started(folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    return subprocess.Popen(
        [*LINE, *COMMANDS[name], "--quiet"], cwd=folder, start_new_session=True, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )  # fmt: skip


def shot(folder, name, moment):
    """Return whether the command still ran when it was killed `moment` s after its start."""
    process = started(folder, name)
    try:
        process.communicate(timeout=moment)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return True
    return False


def left(folder, name):
    """Return the digests of all files by path that the command leaves when it is let alone."""
    process = started(folder, name)
    _, said = process.communicate()
    if process.returncode:
        raise SystemExit(f"{name} ended with {process.returncode}: {said.decode()[-500:]}")
    files = sorted(p for p in folder.rglob("*") if p.is_file())
    return {p.relative_to(folder).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest() for p in files}


def halves(folder):
    """Return the files that are there under their own name and are not whole."""
    return [p.relative_to(folder).as_posix() for p in sorted(folder.rglob("[!.]*")) if p.is_file() and not is_whole(p)]


def is_whole(path):
    try:
        if path.suffix == ".json":
            json.loads(path.read_text(encoding="utf-8"))
        elif path.suffix == ".html":
            return path.read_text(encoding="utf-8").rstrip().endswith("</html>")
        elif path.suffix in (".nc", ".h5"):
            h5py.File(path, "r").close()
        elif path.suffix in (".toml", ".csv"):
            return path.read_bytes().endswith(b"\n")
    except (OSError, ValueError):
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())
