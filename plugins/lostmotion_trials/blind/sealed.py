"""The sealed data of a blind trial: the truth of each case."""

from __future__ import annotations

from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion_trials.blind.imperfect import World
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.blind.simulator import BlindMachine


@dataclass(frozen=True, kw_only=True)
class SealedMachine(BlindMachine):
    """A machine with the noise of its recording."""

    measurement_noise: float = described("standard deviation of the measurement noise, in SI units")


@dataclass(frozen=True, kw_only=True)
class SealedTruth:
    """The truth of one case: `sealed/NNN.json`."""

    schema: str = described("`lostmotion.sealed/1`")
    case: str = described("name of the case")
    salt: str = described("random bytes, so that a truth cannot be guessed from its digest")
    variant: str = described("kind of the measurement noise: plain, coloured or outliers")
    effects: tuple[Effect, ...] = described("what is hidden in the machine")
    machine: SealedMachine = described("the machine and how it is recorded")
    world: World | None = described("the imperfections of a machine of an imperfect world", default=None)
