"""The one door to the page templates, and what a page is made of."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Generic, NamedTuple, TypeVar

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup
from matplotlib.figure import Figure

from lostmotion.errors import DataError, LostMotionError
from lostmotion.report import style
from lostmotion.report.words import DASH, typeset
from lostmotion.storage import save_text

E = TypeVar("E")


class Grid(NamedTuple):
    """A table of a page: headings, and as many words in each row."""

    head: list[str]
    rows: list[list[str]]


def trimmed(head: list[str], rows: list[list[str]]) -> Grid:
    """Return the table without rows and columns in which nothing but the name stands."""
    rows = [row for row in rows if set(row[1:]) - {DASH, ""}]
    kept = [column for column in range(len(head)) if column == 0 or any(row[column] not in (DASH, "") for row in rows)]
    return Grid([head[k] for k in kept], [[row[k] for k in kept] for row in rows])


class PageSection(NamedTuple, Generic[E]):
    """A section of a page: its name there, its title, and functions that draw and say it.

    `words` stand above the figure, `caption` below it, then the `table`, of which `look` is a class of the style sheet.
    """

    name: str
    title: str | Callable[[E], str]
    draw: Callable[[E], Figure | None] = lambda _: None
    caption: Callable[[E], str] = lambda _: ""
    table: Callable[[E], Grid | None] = lambda _: None
    words: Callable[[E], str] = lambda _: ""
    look: str = "tight"


class DrawnSection(NamedTuple):
    """A section as the template takes it: markup is empty where there was nothing to draw."""

    name: str
    title: str
    markup: Markup
    caption: str
    table: Grid | None = None
    words: str = ""
    look: str = "tight"


def drawn(sections: Sequence[PageSection[E]], evidence: E) -> Iterator[DrawnSection]:
    """Yield the sections that have a figure, a table with rows, or words."""
    for one in sections:
        figure, table, words = one.draw(evidence), one.table(evidence), one.words(evidence)
        if figure is None and not (table and table.rows) and not words:
            continue
        title = one.title if isinstance(one.title, str) else one.title(evidence)
        # The markup is drawn by matplotlib, which escapes the words it is given.
        markup = style.embedded(figure, one.name) if figure else Markup()
        yield DrawnSection(one.name, title, markup, one.caption(evidence) if figure else "", table, words, one.look)


def written(page: Path, render: Callable[[], str], source: str) -> Path:
    """Return the path of a page once it is on the disk, whole; facts that no command wrote are refused.

    `source` names the file of facts and the command that writes it.
    """
    try:
        text = render()
    except LostMotionError:
        raise
    except Exception as err:  # a file that somebody changed can be wrong in every way there is
        said = f"{type(err).__name__}: {str(err).partition(chr(10))[0][:120]}"
        raise DataError(f"{page} cannot be drawn ({said}): {source}") from err
    return save_text(page, text)


def template(name: str, package: str) -> Template:
    """Return a page template that escapes every string and stumbles over every name it does not know.

    It lies in a `package`, and may include what all pages share, such as the frame and the style sheet.
    """
    folders = dict.fromkeys((package, "lostmotion.report"))
    pages = Environment(
        loader=ChoiceLoader([PackageLoader(folder, ".") for folder in folders]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    pages.filters["typeset"] = typeset
    return pages.get_template(name)
