"""What a map costs, how that grows, what refinement at the boundary of chaos saves, and whether `Map.at` is honest.

    python benchmarks/map_study.py [--reference 257] [--full]

Prints the cost of a cell-period on one thread and on all cores, by number of cells; the extrapolated, or with `--full`
measured, time of 128 x 128 cells x 4 starts x 800 periods; then the share of cells of a fine reference that uniform and
refined maps put on the wrong side of the boundary, by number of cells computed; then how often the interval of
`Map.at`, read from a coarse map, holds what a cell of the fine one shows.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy.ndimage import distance_transform_edt

from lostmotion.kernels.threads import cores
from lostmotion.registry import default
from lostmotion_chaos.maps.map import Map
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
from lostmotion_chaos.maps.sweep import Workers

ALPHA, ZETA = "alpha=0.2:0.6666:{0}:inverse", "zeta=0.008:0.05:{0}"
"""1/alpha from 1.5 to 5: the first window of chaos, the gap behind it, and the edge of the second."""


def made(folder, side, how=None, **asked):
    """Return a map of side x side cells, and the time (s) and processor time (s) it took."""
    study = make_study(Request("lin_backlash", (ALPHA.format(side), ZETA.format(side)), **asked), default())
    path = Path(folder) / f"{side}-{time.monotonic_ns()}.zarr"
    begin, cpu = time.perf_counter(), time.process_time()
    found = make_map(study, path, how or RunOptions(Workers(cores())), lambda done, total: None)
    return found, time.perf_counter() - begin, time.process_time() - cpu


def cost(folder, full):
    """Print the cost of a cell-period, and the time of the map of the issue."""
    made(folder, 2, periods=40, transient=0, starts=1)
    rates = {}
    for side, jobs in ((6, 1), (12, 1), (12, cores()), (24, cores())):
        _, seconds, cpu = made(folder, side, RunOptions(Workers(jobs)))
        each = side * side * 4 * 800
        rates[side, jobs] = cpu / each
        print(
            f"{side:4d} x {side:<4d} x 4 starts x 800 periods, {jobs} threads: {seconds:6.2f} s, "
            f"{1e6 * seconds / each:5.2f} us a cell-period; processor {1e6 * cpu / each:5.2f} us"
        )
    total = 128 * 128 * 4 * 800
    if full:
        _, seconds, cpu = made(folder, 128)
        print(
            f" 128 x 128 measured: {seconds:.0f} s, {1e6 * seconds / total:.2f} us a cell-period, processor {cpu:.0f} s"
        )
    else:
        guess = rates[24, cores()] * total
        print(f" 128 x 128 extrapolated: {guess:.0f} s of processor, {guess / cores():.0f} s on {cores()} idle cores")


def wrong(share, known):
    """Return the share of cells on the wrong side when each is given what the nearest known one has."""
    nearest = distance_transform_edt(~known, return_distances=False, return_indices=True)
    return float(((share[tuple(nearest)] > 0.5) != (share > 0.5)).mean())


def spread_out(known, step, shape):
    """Return a mask on a fine grid from one on every `step`-th point."""
    mask = np.zeros(shape, dtype=bool)
    mask[::step, ::step] = known
    return mask


def refinement(folder, reference, side):
    """Print errors at the boundary against cells, of uniform and of refined maps."""
    share = reference.share
    print(f"\nboundary of chaos against {side} x {side} cells:")
    uniform = []
    for step in (16, 8, 4, 2):
        known = spread_out(True, step, share.shape)
        uniform.append((int(known.sum()), wrong(share, known)))
        print(f"  uniform {known.sum():6d} cells: {100 * uniform[-1][1]:5.2f} % wrong")
    for base, levels in ((9, 3), (17, 2), (9, 4), (17, 3)):
        many = (base - 1) * 2**levels + 1
        if many > side:
            continue
        found, seconds, _ = made(folder, base, RunOptions(Workers(cores()), levels), **SHORT)
        computed = found.dataset["level"].to_numpy() >= 0
        step = (side - 1) // (many - 1)
        error = wrong(share, spread_out(computed, step, share.shape))
        print(
            f"  {base} x {base}, {levels} halvings {computed.sum():6d} cells: {100 * error:5.2f} % wrong; "
            f"{ratio(uniform, error, int(computed.sum()))} ({seconds:.0f} s)"
        )


def ratio(uniform, error, cells):
    """Say how many more cells a uniform map needs for the same error, read off its line of log error over log cells."""
    many, wrong_share = np.log(np.array(uniform, dtype=float)).T
    if np.log(error) < wrong_share.min():
        return f"more than {np.exp(many[-1]) / cells:.1f} times fewer cells: the best uniform map is worse"
    falling = np.maximum.accumulate(wrong_share[::-1])
    return f"{np.exp(np.interp(np.log(error), falling, many[::-1])) / cells:.1f} times fewer cells than a uniform map"


def honesty(reference, side):
    """Print how often the 95 % interval from every eighth cell holds a start of the fine map, and near the edges."""
    coarse = Map(reference.dataset.isel(alpha=slice(None, None, 8), zeta=slice(None, None, 8)))
    rng = np.random.default_rng(0)
    rows = []
    for _ in range(4000):
        i, j = rng.integers(0, side, 2)
        cell = reference.dataset.isel(alpha=i, zeta=j)
        truth = cell["lyapunov_max"].to_numpy()[rng.integers(0, cell.sizes["start"])]
        read = coarse.at(alpha=float(cell["alpha"]), zeta=float(cell["zeta"]))
        rows.append((read.low <= truth <= read.high, 0.0 < read.chaotic_share < 1.0, read.high - read.low))
    table = np.array(rows, dtype=float)
    edge = table[:, 1] > 0
    print(f"\nMap.at from {coarse.share.shape[0]} x {coarse.share.shape[1]} cells, 4000 points of the fine map:")
    for name, chosen in (("all", np.full(len(edge), True)), ("at an edge", edge), ("elsewhere", ~edge)):
        told = table[chosen]
        inside, width = 100 * told[:, 0].mean(), np.median(told[:, 2])
        print(f"  {name:<11} {len(told):5d} points: {inside:.1f} % inside, median width {width:.4f}")


SHORT = {"periods": 200, "transient": 150, "starts": 4}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reference", type=int, default=129, help="cells along a side of the fine map: 129 or 257")
    parser.add_argument("--full", action="store_true", help="measure the map of 128 x 128 cells")
    told = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cost(folder, told.full)
        reference, seconds, _ = made(folder, told.reference, **SHORT)
        print(f"\nfine map: {seconds:.0f} s")
        refinement(folder, reference, told.reference)
        honesty(reference, told.reference)


if __name__ == "__main__":
    main()
