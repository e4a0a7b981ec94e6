"""All that was asked for, one after another: pictures, tables, the page and the key figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple, cast

from lostmotion.errors import DataError, nearest
from lostmotion.provenance import provenance
from lostmotion.registry import Registry
from lostmotion.report.paper_page import Entry, cells, drawn, tabled, write_index
from lostmotion.reproduce.lab import Lab
from lostmotion.reproduce.outcome import Outcome
from lostmotion.storage import folder_for, save_json

Say = Callable[[str], None]


class Item(NamedTuple):
    """A figure or table: its label and title on the page, and the module that makes it."""

    label: str
    title: str
    module: str


ITEMS: dict[str, Item] = {
    "table1": Item("Table 1", "The three oscillators, and what they do", "portraits"),
    "fig3": Item("Fig. 3", "Phase plots of Cases 1 and 2", "portraits"),
    "fig4": Item("Fig. 4", "Phase plot of Case 3, and in delay coordinates", "portraits"),
    "fig5": Item("Fig. 5", "The normalised force of the backlash", "portraits"),
    "fig8": Item("Fig. 8", "Phase plots of Case 1 at four values of 1/alpha", "portraits"),
    "fig9": Item("Fig. 9", "Poincaré maps of Case 1 at four values of 1/alpha", "portraits"),
}
"""Everything that can be asked for, in the order of the page."""


def chosen(names: Sequence[str]) -> list[str]:
    """Return the names asked for in the order of the page; none, or `all`, is all of them."""
    for name in names:
        if name != "all" and name not in ITEMS:
            raise DataError(f"there is no {name!r} to reproduce{nearest(name, ITEMS)}: take {', '.join(ITEMS)} or all")
    return list(ITEMS) if not names or "all" in names else [name for name in ITEMS if name in names]


def outcome_of(name: str, lab: Lab) -> Outcome:
    """Return the outcome of one figure or table."""
    module = import_module(f"lostmotion.reproduce.{ITEMS[name].module}")
    return cast("Outcome", getattr(module, name)(lab))


def reproduce(names: Sequence[str], out: Path, lab: Lab, say: Say = lambda _step: None) -> dict[str, Any]:
    """Return the content of `reproduce.json` after writing it, the figures, the tables and `index.html` into `out`."""
    wanted, folder = chosen(names), folder_for(out)
    entries, content = [], {}
    for name in wanted:
        say(ITEMS[name].label)
        found = outcome_of(name, lab)
        entries.append(_written(name, found, folder))
        content[name] = {"verdict": found.verdict, "says": found.says, "numbers": dict(found.numbers)}
    effort = "Drawn with --quick: short runs and coarse sweeps." if lab.quick else "Drawn with full effort."
    write_index(folder, entries, effort)
    settings = {"names": wanted, "quick": lab.quick}
    result = {"items": content, "provenance": provenance("reproduce", settings, lab.seed, {})}
    save_json(folder / "reproduce.json", result)
    return result


def _written(name: str, found: Outcome, folder: Path) -> Entry:
    """Return the entry of a figure or table whose files are written."""
    item = ITEMS[name]
    files = drawn(name, found.data, folder) if found.data else ()
    heads, rows = (found.table.heads, cells(found.table.rows)) if found.table else ((), ())
    files += tabled(name, heads, rows, folder) if rows else ()
    return Entry(name, item.label, item.title, found.verdict, found.says, files, heads, rows)


def laboratory(registry: Registry, *, quick: bool, seed: int, jobs: int) -> Lab:
    """Return the laboratory in which all figures are made."""
    return Lab(registry, quick, seed, jobs)
