"""A model with its terms under a periodic drive, as a stroboscopic map with tangent vectors.

The state is integrated by RK4 in fixed steps, the tangent vectors by the same steps differentiated: the directional
derivative of the vector field along a tangent vector is computed at each stage. So the growth of a tangent vector is
that of the computed motion itself, to about 1e-9. What remains is the error of RK4: of fourth order where the force is
smooth, of second order at a kink such as a contact. A step with a kink is repeated in `FINER` parts. A continuous force
needs no correction of the tangent at a kink (no saltation). A force that jumps does; this correction is not made, and
the orbit has the status "jumps".

Dry friction of the library is a steep line of width `force * mobility`. Here `LINE` steps resolve it, and finer ones
its edges, so its tangent is that of the law as it is computed: through a reversal of motion it tends to the saltation
of the jump; during sticking it shrinks by a factor of e every `LINE` steps, where that of an ideal jump would vanish at
once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lostmotion.contracts import Array, Assembly, Flow, Model, Orbit
from lostmotion.errors import ContractError
from lostmotion.likelihood.drive import SILENT, DriveHarmonic, pad_inputs
from lostmotion.likelihood.system import System
from lostmotion_chaos.flows.stroboscopic import build_map

ACCURACY = 0.04
"""Step times fastest rate: 157 steps a cycle. Halving it changes the exponents of a smooth flow by less than 1e-5."""
FEWEST, MOST = 64, 50_000
"""Steps in a period."""
ROUGH = 5.0
"""Steps may be this many times too long, where `MOST` are too few; beyond this the motion is too stiff."""
LINE = 8
"""Steps in which a law crosses its steep line, in place of the single one of a filter or a simulation. As the steps are
as many times finer where there is such a law, the line is as wide as with ordinary steps."""
FINER = 16
"""Parts in which a step with a kink is repeated."""
COARSE, PROBES = 40, 100
"""Periods that are simulated, and their states at which the fastest rate is computed, before the step is chosen."""


@dataclass(frozen=True)
class Harmonic:
    """The first input of a model (a force, a base position) as amplitude * cos(omega t + phase); `omega` in rad/s."""

    amplitude: float
    omega: float
    phase: float = 0.0

    @property
    def period(self) -> float:
        """The period (s)."""
        return 2.0 * math.pi / self.omega

    def column(self, name: str) -> Callable[[Array], Array]:
        """Return the driven input called `name` as a function of time; a base velocity is that of the position."""
        if name == "base_velocity":
            return lambda t: -self.amplitude * self.omega * np.sin(self.omega * t + self.phase)
        return lambda t: self.amplitude * np.cos(self.omega * t + self.phase)


def flow_of(
    machine: System | Assembly | Model,
    values: Mapping[str, float],
    *,
    drive: Harmonic | tuple[float, float] | float,
    start: Array | None = None,
    steps: int = 0,
) -> Flow:
    """Return the flow of a machine with all its terms: exact where the model has a closed form, else by RK4.

    `drive` is amplitude and omega (rad/s) of a harmonic force or base motion, or, for a machine that nothing drives,
    the time (s) between samples. `steps` is the number of RK4 steps in a period; by default 157 for the fastest cycle.
    """
    system = machine if isinstance(machine, System) else System.of(machine)
    beat, period = _read_drive(drive)
    if not steps and (exact := _make_exact(system, values, beat or Harmonic(0.0, 2.0 * math.pi / period), start)):
        return exact
    return make_stepped_flow(system, values, drive=drive, start=start, steps=steps)


def _make_exact(system: System, values: Mapping[str, float], beat: Harmonic, start: Array | None) -> Flow | None:
    """Return the closed-form flow of the model, if it has one and no terms are added."""
    if system.terms:
        return None
    full = dict(zip(system.index, _make_parameters(system, values).tolist(), strict=True))
    return system.equations.exact(full, (beat.amplitude, beat.omega, beat.phase), _make_start(system, start))


def make_stepped_flow(
    system: System,
    values: Mapping[str, float],
    *,
    drive: Harmonic | tuple[float, float] | float,
    start: Array | None = None,
    steps: int = 0,
) -> SteppedFlow:
    """Return the flow by RK4, with arguments as in `flow_of`."""
    beat, period = _read_drive(drive)
    full, begin = _make_parameters(system, values), _make_start(system, start)
    raw = SteppedFlow(system, full, beat, period, begin, steps or FEWEST, np.full(len(begin), 1e100))
    return raw._choose_steps(bool(steps))


def _make_parameters(system: System, values: Mapping[str, float]) -> Array:
    """Return the parameter vector, or raise a `ContractError` that names a missing parameter or one out of bounds."""
    given = {system.slot(name).key: float(value) for name, value in values.items()}
    inertias = system.inertia_keys
    for slot in system.slots:
        q, value = slot.param, given.get(slot.key)
        if value is None:
            if slot.term is not None or q.scale == "log" or q.low > 0.0:
                raise ContractError(f"{system.model.name} lacks {slot.key} ({q.meaning}, {slot.unit}): give it a value")
        elif not (math.isfinite(value) and q.low <= value <= q.high and (value > 0.0 or slot.key not in inertias)):
            wanted = "a number above 0" if slot.key in inertias else f"a finite number from {q.low:g} to {q.high:g}"
            raise ContractError(f"{slot.key} ({q.meaning}) is {value:g}: expected {wanted} {slot.unit}")
    return system.vector(given)


def _make_start(system: System, start: Array | None) -> Array:
    """Return the initial state, zero where none is given."""
    begin = np.zeros(system.states(system.everything))
    told = np.zeros(0) if start is None else np.asarray(start, dtype=float)
    if told.ndim != 1 or len(told) > len(begin) or not np.isfinite(told).all():
        raise ContractError(f"the start is {told}: expected up to {len(begin)} finite numbers")
    begin[: len(told)] = told
    return begin


def _read_drive(drive: Harmonic | tuple[float, float] | float) -> tuple[Harmonic | None, float]:
    """Return the drive, if there is one, and the period (s)."""
    beat = None if isinstance(drive, float | int) else drive if isinstance(drive, Harmonic) else Harmonic(*drive)
    if beat and not 0.0 < beat.omega < math.inf:
        raise ContractError(f"the drive has omega = {beat.omega:g} rad/s: expected a finite number above zero")
    period = beat.period if beat else float(drive)  # type: ignore[arg-type]
    if not 0.0 < period < math.inf:
        raise ContractError(f"the period is {period:g} s: expected a finite time above zero")
    return beat, period


@dataclass(frozen=True, eq=False)
class SteppedFlow:
    """The flow of a system by `steps` RK4 steps to a period; `scale` (n,) are natural sizes of the states."""

    system: System
    full: Array
    beat: Harmonic | None
    period: float
    start: Array
    steps: int
    scale: Array
    compiled: bool = True
    shortage: float = 1.0

    @property
    def states(self) -> tuple[str, ...]:
        """The names of the states, those of the terms last."""
        own = [f"{key}.{s}" for key, t in zip(self.system.keys, self.system.terms, strict=True) for s in t.states]
        return (*self.system.model.states, *own)

    @property
    def driven(self) -> bool:
        """Whether the phase of a drive is one more direction of the flow, with the exponent zero."""
        return self.beat is not None and self.beat.amplitude != 0.0

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from `start` (n,) at drive phase 0, with `tangents` tangent vectors kept orthogonal."""
        if self.shortage > ROUGH:
            return Orbit(np.full((periods + 1, len(start)), np.nan), np.full((periods, tangents), np.nan), "too_stiff")
        states, growth, status = self._run(start, periods, tangents, 1)
        return Orbit(states, growth, status)

    def sample(self, start: Array, *, periods: int, looks: int) -> Array:
        """Return states (periods * looks + 1, n) at `looks` even times of each period; NaN after a divergence."""
        return self._run(start, periods, 0, looks)[0]

    def _run(self, start: Array, periods: int, tangents: int, looks: int) -> tuple[Array, Array, str]:
        n, sub = len(self.start), -(-self.steps // looks)
        h = self.period / (sub * looks)
        begin = np.asarray(start, dtype=float)
        if begin.shape != (n,) or not 0 <= tangents <= n:
            raise ContractError(f"a start of shape {begin.shape} and {tangents} tangents do not fit {n} states")
        states, growth = np.full((periods * looks + 1, n), np.nan), np.zeros((periods, tangents))
        inputs, (base, own) = self._make_inputs(sub * looks, h), self._pack(h)
        broken = np.zeros(2, dtype=np.int64)
        done = self._map(
            begin, inputs, h, looks, self._count_between(sub * looks), FINER, base, own,
            *self.system.wiring(self.system.everything), self.scale, _make_frame(tangents, n), states, growth, broken,
            np.zeros((3, inputs.shape[1])),
        )  # fmt: skip
        if done < len(states):
            states[done:], growth[max(done - 1, 0) // looks :] = np.nan, np.nan
            return states, growth, "diverged"
        return states, growth, "jumps" if broken[0] else "ok"

    @cached_property
    def _map(self) -> Callable[..., int]:
        return build_map(self.system.blueprint, len(self.start), self.compiled)

    def _count_between(self, steps: int) -> int:
        """Return the steps between two orthonormalisations: about one over the fastest rate."""
        return max(1, min(steps, round(1.0 / ACCURACY)))

    def _make_inputs(self, steps: int, h: float) -> Array:
        """Return the inputs of one period (3 * steps, inputs): start, middle and end of each step."""
        names, count = self.system.model.driven, len(self.system.model.inputs)
        if self.beat is None:
            return np.zeros((3 * steps, count))
        t = (np.arange(steps)[:, None] * h + np.array([0.0, 0.5 * h, h])).ravel()
        columns = [self.beat.column(name) for name in names]
        keys = self.system.list_input_terms(self.system.everything)
        acting = self.system.acting(columns, self.full, keys, self._harmonic)
        moved = [there or recorded for there, recorded in zip(acting, columns, strict=True)]
        return np.ascontiguousarray(pad_inputs(np.stack([u(t) for u in moved], axis=1), count))

    @property
    def _harmonic(self) -> DriveHarmonic:
        return DriveHarmonic(self.beat.omega, self.beat.amplitude) if self.beat else SILENT

    def _pack(self, h: float) -> tuple[Array, Array]:
        """Return the parameters of model and terms, with the mobility for `LINE` steps."""
        packed = self.system.pack(self.full[None], h, self._harmonic, line=LINE)[0]
        rows = self.system.blueprint.rows
        base, own = packed[: rows.pace - rows.params], packed[rows.own - rows.params : rows.onset - rows.params]
        return np.ascontiguousarray(base), np.ascontiguousarray(own)

    def _choose_steps(self, fixed: bool) -> SteppedFlow:
        """Return this flow with a step and with sizes of the states from a simulation of some periods."""
        flow = self
        for _ in range(2):
            looks = min(flow.steps, FEWEST)
            seen = flow.sample(flow.start, periods=COARSE, looks=looks)
            seen = seen[np.isfinite(seen).all(axis=1) & (np.abs(seen) < 1e12).all(axis=1)]
            size = np.abs(seen).max(axis=0)
            scale = np.maximum(0.5 * np.ptp(seen, axis=0), 1e-3 * size)
            scale = np.where(scale > 0.0, scale, max(float(scale.max()), 1e-9))
            wanted = float(flow.steps) if fixed else flow._count_steps(seen, looks)
            steps = flow.steps if fixed else math.ceil(min(max(wanted, FEWEST), MOST))
            flow = replace(self, steps=steps, scale=scale, shortage=wanted / steps)
        return flow

    def _count_steps(self, seen: Array, looks: int) -> float:
        """Return the number of steps in a period for the fastest rate at the states `seen`."""
        picked = np.unique(np.linspace(0, len(seen) - 1, PROBES).astype(int))
        inputs = self._make_inputs(looks, self.period / looks)[3 * (picked % looks)]
        n = len(self.system.model.states)
        rate = self.system.find_fastest_rate(self.full, self.system.everything, seen[picked][:, :n], inputs)
        finer = LINE if any("mobility" in term.needs for _, term in self.system.forces) else 1
        return finer * rate * self.period / ACCURACY


def _make_frame(tangents: int, n: int) -> Array:
    """Return orthonormal rows (tangents, n) that are not aligned with any state."""
    wave = np.cos(np.arange(1, n + 1)[:, None] * (np.arange(n) + 0.5) * 0.9) + np.eye(n)
    return np.ascontiguousarray(np.linalg.qr(wave.T)[0].T[:tangents])
