"""Who appears in the figures: the model before and after, or the one model where nothing had to be added."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style

T = TypeVar("T")


class Version(NamedTuple):
    """A model as figures show it: its key in arrays, the word that tells it apart, and its colour."""

    key: str
    word: str
    colour: str

    def named(self, noun: str) -> str:
        """Return `noun before`, `noun after`, or the noun alone where there is one model only."""
        return f"{noun} {self.word}".rstrip()

    def of(self, before: T, after: T) -> T:
        """Return which of two values is that of this model."""
        return after if self.key == "after" else before


def versions(evidence: Evidence) -> tuple[Version, ...]:
    """Return the versions of the model, in the order in which they are drawn."""
    if not evidence.augmented:
        return (Version("before", "", style.AFTER),)
    return Version("before", "before", style.BEFORE), Version("after", "after", style.AFTER)
