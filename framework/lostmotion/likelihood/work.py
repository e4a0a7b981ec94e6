"""The work that the filters of this process have done, which does not depend on the load of the machine.

A search that ends after some processor time would give other answers on a busy machine than on an idle one.
"""

from __future__ import annotations

import threading

_LOCK = threading.Lock()
_DONE = [0]


def add_work(steps: int) -> None:
    """Count steps of filters: those of all points, times the number of states. Lanes without a point count as well."""
    with _LOCK:
        _DONE[0] += steps


def count_work() -> int:
    """Return the number of steps that all filters of this process have done."""
    return _DONE[0]
