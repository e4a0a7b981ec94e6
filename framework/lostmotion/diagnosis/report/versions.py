"""The versions of the model in the figures: before and after, or one version where nothing was added."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style

T = TypeVar("T")


class Version(NamedTuple):
    """A version of the model in figures: its key in arrays, the word "before" or "after", and its colour."""

    key: str
    word: str
    colour: str

    def make_label(self, noun: str) -> str:
        """Return `noun before`, `noun after`, or the noun alone where there is only one version."""
        return f"{noun} {self.word}".rstrip()

    def select(self, before: T, after: T) -> T:
        """Return the one of two values that belongs to this version."""
        return after if self.key == "after" else before


def list_versions(evidence: Evidence) -> tuple[Version, ...]:
    """Return the versions of the model in drawing order."""
    if not evidence.augmented:
        return (Version("before", "", style.AFTER),)
    return Version("before", "before", style.BEFORE), Version("after", "after", style.AFTER)
