"""Long recordings: terms are searched on stretches of them, then tested and fitted on all samples."""

from __future__ import annotations

from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior

LONG = 12_000
"""From this many samples on, of all recordings together, a search uses stretches of them first."""
STRETCHES, SOUGHT = 4, 8_000
"""The number of stretches of each recording, evenly spread over it, and the samples of all stretches together."""


def cut_stretches(posterior: Posterior) -> Posterior:
    """Return the posterior on stretches of its recordings, or unchanged where they are not long."""
    if posterior.samples <= LONG:
        return posterior
    parts = [part for o in posterior.observations for part in list_stretches(o, SOUGHT / posterior.samples)]
    return posterior.on(tuple(parts))


def list_stretches(observation: Observation, share: float) -> list[Observation]:
    """Return stretches of a recording, the first and the last at its ends, which make up a share of it."""
    long = max(round(share * observation.samples / STRETCHES), 1)
    gap = (observation.samples - long) / (STRETCHES - 1)
    return [observation.part(round(i * gap), round(i * gap) + long) for i in range(STRETCHES)]
