"""`lostmotion plugins`: what there is, what it says of itself, and whether it keeps its contract."""

from __future__ import annotations

import json
import platform
from collections import Counter
from dataclasses import MISSING, asdict, fields, is_dataclass
from typing import TYPE_CHECKING, Any

import click

from lostmotion import __version__
from lostmotion.cli._lazy import PluginName, examples, registry_of
from lostmotion.errors import PluginError, nearest
from lostmotion.registry import Entry, Registry

if TYPE_CHECKING:
    from lostmotion.contracts import Param
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
    registry = registry_of(ctx)
    sheets = [_sheet(entry, registry.load(entry.kind, name)) for entry in _called(registry, name)]
    if _wants_json(ctx, as_json):
        _print_json(ctx, plugins=sheets)
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


def _print_json(ctx: click.Context, **content: Any) -> None:
    provenance = {"lostmotion": __version__, "python": platform.python_version(), "command": ctx.command_path}
    content = {"schema": "lostmotion.plugins/1", "provenance": provenance, **content}
    click.echo(json.dumps(content, indent=1, default=str))


def _print_table(entries: tuple[Entry, ...]) -> None:
    rows = [("kind", "name", "owner", "state")]
    rows += [(e.kind, e.name, f"{e.owner} {e.version}".strip(), e.state) for e in entries]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip() for row in rows]
    lines += [f"\n{why}" for why in dict.fromkeys(_complaint(e) for e in entries if e.why)]
    click.echo("\n".join(lines))


def _complaint(entry: Entry) -> str:
    return f"{entry.owner} ({entry.target}): {entry.why}" if entry.kind == "package" else entry.why


def _sheet(entry: Entry, cls: type[Any]) -> dict[str, Any]:
    """Return everything that a class says of itself, as plain data."""
    said = {"kind": entry.kind, "name": entry.name, "owner": f"{entry.owner} {entry.version}".strip()}
    said["about"] = " ".join((cls.__doc__ or "").split())
    words = {key: getattr(cls, key, None) for key in _WORDS}
    sheet: dict[str, Any] = said | {key: word for key, word in words.items() if isinstance(word, str)}
    sheet |= {key: sorted(getattr(cls, key)) for key in _SETS if getattr(cls, key, None)}
    sheet |= {key: list(getattr(cls, key)) for key in _LISTS if getattr(cls, key, None)}
    if places := getattr(cls, "interfaces", None):
        sheet["interfaces"] = [{"name": i.name, "row": i.row, "inertia": i.inertia, "holds": i.holds} for i in places]
    if params := getattr(cls, "params", None):
        motions = getattr(cls, "motions", None) or (cls.motion,)
        sheet["parameters"] = [_parameter(q, motions, entry.kind) for q in params]
    if options := [f for f in fields(cls) if f.init and f.name != "at"] if is_dataclass(cls) else []:
        sheet["options"] = {f.name: None if f.default is MISSING else f.default for f in options}
    if known := getattr(cls, "known_failures", None):
        sheet["known_failures"] = dict(known)
    return sheet


_WORDS = ("physics", "formula", "null", "paper", "motion", "reads", "unit")
_LISTS = ("states", "inputs", "channels", "needs", "motions", "resembles")
_SETS = ("preserves",)


def _parameter(q: Param, motions: tuple[str, ...], kind: str) -> dict[str, Any]:
    """Return a parameter as plain data, with its unit in each kind of motion."""
    sheet: dict[str, Any] = {"name": q.name, "meaning": q.meaning, "units": {m: q.dimension.unit(m) for m in motions}}
    sheet |= {"low": _bound(q.low), "high": _bound(q.high), "scale": q.scale, "null": q.null}
    sheet |= {"typical": q.typical, "aliases": list(q.aliases)}
    return sheet | ({"prior": _prior(q)} if kind == "term" else {})


def _prior(q: Param) -> str:
    """Return how a diagnosis believes in a parameter of a term beforehand, in natural sizes of the recording."""
    if q.choices:
        return f"one of {', '.join(f'{c:g}' for c in q.choices)}"
    sizes = ("drive force", "rms position", "length of the recording" if q.lasting else "time of the motion")
    powers = zip(sizes, (q.dimension.force, q.dimension.length, q.dimension.time), strict=True)
    natural = "".join(
        f" {'*' if n > 0 else '/'} {size}" + (f"^{abs(n)}" if abs(n) > 1 else "") for size, n in powers if n
    )
    form = "log-normal about" if q.scale == "log" else "half-normal of width" if q.low == 0.0 else "normal about 0, sd"
    return f"{form} {q.typical:g}{natural}"


def _bound(value: float) -> float | None:
    """Return a finite bound, or None, since JSON has no infinity."""
    return value if abs(value) < float("inf") else None


def _print_sheet(sheet: dict[str, Any]) -> None:
    click.secho(f"{sheet['name']} ({sheet['kind']} of {sheet['owner']})", bold=True)
    click.echo(click.wrap_text(sheet["about"], 100, "  ", "  "))
    for key in (*_WORDS, *_LISTS, *_SETS):
        if key in sheet:
            value = sheet[key] if isinstance(sheet[key], str) else ", ".join(sheet[key])
            click.echo(click.wrap_text(value, 100, f"  {key:<11}", " " * 13))
    for place in sheet.get("interfaces", ()):
        holds = f", holds {', '.join(place['holds'])}" if place["holds"] else ""
        click.echo(f"  {'interface':<11}{place['name']}: acts on row {place['row']} through {place['inertia']}{holds}")
    for parameter in sheet.get("parameters", ()):
        click.echo(f"  {'parameter':<11}{_parameter_line(parameter)}")
        if "prior" in parameter:
            click.echo(f"  {'':<11}  prior {parameter['prior']}")
    for option, value in sheet.get("options", {}).items():
        click.echo(f"  {'option':<11}{option} = {value!r}")
    for rule, reason in sheet.get("known_failures", {}).items():
        click.echo(f"  {'breaks':<11}{rule}: {reason}")


def _parameter_line(q: dict[str, Any]) -> str:
    units = " or ".join(dict.fromkeys(q["units"].values()))
    low = "-inf" if q["low"] is None else f"{q['low']:g}"
    high = "inf" if q["high"] is None else f"{q['high']:g}"
    null = "" if q["null"] is None else f", does nothing at {q['null']:g}"
    also = f", also called {', '.join(q['aliases'])}" if q["aliases"] else ""
    return f"{q['name']}: {q['meaning']} in {units}, from {low} to {high}, {q['scale']}{null}{also}"


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
