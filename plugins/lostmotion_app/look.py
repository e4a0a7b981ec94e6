"""The look of the widgets of Panel on this page."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import panel as pn
from panel.theme.base import Inherit
from panel.theme.native import Native
from panel.widgets import Widget

_SHEETS = {"stylesheets": [Inherit, (Path(__file__).parent / "widgets.css").read_text(encoding="utf-8")]}


class Look(Native):  # type: ignore[misc]  # Panel is not typed here
    """The plain look of Panel, with arrows and tabs that are seen on a dark page, and without room for hidden tabs."""

    modifiers: ClassVar = {Widget: _SHEETS, pn.Tabs: _SHEETS}
