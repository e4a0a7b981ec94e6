"""Pairs of neighbours in delay space, followed in time: what the exponents of Rosenstein and of Kantz are read from.

States are principal components of the delay window (Broomhead, King, Physica D 20 (1986) 217-236), which hold less
noise than the delays themselves. Where a drive period is known, neighbours are sought at the same drive phase, which
is a state of the machine. Of the distance only what stands across the flow is counted.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from lostmotion.contracts import Array, Series
from lostmotion.kernels.neighbours import Tree, grow, several
from lostmotion.kernels.threads import spread
from lostmotion.signals import delay_vectors
from lostmotion_plugins.quantifiers._kernels_divergence import COUNT, FAR, follow, same_phase, visits

Indices = NDArray[np.int64]
FRAMES = 2000
"""Delay windows that the principal components are taken from."""
BLOCKS = 20
"""Pieces of the record that are left out in turn."""
PLAIN = 3
"""Components in which distances are measured: two across the flow, where noise in the mean of a logarithm cancels, as
the logarithm is harmonic in the plane (the mean of ln|d + noise| over a circle of noise is ln|d| outside it)."""
TIES = 1e-9
"""Distances below this share of the usual one are repeats."""
TURNS = 30
"""With fewer drive periods than this, neighbours are sought at all phases."""
SMOOTH = 8
"""Samples in a period from which on a drive is resolved, and may be averaged over."""
HORIZON = 0.55
"""Pairs are followed until their mean distance has come to this share of that of strangers."""


@dataclass(frozen=True, eq=False)
class States:
    """Points (n, dim) to seek neighbours in, and how they are sampled.

    `plane` (<= 3, n) holds their paths, to measure distances in, and `motion` (<= 3, n) the velocities across which
    they are measured, (0, n) for a map. `turn` is the drive period in samples, 0 for none; `flow` whether the motion
    is continuous between samples.
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

        Neighbours part and close up again within each turn, which a short fit takes for growth.
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
        return TIES * self.size

    @cached_property
    def tree(self) -> Tree:
        """The search tree of the points."""
        return grow(self.points)

    @property
    def locked(self) -> bool:
        """Whether neighbours can be sought at the same drive phase."""
        return bool(self.turn) and len(self.points) / self.turn >= TURNS


@dataclass(frozen=True, eq=False)
class Pairs:
    """References (q,) and their neighbours (q, g, m) in groups; `repeats` is the share of references with a tie.

    With `grows` each group holds those before it too.
    """

    wanted: Indices
    groups: Indices
    limit: int
    repeats: float
    grows: bool = False


@dataclass(frozen=True, eq=False)
class Spread:
    """Sums (blocks, g, 4, times) of what `follow` adds up, the distance of strangers, and the noise in one sample."""

    sums: Array
    strangers: float
    noise: float


def states(series: Series) -> States:
    """Return the states of a recording. A delay of one sample means a map: then there is no flow."""
    e = series.embedding
    flow = e.lag > 1 and e.dim > 1
    points = components(series.x, e.window, e.dim) if flow else delay_vectors(series.x, e.lag, e.dim)
    turn = series.period / series.dt if series.period else 0.0
    plane = np.ascontiguousarray(points[:, :PLAIN].T)
    motion = np.zeros((len(plane) if flow else 0, len(points)))
    motion[:, 1:-1] = plane[: len(motion), 2:] - plane[: len(motion), :-2]
    theiler, turn = max(e.theiler, e.window), turn if turn >= SMOOTH else 0.0
    return States(points, plane, motion, series.x, series.dt, e.window, theiler, turn, flow)


def components(x: Array, window: int, dim: int) -> Array:
    """Return the first `dim` principal components (n - window + 1, dim) of all windows of x, over sqrt(window).

    Without BLAS, which on a busy machine takes longer to wake its threads than the work takes.
    """
    frames = sliding_window_view(x, window)
    some = frames[:: max(1, len(frames) // FRAMES)]
    some = some - some.mean(axis=0)
    own = np.linalg.eigh(np.einsum("ij,ik->jk", some, some))[1][:, ::-1][:, :dim] / np.sqrt(window)
    return np.stack([np.correlate(x, own[:, k], "valid") for k in range(dim)], axis=1)


def strangers(made: States) -> float:
    """Return the mean distance of points that have nothing to do with one another, at the same phase if locked."""
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


def neighbours(made: States, wanted: Indices, limit: int, k: int) -> tuple[Indices, float]:
    """Return neighbours (q, k) in different visits, the nearest first, -1 for none, and the share with a repeat."""
    tie = made.tie
    found = np.full((len(wanted), k), -1)
    if made.locked:
        skipped = np.zeros(len(wanted), np.bool_)
        law = (made.turn, made.theiler, tie * tie, limit)
        spread(lambda a, b: same_phase(made.points, wanted[a:b], law, found[a:b], skipped[a:b]), len(wanted))
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
        visits(near, made.theiler if made.flow else 0, limit, part)
        found[left] = part
        left, many = left[part[:, -1] < 0], 2 * many
    return found, float((closest[:, 0] <= tie).mean())


def horizon(made: States, away: float) -> int:
    """Return for how many samples to follow pairs: until they are half as far apart as strangers, if ever."""
    n = len(made.points)
    most = min(n // 5, max(20 * made.theiler, 10 * made.window, 100))
    wanted = np.linspace(1, n - most - 3, 200).astype(np.int64)
    near, _ = neighbours(made, wanted, n - most - 2, 1)
    good = near[:, 0] >= 0
    if not good.any():
        return most
    sums = np.zeros((1, 4, most))
    follow(made.plane, made.motion[:0], wanted[good], near[good, :1, None], (False, False, -1.0, 0.0), sums)
    over = np.nonzero(sums[0, FAR] > HORIZON * away * sums[0, COUNT])[0]
    return int(min(most, over[0] + made.smooth + made.window if len(over) else most))


def sought(made: States, steps: int, references: int, k: int) -> Pairs:
    """Return about `references` points, evenly over the record, each with k neighbours in groups of one."""
    limit = len(made.points) - steps - 2
    stride = max(1, limit // references)
    wanted = np.arange(1, limit, stride)
    found, repeats = neighbours(made, wanted, limit, k)
    return Pairs(wanted, found[:, :, None], limit, repeats)


def noise_between(made: States, pairs: Pairs) -> float:
    """Return the standard deviation of white noise in a sample, from third differences of what parts neighbours.

    The difference of two neighbours is small and smooth, so that its third difference is mostly noise; of a map
    nothing can be said: 0.
    """
    near = pairs.groups[:, 0, 0]
    if not made.flow or made.window < 5:
        return 0.0
    offsets = np.arange(min(made.window, 12))
    i, j = pairs.wanted[near >= 0][:, None] + offsets, near[near >= 0][:, None] + offsets
    third = np.diff(made.x[i] - made.x[j], 3, axis=1)
    return float(np.sqrt((third**2).mean() / 40.0)) if third.size else 0.0


def followed(made: States, pairs: Pairs, steps: int, *, before: bool = False) -> Spread:
    """Return what neighbours do for `steps` samples, in blocks of the record."""
    away = strangers(made)
    noise = noise_between(made, pairs)
    sums = np.zeros((BLOCKS, pairs.groups.shape[1], 4, steps + 1))
    law = (pairs.grows, before, made.tie**2, 2.0 * noise * noise / (made.window if made.flow else 1))
    ends = np.linspace(0, len(pairs.wanted), BLOCKS + 1).astype(int)

    def work(begin: int, end: int) -> None:
        for b in range(begin, end):
            part = slice(ends[b], ends[b + 1])
            follow(made.plane, made.motion, pairs.wanted[part], pairs.groups[part], law, sums[b])

    spread(work, BLOCKS)
    return Spread(sums, away, noise)
