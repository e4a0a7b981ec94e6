"""The tape of a simulator: exact along the path, with the derivatives of the simulator."""

import numpy as np
import pytest
from lostmotion_template.simulators import TwoLink

from lostmotion.errors import CaseError, ContractError
from lostmotion.robots.log import measure_clock, resample
from lostmotion.robots.tape import Path, make_part, make_shares, make_tape, smooth_path
from lostmotion.robots.user import FunctionSimulator
from lostmotion_trials.integrators.arm import Arm, plan_motion

RIGID = Arm(armature=np.zeros(2), damping=np.zeros(2))


def path_of(samples=400, dt=0.002):
    return Path(*plan_motion(np.random.default_rng(3), samples, dt))


def test_along_its_path_it_has_the_torque_of_the_simulator():
    path = path_of()
    tape = make_tape(TwoLink(), path)
    own = RIGID.torque(path.q, path.v, path.a)
    assert np.abs(tape.torque - own).max() < 1e-10 * np.abs(own).max()


def test_beside_its_path_it_is_right_to_second_order():
    path, rng = path_of(), np.random.default_rng(0)
    tape, simulator = make_tape(TwoLink(), path), TwoLink()
    dq, dv = 1e-4 * rng.standard_normal((2, *path.q.shape))
    linear = tape.torque + np.einsum("kij,kj->ki", tape.stiffness, dq) + np.einsum("kij,kj->ki", tape.damping, dv)
    exact = simulator.inverse(path.q + dq, path.v + dv, path.a)
    moved = np.abs(exact - tape.torque).max()
    assert moved > 1e-4
    assert np.abs(linear - exact).max() < 1e-3 * moved


def test_a_payload_is_one_more_linear_part():
    path = path_of()
    tape = make_tape(TwoLink(), path)
    part = make_part(TwoLink(), "tip.payload", tape)
    heavy = make_tape(TwoLink(payload=0.3), path)
    assert np.allclose(tape.mass + 0.3 * part.mass, heavy.mass, rtol=1e-9)
    assert np.allclose(tape.bias + 0.3 * part.bias, heavy.bias, rtol=1e-9, atol=1e-9)


def test_the_shares_of_a_function_are_its_whole_torque():
    path, simulator = path_of(), FunctionSimulator(Arm().torque, ("shoulder", "elbow"))
    tape = make_tape(simulator, path)
    shares = make_shares(simulator, tape)
    whole = sum(part.weigh(path.a) for name, part in shares.items() if name != "shoulder.gravity_elbow")
    assert np.allclose(whole, tape.torque, atol=1e-9 * np.abs(tape.torque).max())
    heavier = FunctionSimulator(lambda q, v, a: 1.02 * Arm().torque(q, v, a), simulator.names)
    assert np.allclose(make_tape(heavier, path).torque - tape.torque, 0.02 * whole, atol=1e-6)


def test_a_log_is_not_read_after_its_last_stamp():
    time = 0.004 * np.arange(300) + 0.0004 * np.random.default_rng(0).random(300)
    time[-1] -= 0.0012
    columns, _ = resample(time, time[:, None], measure_clock(time, "log"), step=False)
    grid = time[0] + measure_clock(time, "log").step * np.arange(len(columns))
    assert np.abs(columns[:, 0] - grid).max() < 1e-5


def test_a_smoothed_path_has_the_derivatives_of_the_true_one():
    path = path_of(2000)
    smooth = smooth_path(path.q + 1e-5 * np.random.default_rng(1).standard_normal(path.q.shape), 0.002)
    inner = slice(20, -20)
    assert np.std((smooth.v - path.v)[inner]) < 0.01 * np.std(path.v)
    assert np.std((smooth.a - path.a)[inner]) < 0.1 * np.std(path.a)


def test_torques_of_another_shape_are_refused_in_words():
    wrong = FunctionSimulator(lambda q, v, a: q[:, :1], ("shoulder", "elbow"))
    with pytest.raises(ContractError, match=r"\(400, 1\) for positions \(400, 2\): return torques"):
        make_tape(wrong, path_of())


def test_a_function_that_raises_is_named():
    def broken(q, v, a):
        raise ZeroDivisionError("no length")

    with pytest.raises(CaseError, match="inverse raised ZeroDivisionError: no length"):
        make_tape(FunctionSimulator(broken, ("shoulder", "elbow")), path_of())
