"""The largest Lyapunov exponent from one long chain of pairs, as a reference."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.results import Estimate, percent
from lostmotion_chaos.kernels.neighbours import nearest, several
from lostmotion_chaos.quantifiers._kernels_divergence import walk
from lostmotion_chaos.quantifiers.divergence import Indices
from lostmotion_chaos.quantifiers.exponent import UNIT, refuse, refuse_short
from lostmotion_chaos.signals.series import delay_vectors

LEAST_PIECES = 10
"""The least number of pieces of the chain for an interval. Chosen by experience; no measurement recorded."""
MOST_REPEATS = 0.5
"""With a larger share of exact repeats, a record is periodic within the resolution of its sensor. Chosen by experience;
no measurement recorded."""
MOST_DISTANCE = 0.5
"""Pieces that end at a larger share of the rms distance have saturated, and no exponent is read. Chosen by experience;
no measurement recorded."""
JUMP, SUDDEN = 0.1, 0.3
"""Growth is due to noise where it exceeds `JUMP` e-folds in the first half of a piece and the second half adds less
than the share `SUDDEN` of it. Chosen by experience; no measurement recorded."""
REMARK = "For reference: replacing neighbours turns their direction, and the interval does not include this bias."


@dataclass(frozen=True)
class Wolf(Quantifier[Series]):
    """Growth along one chain of replaced neighbours: Wolf, Swift, Swinney, Vastano, Physica D 16 (1985) 285-317.

    A pair is followed for `steps` samples (0: half a delay window), then replaced by the one of `choice` nearest
    neighbours whose direction is closest to the old one's. Repeats, at distance 0, are no neighbours.
    """

    steps: int = 0
    choice: int = 8
    name: ClassVar[str] = "lyapunov_wolf"
    paper: ClassVar[str] = "Wolf, Swift, Swinney, Vastano, Physica D 16 (1985) 285-317"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        if no := refuse_short(data):
            return no
        e = data.embedding
        steps = self.steps or max(1, e.window // 2)
        points = delay_vectors(data.x, e.lag, e.dim)
        tie = 1e-9 * float(data.x.std())
        queries = np.arange(1, len(points) - steps, steps)
        if (repeats := _share_repeats(points, e.theiler, queries, tie)) > MOST_REPEATS:
            return refuse("regular", f"{percent(repeats)} of the points repeat exactly: the motion is periodic.")
        found, _ = several(points, self.choice, theiler=e.theiler, norm="euclidean", least=tie, queries=queries)
        near = np.full((len(points), self.choice), -1)
        near[queries] = found
        room = np.zeros((len(points) // steps + 1, 3))
        gained = room[: walk(points, near, (steps, tie * tie), room)]
        size = float(np.sqrt(2.0 * points.var(axis=0).sum()))
        return _refuse_noise(gained, size) or _average_rates(gained[:, 1] / (steps * data.dt), steps * data.dt)


def _share_repeats(points: Array, theiler: int, queries: Indices, tie: float) -> float:
    """Return the share of points with a repeat that is still a repeat ten pieces later, unlike in chaotic motion."""
    index, far = nearest(points, theiler=theiler, norm="euclidean", least=-1.0, queries=queries)
    step = 10 * int(queries[1] - queries[0]) if len(queries) > 1 else 1
    same = (index >= 0) & (far <= tie) & (np.maximum(index, queries) + step < len(points))
    later = points[queries[same] + step] - points[index[same] + step]
    return float((np.sqrt((later**2).sum(axis=1)) <= tie).sum() / max(len(queries), 1))


def _refuse_noise(gained: Array, size: float) -> Estimate | None:
    """Return a refusal where pairs diverge at once, or have saturated at the end of their piece, as in noise."""
    if len(gained) < LEAST_PIECES:
        return refuse("too_few_neighbours", f"{len(gained)} pairs could be followed, {LEAST_PIECES} are needed.")
    first, whole, far = gained.mean(axis=0)
    if far > MOST_DISTANCE * size:
        return refuse("no_scaling_region", "The distance of neighbours saturates within each piece, as in noise.")
    if first > JUMP and whole - first < SUDDEN * first:
        return refuse("below_noise", "Neighbours diverge at once and then no further, as due to noise.")
    return None


def _average_rates(rates: Array, piece: float) -> Estimate:
    """Return the mean of the rates (1/s) of all pieces, its interval from blocks of them, and the running mean."""
    blocks = np.array([b.mean() for b in np.array_split(rates, min(20, len(rates) // 2))])
    value, wide = float(rates.mean()), 2.1 * float(blocks.std(ddof=1)) / float(np.sqrt(len(blocks)))
    times: Array = piece * np.arange(1.0, len(rates) + 1)
    running = np.cumsum(rates) / np.arange(1, len(rates) + 1)
    curve: dict[str, Array] = {"time": times, "divergence": np.cumsum(rates) * piece, "slope": running}
    return Estimate(value, value - wide, value + wide, "uncertain", UNIT, curve, REMARK, {"pairs": float(len(rates))})
