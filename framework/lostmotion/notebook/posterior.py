"""What an identification found, as an object: intervals, draws, figures and the page."""

from __future__ import annotations

import html
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lostmotion.report import identification as page
from lostmotion.report import identification_figures as drawing
from lostmotion.report import style
from lostmotion.report.identification_facts import AGAIN, Sampled, sampled_of
from lostmotion.results import Interval
from lostmotion.storage import finite, folder_for, load_arrays, load_json, save_datasets, save_json, save_text

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class PosteriorPlots:
    """The figures of an identification; each returns a matplotlib figure, and a bare call the corner."""

    sampled: Sampled

    def __call__(self) -> Figure:
        """Return the parameters drawn one against another."""
        return self.corner()

    def corner(self) -> Figure:
        """Return the parameters drawn one against another."""
        with style.applied():
            return drawing.corner(self.sampled)

    def trace(self) -> Figure:
        """Return the walkers over the steps, and how their ranks mix."""
        with style.applied():
            return drawing.trace(self.sampled)


@dataclass(frozen=True, eq=False)
class IdentificationResult:
    """What `lostmotion.identify` returns: `content` is that of `identification.json`, `groups` those of ArviZ."""

    content: Mapping[str, Any]
    groups: Mapping[str, xr.Dataset] = field(repr=False)

    @property
    def converged(self) -> bool:
        """Whether the chain may be believed: where not, there are no intervals."""
        return bool(self.content["converged"])

    @property
    def says(self) -> tuple[str, ...]:
        """What is to be known of the answer, in sentences."""
        return tuple(str(one) for one in self.content["says"])

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on the recordings and on what makes intervals less certain."""
        return tuple(str(one) for one in self.content["notes"])

    @property
    def parameters(self) -> Mapping[str, Interval]:
        """The parameters by name, with median, central 95 % interval and unit."""
        return {name: Interval.of(told) for name, told in self.content["parameters"].items()}

    @property
    def sampled(self) -> Sampled:
        """Facts and draws as figures take them."""
        facts: Any = finite(self.content)
        return sampled_of(facts, self.groups["posterior"])

    @property
    def plot(self) -> PosteriorPlots:
        """The figures: `plot.corner()` and `plot.trace()`."""
        return PosteriorPlots(self.sampled)

    def to_dict(self) -> dict[str, Any]:
        """Return the content of `identification.json`."""
        made: Any = finite(self.content)
        return dict(made)

    def to_xarray(self) -> xr.Dataset:
        """Return the draws of each parameter (chain, draw), with units."""
        return self.groups["posterior"]

    def to_arviz(self) -> Any:
        """Return ArviZ's `InferenceData`."""
        import arviz

        groups: dict[str, Any] = dict(self.groups)
        return arviz.InferenceData(**groups)

    def report(self, path: str | Path = "report.html") -> Path:
        """Return the path of the page that was written: self-contained HTML."""
        return save_text(Path(path), page.render(self.sampled))

    def save(self, folder: str | Path) -> Path:
        """Return the folder into which `identification.json`, `posterior.nc` and `report.html` were written."""
        place = folder_for(Path(folder))
        groups: dict[str | None, xr.Dataset] = dict(self.groups.items())
        save_datasets(place / "posterior.nc", groups, {"title": str(self.content["title"])})
        save_json(place / "identification.json", self.content)
        self.report(place / "report.html")
        return place

    def __repr__(self) -> str:
        lines = [f"{self.content['title']}: {self.content['model']}", *self.says]
        return "\n".join([*lines, *(f"  {name} = {told}" for name, told in self.parameters.items())])

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(k)}</td><td>{html.escape(str(v))}</td></tr>" for k, v in self.parameters.items()
        )
        said = "".join(f"<li>{html.escape(one)}</li>" for one in self.says)
        return f"<h4>{html.escape(str(self.content['title']))}</h4><ul>{said}</ul><table>{rows}</table>"


def load_identification(folder: Path) -> IdentificationResult:
    """Return the identification that was saved into a folder; `DataError` where it is absent or damaged."""
    content = load_json(folder / "identification.json", AGAIN)
    import h5netcdf

    with h5netcdf.File(folder / "posterior.nc", "r") as file:
        names = list(file.groups)
    groups = {name: load_arrays(folder / "posterior.nc", AGAIN, group=name) for name in names}
    return IdentificationResult(content, groups)
