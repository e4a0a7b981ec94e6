"""The tables and sentences of `docs/validation.md`, each from the stored results."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from judge_rows import SURE
from lostmotion_trials.arms.judging import CLEAR, EMPTY, FAILED, FALSE, MORE, OTHER, RIGHT, WRONG, ArmsTarget
from lostmotion_trials.blind.score import LEAST_TRIES
from lostmotion_trials.rates import Rate, estimate_rate
from validation_results import (
    ARMS,
    STUDIES,
    Result,
    choose_newest,
    compare_with_oracle,
    count_rows,
    find_oracle,
    list_false,
    split_rows,
)

Reasons = Mapping[tuple[str, str], str]
SPACE = "\N{NO-BREAK SPACE}"
SECONDS = (10.0, 60.0)
"""Targets of the median and of the largest processor time of a diagnosis, in s."""
HELD = (0.93, 0.97)
"""Target of the share of 95 % intervals that hold the truth."""
TRIALS = (10_000, 1_000_000)
"""Numbers of trials whose cost is computed."""
RECALL = 0.8
"""Target of the effects named above 0.95, as a share of those that the oracle names."""


def format_rate(rate: Rate, *, band: bool = True) -> str:
    """Return a share as text, with its 95 % band."""
    if not rate.of:
        return "not measured"
    share, low, high = (f"{100.0 * one:.0f}" for one in (rate.share, rate.low, rate.high))
    return f"{rate.hits} of {rate.of}" + (f" ({share}; {low} to {high}{SPACE}%)" if band else "")


def format_seconds(seconds: Sequence[float]) -> str:
    """Return median and largest processor time as text."""
    return f"{np.median(seconds):.0f}, {max(seconds):.0f}" if seconds else "not stored"


def make_table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table as Markdown; a sentence if it has no rows."""
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([f"| {' | '.join(heads)} |", "|---" * len(heads) + "|", *lines]) if lines else "None is stored."


def describe_set(result: Result) -> str:
    """Return the machines of a result, with their number where only a part of them was diagnosed."""
    part = f", the first {len(result.rows)} of {result.of}" if len(result.rows) < result.of else f", {len(result.rows)}"
    return f"`{result.machines}`{part}"


def write_version(results: Sequence[Result], _: Reasons) -> str:
    """Return which version the newest results are of, and the commands that repeat them."""
    newest = choose_newest(results)
    commands = dict.fromkeys(f"`{command}`" for r in newest for command in r.commands)
    machines = sum(len(r.rows) for r in newest)
    return (
        "The newest results with and without hidden effects are of version"
        f" `{newest[0].code}`, committed on {newest[0].committed[:10]}: {machines}"
        f" machines, run on {newest[0].date}. In a checkout of this version they are repeated by {', '.join(commands)}."
    )


def write_targets(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the targets: what the newest version reached."""
    newest = choose_newest(results)
    every = [row for r in newest for row in r.rows]
    rough = [row for r in newest if "imperfect" in r.set for row in r.rows]
    empty = [row for row in every if not row["effects"] and row["status"] == "ok"]
    alarms = estimate_rate(sum(bool(list_false(row)) for row in empty), len(empty))
    rows = [
        judge_rate("names above 0.95 that are right, imperfect world", count_rows(rough).right, SURE, 1.0),
        judge_recall(*compare_with_oracle(results, newest)),
        judge_rate("machines without a hidden effect that have a name above 0.95", alarms, 0.0, 0.01),
        judge_rate("95 % intervals that hold the truth", count_rows(every).held, *HELD),
        *(
            judge_time(*target, count_rows(every).seconds)
            for target in zip(("median", "largest"), SECONDS, strict=True)
        ),
    ]
    return make_table(("what", "result", "target", "state"), rows)


def judge_recall(own: int, known: int, asked: int) -> list[str]:
    """Return the row of the effects that are named, beside those that the oracle names."""
    told = f"{own} beside {known}, of {asked} effects" if asked else "not measured"
    state = ("met" if own >= RECALL * known else "missed") if known else "not tried"
    aim = f"at least {100.0 * RECALL:.0f} % of the oracle's"
    return ["effects named above 0.95, beside those that the oracle names", told, aim, state]


def judge_time(which: str, limit: float, seconds: Sequence[float]) -> list[str]:
    """Return the row of the median or the largest processor time."""
    found = (np.median(seconds) if which == "median" else max(seconds)) if seconds else math.nan
    state = "met" if found <= limit else "missed" if seconds else "not tried"
    told = f"{found:.0f} s" if seconds else "not measured"
    return [f"processor time of a diagnosis, {which}", told, f"at most {limit:g} s", state]


def judge_rate(what: str, rate: Rate, low: float, high: float) -> list[str]:
    """Return the row of a target; `open` where the band of the rate does not decide, or after few tries."""
    ends = [f"{100.0 * one:.0f}" for one in (low, high)]
    aim = f"at least {ends[0]} %" if high == 1.0 else f"at most {ends[1]} %" if low == 0.0 else f"{' to '.join(ends)} %"
    state = ArmsTarget(what, low, high, rate).state
    return [what, format_rate(rate), aim, "open" if state == "met" and rate.of < LEAST_TRIES else state]


def list_set_row(results: Sequence[Result], result: Result) -> list[str]:
    """Return the cells of a judged result: names, effects, oracle, intervals, machines with a false name, time."""
    counts, (own, known, asked) = count_rows(result.rows), compare_with_oracle(results, [result])
    oracle = f"{known} and {own} of {asked}" if asked else "-"
    lost = len(result.rows) - len(result.ended)
    return [
        describe_set(result) + (f" ({lost} without an answer)" if lost else ""),
        format_rate(counts.right),
        format_rate(counts.named, band=False) if counts.named.of else "none hidden",
        oracle,
        format_rate(counts.likely, band=False) if counts.likely.of else "-",
        format_rate(counts.alarms, band=False),
        format_rate(counts.held),
        format_seconds(counts.seconds),
    ]


SET_HEADS = (
    "machines", "names above 0.95 that are right", "hidden effects named above 0.95", "named by oracle and diagnosis",
    "at any probability", "machines with a false name", "intervals that hold", "processor s: median, largest",
)  # fmt: skip


def write_sets(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the newest version by set of machines."""
    return make_table(SET_HEADS, [list_set_row(results, r) for r in choose_newest(results)])


def write_history(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the earlier versions, the newest first."""
    newest = choose_newest(results)
    old = [r for r in results if r.judged and r not in newest]
    return make_table(("version", *SET_HEADS), [[f"`{r.code}`", *list_set_row(results, r)] for r in old])


def make_drive_key(rows: Iterable[dict]) -> Callable[[dict], str]:
    """Return the function that names the drive of a row, and its sensor if the rows have several."""
    several = len({row["sensor"] for row in rows}) > 1
    return lambda row: row["drive"] + (f", {row['sensor']}" if several else "")


def write_drives(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the newest version by kind of drive, and by sensor where there are several."""
    rows = [row for r in choose_newest(results) for row in r.rows]
    groups = split_rows(rows, make_drive_key(rows))
    heads = ("drive", "machines", "names above 0.95 that are right", "hidden effects named above 0.95",
             "machines with a false name", "intervals that hold")  # fmt: skip
    return make_table(heads, [
        [kind, str(c.machines), format_rate(c.right), format_rate(c.named), format_rate(c.alarms), format_rate(c.held)]
        for kind, c in ((kind, count_rows(own)) for kind, own in groups.items())
    ])  # fmt: skip


def is_miss(row: dict) -> bool:
    """Return whether a machine has no answer, a false name above 0.95, or a hidden effect that is not named so."""
    return row["status"] != "ok" or bool(list_false(row)) or any(e[5] and not e[3] for e in row["effects"])


def format_answer(row: dict) -> str:
    """Return what was said of a machine, false names above 0.95 first; the key of a reason contains it."""
    if row["status"] != "ok":
        return row["status"].partition(":")[0]
    names = sorted(row["names"], key=lambda one: (one[3] is not False, not one[2]))
    told = [name + ("" if sure or ok is None or p is None else f" {p:.2f}") for name, p, sure, ok in names]
    return ", ".join(told) or "nothing"


def name_miss(row: dict) -> str:
    """Return the name of a miss in `reasons.toml`: the machine, and its false names, or `-`."""
    return f"{row['key']} {' '.join(list_false(row)) or '-'}"


def explain_miss(row: dict, result: str, reasons: Reasons) -> str:
    """Return the reason of a miss: the one written by hand, or else what the diagnosis itself states."""
    if reason := reasons.get((result, name_miss(row))):
        return reason
    if row["status"] != "ok":
        return row["status"]
    if row["why"] and not list_false(row):
        return row["why"]
    if not row["gains"]:
        return "not examined"
    right, other = row["gains"]
    if not right:
        return "no gain of the right law is among the first ten"
    word = "gains" if right[1] else "gains at most"
    return f"the right law {word} {round(right[0])}" + (f", the answer {round(other[0])}" if other and other[0] else "")


MISS_HEADS = ("machine", "drive", "hidden (share)", "oracle", "answer", "why")


def list_miss_row(row: dict, result: Result, stated: Sequence | None, reasons: Reasons) -> list[str]:
    """Return the cells of a miss; `stated` is what the oracle states of the machine."""
    seen = "-" if stated is None else f"{sum(p for p, ok in stated if ok):.2f}"
    sizes = [f"{e[0]}{'' if e[1] is None else f' ({100.0 * e[1]:.1f}{SPACE}%)'}" for e in row["effects"]]
    place = f"{result.machines.removeprefix('imperfect --fresh ')}: {row['key']}"
    why = explain_miss(row, result.name, reasons).replace("|", "/")
    return [place, row["drive"], ", ".join(sizes) or "nothing", seen, format_answer(row), why]


def write_misses(results: Sequence[Result], reasons: Reasons) -> str:
    """Return the table of the misses of the newest version."""
    chosen = [(r, find_oracle(results, r)) for r in choose_newest(results)]
    rows = [(row, r, oracle.get(row["key"])) for r, oracle in chosen for row in filter(is_miss, r.rows)]
    return make_table(MISS_HEADS, [list_miss_row(*cells, reasons) for cells in rows])


def write_examined(results: Sequence[Result], reasons: Reasons) -> str:
    """Return the table of the misses of earlier versions whose reason was written by hand."""
    newest = choose_newest(results)
    rows = [
        [f"`{r.code}`", *list_miss_row(row, r, find_oracle(results, r).get(row["key"]), reasons)]
        for r in results
        if r.judged and r not in newest
        for row in filter(is_miss, r.rows)
        if (r.name, name_miss(row)) in reasons
    ]
    return make_table(("version", *MISS_HEADS), rows)


def find_unused_reasons(results: Iterable[Result], reasons: Reasons) -> list[str]:
    """Return the reasons that are those of no stored miss."""
    results = list(results)
    misses = {(r.name, name_miss(row)) for r in results if r.judged for row in r.rows if is_miss(row)}
    misses |= {(r.name, f"{row['key']} -") for r in results if r.set in ARMS for row in r.rows if is_arm_miss(row)}
    return [f"{name}: {miss}" for name, miss in reasons if (name, miss) not in misses]


def write_arms(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the trials on arms, a row for each."""
    counts = {
        "joint and physics right, of the effects that gain more than 30": lambda r: count_arms(
            [row for row in r if row["hidden"] and row["gain"] > CLEAR], RIGHT, MORE),
        "of all hidden effects": lambda r: count_arms(take_hiding(r), RIGHT, MORE),
        "a name at a wrong joint": lambda r: count_arms(take_hiding(r), WRONG),
        "other physics at the right joint": lambda r: count_arms(take_hiding(r), OTHER),
        "the right name and a false one": lambda r: count_arms(take_hiding(r), MORE),
        "arms without an effect that have a name": lambda r: count_arms([x for x in r if not x["hidden"]], FALSE),
        "95 % intervals of named sizes that hold the truth": count_sizes,
    }  # fmt: skip
    rows = []
    for r in (r for r in results if r.set in ARMS):
        asked = r.commands[0].removeprefix("lostmotion prove ").replace("--world arms ", "").replace(" --out OUT", "")
        times = format_seconds(sorted(row["cpu"] for row in r.rows if row["cpu"] is not None))
        rates = (format_rate(count(r.rows)) for count in counts.values())
        rows.append([f"`{r.name}`", f"`{asked}`", f"`{r.code}`, {r.date}{mark(r)}", *rates, times])
    return make_table(("trial", "options", "version, date", *counts, "processor s: median, largest"), rows)


def take_hiding(rows: Iterable[dict]) -> list[dict]:
    """Return the arms with a hidden effect."""
    return [row for row in rows if row["hidden"]]


def count_arms(rows: Sequence[dict], *outcomes: str) -> Rate:
    """Return the share of arms with these outcomes."""
    return estimate_rate(sum(row["outcome"] in outcomes for row in rows), len(rows))


def count_sizes(rows: Sequence[dict]) -> Rate:
    """Return the share of intervals of named sizes that hold the truth."""
    sizes = [size for row in rows for size in row["sizes"]]
    return estimate_rate(sum(size[4] for size in sizes), len(sizes))


def is_arm_miss(row: dict) -> bool:
    """Return whether something is wrong or absent in the answer of an arm, or in an interval of a size."""
    return row["outcome"] not in (RIGHT, EMPTY) or not all(size[4] for size in row["sizes"])


def write_armmisses(results: Sequence[Result], reasons: Reasons) -> str:
    """Return the table of the arms whose effect was not named, and of the intervals that miss."""
    rows = []
    for result in (r for r in results if r.set in ARMS):
        for row in filter(is_arm_miss, result.rows):
            outside = [s for s in row["sizes"] if not s[4]]
            hidden = ", ".join(row["hidden"]) or "nothing"
            gain = "-" if row["gain"] is None or math.isnan(row["gain"]) else f"{round(row['gain'])}"
            said = ", ".join(row["named"]) or (FAILED if row["outcome"] == FAILED else "nothing")
            why = "; ".join(f"{name.rpartition('.')[2]} {truth:.4g}, interval {low:.4g} to {high:.4g}"
                            for name, truth, low, high, _ in outside)  # fmt: skip
            why = reasons.get((result.name, f"{row['key']} -"), why)
            why = why or (f"gains less than {CLEAR:g}" if row["outcome"] == "silent" and row["gain"] < CLEAR else "")
            rows.append([f"`{result.name}` {row['key']}", hidden, gain, said, why or "not examined"])
    return make_table(("arm", "hidden", "gain alone", "named", "why"), rows)


def write_studies(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of the single studies."""
    rows = []
    for result in (r for r in results if r.set in STUDIES):
        for number, row in enumerate(result.rows):
            origin = ["as above"] * 2 if number else [f"`{result.commands[0]}`", f"`{result.code}`{mark(result)}"]
            rows.append([row["what"], format_rate(estimate_rate(row["hits"], row["of"])), *origin])
    return make_table(("what", "result", "command", "version"), rows)


def write_costs(results: Sequence[Result], _: Reasons) -> str:
    """Return the table of what many diagnoses cost, from the mean processor time of the stored ones."""
    rows = []
    for result in [*choose_newest(results), *(r for r in results if r.set in ARMS)]:
        seconds = [row["cpu"] for row in result.rows if row["cpu"] is not None]
        if len(seconds) < 2:
            continue
        mean, half = np.mean(seconds), 1.96 * np.std(seconds, ddof=1) / len(seconds) ** 0.5
        told = f"{mean:.0f} ({max(mean - half, 0.0):.0f} to {mean + half:.0f})"
        hours = (f"{float(f'{count * mean / 3600.0:.2g}'):,.0f}" for count in TRIALS)
        rows.append([f"`{result.machines}`", str(len(seconds)), told, *hours])
    heads = (f"core hours of {count:,} trials" for count in TRIALS)
    return make_table(("machines", "measured on", "mean processor s of a diagnosis (95 %)", *heads), rows)


def write_intervals(results: Sequence[Result], _: Reasons) -> str:
    """Return in how many runs on imperfect machines the intervals are too narrow."""
    rates = [count_rows(r.rows).held for r in results if r.judged and "imperfect" in r.set]
    below = sum(rate.high < HELD[0] for rate in rates if rate.of)
    return (
        f"**Intervals are too narrow beside flaws.** In {below} of {len(rates)} runs on imperfect machines the whole"
        f" 95 % band of the share that holds the truth lies below {100.0 * HELD[0]:.0f} %."
    )


def mark(result: Result) -> str:
    """Return the note of a result in brackets."""
    return f" ({result.note})" if result.note else ""


TABLES: Mapping[str, Callable[[Sequence[Result], Reasons], str]] = {
    "version": write_version,
    "targets": write_targets,
    "sets": write_sets,
    "drives": write_drives,
    "misses": write_misses,
    "history": write_history,
    "intervals": write_intervals,
    "examined": write_examined,
    "arms": write_arms,
    "armmisses": write_armmisses,
    "studies": write_studies,
    "costs": write_costs,
}
