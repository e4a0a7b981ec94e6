"""A machine written down as equations: what is read, what is refused with its place, and that it is a model."""

from __future__ import annotations

import pickle
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lostmotion.case import load_case
from lostmotion.contracts import place_of
from lostmotion.errors import CaseError
from lostmotion.preparation.prepare import case_of
from lostmotion.registry import default
from lostmotion.testing import check
from lostmotion.written import model_of

SHAKEN = "m*(x'' + base_acceleration) + c*x' + k1*x + gap(x, k0, x0) = force"
CHAIN = (
    "m1*x1'' + c1*x1' + k1*x1 + c0*(x1' - x2') + gap(x1 - x2, k0, x0) = force",
    "m2*x2'' + c2*x2' + k2*x2 = c0*(x1' - x2') + gap(x1 - x2, k0, x0) + second_force",
)
EVERY = [
    "m*x'' + c*x' + k*x = force",
    SHAKEN,
    CHAIN,
    "J*th'' + d*th' + T*sin(th) = torque",
    "m*x'' = -k*(x - base_position)",
    "x'' + 2*zeta*w*x' + w^2*x + b*x**3 = force/m",
    "m*x'' + f*sign(x') + stop(x, k, x0) = sat(force, limit)",
]


def derivatives(model, y, u, p):
    """Return what `rhs` and `observe` of a model make of a point."""
    dydt, seen = np.zeros(len(model.states)), np.zeros(len(model.channels))
    type(model).rhs(0.0, y, u, p, dydt)
    type(model).observe(0.0, y, dydt, u, p, seen)
    return dydt, dict(zip(model.channels, seen, strict=True))


def by_name(model, values):
    """Return values in the order in which a model has its parameters."""
    return np.array([values[q.name] for q in model.params])


@pytest.mark.parametrize(("name", "texts"), [("lin_backlash", SHAKEN), ("clearance_chain", CHAIN)])
def test_an_equation_is_the_model_that_was_written_by_hand(name, texts):
    known, made, rng = default().make("model", name), model_of(texts)(), np.random.default_rng(1)
    for _ in range(50):
        y, u = rng.normal(size=len(known.states)), rng.normal(size=len(known.inputs))
        values = {q.name: rng.uniform(0.1, 2.0) for q in known.params}
        pushed = np.array([u[known.inputs.index(i)] for i in made.inputs])
        idle = np.array([x if i in made.inputs else 0.0 for i, x in zip(known.inputs, u, strict=True)])
        one, seen = derivatives(known, y, idle, by_name(known, values))
        other, shown = derivatives(made, y, pushed, by_name(made, values))
        assert np.allclose(one, other, rtol=1e-12, atol=1e-12)
        assert shown["acceleration"] == pytest.approx(seen["acceleration"], rel=1e-12)


@pytest.mark.parametrize("texts", EVERY, ids=str)
def test_a_model_that_is_written_down_keeps_the_contract(texts):
    assert not [finding for finding in check(model_of(texts)) if not finding.ok]


def test_dimensions_follow_from_the_equation():
    made = model_of("m*x'' + c*x' + k*x + k3*x^3 + f*tanh(x'/v) + q*abs(x')*x' = force")()
    units = {q.name: q.dimension.unit(made.motion) for q in made.params}
    assert units == {"m": "kg", "c": "N s/m", "k": "N/m", "k3": "N/m^3", "f": "N", "v": "m/s", "q": "N s^2/m^2"}


def test_an_angle_may_stand_in_a_sine_and_units_tell_the_rest():
    made = model_of("J*a'' + m*g*l*sin(a) = torque", units={"m": "kg", "g": "m/s^2", "l": "m"})()
    units = {q.name: q.dimension.unit(made.motion) for q in made.params}
    assert (made.motions, made.inputs) == (("rotation",), ("force",))
    assert units["J"] == "kg m^2"
    assert units["m"] == "kg"


def test_coordinates_are_channels_and_places():
    made = model_of(CHAIN)()
    assert [i.name for i in made.interfaces] == ["ground", "x2", "x1-x2"]
    assert {"position", "acceleration", "x1", "x2", "x2.velocity", "x2.acceleration"} <= set(made.channels)
    joint = made.interfaces[2]
    assert (joint.row, joint.inertia, joint.against) == (1, "m1", (3, "m2"))
    assert (joint.stiffness, joint.play, joint.holds) == ("k0", "x0", ("k0", "x0"))


def test_terms_that_need_a_gap_act_where_the_equation_has_one():
    made, term = model_of(CHAIN)(), default().load("term", "contact_damping")
    assert place_of(made, term(at="x1-x2")).play == "x0"
    assert not term(at="x2").fits(made)


def test_a_model_goes_to_another_process():
    made = model_of(SHAKEN)().turned("rotation")
    assert pickle.loads(pickle.dumps(made)) == made  # noqa: S301 - our own bytes


REFUSED = {
    "m*x'' + c*x' + k*x": "has the end where an operator or '=' is expected, at character 19",
    "m*x'' + c*x = force + c*x'": "different dimensions, at character 23",
    "m*x'' + $x = force": "has '$', which is not allowed in an equation, at character 9",
    "m*x'' + foo(x) = force": "unknown function 'foo'",
    "m*x'' + gap(x, k) = force": "gives 2 arguments to gap(x, k, x0)",
    "m*sin(x'') = force": "is not linear in x''",
    "m*x' = force": "has no second derivative",
    "(m1 + m2)*x'' = force": "has no single parameter as the mass of x",
    "m*x'' + k*x''' = force": "has the derivative x'''",
    "m*x'' + k' = force": "has the derivative k'",
    "m*x'' + a*b*x = force": "do not determine the units of a, b",
    "m x'' = force": "where an operator or '=' is expected, at character 3",
    "__import__('os').system('true') = m*x''": "which is not allowed in an equation",
    "m*force'' = 1": "has another meaning already",
    "": "is expected, at character 1",
    "m*x'' + 1e999*x = force": "has '1e999', which is not a finite number, at character 9",
    "(" * 60 + "m*x''" + ")" * 60 + " = force": "nests more than",
}


@pytest.mark.parametrize(("text", "says"), REFUSED.items())
def test_what_cannot_be_meant_is_refused_with_its_place(text, says):
    with pytest.raises(CaseError) as err:
        model_of(text)
    assert says in str(err.value)


@pytest.mark.parametrize(
    ("units", "says"),
    [
        ({"m": "N"}, "different dimensions"),
        ({"m": "g"}, "numbers of a case are in SI"),
        ({"q": "kg"}, "not a parameter"),
    ],
)
def test_units_that_cannot_be_meant_are_refused(units, says):
    with pytest.raises(CaseError) as err:
        model_of("m*x'' + c*x' + k*x = force", units=units)
    assert says in str(err.value)


PIECES = (
    "m",
    "*",
    "x''",
    "x'",
    "+",
    "-",
    "k",
    "x",
    "(",
    ")",
    "=",
    "force",
    "^",
    "2",
    "gap(",
    ",",
    "sin(",
    " ",
    "'",
    "1e9",
    "/",
)


@settings(max_examples=300, deadline=None)
@given(st.one_of(st.lists(st.sampled_from(PIECES), max_size=14).map("".join), st.text(max_size=30)))
def test_any_text_is_a_model_or_refused(text):
    with suppress(CaseError):
        assert model_of(text).equations == (text,)


CASE = """
[[recordings]]
file = "run.csv"
rate = 100.0
inputs = [ { input = "force", column = "F", unit = "N" } ]
sensors = [ { channel = "x1", column = "a", unit = "mm" }, { channel = "x2.acceleration", column = "b", unit = "g" } ]
[model]
equations = [
  "m1*x1'' + c*(x1' - x2') + k*(x1 - x2) = force",
  "m2*x2'' = c*(x1' - x2') + k*(x1 - x2)",
]
[model.known]
m1 = 1.0
[model.estimate]
m2 = { low = 0.1, high = 10.0, scale = "log" }
"""


def test_a_case_may_write_its_model_down(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    case, registry = load_case(path), default()
    assert [s.target for s in case.recordings[0].sensors] == ["position", "x2.acceleration"]
    assert [s.name for s in case.recordings[0].sensors] == ["x1", "x2 acceleration"]
    assert registry.make("model", case_of(path, registry).model).coordinates == ("x1", "x2")


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("equations = [", 'name = "lin_backlash"\nequations = [', "both name and equations"),
        ("x1'' +", "x1'' + ?", "has '?', which is not allowed in an equation"),
        ("equations", "equation", "unknown key 'equation'"),
    ],
)
def test_a_case_says_what_is_wrong_with_its_model(tmp_path, old, new, says):
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace(old, new, 1))
    with pytest.raises(CaseError) as err:
        load_case(path)
    assert says in str(err.value)
    assert "case.toml" in str(err.value)
