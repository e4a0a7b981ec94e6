"""Posteriors of real machines: the EMPS carriage from two recordings, and a friction damper with a gap from its force.

Real recordings have no truth, and each fact below is about one machine: no chance, no rate of false alarms. The figures
behind the tolerances are those that `benchmarks/real.py` prints.
"""

from __future__ import annotations

import numpy as np
import pytest
from machines import EMPS_FILES, LEVEL, PUBLISHED, damper, emps, travel

from lostmotion.identification.sampling import SamplingPlan
from lostmotion.identification.trajectory import write_warnings

pytestmark = [pytest.mark.real, pytest.mark.slow]
TOLERANCE = {"m": 0.01, "c": 0.08, "coulomb_friction.force": 0.02, "offset_force.force": 0.03}
"""Of the published values, relative; measured: 0.6 %, 6.8 %, 1.3 %, 1.0 % at the most."""
SHORT = SamplingPlan(ess=400.0)


def folder_of(shared, name):
    data = shared / "data" / name
    if not data.is_dir():
        pytest.skip(f"no recordings of {name}: {data} is absent")
    return data


@pytest.fixture(scope="module")
def carriage(shared, tmp_path_factory):
    """The posterior of EMPS from either recording."""
    data = folder_of(shared, "emps")
    return {name: emps(tmp_path_factory.mktemp(name), data, (name,), SHORT) for name in EMPS_FILES}


@pytest.mark.parametrize("name", EMPS_FILES)
def test_the_carriage_is_that_of_the_published_identification(carriage, name):
    seen = carriage[name]
    assert seen.result.converged
    for key, (value, _) in PUBLISHED.items():
        assert seen.result.intervals[key].median == pytest.approx(value, rel=TOLERANCE[key]), key


def test_intervals_of_one_recording_miss_those_of_the_other_and_the_workflow_warns(carriage):
    """What is left over has a memory: viscous friction differs by 12 posterior standard deviations between the
    recordings, and by 1.2 of those that allow for a memory (sandwich); the mass by 8, and by 2.7."""
    one, other = (carriage[name] for name in EMPS_FILES)
    for key, least, most in (("c", 6.0, 2.0), ("m", 4.0, 4.0)):
        difference = abs(one.fit.theta[one.index(key)] - other.fit.theta[other.index(key)])
        usual, robust = (np.hypot(a, b) for a, b in zip(one.deviations(key), other.deviations(key), strict=True))
        assert difference > least * usual, key
        assert difference < most * robust, key
    assert all(write_warnings(seen.fit) for seen in carriage.values())


def test_published_values_lie_within_what_a_memory_allows(carriage):
    """Within 3 of the standard deviations, ours by sandwich and theirs together; measured 2.9 at the most (the mass
    from the pulses)."""
    for seen in carriage.values():
        for key, (value, sd) in PUBLISHED.items():
            at = seen.result.intervals[key].median
            ours = seen.deviations(key)[1] * (at if seen.fit.posterior.space.free[seen.index(key)].log else 1.0)
            assert abs(at - value) < 3.0 * np.hypot(ours, sd), key


@pytest.fixture(scope="module")
def band(shared, tmp_path_factory):
    data = folder_of(shared, "brfd_friction_backlash")
    names = ("d2_0.5Hz_30lb_1in", "d2_0.25Hz_30lb_1in")
    return [damper(tmp_path_factory.mktemp("damper"), data, (name,), SHORT) for name in names]


def test_a_gap_is_found_from_force_over_travel(band):
    """Free runs of the whole recording err by less than a tenth of the scatter of the force (measured: 8 %)."""
    for seen in band:
        assert seen.result.converged
        assert seen.free_error < 0.1
        gap = seen.result.intervals["x0"]
        assert 1.5e-3 < gap.low < gap.high < 2.7e-3
        assert gap.high / gap.low < 1.3


def test_the_travel_to_half_of_the_plateau_is_that_read_off_the_recording(band):
    """0.27 to 0.31 inch, read off the loops without a model; here 2 x0 + 1.5 force / k0."""
    for seen in band:
        low, _, high = np.quantile(travel(seen) / 0.0254, [0.025, 0.5, 0.975])
        assert 0.27 < low < high < 0.31


def test_the_friction_of_the_damper_is_the_level_of_its_plateau(band):
    """30 lb: the medians of the plateaus at 1 Hz are +2.25 and -1.99 kip, 9.4 kN on average; to within 10 %."""
    for seen in band:
        assert seen.result.intervals["dahl_friction.force"].median == pytest.approx(LEVEL, rel=0.1)
