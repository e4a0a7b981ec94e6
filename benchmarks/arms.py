"""Robot arms with a hidden effect: how often joint and physics are both named, and how often a name is false.

    python benchmarks/arms.py --arms 24 --empty 10 --wrong 0.02 --seed 0 --out FOLDER

Each arm has two joints, random masses, and one effect of random size at a random joint, or none. Its log comes from an
integrator of its own (`lostmotion_trials.integrators.arm`). `--wrong` is the share (sd) by which inertias and damping
of the machine differ from those of its model. One line of JSON for each arm goes to a file in FOLDER as it is done.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

from lostmotion.registry import Registry
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_run import diagnose_robot
from lostmotion_trials.arms.draw import EFFECTS, Truth, draw_arm, write_case

SURE = 0.95


def judge(truth: Truth, found: list[dict[str, object]]) -> str:
    """Return the outcome: right, physics, joint, false, silent or empty."""
    named = [f for f in found if f["probability"] > SURE]  # type: ignore[operator]
    if truth.mechanism == "none":
        return "false" if named else "empty"
    pairs = {(f["mechanism"], f["at"]) for f in named}
    if pairs == {(truth.mechanism, truth.at)}:
        return "right"
    if (truth.mechanism, truth.at) in pairs:
        return "right and more"
    if not named:
        return "silent"
    joint = truth.at.partition(".")[0]
    return "other physics" if all(str(at).partition(".")[0] == joint for _, at in pairs) else "wrong joint"


def run(number: int, effect: str, options: argparse.Namespace, registry: Registry) -> dict[str, object]:
    """Return the outcome of one arm."""
    model, truth, log = draw_arm(number, options.seed, effect, options.wrong)
    case = write_case(options.out / f"arm{number:03d}", number, model, log)
    begun = time.process_time()
    output = diagnose_robot(load_robot_case(case, registry), registry)
    found = [
        {
            "mechanism": m.mechanism, "at": m.at, "probability": m.probability,
            "values": {k: (x.median, x.low, x.high) for k, x in m.parameters.items()},
        }
        for m in output.result.found
    ]  # fmt: skip
    first = output.result.ranking[0]
    fit = output.result.fit
    return {
        "number": number, "outcome": judge(truth, found), "truth": [truth.mechanism, truth.at, dict(truth.values)],
        "found": found, "gain": first.log_evidence_gain, "before": fit.before.nrmse, "after": fit.after.nrmse,
        "seconds": time.process_time() - begun,
    }  # fmt: skip


def main() -> None:
    """Run the arms that are not done yet, and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arms", type=int, default=24)
    parser.add_argument("--empty", type=int, default=10)
    parser.add_argument("--wrong", type=float, default=0.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="")
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    registry, file = Registry.discover(), options.out / "rows.jsonl"
    effects = options.only.split(",") if options.only else list(EFFECTS)
    plan = [effects[i % len(effects)] for i in range(options.arms)] + ["none"] * options.empty
    done = {json.loads(line)["number"] for line in file.read_text().splitlines()} if file.exists() else set()
    for number, effect in enumerate(plan):
        if number not in done:
            row = run(number, effect, options, registry)
            with file.open("a") as stream:
                stream.write(json.dumps(row) + "\n")
            told = [(f["mechanism"], f["at"], round(float(f["probability"]), 3)) for f in row["found"]]  # type: ignore[attr-defined,arg-type]
            print(f"{number:3d} {row['outcome']:14s} {row['seconds']:.0f} s  {row['truth']}  {told}", flush=True)
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    counts: dict[str, int] = {}
    for row in rows:
        counts[row["outcome"]] = counts.get(row["outcome"], 0) + 1
    print(counts)


if __name__ == "__main__":
    main()
