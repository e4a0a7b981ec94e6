"""What several recordings share, and what is each one's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion.results import Interval


@dataclass(frozen=True)
class OwnParameters:
    """The parameters of a term in one recording by itself."""

    recording: str = described("name of the recording")
    level: float = described("level of its drive")
    parameters: Mapping[str, Interval] = described("the parameters by name")


@dataclass(frozen=True)
class OwnValue:
    """One parameter in one recording by itself."""

    recording: str = described("name of the recording")
    level: float = described("level of its drive")
    median: float = described("median")
    low: float = described("lower end of the central 95 % interval")
    high: float = described("upper end of it")
    unit: str = described("unit of the three")


@dataclass(frozen=True)
class PowerOfLevel:
    """A parameter that goes with a power of the level."""

    exponent: float = described("the exponent")
    error: float = described("its standard error")
    p: float = described("p-value of that law")


@dataclass(frozen=True)
class Comparison:
    """Whether one value of a parameter holds in all recordings."""

    holds: bool = described("whether it does")
    p: float = described("p-value of one value for all")
    says: str = described("how values differ, in a sentence")


@dataclass(frozen=True)
class FullComparison:
    """Whether one value of a parameter holds in all recordings, and how it differs where it does not."""

    holds: bool = described("whether it does")
    p: float = described("p-value of one value for all")
    says: str = described("how values differ, in a sentence")
    power_of_level: PowerOfLevel | None = described("the power of the level with which it goes; null where it does not")
    differs_in: str | None = described("the one recording in which it differs; null where there is none")


@dataclass(frozen=True)
class SharedParameter:
    """A parameter in each recording, and whether one value holds."""

    by_recording: tuple[OwnValue, ...] = described("its value in each recording")
    shared: FullComparison = described("whether one value holds")


@dataclass(frozen=True, kw_only=True)
class Sharing:
    """What recordings share."""

    recordings: tuple[str, ...] | None = described("names of the recordings that were fitted", default=None)
    levels: tuple[float, ...] | None = described("levels of their drives", default=None)
    level_of: str | None = described("what the levels are of: drive or response", default=None)
    level_unit: str | None = described("unit of the levels", default=None)
    parameters: Mapping[str, SharedParameter] = described("each parameter that was compared, by key")
    says: tuple[str, ...] = described("what holds and what differs, in sentences")
