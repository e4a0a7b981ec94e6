"""Where a model and a recording differ: a missing force, what it depends on, and when it is largest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described


@dataclass(frozen=True)
class UnexplainedForce:
    """A force that is missing, as a random one."""

    significant: bool = described("whether it is beyond the usual noise of the drive")
    rms: float = described("its rms, in `unit`")
    unit: str = described("unit of `rms`")
    share_of_drive: float = described("its rms as a share of the drive")


@dataclass(frozen=True)
class WorstWindow:
    """The stretch of a recording in which a model disagrees most."""

    window: int = described("its number, from 0")
    begin: float = described("its begin", unit="s")
    end: float = described("its end", unit="s")
    ratio: float = described("mean squared one-step error over the variance expected")
    p: float = described("p-value over all windows; null where there are too few samples")
    beyond_chance: bool = described("whether that is beyond chance")


@dataclass(frozen=True)
class Peaks:
    """The peaks of the hits of a hammer."""

    values: tuple[float, ...] = described("force of each hit, in `unit`")
    unit: str = described("unit of `values`")


@dataclass(frozen=True)
class DisagreementOverTime:
    """How much the models disagree with a recording in each stretch of it."""

    edges: tuple[float, ...] = described("limits of the stretches", unit="s")
    unit: str = described("unit of `edges`")
    windows: str = described("`even`, or `hits` where a stretch begins with each hit")
    before: tuple[float, ...] = described("mean squared one-step error over the variance expected, nominal model")
    after: tuple[float, ...] = described("the same with what was found")
    expected: float = described("what a right model has")
    worst: WorstWindow = described("the stretch that stands out most, after")
    worst_before: WorstWindow = described("the stretch that stands out most, before")
    says: str = described("where the model disagrees most, in a sentence; empty where that is not beyond chance")
    peaks: Peaks | None = described("peaks of the hits, where a hammer drives the machine", default=None)


@dataclass(frozen=True)
class RecordingMismatch:
    """How much the models disagree with one of several recordings."""

    name: str = described("name of the recording")
    level: float = described("rms of its drive, or of its response where nothing drives it, in `unit`")
    unit: str = described("unit of `level`")
    fitted: bool = described("whether it went into the fit")
    before: float = described("mean squared one-step error over the variance expected, nominal model")
    after: float = described("the same with what was found")
    p_after: float | None = described("p-value over all recordings, after", default=None)
    p_before: float | None = described("p-value over all recordings, before", default=None)


@dataclass(frozen=True)
class LevelTrend:
    """Whether the disagreement goes with the level of the drive."""

    correlation: float = described("rank correlation of disagreement and level")
    p: float = described("its p-value")


@dataclass(frozen=True)
class BothTrends:
    """Trends before and after; null where there are too few recordings."""

    after: LevelTrend | None = described("with what was found")
    before: LevelTrend | None = described("of the nominal model")


@dataclass(frozen=True)
class ByRecording:
    """How much the models disagree with each of several recordings."""

    rows: tuple[RecordingMismatch, ...] = described("each recording")
    level_of: str = described("what `level` is of: drive or response")
    expected: float = described("what a right model has")
    trend: BothTrends = described("whether the disagreement goes with the level")
    says: str = described("in which recording the model disagrees most, in a sentence")


@dataclass(frozen=True)
class ForceDependence:
    """What a missing force depends on, by covariate such as position, velocity, phase or time."""

    summary: str = described("what it depends on, in words")
    explained_by: Mapping[str, float] = described("share of its variance that a curve over the covariate explains")
    standard_error: Mapping[str, float] = described("standard error of that share")
    log_likelihood_ratio: Mapping[str, float] = described(
        "log likelihood ratio of a curve over the covariate in the filter"
    )
    robust_log_likelihood_ratio: Mapping[str, float] = described("the same with few outliers bounded: this one decides")
    p_value: Mapping[str, float] = described("p-value of the covariate")
    p_value_of_share: Mapping[str, float] = described("p-value of the share against surrogates")
    significant: tuple[str, ...] = described("covariates beyond chance, the likeliest first")
    against: str = described("what the p-values are against, in words")
    bodies: int | None = described("number of bodies that a missing force acts on", default=None)
    over_time: DisagreementOverTime | None = described("when the models disagree most", default=None)
    by_recording: ByRecording | None = described("with which recording the models disagree most", default=None)
