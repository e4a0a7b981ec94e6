"""The chaos laboratory from end to end: a recording in, `analysis.json`, `analysis.nc` and `report.html` out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.analysis.beat import Beat, MotionEvidence, beat_of, returns
from lostmotion.analysis.denoise import Denoised, denoise
from lostmotion.analysis.embed import embed
from lostmotion.analysis.motion import Verdict, verdict_on
from lostmotion.analysis.quantify import quantify
from lostmotion.analysis.report.page import write_analysis
from lostmotion.analysis.result import arrays_of, statement
from lostmotion.analysis.source import Source, WantedChannel, source_of
from lostmotion.analysis.surrogates import SurrogateTest, surrogate_test
from lostmotion.codec import to_plain
from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.defaults import (
    DENOISER,
    DIMENSION,
    EMBEDDER,
    ENTROPY,
    EXPONENT,
    EXPONENT_CHECKS,
    METER,
    STATISTIC,
    SURROGATE,
    SURROGATE_OF_CYCLES,
)
from lostmotion.errors import DataError
from lostmotion.preparation.vetting import Guests
from lostmotion.provenance import origin_of
from lostmotion.rates import exponent_in
from lostmotion.registry import Registry
from lostmotion.results import Estimate
from lostmotion.results.analysis import Analysis
from lostmotion.settings import DEFAULT, Settings
from lostmotion.signals import checked
from lostmotion.storage import dataset_of, folder_for, save_datasets, save_json

if TYPE_CHECKING:
    import xarray as xr

Say = Callable[[str], None]
STREAMS = ("denoise", "exponent", "dimension", "entropy", "surrogates", "others", "dimensions")
QUIET, LOUD = 0.003, 0.3
"""Noise below this share of the standard deviation is left alone, as no method here sees it; and above it, as no
motion can be told from it."""
PICTURED = 9
FEW, APART = 8, 0.7
"""A motion that returns after k of up to 8 periods so much better than after one is taken to be k times longer."""


@dataclass(frozen=True)
class AnalysisRequest:
    """What is asked for: which channel, which methods, how many surrogates, the unit of exponents, seed and cores."""

    columns: tuple[str, ...] = ()
    rate: float | None = None
    every: int = 1
    period: float | None = None
    embedder: str = EMBEDDER
    denoiser: str | None = None
    quantifiers: tuple[str, ...] = ()
    surrogates: tuple[str, ...] = ()
    draws: int = 99
    unit: str = "1/s"
    seed: int = 0
    jobs: int = 2
    settings: Settings = DEFAULT

    def rng(self, stream: str) -> np.random.Generator:
        """Return the random stream of one stage: no stage depends on what another one has drawn."""
        return np.random.default_rng([self.seed, STREAMS.index(stream)])


@dataclass(frozen=True, eq=False)
class AnalysedChannel:
    """Everything that was found out about one recorded channel."""

    source: Source
    beat: Beat
    raw: Series
    denoised: Denoised
    exponent: Estimate
    dimension: Estimate
    entropy: Estimate
    others: dict[str, Estimate]
    tests: tuple[SurrogateTest, ...]
    surrogate_dims: Array | None
    verdict: Verdict
    exponent_method: str
    denoiser: str
    aside: tuple[str, ...] = ()

    @property
    def clean(self) -> Series:
        """The series that was measured: cleaned, and embedded anew."""
        return self.denoised.series


def run_analysis(
    path: Path, out: Path, registry: Registry, request: AnalysisRequest, say: Say = lambda _step: None
) -> Analysis:
    """Return what was found after writing `analysis.json`, the arrays and the report into the folder `out`."""
    say("reading")
    wanted = WantedChannel(request.columns, request.rate, request.every)
    source = source_of(path, wanted, registry, request.settings.recording)
    _require_known(registry, request)
    folder = folder_for(out)
    result, arrays = analyse_source(source, registry, request, say)
    say("report")
    save_datasets(folder / "analysis.nc", {None: arrays})
    save_json(folder / "analysis.json", to_plain(result))
    write_analysis(folder)
    return result


def analyse_source(
    source: Source, registry: Registry, request: AnalysisRequest, say: Say = lambda _step: None
) -> tuple[Analysis, xr.Dataset]:
    """Return what was found and the arrays behind it; nothing is written."""
    found = analyse(source, registry, request, say)
    settings = {k: v for k, v in asdict(request).items() if k not in ("jobs", "seed", "settings")}
    settings["thresholds"] = asdict(request.settings.motion)
    settings["recording_thresholds"] = asdict(request.settings.recording)
    made = origin_of("analyse", settings, request.seed, {**registry.origins(), **source.inputs})
    variables, coords = arrays_of(found)
    return statement(found, made), dataset_of(variables, coords, {"title": source.title})


def analyse(
    source: Source, registry: Registry, request: AnalysisRequest, say: Say = lambda _step: None
) -> AnalysedChannel:
    """Return what the chain finds: delay, dimension, noise, exponent, correlation dimension, surrogate tests."""
    beat = beat_of(checked(source.x), source, request.period)
    third_party = Guests(registry)
    say("delay and dimension")
    raw = _embedded(source.x, third_party, request.embedder, source.dt, beat)
    say("noise")
    denoised, denoiser = _cleaned(raw, third_party, request)
    if denoised.series is not raw:
        again = _embedded(denoised.series.x, third_party, request.embedder, source.dt, beat)
        denoised = replace(denoised, series=again)
    # What noise reduction leaves is no longer white and makes growth look slow: exponents are read from the raw series.
    grown = _Measured(raw, third_party, request, beat, say)
    measured = _Measured(denoised.series, third_party, request, beat, say)
    exponent, dimension = grown(EXPONENT, "exponent"), measured(DIMENSION, "dimension")
    entropy = measured(ENTROPY, "entropy")
    others = {name: grown(name, "others") for name in dict.fromkeys((*EXPONENT_CHECKS, *request.quantifiers))}
    tests = _tests(raw, third_party, request, say)
    weighed = MotionEvidence(beat, raw, denoised, exponent, dimension, entropy, tests, request.settings.motion)
    return AnalysedChannel(
        source=source,
        beat=beat,
        raw=raw,
        denoised=denoised,
        exponent=exponent,
        dimension=dimension,
        entropy=entropy,
        others=others,
        tests=tests,
        surrogate_dims=_surrogate_dims(raw, registry, request, say),
        verdict=verdict_on(weighed),
        exponent_method=EXPONENT.removeprefix("lyapunov_"),
        denoiser=denoiser,
        aside=tuple(dict.fromkeys(third_party.said)),
    )


def _embedded(x: Array, third_party: Guests, name: str, dt: float, beat: Beat) -> Series:
    """Return the series with delay and dimension; the usual embedder takes the place of one that breaks down."""

    def work(name: str) -> Series:
        return embed(x, third_party.registry.make("embedder", name), dt=dt, period=beat.period)

    return third_party("embedder", name, x, lambda: work(name)) or work(EMBEDDER)


@dataclass(frozen=True, eq=False)
class _Measured:
    """Quantifiers by name on one series, exponents in the unit that was asked for."""

    series: Series
    third_party: Guests
    request: AnalysisRequest
    beat: Beat
    say: Say

    def __call__(self, name: str, stream: str) -> Estimate:
        """Return the estimate of the quantifier `name`, which is a refusal where that breaks its contract."""
        self.say(name.replace("_", " "))
        reader, rng = _reader(self.third_party.registry, name), self.request.rng(stream)
        found = self.third_party("quantifier", name, self.series.x, lambda: quantify(self.series, reader, rng=rng))
        if found is None:
            return Estimate.refused("failed", self.third_party.said[-1], unit=reader.unit)
        return _converted(found, self.request, self.beat)


def _require_known(registry: Registry, request: AnalysisRequest) -> None:
    """Refuse a name that is unknown before the work begins."""
    registry.load("embedder", request.embedder)
    for name in request.surrogates:
        registry.load("surrogate", name)
    for name in request.quantifiers:
        _reader(registry, name)
    if request.denoiser not in (None, "none"):
        registry.load("denoiser", str(request.denoiser))


def _reader(registry: Registry, name: str) -> Quantifier[Series]:
    """Return the quantifier of recordings of this name."""
    quantifier: Quantifier[Series] = registry.make("quantifier", name)
    if quantifier.reads != "series":
        raise DataError(f"{name} measures a model, not a recording: name one that reads a series")
    return quantifier


def _cleaned(raw: Series, third_party: Guests, request: AnalysisRequest) -> tuple[Denoised, str]:
    """Return the series with less noise, and how that was done; a denoiser that breaks down leaves it as it is."""
    registry = third_party.registry
    meter, rng = _reader(registry, METER), request.rng("denoise")
    level = meter.estimate(raw, rng=rng)
    if request.denoiser == "none" or (request.denoiser is None and not QUIET < level.value < LOUD):
        return Denoised(raw, level, level), "none"
    name = request.denoiser or DENOISER
    denoiser = registry.make("denoiser", name)
    cleaned = third_party("denoiser", name, raw.x, lambda: denoise(raw, denoiser, meter, rng=rng))
    return (cleaned, name) if cleaned else (Denoised(raw, level, level), "none")


def _converted(estimate: Estimate, request: AnalysisRequest, beat: Beat) -> Estimate:
    """Return an exponent in the unit that was asked for; any other estimate as it is."""
    if estimate.unit != "1/s":
        return estimate
    if request.unit.endswith("/period") and beat.period is None:
        raise DataError(f"the unit {request.unit} needs a period, and none was found: give --period, or another unit")
    return exponent_in(estimate, request.unit, period=beat.period)


def _tests(raw: Series, third_party: Guests, request: AnalysisRequest, say: Say) -> tuple[SurrogateTest, ...]:
    """Return the surrogate tests: on the recording as it is, since noise reduction makes any series look ruled."""
    names = request.surrogates or ((SURROGATE, SURROGATE_OF_CYCLES) if raw.period else (SURROGATE,))
    statistic, tests = _reader(third_party.registry, STATISTIC), []
    for stream, name in zip(request.rng("surrogates").spawn(len(names)), names, strict=True):
        say(f"{name} surrogates")
        surrogate = third_party.registry.make("surrogate", name, **_options(name, raw))
        test = partial(surrogate_test, raw, surrogate, statistic, draws=request.draws, sided="low", jobs=request.jobs)
        tests.append(third_party("surrogate", name, raw.x, partial(test, rng=stream)))
    found = tuple(test for test in tests if test)
    return found or _tests(raw, third_party, replace(request, surrogates=(SURROGATE,)), say)


def _options(name: str, raw: Series) -> dict[str, int]:
    """Return the options of a surrogate: cycles stay together over as many periods as the motion needs to return."""
    if name != SURROGATE_OF_CYCLES or raw.period is None:
        return {}
    spread = returns(raw, raw.period)[:FEW]
    best = int(np.nanargmin(spread))
    return {"together": best + 1} if spread[best] < APART * spread[0] else {}


def _surrogate_dims(raw: Series, registry: Registry, request: AnalysisRequest, say: Say) -> Array | None:
    """Return the dimension of a few surrogates over the embedding dimension (draws, dims), as in Fig. 21."""
    say("dimension of surrogates")
    rng = request.rng("dimensions")
    quantifier = registry.make("quantifier", DIMENSION, fast=True)
    rows = []
    for x in registry.make("surrogate", SURROGATE).draw(raw, draws=PICTURED, rng=rng):
        found = quantify(replace(raw, x=x), quantifier, rng=rng)
        if "dimension_by_dim" in found.curve:
            rows.append(found.curve["dimension_by_dim"])
    return np.array(rows) if len({len(r) for r in rows}) == 1 else None
