"""What the page of an analysis is drawn from, and the words for it that several figures share."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from lostmotion.report import style
from lostmotion.report.evidence import Drawable, arrays_of
from lostmotion.report.words import Scale, sentence, shortened, spoken, with_unit
from lostmotion.results import Array
from lostmotion.storage import load_json, require_files

AGAIN = "run `lostmotion analyse` again"
RECORDED = "as recorded"
CLEANED = "noise reduced"


@dataclass(frozen=True, eq=False)
class AnalysisEvidence(Drawable):
    """The facts of an analysis as JSON has them, and the dataset behind them."""

    facts: Mapping[str, Any]

    def fact(self, *path: str) -> Any:
        """Return the fact at a path of keys, or None where any of them is absent."""
        found: Any = self.facts
        for key in path:
            found = found.get(key) if isinstance(found, Mapping) else None
        return found

    def number(self, *path: str) -> float:
        """Return the number at a path of keys, or NaN where there is none."""
        found = self.fact(*path)
        return float(found) if isinstance(found, int | float) else float("nan")


class Shown(NamedTuple):
    """One version of the recording: the key of its series, its name and its colour."""

    key: str
    words: str
    colour: str


def read_analysis(folder: Path) -> AnalysisEvidence:
    """Return what `lostmotion analyse` wrote into a folder."""
    require_files(folder, ["analysis.json"], "lostmotion analyse RECORDING")
    facts = load_json(folder / "analysis.json", AGAIN)
    return AnalysisEvidence(arrays_of(folder / "analysis.nc", AGAIN), facts)


def entry(evidence: AnalysisEvidence, *path: str) -> Mapping[str, Any]:
    """Return the facts on one number, or nothing."""
    found = evidence.fact(*path)
    return found if isinstance(found, Mapping) else {}


def rows_of(evidence: AnalysisEvidence, key: str) -> list[Mapping[str, Any]]:
    """Return the entries of a list of facts."""
    found = evidence.fact(key)
    return [row for row in found if isinstance(row, Mapping)] if isinstance(found, list) else []


def period_of(evidence: AnalysisEvidence) -> float:
    """Return the period (s) of the drive, or NaN."""
    period = evidence.number("drive", "period")
    return period if period > 0 else math.nan


def beat(evidence: AnalysisEvidence) -> str:
    """Return what the period is that of: the drive, or a line of the spectrum where no drive was named."""
    return "strongest line" if evidence.fact("drive", "source") == "spectrum" else "drive"


def quantity(evidence: AnalysisEvidence) -> str:
    """Return what was recorded, such as `displacement`."""
    name = evidence.long_names.get("x", "").partition(",")[0]
    return shortened(spoken(name) if name not in ("", "x") else "recorded signal", 24)


def scale(evidence: AnalysisEvidence, *names: str) -> Scale:
    """Return the scale in which the recording is easy to read."""
    values = [evidence.arrays[name].ravel() for name in names or ("x",) if evidence.has(name)]
    return style.scale_of(np.concatenate(values) if values else np.zeros(1), shortened(evidence.units.get("x", ""), 12))


def delayed(evidence: AnalysisEvidence, shown: Scale) -> tuple[str, str]:
    """Return the names of the axes of a plane of two delay coordinates."""
    said = quantity(evidence)
    seconds = evidence.number("delay", "seconds")
    later = f"{said}, {seconds:.3g} s later" if math.isfinite(seconds) else f"{said}, one delay later"
    return with_unit(said, shown.unit), folded(with_unit(later, shown.unit), 40)


def lag_of(evidence: AnalysisEvidence) -> int:
    """Return the delay in samples; 1 where none was found."""
    lag = evidence.number("delay", "samples")
    return max(1, int(lag)) if math.isfinite(lag) else 1


def versions(evidence: AnalysisEvidence, before: str, after: str) -> list[Shown]:
    """Return the versions of an array that are there: before and after noise reduction."""
    both = (Shown(before, RECORDED, style.BEFORE), Shown(after, CLEANED, style.AFTER))
    found = [shown for shown in both if evidence.has(shown.key)]
    return found if len(found) > 1 else [shown._replace(colour=style.RECORDED) for shown in found]


def folded(words: str, width: int) -> str:
    """Return a label on two lines where it is longer than `width`."""
    return "\n".join(textwrap.wrap(words, width, max_lines=2, placeholder=" …"))


def thinned(values: Array, most: int) -> Array:
    """Return every k-th row, so that at most so many are left."""
    return values[:: max(1, math.ceil(len(values) / most))]


def whole(text: str) -> str:
    """Return a text as a sentence: with a capital at its start and a stop at its end."""
    text = sentence(text.strip())
    return text if not text or text.endswith((".", "!", "?", "…")) else text + "."


def listed(parts: list[str]) -> str:
    """Return parts as one sentence after another, without the empty ones."""
    return " ".join(sentence(part) for part in parts if part)
