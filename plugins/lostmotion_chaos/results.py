"""The result of `lostmotion analyse` in the form of `analysis.json`; the curves are in `analysis.nc`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from lostmotion.codec import described
from lostmotion.results.background import Origin

MotionKind = Literal["periodic", "quasiperiodic", "chaotic", "stochastic", "undecided"]
Strength = Literal["firm", "likely", "open"]
"""Strength of a verdict: all signs agree (firm), some are silent (likely), or the signs do not decide (open)."""
State = Literal["for", "against", "silent"]
DriveSource = Literal["excitation", "given", "spectrum", "none"]
Sided = Literal["two", "low", "high"]


@dataclass(frozen=True)
class Sign:
    """One sign of chaos: its name, its state, the reason, the explanation that it excludes, and its numbers."""

    key: str = described("key of the sign", key="sign")
    name: str = described("name of the sign")
    state: State = described("for chaos, against it, or silent where it could not be measured")
    says: str = described("the reason, in a sentence")
    excludes: str = described("the other explanation that it excludes where it is for chaos")
    figures: Mapping[str, float] = described("the numbers behind it, by name", default={})


@dataclass(frozen=True, kw_only=True)
class ChosenDelay:
    """The delay of the embedding."""

    samples: int = described("the delay in samples")
    seconds: float = described("the delay", unit="s")
    method: str = described("how it was chosen")


@dataclass(frozen=True, kw_only=True)
class ChosenDimension:
    """The dimension of the embedding."""

    value: int = described("coordinates of a delay vector")
    method: str = described("how it was chosen")
    theiler: int = described("points closer in time than this are not counted as neighbours", unit="samples")


@dataclass(frozen=True, kw_only=True)
class RecordedNoise:
    """The noise of the recording, before and after noise reduction."""

    before: float = described("noise as recorded; null where it could not be separated from the motion")
    after: float = described("noise after reduction; null where it could not be separated from the motion")
    unit: str = described("the quantity of which both are shares")
    before_interval: tuple[float, ...] = described("both ends of the 95 % interval of `before`")
    method: str = described("the denoiser; `none` where the recording was not changed")


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A value with its 95 % interval, or the reason why there is none."""

    name: str | None = described("the quantifier; only among `others`", default=None)
    value: float = described("the value; null where there is none")
    low: float = described("lower end of the 95 % interval; null where there is none")
    high: float = described("upper end of the 95 % interval; null where there is none")
    unit: str = described("its unit, `1` for a pure number")
    method: str = described("the method that measured it")
    status: str = described("`ok`, or the limitation of the value")
    says: str = described("a sentence where the status is not `ok`; empty otherwise")
    details: Mapping[str, float] = described("further numbers by name, such as the ends of the fitted range")


@dataclass(frozen=True, kw_only=True)
class SurrogateOutcome:
    """The outcome of a surrogate test."""

    null: str = described("the null hypothesis, in words")
    method: str = described("how surrogates were made")
    statistic: str = described("the statistic that was compared")
    draws: int = described("number of surrogates")
    p: float = described("p-value; null where the statistic could not be computed")
    sided: Sided = described("the side of the test")
    original: float = described("the statistic of the recording")
    says: str = described("the conclusion, in a sentence")


@dataclass(frozen=True, kw_only=True)
class DrivePeriod:
    """The period of the drive."""

    period: float = described("the period; null where there is none", unit="s")
    samples_per_period: float = described("samples in a period; null where there is none")
    source: DriveSource = described("where the period comes from")


@dataclass(frozen=True, kw_only=True)
class Analysis:
    """The content of `analysis.json`: the kind of a motion, the signs of chaos, and the measured quantities."""

    schema: str = described("name and version of the format", default="lostmotion.analysis/1")
    title: str = described("title of the case, or name of the recording")
    verdict: MotionKind = described("the kind of motion")
    strength: Strength = described("strength of the evidence for the verdict")
    says: str = described("the result in one or two sentences")
    signs: tuple[Sign, ...] = described("the signs of chaos")
    because: tuple[str, ...] = described("the reasons for the verdict, in sentences")
    delay: ChosenDelay = described("the delay of the embedding")
    dimension: ChosenDimension = described("the dimension of the embedding")
    noise: RecordedNoise = described("the noise of the recording")
    lyapunov: Measure = described("largest Lyapunov exponent")
    d2: Measure = described("correlation dimension")
    k2: Measure = described("correlation entropy")
    others: tuple[Measure, ...] = described("further quantities: checks of the exponent, and requested quantifiers")
    surrogates: tuple[SurrogateOutcome, ...] = described("the surrogate tests")
    drive: DrivePeriod = described("the period of the drive")
    notes: tuple[str, ...] = described("limitations of the result, in sentences")
    provenance: Origin = described("versions, settings, seed and digests of the inputs")
