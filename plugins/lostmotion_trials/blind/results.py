"""What a blind trial returns: what became of each case, and what all of them say together (`proof.json`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.rates import Rate

NAN = float("nan")


@dataclass(frozen=True)
class DiagnosedCase:
    """Whether a case was diagnosed."""

    case: str = described("name of the case")
    status: str = described("ok or failed")
    says: str = described("the diagnosis in sentences, or why there is none")


@dataclass(frozen=True, kw_only=True)
class JudgedEffect(Effect):
    """What became of a hidden effect."""

    gain: float = described("log-likelihood that its true term gains; null where no term stands for it", default=NAN)
    status: str = described("ok, or why there is no gain")
    outcome: str = described("hit, confused, noticed, misnamed or missed")
    probability: float = described("probability that was stated of it; null where it was not named", default=NAN)
    sure: bool | None = described("in an imperfect world: whether a sure name names it", default=None)


@dataclass(frozen=True)
class JudgedParameter:
    """A parameter that was estimated where everything was named, against its truth."""

    name: str = described("name of the parameter, behind that of its mechanism")
    truth: float = described("true value, in SI units")
    low: float = described("lower end of the 95 % interval")
    median: float = described("median of the posterior")
    high: float = described("upper end of the 95 % interval")
    inside: bool = described("whether the interval holds the truth")
    relative_error: float = described(
        "error of the median over the truth; null of an angle, and where the truth is zero"
    )


@dataclass(frozen=True)
class HeldOutJudged:
    """Errors on held-out data in the same free runs, over the deviation of the response."""

    before: float = described("of the nominal model")
    after: float = described("of the model with what was found")
    true: float = described("of the true model")
    share: float = described("what was won over what the true model wins; null where there is little to win")
    ratio: float = described("error of the found model over that of the true one")


@dataclass(frozen=True)
class HeldAgainst:
    """What a diagnosis said, held against the truth."""

    effects: tuple[JudgedEffect, ...] = described("the hidden effects with their outcomes")
    named: tuple[str, ...] = described("what was named, with places", default=())
    false: tuple[str, ...] = described("what was named in error", default=())
    parameters: tuple[JudgedParameter, ...] = described("estimated parameters against their truths", default=())
    stated: tuple[tuple[float, float], ...] = described(
        "each probability that was stated of a mechanism, and 1 if that was at work, else 0", default=()
    )


@dataclass(frozen=True, kw_only=True)
class JudgedCase:
    """What became of a case; of an imperfect world where it has a `kind`."""

    case: str = described("name of the case")
    model: str = described("model of the machine")
    variant: str = described("kind of the measurement noise")
    margin: float = described("log-likelihood by which the true model is better than the found one; null if equal")
    kind: str | None = described("in an imperfect world: the kind of drive", default=None)
    bound_status: str | None = described("why the true model could not be fitted", default=None)
    verdict: str = described("verdict of the diagnosis; failed where there is none")
    answer: HeldAgainst = described("what was said, held against the truth", flat=True)
    sure: tuple[tuple[str, bool], ...] | None = described(
        "in an imperfect world: each sure name, and whether what it names is there", default=None
    )
    worse: float | None = described("in an imperfect world: rise of the held-out error by what was found", default=None)
    heldout: HeldOutJudged | None = described("held-out errors; null where one could not be measured")


@dataclass(frozen=True)
class Outcomes:
    """What became of some effects."""

    rate: Rate = described("those that were named", flat=True)
    outcomes: Mapping[str, int] = described("number of effects, by outcome")
    misnamed_alike: int = described("misnamed ones where what was named fits as well, to within 3 in log-likelihood")


@dataclass(frozen=True)
class SizeBin:
    """The effects of a size."""

    low: float = described("least gain in log-likelihood", key="from")
    high: float = described("gain that is too large; null where there is none", key="to")
    counts: Outcomes = described("what became of them", flat=True)


@dataclass(frozen=True)
class LikelihoodLimit:
    """The chance of the likelihood-ratio test to notice an effect, over its gain."""

    gain: tuple[float, ...] = described("gains in log-likelihood")
    informed: tuple[float, ...] = described("chance of a test that is told what to look for", key="told")
    one_of_many: tuple[float, ...] = described("chance of a test that looks for one of many candidates")
    candidates: int = described("number of candidates")
    false_alarms: float = described("false alarms that the test raises")


@dataclass(frozen=True)
class MechanismCounts:
    """What became of one mechanism."""

    mechanism: str = described("its name")
    median_gain: float = described("median gain of its true term in log-likelihood; null where it has none")
    bound_status: str = described("ok, or why there is no gain")
    counts: Outcomes = described("what became of it", flat=True)


@dataclass(frozen=True)
class ConfusionCount:
    """How often an answer was given to a truth."""

    truth: str = described("the hidden mechanism, or nothing")
    answer: str = described("what was named, or nothing")
    cases: int = described("how often")


@dataclass(frozen=True)
class ReliabilityBin:
    """How often a mechanism was at work of which a probability in a range was stated."""

    low: float = described("least probability", key="from")
    high: float = described("largest probability", key="to")
    stated: float = described("mean of the probabilities that were stated; null of none")
    rate: Rate = described("those at work", flat=True)


@dataclass(frozen=True)
class CoverageRow:
    """How many truths the 95 % intervals of a parameter hold."""

    name: str = described("name of the parameter; all for all of them")
    rate: Rate = described("truths inside", flat=True)
    median_relative_error: float = described("median of the errors over the truths; null of none")


@dataclass(frozen=True)
class HeldOutCounts:
    """How near the found models come to the true ones on held-out data."""

    cases: int = described("number of cases")
    median_share: float = described("median of what was won over what the true model wins; null of none")
    shares: int = described("cases in which there was something to win")
    median_ratio: float = described("median error of the found model over that of the true one; null of none")
    within: Rate = described("cases in which that ratio is at most 1.05")
    ratios: tuple[float, ...] = described("the ratios in order")


@dataclass(frozen=True)
class AlarmCount:
    """False alarms on machines that hide nothing."""

    noise: str = described("kind of the measurement noise; all for all of them")
    rate: Rate = described("cases with a false alarm", flat=True)


@dataclass(frozen=True)
class SureCount:
    """Names that were stated with more than 0.95 in an imperfect world."""

    kind: str = described("kind of drive; all for all of them")
    machines: int = described("number of machines")
    rate: Rate = described("names that are there", flat=True)
    named: Rate = described("machines whose hidden effect is among the sure names")
    worse: Rate = described("machines whose held-out error rose by what was found")


@dataclass(frozen=True)
class Miss:
    """A hidden effect that was not named."""

    case: str = described("name of the case")
    mechanism: str = described("the hidden mechanism")
    what: str = described("what it is, where no library has it")
    at: str = described("the place at which it acts")
    gain: float = described("gain of its true term in log-likelihood; null where it has none")
    status: str = described("ok, or why there is no gain")
    outcome: str = described("confused, noticed, misnamed or missed")
    named: tuple[str, ...] = described("what was named")
    margin: float = described("log-likelihood by which the true model is better than the found one; null if equal")
    folder: str = described("folder of the case")


@dataclass(frozen=True)
class FalseAlarm:
    """A case in which something was named that is not there."""

    case: str = described("name of the case")
    folder: str = described("folder of the case")
    truth: tuple[str, ...] = described("what was hidden")
    named: tuple[str, ...] = described("what was named in error")


@dataclass(frozen=True)
class LostCase:
    """A case without a diagnosis, or without a true model."""

    case: str = described("name of the case")
    says: str = described("why there is none")


@dataclass(frozen=True)
class Target:
    """What a diagnosis should reach, and what it reached."""

    what: str = described("what is counted, in words")
    at_least: float = described("least share that meets the target")
    at_most: float = described("largest share that meets the target")
    state: str = described("met, missed, open where it may be chance, or not tried")
    rate: Rate = described("what was reached", flat=True)


@dataclass(frozen=True)
class ProofSummary:
    """What all cases of a blind trial say together."""

    cases: int = described("number of cases")
    clean: int = described("cases that hide nothing and were diagnosed")
    effects: int = described("number of hidden effects")
    detection: tuple[SizeBin, ...] = described("what became of effects, by size")
    sizes: tuple[tuple[float, float], ...] = described("gain of each effect, and 1 if it was named, else 0")
    limit: LikelihoodLimit = described("what is possible at all")
    mechanisms: tuple[MechanismCounts, ...] = described("what became of each mechanism")
    confusion: tuple[ConfusionCount, ...] = described("what was taken for what")
    reliability: tuple[ReliabilityBin, ...] = described("whether stated probabilities are right")
    coverage: tuple[CoverageRow, ...] = described("whether intervals hold the truth: all together, then by parameter")
    heldout: HeldOutCounts = described("held-out errors against those of the true models")
    alarms: tuple[AlarmCount, ...] = described("false alarms: all together, then by the kind of noise")
    sure: tuple[SureCount, ...] = described("sure names in an imperfect world: all together, then by the kind of drive")
    misses: tuple[Miss, ...] = described("every effect that was not named")
    false_alarms: tuple[FalseAlarm, ...] = described("every case in which something was named in error")
    failed: tuple[LostCase, ...] = described("cases without a diagnosis")
    unmeasured: tuple[LostCase, ...] = described("cases whose true model could not be fitted")
    targets: tuple[Target, ...] = described("what should be reached, and what was", default=())
    says: tuple[str, ...] = described("the answer, in sentences", default=())


@dataclass(frozen=True)
class Proof:
    """What `proof.json` holds."""

    schema: str = described("`lostmotion.proof/1`")
    title: str = described("title of the trial")
    summary: ProofSummary = described("what all cases say together", flat=True)
    provenance: Mapping[str, object] = described("versions, settings, seed and digests that made it")
