"""Where a result comes from: recordings, the fitted machine, versions, settings and digests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import told


@dataclass(frozen=True)
class RecordingFacts:
    """A recording of the case."""

    name: str = told("its name")
    samples: int = told("number of its samples")
    rate: float = told("samples in a second", unit="Hz")
    start: str | None = told("date and time of day of its first sample (ISO 8601); null where it is not known")
    inputs: tuple[str, ...] = told("its recorded inputs")


@dataclass(frozen=True)
class TermFacts:
    """A term of the fitted machine."""

    key: str = told("its key: name, with `@place` where the model has several")
    name: str = told("its name")
    at: str = told("the place at which it acts")


@dataclass(frozen=True)
class SensorChannel:
    """A sensor of the fitted machine."""

    name: str = told("its name")
    channel: str = told("the channel of the model that it measures")


@dataclass(frozen=True)
class FittedMachine:
    """The fitted model with what was found, as it is set in motion again."""

    model: str = told("name of the model; `equations` for one that is written as equations")
    equations: tuple[str, ...] = told("its equations of motion")
    units: Mapping[str, str] = told("units of its parameters, as the case gives them")
    motion: str = told("translation or rotation")
    terms: tuple[TermFacts, ...] = told("the terms that are added to it")
    learned: tuple[str, ...] = told("the keys of learned curves")
    sensors: tuple[SensorChannel, ...] = told("its sensors")
    values: Mapping[str, float] = told("all its parameters, in SI units")


@dataclass(frozen=True)
class Origin:
    """What made a result: the same inputs, settings, seed and versions give the same bytes."""

    component: str = told("the part of the program that made it")
    versions: Mapping[str, str] = told("versions of the packages that may change a number")
    settings: Mapping[str, object] = told("what was asked for, and the thresholds that decided")
    seed: int | None = told("seed of the random numbers")
    inputs: Mapping[str, str] = told("SHA-256 digest of each file that went in")
