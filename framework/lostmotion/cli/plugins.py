"""`lostmotion plugins`: list the plugins, show their descriptions, and check them against their contracts."""

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

_AS_JSON = click.option("--json", "as_json", is_flag=True, help="Write JSON, for programs.")
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
    """List every model, term and method: kind, name, owner, state.

    Exit status 0, also when some plugins cannot be used: the list shows the reason.
    """
    if ctx.invoked_subcommand is None:
        entries = registry_of(ctx).entries()
        _print_json(ctx, plugins=[asdict(e) for e in entries]) if as_json else _print_table(entries)


@command.command(
    short_help="Show the description of a plugin.",
    epilog=examples("lostmotion plugins show lin_backlash", "lostmotion plugins show lugre_friction --json"),
)
@_NAME
@_AS_JSON
@click.pass_context
def show(ctx: click.Context, name: str, as_json: bool) -> None:
    """Show the description of a plugin: physics, formula, parameters with units and bounds, paper, owner.

    Exit status 0; 2 when no usable plugin has this name.
    """
    from lostmotion.cli.sheets import make_sheet
    from lostmotion.codec import to_plain

    registry = registry_of(ctx)
    sheets = [make_sheet(entry, registry.load(entry.kind, name)) for entry in _find_entries(registry, name)]
    if _wants_json(ctx, as_json):
        _print_json(ctx, plugins=[to_plain(sheet) for sheet in sheets])
        return
    for sheet in sheets:
        _print_sheet(sheet)


@command.command(
    short_help="Check plugins against the rules of their kind.",
    epilog=examples(
        "lostmotion plugins check coulomb_friction", "lostmotion --plugin my_terms.py plugins check my_drag my_spring"
    ),
)
@click.argument("names", metavar="NAME...", nargs=-1, required=True, type=PluginName())
@_AS_JSON
@click.pass_context
def check(ctx: click.Context, names: tuple[str, ...], as_json: bool) -> None:
    """Check plugins against the rules of their kind.

    A broken rule that the plugin lists in `known_failures`, with the reason, is reported and does not count. Exit
    status 0 when all rules are kept, 1 when a rule is broken, 2 when no usable plugin has this name.
    """
    from lostmotion import testing

    registry = registry_of(ctx)
    entries = [entry for name in names for entry in _find_entries(registry, name)]
    report = [(e, testing.check(registry.load(e.kind, e.name))) for e in entries]
    if _wants_json(ctx, as_json):
        _print_json(ctx, checks=[{"kind": e.kind, "name": e.name, "rules": [asdict(f) for f in r]} for e, r in report])
    else:
        _print_checks(report)
    ctx.exit(0 if all(f.ok or f.known for _, findings in report for f in findings) else 1)


def _find_entries(registry: Registry, name: str) -> list[Entry]:
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
    lines += [f"\n{why}" for why in dict.fromkeys(_format_complaint(e) for e in entries if e.why)]
    click.echo("\n".join(lines))


def _format_complaint(entry: Entry) -> str:
    return f"{entry.owner} ({entry.target}): {entry.why}" if entry.kind == "package" else entry.why


def _print_sheet(sheet: PluginSheet) -> None:
    from lostmotion.cli.sheets import LIST_FIELDS, SET_FIELDS, TEXT_FIELDS

    click.secho(f"{sheet.name} ({sheet.kind} of {sheet.owner})", bold=True)
    click.echo(click.wrap_text(sheet.about, 100, "  ", "  "))
    for key in (*TEXT_FIELDS, *LIST_FIELDS, *SET_FIELDS):
        if (value := getattr(sheet, key)) is not None:
            text = value if isinstance(value, str) else ", ".join(value)
            click.echo(click.wrap_text(text, 100, f"  {key:<11}", " " * 13))
    for place in sheet.interfaces or ():
        holds = f", holds {', '.join(place.holds)}" if place.holds else ""
        acts = "the step applies its force" if place.row is None else f"acts on row {place.row} through {place.inertia}"
        click.echo(f"  {'interface':<11}{place.name}: {acts}{holds}")
    for parameter in sheet.parameters or ():
        click.echo(f"  {'parameter':<11}{_format_parameter(parameter)}")
        if parameter.prior is not None:
            click.echo(f"  {'':<11}  prior {parameter.prior}")
    for option, default in (sheet.options or {}).items():
        click.echo(f"  {'option':<11}{option} = {default!r}")
    for rule, reason in (sheet.known_failures or {}).items():
        click.echo(f"  {'breaks':<11}{rule}: {reason}")


def _format_parameter(q: ParameterSheet) -> str:
    units = " or ".join(dict.fromkeys(q.units.values()))
    null = "" if q.null is None else f", does nothing at {q.null:g}"
    also = f", also called {', '.join(q.aliases)}" if q.aliases else ""
    return f"{q.name}: {q.meaning} in {units}, from {q.low:g} to {q.high:g}, {q.scale}{null}{also}"


def _print_checks(report: list[tuple[Entry, list[Finding]]]) -> None:
    for entry, findings in report:
        click.secho(f"{entry.name} ({entry.kind} of {entry.owner})", bold=True)
        for finding in findings:
            click.echo(f"  {_get_mark(finding):<5} {finding.rule}")
            if not finding.ok:
                sentence = f"{finding.found}. Known: {finding.known}" if finding.known else finding.sentence
                click.echo(click.wrap_text(sentence, 100, " " * 8, " " * 8))
    many = Counter(_get_mark(f) for _, findings in report for f in findings)
    known = f", {many['known']} known to be broken" if many["known"] else ""
    click.echo(f"{many['ok']} rules kept, {many['FAIL']} broken{known}")


def _get_mark(finding: Finding) -> str:
    """Return how a finding is marked in the list."""
    if finding.ok:
        return "ok"
    return "known" if finding.known else "FAIL"
