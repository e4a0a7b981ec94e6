"""Access to the entries of a case file by key and type, with errors that name their place."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any
from unicodedata import category

from lostmotion.errors import CaseError, nearest

LONGEST, MOST = 1000, 1000
"""The greatest number of characters of a text, and of tables of one kind."""
_CONTROLS = ("Cc", "Cs", "Zl", "Zp")
_WORDS = {str: "text", bool: "true or false", int: "a number", float: "a number", list: "a list", dict: "a table"}


@dataclass(frozen=True)
class Fields:
    """A table of the case file and its place, for instance `recordings[0].response`."""

    file: str
    place: str
    values: Mapping[str, Any]  # as TOML has them: each is checked when it is read

    def only(self, known: Iterable[str]) -> Fields:
        """Return the table itself; raise `CaseError` for a key that is not among `known`."""
        known = list(known)
        for key in self.values:
            if key not in known:
                raise self.error(f"has the unknown key {key!r}{nearest(key, known)}; known are {', '.join(known)}")
        return self

    def error(self, says: str) -> CaseError:
        """Return an error that names the file and the place; `says` starts with a verb."""
        return CaseError(f"{self.file}: {self.place} {says}")

    def wrong(self, key: str, wanted: str) -> CaseError:
        """Return an error on the value of `key`."""
        value = self.values[key]
        found = f"{_WORDS.get(type(value), type(value).__name__)} ({_format_value(value)})"[:80]
        return self.error(f"has {found} as {key!r}: expected {wanted}")

    def text(self, key: str) -> str:
        """Return a text that is not blank; the key must be there."""
        value = self._get(key, "text in quotes")
        if not isinstance(value, str) or not value.strip():
            raise self.wrong(key, "text in quotes")
        if len(value) > LONGEST or any(category(c) in _CONTROLS for c in value):
            raise self.wrong(key, f"one line of text, {LONGEST} characters at most, without control characters")
        return value

    def path(self, key: str) -> str:
        """Return the name of a file; the key must be there."""
        value = self.text(key)
        if not PurePath(value).name:
            raise self.wrong(key, "the name of a file")
        return value

    def maybe_text(self, key: str) -> str | None:
        """Return a text, or None where the key is absent."""
        return self.text(key) if key in self.values else None

    def number(self, key: str) -> float:
        """Return a finite number; the key must be there."""
        value = self._get(key, "a number")
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= sys.float_info.max:
            raise self.wrong(key, "a finite number, without quotes")
        return float(value)

    def maybe_number(self, key: str) -> float | None:
        """Return a finite number, or None where the key is absent."""
        return self.number(key) if key in self.values else None

    def positive(self, key: str) -> float:
        """Return a number above zero; the key must be there."""
        value = self.number(key)
        if value <= 0:
            raise self.wrong(key, "a positive number")
        return value

    def flag(self, key: str) -> bool:
        """Return true or false; false where the key is absent."""
        value = self.values.get(key, False)
        if not isinstance(value, bool):
            raise self.wrong(key, "true or false, without quotes")
        return value

    def choice(self, key: str, known: Iterable[str]) -> str:
        """Return a text that is among `known`."""
        value, known = self.text(key), list(known)
        if value not in known:
            raise self.error(f"has {key} = {value!r}{nearest(value, known)}: expected one of {', '.join(known)}")
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        """Return a list of texts; empty where the key is absent."""
        value = self.values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(v, str) and v for v in value):
            raise self.wrong(key, 'a list of texts, as ["file.py"]')
        return tuple(value)

    def table(self, key: str) -> Fields:
        """Return a table; the key must be there."""
        value = self._get(key, "a table")
        if not isinstance(value, dict):
            raise self.wrong(key, "a table")
        return Fields(self.file, self._below(key), value)

    def maybe_table(self, key: str) -> Fields:
        """Return a table, empty where the key is absent."""
        return self.table(key) if key in self.values else Fields(self.file, self._below(key), {})

    def tables(self, key: str) -> Iterator[Fields]:
        """Yield the tables of a list that is not empty; the key must be there."""
        value = self._get(key, f"at least one [[{key}]]")
        if not isinstance(value, list) or not value or not all(isinstance(v, dict) for v in value):
            raise self.wrong(key, f"at least one table, headed [[{key}]]")
        if len(value) > MOST:
            raise self.error(f"has {len(value)} [[{key}]], at most {MOST} are read: divide it into several cases")
        for i, entry in enumerate(value):
            yield Fields(self.file, f"{self._below(key)}[{i}]", entry)

    def entries(self, key: str) -> Iterator[Fields]:
        """Yield the tables of a list that may be empty; the key must be there."""
        value = self._get(key, "a list of tables")
        if not isinstance(value, list) or not all(isinstance(v, dict) for v in value):
            raise self.wrong(key, f"a list of tables, as {key} = [ {{ column = ... }} ]")
        for i, entry in enumerate(value[:MOST]):
            yield Fields(self.file, f"{self._below(key)}[{i}]", entry)

    def numbers(self) -> dict[str, float]:
        """Return the whole table as finite numbers."""
        return {key: self.number(key) for key in self.values}

    def _get(self, key: str, wanted: str) -> Any:
        if key not in self.values:
            raise self.error(f"lacks {key!r}: add {wanted}")
        return self.values[key]

    def _below(self, key: str) -> str:
        return key if self.place == "the case" else f"{self.place}.{key}"


def _format_value(value: object) -> str:
    """Return a value as text; "..." for one that is nested too deeply or has too many digits."""
    try:
        return repr(value)
    except (RecursionError, ValueError):
        return "..."
