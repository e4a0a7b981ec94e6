"""What an analysis found, as an object: the verdict on a motion, its measures, arrays and the page."""

from __future__ import annotations

import html
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lostmotion.report import analysis as page
from lostmotion.report.analysis_facts import AnalysisEvidence
from lostmotion.storage import finite, folder_for, load_arrays, load_json, save_datasets, save_json, save_text

if TYPE_CHECKING:
    import xarray as xr

AGAIN = "run `lostmotion analyse` again"


@dataclass(frozen=True, eq=False)
class AnalysisResult:
    """What `lostmotion.analyse` returns: `content` is that of `analysis.json`, `arrays` the dataset behind it."""

    content: Mapping[str, Any]
    arrays: xr.Dataset = field(repr=False)

    @property
    def verdict(self) -> str:
        """What kind of motion it is."""
        return str(self.content["verdict"])

    @property
    def says(self) -> tuple[str, ...]:
        """The answer, in sentences."""
        said = self.content["says"]
        return (str(said),) if isinstance(said, str) else tuple(str(one) for one in said)

    def to_dict(self) -> dict[str, Any]:
        """Return the content of `analysis.json`."""
        made: Any = finite(self.content)
        return dict(made)

    def to_xarray(self) -> xr.Dataset:
        """Return the arrays behind the analysis, with units and coordinates."""
        return self.arrays

    def report(self, path: str | Path = "report.html") -> Path:
        """Return the path of the page that was written: self-contained HTML."""
        return save_text(Path(path), page.render(AnalysisEvidence(self.arrays, self.to_dict())))

    def save(self, folder: str | Path) -> Path:
        """Return the folder into which `analysis.json`, `analysis.nc` and `report.html` were written."""
        place = folder_for(Path(folder))
        save_datasets(place / "analysis.nc", {None: self.arrays})
        save_json(place / "analysis.json", self.content)
        self.report(place / "report.html")
        return place

    def __repr__(self) -> str:
        return "\n".join([f"{self.content['title']}: {self.verdict}", *self.says])

    def _repr_html_(self) -> str:
        said = "".join(f"<li>{html.escape(one)}</li>" for one in self.says)
        return f"<h4>{html.escape(str(self.content['title']))}: {html.escape(self.verdict)}</h4><ul>{said}</ul>"


def load_analysis(folder: Path) -> AnalysisResult:
    """Return the analysis that was saved into a folder; `DataError` where it is absent or damaged."""
    content = load_json(folder / "analysis.json", AGAIN)
    return AnalysisResult(content, load_arrays(folder / "analysis.nc", AGAIN))
