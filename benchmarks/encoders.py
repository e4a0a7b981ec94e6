"""Friction hidden in a machine of two bodies: is it named, and with its place, with one encoder and with two?

    python benchmarks/encoders.py --out DIR [--machines 10] [--places second joint ground] [--encoders 1 2]

Each machine is a clearance chain with values of its own, under a multisine; DOP853 follows it, from equations that are
written anew here, with dry friction as tanh(v / width) of a width far below the velocities. Its two positions are read
with 1 % noise. One line of JSON for each diagnosis is added to DIR/encoders.jsonl; what stands there is not run again.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import time
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from lostmotion.case import dump_case
from lostmotion.codec import to_plain
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.registry import Registry
from lostmotion.results.diagnosis import Diagnosis

PLACES = ("second", "joint", "ground")
NOISE, SHARE = 0.01, 0.12
"""Noise of an encoder over the deviation of what it shows; friction over the amplitude of the drive."""
SECONDS, RATE, FINER = 12.0, 150.0, 6
LINES = 12


def values_of(rng: np.random.Generator) -> dict[str, float]:
    """Return the values of a machine: two masses, springs to the ground, a joint with play, damping."""
    m1, m2 = rng.uniform(0.8, 1.5), rng.uniform(0.5, 1.2)
    k1 = m1 * rng.uniform(8.0, 14.0) ** 2
    return {
        "m1": m1, "c1": 0.04 * math.sqrt(k1 * m1), "k1": k1,
        "m2": m2, "c2": 0.02 * math.sqrt(k1 * m2), "k2": 0.2 * k1 * rng.uniform(0.5, 1.5),
        "k0": 6.0 * k1 * rng.uniform(0.7, 1.4), "c0": 0.02 * math.sqrt(k1 * m1), "x0": rng.uniform(1.0e-3, 2.0e-3),
    }  # fmt: skip


def recorded(values: dict[str, float], place: str, rng: np.random.Generator) -> tuple[dict[str, Any], float]:
    """Return the columns of a recording of a machine with friction at a place, and the friction (N)."""
    q, natural = values, math.sqrt(values["k1"] / values["m1"]) / (2.0 * math.pi)
    lines = natural * rng.uniform(0.35, 2.2, LINES)
    phases = rng.uniform(0.0, 2.0 * math.pi, LINES)
    level = 0.012 * q["k1"] / math.sqrt(LINES)

    def force(t: Any) -> Any:
        return level * np.sum(np.cos(2.0 * math.pi * np.multiply.outer(t, lines) + phases), axis=-1)

    friction = SHARE * level * math.sqrt(LINES)

    def rates(t: float, y: Any) -> Any:
        lean, slip = y[0] - y[2], y[1] - y[3]
        joint = q["c0"] * slip + q["k0"] * math.copysign(max(abs(lean) - q["x0"], 0.0), lean)
        drag = {p: friction * math.tanh(v / 2e-5) for p, v in (("ground", y[1]), ("joint", slip), ("second", y[3]))}
        first = float(force(t)) - q["c1"] * y[1] - q["k1"] * y[0] - joint
        other = joint - q["c2"] * y[3] - q["k2"] * y[2]
        if place == "ground":
            first -= drag["ground"]
        elif place == "joint":
            first, other = first - drag["joint"], other + drag["joint"]
        elif place == "second":
            other -= drag["second"]
        return [y[1], first / q["m1"], y[3], other / q["m2"]]

    t = np.arange(round(SECONDS * RATE)) / RATE
    seen = solve_ivp(
        rates, (0.0, t[-1]), [0.0] * 4, "DOP853", t_eval=t, rtol=1e-8, atol=1e-11, max_step=1.0 / RATE / FINER
    ).y
    table = {"t": t, "F": force(t)}
    for name, x in (("motor", seen[0]), ("load", seen[2])):
        table[name] = 1e3 * (x + NOISE * x.std() * rng.standard_normal(len(t)))
    return table, friction


def case_of(values: dict[str, float], encoders: int) -> dict[str, Any]:
    """Return the case: masses and springs to the ground are known, joint, gap and damping are not."""
    sensors = [
        {"channel": "position", "column": "motor", "unit": "mm", "name": "motor encoder"},
        {"channel": "second_position", "column": "load", "unit": "mm", "name": "load encoder"},
    ]
    known = {name: values[name] for name in ("m1", "m2", "k1", "k2", "c2", "c0")}
    wide = {
        name: {"low": values[name] / 3.0, "high": 3.0 * values[name], "scale": "log"} for name in ("c1", "k0", "x0")
    }
    recording = {
        "file": "recording.csv", "time": "t", "inputs": [{"input": "force", "column": "F", "unit": "N"}],
        "sensors": sensors[:encoders],
    }  # fmt: skip
    return {
        "title": f"Clearance chain, {encoders} of 2 encoders",
        "recordings": [recording],
        "model": {"name": "clearance_chain", "known": known, "estimate": wide},
    }


def prepared(folder: Path, seed: int, place: str, encoders: int) -> tuple[Path, dict[str, Any]]:
    """Return the case of a machine, written into a folder, and what is true of it."""
    rng = np.random.default_rng([seed, PLACES.index(place) if place in PLACES else len(PLACES)])
    values = values_of(rng)
    table, friction = recorded(values, place, rng)
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "recording.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(table)
        writer.writerows(zip(*table.values(), strict=True))
    dump_case(case_of(values, encoders), folder / "case.toml")
    return folder / "case.toml", {**values, "friction": friction}


def row_of(said: Diagnosis, truth: dict[str, Any], seconds: float) -> dict[str, Any]:
    """Return one line of the table: what was named, and intervals beside the truth."""
    found = [
        {"mechanism": e.mechanism, "at": e.at, "probability": e.probability, "parameters": to_plain(e.parameters)}
        for e in said.found
    ]
    after, fit = to_plain(said.parameters.after), to_plain(said.fit)
    return {"found": found, "after": after, "fit": fit, "truth": truth, "seconds": seconds}


def hit(row: dict[str, Any]) -> str:
    """Return "named", "named beside others", "elsewhere" or "missed"."""
    names = [(e["mechanism"], e["at"]) for e in row["found"]]
    if ("coulomb_friction", row["place"]) in names:
        return "named" if len(names) == 1 else "named beside others"
    return "elsewhere" if any(m == "coulomb_friction" for m, _ in names) else "missed"


def summary(rows: list[dict[str, Any]]) -> str:
    """Return how often the friction was named, and how wide the intervals of joint and gap are."""
    lines = []
    for encoders in (1, 2):
        for place in (*PLACES, "none"):
            some = [r for r in rows if r["encoders"] == encoders and r["place"] == place]
            if not some:
                continue
            told = [hit(r) for r in some]
            counts = ", ".join(f"{told.count(w)} {w}" for w in dict.fromkeys(told))
            alarms = sum(bool(r["found"]) for r in some)
            said = counts if place != "none" else f"{alarms} false alarms"
            lines.append(f"{encoders} encoder(s), friction at {place:7s}: {len(some)} records: {said}")
            for name in ("k0", "x0"):
                spans = [r["after"][name] for r in some if name in r["after"]]
                wide = [100.0 * (s["high"] - s["low"]) / s["median"] for s in spans]
                inside = sum(s["low"] <= r["truth"][name] <= s["high"] for s, r in zip(spans, some, strict=True))
                lines.append(
                    f"    {name}: interval {np.median(wide):.2g} % wide (median), holds {inside} of {len(spans)}"
                )
    return "\n".join(lines)


def main() -> None:
    """Run what is asked and not there yet, and print the summary of all that is there."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--machines", type=int, default=10)
    parser.add_argument("--places", nargs="+", default=list(PLACES), choices=[*PLACES, "none"])
    parser.add_argument("--encoders", nargs="+", type=int, default=[2, 1])
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    log = asked.out / "encoders.jsonl"
    rows = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    done = {(r["machine"], r["place"], r["encoders"]) for r in rows}
    for machine in range(asked.machines):
        for encoders in asked.encoders:
            for place in asked.places:
                if (machine, place, encoders) in done:
                    continue
                folder = asked.out / f"{machine:02d}-{place}-{encoders}"
                case, truth = prepared(folder, machine, place, encoders)
                begin = time.perf_counter()
                said = run_diagnosis(case, folder / "out", Registry.discover(), jobs=asked.jobs, propose=False)
                row = row_of(said, truth, time.perf_counter() - begin)
                row = {"machine": machine, "place": place, "encoders": encoders, **row}
                rows.append(row)
                with log.open("a") as file:
                    file.write(json.dumps(row) + "\n")
                print(machine, place, encoders, hit(row), f"{row['seconds']:.0f} s", flush=True)
    print(summary(rows))


if __name__ == "__main__":
    main()
