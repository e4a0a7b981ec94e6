"""The errors that callers may catch; each is a `LostMotionError`.

They derive from each other as follows::

    LostMotionError
    ├── DataError       the recording cannot be used as it is
    │   └── PlaceError  a file cannot be written, or its disk is full: the same work can be repeated elsewhere
    ├── CaseError       the case file contains something that cannot be valid
    ├── ContractError   a plugin breaks the contract of its kind
    └── PluginError     a name is unknown, contested or could not be loaded
        └── AbsentError  no installed package offers a function of `lostmotion`

A message says what was found, what was expected and what to do.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from itertools import islice

COMPARED = 2000
"""The number of known names that `nearest` compares; each costs a comparison of strings."""


class LostMotionError(Exception):
    """Base of all intended errors; the command line prints its message and exits with status 2."""


class DataError(LostMotionError):
    """The recording cannot be used as it is."""


class PlaceError(DataError):
    """A file or folder cannot be written, for instance because its disk is full; existing files are unchanged."""


class CaseError(LostMotionError):
    """The case file contains something that cannot be valid."""


class ContractError(LostMotionError):
    """A plugin breaks the contract of its kind; `plugin` is its name, where that is known."""

    def __init__(self, says: str = "", plugin: str = "") -> None:
        super().__init__(says)
        self.plugin = plugin


class PluginError(LostMotionError):
    """A plugin name is unknown, contested or could not be loaded."""


class AbsentError(PluginError, AttributeError):
    """A function of `lostmotion` that no installed package offers; it is an `AttributeError` too, as Python expects."""


class PluginWarning(UserWarning):
    """A plugin is not used, or is slow, and the run continues; the command line prints the warning as one sentence."""


def nearest(word: str, known: Iterable[str]) -> str:
    """Return ` (did you mean 'x'?)` for the known name closest to `word`, or an empty string."""
    close = difflib.get_close_matches(word[:200], list(islice(known, COMPARED)), n=1, cutoff=0.5)
    return f" (did you mean {close[0]!r}?)" if close else ""
