"""A term in the joint of a chain acts on both bodies: Newton's third law, through the kernel and its slow twin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from field import elsewhere

from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.system import System
from lostmotion_chaos.flows.flow import Harmonic, make_stepped_flow
from lostmotion_plugins.models.clearance_chain import ClearanceChain
from lostmotion_plugins.terms.elastic import CubicStiffness
from lostmotion_plugins.terms.friction import CoulombFriction

BODIES = {"m1": 1.0, "m2": 0.3, "k0": 4e3, "x0": 0.01}
START = np.array([0.0, 2.0, 0.0, -0.5])


def test_friction_in_the_joint_keeps_the_momentum_and_ends_the_relative_motion():
    """Free bodies: they end as one, at the velocity of their centre of mass. The line of friction is as wide as one
    step asks for that moves both bodies, so that it does not swing."""
    system = System.of(ClearanceChain() + CoulombFriction(at="joint"))
    full = system.vector({**BODIES, "coulomb_friction@joint.force": 1.0})
    drive = Drive.smooth([np.zeros_like], 0.25e-3, 16000)
    states = system.simulate(full, system.everything, START, drive).states
    np.testing.assert_allclose(states[:, 1] + 0.3 * states[:, 3], 2.0 - 0.15, rtol=1e-12)
    np.testing.assert_allclose(states[-1, [1, 3]], 1.85 / 1.3, rtol=1e-3)


@pytest.mark.parametrize("compiled", [True, False])
def test_a_spring_in_the_joint_against_another_integrator(compiled):
    def rates(t, y):
        lean = y[0] - y[2]
        push = 4e3 * (lean - min(max(lean, -0.01), 0.01)) + 1e6 * lean**3
        return [y[1], 30.0 * np.cos(40.0 * t) - push, y[3], push / 0.3]

    system = System.of(ClearanceChain() + CubicStiffness(at="joint"))
    values = {**BODIES, "cubic_stiffness@joint.coefficient": 1e6}
    flow = make_stepped_flow(system, values, drive=Harmonic(30.0, 40.0), start=START, steps=1000)
    t = np.linspace(0.0, 2.0 * np.pi / 40.0, 21)
    states = replace(flow, compiled=compiled).sample(START, periods=1, looks=20)
    np.testing.assert_allclose(states, elsewhere(rates, t, START, max_step=1e-3), atol=1e-4)
