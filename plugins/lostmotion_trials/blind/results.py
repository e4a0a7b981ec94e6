"""What a blind trial returns: what became of each case, and what all of them say together (`proof.json`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import told
from lostmotion_trials.blind.pilot import Effect

NAN = float("nan")


@dataclass(frozen=True)
class DiagnosedCase:
    """Whether a case was diagnosed."""

    case: str = told("name of the case")
    status: str = told("ok or failed")
    says: str = told("the diagnosis in sentences, or why there is none")


@dataclass(frozen=True, kw_only=True)
class JudgedEffect(Effect):
    """What became of a hidden effect."""

    gain: float = told("log-likelihood that its true term gains; null where no term stands for it", default=NAN)
    status: str = told("ok, or why there is no gain")
    outcome: str = told("hit, confused, noticed, misnamed or missed")
    probability: float = told("probability that was stated of it; null where it was not named", default=NAN)
    sure: bool | None = told("in an imperfect world: whether a sure name names it", default=None)


@dataclass(frozen=True)
class JudgedParameter:
    """A parameter that was estimated where everything was named, against its truth."""

    name: str = told("name of the parameter, behind that of its mechanism")
    truth: float = told("true value, in SI units")
    low: float = told("lower end of the 95 % interval")
    median: float = told("median of the posterior")
    high: float = told("upper end of the 95 % interval")
    inside: bool = told("whether the interval holds the truth")
    relative_error: float = told("error of the median over the truth; null of an angle, and where the truth is zero")


@dataclass(frozen=True)
class HeldOutJudged:
    """Errors on held-out data in the same free runs, over the deviation of the response."""

    before: float = told("of the nominal model")
    after: float = told("of the model with what was found")
    true: float = told("of the true model")
    share: float = told("what was won over what the true model wins; null where there is little to win")
    ratio: float = told("error of the found model over that of the true one")


@dataclass(frozen=True)
class HeldAgainst:
    """What a diagnosis said, held against the truth."""

    effects: tuple[JudgedEffect, ...] = told("the hidden effects with their outcomes")
    named: tuple[str, ...] = told("what was named, with places", default=())
    false: tuple[str, ...] = told("what was named in error", default=())
    parameters: tuple[JudgedParameter, ...] = told("estimated parameters against their truths", default=())
    stated: tuple[tuple[float, float], ...] = told(
        "each probability that was stated of a mechanism, and 1 if that was at work, else 0", default=()
    )


@dataclass(frozen=True, kw_only=True)
class JudgedCase:
    """What became of a case; of an imperfect world where it has a `kind`."""

    case: str = told("name of the case")
    model: str = told("model of the machine")
    variant: str = told("kind of the measurement noise")
    margin: float = told("log-likelihood by which the true model is better than the found one; null if equal")
    kind: str | None = told("in an imperfect world: the kind of drive", default=None)
    oracle: str | None = told("why the true model could not be fitted", default=None)
    verdict: str = told("verdict of the diagnosis; failed where there is none")
    answer: HeldAgainst = told("what was said, held against the truth", flat=True)
    sure: tuple[tuple[str, bool], ...] | None = told(
        "in an imperfect world: each sure name, and whether what it names is there", default=None
    )
    worse: float | None = told("in an imperfect world: rise of the held-out error by what was found", default=None)
    heldout: HeldOutJudged | None = told("held-out errors; null where one could not be measured")


@dataclass(frozen=True)
class Rate:
    """A share with its exact 95 % band (Clopper, Pearson 1934)."""

    hits: int = told("how many there are")
    of: int = told("of how many")
    share: float = told("the share; null of nothing")
    low: float = told("lower end of the 95 % band")
    high: float = told("upper end of the 95 % band")


@dataclass(frozen=True)
class Outcomes:
    """What became of some effects."""

    rate: Rate = told("those that were named", flat=True)
    outcomes: Mapping[str, int] = told("number of effects, by outcome")
    misnamed_alike: int = told("misnamed ones where what was named fits as well, to within 3 in log-likelihood")


@dataclass(frozen=True)
class SizeBin:
    """The effects of a size."""

    low: float = told("least gain in log-likelihood", key="from")
    high: float = told("gain that is too large; null where there is none", key="to")
    counts: Outcomes = told("what became of them", flat=True)


@dataclass(frozen=True)
class LikelihoodLimit:
    """The chance of the likelihood-ratio test to notice an effect, over its gain."""

    gain: tuple[float, ...] = told("gains in log-likelihood")
    informed: tuple[float, ...] = told("chance of a test that is told what to look for", key="told")
    one_of_many: tuple[float, ...] = told("chance of a test that looks for one of many candidates")
    candidates: int = told("number of candidates")
    false_alarms: float = told("false alarms that the test raises")


@dataclass(frozen=True)
class MechanismCounts:
    """What became of one mechanism."""

    mechanism: str = told("its name")
    median_gain: float = told("median gain of its true term in log-likelihood; null where it has none")
    oracle: str = told("ok, or why there is no gain")
    counts: Outcomes = told("what became of it", flat=True)


@dataclass(frozen=True)
class ConfusionCount:
    """How often an answer was given to a truth."""

    truth: str = told("the hidden mechanism, or nothing")
    answer: str = told("what was named, or nothing")
    cases: int = told("how often")


@dataclass(frozen=True)
class ReliabilityBin:
    """How often a mechanism was at work of which a probability in a range was stated."""

    low: float = told("least probability", key="from")
    high: float = told("largest probability", key="to")
    stated: float = told("mean of the probabilities that were stated; null of none")
    rate: Rate = told("those at work", flat=True)


@dataclass(frozen=True)
class CoverageRow:
    """How many truths the 95 % intervals of a parameter hold."""

    name: str = told("name of the parameter; all for all of them")
    rate: Rate = told("truths inside", flat=True)
    median_relative_error: float = told("median of the errors over the truths; null of none")


@dataclass(frozen=True)
class HeldOutCounts:
    """How near the found models come to the true ones on held-out data."""

    cases: int = told("number of cases")
    median_share: float = told("median of what was won over what the true model wins; null of none")
    shares: int = told("cases in which there was something to win")
    median_ratio: float = told("median error of the found model over that of the true one; null of none")
    within: Rate = told("cases in which that ratio is at most 1.05")
    ratios: tuple[float, ...] = told("the ratios in order")


@dataclass(frozen=True)
class AlarmCount:
    """False alarms on machines that hide nothing."""

    noise: str = told("kind of the measurement noise; all for all of them")
    rate: Rate = told("cases with a false alarm", flat=True)


@dataclass(frozen=True)
class SureCount:
    """Names that were stated with more than 0.95 in an imperfect world."""

    kind: str = told("kind of drive; all for all of them")
    machines: int = told("number of machines")
    rate: Rate = told("names that are there", flat=True)
    named: Rate = told("machines whose hidden effect is among the sure names")
    worse: Rate = told("machines whose held-out error rose by what was found")


@dataclass(frozen=True)
class Miss:
    """A hidden effect that was not named."""

    case: str = told("name of the case")
    mechanism: str = told("the hidden mechanism")
    what: str = told("what it is, where no library has it")
    at: str = told("the place at which it acts")
    gain: float = told("gain of its true term in log-likelihood; null where it has none")
    status: str = told("ok, or why there is no gain")
    outcome: str = told("confused, noticed, misnamed or missed")
    named: tuple[str, ...] = told("what was named")
    margin: float = told("log-likelihood by which the true model is better than the found one; null if equal")
    folder: str = told("folder of the case")


@dataclass(frozen=True)
class FalseAlarm:
    """A case in which something was named that is not there."""

    case: str = told("name of the case")
    folder: str = told("folder of the case")
    truth: tuple[str, ...] = told("what was hidden")
    named: tuple[str, ...] = told("what was named in error")


@dataclass(frozen=True)
class LostCase:
    """A case without a diagnosis, or without a true model."""

    case: str = told("name of the case")
    says: str = told("why there is none")


@dataclass(frozen=True)
class Target:
    """What a diagnosis should reach, and what it reached."""

    what: str = told("what is counted, in words")
    at_least: float = told("least share that is wanted")
    at_most: float = told("largest share that is wanted")
    state: str = told("met, missed, open where it may be chance, or not tried")
    rate: Rate = told("what was reached", flat=True)


@dataclass(frozen=True)
class ProofSummary:
    """What all cases of a blind trial say together."""

    cases: int = told("number of cases")
    clean: int = told("cases that hide nothing and were diagnosed")
    effects: int = told("number of hidden effects")
    detection: tuple[SizeBin, ...] = told("what became of effects, by size")
    sizes: tuple[tuple[float, float], ...] = told("gain of each effect, and 1 if it was named, else 0")
    limit: LikelihoodLimit = told("what is possible at all")
    mechanisms: tuple[MechanismCounts, ...] = told("what became of each mechanism")
    confusion: tuple[ConfusionCount, ...] = told("what was taken for what")
    reliability: tuple[ReliabilityBin, ...] = told("whether stated probabilities are right")
    coverage: tuple[CoverageRow, ...] = told("whether intervals hold the truth: all together, then by parameter")
    heldout: HeldOutCounts = told("held-out errors against those of the true models")
    alarms: tuple[AlarmCount, ...] = told("false alarms: all together, then by the kind of noise")
    sure: tuple[SureCount, ...] = told("sure names in an imperfect world: all together, then by the kind of drive")
    misses: tuple[Miss, ...] = told("every effect that was not named")
    false_alarms: tuple[FalseAlarm, ...] = told("every case in which something was named in error")
    failed: tuple[LostCase, ...] = told("cases without a diagnosis")
    unmeasured: tuple[LostCase, ...] = told("cases whose true model could not be fitted")
    targets: tuple[Target, ...] = told("what should be reached, and what was", default=())
    says: tuple[str, ...] = told("the answer, in sentences", default=())


@dataclass(frozen=True)
class Proof:
    """What `proof.json` holds."""

    schema: str = told("`lostmotion.proof/1`")
    title: str = told("title of the trial")
    summary: ProofSummary = told("what all cases say together", flat=True)
    provenance: Mapping[str, object] = told("versions, settings, seed and digests that made it")
