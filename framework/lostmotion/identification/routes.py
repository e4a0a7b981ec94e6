"""The routes from a case to a posterior: what is asked, what a route returns, and which one a case allows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

from lostmotion.case import CaseFile
from lostmotion.defaults import QUANTIFIERS
from lostmotion.errors import CaseError
from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, Task
from lostmotion.provenance import origin_of
from lostmotion.results.background import Origin
from lostmotion.results.identification import Identification, RouteName
from lostmotion.settings import DEFAULT, Settings

TRAJECTORY: RouteName = "trajectory"


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
class Route:
    """A sampling task, and the function that makes the result from its draws."""

    task: Task
    make_result: Callable[[SampledPosterior], Identification]


def choose_route(case: CaseFile, order: IdentificationRequest) -> str:
    """Return the requested route, or else the one that the case allows."""
    if order.route == TRAJECTORY and case.levels and not case.recordings:
        raise CaseError("the case has [[levels]] and no [[recordings]]: take --route quantifiers, or add a recording")
    if order.route == QUANTIFIERS and order.terms:
        raise CaseError("the quantifier route supports no terms, since its maps have none: leave --term out")
    return order.route or (QUANTIFIERS if case.levels and not case.recordings else TRAJECTORY)


def make_origin(
    case: CaseFile, order: IdentificationRequest, settings: Mapping[str, object], inputs: Mapping[str, str]
) -> Origin:
    """Return the origin of a result: case and `settings` of a route, the plan of its chain, and its `inputs`."""
    used = {"model": case.model, "known": dict(case.known), **settings, **asdict(order.plan)}
    used["thresholds"] = order.settings.as_dict()
    del used["limits"]
    return origin_of("identify", used, order.seed, inputs)
