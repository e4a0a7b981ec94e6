"""What the time steps of the user's simulation cost in log-likelihood, against the exact motion of the same model."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.chain import differentiate_errors
from lostmotion.results.robots import StepCost
from lostmotion.robots.arm_hypothesis import ArmHypothesis
from lostmotion.simulators import Simulator

FINER = 5e-4
"""A finer step (s) whose cost is told as well."""
TOLD = 10.0
"""A cost in log-likelihood above which it is part of the answer."""


def measure_steps(nominal: ArmHypothesis, simulator: Simulator) -> tuple[StepCost, ...]:
    """Return the costs of the simulator's own step and of a finer one; none where it does not integrate.

    From each filtered state one sample is simulated with these steps and exactly. The filter is linear in the
    difference, so that its one-step errors with such a simulation follow from those on the tape, with the same levels
    of noise.
    """
    own = simulator.step
    if own is None or nominal.frame.arm.side != "motor" or nominal.frame.arm.log.controlled:
        return ()
    kept, arm = nominal.kept, nominal.frame.arm
    samples, n = len(kept.states), len(arm.joints)
    q, v = kept.states[:, :n], kept.states[:, n : 2 * n]
    torque = arm.log.drive([], {})[:samples, None]
    exact = simulator.roll(q, v, torque, arm.log.dt)
    found = []
    for step in dict.fromkeys((own, min(own, FINER))):
        rolled = simulator.roll(q, v, torque, arm.log.dt, step=step)
        shift = np.concatenate([one[:, 0] - two[:, 0] for one, two in zip(rolled, exact, strict=True)], axis=1)
        found.append(StepCost(step, _weigh_shift(nominal, shift)))
    return tuple(found)


def _weigh_shift(nominal: ArmHypothesis, shift: np.ndarray) -> float:
    """Return the loss of log-likelihood if each prediction of a state is off by `shift` (samples, 2 n)."""
    kept, arm = nominal.kept, nominal.frame.arm
    moved = np.zeros((1, *kept.gains.shape[:2]))
    none, begins = np.zeros((len(shift), 0, 0)), np.array([0, 1], dtype=np.int64)
    differentiate_errors(
        arm.pick({}), kept.gains, kept.moves, np.ascontiguousarray(shift[:, :, None]), none,
        np.ones((len(shift), 1)), begins, np.zeros((1, kept.gains.shape[1])), moved,
    )  # fmt: skip
    moved[0, : arm.settling] = 0.0
    e, v = kept.seen.errors, kept.seen.variances
    there = np.where(e == 0.0, 0.0, e + moved[0].reshape(e.shape))
    return float(np.sum(0.5 * (there**2 - e**2) / v))


def describe_steps(costs: tuple[StepCost, ...]) -> str:
    """Return the costs in a sentence."""
    if not costs or not all(math.isfinite(one.nats) for one in costs):
        return ""
    first, *finer = costs
    more = "".join(f"; {1e3 * one.step:g} ms costs {one.nats:.0f}" for one in finer)
    return (
        f"Your simulation's step of {1e3 * first.step:g} ms costs {first.nats:.0f} nats of log-likelihood against the"
        f" exact motion of the same model{more}."
    )
