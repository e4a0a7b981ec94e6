"""Notes on repetition: equal cycles of a recording, and held-out data that repeat fitted data."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.likelihood.observation import Observation
from lostmotion.results import join_names, rounded
from lostmotion.signals.repetition import SAME, Repetition, repeated_share, repetition_of


@dataclass(frozen=True)
class RepetitionOptions:
    """When cycles of a recording are compared, and when they are equal."""

    longest: int = 50_000
    """Samples of the end of a recording whose cycles are compared."""
    cycles: int = 4
    """A note on equal cycles is written when a recording has at least this number of cycles."""
    distinct: float = 1.5
    """Cycles are equal when fewer than this number are distinct."""
    gaps: float = 0.1
    """Cycles are not compared when more than this share of the readings is missing."""


OPTIONS = RepetitionOptions()


def note_repetitions(
    observations: Sequence[Observation],
    train: Sequence[Observation],
    held: Sequence[Observation],
) -> list[str]:
    """Return notes on whole recordings whose cycles repeat, and on held-out data that repeat what was fitted."""
    return [*_note_repeated_heldout(train, held), *_note_equal_cycles(observations)]


def count_cycles(observation: Observation) -> Repetition | None:
    """Return the number of distinct cycles of the first sensor of a recording; None if it has no cycles."""
    x = _fill_gaps(observation)[-OPTIONS.longest :]
    omega = observation.harmonic.omega
    period = 2.0 * math.pi / (omega * observation.dt) if omega else observation.period
    return repetition_of(x, observation.noise, period)


def compute_repeated_share(train: Iterable[Observation], held: Observation) -> float | None:
    """Return the share (0 to 1) of the variance of held-out data that fitted data of the same channel repeat, or None.

    It is None if there are no comparable data.
    """
    alike = [o for o in train if o.channel == held.channel and math.isclose(o.dt, held.dt, rel_tol=1e-6)]
    shares = [repeated_share(_fill_gaps(o), _fill_gaps(held), max(o.noise, held.noise)) for o in alike]
    return max((share for share in shares if share is not None), default=None)


def _note_repeated_heldout(train: Sequence[Observation], held: Sequence[Observation]) -> list[str]:
    shares = [(o, compute_repeated_share(train, o)) for o in held]
    again = [(o, share) for o, share in shares if share is not None and share > SAME]
    if not again:
        return []
    least = math.floor(1000.0 * min(share for _, share in again)) / 10.0
    names = join_names(list(dict.fromkeys(o.name for o, _ in again)))
    what = "The held-out part repeats" if len(held) == 1 else f"The held-out part of {names} repeats"
    looks = [count_cycles(o) for o, _ in again]
    cyclic = all(one is not None and one.distinct < OPTIONS.distinct for one in looks)
    return [
        f"{what} the motion of the fitted part ({rounded(least, 4)} % of its variance): the"
        " predictions are a test for this"
        f" {'cycle' if cyclic else 'motion'} only."
    ]


def _note_equal_cycles(observations: Sequence[Observation]) -> list[str]:
    """Return a note for each recording whose cycles are equal to within the noise."""
    notes = []
    for observation in observations:
        looks = count_cycles(observation)
        if looks is not None and looks.cycles >= OPTIONS.cycles and looks.distinct < OPTIONS.distinct:
            these = f"The {looks.cycles} cycles of {observation.name}"
            notes.append(
                f"{these} are equivalent to {looks.distinct:.1f} distinct cycles (the mean cycle is"
                f" {rounded(100.0 * looks.share, 4)} % of the variance). More cycles like these only"
                " reduce the noise; record"
                " another level, frequency or waveform to obtain another motion."
            )
    return notes


def _fill_gaps(observation: Observation) -> Array:
    """Return the readings (samples,) of the first sensor with interpolated gaps; all NaN if too many are missing."""
    x = observation.response
    taken = np.isfinite(x)
    if taken.all():
        return x
    if taken.mean() < 1.0 - OPTIONS.gaps:
        return np.full(len(x), np.nan)
    places = np.arange(len(x))
    return np.interp(places, places[taken], x[taken])
