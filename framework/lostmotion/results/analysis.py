"""What `lostmotion analyse` finds, as `analysis.json` has it; the curves behind it are in `analysis.nc`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from lostmotion.codec import told
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

    key: str = told("key of the sign", key="sign")
    name: str = told("name of the sign")
    state: State = told("whether it speaks for chaos, against it, or could not be read")
    says: str = told("the sentence why")
    excludes: str = told("the other explanation that it rules out where it speaks for chaos")
    figures: Mapping[str, float] = told("the numbers behind it, by name", default={})


@dataclass(frozen=True, kw_only=True)
class ChosenDelay:
    """The delay of the embedding."""

    samples: int = told("the delay in samples")
    seconds: float = told("the delay", unit="s")
    method: str = told("how it was chosen")


@dataclass(frozen=True, kw_only=True)
class ChosenDimension:
    """The dimension of the embedding."""

    value: int = told("coordinates of a delay vector")
    method: str = told("how it was chosen")
    theiler: int = told("points closer in time than this are no neighbours", unit="samples")


@dataclass(frozen=True, kw_only=True)
class RecordedNoise:
    """The noise of the recording, before and after noise reduction."""

    before: float = told("noise as recorded; null where it could not be told from the motion")
    after: float = told("noise after reduction; null where it could not be told from the motion")
    unit: str = told("what both are shares of")
    before_interval: tuple[float, ...] = told("both ends of the 95 % interval of `before`")
    method: str = told("the denoiser; `none` where the recording was left as it is")


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A number with its 95 % interval, or the reason why there is none."""

    name: str | None = told("the quantifier; only among `others`", default=None)
    value: float = told("the number; null where there is none")
    low: float = told("lower end of the 95 % interval; null where there is none")
    high: float = told("upper end of the 95 % interval; null where there is none")
    unit: str = told("its unit, `1` for a pure number")
    method: str = told("the method that measured it")
    status: str = told("`ok`, or what is wrong with the number")
    says: str = told("a sentence where the status is not `ok`; empty otherwise")
    details: Mapping[str, float] = told("further numbers by name, such as the ends of the piece that was fitted")


@dataclass(frozen=True, kw_only=True)
class SurrogateOutcome:
    """What a test against surrogates found."""

    null: str = told("the null hypothesis, in words")
    method: str = told("how surrogates were made")
    statistic: str = told("the number that was compared")
    draws: int = told("number of surrogates")
    p: float = told("p-value; null where the statistic could not be had")
    sided: Sided = told("the side of the test")
    original: float = told("the statistic of the recording")
    says: str = told("what follows, in a sentence")


@dataclass(frozen=True, kw_only=True)
class DrivePeriod:
    """The period of the drive."""

    period: float = told("the period; null where there is none", unit="s")
    samples_per_period: float = told("samples in a period; null where there is none")
    source: DriveSource = told("where the period comes from")


@dataclass(frozen=True, kw_only=True)
class Analysis:
    """The content of `analysis.json`: the kind of a motion, the signs of it, and its measures."""

    schema: str = told("name and version of the format", default="lostmotion.analysis/1")
    title: str = told("title of the case, or name of the recording")
    verdict: MotionKind = told("the kind of motion")
    strength: Strength = told("how firmly the signs bear the verdict")
    says: str = told("the answer in a sentence or two")
    signs: tuple[Sign, ...] = told("the signs of chaos, one by one")
    because: tuple[str, ...] = told("what the verdict rests on, in sentences")
    delay: ChosenDelay = told("the delay of the embedding")
    dimension: ChosenDimension = told("the dimension of the embedding")
    noise: RecordedNoise = told("the noise of the recording")
    lyapunov: Measure = told("largest Lyapunov exponent")
    d2: Measure = told("correlation dimension")
    k2: Measure = told("correlation entropy")
    others: tuple[Measure, ...] = told("further measures: checks of the exponent, and what was asked for")
    surrogates: tuple[SurrogateOutcome, ...] = told("the surrogate tests")
    drive: DrivePeriod = told("the period of the drive")
    notes: tuple[str, ...] = told("what a reader should mind")
    provenance: Origin = told("where the result comes from")
