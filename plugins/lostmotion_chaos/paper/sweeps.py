"""Figs. 6, 7 and 10, a bifurcation diagram and a map: Case 1 over 1/alpha and damping, from several starts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.results import join_names
from lostmotion_chaos.paper.cases import CASES
from lostmotion_chaos.paper.drawings import (
    BranchesDrawing,
    DiagramsDrawing,
    LineDrawing,
    PlaneDrawing,
    SharedPlaneDrawing,
)
from lostmotion_chaos.paper.lab import Lab
from lostmotion_chaos.paper.outcome import PaperOutcome, judge_claims

LOW, HIGH = 1.0, 10.0
"""The range of 1/alpha in Fig. 6."""
DAMPINGS = (0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32)
"""2 zeta in Fig. 7; it doubles from panel to panel."""
KEPT = 60
"""Periods of each motion that a diagram shows."""
KNOWN = ((1.6, 2.3), (4.42, 6.55), (7.2, 7.55), (7.68, 8.6), (9.0, 9.8))
"""The windows of 1/alpha in which careful integration finds chaos at 2 zeta = 0.04."""
SOME = 0.25
"""A cell counts as chaotic from this share of chaotic starts on; chosen by experience, no measurement recorded."""


@dataclass(frozen=True)
class SweepEffort:
    """The number of starts of each cell, the drive periods that are used, and the drive periods of the transient."""

    starts: int
    periods: int
    transient: int


@dataclass(frozen=True, eq=False)
class Sweep:
    """Exponents (cells, starts) in bit per normalised time, periods (cells, starts), x/x0 (cells, starts, KEPT)."""

    inverse: Array
    exponents: Array
    periods: NDArray[np.int64]
    places: Array

    @property
    def chaotic(self) -> NDArray[np.bool_]:
        """Return which motions (cells, starts) are chaotic."""
        found: NDArray[np.bool_] = (self.periods == 0) & (self.exponents > 0.0)
        return found

    @property
    def share(self) -> Array:
        """Return the share of starts (cells,) that end in chaos."""
        return np.asarray(self.chaotic.mean(axis=1), dtype=np.float64)


def sweep_case(lab: Lab, damping: float, inverse: Array, effort: SweepEffort) -> Sweep:
    """Return the motions of Case 1 with another 2 zeta at each 1/alpha of `inverse` (cells,)."""
    cells = len(inverse)
    exponents = np.full((cells, effort.starts), np.nan)
    periods = np.zeros((cells, effort.starts), dtype=np.int64)
    places = np.full((cells, effort.starts, min(KEPT, effort.periods)), np.nan)

    def work(k: int) -> None:
        case = CASES[1].vary(alpha=1.0 / float(inverse[k]), damping=damping)
        flow = case.make_flow(lab)
        starts = lab.draw_starts(flow, effort.starts)
        found = lab.follow(flow, starts, periods=effort.periods, transient=effort.transient)
        exponents[k], periods[k] = case.bit * found.exponents, found.periods
        places[k] = found.states[:, -KEPT:, 0] / case.x0

    lab.spread(work, cells)
    return Sweep(inverse, exponents, periods, places)


def find_windows(inverse: Array, chaotic: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """Return the ranges of 1/alpha with chaos; a gap of one cell is ignored."""
    filled = chaotic.copy()
    filled[1:-1] |= chaotic[:-2] & chaotic[2:]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], filled, [False]]).astype(int)))
    return [(float(inverse[a]), float(inverse[b - 1])) for a, b in edges.reshape(-1, 2) if b - a > 1]


def _sweep_line(lab: Lab) -> Sweep:
    """Return the motions of Case 1 over 1/alpha at its own damping; computed once for all figures."""
    cells = lab.pick(451, 91)
    effort = SweepEffort(*lab.pick((8, 1000, 500), (3, 250, 150)))
    return lab.compute_once("line", lambda: sweep_case(lab, CASES[1].damping, np.linspace(LOW, HIGH, cells), effort))


def _compute_window_shares(sweep: Sweep) -> dict[str, float]:
    """Return the share of chaotic motions in each of the known windows and in the widest gap between them."""
    spans = {f"window_{low:g}": (low, high) for low, high in KNOWN} | {"gap_2.5_to_4.2": (2.5, 4.2)}
    where = {name: (sweep.inverse >= low) & (sweep.inverse <= high) for name, (low, high) in spans.items()}
    return {name: float(sweep.chaotic[cells].mean()) for name, cells in where.items()}


def fig6(lab: Lab) -> PaperOutcome:
    """Return the largest exponent over 1/alpha, from several starts at each value."""
    sweep = _sweep_line(lab)
    found = find_windows(sweep.inverse, sweep.share >= SOME)
    mixed = float(np.mean((sweep.share > 0.0) & (sweep.share < 1.0)))
    at = np.abs(sweep.inverse - 2.0) < 0.06
    near_two = float(np.nanmean(sweep.exponents[at]))
    spans = join_names([f"{a:.2f} to {b:.2f}" for a, b in found if b - a > 0.1]) or "none"
    near_four = float(np.nanmax(sweep.exponents[np.abs(sweep.inverse - 4.1) < 0.06]))
    says = (
        f"Chaos occurs in separate windows of 1/alpha, as the paper says: {spans}; near 2.0 the exponent is "
        f"{near_two:.3f} bit/time (paper: about 0.06). Near 4.1, which the paper calls chaotic, the highest is "
        f"{near_four:.3f}, and in {100 * mixed:.0f} % of the cells chaos depends on the start."
    )
    numbers = {"near_2_bit_per_time": near_two, "windows": float(len(found)), "share_mixed": mixed}
    numbers |= _compute_window_shares(sweep)
    numbers["highest_bit_per_time"] = float(np.nanmax(sweep.exponents))
    numbers["highest_near_4.1"] = near_four
    data = LineDrawing(sweep.inverse, sweep.exponents, sweep.share, KNOWN)
    claims = judge_claims(len(found) >= 3, abs(near_two - 0.06) < 0.015, near_four > 0.0)
    return PaperOutcome(claims, says, numbers, data)


def fig7(lab: Lab) -> PaperOutcome:
    """Return bifurcation diagrams over 1/alpha for seven dampings."""
    inverse = np.linspace(LOW, HIGH, lab.pick(361, 73))
    effort = SweepEffort(*lab.pick((4, 400, 500), (2, 120, 100)))
    sweeps = [sweep_case(lab, damping, inverse, effort) for damping in DAMPINGS]
    shares = np.array([float(s.chaotic.mean()) for s in sweeps])
    falls = bool((np.diff(shares) <= 0.0).all())
    says = (
        f"From 2 zeta = 0.005 to 0.32 the share of chaotic motions changes from {100 * shares[0]:.0f} to "
        f"{100 * shares[-1]:.0f} %: "
        + ("it falls with every doubling." if falls else "damping reduces chaos, but not at every step.")
        + " At 0.005 some of the motions that do not repeat are transients."
    )
    numbers = {f"share_{d:g}": float(s) for d, s in zip(DAMPINGS, shares, strict=True)}
    data = DiagramsDrawing(inverse, [s.places for s in sweeps], DAMPINGS, shares)
    return PaperOutcome(
        judge_claims(bool(shares[-1] < 0.2 * shares.max()), bool(shares[3] > shares[-1])), says, numbers, data
    )


@dataclass(frozen=True, eq=False)
class Plane:
    """Exponents (dampings, inverse, starts) in bit per normalised time over a plane, and which motions are chaotic."""

    inverse: Array
    dampings: Array
    exponents: Array
    chaotic: NDArray[np.bool_]


def sweep_plane(lab: Lab, inverse: Array, dampings: Array, effort: SweepEffort) -> Plane:
    """Return the motions of Case 1 over 1/alpha and 2 zeta."""
    rows = [sweep_case(lab, float(damping), inverse, effort) for damping in dampings]
    return Plane(inverse, dampings, np.stack([r.exponents for r in rows]), np.stack([r.chaotic for r in rows]))


def fig10(lab: Lab) -> PaperOutcome:
    """Return the largest exponent over 1/alpha and zeta (highest of several starts) and the share of chaotic starts."""
    across, up = lab.pick((121, 41), (37, 13))
    effort = SweepEffort(*lab.pick((4, 400, 300), (2, 120, 80)))
    found = sweep_plane(lab, np.linspace(LOW, HIGH, across), np.linspace(0.01, 0.32, up), effort)
    share = found.chaotic.mean(axis=2)
    low, high = (float(share[part].mean()) for part in (found.dampings < 0.06, found.dampings > 0.25))
    mixed = float(np.mean((share > 0.0) & (share < 1.0)))
    says = (
        f"Damping reduces chaos, as the paper says, but not uniformly: of the motions below zeta = 0.03 "
        f"{100 * low:.0f} % are chaotic, above 0.125 {100 * high:.0f} %. In {100 * mixed:.0f} % of the plane chaos "
        "depends on the start: it is not a function of 1/alpha and zeta alone, which an inversion would require."
    )
    numbers = {"share_low_damping": low, "share_high_damping": high, "share_mixed": mixed}
    data = SharedPlaneDrawing(found.inverse, 0.5 * found.dampings, found.exponents.max(axis=2), share)
    return PaperOutcome(judge_claims(low > 5.0 * high), says, numbers, data)


def bifurcation(lab: Lab) -> PaperOutcome:
    """Return a bifurcation diagram over 1/alpha with the exponents of the same motions."""
    effort = SweepEffort(*lab.pick((6, 400, 600), (3, 150, 150)))
    sweep = sweep_case(lab, CASES[1].damping, np.linspace(LOW, HIGH, lab.pick(1201, 181)), effort)
    rows = zip(sweep.exponents, ~sweep.chaotic, strict=True)
    several = float(np.mean([_has_several_attractors(row, calm) for row, calm in rows]))
    says = (
        "Stroboscopic positions of Case 1 with the exponents of the same motions below: where the points fill a band "
        f"the exponent is positive. At {100 * several:.0f} % of the values of 1/alpha the starts end on periodic "
        "orbits with different exponents, or only some of them end in chaos."
    )
    numbers = {"share_chaotic": float(sweep.chaotic.mean()), "share_with_several_attractors": several}
    data = BranchesDrawing(sweep.inverse, sweep.places, sweep.exponents)
    return PaperOutcome("beyond the paper", says, numbers, data)


def _has_several_attractors(exponents: Array, calm: NDArray[np.bool_]) -> bool:
    """Return whether only some motions of a cell are chaotic, or all are periodic with different exponents."""
    if calm.any() and not calm.all():
        return True
    return bool(calm.all() and np.ptp(exponents) > 1e-3)


def plane_map(lab: Lab) -> PaperOutcome:
    """Return a map of the largest exponent over 1/alpha and zeta with more cells than Fig. 10."""
    across, up = lab.pick((301, 111), (61, 25))
    effort = SweepEffort(*lab.pick((1, 300, 300), (1, 100, 100)))
    found = sweep_plane(lab, np.linspace(LOW, HIGH, across), np.geomspace(0.01, 0.32, up), effort)
    top = 0.5 * float(found.dampings[found.chaotic.any(axis=(1, 2))].max(initial=0.0))
    says = (
        f"The largest exponent on {across} by {up} cells, of the motion that begins at rest; "
        f"{100 * found.chaotic.mean():.0f} % of the cells are chaotic, up to zeta = {top:.2g}. Single cells that "
        "differ from their neighbours are caused by coexisting attractors and long transients."
    )
    numbers = {"share_chaotic": float(found.chaotic.mean()), "highest_zeta": top}
    data = PlaneDrawing(found.inverse, 0.5 * found.dampings, found.exponents[:, :, 0])
    return PaperOutcome("beyond the paper", says, numbers, data)
