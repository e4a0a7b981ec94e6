"""What a calibration returns: what became of each machine, and what all of them say together (`calibration.json`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described

OK, UNCONVERGED, FAILED = "ok", "unconverged", "failed"


@dataclass(frozen=True)
class Standing:
    """Where a truth lies among the draws of its posterior."""

    unit: str = described("unit of the parameter")
    low: float = described("lower end of the central 95 % interval")
    median: float = described("median of the posterior")
    high: float = described("upper end of the central 95 % interval")
    sd: float = described("standard deviation of the posterior")
    z: float = described("truth less mean of the posterior, over its standard deviation")
    below: float = described("share of the draws below the truth")
    rank: int = described("rank of the truth among 99 thinned draws, 0 to 99")


@dataclass(frozen=True)
class Sought:
    """A parameter of a machine that is to be found again."""

    truth: float = described("its true value, in SI units")
    drawn: bool = described("whether it was drawn from a prior")
    standing: Standing | None = described(
        "where the truth lies in the posterior, if there is one", flat=True, default=None
    )


@dataclass(frozen=True)
class MachineTrial:
    """What became of one machine."""

    machine: int = described("its number")
    status: str = described(f"{OK}, {UNCONVERGED} or {FAILED}")
    says: str = described("why it has no posterior; empty where it has one")
    parameters: Mapping[str, Sought] = described("what was to be found again, by name")
    ess: float | None = described("effective draws of the parameter that has the fewest", default=None)
    rhat: float | None = described("largest split R-hat of all parameters", default=None)


@dataclass(frozen=True)
class Coverage:
    """How many truths lie in their central intervals, and how many of a right posterior would."""

    inside: int = described("truths inside of their intervals")
    of: int = described("number of intervals")
    low: int = described("fewest that a right posterior leaves but for one time in a hundred")
    high: int = described("most that a right posterior leaves but for one time in a hundred")


@dataclass(frozen=True)
class ParameterCheck:
    """What all machines say of one parameter."""

    unit: str = described("unit of the parameter")
    drawn: bool = described("whether it was drawn from a prior; only then its ranks should be uniform")
    chi2_p: float = described("p-value of Pearson's test that the ranks are uniform; null where there are too few")
    ecdf_p: float = described("p-value of the test by simultaneous bands; null where it was not drawn")
    coverage: Mapping[str, Coverage] = described("by the central interval, in per cent")
    mean_z: float = described("mean of the standardised errors")
    rms_z: float = described("root mean square of the standardised errors; 1 where intervals have their width")
    median_relative_sd: float = described("median of the posterior's deviation over its median")
    histogram: tuple[int, ...] = described("ranks in each of equal bins")
    ecdf: tuple[float, ...] = described("ranks below 1, 2, ... 99")


@dataclass(frozen=True)
class LostMachine:
    """A machine without a posterior."""

    machine: int = described("its number")
    says: str = described("why it has none")


@dataclass(frozen=True)
class BarBand:
    """What uniform ranks leave in one bar of the histogram with a probability of 1 %."""

    bins: int = described("number of bars")
    expected: float = described("ranks expected in each bar")
    low: int = described("fewest ranks in a bar")
    high: int = described("most ranks in a bar")


@dataclass(frozen=True)
class CurveBand:
    """What uniform ranks leave anywhere in the empirical distribution function with a probability of 1 %."""

    at: tuple[float, ...] = described("places, as shares of the ranks")
    middle: tuple[float, ...] = described("ranks expected below each place")
    low: tuple[float, ...] = described("fewest ranks below each place")
    high: tuple[float, ...] = described("most ranks below each place")


@dataclass(frozen=True)
class RankBands:
    """The bands of uniform ranks; there are none without machines."""

    histogram: BarBand | None = described("of single bars", default=None)
    ecdf: CurveBand | None = described("of the whole distribution function", default=None)


@dataclass(frozen=True)
class HardMachine:
    """A machine whose truth lies far out in its posterior."""

    machine: int = described("its number")
    parameter: str = described("name of the parameter")
    z: float = described("truth less mean of the posterior, over its standard deviation")
    truth: float = described("the true value, in SI units")
    median: float = described("median of the posterior")
    sd: float = described("standard deviation of the posterior")
    unit: str = described("unit of the parameter")


@dataclass(frozen=True)
class CalibrationSummary:
    """What all machines say together."""

    machines: int = described("number of machines that were drawn")
    unconverged: tuple[LostMachine, ...] = described("machines whose chain has not converged")
    failed: tuple[LostMachine, ...] = described("machines that could not be identified")
    parameters: Mapping[str, ParameterCheck] = described("the checks, by parameter")
    bands: RankBands = described("what uniform ranks leave by chance")
    hardest: tuple[HardMachine, ...] = described("the machines whose truth lies farthest out")
    level: float = described("level of the tests, for all drawn parameters together")
    passes: bool = described("whether ranks are uniform, intervals cover, and hardly a machine was lost")
    few: bool = described("whether there are so few machines that only gross faults show")
    says: tuple[str, ...] = described("the answer, in sentences", default=())

    @property
    def lost(self) -> Mapping[str, tuple[LostMachine, ...]]:
        """The machines without a posterior, by status."""
        return {UNCONVERGED: self.unconverged, FAILED: self.failed}


@dataclass(frozen=True)
class CalibrationResult:
    """What `calibration.json` holds."""

    schema: str = described("`lostmotion.calibration/1`")
    title: str = described("title of the case")
    model: str = described("the model that was fitted, with its terms")
    route: str = described("trajectory or quantifiers")
    moved_by: str = described("what moved the machines, in words")
    hidden: Mapping[str, float] = described("parameters of what was hidden in every machine, in SI units")
    summary: CalibrationSummary = described("what all machines say together", flat=True)
    provenance: Mapping[str, object] = described("versions, settings, seed and digests that made it")
