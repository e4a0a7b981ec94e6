"""The result of a diagnosis and the content of `diagnosis.json`: frozen dataclasses in SI units, no computations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import Cells, described
from lostmotion.results import Interval
from lostmotion.results.absent import AbsentTerm, UnlimitedTerm
from lostmotion.results.background import FittedMachine, Origin, RecordingFacts
from lostmotion.results.behaviour import Behaviour, Decays
from lostmotion.results.expectation import Expectation, WrongScale
from lostmotion.results.mismatch import ForceDependence, UnexplainedForce
from lostmotion.results.shared_values import Comparison, OwnParameters, Sharing

SCHEMA = "lostmotion.diagnosis/1"


@dataclass(frozen=True)
class LearnedCurve:
    """A force learned over one quantity or two, with its 95 % band; tables are (points,) or (points, points)."""

    over: str = described("the quantity it depends on: position, velocity, phase, time or history")
    at_place: str = described("the place of the model at which the force acts")
    unit: str = described("unit of `at`")
    force_unit: str = described("unit of `force`, `low` and `high`")
    times: str = described("the factor on the curve; empty where the curve is the force itself")
    at: tuple[float, ...] = described("points of the quantity")
    force: tuple[Cells, ...] = described("the force at the points; rows over `at`, columns over `at_too`")
    low: tuple[Cells, ...] = described("lower end of the 95 % band of the force")
    high: tuple[Cells, ...] = described("upper end of the 95 % band of the force")
    over_too: str | None = described("the second quantity of a surface", default=None)
    unit_too: str | None = described("unit of `at_too`", default=None)
    at_too: tuple[float, ...] | None = described("points of the second quantity", default=None)
    visited: tuple[tuple[bool, ...], ...] | None = described(
        "cells of the surface that the motion visited", default=None
    )
    forgets_in: float | None = described(
        "the time constant of the hidden state of a force with a memory", unit="s", default=None
    )


@dataclass(frozen=True, kw_only=True)
class ProposedFormula:
    """A formula that a sparse regression proposes for a learned curve: a proposal, not a finding."""

    formula: str | None = described("the formula; null where none is close enough")
    share_of_curve: float | None = described("the share of the curve that the formula explains", default=None)
    says: str = described("the reliability of the proposal, in a sentence")


@dataclass(frozen=True)
class LookAlike:
    """A term of the library that is similar to a learned force."""

    mechanism: str = described("name of the term")
    at: str = described("place at which it would act")


@dataclass(frozen=True, kw_only=True)
class Mechanism:
    """A missing mechanism: a term of the library, a property of a sensor, or a force without a name.

    Bounds of `parameters` are NaN where their intervals are withheld.
    """

    mechanism: str = described("name of the mechanism; `unknown` or `random_force` where it has none")
    at: str = described(
        "the place of the model, drive or sensor at which it acts; empty for a force without a name",
        default="",
        spare=True,
    )
    probability: float = described("posterior probability among the library, `nothing_missing` and `unknown`")
    state: str = described("`named`, `likely` or `open`")
    doubts: tuple[str, ...] = described("reasons why it is not more than likely, in sentences", default=())
    log_odds: float | None = described("log odds of the learned curves over the best of the library", default=None)
    depends_on: tuple[str, ...] | None = described("the covariates of a force without a name", default=None)
    parameters: Mapping[str, Interval] = described("its parameters by name")
    curve: LearnedCurve | None = described("the first of `curves`", default=None)
    curves: tuple[LearnedCurve, ...] = described("the learned curves", default=(), spare=True)
    proposal: ProposedFormula | None = described("a formula for the learned curves", default=None)
    looks_like: tuple[LookAlike, ...] = described("similar terms of the library", default=(), spare=True)
    share_of_likeness: float | None = described("share of its variance that these terms explain", default=None)
    share_of_drive: float | None = described("largest force, as a share of the drive", default=None)
    since: Interval | None = described("its onset, where it began during the recording", default=None)
    says: str = described("the finding, in a sentence")
    by_recording: tuple[OwnParameters, ...] = described(
        "its parameters estimated from each recording separately", default=(), spare=True
    )
    shared: Comparison | None = described("whether one value is valid for all recordings", default=None)


@dataclass(frozen=True)
class OpenTerm:
    """A term that would raise the likelihood, but for which there is evidence against a name."""

    mechanism: str = described("name of the term")
    at: str = described("place at which it would act")
    probability: float = described("its posterior probability")
    says: str = described("why it is open, in a sentence")


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A row of the ranking: a term, `nothing_missing` or `unknown`."""

    mechanism: str = described("name of the candidate")
    at: str = described("place at which it acts")
    log_evidence_gain: float = described("gain in log evidence when it alone is added to the nominal model")
    probability: float = described("posterior probability; for a found term, the one in `found`")
    price: float | None = described(
        "penalty for its parameters and for the size of the library, in log evidence", default=None
    )
    fitted: bool = described("whether it was fitted; else the gain is the bound of a score test")


@dataclass(frozen=True)
class DecidingExcitation:
    """The experiment that would distinguish two explanations."""

    waveform: str = described("harmonic, two tones, sweep or multisine")
    level: float = described("amplitude of the drive, in `unit`")
    frequency: float = described("upper end of the band", unit="Hz")
    band: tuple[float, ...] = described("lowest and highest frequency", unit="Hz")
    unit: str = described("unit of `level`")
    expected_log_gain: float = described("expected log-likelihood difference")
    repeat_log_gain: float = described("the same for a repeat of the recording")
    if_found_is_true: float = described("the same if the found mechanism is true")
    if_this_is_true: float = described("the same if this mechanism is true")


@dataclass(frozen=True, kw_only=True)
class Confusion:
    """A mechanism that the recording cannot distinguish from the found one."""

    mechanism: str = described("name of the mechanism")
    at: str | None = described("place at which it would act", default=None)
    probability: float | None = described("its posterior probability", default=None)
    excitation: DecidingExcitation | None = described("the experiment that would decide", default=None)
    says: str = described("why it cannot be distinguished, and what would decide, in sentences")


@dataclass(frozen=True)
class ParameterSets:
    """The parameters of the nominal model, and of the model with the found mechanisms."""

    before: Mapping[str, Interval] = described("of the nominal model, by name")
    after: Mapping[str, Interval] = described("of the model with the found mechanisms, by name")


@dataclass(frozen=True)
class HeldOutScore:
    """The prediction scores of a model on held-out data."""

    log_score: float = described("mean log density of one-step predictions, for each sample", key="heldout_log_score")
    nrmse: float = described(
        "error of free runs over `horizon`, over the standard deviation of the response, the mean over sensors",
        key="heldout_nrmse",
    )
    nrmse_by_sensor: Mapping[str, float] = described("the same for each sensor, by name", key="heldout_nrmse_by_sensor")
    horizon: float = described("length of the free runs, in `horizon_unit`")


@dataclass(frozen=True)
class HeldOutScores:
    """Predictions of held-out data, before and after."""

    before: HeldOutScore = described("of the nominal model")
    after: HeldOutScore = described("of the model with the found mechanisms")
    noise_floor_nrmse: float = described("the error that measurement noise alone causes")
    horizon_unit: str = described("Lyapunov times, drive periods or natural periods")
    horizon_unit_time: float = described("length of that unit", unit="s")


@dataclass(frozen=True)
class Labels:
    """The models in words."""

    before: str = described("the nominal model")
    after: str = described("the model with the found mechanisms")


@dataclass(frozen=True)
class DriveFacts:
    """The excitation of the machine."""

    amplitude: float = described("scale of the force to which shares refer, in `unit`")
    unit: str = described("its unit")
    of: str = described("the meaning of this scale: the drive, or the inertial force")
    frequency: float | None = described("frequency of a periodic drive; null where it is not periodic", unit="Hz")
    free: bool = described("whether no input was recorded")


@dataclass(frozen=True)
class Units:
    """The units of the arrays."""

    position: str = described("unit of positions")
    velocity: str = described("unit of velocities")
    force: str = described("unit of forces")
    time: str = described("unit of times")
    angle: str = described(
        "`deg` where the case uses degrees: pages show angles in this unit", default="rad", spare=True
    )


@dataclass(frozen=True)
class Response:
    """The quantity that the first sensor measures."""

    quantity: str = described("position, velocity, acceleration, force or angle")


@dataclass(frozen=True)
class SensorFacts:
    """A sensor and its noise, after."""

    name: str = described("its name")
    channel: str = described("the channel of the model that it measures")
    unit: str = described("its unit")
    noise_sd: float = described("standard deviation of all its measurement noise, in `unit`")
    kind: str = described("`white`, `ar1` (slow) or `quantised`")


@dataclass(frozen=True)
class Exponents:
    """Largest Lyapunov exponents of the models."""

    before: float = described("of the nominal model")
    after: float = described("of the model with the found mechanisms")
    unit: str = described("their unit")


@dataclass(frozen=True)
class Both:
    """A number before and after."""

    before: float = described("of the nominal model")
    after: float = described("of the model with the found mechanisms")


@dataclass(frozen=True)
class BothTrue:
    """A truth value before and after."""

    before: bool = described("of the nominal model")
    after: bool = described("of the model with the found mechanisms")


@dataclass(frozen=True)
class ValidTimes:
    """The times for which free runs over held-out data stay near the recording."""

    before: float = described("of the nominal model, in `unit`")
    after: float = described("of the model with the found mechanisms, in `unit`")
    unit: str = described("unit of both")
    or_longer: BothTrue = described("whether the free runs ended before their errors became too large")
    in_lyapunov_times: Both | None = described("the same in Lyapunov times", default=None)
    in_drive_periods: Both | None = described("the same in periods of the drive", default=None)
    in_natural_periods: Both | None = described("the same in natural periods", default=None)


@dataclass(frozen=True)
class Whiteness:
    """The Ljung-Box test of one-step errors."""

    p: float = described("its p-value")
    says: str = described("its meaning, in a sentence")


@dataclass(frozen=True)
class BothWhite:
    """Whiteness before and after."""

    before: Whiteness = described("of the nominal model")
    after: Whiteness = described("of the model with the found mechanisms")


@dataclass(frozen=True)
class SampledEvidence:
    """The log evidence of a model by Laplace's method and by importance sampling."""

    laplace: float = described("by Laplace's method")
    sampled: float = described("by importance sampling; null where it could not be computed")
    error: float = described("standard error of `sampled`")
    effective: float = described("effective number of draws; below a few tens `sampled` is not to be trusted")


@dataclass(frozen=True)
class EvidenceCheck:
    """A check of the log evidence by another method; empty where nothing was found."""

    before: SampledEvidence | None = described("of the nominal model", default=None)
    after: SampledEvidence | None = described("of the model with the found mechanisms", default=None)
    says: str | None = described("whether the two methods agree, in a sentence", default=None)


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """The result of a diagnosis: the content of `diagnosis.json`."""

    title: str = described("title of the case")
    schema: str = described("name and number of this format", default=SCHEMA)
    verdict: str = described("`adequate`: this recording shows no missing physics; or `mismatch`")
    says: tuple[str, ...] = described("the result in sentences")
    scales: tuple[WrongScale, ...] = described(
        "columns whose scale does not fit the model, the most likely one first", default=(), spare=True
    )
    found: tuple[Mechanism, ...] = described(
        "the missing mechanisms, named ones first; empty where the verdict is `adequate`"
    )
    open: tuple[OpenTerm, ...] = described("terms that would raise the likelihood but are not named")
    ranking: tuple[Candidate, ...] = described("every candidate, the most probable first")
    confused_with: tuple[Confusion, ...] = described(
        "mechanisms that this recording cannot distinguish from the found ones"
    )
    expected: Expectation | None = described(
        "what the recording can tell, from the nominal model; null where that cannot follow it", default=None
    )
    absent: tuple[AbsentTerm, ...] = described(
        "upper bounds of the terms that are not in the model; empty where the model does not predict held-out data",
        default=(),
    )
    unlimited: tuple[UnlimitedTerm, ...] = described("terms whose size this recording does not limit", default=())
    unexplained: UnexplainedForce = described("the remaining random force")
    unexplained_before: UnexplainedForce = described("the random force that remains with the nominal model")
    where: ForceDependence = described("dependence of the missing force, before")
    where_after: ForceDependence = described("dependence of the remaining force, after")
    parameters: ParameterSets = described("the parameters of the model, before and after")
    fit: HeldOutScores = described("predictions of held-out data, before and after")
    model: Labels = described("the models in words")
    drive: DriveFacts = described("the excitation of the machine")
    units: Units = described("units of the arrays")
    response: Response = described("the quantity that the first sensor measures")
    sensors: tuple[SensorFacts, ...] = described("the sensors and their noise")
    lyapunov: Exponents = described("largest Lyapunov exponents")
    valid_prediction_time: ValidTimes = described("the time for which predictions are valid")
    whiteness: BothWhite = described("whether one-step errors are white")
    sharing: Sharing | None = described("comparison of several recordings; absent for one recording", default=None)
    show: Behaviour = described("measures of the motion, before, after and of noise alone")
    decay: Decays | None = described("free decays of recordings without a drive and of hammer tests", default=None)
    evidence: EvidenceCheck = described("the log evidence by another method")
    machine: FittedMachine = described("the fitted model, in a form from which it can be simulated again")
    truth: Mapping[str, float] = described("true values from the case, for tests with simulated data")
    recordings: tuple[RecordingFacts, ...] = described("the recordings of the case")
    notes: tuple[str, ...] = described("limitations of the result, in sentences")
    provenance: Origin = described("versions, settings, seed and digests of the inputs")
