"""The rules of a Term."""

from __future__ import annotations

import inspect
import itertools
import math
import string
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from lostmotion.contracts import Array, DriveTerm, SensorTerm, Term
from lostmotion.likelihood.plan import make_law, prepare_values
from lostmotion.quantities import Dimension
from lostmotion.testing.probes import STEP, Point, compile_function, points_of_term, relative_difference
from lostmotion.testing.rules import join_words, rule
from lostmotion.testing.shared_rules import find_repeated

_STEPS = 5
_BY, _SAME_FORCE = 0.37, 1e-9
"""A shift of the zero of the position, and the relative difference of forces by rounding."""


def compute_force(term: Term, point: Point, function: Any = None) -> Any:
    """Return the force at a point."""
    return (function or term.force)(*_force_arguments(term, point))


def compute_rate(term: Term, point: Point, function: Any = None, *, over: float = math.nan) -> Array:
    """Return the time derivative of the own states, written into an array filled with `over`."""
    dsdt = np.full(len(term.states), over)
    rate: Any = function or term.rate
    rate(*_force_arguments(term, point), dsdt)
    return dsdt


def _force_arguments(term: Term, point: Point) -> tuple[Any, ...]:
    return point.t, point.x, point.v, point.u, prepare_values(term, point.p), tuple(point.y)


def _compile_law(term: Term, name: str) -> Any:
    """Return `force` or `rate` compiled; a method gets the numeric fields of the term."""
    law = make_law(term, 0)
    made = compile_function(getattr(type(term), name))
    static = isinstance(inspect.getattr_static(type(term), name), staticmethod)
    return made if static else partial(made, law.fields)


def _evolve_states(term: Term, point: Point) -> Point:
    """Return the point after a few Euler steps of the own states."""
    for _ in range(_STEPS if term.states else 0):
        point.y[:] += STEP * compute_rate(term, point)
    return point


@rule("term", declaration=True)
def has_a_null(term: Term) -> str:
    """Give at least one parameter a `null` within its bounds: the value at which the whole term has no effect."""
    nulls = {q: q.null for q in term.params if q.null is not None}
    if not nulls:
        return "no parameter has a null"
    bad = [q.name for q, null in nulls.items() if not q.low <= null <= q.high]
    return f"the null of {bad[0]} is outside its bounds" if bad else ""


@rule("term", declaration=True)
def physics_names_its_parameters(term: Term) -> str:
    """Write `physics` as a sentence with each parameter that has a null in braces, and no other word in braces."""
    named = {field for _, field, _, _ in string.Formatter().parse(term.physics) if field is not None}
    if unknown := named - {q.name for q in term.params}:
        return f"it names {join_words(sorted(unknown))}, which is not one of its parameters"
    lacking = [q.name for q in term.params if q.null is not None and q.name not in named]
    return f"it leaves out {join_words(lacking)}" if lacking else ""


@rule("term", declaration=True, courtesy=True)
def formula_is_written(term: Term) -> str:
    """Write the law in `formula` as plain text with the names of the parameters: `-coefficient * v`."""
    return "" if term.formula.strip() else "the formula is empty"


@rule("term", declaration=True)
def needs_are_names_of_others(term: Term) -> str:
    """List in `needs` parameters of the model or names in `PSEUDO_NEEDS`, each once, but not the own parameters."""
    own = {q.name for q in term.params}
    again = find_repeated(term.needs) + [n for n in term.needs if n in own or not str(n).isidentifier()]
    return f"{join_words(again)} occurs twice, is an own parameter or is not an identifier" if again else ""


@rule("term", declaration=True)
def states_begin_with_sizes(term: Term) -> str:
    """Give each of `states` no size, a dimension or the name of an own parameter."""
    own = {None, *(q.name for q in term.params)}
    bad = [size for size in term.sizes if not isinstance(size, Dimension) and size not in own]
    return f"{bad[0]!r} is neither a dimension nor one of its parameters" if bad else ""


@rule("term", declaration=True)
def place_is_a_field(term: Any) -> str:
    """Define the field `at: str = "ground"`, with which users choose the place of the term."""
    good = isinstance(getattr(term, "at", None), str) and "at" in {f.name for f in fields(term)}
    return "" if good else "it has no field `at` with the name of a place"


@rule("term", declaration=True)
def states_and_rate_go_together(term: Term) -> str:
    """Define both the own `states` and their `rate`, or neither."""
    has_rate = type(term).rate is not Term.rate
    if has_rate == bool(term.states):
        return ""
    return "it has a rate and no states" if has_rate else f"it has the states {join_words(term.states)} and no rate"


@rule("term")
def force_is_zero_at_null(term: Term) -> str:
    """Return a force of exactly 0 when the parameters with a null are at it, even after states have evolved from 0."""
    for point in points_of_term(term, null=True):
        for p in (point, _evolve_states(term, point)):
            if (force := compute_force(term, p)) != 0.0:
                return f"the force is {force} at x = {p.x:.3g}, v = {p.v:.3g}, p = {p.p}"
    return ""


@rule("term")
def force_does_something(term: Term) -> str:
    """Return a force other than 0 somewhere when the parameters are away from their null."""
    if term.acts != "motion":
        return ""
    forces = [compute_force(term, _evolve_states(term, p)) for p in points_of_term(term)]
    return "" if any(f != 0.0 for f in forces) else f"the force was 0 at each of {len(forces)} points"


@rule("term")
def shifted_moves_the_zero(term: Term) -> str:
    """Return from `shifted` the parameters with which the force at x - by is the one at x, if you override it."""
    if type(term).shifted is Term.shifted:
        return ""
    for point in points_of_term(term):
        own = len(term.params)
        moved = np.array([*term.shifted(tuple(point.p[:own]), _BY), *point.p[own:]])
        here, there = compute_force(term, point), compute_force(term, replace(point, x=point.x - _BY, p=moved))
        if relative_difference(here, there) > _SAME_FORCE:
            return f"the force is {here} at x = {point.x:.3g}, and {there} at x - {_BY} with the shifted parameters"
    return ""


@rule("term")
def force_is_a_finite_number(term: Term) -> str:
    """Return a finite number from `force` for any motion and at rest, when all parameters are near one."""
    rest = [Point(p.t, 0.0 * p.y, p.u, p.p) for p in points_of_term(term)]
    for p in [*points_of_term(term), *rest]:
        force = compute_force(term, p)
        if not isinstance(force, (float, int, np.floating)) or not math.isfinite(force):
            return f"the force is {force} at x = {p.x:.3g}, v = {p.v:.3g}"
    return ""


@rule("term")
def force_and_rate_change_no_argument(term: Term) -> str:
    """Only read `u`, `p` and `s`: the integrator uses them again in the same step."""
    for p in points_of_term(term):
        held = [a.copy() for a in (p.u, p.p, p.y)]
        for call in (compute_force, compute_rate):
            call(term, p)
            if any(not np.array_equal(a, b) for a, b in zip(held, (p.u, p.p, p.y), strict=True)):
                return f"u, p or s was changed by {'force' if call is compute_force else 'rate'}"
    return ""


@rule("term")
def rate_writes_every_state(term: Term) -> str:
    """Write every entry of `dsdt`, with `=` and not with `+=`, with finite numbers: the array contains old values."""
    for p in points_of_term(term):
        over_nan, over_zero = compute_rate(term, p), compute_rate(term, p, over=0.0)
        bad = [s for s, a, b in zip(term.states, over_nan, over_zero, strict=True) if a != b]
        if bad:
            return f"dsdt of {join_words(bad)} is not written, depends on its old value or is not finite"
    return ""


_TIMES = np.linspace(-1.0, 3.0, 41)


def _sample_input(t: Array, order: int) -> Array:
    """Return a recorded input, or its derivative."""
    return np.sin(2.0 * t) if order == 0 else 2.0 * np.cos(2.0 * t)


@rule("term")
def input_is_as_recorded_at_null(term: Term) -> str:
    """Return from `true` the recorded input and its derivative when the parameters with a null are at it."""
    if not isinstance(term, DriveTerm):
        return ""
    for point, order in itertools.product(points_of_term(term, null=True), (0, 1)):
        if not np.array_equal(term.true(_sample_input, _TIMES, tuple(point.p), order), _sample_input(_TIMES, order)):
            return f"the input of order {order} is changed at p = {point.p}"
    return ""


@rule("term")
def input_is_changed(term: Term) -> str:
    """Return from `true` a changed input with finite numbers when the parameters are away from their null."""
    if not isinstance(term, DriveTerm):
        return ""
    made = [term.true(_sample_input, _TIMES, tuple(p.p), 0) for p in points_of_term(term)]
    if not all(m.shape == _TIMES.shape and np.all(np.isfinite(m)) for m in made):
        return "the input does not have one finite number for each time"
    return "" if any(not np.array_equal(m, _sample_input(_TIMES, 0)) for m in made) else "the input is never changed"


@rule("term")
def derivative_is_that_of_the_input(term: Term) -> str:
    """Return from `true` for order 1 the time derivative of the result for order 0, as for a base velocity."""
    if not isinstance(term, DriveTerm):
        return ""
    for point in points_of_term(term):
        p, h = tuple(point.p), 1e-5
        ends = [term.true(_sample_input, _TIMES + side, p, 0) for side in (h, -h)]
        if not np.allclose(
            (ends[0] - ends[1]) / (2.0 * h), term.true(_sample_input, _TIMES, p, 1), rtol=1e-5, atol=1e-5
        ):
            return f"it is not the derivative at p = {point.p}"
    return ""


@rule("term")
def sensor_is_true_at_null(term: Term) -> str:
    """Give exact readings without delay when the parameters with a null are at it, and other readings otherwise."""
    if not isinstance(term, SensorTerm):
        return ""
    for point in points_of_term(term, null=True):
        p = tuple(point.p)
        if not _is_exact(term, p):
            return f"the readings are not exact at p = {point.p}"
    return "" if not all(_is_exact(term, tuple(q.p)) for q in points_of_term(term)) else "the readings are always exact"


def _is_exact(term: SensorTerm, p: tuple[float, ...]) -> bool:
    """Return whether the readings of a sensor are exact and without delay."""
    exact = (term.gain(p), term.offset(p), term.delay(p)) == (1.0, 0.0, 0.0)
    same = (np.array_equal(shown(_TIMES, p), _TIMES) for shown in (term.rounded, term.bent))
    return exact and all(same) and not _lags(term, p)


def _lags(term: SensorTerm, p: tuple[float, ...]) -> bool:
    """Return whether a sensor with states does not reach the exact value within a few steps."""
    if not term.states:
        return False
    point = next(points_of_term(term))
    shown = Point(0.0, np.zeros(len(term.states)), point.u, np.array(p), 1.0, 0.0)
    for _ in range(_STEPS):
        shown.y[:] += STEP * compute_rate(term, shown)
    return bool(abs(shown.y[0] - 1.0) > 1e-6)


@rule("term")
def force_is_deterministic(term: Term) -> str:
    """Make `force` and `rate` depend only on their arguments; a quantity with a memory has to be a state."""
    same = all(
        not relative_difference(compute_force(term, p), compute_force(term, p))
        and not relative_difference(compute_rate(term, p), compute_rate(term, p))
        for p in points_of_term(term)
    )
    return "" if same else "two calls with the same arguments gave different numbers"


@rule("term")
def compiles_to_the_same_numbers(term: Term) -> str:
    """Use only `math`, arithmetic, branches and other such functions: numba must compile them to the same numbers."""
    force, rate = _compile_law(term, "force"), _compile_law(term, "rate") if term.states else term.rate
    for p in points_of_term(term):
        gaps = {
            "force": relative_difference(compute_force(term, p), compute_force(term, p, force)),
            "rate": relative_difference(compute_rate(term, p), compute_rate(term, p, rate)),
        }
        if bad := {name: gap for name, gap in gaps.items() if not gap < 1e-12}:
            return f"compiled and plain differ: {bad}"
    return ""
