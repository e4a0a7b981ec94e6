"""What a batch says of its cases: one row for each, by which a thousand machines can be sorted, and a few lines."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from lostmotion.storage import whole

SUMMARY = "summary.csv"
DIAGNOSED, ASIDE = "diagnosed", "set aside"
COLUMNS = (
    "case", "status", "verdict", "mechanisms", "probability", "share_of_drive", "unexplained_share",
    "heldout_before", "heldout_after", "noise_floor", "moved", "moved_before", "moved_after", "moved_by", "says",
)  # fmt: skip

Row = Mapping[str, Any]


def row_of(name: str, content: Mapping[str, Any]) -> dict[str, Any]:
    """Return the row of a case from its `diagnosis.json`; shares are of the drive, held-out errors of the response."""
    found, fit = content["found"], content["fit"]
    return {
        "case": name,
        "status": DIAGNOSED,
        "verdict": content["verdict"],
        "mechanisms": " + ".join(map(_mechanism, found)),
        "probability": min(_known(found, "probability"), default=None),
        "share_of_drive": max(_known(found, "share_of_drive"), default=None),
        "unexplained_share": content["unexplained"]["share_of_drive"],
        "heldout_before": fit["before"]["heldout_nrmse"],
        "heldout_after": fit["after"]["heldout_nrmse"],
        "noise_floor": fit["noise_floor_nrmse"],
        **_moved(content["parameters"]),
        "says": " ".join(content["says"]),
    }


def row_aside(name: str, said: str) -> dict[str, Any]:
    """Return the row of a case that could not be used, with the sentence that says why."""
    return {"case": name, "status": ASIDE, "says": " ".join(said.split())}


def save_rows(path: Path, rows: Sequence[Row]) -> None:
    """Write one line for each case as CSV; what a case does not have stays empty."""
    with whole(path) as spare, spare.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([_cell(row.get(column)) for column in COLUMNS] for row in rows)


def lines_of(rows: Sequence[Row]) -> list[str]:
    """Return how many cases were diagnosed, and how often each answer was given, the most frequent one first."""
    answers = Counter(row["mechanisms"] or row["verdict"] for row in rows if row["status"] == DIAGNOSED)
    aside = len(rows) - answers.total()
    head = f"{answers.total()} of {len(rows)} cases diagnosed" + (f", {aside} set aside" if aside else "")
    width = len(str(max(answers.values(), default=0)))
    ordered = sorted(answers.items(), key=lambda one: (-one[1], one[0]))
    return [head, *(f"  {count:>{width}}  {answer}" for answer, count in ordered)]


def _mechanism(entry: Mapping[str, Any]) -> str:
    place = entry.get("at")
    return f"{entry['mechanism']}@{place}" if place else str(entry["mechanism"])


def _known(entries: Sequence[Mapping[str, Any]], key: str) -> list[float]:
    return [entry[key] for entry in entries if entry.get(key) is not None]


def _moved(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameter that moved most from before to after, as a share of what it was; nothing if none moved."""
    before, after = ({name: one["median"] for name, one in parameters[when].items()} for when in ("before", "after"))
    both = [name for name in before if before[name] and after.get(name) not in (None, before[name])]
    shares = {name: after[name] / before[name] - 1.0 for name in both}
    if not shares:
        return {}
    name = max(shares, key=lambda one: abs(shares[one]))
    return {"moved": name, "moved_before": before[name], "moved_after": after[name], "moved_by": shares[name]}


def _cell(value: Any) -> Any:
    if isinstance(value, float):
        return f"{value:.6g}"
    return "" if value is None else value
