"""What one figure or table comes to: the arrays it is drawn from, key figures, and whether the paper's claim holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from lostmotion.codec import described
from lostmotion_trials.paper.drawings import Drawing

Verdict = Literal["reproduced", "reproduced in part", "not reproduced", "beyond the paper"]


@dataclass(frozen=True)
class PaperTable:
    """A table: its column heads, with units, and rows of text or numbers."""

    heads: tuple[str, ...]
    rows: tuple[tuple[str | float, ...], ...]


@dataclass(frozen=True, eq=False)
class PaperOutcome:
    """The outcome of one figure or table.

    `data` is what its drawing takes, `numbers` are the key figures by name, `says` is one sentence: what was found,
    against what the paper says.
    """

    verdict: Verdict
    says: str
    numbers: Mapping[str, float] = field(default_factory=dict)
    data: Drawing | None = None
    table: PaperTable | None = None


@dataclass(frozen=True)
class ReproducedItem:
    """What became of one figure or table."""

    verdict: str = described("reproduced, reproduced in part, not reproduced, or beyond the paper")
    says: str = described("what was found, against what the paper says")
    numbers: Mapping[str, float] = described("key figures, by name")


@dataclass(frozen=True)
class Reproduction:
    """What `reproduce.json` holds."""

    items: Mapping[str, ReproducedItem] = described("figures and tables, by name")
    provenance: Mapping[str, object] = described("versions, settings and seed that made it")


def verdict_of(*claims: bool) -> Verdict:
    """Return the verdict on a figure of which these claims hold or not."""
    if all(claims):
        return "reproduced"
    return "reproduced in part" if any(claims) else "not reproduced"


def listed(items: list[str]) -> str:
    """Return the items as words: a, b and c."""
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + " and " + items[-1] if items else "none"
