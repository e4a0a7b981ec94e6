"""A set that explains one-step errors and predicts the motion worse is not told."""

from dataclasses import replace

import numpy as np

from lostmotion.robots.arm_search import find_probabilities
from lostmotion.robots.arm_words import find_told
from lostmotion.robots.free_runs import predict_heldout
from lostmotion.robots.refutation import leave_out_refuted
from lostmotion_trials.integrators.arm import Arm

FRICTION = "coulomb_friction@elbow"


def test_a_set_whose_free_runs_are_worse_is_left_out(search_of, helpers):
    """The friction that is there stays; with four times its size, the same set at the same score is refuted."""
    search = search_of(helpers.record(Arm(friction=np.array([0.0, 0.5])), samples=1500), ("coulomb_friction",), most=1)
    assert leave_out_refuted(search).refuted == 0
    told = find_told(search)
    assert told.terms == {FRICTION}
    place = [c.key for c in told.frame.own].index(f"{FRICTION}.force")
    wrong = told.at.copy()
    wrong[place] *= 4.0
    search.found[told.terms] = replace(told, at=wrong)
    assert leave_out_refuted(search).refuted >= 1  # an unknown force over time may be refuted as well
    assert FRICTION not in find_probabilities(search)


def test_a_set_whose_effects_alone_are_worse_is_left_out(search_of, helpers, monkeypatch):
    """Known values that are corrected beside it undo what it does: the simulation that receives it alone is worse."""

    def predict(one, *, alone=False):
        runs = predict_heldout(one, alone=alone)
        return replace(runs, nrmse=1e3 * runs.nrmse) if alone and one.terms else runs

    search = search_of(helpers.record(Arm(friction=np.array([0.0, 0.5])), samples=1500), ("coulomb_friction",), most=1)
    monkeypatch.setattr("lostmotion.robots.refutation.predict_heldout", predict)
    runs = leave_out_refuted(search)
    assert runs.refuted >= 1
    assert FRICTION not in find_probabilities(search)
    assert runs.after_alone is runs.before_alone
