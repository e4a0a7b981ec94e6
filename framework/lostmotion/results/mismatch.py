"""Where a model and a recording differ: a missing force, what it depends on, and when it is largest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import told


@dataclass(frozen=True)
class UnexplainedForce:
    """A force that is missing, as a random one."""

    significant: bool = told("whether it is beyond the usual noise of the drive")
    rms: float = told("its rms, in `unit`")
    unit: str = told("unit of `rms`")
    share_of_drive: float = told("its rms as a share of the drive")


@dataclass(frozen=True)
class WorstWindow:
    """The stretch of a recording in which a model disagrees most."""

    window: int = told("its number, from 0")
    begin: float = told("its begin", unit="s")
    end: float = told("its end", unit="s")
    ratio: float = told("mean squared one-step error over the variance expected")
    p: float = told("p-value over all windows; null where there are too few samples")
    beyond_chance: bool = told("whether that is beyond chance")


@dataclass(frozen=True)
class Peaks:
    """The peaks of the hits of a hammer."""

    values: tuple[float, ...] = told("force of each hit, in `unit`")
    unit: str = told("unit of `values`")


@dataclass(frozen=True)
class DisagreementOverTime:
    """How much the models disagree with a recording in each stretch of it."""

    edges: tuple[float, ...] = told("limits of the stretches", unit="s")
    unit: str = told("unit of `edges`")
    windows: str = told("`even`, or `hits` where a stretch begins with each hit")
    before: tuple[float, ...] = told("mean squared one-step error over the variance expected, nominal model")
    after: tuple[float, ...] = told("the same with what was found")
    expected: float = told("what a right model has")
    worst: WorstWindow = told("the stretch that stands out most, after")
    worst_before: WorstWindow = told("the stretch that stands out most, before")
    says: str = told("where the model disagrees most, in a sentence; empty where that is not beyond chance")
    peaks: Peaks | None = told("peaks of the hits, where a hammer drives the machine", default=None)


@dataclass(frozen=True)
class RecordingMismatch:
    """How much the models disagree with one of several recordings."""

    name: str = told("name of the recording")
    level: float = told("rms of its drive, or of its response where nothing drives it, in `unit`")
    unit: str = told("unit of `level`")
    fitted: bool = told("whether it went into the fit")
    before: float = told("mean squared one-step error over the variance expected, nominal model")
    after: float = told("the same with what was found")
    p_after: float | None = told("p-value over all recordings, after", default=None)
    p_before: float | None = told("p-value over all recordings, before", default=None)


@dataclass(frozen=True)
class LevelTrend:
    """Whether the disagreement goes with the level of the drive."""

    correlation: float = told("rank correlation of disagreement and level")
    p: float = told("its p-value")


@dataclass(frozen=True)
class BothTrends:
    """Trends before and after; null where there are too few recordings."""

    after: LevelTrend | None = told("with what was found")
    before: LevelTrend | None = told("of the nominal model")


@dataclass(frozen=True)
class ByRecording:
    """How much the models disagree with each of several recordings."""

    rows: tuple[RecordingMismatch, ...] = told("each recording")
    level_of: str = told("what `level` is of: drive or response")
    expected: float = told("what a right model has")
    trend: BothTrends = told("whether the disagreement goes with the level")
    says: str = told("in which recording the model disagrees most, in a sentence")


@dataclass(frozen=True)
class ForceDependence:
    """What a missing force depends on, by covariate such as position, velocity, phase or time."""

    summary: str = told("what it depends on, in words")
    explained_by: Mapping[str, float] = told("share of its variance that a curve over the covariate explains")
    standard_error: Mapping[str, float] = told("standard error of that share")
    log_likelihood_ratio: Mapping[str, float] = told("log likelihood ratio of a curve over the covariate in the filter")
    robust_log_likelihood_ratio: Mapping[str, float] = told("the same with few outliers bounded: this one decides")
    p_value: Mapping[str, float] = told("p-value of the covariate")
    p_value_of_share: Mapping[str, float] = told("p-value of the share against surrogates")
    significant: tuple[str, ...] = told("covariates beyond chance, the likeliest first")
    against: str = told("what the p-values are against, in words")
    bodies: int | None = told("number of bodies that a missing force acts on", default=None)
    over_time: DisagreementOverTime | None = told("when the models disagree most", default=None)
    by_recording: ByRecording | None = told("with which recording the models disagree most", default=None)
