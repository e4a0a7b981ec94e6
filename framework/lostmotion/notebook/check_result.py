"""The check of a case before the fit as an object: sentences, numbers, a figure, and the page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from lostmotion.diagnosis.report import check_page as drawing
from lostmotion.notebook.answers import Answer, format_answer
from lostmotion.report import style
from lostmotion.results import Interval
from lostmotion.results.expectation import CaseCheck, Detection, Improvement, ParameterPair, WrongScale
from lostmotion.storage import folder_for, load_result, save_json, save_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILE = "check.json"


@dataclass(frozen=True)
class CheckPlots:
    """The figure of a check; calling the object draws it."""

    result: CaseCheck

    def __repr__(self) -> str:
        return "<figures of a check: .effects()>"

    def __call__(self) -> Figure:
        """Return the smallest sizes of terms that would be named, as shares of the drive."""
        return self.effects()

    def effects(self) -> Figure:
        """Return the smallest sizes of terms that would be named, as shares of the drive."""
        with style.use_style(self.result.angle):
            made = drawing.draw_effects(self.result.expected, self.result.yardstick)
            return made or style.make_note("no force would be named")


@dataclass(frozen=True)
class CheckResult(Answer[CaseCheck]):
    """The result of `lostmotion.check`; its representation is the answer in words.

    `result` is the content of `check.json`.
    """

    @property
    def parameters(self) -> Mapping[str, Interval]:
        """The nominal value and the expected 95 % interval of each estimated parameter, by name."""
        return self.result.expected.parameters

    @property
    def scales(self) -> tuple[WrongScale, ...]:
        """The columns whose scale does not fit the model, the most likely one first."""
        return self.result.scales

    @property
    def pairs(self) -> tuple[ParameterPair, ...]:
        """The pairs of parameters that this recording hardly tells apart."""
        return self.result.expected.pairs

    @property
    def effects(self) -> tuple[Detection, ...]:
        """The smallest size of each term that would be named, the smallest share of the drive first."""
        return self.result.expected.effects

    @property
    def improvements(self) -> tuple[Improvement, ...]:
        """Changes of the experiment that would help, the best first."""
        return self.result.improvements

    @property
    def plot(self) -> CheckPlots:
        """The figure: `plot.effects()`."""
        return CheckPlots(self.result)

    def report(self, path: str | Path = "check.html") -> Path:
        """Write the page as self-contained HTML and return its path."""
        return save_text(Path(path), drawing.render_check(self.result))

    def save(self, folder: str | Path) -> Path:
        """Write `check.json` and `check.html` into a folder, for `load`, and return it."""
        place = folder_for(Path(folder))
        save_json(place / FILE, self.to_dict())
        self.report(place / "check.html")
        return place

    def __repr__(self) -> str:
        return "\n".join([f"{self.result.title}: {self.result.model}", *self.says])

    def _repr_html_(self) -> str:
        with style.use_style(self.result.angle):
            drawn = drawing.draw_effects(self.result.expected, self.result.yardstick, most=drawing.SHOWN)
            figure = style.embed_figure(drawn, "effects") if drawn else ""
        return format_answer(f"{self.result.title}: check before the fit", self.says, figure)


def load_check(folder: Path) -> CheckResult:
    """Return the check stored in a folder; raise `DataError` where it is absent or damaged."""
    return CheckResult(load_result(CaseCheck, folder / FILE, drawing.RERUN_HINT))
