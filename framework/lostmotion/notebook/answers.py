"""What results of commands have in common as objects: sentences, notes, content, and the answer of a diagnosis."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from lostmotion.codec import to_plain
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Diagnosis, HeldOutScore, Mechanism
from lostmotion.results.expectation import CaseCheck
from lostmotion.results.identification import Identification
from lostmotion.results.robots import RobotDiagnosis

if TYPE_CHECKING:
    import xarray as xr

Stored = TypeVar("Stored", Diagnosis, RobotDiagnosis, CaseCheck, Identification)
Diagnosed = TypeVar("Diagnosed", Diagnosis, RobotDiagnosis)


@dataclass(frozen=True, eq=False)
class Answer(Generic[Stored]):
    """A stored `result`: its sentences, its notes and its content."""

    result: Stored

    @property
    def says(self) -> tuple[str, ...]:
        """The result in sentences."""
        return self.result.says

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the recordings and on the limitations of the result."""
        return self.result.notes

    def to_dict(self) -> dict[str, Any]:
        """Return the content of the stored JSON file."""
        made: dict[str, Any] = to_plain(self.result)
        return made


@dataclass(frozen=True, eq=False)
class DiagnosisAnswer(Answer[Diagnosed]):
    """The answer of a diagnosis, of a machine or of a robot; `arrays` is the dataset behind it."""

    arrays: xr.Dataset

    @property
    def verdict(self) -> str:
        """Whether the model is "adequate", or there is a "mismatch"."""
        return self.result.verdict

    @property
    def found(self) -> tuple[Mechanism, ...]:
        """The missing mechanisms: named ones first, open ones last."""
        return self.result.found

    @property
    def parameters_before(self) -> Mapping[str, Interval]:
        """The parameters of the nominal model, by name."""
        return self.result.parameters.before

    @property
    def parameters_after(self) -> Mapping[str, Interval]:
        """The parameters of the model with the found mechanisms, by name."""
        return self.result.parameters.after

    @property
    def heldout(self) -> Mapping[str, HeldOutScore]:
        """The prediction scores of the models "before" and "after" on held-out data."""
        return {"before": self.result.fit.before, "after": self.result.fit.after}

    def to_xarray(self) -> xr.Dataset:
        """Return the arrays behind the diagnosis, with units and coordinates."""
        return self.arrays


def format_answer(heading: str, sentences: Iterable[str], more: str) -> str:
    """Return a heading and sentences as HTML, with `more` HTML after them."""
    items = "".join(f"<li>{html.escape(one)}</li>" for one in sentences)
    return f"<h4>{html.escape(heading)}</h4><ul>{items}</ul>{more}"
