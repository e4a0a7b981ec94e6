"""The quantifier route from a case to a sampling task: levels, their maps, and the posterior."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lostmotion.case import CaseFile, Prior
from lostmotion.case.drive_levels import Level
from lostmotion.contracts import Array, Model
from lostmotion.errors import CaseError, ContractError, DataError, nearest
from lostmotion.identification.sampling import ShownCoordinate, Task
from lostmotion.likelihood.space import FreeParameter, ParameterSpace
from lostmotion.likelihood.system import System
from lostmotion.preparation.vetting import make_plugin
from lostmotion.quantities import unit_of
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT, LevelSettings, Settings
from lostmotion_chaos.defaults import SECTION_DIMENSION
from lostmotion_chaos.levels.incremental_mixture import find_mixture
from lostmotion_chaos.levels.reading import read_levels
from lostmotion_chaos.maps.atlas import FREQUENCY_RATIO, Atlas
from lostmotion_chaos.maps.inversion import Inversion, group_levels
from lostmotion_chaos.maps.layout import read_map_settings, read_origin
from lostmotion_chaos.maps.map import Map
from lostmotion_chaos.maps.numbers import NumberLaw, NumberPower, make_law
from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
from lostmotion_chaos.maps.sweep import ProgressCallback, Workers

SWEPT_NUMBERS = ("alpha", "zeta", FREQUENCY_RATIO)
"""The dimensionless numbers that are the axes of a map; the third one only where the priors leave it free."""
PRIOR_TAIL = 5e-4
"""Share of an unbounded prior that is cut off at either end, since a map has ends."""
SMALLEST_SHARE = 5e-3
"""Where a prior begins at zero: the smallest value, as a share of the largest."""
ROUNDING_STEP = 0.01
"""The ends of a map are rounded outwards to steps of this share, so that a repeated reading reuses the map."""
RATIO_TOLERANCE = 2e-3
"""Relative tolerance between the frequency ratio of a given map and that of the case."""
FIRST_DRAWS = 4000
"""Draws from the first proposal; the best of them is taken as the maximum."""


@dataclass(frozen=True)
class MapGrid:
    """How maps are made: points along alpha, zeta and (where it is free) the frequency ratio, and motions in a cell.

    `maps` are files that are used instead of new maps. `jobs` = 0 means one thread for each core.
    """

    alpha: int = 160
    zeta: int = 20
    ratios: int = 7
    periods: int = 600
    transient: int = 200
    starts: int = 4
    seed: int = 0
    maps: tuple[Path, ...] = ()
    jobs: int = 0

    def count_points(self, name: str, several: bool) -> int:
        """Return the number of points of an axis; with a third axis, the first two have half as many."""
        if name == FREQUENCY_RATIO:
            return self.ratios
        return max(2, {"alpha": self.alpha, "zeta": self.zeta}[name] // (2 if several else 1))


@dataclass(frozen=True, eq=False)
class LevelNumbers:
    """The laws of the dimensionless numbers at each of the `levels`; each of `groups` has one drive frequency."""

    model: Model
    levels: tuple[Level, ...]
    free: tuple[FreeParameter, ...]
    laws: tuple[Mapping[str, NumberLaw], ...]
    fixed: Mapping[str, float]
    groups: list[list[int]] = field(default_factory=list)

    def find_range(self, group: Sequence[int], name: str) -> tuple[float, float]:
        """Return the range of a number over the levels of a group and over the bounds of the free parameters."""
        low, high = (tuple(_log_bound(f, end) for f in self.free) for end in ("low", "high"))
        ends = [self.laws[k][name].find_range(low, high) for k in group]
        return min(a for a, _ in ends), max(b for _, b in ends)


def make_quantifier_task(
    case: CaseFile, registry: Registry, out: Path, rng: np.random.Generator, grid: MapGrid | None = None,
    *, say: ProgressCallback = lambda _done, _all: None, settings: Settings = DEFAULT,
) -> Task:  # fmt: skip
    """Return the sampling task: the posterior given the levels of a case, given or read from its recordings.

    The maps are made or continued in the folder `out`; `say` is called with the numbers of finished and of all cells.
    `task.posterior` is the `Inversion`.
    """
    levels = read_or_take_levels(case, registry, rng, settings)
    posterior = make_inversion(case, levels, registry, out, grid or MapGrid(), say=say, limits=settings.levels)
    shown = tuple(ShownCoordinate(f.key, f.unit, 1.0 if f.log else 0.0) for f in posterior.space.free)
    mixture = find_mixture(posterior, rng)
    points = mixture.draw(FIRST_DRAWS, rng)
    log_densities = posterior.log_likelihood(points) + posterior.space.log_prior(points)
    if not np.isfinite(log_densities).any():
        raise DataError("no parameters within the priors explain these levels: check amplitudes, units and priors")
    return Task(posterior, mixture, shown, points[int(np.argmax(log_densities))], compute_digest(posterior))


def read_or_take_levels(
    case: CaseFile, registry: Registry, rng: np.random.Generator, settings: Settings = DEFAULT
) -> tuple[Level, ...]:
    """Return the levels of a case: those given in it, or else those read from its recordings."""
    if case.levels:
        return case.levels
    if case.recordings:
        return tuple(read.level for read in read_levels(case, registry, rng, settings))
    raise CaseError("the case has neither [[levels]] nor [[recordings]]: the quantifier route needs one of the two")


def make_inversion(
    case: CaseFile, levels: tuple[Level, ...], registry: Registry, out: Path, grid: MapGrid,
    *, say: ProgressCallback = lambda _done, _all: None, limits: LevelSettings = DEFAULT.levels,
) -> Inversion:  # fmt: skip
    """Return the posterior given levels; its maps are made in the folder `out` or read from the given files."""
    wanted = make_level_numbers(case, levels, registry)
    atlases = []
    for group in wanted.groups:
        found = (
            _find_given_map(wanted, group, grid) if grid.maps else _make_map(wanted, group, registry, out, grid, say)
        )
        atlases.append(Atlas.of(found, limits))
    which = {k: i for i, group in enumerate(wanted.groups) for k in group}
    order = tuple(which[k] for k in range(len(levels)))
    return Inversion(levels, tuple(atlases), order, wanted.laws, ParameterSpace(wanted.free), limits)


def make_level_numbers(case: CaseFile, levels: tuple[Level, ...], registry: Registry) -> LevelNumbers:
    """Return the dimensionless numbers at the levels of a case; raise `CaseError` where they cannot be computed."""
    model: Model = make_plugin(registry, "model", case.model)
    powers = {group.name: NumberPower.of(group, model) for group in model.groups}
    if lacking := [name for name in SWEPT_NUMBERS if name not in powers]:
        raise CaseError(f"{model.name} has no dimensionless number {lacking[0]}: the quantifier route cannot use it")
    known, free = (
        _collect_known(case, model),
        tuple(_make_free_parameter(key, prior, model) for key, prior in case.estimate.items()),
    )
    _require_units(model, levels)
    names = [f.key for f in free]
    laws = []
    for level in levels:
        given = {**known, "drive.amplitude": level.amplitude, "drive.omega": level.omega}
        laws.append({name: make_law(powers[name], given, names) for name in SWEPT_NUMBERS})
    wanted = LevelNumbers(
        model, levels, free, tuple(laws), _compute_fixed_numbers(powers, known, free), group_levels(levels)
    )
    return _drop_fixed_ratio(wanted)


def _drop_fixed_ratio(wanted: LevelNumbers) -> LevelNumbers:
    """Return the numbers without the frequency ratio where no free parameter changes it: each map then fixes it."""
    if any(any(law[FREQUENCY_RATIO].powers) for law in wanted.laws):
        return wanted
    laws = tuple({name: law for name, law in of.items() if name != FREQUENCY_RATIO} for of in wanted.laws)
    ratios = {f"{FREQUENCY_RATIO} {k}": math.exp(of[FREQUENCY_RATIO].constant) for k, of in enumerate(wanted.laws)}
    return replace(wanted, laws=laws, fixed={**wanted.fixed, **ratios})


def _collect_known(case: CaseFile, model: Model) -> dict[str, float]:
    """Return the known values by the model's own names; raise `CaseError` for parameters that cannot be estimated."""
    system = System.of(model)
    groups = {group.name for group in model.groups}
    try:
        known = {system.slot(name).key: value for name, value in case.known.items()}
        asked = [name for name in case.estimate if name not in groups and system.slot(name).key == name]
    except ContractError as err:
        raise CaseError(str(err)) from err
    useful = {"zeta", *(key for name in SWEPT_NUMBERS for key in _find_dependencies(model, name))}
    for name in case.estimate:
        if name not in useful:
            near = nearest(name, useful)
            raise CaseError(f"{name} cannot be estimated from chaos measures{near}: {', '.join(sorted(useful))} can")
    if "zeta" in case.estimate and "c" in {*asked, *known}:
        raise CaseError("the case gives both c and zeta: keep one of them")
    if known.get("mgl"):
        raise CaseError("the link has a weight (mgl), for which there is no map: the quantifier route needs mgl = 0")
    return known


def _find_dependencies(model: Model, name: str) -> set[str]:
    power = NumberPower.of(next(group for group in model.groups if group.name == name), model)
    return {key for key in (*power.powers, power.target) if not key.startswith("drive.")}


def _compute_fixed_numbers(
    powers: Mapping[str, NumberPower], known: Mapping[str, float], free: tuple[FreeParameter, ...]
) -> dict[str, float]:
    """Return the values of all other dimensionless numbers at the start values of the free parameters."""
    middle = {**known, **{f.key: f.value(f.start) for f in free}}
    fixed = {}
    for name, power in powers.items():
        if name not in SWEPT_NUMBERS:
            target = middle.get(power.target, 0.0)
            fixed[name] = target / (power.factor * math.prod(middle[k] ** p for k, p in power.powers.items()))
    return fixed


def _require_units(model: Model, levels: Sequence[Level]) -> None:
    unit = unit_of(model.inputs[0], model.motion)
    for level in levels:
        if level.unit != unit:
            raise CaseError(
                f"level {level.name} has an amplitude in {level.unit}, but what drives {model.name} is in {unit}: "
                "correct its unit, or choose another model"
            )


def _make_free_parameter(key: str, prior: Prior, model: Model) -> FreeParameter:
    """Return a free parameter whose prior is truncated to the finite, positive range of a map."""
    units = {slot.key: slot.unit for slot in System.of(model).slots}
    log = prior.kind in ("log-uniform", "log-normal")
    low, high = (prior.quantile(share) for share in ((PRIOR_TAIL, 1.0 - PRIOR_TAIL) if prior.bell else (0.0, 1.0)))
    low = max(low, SMALLEST_SHARE * high)
    if not high > low:
        raise CaseError(f"the prior of {key} goes up to {high:g}: the quantifier route needs positive values")
    ends = [math.log(value) if log else value for value in (low, high)]
    start = prior.start()
    begin = min(max(math.log(start) if log else start, ends[0]), ends[1])
    return FreeParameter(key, units.get(key, "1"), begin, ends[0], ends[1], log, *(prior.bell or (0.0, math.inf)))


def _log_bound(free: FreeParameter, end: str) -> float:
    value = float(getattr(free, end))
    return value if free.log else math.log(value)


def _make_map(
    wanted: LevelNumbers, group: Sequence[int], registry: Registry, out: Path, grid: MapGrid, say: ProgressCallback
) -> Map:  # fmt: skip
    """Return the map for the levels of one frequency, made in the folder `out`; its name has a hash of its settings."""
    request = make_request(wanted, group, grid)
    study = make_study(request, registry)
    name = hashlib.sha256(repr(request).encode()).hexdigest()[:8]
    return make_map(study, out / f"map-{name}.nc", RunOptions(Workers(grid.jobs)), say)


def make_request(wanted: LevelNumbers, group: Sequence[int], grid: MapGrid) -> Request:
    """Return the request for the map that the levels of one frequency need."""
    names = tuple(wanted.laws[group[0]])
    axes = []
    for name in names:
        low, high = wanted.find_range(group, name)
        if high / low - 1.0 < 1e-9:
            axes.append(f"{name}={low!r}:{low!r}:1")
            continue
        spacing = ":inverse" if name == "alpha" else ""
        ends = f"{_round_outward(low, math.floor)!r}:{_round_outward(high, math.ceil)!r}"
        axes.append(f"{name}={ends}:{grid.count_points(name, FREQUENCY_RATIO in names)}{spacing}")
    fixed = {key: value for key, value in wanted.fixed.items() if " " not in key and value}
    if FREQUENCY_RATIO not in names:
        fixed[FREQUENCY_RATIO] = float(f"{np.mean([wanted.fixed[f'{FREQUENCY_RATIO} {k}'] for k in group]):.5g}")
    return Request(
        wanted.model.name, tuple(axes), grid.periods, grid.transient, grid.starts,
        sets=tuple(f"{key}={value!r}" for key, value in fixed.items()),
        quantities=(SECTION_DIMENSION,), seed=grid.seed,
    )  # fmt: skip


def _round_outward(end: float, rounded: Callable[[float], int]) -> float:
    return float(f"{math.exp(ROUNDING_STEP * rounded(math.log(end) / ROUNDING_STEP)):.6g}")


def _find_given_map(wanted: LevelNumbers, group: Sequence[int], grid: MapGrid) -> Map:
    """Return the first given map that covers the range that the levels of one frequency need."""
    reasons = []
    for path in grid.maps:
        found = Map.open(path)
        if why := _explain_mismatch(found, wanted, group):
            reasons.append(f"{path.name} {why}")
        else:
            return found
    raise DataError(f"no map fits level {wanted.levels[group[0]].name}: {'; '.join(reasons)}")


def _explain_mismatch(found: Map, wanted: LevelNumbers, group: Sequence[int]) -> str:
    """Return why a map cannot be used, or an empty text."""
    settings, names = read_map_settings(read_origin(found.dataset.attrs)), wanted.laws[group[0]]
    if settings.model != wanted.model.name:
        return f"is of {settings.model}"
    if {*found.axes} != {*names}:
        return f"is over {', '.join(found.axes)}, and {', '.join(names)} are needed"
    for name in names:
        low, high = wanted.find_range(group, name)
        ends = found.dataset[name].to_numpy()
        if not (ends[0] <= low * (1.0 + RATIO_TOLERANCE) and ends[-1] * (1.0 + RATIO_TOLERANCE) >= high):
            return f"goes from {name} = {ends[0]:.4g} to {ends[-1]:.4g}, and the priors ask for {low:.4g} to {high:.4g}"
    if FREQUENCY_RATIO not in names:
        ratio = wanted.fixed[f"{FREQUENCY_RATIO} {group[0]}"]
        if not math.isclose(settings.fixed.get(FREQUENCY_RATIO, math.nan), ratio, rel_tol=RATIO_TOLERANCE):
            return f"has a frequency ratio of {settings.fixed.get(FREQUENCY_RATIO)}, and {ratio:.6g} is needed"
    return ""


def compute_digest(posterior: Inversion) -> str:
    """Return a text that changes with the levels, the priors and the maps."""
    maps = tuple(atlas.provenance for atlas in posterior.atlases)
    parts = (posterior.levels, posterior.space.free, maps, posterior.limits)
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def compute_derived(posterior: Inversion, points: Array) -> dict[str, Array]:
    """Return the dimensionless numbers (count,) of draws (count, parameters) that are not free parameters."""
    return {
        k: v for k, v in posterior.compute_numbers(points).items() if k not in {f.key for f in posterior.space.free}
    }
