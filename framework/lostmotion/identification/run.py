"""The whole way of an identification: case in, `identification.json`, `posterior.nc` and `report.html` out.

Two routes lead to one posterior: by trajectory, the recordings themselves; by quantifiers, chaos measures at several
levels of the drive. Sampling, statement and page are the same.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.codec import to_plain
from lostmotion.contracts import Array
from lostmotion.errors import CaseError
from lostmotion.identification.levels import Survey, quantifier_task
from lostmotion.identification.predictive import groups_of
from lostmotion.identification.report.page import write_identification
from lostmotion.identification.result import derived_intervals, drive_level, mode_notes, statement
from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, Task, Watch, identify
from lostmotion.identification.trajectory import best_fits, chosen_terms, task_for, warnings_of
from lostmotion.inference.contacts import list_short_contacts
from lostmotion.likelihood.space import FreeParameter
from lostmotion.maps.inversion import Inversion, predict_levels
from lostmotion.preparation.prepare import Prepared, case_of, prepared_of
from lostmotion.preparation.vetting import within_numbers
from lostmotion.provenance import origin_of
from lostmotion.registry import Registry
from lostmotion.results.background import Origin
from lostmotion.results.identification import Identification
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import folder_for, save_datasets, save_json

if TYPE_CHECKING:
    import xarray as xr

ROUTES = ("trajectory", "quantifiers")
CHAIN = "chain.h5"
EXPECTED = 4000
"""Draws from which is told what the posterior expects at each level."""


@dataclass(frozen=True)
class Order:
    """What is asked for beyond the case: route, terms (`NAME` or `NAME@PLACE`), seed, cores, how long to sample.

    Without a route it is the trajectory where the case has recordings. `maps` are files for the quantifier route.
    """

    terms: tuple[str, ...] = ()
    seed: int = 0
    jobs: int = 2
    plan: SamplingPlan = field(default_factory=SamplingPlan)
    route: str | None = None
    maps: tuple[Path, ...] = ()
    fresh: bool = False
    settings: Settings = DEFAULT


@dataclass(frozen=True)
class Identified:
    """The draws, the result that `identification.json` holds, the time (s) of the sampling, and `groups` for ArviZ."""

    posterior: SampledPosterior
    result: Identification
    seconds: float
    groups: Mapping[str, xr.Dataset] = field(default_factory=dict)


@dataclass(frozen=True)
class Way:
    """A task, and what makes the result of its draws."""

    task: Task
    tell: Callable[[SampledPosterior], Identification]


@within_numbers()
def run_identification(
    path: Path, out: Path, registry: Registry, order: Order, watch: Watch = lambda _steps, _says: None
) -> Identified:
    """Return what was identified after writing it into the folder `out`; all recordings of the case are used.

    A chain that an interrupted run has left there is continued.
    """
    watch(0, "reading the case")
    done = identified(case_of(path, registry), None, out, registry, order, watch)
    watch(0, "report")
    _write(out, done)
    return done


def identified(
    case: CaseFile,
    prepared: Prepared | None,
    out: Path,
    registry: Registry,
    order: Order,
    watch: Watch = lambda _steps, _says: None,
) -> Identified:
    """Return what was identified of a case, `prepared` where its recordings are at hand; the chain is kept in `out`."""
    rng = np.random.default_rng(order.seed)
    asked = (order, rng, watch)
    if prepared or route_of(case, order) == "trajectory":
        way = _by_trajectory(prepared or prepared_of(case, registry), out, registry, asked)
    else:
        way = _by_quantifiers(case, out, registry, asked)
    if order.fresh:
        (out / CHAIN).unlink(missing_ok=True)
    begin = time.perf_counter()
    found = identify(way.task, rng=rng, plan=order.plan, watch=watch, keep=out / CHAIN)
    seconds = time.perf_counter() - begin
    watch(0, "what the posterior says of the readings")
    groups = groups_of(way.task, found, case, np.random.default_rng([order.seed, 1]))
    return Identified(found, way.tell(found), seconds, groups)


def route_of(case: CaseFile, order: Order) -> str:
    """Return the route that is asked for, or else the one that the case offers."""
    if order.route == "trajectory" and case.levels and not case.recordings:
        raise CaseError("the case has [[levels]] and no [[recordings]]: take --route quantifiers, or add a recording")
    if order.route == "quantifiers" and order.terms:
        raise CaseError("the quantifier route knows no terms, since its maps have none: leave --term out")
    return order.route or ("quantifiers" if case.levels and not case.recordings else "trajectory")


Asked = tuple[Order, np.random.Generator, Watch]


def _by_trajectory(prepared: Prepared, out: Path, registry: Registry, asked: Asked) -> Way:
    order, rng, watch = asked
    case = prepared.case
    terms = chosen_terms(prepared, order.terms, registry)
    folder_for(out)
    watch(0, "looking for the maximum")
    fits = best_fits(prepared, terms, rng, order.jobs, order.settings)
    problem = fits[0].problem
    settings = {"terms": sorted(problem.active), "steps_between_samples": problem.nsub, "sensor": asdict(case.sensor)}
    origin = _origin(case, order, settings, prepared.inputs)
    notes = (*prepared.notes, *mode_notes(len(fits)), *list_short_contacts(fits[0]), *warnings_of(fits[0]))
    model = " + ".join([case.model, *sorted(problem.active)])

    def tell(found: SampledPosterior) -> Identification:
        told = statement(found, "trajectory", case, origin)
        return replace(told, model=model, modes=len(fits), notes=notes)

    return Way(task_for(prepared, fits, terms), tell)


def _by_quantifiers(case: CaseFile, out: Path, registry: Registry, asked: Asked) -> Way:
    order, rng, watch = asked
    folder_for(out)
    survey = Survey(maps=order.maps, jobs=order.jobs)
    watch(0, "reading the levels")

    def say(done: int, cells: int) -> None:
        watch(0, f"map: {done} of {cells} cells")

    task = quantifier_task(case, registry, out, rng, survey, say=say)
    posterior = task.posterior
    assert isinstance(posterior, Inversion)  # noqa: S101 - it is what a quantifier task holds
    inputs = {**registry.origins(("model", case.model)), "case": case.digest}
    origin = _origin(case, order, {"maps": [asdict(survey)["maps"]]}, inputs)

    def tell(found: SampledPosterior) -> Identification:
        points = coordinates(posterior.free, found.draws)
        some = points[:: max(1, len(points) // EXPECTED)]
        expected = predict_levels(posterior, some, np.random.default_rng(order.seed))
        told = statement(found, "quantifiers", case, origin)
        return replace(
            told, levels=tuple(map(drive_level, expected)), derived=derived_intervals(posterior, points, found)
        )

    return Way(task, tell)


def coordinates(free: tuple[FreeParameter, ...], values: Array) -> Array:
    """Return the coordinates (count, parameters) of parameter values (count, parameters)."""
    return np.stack([np.log(values[:, i]) if f.log else values[:, i] for i, f in enumerate(free)], axis=1)


def _origin(case: CaseFile, order: Order, settings: Mapping[str, object], inputs: Mapping[str, str]) -> Origin:
    told = {"model": case.model, "known": dict(case.known), **settings, **asdict(order.plan)}
    told["thresholds"] = order.settings.as_dict()
    del told["limits"]
    return origin_of("identify", told, order.seed, inputs)


def inference_of(done: Identified) -> Any:
    """Return the draws of an identification as ArviZ's `InferenceData`."""
    attrs: dict[str, str | int] = {
        "title": done.result.title,
        "model": done.result.model,
        "converged": int(done.posterior.converged),
    }
    data = done.posterior.inference_data(attrs)
    if done.groups:
        data.add_groups(dict(done.groups))
    return data


def _write(folder: Path, done: Identified) -> None:
    told = inference_of(done)
    save_datasets(folder / "posterior.nc", {name: told[name] for name in told.groups()}, told.attrs)
    save_json(folder / "identification.json", to_plain(done.result))
    write_identification(folder)
