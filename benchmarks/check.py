"""How well the check before the fit predicts what a diagnosis finds.

    python benchmarks/check.py run --machines 100 --out DIR
    python benchmarks/check.py show --out DIR

Each trial is a random machine (`small_effects.py`). Its recording without an effect is checked. Then the expected
intervals are compared with those that a diagnosis finds in the same recording (without candidate terms, which changes
no interval where nothing is found), and one of the effects that would be named is hidden at the smallest size that the
check states: 80 to 97 % of them should be named. A run that was stopped is continued; each machine has a limit of
processor time (`--timeout`).
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from lostmotion.diagnosis.diagnosis_run import diagnose_prepared
from lostmotion.diagnosis.recording_check import check_prepared
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from lostmotion.results import Interval
from lostmotion.results.expectation import Detection
from lostmotion_trials.blind.bound import are_equivalent
from lostmotion_trials.blind.mechanisms import TABLE
from small_effects import AMPLITUDES, SmallMachine, describe_share, draw_small_machine, read_rows, run_command

SEED = 50
FACTOR = 1.5
"""Expected and found widths should agree within this factor."""
LARGEST = 0.3
"""An effect with a larger share of the drive is no small one: the machine moves in another way with it."""


def measure_widths(parameters: dict[str, Interval]) -> dict[str, float]:
    """Return the widths of intervals, as logarithms of the ratio of their ends where these are positive."""
    return {
        name: float(np.log(one.high / one.low)) if one.low > 0.0 else one.high - one.low
        for name, one in parameters.items()
    }


def run_trial(trial: int) -> dict[str, object]:
    """Return the row of one machine."""
    rng, registry = np.random.default_rng([SEED, trial]), default()
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        machine = draw_small_machine(rng)
        machine.write(place / "clean", 0.0, rng)
        prepared = prepare(place / "clean" / "case.toml", registry)
        begin = time.process_time()
        checked = check_prepared(prepared, jobs=1)
        seconds = time.process_time() - begin
        machine, effect = choose_effect(machine, checked.expected.effects, rng)
        plain = diagnose_prepared(replace(prepared, terms=()), registry, seed=0, jobs=1, propose=False)[0].result
        widths = measure_widths(dict(plain.parameters.after))
        sign = float(rng.choice([-1.0, 1.0])) if machine.signed else 1.0
        machine.write(place / "case", sign * effect.smallest, rng)
        hidden = prepare(place / "case" / "case.toml", registry)
        result = diagnose_prepared(hidden, registry, seed=0, jobs=1, propose=False)[0].result
    found = [(one.mechanism, one.at, one.probability, one.state) for one in result.found]
    return {
        "status": "ok",
        "mechanism": machine.mechanism,
        "at": machine.at,
        "model": machine.rig.model,
        "size": effect.smallest,
        "share": effect.share_of_drive,
        "found": found,
        "named": [state for name, _, _, state in found if are_equivalent(name, machine.mechanism)],
        "expected": measure_widths(dict(checked.expected.parameters)),
        "widths": widths,
        "seconds": round(seconds, 2),
    }


def choose_effect(
    machine: SmallMachine, effects: Sequence[Detection], rng: np.random.Generator
) -> tuple[SmallMachine, Detection]:
    """Return a machine with a random one of the effects that would be named in it and can be hidden, and the effect."""
    options = [
        one
        for one in effects
        if one.mechanism in AMPLITUDES
        and TABLE[one.mechanism].fits(machine.rig)
        and {"", one.at} & set(TABLE[one.mechanism].find_places(machine.rig))
        and not one.confused_with
        and (one.share_of_drive or 0.0) < LARGEST
    ]
    if not options:
        raise ValueError("no effect would be named")
    effect = options[int(rng.integers(len(options)))]
    return replace(machine, mechanism=effect.mechanism, at=effect.at), effect


def show(path: Path) -> None:
    """Print how many widths agree, and how many effects are named."""
    rows = [row for row in read_rows(path) if row["status"] == "ok"]
    if not rows:
        print("no rows yet")
        return
    ratios = np.array([row["widths"][name] / row["expected"][name] for row in rows for name in row["widths"]])
    ratios = ratios[np.isfinite(ratios)]
    close = int(np.sum(np.abs(np.log(ratios)) < np.log(FACTOR)))
    print(f"{len(rows)} machines; found over expected widths of intervals: median {np.median(ratios):.2f},")
    print(f"  5 to 95 %: {np.quantile(ratios, 0.05):.2f} to {np.quantile(ratios, 0.95):.2f};", end=" ")
    print(f"within a factor of {FACTOR}: {describe_share(close, len(ratios))}")
    print(f"named at the stated size: {describe_share(sum('named' in row['named'] for row in rows), len(rows))}")
    print(f"named or likely: {describe_share(sum(bool(row['named']) for row in rows), len(rows))}")
    wrong = [row for row in rows if any(state == "named" for _, _, _, state in row["found"]) and not row["named"]]
    print(f"another name: {len(wrong)}; median time of a check {np.median([row['seconds'] for row in rows]):.1f} s")
    for row in rows:
        if "named" not in row["named"]:
            print(f"  trial {row['trial']}: {row['mechanism']} in {row['model']}, found {row['found']}")


if __name__ == "__main__":
    run_command(str(__doc__), "check.jsonl", 100, run_trial, show)
