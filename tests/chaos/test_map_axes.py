"""Axes of a map and the knobs of a rig: what is read from texts, what is set, and what is refused."""

import math

import numpy as np
import pytest

from lostmotion.contracts import Assembly
from lostmotion.errors import CaseError, LostMotionError
from lostmotion.registry import default
from lostmotion_chaos.maps.axes import MapAxis, parse_axis
from lostmotion_chaos.maps.rig import SweptMachine, measure_extent
from lostmotion_chaos.maps.run import Request, make_study

X, Y = "alpha=0.2:0.5:4:inverse", "zeta=0.01:0.04:3"


def rig(swept=("alpha", "zeta"), **fixed):
    """A rig of lin_backlash; a double underscore stands for a dot."""
    told = {name.replace("__", "."): value for name, value in fixed.items()}
    return SweptMachine(Assembly(default().make("model", "lin_backlash")), swept, told).validate()


def test_an_inverse_axis_is_even_in_one_over_it():
    axis = parse_axis("alpha=0.1:0.5:9:inverse")
    assert axis == MapAxis("alpha", 0.1, 0.5, 9, "inverse")
    assert np.diff(1.0 / axis.values) == pytest.approx(np.full(8, -1.0))
    assert (axis.values[0], axis.values[-1]) == (0.1, 0.5)


def test_a_log_axis_is_even_in_the_logarithm():
    assert parse_axis("c=0.01:1:3:log").values == pytest.approx([0.01, 0.1, 1.0])


@pytest.mark.parametrize("text", ["zeta=0.01:0.07:4", "alpha=0.1:0.7:5:inverse", "c=0.3:9:6:log"])
def test_the_points_of_an_axis_are_among_those_of_a_finer_one(text):
    axis = parse_axis(text)
    assert np.array_equal(axis.refine(2).values[::4], axis.values) or axis.spacing != "linear"
    assert axis.refine(2).values[::4] == pytest.approx(axis.values, rel=1e-15)


def test_an_axis_as_text_is_read_as_itself():
    axis = MapAxis("alpha", 0.1, 1.0 / 3.0, 9, "inverse")
    assert parse_axis(axis.as_text()) == axis


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("alpha", "NAME=LOW:HIGH:N"),
        ("alpha=0.1:0.5", "NAME=LOW:HIGH:N"),
        ("alpha=a:0.5:3", "an end of axis alpha is 'a'"),
        ("alpha=0.1:inf:3", "finite"),
        ("alpha=0.1:0.5:3.5", "whole number"),
        ("alpha=0.5:0.1:3", "the lower end first"),
        ("alpha=0.1:0.5:1", "2 to"),
        ("alpha=-1:0.5:3:log", "above zero"),
        ("alpha=0.1:0.5:3:invers", "did you mean 'inverse'"),
    ],
)
def test_what_is_no_axis_is_refused(text, says):
    with pytest.raises(CaseError, match=says):
        parse_axis(text)


def test_the_numbers_of_the_paper_set_the_normalised_machine():
    made = rig()
    assert made.normalised
    assert made.time_unit == "t_bar"
    flow, _ = made.flow({"alpha": 0.5, "zeta": 0.02})
    assert flow.numbers == (1.0, 0.04, 0.0, 1.0, 1.0, 0.5, 0.2, 0.0)


def test_groups_set_a_machine_in_si_units_too():
    """Case 1 of Tjahjowidodo et al. (2007), Table 1: alpha = 0.5, 2 zeta = 0.04 and omega / omega_0 = 0.2."""
    made = rig(("alpha",), m=1.0, k0=4e4, x0=0.005, zeta=0.02, frequency_ratio=0.2)
    assert not made.normalised
    with pytest.raises(CaseError, match=r"drive.omega|frequency_ratio"):
        rig(("alpha",), m=1.0, k0=4e4, x0=0.005, zeta=0.02)
    m, c, k1, k0, x0, amplitude, omega, _ = made.flow({"alpha": 0.5})[0].numbers
    assert (m, c, k1, k0, x0) == pytest.approx((1.0, 8.0, 0.0, 4e4, 0.005))
    assert (amplitude, omega) == pytest.approx((100.0, 40.0))


def test_parameters_of_terms_and_aliases_are_knobs():
    registry = default()
    friction = registry.make("term", "coulomb_friction")
    made = SweptMachine(
        Assembly(registry.make("model", "lin_backlash")) + friction,
        ("coulomb_friction.force",), {"alpha": 0.5, "zeta": 0.02},
    ).validate()  # fmt: skip
    assert made.normalised
    assert made.flow({"coulomb_friction.force": 0.1})[0].period == pytest.approx(10.0 * math.pi)
    assert rig(("damping", "drive.amplitude"), m=1, k0=1, x0=1, drive__omega=0.2).find_knob("damping").key == "c"


@pytest.mark.parametrize(
    ("swept", "fixed", "says"),
    [
        (("alpha",), {}, "zeta is not given"),
        (("zeta",), {}, "alpha is not given"),
        (("alpha", "zeta"), {"c": 1.0}, "both set c"),
        (("alpha", "zeta"), {"drive__amplitude": 1.0}, "both set drive.amplitude"),
        (("alpa", "zeta"), {}, "did you mean 'alpha'"),
        (("alpha", "start.speed"), {"zeta": 0.1}, "has no 'start.speed'"),
        (("c",), {"m": 1.0, "k0": 1.0, "x0": 1.0}, "drive.amplitude is not given"),
    ],
)
def test_knobs_that_contradict_or_are_wanting_are_refused(swept, fixed, says):
    with pytest.raises(CaseError, match=says):
        rig(swept, **fixed)


def test_starts_reach_about_as_far_as_the_motion():
    flow, _ = rig().flow({"alpha": 0.5, "zeta": 0.02})
    assert measure_extent(flow, 40)[0] == pytest.approx(2.0, rel=0.5)
    still, _ = rig().flow({"alpha": 0.0, "zeta": 0.02})
    assert np.array_equal(measure_extent(still, 40), [1.0, 1.0])


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"axes": ()}, "one axis or more"),
        ({"axes": (X, X)}, "name each once"),
        ({"axes": (X, Y), "sets": ("zeta=0.1",)}, "both set c"),
        ({"axes": (X, Y), "drive": "sweep:start=1"}, "no drive with 'sweep'"),
        ({"axes": (X, Y), "drive": "harmonic:rms=1"}, "no drive with 'rms'"),
        ({"axes": (X, Y), "quantities": ("kaplan_york",)}, "did you mean 'kaplan_yorke'"),
        ({"axes": (X, Y), "model": "lin_backlsh"}, "did you mean 'lin_backlash'"),
        ({"axes": (X, "zeta=-0.1:0.1:3")}, "c \\(viscous damping\\) is -0.2"),
        ({"axes": (X, Y), "terms": ("coulomb_friction",)}, "lacks coulomb_friction.force"),
    ],
)
def test_a_request_that_cannot_be_meant_is_refused(asked, says):
    with pytest.raises(LostMotionError, match=says):
        make_study(Request(**{"model": "lin_backlash", **asked}), default())


def test_a_drive_may_be_told_in_hertz():
    request = Request("lin_backlash", (X, Y), drive=f"harmonic:frequency={0.3 / (2 * math.pi)},phase=0.5")
    flow, _ = make_study(request, default()).rig.flow({"alpha": 0.5, "zeta": 0.02})
    assert flow.numbers[6:] == pytest.approx((0.3, 0.5))
