"""How well the quantifier route reads its levels, and what it makes of them.

    python benchmarks/levels.py errors [--machines 60]     how far exponents and dimensions read from recordings lie off
    python benchmarks/levels.py machine                    a simulated machine at eight levels
    python benchmarks/levels.py decide                     two gap sizes of equal exponents, told apart by D2
    python benchmarks/levels.py table2                     Table 2 of the paper, typed in

`errors` simulates recordings of machines drawn at random (position with 0.2 to 2 % of noise, 120 to 250 periods),
reads them, and compares with the tangent flow and the section along the same motion, followed for 6000 periods.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

from lostmotion.contracts import Array, Flow
from lostmotion.flow import Harmonic, flow_of
from lostmotion.kernels.threads import cores
from lostmotion.registry import default
from lostmotion.study.cells import period_of
from lostmotion.study.inversion import TAIL
from lostmotion.workflow.reading import read_level
from lostmotion.workflow.rehearsal import Bench, rehearsed

LONG = 6000
WEAK = 0.5
"""Exponents (nat per period of the drive) below which chaos is called weak."""


def one(seed: int) -> dict[str, Any]:
    """Return what was read of one recording, and the truth."""
    registry, rng = default(), np.random.default_rng([seed, 20])
    inverse, zeta, ratio = rng.uniform(0.8, 9.5), rng.uniform(0.01, 0.06), rng.uniform(0.18, 0.32)
    noise = float(rng.choice([0.002, 0.005, 0.01] if seed % 2 else [0.002, 0.005, 0.01, 0.02]))
    bench = Bench(int(rng.integers(120, 250)), int(rng.choice([50, 80, 100])), noise)
    moved = bool(seed % 2)
    model = registry.make("model", "robot_joint" if moved else "lin_backlash")
    values = {"m": 1.0, "c": 2.0 * zeta, "k0": 1.0, "x0": 1.0, "mgl" if moved else "k1": 0.0}
    beat = Harmonic(1.0 / inverse / (ratio**2 if moved else 1.0), ratio)
    signals, begin = rehearsed(model, values, beat, bench, rng)
    flow = flow_of(model, values, drive=beat, start=begin)
    exponent, dimension, period = truth(flow, rng)
    start = time.perf_counter()
    read = read_level(signals, registry, rng)
    row: dict[str, Any] = {
        "seed": seed, "model": model.name, "inverse": inverse, "zeta": zeta, "ratio": ratio, **vars(bench),
        "period": period,
        "lyapunov_true": exponent[0], "lyapunov_true_sd": exponent[1], "d2_true": dimension[0],
        "d2_true_sd": dimension[1], "motion": read.level.motion or "undecided", "seconds": time.perf_counter() - start,
        "beat": beat.period,
    }  # fmt: skip
    for name, found in (("lyapunov", read.exponent), ("d2", read.dimension)):
        if found is not None:
            row |= {name: found.value, f"{name}_sd": (found.high - found.low) / 3.92, f"{name}_status": found.status}
    return row


def truth(flow: Flow, rng: np.random.Generator) -> tuple[tuple[float, float], tuple[float, float], int]:
    """Return exponent (1/s) and dimension with their errors, and the period, of the motion from the start of a flow."""
    registry = default()
    found = registry.make("quantifier", "lyapunov_max", periods=LONG, transient=0).estimate(flow, rng=rng)
    section = registry.make("quantifier", "section_dimension", periods=LONG, transient=0).estimate(flow, rng=rng)
    states = flow.march(flow.start, periods=400, tangents=0).states
    sd = section.details.get("stderr", math.nan)
    return (found.value, found.details.get("stderr", math.nan)), (section.value, sd), period_of(states)


def errors(machines: int, keep: Path | None) -> None:
    """Print how the readings of machines compare with the truth."""
    with ProcessPoolExecutor(cores()) as pool:
        rows = []
        for k, row in enumerate(pool.map(one, range(machines))):
            rows.append(row)
            print(f"\r{k + 1} of {machines}", end="", file=sys.stderr, flush=True)
            if keep:
                keep.write_text(json.dumps(rows))
    print(file=sys.stderr)
    told(rows)


def told(rows: list[dict[str, Any]]) -> None:
    """Print the kinds that were seen, the errors of exponents and dimensions, and the times."""
    kinds = ("periodic", "chaotic", "undecided")
    weak = [r for r in chaotic(rows) if r["lyapunov_true"] * r["beat"] < WEAK]
    strong = [r for r in chaotic(rows) if r["lyapunov_true"] * r["beat"] >= WEAK]
    print(f"{'truth, seen as':<28}" + "".join(f"{k:>12}" for k in kinds))
    for name in ("lin_backlash", "robot_joint"):
        table = {"periodic": [r for r in rows if r["period"]], f"chaotic, below {WEAK:g}": weak, "chaotic": strong}
        for label, kept in table.items():
            own = [r for r in kept if r["model"] == name]
            print(f"{name + ', ' + label:<36}" + "".join(f"{sum(r['motion'] == k for r in own):>12}" for k in kinds))
    for name in ("lyapunov", "d2"):
        kept = [r for r in chaotic(rows) if r["motion"] == "chaotic" and math.isfinite(r.get(name, math.nan))]
        kept = [r for r in kept if math.isfinite(r[f"{name}_true"]) and (name != "d2" or r["d2_status"] == "ok")]
        off, claimed, size = (np.array([r[k] for r in kept]) for k in (name, f"{name}_sd", f"{name}_true"))
        z = (off - size) / claimed
        print(f"{name}: {len(kept)} readings; error over claimed sd: mean {z.mean():+.2f}, rms "
              f"{math.sqrt(np.mean(z**2)):.2f}, largest {np.abs(z).max():.2f}; error over value: mean "
              f"{np.mean(off / size - 1.0):+.3f}, sd {np.std(off / size):.3f}")  # fmt: skip
        bias, scale, own = fitted(off, claimed, size)
        print(f"  most likely: bias {bias:+.3f} of the value, {scale:.2f} claimed sd and {own:.3f} of the value")
    print(f"seconds a recording: {np.mean([r['seconds'] for r in rows]):.2f}")


def fitted(seen: Array, claimed: Array, true: Array) -> tuple[float, float, float]:
    """Return bias, factor of the claimed sd, and own error as a share of the value, by maximum likelihood (Student)."""

    def cost(theta: Array) -> float:
        sd = np.hypot(math.exp(theta[1]) * claimed, math.exp(theta[2]) * seen)
        z = (seen / (1.0 + theta[0]) - true) / sd
        return float(np.sum(np.log(sd) + 0.5 * (TAIL + 1.0) * np.log1p(z**2 / TAIL)) + 0.5 * theta[2] ** 2 / 25.0)

    found = minimize(cost, [0.0, -0.2, -3.0], method="Nelder-Mead", options={"maxiter": 2000}).x
    return float(found[0]), math.exp(found[1]), math.exp(found[2])


def chaotic(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the rows of motions whose exponent is positive beyond doubt."""
    return [r for r in rows if not r["period"] and r["lyapunov_true"] > 3.0 * r["lyapunov_true_sd"]]


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("errors",))
    parser.add_argument("--machines", type=int, default=60)
    parser.add_argument("--keep", type=Path, help="file for the rows of `errors`")
    args = parser.parse_args()
    errors(args.machines, args.keep)


if __name__ == "__main__":
    main()
