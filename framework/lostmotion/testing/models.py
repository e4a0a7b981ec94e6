"""The rules of a Model."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from lostmotion.contracts import Array, Interface, Model
from lostmotion.testing.probes import Point, blank, compiled, differ, of_model
from lostmotion.testing.rules import listed, rule
from lostmotion.testing.shared import repeated

INPUTS = ("force", "base_position", "base_velocity")
_SMALL = 1e-6


def slope(model: Model, point: Point, function: Any = None) -> Array:
    """Return the time derivative of the states; what was not written is NaN."""
    dydt = blank(len(model.states))
    (function or type(model).rhs)(point.t, point.y, point.u, point.p, dydt)
    return dydt


def sight(model: Model, point: Point, function: Any = None) -> Array:
    """Return what the sensors see; what was not written is NaN."""
    seen, dydt = blank(len(model.channels)), np.arange(1.0, len(model.states) + 1.0)
    (function or type(model).observe)(point.t, point.y, dydt, point.u, point.p, seen)
    return seen


def _changed(before: Iterable[Array], after: Iterable[Array]) -> bool:
    return any(not np.array_equal(a, b) for a, b in zip(before, after, strict=True))


@rule("model", declaration=True)
def motion_is_known(model: Model) -> str:
    """Write `motion = "translation"` (N, m) or `motion = "rotation"` (N m, rad): the units follow from it."""
    return "" if model.motion in ("translation", "rotation") else f"the motion is {model.motion!r}"


@rule("model", declaration=True)
def inputs_and_channels_are_named(model: Model) -> str:
    """Let inputs be "force", or "base_position" and "base_velocity"; give each channel a name of its own."""
    if not model.states or not model.inputs or not model.channels:
        return "states, inputs or channels are empty"
    if unknown := [name for name in model.inputs if name not in INPUTS]:
        return f"input {unknown[0]!r} is not known"
    if again := repeated(model.channels) + repeated(model.inputs):
        return f"{listed(again)} stands twice"
    bad = [name for name in model.channels if not str(name).isidentifier()]
    return f"channel {bad[0]!r} is no identifier" if bad else ""


@rule("model", declaration=True)
def interfaces_name_rows_and_params(model: Model) -> str:
    """Let each interface name a row of `dydt`, and parameters of the model for its inertia and for what it holds."""
    known = {q.name for q in model.params}
    if not model.interfaces or repeated(i.name for i in model.interfaces):
        return "there is no interface, or two have the same name"
    for place in model.interfaces:
        row, other = place.against or (place.row, place.inertia)
        if wrong := {place.row, row} - set(range(len(model.states))):
            return f"{place.name} acts on row {min(wrong)}, and the rows are 0 to {len(model.states) - 1}"
        if unknown := [name for name in (place.inertia, other, *place.holds) if name not in known]:
            return f"{place.name} names {unknown[0]!r}, which is no parameter"
    return ""


@rule("model")
def rhs_writes_every_entry(model: Model) -> str:
    """Write all of `dydt`, by `=` and not by `+=`: the host does not clear it, and what is not written is left over."""
    for point in of_model(model):
        over_nan, over_zero = slope(model, point), _over(model, point)
        lacking = [
            s for s, a, b in zip(model.states, over_nan, over_zero, strict=True) if np.isnan(a) and not np.isnan(b)
        ]
        if lacking:
            return f"dydt of {listed(lacking)} keeps what was in it"
    return ""


def _over(model: Model, point: Point) -> Array:
    """Return the time derivative of the states, written over zeros."""
    dydt = np.zeros(len(model.states))
    type(model).rhs(point.t, point.y, point.u, point.p, dydt)
    return dydt


@rule("model")
def rhs_changes_no_argument(model: Model) -> str:
    """Only read `y`, `u` and `p` in `rhs`: the integrator uses them again in the same step."""
    for point in of_model(model):
        held = [a.copy() for a in (point.y, point.u, point.p)]
        slope(model, point)
        if _changed(held, (point.y, point.u, point.p)):
            return "y, u or p was changed"
    return ""


@rule("model")
def rhs_is_finite(model: Model) -> str:
    """Let `rhs` return finite numbers for every state when all parameters are near one, however the machine moves."""
    bad = [p for p in of_model(model) if not np.isfinite(_over(model, p)).all()]
    return f"dydt is {_over(model, bad[0])} at y = {bad[0].y}" if bad else ""


@rule("model")
def rhs_is_deterministic(model: Model) -> str:
    """Let `rhs` depend on its arguments alone: disturbance and noise are the business of the filter."""
    bad = [p for p in of_model(model) if differ(slope(model, p), slope(model, p))]
    return "two calls with the same arguments gave different numbers" if bad else ""


@rule("model")
def observe_writes_every_channel(model: Model) -> str:
    """Write all of `seen`, one entry for each channel, with finite numbers."""
    for point in of_model(model):
        bad = [c for c, value in zip(model.channels, sight(model, point), strict=True) if not np.isfinite(value)]
        if bad:
            return f"{listed(bad)} is not written, or not finite"
    return ""


@rule("model")
def observe_changes_no_argument(model: Model) -> str:
    """Only read `y`, `dydt`, `u` and `p` in `observe`."""
    for point in of_model(model):
        y, u, p, dydt = point.y, point.u, point.p, np.arange(1.0, len(model.states) + 1.0)
        held = [a.copy() for a in (y, u, p, dydt)]
        type(model).observe(point.t, y, dydt, u, p, blank(len(model.channels)))
        if _changed(held, (y, u, p, dydt)):
            return "y, dydt, u or p was changed"
    return ""


@rule("model")
def interface_velocity_is_the_rate_of_its_position(model: Model) -> str:
    """Let `motion` return position and velocity of the same motion: the second is the time derivative of the first."""
    for place in model.interfaces:
        gap = max(abs(_rate(model, place, p) - place.motion(p.y, p.u)[1]) for p in of_model(model))
        if not gap < _SMALL * 1e3:
            return f"at {place.name} they differ by up to {gap:.3g}"
    return ""


def _rate(model: Model, place: Interface, p: Point) -> float:
    """Return the time derivative of the position at an interface, by central differences along the motion."""
    dudt = np.zeros(len(model.inputs))
    if {"base_position", "base_velocity"} <= set(model.inputs):
        dudt[model.inputs.index("base_position")] = p.u[model.inputs.index("base_velocity")]
    dydt = _over(model, p)
    ahead = place.motion(p.y + _SMALL * dydt, p.u + _SMALL * dudt)[0]
    behind = place.motion(p.y - _SMALL * dydt, p.u - _SMALL * dudt)[0]
    return float((ahead - behind) / (2.0 * _SMALL))


@rule("model")
def compiles_to_the_same_numbers(model: Model) -> str:
    """Use only `math`, arithmetic, branches and other such functions: numba must compile them to the same numbers."""
    cls, places = type(model), model.interfaces
    rhs, observe, motions = compiled(cls.rhs), compiled(cls.observe), [compiled(i.motion) for i in places]
    for p in of_model(model):
        gaps = {"rhs": differ(slope(model, p), slope(model, p, rhs))}
        gaps["observe"] = differ(sight(model, p), sight(model, p, observe))
        gaps |= {i.name: differ(i.motion(p.y, p.u), m(p.y, p.u)) for i, m in zip(places, motions, strict=True)}
        if bad := {name: gap for name, gap in gaps.items() if not gap < 1e-12}:
            return f"compiled and plain differ: {bad}"
    return ""
