"""A model with its terms: parameter layout, compiled kernels, simulation.

A `System` holds a model and a library of terms, each of which is on or off (`active`) at run time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np

from lostmotion.contracts import Array, Assembly, DriveTerm, Input, Machine, Place, SensorTerm, place_of
from lostmotion.errors import ContractError, nearest
from lostmotion.likelihood.acting import Column, Recorded, apply_term, evaluate_order
from lostmotion.likelihood.drive import SILENT, Drive, DriveHarmonic, count_substeps
from lostmotion.likelihood.kernel_calls import compute_each, run_freely
from lostmotion.likelihood.layout import ALWAYS, NUMB, Layout, Slot, key_of, onset_key
from lostmotion.likelihood.sensors import Sensor, SensorChange

__all__ = ["ALWAYS", "Clock", "Motion", "Slot", "System", "key_of", "onset_key"]

PIECE = 200_000
"""Steps of a long motion that are computed at a time."""


class Clock(NamedTuple):
    """The sampling of a simulation: `samples` every `dt` s, with `nsub` steps between two."""

    dt: float
    nsub: int
    samples: int


@dataclass(frozen=True)
class Motion:
    """A free simulation: `states` (samples, n) at the sample times, and the number of finite ones."""

    states: Array
    finite: int


@dataclass(frozen=True)
class System(Layout):
    """A model and its possible terms; all terms are known to the kernel, `active` says which act."""

    @classmethod
    def of(cls, assembly: Assembly | Machine) -> System:
        """Return the system of a model or of `model + term + ...`."""
        if not isinstance(assembly, Assembly):
            return cls(assembly)
        return cls(assembly.model, assembly.terms)

    @cached_property
    def groups(self) -> tuple[tuple[str, tuple[int, ...]], ...]:
        """The inputs by name, with their columns among those of the model: for a base motion value and derivative."""
        names = self.model.inputs
        found: list[tuple[str, tuple[int, ...]]] = []
        for i, name in enumerate(names):
            if name == "base_position" and "base_velocity" in names:
                found.append((name, (i, names.index("base_velocity"))))
            elif name != "base_velocity" or "base_position" not in names:
                found.append((name, (i,)))
        return tuple(found)

    def list_input_terms(self, active: Iterable[str], *, alone: bool = True) -> tuple[str, ...]:
        """Return the keys of those terms that change the input: of the drive, and delays of the sensor.

        The delay of a sensor that is `alone` is a delay of the drive; of several, each has a delay of its own.
        """
        return tuple(
            k
            for k, t in self.channel_terms.items()
            if k in set(active) and not t.marked and (alone or isinstance(t, DriveTerm))
        )

    def is_idle(self, full: Array, key: str, least: float = 0.0) -> bool:
        """Return whether a term does nothing: all its parameters with a null are at it, or no farther than `least`."""
        term = self.terms[self.keys.index(key)]
        return all(abs(full[self.index[f"{key}.{name}"]] - null) <= least for name, null in term.null().items())

    def acting(
        self, columns: Sequence[Column], full: Array, keys: Iterable[str], harmonic: DriveHarmonic, *, lead: int = 0
    ) -> list[Column | None]:
        """Return the inputs that act, as functions of time (s); None where it is the recorded one.

        `keys` are terms of the drive, which act on the input that drives (in column `lead`) unless they name another,
        and delays of a sensor: a late one shows the effect of earlier inputs.
        """
        made: list[Column | None] = [None] * len(columns)
        for name, places in self.groups:
            if max(places) >= len(columns):  # an input that nothing drives
                continue
            u: Input = Recorded(tuple(columns[place] for place in places))
            own = [key for key in keys if self._acts_on(key, name, lead in places)]
            for key in own:
                u = apply_term(self.channel_terms[key], u, self.values(full, key, harmonic), self.onset(full, key))
            for order, place in enumerate(places if own else ()):
                made[place] = partial(evaluate_order, u, order)
        return made

    def _acts_on(self, key: str, name: str, leads: bool) -> bool:
        term = self.channel_terms[key]
        return isinstance(term, SensorTerm) or term.at == name or (term.at == "drive" and leads)

    def gain(self, full: Array, active: Iterable[str], place: str = "sensor") -> float:
        """Return the gain of the sensor at a place."""
        return math.prod(t.gain(p) for t, p in self.at_sensor(full, active, place))

    def at_sensor(self, full: Array, active: Iterable[str], place: str) -> list[tuple[SensorTerm, tuple[float, ...]]]:
        """Return the terms of the sensor at a place that act from the beginning, with the parameters of each."""
        chosen = set(active)
        return [
            (term, self.values(full, key, SILENT))
            for key, term in self.channel_terms.items()
            if isinstance(term, SensorTerm)
            and key in chosen
            and term.at == place
            and not self.onset(full, key) > ALWAYS
        ]

    def changes_at_sensor(self, full: Array, active: Iterable[str], place: str) -> tuple[SensorChange, ...]:
        """Return the changes of gain and offset of the sensor at a place, from terms with an onset."""
        keys = [key for key in self.rescaling if key in set(active) and self.onset(full, key) > ALWAYS]
        found = []
        for key in keys:
            term, p = self.channel_terms[key], self.values(full, key, SILENT)
            if isinstance(term, SensorTerm) and term.at == place and (term.gain(p), term.offset(p)) != (1.0, 0.0):
                found.append(SensorChange(term.gain(p), term.offset(p), self.onset(full, key)))
        return tuple(found)

    @cached_property
    def bending_terms(self) -> tuple[str, ...]:
        """The keys of the terms that make a sensor nonlinear."""
        bent = SensorTerm.bent
        return tuple(k for k, t in self.channel_terms.items() if isinstance(t, SensorTerm) and type(t).bent is not bent)

    @cached_property
    def lagging_terms(self) -> tuple[str, ...]:
        """The keys of the sensor terms that have states of their own."""
        return tuple(key for key, term in self.channel_terms.items() if term.acts == "sensor" and term.states)

    def has_sensor_terms(self, active: Iterable[str]) -> bool:
        """Return whether any sensor term is active."""
        return any(isinstance(self.channel_terms[key], SensorTerm) for key in set(active) & set(self.channel_terms))

    @cached_property
    def has_delay_terms(self) -> bool:
        """Whether any of the terms delays a sensor."""
        return any(isinstance(t, SensorTerm) and type(t).delay is not SensorTerm.delay for t in self.terms)

    def senses_force(self, name: str) -> bool:
        """Return whether a channel shows the forces on a body at once, as an accelerometer does."""
        return name in self._felt

    @cached_property
    def _felt(self) -> frozenset[str]:
        """The channels that depend on the derivatives of states on which forces act."""
        model, rng = self.equations, np.random.default_rng(0)
        y, u = rng.random(len(model.states)), rng.random(max(len(model.inputs), 1))
        p, seen, pushed = rng.random(len(model.params)), np.zeros(len(model.channels)), np.zeros(len(model.channels))
        still, push = np.zeros(len(y)), np.zeros(len(y))
        push[[body.row for body in self.blueprint.bodies]] = 1.0
        model.observe(0.0, y, still, u, p, seen)
        model.observe(0.0, y, push, u, p, pushed)
        return frozenset(name for name, a, b in zip(model.channels, seen, pushed, strict=True) if a != b)

    def channel(self, name: str) -> tuple[int, int]:
        """Return the index of an observed channel, and that of the state that it equals (-1 where there is none)."""
        if name not in self.model.channels:
            known = ", ".join(self.model.channels)
            raise ContractError(
                f"{self.model.name} does not show {name!r}{nearest(name, self.model.channels)}: it shows {known}"
            )
        direct = self.model.states.index(name) if name in self.model.states else NUMB
        return self.model.channels.index(name), direct

    def shown(self, sensor: Sensor, active: Iterable[str]) -> tuple[int, int]:
        """Return the index of the channel of a sensor, and that of the state that it equals (-1 where there is none).

        One with a state of its own shows that.
        """
        chosen = set(active) & set(self.lagging_terms)
        if not chosen:
            return self.channel(sensor.channel)
        for (key, term), at in zip(self.forces, self.wiring(active)[1], strict=True):
            if key in chosen and isinstance(term, SensorTerm) and term.at == sensor.place:
                return self.channel(sensor.channel)[0], int(at)
        return self.channel(sensor.channel)

    def simulate(self, full: Array, active: Iterable[str], y0: Array, drive: Drive, nsub: int = 1) -> Motion:
        """Return the free motion by RK4, `nsub` steps to a sample, from the state `y0` under `drive`.

        States that `y0` lacks, those of terms, begin at zero; inputs that `drive` lacks are zero.
        """
        chosen, drive = frozenset(active), drive.pad_inputs(len(self.model.inputs))
        start = np.zeros((1, self.states(chosen)))
        start[0, : min(start.shape[1], len(y0))] = y0[: start.shape[1]]
        packed = self.pack(full[None], drive.dt / nsub, drive.harmonic)
        states, reached = run_freely(
            self, chosen, packed, start, drive, nsub, np.zeros(1, dtype=np.int64), drive.samples
        )
        return Motion(states[0], int(reached[0]))

    def moved(
        self,
        full: Array,
        y0: Array,
        columns: Sequence[Callable[[Array], Array]],
        clock: Clock,
        harmonic: DriveHarmonic = SILENT,
    ) -> Motion:
        """Return the free motion with all terms under inputs that are functions of time (s).

        Each step has a cubic of its own, so the inputs may have any frequency that the steps resolve.
        """
        dt, count, states, done = clock.dt / clock.nsub, max(PIECE // clock.nsub, 1), [], 0
        start = np.zeros(self.states(self.everything))
        start[: min(len(start), len(y0))] = y0[: len(start)]
        while done < clock.samples:
            steps = min(count, clock.samples - done) * clock.nsub + 1
            drive = replace(Drive.smooth(columns, dt, steps, done * clock.dt), harmonic=harmonic)
            piece = self.simulate(full, self.everything, start, drive)
            states.append(piece.states[: -1 : clock.nsub])
            start = piece.states[-1]
            done += count
        seen = np.concatenate(states)
        bad = np.flatnonzero(~np.isfinite(seen).all(axis=1))
        return Motion(seen, int(bad[0]) if len(bad) else len(seen))

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
        """Return the derivatives (sets, points, n) of states (points, n), and the channels (sets, points, channels).

        `packed` (sets, params) are parameters as `pack` returns them, `inputs` (points, inputs), `times` (points,) in
        s, zero if not given. The force with the key `muted` is switched off, and its states stay; `latent` are the
        numbers of states that are random forces.
        """
        return compute_each(self, active, packed, states, inputs, times, muted=muted, latent=latent)

    def compute_derivatives(
        self, active: frozenset[str], packed: Array, states: Array, inputs: Array, times: Any = None
    ) -> tuple[Array, Array]:
        """Return what `compute_each` returns for one set of parameters (1, params): (points, n), (points, channels)."""
        rates, seen = self.compute_each(active, packed, states, inputs, times)
        return rates[0], seen[0]

    def accelerate(self, rates: Array, place: Place) -> Array:
        """Return the acceleration (...) of the body at a place, from derivatives of the states (..., n)."""
        return np.asarray(rates[..., self._interface(place).row])

    def kick(self, full: Array, place: Place) -> Array:
        """Return the change of the states (n,) of the model by one unit (N s or N m s) of impulse at a place."""
        changed = np.zeros(len(self.model.states))
        changed[self._interface(place).row] = 1.0 / self.own_inertia(full, place)
        return changed

    def compute_force(
        self, key: str, active: frozenset[str], packed: Array, along: tuple[Array, Array, Array]
    ) -> Array:
        """Return the force (samples,) of a term at its place, `along` states (samples, n), inputs and times (samples,).

        `packed` is (1, params), as `pack` returns it.
        """
        place = self._interface(place_of(self.model, dict(self.forces)[key]))
        both = (self.compute_each(active, packed, *along, muted=muted)[0][0] for muted in (None, key))
        with_term, without = (self.accelerate(rates, place) for rates in both)
        return np.asarray((with_term - without) * packed[0, self.index[place.inertia]])

    @property
    def bodies(self) -> int:
        """The number of bodies on which a random force acts."""
        return len(self.blueprint.bodies)

    def holds_forces(self, channels: Iterable[str]) -> bool:
        """Return whether random forces are held over each sample: where a sensor of these channels shows them."""
        return any(self.senses_force(name) for name in channels)

    @property
    def inertia_keys(self) -> frozenset[str]:
        """The parameters that are an inertia at a place and have to be above zero."""
        return frozenset(place.inertia for place in self.equations.interfaces)

    def spread_states(self, positions: Array, velocities: Array) -> Array:
        """Return states (points, n) with these positions and velocities (points,) of the first body, else zero."""
        states = np.zeros((len(positions), len(self.model.states)))
        position, velocity = self.model.first_body
        states[:, position], states[:, velocity] = positions, velocities
        return states

    def count_substeps(
        self, rate: float, dt: float, accuracy: float, *, active: frozenset[str] = frozenset(), held: bool = False
    ) -> int:
        """Return the number of steps in a sample of `dt` s, where the fastest rate of the motion is `rate` (1/s).

        `accuracy` is the largest product of step and rate, and `held` says that inputs are constant over a sample.
        """
        return count_substeps(rate, dt, accuracy=accuracy)

    def find_fastest_rate(
        self, full: Array, active: Iterable[str], states: Array, inputs: Array, dt: float = 1.0
    ) -> float:
        """Return the fastest rate (1/s) of the linearised motion over the given states (points, n) and inputs.

        `dt` is the time (s) between two samples, over which a machine is stepped that has no equations.

        Infinite on overflow. A state that is the same at all points, such as that of a second body with unknown motion,
        is perturbed by as little as the one that varies least.
        """
        chosen, (points, m) = frozenset(active), states.shape
        wide = np.ptp(states, axis=0)
        wide = np.where(wide > 0.0, wide, np.min(wide, where=wide > 0.0, initial=np.max(wide)))
        spread = np.maximum(1e-6 * (wide + 1e-12), 1e-9 * np.abs(states).max(axis=0))
        moved = np.zeros((m + 1, points, self.states(chosen)))
        moved[:, :, :m] = states
        for a in range(m):
            moved[a + 1, :, a] += spread[a]
        tiled = np.tile(inputs, (m + 1, 1))
        rates, _ = self.compute_derivatives(
            chosen, self.pack(full[None], 1.0), moved.reshape(-1, moved.shape[2]), tiled
        )
        rates = rates.reshape(moved.shape)[:, :, :m]
        with np.errstate(over="ignore", invalid="ignore"):
            jacobians = np.moveaxis((rates[1:] - rates[0]) / spread[:, None, None], 0, 2)
        if not np.all(np.isfinite(jacobians)):
            return math.inf
        return float(np.abs(np.linalg.eigvals(jacobians)).max(initial=0.0))
