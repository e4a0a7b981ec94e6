"""The quantifier route from a case to what is to be sampled: levels, their maps, and the posterior over both."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lostmotion.case import CaseFile, Prior
from lostmotion.case.levels import Level
from lostmotion.contracts import Array, Model
from lostmotion.defaults import SECTION_DIMENSION
from lostmotion.errors import CaseError, ContractError, DataError, nearest
from lostmotion.identification.reading import read_levels
from lostmotion.identification.sampling import ShownCoordinate, Task, TMixture
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import System
from lostmotion.maps.atlas import FREQUENCY_RATIO, Atlas
from lostmotion.maps.inversion import Inversion, group_levels
from lostmotion.maps.layout import read_map_settings, read_origin
from lostmotion.maps.map import Map
from lostmotion.maps.numbers import NumberLaw, NumberPower, make_law
from lostmotion.maps.run import Request, RunOptions, make_map, make_study
from lostmotion.maps.sweep import Workers
from lostmotion.preparation.vetting import sound
from lostmotion.quantities import unit_of
from lostmotion.registry import Registry

SWEPT = ("alpha", "zeta", FREQUENCY_RATIO)
"""The dimensionless numbers that an inversion looks things up by; a third one only where the priors leave it open."""
TAILS = 5e-4
"""Share of a prior that is cut off at either end, since a map has ends."""
SMALLEST = 5e-3
"""Where a prior begins at zero: the least value, as a share of the largest."""
STEP = 0.01
"""The ends of a map are rounded outwards by steps of this share, so that levels read again find it again."""
ALIKE = 2e-3
"""Share by which the frequency ratio of a map that is given may differ from that of the case."""
FIRST = 4000
"""Draws from the first proposal, of which the best stands for the maximum."""
Say = Callable[[int, int], None]


@dataclass(frozen=True)
class Survey:
    """How maps are made: points along alpha, zeta and (where it is open) the frequency ratio, and motions in a cell.

    `maps` are files to be used in place of new ones. `jobs` = 0 stands for one to each core.
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

    def points(self, name: str, several: bool) -> int:
        """Return the points of an axis; with a third axis there are half as many along the other two."""
        if name == FREQUENCY_RATIO:
            return self.ratios
        return max(2, {"alpha": self.alpha, "zeta": self.zeta}[name] // (2 if several else 1))


@dataclass(frozen=True, eq=False)
class LevelNumbers:
    """The laws of the dimensionless numbers at each of the `levels`, in `groups` of one drive frequency."""

    model: Model
    levels: tuple[Level, ...]
    free: tuple[FreeParameter, ...]
    laws: tuple[Mapping[str, NumberLaw], ...]
    fixed: Mapping[str, float]
    groups: list[list[int]] = field(default_factory=list)

    def span(self, group: Sequence[int], name: str) -> tuple[float, float]:
        """Return the ends of a number over the levels of a group and over the bounds of what is free."""
        low, high = (tuple(_log(f, end) for f in self.free) for end in ("low", "high"))
        ends = [self.laws[k][name].find_range(low, high) for k in group]
        return min(a for a, _ in ends), max(b for _, b in ends)


def quantifier_task(
    case: CaseFile, registry: Registry, out: Path, rng: np.random.Generator, survey: Survey | None = None,
    *, say: Say = lambda _done, _all: None,
) -> Task:  # fmt: skip
    """Return what is to be sampled: the posterior given the levels of a case, typed in or read from its recordings.

    The maps are made in the folder `out`, or continued there; `say` is told how many cells are done, of how many.
    `task.posterior` is the `Inversion`.
    """
    levels = levels_of(case, registry, rng)
    posterior = inversion_of(case, levels, registry, out, survey or Survey(), say=say)
    shown = tuple(ShownCoordinate(f.key, f.unit, 1.0 if f.log else 0.0) for f in posterior.free)
    mixture = TMixture.by_importance_sampling(posterior, rng)
    points = mixture.draw(FIRST, rng)
    log_densities = posterior.log_likelihoods(points) + np.array([posterior.log_prior(p) for p in points])
    if not np.isfinite(log_densities).any():
        raise DataError("no machine within the priors shows such levels: check amplitudes, units and priors")
    return Task(posterior, mixture, shown, points[int(np.argmax(log_densities))], digest_of(posterior))


def levels_of(case: CaseFile, registry: Registry, rng: np.random.Generator) -> tuple[Level, ...]:
    """Return the levels of a case: those typed in, or else those that its recordings are read as."""
    if case.levels:
        return case.levels
    if case.recordings:
        return tuple(read.level for read in read_levels(case, registry, rng))
    raise CaseError("the case has neither [[levels]] nor [[recordings]]: the quantifier route wants one of the two")


def inversion_of(
    case: CaseFile, levels: tuple[Level, ...], registry: Registry, out: Path, survey: Survey,
    *, say: Say = lambda _done, _all: None,
) -> Inversion:  # fmt: skip
    """Return the posterior given levels, its maps made in the folder `out` or taken from the files of the survey."""
    wanted = wanted_of(case, levels, registry)
    atlases = []
    for group in wanted.groups:
        found = _given(wanted, group, survey) if survey.maps else _made(wanted, group, registry, out, survey, say)
        atlases.append(Atlas.of(found))
    which = {k: i for i, group in enumerate(wanted.groups) for k in group}
    return Inversion(levels, tuple(atlases), tuple(which[k] for k in range(len(levels))), wanted.laws, wanted.free)


def wanted_of(case: CaseFile, levels: tuple[Level, ...], registry: Registry) -> LevelNumbers:
    """Return which numbers the levels of a case ask for; raises `CaseError` where they cannot be worked out."""
    model: Model = sound(registry, "model", case.model)
    powers = {group.name: NumberPower.of(group, model) for group in model.groups}
    if lacking := [name for name in SWEPT if name not in powers]:
        raise CaseError(f"{model.name} has no dimensionless number {lacking[0]}: the quantifier route cannot use it")
    known, free = _known(case, model), tuple(_free(key, prior, model) for key, prior in case.estimate.items())
    _require_units(model, levels)
    names = [f.key for f in free]
    laws = []
    for level in levels:
        told = {**known, "drive.amplitude": level.amplitude, "drive.omega": level.omega}
        laws.append({name: make_law(powers[name], told, names) for name in SWEPT})
    wanted = LevelNumbers(model, levels, free, tuple(laws), _fixed(powers, known, free), group_levels(levels))
    return _bare(wanted)


def _bare(wanted: LevelNumbers) -> LevelNumbers:
    """Return the same without a frequency ratio where nothing free moves it: it is fixed in each map then."""
    if any(any(law[FREQUENCY_RATIO].powers) for law in wanted.laws):
        return wanted
    laws = tuple({name: law for name, law in of.items() if name != FREQUENCY_RATIO} for of in wanted.laws)
    ratios = {f"{FREQUENCY_RATIO} {k}": math.exp(of[FREQUENCY_RATIO].constant) for k, of in enumerate(wanted.laws)}
    return replace(wanted, laws=laws, fixed={**wanted.fixed, **ratios})


def _known(case: CaseFile, model: Model) -> dict[str, float]:
    """Return what a case knows by the model's own names; further parameters that would be estimated are refused."""
    system = System.of(model)
    groups = {group.name for group in model.groups}
    try:
        known = {system.slot(name).key: value for name, value in case.known.items()}
        asked = [name for name in case.estimate if name not in groups and system.slot(name).key == name]
    except ContractError as err:
        raise CaseError(str(err)) from err
    useful = {"zeta", *(key for name in SWEPT for key in _moves(model, name))}
    for name in case.estimate:
        if name not in useful:
            near = nearest(name, useful)
            raise CaseError(f"{name} cannot be estimated from chaos measures{near}: {', '.join(sorted(useful))} can")
    if "zeta" in case.estimate and "c" in {*asked, *known}:
        raise CaseError("the case gives both c and zeta: keep one of them")
    if known.get("mgl"):
        raise CaseError("the link has a weight (mgl), for which there is no map: the quantifier route wants mgl = 0")
    return known


def _moves(model: Model, name: str) -> set[str]:
    power = NumberPower.of(next(group for group in model.groups if group.name == name), model)
    return {key for key in (*power.powers, power.target) if not key.startswith("drive.")}


def _fixed(
    powers: Mapping[str, NumberPower], known: Mapping[str, float], free: tuple[FreeParameter, ...]
) -> dict[str, float]:
    """Return the further dimensionless numbers that are not zero, at the middle of what is free."""
    middle = {**known, **{f.key: f.value(f.start) for f in free}}
    fixed = {}
    for name, power in powers.items():
        if name not in SWEPT:
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


def _free(key: str, prior: Prior, model: Model) -> FreeParameter:
    """Return a free parameter with its prior cut where a map must end, all of it positive."""
    units = {slot.key: slot.unit for slot in System.of(model).slots}
    log = prior.kind in ("log-uniform", "log-normal")
    low, high = (prior.quantile(share) for share in ((TAILS, 1.0 - TAILS) if prior.bell else (0.0, 1.0)))
    low = max(low, SMALLEST * high)
    if not high > low:
        raise CaseError(f"the prior of {key} goes up to {high:g}: the quantifier route wants positive values")
    ends = [math.log(value) if log else value for value in (low, high)]
    start = prior.start()
    begin = min(max(math.log(start) if log else start, ends[0]), ends[1])
    return FreeParameter(key, units.get(key, "1"), begin, ends[0], ends[1], log, *(prior.bell or (0.0, math.inf)))


def _log(free: FreeParameter, end: str) -> float:
    value = float(getattr(free, end))
    return value if free.log else math.log(value)


def _made(
    wanted: LevelNumbers, group: Sequence[int], registry: Registry, out: Path, survey: Survey, say: Say
) -> Map:  # fmt: skip
    """Return the map for the levels of one frequency, made in the folder `out` under a name that tells its settings."""
    request = request_for(wanted, group, survey)
    study = make_study(request, registry)
    name = hashlib.sha256(repr(request).encode()).hexdigest()[:8]
    return make_map(study, out / f"map-{name}.nc", RunOptions(Workers(survey.jobs)), say)


def request_for(wanted: LevelNumbers, group: Sequence[int], survey: Survey) -> Request:
    """Return the map that the levels of one frequency ask for."""
    names = tuple(wanted.laws[group[0]])
    axes = []
    for name in names:
        low, high = wanted.span(group, name)
        if high / low - 1.0 < 1e-9:
            axes.append(f"{name}={low!r}:{low!r}:1")
            continue
        spacing = ":inverse" if name == "alpha" else ""
        ends = f"{_outward(low, math.floor)!r}:{_outward(high, math.ceil)!r}"
        axes.append(f"{name}={ends}:{survey.points(name, FREQUENCY_RATIO in names)}{spacing}")
    fixed = {key: value for key, value in wanted.fixed.items() if " " not in key and value}
    if FREQUENCY_RATIO not in names:
        fixed[FREQUENCY_RATIO] = float(f"{np.mean([wanted.fixed[f'{FREQUENCY_RATIO} {k}'] for k in group]):.5g}")
    return Request(
        wanted.model.name, tuple(axes), survey.periods, survey.transient, survey.starts,
        sets=tuple(f"{key}={value!r}" for key, value in fixed.items()),
        quantities=(SECTION_DIMENSION,), seed=survey.seed,
    )  # fmt: skip


def _outward(end: float, rounded: Callable[[float], int]) -> float:
    return float(f"{math.exp(STEP * rounded(math.log(end) / STEP)):.6g}")


def _given(wanted: LevelNumbers, group: Sequence[int], survey: Survey) -> Map:
    """Return the map among those given that holds all that the levels of one frequency may need."""
    reasons = []
    for path in survey.maps:
        found = Map.open(path)
        if why := _unfit(found, wanted, group):
            reasons.append(f"{path.name} {why}")
        else:
            return found
    raise DataError(f"no map fits level {wanted.levels[group[0]].name}: {'; '.join(reasons)}")


def _unfit(found: Map, wanted: LevelNumbers, group: Sequence[int]) -> str:
    """Return why a map does not serve, or nothing."""
    settings, names = read_map_settings(read_origin(found.dataset.attrs)), wanted.laws[group[0]]
    if settings.model != wanted.model.name:
        return f"is of {settings.model}"
    if {*found.axes} != {*names}:
        return f"is over {', '.join(found.axes)}, and {', '.join(names)} are wanted"
    for name in names:
        low, high = wanted.span(group, name)
        ends = found.dataset[name].to_numpy()
        if not (ends[0] <= low * (1.0 + ALIKE) and ends[-1] * (1.0 + ALIKE) >= high):
            return f"goes from {name} = {ends[0]:.4g} to {ends[-1]:.4g}, and the priors ask for {low:.4g} to {high:.4g}"
    if FREQUENCY_RATIO not in names:
        ratio = wanted.fixed[f"{FREQUENCY_RATIO} {group[0]}"]
        if not math.isclose(settings.fixed.get(FREQUENCY_RATIO, math.nan), ratio, rel_tol=ALIKE):
            return f"has a frequency ratio of {settings.fixed.get(FREQUENCY_RATIO)}, and {ratio:.6g} is wanted"
    return ""


def digest_of(posterior: Inversion) -> str:
    """Return a text that changes with the levels, the priors and the maps."""
    parts = (posterior.levels, posterior.free, tuple(atlas.provenance for atlas in posterior.atlases))
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def derived(posterior: Inversion, points: Array) -> dict[str, Array]:
    """Return dimensionless numbers (count,) that draws (count, parameters) imply and that are not free themselves."""
    return {k: v for k, v in posterior.compute_numbers(points).items() if k not in {f.key for f in posterior.free}}
