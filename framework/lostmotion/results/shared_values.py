"""Comparison of the parameters of several recordings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion.results import Interval


@dataclass(frozen=True)
class OwnParameters:
    """The parameters of a term, estimated from one recording alone."""

    recording: str = described("name of the recording")
    level: float = described("level of its drive")
    parameters: Mapping[str, Interval] = described("the parameters by name")


@dataclass(frozen=True)
class OwnValue:
    """One parameter, estimated from one recording alone."""

    recording: str = described("name of the recording")
    level: float = described("level of its drive")
    median: float = described("median")
    low: float = described("lower end of the central 95 % interval")
    high: float = described("upper end of the interval")
    unit: str = described("unit of these three values")


@dataclass(frozen=True)
class PowerOfLevel:
    """A parameter that changes with a power of the level."""

    exponent: float = described("the exponent")
    error: float = described("its standard error")
    p: float = described("p-value of this power law")


@dataclass(frozen=True)
class Comparison:
    """Whether one value of a parameter is valid for all recordings."""

    holds: bool = described("whether it is")
    p: float = described("p-value of one value for all recordings")
    says: str = described("how the values differ, in a sentence")


@dataclass(frozen=True)
class FullComparison:
    """Whether one value of a parameter is valid for all recordings, and how it differs if not."""

    holds: bool = described("whether it is")
    p: float = described("p-value of one value for all recordings")
    says: str = described("how the values differ, in a sentence")
    power_of_level: PowerOfLevel | None = described("power law of the level that the values follow; null if none")
    differs_in: str | None = described("the only recording with a different value; null if none")


@dataclass(frozen=True)
class SharedParameter:
    """A parameter in each recording, and whether one value is valid for all."""

    by_recording: tuple[OwnValue, ...] = described("its value in each recording")
    shared: FullComparison = described("whether one value is valid for all")


@dataclass(frozen=True, kw_only=True)
class Sharing:
    """Comparison of the parameters of several recordings."""

    recordings: tuple[str, ...] | None = described("names of the fitted recordings", default=None)
    levels: tuple[float, ...] | None = described("levels of their drives", default=None)
    level_of: str | None = described("the quantity of the levels: drive or response", default=None)
    level_unit: str | None = described("unit of the levels", default=None)
    parameters: Mapping[str, SharedParameter] = described("each compared parameter, by key")
    says: tuple[str, ...] = described("which parameters are equal and which differ, in sentences")
