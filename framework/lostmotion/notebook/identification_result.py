"""The result of an identification as an object: intervals, draws, figures and the page."""

from __future__ import annotations

import html
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from lostmotion.codec import to_plain
from lostmotion.identification.report import figures as drawing
from lostmotion.identification.report import identification_page as page
from lostmotion.identification.report.view import DRAWS, RERUN_HINT, RESULT, IdentificationView, make_view
from lostmotion.notebook.answers import Answer, format_answer
from lostmotion.report import style
from lostmotion.results import Interval
from lostmotion.results.identification import Identification
from lostmotion.storage import folder_for, load_arrays, load_result, save_datasets, save_json, save_text

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class PosteriorPlots:
    """The figures of an identification; each method returns a matplotlib figure, and calling the object the corner."""

    view: IdentificationView

    def __repr__(self) -> str:
        return "<figures of a posterior: .corner(), .trace()>"

    def __call__(self) -> Figure:
        """Return the corner plot of the parameters."""
        return self.corner()

    def corner(self) -> Figure:
        """Return the corner plot of the parameters."""
        with style.use_style():
            return drawing.draw_corner(self.view)

    def trace(self) -> Figure:
        """Return the walkers over the steps, and the distribution of their ranks."""
        with style.use_style():
            return drawing.draw_trace(self.view)


@dataclass(frozen=True, eq=False)
class IdentificationResult(Answer[Identification]):
    """The result of `lostmotion.identify`: `result` is the content of `identification.json`, `groups` of ArviZ."""

    groups: Mapping[str, xr.Dataset] = field(repr=False)

    @property
    def converged(self) -> bool:
        """Whether the chain has converged; without convergence there are no intervals."""
        return self.result.converged

    @property
    def parameters(self) -> Mapping[str, Interval]:
        """The parameters by name, with median, central 95 % interval and unit."""
        return {name: row.interval for name, row in self.result.parameters.items()}

    @property
    def view(self) -> IdentificationView:
        """The result and its draws in the form that the figures use."""
        return make_view(self.result, self.groups["posterior"])

    @property
    def plot(self) -> PosteriorPlots:
        """The figures: `plot.corner()` and `plot.trace()`."""
        return PosteriorPlots(self.view)

    def to_xarray(self) -> xr.Dataset:
        """Return the draws of each parameter (chain, draw), with units."""
        return self.groups["posterior"]

    def to_arviz(self) -> xr.DataTree:
        """Return the groups of ArviZ as a tree, on which the functions of ArviZ work."""
        import xarray as xr

        return xr.DataTree.from_dict(dict(self.groups))

    def report(self, path: str | Path = "report.html") -> Path:
        """Write the page as self-contained HTML and return its path."""
        return save_text(Path(path), page.render(self.view))

    def save(self, folder: str | Path) -> Path:
        """Write `identification.json`, `posterior.nc` and `report.html` into a folder and return it."""
        place = folder_for(Path(folder))
        groups: dict[str | None, xr.Dataset] = dict(self.groups.items())
        save_datasets(place / DRAWS, groups, {"title": self.result.title})
        save_json(place / RESULT, to_plain(self.result))
        self.report(place / "report.html")
        return place

    def __repr__(self) -> str:
        lines = [f"{self.result.title}: {self.result.model}", *self.says]
        return "\n".join([*lines, *(f"  {name} = {value}" for name, value in self.parameters.items())])

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(k)}</td><td>{html.escape(str(v))}</td></tr>" for k, v in self.parameters.items()
        )
        return format_answer(self.result.title, self.says, f"<table>{rows}</table>")


def load_identification(folder: Path) -> IdentificationResult:
    """Return the identification stored in a folder; raise `DataError` where it is absent or damaged."""
    result = load_result(Identification, folder / RESULT, RERUN_HINT)
    import h5netcdf

    with h5netcdf.File(folder / DRAWS, "r") as file:
        names = list(file.groups)
    groups = {name: load_arrays(folder / DRAWS, RERUN_HINT, group=name) for name in names}
    return IdentificationResult(result, groups)
