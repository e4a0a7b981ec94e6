"""Key figures of the paper from our own runs, against a careful integration that shares no code with ours.

That integration was by RK4 with 300 to 1000 fixed steps a period, with the variational exponent, from 64 starts.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from lostmotion.registry import default
from lostmotion_chaos.flows.flow import flow_of
from lostmotion_chaos.paper import experiment, noisy, portraits, sweeps
from lostmotion_chaos.paper.cases import CASES, PRINTED
from lostmotion_chaos.paper.joint import LEVELS, PAPER, SUSPECT, follow_joint
from lostmotion_chaos.paper.lab import Lab, find_return_period


@pytest.fixture(scope="module")
def lab():
    return Lab(default(), quick=True)


def test_the_cases_in_normalised_form_are_those_of_table_1():
    for case, (damping, alpha, ratio) in {
        1: (0.04, 0.5, 0.2),
        2: (0.0454, 1.548, 0.2272),
        3: (0.0974, 2.4, 0.3602),
    }.items():
        assert CASES[case].damping == pytest.approx(damping, abs=5e-5)
        assert CASES[case].alpha == pytest.approx(alpha, abs=5e-4)
        assert CASES[case].ratio == pytest.approx(ratio, abs=5e-5)


def test_case_1_is_chaotic_at_2_and_periodic_at_2_6_and_at_4_1(lab):
    found = portraits.fig8(lab)
    assert found.verdict == "reproduced in part"
    assert found.numbers["chaotic_share_2"] == 1.0
    # 0.052 bit per unit of normalised time; eight orbits of 400 periods scatter by 2 % around it.
    assert found.numbers["bit_per_time_2"] == pytest.approx(0.052, abs=0.003)
    assert found.numbers["chaotic_share_2.6"] == 0.0
    assert found.numbers["chaotic_share_4.1"] == 0.0


def test_case_2_is_not_chaotic_as_printed(lab):
    assert portraits.fig3(lab).numbers["case2_chaotic_share"] == 0.0


def test_case_2_is_chaotic_at_230_newton(lab):
    found = portraits.follow_motions(lab, replace(CASES[2], amplitude=230.0))
    assert found.bits[found.chaotic].mean() == pytest.approx(4.2, abs=0.4)


def test_case_3_has_a_chaotic_and_a_periodic_attractor(lab):
    found = portraits.fig4(lab).numbers
    assert 0.0 < found["chaotic_share"] < 1.0
    assert 0.5 < found["bit_per_s"] < 0.8
    assert found["periodic_bit_per_s"] == pytest.approx(-0.34, abs=0.01)


def test_case_3_at_1_57_hertz_to_the_last_digit_lies_at_the_edge_of_a_window(lab):
    found = portraits.follow_motions(Lab(default()), replace(CASES[3], omega=PRINTED))
    assert found.bits[found.chaotic].mean() == pytest.approx(0.4, abs=0.05)


def test_chaos_comes_in_the_windows_that_are_known(lab):
    found = sweeps.fig6(lab).numbers
    # Some cells lie at the edges of a window, or in the narrow periodic windows inside.
    assert found["window_1.6"] > 0.7
    assert min(found["window_4.42"], found["window_7.2"], found["window_7.68"], found["window_9"]) > 0.9
    assert found["gap_2.5_to_4.2"] == 0.0
    assert found["near_2_bit_per_time"] == pytest.approx(0.052, abs=0.004)
    assert found["highest_near_4.1"] < 0.0


def test_damping_removes_chaos(lab):
    found = sweeps.fig7(lab).numbers
    assert found["share_0.32"] == 0.0
    assert found["share_0.04"] > 0.5


def test_more_noise_asks_for_more_dimensions(lab):
    found = noisy.fig13(lab).numbers
    assert found["dim_0"] <= 3.0
    assert found["dim_0"] < found["dim_1"] <= found["dim_10"]


def test_noise_reduction_leaves_less_than_half_of_the_noise(lab):
    found = noisy.fig15(lab).numbers
    assert max(found["left_1"], found["left_5"], found["left_10"]) < 0.6


def test_the_joint_is_chaotic_at_the_middle_levels_only(lab):
    for level, paper in zip(LEVELS, PAPER, strict=True):
        found = follow_joint(lab, level)
        assert found.chaotic.all() == (level in SUSPECT), level
        if math.isfinite(paper):
            assert found.bits.mean() == pytest.approx(paper, abs=0.6)


def test_chaos_of_the_joint_is_seen_by_its_encoder(lab):
    found = experiment.fig17(lab).numbers
    assert found["aperiodic_share"] > 3.0 * found["noise_share"]


@pytest.mark.parametrize("period", [1, 3, 7, 24])
def test_a_period_is_found_and_chaos_has_none(period):
    place = np.sin(2.0 * math.pi * np.arange(200) / period + 0.3)
    assert find_return_period(np.column_stack([place, 2.0 * place])) == period
    assert find_return_period(np.random.default_rng(0).standard_normal((200, 2))) == 0


def test_the_joint_is_solved_exactly():
    model, omega = default().make("model", "robot_joint"), 2.0 * math.pi * 1.54
    values = {"m": 0.4, "c": 1.7, "k0": 550.0, "x0": 0.0132, "mgl": 0.0}
    drive = (math.radians(1.34), omega)
    exact, stepped = (flow_of(model, values, drive=drive, steps=steps) for steps in (0, 4000))
    begin = np.array([0.01, -0.2])
    near, far = (flow.sample(begin, periods=4, looks=8) for flow in (exact, stepped))
    assert not hasattr(exact, "steps")
    assert np.abs(near[:, 0] - far[:, 0]).max() < 1e-4 * values["x0"]


def test_a_joint_with_weight_is_not_solved_exactly():
    model = default().make("model", "robot_joint")
    values = {"m": 0.4, "c": 1.7, "k0": 550.0, "x0": 0.0132, "mgl": 0.1}
    assert hasattr(flow_of(model, values, drive=(0.02, 9.0)), "steps")


@pytest.mark.slow
def test_recordings_of_the_joint_show_the_exponents_of_the_model(lab):
    found = experiment.table2(lab).numbers
    for level in LEVELS:
        read, model = found[f"recording_{level:g}"], found[f"model_{level:g}"]
        if level in SUSPECT:
            assert read == pytest.approx(model, abs=0.8)
        else:
            assert not read > 0.0
