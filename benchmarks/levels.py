"""How well the quantifier route reads its levels, and what it makes of them.

    python benchmarks/levels.py errors [--machines 60]     how far exponents and dimensions read from recordings lie off
    python benchmarks/levels.py chaos [--machines 358]     the same of chaos alone, with damping from 0.5 to 8 %
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
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from itertools import repeat
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.stats import t as student

from lostmotion.case import CaseFile, Prior
from lostmotion.case.drive_levels import Level, Measured
from lostmotion.contracts import Array, Flow
from lostmotion.identification.sampling import identify
from lostmotion.kernels.threads import cores
from lostmotion.registry import default
from lostmotion.results import Estimate
from lostmotion.settings import DEFAULT
from lostmotion_chaos.flows.flow import Harmonic, flow_of
from lostmotion_chaos.levels.levels import MapGrid, make_inversion, make_quantifier_task
from lostmotion_chaos.levels.reading import correct_estimate, read_level
from lostmotion_chaos.levels.rehearsal import RecordingPlan, simulate_levels, simulate_signals
from lostmotion_chaos.maps.cells import find_period
from lostmotion_chaos.maps.inversion import ERROR_DOF, Inversion, predict_levels
from lostmotion_chaos.paper.joint import DAMPING, FREQUENCY, HALF, LEVELS, PAPER, RATIO

OMEGA = 40.0
SD_PAPER = 0.2
"""Standard deviation (bit/s) that is put to the exponents of Table 2, which come without an error."""
TRUE_GAP, TWO_GAPS, BETWEEN = {"x0": 0.0031, "zeta": 0.0239}, (60.0, 75.0, 100.0), 0.005
"""A machine and its levels (N), found among 1600 machines and sets of levels on a map: their exponents fit gaps of
2 to 4 and of 7 to 11 mm."""
CAREFUL = RecordingPlan(periods=400, looks=60, noise=0.002)
LONG, BRIEF = 6000, 2000
Known = tuple[float, float]
"""A value with its standard deviation."""


def run_machine(seed: int, chaos: bool = False) -> dict[str, Any]:
    """Return what was read of one recording, and the truth; nothing, where `chaos` is wanted and the motion is not."""
    registry, rng = default(), np.random.default_rng([seed, 20 + chaos])
    inverse, zeta = rng.uniform(0.8, 9.5), 0.005 * 16.0 ** rng.uniform() if chaos else rng.uniform(0.01, 0.06)
    ratio = rng.uniform(0.18, 0.32)
    noise = float(rng.choice([0.002, 0.005, 0.01] if seed % 2 or chaos else [0.002, 0.005, 0.01, 0.02]))
    bench = RecordingPlan(int(rng.integers(120, 250)), int(rng.choice([50, 80, 100])), noise)
    moved = bool(seed % 2)
    model = registry.make("model", "robot_joint" if moved else "lin_backlash")
    values = {"m": 1.0, "c": 2.0 * zeta, "k0": 1.0, "x0": 1.0, "mgl" if moved else "k1": 0.0}
    beat = Harmonic(1.0 / inverse / (ratio**2 if moved else 1.0), ratio)
    signals, begin = simulate_signals(model, values, beat, bench, rng)
    flow = flow_of(model, values, drive=beat, start=begin)
    if chaos and not shows_chaos(*compute_truth(flow, rng, BRIEF)):
        return {}
    exponent, dimension, period = compute_truth(flow, rng)
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


def shows_chaos(exponent: Known, _dimension: Known, period: int) -> bool:
    """Return whether an exponent is positive beyond doubt, of a motion that does not repeat itself."""
    return not period and exponent[0] > 3.0 * exponent[1]


def compute_truth(flow: Flow, rng: np.random.Generator, periods: int = LONG) -> tuple[Known, Known, int]:
    """Return exponent (1/s) and dimension with their errors, and the period, of the motion from the start of a flow."""
    registry = default()
    found = registry.make("quantifier", "lyapunov_max", periods=periods, transient=0).estimate(flow, rng=rng)
    section = registry.make("quantifier", "section_dimension", periods=periods, transient=0).estimate(flow, rng=rng)
    states = flow.strobe(flow.start, periods=400, tangents=0).states
    sd = section.details.get("stderr", math.nan)
    return (found.value, found.details.get("stderr", math.nan)), (section.value, sd), find_period(states)


def measure_errors(machines: int, keep: Path | None, *, chaos: bool = False) -> None:
    """Print how the readings of machines compare with the truth."""
    with ProcessPoolExecutor(cores()) as pool:
        rows: list[dict[str, Any]] = []
        for k, row in enumerate(pool.map(run_machine, range(machines), repeat(chaos))):
            rows += [row] if row else []
            print(f"\r{k + 1} of {machines}", end="", file=sys.stderr, flush=True)
            if keep:
                keep.write_text(json.dumps(rows))
    print(file=sys.stderr)
    print_errors(rows)


def print_errors(rows: list[dict[str, Any]]) -> None:
    """Print the kinds that were seen, the errors of exponents and dimensions, and the times."""
    kinds = ("periodic", "chaotic", "undecided")
    weak = [r for r in select_chaotic(rows) if r["lyapunov_true"] * r["beat"] < DEFAULT.levels.weak]
    strong = [r for r in select_chaotic(rows) if r["lyapunov_true"] * r["beat"] >= DEFAULT.levels.weak]
    print(f"{'truth, seen as':<28}" + "".join(f"{k:>12}" for k in kinds))
    for name in ("lin_backlash", "robot_joint"):
        table = {
            "periodic": [r for r in rows if r["period"]],
            f"chaotic, below {DEFAULT.levels.weak:g}": weak,
            "chaotic": strong,
        }
        for label, kept in table.items():
            own = [r for r in kept if r["model"] == name]
            print(f"{name + ', ' + label:<36}" + "".join(f"{sum(r['motion'] == k for r in own):>12}" for k in kinds))
    for name in ("lyapunov", "d2"):
        kept = [r for r in select_chaotic(rows) if r["motion"] == "chaotic" and math.isfinite(r.get(name, math.nan))]
        kept = [r for r in kept if math.isfinite(r[f"{name}_true"]) and (name != "d2" or r["d2_status"] == "ok")]
        off, claimed, size = (np.array([r[k] for r in kept]) for k in (name, f"{name}_sd", f"{name}_true"))
        z = (off - size) / claimed
        print(f"{name}: {len(kept)} readings; error over claimed sd: mean {z.mean():+.2f}, rms "
              f"{math.sqrt(np.mean(z**2)):.2f}, largest {np.abs(z).max():.2f}; error over value: mean "
              f"{np.mean(off / size - 1.0):+.3f}, sd {np.std(off / size):.3f}")  # fmt: skip
        moved = np.array([r["model"] == "robot_joint" for r in kept])
        names = [f"{name} of a moved base" if base and name == "d2" else name for base in moved]
        ranges = [[r[name] + s * 1.96 * r[f"{name}_sd"] for s in (-1, 1)] for r in kept]
        found = [correct_estimate(key, Estimate(r[name], *ends, "ok"))
                 for key, r, ends in zip(names, kept, ranges, strict=True)]  # fmt: skip
        left = np.array([(one.value - t) / one.sd for one, t in zip(found, size, strict=True)])
        inside = np.abs(left) < student.ppf(0.975, ERROR_DOF)
        print(f"  as corrected: mean {left.mean():+.2f}, rms {math.sqrt(np.mean(left**2)):.2f}; 95 % intervals hold "
              f"{inside.sum()} of {len(left)}")  # fmt: skip
        unit = np.array([r["beat"] if name == "lyapunov" else 1.0 for r in kept])
        for parts in (np.zeros_like(moved), moved):
            biases, scale, own, fits = fit_errors(off * unit, claimed * unit, size * unit, parts)
            print(f"  most likely (log-likelihood {fits:.1f}): bias {' and '.join(f'{b:+.3f}' for b in biases)} of the "
                  f"value, {scale:.2f} claimed sd and {own:.3f} of the value")  # fmt: skip
    print(f"seconds a recording: {np.mean([r['seconds'] for r in rows]):.2f}")


def fit_errors(seen: Array, claimed: Array, true: Array, parts: Array) -> tuple[list[float], float, float, float]:
    """Return the most likely biases, factor of the claimed sd, own error as a share of the value, and log-likelihood.

    There is a bias for those that are not in `parts`, and one for those that are. What is seen errs about the truth
    (Student): were the truth to err about what is seen, low readings would count for more than high ones.
    """

    def cost(theta: Array) -> float:
        bias, sd = theta[2:][parts.astype(int)], np.hypot(math.exp(theta[0]) * claimed, math.exp(theta[1]) * true)
        z = (seen - (1.0 + bias) * true) / sd
        return float(
            np.sum(np.log(sd) + 0.5 * (ERROR_DOF + 1.0) * np.log1p(z**2 / ERROR_DOF)) + 0.5 * theta[1] ** 2 / 25.0
        )

    start = [-0.2, -3.0, *[0.0] * len(np.unique(parts))]
    best = minimize(cost, start, method="Nelder-Mead", options={"maxiter": 4000})
    return best.x[2:].tolist(), math.exp(best.x[0]), math.exp(best.x[1]), -float(best.fun)


def select_chaotic(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the rows of motions whose exponent is positive beyond doubt."""
    return [r for r in rows if not r["period"] and r["lyapunov_true"] > 3.0 * r["lyapunov_true_sd"]]


def identify_machine(folder: Path) -> None:
    """Find a simulated machine again from recordings at eight levels."""
    case = make_case({"x0": Prior(low=0.002, high=0.012), "zeta": Prior(low=0.01, high=0.06)})
    truth, rng = {"x0": 0.0052, "zeta": 0.023}, np.random.default_rng(8)
    drives = [(a, OMEGA) for a in (40.0, 50.0, 62.0, 77.0, 95.0, 117.0, 145.0, 180.0)]
    begin = time.perf_counter()
    reads = simulate_levels(case, default(), truth, drives, rng)
    print(f"eight recordings simulated and read in {time.perf_counter() - begin:.1f} s")
    sample_levels(replace(case, levels=tuple(read.level for read in reads)), truth, folder)


def identify_table2(folder: Path) -> None:
    """Invert Table 2 of the paper: a robot joint whose stiffness and inertia are those of `reproduce/joint.py`."""
    omega, log2 = 2.0 * math.pi * FREQUENCY, math.log(2.0)
    levels = []
    for degrees, bits in zip(LEVELS, PAPER, strict=True):
        seen = None if math.isnan(bits) else Measured(bits * log2, SD_PAPER * log2)
        motion = "chaotic" if seen else "periodic"
        levels.append(Level(f"{degrees:g} deg", math.radians(degrees), omega, motion, seen, None, "rad"))
    estimate = {"x0": Prior(low=math.radians(0.3), high=math.radians(1.5)), "zeta": Prior(low=0.01, high=0.12)}
    known = {"m": 1.0, "k0": (omega / RATIO) ** 2}
    case = CaseFile("Table 2", Path(), (), "robot_joint", known, estimate, {}, (), "none", levels=tuple(levels))
    sample_levels(case, {"x0": math.radians(HALF), "zeta": 0.5 * DAMPING}, folder)


def sample_levels(case: CaseFile, truth: Mapping[str, float], folder: Path) -> None:
    """Print the posterior of a case beside the truth, and what it expects at each level."""
    rng, begin = np.random.default_rng(0), time.perf_counter()
    task = make_quantifier_task(case, default(), folder, rng, say=show_progress)
    made = time.perf_counter()
    found = identify(task, rng=rng)
    print(f"map and proposal {made - begin:.0f} s, chain {time.perf_counter() - made:.1f} s")
    print(f"ESS {found.quality.ess.min():.0f}, R-hat {found.quality.rhat.max():.3f}, {found.evaluations} evaluations")
    for key, unit, draws in zip(found.keys, found.units, found.draws.T, strict=True):
        low, median, high = np.quantile(draws, [0.025, 0.5, 0.975])
        print(f"  {key}: {median:.5g} {unit} [{low:.5g}, {high:.5g}], truth {truth[key]:.5g}")
    posterior = task.posterior
    assert isinstance(posterior, Inversion)
    for one in predict_levels(posterior, found.draws[::10], rng):
        seen, band = one.level.lyapunov, one.lyapunov
        told = f"{seen.value:.3g} +- {seen.sd:.2g} 1/s" if seen else ""
        expected = f"{band.median:.3g} [{band.low:.3g}, {band.high:.3g}] 1/s" if band else ""
        print(f"  {one.level.name:>10}: {one.level.motion or 'undecided':<10}{told:<24}"
              f"chaos expected {one.chaotic_share:4.0%}  {expected}")  # fmt: skip


def make_case(estimate: Mapping[str, Prior]) -> CaseFile:
    """Return a case of Lin's oscillator, Case 1 of the paper, whose stiffness and mass are known."""
    known = {"m": 1.0, "k0": 4e4, "k1": 0.0}
    return CaseFile("oscillator", Path(), (), "lin_backlash", known, dict(estimate), {}, (), "none")


def decide_levels(folder: Path) -> None:
    """Show levels of a machine whose exponents fit two gaps, and what the dimensions make of that.

    At a known damping the dimension says little beside the exponent, since the sum of all exponents is -c / m and the
    dimension goes with both (Kaplan and Yorke). With the damping open it tells the damping, and so the gap.
    """
    case = make_case({"x0": Prior(low=0.002, high=0.012), "zeta": Prior(low=0.01, high=0.06)})
    for seed in range(1, 4):
        rng, drives = np.random.default_rng(seed), [(a, OMEGA) for a in TWO_GAPS]
        reads = simulate_levels(case, default(), TRUE_GAP, drives, rng, plan=CAREFUL)
        both = make_inversion(
            case, tuple(read.level for read in reads), default(), folder, MapGrid(), say=show_progress
        )
        gaps, points = list_grid(both)
        for name, posterior in (("exponents alone", both.without_d2()), ("with dimensions", both)):
            heights = posterior.log_likelihood(points)
            share = np.exp(heights - heights.max()).reshape(len(gaps), -1).sum(axis=1)
            small = share[gaps < BETWEEN].sum() / share.sum()
            print(f"recordings {seed}, {name}: {small:.2f} for half gaps below {1e3 * BETWEEN:g} mm, where the true "
                  f"{1e3 * TRUE_GAP['x0']:g} mm lies, {1 - small:.2f} above")  # fmt: skip


def list_grid(posterior: Inversion) -> tuple[Array, Array]:
    """Return the gaps of a grid over the prior, and its points."""
    ends = [np.linspace(f.low, f.high, n) for f, n in zip(posterior.space.free, (400, 100), strict=True)]
    return ends[0], np.stack(np.meshgrid(*ends, indexing="ij"), axis=-1).reshape(-1, 2)


def show_progress(done: int, cells: int) -> None:
    """Say on the terminal how far the map is."""
    print(f"\rmap: {done} of {cells} cells", end="\n" if done == cells else "", file=sys.stderr, flush=True)


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("errors", "chaos", "machine", "decide", "table2"))
    parser.add_argument("--machines", type=int, default=240, help="recordings for `errors` and `chaos`")
    parser.add_argument("--keep", type=Path, help="file for the rows of `errors`")
    parser.add_argument("--folder", type=Path, default=Path("levels"), help="where the maps are kept")
    args = parser.parse_args()
    if args.what in ("errors", "chaos"):
        measure_errors(args.machines, args.keep, chaos=args.what == "chaos")
        return
    {"machine": identify_machine, "decide": decide_levels, "table2": identify_table2}[args.what](args.folder)


if __name__ == "__main__":
    main()
