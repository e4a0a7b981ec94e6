"""What an analysis finds for one recorded channel, stage by stage."""

from __future__ import annotations

from dataclasses import dataclass

from lostmotion.contracts import Array, Series
from lostmotion.results import Estimate
from lostmotion_chaos.analysis.denoise import Denoised
from lostmotion_chaos.analysis.motion import Verdict
from lostmotion_chaos.analysis.period import BasePeriod
from lostmotion_chaos.analysis.source import Source
from lostmotion_chaos.analysis.surrogates import SurrogateTest


@dataclass(frozen=True, eq=False)
class AnalysedChannel:
    """The results of all stages for one recorded channel."""

    source: Source
    base: BasePeriod
    raw: Series
    denoised: Denoised
    exponent: Estimate
    dimension: Estimate
    entropy: Estimate
    others: dict[str, Estimate]
    tests: tuple[SurrogateTest, ...]
    surrogate_dims: Array | None
    verdict: Verdict
    exponent_method: str
    denoiser: str
    aside: tuple[str, ...] = ()

    @property
    def clean(self) -> Series:
        """The analysed series: with reduced noise and its own embedding."""
        return self.denoised.series
