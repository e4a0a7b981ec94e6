"""The judge of the diagnosis: the same machines for two versions of the code.

    python benchmarks/judge.py make --set twelve --machines MACHINES
    python benchmarks/judge.py run --set twelve --machines MACHINES --code CHECKOUT --out ROWS --label old
    python benchmarks/judge.py compare ROWS_OLD ROWS_NEW
    python benchmarks/judge.py reliability ROWS [ROWS ...]
    python benchmarks/judge.py oracle --machines MACHINES --out ROWS
    python benchmarks/judge.py recall ROWS_WITH_ORACLE ROWS [ROWS ...]

`make` writes machines once, as folders with a case and a recording, so that all versions see the same bytes. `run`
diagnoses them through the command line of the checkout CHECKOUT, each in a process of its own with a limit of
processor time, and appends a row of JSON each to ROWS/SET/rows.jsonl; a run that was stopped is continued. The other
commands read rows only.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from judge_rows import print_comparison, print_oracle, print_reliability, read_rows
from judge_truth import load_truth

SETS = ("twelve", "exact", "foreign", "library", "imperfect", "clean", "real")
PATIENCE = 20.0
"""A process ends after this many times its limit of processor time on the clock."""
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
"""Each process has one thread, so that its processor time does not depend on the number of cores."""


def make_machines(name: str, machines: Path, limit: int, fresh: int = 0) -> list[Path]:
    """Return the folders of the first machines of a set; those that are missing are written first.

    `fresh` is added to the seed of the set: with another number the machines are others.
    """
    if name == "twelve":
        from judge_machines import make_twelve as make
    elif name == "exact":
        from judge_machines import make_exact as make
    elif name == "foreign":
        from judge_foreign import make_foreign as make
    elif name == "library":
        from judge_sets import make_library as make
    elif name == "imperfect":
        from judge_sets import make_imperfect as make
    elif name == "real":
        from judge_real import make_real as make
    else:
        from judge_sets import make_clean as make
    return make(machines / name, limit, fresh)


def find_machines(name: str, machines: Path, limit: int) -> list[Path]:
    """Return the folders of the machines of a set that are complete, in order, at most `limit`."""
    truths = sorted((machines / name).glob("*.truth.json"))
    folders = [path.with_name(path.name.removesuffix(".truth.json")) for path in truths]
    return [folder for folder in folders if (folder / "case.toml").exists()][: limit or None]


def limit_processor(limit: float) -> None:
    """End this process after `limit` s of processor time."""
    seconds = int(limit)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))


def is_timeout(status: int | None) -> bool:
    """Return whether an exit status is that of a process at its limit of time."""
    return status in (-signal.SIGXCPU, -signal.SIGKILL)


def run_command(command: list[str], code: Path, place: Path, limit: float) -> tuple[int, float, float]:
    """Return the exit status of a command of a checkout, its processor time and its time on the clock, in s.

    A negative status is the signal that ended the process, SIGXCPU at the limit of processor time.
    """
    path = os.pathsep.join(str(code / part) for part in ("framework", "plugins"))
    env = {**os.environ, "PYTHONPATH": path, **dict.fromkeys(ONE_THREAD, "1")}
    begin = time.monotonic()
    with (place / "said.txt").open("w") as said:
        child = subprocess.Popen(
            command, env=env, cwd=place, stdout=said, stderr=said, preexec_fn=lambda: limit_processor(limit)
        )
    watch = threading.Timer(PATIENCE * limit, child.kill)
    watch.start()
    try:
        _, status, used = os.wait4(child.pid, 0)
    except KeyboardInterrupt:
        child.kill()
        raise
    finally:
        watch.cancel()
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, time.monotonic() - begin


def shorten(entry: dict) -> dict:
    """Return what is kept of a finding."""
    return {key: entry.get(key) for key in ("mechanism", "at", "probability", "state", "doubts", "parameters", "says")}


def diagnose(folder: Path, code: Path, limit: float) -> dict:
    """Return what a checkout says about a machine, with its processor time."""
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        command = [sys.executable, "-m", "lostmotion", "diagnose", str((folder / "case.toml").absolute())]
        command += ["--out", str(place / "out"), "--quiet", "--jobs", "1"]
        status, used, clock = run_command(command, code, place, limit)
        row = {"cpu": round(used, 2), "clock": round(clock, 2)}
        file = place / "out" / "diagnosis.json"
        if is_timeout(status):
            return {**row, "status": "timeout", "limit": limit}
        if status or not file.exists():
            said = (place / "said.txt").read_text().strip().splitlines()
            return {**row, "status": f"failed ({status}): {' '.join(said[-3:])[:400]}"}
        answer = json.loads(file.read_text())
    keys = ("mechanism", "at", "log_evidence_gain", "probability", "price", "fitted")
    return {
        **row,
        "status": "ok",
        "verdict": answer["verdict"],
        "says": answer["says"],
        "found": [shorten(entry) for entry in answer["found"]],
        "open": [{k: e.get(k) for k in ("mechanism", "at", "probability")} for e in answer.get("open", [])],
        "ranking": [{k: e.get(k) for k in keys} for e in answer["ranking"][:10]],
        "confused_with": [{k: e.get(k) for k in ("mechanism", "at")} for e in answer.get("confused_with", [])],
        "parameters": answer["parameters"]["after"],
        "nrmse": [answer["fit"][k]["heldout_nrmse"] for k in ("before", "after")],
        "horizon": [answer["fit"]["after"]["horizon"], answer["fit"]["horizon_unit_time"]],
        "notes": answer.get("notes", []),
    }


def describe_code(code: Path) -> str:
    """Return the commit of a checkout, with a plus sign if files differ from it; empty without git."""
    with contextlib.suppress(OSError, subprocess.CalledProcessError):
        git = ["git", "-C", str(code)]
        head = subprocess.run([*git, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True).stdout
        state = subprocess.run([*git, "status", "--porcelain"], capture_output=True, text=True, check=True).stdout
        return head.strip() + ("+" if state.strip() else "")
    return ""


def run_set(args: argparse.Namespace) -> None:
    """Diagnose the machines of a set that have no row yet."""
    out = args.out / args.set
    out.mkdir(parents=True, exist_ok=True)
    path, code = out / "rows.jsonl", args.code.absolute()
    done = {row["key"] for row in read_rows(path)} if path.exists() else set()
    wanted = set(filter(None, args.keys.split(",")))
    for folder in find_machines(args.set, args.machines, args.limit):
        if folder.name in done or (wanted and folder.name not in wanted):
            continue
        said = diagnose(folder, code, args.timeout)
        head = {"set": args.set, "key": folder.name, "label": args.label, "commit": describe_code(code)}
        row = {**head, **said, "truth": load_truth(folder)}
        with path.open("a") as stream:
            print(json.dumps(row), file=stream, flush=True)
        names = [f"{e['mechanism']} {e['probability']:.3f} {e['state']}" for e in row.get("found", [])]
        print(folder.name, row["status"], f"{row['cpu']:.0f} s", names, flush=True)


def run_oracle(args: argparse.Namespace) -> None:
    """Compute what an observer who knows the flaws of each machine of the imperfect world would say."""
    from judge_oracle import judge_machine

    out = args.out / "oracle"
    out.mkdir(parents=True, exist_ok=True)
    path = out / "rows.jsonl"
    done = {row["key"] for row in read_rows(path)} if path.exists() else set()
    for folder in find_machines("imperfect", args.machines, args.limit):
        if folder.name in done:
            continue
        begin = time.process_time()
        row = {"key": folder.name, **judge_machine(folder), "truth": load_truth(folder)}
        row["cpu"] = round(time.process_time() - begin, 1)
        with path.open("a") as stream:
            print(json.dumps(row), file=stream, flush=True)
        print(folder.name, row["cpu"], row.get("status"), row.get("best"), flush=True)


def parse_options() -> argparse.Namespace:
    """Return the options."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("make", "run", "oracle"):
        one = commands.add_parser(name)
        one.add_argument("--machines", type=Path, required=True, help="folder of the machines")
        one.add_argument("--limit", type=int, default=0, help="only the first machines of the set (0: all)")
        if name != "oracle":
            one.add_argument("--set", choices=SETS, required=True)
        if name == "make":
            one.add_argument("--fresh", type=int, default=0, help="added to the seed of the set, for other machines")
        else:
            one.add_argument("--out", type=Path, required=True, help="folder of the rows")
        if name == "run":
            one.add_argument("--code", type=Path, default=Path(), help="checkout whose code is judged")
            one.add_argument("--label", default="")
            one.add_argument("--timeout", type=float, default=600.0, help="limit of processor time of a machine, in s")
            one.add_argument("--keys", default="", help="only these machines, separated by commas")
    one = commands.add_parser("compare")
    one.add_argument("old", type=Path)
    one.add_argument("new", type=Path)
    one = commands.add_parser("recall")
    one.add_argument("oracle", type=Path, help="folder with the rows of the oracle")
    one.add_argument("rows", type=Path, nargs="*")
    one = commands.add_parser("reliability")
    one.add_argument("rows", type=Path, nargs="+")
    return parser.parse_args()


def main() -> None:
    """Run one command."""
    args = parse_options()
    if args.command == "make":
        for folder in make_machines(args.set, args.machines, args.limit, args.fresh):
            print(folder)
    elif args.command == "run":
        run_set(args)
    elif args.command == "oracle":
        run_oracle(args)
    elif args.command == "compare":
        print_comparison(args.old, args.new)
    elif args.command == "recall":
        print_oracle(args.oracle, args.rows)
    else:
        print_reliability(args.rows)


if __name__ == "__main__":
    main()
