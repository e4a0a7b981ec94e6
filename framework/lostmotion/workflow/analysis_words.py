"""What an analysis says: its numbers and sentences, as `analysis.json` has them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from lostmotion.results import Estimate
from lostmotion.results.analysis import (
    Analysis,
    ChosenDelay,
    ChosenDimension,
    DrivePeriod,
    Measure,
    RecordedNoise,
    SurrogateOutcome,
)
from lostmotion.results.background import Origin
from lostmotion.stages.surrogates import SurrogateTest

if TYPE_CHECKING:
    from lostmotion.workflow.analyse import AnalysedChannel

SHARE = "share of the signal's standard deviation"
CORRELATION = "grassberger_procaccia"


def statement(found: AnalysedChannel, origin: Origin) -> Analysis:
    """Return what was found out about a channel."""
    clean, denoised, embedding = found.clean, found.denoised, found.clean.embedding
    delay, dimension = embedding.methods
    return Analysis(
        title=found.source.title,
        verdict=found.verdict.motion,
        strength=found.verdict.strength,
        says=found.verdict.says,
        signs=found.verdict.signs,
        because=found.verdict.because,
        delay=ChosenDelay(samples=int(embedding.lag), seconds=embedding.lag * clean.dt, method=delay),
        dimension=ChosenDimension(value=int(embedding.dim), method=dimension, theiler=int(embedding.theiler)),
        noise=RecordedNoise(
            before=denoised.before.value,
            after=denoised.after.value,
            unit=SHARE,
            before_interval=(denoised.before.low, denoised.before.high),
            method=found.denoiser,
        ),
        lyapunov=measure(found.exponent, found.exponent_method),
        d2=measure(found.dimension, CORRELATION),
        k2=measure(found.entropy, CORRELATION),
        others=tuple(measure(one, name, name) for name, one in found.others.items()),
        surrogates=tuple(map(outcome, found.tests)),
        drive=_drive(found),
        notes=notes(found),
        provenance=origin,
    )


def measure(found: Estimate, method: str, name: str | None = None) -> Measure:
    """Return an estimate without its curves."""
    return Measure(
        name=name,
        value=found.value,
        low=found.low,
        high=found.high,
        unit=found.unit,
        method=method,
        status=found.status,
        says=found.says,
        details=found.details,
    )


def outcome(test: SurrogateTest) -> SurrogateOutcome:
    """Return a surrogate test without its draws."""
    return SurrogateOutcome(
        null=test.null,
        method=test.method,
        statistic=test.statistic,
        draws=len(test.values),
        p=test.p,
        sided=test.sided,
        original=test.original,
        says=test.says,
    )


def _drive(found: AnalysedChannel) -> DrivePeriod:
    period = math.nan if found.beat.period is None else found.beat.period
    return DrivePeriod(period=period, samples_per_period=period / found.source.dt, source=found.beat.source)


def notes(found: AnalysedChannel) -> tuple[str, ...]:
    """Return what a reader should doubt."""
    source, embedding = found.source, found.clean.embedding
    said = [*source.notes, *found.beat.notes, *found.aside]
    if embedding.status != "ok":
        said.append(embedding.says)
    for what, one in (("exponent", found.exponent), ("correlation dimension", found.dimension)):
        if one.status == "uncertain" or (one.ok and one.says):
            said.append(f"On the {what}: {one.says}")
    periods = math.nan if found.beat.period is None else len(source.x) * source.dt / found.beat.period
    if periods < 50:
        said.append(
            f"The recording holds {periods:.0f} periods: exponents and dimensions want some hundreds, so record longer."
        )
    return tuple(dict.fromkeys(said))
