"""The rules of a Term."""

from __future__ import annotations

import inspect
import itertools
import math
import string
from dataclasses import fields
from functools import partial
from typing import Any

import numpy as np

from lostmotion.contracts import Array, DriveTerm, SensorTerm, Term
from lostmotion.likelihood.plan import make_law, prepare_values
from lostmotion.testing.probes import STEP, Point, compiled, differ, of_term
from lostmotion.testing.rules import SNAKE, listed, rule
from lostmotion.testing.shared import repeated

_STEPS = 5


def pull(term: Term, point: Point, function: Any = None) -> Any:
    """Return the force at a point."""
    return (function or term.force)(*_arguments(term, point))


def pace(term: Term, point: Point, function: Any = None, *, over: float = math.nan) -> Array:
    """Return the time derivative of the own states, written over `over`."""
    dsdt = np.full(len(term.states), over)
    rate: Any = function or term.rate
    rate(*_arguments(term, point), dsdt)
    return dsdt


def _arguments(term: Term, point: Point) -> tuple[Any, ...]:
    return point.t, point.x, point.v, point.u, prepare_values(term, point.p), tuple(point.y)


def _fast(term: Term, name: str) -> Any:
    """Return `force` or `rate` compiled, with the fields of the term where it reads them."""
    law = make_law(term, 0)
    made = compiled(getattr(type(term), name))
    static = isinstance(inspect.getattr_static(type(term), name), staticmethod)
    return made if static else partial(made, law.fields)


def _walked(term: Term, point: Point) -> Point:
    """Return the point after a few Euler steps of the own states."""
    for _ in range(_STEPS if term.states else 0):
        point.y[:] += STEP * pace(term, point)
    return point


@rule("term", declaration=True)
def has_a_null(term: Term) -> str:
    """Give at least one parameter a `null` within its bounds: the value at which the whole term does nothing."""
    nulls = {q: q.null for q in term.params if q.null is not None}
    if not nulls:
        return "no parameter has a null"
    bad = [q.name for q, null in nulls.items() if not q.low <= null <= q.high]
    return f"the null of {bad[0]} is outside of its bounds" if bad else ""


@rule("term", declaration=True)
def physics_names_its_parameters(term: Term) -> str:
    """Write `physics` as a sentence that has every parameter with a null in braces, and no other word in braces."""
    named = {field for _, field, _, _ in string.Formatter().parse(term.physics) if field is not None}
    if unknown := named - {q.name for q in term.params}:
        return f"it names {listed(sorted(unknown))}, which is no parameter of its own"
    lacking = [q.name for q in term.params if q.null is not None and q.name not in named]
    return f"it leaves out {listed(lacking)}" if lacking else ""


@rule("term", declaration=True, courtesy=True)
def formula_is_written(term: Term) -> str:
    """Write the law in `formula` as plain text, in the names of the parameters: `-coefficient * v`."""
    return "" if term.formula.strip() else "the formula is empty"


@rule("term", declaration=True)
def needs_are_names_of_others(term: Term) -> str:
    """List in `needs` parameters of the model, or `step` or `mobility`, each once; own ones come by themselves."""
    own = {q.name for q in term.params}
    again = repeated(term.needs) + [n for n in term.needs if n in own or not str(n).isidentifier()]
    return f"{listed(again)} stands twice, is its own or is no name" if again else ""


@rule("term", declaration=True)
def motions_are_known(term: Term) -> str:
    """List in `motions` one or both of "translation" and "rotation"."""
    good = term.motions and set(term.motions) <= {"translation", "rotation"}
    return "" if good else f"the motions are {term.motions!r}"


@rule("term", declaration=True, courtesy=True)
def resembles_names_others(term: Term) -> str:
    """List in `resembles` the names of other terms that a recording may not tell from this one."""
    bad = [name for name in term.resembles if name == term.name or not SNAKE.fullmatch(str(name))]
    return f"{bad[0]!r} is no other term" if bad else ""


@rule("term", declaration=True)
def place_is_a_field(term: Any) -> str:
    """Write the field `at: str = "ground"`: whoever uses the term says with it where the term acts."""
    good = isinstance(getattr(term, "at", None), str) and "at" in {f.name for f in fields(term)}
    return "" if good else "it has no field `at` that holds the name of a place"


@rule("term", declaration=True)
def states_and_rate_go_together(term: Term) -> str:
    """Name the own `states` and write `rate` for them, or do neither."""
    has_rate = type(term).rate is not Term.rate
    if has_rate == bool(term.states):
        return ""
    return "it writes rate and names no states" if has_rate else f"it names {listed(term.states)} and has no rate"


@rule("term")
def force_is_zero_at_null(term: Term) -> str:
    """Let the force be exactly 0 when the parameters with a null are at it, also after its states have run from 0."""
    for point in of_term(term, null=True):
        for p in (point, _walked(term, point)):
            if (force := pull(term, p)) != 0.0:
                return f"the force is {force} at x = {p.x:.3g}, v = {p.v:.3g}, p = {p.p}"
    return ""


@rule("term")
def force_does_something(term: Term) -> str:
    """Let the force differ from 0 somewhere when the parameters are away from their null."""
    if term.acts != "motion":
        return ""
    forces = [pull(term, _walked(term, p)) for p in of_term(term)]
    return "" if any(f != 0.0 for f in forces) else f"the force was 0 at each of {len(forces)} points"


@rule("term")
def force_is_a_finite_number(term: Term) -> str:
    """Return one finite number from `force` for any motion, at rest too, when all parameters are near one."""
    rest = [Point(p.t, 0.0 * p.y, p.u, p.p) for p in of_term(term)]
    for p in [*of_term(term), *rest]:
        force = pull(term, p)
        if not isinstance(force, (float, int, np.floating)) or not math.isfinite(force):
            return f"the force is {force} at x = {p.x:.3g}, v = {p.v:.3g}"
    return ""


@rule("term")
def force_and_rate_change_no_argument(term: Term) -> str:
    """Only read `u`, `p` and `s`: the integrator uses them again in the same step."""
    for p in of_term(term):
        held = [a.copy() for a in (p.u, p.p, p.y)]
        for call in (pull, pace):
            call(term, p)
            if any(not np.array_equal(a, b) for a, b in zip(held, (p.u, p.p, p.y), strict=True)):
                return f"u, p or s was changed by {'force' if call is pull else 'rate'}"
    return ""


@rule("term")
def rate_writes_every_state(term: Term) -> str:
    """Write all of `dsdt`, by `=` and not by `+=`, with finite numbers: what is not written is left over."""
    for p in of_term(term):
        over_nan, over_zero = pace(term, p), pace(term, p, over=0.0)
        bad = [s for s, a, b in zip(term.states, over_nan, over_zero, strict=True) if a != b]
        if bad:
            return f"dsdt of {listed(bad)} keeps what was in it, or is not finite"
    return ""


_TIMES = np.linspace(-1.0, 3.0, 41)


def _wave(t: Array, order: int) -> Array:
    """Return a recorded input, or its derivative."""
    return np.sin(2.0 * t) if order == 0 else 2.0 * np.cos(2.0 * t)


@rule("term")
def input_is_as_recorded_at_null(term: Term) -> str:
    """Let `true` return the recorded input itself, and its derivative, when the parameters with a null are at it."""
    if not isinstance(term, DriveTerm):
        return ""
    for point, order in itertools.product(of_term(term, null=True), (0, 1)):
        if not np.array_equal(term.true(_wave, _TIMES, tuple(point.p), order), _wave(_TIMES, order)):
            return f"the input of order {order} is another one at p = {point.p}"
    return ""


@rule("term")
def input_is_changed(term: Term) -> str:
    """Let `true` return another input, with finite numbers, when the parameters are away from their null."""
    if not isinstance(term, DriveTerm):
        return ""
    made = [term.true(_wave, _TIMES, tuple(p.p), 0) for p in of_term(term)]
    if not all(m.shape == _TIMES.shape and np.all(np.isfinite(m)) for m in made):
        return "the input is not one finite number for each time"
    return "" if any(not np.array_equal(m, _wave(_TIMES, 0)) for m in made) else "the input is never changed"


@rule("term")
def derivative_is_that_of_the_input(term: Term) -> str:
    """Let `true` of order 1 return the time derivative of what it returns of order 0: a base moves with a velocity."""
    if not isinstance(term, DriveTerm):
        return ""
    for point in of_term(term):
        p, h = tuple(point.p), 1e-5
        ends = [term.true(_wave, _TIMES + side, p, 0) for side in (h, -h)]
        if not np.allclose((ends[0] - ends[1]) / (2.0 * h), term.true(_wave, _TIMES, p, 1), rtol=1e-5, atol=1e-5):
            return f"it is not at p = {point.p}"
    return ""


@rule("term")
def sensor_is_true_at_null(term: Term) -> str:
    """Let a sensor show what is there, at once, when the parameters with a null are at it; and else something other."""
    if not isinstance(term, SensorTerm):
        return ""
    for point in of_term(term, null=True):
        p = tuple(point.p)
        if not _true(term, p):
            return f"it shows something other at p = {point.p}"
    return "" if not all(_true(term, tuple(q.p)) for q in of_term(term)) else "it never changes what is shown"


def _true(term: SensorTerm, p: tuple[float, ...]) -> bool:
    """Return whether a sensor shows what is there, at once."""
    exact = (term.gain(p), term.offset(p), term.delay(p)) == (1.0, 0.0, 0.0)
    same = (np.array_equal(shown(_TIMES, p), _TIMES) for shown in (term.rounded, term.bent))
    return exact and all(same) and not _lags(term, p)


def _lags(term: SensorTerm, p: tuple[float, ...]) -> bool:
    """Return whether a sensor with states does not reach within a few steps what is there."""
    if not term.states:
        return False
    point = next(of_term(term))
    shown = Point(0.0, np.zeros(len(term.states)), point.u, np.array(p), 1.0, 0.0)
    for _ in range(_STEPS):
        shown.y[:] += STEP * pace(term, shown)
    return bool(abs(shown.y[0] - 1.0) > 1e-6)


@rule("term")
def force_is_deterministic(term: Term) -> str:
    """Let `force` and `rate` depend on their arguments alone; what has to be remembered is a state."""
    same = all(
        not differ(pull(term, p), pull(term, p)) and not differ(pace(term, p), pace(term, p)) for p in of_term(term)
    )
    return "" if same else "two calls with the same arguments gave different numbers"


@rule("term")
def compiles_to_the_same_numbers(term: Term) -> str:
    """Use only `math`, arithmetic, branches and other such functions: numba must compile them to the same numbers."""
    force, rate = _fast(term, "force"), _fast(term, "rate") if term.states else term.rate
    for p in of_term(term):
        gaps = {
            "force": differ(pull(term, p), pull(term, p, force)),
            "rate": differ(pace(term, p), pace(term, p, rate)),
        }
        if bad := {name: gap for name, gap in gaps.items() if not gap < 1e-12}:
            return f"compiled and plain differ: {bad}"
    return ""
