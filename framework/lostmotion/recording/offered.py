"""Readers of further formats, which packages offer through the hook `lostmotion_readers`."""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module, metadata
from pathlib import Path
from typing import NamedTuple

from lostmotion.errors import DataError
from lostmotion.hookspecs import GROUP
from lostmotion.offers import READER, Host, RefusedError, call_guarded
from lostmotion.recording.table import Table


class OfferedReader(NamedTuple):
    """The reader of one ending: its owner, its function as "package.module:function", and what it needs for pip."""

    owner: str
    target: str
    requirement: str

    def read(self, path: Path) -> Table:
        """Return the table of a file; `DataError` that names the requirement if its library is absent."""
        module, _, function = self.target.partition(":")
        try:
            table = getattr(import_module(module), function)(path)
        except ImportError as err:
            raise DataError(
                f"{path.name}: the library that reads {path.suffix.lower()} files is not installed"
                f" ({err.name or err}): pip install '{self.requirement}', or export the recording as csv"
            ) from err
        if not isinstance(table, Table):
            raise DataError(f"{path.name}: {self.target} of {self.owner} returned no Table: inform its author")
        return table


@lru_cache(maxsize=1)
def offered_readers() -> dict[str, tuple[OfferedReader, ...]]:
    """Return the readers that installed packages offer, by ending; a package that fails offers none."""
    host = Host()
    found: dict[str, tuple[OfferedReader, ...]] = {}
    for point in metadata.entry_points(group=GROUP):
        owner = point.dist.name if point.dist else point.module
        try:
            offers = host.ask(call_guarded(point.load, "it could not be imported"), owner)
        except RefusedError:
            continue  # `lostmotion plugins` states the reason
        for offer in offers:
            if offer.kind == READER:
                ending = offer.name.lower().lstrip(".")
                found[ending] = (*found.get(ending, ()), OfferedReader(owner, offer.target, offer.about))
    return found


def find_offered(ending: str) -> OfferedReader | None:
    """Return the reader of an ending, or None; `DataError` if two packages offer one."""
    readers = offered_readers().get(ending, ())
    if len(readers) > 1:
        owners = " and ".join(one.owner for one in readers)
        raise DataError(f"files that end in {ending!r} are read by {owners}: uninstall one of them")
    return readers[0] if readers else None
