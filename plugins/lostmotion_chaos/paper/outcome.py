"""The outcome of one figure or table: its data, key figures, and whether the claim of the paper holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from lostmotion.codec import described
from lostmotion_chaos.paper.drawings import Drawing

Verdict = Literal["reproduced", "reproduced in part", "not reproduced", "beyond the paper"]


@dataclass(frozen=True)
class PaperTable:
    """A table: its column heads, with units, and rows of text or numbers."""

    heads: tuple[str, ...]
    rows: tuple[tuple[str | float, ...], ...]


@dataclass(frozen=True, eq=False)
class PaperOutcome:
    """The outcome of one figure or table.

    `data` is the input of its drawing, `numbers` are the key figures by name, `says` is a sentence that compares the
    result with the paper.
    """

    verdict: Verdict
    says: str
    numbers: Mapping[str, float] = field(default_factory=dict)
    data: Drawing | None = None
    table: PaperTable | None = None


@dataclass(frozen=True)
class ReproducedItem:
    """The result of one figure or table in `reproduce.json`."""

    verdict: str = described("reproduced, reproduced in part, not reproduced, or beyond the paper")
    says: str = described("comparison of the result with the paper")
    numbers: Mapping[str, float] = described("key figures, by name")


@dataclass(frozen=True)
class Reproduction:
    """The content of `reproduce.json`."""

    items: Mapping[str, ReproducedItem] = described("figures and tables, by name")
    provenance: Mapping[str, object] = described("versions, settings and seed of this run")


def judge_claims(*claims: bool) -> Verdict:
    """Return the verdict on a figure from the truth of each claim of the paper about it."""
    if all(claims):
        return "reproduced"
    return "reproduced in part" if any(claims) else "not reproduced"
