"""The route of `identify` from measures of chaos at several levels of the drive to parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.case.drive_levels import Measured
from lostmotion.contracts import Array
from lostmotion.identification.result import make_result
from lostmotion.identification.routes import IdentificationRequest, Route, make_origin
from lostmotion.identification.sampling import SampledPosterior, Watch
from lostmotion.likelihood.space import FreeParameter
from lostmotion.registry import Registry
from lostmotion.results import Interval
from lostmotion.results.identification import DriveLevel, ExpectedMotion, Identification, MeasuredRange, RouteName
from lostmotion.storage import folder_for
from lostmotion_chaos.levels.levels import MapGrid, compute_derived, make_quantifier_task
from lostmotion_chaos.maps.inversion import Inversion, Predicted, predict_levels

QUANTIFIERS: RouteName = "quantifiers"
PREDICTION_DRAWS = 4000
"""Number of draws used for the predictions at each level."""


def prepare_quantifiers(
    case: CaseFile,
    out: Path,
    registry: Registry,
    order: IdentificationRequest,
    rng: np.random.Generator,
    watch: Watch,
) -> Route:
    """Return the task of a case with levels, and the function that makes its result; maps are made in `out`."""
    folder_for(out)
    grid = MapGrid(maps=order.maps, jobs=order.jobs)
    watch(0, "reading the levels")

    def say(done: int, cells: int) -> None:
        watch(0, f"map: {done} of {cells} cells")

    task = make_quantifier_task(case, registry, out, rng, grid, say=say, settings=order.settings)
    posterior = task.posterior
    assert isinstance(posterior, Inversion)  # noqa: S101 - it is what a quantifier task holds
    inputs = {**registry.origins(("model", case.model)), "case": case.digest}
    origin = make_origin(case, order, {"maps": [asdict(grid)["maps"]]}, inputs)

    def complete(found: SampledPosterior) -> Identification:
        points = compute_coordinates(posterior.space.free, found.draws)
        some = points[:: max(1, len(points) // PREDICTION_DRAWS)]
        expected = predict_levels(posterior, some, np.random.default_rng(order.seed))
        result = make_result(found, QUANTIFIERS, case, origin)
        return replace(
            result,
            levels=tuple(map(make_drive_level, expected)),
            derived=compute_derived_intervals(posterior, points, found),
        )

    return Route(task, complete)


def compute_coordinates(free: tuple[FreeParameter, ...], values: Array) -> Array:
    """Return the coordinates (count, parameters) of parameter values (count, parameters)."""
    return np.stack([np.log(values[:, i]) if f.log else values[:, i] for i, f in enumerate(free)], axis=1)


def make_drive_level(one: Predicted) -> DriveLevel:
    """Return a level with the measured values and the prediction of the posterior."""
    level = one.level
    return DriveLevel(
        name=level.name,
        amplitude=level.amplitude,
        unit=level.unit,
        omega=level.omega,
        motion=level.motion,
        lyapunov=_make_measured_range(level.lyapunov, "1/s"),
        d2=_make_measured_range(level.d2, "1"),
        predicted=ExpectedMotion(chaotic_share=one.chaotic_share, lyapunov=one.lyapunov, d2=one.d2),
    )


def _make_measured_range(seen: Measured | None, unit: str) -> MeasuredRange | None:
    if seen is None:
        return None
    half = 1.96 * seen.sd
    return MeasuredRange(value=seen.value, low=seen.value - half, high=seen.value + half, unit=unit)


def compute_derived_intervals(posterior: Inversion, points: Array, found: SampledPosterior) -> Mapping[str, Interval]:
    """Return the intervals of derived numbers; none from a chain that has not converged."""
    if not found.converged:
        return {}
    rows = {}
    for name, values in compute_derived(posterior, points).items():
        low, median, high = np.quantile(values, [0.025, 0.5, 0.975]).tolist()
        rows[name] = Interval(median, low, high, "1")
    return rows
