"""What the cases of a blind trial say together: rates with their bands, coverage, confusions, targets."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.stats import beta, chi2, ncx2

from lostmotion_trials.blind.bound import alike
from lostmotion_trials.blind.commitment import PLAIN
from lostmotion_trials.blind.judging import FLAWS, HIT, MISNAMED, OUTCOMES, VAGUE
from lostmotion_trials.blind.sentences import says_of

Row = Mapping[str, Any]
GAINS = (0.0, 5.0, 15.0, 50.0, 150.0, 500.0, math.inf)
"""Edges of the bins of effect size, in log-likelihood that the true terms gain."""
ALARMS = 0.02
"""False alarms that a clean recording may raise."""
STATED = (0.0, 0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99, 1.0)
COVERED = (0.90, 0.98)
CLOSE, WITHIN = 1.05, 0.9
"""The found model may err on held-out data by so much more than the true one, in this share of cases at the least."""
LEVEL = 0.95
NEAR = 3.0
"""What was named in error cannot be told from the truth if that is better by less than this in log-likelihood."""
ENOUGH = 20
"""With fewer tries a target is not said to be met."""


def summary(rows: Sequence[Row], failed: Sequence[Row]) -> dict[str, Any]:
    """Return what a blind trial found, ready for JSON, from what became of each case."""
    lost = {row["case"] for row in failed}
    kept = ("case", "named", "margin")
    effects = [{**effect, **{key: row[key] for key in kept}} for row in rows for effect in row["effects"]]
    clean = [row for row in rows if not row["effects"] and row["case"] not in lost]
    told: dict[str, Any] = {
        "cases": len(rows),
        "clean": len(clean),
        "effects": len(effects),
        "detection": [_bin(effects, low, high) for low, high in pairwise(GAINS)],
        "sizes": [[e["gain"], float(e["outcome"] == HIT)] for e in effects if e["gain"] is not None],
        "limit": _limit(rows),
        "mechanisms": _mechanisms(effects),
        "confusion": _confusion(rows),
        "reliability": _reliability([pair for row in rows for pair in row["stated"]]),
        "coverage": _coverage([one for row in rows if row["variant"] == PLAIN for one in row["parameters"]]),
        "heldout": _heldout([row["heldout"] for row in rows if row["heldout"] and row["effects"]]),
        "alarms": _alarms(clean),
        "sure": _sure([row for row in rows if "sure" in row]),
        "misses": [_told(e) for e in effects if e["outcome"] != HIT],
        "false_alarms": [_alarm(row) for row in rows if row["false"]],
        "failed": [{"case": row["case"], "says": row["says"]} for row in failed],
        "unmeasured": [{"case": row["case"], "says": row["oracle"]} for row in rows if "oracle" in row],
    }
    told["targets"] = _targets(told, effects)
    return {**told, "says": says_of(told)}


def rate(hits: int, of: int) -> dict[str, Any]:
    """Return a share with its exact 95 % band (Clopper, Pearson 1934); no share of nothing."""
    if not of:
        return {"hits": 0, "of": 0, "share": None, "low": None, "high": None}
    tail = 0.5 * (1.0 - LEVEL)
    low = float(beta.ppf(tail, hits, of - hits + 1)) if hits else 0.0
    high = float(beta.ppf(1.0 - tail, hits + 1, of - hits)) if hits < of else 1.0
    return {"hits": hits, "of": of, "share": hits / of, "low": low, "high": high}


def _bin(effects: Sequence[Row], low: float, high: float) -> dict[str, Any]:
    """Return what became of the effects with gains from `low` to below `high`."""
    own = [e for e in effects if e["gain"] is not None and low <= e["gain"] < high]
    return {"from": low, "to": high if math.isfinite(high) else None, **_counts(own)}


def _counts(effects: Sequence[Row]) -> dict[str, Any]:
    found = Counter(e["outcome"] for e in effects)
    close = sum(e["outcome"] == MISNAMED and e["margin"] is not None and e["margin"] < NEAR for e in effects)
    outcomes = {name: found[name] for name in OUTCOMES}
    return {**rate(found[HIT], len(effects)), "outcomes": outcomes, "misnamed_alike": close}


def _limit(rows: Sequence[Row]) -> dict[str, Any]:
    """Return the chance of the likelihood-ratio test, which knows what to look for, to notice an effect.

    At a gain of g twice the log of the ratio is a non-central chi-square of one degree of freedom about 2 g (Wilks).
    """
    candidates = int(np.median([len(row["stated"]) for row in rows if row["stated"]] or [1]))
    gain = np.geomspace(0.3, 2000.0, 81)
    share = ALARMS / candidates
    return {
        "gain": gain.tolist(),
        "told": ncx2.sf(chi2.isf(ALARMS, 1), 1, 2.0 * gain).tolist(),
        "one_of_many": ncx2.sf(chi2.isf(share, 1), 1, 2.0 * gain).tolist(),
        "candidates": candidates,
        "false_alarms": ALARMS,
    }


def _mechanisms(effects: Sequence[Row]) -> list[dict[str, Any]]:
    """Return one row for each mechanism that was hidden."""
    names = sorted({e["mechanism"] for e in effects})
    rows = []
    for name in names:
        own = [e for e in effects if e["mechanism"] == name]
        gains = [e["gain"] for e in own if e["gain"] is not None]
        status = Counter(e["status"] for e in own).most_common(1)[0][0]
        middle = float(np.median(gains)) if gains else None
        rows.append({"mechanism": name, "median_gain": middle, "oracle": status, **_counts(own)})
    return rows


def _confusion(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return how often each answer was given to each truth; of several effects each counts."""
    pairs: Counter[tuple[str, str]] = Counter()
    for row in rows:
        for truth in [e["mechanism"] for e in row["effects"]] or ["nothing"]:
            named, false = ({name.partition("@")[0] for name in row[key]} for key in ("named", "false"))
            like = {name for name in named if alike(name, truth)}
            other = named - set(FLAWS) if "sure" in row else false
            pairs.update((truth, answer) for answer in (named & {truth} or like or other or {"nothing"}))
    return [{"truth": t, "answer": a, "cases": n} for (t, a), n in sorted(pairs.items())]


def _reliability(stated: Sequence[Sequence[float]]) -> list[dict[str, Any]]:
    """Return for each range of stated probability how often the mechanism was at work."""
    rows = []
    for low, high in pairwise(STATED):
        own = [(p, at) for p, at in stated if low <= p < high or p == high == 1.0]
        mean = float(np.mean([p for p, _ in own])) if own else None
        rows.append({"from": low, "to": high, "stated": mean, **rate(int(sum(at for _, at in own)), len(own))})
    return rows


def _coverage(found: Sequence[Row]) -> list[dict[str, Any]]:
    """Return how many truths the 95 % intervals hold, and how far medians are off: all together, then one by one."""
    names = sorted({one["name"] for one in found})
    return [_covered("all", found), *(_covered(n, [one for one in found if one["name"] == n]) for n in names)]


def _covered(name: str, found: Sequence[Row]) -> dict[str, Any]:
    errors = [abs(one["relative_error"]) for one in found if one["relative_error"] is not None]
    return {
        "name": name,
        **rate(sum(one["inside"] for one in found), len(found)),
        "median_relative_error": float(np.median(errors)) if errors else None,
    }


def _heldout(found: Sequence[Row]) -> dict[str, Any]:
    """Return what was won on held-out data, over what the true model wins, and how near the errors come to its own."""
    shares = [one["share"] for one in found if one["share"] is not None]
    ratios = [one["ratio"] for one in found]
    return {
        "cases": len(found),
        "median_share": float(np.median(shares)) if shares else None,
        "shares": len(shares),
        "median_ratio": float(np.median(ratios)) if ratios else None,
        "within": rate(sum(ratio <= CLOSE for ratio in ratios), len(ratios)),
        "ratios": sorted(ratios),
    }


def _alarms(clean: Sequence[Row]) -> list[dict[str, Any]]:
    """Return false alarms on clean cases: all together, then by the kind of measurement noise.

    In an imperfect world each machine lacks something and has noise of its own kind: an alarm is a false sure name.
    """
    rough = any("sure" in row for row in clean)
    kinds = [] if rough else sorted({row["variant"] for row in clean})
    groups = [("all", clean), *((kind, [row for row in clean if row["variant"] == kind]) for kind in kinds)]
    wrong = "false" if rough else "named"
    return [{"noise": name, **rate(sum(bool(row[wrong]) for row in rows), len(rows))} for name, rows in groups]


def _sure(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return for each kind of drive in an imperfect world how many of the sure names are there, and what was named.

    `rate` counts names that were stated with more than 0.95, `named` machines whose hidden effect is among them,
    `worse` machines whose held-out error rose by what was found. Without machines of such a world there are no rows.
    """
    kinds = sorted({row["kind"] for row in rows})
    groups = [("all", rows), *((kind, [row for row in rows if row["kind"] == kind]) for kind in kinds)] if rows else []
    told = []
    for kind, own in groups:
        names = [right for row in own for _, right in row["sure"]]
        hiding = [row for row in own if row["effects"] and row["effects"][0]["mechanism"] not in VAGUE]
        named = rate(sum(row["effects"][0]["sure"] for row in hiding), len(hiding))
        tried = [row["worse"] for row in own if row.get("worse") is not None]
        worse = rate(sum(rise > 0.0 for rise in tried), len(tried))
        told.append(
            {"kind": kind, "machines": len(own), **rate(sum(names), len(names)), "named": named, "worse": worse}
        )
    return told


def _told(effect: Row) -> dict[str, Any]:
    kept = ("case", "mechanism", "what", "at", "gain", "status", "outcome", "named", "margin")
    return {**{key: effect[key] for key in kept}, "folder": f"cases/{effect['case']}"}


def _alarm(row: Row) -> dict[str, Any]:
    truth = [e["mechanism"] for e in row["effects"]]
    return {"case": row["case"], "folder": f"cases/{row['case']}", "truth": truth, "named": row["false"]}


def _targets(told: Row, effects: Sequence[Row]) -> list[dict[str, Any]]:
    """Return what a diagnosis should reach, what it reached, and whether that is as it should be.

    In an imperfect world no model is true and no effect has a gain: what counts are the names that were sure.
    """
    if told["sure"]:
        rows = [(f"sure names that are there, {row['kind']}", row, LEVEL, 1.0) for row in told["sure"]]
        return [_target(what, found, low, high) for what, found, low, high in rows]
    plain = next((row for row in told["alarms"] if row["noise"] == PLAIN), rate(0, 0))
    rows = [
        ("effects named, gain above 50", _named(effects, 50.0, math.inf), 0.95, 1.0),
        ("effects named, gain 15 to 50", _named(effects, 15.0, 50.0), 0.80, 1.0),
        ("truths in 95 % intervals", told["coverage"][0], *COVERED),
        ("false alarms on clean cases, white noise", plain, 0.0, ALARMS),
        ("cases with a held-out error within 5 % of the true model's", told["heldout"]["within"], WITHIN, 1.0),
    ]
    return [_target(what, found, low, high) for what, found, low, high in rows]


def _named(effects: Iterable[Row], low: float, high: float) -> dict[str, Any]:
    own = [e for e in effects if e["gain"] is not None and low < e["gain"] <= high]
    return rate(sum(e["outcome"] == HIT for e in own), len(own))


def _target(what: str, found: Row, low: float, high: float) -> dict[str, Any]:
    """Return a target with what was reached: "met", "missed", or "open" where it may be chance."""
    kept = {key: found[key] for key in ("hits", "of", "share", "low", "high")}
    if found["share"] is None:
        state = "not tried"
    elif low <= found["share"] <= high:
        state = "met" if found["of"] >= ENOUGH else "open"
    else:
        state = "open" if found["low"] <= high and found["high"] >= low else "missed"
    return {"what": what, "at_least": low, "at_most": high, "state": state, **kept}
