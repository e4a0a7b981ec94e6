"""The shared setting of all figures: methods by name, computing effort, random streams, and cached results."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Flow
from lostmotion.kernels.threads import spread
from lostmotion.registry import Registry
from lostmotion_chaos.flows.flow import flow_of

T = TypeVar("T")
LONGEST = 24
"""Longest period of a periodic motion that is looked for, in drive periods."""
SAME = 1e-6
"""Distance, as a share of the largest state, within which a motion has returned."""
NEVER = 0
"""The period of a motion that does not return."""
WARM = 40
"""Drive periods from rest that set the size of the box of starts."""
WIDE = 1.5
"""Half width of the box of starts over the largest state in these periods."""


class SampledFlow(Flow, Protocol):
    """A flow that can be sampled within a period."""

    def sample(self, start: Array, *, periods: int, looks: int) -> Array:
        """Return states (periods * looks + 1, n) at `looks` evenly spaced times of each period."""


@dataclass(frozen=True, eq=False)
class FollowedMotions:
    """Motions from several starts: exponents (starts,) in 1/s and periods (starts,) in drive periods (0: none).

    `states` (starts, periods, n) are the states at phase 0 after the transient.
    """

    exponents: Array
    periods: NDArray[np.int64]
    states: Array

    @property
    def chaotic(self) -> NDArray[np.bool_]:
        """Return which of the motions (starts,) do not return and have a positive exponent."""
        found: NDArray[np.bool_] = (self.periods == NEVER) & (self.exponents > 0.0)
        return found

    @property
    def bits(self) -> Array:
        """Return the exponents (starts,) in bit/s."""
        return self.exponents / math.log(2.0)


@dataclass(frozen=True, eq=False)
class Lab:
    """The registry, the effort (`quick`), the seed, the number of cores (`jobs`), and cached results (`kept`)."""

    registry: Registry
    quick: bool = False
    seed: int = 0
    jobs: int = 2
    kept: dict[str, object] = field(default_factory=dict)

    def pick(self, full: T, quick: T) -> T:
        """Return the value for the full or for the quick effort."""
        return quick if self.quick else full

    def make_rng(self, stream: str) -> np.random.Generator:
        """Return the random generator of this name, so that no figure depends on the random numbers of another."""
        return np.random.default_rng([self.seed, *stream.encode()])

    def compute_once(self, key: str, make: Callable[[], T]) -> T:
        """Return the result of `make`, which is called once for all figures."""
        if key not in self.kept:
            self.kept[key] = make()
        return cast("T", self.kept[key])

    def make(self, kind: str, name: str, **options: Any) -> Any:
        """Return a method by its name."""
        return self.registry.make(kind, name, **options)

    def make_flow(self, model: str, values: Mapping[str, float], drive: tuple[float, float]) -> SampledFlow:
        """Return the flow of a model under a harmonic drive (amplitude, omega)."""
        made = self.compute_once(f"model {model}", lambda: self.make("model", model))
        return cast("SampledFlow", flow_of(made, values, drive=drive))

    def draw_starts(self, flow: SampledFlow, many: int) -> Array:
        """Return starts (many, n): rest, and random starts from a box around the motion that begins at rest."""
        seen = flow.sample(flow.start, periods=WARM, looks=16)
        reach = WIDE * np.abs(seen).max(axis=0)
        drawn = self.make_rng("starts").uniform(-1.0, 1.0, (max(many - 1, 0), len(reach))) * reach
        return np.concatenate([flow.start[None], drawn])[:many]

    def follow(self, flow: SampledFlow, starts: Array, *, periods: int, transient: int = 200) -> FollowedMotions:
        """Return the motions from `starts` (k, n), each followed for `periods` after a transient (drive periods)."""
        exponents, back = np.full(len(starts), np.nan), np.zeros(len(starts), dtype=np.int64)
        states = np.full((len(starts), periods, starts.shape[1]), np.nan)
        for k, start in enumerate(starts):
            orbit = flow.strobe(start, periods=transient + periods, tangents=1)
            exponents[k] = orbit.growth[transient:, 0].mean() / flow.period
            states[k] = orbit.states[transient + 1 :]
            back[k] = find_return_period(states[k])
        return FollowedMotions(exponents, back, states)

    def spread(self, work: Callable[[int], None], many: int) -> None:
        """Call `work(k)` for k = 0 ... many - 1 on all cores."""

        def piece(begin: int, end: int) -> None:
            for k in range(begin, end):
                work(k)

        spread(piece, many, jobs=self.jobs, slices=many)


def find_return_period(states: Array) -> int:
    """Return after how many drive periods the last of `states` (periods, n) return, or 0 if they do not."""
    last = states[-2 * LONGEST :]
    size = float(np.abs(states).max()) or 1.0
    apart = np.abs(states - states[-1]).max(axis=1) / size
    if not np.isfinite(last).all():
        return NEVER
    for k in range(1, min(LONGEST, len(states) - 1) + 1):
        if apart[-1 - k] < SAME and float(np.abs(last[k:] - last[:-k]).max()) < SAME * size:
            return k
    return NEVER
