"""Run an identification: from a case to `identification.json`, `posterior.nc` and `report.html`.

There are two routes to the posterior: "trajectory" uses the recordings themselves, "quantifiers" uses chaos measures at
several levels of the drive. Sampling, result and page are the same.
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
from lostmotion.identification.levels import MapGrid, make_quantifier_task
from lostmotion.identification.predictive import make_groups
from lostmotion.identification.report.page import write_identification
from lostmotion.identification.result import compute_derived_intervals, make_drive_level, make_result, write_mode_notes
from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, Task, Watch, identify
from lostmotion.identification.trajectory import choose_terms, find_best_fits, make_trajectory_task, write_warnings
from lostmotion.inference.contacts import list_short_contacts
from lostmotion.likelihood.space import FreeParameter
from lostmotion.maps.inversion import Inversion, predict_levels
from lostmotion.preparation.prepare import Prepared, case_of, prepare_case
from lostmotion.preparation.vetting import catch_divergence
from lostmotion.provenance import origin_of
from lostmotion.registry import Registry
from lostmotion.results.background import Origin
from lostmotion.results.identification import Identification
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import folder_for, save_datasets, save_json

if TYPE_CHECKING:
    import xarray as xr

ROUTES = ("trajectory", "quantifiers")
CHAIN_FILE = "chain.h5"
PREDICTION_DRAWS = 4000
"""Number of draws used for the predictions at each level."""


@dataclass(frozen=True)
class IdentificationRequest:
    """Options of an identification: route, terms (`NAME` or `NAME@PLACE`), seed, cores, length of the sampling.

    Without a route, a case with recordings uses the trajectory. `maps` are files for the quantifier route.
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
    """The draws, the result stored in `identification.json`, the sampling time (s), and the `groups` for ArviZ."""

    posterior: SampledPosterior
    result: Identification
    seconds: float
    groups: Mapping[str, xr.Dataset] = field(default_factory=dict)


@dataclass(frozen=True)
class Route:
    """A sampling task, and the function that makes the result from its draws."""

    task: Task
    make_result: Callable[[SampledPosterior], Identification]


@catch_divergence()
def run_identification(
    path: Path, out: Path, registry: Registry, order: IdentificationRequest, watch: Watch = lambda _steps, _says: None
) -> Identified:
    """Return the identification of a case after writing its files into the folder `out`; all recordings are used.

    A chain that an interrupted run has left in `out` is continued.
    """
    watch(0, "reading the case")
    done = identify_case(case_of(path, registry), None, out, registry, order, watch)
    watch(0, "report")
    _write_files(out, done)
    return done


def identify_case(
    case: CaseFile,
    prepared: Prepared | None,
    out: Path,
    registry: Registry,
    order: IdentificationRequest,
    watch: Watch = lambda _steps, _says: None,
) -> Identified:
    """Return the identification of a case, `prepared` if its recordings are loaded; the chain is stored in `out`."""
    rng = np.random.default_rng(order.seed)
    asked = (order, rng, watch)
    if prepared or choose_route(case, order) == "trajectory":
        way = _prepare_trajectory(prepared or prepare_case(case, registry, order.settings), out, registry, asked)
    else:
        way = _prepare_quantifiers(case, out, registry, asked)
    if order.fresh:
        (out / CHAIN_FILE).unlink(missing_ok=True)
    begin = time.perf_counter()
    found = identify(way.task, rng=rng, plan=order.plan, watch=watch, keep=out / CHAIN_FILE)
    seconds = time.perf_counter() - begin
    watch(0, "predicting the readings from the posterior")
    groups = make_groups(way.task, found, case, np.random.default_rng([order.seed, 1]))
    return Identified(found, way.make_result(found), seconds, groups)


def choose_route(case: CaseFile, order: IdentificationRequest) -> str:
    """Return the requested route, or else the one that the case allows."""
    if order.route == "trajectory" and case.levels and not case.recordings:
        raise CaseError("the case has [[levels]] and no [[recordings]]: take --route quantifiers, or add a recording")
    if order.route == "quantifiers" and order.terms:
        raise CaseError("the quantifier route supports no terms, since its maps have none: leave --term out")
    return order.route or ("quantifiers" if case.levels and not case.recordings else "trajectory")


Asked = tuple[IdentificationRequest, np.random.Generator, Watch]


def _prepare_trajectory(prepared: Prepared, out: Path, registry: Registry, asked: Asked) -> Route:
    order, rng, watch = asked
    case = prepared.case
    terms = choose_terms(prepared, order.terms, registry)
    folder_for(out)
    watch(0, "looking for the maximum")
    fits = find_best_fits(prepared, terms, rng, order.jobs, order.settings)
    problem = fits[0].problem
    settings = {"terms": sorted(problem.active), "steps_between_samples": problem.nsub, "sensor": asdict(case.sensor)}
    origin = _make_origin(case, order, settings, prepared.inputs)
    notes = (*prepared.notes, *write_mode_notes(len(fits)), *list_short_contacts(fits[0]), *write_warnings(fits[0]))
    model = " + ".join([case.model, *sorted(problem.active)])

    def complete(found: SampledPosterior) -> Identification:
        result = make_result(found, "trajectory", case, origin)
        return replace(result, model=model, modes=len(fits), notes=notes)

    return Route(make_trajectory_task(prepared, fits, terms), complete)


def _prepare_quantifiers(case: CaseFile, out: Path, registry: Registry, asked: Asked) -> Route:
    order, rng, watch = asked
    folder_for(out)
    grid = MapGrid(maps=order.maps, jobs=order.jobs)
    watch(0, "reading the levels")

    def say(done: int, cells: int) -> None:
        watch(0, f"map: {done} of {cells} cells")

    task = make_quantifier_task(case, registry, out, rng, grid, say=say, settings=order.settings)
    posterior = task.posterior
    assert isinstance(posterior, Inversion)  # noqa: S101 - it is what a quantifier task holds
    inputs = {**registry.origins(("model", case.model)), "case": case.digest}
    origin = _make_origin(case, order, {"maps": [asdict(grid)["maps"]]}, inputs)

    def complete(found: SampledPosterior) -> Identification:
        points = compute_coordinates(posterior.free, found.draws)
        some = points[:: max(1, len(points) // PREDICTION_DRAWS)]
        expected = predict_levels(posterior, some, np.random.default_rng(order.seed))
        result = make_result(found, "quantifiers", case, origin)
        return replace(
            result,
            levels=tuple(map(make_drive_level, expected)),
            derived=compute_derived_intervals(posterior, points, found),
        )

    return Route(task, complete)


def compute_coordinates(free: tuple[FreeParameter, ...], values: Array) -> Array:
    """Return the coordinates (count, parameters) of parameter values (count, parameters)."""
    return np.stack([np.log(values[:, i]) if f.log else values[:, i] for i, f in enumerate(free)], axis=1)


def _make_origin(
    case: CaseFile, order: IdentificationRequest, settings: Mapping[str, object], inputs: Mapping[str, str]
) -> Origin:
    used = {"model": case.model, "known": dict(case.known), **settings, **asdict(order.plan)}
    used["thresholds"] = order.settings.as_dict()
    del used["limits"]
    return origin_of("identify", used, order.seed, inputs)


def make_inference_data(done: Identified) -> Any:
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


def _write_files(folder: Path, done: Identified) -> None:
    data = make_inference_data(done)
    save_datasets(folder / "posterior.nc", {name: data[name] for name in data.groups()}, data.attrs)
    save_json(folder / "identification.json", to_plain(done.result))
    write_identification(folder)
