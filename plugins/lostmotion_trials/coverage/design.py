"""Where the machines of a calibration come from: a design is read, and they are drawn from the priors of its case."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from lostmotion.case import CaseFile, Prior, load_case
from lostmotion.contracts import Array, Group, Model, Term
from lostmotion.errors import CaseError
from lostmotion.identification.sampling import SamplingPlan
from lostmotion.inference.setup import make_known
from lostmotion.likelihood.system import Slot, System, key_of
from lostmotion.provenance import digest
from lostmotion.registry import Registry
from lostmotion.simulation.simulated_machine import assembly_of
from lostmotion_trials.coverage.machines import SeenMachine, Stand, describe_motion, record_machine

ROUTES = ("trajectory", "quantifiers")
MOST_DRAWS = 1000
"""Draws from a prior until one is a machine that can be: a normal prior may reach below zero."""


@dataclass(frozen=True)
class Design:
    """What is drawn and how it is identified: the case with its priors, the bench, what is hidden, the terms fitted.

    `hide` are terms with their values, `NAME[@PLACE]:param=value`, which act in every machine whether fitted or not.
    `plugins` are files that bring models or terms, beside those that the case names; `maps` are those that the route
    by quantifiers looks things up in.
    """

    case: Path
    bench: Stand
    hide: tuple[str, ...] = ()
    terms: tuple[str, ...] = ()
    route: str = "trajectory"
    plan: SamplingPlan = field(default_factory=lambda: SamplingPlan(ess=300.0))
    seed: int = 0
    plugins: tuple[str, ...] = ()
    maps: tuple[Path, ...] = ()

    @property
    def labels(self) -> tuple[str, ...]:
        """The names of the recordings."""
        return tuple(f"drive{k}" for k in range(1, len(self.bench.drives) + 1))

    @property
    def inputs(self) -> dict[str, str]:
        """The digests of what goes in, by file name."""
        case = load_case(self.case)
        files = (*map(Path, self.plugins), *(case.folder / name for name in case.plugins), *self.maps)
        return {"case": case.digest, **{file.name: digest(file) for file in files}}


class DrawnMachine(NamedTuple):
    """A machine: its parameters in each recording, the offsets of the sensor, and what of it is to be found again.

    `truth` has the names of the results. What is in `drawn` comes from the priors; the rest is as it is.
    """

    fulls: tuple[Array, ...]
    offsets: tuple[float, ...]
    truth: Mapping[str, float]
    drawn: frozenset[str]


@dataclass(frozen=True)
class Workshop:
    """What a design stands for once it has been read and found good: the case, and the system of every machine.

    `groups` are the dimensionless numbers that are drawn in place of parameters, as the route by quantifiers may.
    """

    design: Design
    registry: Registry
    case: CaseFile
    system: System
    hidden: Mapping[str, float]
    groups: tuple[Group, ...] = ()

    @property
    def moved_by(self) -> str:
        """What moves the machines, in words."""
        return describe_motion(self.system)

    def draw(self, rng: np.random.Generator) -> DrawnMachine:
        """Return a machine drawn from the priors of the case."""
        truth = dict(self.hidden)
        fulls = [self._fill_known() for _ in self.design.labels]
        for name, prior in self.case.estimate.items():
            if name not in {group.name for group in self.groups}:
                slot = self.system.slot(name)
                for full, (told, value) in zip(fulls, self._draw_values(slot, prior, rng), strict=True):
                    full[self.system.index[slot.key]] = truth[told] = value
        for group in self.groups:
            truth[group.name] = self.case.estimate[group.name].quantile(rng.uniform())
            for full in fulls:
                full[self.system.index[group.target]] = group.law(_name_values(self.system, full), truth[group.name])
        offsets = self._draw_offsets(rng)
        truth |= offsets
        drawn = frozenset(truth) - frozenset(self.hidden)
        return DrawnMachine(tuple(fulls), tuple(offsets.values()) or (0.0,) * len(fulls), truth, drawn)

    def _fill_known(self) -> Array:
        """Return the parameters that are the same in every machine; what is drawn stands at its middle."""
        full = make_known(self.system, _replace_groups(self.case, self.groups))
        for key, value in self.hidden.items():
            full[self.system.index[key]] = value
        return full

    def _draw_values(self, slot: Slot, prior: Prior, rng: np.random.Generator) -> list[tuple[str, float]]:
        """Return the name and the value of a parameter in each recording."""
        labels = self.design.labels
        if prior.each and len(labels) > 1:
            return [(f"{slot.key}[{label}]", _draw_possible(slot, prior, rng)) for label in labels]
        return [(slot.key, _draw_possible(slot, prior, rng))] * len(labels)

    def _draw_offsets(self, rng: np.random.Generator) -> dict[str, float]:
        prior, labels = self.case.sensor.offset, self.design.labels
        if prior is None:
            return {}
        names = [f"offset[{label}]" for label in labels] if len(labels) > 1 else ["offset"]
        return {name: prior.quantile(rng.uniform()) for name in names}

    def record(self, machine: DrawnMachine, rng: np.random.Generator) -> list[SeenMachine]:
        """Return what the sensors show of a machine under each drive."""
        bench, streams = self.design.bench, rng.spawn(len(self.design.labels))
        both = zip(machine.fulls, bench.drives, streams, strict=True)
        return [record_machine(self.system, full, bench, drive, stream) for full, drive, stream in both]


@lru_cache(maxsize=4)
def make_workshop(design: Design) -> Workshop:
    """Return the workshop of a design; whatever cannot be meant is refused here."""
    design.bench.check()
    if design.route not in ROUTES:
        raise CaseError(f"there is no route {design.route!r}: the routes are {', '.join(ROUTES)}")
    if design.route == "quantifiers" and design.terms:
        raise CaseError("the quantifier route knows no terms, since its maps have none: leave --term out")
    case = load_case(design.case)
    registry = Registry.discover([*design.plugins, *(case.folder / name for name in case.plugins)])
    if not case.estimate:
        raise CaseError(f"{design.case.name} estimates nothing: give priors in [model.estimate]")
    model: Model = registry.make("model", case.model)
    hidden, values = assembly_of(registry, case.model, design.hide)
    assembly_of(registry, case.model, design.terms)
    system = System(model, _collect_terms(hidden.terms, model, case, registry))
    groups = tuple(g for g in model.groups if g.name in case.estimate and design.route != ROUTES[0])
    make_known(system, _replace_groups(case, groups))
    _require_values(system, case, values)
    return Workshop(design, registry, case, system, values, groups)


def _replace_groups(case: CaseFile, groups: tuple[Group, ...]) -> CaseFile:
    """Return the case with parameters in place of dimensionless numbers, at the middle of their priors."""
    numbers = {group.name: case.estimate[group.name].start() for group in groups}
    estimate = {key: prior for key, prior in case.estimate.items() if key not in numbers}
    middle = {**case.known, **{key: prior.start() for key, prior in estimate.items()}}
    targets = {group.target: group.law(middle, numbers[group.name]) for group in groups}
    return replace(case, known={**case.known, **targets}, estimate=estimate)


def _name_values(system: System, full: Array) -> dict[str, float]:
    return {key: float(full[i]) for key, i in system.index.items()}


def _require_values(system: System, case: CaseFile, values: Mapping[str, float]) -> None:
    """Refuse a term that acts in the machines with a parameter that nothing gives a value."""
    given = {system.slot(name).key for name in (*case.known, *case.estimate) if "." in name} | set(values)
    if lacking := [slot.key for slot in system.slots if slot.term is not None and slot.key not in given]:
        raise CaseError(f"{lacking[0]} has no value: add it to --hide, or to the case")


def _collect_terms(hidden: tuple[Term, ...], model: Model, case: CaseFile, registry: Registry) -> tuple[Term, ...]:
    """Return the terms that act in every machine: those that are hidden, and those whose parameters the case names."""
    found = {key_of(term): term for term in hidden}
    for key in (name.rpartition(".")[0] for name in (*case.known, *case.estimate) if "." in name):
        if key in {key_of(term) for term in hidden}:
            raise CaseError(f"{key} is hidden and stands in the case: keep one of them")
        (term,) = assembly_of(registry, model.name, [key])[0].terms
        found[key_of(term)] = term
    return tuple(found.values())


def _draw_possible(slot: Slot, prior: Prior, rng: np.random.Generator) -> float:
    """Return a draw from a prior that lies within the bounds of the parameter, as that of the fit does."""
    for _ in range(MOST_DRAWS):
        value = prior.quantile(rng.uniform())
        if slot.param.low <= value <= slot.param.high:
            return value
    raise CaseError(f"the prior of {slot.key} lies outside of {slot.param.low:g} to {slot.param.high:g}: correct it")
