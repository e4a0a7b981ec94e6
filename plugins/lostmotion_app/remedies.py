"""Warnings about a case, and their remedies: changes of the case after which a warning is gone.

A change is offered only if the recording, read again with it, has not this warning, and no further one.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass
from difflib import unified_diff
from pathlib import Path
from typing import Any

from lostmotion.errors import CaseError, DataError
from lostmotion.recording.formats import read_table
from lostmotion.recording.load import recording_of
from lostmotion.recording.spec import RecordingSpec
from lostmotion.recording.table import Table
from lostmotion_app.case_content import Content, drop_value_guess, find_guessed_value
from lostmotion_app.desk import Desk
from lostmotion_app.recording_changes import list_changes

_NUMBER = re.compile(r"[-+]?\d[\d.,]*(e[-+]?\d+)?")


@dataclass(frozen=True)
class Remedy:
    """A change of the case: what the button says, and the content of the case with it.

    `parameter` is the parameter whose known value it asks for; empty where it asks for none.
    """

    says: str
    content: Content
    parameter: str = ""

    def fill(self, number: float) -> Content:
        """Return the content with a known value (SI) of the parameter."""
        content = deepcopy(self.content)
        content["model"].get("estimate", {}).pop(self.parameter, None)
        content["model"].setdefault("known", {})[self.parameter] = number
        drop_value_guess(content, self.parameter)
        return content


@dataclass(frozen=True)
class WarnedCase:
    """A warning, and the remedies of which each removes it."""

    says: str
    remedies: tuple[Remedy, ...] = ()


def list_warnings(desk: Desk, table: Table | None = None) -> list[WarnedCase]:
    """Return what the case of the desk supposes, and the warnings about its recordings, with their remedies.

    `table` is that of the first recording, where it is read already. That a recording cannot be used is a warning too.
    Raises `CaseError` for a case that cannot be read.
    """
    content = desk.content
    if not content or desk.is_robot:
        return []
    files = [desk.case.parent / one["file"] for one in content["recordings"]]
    tables: dict[Path, Table] = {} if table is None else {files[0]: table}
    found: dict[tuple[str, ...], WarnedCase] = {}
    for number, (path, spec) in enumerate(zip(files, desk.read_specs(content), strict=True)):
        read = tables[path] = tables.get(path) or read_table(path)
        name = f"{path.name}: " if len(set(files)) > 1 else ""
        for one in _warn_recording(desk, content, number, spec, read):
            same = (name, shape_of(one.says), *(remedy.says for remedy in one.remedies))
            found.setdefault(same, WarnedCase(name + one.says, one.remedies))
    return [*list_guesses(content), *found.values()]


def list_guesses(content: Content) -> Iterator[WarnedCase]:
    """Yield what a first case supposes; the user confirms it, or gives the value that was supposed."""
    for says in content.get("guessed", ()):
        confirmed = deepcopy(content)
        confirmed["guessed"].remove(says)
        if not confirmed["guessed"]:
            del confirmed["guessed"]
        name = find_guessed_value(says)
        asked = (Remedy("Set", content, name),) if name else ()
        yield WarnedCase(f"Supposed: {says}", (*asked, Remedy("Confirm", confirmed)))


def _warn_recording(
    desk: Desk, content: Content, number: int, spec: RecordingSpec, table: Table
) -> Iterator[WarnedCase]:
    """Yield the warnings about one recording of a case."""
    notes, usable = read_notes([spec], table)
    tried, count = [], len(content["recordings"])
    for says, change in list_changes(number, spec, table, notes) if notes else ():
        changed = deepcopy(content)
        change(changed)
        try:
            specs = desk.read_specs(changed)
        except CaseError:
            continue
        left, used = read_notes(specs[number : number + 1 + len(specs) - count], table)
        if is_better(notes, left) or (used and not usable):  # the warnings of an unusable recording are not seen
            tried.append((Remedy(says, changed), set(map(shape_of, left))))
    for note in notes:
        yield WarnedCase(note, tuple(remedy for remedy, left in tried if shape_of(note) not in left))


def read_notes(specs: Sequence[RecordingSpec], table: Table) -> tuple[tuple[str, ...], bool]:
    """Return the warnings about the recordings of one table, and whether they can be used; if not, that is a warning.

    A warning that is the same in several of them is there once.
    """
    notes, usable = dict[str, str](), True
    for spec in specs:
        try:
            found = recording_of(spec, table, Path(spec.file).name, "").notes
        except DataError as err:
            found, usable = (str(err),), False
        for note in found:
            notes.setdefault(shape_of(note), note)
    return tuple(notes.values()), usable


def shape_of(note: str) -> str:
    """Return a warning without its numbers, which may differ where a part of a recording is left out."""
    return _NUMBER.sub("#", note)


def is_better(before: Iterable[str], after: Iterable[str]) -> bool:
    """Return whether at least one warning is gone, and none is new."""
    return set(map(shape_of, after)) < set(map(shape_of, before))


def list_changed_lines(before: str, after: str) -> list[str]:
    """Return the lines of a case that a change takes out (-) and puts in (+)."""
    lines: list[Any] = list(unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0))
    return [line for line in lines[2:] if not line.startswith("@@")]
