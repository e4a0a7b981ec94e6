"""What a diagnosis found, as an object: in words, numbers, figures, arrays, and as a model that can be run."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lostmotion.codec import from_plain, to_plain
from lostmotion.diagnosis.findings import Outcome
from lostmotion.diagnosis.report import learned, missing, page, portraits, posteriors, prediction, ranking
from lostmotion.diagnosis.report.evidence import Evidence, evidence_with
from lostmotion.identification.predictive import predict_readings
from lostmotion.inference import mixture
from lostmotion.notebook.machine import FittedModel, fitted_of, machine_of
from lostmotion.registry import Registry, default
from lostmotion.report import style
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Candidate, Diagnosis, HeldOutScore, Mechanism
from lostmotion.storage import folder_for, load_arrays, load_json, save_datasets, save_json, save_text

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

AGAIN = "run `lostmotion diagnose` again"
PREDICTED = 500
"""Draws of which `to_arviz` tells what they say of the readings."""


@dataclass(frozen=True, eq=False)
class DiagnosisPlots:
    """The figures of a diagnosis; each returns a matplotlib figure, and a bare call the prediction."""

    evidence: Evidence

    def __repr__(self) -> str:
        return (
            "<figures of a diagnosis: .prediction(), .missing_force(), .ranking(), .parameters(), .sections(),"
            " .learned_force()>"
        )

    def __call__(self) -> Figure:
        """Return the recording with free runs over held-out data, before and after."""
        return self.prediction()

    def prediction(self, ax: Axes | None = None) -> Figure:
        """Return the recording with free runs over held-out data, before and after; into `ax` alone where given."""
        if ax is None:
            return self._drawn(prediction.draw)
        with style.applied(self.evidence.result.units.angle):
            prediction.draw_window(ax, self.evidence, prediction.window_of(self.evidence))
            ax.legend()
        return ax.get_figure(root=True)  # type: ignore[return-value]

    def missing_force(self) -> Figure:
        """Return the force that the model does not explain, over what it may depend on."""
        return self._drawn(missing.draw)

    def ranking(self) -> Figure:
        """Return the candidates with the log evidence that each adds, and their probabilities."""
        return self._drawn(ranking.draw)

    def parameters(self) -> Figure:
        """Return the posterior densities of the parameters, before and after."""
        return self._drawn(posteriors.draw)

    def sections(self) -> Figure:
        """Return phase portraits and Poincare sections of recording and models."""
        return self._drawn(portraits.draw)

    def learned_force(self) -> Figure:
        """Return the force that was learned, with its band; an empty figure where none was."""
        return self._drawn(learned.draw)

    def _drawn(self, draw: Callable[[Evidence], Figure | None]) -> Figure:
        """Return a figure; one that says so where there is nothing to be drawn."""
        with style.applied(self.evidence.result.units.angle):
            made = draw(self.evidence)
            if made is None:
                made = style.blank(1.0)
                made.text(0.5, 0.5, "there is nothing to be drawn here", ha="center", va="center")
        return made


@dataclass(frozen=True, eq=False)
class DiagnosisResult:
    """What `lostmotion.diagnose` returns. It shows itself as the answer in words.

    `result` is the diagnosis with all that `diagnosis.json` holds, `arrays` the dataset behind it; `outcome` is what
    both were made of, where it was made in this session.
    """

    result: Diagnosis
    arrays: xr.Dataset
    registry: Registry = field(repr=False)
    outcome: Outcome | None = field(default=None, repr=False)

    @property
    def verdict(self) -> str:
        """Whether the model is "adequate", or there is a "mismatch"."""
        return self.result.verdict

    @property
    def says(self) -> tuple[str, ...]:
        """The answer, in sentences."""
        return self.result.says

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on the recordings and on what makes the answer less certain."""
        return self.result.notes

    @property
    def found(self) -> tuple[Mechanism, ...]:
        """What the model leaves out, what is named first and what is open last."""
        return self.result.found

    @property
    def ranking(self) -> tuple[Candidate, ...]:
        """All candidates, the most probable first."""
        return self.result.ranking

    @property
    def parameters_before(self) -> Mapping[str, Interval]:
        """The parameters of the model as it was, by name."""
        return self.result.parameters.before

    @property
    def parameters_after(self) -> Mapping[str, Interval]:
        """The parameters of the model with what was found, by name."""
        return self.result.parameters.after

    @property
    def heldout(self) -> Mapping[str, HeldOutScore]:
        """What the models "before" and "after" predict of data that no fit has seen."""
        return {"before": self.result.fit.before, "after": self.result.fit.after}

    @cached_property
    def model(self) -> FittedModel:
        """The model with what was found, fitted: `.simulate(inputs, duration=..., rate=...)` sets it in motion."""
        if self.outcome is not None:
            return fitted_of(self.outcome, self.result.machine)
        return machine_of(self.result.machine, self.registry)

    @cached_property
    def evidence(self) -> Evidence:
        """The result and its arrays as figures take them."""
        return evidence_with(self.result, self.arrays)

    @property
    def plot(self) -> DiagnosisPlots:
        """The figures: `plot.prediction()`, `.missing_force()`, `.ranking()`, `.parameters()`, `.sections()`."""
        return DiagnosisPlots(self.evidence)

    def to_dict(self) -> dict[str, Any]:
        """Return the content of `diagnosis.json`."""
        made: dict[str, Any] = to_plain(self.result)
        return made

    def to_xarray(self) -> xr.Dataset:
        """Return the arrays behind the diagnosis, with units and coordinates."""
        return self.arrays

    def to_arviz(self) -> Any:
        """Return ArviZ's `InferenceData`: draws of the parameters after (one chain), and what was observed.

        Of a diagnosis that was made in this session there are `log_likelihood` and `posterior_predictive` beside them,
        for `arviz.loo` and `arviz.plot_ppc`: of `PREDICTED` draws, over the part of the recording that was fitted.
        """
        import arviz

        names = [str(name) for name in self.arrays["parameter_after"].values]
        draws, predicted = np.asarray(self.arrays["posterior_after"], dtype=float), self._predicted()
        response = {"response": np.asarray(self.arrays["response"], dtype=float)}
        made = arviz.from_dict(
            posterior={name: draws[None, :, i] for i, name in enumerate(names)},
            observed_data=None if predicted else response,
            constant_data=response if predicted else None,
            dims={"response": ["time"]},
            coords={"time": np.asarray(self.arrays["time"], dtype=float)},
        )
        for name, told in self.parameters_after.items():
            if name in made.posterior:
                made.posterior[name].attrs["units"] = told.unit
        made.add_groups(predicted)
        return made

    def _predicted(self) -> dict[str, Any]:
        """Return the groups of ArviZ on the readings, by name; none where the diagnosis was loaded from a folder."""
        if self.outcome is None:
            return {}
        fit, rng = self.outcome.diagnosis.after, np.random.default_rng(0)
        return predict_readings(fit.problem, mixture.draws(fit, rng, PREDICTED), (1, PREDICTED), rng)

    def report(self, path: str | Path = "report.html") -> Path:
        """Return the path of the page that was written: self-contained HTML."""
        return save_text(Path(path), page.render(self.evidence))

    def save(self, folder: str | Path) -> Path:
        """Return the folder into which `diagnosis.json`, `arrays.nc` and `report.html` were written, for `load`."""
        place = folder_for(Path(folder))
        save_datasets(place / "arrays.nc", {None: self.arrays})
        save_json(place / "diagnosis.json", self.to_dict())
        self.report(place / "report.html")
        return place

    def __repr__(self) -> str:
        lines = [f"{self.result.title}: {self.verdict}", *self.says]
        lines += [f"  {name} = {told}" for name, told in self.parameters_after.items()]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        said = "".join(f"<li>{html.escape(one)}</li>" for one in self.says)
        with style.applied(self.evidence.result.units.angle):
            drawn = prediction.draw(self.evidence)
            figure = style.embedded(drawn, "prediction") if drawn else ""
        title = html.escape(self.result.title)
        return f"<h4>{title}: {html.escape(self.verdict)}</h4><ul>{said}</ul>{figure}"


def load_diagnosis(folder: Path, registry: Registry | None = None) -> DiagnosisResult:
    """Return the diagnosis that was saved into a folder; `DataError` where it is absent or damaged."""
    file = folder / "diagnosis.json"
    result = from_plain(Diagnosis, load_json(file, AGAIN), str(file))
    return DiagnosisResult(result, load_arrays(folder / "arrays.nc", AGAIN), registry or default())
