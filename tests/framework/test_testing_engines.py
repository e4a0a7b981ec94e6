"""A wrong engine breaks the rule of the battery that was written for it; the two built-in ones break none."""

import time
from dataclasses import dataclass, replace

import numpy as np
import pytest

from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.reference import Reference
from lostmotion.testing import check, rules_for

AGREES = "filter_agrees_with_matrices"


@pytest.mark.slow
@pytest.mark.parametrize("engine", [Lanes(), Lanes(compiled=False), Reference()], ids=["lanes", "twin", "reference"])
def test_the_engines_of_the_house_break_no_rule(engine):
    assert [str(f) for f in check(engine) if not f.ok] == []


@dataclass(frozen=True)
class Short(Lanes):
    """Steps too long: the gap is seen too late."""

    def filter(self, dynamics, observation, points):
        return super().filter(replace(dynamics, nsub=1), observation, points)


@dataclass(frozen=True)
class Deaf(Lanes):
    """Takes a held random force for a white one, which an accelerometer does not see."""

    def filter(self, dynamics, observation, points):
        known = replace(dynamics, random="white") if dynamics.random == "held" else dynamics
        return super().filter(known, observation, points)


@dataclass(frozen=True)
class Ungauged(Lanes):
    """Forgets the gain of the sensors."""

    def filter(self, dynamics, observation, points):
        return super().filter(dynamics, observation, replace(points, gain=np.ones(points.gain.shape)))


@dataclass(frozen=True)
class Causal(Lanes):
    """Returns what is known after each sample for what is known after all."""

    def smooth(self, dynamics, observation, points):
        found = super().smooth(dynamics, observation, points)
        return replace(found, states=found.filtered, covariance=found.filtered_covariance)


@dataclass(frozen=True)
class Punctual(Lanes):
    """Begins each free run at the first sample of the drive."""

    def simulate(self, dynamics, points, start, steps, kicks=None):
        return super().simulate(dynamics, replace(points, first=np.zeros_like(points.first)), start, steps, kicks)


@dataclass(frozen=True)
class Sociable(Lanes):
    """Lets the gain of each point feel that of its neighbour, in the last digits."""

    def filter(self, dynamics, observation, points):
        gain = points.gain * (1.0 + 1e-12 * np.roll(points.gain, 1, axis=0))
        return super().filter(dynamics, observation, replace(points, gain=gain))


@dataclass(frozen=True)
class Filling(Lanes):
    """Reads what was not read as zero."""

    def filter(self, dynamics, observation, points):
        return super().filter(dynamics, replace(observation, readings=np.nan_to_num(observation.readings)), points)


@dataclass(frozen=True)
class Raising(Lanes):
    """Raises where a point leaves all numbers."""

    def filter(self, dynamics, observation, points):
        found = super().filter(dynamics, observation, points)
        if not found.finite.all():
            raise FloatingPointError("diverged")
        return found


@dataclass(frozen=True)
class Lasting(Lanes):
    """Calls all points finite."""

    def filter(self, dynamics, observation, points):
        found = super().filter(dynamics, observation, points)
        return replace(found, finite=np.ones_like(found.finite))


_KEPT = {}


@dataclass(frozen=True)
class Sharing(Lanes):
    """Keeps the points of a call where the next one finds them."""

    def filter(self, dynamics, observation, points):
        _KEPT["points"] = points
        time.sleep(0.02)
        return super().filter(dynamics, observation, _KEPT["points"])


WRONG = [
    (Short, AGREES),
    (Deaf, AGREES),
    (Ungauged, AGREES),
    (Causal, "smoother_agrees_with_matrices"),
    (Punctual, "free_run_agrees_with_matrices"),
    (Sociable, "points_do_not_know_each_other"),
    (Filling, "missing_readings_add_nothing"),
    (Raising, "divergence_is_a_status"),
    (Lasting, "divergence_is_a_status"),
    (Sharing, "threads_do_not_disturb_each_other"),
]


@pytest.mark.parametrize(("engine", "broken"), WRONG, ids=[engine.__name__ for engine, _ in WRONG])
def test_a_wrong_engine_breaks_its_rule(engine, broken):
    (rule,) = (rule for rule in rules_for("engine") if rule.name == broken)
    assert not rule(engine()).ok


def test_every_rule_of_behaviour_is_broken_by_some_wrong_engine():
    assert {rule.name for rule in rules_for("engine") if not rule.declaration and not rule.courtesy} == {
        broken for _, broken in WRONG
    }
