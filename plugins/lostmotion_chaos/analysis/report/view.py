"""The data of the page of an analysis, and texts that several figures share."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from lostmotion.report import style
from lostmotion.report.words import Scale, sentence, shorten, to_words, with_unit
from lostmotion.results import Array
from lostmotion.storage import load_arrays, load_result, require_files
from lostmotion_chaos.results import Analysis

RERUN_HINT = "run `lostmotion analyse` again"
RESULT, ARRAYS = "analysis.json", "analysis.nc"
RECORDED = "as recorded"
CLEANED = "noise reduced"


class Variant(NamedTuple):
    """One version of the recording: the key of its series, its name and its colour."""

    key: str
    words: str
    colour: str


@dataclass(frozen=True)
class AnalysisView:
    """The data of figures and page: the result, and numeric arrays with their units and long names."""

    result: Analysis
    arrays: Mapping[str, Array]
    units: Mapping[str, str]
    long_names: Mapping[str, str]

    def has(self, *names: str) -> bool:
        """Return whether every array of `names` exists and has at least one finite value."""
        return all(name in self.arrays and bool(np.isfinite(self.arrays[name]).any()) for name in names)

    @property
    def period(self) -> float:
        """The period (s) of the drive, or NaN."""
        period = self.result.drive.period
        return period if period > 0 else math.nan

    @property
    def lag(self) -> int:
        """The delay in samples, at least 1."""
        return max(1, self.result.delay.samples)


def read_analysis(folder: Path) -> AnalysisView:
    """Return the data that `lostmotion analyse` wrote into a folder; the arrays may be absent."""
    require_files(folder, [RESULT], "lostmotion analyse RECORDING")
    result, arrays = load_result(Analysis, folder / RESULT, RERUN_HINT), folder / ARRAYS
    return make_view(result, load_arrays(arrays, RERUN_HINT) if arrays.is_file() else xr.Dataset())


def make_view(result: Analysis, data: xr.Dataset) -> AnalysisView:
    """Return the data of figures and page from a result and the numeric arrays of a dataset."""
    numeric = {str(n): v for n, v in data.variables.items() if v.dtype.kind in "fiub"}
    return AnalysisView(
        result,
        arrays={name: np.asarray(variable.values, dtype=float) for name, variable in numeric.items()},
        units={name: str(variable.attrs.get("units", "")) for name, variable in numeric.items()},
        long_names={name: str(variable.attrs.get("long_name", "")) for name, variable in numeric.items()},
    )


def name_period_source(view: AnalysisView) -> str:
    """Return "drive", or "strongest line" where the period was read from the spectrum."""
    return "strongest line" if view.result.drive.source == "spectrum" else "drive"


def name_quantity(view: AnalysisView) -> str:
    """Return the name of the recorded quantity, such as `displacement`."""
    name = view.long_names.get("x", "").partition(",")[0]
    return shorten(to_words(name) if name not in ("", "x") else "recorded signal", 24)


def choose_scale(view: AnalysisView, *names: str) -> Scale:
    """Return the unit scale in which the recording is easy to read."""
    values = [view.arrays[name].ravel() for name in names or ("x",) if view.has(name)]
    return style.scale_of(np.concatenate(values) if values else np.zeros(1), shorten(view.units.get("x", ""), 12))


def name_delay_axes(view: AnalysisView, shown: Scale) -> tuple[str, str]:
    """Return the axis labels of a plane of two delay coordinates."""
    name = name_quantity(view)
    seconds = view.result.delay.seconds
    later = f"{name}, {seconds:.3g} s later" if math.isfinite(seconds) else f"{name}, one delay later"
    return with_unit(name, shown.unit), wrap_label(with_unit(later, shown.unit), 40)


def find_versions(view: AnalysisView, before: str, after: str) -> list[Variant]:
    """Return the available versions of an array: before and after noise reduction."""
    both = (Variant(before, RECORDED, style.BEFORE), Variant(after, CLEANED, style.AFTER))
    found = [shown for shown in both if view.has(shown.key)]
    return found if len(found) > 1 else [shown._replace(colour=style.RECORDED) for shown in found]


def wrap_label(words: str, width: int) -> str:
    """Return a label on two lines where it is longer than `width`."""
    return "\n".join(textwrap.wrap(words, width, max_lines=2, placeholder=" …"))


def thin_rows(values: Array, most: int) -> Array:
    """Return every k-th row, so that at most `most` rows remain."""
    return values[:: max(1, math.ceil(len(values) / most))]


def complete_sentence(text: str) -> str:
    """Return a text as a sentence, with a capital letter and a full stop."""
    text = sentence(text.strip())
    return text if not text or text.endswith((".", "!", "?", "…")) else text + "."


def join_sentences(parts: list[str]) -> str:
    """Return the non-empty parts as consecutive sentences."""
    return " ".join(sentence(part) for part in parts if part)
