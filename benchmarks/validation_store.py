"""Condenses raw runs of trials to the small results in `benchmarks/results`, one row for each machine.

A result has the version of the code, the commands that repeat the run, and for each machine what is hidden in it, what
was named with which probability, and whether that is right. `docs/validation.md` is drawn from results only.
"""

from __future__ import annotations

import json
import shlex
import subprocess
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from judge_rows import VAGUE, check_intervals, is_right, is_sure, list_names, list_stated, names_effect, read_rows
from validation_results import ORACLE, PEERS, RESULTS, RIGS, read_results, write_result

DIGITS = 4
"""Decimals of a stored probability or share."""
LEAST_STATED = 0.02
"""Probabilities below this one are not stored, as in `judge.py reliability`."""
JUDGE = "python benchmarks/judge.py"


def store(run: Path, name: str, options: Mapping[str, str | int | Path | None]) -> Path:
    """Return the file of a result after condensing a raw run.

    `options` may have `fresh` (the seed offset of the machines), `machines` (their folder, for the sizes of the hidden
    effects), `code` (the version: only its rows are taken), `seconds` (a file of processor times of arms), and `note`.
    """
    file, condense = find_condenser(run)
    head, rows = condense(run, options)
    code = str(head.pop("code", "") or options.get("code") or "")
    if not code:
        raise SystemExit(f"{run} does not say which version of the code made it: give --code COMMIT")
    date = datetime.fromtimestamp(file.stat().st_mtime, UTC).date().isoformat()
    head = {"name": name, **head, "code": code, "committed": find_commit_time(code) or date, "date": date}
    head |= {"note": options["note"]} if options.get("note") else {}
    path = RESULTS / f"{name}.json"
    write_result(path, head, rows)
    return path


def find_condenser(run: Path) -> tuple[Path, Callable[..., tuple[dict, list[dict]]]]:
    """Return the file of a run that tells what it is, and the function that condenses it."""
    if (run / "proof.json").exists():
        schema = json.loads((run / "proof.json").read_text())["schema"]
        return run / "proof.json", condense_arms if "arms" in schema else condense_proof
    for study, condense in (
        ("absent", condense_absent),
        ("check", condense_check),
        ("peers", condense_peers),
        ("rigs", condense_rigs),
    ):
        if (run / f"{study}.jsonl").exists():
            return run / f"{study}.jsonl", condense
    path = run / "rows.jsonl"
    first = read_rows(path)[:1] if path.exists() else []
    if not first or "truth" not in first[0]:
        raise SystemExit(
            f"{run} is no run that can be stored: give a folder with the rows.jsonl of judge.py (as OUT/imperfect), the"
            " proof.json of `lostmotion prove`, or the absent.jsonl, check.jsonl, peers.jsonl or rigs.jsonl of a study"
        )
    return path, condense_oracle if "best" in first[0] else condense_judged


def find_commit_time(code: str) -> str:
    """Return the time of a commit (ISO 8601), empty if this checkout does not have it."""
    command = ["git", "-C", str(RESULTS.parent), "show", "-s", "--format=%cI", code.removesuffix("+")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def describe_machines(kind: str, fresh: int) -> str:
    """Return the name of a set of machines, which says how `judge.py make` draws it."""
    return f"{kind} --fresh {fresh}" if fresh else kind


def condense_judged(run: Path, options: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rows of a run of `judge.py run`; the last row of a machine counts."""
    rows = list({row["key"]: row for row in read_rows(run / "rows.jsonl")}.values())
    codes = sorted({row["commit"] for row in rows})
    code = options.get("code") or codes[0]
    if len(codes) > 1 and not options.get("code"):
        raise SystemExit(
            f"{run} has rows of the versions {', '.join(codes)}: give --code to store those of one of them"
        )
    kind, fresh = rows[0]["set"], int(options.get("fresh") or 0)
    head = {"set": kind, "machines": describe_machines(kind, fresh), "code": code}
    make = f"{JUDGE} make --set {kind} --machines MACHINES" + (f" --fresh {fresh}" if fresh else "")
    head["commands"] = [make, f"{JUDGE} run --set {kind} --machines MACHINES --out ROWS"]
    folder = options.get("machines")
    folder = Path(folder) / kind if folder else None
    head["of"] = len(list(folder.glob("*.truth.json"))) if folder else len(rows)
    known = find_known_shares(str(head["machines"]))
    return head, [condense_row(row, known, folder) for row in rows if row["commit"] == code]


def find_known_shares(machines: str) -> dict[str, list]:
    """Return the hidden names and their sizes by machine, as earlier results of the same machines have them."""
    found = {}
    for result in read_results():
        if result.machines == machines and result.judged:
            found |= {r["key"]: [[e[0], e[1]] for e in r["effects"]] for r in result.rows if r["shares"]}
    return found


def condense_row(row: dict, known: Mapping[str, list], folder: Path | None) -> dict:
    """Return the stored row of a judged machine."""
    truth, names = row["truth"], list_names(row)
    hidden, shares = [e["mechanism"] for e in truth["effects"]], None
    if row["key"] in known and [name for name, _ in known[row["key"]]] == hidden:
        shares = [share for _, share in known[row["key"]]]
    elif folder and (folder / f"{row['key']}.sealed.json").exists() and truth["further"].get("world") == "imperfect":
        shares = measure_machine(folder / f"{row['key']}.sealed.json")
    held = check_intervals(row) if row["status"] == "ok" else []
    said = [*names, *(e for e in row.get("found", []) if e["mechanism"] in VAGUE)]
    return {
        "key": row["key"],
        "status": row["status"][:80],
        "drive": truth["drive"],
        "sensor": str(truth["further"].get("sensor", "position")),
        "effects": [
            condense_effect(effect, names, truth, share)
            for effect, share in zip(truth["effects"], shares or [None] * len(hidden), strict=True)
        ],
        "shares": shares is not None,
        "names": [
            [e["mechanism"], round(e["probability"], DIGITS), is_sure(e), judge_name(e, truth)] for e in said
        ],
        "held": [sum(ok for _, ok in held), len(held)],
        "missed": [name for name, ok in held if not ok],
        "stated": [[round(p, DIGITS), ok] for _, p, ok, _ in list_stated([row])],
        "cpu": row["cpu"],
        "heldout": [round(error, 5) for error in row.get("nrmse", []) if error is not None],
        "why": find_doubt(said),
        "gains": find_gains(row),
    }  # fmt: skip


def condense_effect(effect: dict, names: Sequence[dict], truth: dict, share: float | None) -> list:
    """Return name, size, gain, whether it is named above 0.95 and at any probability, and whether it has a name."""
    own = [e for e in names if names_effect(e, effect, several=truth["several"])]
    size = None if share is None else round(share, DIGITS)
    nameable = bool(set(effect["accept"]) - set(VAGUE))
    return [effect["mechanism"], size, truth["gain"], any(map(is_sure, own)), bool(own), nameable]


def judge_name(entry: dict, truth: dict) -> bool | None:
    """Return whether a name is right; None for an unknown or a random force, which are no names."""
    return None if entry["mechanism"] in VAGUE else is_right(entry, truth)


def find_doubt(said: Sequence[dict]) -> str:
    """Return the first doubt that a diagnosis states, its first sentence."""
    doubts = [doubt for entry in said for doubt in entry.get("doubts") or ()]
    return doubts[0].split(". ")[0].rstrip(".") if doubts else ""


def find_gains(row: dict) -> list:
    """Return what the best right law and the best other answer gain alone in log evidence, and whether that was fitted.

    They are entries of the ranking, `[GAIN, FITTED]` each, None where there is none; empty without a ranking.
    """
    if not row.get("ranking"):
        return []
    effects, several = row["truth"]["effects"], row["truth"]["several"]
    right = [e for e in row["ranking"] if any(names_effect(e, effect, several=several) for effect in effects)]
    right = [e for e in right if e["fitted"] or e["log_evidence_gain"]]
    said = {e["mechanism"] for e in row["found"]} or {"nothing_missing"}
    other = [e for e in row["ranking"] if e["mechanism"] in said and not judge_name(e, row["truth"])]
    return [[round(own[0]["log_evidence_gain"], 1), own[0]["fitted"]] if own else None for own in (right, other)]


def measure_machine(path: Path) -> list[float | None]:
    """Return the sizes of the hidden effects of a machine of the imperfect world, from its sealed truth."""
    from judge_oracle import measure_shares
    from lostmotion.codec import from_plain
    from lostmotion_trials.blind.sealed import SealedTruth

    return measure_shares(from_plain(SealedTruth, json.loads(path.read_text()), path.name))


def condense_oracle(run: Path, options: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rows of a run of `judge.py oracle`: the probabilities of names, and whether they are right."""
    fresh = int(options.get("fresh") or 0)
    head = {"set": ORACLE, "machines": describe_machines("imperfect", fresh)}
    make = f"{JUDGE} make --set imperfect --machines MACHINES" + (f" --fresh {fresh}" if fresh else "")
    head["commands"] = [make, f"{JUDGE} oracle --machines MACHINES --out ROWS"]
    rows = []
    for row in read_rows(run / "rows.jsonl"):
        if row["status"] == "ok" and any(e["accept"] for e in row["truth"]["effects"]):
            stated = [(p, name == "true") for name, p in row["best"].items() if name not in ("nothing_missing", *VAGUE)]
            rows.append({"key": row["key"], "stated": [[p, ok] for p, ok in stated if p > LEAST_STATED]})
    return head, rows


def condense_proof(run: Path, options: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rows of a trial of `lostmotion prove` in the perfect or the imperfect world."""
    origin = json.loads((run / "proof.json").read_text())["provenance"]
    world, rows = origin["settings"]["world"], []
    for path in sorted((run / "steps" / "score" / "trials").glob("*.json")):
        case = json.loads(path.read_text())
        sealed = json.loads((run / "sealed" / f"{case['case']}.json").read_text())
        rows.append(condense_case(case, sealed["machine"]))
    words = format_plan(origin, ("clean", "only"), {"most": "samples"})
    head = {"set": f"prove {world}", "machines": f"{words} --seed {origin['seed']}", "of": len(rows)}
    head["commands"] = [f"lostmotion prove --cases {len(rows)} {words} --seed {origin['seed']} --out OUT"]
    return head, rows


def format_plan(origin: Mapping, flags: Sequence[str], numbers: Mapping[str, str]) -> str:
    """Return the options of `lostmotion prove` that differ from the usual ones, as text."""
    settings = origin["settings"]
    words = [f"--world {settings['world']}"]
    words += [f"--{word} {settings[key]}" for key, word in numbers.items() if settings.get(key)]
    for flag in flags:
        value = settings.get(flag)
        words += [f"--only {one}" for one in value] if isinstance(value, list) else [f"--{flag}"] if value else []
    return " ".join(words)


def condense_case(case: dict, machine: dict) -> dict:
    """Return the stored row of a case of a blind trial."""
    sure, parameters, heldout = case.get("sure"), case["parameters"], case.get("heldout") or {}
    pairs = sure if sure is not None else [(name, name not in case["false"]) for name in case["named"]]
    named = [(name.partition("@")[0], bool(ok)) for name, ok in pairs]
    effects = []
    for effect in case["effects"]:
        hit, has_name = effect["outcome"] == "hit", effect["mechanism"] not in VAGUE
        above = effect["sure"] if effect.get("sure") is not None else hit
        effects.append([effect["mechanism"], None, effect["gain"], bool(above), hit, has_name])
    return {
        "key": case["case"],
        "status": "failed" if case["verdict"] == "failed" else "ok",
        "drive": case.get("kind") or ("sweep" if machine["signal"]["sweep"] else "tones"),
        "sensor": machine.get("channel", "position"),
        "effects": effects,
        "shares": False,
        "names": [[name, None, True, None if name in VAGUE else ok] for name, ok in named],
        "held": [sum(one["inside"] for one in parameters), len(parameters)],
        "missed": [one["name"] for one in parameters if not one["inside"]],
        "stated": [[round(p, DIGITS), bool(at)] for p, at in case["stated"] if p > LEAST_STATED],
        "cpu": None,
        "heldout": [round(heldout[k], 5) for k in ("before", "after", "true") if heldout.get(k) is not None],
        "why": "",
        "gains": [],
    }


def condense_arms(run: Path, options: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rows of a trial of `lostmotion prove --world arms`."""
    proof, seconds = json.loads((run / "proof.json").read_text()), read_seconds(options.get("seconds"))
    origin = proof["provenance"]
    words = format_plan(origin, ("clean", "only"), {"samples": "samples", "joints": "joints", "wrong": "wrong"})
    if origin["settings"].get("effects", 1) > 1:
        words += f" --effects {origin['settings']['effects']}"
    head = {"set": "arms", "machines": f"{words} --seed {origin['seed']}", "of": len(proof["arms"])}
    head["commands"] = [f"lostmotion prove --cases {len(proof['arms'])} {words} --seed {origin['seed']} --out OUT"]
    rows = [
        {
            "key": arm["case"],
            "hidden": arm["hidden"],
            "named": arm["named"],
            "outcome": arm["outcome"],
            "gain": arm["gain"],
            "sizes": [[s["name"], s["truth"], s["low"], s["high"], s["inside"]] for s in arm["sizes"]],
            "cpu": seconds.get(arm["case"]),
        }
        for arm in proof["arms"]
    ]
    return head, rows


def read_seconds(path: object) -> dict[str, float]:
    """Return processor times by case, from lines `CASE diagnose SECONDS`; the last one of a case counts."""
    lines = [line.split() for line in Path(str(path)).read_text().splitlines()] if path else []
    return {words[0]: float(words[2]) for words in lines if len(words) == 3 and words[1] == "diagnose"}


def condense_absent(run: Path, _: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rates of `benchmarks/absent.py`."""
    rows = read_rows(run / "absent.jsonl")
    bounds = [row for row in rows if row["status"] == "bound"]
    rates = [["the bound lies above the true size", sum(r["upper"] >= r["size"] for r in bounds), len(bounds)]]
    return describe_study("absent", rows), list(list_rates(rates))


def condense_check(run: Path, _: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rates of `benchmarks/check.py`."""
    from check import FACTOR

    machines = read_rows(run / "check.jsonl")
    rows = [row for row in machines if row["status"] == "ok"]
    ratios = np.array([row["widths"][name] / row["expected"][name] for row in rows for name in row["widths"]])
    ratios = ratios[np.isfinite(ratios)]
    close = int(np.sum(np.abs(np.log(ratios)) < np.log(FACTOR)))
    rates = [
        [f"the width of an interval is the expected one within a factor of {FACTOR}", close, len(ratios)],
        ["an effect of the smallest stated size is named", sum("named" in r["named"] for r in rows), len(rows)],
    ]
    return describe_study("check", machines), list(list_rates(rates))


def condense_peers(run: Path, _: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rows of `benchmarks/beside_peers.py`; the version is that of lostmotion."""
    from beside_peers import NOMINAL, OURS
    from beside_peers import PEERS as TOOLS

    rows = read_rows(run / "peers.jsonl")
    tools = {row["tool"] for row in rows} - {NOMINAL, OURS}
    some = "" if tools == set(TOOLS) else f" --tools {shlex.join(sorted(tools))}"
    versions = {row["tool"].partition(",")[0]: row["version"] for row in rows}
    kind, code = rows[0]["set"], versions.pop(OURS)
    machines = f"--set {kind} --machines MACHINES"
    commands = [f"{JUDGE} make {machines}", f"{JUDGE} run {machines} --out ROWS"]
    commands += [f"python benchmarks/beside_peers.py run {machines} --rows ROWS --out OUT{some}"]
    told = ", ".join(f"{tool} {number}" for tool, number in versions.items() if number != code)
    head = {"set": PEERS, "machines": kind, "of": len({row["key"] for row in rows}), "commands": commands}
    keys = ("key", "tool", "hidden", "found", "of", "false", "terms", "error", "wild", "cpu", "setting")
    return {**head, "code": code, "note": told}, [
        {key: round(row[key], 5) if key == "error" and row[key] is not None else row[key] for key in keys}
        for row in rows
    ]


def condense_rigs(run: Path, options: Mapping) -> tuple[dict, list[dict]]:
    """Return head and rows of `benchmarks/real_rigs.py`, of one version; the last row of a rig counts."""
    rows = read_rows(run / "rigs.jsonl")
    code = str(options.get("code") or rows[-1]["code"])
    kept = list(
        {row["key"]: {k: v for k, v in row.items() if k != "code"} for row in rows if row["code"] == code}.values()
    )
    commands = ["python benchmarks/real_rigs.py --out OUT"]
    return {"set": RIGS, "machines": "real rigs", "of": len(kept), "commands": commands, "code": code}, kept


def describe_study(name: str, rows: Sequence[Mapping]) -> dict:
    """Return the head of a study of `benchmarks`; older rows do not say which version made them."""
    first = min(row["trial"] for row in rows)
    machines = 1 + max(row["trial"] for row in rows) - first
    command = f"python benchmarks/{name}.py run --machines {machines}{f' --first {first}' * (first > 0)} --out OUT"
    codes = {row.get("commit", "") for row in rows}
    head = {"set": name, "machines": f"{len(rows)} random machines", "of": machines, "commands": [command]}
    return {**head, "code": codes.pop() if len(codes) == 1 else ""}


def list_rates(rates: Iterable[Sequence]) -> Iterator[dict]:
    """Yield a stored row for each rate of a study."""
    for what, hits, of in rates:
        yield {"what": what, "hits": hits, "of": of}
