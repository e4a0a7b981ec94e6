"""The page `docs/validation.md` from stored results.

    python benchmarks/validation.py store RUN --name NAME [--fresh N] [--machines DIR] [--code COMMIT]
    python benchmarks/validation.py draw
    python benchmarks/validation.py check

`store` condenses a raw run (OUT/SET of `judge.py run`, OUT/oracle of `judge.py oracle`, the folder of a `lostmotion
prove`, or that of `absent.py`, `check.py`, `beside_peers.py` or `real_rigs.py`) into `benchmarks/results/NAME.json`.
`draw` writes the tables of the page between their marks; the build of the documentation draws the figures. `check`
fails if a table is not that of the results. Reasons of misses are written by hand into
`benchmarks/results/reasons.toml`; `store` leaves them alone.
"""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from validation_peers import PEER_TABLES
from validation_results import read_reasons, read_results
from validation_rigs import RIG_TABLES
from validation_tables import TABLES, find_unused_reasons

PAGE = Path(__file__).resolve().parents[1] / "docs" / "validation.md"
MARK = "<!-- figures of benchmarks/validation.py {} -->"
BLOCK = re.compile(
    MARK.format(r"(?P<name>(?!end\b)[a-z]+)") + r"\n(?P<text>.*?)^" + MARK.format("end"), re.MULTILINE | re.DOTALL
)


BLOCKS = TABLES | PEER_TABLES | RIG_TABLES


def write_blocks(text: str) -> str:
    """Return the text of the page with each block as the stored results say."""
    results, reasons = read_results(), read_reasons()

    def write(found: re.Match[str]) -> str:
        name = found["name"]
        if name not in BLOCKS:
            raise SystemExit(f"{PAGE.name} has the block {name!r}, which no table has: use {', '.join(BLOCKS)}")
        return f"{MARK.format(name)}\n\n{BLOCKS[name](results, reasons).strip()}\n\n{MARK.format('end')}"

    return BLOCK.sub(write, text)


def check_page(text: str) -> list[str]:
    """Return what is wrong with the text of the page, one sentence each; none if it says what the results say."""
    told = {found["name"]: found["text"].strip() for found in BLOCK.finditer(text)}
    true = {found["name"]: found["text"].strip() for found in BLOCK.finditer(write_blocks(text))}
    wrong = [f"the block {name!r} is not that of the results: run `validation.py draw`" for name in BLOCKS
             if name in told and told[name] != true[name]]  # fmt: skip
    wrong += [f"the page has no block {name!r}: add its marks" for name in BLOCKS if name not in told]
    unused = find_unused_reasons(read_results(), read_reasons())
    return wrong + [f"reasons.toml explains {what}, which is no stored miss: correct or delete it" for what in unused]


def parse_options() -> argparse.Namespace:
    """Return the options."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("store")
    one.add_argument("run", type=Path, help="folder with the rows, or with the proof.json")
    one.add_argument("--name", required=True, help="name of the result")
    one.add_argument("--fresh", type=int, default=0, help="as in `judge.py make`")
    one.add_argument("--machines", type=Path, help="folder of the machines, for the sizes of the hidden effects")
    one.add_argument("--code", help="the version, if the run does not say it; of several, the one to be stored")
    one.add_argument("--seconds", type=Path, help="lines CASE diagnose SECONDS: processor times of arms")
    one.add_argument("--note", help="what the page says behind the version")
    commands.add_parser("draw")
    commands.add_parser("check")
    return parser.parse_args()


def main() -> None:
    """Run one command."""
    args = parse_options()
    if args.command == "store":
        from validation_store import store

        path = store(args.run, args.name, vars(args))
        print(f"{path} ({path.stat().st_size / 1024:.0f} KB)")
        return
    text = PAGE.read_text(encoding="utf-8")
    if args.command == "draw":
        text = write_blocks(text)
        PAGE.write_text(text, encoding="utf-8")
    if wrong := check_page(text):
        raise SystemExit("\n".join(wrong))
    print(f"{PAGE.name} says what the results say")


if __name__ == "__main__":
    main()
