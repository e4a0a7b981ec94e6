"""A machine set in motion: a model with terms, parameters by name, a drive, and what its sensors would show."""

from __future__ import annotations

import functools
import json
import math
import operator
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lostmotion.beside import SensorTerm
from lostmotion.contracts import Array, Assembly, Model, Term
from lostmotion.errors import CaseError, nearest
from lostmotion.forcing import SILENT, Drive
from lostmotion.inference.tracks import Track, tone_of
from lostmotion.provenance import provenance
from lostmotion.quantities import ANGULAR, SI
from lostmotion.registry import Registry
from lostmotion.storage import save_table
from lostmotion.system import Slot, System, key_of
from lostmotion.workflow.drives import Signal, number, pairs, signal_of
from lostmotion.workflow.vetting import sound

ACCURACY = 0.02
"""Step times fastest rate: 300 steps a cycle. At a kink the method is of first order, whatever the step."""
FEWEST, LARGEST = 4, 10_000_000
"""Steps between samples at least, and steps in all at most, which is what a gigabyte holds."""
PROBES = 200
HUGE = 1e150
"""What no input and no channel reaches: its square would be infinite."""


@dataclass(frozen=True)
class Plan:
    """What is to be simulated; `duration` in s, `rate` in Hz, everything else in the units of the model.

    `values` and `initial` name parameters (`c`, `coulomb_friction@base.force`) and states. Several `drives` add up.
    `noise` is the standard deviation of white noise on each channel, as a share of that of the channel. `origins` are
    the digests or versions of the plugins of other people that take part.
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
class Table:
    """Columns (samples,) by name: `time`, the inputs, the channels; with their units and where they come from."""

    columns: Mapping[str, Array]
    units: Mapping[str, str]
    attrs: Mapping[str, str]
    nsub: int

    def save(self, path: Path) -> None:
        """Write a .csv or .nc file, whole or not at all."""
        save_table(path, self.columns, self.units, self.attrs)


def simulate(plan: Plan) -> Table:
    """Return the simulated columns of `plan`, sampled at 0, 1/rate, ... up to but not including `duration`."""
    samples = _samples(plan)
    system = System.of(plan.assembly)
    full, y0 = _parameters(system, plan.values), _initial(plan)
    signals = _inputs(plan)
    coarse = _drive(signals, plan, 1)
    if not np.abs(coarse.u).max() < HUGE:
        raise CaseError(f"the drive reaches {np.abs(coarse.u).max():.3g}: check its unit")
    nsub = _substeps(system, full, y0, coarse)
    recorded = _drive(signals, plan, nsub)
    drive = _acting(system, full, signals, recorded)
    motion = system.simulate(full, system.everything, y0, drive)
    inputs = recorded.u[:: 3 * nsub]
    columns = dict(zip(plan.assembly.model.inputs, inputs.T, strict=True))
    channels = _channels(system, full, motion.states, drive)
    if motion.finite < samples or not all(np.abs(x).max() < HUGE for x in channels.values()):
        raise CaseError(
            f"the motion left all bounds after {motion.finite / plan.rate:.4g} s of {plan.duration:g} s:"
            " check the signs and sizes of the parameters"
        )
    columns |= _shown(system, full, _noisy(channels, plan), plan)
    return _table(plan, {"time": np.arange(samples) / plan.rate, **columns}, nsub)


def assembly_of(registry: Registry, model: str, terms: Iterable[str]) -> tuple[Assembly, dict[str, float]]:
    """Return model plus terms, and the parameters given with the terms, from `NAME[@PLACE][:param=value,...]`."""
    assembly, values = Assembly(sound(registry, "model", model)), {}
    for text in terms:
        head, _, rest = text.partition(":")
        name, _, place = head.partition("@")
        term = sound(registry, "term", name, **({"at": place} if place else {}))
        assembly = assembly + term
        for key, value in pairs(rest, f"term {text!r}").items():
            values[f"{key_of(term)}.{_own(term, key)}"] = number(value, f"{key} of {name}")
    return assembly, values


def _own(term: Term, key: str) -> str:
    """Return the name of a term's parameter from its name or an alias."""
    for q in term.params:
        if key in (q.name, *q.aliases):
            return q.name
    known = [q.name for q in term.params]
    raise CaseError(f"{term.name} has no parameter {key!r}{nearest(key, known)}: it has {', '.join(known)}")


def _samples(plan: Plan) -> int:
    """Return the number of samples, having looked at the numbers of the plan."""
    for what, value in (("duration", plan.duration), ("rate", plan.rate)):
        if not (0.0 < value < math.inf):
            raise CaseError(f"the {what} is {value:g}: wanted a finite number above zero")
    if not (0.0 <= plan.noise < math.inf):
        raise CaseError(f"the noise is {plan.noise:g}: wanted a share of the standard deviation, such as 0.01")
    samples = plan.duration * plan.rate
    if not 1.5 <= samples <= LARGEST / FEWEST:
        raise CaseError(
            f"{plan.duration:g} s at {plan.rate:g} Hz is {samples:.4g} samples: wanted 2 to {LARGEST // FEWEST}"
        )
    return round(samples)


def _parameters(system: System, values: Mapping[str, float]) -> Array:
    """Return the full parameter vector; what must be given and is not is named with its unit."""
    given = {system.slot(name).key: value for name, value in values.items()}
    lacking = [slot for slot in system.slots if slot.key not in given and _needed(slot)]
    if lacking:
        names = ", ".join(f"{slot.key} ({slot.param.meaning}, {slot.unit})" for slot in lacking)
        raise CaseError(f"{system.model.name} lacks {names}: add --set {lacking[0].key}=...")
    inertias = {place.inertia for place in system.model.interfaces}
    for slot in system.slots:
        _require_bounds(slot, given.get(slot.key), slot.key in inertias)
    return system.vector(given)


def _needed(slot: Slot) -> bool:
    """Return whether a parameter must be given: all of a term; of a model, those that are not simply absent at zero."""
    return slot.term is not None or slot.param.scale == "log" or slot.param.low > 0.0


def _require_bounds(slot: Slot, value: float | None, inertia: bool) -> None:
    q = slot.param
    if value is None or (q.low <= value <= q.high and (value > 0.0 or not inertia)):
        return
    wanted = "above 0" if inertia else f"from {q.low:g} to {q.high:g}"
    raise CaseError(f"{slot.key} ({q.meaning}) is {value:g}: wanted a value {wanted} {slot.unit}")


def _initial(plan: Plan) -> Array:
    """Return the state to start from: zero where nothing is given."""
    states = plan.assembly.model.states
    for name in plan.initial:
        if name not in states:
            raise CaseError(
                f"{plan.assembly.model.name} has no state {name!r}{nearest(name, states)}: it has {', '.join(states)}"
            )
    return np.array([float(plan.initial.get(name, 0.0)) for name in states])


def _inputs(plan: Plan) -> list[Signal]:
    """Return a signal for each input of the model: the drive itself, and its derivative for a base velocity."""
    model = plan.assembly.model
    if not plan.drives:
        raise CaseError(f"nothing drives {model.name}: add --drive, such as harmonic:amplitude=1,frequency=2")
    streams = np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=(0,))).spawn(len(plan.drives))
    parts = [signal_of(d, duration=plan.duration, rng=r) for d, r in zip(plan.drives, streams, strict=True)]
    total = functools.reduce(operator.add, parts)
    if total.top > 0.5 * plan.rate:
        raise CaseError(
            f"the drive reaches {total.top:.4g} Hz, of which {plan.rate:g} samples per second show nothing:"
            f" wanted a rate above {2.0 * total.top:.4g} Hz, or a slower drive"
        )
    known = {"force": total, "base_position": total, "base_velocity": Signal(total.slope, total.slope, total.top)}
    for name in model.inputs:
        if name not in known:
            raise CaseError(
                f"{model.name} is driven by {name}, which simulate cannot make: it makes {', '.join(known)}"
            )
    return [known[name] for name in model.inputs]


def _drive(signals: list[Signal], plan: Plan, nsub: int) -> Drive:
    samples = round(plan.duration * plan.rate)
    return Drive.smooth([s.value for s in signals], 1.0 / plan.rate, nsub, samples)


def _acting(system: System, full: Array, signals: list[Signal], recorded: Drive) -> Drive:
    """Return the drive that acts, where terms stand between it and what is recorded.

    Its tone is what a diagnosis would read off its samples.
    """
    u = recorded.u[:: 3 * recorded.nsub]
    tone = tone_of(Track("drive", np.zeros(len(u)), u, recorded.dt, ""))
    plain = replace(recorded, tone=tone)
    if not system.shaping(system.everything):
        return plain
    acting = system.acting(lambda t, order: signals[order].value(t), full, system.everything, tone)
    return Drive.acting(acting, len(signals), plain, False)


def _shown(system: System, full: Array, channels: Mapping[str, Array], plan: Plan) -> dict[str, Array]:
    """Return what the sensors store: the first channel, with what the terms of a sensor make of it."""
    shown, first = dict(channels), plan.assembly.model.channels[0]
    gain = system.gain(full, system.everything)
    shown[first] = gain * shown[first]
    for key, term in system.beside.items():
        if isinstance(term, SensorTerm):
            shown[first] = term.rounded(shown[first], system.values(full, key, SILENT))
    return shown


def _substeps(system: System, full: Array, y0: Array, coarse: Drive) -> int:
    """Return the steps between samples, from the fastest rate met in a coarse run, or refuse what would take too many.

    The coarse run may be unstable; it then still reaches the contacts, and they are what is fast.
    """
    n = len(system.model.states)
    rough = Drive(np.repeat(coarse.u.reshape(coarse.samples, -1), FEWEST, axis=0).reshape(-1, coarse.u.shape[1]),
                  coarse.dt, FEWEST, coarse.samples)  # fmt: skip
    motion = system.simulate(full, system.everything, y0, rough)
    picked = np.unique(np.linspace(0, max(motion.finite - 1, 0), PROBES).astype(int))
    states, inputs = motion.states[picked, :n], coarse.u[3 * picked]
    rate = system.stiffness(full, system.everything, states, inputs)
    asked = rate * coarse.dt / ACCURACY
    if not asked * coarse.samples <= LARGEST:
        after = f"left all bounds after {motion.finite * coarse.dt:.4g} s, or " * (motion.finite < coarse.samples)
        raise CaseError(
            f"the motion {after}is too stiff: {rate:.3g} rad/s ask for {asked:.3g} steps between samples, and {LARGEST}"
            " in all are taken at most; check signs and sizes of the parameters, or shorten the duration"
        )
    return max(FEWEST, math.ceil(asked))


def _channels(system: System, full: Array, states: Array, drive: Drive) -> dict[str, Array]:
    """Return what the sensors see (samples,) by channel, without noise."""
    model, n = system.model, states.shape[1]
    base, own = system.pack(full, drive.dt / drive.nsub)
    on, at = system.wiring(system.everything)
    derivative = system.kernel(system.everything).derivative
    seen, dydt = np.zeros((len(states), len(model.channels))), np.zeros(n)
    for k, y in enumerate(states):
        t, u = k * drive.dt, drive.u[3 * drive.nsub * k]
        derivative(t, y, u, base, own, on, at, 0.0, dydt)
        model.observe(t, y, dydt, u, base, seen[k])
    return dict(zip(model.channels, seen.T, strict=True))


def _noisy(channels: Mapping[str, Array], plan: Plan) -> dict[str, Array]:
    """Return the channels with white noise on each; the noise of a channel does not depend on the others."""
    streams = np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=(1,))).spawn(len(channels))
    both = zip(channels.items(), streams, strict=True)
    return {name: x + plan.noise * x.std() * rng.standard_normal(len(x)) for (name, x), rng in both}


def _table(plan: Plan, columns: Mapping[str, Array], nsub: int) -> Table:
    model = plan.assembly.model
    settings = {
        "values": dict(plan.values), "initial": dict(plan.initial), "drives": list(plan.drives),
        "terms": [key_of(t) for t in plan.assembly.terms], "duration": plan.duration, "rate": plan.rate,
        "noise": plan.noise, "substeps": nsub,
    }  # fmt: skip
    made = provenance(f"simulate {model.name}", settings, plan.seed, plan.origins)
    attrs = {
        "schema": "lostmotion.simulate/1",
        "title": plan.assembly.label,
        "provenance": json.dumps(made, sort_keys=True),
    }
    return Table(columns, {name: _unit(name, model) for name in columns}, attrs, nsub)


def _unit(name: str, model: Model) -> str:
    """Return the SI unit of a column; of one that nobody knows, "1"."""
    table = SI if model.motion == "translation" else {**SI, **ANGULAR}
    return table.get({"base_velocity": "velocity"}.get(name, name), "1")
