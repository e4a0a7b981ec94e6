"""A campaign whose posterior is known in closed form; it imports little, so that processes begin soon."""

import os
import signal
import time
from functools import partial

import numpy as np

from lostmotion.inference.ranks import rank_of
from lostmotion.workflow.campaign import Campaign

COUNT = 12


def toy(pause, number):
    """Return a trial: a truth from N(0, 1), and where it lies in the posterior of one noisy look at it."""
    time.sleep(pause)
    rng = np.random.default_rng([3, number])
    truth = rng.standard_normal()
    seen = truth + rng.standard_normal()
    return placed(number, truth, rng.normal(0.5 * seen, 0.5**0.5, (4, 250)))


def whoami(number):
    """Return a trial that tells in which process it was made, and how many threads algebra may take there."""
    return {"number": number, "process": os.getpid(), "threads": os.environ.get("OPENBLAS_NUM_THREADS")}


def deadly(number):
    """Return a trial, but for two whose process the system kills."""
    if number in (2, 5):
        os.kill(os.getpid(), signal.SIGKILL)
    return {"number": number}


def buried(number):
    return {"number": number, "lost": True}


def placed(number, truth, chain):
    low, median, high = np.quantile(chain, [0.025, 0.5, 0.975])
    place = {
        "truth": truth, "drawn": True, "unit": "1", "low": low, "median": median, "high": high, "sd": chain.std(),
        "z": (truth - chain.mean()) / chain.std(), "below": float(np.mean(chain < truth)),
        "rank": rank_of(truth, chain),
    }  # fmt: skip
    return {"machine": number, "status": "ok", "says": "", "parameters": {"a": place}}


def campaign(*, count=COUNT, pause=0.0, identity=None):
    return Campaign(partial(toy, pause), count, identity or {"settings": {"noise": 1.0}, "seed": 3})
