"""The filter of a chain: against plain matrices, differences, and sticking friction."""

import math
from dataclasses import replace

import numpy as np
import pytest

from lostmotion.robots.arm import LAW_STEPS, Column, TapedArm
from lostmotion.robots.arm_effects import measure_scales
from lostmotion.robots.arm_preparation import make_arm
from lostmotion.robots.gears import Gear
from lostmotion.robots.soft_friction import SOFT_FRICTION
from lostmotion_plugins.terms.friction import CoulombFriction, StribeckFriction
from lostmotion_plugins.terms.friction_kinds import FrictionDrift
from lostmotion_trials.integrators.arm import Arm

LEVELS = (np.array([0.1, 0.03]) ** 2 * 0.002, np.array([3e-5, 3e-5]) ** 2)
KEY = "coulomb_friction@elbow.force"


def plain_filter(arm, levels, last):
    """Return the log-likelihood of a Kalman filter with matrices, written after the equations of the tape."""
    log, tape, n = arm.log, arm.tape, 2
    mid = lambda x: np.concatenate([0.5 * (x[:-1] + x[1:]), x[-1:]])  # noqa: E731
    loss, armature = np.diag(arm.get({}, "damping")), np.diag(arm.get({}, "armature"))
    mass, kq, kv = mid(tape.mass) + armature, mid(tape.stiffness), mid(tape.damping)
    bias, q0, v0 = mid(tape.bias), mid(tape.path.q), mid(tape.path.v)
    x = np.concatenate([tape.path.q[0], tape.path.v[0]])
    cov = np.diag([1e-6, 1e-6, 1e-2, 1e-2])
    see, dt, total = np.eye(2, 4), log.dt, 0.0
    for k in range(last):
        spread = see @ cov @ see.T + np.diag(levels[1])
        error = log.readings[k] - see @ x
        if k >= arm.settling:
            total -= 0.5 * (error @ np.linalg.solve(spread, error) + np.linalg.slogdet(2.0 * np.pi * spread)[1])
        gain = cov @ see.T @ np.linalg.inv(spread)
        x, cov = x + gain @ error, cov - gain @ see @ cov
        if k == last - 1:
            break
        full = kv[k] + loss
        w = np.linalg.inv(mass[k] + 0.5 * dt * full)
        middle = x[:n] + 0.5 * dt * x[n:]
        pull = log.torque[k] - bias[k] + kv[k] @ v0[k] - kq[k] @ (middle - q0[k]) - full @ x[n:]
        dv = np.hstack([-dt * w @ kq[k], np.eye(n) - dt * w @ (full + 0.5 * dt * kq[k])])
        move = np.vstack([np.hstack([np.eye(n), 0.5 * dt * np.eye(n)]) + 0.5 * dt * dv, dv])
        speed = x[n:] + dt * w @ pull
        x = np.concatenate([x[:n] + 0.5 * dt * (x[n:] + speed), speed])
        force = w @ np.diag(levels[0] * dt) @ w.T
        noise = np.block([[force * dt * dt / 3.0, force * dt / 2.0], [force * dt / 2.0, force]])
        cov = move @ cov @ move.T + noise
    return total


@pytest.fixture(scope="module")
def empty(make):
    return make(Arm())


@pytest.fixture(scope="module")
def make(helpers):
    return lambda machine, seed=0: make_arm(helpers.make_simulator(), helpers.record(machine, seed))


def test_it_is_a_kalman_filter(empty):
    last = 400
    found = empty.filter({}, (), LEVELS, last=last).seen.log_likelihood
    assert found == pytest.approx(plain_filter(empty, LEVELS, last), abs=1e-6 * abs(found))


def test_one_step_errors_of_the_true_model_are_honest(empty):
    noise = np.array([3e-5, 3e-5]) ** 2
    force = (0.0166 * np.std(empty.log.torque, axis=0)) ** 2 * empty.log.dt
    seen = empty.filter({}, (), (force, noise)).seen
    z = (seen.errors / np.sqrt(seen.variances))[empty.settling :]
    assert np.all(np.abs(z.var(axis=0) - 1.0) < 0.15)
    assert np.all(np.abs([np.corrcoef(z[:-1, j], z[1:, j])[0, 1] for j in range(2)]) < 0.06)


def test_derivatives_over_forces_are_those_of_differences(empty):
    log, last = empty.log, 1500
    wave = np.sin(np.arange(log.samples) * 0.05)
    both = np.stack([wave, 0.3 * wave], axis=1)
    kept = empty.filter({}, (), LEVELS, last=last, keep=True)
    found = empty.differentiate(kept, [Column("one", 1, wave), Column("both", -1, both)], {})
    single = np.stack([0.0 * wave, wave], axis=1)
    for row, force in zip(found, (single, both), strict=True):
        ends = [empty.filter({}, (), LEVELS, last=last, force=s * force).seen.errors for s in (1e-3, -1e-3)]
        difference = ((ends[0] - ends[1]) / 2e-3).ravel()
        assert np.abs(row - difference).max() < 1e-6 * np.abs(difference).max()


def test_derivatives_hold_behind_a_gear(empty):
    gears = {1: Gear(0.0, 2e4)}
    wave = np.cos(np.arange(empty.log.samples) * 0.03)
    kept = empty.filter({}, (), LEVELS, last=800, keep=True, gears=gears)
    row = empty.differentiate(kept, [Column("one", 1, wave)], gears)[0]
    force = np.stack([0.0 * wave, wave], axis=1)
    ends = [empty.filter({}, (), LEVELS, last=800, force=s * force, gears=gears).seen.errors for s in (1e-3, -1e-3)]
    difference = ((ends[0] - ends[1]) / 2e-3).ravel()
    assert np.abs(row - difference).max() < 1e-6 * np.abs(difference).max()


def test_a_force_on_a_link_reaches_its_motor_through_the_gear(empty):
    gears = {1: Gear(0.0, 2e3)}
    wave = np.cos(np.arange(empty.log.samples) * 0.3)
    force = np.stack([0.3 * wave, wave], axis=1)
    kept = empty.filter({}, (), LEVELS, last=800, keep=True, gears=gears)
    row = empty.differentiate(kept, [Column("both", -1, force)], gears)[0]
    wide = np.hstack([np.zeros_like(force), force])
    ends = [empty.filter({}, (), LEVELS, last=800, force=s * wide, gears=gears).seen.errors for s in (1e-3, -1e-3)]
    difference = ((ends[0] - ends[1]) / 2e-3).ravel()
    assert np.abs(row - difference).max() < 1e-6 * np.abs(difference).max()
    at_motor = empty.filter({}, (), LEVELS, last=800, force=1e-3 * force, gears=gears).seen.errors
    assert np.abs(at_motor - ends[0]).max() > 0.1 * np.abs(1e-3 * row).max()


def test_an_unknown_armature_feels_the_acceleration_of_its_motor(empty):
    """The change of one-step errors by 2 % more armature is that of its torque, where a gear is soft."""
    gears, armature = {1: Gear(0.0, 1e3)}, empty.get({}, "armature")[1]
    kept = empty.filter({}, (), LEVELS, keep=True, gears=gears)
    moved = empty.filter({"elbow.armature": 1.02 * armature}, (), LEVELS, gears=gears)
    change = (moved.seen.errors - kept.seen.errors).ravel()
    told = 0.02 * armature * empty.differentiate(kept, [Column("armature", 1, -kept.accelerations[:, 3])], gears)[0]
    assert np.linalg.norm(change - told) < 0.1 * np.linalg.norm(change)


def test_accelerations_have_the_share_of_a_force_that_the_model_lacks(make):
    """Those of the model alone, as predicted from sample to sample, are wrong by the force over the inertia."""
    arm = make(Arm(offset=np.array([0.0, 2.0])))
    kept = arm.filter({}, (), LEVELS, keep=True)
    known = arm.filter({}, (), LEVELS, keep=True, force=np.tile([0.0, 2.0], (arm.log.samples, 1)))
    inner = slice(100, -100)
    apart = np.mean(kept.accelerations[inner] - known.accelerations[inner], axis=0)
    pushed = np.linalg.inv(arm.tape.mass[0] + np.diag(arm.get({}, "armature"))) @ [0.0, 2.0]
    assert abs(pushed[1]) > 5.0
    assert np.abs(apart).max() < 0.1 * abs(pushed[1])


def test_the_damping_of_a_gear_acts_in_the_middle_of_a_step(make, monkeypatch):
    """At its beginning, it made play stiffer in proportion to the step: 6 and 7 nats were lost at the true values."""
    machine = Arm(play=np.array([1e-3, -1.0]), stiffness=np.array([6e4, 5e4]), loss=np.array([30.0, 10.0]))
    for seed in (1, 2):
        arm, told = make(machine, seed), []
        for longest in (0.5, 0.06):
            monkeypatch.setattr("lostmotion.robots.arm.FASTEST", longest)
            told.append(arm.filter({}, (), LEVELS, gears={0: Gear(1e-3, 6e4, 0.112)}).seen.log_likelihood)
        assert abs(told[0] - told[1]) < 3.0


def test_friction_is_most_likely_at_its_true_value(make):
    machine = Arm(friction=np.array([0.0, 0.3]))
    arm, term = make(machine), CoulombFriction(at="elbow")
    told = {f: arm.filter({KEY: f}, (term,), LEVELS).seen.log_likelihood for f in (0.0, 0.27, 0.3, 0.33)}
    assert max(told, key=told.get) == 0.3
    assert told[0.3] - told[0.0] > 500.0


def test_a_law_takes_fine_steps_where_it_is_steep(make, monkeypatch):
    """With fine steps around zero speed alone, 7 and 10 nats were lost in the onset; a flexible gear was named."""
    machine = Arm(friction=np.array([0.0, 0.3]), onset=np.array([2e-4, 0.05]))
    term = replace(SOFT_FRICTION, at="elbow")
    values = {"soft_friction@elbow.force": 0.3, "soft_friction@elbow.velocity": 0.05}
    for seed in (1, 2):
        arm = make(machine, seed)
        told = arm.filter(values, (term,), LEVELS).seen.log_likelihood
        monkeypatch.setattr(TapedArm, "count_steps", lambda *_: LAW_STEPS)
        assert abs(arm.filter(values, (term,), LEVELS).seen.log_likelihood - told) < 2.0
        monkeypatch.undo()


def test_laws_act_at_the_velocity_in_the_middle_of_a_step(make, monkeypatch):
    """At that after a step, the Stribeck velocity of friction was 1.2 % larger than with four times as many steps."""
    arm = make(Arm(friction=np.array([0.0, 0.3]), excess=np.array([0.0, 0.2]), stribeck=np.array([0.05, 0.15])))
    names = [f"stribeck_friction@elbow.{name}" for name in ("force", "excess", "velocity")]
    term, places, found = StribeckFriction(at="elbow"), np.array([0.147, 0.157, 0.167]), []
    for steps in (LAW_STEPS, 4 * LAW_STEPS):
        monkeypatch.setattr("lostmotion.robots.arm.LAW_STEPS", steps)
        told = [
            arm.filter(dict(zip(names, (0.3, 0.2, v), strict=True)), (term,), LEVELS).seen.log_likelihood
            for v in places
        ]
        bend, slope, _ = np.polyfit(places - places[1], told, 2)
        found.append(places[1] - 0.5 * slope / bend)
    assert found[0] == pytest.approx(found[1], rel=0.005)


def test_a_run_that_begins_later_has_the_clock_of_the_log(empty):
    """Friction that rose from 0.1 to 0.3 N m within the first 0.2 s is 0.3 N m in a run that begins at 2 s."""
    drift = {f"friction_drift@elbow.{name}": x for name, x in (("force", 0.1), ("change", 0.2), ("time", 0.05))}
    start = (1000, np.concatenate([empty.tape.path.q[1000], empty.tape.path.v[1000]]), 1e-10 * np.eye(4))
    blind = np.full_like(empty.log.readings, math.nan)
    runs = [
        empty.filter(values, (term,), LEVELS, last=1100, keep=True, readings=blind, start=start).states
        for values, term in ((drift, FrictionDrift(at="elbow")), ({KEY: 0.3}, CoulombFriction(at="elbow")))
    ]
    assert np.abs(runs[0] - runs[1]).max() < 1e-9


def test_a_lasting_time_has_the_scale_of_the_whole_log(empty):
    scales = measure_scales(empty)[1]
    lasting = next(q for q in FrictionDrift.params if q.name == "time")
    assert scales.size(lasting) == pytest.approx(0.3 * empty.log.samples * empty.log.dt)
    assert scales.size(replace(lasting, prior=replace(lasting.prior, lasting=False))) == pytest.approx(
        0.3 * scales.length / scales.speed
    )


def test_a_stiff_gear_is_no_gear(empty):
    plain = empty.filter({}, (), LEVELS, last=1000).seen.log_likelihood
    stiff = empty.filter({}, (), LEVELS, last=1000, gears={0: Gear(0.0, 5e6, 0.5)}).seen.log_likelihood
    soft = empty.filter({}, (), LEVELS, last=1000, gears={0: Gear(0.0, 2e3, 0.05)}).seen.log_likelihood
    assert abs(stiff - plain) < 3.0
    assert soft < plain - 20.0


def test_missing_readings_add_nothing(empty):
    holes = empty.log.readings.copy()
    holes[500:600] = math.nan
    arm = replace(empty, log=replace(empty.log, readings=holes), _cache={})
    seen = arm.filter({}, (), LEVELS, last=1000).seen
    assert np.all(seen.errors[500:600] == 0.0)
    assert math.isfinite(seen.log_likelihood)


def test_a_divergence_has_no_likelihood(empty):
    push = np.full((empty.log.samples, 2), 1e12)
    seen = empty.filter({}, (), LEVELS, last=1000, force=push).seen
    assert seen.log_likelihood == -math.inf
