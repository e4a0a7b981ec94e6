"""The page of a robot arm in the gallery: `python benchmarks/arm_page.py --out FOLDER --write`.

Draws an arm with two joints, dry friction in one of them and inertias that are wrong by 2 %, records it with an
integrator of its own, and diagnoses the case in MJCF. `--write` puts the tables into docs/gallery/robot_arm.md.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from gallery import format_interval, write_into_pages
from lostmotion.registry import Registry
from lostmotion.results.robots import RobotDiagnosis
from lostmotion.robots.arm_run import run_robot
from lostmotion_trials.arms.draw import draw_arm, write_case

EFFECT, WRONG = "coulomb_friction", 0.02


def format_found(found: RobotDiagnosis, truth: str) -> str:
    """Return what was hidden and what was found as a table."""
    rows = [("hidden", truth)]
    for one in found.found:
        values = "; ".join(f"{name} {format_interval(x)} {x.unit}" for name, x in one.parameters.items())
        rows.append((f"{one.state}, probability {one.probability:.3f}", f"{one.mechanism} at {one.at}: {values}"))
    rows += [(f"step of {1e3 * one.step:g} ms costs", f"{one.nats:.0f} nats") for one in found.steps]
    if found.written is not None:
        rows.append(("`arm_found.xml`, stepped by MuJoCo, keeps", f"{found.written.share:.0%} of the gain"))
    return "\n".join(["| | |", "|---|---|", *(f"| {a} | {b} |" for a, b in rows)])


def format_joints(found: RobotDiagnosis) -> str:
    """Return the joints before and after as a table."""
    head = ["joint", "found there", "torque (sd)", "random torque before", "after", "held-out error before", "after"]
    rows = [
        (
            row.joint, ", ".join(row.found) or "nothing", f"{row.torque:.3g} {row.unit}", f"{row.random_before:.2g}",
            f"{row.random_after:.2g}", f"{row.nrmse_before:.2%}", f"{row.nrmse_after:.2%}",
        )
        for row in found.joints
    ]  # fmt: skip
    return "\n".join([f"| {' | '.join(head)} |", "|---" * len(head) + "|", *(f"| {' | '.join(r)} |" for r in rows)])


def main() -> None:
    """Print the tables of the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--write", action="store_true", help="put the tables into the page of the gallery")
    options = parser.parse_args()
    model, truth, log = draw_arm(0, options.seed, EFFECT, WRONG)
    case = write_case(options.out, 0, model, log)
    begun = time.perf_counter()
    found = run_robot(case, options.out / "result", Registry.discover())
    values = ", ".join(f"{name} {value:.4g}" for name, value in truth.values.items())
    tables = {
        "figures of benchmarks/arm_page.py found": format_found(found, f"{truth.mechanism} at {truth.at}: {values}"),
        "figures of benchmarks/arm_page.py joints": format_joints(found),
        "figures of benchmarks/arm_page.py says": "\n".join(
            ["| the answer |", "|---|", *(f"| {s} |" for s in found.says)]
        ),
    }
    print("\n\n".join(tables.values()), f"\n{time.perf_counter() - begun:.0f} s")
    if options.write:
        write_into_pages(tables)


if __name__ == "__main__":
    main()
