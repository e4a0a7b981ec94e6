"""The result of an analysis as an object: the verdict on a motion, its measures, arrays and the page."""

from __future__ import annotations

import html
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lostmotion.codec import to_plain
from lostmotion.storage import folder_for, load_arrays, load_result, save_datasets, save_json, save_text
from lostmotion_chaos.analysis.report import page as page
from lostmotion_chaos.analysis.report.view import ARRAYS, RERUN_HINT, RESULT, make_view
from lostmotion_chaos.results import Analysis

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, eq=False)
class AnalysisResult:
    """The result of `lostmotion.analyse`: `result` is the content of `analysis.json`, `arrays` its dataset."""

    result: Analysis
    arrays: xr.Dataset = field(repr=False)

    @property
    def verdict(self) -> str:
        """The kind of motion."""
        return self.result.verdict

    @property
    def says(self) -> tuple[str, ...]:
        """The result in sentences."""
        return (self.result.says,)

    def to_dict(self) -> dict[str, Any]:
        """Return the content of `analysis.json`."""
        made: dict[str, Any] = to_plain(self.result)
        return made

    def to_xarray(self) -> xr.Dataset:
        """Return the arrays behind the analysis, with units and coordinates."""
        return self.arrays

    def report(self, path: str | Path = "report.html") -> Path:
        """Write the page as self-contained HTML and return its path."""
        return save_text(Path(path), page.render(make_view(self.result, self.arrays)))

    def save(self, folder: str | Path) -> Path:
        """Write `analysis.json`, `analysis.nc` and `report.html` into a folder and return it."""
        place = folder_for(Path(folder))
        save_datasets(place / ARRAYS, {None: self.arrays})
        save_json(place / RESULT, to_plain(self.result))
        self.report(place / "report.html")
        return place

    def __repr__(self) -> str:
        return "\n".join([f"{self.result.title}: {self.verdict}", *self.says])

    def _repr_html_(self) -> str:
        items = "".join(f"<li>{html.escape(one)}</li>" for one in self.says)
        return f"<h4>{html.escape(self.result.title)}: {html.escape(self.verdict)}</h4><ul>{items}</ul>"


def load_analysis(folder: Path) -> AnalysisResult:
    """Return the analysis stored in a folder; raise `DataError` where it is absent or damaged."""
    return AnalysisResult(load_result(Analysis, folder / RESULT, RERUN_HINT), load_arrays(folder / ARRAYS, RERUN_HINT))
