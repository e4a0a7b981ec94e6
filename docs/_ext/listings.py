"""Directives that list plugins, commands and settings from the code, so that the pages are always up to date."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from dataclasses import fields
from typing import Any, ClassVar

import click
from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

import lostmotion
from lostmotion.cli import main
from lostmotion.contracts import KINDS
from lostmotion.registry import Entry, default
from lostmotion.results import STATUSES
from lostmotion.settings import DEFAULT
from lostmotion.testing import rules_for


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer each directive by its name."""
    for directive in (Plugins, Commands, Doors, Statuses, Mechanisms, Rules, Thresholds):
        app.add_directive(directive.__name__.lower(), directive)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


class Plugins(SphinxDirective):
    """All built-in plugins of one kind, with their documentation, attributes and parameters."""

    required_arguments = 1
    option_spec: ClassVar[Any] = {}

    def run(self) -> list[nodes.Node]:
        """Return one section for each name of the kind."""
        kind = self.arguments[0]
        entries = [e for e in default().entries() if e.kind == kind and e.owner == "lostmotion"]
        return [self._section(entry) for entry in entries]

    def _section(self, entry: Entry) -> nodes.section:
        cls = default().load(entry.kind, entry.name)
        section = nodes.section(ids=[nodes.make_id(f"{entry.kind}-{entry.name}")], names=[entry.name])
        section += nodes.title("", "", nodes.literal("", entry.name))
        section += nodes.paragraph("", "", *format_code(" ".join((cls.__doc__ or "").split())))
        section += nodes.field_list("", *(make_field(*pair) for pair in list_attributes(cls)))
        if params := getattr(cls, "params", ()):
            section += make_parameter_table(cls, params)
        if groups := getattr(cls, "groups", ()):
            rows = [(g.name, g.meaning, g.formula) for g in groups]
            section += make_table(("number", "meaning", "formula"), rows)
        return section


def list_attributes(cls: Any) -> Iterator[tuple[str, str]]:
    """Yield the descriptive attributes of a class, as pairs of word and text."""
    for word in ("formula", "null", "unit", "reads", "paper"):
        if isinstance(text := getattr(cls, word, None), str):
            yield {"null": "null hypothesis", "reads": "reads a"}.get(word, word), text
    for word in ("states", "inputs", "channels", "needs"):
        if names := getattr(cls, word, ()):
            yield word, ", ".join(names)
    if kept := getattr(cls, "preserves", ()):
        yield "preserves", ", ".join(sorted(kept))
    if places := getattr(cls, "interfaces", ()):
        yield "places", ", ".join(place.name for place in places)


def make_field(word: str, text: str) -> nodes.field:
    """Return a field of a list; formulas and names are set as code."""
    plain = word in ("paper", "null hypothesis")
    body = nodes.paragraph("", "", nodes.Text(text) if plain else nodes.literal("", text))
    return nodes.field("", nodes.field_name("", word), nodes.field_body("", body))


def format_code(text: str) -> Iterator[nodes.Node]:
    """Yield the pieces of a text; text between backticks is set as code."""
    for i, piece in enumerate(text.split("`")):
        yield nodes.literal("", piece) if i % 2 else nodes.Text(piece)


def make_parameter_table(cls: Any, params: Any) -> nodes.table:
    """Return the table of the parameters of a model or a term; models have no null."""
    motion = getattr(cls, "motion", None) or getattr(cls, "motions", ("translation",))[0]
    rows = [(q.name, q.meaning, q.dimension.unit(motion), format_bounds(q)) for q in params]
    heads = ("parameter", "meaning", "unit", "bounds")
    if all(q.null is None for q in params):
        return make_table(heads, rows)
    nulls = ("" if q.null is None else f"{q.null:g}" for q in params)
    return make_table((*heads, "null"), [(*row, null) for row, null in zip(rows, nulls, strict=True)])


def format_bounds(q: Any) -> str:
    """Return the physical bounds of a parameter in words, none where there are none."""
    low, high = (f"{x:g}" if abs(x) < float("inf") else "" for x in (q.low, q.high))
    if low and high:
        return f"{low} to {high}"
    return f"from {low}" if low else f"to {high}" if high else ""


def make_table(heads: tuple[str, ...], rows: list[tuple[str, ...]]) -> nodes.table:
    """Return a table; its first column is set as code."""
    group = nodes.tgroup(cols=len(heads))
    group += [nodes.colspec(colwidth=1) for _ in heads]
    group += nodes.thead("", nodes.row("", *(make_cell(nodes.Text(head)) for head in heads)))
    lines = [
        nodes.row("", make_cell(nodes.literal("", row[0])), *(make_cell(*format_code(x)) for x in row[1:]))
        for row in rows
    ]
    group += nodes.tbody("", *lines)
    return nodes.table("", group, classes=["narrow"])


def make_cell(*content: nodes.Node) -> nodes.entry:
    """Return one cell."""
    return nodes.entry("", nodes.paragraph("", "", *content))


class GeneratedLines(SphinxDirective):
    """Lines of reStructuredText that `lines` yields, parsed at the place of the directive."""

    def run(self) -> list[nodes.Node]:
        """Return the nodes of the parsed lines."""
        holder = nodes.section()
        self.state.nested_parse(StringList(list(self.lines()), source=self.name), self.content_offset, holder, True)
        return list(holder.children)

    def lines(self) -> Iterator[str]:
        """Yield the lines."""
        raise NotImplementedError


class Commands(GeneratedLines):
    """Every command of `lostmotion`, by sphinx-click; a new command is listed automatically."""

    def lines(self) -> Iterator[str]:
        """Yield a directive for each command."""
        for name, (target, _) in main.find_commands(click.Context(main)).items():
            command = main.get_command(click.Context(main), name)
            nested = "full" if isinstance(command, click.Group) else "none"
            yield from ("", f".. click:: {target}", f"   :prog: lostmotion {name}", f"   :nested: {nested}", "")


class Doors(GeneratedLines):
    """The functions in `lostmotion.__all__`; the classes have sections of their own."""

    def lines(self) -> Iterator[str]:
        """Yield a directive for each name."""
        for name in lostmotion.__all__:
            if not isinstance(getattr(lostmotion, name), type):
                yield from (f".. autofunction:: lostmotion.{name}", "")


class Thresholds(SphinxDirective):
    """The thresholds of the settings, one table for each stage."""

    def run(self) -> list[nodes.Node]:
        """Return a section for each stage."""
        made = []
        for stage in fields(DEFAULT):
            about = inspect.getdoc(type(getattr(DEFAULT, stage.name))) or ""
            section = nodes.section(ids=[f"settings-{stage.name}"], names=[stage.name])
            section += nodes.title("", "", nodes.literal("", stage.name))
            section += nodes.paragraph("", "", *format_code(about))
            own = [one for one in DEFAULT if one.key.startswith(f"{stage.name}.")]
            rows = [
                (one.key, f"{one.value:.4g}", one.unit, " ".join(filter(None, (one.why, one.source)))) for one in own
            ]
            section += make_table(("setting", "value", "unit", "why"), rows)
            made.append(section)
        return made


class Statuses(SphinxDirective):
    """The values of `status` with their meanings."""

    def run(self) -> list[nodes.Node]:
        """Return a table."""
        return [make_table(("status", "meaning"), list(STATUSES.items()))]


class Mechanisms(SphinxDirective):
    """The names of all terms, with the sentences that a diagnosis uses."""

    def run(self) -> list[nodes.Node]:
        """Return a table."""
        names = [e.name for e in default().entries() if e.kind == "term" and e.owner == "lostmotion"]
        return [make_table(("mechanism", "what is said"), [(n, default().load("term", n).physics) for n in names])]


class Rules(SphinxDirective):
    """The rules of the conformance kit, for each kind, with the advice in their docstrings."""

    def run(self) -> list[nodes.Node]:
        """Return a table: rule, kinds, advice."""
        rules = {rule.name: rule for kind in KINDS for rule in rules_for(kind)}
        rows = [(r.name, "all" if len(r.kinds) == len(KINDS) else ", ".join(r.kinds), r.advice) for r in rules.values()]
        return [make_table(("rule", "of", "what to do where it is broken"), rows)]
