"""Pages of the docs as something that runs: their code blocks in order, in a folder of their own for each page.

A comment before a block says what becomes of it:

    <!-- file: case.toml -->      it is written to that file
    <!-- add to: case.toml -->    it is put at the end of that file
    <!-- prints -->               it shows lines that the blocks before have printed, numbers within five per cent
    <!-- exit: 2 -->              it ends with that exit status

Anywhere on a page `<!-- needs: emps -->` names a folder of recordings beside the project, `<!-- slow -->` moves the
page to the slow run, and `<!-- figures of COMMAND -->` says where figures come from that take too long for that.
Python and shell are executed where nothing is said, JSON is parsed, and a TOML that goes nowhere is refused.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

BLOCK = re.compile(r"^(?P<fence>`{3,})(?P<language>\S*)[^\n]*\n(?P<code>.*?)^(?P=fence)[ ]*$", re.MULTILINE | re.DOTALL)
MARK = re.compile(r"<!--\s*(file|add to|prints|exit|needs|slow|figures|by hand)(?:(?::| of)\s*(.*?))?\s*-->")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TOLERANCE = 0.05


@dataclass(frozen=True)
class Block:
    """A code block, the line where it begins, and what the comments before it say."""

    language: str
    code: str
    line: int
    marks: dict[str, str]


@dataclass(frozen=True)
class Page:
    """A page with what stands in it."""

    path: Path

    @property
    def text(self) -> str:
        """What the page says, as it is written."""
        return self.path.read_text(encoding="utf-8")

    @property
    def needs(self) -> list[str]:
        """The folders of recordings that the page wants."""
        return [found[2] for found in MARK.finditer(self.text) if found[1] == "needs"]

    @property
    def slow(self) -> bool:
        """Whether the page is for the slow run."""
        return any(found[1] == "slow" for found in MARK.finditer(self.text))

    def blocks(self) -> Iterator[Block]:
        """Yield the code blocks in order; directives, whose language is in braces, are the build's."""
        text, end = self.text, 0
        for found in BLOCK.finditer(text):
            before = text[end : found.start()]
            marks = {m[1]: m[2] or "" for m in MARK.finditer(before) if not MARK.sub("", before[m.start() :]).strip()}
            end = found.end()
            if not found["language"].startswith("{"):
                yield Block(found["language"], found["code"], text.count("\n", 0, found.start()) + 1, marks)


def run(page: Page, folder: Path) -> None:
    """Run every block of a page in `folder`; raise `AssertionError` with the block and what it printed."""
    printed = ""
    for block in page.blocks():
        place = f"{page.path.name}, line {block.line}"
        if "prints" in block.marks:
            unseen = [line for line in block.code.splitlines() if not shown(line, printed)]
            assert not unseen, f"{place} shows what nothing has printed:\n" + "\n".join([*unseen, "In", printed])
        elif "file" in block.marks:
            written(folder, block.marks["file"], "w", block.code)
        elif "add to" in block.marks:
            written(folder, block.marks["add to"], "a", "\n" + block.code)
        else:
            printed += done(block, folder, place)


def written(folder: Path, name: str, mode: str, code: str) -> None:
    """Write a block to a file of the folder, or put it at the file's end."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open(mode, encoding="utf-8") as stream:
        stream.write(code)


def done(block: Block, folder: Path, place: str) -> str:
    """Execute or parse one block, and return what it printed."""
    if block.language == "json":
        json.loads(block.code)
    elif block.language in ("sh", "python"):
        return executed(block, folder, place)
    else:
        assert block.language == "text", f"{place} is {block.language or 'of no language'}: say which file it goes to"
    return ""


def executed(block: Block, folder: Path, place: str) -> str:
    """Run one block in a process of its own, and return what it printed."""
    script = folder / ".block.py"
    script.write_text(block.code, encoding="utf-8")
    shell = ["bash", "-euo", "pipefail", "-c", block.code]
    command = shell if block.language == "sh" else [sys.executable, str(script)]
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    env = os.environ | {"PATH": path, "MPLBACKEND": "agg"}
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env=env)
    wanted = int(block.marks.get("exit", "0"))
    told = f"{place} ended with {ended.returncode}, not {wanted}\n{block.code}\n{ended.stdout}\n{ended.stderr}"
    assert ended.returncode == wanted, told
    return ended.stdout + ended.stderr


def shown(line: str, printed: str) -> bool:
    """Return whether a line was printed, its words as they are and its numbers within the tolerance; `...` stands."""
    return line.strip() in ("", "...") or any(alike(line, other) for other in printed.splitlines())


def alike(line: str, other: str) -> bool:
    """Return whether two lines have the same words, and numbers that are close."""
    words = [" ".join(NUMBER.sub("#", text).split()) for text in (line, other)]
    if words[0] != words[1]:
        return False
    pairs = zip(map(float, NUMBER.findall(line)), map(float, NUMBER.findall(other)), strict=True)
    return all(abs(a - b) <= TOLERANCE * max(abs(a), abs(b)) for a, b in pairs)
