"""Deliberately bad plugins: each breaks one rule, and the kit says which."""

import random
from dataclasses import dataclass, replace
from typing import ClassVar

import pytest

from lostmotion import testing
from lostmotion.contracts import DriveTerm, Interface, Model, Motion, Param, SensorTerm, Term
from lostmotion.quantities import DAMPING, INERTIA, NUMBER, TIME

DRAG = Param("coefficient", "drag", DAMPING, low=0.0, null=0.0)
MASS = Param("m", "mass", INERTIA, low=0.0, scale="log")


@dataclass(frozen=True)
class Drag(Term):
    """A good term without states."""

    at: str = "ground"
    name: ClassVar[str] = "drag"
    physics: ClassVar[str] = "Drag of {coefficient} acts"
    formula: ClassVar[str] = "-coefficient * v"
    paper: ClassVar[str] = "Stokes (1851)"
    params = (DRAG,)

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * v


@dataclass(frozen=True)
class Memory(Drag):
    """A good term with a state."""

    name: ClassVar[str] = "memory"
    states = ("held",)

    @staticmethod
    def force(t, x, v, u, p, s):
        return -s[0]

    @staticmethod
    def rate(t, x, v, u, p, s, dsdt):
        dsdt[0] = p[0] * v - s[0]


@dataclass(frozen=True)
class Late(DriveTerm):
    """A good term of the drive."""

    at: str = "drive"
    name: ClassVar[str] = "late"
    physics: ClassVar[str] = "The drive is late by {delay}"
    formula: ClassVar[str] = "u(t - delay)"
    paper: ClassVar[str] = "Ljung (1999)"
    params = (Param("delay", "delay of the drive", TIME, null=0.0),)

    @staticmethod
    def true(u, t, p, order):
        return u(t - p[0], order)


@dataclass(frozen=True)
class Gauge(SensorTerm):
    """A good term of the sensor."""

    at: str = "sensor"
    name: ClassVar[str] = "gauge"
    physics: ClassVar[str] = "The sensor shows too much by {error}"
    formula: ClassVar[str] = "(1 + error) * x"
    paper: ClassVar[str] = "Ljung (1999)"
    params = (Param("error", "error of the gain", NUMBER, null=0.0),)

    @staticmethod
    def gain(p):
        return 1.0 + p[0]


@dataclass(frozen=True)
class Placeless(Term):
    """A term whose place cannot be chosen."""

    at: ClassVar[str] = "ground"
    name: ClassVar[str] = "placeless"
    physics: ClassVar[str] = "Drag of {coefficient} acts"
    formula: ClassVar[str] = "-coefficient * v"
    paper: ClassVar[str] = "Stokes (1851)"
    params = (DRAG,)
    force = Drag.__dict__["force"]


def here(y, u):
    return y[0], y[1]


def elsewhere(y, u):
    return 0.5 * y[0], y[1]


def backwards(y, u):
    return -y[0], -y[1]


def geared(y, u, lever):
    return y[0] - lever * y[2], y[1] - lever * y[3]


@dataclass(frozen=True)
class Cart(Model):
    """A good model."""

    name: ClassVar[str] = "cart"
    paper: ClassVar[str] = "Newton (1687)"
    motion = "translation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position", "velocity")
    params = (MASS,)
    interfaces = (Interface("ground", row=1, inertia="m", motion=here),)

    @staticmethod
    def rhs(t, y, u, p, dydt):
        dydt[0] = y[1]
        dydt[1] = u[0] / p[0]

    @staticmethod
    def observe(t, y, dydt, u, p, seen):
        seen[0] = y[0]
        seen[1] = y[1]


@dataclass(frozen=True)
class Wheels(Model):
    """A good model of two wheels on a table, in translation or rotation."""

    name: ClassVar[str] = "wheels"
    paper: ClassVar[str] = "Newton (1687)"
    motion: Motion = "rotation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity", "second_position", "second_velocity")
    inputs = ("force", "second_force", "base_acceleration")
    channels = ("position", "velocity", "second_position", "second_velocity", "second_acceleration")
    params = (MASS, Param("ratio", "ratio of the gears", NUMBER, low=0.0, scale="log"))
    interfaces = (Interface("mesh", row=1, inertia="m", motion=geared, against=(3, "m"), lever="ratio"),)

    @staticmethod
    def rhs(t, y, u, p, dydt):
        push = y[0] - p[1] * y[2]
        dydt[0] = y[1]
        dydt[1] = (u[0] - push) / p[0] - u[2]
        dydt[2] = y[3]
        dydt[3] = (u[1] + p[1] * push) / p[0] - u[2]

    @staticmethod
    def observe(t, y, dydt, u, p, seen):
        seen[0] = y[0]
        seen[1] = y[1]
        seen[2] = y[2]
        seen[3] = y[3]
        seen[4] = dydt[3] + u[2]


def sees_relative_acceleration(t, y, dydt, u, p, seen):
    seen[0] = y[0]
    seen[1] = y[1]
    seen[2] = y[2]
    seen[3] = y[3]
    seen[4] = dydt[3]


def sees_the_first_wheel_twice(t, y, dydt, u, p, seen):
    seen[0] = y[0]
    seen[1] = y[1]
    seen[2] = y[0]
    seen[3] = y[1]
    seen[4] = dydt[1] + u[2]


def stays(self, motion):
    return self


def adds_up(t, y, u, p, dydt):
    dydt[0] = y[1]
    dydt[1] += u[0] / p[0]


def clears_its_input(t, y, u, p, dydt):
    dydt[0] = y[1]
    dydt[1] = u[0] / p[0]
    y[0] = 0.0


def divides_by_zero(t, y, u, p, dydt):
    dydt[0] = y[1]
    dydt[1] = u[0] / (p[0] - p[0])


def shakes(t, y, u, p, dydt):
    dydt[0] = y[1]
    dydt[1] = u[0] / p[0] + random.random()  # noqa: S311


def makes_text(t, y, u, p, dydt):
    dydt[0] = y[1]
    dydt[1] = float(str(float(u[0] / p[0])))


def sees_half(t, y, dydt, u, p, seen):
    seen[0] = y[0]


def sees_and_changes(t, y, dydt, u, p, seen):
    seen[0] = y[0]
    seen[1] = y[1]
    dydt[1] = 0.0


def pushes_always(t, x, v, u, p, s):
    return 1.0 - p[0] * v


def does_nothing(t, x, v, u, p, s):
    return 0.0 * v


def doubles_its_parameter(p, by):
    return (2.0 * p[0],)


def explodes_at_rest(t, x, v, u, p, s):
    return -p[0] * v / abs(v)


def eats_its_parameter(t, x, v, u, p, s):
    force = -p[0] * v
    p[0] = 0.0
    return force


def trembles(t, x, v, u, p, s):
    return -p[0] * v * random.random()  # noqa: S311


def forgets_an_argument(t, x, v, p, s):
    return -p[0] * v


def makes_text_of_it(t, x, v, u, p, s):
    return -p[0] * float(str(float(v)))


def forgets_a_state(t, x, v, u, p, s, dsdt):
    pass


def ground(**changes):
    return (replace(Cart.interfaces[0], **changes),)


def mesh(**changes):
    return (replace(Wheels.interfaces[0], **changes),)


RANDOM = {"compiles_to_the_same_numbers"}


def shifts_always(u, t, p, order):
    return u(t - p[0] - 1.0, order)


def leaves_as_it_is(u, t, p, order):
    return u(t, order)


def forgets_the_order(u, t, p, order):
    return u(t - p[0], 0)


def shows_twice(p):
    return 2.0


BAD = [
    ("name_is_snake_case", Drag, {"name": "Air Drag"}, set()),
    ("paper_is_cited", Drag, {"paper": ""}, set()),
    ("has_docstring", Drag, {"__doc__": None}, set()),
    ("known_failures_are_named", Drag, {"known_failures": ["has_a_null"]}, set()),
    ("known_failures_are_named", Drag, {"known_failures": {"has_no_null": "a reason"}}, set()),
    ("attributes_are_complete", Cart, {"channels": "abc"}, {"channels_are_named_by_quantity", "bodies_are_shown"}),
    ("methods_have_the_arguments_of_the_contract", Drag, {"force": staticmethod(forgets_an_argument)}, None),
    ("params_are_unique", Cart, {"params": (MASS, replace(MASS, name="mass")), "aliases": {"mass": "m"}}, set()),
    ("params_are_unique", Cart, {"aliases": {"weight": "g"}}, set()),
    ("bounds_are_ordered", Drag, {"params": (replace(DRAG, high=0.0),)}, set()),
    ("dimensions_are_dimensions", Drag, {"params": (replace(DRAG, dimension="N s/m"),)}, set()),
    ("params_have_meanings", Drag, {"params": (replace(DRAG, meaning=" "),)}, set()),
    ("functions_are_static", Drag, {"force": Drag.force}, set()),
    ("states_are_named", Memory, {"states": ("held force",)}, set()),
    ("can_be_pickled", Drag, {}, set()),
    ("motion_is_known", Cart, {"motion": "sideways"}, set()),
    ("motion_is_known", Cart, {"motions": ("rotation",)}, set()),
    ("motion_is_known", Wheels, {"turned": stays}, set()),
    ("inputs_and_channels_are_named", Cart, {"inputs": ("warmth",)}, set()),
    ("inputs_and_channels_are_named", Cart, {"inputs": ("base_position", "force", "base_velocity")}, set()),
    ("inputs_and_channels_are_named", Cart, {"inputs": ("base_position",)}, set()),
    ("channels_are_named_by_quantity", Cart, {"channels": ("position", "velocity", "heat")}, set()),
    ("bodies_are_shown", Cart, {"channels": ("position",), "observe": staticmethod(sees_half)}, set()),
    ("channels_of_states_show_them", Wheels, {"observe": staticmethod(sees_the_first_wheel_twice)}, set()),
    ("channels_are_rates_of_each_other", Wheels, {"observe": staticmethod(sees_relative_acceleration)}, set()),
    ("interfaces_name_rows_and_params", Cart, {"interfaces": ground(row=2)}, set()),
    ("interfaces_name_rows_and_params", Cart, {"interfaces": ground(holds=("x0",))}, set()),
    ("levers_are_numbers", Wheels, {"interfaces": mesh(lever="m")}, set()),
    ("levers_are_numbers", Wheels, {"interfaces": mesh(against=None)}, set()),
    ("interface_force_acts_along_its_motion", Cart, {"interfaces": ground(motion=backwards)}, set()),
    ("interface_force_acts_along_its_motion", Wheels, {"interfaces": mesh(lever=None, motion=here)}, set()),
    ("interface_velocity_is_the_rate_of_its_position", Cart, {"interfaces": ground(motion=elsewhere)}, set()),
    ("rhs_writes_every_entry", Cart, {"rhs": staticmethod(adds_up)}, set()),
    ("rhs_changes_no_argument", Cart, {"rhs": staticmethod(clears_its_input)}, set()),
    ("rhs_is_finite", Cart, {"rhs": staticmethod(divides_by_zero)}, set()),
    ("rhs_is_deterministic", Cart, {"rhs": staticmethod(shakes)}, RANDOM),
    ("observe_writes_every_channel", Cart, {"observe": staticmethod(sees_half)}, set()),
    ("observe_changes_no_argument", Cart, {"observe": staticmethod(sees_and_changes)}, set()),
    ("compiles_to_the_same_numbers", Cart, {"rhs": staticmethod(makes_text)}, set()),
    ("has_a_null", Drag, {"params": (replace(DRAG, null=-1.0),)}, set()),
    ("has_a_null", Drag, {"params": (replace(DRAG, null=None),)}, set()),
    ("physics_names_its_parameters", Drag, {"physics": "Drag of {size} acts"}, set()),
    ("physics_names_its_parameters", Drag, {"physics": "Drag acts"}, set()),
    ("formula_is_written", Drag, {"formula": " "}, set()),
    ("needs_are_names_of_others", Drag, {"needs": ("coefficient",)}, set()),
    ("states_begin_with_sizes", Memory, {"states": {"held": "nothing"}}, set()),
    ("states_and_rate_go_together", Drag, {"states": ("held",)}, set()),
    ("states_and_rate_go_together", Memory, {"states": ()}, set()),
    ("force_is_zero_at_null", Drag, {"force": staticmethod(pushes_always)}, set()),
    ("force_is_zero_at_null", Memory, {"force": staticmethod(pushes_always)}, set()),
    ("force_does_something", Drag, {"force": staticmethod(does_nothing)}, set()),
    ("shifted_moves_the_zero", Drag, {"shifted": staticmethod(doubles_its_parameter)}, set()),
    ("force_is_a_finite_number", Drag, {"force": staticmethod(explodes_at_rest)}, set()),
    ("force_and_rate_change_no_argument", Drag, {"force": staticmethod(eats_its_parameter)}, None),
    ("force_is_deterministic", Drag, {"force": staticmethod(trembles)}, RANDOM),
    ("compiles_to_the_same_numbers", Drag, {"force": staticmethod(makes_text_of_it)}, set()),
    ("rate_writes_every_state", Memory, {"rate": staticmethod(forgets_a_state)}, None),
    ("input_is_as_recorded_at_null", Late, {"true": staticmethod(shifts_always)}, None),
    ("input_is_changed", Late, {"true": staticmethod(leaves_as_it_is)}, set()),
    ("derivative_is_that_of_the_input", Late, {"true": staticmethod(forgets_the_order)}, None),
    ("sensor_is_true_at_null", Gauge, {"gain": staticmethod(shows_twice)}, set()),
]


def spoiled(base, changes):
    cls = type("Spoiled", (base,), {"__doc__": "Spoiled on purpose.", "__module__": __name__, **changes})
    return dataclass(frozen=True)(cls)


def broken_rules(component):
    return {f.rule for f in testing.check(component) if not f.ok}


@pytest.mark.parametrize("component", [Drag, Memory, Cart, Wheels, Wheels("translation"), Drag(at="base")])
def test_good_plugins_keep_every_rule(component):
    assert [str(f) for f in testing.check(component) if not f.ok] == []
    testing.assert_conforms(component)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize(("rule", "base", "changes", "also"), BAD, ids=[f"{b[0]}-{i}" for i, b in enumerate(BAD)])
def test_bad_plugin_fails_the_rule_meant_for_it(rule, base, changes, also):
    """A class made on the fly cannot be pickled; `also` names the rules that must fail with it, None any."""
    broken = broken_rules(spoiled(base, changes))
    assert rule in broken
    if also is not None:
        assert broken - {"can_be_pickled"} == ({rule} | also) - {"can_be_pickled"}


def test_a_class_without_the_decorator_is_found():
    plain = type("Plain", (Drag,), {"__doc__": "Not decorated.", "__module__": __name__})
    assert broken_rules(plain) == {"is_frozen_dataclass"}


def test_a_term_needs_a_place():
    assert broken_rules(Placeless) == {"place_is_a_field"}


def test_every_rule_has_a_bad_plugin_and_advice():
    rules = {rule.name: rule for kind in ("model", "term") for rule in testing.rules_for(kind)}
    assert set(rules) == {bad[0] for bad in BAD} | {"is_frozen_dataclass", "place_is_a_field"}
    assert [name for name, rule in rules.items() if not rule.advice.endswith(".")] == []
