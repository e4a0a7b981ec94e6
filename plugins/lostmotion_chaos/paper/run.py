"""Makes the requested figures and tables one after another, then the page and the key figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import NamedTuple, cast

from lostmotion.codec import to_plain
from lostmotion.errors import DataError, nearest
from lostmotion.provenance import provenance
from lostmotion.registry import Registry
from lostmotion.storage import folder_for, save_json
from lostmotion_chaos.paper.lab import Lab
from lostmotion_chaos.paper.outcome import PaperOutcome, ReproducedItem, Reproduction
from lostmotion_chaos.paper.page import PageEntry, draw_figure, format_cells, write_index, write_table

Say = Callable[[str], None]


class Item(NamedTuple):
    """A figure or table: its label and title on the page, and the module and function that make it.

    An empty `function` means the function with the name of the item.
    """

    label: str
    title: str
    module: str
    function: str = ""


ITEMS: dict[str, Item] = {
    "table1": Item("Table 1", "The three oscillators and their motions", "portraits"),
    "fig3": Item("Fig. 3", "Phase plots of Cases 1 and 2", "portraits"),
    "fig4": Item("Fig. 4", "Phase plot of Case 3, and in delay coordinates", "portraits"),
    "fig5": Item("Fig. 5", "The normalised force of the backlash", "portraits"),
    "fig6": Item("Fig. 6", "The largest exponent of Case 1 over 1/alpha", "sweeps"),
    "fig7": Item("Fig. 7", "Bifurcation diagrams of Case 1 at seven dampings", "sweeps"),
    "fig8": Item("Fig. 8", "Phase plots of Case 1 at four values of 1/alpha", "portraits"),
    "fig9": Item("Fig. 9", "Poincaré maps of Case 1 at four values of 1/alpha", "portraits"),
    "fig10": Item("Fig. 10", "The largest exponent over 1/alpha and damping", "sweeps"),
    "fig11": Item("Fig. 11", "Case 3 and its mutual information under noise", "noisy"),
    "fig12": Item("Fig. 12", "Poincaré maps of Case 3 under noise", "noisy"),
    "fig13": Item("Fig. 13", "Cao's E1 of Case 3 under noise", "noisy"),
    "fig14": Item("Fig. 14", "Slopes of the correlation sum of Case 3, against surrogates", "noisy"),
    "fig15": Item("Fig. 15", "Poincaré maps after noise reduction", "noisy"),
    "fig16": Item("Fig. 16", "The same, enlarged", "noisy"),
    "fig17": Item("Fig. 17", "Input and output of the joint at 2.68 degrees", "experiment"),
    "fig18": Item("Fig. 18", "Mutual information of the output at 2.68 degrees", "experiment"),
    "fig19": Item("Fig. 19", "Cao's numbers of the output at 2.68 degrees", "experiment"),
    "fig20": Item("Fig. 20", "Delay plots of the output at eight levels", "experiment"),
    "fig21": Item("Fig. 21", "Correlation dimensions of the output, against surrogates", "experiment"),
    "table2": Item("Table 2", "Largest exponents of the output at eight levels", "experiment"),
    "fig22": Item("Fig. 22", "Noise reduction of the output", "experiment"),
    "fig23": Item("Fig. 23", "Cao's number before and after noise reduction", "experiment"),
    "bifurcation": Item("More", "A bifurcation diagram with the exponents below it", "sweeps"),
    "basins": Item("More", "Basins of attraction of Cases 2 and 3", "basins"),
    "section": Item("More", "Poincaré sections coloured by density", "basins"),
    "map": Item("More", "A map of the largest exponent over 1/alpha and damping", "sweeps", "plane_map"),
}
"""All figures and tables, in the order of the page."""


def choose_names(names: Sequence[str]) -> list[str]:
    """Return the requested names in the order of the page; no name, or `all`, means all of them."""
    for name in names:
        if name != "all" and name not in ITEMS:
            raise DataError(f"there is no {name!r} to reproduce{nearest(name, ITEMS)}: take {', '.join(ITEMS)} or all")
    return list(ITEMS) if not names or "all" in names else [name for name in ITEMS if name in names]


def make_outcome(name: str, lab: Lab) -> PaperOutcome:
    """Return the outcome of one figure or table."""
    item = ITEMS[name]
    module = import_module(f"lostmotion_chaos.paper.{item.module}")
    return cast("PaperOutcome", getattr(module, item.function or name)(lab))


def reproduce(names: Sequence[str], out: Path, lab: Lab, say: Say = lambda _step: None) -> Reproduction:
    """Write the figures, the tables, `index.html` and `reproduce.json` into `out`; return the content of the last."""
    wanted, folder = choose_names(names), folder_for(out)
    entries, items = [], {}
    for name in wanted:
        say(ITEMS[name].label)
        found = make_outcome(name, lab)
        entries.append(_write_item(name, found, folder))
        items[name] = ReproducedItem(found.verdict, found.says, found.numbers)
    effort = "Drawn with --quick: short runs and coarse sweeps." if lab.quick else "Drawn with full effort."
    write_index(folder, entries, effort)
    settings = {"names": wanted, "quick": lab.quick}
    result = Reproduction(items, provenance("reproduce", settings, lab.seed, {}))
    save_json(folder / "reproduce.json", to_plain(result))
    return result


def _write_item(name: str, found: PaperOutcome, folder: Path) -> PageEntry:
    """Write the files of a figure or table and return its entry on the page."""
    item = ITEMS[name]
    files = draw_figure(name, found.data, folder) if found.data else ()
    heads, rows = (found.table.heads, format_cells(found.table.rows)) if found.table else ((), ())
    files += write_table(name, heads, rows, folder) if rows else ()
    return PageEntry(name, item.label, item.title, found.verdict, found.says, files, heads, rows)


def make_laboratory(registry: Registry, *, quick: bool, seed: int, jobs: int) -> Lab:
    """Return the shared setting of all figures."""
    return Lab(registry, quick, seed, jobs)
