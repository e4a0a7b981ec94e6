"""The origin of a result: recordings, the fitted machine, versions, settings and digests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described


@dataclass(frozen=True)
class RecordingFacts:
    """A recording of the case."""

    name: str = described("its name")
    samples: int = described("number of its samples")
    rate: float = described("samples per second", unit="Hz")
    start: str | None = described("date and time of its first sample (ISO 8601); null where it is not known")
    inputs: tuple[str, ...] = described("its recorded inputs")


@dataclass(frozen=True)
class TermFacts:
    """A term of the fitted machine."""

    key: str = described("its key: name, with `@place` where the model has several")
    name: str = described("its name")
    at: str = described("the place at which it acts")


@dataclass(frozen=True)
class SensorChannel:
    """A sensor of the fitted machine."""

    name: str = described("its name")
    channel: str = described("the channel of the model that it measures")


@dataclass(frozen=True)
class FittedMachine:
    """The fitted model with the found mechanisms, in a form from which it can be simulated again."""

    model: str = described("name of the model; `equations` for one that is written as equations")
    equations: tuple[str, ...] = described("its equations of motion")
    units: Mapping[str, str] = described("units of its parameters in the case")
    motion: str = described("translation or rotation")
    terms: tuple[TermFacts, ...] = described("the terms that are added to it")
    learned: tuple[str, ...] = described("the keys of learned curves")
    sensors: tuple[SensorChannel, ...] = described("its sensors")
    values: Mapping[str, float] = described("all its parameters, in SI units")


@dataclass(frozen=True)
class Origin:
    """The origin of a result: the same inputs, settings, seed and versions give the same bytes."""

    component: str = described("the part of the program that made it")
    versions: Mapping[str, str] = described("versions of the packages that may change a value")
    settings: Mapping[str, object] = described("the options, and the thresholds of the decisions")
    seed: int | None = described("seed of the random numbers")
    inputs: Mapping[str, str] = described("SHA-256 digest of each input file")
