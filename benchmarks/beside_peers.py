"""lostmotion beside PySINDy and SysIdentPy on the same recordings: what each finds, held-out errors, processor time.

    python benchmarks/judge.py make --set twelve --machines MACHINES
    python benchmarks/judge.py run --set twelve --machines MACHINES --out ROWS
    python benchmarks/beside_peers.py run --machines MACHINES --rows ROWS --out OUT
    python benchmarks/validation.py store OUT --name peers-twelve

The peers need the extra `peers`. Each fits each machine in a process of its own with one thread. Its settings are those
with the smallest error of free runs over the last 30 % of the fitted data, or within 5 % of it with the fewest terms.
It finds a hidden effect if one of its terms may stand for it (`LAWS` in peers_sindy.py); a term that stands for no
hidden effect and is not in the nominal model is false. The nominal model of lostmotion is a grey-box fit without the
missing terms. A run that was stopped is continued.
"""

from __future__ import annotations

import argparse
import importlib
import json
import sys
import tempfile
import time
from collections.abc import Iterable, Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from judge import run_command
from judge_rows import VAGUE, count_hits, is_sure, list_false, list_names, read_rows, read_set
from peer_tracks import load_track, measure_error
from peers_sindy import LAWS

PEERS: Mapping[str, tuple[str, str, Mapping[str, bool]]] = {
    "PySINDy, polynomials": ("pysindy", "peers_sindy", {"laws": False, "weak": False}),
    "PySINDy, polynomials, weak form": ("pysindy", "peers_sindy", {"laws": False, "weak": True}),
    "PySINDy, laws": ("pysindy", "peers_sindy", {"laws": True, "weak": False}),
    "PySINDy, laws, weak form": ("pysindy", "peers_sindy", {"laws": True, "weak": True}),
    "SysIdentPy": ("sysidentpy", "peers_narmax", {}),
}
"""The package of each peer, the module that fits it, and its options."""
NOMINAL, OURS = "grey box (nominal model)", "lostmotion"
LIMIT = 900.0
"""Limit of the processor time of a fit, in s."""


def find_version(package: str) -> str:
    """Return the version of a peer; exit with what to install if it is absent."""
    try:
        return version(package)
    except PackageNotFoundError:
        raise SystemExit(f"{package} is not installed: pip install 'lostmotion[peers]'") from None


def judge_terms(terms: Iterable[str], truth: Mapping) -> tuple[int, int, list[str]]:
    """Return how many hidden effects with a name the terms of a peer find, how many there are, and the false terms."""
    named = {term: set(LAWS[term][1]) for term in terms if term in LAWS and LAWS[term][1]}
    wanted = [set(effect["accept"]) - set(VAGUE) for effect in truth["effects"]]
    wanted = [names for names in wanted if names]
    found = sum(any(names & own for own in named.values()) for names in wanted)
    return found, len(wanted), [term for term, own in named.items() if not any(names & own for names in wanted)]


def describe(row: Mapping, tool: str, code: str, found: tuple[int, int, list[str]], **more: object) -> dict:
    """Return the row of a tool on a machine."""
    hidden = [effect["mechanism"] for effect in row["truth"]["effects"]]
    counts = dict(zip(("found", "of", "false"), found, strict=True))
    return {"key": row["key"], "tool": tool, "version": code, "hidden": hidden, **counts, **more}


def list_own_rows(row: Mapping) -> list[dict]:
    """Return the rows of the nominal model and of the diagnosis, from a row of `judge.py run`."""
    found, of = count_hits(row, sure=True)
    terms = [entry["mechanism"] for entry in list_names(row) if is_sure(entry)]
    before, after = row["nrmse"]
    nominal = describe(row, NOMINAL, row["commit"], (0, of, []), terms=[], error=before, wild=0.0, cpu=None, setting="")
    ours = {"terms": terms, "error": after, "wild": 0.0, "cpu": row["cpu"], "setting": ""}
    return [nominal, describe(row, OURS, row["commit"], (found, of, list_false(row)), **ours)]


def fit_machine(folder: Path, tool: str, horizon: tuple[float, float]) -> dict:
    """Return what a peer says of a machine, with the processor time of its fit, in s."""
    package, module, options = PEERS[tool]
    find_version(package)
    track = load_track(folder, horizon)
    fit = importlib.import_module(module).fit
    importlib.import_module(package)
    begin = time.process_time()
    model = fit(track, **options)
    used = time.process_time() - begin
    error, wild = measure_error(track, model.roll)
    return {"terms": model.terms, "error": error, "wild": wild, "cpu": round(used, 1), "setting": model.setting}


def run_machine(row: Mapping, folder: Path, tool: str) -> dict:
    """Return the row of a peer on a machine, fitted in a process of its own."""
    command = [sys.executable, __file__, "fit", str(folder.absolute()), tool, *map(str, row["horizon"])]
    with tempfile.TemporaryDirectory() as place:
        status, used, _ = run_command(command, Path(__file__).parents[1], Path(place), LIMIT)
        said = (Path(place) / "said.txt").read_text().strip().splitlines()
    code = find_version(PEERS[tool][0])
    if status:
        end = {"terms": [], "error": None, "wild": 1.0, "cpu": round(used, 1), "setting": f"failed: {said[-1:]}"[:200]}
        return describe(row, tool, code, judge_terms((), row["truth"]), **end)
    model = json.loads(said[-1])
    return describe(row, tool, code, judge_terms(model["terms"], row["truth"]), **model)


def run(args: argparse.Namespace) -> None:
    """Fit all peers to all machines that have a diagnosis and no row yet."""
    args.out.mkdir(parents=True, exist_ok=True)
    path = args.out / "peers.jsonl"
    done = {(row["key"], row["tool"]) for row in read_rows(path)} if path.exists() else set()
    for package in {package for package, _, _ in PEERS.values()}:
        find_version(package)
    for key, row in sorted(read_set(args.rows, args.set).items()):
        if row["status"] != "ok":
            continue
        own = {one["tool"]: one for one in list_own_rows(row)}
        for tool in (*own, *(args.tools or PEERS)):
            if (key, tool) not in done:
                found = own.get(tool) or run_machine(row, args.machines / args.set / key, tool)
                with path.open("a") as stream:
                    print(json.dumps({"set": args.set, **found}), file=stream, flush=True)
                print(key, tool, found["error"], found["cpu"], found["terms"], flush=True)


def main() -> None:
    """Run one command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("run")
    one.add_argument("--set", default="twelve", help="set of machines of judge.py")
    one.add_argument("--machines", type=Path, required=True, help="folder of the machines")
    one.add_argument("--rows", type=Path, required=True, help="OUT of `judge.py run`, with the rows of lostmotion")
    one.add_argument("--out", type=Path, required=True, help="folder of the rows")
    one.add_argument("--tools", nargs="*", choices=PEERS, help="only these peers")
    one = commands.add_parser("fit", help="one fit, for `run`")
    one.add_argument("folder", type=Path)
    one.add_argument("tool", choices=PEERS)
    one.add_argument("horizon", type=float, nargs=2, help="number and length (s) of the units of a free run")
    args = parser.parse_args()
    if args.command == "run":
        run(args)
    else:
        print(json.dumps(fit_machine(args.folder, args.tool, tuple(args.horizon))))


if __name__ == "__main__":
    main()
