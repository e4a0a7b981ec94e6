"""Sets that free runs over held-out data refute: they explain one-step errors, and predict the motion worse."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lostmotion.robots.arm_search import ArmSearch
from lostmotion.robots.arm_words import find_told
from lostmotion.robots.free_runs import HeldOutRuns, predict_heldout

WORSE = 1.1
"""An error of free runs that is larger by a smaller factor is no refutation: beside true small effects it was 1.05."""


class ToldRuns(NamedTuple):
    """Free runs of no effect and of the set that is told, and how many sets were refuted.

    Those `alone` are without the discrepancy: all known values are as in the file.
    """

    before: HeldOutRuns
    after: HeldOutRuns
    before_alone: HeldOutRuns
    after_alone: HeldOutRuns
    refuted: int


def leave_out_refuted(search: ArmSearch) -> ToldRuns:
    """Leave out the sets that would be told and whose free runs are worse than those of no effect; return the runs.

    Where the model is far from the arm, a set with many effects may turn torques into motions that never happen, or
    make up for known values that are corrected beside it: a simulation that receives its effects alone is worse then.
    """
    nothing, count = search.found[frozenset()], 0
    before, before_alone = predict_heldout(nothing), predict_heldout(nothing, alone=True)
    while (told := find_told(search)).terms:
        after, after_alone = predict_heldout(told), predict_heldout(told, alone=True)
        pairs = ((before, after), (before_alone, after_alone))
        if all(np.mean(new.nrmse) <= WORSE * np.mean(old.nrmse) for old, new in pairs):
            return ToldRuns(before, after, before_alone, after_alone, count)
        del search.found[told.terms]
        count += 1
    return ToldRuns(before, before, before_alone, before_alone, count)
