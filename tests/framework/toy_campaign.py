"""A campaign whose posterior is known in closed form; it imports little, so that processes begin soon."""

import os
import signal
import time
from dataclasses import dataclass
from functools import partial

import numpy as np

from lostmotion.campaigns.campaign import Campaign
from lostmotion_trials.coverage.ranks import compute_rank
from lostmotion_trials.coverage.results import MachineTrial, Sought, Standing

COUNT = 12


HELD, SLOW = 4, 0.5
"""From this trial on each one waits to be let go, and then takes so many seconds."""


@dataclass(frozen=True)
class Maker:
    """In which process a trial was made, and how many threads algebra may take there."""

    number: int
    process: int
    threads: str | None


@dataclass(frozen=True)
class Fate:
    """A trial that ended, or whose process was killed."""

    number: int
    lost: bool = False


def toy(gate, number):
    """Return a trial: a truth from N(0, 1), and where it lies in the posterior of one noisy look at it.

    With a `gate` trials from `HELD` on wait until that file is there, so that a test can be sure to come in between.
    """
    while gate and number >= HELD and not gate.exists():
        time.sleep(0.02)
    time.sleep(SLOW if gate else 0.0)
    rng = np.random.default_rng([3, number])
    truth = rng.standard_normal()
    seen = truth + rng.standard_normal()
    return placed(number, truth, rng.normal(0.5 * seen, 0.5**0.5, (4, 250)))


def whoami(number):
    """Return a trial that tells in which process it was made, and how many threads algebra may take there."""
    return Maker(number, os.getpid(), os.environ.get("OPENBLAS_NUM_THREADS"))


def deadly(number):
    """Return a trial, but for two whose process the system kills."""
    if number in (2, 5):
        os.kill(os.getpid(), signal.SIGKILL)
    return Fate(number)


def buried(number):
    return Fate(number, lost=True)


def placed(number, truth, chain):
    low, median, high = np.quantile(chain, [0.025, 0.5, 0.975])
    z, below = (truth - chain.mean()) / chain.std(), float(np.mean(chain < truth))
    standing = Standing("1", low, median, high, chain.std(), z, below, compute_rank(truth, chain))
    return MachineTrial(number, "ok", "", {"a": Sought(truth, True, standing)})


def campaign(*, count=COUNT, gate=None, identity=None):
    return Campaign(partial(toy, gate), MachineTrial, count, identity or {"settings": {"noise": 1.0}, "seed": 3})


def fall(mark, number):
    """Return a trial; the first worker that makes one of these two is killed in its middle."""
    if number in (1, 4):
        try:
            (mark / str(number)).touch(exist_ok=False)
            os.kill(os.getpid(), signal.SIGKILL)
        except FileExistsError:
            pass
    return toy(None, number)
