"""How much longer a diagnosis takes with the whole library: `python benchmarks/library_time.py [--machines 12]`.

Each machine of `benchmarks/library.py`, with nothing hidden or with one of four terms of the first library, is
diagnosed on one core with all terms, and with the 22 terms of that library. Prints the processor seconds of both and
their ratio.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from lostmotion.diagnosis.diagnosis_run import diagnose_prepared
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default

sys.path.insert(0, str(Path(__file__).resolve().parent))

import library

LATER = {
    "actuator_lag", "backlash", "bilinear_stiffness", "cogging", "damping_drift", "directional_damping",
    "directional_friction", "drive_dead_zone", "drive_saturation", "end_stop", "friction_drift", "hertz_contact",
    "hidden_mode", "hunt_crossley_contact", "inertia_change", "load_dependent_friction", "position_dependent_friction",
    "position_ripple", "quadratic_stiffness", "sensor_lag",
}  # fmt: skip
"""The terms that the first library did not have."""
HIDDEN = (
    "clean",
    "coulomb_friction",
    "clean",
    "cubic_stiffness",
    "clean",
    "viscous_damping",
    "clean",
    "linear_stiffness",
)
SEED, GAIN, SAMPLES = 90, 150.0, 1500


def measure_machine(name, sensor, drive, seed):
    """Return the processor seconds of a diagnosis with all terms, and with those of the first library."""
    task, registry, taken = (name, sensor, drive, seed, GAIN, SAMPLES), default(), []
    with tempfile.TemporaryDirectory() as place:
        library.write_case(task, library.draft_machine(task), 1.0, Path(place))
        prepared = prepare(Path(place) / "case.toml", registry)
        first = replace(prepared, terms=tuple(term for term in prepared.terms if term.name not in LATER))
        for terms in (first, prepared, first):  # the first one loads kernels and is not counted
            begin = time.process_time()
            diagnose_prepared(terms, registry, seed=0, jobs=1, propose=False)
            taken.append(time.process_time() - begin)
    return taken[1], taken[2]


def main():
    """Print a line for each machine, and the median ratio."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", type=int, default=12)
    args, rows = parser.parse_args(), []
    kinds = list(itertools.product(library.SENSORS, library.DRIVES))
    for i in range(args.machines):
        name, (sensor, drive) = HIDDEN[i % len(HIDDEN)], kinds[i % len(kinds)]
        whole, first = measure_machine(name, sensor, drive, SEED + i // len(kinds))
        rows.append((whole, first))
        print(f"{name}, {sensor}, {drive}: {whole:.1f} s with all terms, {first:.1f} s with 22", flush=True)
    whole, first = np.array(rows).T
    print(f"ratio: median {np.median(whole / first):.2f}, of the sums {whole.sum() / first.sum():.2f}")


if __name__ == "__main__":
    main()
