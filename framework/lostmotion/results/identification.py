"""The result of `lostmotion identify` in the form of `identification.json`; the draws are in `posterior.nc`."""

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
    steps: int = described("steps of each walker after the burn-in")
    burn_in: int = described("steps of each walker in the burn-in")
    acceptance: float = described("share of accepted proposals")
    autocorrelation_time: float = described("longest autocorrelation time of any parameter", unit="steps")
    lacks: tuple[str, ...] = described("convergence criteria that are not met; empty where the chain has converged")


@dataclass(frozen=True, kw_only=True)
class MeasuredRange:
    """A measured value at a level, with its 95 % interval."""

    value: float = described("the measured value")
    low: float = described("lower end of its 95 % interval")
    high: float = described("upper end of its 95 % interval")
    unit: str = described("unit: `1/s` of an exponent (natural logarithm), `1` of a dimension")


@dataclass(frozen=True)
class ExpectedRange:
    """Median and central 95 % range of a predicted value; in 1/s for an exponent."""

    low: float = described("lower end of the central 95 %")
    median: float = described("median")
    high: float = described("upper end of the central 95 %")


@dataclass(frozen=True, kw_only=True)
class ExpectedMotion:
    """Prediction of the posterior for the motion at a level, with exponent and dimension of a chaotic motion."""

    chaotic_share: float = described("probability of a chaotic motion")
    lyapunov: ExpectedRange | None = described("largest exponent of a chaotic motion", unit="1/s", default=None)
    d2: ExpectedRange | None = described("correlation dimension of a chaotic motion", default=None)


@dataclass(frozen=True, kw_only=True)
class DriveLevel:
    """One level of the drive: measured values, and predictions of the posterior."""

    name: str = described("name of the level or of its recording")
    amplitude: float = described("amplitude of the drive, in `unit`")
    unit: str = described("SI unit of the amplitude")
    omega: float = described("angular frequency of the drive", unit="rad/s")
    motion: Literal["periodic", "chaotic"] | None = described("observed motion; null where it could not be determined")
    lyapunov: MeasuredRange | None = described("largest exponent, where it was measured", default=None)
    d2: MeasuredRange | None = described("correlation dimension, where it was measured", default=None)
    predicted: ExpectedMotion = described("predictions of the posterior at this level")


@dataclass(frozen=True, kw_only=True)
class Identification:
    """The content of `identification.json`: the parameters of a case with intervals, and how they were estimated."""

    schema: str = described("name and version of the format", default="lostmotion.identification/1")
    route: RouteName = described(
        "`trajectory`: from the recordings themselves; `quantifiers`: from chaos measures at levels of the drive"
    )
    converged: bool = described("whether the chain has converged; if not, there are no intervals")
    says: tuple[str, ...] = described("sentences on the chain, at the top of the report")
    ess_min: float = described("smallest effective sample size of the bulk of any parameter")
    ess_tail_min: float = described("smallest effective sample size of the tails of any parameter")
    rhat_max: float = described("largest split R-hat of any parameter")
    parameters: Mapping[str, Parameter] = described("parameters of the machine")
    noise: Mapping[str, Parameter] = described("noise levels and offsets of sensors", default={})
    sampling: Sampling = described("how the posterior was sampled")
    log_likelihood_evaluations: int = described("evaluations of the likelihood, including those before the chain began")
    title: str = described("title of the case")
    model: str = described("the model with the added terms")
    truth: Mapping[str, float] = described("true values, where the case has any; no fit uses them", default={})
    notes: tuple[str, ...] = described("limitations of the intervals, and remarks on the recordings")
    provenance: Origin = described("versions, settings, seed and digests of the inputs")
    modes: int | None = described("separate maxima of the posterior (route trajectory)", default=None)
    levels: tuple[DriveLevel, ...] | None = described("the levels of the drive (route quantifiers)", default=None)
    derived: Mapping[str, Interval] | None = described(
        "dimensionless numbers derived from the parameters (route quantifiers); empty without convergence",
        default=None,
    )

    @property
    def rows(self) -> Mapping[str, Parameter]:
        """All parameters, noise levels last."""
        return {**self.parameters, **self.noise}
