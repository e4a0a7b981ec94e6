"""Sets that free runs over held-out data refute: they explain one-step errors, and predict the motion worse."""

from __future__ import annotations

import numpy as np

from lostmotion.robots.arm_search import ArmSearch
from lostmotion.robots.arm_words import find_told
from lostmotion.robots.free_runs import predict_heldout

WORSE = 1.1
"""An error of free runs that is larger by a smaller factor is no refutation: beside true small effects it was 1.05."""


def leave_out_refuted(search: ArmSearch) -> int:
    """Leave out the sets that would be told and whose free runs are worse than those of no effect; return how many.

    Where the model is far from the arm, a set with many effects may turn torques into motions that never happen.
    """
    most = WORSE * float(np.mean(predict_heldout(search.found[frozenset()]).nrmse))
    count = 0
    while (told := find_told(search)).terms and not np.mean(predict_heldout(told).nrmse) <= most:
        del search.found[told.terms]
        count += 1
    return count
