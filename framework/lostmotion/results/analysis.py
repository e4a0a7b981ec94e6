"""What `lostmotion analyse` finds, as `analysis.json` has it; the curves behind it are in `analysis.nc`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from lostmotion.codec import described
from lostmotion.results.background import Origin

MotionKind = Literal["periodic", "quasiperiodic", "chaotic", "stochastic", "undecided"]
Strength = Literal["firm", "likely", "open"]
"""How far the signs bear a verdict: all that can, some while others are silent, or not at all."""
State = Literal["for", "against", "silent"]
DriveSource = Literal["excitation", "given", "spectrum", "none"]
Sided = Literal["two", "low", "high"]


@dataclass(frozen=True)
class Sign:
    """One sign of chaos: its name, what it says of chaos, the sentence why, what else it rules out, its numbers."""

    key: str = described("key of the sign", key="sign")
    name: str = described("name of the sign")
    state: State = described("whether it speaks for chaos, against it, or could not be read")
    says: str = described("the sentence why")
    excludes: str = described("the other explanation that it rules out where it speaks for chaos")
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
    theiler: int = described("points closer in time than this are no neighbours", unit="samples")


@dataclass(frozen=True, kw_only=True)
class RecordedNoise:
    """The noise of the recording, before and after noise reduction."""

    before: float = described("noise as recorded; null where it could not be told from the motion")
    after: float = described("noise after reduction; null where it could not be told from the motion")
    unit: str = described("what both are shares of")
    before_interval: tuple[float, ...] = described("both ends of the 95 % interval of `before`")
    method: str = described("the denoiser; `none` where the recording was left as it is")


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A number with its 95 % interval, or the reason why there is none."""

    name: str | None = described("the quantifier; only among `others`", default=None)
    value: float = described("the number; null where there is none")
    low: float = described("lower end of the 95 % interval; null where there is none")
    high: float = described("upper end of the 95 % interval; null where there is none")
    unit: str = described("its unit, `1` for a pure number")
    method: str = described("the method that measured it")
    status: str = described("`ok`, or what is wrong with the number")
    says: str = described("a sentence where the status is not `ok`; empty otherwise")
    details: Mapping[str, float] = described("further numbers by name, such as the ends of the piece that was fitted")


@dataclass(frozen=True, kw_only=True)
class SurrogateOutcome:
    """What a test against surrogates found."""

    null: str = described("the null hypothesis, in words")
    method: str = described("how surrogates were made")
    statistic: str = described("the number that was compared")
    draws: int = described("number of surrogates")
    p: float = described("p-value; null where the statistic could not be had")
    sided: Sided = described("the side of the test")
    original: float = described("the statistic of the recording")
    says: str = described("what follows, in a sentence")


@dataclass(frozen=True, kw_only=True)
class DrivePeriod:
    """The period of the drive."""

    period: float = described("the period; null where there is none", unit="s")
    samples_per_period: float = described("samples in a period; null where there is none")
    source: DriveSource = described("where the period comes from")


@dataclass(frozen=True, kw_only=True)
class Analysis:
    """The content of `analysis.json`: the kind of a motion, the signs of it, and its measures."""

    schema: str = described("name and version of the format", default="lostmotion.analysis/1")
    title: str = described("title of the case, or name of the recording")
    verdict: MotionKind = described("the kind of motion")
    strength: Strength = described("how firmly the signs bear the verdict")
    says: str = described("the answer in a sentence or two")
    signs: tuple[Sign, ...] = described("the signs of chaos, one by one")
    because: tuple[str, ...] = described("what the verdict rests on, in sentences")
    delay: ChosenDelay = described("the delay of the embedding")
    dimension: ChosenDimension = described("the dimension of the embedding")
    noise: RecordedNoise = described("the noise of the recording")
    lyapunov: Measure = described("largest Lyapunov exponent")
    d2: Measure = described("correlation dimension")
    k2: Measure = described("correlation entropy")
    others: tuple[Measure, ...] = described("further measures: checks of the exponent, and what was asked for")
    surrogates: tuple[SurrogateOutcome, ...] = described("the surrogate tests")
    drive: DrivePeriod = described("the period of the drive")
    notes: tuple[str, ...] = described("what a reader should mind")
    provenance: Origin = described("where the result comes from")
