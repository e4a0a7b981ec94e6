"""The rules of a Model."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from lostmotion.contracts import Array, Interface, Model
from lostmotion.errors import DataError
from lostmotion.quantities import NUMBER, names_quantity, quantity_of
from lostmotion.testing.probes import Point, compile_function, make_blank, points_of_model, relative_difference
from lostmotion.testing.rules import join_words, rule
from lostmotion.testing.shared_rules import find_repeated

INPUTS = ("force", "base_position", "base_velocity", "base_acceleration", "voltage", "current")
"""The names of inputs; one that ends in `_force` acts on a further body."""
RATE_OF = {"velocity": "position", "acceleration": "velocity"}
_SMALL = 1e-6


def compute_rhs(model: Model, point: Point, function: Any = None) -> Array:
    """Return the time derivative of the states; entries that are not written are NaN."""
    dydt = make_blank(len(model.states))
    (function or type(model).rhs)(point.t, point.y, point.u, point.p, dydt)
    return dydt


def compute_channels(model: Model, point: Point, function: Any = None) -> Array:
    """Return the channels; entries that are not written are NaN."""
    seen, dydt = make_blank(len(model.channels)), np.arange(1.0, len(model.states) + 1.0)
    (function or type(model).observe)(point.t, point.y, dydt, point.u, point.p, seen)
    return seen


def _any_changed(before: Iterable[Array], after: Iterable[Array]) -> bool:
    return any(not np.array_equal(a, b) for a, b in zip(before, after, strict=True))


@rule("model", declaration=True)
def motion_is_known(model: Model) -> str:
    """Write `motion = "translation"` (N, m) or `motion = "rotation"` (N m, rad), which determines the units.

    Where the equations hold for both, make it a field, `motion: Motion = "translation"`, and list both in `motions`.
    """
    if unknown := {model.motion, *model.motions} - {"translation", "rotation"}:
        return f"the motion {sorted(unknown)[0]!r} is not known"
    if model.motions and model.motion not in model.motions:
        return f"the motion is {model.motion}, and motions are {join_words(model.motions)}"
    stiff = [m for m in model.motions if model.turned(m).motion != m]
    return f"turned({stiff[0]!r}) is still a model of {model.motion}" if stiff else ""


@rule("model", declaration=True)
def inputs_and_channels_are_named(model: Model) -> str:
    """Name inputs "force", "second_force", "base_position" followed by "base_velocity", "base_acceleration", "voltage".

    The name of a force on a further body ends in "_force". Give each channel a unique name.
    """
    if not model.states or not model.inputs or not model.channels:
        return "states, inputs or channels are empty"
    if unknown := [name for name in model.inputs if name not in INPUTS and not str(name).endswith("_force")]:
        return f"input {unknown[0]!r} is not known"
    behind = [b for a, b in zip(("", *model.inputs), (*model.inputs, ""), strict=True) if a == "base_position"]
    if behind != [name for name in model.inputs if name == "base_velocity"]:
        return "base_position is not followed directly by base_velocity, or one of them is missing"
    if again := find_repeated(model.channels) + find_repeated(model.inputs):
        return f"{join_words(again)} occurs twice"
    bad = [name for name in model.channels if not str(name).replace(".", "_").isidentifier()]
    return f"channel {bad[0]!r} is not an identifier" if bad else ""


@rule("model", declaration=True)
def channels_are_named_by_quantity(model: Model) -> str:
    """End the name of each channel in its quantity: position, velocity, acceleration, force, torque or current.

    The part before it names the body, as in "second_position". Units and derivatives follow from the name.
    """
    known = getattr(model, "coordinates", ())
    bad = [name for name in model.channels if not (names_quantity(name) or name in known)]
    return f"channel {bad[0]!r} names no quantity" if bad else ""


def _quantity(name: str) -> str | None:
    try:
        return quantity_of(name)
    except DataError:
        return None


@rule("model", declaration=True, courtesy=True)
def bodies_are_shown(model: Model) -> str:
    """Provide channels for positions and velocities that are states, with the same names: sensors may measure them."""
    hidden = [s for s in model.states if _quantity(s) in ("position", "velocity") and s not in model.channels]
    return f"{join_words(hidden)} is a state without a channel" if hidden else ""


@rule("model", declaration=True)
def interfaces_name_rows_and_params(model: Model) -> str:
    """Give each interface a row of `dydt`, and parameters of the model for `inertia` and `holds`."""
    known = {q.name for q in model.params}
    if not model.interfaces or find_repeated(i.name for i in model.interfaces):
        return "there is no interface, or two have the same name"
    for place in model.interfaces:
        row, other = place.against or (place.row, place.inertia)
        if wrong := {place.row, row} - set(range(len(model.states))):
            return f"{place.name} acts on row {min(wrong)}, and the rows are 0 to {len(model.states) - 1}"
        if unknown := [name for name in (place.inertia, other, *place.holds) if name not in known]:
            return f"{place.name} names {unknown[0]!r}, which is not a parameter"
    return ""


@rule("model", declaration=True)
def levers_are_numbers(model: Model) -> str:
    """Give a `lever` only to an interface that acts `against` a second body: a parameter of the dimension NUMBER."""
    plain = {q.name for q in model.params if q.dimension == NUMBER}
    bad = [i for i in model.interfaces if i.lever is not None and (i.against is None or i.lever not in plain)]
    return (
        f"{bad[0].name} has the lever {bad[0].lever!r}, which has no dimension NUMBER, or no second body" if bad else ""
    )


@rule("model")
def rhs_writes_every_entry(model: Model) -> str:
    """Write every entry of `dydt`, with `=` and not with `+=`: the array contains old values."""
    for point in points_of_model(model):
        over_nan, over_zero = compute_rhs(model, point), _rhs_over_zeros(model, point)
        lacking = [
            s for s, a, b in zip(model.states, over_nan, over_zero, strict=True) if np.isnan(a) and not np.isnan(b)
        ]
        if lacking:
            return f"dydt of {join_words(lacking)} is not written, or depends on its old value"
    return ""


def _rhs_over_zeros(model: Model, point: Point) -> Array:
    """Return the time derivative of the states, written into an array of zeros."""
    dydt = np.zeros(len(model.states))
    type(model).rhs(point.t, point.y.copy(), point.u.copy(), point.p, dydt)
    return dydt


@rule("model")
def rhs_changes_no_argument(model: Model) -> str:
    """Only read `y`, `u` and `p` in `rhs`: the integrator uses them again in the same step."""
    for point in points_of_model(model):
        held = [a.copy() for a in (point.y, point.u, point.p)]
        compute_rhs(model, point)
        if _any_changed(held, (point.y, point.u, point.p)):
            return "y, u or p was changed"
    return ""


@rule("model")
def rhs_is_finite(model: Model) -> str:
    """Return finite numbers from `rhs` for any motion when all parameters are near one."""
    bad = [p for p in points_of_model(model) if not np.isfinite(_rhs_over_zeros(model, p)).all()]
    return f"dydt is {_rhs_over_zeros(model, bad[0])} at y = {bad[0].y}" if bad else ""


@rule("model")
def rhs_is_deterministic(model: Model) -> str:
    """Make `rhs` depend only on its arguments: the filter models disturbances and noise."""
    bad = [p for p in points_of_model(model) if relative_difference(compute_rhs(model, p), compute_rhs(model, p))]
    return "two calls with the same arguments gave different numbers" if bad else ""


@rule("model")
def observe_writes_every_channel(model: Model) -> str:
    """Write every entry of `seen`, one for each channel, with finite numbers."""
    for point in points_of_model(model):
        bad = [
            c for c, value in zip(model.channels, compute_channels(model, point), strict=True) if not np.isfinite(value)
        ]
        if bad:
            return f"{join_words(bad)} is not written, or not finite"
    return ""


@rule("model")
def observe_changes_no_argument(model: Model) -> str:
    """Only read `y`, `dydt`, `u` and `p` in `observe`."""
    for point in points_of_model(model):
        y, u, p, dydt = point.y, point.u, point.p, np.arange(1.0, len(model.states) + 1.0)
        held = [a.copy() for a in (y, u, p, dydt)]
        type(model).observe(point.t, y, dydt, u, p, make_blank(len(model.channels)))
        if _any_changed(held, (y, u, p, dydt)):
            return "y, dydt, u or p was changed"
    return ""


@rule("model")
def interface_velocity_is_the_rate_of_its_position(model: Model) -> str:
    """Return from `motion` position and velocity of the same motion: the velocity is the derivative of the position."""
    for place in model.interfaces:
        gap = max(abs(_position_rate(model, place, p) - _motion_at(model, place, p)[1]) for p in points_of_model(model))
        if not gap < _SMALL * 1e3:
            return f"at {place.name} they differ by up to {gap:.3g}"
    return ""


def _position_rate(model: Model, place: Interface, p: Point) -> float:
    """Return the time derivative of the position at an interface, by central differences along the motion."""
    ahead, behind = (_motion_at(model, place, _point_later(model, p, step))[0] for step in (_SMALL, -_SMALL))
    return float((ahead - behind) / (2.0 * _SMALL))


def _motion_at(model: Model, place: Interface, p: Point, function: Any = None) -> tuple[float, float]:
    """Return relative position and velocity at an interface."""
    names = [q.name for q in model.params]
    lever = () if place.lever is None else (float(p.p[names.index(place.lever)]),)
    found: tuple[float, float] = (function or place.motion)(p.y, p.u, *lever)
    return found


def _point_later(model: Model, p: Point, step: float) -> Point:
    """Return the point `step` seconds later, to first order; of the inputs only a base position changes."""
    dudt = np.zeros(len(model.inputs))
    if "base_position" in model.inputs:
        dudt[model.inputs.index("base_position")] = p.u[model.inputs.index("base_velocity")]
    return replace(p, t=p.t + step, y=p.y + step * _rhs_over_zeros(model, p), u=p.u + step * dudt)


@rule("model")
def interface_force_acts_along_its_motion(model: Model) -> str:
    """Define the relative velocity at an interface positive in the direction of the force there.

    Its derivative is one by the velocity of the body in `row`, and minus one, or minus the lever, by that of a second
    body: then force times relative velocity is the power of the term.
    """
    for place, p in ((place, p) for place in model.interfaces for p in points_of_model(model)):
        lever = p.p[[q.name for q in model.params].index(place.lever)] if place.lever else 1.0
        for row, wanted in ((place.row, 1.0), *(((place.against[0], -lever),) if place.against else ())):
            push = np.zeros(len(p.y))
            push[row] = 1.0
            ends = [_motion_at(model, place, replace(p, y=p.y + sign * push))[1] for sign in (1.0, -1.0)]
            if not abs(0.5 * (ends[0] - ends[1]) - wanted) < _SMALL * (1.0 + abs(wanted)):
                return f"at {place.name} it changes by {0.5 * (ends[0] - ends[1]):.3g} with {model.states[row]}"
    return ""


def _channels_of(model: Model, p: Point) -> Array:
    """Return the channels of a motion without terms."""
    seen = make_blank(len(model.channels))
    type(model).observe(p.t, p.y, _rhs_over_zeros(model, p), p.u, p.p, seen)
    return seen


@rule("model")
def channels_of_states_show_them(model: Model) -> str:
    """Give a channel with the name of a state the value of that state: the filter uses the state instead."""
    both = [name for name in model.channels if name in model.states]
    for p in points_of_model(model):
        seen = _channels_of(model, p)
        if bad := [c for c in both if abs(seen[model.channels.index(c)] - p.y[model.states.index(c)]) > 0.0]:
            return f"channel {bad[0]} differs from the state {bad[0]}"
    return ""


@rule("model")
def channels_are_rates_of_each_other(model: Model) -> str:
    """Make a velocity the time derivative of the position of the same body, and an acceleration that of the velocity.

    Where "base_acceleration" is an input, add it to the acceleration: an accelerometer measures both.
    """
    for p in points_of_model(model):
        seen, ends = (
            _channels_of(model, p),
            [_channels_of(model, _point_later(model, p, step)) for step in (_SMALL, -_SMALL)],
        )
        rates = (ends[0] - ends[1]) / (2.0 * _SMALL)
        for index, name in enumerate(model.channels):
            below = name.removesuffix(quantity_of(name)) + RATE_OF.get(quantity_of(name), "?")
            if below in model.channels:
                base = name.endswith("acceleration") and "base_acceleration" in model.inputs
                more = p.u[model.inputs.index("base_acceleration")] if base else 0.0
                wanted = rates[model.channels.index(below)] + more
                if abs(seen[index] - wanted) > _SMALL * 1e3 * (1.0 + abs(wanted)):
                    return f"{name} is {seen[index]:.6g}, where {below} and the base give {wanted:.6g}"
    return ""


@rule("model")
def compiles_to_the_same_numbers(model: Model) -> str:
    """Use only `math`, arithmetic, branches and other such functions: numba must compile them to the same numbers."""
    cls, places = type(model), model.interfaces
    rhs, observe, motions = (
        compile_function(cls.rhs),
        compile_function(cls.observe),
        [compile_function(i.motion) for i in places],
    )
    for p in points_of_model(model):
        gaps = {"rhs": relative_difference(compute_rhs(model, p), compute_rhs(model, p, rhs))}
        gaps["observe"] = relative_difference(compute_channels(model, p), compute_channels(model, p, observe))
        pairs = zip(places, motions, strict=True)
        gaps |= {i.name: relative_difference(_motion_at(model, i, p), _motion_at(model, i, p, m)) for i, m in pairs}
        if bad := {name: gap for name, gap in gaps.items() if not gap < 1e-12}:
            return f"compiled and plain differ: {bad}"
    return ""
