"""A campaign of short recordings, some of them broken: `python benchmarks/load.py [--recordings 1000] [--jobs 2]`.

Machines of the blind trial, 300 to 500 samples each, moved by the integrator that the fit does not know. One recording
in twenty is then cut off, told in a wrong unit, holed by NaN, or robbed of a column. `lostmotion diagnose` takes all of
them at once, and the memory of its process and of its workers is read meanwhile. Exit status 1 when anything else than
the broken ones was set aside, or when, of a hundred recordings or more, a worker held a tenth more in the last quarter
than in the second. With `--out FOLDER` what is done stays there, and the same command goes on with it.
"""

from __future__ import annotations

import argparse
import csv
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lostmotion_trials.blind.commitment import Blind, conceal_case
from lostmotion_trials.sealing import format_case_name

EVERY, SEED = 20, 5
BREAKS = ("truncated", "unit", "nan", "column")
HIDDEN = ("coulomb_friction", "contact_damping", "cubic_stiffness", "quadratic_damping", "excitation_delay")
"""Nothing is hidden in one machine of three, one of these in each of the others."""
FEWEST, GROWTH = 100, 1.1
PAUSE = 0.5
"""Seconds between two looks at the memory."""


@dataclass
class Watch:
    """Memory (MiB) as it was seen: for each look how many cases were done, the parent's, and the largest worker's."""

    looks: list[tuple[int, float, float]] = field(default_factory=list)
    peaks: dict[int, float] = field(default_factory=dict)

    def look(self, parent, done):
        held = {pid: read_memory(pid) for pid in (parent, *list_children(parent))}
        for pid, (_, peak) in held.items():
            self.peaks[pid] = max(peak, self.peaks.get(pid, 0.0))
        workers = [now for pid, (now, _) in held.items() if pid != parent]
        self.looks.append((done, held[parent][0], max(workers, default=0.0)))

    def quarter(self, which):
        """Return the median memory of the largest worker while that quarter of the cases was made, first is 0."""
        last = self.looks[-1][0] + 1
        return float(np.median([w for done, _, w in self.looks if which <= 4 * done / last < which + 1] or [np.nan]))


def choose_fault(number):
    return BREAKS[number // EVERY % len(BREAKS)] if number % EVERY == EVERY // 2 else ""


def record(number, folder):
    """Return the path of a case, after writing it and its recording, broken if its number says so."""
    place = folder / "cases" / format_case_name(number)
    if not (place / "done").exists():
        only, clean = ((), True) if number % 3 == 0 else (HIDDEN, False)
        conceal_case(Blind(SEED, 300 + 37 * number % 201, only, clean), folder, number)
        break_recording(place, choose_fault(number))
        (place / "done").touch()
    return place / "case.toml"


def break_recording(place, how):
    case, table = place / "case.toml", place / "recording.csv"
    text, rows = case.read_text(encoding="utf-8"), table.read_text(encoding="utf-8").splitlines(keepends=True)
    if how == "unit":
        case.write_text(re.sub('"position", unit = "[a-z]+"', '"position", unit = "s"', text), encoding="utf-8")
    if how == "truncated":
        rows = [*rows[: len(rows) // 2], rows[len(rows) // 2].partition(",")[0]]
    if how == "nan":
        rows[100:200] = [",".join((row.split(",")[0], "nan", "nan")) + "\n" for row in rows[100:200]]
    if how == "column":
        rows[0] = rows[0].replace("response", "respons")
    table.write_text("".join(rows), encoding="utf-8")


def read_memory(pid):
    """Return what a process holds and the most it has held, in MiB; zeros when it is no more."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return 0.0, 0.0
    table = {key: rest.split() for key, _, rest in (line.partition(":") for line in lines)}
    return tuple(float(table.get(key, ["0"])[0]) / 1024 for key in ("VmRSS", "VmHWM"))


def list_children(pid):
    try:
        return [int(one) for one in Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="utf-8").split()]
    except OSError:
        return []


def watch_run(paths, out, jobs):
    """Return the exit status of `diagnose` and what its processes held."""
    line = [sys.executable, "-m", "lostmotion", "diagnose", *map(str, paths), "--out", str(out), "--jobs", str(jobs)]
    watch = Watch()
    with subprocess.Popen([*line, "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        while process.poll() is None:
            watch.look(process.pid, len(list((out / ".campaign" / "trials").glob("[0-9]*.json"))))
            time.sleep(PAUSE)
    return process.returncode, watch


def read_rows(path):
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def print_summary(rows, watch, seconds):
    """Print wall time, memory over the campaign, and what was set aside and why."""
    print(f"{len(rows)} recordings in {seconds:.0f} s, {seconds / len(rows):.1f} s each")
    print("done  parent  largest worker (MiB)")
    for k in range(0, len(watch.looks), max(1, len(watch.looks) // 20)):
        done, parent, worker = watch.looks[k]
        print(f"{done:>4}  {parent:>6.0f}  {worker:>6.0f}")
    parent, *workers = watch.peaks.values()
    print(f"peaks: parent {parent:.0f} MiB, workers {', '.join(f'{peak:.0f}' for peak in workers)} MiB")
    for number, row in enumerate(rows):
        if row["status"] == "set aside":
            print(f"{row['case']} ({choose_fault(number) or 'whole'}): {row['says']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--recordings", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        folder = options.out or Path(spare)
        paths = [record(number, folder) for number in range(options.recordings)]
        begun = time.perf_counter()
        status, watch = watch_run(paths, folder / "results", options.jobs)
        rows = read_rows(folder / "results" / "summary.csv")
        print_summary(rows, watch, time.perf_counter() - begun)
    wrong = [row["case"] for k, row in enumerate(rows) if (row["status"] == "set aside") != bool(choose_fault(k))]
    grown = watch.quarter(3) / watch.quarter(1)
    print(f"exit status {status}; set aside or taken wrongly: {', '.join(wrong) or 'none'}; growth {grown:.3f}")
    return int(bool(wrong) or (len(rows) >= FEWEST and not grown <= GROWTH))


if __name__ == "__main__":
    sys.exit(main())
