"""A machine whose parameters, dimensionless numbers, drive and initial state can be set or swept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from lostmotion.contracts import Array, Assembly, Flow, Group
from lostmotion.errors import CaseError, nearest
from lostmotion.likelihood.system import System
from lostmotion.quantities import unit_of
from lostmotion_chaos.flows.flow import Harmonic, flow_of

DRIVE = {"amplitude": "amplitude of the drive", "omega": "angular frequency of the drive", "phase": "its phase"}
DEFAULT_OMEGA = 0.2
"""Drive frequency of a normalised machine, relative to its natural frequency, as in Table 1 of the paper."""


@dataclass(frozen=True)
class Knob:
    """A quantity of a machine that can be set; `kind` is "group", "parameter", "drive" or "start"."""

    name: str
    kind: str
    key: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class SweptMachine:
    """A model with its terms, the quantities that are `fixed`, and the names of those that are `swept`.

    It is normalised where no parameter of the model is set: all parameters that set a scale are then one, times are in
    units of 1 / omega_0 (t_bar), and the dimensionless numbers of the model determine everything else.
    """

    assembly: Assembly
    swept: tuple[str, ...]
    fixed: Mapping[str, float] = field(default_factory=dict)

    def __reduce__(self) -> tuple[type[SweptMachine], tuple[object, ...]]:
        """Return what a worker needs to construct this machine again, without compiled or cached objects."""
        return SweptMachine, (self.assembly, self.swept, dict(self.fixed))

    @cached_property
    def system(self) -> System:
        """The model with its terms in executable form."""
        return System.of(self.assembly)

    @cached_property
    def groups(self) -> Mapping[str, Group]:
        """The dimensionless numbers of the model by name."""
        return {group.name: group for group in self.assembly.model.groups}

    @cached_property
    def normalised(self) -> bool:
        """Whether the parameters of the model are one and time is in units of t_bar."""
        knobs = [self.find_knob(name) for name in (*self.fixed, *self.swept)]
        own = any(knob.kind == "parameter" and "." not in knob.key for knob in knobs)
        return bool(self.groups) and not own

    @property
    def time_unit(self) -> str:
        """The unit of a time."""
        return "t_bar" if self.normalised else "s"

    def find_knob(self, name: str) -> Knob:
        """Return the quantity called `name`, or raise `CaseError` with the nearest known name."""
        head, _, tail = name.partition(".")
        if name in self.groups:
            group = self.groups[name]
            return Knob(name, "group", group.target, "1", f"{group.meaning}, {group.formula}")
        if head == "drive" and tail in DRIVE:
            return Knob(name, "drive", name, self._get_drive_unit(tail), DRIVE[tail])
        if head == "start" and tail in self.assembly.model.states:
            return Knob(name, "start", name, "", f"{tail} at the start")
        return self._find_parameter(name)

    def _find_parameter(self, name: str) -> Knob:
        wanted = self.assembly.model.aliases.get(name, name)
        for slot in self.system.slots:
            if slot.key == wanted:
                return Knob(name, "parameter", slot.key, slot.unit, slot.param.meaning)
        states = [f"start.{state}" for state in self.assembly.model.states]
        known = [*self.groups, *(s.key for s in self.system.slots), *(f"drive.{key}" for key in DRIVE), *states]
        raise CaseError(f"{self.assembly.label} has no {name!r}{nearest(name, known)}: it has {', '.join(known)}")

    def get_unit(self, name: str) -> str:
        """Return the unit in which a quantity is swept."""
        return "1" if self.normalised else self.find_knob(name).unit or "1"

    def _get_drive_unit(self, key: str) -> str:
        if key != "amplitude":
            return "rad/s" if key == "omega" else "rad"
        return unit_of(self.assembly.model.inputs[0], self.assembly.model.motion)

    def validate(self) -> SweptMachine:
        """Return this machine, or raise `CaseError` when a quantity is unknown, set twice, or missing."""
        found: dict[str, str] = {}
        for name in (*self.fixed, *self.swept):
            knob = self.find_knob(name)
            if knob.key in found:
                raise CaseError(f"{found[knob.key]} and {name} both set {knob.key}: keep one")
            found[knob.key] = name
        if self.normalised:
            missing = [g.name for g in self.groups.values() if g.target not in found and self._needs_value(g.target)]
        else:
            missing = [f"drive.{key}" for key in ("amplitude", "omega") if f"drive.{key}" not in found]
        if missing:
            raise CaseError(
                f"{missing[0]} is not given: add --set {missing[0]}=..., or sweep it with --x, --y or --axis"
            )
        return self

    def _needs_value(self, target: str) -> bool:
        """Return whether the target of a dimensionless number has no default value."""
        if target.startswith("drive."):
            return target == "drive.amplitude"
        return self.system.slot(target).param.scale == "log"

    @cached_property
    def _knobs(self) -> Mapping[str, Knob]:
        return {name: self.find_knob(name) for name in (*self.fixed, *self.swept)}

    @cached_property
    def _default_values(self) -> dict[str, float]:
        """Values of parameters and drive before anything is set."""
        if not self.normalised:
            return {}
        ones = {q.name: 1.0 for q in self.assembly.model.params if q.scale == "log"}
        return {**ones, "drive.omega": DEFAULT_OMEGA}

    def flow(self, point: Mapping[str, float]) -> tuple[Flow, dict[int, float]]:
        """Return the flow at the swept values `point`, and the given initial values of states (index: value)."""
        numbers, values, begin = {**self.fixed, **point}, dict(self._default_values), {}
        for name, number in numbers.items():
            knob = self._knobs[name]
            if knob.kind == "start":
                begin[self.assembly.model.states.index(name.partition(".")[2])] = number
            elif knob.kind != "group":
                values[knob.key] = number
        for group in self.assembly.model.groups:
            if group.name in numbers:
                values[group.target] = group.law(values, numbers[group.name])
        drive = Harmonic(*(values.pop(f"drive.{key}", 0.0) for key in DRIVE))
        return flow_of(self.system, values, drive=drive), begin


def measure_extent(flow: Flow, periods: int, looks: int = 8) -> Array:
    """Return the largest absolute value (n,) of each state on the way from the start, one where it does not move."""
    sample = getattr(flow, "sample", None)
    seen = sample(flow.start, periods=periods, looks=looks) if sample else _sample_strobe(flow, periods)
    seen = seen[np.isfinite(seen).all(axis=1) & (np.abs(seen) < 1e6 * (1.0 + np.abs(seen[:1]))).all(axis=1)]
    size = np.abs(seen).max(axis=0, initial=0.0)
    wide: Array = np.where(size > 0.0, size, float(size.max(initial=0.0)) or 1.0)
    return wide


def _sample_strobe(flow: Flow, periods: int) -> Array:
    return flow.strobe(flow.start, periods=periods, tangents=0).states
