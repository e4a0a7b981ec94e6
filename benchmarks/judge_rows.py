"""What the rows of `benchmarks/judge.py` say: names that are right or false, intervals, time, and reliability.

A name is *sure* where its stated probability is above 0.95 and its state is `named`. `unknown` and `random_force` are
no names. The truth of a machine lists for each hidden effect the names that are right; every other name is false.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np

SURE = 0.95
VAGUE = ("unknown", "random_force")
FLAWS = ("sensor_quantisation",)
"""Names that are right in every machine of the imperfect world."""
BINS = (0.0, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99, 1.0001)
CLEAR = ("02_friction", "03_weak_friction", "13_friction_in_noise", "14_weak_friction_in_noise")
"""The clear cases among the twelve."""
TIMED = {
    "clean": ("01_nothing",),
    "friction": CLEAR,
    "two effects": ("05_three_simple", "11_friction_and_wear"),
    "hysteresis": ("08_bouc_wen",),
    "left-over force": ("12_left_over", "06_contact_law"),
}
"""The machines of each kind of the table of processor times."""


def read_rows(path: Path) -> list[dict]:
    """Return the rows of a file."""
    return [json.loads(line) for line in path.read_text().splitlines() if line.strip()]


def read_set(folder: Path, name: str) -> dict[str, dict]:
    """Return the rows of a set by machine; empty where there is no file. The last row of a machine counts."""
    path = folder / name / "rows.jsonl"
    return {row["key"]: row for row in read_rows(path)} if path.exists() else {}


def names_effect(entry: dict, effect: dict, *, several: bool) -> bool:
    """Return whether an entry names an effect, at its place where there are several."""
    here = not several or not effect["at"] or entry.get("at") in (effect["at"], "", None, "drive", "sensor")
    return here and entry["mechanism"] in effect["accept"]


def is_right(entry: dict, truth: dict) -> bool:
    """Return whether what an entry names is in a machine."""
    if truth["further"].get("world") == "imperfect" and entry["mechanism"] in FLAWS:
        return True
    return names_hidden(entry, truth)


def names_hidden(entry: dict, truth: dict) -> bool:
    """Return whether an entry names one of the hidden effects of a machine."""
    return any(names_effect(entry, effect, several=truth["several"]) for effect in truth["effects"])


def is_sure(entry: dict) -> bool:
    """Return whether an entry is named with a probability above `SURE`."""
    return entry["probability"] > SURE and entry["state"] == "named"


def list_names(row: dict) -> list[dict]:
    """Return the findings of a row that have a name of the library."""
    return [entry for entry in row.get("found", []) if entry["mechanism"] not in VAGUE]


def list_false(row: dict, *, sure: bool = True) -> list[str]:
    """Return the false names of a row, only the sure ones by default."""
    entries = [e for e in list_names(row) if is_sure(e) or not sure]
    return [entry["mechanism"] for entry in entries if not is_right(entry, row["truth"])]


def count_hits(row: dict, *, sure: bool) -> tuple[int, int]:
    """Return how many of the hidden effects with a name are named, and how many there are."""
    several, entries = row["truth"]["several"], [e for e in list_names(row) if is_sure(e) or not sure]
    wanted = [effect for effect in row["truth"]["effects"] if set(effect["accept"]) - set(VAGUE)]
    return sum(any(names_effect(e, w, several=several) for e in entries) for w in wanted), len(wanted)


def is_inside(interval: dict, value: float, *, turn: bool) -> bool:
    """Return whether an interval contains a value; with `turn` it is an angle in rad."""
    low, high, median = interval["low"], interval["high"], interval["median"]
    if turn:
        value += 2.0 * math.pi * round((median - value) / (2.0 * math.pi))
    return low <= value <= high


def check_intervals(row: dict) -> list[tuple[str, bool]]:
    """Return the parameters whose true value is known, with whether their interval contains it.

    These are those of each entry that names a hidden effect by its own name, and, where all that is hidden was named
    and nothing else, those of the machine.
    """
    told: list[tuple[str, bool]] = []
    for entry in list_names(row):
        for effect in row["truth"]["effects"]:
            if entry["mechanism"] == effect["mechanism"]:
                told += compare_values(entry["parameters"], effect["parameters"], f"{entry['mechanism']}.")
    hits, wanted = count_hits(row, sure=False)
    if hits == wanted == len(row["truth"]["effects"]) and not list_false(row, sure=False) and row["status"] == "ok":
        told += compare_values(row["parameters"], row["truth"]["values"], "")
    return told


def compare_values(said: dict, truth: dict, prefix: str) -> list[tuple[str, bool]]:
    """Return the names of intervals whose truth is known, with whether they contain it."""
    known = {k: i for k, i in said.items() if k in truth and i["low"] is not None and i["low"] < i["high"]}
    return [(prefix + k, is_inside(i, truth[k], turn=k == "phase")) for k, i in known.items()]


def format_share(count: int, of: int) -> str:
    """Return a number out of another one."""
    return f"{count} of {of}" + (f" ({100.0 * count / of:.0f} %)" if of else "")


def format_findings(row: dict) -> str:
    """Return the findings of a row in short, false names with an exclamation mark."""
    if row["status"] != "ok":
        return row["status"][:60]
    parts = []
    for entry in row["found"]:
        vague = entry["mechanism"] in VAGUE or is_right(entry, row["truth"])
        parts.append(f"{entry['mechanism']} {entry['probability']:.3f} {entry['state']}" + ("" if vague else " (!)"))
    return "; ".join(parts) or row["verdict"]


def count_recall(rows: Iterable[dict]) -> str:
    """Return the share of hidden effects with a sure name, and of sure names that are right."""
    rows = list(rows)
    hits = [count_hits(row, sure=True) for row in rows]
    sure = [is_right(e, row["truth"]) for row in rows for e in list_names(row) if is_sure(e)]
    named = format_share(sum(h for h, _ in hits), sum(w for _, w in hits))
    return f"recall {named}, precision {format_share(sum(sure), len(sure))}"


def measure_twelve(rows: dict[str, dict]) -> list[tuple[str, str]]:
    """Return the lines of the twelve machines."""
    clear = [rows[key] for key in CLEAR if key in rows]
    held = [ok for row in clear for _, ok in check_intervals(row)]
    hits = sum(count_hits(row, sure=True)[0] for row in clear)
    false = sum(len(list_false(row)) for row in rows.values())
    lines = [
        ("clear cases named above 0.95", f"{format_share(hits, len(clear))}, intervals {sum(held)} of {len(held)}"),
        ("false names above 0.95, twelve machines", f"{false} in {len(rows)}"),
    ]
    for kind, keys in TIMED.items():
        times = [f"{rows[k]['cpu']:.0f}" + (">" if rows[k]["status"] == "timeout" else "") for k in keys if k in rows]
        lines.append((f"processor s, {kind}", ", ".join(times)))
    return lines


def measure_foreign(rows: dict[str, dict]) -> list[tuple[str, str]]:
    """Return the lines of the machines with a law that the library lacks."""
    ended = [row for row in rows.values() if row["status"] == "ok"]
    false = [list_false(row) for row in ended]
    any_name = sum(any(map(is_sure, list_names(row))) for row in ended)
    return [
        ("foreign laws: false names above 0.95", f"{sum(map(len, false))} in {sum(map(bool, false))} of {len(ended)}"),
        ("foreign laws: machines with any name above 0.95", format_share(any_name, len(ended))),
        ("foreign laws: no end", format_share(len(rows) - len(ended), len(rows))),
    ]


def measure_library(rows: dict[str, dict]) -> list[tuple[str, str]]:
    """Return the lines of the rows of the library table with a gain of 50 to 750."""
    ended = [r for r in rows.values() if r["status"] == "ok"]
    good = [r for r in ended if r["truth"]["gain"] and 50.0 <= r["truth"]["gain"] <= 750.0]
    hits = sum(count_hits(row, sure=False)[0] for row in good)
    wrong = sum(bool(list_false(row, sure=False)) for row in good)
    held = [ok for row in good for _, ok in check_intervals(row)]
    return [
        ("library: named", format_share(hits, len(good))),
        ("library: machines with a wrong name", format_share(wrong, len(good))),
        ("library: wrong name above 0.95", format_share(sum(bool(list_false(r)) for r in good), len(good))),
        ("library: intervals with the truth", format_share(sum(held), len(held))),
        ("library: no end", format_share(len(rows) - len(ended), len(rows))),
    ]


def measure_imperfect(rows: dict[str, dict]) -> list[tuple[str, str]]:
    """Return the lines of the imperfect world."""
    return [("imperfect world, above 0.95", count_recall(rows.values()))]


def find_best_recall(told: Sequence[tuple[float, bool]]) -> tuple[float, int]:
    """Return the least stated probability above which 95 % of the names are right, and how many of them are right."""
    order = sorted(told, key=lambda one: -one[0])
    best = (math.nan, 0)
    for count, (stated, _) in enumerate(order, start=1):
        right = sum(ok for _, ok in order[:count])
        if right >= SURE * count:
            best = (stated, right)
    return best


def print_oracle(folder: Path, others: Sequence[Path]) -> None:
    """Print what the oracle names of the imperfect world, beside what versions of the code name of the same machines.

    A machine counts if it hides an effect that has a name and a force.
    """
    oracle = {r["key"]: r for r in read_set(folder, "oracle").values() if r["status"] == "ok"}
    oracle = {k: r for k, r in oracle.items() if any(e["accept"] for e in r["truth"]["effects"])}
    print("| who | machines | named above 0.95, right | recall at 95 % precision, above |\n|---|---|---|---|")
    for other in others:
        rows = {k: r for k, r in read_set(other, "imperfect").items() if k in oracle and r["status"] == "ok"}
        for words, sure in (("all names", False), ("state named", True)):
            print_recall(f"{other.name}: {words}", list_told(rows.values(), sure=sure), len(rows))
        print_recall("oracle, the same machines", list_oracle([oracle[k] for k in rows]), len(rows))
    print_recall("oracle", list_oracle(oracle.values()), len(oracle))


def list_told(rows: Iterable[dict], *, sure: bool) -> list[tuple[float, bool]]:
    """Return the probability of each name, and whether it is right; `FLAWS` are left out where they are not hidden.

    The oracle knows the flaws of a machine, and names none of them.
    """
    told = []
    for row in rows:
        for entry in list_names(row):
            right = names_hidden(entry, row["truth"])
            if (right or entry["mechanism"] not in FLAWS) and (is_sure(entry) or not sure):
                told.append((entry["probability"], right))
    return told


def list_oracle(rows: Iterable[dict]) -> list[tuple[float, bool]]:
    """Return the names of the oracle: each group with its probability, and whether it is right."""
    groups = [one for row in rows for one in row["best"].items()]
    return [(share, name == "true") for name, share in groups if name not in ("nothing_missing", *VAGUE)]


def print_recall(who: str, told: Sequence[tuple[float, bool]], machines: int) -> None:
    """Print a line of the table of the oracle."""
    sure = [ok for stated, ok in told if stated > SURE]
    stated, right = find_best_recall(told)
    print(f"| {who} | {machines} | {sum(sure)} of {len(sure)} | {format_share(right, machines)}, {stated:.3f} |")


def measure_clean(rows: dict[str, dict]) -> list[tuple[str, str]]:
    """Return the lines of the machines that hide nothing."""
    lines = []
    for world in ("perfect", "imperfect"):
        own = [row for row in rows.values() if row["truth"]["further"]["world"] == world and row["status"] == "ok"]
        names = sum(bool(list_false(row, sure=False)) for row in own)
        sure = sum(bool(list_false(row)) for row in own)
        lines.append((f"nothing hidden, {world}: with a name; above 0.95", f"{names}; {sure} of {len(own)}"))
    return lines


MEASURES: dict[str, Callable[[dict[str, dict]], list[tuple[str, str]]]] = {
    "twelve": measure_twelve,
    "exact": measure_twelve,
    "foreign": measure_foreign,
    "library": measure_library,
    "imperfect": measure_imperfect,
    "clean": measure_clean,
}


def print_comparison(old: Path, new: Path) -> None:
    """Print the table of both versions on the machines that both have, and what they say of each of the twelve."""
    print("| what | old | new |\n|---|---|---|")
    for name, measure in MEASURES.items():
        rows = [read_set(folder, name) for folder in (old, new)]
        both = rows[0].keys() & rows[1].keys() if all(rows) else rows[0].keys() | rows[1].keys()
        sides = [measure({k: r for k, r in sorted(side.items()) if k in both}) if side else [] for side in rows]
        heads = [head for head, _ in sides[0] or sides[1]]
        cells = [dict(side) for side in sides]
        for head in heads:
            print(f"| {head} | {cells[0].get(head, '-')} | {cells[1].get(head, '-')} |")
        times = [sum(row["cpu"] for k, row in side.items() if k in both) for side in rows]
        if both:
            print(f"| {name}: machines compared; processor s together | {len(both)}; {times[0]:.0f} | {times[1]:.0f} |")
    for name in MEASURES:
        print_machines(name, read_set(old, name), read_set(new, name))


def print_machines(name: str, old: dict[str, dict], new: dict[str, dict]) -> None:
    """Print what both versions say of each machine of a set."""
    keys = sorted(old.keys() | new.keys())
    if keys:
        print(f"\n{name}: false names have (!)\n\n| machine | hidden | old | s | new | s |\n|---|---|---|---|---|---|")
    for key in keys:
        truth = (old.get(key) or new.get(key))["truth"]
        cells = [(format_findings(s[key]), f"{s[key]['cpu']:.0f}") if key in s else ("-", "-") for s in (old, new)]
        missed = [[k for k, ok in check_intervals(s[key]) if not ok] if key in s else [] for s in (old, new)]
        notes = [f"; interval misses {', '.join(m)}" if m else "" for m in missed]
        (first, used), (second, spent) = cells
        print(f"| {key} | {truth['says']} | {first}{notes[0]} | {used} | {second}{notes[1]} | {spent} |")


def list_stated(rows: Iterable[dict]) -> list[tuple[str, float, bool, bool]]:
    """Return kind of drive, stated probability, whether it is right, and whether it was found, of each stated name.

    Names that are right for the same hidden effect, and those of the other findings, are one statement each: the sum of
    their probabilities. Statements below 0.02 are left out.
    """
    told = []
    for row in rows:
        found = {e["mechanism"] for e in row.get("found", [])}
        groups: dict[str, list[dict]] = {}
        for entry in row.get("ranking", []):
            if entry["mechanism"] in (*VAGUE, "nothing_missing"):
                continue
            own = [i for i, e in enumerate(row["truth"]["effects"]) if entry["mechanism"] in e["accept"]]
            groups.setdefault(f"effect {own[0]}" if own else entry["mechanism"], []).append(entry)
        for entries in groups.values():
            stated = min(sum(e["probability"] for e in entries), 1.0)
            right = any(is_right(e, row["truth"]) for e in entries)
            if stated > 0.02:
                told.append((row["truth"]["drive"], stated, right, any(e["mechanism"] in found for e in entries)))
    return told


def print_reliability(folders: Sequence[Path]) -> None:
    """Print for each range of stated probability how often it was right, over all rows, and by drive and set."""
    for folder in folders:
        sets = {name: [r for r in read_set(folder, name).values() if r["status"] == "ok"] for name in MEASURES}
        rows = [row for own in sets.values() for row in own]
        print(f"\n{folder}: {len(rows)} machines")
        drives = sorted({row["truth"]["drive"] for row in rows})
        parts = {"all": rows, **sets, **{d: [r for r in rows if r["truth"]["drive"] == d] for d in drives}}
        print("| part | " + " | ".join(f"{a:g} to {min(b, 1.0):g}" for a, b in itertools.pairwise(BINS)) + " |")
        print("|---" * len(BINS) + "|")
        for name, own in parts.items():
            print(f"| {name} | " + " | ".join(format_bins(list_stated(own))) + " |")


def format_bins(told: Sequence[tuple[str, float, bool, bool]]) -> list[str]:
    """Return for each range of probability: mean stated, and how many of how many were right."""
    cells = []
    for low, high in itertools.pairwise(BINS):
        own = [(p, ok) for _, p, ok, _ in told if low < p <= high]
        right = sum(ok for _, ok in own)
        cells.append(f"{np.mean([p for p, _ in own]):.3f}: {right} of {len(own)}" if own else "-")
    return cells
