"""Run an analysis: from a recording to `analysis.json`, `analysis.nc` and `report.html`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.contracts import Array, Quantifier, Series
from lostmotion.errors import DataError
from lostmotion.preparation.vetting import MethodWatch
from lostmotion.provenance import origin_of
from lostmotion.registry import Registry
from lostmotion.results import Estimate
from lostmotion.settings import DEFAULT, MotionSettings, Settings
from lostmotion.storage import dataset_of, folder_for, save_datasets, save_json
from lostmotion_chaos.analysis.channel import AnalysedChannel
from lostmotion_chaos.analysis.denoise import Denoised, denoise
from lostmotion_chaos.analysis.embed import embed
from lostmotion_chaos.analysis.motion import judge_motion
from lostmotion_chaos.analysis.motion_options import OPTIONS
from lostmotion_chaos.analysis.period import BasePeriod, MotionEvidence, find_base_period, measure_returns
from lostmotion_chaos.analysis.quantify import quantify
from lostmotion_chaos.analysis.report.page import write_analysis
from lostmotion_chaos.analysis.result import collect_arrays, make_result
from lostmotion_chaos.analysis.source import Source, WantedChannel, load_source
from lostmotion_chaos.analysis.surrogates import SurrogateTest, surrogate_test
from lostmotion_chaos.defaults import (
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
from lostmotion_chaos.rates import exponent_in
from lostmotion_chaos.results import Analysis
from lostmotion_chaos.signals.series import checked

if TYPE_CHECKING:
    import xarray as xr

ProgressCallback = Callable[[str], None]
STREAMS = ("denoise", "exponent", "dimension", "entropy", "surrogates", "others", "dimensions")
PICTURED_SURROGATES = 9
"""Number of surrogates whose dimension is shown in the figure."""
MAX_PERIODS_TOGETHER = 8
"""Largest number of cycles that surrogates keep together."""


@dataclass(frozen=True)
class AnalysisRequest:
    """Options of an analysis: channel, methods, number of surrogates, unit of exponents, seed and cores."""

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
    time: str | None = None

    def make_rng(self, stream: str) -> np.random.Generator:
        """Return the random generator of one stage; the stages do not depend on each other's draws."""
        return np.random.default_rng([self.seed, STREAMS.index(stream)])


def run_analysis(
    path: Path, out: Path, registry: Registry, request: AnalysisRequest, say: ProgressCallback = lambda _step: None
) -> Analysis:
    """Return the result after writing `analysis.json`, the arrays and the report into the folder `out`."""
    say("reading")
    wanted = WantedChannel(request.columns, request.rate, request.every, request.time)
    source = load_source(path, wanted, registry, request.settings.recording)
    _require_known(registry, request)
    folder = folder_for(out)
    result, arrays = analyse_source(source, registry, request, say)
    say("report")
    save_datasets(folder / "analysis.nc", {None: arrays})
    save_json(folder / "analysis.json", to_plain(result))
    write_analysis(folder)
    return result


def analyse_source(
    source: Source, registry: Registry, request: AnalysisRequest, say: ProgressCallback = lambda _step: None
) -> tuple[Analysis, xr.Dataset]:
    """Return the result and the arrays behind it; no file is written."""
    found = analyse(source, registry, request, say)
    settings = {k: v for k, v in asdict(request).items() if k not in ("jobs", "seed", "settings")}
    settings["thresholds"] = asdict(request.settings.motion)
    settings["recording_thresholds"] = asdict(request.settings.recording)
    made = origin_of("analyse", settings, request.seed, {**registry.origins(), **source.inputs})
    variables, coords = collect_arrays(found)
    return make_result(found, made, request.settings.motion), dataset_of(variables, coords, {"title": source.title})


def analyse(
    source: Source, registry: Registry, request: AnalysisRequest, say: ProgressCallback = lambda _step: None
) -> AnalysedChannel:
    """Return the results of all stages: delay, dimension, noise, exponent, correlation dimension, surrogate tests."""
    base = find_base_period(checked(source.x), source, request.period)
    third_party = MethodWatch(registry)
    say("delay and dimension")
    raw = _embed_series(source.x, third_party, request.embedder, source.dt, base)
    say("noise")
    denoised, denoiser = _reduce_noise(raw, third_party, request)
    if denoised.series is not raw:
        again = _embed_series(denoised.series.x, third_party, request.embedder, source.dt, base)
        denoised = replace(denoised, series=again)
    # The noise that remains after reduction is not white and hides fast growth: exponents come from the raw series.
    grown = _SeriesMeasurer(raw, third_party, request, base, say)
    measured = _SeriesMeasurer(denoised.series, third_party, request, base, say)
    exponent, dimension = grown(EXPONENT, "exponent"), measured(DIMENSION, "dimension")
    entropy = measured(ENTROPY, "entropy")
    others = {name: grown(name, "others") for name in dict.fromkeys((*EXPONENT_CHECKS, *request.quantifiers))}
    tests = _run_tests(raw, third_party, request, say)
    weighed = MotionEvidence(base, raw, denoised, exponent, dimension, entropy, tests, request.settings.motion)
    return AnalysedChannel(
        source=source,
        base=base,
        raw=raw,
        denoised=denoised,
        exponent=exponent,
        dimension=dimension,
        entropy=entropy,
        others=others,
        tests=tests,
        surrogate_dims=_measure_surrogate_dims(raw, registry, request, say),
        verdict=judge_motion(weighed),
        exponent_method=EXPONENT.removeprefix("lyapunov_"),
        denoiser=denoiser,
        aside=tuple(dict.fromkeys(third_party.said)),
    )


def _embed_series(x: Array, third_party: MethodWatch, name: str, dt: float, base: BasePeriod) -> Series:
    """Return the embedded series; the default embedder replaces one that fails."""

    def work(name: str) -> Series:
        return embed(x, third_party.registry.make("embedder", name), dt=dt, period=base.period)

    return third_party("embedder", name, x, lambda: work(name)) or work(EMBEDDER)


@dataclass(frozen=True, eq=False)
class _SeriesMeasurer:
    """Estimates of quantifiers by name on one series, exponents in the requested unit."""

    series: Series
    third_party: MethodWatch
    request: AnalysisRequest
    base: BasePeriod
    say: ProgressCallback

    def __call__(self, name: str, stream: str) -> Estimate:
        """Return the estimate of the quantifier `name`; it is a refusal where the quantifier breaks its contract."""
        self.say(name.replace("_", " "))
        reader, rng = _make_quantifier(self.third_party.registry, name), self.request.make_rng(stream)
        found = self.third_party("quantifier", name, self.series.x, lambda: quantify(self.series, reader, rng=rng))
        if found is None:
            return Estimate.refused("failed", self.third_party.said[-1], unit=reader.unit)
        return _convert_unit(found, self.request, self.base)


def _require_known(registry: Registry, request: AnalysisRequest) -> None:
    """Raise an error for an unknown name before the work begins."""
    registry.load("embedder", request.embedder)
    for name in request.surrogates:
        registry.load("surrogate", name)
    for name in request.quantifiers:
        _make_quantifier(registry, name)
    if request.denoiser not in (None, "none"):
        registry.load("denoiser", str(request.denoiser))


def _make_quantifier(registry: Registry, name: str) -> Quantifier[Series]:
    """Return the quantifier of this name; raise `DataError` if it does not read a series."""
    quantifier: Quantifier[Series] = registry.make("quantifier", name)
    if quantifier.reads != "series":
        raise DataError(f"{name} measures a model, not a recording: name one that reads a series")
    return quantifier


def _reduce_noise(raw: Series, third_party: MethodWatch, request: AnalysisRequest) -> tuple[Denoised, str]:
    """Return the series with reduced noise, and the name of the method; the series is unchanged if that fails."""
    registry = third_party.registry
    meter, rng = _make_quantifier(registry, METER), request.make_rng("denoise")
    level = meter.estimate(raw, rng=rng)
    if request.denoiser == "none" or (request.denoiser is None and not OPTIONS.quiet < level.value < OPTIONS.loud):
        return Denoised(raw, level, level), "none"
    name = request.denoiser or DENOISER
    denoiser = registry.make("denoiser", name)
    cleaned = third_party("denoiser", name, raw.x, lambda: denoise(raw, denoiser, meter, rng=rng))
    return (cleaned, name) if cleaned else (Denoised(raw, level, level), "none")


def _convert_unit(estimate: Estimate, request: AnalysisRequest, base: BasePeriod) -> Estimate:
    """Return an exponent in the requested unit, and any other estimate unchanged."""
    if estimate.unit != "1/s":
        return estimate
    if request.unit.endswith("/period") and base.period is None:
        raise DataError(f"the unit {request.unit} needs a period, and none was found: give --period, or another unit")
    return exponent_in(estimate, request.unit, period=base.period)


def _run_tests(
    raw: Series, third_party: MethodWatch, request: AnalysisRequest, say: ProgressCallback
) -> tuple[SurrogateTest, ...]:
    """Return the surrogate tests of the raw series, since noise reduction makes any series look deterministic.

    A usual test that the recording is too short for is left out with a note; one that was asked for is refused.
    """
    names = request.surrogates or ((SURROGATE, SURROGATE_OF_CYCLES) if raw.period else (SURROGATE,))
    statistic, tests = _make_quantifier(third_party.registry, STATISTIC), []
    for stream, name in zip(request.make_rng("surrogates").spawn(len(names)), names, strict=True):
        say(f"{name} surrogates")
        surrogate = third_party.registry.make("surrogate", name, **_choose_options(name, raw, request.settings.motion))
        test = partial(
            surrogate_test,
            raw,
            surrogate,
            statistic,
            draws=request.draws,
            sided="low",
            jobs=request.jobs,
            level=request.settings.motion.level,
        )
        try:
            tests.append(third_party("surrogate", name, raw.x, partial(test, rng=stream)))
        except DataError as err:
            if name in request.surrogates or name == SURROGATE:
                raise
            third_party.said.append(f"The test against {name.replace('_', ' ')} surrogates was left out: {err}.")
    found = tuple(test for test in tests if test)
    return found or _run_tests(raw, third_party, replace(request, surrogates=(SURROGATE,)), say)


def _choose_options(name: str, raw: Series, limits: MotionSettings) -> dict[str, int]:
    """Return the options of a surrogate: the number of cycles that stay together, after which the motion returns."""
    if name != SURROGATE_OF_CYCLES or raw.period is None:
        return {}
    spread = measure_returns(raw, raw.period)[:MAX_PERIODS_TOGETHER]
    best = int(np.nanargmin(spread))
    return {"together": best + 1} if spread[best] < OPTIONS.together * spread[0] else {}


def _measure_surrogate_dims(
    raw: Series, registry: Registry, request: AnalysisRequest, say: ProgressCallback
) -> Array | None:
    """Return the dimension of a few surrogates (draws, dims) over the embedding dimension, as in Fig. 21."""
    say("dimension of surrogates")
    rng = request.make_rng("dimensions")
    quantifier = registry.make("quantifier", DIMENSION, fast=True)
    rows = []
    for x in registry.make("surrogate", SURROGATE).draw(raw, draws=PICTURED_SURROGATES, rng=rng):
        found = quantify(replace(raw, x=x), quantifier, rng=rng)
        if "dimension_by_dim" in found.curve:
            rows.append(found.curve["dimension_by_dim"])
    return np.array(rows) if len({len(r) for r in rows}) == 1 else None
