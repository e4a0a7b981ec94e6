"""The tables of `docs/validation.md` on real machines, from results of `real_rigs.py`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from judge_rows import SURE
from validation_results import RIGS, Result
from validation_tables import Reasons, make_table, mark


def list_rigs(results: Sequence[Result]) -> list[Result]:
    """Return the results of `real_rigs.py`, the newest version first."""
    return [r for r in results if r.set == RIGS]


def write_rigs(results: Sequence[Result], _: Reasons) -> str:
    """Return the command and the table of what is published and what is said."""
    texts = []
    for result in list_rigs(results)[:1]:
        heads = ("recording", "published", "named above 0.95", "likely or open", "found", "beyond what is published",
                 "held-out error", "processor s")  # fmt: skip
        rows = [
            [
                f"[`{row['key']}`](gallery/{row['page']}.md)",
                row["published"],
                list_names(row, sure=True),
                list_names(row, sure=False),
                f"{sum(row['found'])} of {len(row['found'])}",
                ", ".join(row["further"]).replace("_", " ") or "-",
                " to ".join("not finite" if e is None else f"{100.0 * e:.3g} %" for e in row["errors"]),
                f"{row['cpu']:.0f}",
            ]
            for row in result.rows
        ]
        commands = ", ".join(f"`{command}`" for command in result.commands)
        texts.append(
            f"Version `{result.code}`{mark(result)}, {result.date}. Command: {commands}.\n\n{make_table(heads, rows)}"
        )
    return "\n\n".join(texts) or "None is stored."


def list_names(row: Mapping, *, sure: bool) -> str:
    """Return the names above 0.95, or the others with their probability and state."""
    told = [e for e in row["names"] if (e[1] > SURE and e[2] == "named") == sure]
    return ", ".join(name if sure else f"{name} ({p:.2f}, {state})" for name, p, state in told).replace("_", " ") or "-"


def write_published(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of published values beside the intervals that a diagnosis states."""
    rows = []
    for result in list_rigs(results)[:1]:
        for row in result.rows:
            for key, value, middle, low, high, unit in row["compared"]:
                inside = "yes" if low <= value <= high else f"no, {100.0 * (middle / value - 1.0):+.1f} %"
                rows.append([f"`{row['key']}`", f"`{key}` ({unit})", f"{value:.5g}",
                             f"{middle:.4g} [{low:.4g}, {high:.4g}]", inside])  # fmt: skip
    return make_table(("recording", "parameter", "published", "diagnosis, 95 %", "published value inside"), rows)


RIG_TABLES: Mapping[str, Callable[[Sequence[Result], Reasons], str]] = {
    "rigs": write_rigs,
    "published": write_published,
}
