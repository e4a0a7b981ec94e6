"""A wrong running system breaks the rule that was written for it; those of the framework break none."""

import time
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import pytest
import running_rules as rules
from reference import Reference

from lostmotion.likelihood.lanes import Lanes

SLOW = [pytest.param(partial(Lanes, compiled=False), marks=pytest.mark.slow, id="twin"),
        pytest.param(Reference, marks=pytest.mark.slow, id="reference")]  # fmt: skip


def judge(rule, run):
    """Return what a rule finds; an exception is a finding too."""
    try:
        return rule(run)
    except Exception as err:
        return repr(err)


@pytest.mark.parametrize("rule", rules.RULES, ids=lambda rule: rule.__name__)
@pytest.mark.parametrize("run", [pytest.param(Lanes, id="lanes"), *SLOW])
def test_the_running_systems_of_the_framework_break_no_rule(run, rule):
    assert judge(rule, run) == ""


@dataclass(frozen=True)
class Short(Lanes):
    """Steps too long: the gap is seen too late."""

    def filter(self, observation, points):
        return Lanes(self.system, self.active, 1, self.random).filter(observation, points)


@dataclass(frozen=True)
class Deaf(Lanes):
    """Takes a held random force for a white one, which an accelerometer does not see."""

    def filter(self, observation, points):
        random = "white" if self.random == "held" else self.random
        return Lanes(self.system, self.active, self.nsub, random).filter(observation, points)


@dataclass(frozen=True)
class Ungauged(Lanes):
    """Forgets the gain of the sensors."""

    def filter(self, observation, points):
        return super().filter(observation, replace(points, gain=np.ones(points.gain.shape)))


@dataclass(frozen=True)
class Causal(Lanes):
    """Returns what is known after each sample for what is known after all."""

    def smooth(self, observation, points):
        found = super().smooth(observation, points)
        return replace(found, states=found.filtered, covariance=found.filtered_covariance)


@dataclass(frozen=True)
class Punctual(Lanes):
    """Begins each free run at the first sample of the drive."""

    def simulate(self, points, start, steps, kicks=None):
        return super().simulate(replace(points, first=np.zeros_like(points.first)), start, steps, kicks)


@dataclass(frozen=True)
class Sociable(Lanes):
    """Lets the gain of each point feel that of its neighbour, in the last digits."""

    def filter(self, observation, points):
        gain = points.gain * (1.0 + 1e-12 * np.roll(points.gain, 1, axis=0))
        return super().filter(observation, replace(points, gain=gain))


@dataclass(frozen=True)
class Filling(Lanes):
    """Reads what was not read as zero."""

    def filter(self, observation, points):
        return super().filter(replace(observation, readings=np.nan_to_num(observation.readings)), points)


@dataclass(frozen=True)
class Raising(Lanes):
    """Raises where a point leaves all numbers."""

    def filter(self, observation, points):
        found = super().filter(observation, points)
        if not found.finite.all():
            raise FloatingPointError("diverged")
        return found


@dataclass(frozen=True)
class Lasting(Lanes):
    """Calls all points finite."""

    def filter(self, observation, points):
        found = super().filter(observation, points)
        return replace(found, finite=np.ones_like(found.finite))


_KEPT = {}


@dataclass(frozen=True)
class Sharing(Lanes):
    """Keeps the points of a call where the next one finds them."""

    def filter(self, observation, points):
        _KEPT["points"] = points
        time.sleep(0.02)
        return super().filter(observation, _KEPT["points"])


WRONG = [
    (Short, rules.filter_agrees_with_matrices),
    (Deaf, rules.filter_agrees_with_matrices),
    (Ungauged, rules.filter_agrees_with_matrices),
    (Causal, rules.smoother_agrees_with_matrices),
    (Punctual, rules.free_run_agrees_with_matrices),
    (Sociable, rules.points_do_not_know_each_other),
    (Filling, rules.missing_readings_add_nothing),
    (Raising, rules.divergence_is_a_status),
    (Lasting, rules.divergence_is_a_status),
    (Sharing, rules.threads_do_not_disturb_each_other),
]


@pytest.mark.parametrize(("run", "rule"), WRONG, ids=[run.__name__ for run, _ in WRONG])
def test_a_wrong_running_system_breaks_its_rule(run, rule):
    assert judge(rule, run) != ""


def test_every_rule_is_broken_by_some_wrong_system():
    assert {rule for _, rule in WRONG} == set(rules.RULES)
