"""A machine that is stepped in NumPy, and the compiled kernel of the same equations: one likelihood."""

from dataclasses import replace

import numpy as np
import pytest
from model_steps import step_model

from lostmotion.case import Prior
from lostmotion.inference.setup import make_posterior
from lostmotion.likelihood.stepped import SteppedSystem, make_system
from lostmotion.likelihood.steps import Steps
from lostmotion.likelihood.tangents import linearise_filter
from lostmotion.notebook.case import Case
from lostmotion.recording import Recording
from lostmotion.registry import default

DT, SAMPLES = 0.01, 150


def push(count=SAMPLES):
    t = np.arange(count) * DT
    return 2.0 * np.sin(3.1 * t) + np.sin(7.7 * t + 1.0)


def case_of(equations, channels, values, estimate, hold="step"):
    """Return the case of noise about nothing in particular: both filter the same numbers."""
    rng = np.random.default_rng(4)
    sensors = {name: scale * (push() + 0.1 * rng.standard_normal(SAMPLES)) for name, (scale, _) in channels.items()}
    units = {"force": "N"} | {name: unit for name, (_, unit) in channels.items()}
    recording = Recording.from_arrays(sensors=sensors, inputs={"force": push()}, rate=1.0 / DT, units=units, hold=hold)
    return Case(recording, equations, values, estimate)


def posteriors(case, terms=(), fine=1):
    """Return the posterior on the compiled kernel, and that on steps of the same model, with the same coordinates."""
    prepared = case.prepare(default(), terms)
    fast = make_posterior(make_system(prepared.model, prepared.terms), prepared.case, prepared.observations, jobs=1)
    stepped = make_system(step_model(prepared.model, fine), prepared.terms)
    assert isinstance(stepped, SteppedSystem)
    return fast.stepped(1), replace(fast, dynamics=Steps(stepped, nsub=1))


SHAKEN = {"acceleration": (1.0, "m/s^2"), "position": (0.1, "m")}
ONE = case_of(
    "m*x'' + c*x' + k*x = force",
    SHAKEN,
    {},
    {"m": Prior(low=0.5, high=2.0), "c": Prior(low=0.1, high=1.0), "k": Prior(low=3.0, high=9.0)},
)
TWO = case_of(
    ["m*x1'' + c*x1' + k*x1 + k2*(x1-x2) = force", "m2*x2'' + c2*x2' - k2*(x1-x2) = 0"],
    SHAKEN | {"x2": (0.1, "m")},
    {"c2": 0.1, "m2": 0.5},
    {"m": Prior(low=0.5, high=2.0), "c": Prior(low=0.1, high=1.0), "k": Prior(low=3.0, high=9.0),
     "k2": Prior(low=1.0, high=4.0)},
)  # fmt: skip


@pytest.mark.parametrize("case", [ONE, TWO], ids=["one body", "two bodies"])
def test_steps_give_the_likelihood_of_the_kernel(case):
    fast, slow = posteriors(case)
    thetas = fast.space.clip(
        fast.space.start + 0.1 * np.random.default_rng(1).standard_normal((5, len(fast.space.start)))
    )
    wanted, found = fast.log_likelihood(thetas), slow.log_likelihood(thetas)
    assert np.isfinite(wanted).all()
    assert found == pytest.approx(wanted, rel=1e-8)


def test_many_points_at_once_are_each_alone():
    _, slow = posteriors(ONE)
    thetas = slow.space.clip(
        slow.space.start + 0.2 * np.random.default_rng(2).standard_normal((4, len(slow.space.start)))
    )
    assert slow.log_likelihood(thetas) == pytest.approx([slow.log_likelihood(t[None])[0] for t in thetas], rel=1e-12)


def test_a_term_acts_at_its_place_as_in_the_kernel():
    """Damping between two bodies, in steps of Heun: the error falls with the square of the step."""
    fast, slow = posteriors(TWO, ("viscous_damping@x1-x2", "cubic_stiffness@x2"))
    values = {"viscous_damping@x1-x2.coefficient": 0.4, "cubic_stiffness@x2.coefficient": 3.0}
    keys = frozenset(key.rpartition(".")[0] for key in values)
    fast, slow = (one.acting(keys).hold_values(values) for one in (fast, slow))
    bare = slow.acting(())
    wanted = fast.log_likelihood(fast.space.start[None])[0]
    gaps = [abs(slow.stepped(n).log_likelihood(slow.space.start[None])[0] - wanted) for n in (1, 4)]
    assert gaps[1] < 0.1 * gaps[0]
    assert gaps[1] < 1e-3 * abs(bare.log_likelihood(bare.space.start[None])[0] - wanted)


def test_smoothed_states_and_the_linearised_filter_are_those_of_the_kernel():
    fast, slow = posteriors(ONE)
    wanted, found = (p.filters[0].smooth(p.space.start) for p in (fast, slow))
    assert found.states == pytest.approx(wanted.states, rel=1e-6, abs=1e-7)
    ways = [linearise_filter(p, p.space.start[None])[0] for p in (fast, slow)]
    unit = np.ones((1, SAMPLES, 2)) * [0.0, 1.0]
    one, other = (way.respond_to_forces(unit, np.zeros((1, SAMPLES, 3))) for way in ways)
    assert other == pytest.approx(one, rel=1e-6, abs=1e-6 * np.abs(one).max())


def test_a_free_run_is_that_of_the_kernel():
    fast, slow = posteriors(TWO, fine=2)
    full, y0 = fast.recordings[0].full(fast.space.start), np.array([0.1, 0.0, -0.1, 0.2])
    drive = fast.observations[0].drive
    wanted = fast.system.simulate(full, (), y0, drive, 2).states
    assert slow.system.simulate(full, (), y0, drive).states == pytest.approx(wanted, abs=1e-12)


def test_the_inertia_at_a_place_is_found_from_steps():
    fast, slow = posteriors(TWO)
    full = fast.recordings[0].full(fast.space.start)
    for place in fast.system.model.places:
        own = next(one for one in slow.system.model.places if one.name == place.name)
        assert slow.system.inertia(full, own) == pytest.approx(fast.system.inertia(full, place), rel=1e-5)
