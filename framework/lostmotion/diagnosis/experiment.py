"""Design of the next experiment: the excitation that best distinguishes two models that fit the recording equally."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.excitations import Excitation, Limits, choose_limits, list_candidates, repeat_drive
from lostmotion.diagnosis.rehearsal import EvidenceBudget, RehearsedModel, compute_evidence, simulate_recording
from lostmotion.inference.fit import Fit
from lostmotion.kernels.threads import each
from lostmotion.likelihood.observation import Observation

__all__ = [
    "Excitation",
    "Limits",
    "Proposal",
    "choose_limits",
    "compute_bayes_factor",
    "compute_natural_frequency",
    "propose",
]
SAMPLES = 3000
"""The largest number of simulated samples; they are weighted like a recording of the actual length."""
ROUNDS, HALFWAY = 4, 2
"""Rounds of Fisher scoring of a complete and of an incomplete fit."""
MOST_REFINED, MOST_FITTED, DRAWS = 6, 2, 2
"""The number of excitations that are evaluated again with incomplete fits, the number evaluated with complete fits, and
the number of simulated recordings that are averaged for each of the latter."""
PLAIN, IMITATED, CERTAIN = 5.0, 0.2, 12.0
"""One model can imitate the other when the log Bayes factor in favour of the other is never above `PLAIN`, or above the
share `IMITATED` of the opposite one, unless it is above `CERTAIN`."""
Ways = tuple[float, float]
"""The expected log Bayes factor in favour of the true model, if the chosen model is true and if the rival is true."""


@dataclass(frozen=True)
class Proposal:
    """An excitation with its expected log Bayes factor, and that of a repetition of the old excitation.

    `ways` and `repeat_ways` have the gain if the chosen model is true and if the rival is true; `counted` states which
    of the two count: both, unless one model can imitate the other for every excitation.
    """

    excitation: Excitation
    ways: Ways
    repeat_ways: Ways
    counted: tuple[int, ...]

    @property
    def gain(self) -> float:
        """The smaller of the gains that count."""
        return min(self.ways[k] for k in self.counted)

    @property
    def repeat(self) -> float:
        """The smaller of the gains of a repetition that count, at least zero."""
        return max(min(self.repeat_ways[k] for k in self.counted), 0.0)


def propose(
    chosen: Fit,
    rival: Fit,
    *,
    limits: Limits | None = None,
    rng: np.random.Generator,
    say: Callable[[str], None] = lambda _: None,
) -> Proposal | None:
    """Return the excitation within `limits` that distinguishes two fits best; None if every simulation diverges."""
    observation = chosen.posterior.observations[0]
    natural = compute_natural_frequency(chosen)
    samples = min(SAMPLES, observation.samples)
    share = observation.samples / samples
    moved = replace(observation, inputs=observation.inputs[:, : len(chosen.posterior.system.model.driven)])
    offered = list_candidates(moved, samples, limits or choose_limits(observation, natural), rng)
    weighed = _ExperimentComparison((RehearsedModel.of(chosen), RehearsedModel.of(rival)), share, rng)
    say(f"expected gains of {len(offered)} excitations")
    rough = weighed.compute_ways(offered, 0)
    say("expected gains of the best excitations and of a repetition")
    good = weighed.compute_ways([e for e, _ in _select_best(rough, (0, 1), MOST_REFINED, max)], HALFWAY)
    counted = _select_counted([ways for _, ways in good if ways])
    again = [e for e, _ in _select_best(good, counted, MOST_FITTED, min)]
    *fine, (_, repeat) = weighed.average_ways([*again, repeat_drive(observation, samples, natural)])
    found = _select_best(fine, counted, 1, min)
    if not found:
        return None
    best, ways = found[0]
    return Proposal(best, ways or (0.0, 0.0), repeat or (0.0, 0.0), counted)


def compute_natural_frequency(fit: Fit) -> float:
    """Return the rms frequency (Hz) of the recorded motion."""
    return 1.0 / (2.0 * math.pi * fit.posterior.scales.time)


def compute_bayes_factor(chosen: Fit, rival: Fit, observation: Observation) -> float:
    """Return the log Bayes factor, chosen model over rival, that a new recording adds to that of the old ones."""
    natural = compute_natural_frequency(chosen)
    whole = repeat_drive(observation, observation.samples, natural)
    asked = EvidenceBudget(1.0, 3 * ROUNDS)
    evidences = [
        compute_evidence(RehearsedModel.of(fit), whole, observation.readings, asked) for fit in (chosen, rival)
    ]
    return evidences[0] - evidences[1]


@dataclass(frozen=True)
class _ExperimentComparison:
    """Two models that an excitation shall distinguish, with a recording that is `share` times as long."""

    models: tuple[RehearsedModel, RehearsedModel]
    share: float
    rng: np.random.Generator

    def average_ways(self, excitations: Sequence[Excitation]) -> list[_Tried]:
        """Return the gains of each excitation with complete fits, averaged over several simulated recordings."""
        drawn = self.compute_ways([e for e in excitations for _ in range(DRAWS)], ROUNDS)
        drawn_ways = [[ways for _, ways in drawn[k : k + DRAWS] if ways] for k in range(0, len(drawn), DRAWS)]
        means = [
            (float(np.mean([a for a, _ in t])), float(np.mean([b for _, b in t]))) if t else None for t in drawn_ways
        ]
        return list(zip(excitations, means, strict=True))

    def compute_ways(self, excitations: Sequence[Excitation], rounds: int) -> list[_Tried]:
        """Return the gains of each excitation with each model true, or None if a simulation diverges."""
        drawn = [(e, [simulate_recording(truth, e, self.rng) for truth in self.models]) for e in excitations]
        jobs = self.models[0].fit.posterior.jobs
        found = each(lambda one: self._compute_ways(*one, EvidenceBudget(self.share, rounds)), drawn, jobs)
        return list(zip(excitations, found, strict=True))

    def _compute_ways(self, excitation: Excitation, seen: Sequence[Array | None], asked: EvidenceBudget) -> Ways | None:
        gains = []
        for z, truth, other in zip(seen, self.models, self.models[::-1], strict=True):
            gain = math.nan
            if z is not None:
                gain = compute_evidence(truth, excitation, z, asked) - compute_evidence(other, excitation, z, asked)
            if not math.isfinite(gain):
                return None
            gains.append(gain)
        return gains[0], gains[1]


_Tried = tuple[Excitation, Ways | None]


def _select_best(
    tried: Sequence[_Tried], counted: tuple[int, ...], most: int, of: Callable[..., float]
) -> list[_Tried]:
    """Return the best excitations without divergence, by the minimum or maximum (`of`) of the gains that count."""
    through = [(e, ways) for e, ways in tried if ways]
    return sorted(through, key=lambda pair: -of(pair[1][k] for k in counted))[:most]  # type: ignore[return-value]


def _select_counted(found: Sequence[Ways]) -> tuple[int, ...]:
    """Return which true models an experiment can confirm: both, unless one model imitates the other."""
    tops = [max((ways[k] for ways in found), default=0.0) for k in (0, 1)]
    least = [min(max(PLAIN, IMITATED * tops[1 - k]), CERTAIN) for k in (0, 1)]
    shown = tuple(k for k in (0, 1) if tops[k] > least[k])
    return shown or (0, 1)
