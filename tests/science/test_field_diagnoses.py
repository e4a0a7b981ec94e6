"""What a diagnosis finds that was hidden in models from the field, in recordings that the framework had no part in.

Each is 25 periods or more with 1 % noise, the position alone; all but the chain move in chaos. Truths are asked to lie
within three standard deviations, in recordings that are fixed by their seeds.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from field_recordings import beyond, diagnosed, observation_of, sign

pytestmark = pytest.mark.slow

WELLS = {"m": 1.0, "c": 0.15, "k": -1.0, "k3": 1.0}
TEETH = {"m": 1.0, "c": 0.08, "k0": 1.0, "x0": 1.0, "preload": 0.1, "kappa": 0.0}
STOP = {"m": 1.0, "c": 0.1, "k": 1.0, "k0": 60.0, "x0": 0.05, "loss": 0.1}
CHAIN = {"m1": 1.0, "c1": 1.5, "k1": 300.0, "m2": 0.6, "c2": 0.8, "k2": 50.0, "k0": 900.0, "c0": 0.5, "x0": 0.004}


def wells(friction):
    """Return a recording of a beam that jumps between two wells, with dry friction (N)."""

    def rates(t, y):
        return [y[1], 0.4 * math.cos(t) - 0.15 * y[1] + y[0] - y[0] ** 3 - friction * sign(y[1], 0.5)]

    return observation_of(rates, lambda t: 0.4 * math.cos(t), start=[0.5, 0.1], omega=1.0, periods=35, skip=10)


def teeth(depth):
    """Return a recording of gears that rattle, with a stiffness that pulsates by a share `depth` at a phase of 0.5."""

    def rates(t, y):
        push = 0.1 + 0.4 * math.cos(t) - 0.08 * y[1]
        return [y[1], push - (1.0 + depth * math.cos(t + 0.5)) * beyond(y[0], 1.0)]

    return observation_of(rates, lambda t: 0.4 * math.cos(t), start=[1.2, 0.0], omega=1.0, skip=10)


def stop(friction):
    """Return a recording of a mass that hits a stop, with dry friction (N)."""

    def rates(t, y):
        push = max(60.0 * (y[0] - 0.05) * (1.0 + 0.1 * y[1]), 0.0) if y[0] > 0.05 else 0.0
        return [y[1], math.cos(2.75 * t) - 0.1 * y[1] - y[0] - push - friction * sign(y[1], 0.5)]

    return observation_of(rates, lambda t: math.cos(2.75 * t), start=[0.2, 0.0], omega=2.75, skip=10)


def chain(friction):
    """Return a recording of the first of two bodies, with dry friction (N) at the second, in periodic motion."""

    def rates(t, y):
        joint = 0.5 * (y[1] - y[3]) + 900.0 * beyond(y[0] - y[2], 0.004)
        first = 4.0 * math.cos(14.0 * t) - 1.5 * y[1] - 300.0 * y[0] - joint
        return [y[1], first, y[3], (joint - 0.8 * y[3] - 50.0 * y[2] - friction * sign(y[3], 0.3)) / 0.6]

    return observation_of(rates, lambda t: 4.0 * math.cos(14.0 * t), start=[0.0] * 4, omega=14.0)


SETS = {
    "duffing": (wells, WELLS, {"c": 0.2, "k3": 0.7}, {"coulomb_friction.force": 0.02}),
    "gear_mesh": (
        teeth, TEETH, {"c": 0.1, "x0": 1.3},
        {"parametric_stiffness.cosine": 0.2 * math.cos(0.5), "parametric_stiffness.sine": -0.2 * math.sin(0.5)},
    ),
    "impact_oscillator": (stop, STOP, {"c": 0.15, "k0": 80.0, "x0": 0.07}, {"coulomb_friction.force": 0.04}),
    "clearance_chain": (chain, CHAIN, {"c1": 1.2, "x0": 0.005}, {"coulomb_friction@second.force": 0.15}),
}  # fmt: skip
"""What records it, what is true, what is to be estimated, and what is hidden."""


@pytest.mark.parametrize("model", SETS)
def test_what_is_hidden_is_named_and_measured(model):
    record, values, unknown, hidden = SETS[model]
    observation = record(math.hypot(*hidden.values()))
    found, known = diagnosed(model, values, unknown, observation)
    assert found.found == (next(iter(hidden)).rpartition(".")[0],)
    assert not found.unexplained
    for key, truth in {**hidden, **{k: values[k] for k in unknown}}.items():
        slack = 0.25 * (known[key].high - known[key].low)
        assert known[key].low - slack <= truth <= known[key].high + slack, key
    for key, truth in hidden.items():
        assert known[key].median == pytest.approx(truth, rel=0.1)


@pytest.mark.parametrize("model", SETS)
def test_nothing_is_found_where_nothing_is_hidden(model):
    record, values, unknown, _ = SETS[model]
    found, known = diagnosed(model, values, unknown, record(0.0))
    assert found.found == ()
    assert not found.unexplained
    np.testing.assert_allclose([known[key].median for key in unknown], [values[key] for key in unknown], rtol=0.03)
