"""The errors a caller may meet; every one is a `LostMotionError`.

    LostMotionError
    ├── DataError       the recording cannot be used as it is
    │   └── PlaceError  a place cannot be written, or its disk is full: the work is sound, and can be done again
    ├── CaseError       the case file says something that cannot be meant
    ├── ContractError   a plugin breaks the contract of its kind
    └── PluginError     a name is unknown, contested or could not be loaded

A message says what was found, what was wanted and what to do.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from itertools import islice

MOST = 2000
"""Known names among which the nearest one is sought: each costs a comparison."""


class LostMotionError(Exception):
    """Base of all errors raised on purpose; the command line turns it into exit status 2."""


class DataError(LostMotionError):
    """The recording cannot be used as it is."""


class PlaceError(DataError):
    """A file or folder cannot be written, for instance since its disk is full; nothing that stood there is touched."""


class CaseError(LostMotionError):
    """The case file says something that cannot be meant."""


class ContractError(LostMotionError):
    """A plugin breaks the contract of its kind; `plugin` is the name of the sinner, where it is known."""

    def __init__(self, says: str = "", plugin: str = "") -> None:
        super().__init__(says)
        self.plugin = plugin


class PluginError(LostMotionError):
    """A plugin name is unknown, contested or could not be loaded."""


class PluginWarning(UserWarning):
    """A plugin was set aside, or is slow, and the rest goes on; the command line shows it as one sentence."""


def nearest(word: str, known: Iterable[str]) -> str:
    """Return ` (did you mean 'x'?)` for the known name closest to `word`, or an empty string."""
    close = difflib.get_close_matches(word[:200], list(islice(known, MOST)), n=1, cutoff=0.5)
    return f" (did you mean {close[0]!r}?)" if close else ""
