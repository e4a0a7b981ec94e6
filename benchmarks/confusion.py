"""Which terms are mistaken for others: `python benchmarks/confusion.py ROWS.jsonl [...] --figure confusion.svg`.

Draws the rows that `benchmarks/library.py table --gain 100` has written: one line for each hidden term, one column for
each answer: a name (sure or likely), `unknown`, or nothing. Prints every pair in which the answer is another term.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion_trials.blind.bound import are_equivalent

NOTHING, UNKNOWN, OTHER = "nothing", "unknown", "random_force"
NO_NAMES = (UNKNOWN, OTHER, "sensor_quantisation")


def list_answers(row):
    """Return the answers for a machine: names, else `unknown` if a force remains, else `nothing`."""
    hidden = row["name"]
    found = [entry["mechanism"] for entry in row["found"]]
    listed = [name for name in found if name not in NO_NAMES or name == hidden]
    names = [hidden if are_equivalent(name, hidden) else name for name in listed]
    if names:
        return list(dict.fromkeys(names))
    return [UNKNOWN] if found else [NOTHING]


def count_answers(rows):
    """Return hidden terms, answers, shares (hidden, answers) of the machines of each term, and the counts of both."""
    pairs, many = Counter(), Counter(row["name"] for row in rows)
    for row in rows:
        pairs.update((row["name"], answer) for answer in list_answers(row))
    hidden = sorted(many)
    others = sorted({answers for _, answers in pairs} - set(hidden) - {NOTHING, UNKNOWN})
    answers = [*hidden, *others, UNKNOWN, NOTHING]
    shares = np.array([[pairs[h, s] / many[h] for s in answers] for h in hidden])
    return hidden, answers, shares, pairs, many


def draw_matrix(hidden, answers, shares, path):
    """Write the matrix as a figure."""
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=(10.5, 9.5), layout="constrained")
        axes = figure.subplots()
        image = axes.imshow(np.where(shares > 0.0, shares, np.nan), cmap="Blues", vmin=0.0, vmax=1.0, aspect="auto")
        axes.set_xticks(range(len(answers)), [s.replace("_", " ") for s in answers], rotation=90, fontsize=7)
        axes.set_yticks(range(len(hidden)), [h.replace("_", " ") for h in hidden], fontsize=7)
        axes.set_xticks(np.arange(len(answers)) - 0.5, minor=True)
        axes.set_yticks(np.arange(len(hidden)) - 0.5, minor=True)
        axes.grid(visible=False, which="major")
        axes.grid(which="minor", color="#dddddd", linewidth=0.4)
        axes.tick_params(which="both", length=0)
        axes.set_xlabel("answer")
        axes.set_ylabel("hidden")
        figure.colorbar(image, ax=axes, shrink=0.5).set_label("share of the machines")
        figure.savefig(path)


def main():
    """Draw the matrix and print the wrong answers."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="+", type=Path)
    parser.add_argument("--figure", type=Path, default=Path("confusion.svg"))
    args = parser.parse_args()
    rows = [json.loads(line) for path in args.rows for line in path.read_text().splitlines()]
    rows = [row for row in rows if row.get("status") == 0 and row["name"] != "clean"]
    hidden, answers, shares, pairs, many = count_answers(rows)
    draw_matrix(hidden, answers, shares, args.figure)
    right = sum(pairs[name, name] for name in hidden)
    print(f"{right} of {len(rows)} machines, of {len(hidden)} terms, had the name of what was hidden.\n")
    print("| hidden | machines | named | else |\n|---|---|---|---|")
    for name in hidden:
        rest = [f"{s.replace('_', ' ')} {pairs[name, s]}" for s in answers if s != name and pairs[name, s]]
        if rest:
            print(f"| `{name}` | {many[name]} | {pairs[name, name]} | {', '.join(rest)} |")


if __name__ == "__main__":
    main()
