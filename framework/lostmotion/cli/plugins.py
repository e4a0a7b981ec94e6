"""`lostmotion plugins`: what there is, what it says of itself, and whether it keeps its contract."""

from __future__ import annotations

import json
import platform
from collections import Counter
from dataclasses import asdict
from typing import TYPE_CHECKING

import click

from lostmotion import __version__
from lostmotion.cli._lazy import PluginName, examples, registry_of
from lostmotion.errors import PluginError, nearest
from lostmotion.registry import Entry, Registry

if TYPE_CHECKING:
    from lostmotion.cli.sheets import ParameterSheet, PluginSheet
    from lostmotion.testing import Finding

_AS_JSON = click.option("--json", "as_json", is_flag=True, help="Write JSON, for machines.")
_NAME = click.argument("name", type=PluginName())


@click.group(
    invoke_without_command=True,
    epilog=examples(
        "lostmotion plugins",
        "lostmotion plugins show coulomb_friction",
        "lostmotion plugins check coulomb_friction",
        "lostmotion --plugin my_terms.py plugins check my_drag",
    ),
)
@_AS_JSON
@click.pass_context
def command(ctx: click.Context, as_json: bool) -> None:
    """List every model, term and method: kind, name, owner, state."""
    if ctx.invoked_subcommand is None:
        entries = registry_of(ctx).entries()
        _print_json(ctx, plugins=[asdict(e) for e in entries]) if as_json else _print_table(entries)


@command.command(
    short_help="Show what a plugin says of itself.",
    epilog=examples("lostmotion plugins show lin_backlash", "lostmotion plugins show lugre_friction --json"),
)
@_NAME
@_AS_JSON
@click.pass_context
def show(ctx: click.Context, name: str, as_json: bool) -> None:
    """Show what a plugin says of itself: physics, formula, parameters with units and bounds, paper, owner."""
    from lostmotion.cli.sheets import sheet_of
    from lostmotion.codec import to_plain

    registry = registry_of(ctx)
    sheets = [sheet_of(entry, registry.load(entry.kind, name)) for entry in _called(registry, name)]
    if _wants_json(ctx, as_json):
        _print_json(ctx, plugins=[to_plain(sheet) for sheet in sheets])
        return
    for sheet in sheets:
        _print_sheet(sheet)


@command.command(
    short_help="Hold plugins against the rules of their kind.",
    epilog=examples(
        "lostmotion plugins check coulomb_friction", "lostmotion --plugin my_terms.py plugins check my_drag my_spring"
    ),
)
@click.argument("names", metavar="NAME...", nargs=-1, required=True, type=PluginName())
@_AS_JSON
@click.pass_context
def check(ctx: click.Context, names: tuple[str, ...], as_json: bool) -> None:
    """Hold plugins against the rules of their kind; the exit status is 1 when one is broken.

    A rule that the plugin itself names in `known_failures`, with the reason, is told and does not count.
    """
    from lostmotion import testing

    registry = registry_of(ctx)
    entries = [entry for name in names for entry in _called(registry, name)]
    report = [(e, testing.check(registry.load(e.kind, e.name))) for e in entries]
    if _wants_json(ctx, as_json):
        _print_json(ctx, checks=[{"kind": e.kind, "name": e.name, "rules": [asdict(f) for f in r]} for e, r in report])
    else:
        _print_checks(report)
    ctx.exit(0 if all(f.ok or f.known for _, findings in report for f in findings) else 1)


def _called(registry: Registry, name: str) -> list[Entry]:
    """Return the entries of this name, one for each kind that has it, or raise `PluginError`."""
    named = {e.kind: e for e in registry.entries() if e.name == name}
    if not named:
        known = sorted({e.name for e in registry.entries()})
        raise PluginError(f"no plugin is called {name!r}{nearest(name, known)}: `lostmotion plugins` lists them")
    for entry in named.values():
        if entry.state != "ready":
            raise PluginError(f"{entry.name} cannot be used: {entry.why}")
    return list(named.values())


def _wants_json(ctx: click.Context, as_json: bool) -> bool:
    return as_json or bool(ctx.parent and ctx.parent.params.get("as_json"))


def _print_json(ctx: click.Context, **content: object) -> None:
    provenance = {"lostmotion": __version__, "python": platform.python_version(), "command": ctx.command_path}
    whole = {"schema": "lostmotion.plugins/1", "provenance": provenance, **content}
    click.echo(json.dumps(whole, indent=1, default=str))


def _print_table(entries: tuple[Entry, ...]) -> None:
    rows = [("kind", "name", "owner", "state")]
    rows += [(e.kind, e.name, f"{e.owner} {e.version}".strip(), e.state) for e in entries]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip() for row in rows]
    lines += [f"\n{why}" for why in dict.fromkeys(_complaint(e) for e in entries if e.why)]
    click.echo("\n".join(lines))


def _complaint(entry: Entry) -> str:
    return f"{entry.owner} ({entry.target}): {entry.why}" if entry.kind == "package" else entry.why


def _print_sheet(sheet: PluginSheet) -> None:
    from lostmotion.cli.sheets import LISTS, SETS, WORDS

    click.secho(f"{sheet.name} ({sheet.kind} of {sheet.owner})", bold=True)
    click.echo(click.wrap_text(sheet.about, 100, "  ", "  "))
    for key in (*WORDS, *LISTS, *SETS):
        if (value := getattr(sheet, key)) is not None:
            text = value if isinstance(value, str) else ", ".join(value)
            click.echo(click.wrap_text(text, 100, f"  {key:<11}", " " * 13))
    for place in sheet.interfaces or ():
        holds = f", holds {', '.join(place.holds)}" if place.holds else ""
        click.echo(f"  {'interface':<11}{place.name}: acts on row {place.row} through {place.inertia}{holds}")
    for parameter in sheet.parameters or ():
        click.echo(f"  {'parameter':<11}{_parameter_line(parameter)}")
        if parameter.prior is not None:
            click.echo(f"  {'':<11}  prior {parameter.prior}")
    for option, default in (sheet.options or {}).items():
        click.echo(f"  {'option':<11}{option} = {default!r}")
    for rule, reason in (sheet.known_failures or {}).items():
        click.echo(f"  {'breaks':<11}{rule}: {reason}")


def _parameter_line(q: ParameterSheet) -> str:
    units = " or ".join(dict.fromkeys(q.units.values()))
    null = "" if q.null is None else f", does nothing at {q.null:g}"
    also = f", also called {', '.join(q.aliases)}" if q.aliases else ""
    return f"{q.name}: {q.meaning} in {units}, from {q.low:g} to {q.high:g}, {q.scale}{null}{also}"


def _print_checks(report: list[tuple[Entry, list[Finding]]]) -> None:
    for entry, findings in report:
        click.secho(f"{entry.name} ({entry.kind} of {entry.owner})", bold=True)
        for finding in findings:
            click.echo(f"  {_state(finding):<5} {finding.rule}")
            if not finding.ok:
                sentence = f"{finding.found}. Known: {finding.known}" if finding.known else finding.sentence
                click.echo(click.wrap_text(sentence, 100, " " * 8, " " * 8))
    many = Counter(_state(f) for _, findings in report for f in findings)
    known = f", {many['known']} known to be broken" if many["known"] else ""
    click.echo(f"{many['ok']} rules kept, {many['FAIL']} broken{known}")


def _state(finding: Finding) -> str:
    """Return how a finding is marked in the list."""
    if finding.ok:
        return "ok"
    return "known" if finding.known else "FAIL"
