"""Limits of size: a file beyond them is refused before memory is allocated for it."""

from __future__ import annotations

from lostmotion.errors import DataError

NUMBERS = 32_000_000
"""Numbers in one file: 256 MiB in memory, of which a reader holds three or four copies for a moment."""
COLUMNS = 10_000
LINE = 2**20
"""Characters in one line of a table."""
MEMBERS = 10_000
"""Arrays in one file."""
TEXT = 64 * 2**20
"""Bytes of a file whose reader holds the whole text in memory (UFF)."""


def check_numbers(count: float, source: str) -> None:
    """Raise `DataError` for a file of more than `NUMBERS` numbers."""
    if count > NUMBERS:
        raise DataError(
            f"{source} holds {count:.3g} numbers, at most {NUMBERS:.3g} are read: "
            "cut the recording, or export fewer columns"
        )


def check_bytes(size: int, source: str, most: int = 8 * NUMBERS) -> None:
    """Raise `DataError` for a file of more than `most` bytes after decompression."""
    if size > most:
        raise DataError(
            f"{source} holds {size / 2**20:.3g} MiB, at most {most / 2**20:.3g} are read: "
            "cut the recording, or export fewer columns"
        )


def check_count(count: int, what: str, source: str) -> None:
    """Raise `DataError` for a file of more than `MEMBERS` arrays."""
    if count > MEMBERS:
        raise DataError(f"{source} holds {count} {what}, at most {MEMBERS} are read: export the recording by itself")


def check_columns(count: int, source: str) -> None:
    """Raise `DataError` for a table of more than `COLUMNS` columns."""
    if count > COLUMNS:
        raise DataError(
            f"{source} names {count} columns, at most {COLUMNS} are read: are rows and columns exchanged? "
            "Write one line for each sample"
        )


def check_line(length: int, source: str) -> None:
    """Raise `DataError` for a line of more than `LINE` characters."""
    if length > LINE:
        raise DataError(
            f"{source} has a line of {length} characters, at most {LINE} are read: are rows and columns "
            "exchanged? Write one line for each sample"
        )
