"""The tables of `docs/validation.md` that compare lostmotion with other tools, from results of `beside_peers.py`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from beside_peers import OURS
from peers_sindy import LAWS
from validation_results import PEERS, Result, split_rows
from validation_tables import Reasons, format_seconds, make_table, mark

MOST = 10.0
"""A larger held-out error is not written as a number."""


def list_compared(results: Sequence[Result]) -> list[Result]:
    """Return the results of `beside_peers.py`, the one with the most machines first."""
    return sorted((r for r in results if r.set == PEERS), key=lambda r: r.of, reverse=True)


def list_tools(result: Result) -> dict[str, list[dict]]:
    """Return the rows of each tool, in the order of the run."""
    groups = split_rows(result.rows, lambda row: row["tool"])
    return {tool: groups[tool] for tool in dict.fromkeys(row["tool"] for row in result.rows)}


def write_peers(results: Sequence[Result], _: Reasons) -> str:
    """Return the commands, and the table of what each tool finds, its errors and its processor time."""
    texts = []
    for result in list_compared(results):
        rows = []
        for tool, own in list_tools(result).items():
            errors = [np.inf if row["error"] is None else row["error"] for row in own]
            middle, most = map(format_error, (np.median(errors), max(errors)))
            seconds = format_seconds([row["cpu"] for row in own if row["cpu"] is not None])
            counts = [sum(row["found"] for row in own), sum(row["of"] for row in own)]
            false = sum(bool(row["false"]) for row in own)
            wild = sum(row["wild"] > 0.0 for row in own)
            rows.append([tool, "{} of {}".format(*counts), f"{false} of {len(own)}", middle, most, f"{wild}", seconds])
        heads = ("tool", "hidden effects found", "machines with a false term", "held-out error: median", "largest",
                 "machines with runs that diverge", "processor s: median, largest")  # fmt: skip
        texts.append(
            f"Machines `{result.machines}`, version `{result.code}`{mark(result)}, {result.date}. Commands:"
            f" {', '.join(f'`{command}`' for command in result.commands)}.\n\n{make_table(heads, rows)}"
        )
    return "\n\n".join(texts)


def write_peer_errors(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the held-out errors and terms on each machine, a column for each tool."""
    texts = []
    for result in list_compared(results):
        tools = list(list_tools(result))
        rows = []
        for key, own in split_rows(result.rows, lambda row: row["key"]).items():
            cells = {row["tool"]: format_cell(row) for row in own}
            hidden = ", ".join(own[0]["hidden"]).replace("_", " ") or "nothing"
            rows.append([key, hidden, *(cells.get(tool, "-") for tool in tools)])
        texts.append(make_table(("machine", "hidden", *tools), rows))
    return "\n\n".join(texts)


def format_error(error: float) -> str:
    """Return a held-out error in per cent."""
    return f"{100.0 * error:.2g} %" if error < MOST else f"above {100.0 * MOST:.0f} %"


def format_cell(row: Mapping) -> str:
    """Return error and terms of a tool on a machine; false terms are in italics, the nominal model's are left out."""
    error = "failed" if row["error"] is None else format_error(row["error"])
    error += " (diverges)" if row["wild"] else ""
    own = row["tool"] == OURS
    terms = [(term, (term,) if own else LAWS.get(term, (None, ()))[1]) for term in row["terms"]]
    told = {names[0]: f"*{names[0]}*" if term in row["false"] else names[0] for term, names in terms if names}
    return f"{error}: {', '.join(told.values()).replace('_', ' ')}" if told else error


PEER_TABLES: Mapping[str, Callable[[Sequence[Result], Reasons], str]] = {
    "peers": write_peers,
    "peererrors": write_peer_errors,
}
