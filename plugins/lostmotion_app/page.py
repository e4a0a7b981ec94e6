"""One page: its screens as tabs, and what it works on, which stands in its address so that a reload finds it again."""

from __future__ import annotations

import html
from pathlib import Path
from typing import Any

import panel as pn

from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT
from lostmotion_app.desk import Desk
from lostmotion_app.folder import WorkFolder
from lostmotion_app.parts import STYLE, make_html
from lostmotion_app.policy import POLICY
from lostmotion_app.screens import Screen
from lostmotion_app.screens.data import DataScreen

SCREENS: tuple[type[Screen], ...] = (DataScreen,)
_TEMPLATE = (Path(__file__).parent / "page.html.j2").read_text(encoding="utf-8")


class Page:
    """The screens of one page, of which one is seen."""

    def __init__(self, desk: Desk) -> None:
        self.desk, self.screens = desk, [made(desk) for made in SCREENS]
        self.head = make_html()
        self.tabs = pn.Tabs(
            *((one.title, pn.Column(sizing_mode="stretch_width")) for one in self.screens),
            sizing_mode="stretch_width",
            dynamic=True,
        )
        desk.changed = self.tell
        self.tabs.param.watch(self._open, "active")

    @property
    def view(self) -> Any:
        """The head of the page above its screens."""
        return pn.Column(self.head, self.tabs, sizing_mode="stretch_width")

    def begin(self) -> None:
        """Open the screen and the recording that the address of the page names."""
        asked = {key: values[0].decode("utf-8", "replace") for key, values in pn.state.session_args.items() if values}
        self.desk.recording = asked.get("recording", "")
        titles = [one.title for one in self.screens]
        active = titles.index(asked["screen"]) if asked.get("screen") in titles else 0
        if self.tabs.active != active:
            self.tabs.active = active  # which opens it
        else:
            self._open(None)

    def tell(self) -> None:
        """Show what has changed."""
        self._write_head()

    def _open(self, _: Any) -> None:
        """Show the screen that was chosen."""
        screen, place = self.screens[self.tabs.active], self.tabs[self.tabs.active]
        if not len(place):
            place[:] = [screen.make_view()]
        screen.show()
        self._write_head()

    def _write_head(self) -> None:
        desk, address = self.desk, pn.state.location
        where = " · ".join(filter(None, (str(desk.folder.root), desk.recording)))
        self.head.object = f'<div class="lm-head"><b>lostmotion</b><span>{html.escape(where)}</span></div>'
        if address is not None:
            address.update_query(screen=self.screens[self.tabs.active].title, recording=desk.recording)


def make_page(folder: WorkFolder, registry: Registry, plugins: tuple[str, ...]) -> Any:
    """Return the page of a folder for one browser."""
    pn.config.theme = "dark" if _asked("theme") == "dark" else "default"
    page = Page(Desk(folder, registry, plugins, hold=DEFAULT.heldout.share))
    made = pn.Template(_TEMPLATE)
    made.add_variable("policy", POLICY)
    made.add_variable("app_favicon", "data:,")
    made.add_variable("style", STYLE.replace(":host, :root", ":root"))
    made.add_panel("page", page.view)
    pn.state.onload(page.begin)
    return made


def _asked(key: str) -> str:
    values = pn.state.session_args.get(key) or [b""]
    return str(values[0].decode("utf-8", "replace"))
