"""What several recordings share, and what is each one's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import told
from lostmotion.results import Interval


@dataclass(frozen=True)
class OwnParameters:
    """The parameters of a term in one recording by itself."""

    recording: str = told("name of the recording")
    level: float = told("level of its drive")
    parameters: Mapping[str, Interval] = told("the parameters by name")


@dataclass(frozen=True)
class OwnValue:
    """One parameter in one recording by itself."""

    recording: str = told("name of the recording")
    level: float = told("level of its drive")
    median: float = told("median")
    low: float = told("lower end of the central 95 % interval")
    high: float = told("upper end of it")
    unit: str = told("unit of the three")


@dataclass(frozen=True)
class PowerOfLevel:
    """A parameter that goes with a power of the level."""

    exponent: float = told("the exponent")
    error: float = told("its standard error")
    p: float = told("p-value of that law")


@dataclass(frozen=True)
class Comparison:
    """Whether one value of a parameter holds in all recordings."""

    holds: bool = told("whether it does")
    p: float = told("p-value of one value for all")
    says: str = told("how values differ, in a sentence")


@dataclass(frozen=True)
class FullComparison:
    """Whether one value of a parameter holds in all recordings, and how it differs where it does not."""

    holds: bool = told("whether it does")
    p: float = told("p-value of one value for all")
    says: str = told("how values differ, in a sentence")
    power_of_level: PowerOfLevel | None = told("the power of the level with which it goes; null where it does not")
    differs_in: str | None = told("the one recording in which it differs; null where there is none")


@dataclass(frozen=True)
class SharedParameter:
    """A parameter in each recording, and whether one value holds."""

    by_recording: tuple[OwnValue, ...] = told("its value in each recording")
    shared: FullComparison = told("whether one value holds")


@dataclass(frozen=True, kw_only=True)
class Sharing:
    """What recordings share."""

    recordings: tuple[str, ...] | None = told("names of the recordings that were fitted", default=None)
    levels: tuple[float, ...] | None = told("levels of their drives", default=None)
    level_of: str | None = told("what the levels are of: drive or response", default=None)
    level_unit: str | None = told("unit of the levels", default=None)
    parameters: Mapping[str, SharedParameter] = told("each parameter that was compared, by key")
    says: tuple[str, ...] = told("what holds and what differs, in sentences")
