"""What every figure works with: methods by name, the effort, random streams, and results that figures share."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Flow
from lostmotion.flow import flow_of
from lostmotion.kernels.threads import spread
from lostmotion.registry import Registry

T = TypeVar("T")
LONGEST = 24
"""Periods of the drive after which a periodic motion comes back at the latest."""
SAME = 1e-6
"""Share of the size of a motion within which it has come back."""
NEVER = 0
WARM = 40
WIDE = 1.5


class SampledFlow(Flow, Protocol):
    """A flow that can be looked at within a period."""

    def sample(self, start: Array, *, periods: int, looks: int) -> Array:
        """Return states (periods * looks + 1, n) at `looks` evenly spaced times of each period."""


@dataclass(frozen=True, eq=False)
class FollowedMotions:
    """Motions from some starts: exponents (starts,) in 1/s, period in drive periods (0: none), last states.

    `states` (starts, periods, n) are those at phase 0 behind the transient.
    """

    exponents: Array
    periods: NDArray[np.int64]
    states: Array

    @property
    def chaotic(self) -> NDArray[np.bool_]:
        """Which of the motions do not come back, and part from their neighbours."""
        found: NDArray[np.bool_] = (self.periods == NEVER) & (self.exponents > 0.0)
        return found

    @property
    def bits(self) -> Array:
        """The exponents (starts,) in bit/s."""
        return self.exponents / math.log(2.0)


@dataclass(frozen=True, eq=False)
class Lab:
    """The registry, whether to be quick, the seed, how many cores; and what has been computed already."""

    registry: Registry
    quick: bool = False
    seed: int = 0
    jobs: int = 2
    kept: dict[str, object] = field(default_factory=dict)

    def pick(self, full: T, quick: T) -> T:
        """Return the one or the other effort."""
        return quick if self.quick else full

    def rng(self, stream: str) -> np.random.Generator:
        """Return the random stream of this name: no figure depends on what another has drawn."""
        return np.random.default_rng([self.seed, *stream.encode()])

    def once(self, key: str, make: Callable[[], T]) -> T:
        """Return what `make` gives, made once for all figures."""
        if key not in self.kept:
            self.kept[key] = make()
        return cast("T", self.kept[key])

    def make(self, kind: str, name: str, **options: Any) -> Any:
        """Return a method by its name."""
        return self.registry.make(kind, name, **options)

    def flow(self, model: str, values: Mapping[str, float], drive: tuple[float, float]) -> SampledFlow:
        """Return the flow of a model under a harmonic drive (amplitude, omega)."""
        made = self.once(f"model {model}", lambda: self.make("model", model))
        return cast("SampledFlow", flow_of(made, values, drive=drive))

    def starts(self, flow: SampledFlow, many: int) -> Array:
        """Return starts (many, n): rest, and others drawn evenly from a box around the motion that begins at rest."""
        seen = flow.sample(flow.start, periods=WARM, looks=16)
        reach = WIDE * np.abs(seen).max(axis=0)
        drawn = self.rng("starts").uniform(-1.0, 1.0, (max(many - 1, 0), len(reach))) * reach
        return np.concatenate([flow.start[None], drawn])[:many]

    def follow(self, flow: SampledFlow, starts: Array, *, periods: int, transient: int = 200) -> FollowedMotions:
        """Return the motions from `starts` (k, n), each followed for `periods` behind a transient."""
        exponents, back = np.full(len(starts), np.nan), np.zeros(len(starts), dtype=np.int64)
        states = np.full((len(starts), periods, starts.shape[1]), np.nan)
        for k, start in enumerate(starts):
            orbit = flow.strobe(start, periods=transient + periods, tangents=1)
            exponents[k] = orbit.growth[transient:, 0].mean() / flow.period
            states[k] = orbit.states[transient + 1 :]
            back[k] = period_of(states[k])
        return FollowedMotions(exponents, back, states)

    def spread(self, work: Callable[[int], None], many: int) -> None:
        """Call `work(k)` for k = 0 ... many - 1 on all cores."""

        def piece(begin: int, end: int) -> None:
            for k in range(begin, end):
                work(k)

        spread(piece, many, jobs=self.jobs, slices=many)


def period_of(states: Array) -> int:
    """Return after how many rows the last of `states` (periods, n) come back, or 0 where they do not."""
    last = states[-2 * LONGEST :]
    size = float(np.abs(states).max()) or 1.0
    apart = np.abs(states - states[-1]).max(axis=1) / size
    if not np.isfinite(last).all():
        return NEVER
    for k in range(1, min(LONGEST, len(states) - 1) + 1):
        if apart[-1 - k] < SAME and float(np.abs(last[k:] - last[:-k]).max()) < SAME * size:
            return k
    return NEVER
