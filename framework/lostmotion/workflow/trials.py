"""One trial of a calibration: a machine drawn from the priors, its recordings, its posterior, and where the truth lies.

A trial is made from the design and its number alone.
"""

from __future__ import annotations

import tempfile
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from lostmotion.case import Case, Prior, dump_case, load_case
from lostmotion.contracts import Array, Model, Term
from lostmotion.errors import CaseError, LostMotionError
from lostmotion.inference.ranks import rank_of
from lostmotion.inference.setup import known_of
from lostmotion.provenance import digest
from lostmotion.quantities import ANGULAR, SI
from lostmotion.registry import Registry
from lostmotion.stages.identify import Identification, Plan
from lostmotion.storage import save_table
from lostmotion.system import Slot, System, key_of
from lostmotion.workflow.machines import Bench, Seen, moved_by, recorded
from lostmotion.workflow.prepare import prepare
from lostmotion.workflow.simulate import assembly_of
from lostmotion.workflow.trajectory import chosen_terms, sampled

TRIES = 1000
"""Draws from a prior until one is a machine that can be: a normal prior may reach below zero."""
REPLACED = ("recordings", "levels", "truth", "plugins")
"""What of the case a machine brings itself, or what the registry holds already."""


@dataclass(frozen=True)
class Design:
    """What is drawn and how it is identified: the case with its priors, the bench, what is hidden, the terms fitted.

    `hide` are terms with their values, `NAME[@PLACE]:param=value`, which act in every machine whether fitted or not.
    `plugins` are files that bring models or terms, beside those that the case names.
    """

    case: Path
    bench: Bench
    hide: tuple[str, ...] = ()
    terms: tuple[str, ...] = ()
    route: str = "trajectory"
    plan: Plan = field(default_factory=lambda: Plan(ess=300.0))
    seed: int = 0
    plugins: tuple[str, ...] = ()

    @property
    def labels(self) -> tuple[str, ...]:
        """The names of the recordings."""
        return tuple(f"drive{k}" for k in range(1, len(self.bench.drives) + 1))

    @property
    def inputs(self) -> dict[str, str]:
        """The digests of what goes in, by file name."""
        case = load_case(self.case)
        files = (*map(Path, self.plugins), *(case.folder / name for name in case.plugins))
        return {"case": case.digest, **{file.name: digest(file) for file in files}}


class Machine(NamedTuple):
    """A machine: its parameters in each recording, the offsets of the sensor, and what of it is to be found again.

    `truth` has the names of the results. What is in `drawn` comes from the priors; the rest is as it is.
    """

    fulls: tuple[Array, ...]
    offsets: tuple[float, ...]
    truth: Mapping[str, float]
    drawn: frozenset[str]


@dataclass(frozen=True)
class Workshop:
    """What a design stands for once it has been read and found good: the case, and the system of every machine."""

    design: Design
    registry: Registry
    case: Case
    system: System
    hidden: Mapping[str, float]

    @property
    def moved_by(self) -> str:
        """What moves the machines, in words."""
        return moved_by(self.system)

    def draw(self, rng: np.random.Generator) -> Machine:
        """Return a machine drawn from the priors of the case."""
        labels = self.design.labels
        truth, drawn = dict(self.hidden), set[str]()
        fulls = [known_of(self.system, self.case) for _ in labels]
        for full in fulls:
            for key, value in self.hidden.items():
                full[self.system.index[key]] = value
        for name, prior in self.case.estimate.items():
            slot = self.system.slot(name)
            for full, (told, value) in zip(fulls, self._values(slot, prior, rng), strict=True):
                full[self.system.index[slot.key]] = truth[told] = value
                drawn.add(told)
        offsets = self._offsets(rng)
        truth |= offsets
        return Machine(
            tuple(fulls), tuple(offsets.values()) or (0.0,) * len(labels), truth, frozenset({*drawn, *offsets})
        )

    def _values(self, slot: Slot, prior: Prior, rng: np.random.Generator) -> list[tuple[str, float]]:
        """Return the name and the value of a parameter in each recording."""
        labels = self.design.labels
        if prior.each and len(labels) > 1:
            return [(f"{slot.key}[{label}]", _possible(slot, prior, rng)) for label in labels]
        return [(slot.key, _possible(slot, prior, rng))] * len(labels)

    def _offsets(self, rng: np.random.Generator) -> dict[str, float]:
        prior, labels = self.case.sensor.offset, self.design.labels
        if prior is None:
            return {}
        names = [f"offset[{label}]" for label in labels] if len(labels) > 1 else ["offset"]
        return {name: prior.quantile(rng.uniform()) for name in names}

    def record(self, machine: Machine, rng: np.random.Generator) -> list[Seen]:
        """Return what the sensors show of a machine under each drive."""
        bench, streams = self.design.bench, rng.spawn(len(self.design.labels))
        both = zip(machine.fulls, bench.drives, streams, strict=True)
        return [recorded(self.system, full, bench, drive, stream) for full, drive, stream in both]


@lru_cache(maxsize=4)
def workshop(design: Design) -> Workshop:
    """Return the workshop of a design; whatever cannot be meant is refused here."""
    design.bench.check()
    if design.route not in ROUTES:
        raise CaseError(f"there is no route {design.route!r}: the routes are {', '.join(ROUTES)}")
    case = load_case(design.case)
    registry = Registry.discover()
    for file in (*map(Path, design.plugins), *(case.folder / name for name in case.plugins)):
        registry.add_file(file)
    if not case.estimate:
        raise CaseError(f"{design.case.name} estimates nothing: give priors in [model.estimate]")
    model: Model = registry.make("model", case.model)
    hidden, values = assembly_of(registry, case.model, design.hide)
    assembly_of(registry, case.model, design.terms)
    terms = _terms(hidden.terms, model, case, registry)
    system = System(model, terms)
    known_of(system, case)
    if lacking := [
        slot.key for slot in system.slots if slot.term is not None and slot.key not in _given(system, case, values)
    ]:
        raise CaseError(f"{lacking[0]} has no value: add it to --hide, or to the case")
    return Workshop(design, registry, case, system, values)


def _terms(hidden: tuple[Term, ...], model: Model, case: Case, registry: Registry) -> tuple[Term, ...]:
    """Return the terms that act in every machine: those that are hidden, and those whose parameters the case names."""
    found = {key_of(term): term for term in hidden}
    for key in (name.rpartition(".")[0] for name in (*case.known, *case.estimate) if "." in name):
        if key in {key_of(term) for term in hidden}:
            raise CaseError(f"{key} is hidden and stands in the case: keep one of them")
        (term,) = assembly_of(registry, model.name, [key])[0].terms
        found[key_of(term)] = term
    return tuple(found.values())


def _given(system: System, case: Case, values: Mapping[str, float]) -> set[str]:
    return {system.slot(name).key for name in (*case.known, *case.estimate)} | set(values)


def _possible(slot: Slot, prior: Prior, rng: np.random.Generator) -> float:
    """Return a draw from a prior that lies within the bounds of the parameter, as that of the fit does."""
    for _ in range(TRIES):
        value = prior.quantile(rng.uniform())
        if slot.param.low <= value <= slot.param.high:
            return value
    raise CaseError(f"the prior of {slot.key} lies outside of {slot.param.low:g} to {slot.param.high:g}: correct it")


def trial(design: Design, number: int) -> dict[str, Any]:
    """Return what became of machine `number`: "ok", "unconverged" or "failed", its truth, and where that lies."""
    shop = workshop(design)
    of_truth, of_motion, of_fit = np.random.default_rng([design.seed, number]).spawn(3)
    machine = shop.draw(of_truth)
    unknown = {name: {"truth": value, "drawn": name in machine.drawn} for name, value in machine.truth.items()}
    try:
        result, also = ROUTES[design.route](shop, machine, of_motion, int(of_fit.integers(2**32)))
    except (LostMotionError, ArithmeticError, ValueError) as err:
        return {"machine": number, "status": "failed", "says": " ".join(str(err).split()), "parameters": unknown}
    if not result.converged:
        says = "; ".join(result.lacks)
        return {"machine": number, "status": "unconverged", "says": says, "parameters": unknown}
    rows = _judged(result, {**machine.truth, **also}, machine.drawn)
    reached = {"ess": float(result.quality.ess.min()), "rhat": float(result.quality.rhat.max())}
    return {"machine": number, "status": "ok", "says": "", "parameters": rows, **reached}


def _judged(result: Identification, truth: Mapping[str, float], drawn: frozenset[str]) -> dict[str, dict[str, Any]]:
    """Return for each parameter whose truth is known where that lies among the draws."""
    if lost := drawn - set(result.keys):
        raise ValueError(f"the posterior has no parameter {sorted(lost)[0]}, which was drawn")
    rows = {}
    for i, (key, unit) in enumerate(zip(result.keys, result.units, strict=True)):
        if key in truth:
            place = _place(truth[key], result.chain[:, :, i])
            rows[key] = {"truth": truth[key], "drawn": key in drawn, "unit": unit, **place}
    return rows


def _place(truth: float, chain: Array) -> dict[str, float | int]:
    """Return where a truth lies among the draws of a chain (walkers, steps)."""
    low, median, high = np.quantile(chain, [0.025, 0.5, 0.975]).tolist()
    mean, sd = float(chain.mean()), float(chain.std())
    return {
        "low": low,
        "median": median,
        "high": high,
        "sd": sd,
        "z": (truth - mean) / sd,
        "below": float(np.mean(chain < truth)),
        "rank": rank_of(truth, chain),
    }


Route = Callable[[Workshop, Machine, np.random.Generator, int], tuple[Identification, dict[str, float]]]
"""Makes the posterior of a machine from a generator for its motion and a seed for the fit; and further truths."""


def by_trajectory(
    shop: Workshop, machine: Machine, rng: np.random.Generator, seed: int
) -> tuple[Identification, dict[str, float]]:
    """Return the posterior from the recordings themselves, and the true measurement noise of each."""
    seen = shop.record(machine, rng)
    with tempfile.TemporaryDirectory() as folder:
        prepared = prepare(_write(shop, machine, seen, Path(folder)), shop.registry)
    terms = chosen_terms(prepared, shop.design.terms, shop.registry)
    result = sampled(prepared, terms, shop.design.plan, rng=np.random.default_rng(seed)).result
    several = len(seen) > 1
    names = [f"measurement_noise[{label}]" if several else "measurement_noise" for label in shop.design.labels]
    return result, {name: one.noise for name, one in zip(names, seen, strict=True)}


def _write(shop: Workshop, machine: Machine, seen: list[Seen], folder: Path) -> Path:
    """Return the case of a machine, written with its recordings into a folder."""
    design, model = shop.design, shop.system.model
    quantity = "force" if "force" in model.inputs else "base_position"
    units = SI if model.motion == "translation" else ANGULAR
    entries = []
    for label, one, offset in zip(design.labels, seen, machine.offsets, strict=True):
        columns = {"excitation": one.excitation, "response": one.response + offset}
        save_table(folder / f"{label}.csv", columns, {}, {})
        entries.append(
            {
                "file": f"{label}.csv",
                "name": label,
                "rate": design.bench.rate,
                "excitation": {"column": "excitation", "quantity": quantity, "unit": units[quantity]},
                "response": {"column": "response", "quantity": "position", "unit": units["position"]},
            }
        )
    content = tomllib.loads(design.case.read_text(encoding="utf-8-sig"))
    kept = {key: value for key, value in content.items() if key not in REPLACED}
    dump_case({**kept, "recordings": entries}, folder / design.case.name)
    return folder / design.case.name


ROUTES: Mapping[str, Route] = {"trajectory": by_trajectory}
"""The ways to a posterior."""
