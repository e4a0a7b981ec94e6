"""The server of the page: on this machine alone, behind a random part of the address, with all its files local."""

from __future__ import annotations

import secrets
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import panel as pn
from bokeh.settings import settings as bokeh_settings
from tornado.ioloop import IOLoop
from tornado.web import RequestHandler

from lostmotion.registry import Registry
from lostmotion_app.folder import MOST_UPLOADED, WorkFolder
from lostmotion_app.page import make_page

HOST = "127.0.0.1"
ROUTE = "/page/open"
"""With two parts, so that Panel finds its files below the random part of the address."""
_REFUSED = (
    "<!doctype html><meta charset=utf-8><title>refused</title><p>This address is refused. Open the whole address that"
    " <code>lostmotion app</code> printed, with its random part."
)


class RefusedRequest(RequestHandler):  # type: ignore[misc]  # Tornado is not typed here
    """The answer to a request outside of the random part of the address: status 403."""

    def prepare(self) -> None:
        """Refuse the request, whatever its method."""
        self.set_status(403)
        self.finish(_REFUSED)


@dataclass(frozen=True)
class PageServer:
    """The server of a folder; `plugins` are the files that the user named on the command line."""

    folder: Path
    registry: Registry
    plugins: tuple[str, ...] = ()
    port: int = 0
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24), repr=False)
    _server: Any = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Bind the port, so that the address is known before the server runs."""
        bokeh_settings.resources = "server"
        pn.config.inline = True
        pn.config.session_token_expiration = 3600
        server = pn.io.server.get_server(
            {ROUTE: lambda: make_page(WorkFolder(self.folder), self.registry, self.plugins)},
            port=self.port,
            address=HOST,
            prefix=self.token,
            title="lostmotion",
            start=False,
            loop=IOLoop.current(),
            default_handler_class=RefusedRequest,
            # base64 adds a third to an upload
            websocket_max_message_size=int(1.4 * MOST_UPLOADED),
            check_unused_sessions_milliseconds=5000,
            unused_session_lifetime_milliseconds=30_000,
        )
        object.__setattr__(self, "_server", server)

    @property
    def address(self) -> str:
        """The address of the page with its random part."""
        return f"http://{HOST}:{self._server.port}/{self.token}{ROUTE}"

    def run(self) -> None:
        """Serve the page until Ctrl+C."""
        self._server.start()
        try:
            self._server.io_loop.start()
        except KeyboardInterrupt:
            self._server.stop()
