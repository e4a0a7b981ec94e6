"""The result of a diagnosis of a robot: what `diagnosis.json` holds besides the keys of any diagnosis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion.results import Interval
from lostmotion.results.background import Origin, RecordingFacts
from lostmotion.results.diagnosis import SCHEMA, Candidate, Confusion, HeldOutScores, Labels, Mechanism, ParameterSets
from lostmotion.results.mismatch import UnexplainedForce


def is_robot_result(plain: Mapping[str, object]) -> bool:
    """Return whether the content of a `diagnosis.json` is that of a robot."""
    return "joints" in plain


@dataclass(frozen=True)
class Check:
    """Something that was looked at before any fit."""

    name: str = described("motion, unit, order, gravity, sign, torque, resonance, side or clock")
    joint: str = described("the joint; empty where it concerns all")
    passed: bool = described("whether nothing is wrong")
    says: str = described("what was found, with the remedy")
    stop: bool = described("whether a diagnosis is meaningless before it is corrected", default=False, spare=True)


@dataclass(frozen=True)
class Dependence:
    """What the missing torque depends on."""

    summary: str = described("the joint and the quantities, in a sentence")
    explained_by: Mapping[str, float] = described("the share that each quantity explains, for the joint with the most")


@dataclass(frozen=True)
class JointRow:
    """A joint before and after."""

    joint: str = described("its name")
    unit: str = described("unit of torques")
    torque: float = described("standard deviation of its torque, in `unit`")
    random_before: float = described("rms of its random force in a sample, nominal model, in `unit`")
    random_after: float = described("the same with the found mechanisms")
    nrmse_before: float = described("error of free runs over held-out data, nominal model")
    nrmse_after: float = described("the same with the found mechanisms")
    white_before: float = described("variance of standardised one-step errors on held-out data, nominal model")
    white_after: float = described("the same with the found mechanisms")
    found: tuple[str, ...] = described("the mechanisms found there")


@dataclass(frozen=True)
class StepCost:
    """What a time step of the simulation costs."""

    step: float = described("the step (s)")
    nats: float = described("loss of log-likelihood against the exact motion of the same model")


@dataclass(frozen=True)
class WrittenModel:
    """The model with what was found in it, as `arm_found.xml` has it, stepped by its simulator.

    Errors are those of free runs over held-out data, without the discrepancy.
    """

    before: float = described("error of the model as it is, with its exact motion")
    exact: float = described("the same with what was found")
    nrmse: float = described("error of the changed model, stepped by its simulator")
    share: float = described("the share of the improvement that stays")


@dataclass(frozen=True, kw_only=True)
class RobotDiagnosis:
    """The result of a diagnosis of a robot: the content of `diagnosis.json`."""

    title: str = described("title of the case")
    schema: str = described("name and number of this format", default=SCHEMA)
    verdict: str = described("`adequate`: this log shows no missing physics; or `mismatch`")
    says: tuple[str, ...] = described("the result in sentences")
    checks: tuple[Check, ...] = described("what was looked at before any fit")
    found: tuple[Mechanism, ...] = described("the missing mechanisms; empty where the verdict is `adequate`")
    ranking: tuple[Candidate, ...] = described("every set of mechanisms that was fitted, the most probable first")
    confused_with: tuple[Confusion, ...] = described("mechanisms that this log cannot distinguish from the found ones")
    unexplained: UnexplainedForce = described("the remaining random force at the joint where it is largest")
    where: Dependence = described("dependence of the missing torque, before")
    parameters: ParameterSets = described("the parameters of the model, before and after")
    fit: HeldOutScores = described("predictions of held-out data, before and after")
    model: Labels = described("the models in words")
    joints: tuple[JointRow, ...] = described("each joint, before and after")
    noise: Mapping[str, Interval] = described("noise of each encoder, after")
    steps: tuple[StepCost, ...] = described("costs of time steps of the simulation: its own, and a finer one")
    written: WrittenModel | None = described("the changed model on held-out data; null where it was not stepped")
    recordings: tuple[RecordingFacts, ...] = described("the log")
    notes: tuple[str, ...] = described("limitations and remarks, in sentences")
    provenance: Origin = described("versions, settings and digests of the inputs")
