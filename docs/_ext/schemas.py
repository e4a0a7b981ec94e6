"""The directive `keys`: the meaning of each key of a result file, from the class that is written to it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import import_module
from itertools import groupby
from typing import Any, ClassVar

from docutils import nodes
from listings import format_code, make_table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from lostmotion.codec import SchemaEntry, schema

HEADS = ("key", "type", "unit", "meaning")


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer `keys`."""
    app.add_directive("keys", Keys)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


class Keys(SphinxDirective):
    """The keys of a class such as `lostmotion.results.diagnosis.Diagnosis`, by the first part of the key."""

    required_arguments = 1
    option_spec: ClassVar[Any] = {}

    def run(self) -> list[nodes.Node]:
        """Return a table of the keys that stand alone, and a section with a table for each that holds others."""
        module, _, name = self.arguments[0].rpartition(".")
        groups = [
            list(group)
            for _, group in groupby(drop_repeated(schema(getattr(import_module(module), name))), get_first_part)
        ]
        alone = [group[0] for group in groups if len(group) == 1]
        return [make_table(HEADS, alone), *(make_section(name, *group) for group in groups if len(group) > 1)]


def get_first_part(entry: SchemaEntry) -> str:
    """Return the first part of a key: `found` of `found[].parameters.NAME.median`."""
    return re.split(r"[.\[]", entry.path)[0]


def make_section(name: str, head: SchemaEntry, *entries: SchemaEntry) -> nodes.section:
    """Return the section of a key that holds others."""
    first = get_first_part(head)
    made = nodes.section(ids=[nodes.make_id(f"{name}-{first}")], names=[nodes.fully_normalize_name(f"{name} {first}")])
    made += nodes.title("", "", nodes.literal("", first))
    made += nodes.paragraph("", "", *format_code(f"{head.doc[:1].upper()}{head.doc[1:]} ({head.type})."))
    made += make_table(HEADS, entries)
    return made


def drop_repeated(entries: Iterator[SchemaEntry]) -> Iterator[SchemaEntry]:
    """Yield entries without the keys of an object that is equal to an earlier one, and refer to that one."""
    rows, told, hidden = list(entries), {}, None
    for row in rows:
        if hidden and row.path.startswith(hidden):
            continue
        inside = f"{row.path}."
        keys = tuple((one.path.removeprefix(inside), *one[1:]) for one in rows if one.path.startswith(inside))
        first = told.setdefault(keys, row.path)
        hidden = inside if len(keys) > 1 and first != row.path else None
        yield row._replace(doc=f"{row.doc}; its keys are those of `{first}`") if hidden else row
