"""What a calibration returns: what became of each machine, and what all of them say together (`calibration.json`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import told

OK, UNCONVERGED, FAILED = "ok", "unconverged", "failed"


@dataclass(frozen=True)
class Standing:
    """Where a truth lies among the draws of its posterior."""

    unit: str = told("unit of the parameter")
    low: float = told("lower end of the central 95 % interval")
    median: float = told("median of the posterior")
    high: float = told("upper end of the central 95 % interval")
    sd: float = told("standard deviation of the posterior")
    z: float = told("truth less mean of the posterior, over its standard deviation")
    below: float = told("share of the draws below the truth")
    rank: int = told("rank of the truth among 99 thinned draws, 0 to 99")


@dataclass(frozen=True)
class Sought:
    """A parameter of a machine that is to be found again."""

    truth: float = told("its true value, in SI units")
    drawn: bool = told("whether it was drawn from a prior")
    standing: Standing | None = told("where the truth lies in the posterior, if there is one", flat=True, default=None)


@dataclass(frozen=True)
class MachineTrial:
    """What became of one machine."""

    machine: int = told("its number")
    status: str = told(f"{OK}, {UNCONVERGED} or {FAILED}")
    says: str = told("why it has no posterior; empty where it has one")
    parameters: Mapping[str, Sought] = told("what was to be found again, by name")
    ess: float | None = told("effective draws of the parameter that has the fewest", default=None)
    rhat: float | None = told("largest split R-hat of all parameters", default=None)


@dataclass(frozen=True)
class Coverage:
    """How many truths lie in their central intervals, and how many of a right posterior would."""

    inside: int = told("truths inside of their intervals")
    of: int = told("number of intervals")
    low: int = told("fewest that a right posterior leaves but for one time in a hundred")
    high: int = told("most that a right posterior leaves but for one time in a hundred")


@dataclass(frozen=True)
class ParameterCheck:
    """What all machines say of one parameter."""

    unit: str = told("unit of the parameter")
    drawn: bool = told("whether it was drawn from a prior; only then its ranks should be uniform")
    chi2_p: float = told("p-value of Pearson's test that the ranks are uniform; null where there are too few")
    ecdf_p: float = told("p-value of the test by simultaneous bands; null where it was not drawn")
    coverage: Mapping[str, Coverage] = told("by the central interval, in per cent")
    mean_z: float = told("mean of the standardised errors")
    rms_z: float = told("root mean square of the standardised errors; 1 where intervals have their width")
    median_relative_sd: float = told("median of the posterior's deviation over its median")
    histogram: tuple[int, ...] = told("ranks in each of equal bins")
    ecdf: tuple[float, ...] = told("ranks below 1, 2, ... 99")


@dataclass(frozen=True)
class LostMachine:
    """A machine without a posterior."""

    machine: int = told("its number")
    says: str = told("why it has none")


@dataclass(frozen=True)
class BarBand:
    """What uniform ranks leave in one bar of the histogram with a probability of 1 %."""

    bins: int = told("number of bars")
    expected: float = told("ranks expected in each bar")
    low: int = told("fewest ranks in a bar")
    high: int = told("most ranks in a bar")


@dataclass(frozen=True)
class CurveBand:
    """What uniform ranks leave anywhere in the empirical distribution function with a probability of 1 %."""

    at: tuple[float, ...] = told("places, as shares of the ranks")
    middle: tuple[float, ...] = told("ranks expected below each place")
    low: tuple[float, ...] = told("fewest ranks below each place")
    high: tuple[float, ...] = told("most ranks below each place")


@dataclass(frozen=True)
class RankBands:
    """The bands of uniform ranks; there are none without machines."""

    histogram: BarBand | None = told("of single bars", default=None)
    ecdf: CurveBand | None = told("of the whole distribution function", default=None)


@dataclass(frozen=True)
class HardMachine:
    """A machine whose truth lies far out in its posterior."""

    machine: int = told("its number")
    parameter: str = told("name of the parameter")
    z: float = told("truth less mean of the posterior, over its standard deviation")
    truth: float = told("the true value, in SI units")
    median: float = told("median of the posterior")
    sd: float = told("standard deviation of the posterior")
    unit: str = told("unit of the parameter")


@dataclass(frozen=True)
class CalibrationSummary:
    """What all machines say together."""

    machines: int = told("number of machines that were drawn")
    unconverged: tuple[LostMachine, ...] = told("machines whose chain has not converged")
    failed: tuple[LostMachine, ...] = told("machines that could not be identified")
    parameters: Mapping[str, ParameterCheck] = told("the checks, by parameter")
    bands: RankBands = told("what uniform ranks leave by chance")
    hardest: tuple[HardMachine, ...] = told("the machines whose truth lies farthest out")
    level: float = told("level of the tests, for all drawn parameters together")
    passes: bool = told("whether ranks are uniform, intervals cover, and hardly a machine was lost")
    few: bool = told("whether there are so few machines that only gross faults show")
    says: tuple[str, ...] = told("the answer, in sentences", default=())

    @property
    def lost(self) -> Mapping[str, tuple[LostMachine, ...]]:
        """The machines without a posterior, by status."""
        return {UNCONVERGED: self.unconverged, FAILED: self.failed}


@dataclass(frozen=True)
class CalibrationResult:
    """What `calibration.json` holds."""

    schema: str = told("`lostmotion.calibration/1`")
    title: str = told("title of the case")
    model: str = told("the model that was fitted, with its terms")
    route: str = told("trajectory or quantifiers")
    moved_by: str = told("what moved the machines, in words")
    hidden: Mapping[str, float] = told("parameters of what was hidden in every machine, in SI units")
    summary: CalibrationSummary = told("what all machines say together", flat=True)
    provenance: Mapping[str, object] = told("versions, settings, seed and digests that made it")
