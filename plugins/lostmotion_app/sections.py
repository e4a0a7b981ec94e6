"""Sections of the pages that commands write, as HTML of this page: they are drawn by the same functions."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, TypeVar

from lostmotion.report import style
from lostmotion.report.pages import DrawnSection, Grid, PageSection, draw_guests, draw_sections
from lostmotion.report.words import typeset
from lostmotion_app.parts import write_heading, write_note, write_table

E = TypeVar("E")
NONE: Mapping[str, Any] = MappingProxyType({})


def write_grid(grid: Grid, bars: Sequence[float] = (), title: str = "") -> str:
    """Return a table of a report as HTML, with a further column of bars if there are any."""
    return write_table(grid.head, grid.rows, bars, title)


def write_sections(
    sections: Sequence[PageSection[E]],
    evidence: E,
    angle: str,
    guests: Mapping[str, Callable[[], PageSection[E]]] = NONE,
) -> str:
    """Return sections of a page as HTML, those of other packages last; angles are in the unit `angle`."""
    with style.use_style(angle):
        return "".join(map(write_section, [*draw_sections(sections, evidence), *draw_guests(guests, evidence)]))


def write_section(one: DrawnSection) -> str:
    """Return a section as HTML; its figure is markup of matplotlib, which escapes all text."""
    figure = f'<div class="lm-figure">{one.markup}</div>' if one.markup else ""
    caption = write_note(typeset(one.caption)) if one.caption else ""
    words = f"<p>{html.escape(typeset(one.words))}</p>" if one.words else ""
    table = write_grid(one.table) if one.table else ""
    return f"{write_heading(one.title)}{words}{figure}{caption}{table}"
