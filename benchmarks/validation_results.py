"""The stored results `benchmarks/results/*.json`: reading, writing, and what their rows count."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from judge_rows import SURE
from lostmotion_trials.rates import Rate, estimate_rate

RESULTS = Path(__file__).resolve().parent / "results"
SCHEMA = "lostmotion.validation/1"
ORACLE, PEERS, RIGS, ARMS, STUDIES = "oracle", "peers", "rigs", ("arms",), ("absent", "check", "locate")
FAMILIES = {
    "hysteresis": "bouc_wen_hysteresis",
    "damping": "viscous_damping quadratic_damping directional_damping damping_drift contact_damping"
    " hunt_crossley_contact",
    "spring": "linear_stiffness cubic_stiffness hertz_contact bilinear_stiffness quadratic_stiffness gravity_pendulum",
    "gap or stop": "asymmetric_gap gap_drift backlash end_stop",
    "constant force": "offset_force",
    "periodic force": "parametric_stiffness excitation_harmonic cogging",
    "delay or lag": "excitation_delay sensor_delay actuator_lag sensor_lag",
    "scale of a channel": "excitation_gain sensor_gain drive_saturation drive_dead_zone sensor_offset",
    "reading": "sensor_quantisation position_ripple",
    "mass": "hidden_mode inertia_change",
    "random force": "random_force",
}
"""Groups of mechanisms with similar effects; those with `friction` in their name are a group of their own."""
FAMILY = {name: family for family, names in FAMILIES.items() for name in names.split()}
OUTSIDE = "law outside the library"


@dataclass(frozen=True)
class Result:
    """A stored result: what was run by which version, and its rows."""

    name: str
    set: str
    machines: str
    code: str
    committed: str
    date: str
    of: int
    commands: Sequence[str]
    note: str
    rows: Sequence[dict]

    @property
    def judged(self) -> bool:
        """Whether the rows are diagnosed machines with one hidden effect or more, or with none."""
        return self.set not in (ORACLE, PEERS, RIGS, *ARMS, *STUDIES)

    @property
    def ended(self) -> list[dict]:
        """The rows of machines with an answer."""
        return [row for row in self.rows if row["status"] == "ok"]


@dataclass(frozen=True)
class Counts:
    """What judged machines say together: shares with their 95 % bands."""

    machines: int
    right: Rate
    named: Rate
    likely: Rate
    alarms: Rate
    held: Rate
    seconds: Sequence[float]


def write_result(path: Path, head: Mapping, rows: Sequence[dict]) -> None:
    """Write a result, one line for each key of its head and for each row."""
    lines = [f" {json.dumps(key)}: {json.dumps(value)}" for key, value in {"schema": SCHEMA, **head}.items()]
    told = ",\n".join(f"  {json.dumps(row)}" for row in rows)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("{\n" + ",\n".join(lines) + f',\n "rows": [\n{told}\n ]\n}}\n')


def read_results(folder: Path = RESULTS) -> list[Result]:
    """Return the stored results, the newest version first."""
    found = []
    for path in sorted(folder.glob("*.json")):
        plain = json.loads(path.read_text())
        if plain["schema"] != SCHEMA or plain["name"] != path.stem:
            raise ValueError(f"{path.name} has schema {plain['schema']!r} and name {plain['name']!r}: store it again")
        keys = ("name", "set", "machines", "code", "committed", "date", "commands", "rows")
        found.append(Result(**{k: plain[k] for k in keys}, of=plain.get("of", 0), note=plain.get("note", "")))
    return sorted(sorted(found, key=lambda r: r.name), key=lambda r: r.committed, reverse=True)


def read_reasons(folder: Path = RESULTS) -> dict[tuple[str, str], str]:
    """Return the reasons of misses that were written by hand, by the name of the result and that of the miss."""
    path = folder / "reasons.toml"
    plain = tomllib.loads(path.read_text()) if path.exists() else {}
    return {(name, miss): reason for name, told in plain.items() for miss, reason in told.items()}


def choose_newest(results: Iterable[Result]) -> list[Result]:
    """Return the judged results of the newest version with machines that hide something and that hide nothing.

    Without such a version they are those of the newest one; `results` begin with the newest.
    """
    judged = [r for r in results if r.judged]
    sets = {code: {r.set for r in judged if r.code == code} for code in (r.code for r in judged)}
    whole = [code for code, names in sets.items() if names >= {"clean", "imperfect"}]
    return [r for r in judged if r.code == (*whole, *sets)[0]]


def count_rows(rows: Sequence[dict]) -> Counts:
    """Return what judged machines say together; an effect of a machine without an answer is not named."""
    ended = [row for row in rows if row["status"] == "ok"]
    effects = [e for row in rows for e in row["effects"] if e[5]]
    sure = [ok for row in ended for _, _, sure, ok in row["names"] if sure and ok is not None]
    held = np.sum([row["held"] for row in ended], axis=0) if ended else (0, 0)
    return Counts(
        machines=len(ended),
        right=estimate_rate(sum(sure), len(sure)),
        named=estimate_rate(sum(e[3] for e in effects), len(effects)),
        likely=estimate_rate(sum(e[4] for e in effects), len(effects)),
        alarms=estimate_rate(sum(map(bool, map(list_false, ended))), len(ended)),
        held=estimate_rate(int(held[0]), int(held[1])),
        seconds=sorted(row["cpu"] for row in rows if row["cpu"] is not None),
    )


def list_false(row: dict) -> list[str]:
    """Return the false names above 0.95 of a row."""
    return [name for name, _, sure, ok in row["names"] if sure and ok is False]


def split_rows(rows: Iterable[dict], key: Callable[[dict], str]) -> dict[str, list[dict]]:
    """Return rows by a key, in its order."""
    groups: dict[str, list[dict]] = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return dict(sorted(groups.items()))


def find_oracle(results: Iterable[Result], of: Result) -> dict[str, list]:
    """Return what the oracle states for the machines of a result, by machine: probability, and whether it is right."""
    for result in results:
        if result.set == ORACLE and result.machines == of.machines:
            return {row["key"]: row["stated"] for row in result.rows}
    return {}


def names_truth(stated: Sequence[Sequence]) -> bool:
    """Return whether the oracle names the hidden effect with a probability above 0.95."""
    return any(ok and p > SURE for p, ok in stated)


def compare_with_oracle(results: Sequence[Result], chosen: Iterable[Result]) -> tuple[int, int, int]:
    """Return how many effects the diagnosis and the oracle name above 0.95, of how many that the oracle was asked."""
    own = asked = known = 0
    for result in chosen:
        oracle = find_oracle(results, result)
        for row in (row for row in result.rows if row["key"] in oracle):
            own += any(e[3] for e in row["effects"])
            known += names_truth(oracle[row["key"]])
            asked += 1
    return own, known, asked


def find_family(name: str) -> str:
    """Return the group of a mechanism; names with blanks are laws that the library lacks."""
    if " " in name or name == "unknown":
        return OUTSIDE
    return "friction" if "friction" in name else FAMILY.get(name, name)


def describe_outcome(row: dict, effect: Sequence) -> str:
    """Return what became of a hidden effect: `right`, the group of a false name, or what was said in its place."""
    name, _, _, above, likely, _ = effect
    if above or name in [said for said, _, _, ok in row["names"] if ok is None]:
        return "right"
    if false := list_false(row):
        return f"false: {find_family(false[0])}"
    if likely:
        return "likely, right"
    judged = [ok for _, _, _, ok in row["names"]]
    if False in judged:
        return "likely, false"
    return "unknown force" if None in judged else "nothing"
