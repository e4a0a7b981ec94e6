"""Real recordings through `diagnose`: `python benchmarks/gallery.py NAME --out DIR`, or `all`.

Prints what was found, held-out errors before and after, and the time; the reports lie in DIR. For the Silverbox also
the error of a free run over the arrow, which no fit has seen, in mV. What an expert reads off the recording without a
model of ours (`tests/science/by_hand.py`) is printed first.

The recordings are cut so that a diagnosis takes a minute: six seconds of each of EMPS (`emps_whole` takes all), 6,000
samples of the Silverbox.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.contracts import Assembly
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.system import System
from lostmotion.registry import Registry, default
from lostmotion.workflow.diagnose import run_diagnosis

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "science"))

import by_hand  # noqa: E402 - these lie beside the tests
import rigs  # noqa: E402
from machines import CARRIAGE, EMPS, EMPS_FILES, thinned  # noqa: E402

RATE = 1e7 / 2**14
"""Samples a second of the Silverbox."""
ARROW, MULTISINE = slice(100, 40575), slice(40650, 127400)
SETTLING = 50
SHOWN = 0.01
"""Candidates of a lower probability are not printed."""
SILVERBOX = f"""
title = "Silverbox, from the linear oscillator"
[[recordings]]
file = "multisine.npz"
rate = {RATE}
excitation = {{ column = "u", quantity = "force", unit = "N" }}
response = {{ column = "y", quantity = "position", unit = "m" }}
[model]
name = "linear_oscillator"
[model.estimate]
m = {{ low = 1e-7, high = 1e-4, scale = "log" }}
c = {{ low = 1e-6, high = 1e-2, scale = "log" }}
k = {{ low = 0.1, high = 10.0, scale = "log" }}
"""
DAMPED = """
[model]
name = "backlash_slider"
[model.estimate]
m = { median = 150.0, sd_log = 1.0 }
c = { low = 1e3, high = 1e5, scale = "log" }
k0 = { median = 5e6, sd_log = 1.0 }
x0 = { median = 2e-3, sd_log = 0.7 }
"""


PIECE = "t_end = 6.0\n"
SAMPLES = 6_000
"""So much of the multisine is read."""


def emps_whole(data: Path, folder: Path) -> str:
    """Return the case of the EMPS carriage: one recording is fitted, the pulses are held out."""
    return "".join(_carriage(data)) + CARRIAGE


def emps(data: Path, folder: Path) -> str:
    """Return the case of the EMPS carriage, with six seconds of either recording."""
    return "".join(text + PIECE for text in _carriage(data)) + CARRIAGE


def _carriage(data: Path) -> list[str]:
    return [EMPS.format(file=(data / "emps" / f"{name}.mat").resolve()) for name in EMPS_FILES]


def silverbox(data: Path, folder: Path) -> str:
    """Return the case of the Silverbox, the beginning of its multisine written beside it."""
    table = np.load(data / "silverbox" / "SNLS80mV.npz")
    part = slice(MULTISINE.start, MULTISINE.start + SAMPLES)
    np.savez(folder / "multisine.npz", u=table["V1"].ravel()[part], y=table["V2"].ravel()[part])
    return SILVERBOX


def damper(data: Path, folder: Path, name: str = "d2_0.5Hz_30lb_1in") -> str:
    """Return the case of the friction damper with backlash at 0.5 Hz: its force under a prescribed motion."""
    return thinned(folder, data / "brfd_friction_backlash", name) + DAMPED


CASES = {
    "emps": emps,
    "emps_whole": emps_whole,
    "silverbox": silverbox,
    "damper": damper,
    "damper_36lb": partial(damper, name="d2_0.5Hz_36lb_1in"),
    "motor_run": rigs.motor,
    "motor_drive": rigs.motors,
    "reuss_beam": rigs.beam,
    "bistable_beam": rigs.bistable,
    "gear_wheel": rigs.wheel,
}


def arrow(content: Mapping[str, Any], data: Path, registry: Registry) -> dict[str, float]:
    """Return the rms errors (V) of free runs over the arrow with the parameters before and after."""
    table = np.load(data / "silverbox" / "SNLS80mV.npz")
    u, y = (table[k].ravel()[ARROW] for k in ("V1", "V2"))
    grid = np.arange(len(u)) / RATE
    drive = Drive.smooth([CubicSpline(grid, u)], 1.0 / RATE, len(u))
    errors = {}
    for when, terms in (("before", ()), ("after", tuple(f for f in content["found"] if f.get("at") == "ground"))):
        model = registry.make("model", "linear_oscillator")
        system = System.of(Assembly(model, tuple(registry.make("term", f["mechanism"]) for f in terms)))
        known = {s.key for s in system.slots}
        values = {k: v["median"] for k, v in content["parameters"][when].items() if k in known}
        run = system.simulate(system.vector(values), system.everything, np.array([y[0], 0.0]), drive, 8)
        errors[when] = float(np.sqrt(np.mean((run.states[SETTLING:, 0] - y[SETTLING:]) ** 2)))
    return errors


def main() -> None:
    """Print a paragraph for each recording that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="?", default="all", choices=(*CASES, "all"))
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="where the recordings lie")
    parser.add_argument("--jobs", type=int, default=1, help="how many cores")
    parser.add_argument("--propose", action="store_true", help="ask for the next experiment too, which takes longer")
    args = parser.parse_args()
    data, registry = args.shared / "data", default()
    for name in CASES if args.which == "all" else (args.which,):
        folder = args.out / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.toml").write_text(CASES[name](data, folder))
        for key, (value, unit) in (by_hand.READ[name](data) if name in by_hand.READ else {}).items():
            print(f"by hand, {key}: {value:.4g} {unit}")
        begin = time.perf_counter()
        content = run_diagnosis(folder / "case.toml", folder / "result", registry, jobs=args.jobs, propose=args.propose)
        told(name, content, time.perf_counter() - begin)
        if name == "silverbox":
            found = {k: f"{1e3 * v:.2f} mV" for k, v in arrow(content, data, registry).items()}
            print(f"  free run over the arrow: {json.dumps(found)}")


def told(name: str, content: Mapping[str, Any], taken: float) -> None:
    """Print what a diagnosis says."""
    fit = content["fit"]
    print(f"{name}, {taken:.0f} s")
    for line in (*content["says"], *content["notes"]):
        print(f"  {line}")
    for label, key in (("error", "heldout_nrmse"), ("log score", "heldout_log_score")):
        print(f"  held-out {label} " + " -> ".join(f"{fit[k][key]:.3g}" for k in ("before", "after")))
    print(f"  noise {fit['noise_floor_nrmse']:.3g}")
    for entry in content["ranking"]:
        if entry["probability"] > SHOWN:
            print(f"  {entry['mechanism']} at {entry['at'] or '-'}: probability {entry['probability']:.3f}")
    for when in ("before", "after"):
        for key, value in content["parameters"][when].items():
            between = f"{value['median']:.5g} [{value['low']:.5g}, {value['high']:.5g}]"
            print(f"  {when}: {key} = {between} {value['unit']}")


if __name__ == "__main__":
    main()
