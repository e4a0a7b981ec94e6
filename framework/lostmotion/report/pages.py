"""The page templates and the sections of a page. This is the only module that uses Jinja."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Generic, NamedTuple, Protocol, TypeVar, cast

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup
from matplotlib.figure import Figure

from lostmotion.errors import DataError, LostMotionError
from lostmotion.report import style
from lostmotion.report.words import DASH, typeset
from lostmotion.storage import save_text

E = TypeVar("E")


class Grid(NamedTuple):
    """A table of a page: headings, and rows with as many cells."""

    head: list[str]
    rows: list[list[str]]


def trim_table(head: list[str], rows: list[list[str]]) -> Grid:
    """Return the table without rows and columns that contain nothing besides the name."""
    rows = [row for row in rows if set(row[1:]) - {DASH, ""}]
    kept = [column for column in range(len(head)) if column == 0 or any(row[column] not in (DASH, "") for row in rows)]
    return Grid([head[k] for k in kept], [[row[k] for k in kept] for row in rows])


class Provider(Protocol):
    """What a page is drawn from: a result with its arrays."""

    def provides(self, name: str) -> bool:
        """Return whether there is a key of the result or an array of this name that is not empty."""


class PageSection(NamedTuple, Generic[E]):
    """A section of a page: its name, its title, and functions that return its content.

    `words` are above the figure, `caption` is below it, then follows the `table` with the style class `look`. A section
    is left out where a key of the result, or an array, that it `requires` is absent or empty.
    """

    name: str
    title: str | Callable[[E], str]
    draw: Callable[[E], Figure | None] = lambda _: None
    caption: Callable[[E], str] = lambda _: ""
    table: Callable[[E], Grid | None] = lambda _: None
    words: Callable[[E], str] = lambda _: ""
    look: str = "tight"
    requires: tuple[str, ...] = ()


class DrawnSection(NamedTuple):
    """A section in the form for the template; `markup` is empty where there is no figure."""

    name: str
    title: str
    markup: Markup
    caption: str
    table: Grid | None = None
    words: str = ""
    look: str = "tight"


def draw_sections(sections: Sequence[PageSection[E]], evidence: E) -> Iterator[DrawnSection]:
    """Yield the sections that have what they require, and a figure, a table with rows, or words."""
    for one in sections:
        if not all(cast(Provider, evidence).provides(name) for name in one.requires):
            continue
        figure, table, words = one.draw(evidence), one.table(evidence), one.words(evidence)
        if figure is None and not (table and table.rows) and not words:
            continue
        title = one.title if isinstance(one.title, str) else one.title(evidence)
        # The markup comes from matplotlib, which escapes all text.
        markup = style.embed_figure(figure, one.name) if figure else Markup()
        yield DrawnSection(one.name, title, markup, one.caption(evidence) if figure else "", table, words, one.look)


def draw_guests(guests: Mapping[str, Callable[[], PageSection[E]]], evidence: E) -> Iterator[DrawnSection]:
    """Yield the sections of third parties, by name; one that fails says so in words, and the page is complete."""
    for name, load in guests.items():
        try:
            yield from draw_sections([load()], evidence)
        except Exception as err:  # code of a third party
            said = str(err) if isinstance(err, LostMotionError) else f"{type(err).__name__}: {err}"
            yield DrawnSection(
                name, name, Markup(), "", words=f"This section cannot be drawn ({said}): inform its author."
            )


def write_page(page: Path, render: Callable[[], str], source: str) -> Path:
    """Return the path of a page after writing it atomically; raise `DataError` for invalid result files.

    `source` names the result file and the command that writes it, for the message.
    """
    try:
        text = render()
    except LostMotionError:
        raise
    except Exception as err:  # an edited result file can cause many types of error
        said = f"{type(err).__name__}: {str(err).partition(chr(10))[0][:120]}"
        raise DataError(f"{page} cannot be drawn ({said}): {source}") from err
    return save_text(page, text)


def load_template(name: str, package: str) -> Template:
    """Return a page template that escapes every string and raises an error for an unknown name.

    It is in `package`, and may include common parts of all pages, such as the frame and the style sheet.
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
