"""Pairs of neighbours in delay space, followed in time: the basis of the exponents of Rosenstein and of Kantz.

States are principal components of the delay window (Broomhead, King, Physica D 20 (1986) 217-236), which contain less
noise than the delays themselves. Where a drive period is known, neighbours are searched at the same drive phase, which
is a state of the machine. Only the part of the distance that is perpendicular to the flow is counted.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from lostmotion.contracts import Array, Series
from lostmotion.kernels.threads import spread
from lostmotion_chaos.kernels.neighbours import Tree, grow, several
from lostmotion_chaos.quantifiers._kernels_divergence import COUNT, FAR, find_same_phase, follow, select_visits
from lostmotion_chaos.signals.series import delay_vectors

Indices = NDArray[np.int64]
FRAMES = 2000
"""Delay windows from which the principal components are computed."""
BLOCKS = 20
"""Blocks of the record that are left out in turn."""
PLANE_DIMS = 3
"""Components in which distances are measured: two are perpendicular to the flow. In a plane, noise cancels in the mean
of the logarithm, which is harmonic there (the mean of ln|d + noise| over a circle of noise is ln|d| outside it)."""
TIE_SHARE = 1e-9
"""Points closer than this share of the rms distance are repeats of each other."""
LEAST_TURNS = 30
"""With fewer drive periods, neighbours are searched at all phases. Chosen by experience; no measurement recorded."""
RESOLVED_SAMPLES = 8
"""With at least so many samples in a period a drive is resolved, and curves are averaged over a period. Chosen by
experience; no measurement recorded."""
HORIZON_SHARE = 0.55
"""Pairs are followed until their mean distance reaches this share of the mean distance of unrelated points. Chosen by
experience; no measurement recorded."""


@dataclass(frozen=True, eq=False)
class States:
    """Points (n, dim) among which neighbours are searched, and how they are sampled.

    `plane` (<= 3, n) has their paths, in which distances are measured, and `motion` (<= 3, n) the velocities, whose
    direction is left out of distances; it is (0, n) for a map. `turn` is the drive period in samples, 0 for none;
    `flow` whether the motion is continuous between samples.
    """

    points: Array
    plane: Array
    motion: Array
    x: Array
    dt: float
    window: int
    theiler: int
    turn: float
    flow: bool

    @cached_property
    def smooth(self) -> int:
        """The samples over which curves are averaged: one period of the drive, or else of the motion.

        Within each period neighbours diverge and converge again, which would disturb a short fit.
        """
        if self.turn or not self.flow:
            return round(self.turn) or 1
        first = self.plane[0]
        pace = float(np.diff(first).std() / max(first.std(), 1e-300))
        most = min(self.theiler, len(first) // 20)
        return max(1, min(most, round(2.0 * np.pi / pace))) if pace > 0.0 else 1

    @property
    def size(self) -> float:
        """The root mean square distance of points at any two times."""
        return float(np.sqrt(2.0 * self.plane.var(axis=1).sum()))

    @property
    def tie(self) -> float:
        """The distance below which two points are repeats of each other."""
        return TIE_SHARE * self.size

    @cached_property
    def tree(self) -> Tree:
        """The search tree of the points."""
        return grow(self.points)

    @property
    def locked(self) -> bool:
        """Whether neighbours are searched at the same drive phase."""
        return bool(self.turn) and len(self.points) / self.turn >= LEAST_TURNS


@dataclass(frozen=True, eq=False)
class Pairs:
    """References (q,) and their neighbours (q, g, m) in groups; `repeats` is the share of references with a repeat.

    With `grows` each group contains those before it, too.
    """

    wanted: Indices
    groups: Indices
    limit: int
    repeats: float
    grows: bool = False


@dataclass(frozen=True, eq=False)
class Spread:
    """Sums (blocks, g, 4, times) of `follow`, the mean distance of unrelated points, and the noise in one sample."""

    sums: Array
    unrelated: float
    noise: float


def reconstruct_states(series: Series) -> States:
    """Return the states of a recording; with a delay of one sample it is treated as a map, without a flow."""
    e = series.embedding
    flow = e.lag > 1 and e.dim > 1
    points = compute_components(series.x, e.window, e.dim) if flow else delay_vectors(series.x, e.lag, e.dim)
    turn = series.period / series.dt if series.period else 0.0
    plane = np.ascontiguousarray(points[:, :PLANE_DIMS].T)
    motion = np.zeros((len(plane) if flow else 0, len(points)))
    motion[:, 1:-1] = plane[: len(motion), 2:] - plane[: len(motion), :-2]
    theiler, turn = max(e.theiler, e.window), turn if turn >= RESOLVED_SAMPLES else 0.0
    return States(points, plane, motion, series.x, series.dt, e.window, theiler, turn, flow)


def compute_components(x: Array, window: int, dim: int) -> Array:
    """Return the first `dim` principal components (n - window + 1, dim) of all windows of x, over sqrt(window).

    BLAS is not used: on a busy machine, starting its threads takes longer than the computation.
    """
    frames = sliding_window_view(x, window)
    some = frames[:: max(1, len(frames) // FRAMES)]
    some = some - some.mean(axis=0)
    own = np.linalg.eigh(np.einsum("ij,ik->jk", some, some))[1][:, ::-1][:, :dim] / np.sqrt(window)
    return np.stack([np.correlate(x, own[:, k], "valid") for k in range(dim)], axis=1)


def measure_unrelated_distance(made: States) -> float:
    """Return the mean distance of unrelated points, at the same drive phase if `locked`."""
    n = len(made.points)
    i = np.arange(1, n - 1, max(1, n // 4000))
    golden = (0.381966 + 0.2360680 * (np.arange(len(i)) * 0.6180339887 % 1.0)) * n
    step = np.round(golden / made.turn) * made.turn if made.locked else golden
    j = np.round(i + step).astype(np.int64)
    if made.locked:
        j = np.where(j < n - 1, j, np.round(i - step).astype(np.int64))
    else:
        j %= n
    good = (j >= 1) & (j < n - 1)
    sums = np.zeros((1, 4, 1))
    follow(made.plane, made.motion, i[good], j[good][:, None, None], (False, False, 0.0, 0.0), sums)
    return float(sums[0, FAR, 0] / max(sums[0, COUNT, 0], 1.0))


def find_neighbours(made: States, wanted: Indices, limit: int, k: int) -> tuple[Indices, float]:
    """Return neighbours (q, k) in different visits, the nearest first and -1 for none, and the share with a repeat."""
    tie = made.tie
    found = np.full((len(wanted), k), -1)
    if made.locked:
        skipped = np.zeros(len(wanted), np.bool_)
        law = (made.turn, made.theiler, tie * tie, limit)
        spread(lambda a, b: find_same_phase(made.points, wanted[a:b], law, found[a:b], skipped[a:b]), len(wanted))
        return found, float(skipped.mean())
    tree = made.tree
    some = wanted[:: max(1, len(wanted) // 300)]
    closest = several(made.points, 1, theiler=made.theiler, norm="euclidean", least=-1.0, queries=some, tree=tree)[1]
    left, many = np.arange(len(wanted)), 3 * k
    while len(left) and many <= 12 * k:
        near, _ = several(
            made.points, many, theiler=made.theiler, norm="euclidean", least=tie, queries=wanted[left], tree=tree
        )
        found[left] = -1
        part = np.full((len(left), k), -1)
        select_visits(near, made.theiler if made.flow else 0, limit, part)
        found[left] = part
        left, many = left[part[:, -1] < 0], 2 * many
    return found, float((closest[:, 0] <= tie).mean())


def choose_horizon(made: States, away: float) -> int:
    """Return for how many samples pairs are followed: until their mean distance is that of `HORIZON_SHARE`, if ever."""
    n = len(made.points)
    most = min(n // 5, max(20 * made.theiler, 10 * made.window, 100))
    wanted = np.linspace(1, n - most - 3, 200).astype(np.int64)
    near, _ = find_neighbours(made, wanted, n - most - 2, 1)
    good = near[:, 0] >= 0
    if not good.any():
        return most
    sums = np.zeros((1, 4, most))
    follow(made.plane, made.motion[:0], wanted[good], near[good, :1, None], (False, False, -1.0, 0.0), sums)
    over = np.nonzero(sums[0, FAR] > HORIZON_SHARE * away * sums[0, COUNT])[0]
    return int(min(most, over[0] + made.smooth + made.window if len(over) else most))


def find_pairs(made: States, steps: int, references: int, k: int) -> Pairs:
    """Return about `references` points, evenly spread over the record, each with k neighbours in groups of one."""
    limit = len(made.points) - steps - 2
    stride = max(1, limit // references)
    wanted = np.arange(1, limit, stride)
    found, repeats = find_neighbours(made, wanted, limit, k)
    return Pairs(wanted, found[:, :, None], limit, repeats)


def estimate_noise(made: States, pairs: Pairs) -> float:
    """Return the standard deviation of white noise in a sample, from third differences of pairs of neighbours.

    The difference of two neighbours is small and smooth, so its third difference is mostly noise. For a map this is
    not possible, and 0 is returned.
    """
    near = pairs.groups[:, 0, 0]
    if not made.flow or made.window < 5:
        return 0.0
    offsets = np.arange(min(made.window, 12))
    i, j = pairs.wanted[near >= 0][:, None] + offsets, near[near >= 0][:, None] + offsets
    third = np.diff(made.x[i] - made.x[j], 3, axis=1)
    return float(np.sqrt((third**2).mean() / 40.0)) if third.size else 0.0


def follow_pairs(made: States, pairs: Pairs, steps: int, *, before: bool = False) -> Spread:
    """Return the sums over pairs that are followed for `steps` samples, by block of the record."""
    away = measure_unrelated_distance(made)
    noise = estimate_noise(made, pairs)
    sums = np.zeros((BLOCKS, pairs.groups.shape[1], 4, steps + 1))
    law = (pairs.grows, before, made.tie**2, 2.0 * noise * noise / (made.window if made.flow else 1))
    ends = np.linspace(0, len(pairs.wanted), BLOCKS + 1).astype(int)

    def work(begin: int, end: int) -> None:
        for b in range(begin, end):
            part = slice(ends[b], ends[b + 1])
            follow(made.plane, made.motion, pairs.wanted[part], pairs.groups[part], law, sums[b])

    spread(work, BLOCKS)
    return Spread(sums, away, noise)
