"""What is not missing: upper bounds of the terms that a machine does not need."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described


@dataclass(frozen=True, kw_only=True)
class AbsentTerm:
    """The upper bound of the size of a term that is not in the model."""

    mechanism: str = described("name of the term")
    at: str = described("place at which it would act")
    parameter: str = described("its amplitude; `amplitude` for a wave, whose cosine and sine are one amplitude")
    upper: float = described(
        "95 % upper bound of the amplitude, of its absolute value if it has a sign, given all that is in the model and"
        " the usual errors of a model"
    )
    unit: str = described("unit of `upper`")
    share_of_drive: float | None = described(
        "largest force at this size, as a share of the drive; null for a sensor, and where it is not known",
        default=None,
    )
    given: Mapping[str, float] = described(
        "values of its other parameters for which the bound holds, in SI units", default={}, spare=True
    )
    says: str = described("the bound, in words")


@dataclass(frozen=True)
class UnlimitedTerm:
    """A term whose size this recording does not limit."""

    mechanism: str = described("name of the term")
    at: str = described("place at which it would act")
    says: str = described("why there is no bound, in a sentence")
