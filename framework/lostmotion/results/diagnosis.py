"""What a diagnosis returns and `diagnosis.json` holds: frozen, in SI units, and nothing that computes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import Cells, told
from lostmotion.results import Interval
from lostmotion.results.background import FittedMachine, Origin, RecordingFacts
from lostmotion.results.behaviour import Behaviour, Decays
from lostmotion.results.mismatch import ForceDependence, UnexplainedForce
from lostmotion.results.sharing import Comparison, OwnParameters, Sharing

SCHEMA = "lostmotion.diagnosis/1"


@dataclass(frozen=True)
class LearnedCurve:
    """A force learned over one quantity or two, with its 95 % band; tables are (points,) or (points, points)."""

    over: str = told("the quantity it depends on: position, velocity, phase, time or history")
    at_place: str = told("the place of the model at which the force acts")
    unit: str = told("unit of `at`")
    force_unit: str = told("unit of `force`, `low` and `high`")
    times: str = told("what the curve is multiplied by; empty where it is a force as it is")
    at: tuple[float, ...] = told("points of the quantity")
    force: tuple[Cells, ...] = told("the force at the points; rows over `at`, columns over `at_too`")
    low: tuple[Cells, ...] = told("lower end of the 95 % band of the force")
    high: tuple[Cells, ...] = told("upper end of the 95 % band of the force")
    over_too: str | None = told("the second quantity of a surface", default=None)
    unit_too: str | None = told("unit of `at_too`", default=None)
    at_too: tuple[float, ...] | None = told("points of the second quantity", default=None)
    visited: tuple[tuple[bool, ...], ...] | None = told("where on the surface the motion was", default=None)
    forgets_in: float | None = told(
        "the time constant of the hidden state of a force with a memory", unit="s", default=None
    )


@dataclass(frozen=True, kw_only=True)
class ProposedFormula:
    """A formula that a sparse regression proposes for a learned curve: a proposal, not a finding."""

    formula: str | None = told("the formula; null where none is close")
    share_of_curve: float | None = told("the share of the curve that the formula explains", default=None)
    says: str = told("what the proposal is worth, in a sentence")


@dataclass(frozen=True)
class LookAlike:
    """A term of the library that a learned force looks like."""

    mechanism: str = told("name of the term")
    at: str = told("place at which it would act")


@dataclass(frozen=True, kw_only=True)
class Mechanism:
    """What the model leaves out: a term of the library, a mark of a sensor, or a force without a name.

    Bounds of `parameters` are NaN where their intervals are withheld.
    """

    mechanism: str = told("name of the mechanism; `unknown` or `random_force` where it has none")
    at: str = told(
        "the place of the model, drive or sensor at which it acts; empty for a force without a name",
        default="",
        spare=True,
    )
    probability: float = told("posterior probability among the library, nothing missing and unknown")
    state: str = told("`named`, `likely` or `open`")
    doubts: tuple[str, ...] = told("why it is no more than likely, in sentences", default=())
    log_odds: float | None = told("log odds of the learned curves over the best of the library", default=None)
    depends_on: tuple[str, ...] | None = told("what a force without a name depends on", default=None)
    parameters: Mapping[str, Interval] = told("its parameters by name")
    curve: LearnedCurve | None = told("the first of `curves`", default=None)
    curves: tuple[LearnedCurve, ...] = told("the learned curves", default=(), spare=True)
    proposal: ProposedFormula | None = told("a formula for the learned curves", default=None)
    looks_like: tuple[LookAlike, ...] = told("terms of the library that it looks like", default=(), spare=True)
    share_of_likeness: float | None = told("the share of its variance that these explain", default=None)
    share_of_drive: float | None = told("largest force, as a share of the drive", default=None)
    since: Interval | None = told("its onset, where it was not there from the beginning", default=None)
    says: str = told("the finding, in a sentence")
    by_recording: tuple[OwnParameters, ...] = told("its parameters in each recording by itself", default=(), spare=True)
    shared: Comparison | None = told("whether one value holds in all recordings", default=None)


@dataclass(frozen=True)
class OpenTerm:
    """A term that would raise the likelihood, with something that speaks against a name."""

    mechanism: str = told("name of the term")
    at: str = told("place at which it would act")
    probability: float = told("its posterior probability")
    says: str = told("why it stays open, in a sentence")


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A row of the ranking: a term, `nothing_missing` or `unknown`."""

    mechanism: str = told("name of the candidate")
    at: str = told("place at which it acts")
    log_evidence_gain: float = told("log evidence that it adds alone to the nominal model")
    probability: float = told("posterior probability; of a term that was found, that of `found`")
    price: float | None = told(
        "what its parameters and its place among the library cost, in log evidence", default=None
    )
    fitted: bool = told("whether it was fitted; else the gain is the bound of a score test")


@dataclass(frozen=True)
class DecidingExcitation:
    """The experiment that would tell two explanations apart."""

    waveform: str = told("harmonic, two tones, sweep or multisine")
    level: float = told("amplitude of the drive, in `unit`")
    frequency: float = told("upper end of the band", unit="Hz")
    band: tuple[float, ...] = told("lowest and highest frequency", unit="Hz")
    unit: str = told("unit of `level`")
    expected_log_gain: float = told("log-likelihood by which it should separate them")
    repeat_log_gain: float = told("the same for a repeat of the recording")
    if_found_is_true: float = told("the same if what was found is true")
    if_this_is_true: float = told("the same if this mechanism is true")


@dataclass(frozen=True, kw_only=True)
class Confusion:
    """A mechanism that the recording cannot tell from what was found."""

    mechanism: str = told("name of the mechanism")
    at: str | None = told("place at which it would act", default=None)
    probability: float | None = told("its posterior probability", default=None)
    excitation: DecidingExcitation | None = told("the experiment that would decide", default=None)
    says: str = told("why it cannot be told apart, and what would decide, in sentences")


@dataclass(frozen=True)
class ParameterSets:
    """The parameters of the model before, and of the model with what was found."""

    before: Mapping[str, Interval] = told("of the nominal model, by name")
    after: Mapping[str, Interval] = told("of the model with what was found, by name")


@dataclass(frozen=True)
class HeldOutScore:
    """What a model predicts of data that no fit has seen."""

    log_score: float = told("mean log density of one-step predictions, for each sample", key="heldout_log_score")
    nrmse: float = told(
        "error of free runs over `horizon`, over the standard deviation of the response, the mean over sensors",
        key="heldout_nrmse",
    )
    nrmse_by_sensor: Mapping[str, float] = told("the same for each sensor, by name", key="heldout_nrmse_by_sensor")
    horizon: float = told("length of the free runs, in `horizon_unit`")


@dataclass(frozen=True)
class HeldOutScores:
    """Predictions of held-out data, before and after."""

    before: HeldOutScore = told("of the nominal model")
    after: HeldOutScore = told("of the model with what was found")
    noise_floor_nrmse: float = told("the error that measurement noise alone gives")
    horizon_unit: str = told("Lyapunov times, drive periods or natural periods")
    horizon_unit_time: float = told("length of that unit", unit="s")


@dataclass(frozen=True)
class Labels:
    """The models in words."""

    before: str = told("the nominal model")
    after: str = told("the model with what was found")


@dataclass(frozen=True)
class DriveFacts:
    """What moves the machine."""

    amplitude: float = told("scale of the force to which shares refer, in `unit`")
    unit: str = told("its unit")
    of: str = told("what that scale is: the drive, or the inertial force")
    frequency: float | None = told("frequency of a periodic drive; null where it is not periodic", unit="Hz")
    free: bool = told("whether no input was recorded")


@dataclass(frozen=True)
class Units:
    """The units of the arrays."""

    position: str = told("unit of positions")
    velocity: str = told("unit of velocities")
    force: str = told("unit of forces")
    time: str = told("unit of times")
    angle: str = told("`deg` where the case gives degrees: pages show angles in it", default="rad", spare=True)


@dataclass(frozen=True)
class Response:
    """What the first sensor measures."""

    quantity: str = told("position, velocity, acceleration, force or angle")


@dataclass(frozen=True)
class SensorFacts:
    """A sensor and its noise, after."""

    name: str = told("its name")
    channel: str = told("the channel of the model that it measures")
    unit: str = told("its unit")
    noise_sd: float = told("standard deviation of all its measurement noise, in `unit`")
    kind: str = told("`white`, `ar1` (slow) or `quantised`")


@dataclass(frozen=True)
class Exponents:
    """Largest Lyapunov exponents of the models."""

    before: float = told("of the nominal model")
    after: float = told("of the model with what was found")
    unit: str = told("their unit")


@dataclass(frozen=True)
class Both:
    """A number before and after."""

    before: float = told("of the nominal model")
    after: float = told("of the model with what was found")


@dataclass(frozen=True)
class BothTrue:
    """A truth value before and after."""

    before: bool = told("of the nominal model")
    after: bool = told("of the model with what was found")


@dataclass(frozen=True)
class ValidTimes:
    """How long free runs over held-out data stay near the recording."""

    before: float = told("of the nominal model, in `unit`")
    after: float = told("of the model with what was found, in `unit`")
    unit: str = told("unit of both")
    or_longer: BothTrue = told("whether free runs were followed no longer than that")
    in_lyapunov_times: Both | None = told("the same in Lyapunov times", default=None)
    in_drive_periods: Both | None = told("the same in periods of the drive", default=None)
    in_natural_periods: Both | None = told("the same in natural periods", default=None)


@dataclass(frozen=True)
class Whiteness:
    """The Ljung-Box test of one-step errors."""

    p: float = told("its p-value")
    says: str = told("what that means, in a sentence")


@dataclass(frozen=True)
class BothWhite:
    """Whiteness before and after."""

    before: Whiteness = told("of the nominal model")
    after: Whiteness = told("of the model with what was found")


@dataclass(frozen=True)
class SampledEvidence:
    """The log evidence of a model by Laplace's method and by importance sampling."""

    laplace: float = told("by Laplace's method")
    sampled: float = told("by importance sampling; null where it cannot be told")
    error: float = told("standard error of `sampled`")
    effective: float = told("effective number of draws; below a few tens `sampled` is not to be trusted")


@dataclass(frozen=True)
class EvidenceCheck:
    """Whether the log evidence holds by another method; empty where nothing was found."""

    before: SampledEvidence | None = told("of the nominal model", default=None)
    after: SampledEvidence | None = told("of the model with what was found", default=None)
    says: str | None = told("whether the two methods agree, in a sentence", default=None)


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """What a diagnosis returns: everything in `diagnosis.json`."""

    title: str = told("title of the case")
    schema: str = told("name and number of this format", default=SCHEMA)
    verdict: str = told("`adequate`: nothing is missing that this recording can show; or `mismatch`")
    says: tuple[str, ...] = told("the answer, in sentences")
    found: tuple[Mechanism, ...] = told(
        "what the model leaves out, named ones first; empty where the verdict is `adequate`"
    )
    open: tuple[OpenTerm, ...] = told("terms that would raise the likelihood and stay without a name")
    ranking: tuple[Candidate, ...] = told("every candidate, the most probable first")
    confused_with: tuple[Confusion, ...] = told("what this recording cannot tell from what was found")
    unexplained: UnexplainedForce = told("the random force that is left")
    unexplained_before: UnexplainedForce = told("the random force that the nominal model leaves")
    where: ForceDependence = told("what the missing force depends on, before")
    where_after: ForceDependence = told("what the rest depends on, after")
    parameters: ParameterSets = told("the parameters of the model, before and after")
    fit: HeldOutScores = told("predictions of held-out data, before and after")
    model: Labels = told("the models in words")
    drive: DriveFacts = told("what moves the machine")
    units: Units = told("units of the arrays")
    response: Response = told("what the first sensor measures")
    sensors: tuple[SensorFacts, ...] = told("the sensors and their noise")
    lyapunov: Exponents = told("largest Lyapunov exponents")
    valid_prediction_time: ValidTimes = told("how long predictions hold")
    whiteness: BothWhite = told("whether one-step errors are white")
    sharing: Sharing | None = told("what several recordings share; absent of one recording", default=None)
    show: Behaviour = told("measures of the motion, before, after and of noise alone")
    decay: Decays | None = told("free decays, of recordings that nothing drives and of hammer tests", default=None)
    evidence: EvidenceCheck = told("the log evidence by another method")
    machine: FittedMachine = told("what it takes to set the fitted model in motion again")
    truth: Mapping[str, float] = told("what the case says is true, for tests on made data")
    recordings: tuple[RecordingFacts, ...] = told("the recordings of the case")
    notes: tuple[str, ...] = told("what makes the answer less certain, in sentences")
    provenance: Origin = told("where the result comes from")
