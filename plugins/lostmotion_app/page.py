"""One page: its screens as tabs, and what it works on, which stands in its address so that a reload finds it again."""

from __future__ import annotations

import html
import logging
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import panel as pn
from panel.theme.base import DarkTheme, DefaultTheme

from lostmotion.registry import Registry
from lostmotion_app.desk import Desk
from lostmotion_app.folder import WorkFolder
from lostmotion_app.look import Look
from lostmotion_app.parts import STYLE, ProblemBox, is_dark, make_html, run_next
from lostmotion_app.policy import POLICY
from lostmotion_app.screens import PageScreen
from lostmotion_app.screens.guest import GuestScreen, list_guests

SCREENS: Mapping[str, str] = {
    "Data": "data:DataScreen",
    "Model": "model:ModelScreen",
    "Check": "check:CheckScreen",
    "Run": "run:RunScreen",
    "Results": "results:ResultsScreen",
    "Take away": "take_away:TakeAwayScreen",
    "Analyse": "analyse:AnalyseScreen",
}
"""The screens by their titles; each is imported when it is opened, so that the first one is there soon."""
WAY = tuple(SCREENS)[:6]
"""The screens from a recording to an answer, in their order."""
LOG = logging.getLogger("lostmotion.app")
BEGINNING = 50
"""Milliseconds after which the first screen is filled: the browser is connected then."""
_SCRIPT = (Path(__file__).parent / "page.js").read_text(encoding="utf-8")
_TEMPLATE = (Path(__file__).parent / "page.html.j2").read_text(encoding="utf-8")


class Page:
    """The screens of one page, of which one is seen."""

    def __init__(self, desk: Desk) -> None:
        self.desk, self.screens = desk, dict[str, PageScreen]()
        self.head, self.fault, self.guests = make_html(), ProblemBox(), list_guests(desk)
        self.titles = [*SCREENS, *self.guests]
        self.tabs = pn.Tabs(
            *((title, pn.Column(sizing_mode="stretch_width")) for title in self.titles),
            sizing_mode="stretch_width",
        )
        wanted = read_query("screen")
        self.tabs.active = self.titles.index(wanted) if wanted in self.titles else 0
        self._fill()
        desk.changed = self.tell
        self.tabs.param.watch(lambda _: self._open(), "active")

    @property
    def title(self) -> str:
        """The title of the screen that is open."""
        return self.titles[int(self.tabs.active)]

    @property
    def view(self) -> Any:
        """The head of the page above its screens."""
        return pn.Column(self.head, self.fault.pane, self.tabs, sizing_mode="stretch_width")

    def begin(self) -> None:
        """Show the state of the first screen, as soon as the page is there."""
        self.screens[self.title].show()
        self._write_head()
        run_next(load_ahead)

    def tell(self) -> None:
        """Show what has changed."""
        self._write_head()

    def tell_fault(self, err: Exception) -> None:
        """Show an error that no screen expects, and log where it was."""
        LOG.error("the page failed", exc_info=err)
        self.fault.tell(f"This failed ({type(err).__name__}: {err}). It is a fault of the page: please report it.")

    def _open(self) -> None:
        """Show the screen that was chosen; Bokeh knows its models before they change."""
        self.fault.tell("")
        self._fill()
        run_next(self.begin)

    def _fill(self) -> None:
        """Make the screen that was chosen, if it was not open before."""
        if self.title not in self.screens:
            self.screens[self.title] = made = self._make_screen()
            self.tabs[self.tabs.active][:] = [made.make_view(), *self._make_next()]

    def _make_screen(self) -> PageScreen:
        """Return the screen that was chosen, that of another package included."""
        if self.title not in SCREENS:
            return GuestScreen(self.desk, self.guests[self.title])
        module, _, name = SCREENS[self.title].partition(":")
        made: PageScreen = getattr(import_module(f"lostmotion_app.screens.{module}"), name)(self.desk)
        return made

    def _make_next(self) -> list[Any]:
        """Return a button that opens the next screen of the way from a recording to an answer."""
        place = int(self.tabs.active) + 1
        if self.title not in WAY[:-1]:
            return []
        button = pn.widgets.Button(name=f"Next: {self.titles[place]}")
        button.on_click(lambda _: setattr(self.tabs, "active", place))
        return [button]

    def _write_head(self) -> None:
        desk, address = self.desk, pn.state.location
        where = " · ".join(filter(None, (desk.folder.root.name, desk.recording)))
        whole = html.escape(str(desk.folder.root), quote=True)
        told = f'<span title="{whole}">{html.escape(where)}</span>'
        self.head.object = f'<div class="lm-head"><h1>lostmotion</h1>{told}</div>'
        if address is not None:
            address.update_query(screen=self.title, recording=desk.recording)


def make_page(folder: WorkFolder, registry: Registry, plugins: tuple[str, ...]) -> Any:
    """Return the page of a folder for one browser."""
    pn.config.design, pn.config.theme = Look, "dark" if read_query("theme") == "dark" else "default"
    page = Page(Desk(folder, registry, plugins, read_query("recording")))
    pn.config.exception_handler = page.tell_fault
    made = pn.Template(_TEMPLATE, theme=DarkTheme if is_dark() else DefaultTheme)
    made.add_variable("policy", POLICY)
    made.add_variable("app_favicon", "data:,")
    made.add_variable("script", _SCRIPT)
    made.add_variable("style", STYLE.replace(":host, :root", ":root"))
    made.add_panel("page", page.view)
    pn.state.onload(lambda: pn.state.add_periodic_callback(page.begin, period=BEGINNING, count=1))
    return made


def load_ahead() -> None:
    """Import what the figures of a recording need, while the user looks at the first screen: it takes 0.5 s."""
    import_module("lostmotion.signals")


def read_query(key: str) -> str:
    """Return a value in the address of this page, empty where it has none."""
    values = pn.state.session_args.get(key) or [b""]
    return str(values[0].decode("utf-8", "replace"))
