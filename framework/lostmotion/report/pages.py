"""The one door to the page templates, and what a page is made of."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from matplotlib.figure import Figure

from lostmotion.report.evidence import Evidence


class Section(NamedTuple):
    """One figure of a page: its name there, heading, drawing (None where its arrays are absent) and caption."""

    name: str
    title: str
    draw: Callable[[Evidence], Figure | None]
    caption: Callable[[Evidence], str]


def template(name: str) -> Template:
    """Return a page template that escapes every string and stumbles over every name it does not know."""
    pages = Environment(
        loader=PackageLoader("lostmotion.report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return pages.get_template(name)
