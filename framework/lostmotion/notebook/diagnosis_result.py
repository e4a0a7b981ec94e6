"""The result of a diagnosis as an object: sentences, numbers, figures, arrays, and a model that can be simulated."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lostmotion.case import GUESSED
from lostmotion.codec import from_plain
from lostmotion.diagnosis.guest_sections import find_sections
from lostmotion.diagnosis.outcome import Outcome
from lostmotion.diagnosis.report import (
    absent_table,
    diagnosis_page,
    learned_figure,
    missing,
    parameter_figure,
    portraits,
    prediction,
    ranking,
)
from lostmotion.diagnosis.report.page_data import Evidence, make_evidence
from lostmotion.identification.arviz_groups import predict_readings
from lostmotion.inference import mixture
from lostmotion.notebook.answers import DiagnosisAnswer, format_answer
from lostmotion.notebook.machine import FittedModel, make_fitted_model, restore_fitted_model
from lostmotion.registry import Registry, default
from lostmotion.report import style
from lostmotion.results.absent import AbsentTerm
from lostmotion.results.diagnosis import Candidate, Diagnosis
from lostmotion.storage import folder_for, load_arrays, load_json, save_text

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RERUN_HINT = "run `lostmotion diagnose` again"
PREDICTED_DRAWS = 500
"""Number of draws with log-likelihoods and predicted readings in `to_arviz`."""


@dataclass(frozen=True, eq=False)
class DiagnosisPlots:
    """The figures of a diagnosis; each method returns a matplotlib figure, and calling the object the prediction."""

    evidence: Evidence

    def __repr__(self) -> str:
        return (
            "<figures of a diagnosis: .prediction(), .missing_force(), .ranking(), .parameters(), .sections(),"
            " .learned_force(), .absent()>"
        )

    def __call__(self) -> Figure:
        """Return the recording with free runs over held-out data, before and after."""
        return self.prediction()

    def prediction(self, ax: Axes | None = None) -> Figure:
        """Return the recording with free runs over held-out data, before and after; with `ax`, draw into these axes."""
        if ax is None:
            return self._draw(prediction.draw)
        with style.use_style(self.evidence.result.units.angle):
            prediction.draw_window(ax, self.evidence, prediction.choose_window(self.evidence))
            ax.legend()
        return ax.get_figure(root=True)  # type: ignore[return-value]

    def missing_force(self) -> Figure:
        """Return the force that the model does not explain, over the covariates on which it may depend."""
        return self._draw(missing.draw)

    def ranking(self) -> Figure:
        """Return the candidates with their gains in log evidence and their probabilities."""
        return self._draw(ranking.draw)

    def parameters(self) -> Figure:
        """Return the posterior densities of the parameters, before and after."""
        return self._draw(parameter_figure.draw)

    def sections(self) -> Figure:
        """Return phase portraits and Poincare sections of recording and models."""
        return self._draw(portraits.draw)

    def learned_force(self) -> Figure:
        """Return the learned force with its band, or an empty figure without one."""
        return self._draw(learned_figure.draw)

    def absent(self) -> Figure:
        """Return the upper bounds of what is not missing, as shares of the drive."""
        return self._draw(absent_table.draw)

    def _draw(self, draw: Callable[[Evidence], Figure | None]) -> Figure:
        """Return a figure, or a figure with a short text where there is nothing to draw."""
        with style.use_style(self.evidence.result.units.angle):
            return draw(self.evidence) or style.make_note("there is nothing to draw here")


@dataclass(frozen=True, eq=False)
class DiagnosisResult(DiagnosisAnswer[Diagnosis]):
    """The result of `lostmotion.diagnose`; its representation is the answer in words.

    `result` is the diagnosis with the content of `diagnosis.json`, `arrays` the dataset behind it; `outcome` holds the
    fits behind both, where the diagnosis was made in this session.
    """

    registry: Registry = field(repr=False)
    outcome: Outcome | None = field(default=None, repr=False)

    @property
    def _guesses(self) -> tuple[str, ...]:
        """The notes on what the case supposes."""
        return tuple(note for note in self.notes if note.startswith(GUESSED))

    @property
    def absent(self) -> tuple[AbsentTerm, ...]:
        """The upper bounds of the terms that are not in the model, the smallest share of the drive first."""
        return self.result.absent

    @property
    def ranking(self) -> tuple[Candidate, ...]:
        """All candidates, the most probable first."""
        return self.result.ranking

    @cached_property
    def model(self) -> FittedModel:
        """The fitted model with the found mechanisms: `.simulate(inputs, duration=..., rate=...)` simulates it."""
        if self.outcome is not None:
            return make_fitted_model(self.outcome, self.result.machine)
        return restore_fitted_model(self.result.machine, self.registry)

    @cached_property
    def evidence(self) -> Evidence:
        """The result and its arrays in the form that the figures use."""
        return make_evidence(self.result, self.arrays)

    @property
    def plot(self) -> DiagnosisPlots:
        """The figures: `plot.prediction()`, `.missing_force()`, `.ranking()`, `.parameters()`, `.sections()`."""
        return DiagnosisPlots(self.evidence)

    def to_arviz(self) -> xr.DataTree:
        """Return the groups of ArviZ as a tree: draws of the parameters after (one chain), and the observed data.

        A diagnosis made in this session also has `log_likelihood` and `posterior_predictive`, for leave-one-out
        predictions and their plots, with `PREDICTED_DRAWS` draws over the fitted part of the recording.
        """
        import xarray as xr

        names, predicted = [str(name) for name in self.arrays["parameter_after"].values], self._predict_readings()
        draws, units = np.asarray(self.arrays["posterior_after"], dtype=float), self.parameters_after
        rows = {
            name: (("chain", "draw"), draws[None, :, i], {"units": units[name].unit} if name in units else {})
            for i, name in enumerate(names)
        }
        response = xr.Dataset({"response": ("time", np.asarray(self.arrays["response"], dtype=float))})
        response = response.assign_coords(time=np.asarray(self.arrays["time"], dtype=float))
        coords = {"chain": np.arange(1), "draw": np.arange(len(draws))}
        return xr.DataTree.from_dict(
            {
                "posterior": xr.Dataset(rows, coords),
                "constant_data" if predicted else "observed_data": response,
                **predicted,
            }
        )

    def _predict_readings(self) -> dict[str, Any]:
        """Return the ArviZ groups for the readings, by name; none where the diagnosis was loaded from a folder."""
        if self.outcome is None:
            return {}
        fit, rng = self.outcome.diagnosis.after, np.random.default_rng(0)
        return predict_readings(
            fit.posterior, mixture.draw_posterior(fit, rng, PREDICTED_DRAWS), (1, PREDICTED_DRAWS), rng
        )

    def report(self, path: str | Path = "report.html") -> Path:
        """Write the page as self-contained HTML and return its path."""
        return save_text(Path(path), diagnosis_page.render(self.evidence, find_sections(self.registry)))

    def save(self, folder: str | Path) -> Path:
        """Write `diagnosis.json`, `arrays.nc` and `report.html` into a folder, for `load`, and return it."""
        place = folder_for(Path(folder))
        return diagnosis_page.save_diagnosis(self.evidence, place, find_sections(self.registry))

    def _list_sentences(self) -> Iterator[str]:
        """Yield the answer, the most usual bounds of what is not missing, and what the case supposes."""
        yield from filter(None, (*self.says, absent_table.summarise_absent(self.absent), *self._guesses))

    def __repr__(self) -> str:
        lines = [f"{self.result.title}: {self.verdict}", *self._list_sentences()]
        lines += [f"  {name} = {interval}" for name, interval in self.parameters_after.items()]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        with style.use_style(self.evidence.result.units.angle):
            drawn = prediction.draw(self.evidence)
            figure = style.embed_figure(drawn, "prediction") if drawn else ""
        return format_answer(f"{self.result.title}: {self.verdict}", self._list_sentences(), figure)


def load_diagnosis(folder: Path, registry: Registry | None = None) -> DiagnosisResult:
    """Return the diagnosis stored in a folder; raise `DataError` where it is absent or damaged."""
    file = folder / "diagnosis.json"
    result = from_plain(Diagnosis, load_json(file, RERUN_HINT), str(file))
    return DiagnosisResult(result, load_arrays(folder / "arrays.nc", RERUN_HINT), registry or default())
