"""What a diagnosis said, read back from its `diagnosis.json`: what those need who compare it, count it or judge it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from lostmotion.codec import from_plain, told
from lostmotion.results import Interval
from lostmotion.storage import load_json

FILE = "diagnosis.json"
NAN = float("nan")


@dataclass(frozen=True)
class AnswerEntry:
    """One entry of `found`."""

    mechanism: str = told("name of the mechanism; `unknown` where a force has no name")
    probability: float = told("its posterior probability")
    at: str = told("the place at which it acts; empty where it has none", default="")
    state: str = told("named, likely or open", default="named")
    parameters: Mapping[str, Interval] = told("its parameters by name", default={})
    share_of_drive: float = told("its largest force over that of the drive", default=NAN)


@dataclass(frozen=True)
class AnswerRank:
    """One entry of `ranking`."""

    mechanism: str = told("name of the candidate")
    at: str = told("the place at which it acts; empty where it has none")
    probability: float = told("its posterior probability")


@dataclass(frozen=True)
class AnswerRival:
    """One entry of `confused_with`."""

    mechanism: str = told("name of a mechanism that the recording cannot tell from what was found")
    at: str | None = told("the place at which it would act", default=None)


@dataclass(frozen=True)
class AnswerParameters:
    """The parameters of the machine."""

    before: Mapping[str, Interval] = told("of the nominal model, by name")
    after: Mapping[str, Interval] = told("of the model with what was found, by name")


@dataclass(frozen=True)
class AnswerError:
    """How well a model predicts held-out data."""

    heldout_nrmse: float = told("error of its free runs over the standard deviation of the response")
    horizon: float = told("length of the free runs, in units of the horizon")


@dataclass(frozen=True)
class AnswerFit:
    """The held-out comparison."""

    before: AnswerError = told("of the nominal model")
    after: AnswerError = told("of the model with what was found")
    noise_floor_nrmse: float = told("the noise of the held-out readings over the deviation of the response")
    horizon_unit: str = told("unit of the horizon, in words")
    horizon_unit_time: float = told("one unit of the horizon", unit="s")


@dataclass(frozen=True)
class AnswerRest:
    """The force that is left over."""

    share_of_drive: float = told("its rms over the force of the drive")


@dataclass(frozen=True)
class Answer:
    """What a diagnosis said of a case."""

    verdict: str = told("adequate or mismatch")
    found: tuple[AnswerEntry, ...] = told("the mechanisms that were found")
    ranking: tuple[AnswerRank, ...] = told("the candidates with their probabilities")
    confused_with: tuple[AnswerRival, ...] = told("mechanisms that cannot be told from what was found")
    unexplained: AnswerRest = told("the force that is left over")
    parameters: AnswerParameters = told("the parameters of the machine")
    fit: AnswerFit = told("the comparison on held-out data")
    says: tuple[str, ...] = told("the answer, in sentences")
    provenance: Mapping[str, object] = told("versions, settings, seed and digests that made it", default={})


def read_answer(folder: Path) -> Answer:
    """Return what the diagnosis in a folder said; `DataError` where no whole one is there."""
    wanted = "run the same command again"
    return from_plain(Answer, load_json(folder / FILE, wanted), str(folder / FILE))
