"""The screens of the page, one in each module."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar

from lostmotion_app.desk import Desk
from lostmotion_app.parts import ProblemBox


class PageScreen(ABC):
    """A screen of the page; `desk` is what the page works on."""

    title: ClassVar[str]

    def __init__(self, desk: Desk) -> None:
        self.desk, self.problem = desk, ProblemBox()

    @abstractmethod
    def make_view(self) -> Any:
        """Return what the screen consists of, once."""

    @abstractmethod
    def show(self) -> None:
        """Show the present state of the desk: the screen has been opened, or the case has changed."""
