"""Simulation of a machine: a model with terms, parameters by name, a drive, and the readings of its sensors."""

from __future__ import annotations

import functools
import json
import math
import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lostmotion.contracts import Array, Assembly, Machine, SensorTerm, Term
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.likelihood.drive import SILENT, Drive, DriveHarmonic
from lostmotion.likelihood.observation import Observation, find_harmonic
from lostmotion.likelihood.stepped import make_system
from lostmotion.likelihood.system import Clock, Slot, System, key_of
from lostmotion.preparation.vetting import make_plugin
from lostmotion.provenance import provenance
from lostmotion.quantities import unit_of
from lostmotion.registry import Registry
from lostmotion.simulation.drive_signals import DriveSignal, parse_number, parse_pairs, signal_of
from lostmotion.storage import save_table

ACCURACY = 0.02
"""Step times fastest rate: 300 steps per cycle. At a kink the method is of first order for any step."""
FEWEST, LARGEST = 4, 10_000_000
"""The least number of steps between samples, and the greatest number in total, which needs a gigabyte."""
PROBES = 200
HUGE = 1e150
"""The limit of inputs and channels: the square of a larger number would be infinite."""


@dataclass(frozen=True)
class Plan:
    """The description of a simulation; `duration` in s, `rate` in Hz, everything else in the units of the model.

    `values` and `initial` name parameters (`c`, `coulomb_friction@base.force`) and states. Several `drives` add up.
    `noise` is the standard deviation of white noise on each channel, as a share of that of the channel. `origins` are
    the digests or versions of the third-party plugins that are used.
    """

    assembly: Assembly
    values: Mapping[str, float]
    drives: tuple[str, ...]
    duration: float
    rate: float
    initial: Mapping[str, float] = field(default_factory=dict)
    noise: float = 0.0
    seed: int = 0
    origins: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class SimulatedTable:
    """Columns (samples,) by name: `time`, the inputs, the channels; with units and provenance."""

    columns: Mapping[str, Array]
    units: Mapping[str, str]
    attrs: Mapping[str, str]
    nsub: int

    def save(self, path: Path) -> None:
        """Write a .csv or .nc file atomically."""
        save_table(path, self.columns, self.units, self.attrs)


@dataclass(frozen=True, eq=False)
class FreeMotion:
    """A free motion: `times` (samples,) in s, `inputs` (samples, inputs), the `channels` (samples,) by name."""

    system: System
    full: Array
    times: Array
    inputs: Array
    channels: Mapping[str, Array]
    nsub: int


def run_free_motion(
    assembly: Assembly,
    values: Mapping[str, float],
    columns: Sequence[Callable[[Array], Array]],
    samples: int,
    rate: float,
    initial: Mapping[str, float],
) -> FreeMotion:
    """Return the free motion of a model with its terms; `columns` are the first inputs of the model over time (s).

    Raises `CaseError` where the motion diverges or needs too many steps.
    """
    system = make_system(assembly.model, assembly.terms)
    full, y0 = _make_parameters(system, values), _make_initial(assembly.model, initial)
    times = np.arange(samples) / rate
    inputs = np.stack([column(times) for column in columns], axis=1)
    if not np.abs(inputs).max() < HUGE:
        raise CaseError(f"the drive reaches {np.abs(inputs).max():.3g}: check its unit")
    nsub = _choose_substeps(system, full, y0, inputs, 1.0 / rate)
    acting, harmonic = _acting_inputs(system, full, columns, inputs, 1.0 / rate)
    motion = system.moved(full, y0, acting, Clock(1.0 / rate, nsub, samples), harmonic)
    acts = np.stack([column(times) for column in acting], axis=1)
    packed = system.pack(full[None], 1.0 / (rate * nsub), harmonic)
    _, seen = system.compute_derivatives(system.everything, packed, motion.states, acts, times)
    channels = dict(zip(assembly.model.channels, seen.T, strict=True))
    if motion.finite < samples or not all(np.abs(x).max() < HUGE for x in channels.values()):
        raise CaseError(
            f"the motion diverged after {motion.finite / rate:.4g} s of {samples / rate:g} s:"
            " check the signs and sizes of the parameters"
        )
    return FreeMotion(system, full, times, inputs, channels, nsub)


def simulate(plan: Plan) -> SimulatedTable:
    """Return the simulated columns of `plan`, sampled at 0, 1/rate, ... up to but not including `duration`."""
    samples = _count_samples(plan)
    signals = _make_inputs(plan)
    columns = [signal.value for signal in signals]
    moved = run_free_motion(plan.assembly, plan.values, columns, samples, plan.rate, plan.initial)
    shown = dict(zip(plan.assembly.model.driven, moved.inputs.T, strict=True))
    shown |= _apply_sensors(moved.system, moved.full, _add_noise(moved.channels, plan), plan)
    return _make_table(plan, {"time": moved.times, **shown}, moved.nsub)


def assembly_of(
    registry: Registry, model: str, terms: Iterable[str], motion: str | None = None
) -> tuple[Assembly, dict[str, float]]:
    """Return model plus terms, and the parameters given with the terms, from `NAME[@PLACE][:param=value,...]`.

    `motion` is "translation" or "rotation"; by default the model is not changed.
    """
    made: Machine = make_plugin(registry, "model", model)
    assembly, values = Assembly(made.turned(motion) if motion else made), {}
    for text in terms:
        head, _, rest = text.partition(":")
        name, _, place = head.partition("@")
        term = make_plugin(registry, "term", name, **({"at": place} if place else {}))
        assembly = assembly + term
        for key, value in parse_pairs(rest, f"term {text!r}").items():
            _require_parameter(term, key)
            values[f"{key_of(term)}.{key}"] = parse_number(value, f"{key} of {name}")
    return assembly, values


def _require_parameter(term: Term, key: str) -> None:
    """Raise `CaseError` if a term has no parameter of this name."""
    known = [q.name for q in term.params]
    if key not in known:
        raise CaseError(f"{term.name} has no parameter {key!r}{nearest(key, known)}: it has {', '.join(known)}")


def _count_samples(plan: Plan) -> int:
    """Return the number of samples after a check of the numbers in the plan."""
    for what, value in (("duration", plan.duration), ("rate", plan.rate)):
        if not (0.0 < value < math.inf):
            raise CaseError(f"the {what} is {value:g}: expected a finite number above zero")
    if not (0.0 <= plan.noise < math.inf):
        raise CaseError(f"the noise is {plan.noise:g}: expected a share of the standard deviation, such as 0.01")
    samples = plan.duration * plan.rate
    if not 1.5 <= samples <= LARGEST / FEWEST:
        raise CaseError(
            f"{plan.duration:g} s at {plan.rate:g} Hz is {samples:.4g} samples: expected 2 to {LARGEST // FEWEST}"
        )
    return round(samples)


def _make_parameters(system: System, values: Mapping[str, float]) -> Array:
    """Return the full parameter vector; raise `CaseError` that names missing parameters with their units."""
    given = {system.slot(name).key: value for name, value in values.items()}
    lacking = [slot for slot in system.slots if slot.key not in given and _is_required(slot)]
    if lacking:
        names = ", ".join(f"{slot.key} ({slot.param.meaning}, {slot.unit})" for slot in lacking)
        raise CaseError(f"{system.model.name} lacks {names}: add --set {lacking[0].key}=...")
    for slot in system.slots:
        _require_bounds(slot, given.get(slot.key), slot.key in system.inertia_keys)
    return system.vector(given)


def _is_required(slot: Slot) -> bool:
    """Return whether a parameter must be given: each one of a term, and those of a model that cannot be zero."""
    return slot.term is not None or slot.param.scale == "log" or slot.param.low > 0.0


def _require_bounds(slot: Slot, value: float | None, inertia: bool) -> None:
    q = slot.param
    if value is None or (q.low <= value <= q.high and (value > 0.0 or not inertia)):
        return
    wanted = "above 0" if inertia else f"from {q.low:g} to {q.high:g}"
    raise CaseError(f"{slot.key} ({q.meaning}) is {value:g}: expected a value {wanted} {slot.unit}")


def _make_initial(model: Machine, initial: Mapping[str, float]) -> Array:
    """Return the initial state, zero where no value is given."""
    states = model.states
    for name in initial:
        if name not in states:
            raise CaseError(f"{model.name} has no state {name!r}{nearest(name, states)}: it has {', '.join(states)}")
    return np.array([float(initial.get(name, 0.0)) for name in states])


def _make_inputs(plan: Plan) -> list[DriveSignal]:
    """Return a signal for each driven input of the model: the drive itself, and its derivative for a base velocity."""
    model = plan.assembly.model
    if not plan.drives:
        raise CaseError(f"nothing drives {model.name}: add --drive, such as harmonic:amplitude=1,frequency=2")
    streams = np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=(0,))).spawn(len(plan.drives))
    parts = [signal_of(d, duration=plan.duration, rng=r) for d, r in zip(plan.drives, streams, strict=True)]
    total = functools.reduce(operator.add, parts)
    if total.top > 0.5 * plan.rate:
        raise CaseError(
            f"the drive reaches {total.top:.4g} Hz, which {plan.rate:g} samples per second cannot show:"
            f" expected a rate above {2.0 * total.top:.4g} Hz, or a slower drive"
        )
    slope = DriveSignal(total.slope, total.slope, total.top)
    return [slope if name == "base_velocity" else total for name in model.driven]


def _acting_inputs(
    system: System, full: Array, columns: Sequence[Callable[[Array], Array]], inputs: Array, dt: float
) -> tuple[list[Callable[[Array], Array]], DriveHarmonic]:
    """Return the acting inputs as functions of time, which drive terms derive from the recorded inputs.

    The harmonic is the one that a diagnosis would find in the recorded samples.
    """
    harmonic = find_harmonic(Observation.of("drive", np.zeros(len(inputs)), inputs, dt, ""))
    acting = system.acting(columns, full, system.list_input_terms(system.everything), harmonic)
    return [there or recorded for there, recorded in zip(acting, columns, strict=True)], harmonic


def _apply_sensors(system: System, full: Array, channels: Mapping[str, Array], plan: Plan) -> dict[str, Array]:
    """Return the stored readings: the channels, with the effects of sensor terms on the first one."""
    shown, first = dict(channels), plan.assembly.model.channels[0]
    gain = system.gain(full, system.everything)
    shown[first] = gain * shown[first]
    for change in system.changes_at_sensor(full, system.everything, "sensor"):
        shown[first] = change.apply(shown[first], np.arange(len(shown[first])) / plan.rate)
    for key, term in system.channel_terms.items():
        if isinstance(term, SensorTerm):
            shown[first] = term.rounded(shown[first], system.values(full, key, SILENT))
    return shown


def _choose_substeps(system: System, full: Array, y0: Array, recorded: Array, dt: float) -> int:
    """Return the number of steps between samples from the fastest rate in a coarse run; `CaseError` for too many.

    The coarse run may be unstable; it then still reaches the contacts, which have the fastest rates.
    """
    n, samples = len(system.model.states), len(recorded)
    motion = system.simulate(full, system.everything, y0, Drive.held(recorded, dt), FEWEST)
    picked = np.unique(np.linspace(0, max(motion.finite - 1, 0), PROBES).astype(int))
    rate = system.find_fastest_rate(full, system.everything, motion.states[picked, :n], recorded[picked], dt)
    asked = rate * dt / ACCURACY
    if not asked * samples <= LARGEST:
        after = f"diverged after {motion.finite * dt:.4g} s, or " * (motion.finite < samples)
        raise CaseError(
            f"the motion {after}is too stiff: {rate:.3g} rad/s ask for {asked:.3g} steps between samples, and at most"
            f" {LARGEST} in total are allowed; check signs and sizes of the parameters, or shorten the duration"
        )
    return max(FEWEST, math.ceil(asked))


def _add_noise(channels: Mapping[str, Array], plan: Plan) -> dict[str, Array]:
    """Return the channels with white noise; the noise of a channel does not depend on the other channels."""
    streams = np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=(1,))).spawn(len(channels))
    both = zip(channels.items(), streams, strict=True)
    return {name: x + plan.noise * x.std() * rng.standard_normal(len(x)) for (name, x), rng in both}


def _make_table(plan: Plan, columns: Mapping[str, Array], nsub: int) -> SimulatedTable:
    model = plan.assembly.model
    settings = {
        "values": dict(plan.values), "initial": dict(plan.initial), "drives": list(plan.drives),
        "terms": [key_of(t) for t in plan.assembly.terms], "duration": plan.duration, "rate": plan.rate,
        "noise": plan.noise, "substeps": nsub,
    }  # fmt: skip
    if model.motion != type(model).motion:
        settings["motion"] = model.motion
    made = provenance(f"simulate {model.name}", settings, plan.seed, plan.origins)
    attrs = {
        "schema": "lostmotion.simulate/1",
        "title": plan.assembly.label,
        "provenance": json.dumps(made, sort_keys=True),
    }
    return SimulatedTable(columns, {name: _unit_of(name, model) for name in columns}, attrs, nsub)


def _unit_of(name: str, model: Machine) -> str:
    """Return the SI unit of a column, or "1" for an unknown one."""
    try:
        return "s" if name == "time" else unit_of(name, model.motion)
    except DataError:
        return "1"
