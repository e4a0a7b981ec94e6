"""What `lostmotion identify` finds, as `identification.json` has it; the draws behind it are in `posterior.nc`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from lostmotion.codec import described
from lostmotion.results import Interval
from lostmotion.results.background import Origin

RouteName = Literal["trajectory", "quantifiers"]


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A parameter of the posterior; its interval and deviation are NaN where the chain has not converged."""

    median: float = described("median of the posterior; null where the chain has not converged")
    low: float = described("lower end of the central 95 % interval; null where the chain has not converged")
    high: float = described("upper end of the central 95 % interval; null where the chain has not converged")
    unit: str = described("SI unit of the parameter, `1` for a pure number")
    sd: float = described("standard deviation of the posterior; null where the chain has not converged")
    at_maximum: float = described("value at the highest maximum of the posterior")
    ess: float = described("effective sample size of the bulk of the posterior")
    rhat: float = described("split R-hat over groups of walkers: 1 where all groups agree")
    tau: float = described("integrated autocorrelation time of the chain", unit="steps")

    @property
    def interval(self) -> Interval:
        """The median and the central 95 % interval."""
        return Interval(self.median, self.low, self.high, self.unit)


@dataclass(frozen=True, kw_only=True)
class Sampling:
    """How the posterior was sampled."""

    walkers: int = described("walkers of the ensemble")
    steps: int = described("steps of each walker that count")
    burn_in: int = described("steps of each walker that were left out before them")
    acceptance: float = described("share of the proposals that were accepted")
    autocorrelation_time: float = described("longest autocorrelation time of any parameter", unit="steps")
    lacks: tuple[str, ...] = described("what keeps the chain from being believed; empty where it has converged")


@dataclass(frozen=True, kw_only=True)
class MeasuredRange:
    """A number that was measured at a level, with its 95 % interval."""

    value: float = described("the measured number")
    low: float = described("lower end of its 95 % interval")
    high: float = described("upper end of its 95 % interval")
    unit: str = described("unit: `1/s` of an exponent (natural logarithm), `1` of a dimension")


@dataclass(frozen=True)
class ExpectedRange:
    """Central 95 % of a predicted number and its median; in 1/s for an exponent."""

    low: float = described("lower end of the central 95 %")
    median: float = described("median")
    high: float = described("upper end of the central 95 %")


@dataclass(frozen=True, kw_only=True)
class ExpectedMotion:
    """What the posterior expects of the motion at a level; of a chaotic motion also its exponent and dimension."""

    chaotic_share: float = described("probability of a chaotic motion")
    lyapunov: ExpectedRange | None = described("largest exponent of a chaotic motion", unit="1/s", default=None)
    d2: ExpectedRange | None = described("correlation dimension of a chaotic motion", default=None)


@dataclass(frozen=True, kw_only=True)
class DriveLevel:
    """One level of the drive: what was measured there, and what the posterior expects."""

    name: str = described("name of the level or of its recording")
    amplitude: float = described("amplitude of the drive, in `unit`")
    unit: str = described("SI unit of the amplitude")
    omega: float = described("angular frequency of the drive", unit="rad/s")
    motion: Literal["periodic", "chaotic"] | None = described("motion that was seen; null where it could not be told")
    lyapunov: MeasuredRange | None = described("largest exponent, where it was measured", default=None)
    d2: MeasuredRange | None = described("correlation dimension, where it was measured", default=None)
    predicted: ExpectedMotion = described("what the posterior expects at this level")


@dataclass(frozen=True, kw_only=True)
class Identification:
    """The content of `identification.json`: the parameters of a case with their intervals, and how they were found."""

    schema: str = described("name and version of the format", default="lostmotion.identification/1")
    route: RouteName = described(
        "`trajectory`: by the recordings themselves; `quantifiers`: by chaos measures at levels of the drive"
    )
    converged: bool = described("whether the chain may be believed; where not, no interval is given")
    says: tuple[str, ...] = described("sentences on the chain, with which the report opens")
    ess_min: float = described("least effective sample size of the bulk of any parameter")
    ess_tail_min: float = described("least effective sample size of the tails of any parameter")
    rhat_max: float = described("largest split R-hat of any parameter")
    parameters: Mapping[str, Parameter] = described("parameters of the machine")
    noise: Mapping[str, Parameter] = described("noise levels and offsets of sensors", default={})
    sampling: Sampling = described("how the posterior was sampled")
    log_likelihood_evaluations: int = described("runs of the likelihood, those before the chain began too")
    title: str = described("title of the case")
    model: str = described("the model, with the terms that were added to it")
    truth: Mapping[str, float] = described("known values, where the case gives any; no fit uses them", default={})
    notes: tuple[str, ...] = described("what makes the intervals less certain, and what was noticed of the recordings")
    provenance: Origin = described("where the result comes from")
    modes: int | None = described("separate maxima of the posterior (by trajectory)", default=None)
    levels: tuple[DriveLevel, ...] | None = described("the levels of the drive (by quantifiers)", default=None)
    derived: Mapping[str, Interval] | None = described(
        "dimensionless numbers that follow from the parameters (by quantifiers); empty without convergence",
        default=None,
    )

    @property
    def rows(self) -> Mapping[str, Parameter]:
        """All parameters, noise levels last."""
        return {**self.parameters, **self.noise}
