"""Captions of code blocks: the comment that makes a test write a block to a file becomes the caption of the block.

`<!-- file: case.toml -->` gives the name of the file as the caption; `<!-- prints -->` marks a block of output.
"""

from __future__ import annotations

import re

from sphinx.application import Sphinx

NAMED = re.compile(r"^<!-- (file|add to): (\S+) -->\n```(\w+)\n", re.MULTILINE)
PRINTED = re.compile(r"^<!-- prints -->\n```text\n", re.MULTILINE)
CAPTIONS = {"file": "{}", "add to": "{}, at its end"}


def setup(app: Sphinx) -> dict[str, bool]:
    """Change pages as they are read."""
    app.connect("source-read", add_captions)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def add_captions(app: Sphinx, page: str, source: list[str]) -> None:
    """Turn the comments of a page into captions and classes of its blocks."""
    source[0] = PRINTED.sub("```{code-block} text\n:class: printed\n\n", NAMED.sub(format_head, source[0]))


def format_head(found: re.Match[str]) -> str:
    """Return the head of a block with its caption."""
    return f"```{{code-block}} {found[3]}\n:caption: {CAPTIONS[found[1]].format(found[2])}\n\n"
