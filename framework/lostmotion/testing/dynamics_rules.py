"""The rules of a Dynamics."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array, Dynamics, Place
from lostmotion.quantities import quantity_of
from lostmotion.testing.probes import draw_values
from lostmotion.testing.rules import join_words, rule
from lostmotion.testing.shared_rules import find_repeated

ROWS, SHORT = 6, 1e-4
"""The number of rows that are tried at once, and the time (s) of a short step."""
CLOSE = 1e-9
"""The largest accepted difference of two results that should be equal, as a share of the largest."""


class _Tried(NamedTuple):
    """Arguments of `step` and `observe`: states, inputs, forces and parameters of some rows."""

    x: Array
    u: Array
    f: Array
    p: Array

    def keep(self, rows: slice) -> _Tried:
        """Return some of the rows."""
        return _Tried(*(a[rows].copy() for a in self))


def _try_rows(machine: Dynamics) -> _Tried:
    """Return random states, inputs, forces and parameters; in the first row each parameter is one."""
    rng = np.random.default_rng(5)
    p = np.array([draw_values(machine.params, rng if i else None) for i in range(ROWS)]).reshape(ROWS, -1)
    sizes = (len(machine.states), len(machine.inputs), len(machine.places))
    x, u, f = (0.3 * rng.standard_normal((ROWS, n)) for n in sizes)
    return _Tried(x, u, f, p)


def _differ(a: Array, b: Array) -> bool:
    largest = float(np.max(np.abs(a), initial=0.0))
    return not (math.isfinite(largest) and np.allclose(a, b, rtol=0.0, atol=CLOSE * max(largest, 1e-300)))


@rule("dynamics", declaration=True)
def places_are_places(machine: Dynamics) -> str:
    """Write `places` as a tuple with a `Place` for each place where a force may act, each with a name of its own."""
    if not machine.places or not all(isinstance(place, Place) for place in machine.places):
        return f"places are {machine.places!r}"[:200]
    again = find_repeated(place.name for place in machine.places)
    return f"the place {join_words(again)} occurs twice" if again else ""


@rule("dynamics", declaration=True)
def channels_of_a_dynamics_are_named_by_quantity(machine: Dynamics) -> str:
    """Name channels and inputs once, and by their quantity at the end: "elbow.velocity", "elbow_force"."""
    if again := [*find_repeated(machine.channels), *find_repeated(machine.inputs)]:
        return f"{join_words(again)} occurs twice"
    for name in (*machine.channels, *machine.inputs, *machine.states):
        quantity_of(name)  # raises an error that names the wrong part
    return ""


@rule("dynamics", declaration=True)
def bodies_of_a_dynamics_move(machine: Dynamics) -> str:
    """Name the velocity of a position `x` among the states "x.velocity" or "x_velocity": sensors begin there."""
    places = [i for i, name in enumerate(machine.states) if quantity_of(name) == "position"]
    lonely = [machine.states[i] for i in places if machine.find_rate(i) is None]
    return "" if places and not lonely else f"the states {join_words(machine.states)} have no velocity of {lonely[:1]}"


@rule("dynamics")
def step_returns_states(machine: Dynamics) -> str:
    """Return from `step` finite states (rows, states) for arrays with one row for each machine."""
    tried = _try_rows(machine)
    found = np.asarray(machine.step(*tried, SHORT))
    if found.shape != tried.x.shape:
        return f"step returned an array {found.shape} for states {tried.x.shape}"
    bad = np.flatnonzero(~np.isfinite(found).all(axis=1))
    return f"step returned {found[bad[0]]} for the states {tried.x[bad[0]]}" if len(bad) else ""


@rule("dynamics")
def observe_returns_channels(machine: Dynamics) -> str:
    """Return from `observe` finite channels (rows, channels)."""
    tried = _try_rows(machine)
    found = np.asarray(machine.observe(*tried))
    if found.shape != (ROWS, len(machine.channels)):
        return f"observe returned an array {found.shape} for {ROWS} rows and {len(machine.channels)} channels"
    bad = np.flatnonzero(~np.isfinite(found).all(axis=1))
    return f"observe returned {found[bad[0]]} for the states {tried.x[bad[0]]}" if len(bad) else ""


@rule("dynamics")
def arguments_are_not_changed(machine: Dynamics) -> str:
    """Leave all arguments of `step` and `observe` as they are: write `x = x + h * k`, not `x += h * k`."""
    tried = _try_rows(machine)
    kept = tried.keep(slice(None))
    machine.step(*tried, SHORT)
    machine.observe(*tried)
    changed = [name for name, a, b in zip(_Tried._fields, tried, kept, strict=True) if not np.array_equal(a, b)]
    return f"{join_words(changed)} was changed" if changed else ""


@rule("dynamics")
def rows_are_independent(machine: Dynamics) -> str:
    """Compute each row from its own states, inputs, forces and parameters alone, the same at each call."""
    tried = _try_rows(machine)
    whole = machine.step(*tried, SHORT), machine.observe(*tried)
    for begin, end in ((0, 1), (2, 5)):
        part = tried.keep(slice(begin, end))
        alone = machine.step(*part, SHORT), machine.observe(*part)
        if any(_differ(a[begin:end], b) for a, b in zip(whole, alone, strict=True)):
            return f"the rows {begin} to {end - 1} alone give another result than among {ROWS}"
    return ""


@rule("dynamics")
def short_step_moves_little(machine: Dynamics) -> str:
    """Let `step` go by `dt`: positions move by their velocities times `dt`, and nothing moves in no time."""
    tried = _try_rows(machine)
    moved, still = machine.step(*tried, SHORT), machine.step(*tried, 1e-12)
    if float(np.max(np.abs(still - tried.x))) > 1e-6:
        return f"a step of 1e-12 s changes a state by {np.max(np.abs(still - tried.x)):.3g}"
    for i, name in enumerate(machine.states):
        rate = machine.find_rate(i) if quantity_of(name) == "position" else None
        if rate is None:
            continue
        mean = 0.5 * (tried.x[:, rate] + moved[:, rate])
        gap = np.max(np.abs((moved[:, i] - tried.x[:, i]) / SHORT - mean))
        if gap > 1e-2 * max(float(np.max(np.abs(mean))), 1e-3):
            return f"in {SHORT:g} s {name} moves by another amount than its velocity {machine.states[rate]} says"
    return ""


@rule("dynamics")
def force_moves_its_place(machine: Dynamics) -> str:
    """Let a force `f` at a place accelerate the motion there in its direction: it has an inertia above zero."""
    tried = _try_rows(machine)
    for i, place in enumerate(machine.places):
        push = np.zeros_like(tried.f)
        push[:, i] = 1.0
        ends = [machine.step(tried.x, tried.u, tried.f + side * push, tried.p, SHORT) for side in (1.0, -1.0)]
        gained = place.move(ends[0], tried.u)[1] - place.move(ends[1], tried.u)[1]
        if not np.all(gained > 0.0):
            return f"a force at {place.name} changes the velocity there by {gained.min():.3g} m/s or rad/s"
    return ""


@rule("dynamics")
def observed_states_are_states(machine: Dynamics) -> str:
    """Show a state in the channel of the same name."""
    tried = _try_rows(machine)
    seen = machine.observe(*tried)
    for c, name in enumerate(machine.channels):
        if name in machine.states and _differ(tried.x[:, machine.states.index(name)], seen[:, c]):
            return f"the channel {name} shows another number than the state {name}"
    return ""
