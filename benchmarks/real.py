"""Posteriors of real machines as tables: `python benchmarks/real.py [emps|damper|all]`.

It writes the cases, samples them and prints medians with 95 % intervals beside what was published. `x wider` says how
much wider an interval is that allows for leftovers with a memory (the sandwich of the scores over 40 blocks).
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from first_light import show
from lostmotion.identification.sampling import SamplingPlan
from lostmotion.identification.trajectory import write_warnings

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "science"))

from machines import EMPS_FILES, PUBLISHED, Found, damper, emps, travel  # noqa: E402 - they lie beside the tests

DAMPERS = (
    "d2_0.25Hz_30lb_1in",
    "d2_0.5Hz_30lb_0.5in",
    "d2_0.5Hz_30lb_1in",
    "d2_0.5Hz_30lb_1.5in",
    "d2_1Hz_30lb_1in",
    "d2_0.5Hz_36lb_1in",
)
TOGETHER = DAMPERS[:4]
"""The slow recordings at one band tension: they share mass, gap, contact and damping, each has its own friction."""
INCH = 0.0254


def list_rows(seen: Found):
    """Return a row for each parameter: median and interval, how much wider with a memory, published, distance."""
    rows = []
    for key, free, unit in zip(seen.result.keys, seen.fit.posterior.space.free, seen.result.units, strict=True):
        usual, robust = seen.deviations(free.key)
        between = seen.result.intervals.get(key)
        ours = f"{between.median:.5g} [{between.low:.5g}, {between.high:.5g}] {unit}" if between else "no interval"
        rows.append((key, ours, f"{robust / usual:.1f}", *compare_published(seen, key, free)))
    return rows


def compare_published(seen: Found, key: str, free):
    """Return the published value, and how far ours is off in standard deviations: without and with a memory."""
    if key not in PUBLISHED or key not in seen.result.intervals:
        return "-", "-"
    (value, sd), at = PUBLISHED[key], seen.result.intervals[key].median
    off = [(at - value) / np.hypot(s * (at if free.log else 1.0), sd) for s in seen.deviations(key)]
    return f"{value:.5g} +- {sd:.3g}", f"{off[0]:+.1f}, {off[1]:+.1f}"


def describe_state(seen: Found, taken: float) -> str:
    """Return how the sampling ended, in a line."""
    quality = seen.result.quality
    said = "converged" if seen.result.converged else f"NOT converged ({'; '.join(seen.result.lacks)})"
    warned = "; the workflow warns of a force left over" if write_warnings(seen.fit) else ""
    return f"{said}, ESS {quality.ess.min():.0f}, R-hat {quality.rhat.max():.3f}, {taken:.0f} s{warned}"


HEAD = ("parameter", "median [95 %]", "x wider", "published", "z without, with")


def identify_carriage(args, folder):
    """EMPS: either recording, and both together with noise and random force of each its own."""
    for files in (*((name,) for name in EMPS_FILES), EMPS_FILES):
        begin = time.perf_counter()
        seen = emps(folder, args.shared / "data" / "emps", files, args.plan)
        taken = time.perf_counter() - begin
        show(f"EMPS, {' and '.join(files)}: {describe_state(seen, taken)}", HEAD, list_rows(seen))


def identify_band(args, folder):
    """The friction damper: each recording by itself, and the slow ones together."""
    data = args.shared / "data" / "brfd_friction_backlash"
    rows = []
    for name in DAMPERS:
        begin = time.perf_counter()
        seen = damper(folder, data, (name,), args.plan)
        taken = time.perf_counter() - begin
        values = [format_parameter(seen, key) for key in ("x0", "k0", "c", "m", FRICTION, "offset_force.force")]
        rows.append((name, *values, format_travel(seen), f"{seen.free_error:.3f}", describe_state(seen, taken)))
    head = ("recording", "x0 (mm)", "k0 (MN/m)", "c (kN s/m)", "m (kg)", "friction (kN)", "offset (kN)")
    show("Friction damper with backlash", (*head, "travel (in)", "free run nrmse", "sampling"), rows)
    begin = time.perf_counter()
    seen = damper(folder, data, TOGETHER, args.plan)
    taken = time.perf_counter() - begin
    show(f"Damper, {len(TOGETHER)} recordings together: {describe_state(seen, taken)}", HEAD, list_rows(seen))


FRICTION = "lugre_friction.force"
SCALE = {"x0": 1e3, "k0": 1e-6, "m": 1.0}


def format_parameter(seen: Found, key: str) -> str:
    """Return a parameter in the unit of the table: median and 95 % interval."""
    if key not in seen.result.intervals:
        return "-"
    between, scale = seen.result.intervals[key], SCALE.get(key, 1e-3)
    return f"{between.median * scale:.3g} [{between.low * scale:.3g}, {between.high * scale:.3g}]"


def format_travel(seen: Found) -> str:
    """Return the travel (inch) from a reversal to half of the plateau: 0.27 to 0.31 inch as read off the loops."""
    low, median, high = np.quantile(travel(seen) / INCH, [0.025, 0.5, 0.975])
    return f"{median:.3f} [{low:.3f}, {high:.3f}]"


PARTS = {"emps": ("emps", identify_carriage), "damper": ("brfd_friction_backlash", identify_band)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", nargs="*", default=["all"], help=" ".join([*PARTS, "all"]))
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="folder of the real recordings")
    parser.add_argument("--ess", type=float, default=1000.0, help="effective draws of each parameter")
    args = parser.parse_args()
    args.plan = SamplingPlan(ess=args.ess)
    for name in PARTS if "all" in args.part else args.part:
        data, part = PARTS[name]
        if not (args.shared / "data" / data).is_dir():
            print(f"\n### {name}\n\nskipped: {args.shared / 'data' / data} is absent")
            continue
        with tempfile.TemporaryDirectory() as folder:
            part(args, Path(folder))


if __name__ == "__main__":
    main()
