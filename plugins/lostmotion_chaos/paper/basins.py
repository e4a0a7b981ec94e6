"""Basins of attraction, and Poincare sections long enough to show the density of visits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.results import join_names
from lostmotion_chaos.paper.cases import CASES, PaperCase
from lostmotion_chaos.paper.drawings import Basin, BasinsDrawing, Visits, VisitsDrawing
from lostmotion_chaos.paper.lab import LONGEST, Lab, find_return_period
from lostmotion_chaos.paper.outcome import PaperOutcome

APART = 1e-3
"""Distance, as a share of x0, beyond which two orbits are different."""


def find_attractors(
    lab: Lab, case: PaperCase, places: tuple[Array, Array], periods: int
) -> tuple[NDArray[np.int64], list[int]]:
    """Return the index of the attractor on which each start (up, across) ends, and the period of each attractor.

    The period is counted in drive periods; it is 0 for chaos. `places` are the positions in x0 and the velocities in
    x0 omega_0 of the starts.
    """
    flow, (across, up) = case.make_flow(lab), places
    scale = np.array([case.x0, case.x0 * case.natural])
    ends = np.full((len(up), len(across), 3), np.nan)

    def work(row: int) -> None:
        for column, x in enumerate(across):
            states = flow.strobe(np.array([x, up[row]]) * scale, periods=periods, tangents=0).states[1:] / scale
            back = find_return_period(states)
            orbit = states[-back:] if back else np.zeros((1, 2))
            ends[row, column] = (back, *orbit[np.argmin(orbit[:, 0])])

    lab.spread(work, len(up))
    return _sort_attractors(ends.reshape(-1, 3), (len(up), len(across)))


def _sort_attractors(ends: Array, shape: tuple[int, int]) -> tuple[NDArray[np.int64], list[int]]:
    """Return the indices (shape) and periods of the attractors: chaos first, then by the number of starts."""
    kinds, back = np.unique(np.column_stack([ends[:, :1], np.round(ends[:, 1:] / APART)]), axis=0, return_inverse=True)
    merged = _merge_kinds(kinds * np.array([1.0, APART, APART]))[back.ravel()]
    names, counts = np.unique(merged, return_counts=True)
    order = sorted(range(len(names)), key=lambda k: (kinds[names[k], 0] != 0, -counts[k]))
    rank = {int(names[k]): place for place, k in enumerate(order)}
    index = np.array([rank[int(m)] for m in merged], dtype=np.int64).reshape(shape)
    return index, [int(kinds[names[k], 0]) for k in order]


def _merge_kinds(kinds: Array) -> NDArray[np.int64]:
    """Return for each row of `kinds` the index of the first row that equals it within the rounding."""
    return np.array([int(np.argmax(np.abs(kinds - kind).max(axis=1) < 3.0 * APART)) for kind in kinds], dtype=np.int64)


def basins(lab: Lab) -> PaperOutcome:
    """Return the basins of Case 2 and Case 3."""
    cells, periods = lab.pick((241, 240), (61, 120))
    found: list[Basin] = []
    numbers: dict[str, float] = {}
    words: list[str] = []
    for k, (wide, high) in ((2, (8.0, 8.0)), (3, (8.0, 8.0))):
        places = np.linspace(-wide, wide, cells), np.linspace(-high, high, cells)
        index, back = find_attractors(lab, CASES[k], places, max(periods, 3 * LONGEST))
        shares = [float(np.mean(index == j)) for j in range(len(back))]
        labels = [_format_label(p, s) for p, s in zip(back, shares, strict=True)]
        found.append(Basin(*places, index, labels))
        numbers[f"case{k}_attractors"] = float(len(back))
        numbers[f"case{k}_chaos"] = sum(s for p, s in zip(back, shares, strict=True) if not p)
        words.append(f"Case {k} ends on {join_names(labels) or 'none'}")
    says = f"{'; '.join(words)}. The exponent depends on the start as well as on the parameters."
    return PaperOutcome("beyond the paper", says, numbers, BasinsDrawing(tuple(found)))


def _format_label(period: int, share: float) -> str:
    """Return the label of an attractor: its period, or "chaos", and its share of the starts."""
    return f"{f'period {period}' if period else 'chaos'} ({100 * share:.1f} %)"


def section(lab: Lab) -> PaperOutcome:
    """Return Poincare sections of Cases 1 and 3 as numbers of visits on a fine grid."""
    points, cells = lab.pick((4_000_000, 900), (200_000, 300))
    found: list[Visits] = []
    numbers: dict[str, float] = {}
    for k in (1, 3):
        counts, edges = _count_visits(lab, CASES[k], points, cells)
        found.append(Visits(counts, *edges, points))
        visited = np.sort(counts[counts > 0])[::-1]
        numbers[f"case{k}_densest"] = float(visited[: max(len(visited) // 100, 1)].sum() / visited.sum())
    says = (
        f"Sections of {points:,} periods: the 1 % of the cells with most visits receive "
        f"{100 * numbers['case1_densest']:.0f} % of the visits in Case 1 and {100 * numbers['case3_densest']:.0f} % in "
        "Case 3. A plot of single points does not show this."
    )
    return PaperOutcome("beyond the paper", says, numbers, VisitsDrawing(tuple(found)))


def _count_visits(lab: Lab, case: PaperCase, points: int, cells: int) -> tuple[Array, tuple[Array, Array]]:
    """Return the number of visits (cells, cells) of a chaotic motion at phase 0, and the edges of the cells."""
    flow = case.make_flow(lab)
    starts = lab.draw_starts(flow, 16)
    found = lab.follow(flow, starts, periods=500, transient=500)
    state = found.states[int(np.argmax(found.chaotic)), -1]
    scale = np.array([case.x0, case.x0 * case.natural])
    first = flow.strobe(state, periods=20_000, tangents=0).states / scale
    low, high = first.min(axis=0), first.max(axis=0)
    room = 0.04 * (high - low)
    edges = tuple(np.linspace(a - r, b + r, cells + 1) for a, b, r in zip(low, high, room, strict=True))
    counts, chunk = np.zeros((cells, cells)), 100_000
    for _ in range(max(points // chunk, 1)):
        states = flow.strobe(state, periods=chunk, tangents=0).states
        state = states[-1]
        seen = states[1:] / scale
        counts += np.histogram2d(seen[:, 0], seen[:, 1], bins=[edges[0], edges[1]])[0]
    return counts, (edges[0], edges[1])
