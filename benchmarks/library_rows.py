"""What the rows of `benchmarks/library.py` say: names, intervals, and why a hidden term was not named."""

from __future__ import annotations

import itertools
import math
from collections import Counter

import numpy as np
from scipy.stats import chi2

from lostmotion.registry import default
from lostmotion.report.words import to_words
from lostmotion.results import Interval
from lostmotion_trials.blind.bound import are_equivalent, complete_parameters, is_covered
from lostmotion_trials.blind.mechanisms import NOISY
from lostmotion_trials.blind.simulator import BlindDrive

SENSORS = ("position", "velocity", "acceleration")
DRIVES = ("multisine", "sweep", "harmonic")
LATE = {"excitation_delay", "sensor_delay", "actuator_lag", "sensor_lag"}


def list_names(row):
    """Return the names of a row, empty for the hidden one or an equivalent one, and whether that is among them."""
    unnamed = {"unknown", "random_force"} - {row["name"]}
    found = [f for f in row["found"] if f["mechanism"] not in unnamed]
    right = [are_equivalent(f["mechanism"], row["name"]) or is_short_delay(f, row) for f in found]
    return ["" if ok else f["mechanism"] for f, ok in zip(found, right, strict=True)], any(right)


def count_certain(row):
    """Return the number of wrong names that have the state `named`: neither a doubt nor an alternative is stated."""
    entries = [f for f in row["found"] if f["mechanism"] in list_names(row)[0]]
    return sum(f["state"] == "named" for f in entries)


def find_rival(row):
    """Return the entry that stands alone in place of the hidden term, without an onset; None where there is none."""
    names, hit = list_names(row)
    alone = not hit and len(names) == 1 and names[0] and row["name"] not in NOISY
    entries = [f for f in row["found"] if alone and f["mechanism"] in names and not f.get("since")]
    return entries[0] if entries else None


def is_short_delay(entry, row):
    """Return whether a delay or lag of less than half a sample is named where the other kind is hidden.

    At 40 samples per cycle, exp(-s T) and 1 / (1 + s T) differ by less than 0.4 % of the amplitude at such a time T.
    """
    if not {entry["mechanism"], row["name"]} <= LATE:
        return False
    return all(abs(i["median"]) < 0.5 * row["dt"] for i in entry["parameters"].values())


def check_coverage(row):
    """Return for each parameter of the hidden term whether its interval contains the truth."""
    if not row["truth"]:
        return []
    truth = {k: v for k, v in row["truth"][0].items() if k not in ("name", "at")}
    machine = row.get("machine")
    known = complete_parameters(truth, machine["values"], BlindDrive(machine["signal"]["tones"])) if machine else truth
    entry = next((f for f in row["found"] if f["mechanism"] == row["name"]), None)
    intervals = entry["parameters"] if entry else {}
    return [
        is_covered(Interval(i["median"], i["low"], i["high"], i["unit"]), known[k], turn=k == "phase")
        for k, i in intervals.items()
        if k in known and i["low"] is not None
    ]


SIMPLER = "a simpler law that the hidden one contains"
RARE = 1e-3
"""A lead over a simpler law is significant if the likelihood ratio test gives it this probability by chance."""


def is_simpler_enough(row):
    """Return whether the data do not distinguish the hidden law from the simpler one that was named in its place.

    The lead of the hidden law, fitted from its true parameters, is not significant (chi-square distribution with one
    degree of freedom for each parameter that the simpler law lacks).
    """
    law = default().load("term", row["name"])
    further = len(law.params) - len(default().load("term", law.extends[0]).params)
    lead = row.get("lead")
    return isinstance(lead, float) and lead < 0.5 * float(chi2.isf(RARE, further))


def explain_miss(row):
    """Return why a hidden term was not named: a simpler law, or an alternative that is stated; empty for neither."""
    found = [f for f in row["found"] if f["mechanism"] != "unknown"]
    simpler = default().load("term", row["name"]).extends if row["name"] != "random_force" else ()
    if any(f["mechanism"] in simpler for f in found):
        return SIMPLER
    stated = " ".join(doubt.lower() for f in found for doubt in f.get("doubts", ()))
    if any(are_equivalent(name, row["name"]) and to_words(name).lower() in stated for name in default().names("term")):
        return "the hidden one is stated as an alternative"
    return ""


LEAST, MOST = 50.0, 750.0
"""The gains in log-likelihood of the machines that count: 50 to 500 wanted, reached within `TOLERANCE`."""
BINS = (0.0, 20.0, 50.0, 150.0, MOST, math.inf)


def format_line(rows):
    """Return the numbers of named machines, intervals with the truth and wrong names, and the median time, as text.

    The numbers in brackets are those of the wrong names that are a simpler law contained in the hidden one, from which
    the data do not distinguish it, and of those that are stated without a doubt or an alternative.
    """
    hits = sum(list_names(r)[1] for r in rows)
    held = [ok for r in rows for ok in check_coverage(r)]
    extra = sum(sum(bool(n) for n in list_names(r)[0]) for r in rows)
    missed = [r for r in rows if not list_names(r)[1]]
    simpler = sum(explain_miss(r) == SIMPLER and is_simpler_enough(r) for r in missed)
    seconds = float(np.median([r["seconds"] for r in rows]))
    certain = sum(map(count_certain, rows))
    return f"{hits} of {len(rows)} | {sum(held)} of {len(held)} | {extra} ({simpler}, {certain}) | {seconds:.0f} |"


def print_summary(rows):
    """Print the table by gain, the table by sensor and drive, and the missed machines with a gain of `LEAST` to `MOST`.

    The gain in log-likelihood is that of the true term on the fitted data, by our own likelihood from the truth.
    """
    hidden = [r for r in rows if r.get("status") == 0 and r["name"] != "clean"]
    good = [r for r in hidden if isinstance(r.get("reached"), float)]
    heads = "named | intervals that hold | names too many (a simpler law as good, without doubt) | seconds (median)"
    print(f"\n| gain | {heads} |\n|{'---|' * 5}")
    for low, high in itertools.pairwise(BINS):
        if own := [r for r in good if low <= r["reached"] < high]:
            print(f"| {low:g} to {high:g} | {format_line(own)}")
    if other := [r for r in hidden if r not in good]:
        print(f"| not known | {format_line(other)}")
    shown = [r for r in good if LEAST <= r["reached"] <= MOST]
    print(f"\n| sensor | drive | {heads} |\n|{'---|' * 6}")
    for sensor, drive in itertools.product(SENSORS, DRIVES):
        if own := [r for r in shown if (r["sensor"], r["drive"]) == (sensor, drive)]:
            print(f"| {sensor} | {drive} | {format_line(own)}")
    clean = [r for r in rows if r.get("status") == 0 and r["name"] == "clean"]
    if clean:
        print(f"\nOf {len(clean)} machines that hide nothing {sum(bool(list_names(r)[0]) for r in clean)} had a name.")
    missed = [(r, explain_miss(r)) for r in shown if not list_names(r)[1]]
    causes = Counter(why or "neither" for _, why in missed)
    print(
        f"\nNot named: {len(missed)} of {len(shown)}. "
        + "; ".join(f"{why}: {count}" for why, count in causes.most_common())
    )
    for r, why in missed:
        found = ", ".join(f["mechanism"] for f in r["found"]) or "nothing"
        place = f"{r['name']}, {r['sensor']}, {r['drive']}, {r['model']}, gain {r['reached']:.0f}"
        lead = f"; lead of the hidden law {r['lead']:.1f}" if isinstance(r.get("lead"), float) else ""
        print(f"- {place}: {found}" + (f" ({why})" if why else "") + lead)
