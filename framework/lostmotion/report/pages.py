"""The one door to the page templates, and what a page is made of."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup
from matplotlib.figure import Figure

from lostmotion.errors import DataError, LostMotionError
from lostmotion.report.evidence import Evidence
from lostmotion.storage import save_text


class Section(NamedTuple):
    """One figure of a page: its name there, heading, drawing (None where its arrays are absent) and caption."""

    name: str
    title: str
    draw: Callable[[Evidence], Figure | None]
    caption: Callable[[Evidence], str]


class DrawnFigure(NamedTuple):
    """A figure as a template takes it."""

    name: str
    title: str
    markup: Markup
    caption: str


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


def template(name: str, package: str = "lostmotion.report") -> Template:
    """Return a page template that escapes every string and stumbles over every name it does not know.

    It lies in a `package`, and may include what lies beside the pages of the framework, such as the style sheet.
    """
    folders = dict.fromkeys((package, "lostmotion.report"))
    pages = Environment(
        loader=ChoiceLoader([PackageLoader(folder, ".") for folder in folders]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return pages.get_template(name)
