"""Predictions of held-out data: free runs under the recorded torques, begun again at filtered states."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lostmotion.parts import Array
from lostmotion.robots.arm_hypothesis import ArmHypothesis

HORIZON = 0.2
"""The length of a free run (s)."""


@dataclass(frozen=True, eq=False)
class HeldOutRuns:
    """Free runs over held-out data: errors over the standard deviation of each position, (n,), and what they show.

    `white` (n,) is the variance of standardised one-step errors, `shown` (samples, readings) are the predicted readings
    from sample `first` on.
    """

    nrmse: Array
    white: Array
    shown: Array
    floor: Array
    first: int


def predict_heldout(found: ArmHypothesis, *, alone: bool = False) -> HeldOutRuns:
    """Return the predictions of a hypothesis for the samples that no fit has seen.

    With `alone` the runs, but not the states that they begin at, are those of its effects without its discrepancy.
    """
    frame = found.frame
    of_discrepancy = np.arange(len(found.at)) >= len(frame.own)
    at = np.where(of_discrepancy, 0.0, found.at) if alone else found.at
    log, first = frame.arm.log, frame.last
    whole = frame.run(found.at, last=log.samples, keep=True)
    length = max(2, round(HORIZON / log.dt))
    blind = np.full_like(log.readings, np.nan)
    size = whole.states.shape[1]
    picks = frame.arm.pick({e.joint: e.make(found.values) for e in frame.gears})
    shown = np.full((log.samples - first, len(log.picks)), np.nan)
    for begin in range(first, log.samples - length, length):
        start = (begin, whole.states[begin].copy(), 1e-12 * np.eye(size))
        run = frame.run(at, last=begin + length, keep=True, readings=blind, start=start)
        shown[begin - first : begin - first + length] = run.states[:, picks]
    places = [i for i, (_, order) in enumerate(log.picks) if order == 0]
    readings = log.readings[first:]
    left = (readings - shown)[:, places]
    spread = np.nanstd(readings[:, places], axis=0)
    nrmse = np.sqrt(np.nanmean(left**2, axis=0)) / spread
    e, v = whole.seen.errors[first:], whole.seen.variances[first:]
    white = np.mean((e**2 / v)[:, places], axis=0)
    noise = np.array([found.values[c.key] for c in frame.own if c.key.endswith(".position_noise")])
    return HeldOutRuns(nrmse, white, shown, noise / spread, first)
