"""What a recording can tell, before terms are fitted: the content of `check.json`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion.results import Interval
from lostmotion.results.absent import UnlimitedTerm
from lostmotion.results.background import Origin

CHECK_SCHEMA = "lostmotion.check/1"


@dataclass(frozen=True)
class ParameterPair:
    """Two parameters that this recording hardly tells apart."""

    one: str = described("name of a parameter")
    other: str = described("name of another one")
    correlation: float = described("their expected correlation, from -1 to 1")


@dataclass(frozen=True, kw_only=True)
class Detection:
    """The smallest size at which a term would be named with a probability of 90 %."""

    mechanism: str = described("name of the term")
    at: str = described("place at which it would act")
    parameter: str = described("its amplitude; `amplitude` for a wave, whose cosine and sine are one amplitude")
    smallest: float = described("smallest amplitude that is named with a probability of 90 %")
    unit: str = described("unit of `smallest`")
    share_of_drive: float | None = described(
        "largest force at this size, as a share of the drive; null for a sensor, and where it is not known",
        default=None,
    )
    given: Mapping[str, float] = described(
        "values of its other parameters for which the size holds, in SI units", default={}, spare=True
    )
    confused_with: tuple[str, ...] = described(
        "terms that this recording cannot tell from it: one of them is named then", default=(), spare=True
    )
    says: str = described("the size, in words")


@dataclass(frozen=True, kw_only=True)
class Expectation:
    """What a recording can tell about a machine, from the information of its nominal model."""

    parameters: Mapping[str, Interval] = described(
        "nominal value and expected 95 % interval of each estimated parameter, by name"
    )
    pairs: tuple[ParameterPair, ...] = described("parameters that this recording hardly tells apart")
    effects: tuple[Detection, ...] = described("the smallest size of each term that would be named")
    unseen: tuple[UnlimitedTerm, ...] = described("terms that this recording would not name at any usual size")


@dataclass(frozen=True, kw_only=True)
class Improvement:
    """A change of the experiment, and what it is expected to improve."""

    change: str = described("the change, in words")
    waveform: str = described("harmonic, two tones, sweep or multisine; `repeat` for a further sensor")
    level: float = described("amplitude of the drive, in `unit`")
    unit: str = described("unit of `level`")
    band: tuple[float, ...] = described("lowest and highest frequency", unit="Hz")
    intervals: float = described("width of the expected intervals, as a multiple of the present one (geometric mean)")
    effects: float = described("smallest sizes of the terms, as a multiple of the present one (geometric mean)")


@dataclass(frozen=True, kw_only=True)
class WrongScale:
    """A column whose scale does not fit the model, and the factor with which it does."""

    column: str = described("the column")
    factor: float = described("the factor by which its values would have to be multiplied")
    says: str = described("what the factor is: a sign, a unit, the ratio of a gear")
    left: float = described("share of the missing force that is left with the factor")


@dataclass(frozen=True, kw_only=True)
class CaseCheck:
    """The check of a case before the fit: the content of `check.json`."""

    title: str = described("title of the case")
    schema: str = described("name and number of this format", default=CHECK_SCHEMA)
    says: tuple[str, ...] = described("the result in sentences")
    model: str = described("the nominal model")
    yardstick: str = described("the force to which shares refer: the drive, or the inertial force")
    angle: str = described("`deg` where the case uses degrees", default="rad", spare=True)
    expected: Expectation = described("what the recording can tell")
    improvements: tuple[Improvement, ...] = described("changes of the experiment that would help, the best first")
    scales: tuple[WrongScale, ...] = described(
        "columns whose scale does not fit the model, the most likely one first", default=(), spare=True
    )
    notes: tuple[str, ...] = described("limitations of the result, in sentences")
    provenance: Origin = described("versions, settings and digests of the inputs")
