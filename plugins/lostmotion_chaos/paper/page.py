"""Writes the page with every figure and table of the paper and its verdict, and the tables as files."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion.report.pages import load_template
from lostmotion.storage import whole
from lostmotion_chaos.paper import draw_basins as paper_basins
from lostmotion_chaos.paper import draw_curves as paper_curves
from lostmotion_chaos.paper import draw_portraits as paper_portraits
from lostmotion_chaos.paper import draw_sweeps as paper_sweeps
from lostmotion_chaos.paper import style as paper_style
from lostmotion_chaos.paper.drawings import Drawing

DRAWINGS: Mapping[str, Callable[..., Figure]] = {
    **paper_portraits.FIGURES,
    **paper_sweeps.FIGURES,
    **paper_basins.FIGURES,
    **paper_curves.FIGURES,
}


@dataclass(frozen=True)
class PageEntry:
    """One figure or table on the page."""

    name: str
    label: str
    title: str
    verdict: str
    says: str
    files: tuple[str, ...]
    heads: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()

    @property
    def kind(self) -> str:
        """Return the CSS class of the badge."""
        return {"reproduced": "good", "not reproduced": "bad"}.get(self.verdict, "part")

    @property
    def image(self) -> str:
        """Return the file name of the picture, or an empty text if there is none."""
        return next((name for name in self.files if name.endswith(".png")), "")


def draw_figure(name: str, data: Drawing, folder: Path) -> tuple[str, ...]:
    """Draw the figure `name` and return the names of its files."""
    with style.use_style():
        return tuple(paper_style.save_figure(DRAWINGS[name](data), folder, name))


def format_cells(rows: tuple[tuple[str | float, ...], ...]) -> tuple[tuple[str, ...], ...]:
    """Return the rows with every cell as text."""
    return tuple(tuple(x if isinstance(x, str) else f"{x:.6g}" for x in row) for row in rows)


def write_table(name: str, heads: tuple[str, ...], rows: tuple[tuple[str, ...], ...], folder: Path) -> tuple[str, ...]:
    """Write a table as CSV and Markdown and return the names of the files."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([heads, *rows])
    lines = [f"| {' | '.join(row)} |" for row in (heads, tuple("---" for _ in heads), *rows)]
    for ending, content in (("csv", text.getvalue()), ("md", "\n".join(lines) + "\n")):
        with whole(folder / f"{name}.{ending}") as spare:
            spare.write_text(content, encoding="utf-8")
    return f"{name}.csv", f"{name}.md"


def write_index(folder: Path, entries: list[PageEntry], effort: str) -> Path:
    """Write `index.html` into the folder of the pictures that it shows, and return its path."""
    page = folder / "index.html"
    counts = {e.verdict: sum(x.verdict == e.verdict for x in entries) for e in entries}
    with whole(page) as spare:
        spare.write_text(
            load_template("page.html.j2", __package__).render(
                entries=entries, counts=sorted(counts.items()), effort=effort
            ),
            encoding="utf-8",
        )
    return page
