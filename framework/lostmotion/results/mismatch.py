"""Differences of a model and a recording: the missing force, its dependence, and when it is largest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described


@dataclass(frozen=True)
class UnexplainedForce:
    """A missing force, described as a random force."""

    significant: bool = described("whether it exceeds the usual noise of the drive")
    rms: float = described("its rms, in `unit`")
    unit: str = described("unit of `rms`")
    share_of_drive: float = described("its rms as a share of the drive")


@dataclass(frozen=True)
class WorstWindow:
    """The section of a recording in which a model disagrees most."""

    window: int = described("its number, from 0")
    begin: float = described("its beginning", unit="s")
    end: float = described("its end", unit="s")
    ratio: float = described("mean squared one-step error over the expected variance")
    p: float = described("p-value over all windows; null where there are too few samples")
    beyond_chance: bool = described("whether this is significant")


@dataclass(frozen=True)
class Peaks:
    """The peak forces of the hits of a hammer."""

    values: tuple[float, ...] = described("force of each hit, in `unit`")
    unit: str = described("unit of `values`")


@dataclass(frozen=True)
class DisagreementOverTime:
    """The disagreement of the models with a recording in each of its sections."""

    edges: tuple[float, ...] = described("limits of the sections", unit="s")
    unit: str = described("unit of `edges`")
    windows: str = described("`even`, or `hits` where a section begins with each hit")
    before: tuple[float, ...] = described("mean squared one-step error over the expected variance, nominal model")
    after: tuple[float, ...] = described("the same with the found mechanisms")
    expected: float = described("the value of a correct model")
    worst: WorstWindow = described("the section with the most significant disagreement, after")
    worst_before: WorstWindow = described("the section with the most significant disagreement, before")
    says: str = described("where the model disagrees most, in a sentence; empty where this is not significant")
    peaks: Peaks | None = described("peaks of the hits, where a hammer excites the machine", default=None)


@dataclass(frozen=True)
class RecordingMismatch:
    """The disagreement of the models with one of several recordings."""

    name: str = described("name of the recording")
    level: float = described("rms of its drive, or of its response without a drive, in `unit`")
    unit: str = described("unit of `level`")
    fitted: bool = described("whether it was used in the fit")
    before: float = described("mean squared one-step error over the expected variance, nominal model")
    after: float = described("the same with the found mechanisms")
    p_after: float | None = described("p-value over all recordings, after", default=None)
    p_before: float | None = described("p-value over all recordings, before", default=None)


@dataclass(frozen=True)
class LevelTrend:
    """The dependence of the disagreement on the level of the drive."""

    correlation: float = described("rank correlation of disagreement and level")
    p: float = described("its p-value")


@dataclass(frozen=True)
class BothTrends:
    """Trends before and after; null where there are too few recordings."""

    after: LevelTrend | None = described("with the found mechanisms")
    before: LevelTrend | None = described("of the nominal model")


@dataclass(frozen=True)
class ByRecording:
    """The disagreement of the models with each of several recordings."""

    rows: tuple[RecordingMismatch, ...] = described("each recording")
    level_of: str = described("the quantity of `level`: drive or response")
    expected: float = described("the value of a correct model")
    trend: BothTrends = described("dependence of the disagreement on the level")
    says: str = described("in which recording the model disagrees most, in a sentence")


@dataclass(frozen=True)
class ForceDependence:
    """The dependence of a missing force on covariates such as position, velocity, phase or time."""

    summary: str = described("the dependence in words")
    explained_by: Mapping[str, float] = described("share of its variance that a curve over the covariate explains")
    standard_error: Mapping[str, float] = described("standard error of that share")
    log_likelihood_ratio: Mapping[str, float] = described(
        "log likelihood ratio of a curve over the covariate in the filter"
    )
    robust_log_likelihood_ratio: Mapping[str, float] = described("the same with bounded outliers; this one decides")
    p_value: Mapping[str, float] = described("p-value of the covariate")
    p_value_of_share: Mapping[str, float] = described("p-value of the share against surrogates")
    significant: tuple[str, ...] = described("significant covariates, the likeliest first")
    against: str = described("the null hypothesis of the p-values, in words")
    bodies: int | None = described("number of bodies on which a missing force acts", default=None)
    over_time: DisagreementOverTime | None = described("when the models disagree most", default=None)
    by_recording: ByRecording | None = described("with which recording the models disagree most", default=None)
