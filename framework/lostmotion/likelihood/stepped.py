"""A machine that can only be stepped, with its terms: what a system of equations answers, answered by steps."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Dynamics, Machine, Place, Term, place_of
from lostmotion.errors import ContractError
from lostmotion.likelihood.drive import SILENT, Drive, DriveHarmonic, count_substeps, pad_inputs
from lostmotion.likelihood.place_frame import PlaceLaws, make_frame, pack_frame
from lostmotion.likelihood.system import Motion, System
from lostmotion.quantities import quantity_of

PROBE = 1e-5
"""The time (s) over which a unit force shows the inertia at a place: nothing else moves meanwhile."""
POSTURES = 8
"""Positions, up to half a turn from the given one, at which the inertia at a place is found; the smallest is used."""
SLOWEST = 0.05
"""A motion that decays to less than this share within a step counts as one that decays to it."""
COARSER = 5.0
"""Steps are longer than those of equations by this factor: their error is that of held inputs, (rate * step)^2 / 24."""
SPREAD = 8
"""States of a motion at which inertias are found."""


def make_system(machine: Machine, terms: Sequence[Term] = ()) -> System:
    """Return the system of a machine with its possible terms."""
    return SteppedSystem(machine, tuple(terms)) if isinstance(machine, Dynamics) else System(machine, tuple(terms))


@dataclass(frozen=True)
class MachineRows:
    """Many states of a machine that are stepped together, each with parameters of its own.

    `params` (rows, params) are those of the machine; `laws` are the terms, None where none is active.
    """

    machine: Dynamics
    params: Array
    laws: PlaceLaws | None = None

    def step(self, x: Array, u: Array, f: Array, dt: float) -> Array:
        """Return the states (rows, states) of the machine after `dt` s."""
        return self._call("step", (x, u, f, self.params, dt), x.shape)

    def observe(self, x: Array, u: Array, f: Array) -> Array:
        """Return the channels (rows, channels) of the machine."""
        return self._call("observe", (x, u, f, self.params), (len(x), len(self.machine.channels)))

    def _call(self, what: str, told: tuple[Any, ...], shape: tuple[int, ...]) -> Array:
        """Return the result of a function of the machine; raise `ContractError` where it has another shape."""
        name = self.machine.name
        try:
            with np.errstate(all="ignore"):
                found = np.asarray(getattr(self.machine, what)(*told), dtype=float)
        except Exception as err:  # code of the user
            shapes = ", ".join(f"{n} {a.shape}" for n, a in zip("xufp", told[:4], strict=True))
            raise ContractError(
                f"{name}: {what} raised {type(err).__name__}: {' '.join(str(err).split())[:200]}; it was called with"
                f" {shapes}: let it return a result for any number of rows",
                name,
            ) from err
        if found.shape != shape:
            wanted = "(rows, states)" if what == "step" else "(rows, channels)"
            raise ContractError(
                f"{name}: {what} returned an array {found.shape} for {shape[0]} rows, expected {shape}: return"
                f" {wanted}",
                name,
            )
        return found

    def move(self, x: Array, u: Array) -> Array:
        """Return position and velocity (rows, places, 2) at each place."""
        return np.stack([place.move(x, u).T for place in self.machine.places], axis=1)

    def push(self, times: Any, x: Array, own: Array, u: Array, free: Array) -> tuple[Array, Array]:
        """Return the forces (rows, places) of terms, and derivatives (rows, own states) of the states of terms.

        `times` is one (s) or (rows,). `free` (rows, places) are further forces, which a sensor with states may show.
        """
        if self.laws is None:
            return np.zeros((len(x), len(self.machine.places))), np.zeros_like(own)
        moved, unseen = self.move(x, u), np.zeros((len(x), len(self.machine.channels)))
        times = np.full(len(x), times, dtype=float)
        force, rates = self.laws.evaluate(times, moved, own, np.concatenate([u, unseen], axis=1))
        if self.laws.senses:
            seen = self.observe(x, u, force + free)
            force, rates = self.laws.evaluate(times, moved, own, np.concatenate([u, seen], axis=1))
        return force, rates

    def advance(self, times: Any, state: tuple[Array, Array, Array], inputs: Sequence[Array], h: float) -> Any:
        """Return the states of machine and terms, (rows, states) and (rows, own states), after `h` s.

        `state` are those before and the free forces (rows, places), `inputs` those at the beginning, on average and at
        the end, each (rows, inputs). The forces of terms are the mean of those at both ends (Heun).
        """
        (x, own, free), (early, mean, late) = state, inputs
        if self.laws is None:
            return self.step(x, mean, free, h), own
        force, rates = self.push(times, x, own, early, free)
        moved = self.step(x, mean, force + free, h)
        further, later = self.push(times + h, moved, own + h * rates, late, free)
        return self.step(x, mean, 0.5 * (force + further) + free, h), own + 0.5 * h * (rates + later)


@dataclass(frozen=True)
class SteppedSystem(System):
    """A `Dynamics` and its possible terms. `pack` keeps the parameters, and step, frequency, amplitude and lines."""

    @property
    def machine(self) -> Dynamics:
        """The machine that is stepped."""
        assert isinstance(self.model, Dynamics)  # noqa: S101 - `make_system` decides
        return self.model

    @cached_property
    def frame(self) -> System:
        """The places of the machine with all terms, whose kernel computes the forces of terms."""
        return System(make_frame(self.machine), self.terms)

    def pack(self, fulls: Array, step: float, harmonic: DriveHarmonic = SILENT, *, line: int = 1) -> Array:
        """Return the parameters (points, params) of machine and terms, and what laws need besides."""
        return np.column_stack([fulls, np.tile([step, *harmonic, float(line)], (len(fulls), 1))])

    def make_rows(
        self, packed: Array, active: frozenset[str], near: Array, *, repeat: int = 1, muted: str | None = None
    ) -> MachineRows:
        """Return the machine at packed parameters (points, params), each for `repeat` rows.

        `near` (points, states, any) are states of each point at which the inertia of its places is found.
        """
        fulls, (step, omega, amplitude, line) = packed[:, :-4], packed[0, -4:]
        params = fulls[:, : len(self.machine.params)]
        kept = {key for key, _ in self.frame.forces} & (active - {muted})
        if not kept:
            return MachineRows(self.machine, np.repeat(params, repeat, axis=0))
        inertias = 1.0 / self._find_mobility(params, near)
        harmonic = DriveHarmonic(omega, amplitude)
        wide = pack_frame(self.frame, fulls, inertias, step, harmonic, line=int(line))
        laws = PlaceLaws(self.frame, active & frozenset(self.frame.keys), np.repeat(wide, repeat, axis=0), muted)
        return MachineRows(self.machine, np.repeat(params, repeat, axis=0), laws)

    def _find_mobility(self, params: Array, near: Array) -> Array:
        """Return one over the inertia (points, places) that a force moves at each place; the largest of some postures.

        `params` is (points, params), `near` (points, states, any).
        """
        found = [self._find_kicks(params, x, True)[1] for x in self._list_postures(near)]
        return np.asarray(np.max(found, axis=0))

    def _list_postures(self, near: Array) -> list[Array]:
        """Return states (points, states) at rest: those given, or of a rotation positions up to half a turn away."""
        rotates = self.machine.motion == "rotation"
        places = np.array([quantity_of(name) == "position" for name in self.machine.states])
        rng, still = np.random.default_rng(0), np.where(places[:, None], near, 0.0)
        if not rotates:
            return [still[:, :, i] for i in range(still.shape[2])]
        turns = np.pi * rng.uniform(-1.0, 1.0, (POSTURES - 1, len(places))) * places
        return [still[:, :, 0], *(still[:, :, 0] + turn for turn in turns)]

    def _find_kicks(self, params: Array, x: Array, check: bool = False) -> tuple[Array, Array]:
        """Return the change of states (points, places, states) by a unit impulse at each place, and of its speed."""
        places = len(self.machine.places)
        rows = MachineRows(self.machine, np.repeat(params, places, axis=0))
        wide, unit = np.repeat(x, places, axis=0), np.tile(np.eye(places), (len(x), 1))
        u = np.zeros((len(wide), len(self.machine.inputs)))
        kicks = (rows.step(wide, u, unit, PROBE) - rows.step(wide, u, -unit, PROBE)) / (2.0 * PROBE)
        speeds = rows.move(kicks, u)[:, :, 1].reshape(len(x), places, places)
        found = np.asarray(np.diagonal(speeds, axis1=1, axis2=2))
        for i, place in enumerate(self.machine.places):
            if check and not np.all(found[:, i] > 0.0):
                value = found[:, i][~(found[:, i] > 0.0)][0]
                raise ContractError(
                    f"{self.machine.name}: a force of 1 at {place.name} accelerates it by {value:.3g}, expected a"
                    " finite number above zero: let `step` apply f, and `motion` return the velocity there",
                    self.machine.name,
                )
        return kicks.reshape(len(x), places, -1), found

    def inertia(self, full: Array, place: Place) -> Any:
        """Return the inertia (kg or kg m^2) that a force at a place moves with the machine at rest at zero."""
        fulls = np.atleast_2d(full)[:, : len(self.machine.params)]
        near = np.zeros((len(fulls), len(self.machine.states)))
        found = 1.0 / self._find_kicks(fulls, near, True)[1][:, self._number(place)]
        return found if full.ndim > 1 else float(found[0])

    def own_inertia(self, full: Array, place: Place) -> Any:
        """Return the same as `inertia`."""
        return self.inertia(full, place)

    def _number(self, place: Place) -> int:
        return [one.name for one in self.machine.places].index(place.name)

    @property
    def inertia_keys(self) -> frozenset[str]:
        """No parameter has to be an inertia."""
        return frozenset()

    @property
    def bodies(self) -> int:
        """The number of places of a body, on each of which a random force acts."""
        return len(self.pushed)

    @cached_property
    def pushed(self) -> list[int]:
        """The numbers of the places on which a random force acts: those that are not between two bodies."""
        return [i for i, place in enumerate(self.machine.places) if not place.relative]

    def spread_forces(self, forces: Array) -> Array:
        """Return forces (rows, places) at all places, of random forces (rows, any) at the first of the pushed ones."""
        free = np.zeros((len(forces), len(self.machine.places)))
        free[:, self.pushed[: forces.shape[1]]] = forces
        return free

    def holds_forces(self, channels: Iterable[str]) -> bool:
        """Return true: random forces are held over each sample, since nothing else can be told to a step."""
        return True

    @cached_property
    def _felt(self) -> frozenset[str]:
        """The channels that depend on forces."""
        machine, rng = self.machine, np.random.default_rng(0)
        x, u, p = (rng.random((1, len(names))) for names in (machine.states, machine.inputs, machine.params))
        rows, push = MachineRows(machine, p), np.ones((1, len(machine.places)))
        still, pushed = rows.observe(x, u, 0.0 * push)[0], rows.observe(x, u, push)[0]
        return frozenset(name for name, a, b in zip(machine.channels, still, pushed, strict=True) if a != b)

    def compute_each(
        self,
        active: frozenset[str],
        packed: Array,
        states: Array,
        inputs: Array,
        times: Any = None,
        *,
        muted: str | None = None,
        latent: tuple[int, ...] = (),
    ) -> tuple[Array, Array]:
        """Return derivatives (sets, points, n) as differences over one step, and channels (sets, points, channels)."""
        n, m = len(self.machine.states), self.states(active)
        u = pad_inputs(inputs, len(self.machine.inputs))
        x, own, free = states[:, :n], states[:, n:m], self.spread_forces(states[:, list(latent)])
        when = np.zeros(len(states)) if times is None else np.asarray(times, dtype=float)
        some = np.unique(np.linspace(0, len(states) - 1, SPREAD).astype(int))
        rates, seen = np.zeros((len(packed), *states.shape)), np.zeros((len(packed), len(x), len(self.model.channels)))
        for i, one in enumerate(packed):
            h, near = float(one[-4]), x[some].T[None]
            rows = self.make_rows(one[None], active, near, repeat=len(x), muted=muted)
            moved, later = rows.advance(when, (x, own, free), (u, u, u), h)
            rates[i, :, :n], rates[i, :, n:m] = (moved - x) / h, (later - own) / h
            force, _ = rows.push(when, x, own, u, free)
            seen[i] = rows.observe(x, u, force + free)
        return rates, seen

    def accelerate(self, rates: Array, place: Place) -> Array:
        """Return the acceleration (...) at a place, from derivatives of the states (..., n)."""
        flat = rates.reshape(-1, rates.shape[-1])[:, : len(self.machine.states)]
        still = np.zeros((len(flat), len(self.machine.inputs)))
        return np.asarray(place.move(flat, still)[1].reshape(rates.shape[:-1]))

    def kick(self, full: Array, place: Place) -> Array:
        """Return the change of the states (n,) of the machine, at rest at zero, by one unit of impulse at a place."""
        params, still = full[None, : len(self.machine.params)], np.zeros((1, len(self.machine.states)))
        return np.asarray(self._find_kicks(params, still)[0][0, self._number(place)])

    def compute_force(
        self, key: str, active: frozenset[str], packed: Array, along: tuple[Array, Array, Array]
    ) -> Array:
        """Return the force (samples,) of a term at its place, as its law gives it."""
        (states, inputs, times), n, m = along, len(self.machine.states), self.states(active)
        u, x, own = pad_inputs(inputs, len(self.machine.inputs)), states[:, :n], states[:, n:m]
        some = np.unique(np.linspace(0, len(x) - 1, SPREAD).astype(int))
        both = [
            self.make_rows(packed, active, x[some].T[None], repeat=len(x), muted=muted).push(
                times, x, own, u, np.zeros((len(x), len(self.machine.places)))
            )[0]
            for muted in (None, key)
        ]
        place = place_of(self.model, dict(self.forces)[key])
        return np.asarray((both[0] - both[1])[:, self._number(place)])

    def spread_states(self, positions: Array, velocities: Array) -> Array:
        """Return states (points, n) with these positions and velocities (points,) of all bodies, else zero."""
        states = np.zeros((len(positions), len(self.machine.states)))
        for i, name in enumerate(self.machine.states):
            kind = quantity_of(name)
            states[:, i] = positions if kind == "position" else velocities if kind == "velocity" else 0.0
        return states

    def count_substeps(
        self, rate: float, dt: float, accuracy: float, *, active: frozenset[str] = frozenset(), held: bool = False
    ) -> int:
        """Return the number of steps in a sample; one where nothing but held inputs acts on the machine.

        The machine integrates itself: steps only resolve its inputs and the forces of terms.
        """
        if held and not active & {key for key, _ in self.frame.forces}:
            return 1
        return count_substeps(rate, dt, accuracy=COARSER * accuracy)

    def find_fastest_rate(
        self, full: Array, active: Iterable[str], states: Array, inputs: Array, dt: float = 1.0
    ) -> float:
        """Return the fastest rate (1/s) of the motion, linearised over a step of `dt` s at states (points, n)."""
        (points, n), u = states.shape, pad_inputs(inputs, len(self.machine.inputs))
        wide = np.ptp(states, axis=0)
        reach = 1e-6 * np.where(wide > 0.0, wide, np.max(wide, initial=1e-6))
        moved = states[None] + np.concatenate([np.zeros((1, n)), np.diag(reach)])[:, None]
        rows = MachineRows(self.machine, np.tile(full[: len(self.machine.params)], (points * (n + 1), 1)))
        free = np.zeros((points * (n + 1), len(self.machine.places)))
        ends = rows.step(moved.reshape(-1, n), np.tile(u, (n + 1, 1)), free, dt).reshape(moved.shape)
        jacobians = np.moveaxis((ends[1:] - ends[0]) / reach[:, None, None], 0, 2)
        if not np.isfinite(jacobians).all():
            return float("inf")
        found = np.linalg.eigvals(jacobians).astype(complex)
        found = np.where(np.abs(found) < SLOWEST, SLOWEST, found)
        return float(np.abs(np.log(found)).max() / dt)

    def run_freely(
        self, active: frozenset[str], packed: Array, start: Array, drive: Drive, nsub: int,
        first: NDArray[np.int64], steps: int, *, kicks: Array | None = None,
    ) -> tuple[Array, NDArray[np.int64]]:  # fmt: skip
        """Return states (points, steps, n) of free runs, NaN after a divergence, and the finite samples of each.

        `packed` are the parameters (points, params) of all runs, or (1, params) where they share them. They start at
        the samples `first` of the drive, from `start` (points, n); `kicks` are added at each later sample.
        """
        drive, n = drive.pad_inputs(len(self.machine.inputs)), len(self.machine.states)
        states, count = np.full((len(start), steps, start.shape[1]), np.nan), len(start)
        whole = packed if len(packed) == count else np.repeat(packed, count, axis=0)
        rows = self.make_rows(whole, active, start[:, :n, None])
        now, free = start.astype(float), np.zeros((count, len(self.machine.places)))
        for k in range(steps):
            now = now + kicks[:, k] if kicks is not None and k else now
            states[:, k] = now
            if k == steps - 1 or not np.isfinite(now).all(axis=1).any():
                break
            for j in range(nsub):
                inputs = cross_inputs(drive.cubics[first + k], j / nsub, 1.0 / nsub)
                times = np.asarray(drive.begin + (first + k + j / nsub) * drive.dt, dtype=float)
                both = rows.advance(times, (now[:, :n], now[:, n:], free), inputs, drive.dt / nsub)
                now = np.concatenate(both, axis=1)
        good = np.cumprod(np.isfinite(states).all(axis=2), axis=1).astype(bool)
        states[~good] = np.nan
        return states, good.sum(axis=1).astype(np.int64)

    def simulate(self, full: Array, active: Iterable[str], y0: Array, drive: Drive, nsub: int = 1) -> Motion:
        """Return the free motion, `nsub` steps to a sample, from the state `y0` under `drive`."""
        chosen, start = frozenset(active), np.zeros((1, self.states(active)))
        start[0, : min(start.shape[1], len(y0))] = y0[: start.shape[1]]
        packed = self.pack(full[None], drive.dt / nsub, drive.harmonic)
        begin = np.zeros(1, dtype=np.int64)
        states, reached = self.run_freely(chosen, packed, start, drive, nsub, begin, drive.samples)
        return Motion(states[0], int(reached[0]))


def cross_inputs(cubics: Array, share: float, width: float) -> tuple[Array, Array, Array]:
    """Return inputs (rows, inputs) at the beginning of a step, on average, and at its end.

    `cubics` (rows, 4, inputs) are those of the sample of each row; the step begins at a `share` of the sample and is
    `width` samples long.
    """
    powers = np.arange(4)
    ends = share ** powers.astype(float), (share + width) ** powers.astype(float)
    mean = ((share + width) ** (powers + 1.0) - share ** (powers + 1.0)) / ((powers + 1.0) * width)
    early, middle, late = (np.einsum("j,rji->ri", weights, cubics) for weights in (ends[0], mean, ends[1]))
    return early, middle, late
