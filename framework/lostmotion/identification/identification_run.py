"""Run an identification: from a case to `identification.json`, `posterior.nc` and `report.html`.

The route "trajectory" to the posterior uses the recordings themselves; packages offer others by the hook
`lostmotion_routes`. Sampling, result and page are the same.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.codec import to_plain
from lostmotion.identification.arviz_groups import make_groups
from lostmotion.identification.report.identification_page import write_identification
from lostmotion.identification.result import make_result, write_mode_notes
from lostmotion.identification.routes import TRAJECTORY, IdentificationRequest, Route, choose_route, make_origin
from lostmotion.identification.sampling import SampledPosterior, Watch, identify
from lostmotion.identification.trajectory import choose_terms, find_best_fits, make_trajectory_task, write_warnings
from lostmotion.inference.contacts import list_short_contacts
from lostmotion.offers import ROUTE
from lostmotion.preparation.prepare import Prepared, case_of, prepare_case
from lostmotion.preparation.vetting import catch_divergence
from lostmotion.registry import Registry
from lostmotion.results.identification import Identification
from lostmotion.storage import folder_for, save_datasets, save_json

if TYPE_CHECKING:
    import xarray as xr

CHAIN_FILE = "chain.h5"


@dataclass(frozen=True)
class Identified:
    """The draws, the result stored in `identification.json`, the sampling time (s), and the `groups` for ArviZ."""

    posterior: SampledPosterior
    result: Identification
    seconds: float
    groups: Mapping[str, xr.Dataset] = field(default_factory=dict)


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
    name = TRAJECTORY if prepared else choose_route(case, order)
    if name == TRAJECTORY:
        ready = prepared or prepare_case(case, registry, order.settings)
        way = _prepare_trajectory(ready, out, registry, order, rng, watch)
    else:
        way = registry.function(ROUTE, name)(case, out, registry, order, rng, watch)
    if order.fresh:
        (out / CHAIN_FILE).unlink(missing_ok=True)
    begin = time.perf_counter()
    found = identify(way.task, rng=rng, plan=order.plan, watch=watch, keep=out / CHAIN_FILE)
    seconds = time.perf_counter() - begin
    watch(0, "predicting the readings from the posterior")
    groups = make_groups(way.task, found, case, np.random.default_rng([order.seed, 1]))
    return Identified(found, way.make_result(found), seconds, groups)


def _prepare_trajectory(
    prepared: Prepared,
    out: Path,
    registry: Registry,
    order: IdentificationRequest,
    rng: np.random.Generator,
    watch: Watch,
) -> Route:
    case = prepared.case
    terms = choose_terms(prepared, order.terms, registry)
    folder_for(out)
    watch(0, "looking for the maximum")
    fits = find_best_fits(prepared, terms, rng, order.jobs, order.settings)
    posterior = fits[0].posterior
    settings = {
        "terms": sorted(posterior.active),
        "steps_between_samples": posterior.dynamics.nsub,
        "sensor": asdict(case.sensor),
    }
    origin = make_origin(case, order, settings, prepared.inputs)
    notes = (*prepared.notes, *write_mode_notes(len(fits)), *list_short_contacts(fits[0]), *write_warnings(fits[0]))
    model = " + ".join([case.model, *sorted(posterior.active)])

    def complete(found: SampledPosterior) -> Identification:
        result = make_result(found, TRAJECTORY, case, origin)
        return replace(result, model=model, modes=len(fits), notes=notes)

    return Route(make_trajectory_task(prepared, fits, terms), complete)


def collect_groups(done: Identified) -> dict[str, xr.Dataset]:
    """Return the groups of an identification in the layout of ArviZ, by name."""
    attrs: dict[str, str | int] = {
        "title": done.result.title,
        "model": done.result.model,
        "converged": int(done.posterior.converged),
    }
    return {**done.posterior.groups(attrs), **done.groups}


def _write_files(folder: Path, done: Identified) -> None:
    save_datasets(folder / "posterior.nc", dict(collect_groups(done).items()), {})
    save_json(folder / "identification.json", to_plain(done.result))
    write_identification(folder)
