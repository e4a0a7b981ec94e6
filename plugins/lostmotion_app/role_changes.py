"""Other roles of the columns, where a first case cannot be made of those that are given or found."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from lostmotion.errors import LostMotionError
from lostmotion.recording.outline import GivenRoles, outline_table

_RATE = re.compile(r"give rate = (\d[\d.e+-]*)")


def list_role_changes(
    path: Path, roles: GivenRoles, factors: Mapping[str, float], says: str
) -> list[tuple[str, GivenRoles]]:
    """Return other roles with which the recording can be used, each with its words; `says` tells why it cannot now."""
    return [(words, other) for words, other in _list_candidates(path, roles, says) if _is_usable(path, other, factors)]


def _list_candidates(path: Path, roles: GivenRoles, says: str) -> Iterator[tuple[str, GivenRoles]]:
    """Yield a rate in place of uneven times, columns that may drive the machine, and that nothing drives it."""
    from lostmotion.preparation.guessed import find_coherent  # which imports a second of SciPy: the first screen waits

    if stated := _RATE.search(says):
        rate = float(stated[1].rstrip("."))
        yield f"A rate of {rate:g} Hz in place of the time", replace(roles, time=None, rate=rate)
    if "--drive none" in says:
        for column in find_coherent(outline_table(path, roles)):
            yield f"{column.name} drives the machine", replace(roles, drive=column.name)
        yield "Nothing drives the machine", replace(roles, drive="none")


def _is_usable(path: Path, roles: GivenRoles, factors: Mapping[str, float]) -> bool:
    from lostmotion.preparation.guessed import check_guesses

    try:
        check_guesses(outline_table(path, roles), factors, free=roles.drive == "none")
    except LostMotionError:
        return False
    return True
