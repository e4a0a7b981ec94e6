"""`lostmotion init`: from a recording that nobody has prepared to a case that can be diagnosed."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Any

import click

from lostmotion.cli._lazy import PluginName, examples, plain, registry_of


@click.command(
    epilog=examples(
        "lostmotion init run1.csv",
        "lostmotion init run1.csv --drive F --response enc --model lin_backlash --out case.toml",
        "lostmotion init emps.mat --drive vir --response qm --unit vir=N --factor vir=35.15 --unit qm=m",
        "lostmotion init decay.csv --rate 2048 --drive none --response acc --unit acc=g",
    )
)
@click.argument("recording", metavar="RECORDING", type=click.Path(path_type=Path))
@click.option("--out", default="case.toml", show_default=True, type=click.Path(dir_okay=False, path_type=Path),
              metavar="FILE", help="Where the case goes.")  # fmt: skip
@click.option("--time", metavar="COLUMN", help="The column of time, where it is not the one that looks like it.")
@click.option("--rate", metavar="HZ", type=click.FloatRange(0.0, min_open=True), help="Samples per second, in place of"
              " a column of time.")  # fmt: skip
@click.option("--drive", metavar="COLUMN", help="What drives the machine, or `none`.")
@click.option("--response", metavar="COLUMN", help="What is measured of its motion.")
@click.option("--unit", "units", metavar="COLUMN=UNIT", multiple=True, help="The unit of a column; again for more.")
@click.option("--factor", "factors", metavar="COLUMN=NUMBER", multiple=True, help="What a column is multiplied by"
              " before its unit, as newtons per volt.")  # fmt: skip
@click.option("--model", type=PluginName("model"), default="", help="The model of the machine; `plugins` lists"
              " them. Or equations of motion, with semicolons between them.")  # fmt: skip
@click.option("--force", is_flag=True, help="Write over a case that is there.")
@click.pass_context
def command(
    ctx: click.Context, /, recording: Path, out: Path, units: tuple[str, ...], factors: tuple[str, ...], model: str,
    force: bool, **roles: Any,
) -> None:  # fmt: skip
    """Look at a recording and write a first case for it: columns, units, rate, a model, wide priors.

    Says which column looks like time, which one drives the machine and which one responds, and what looks wrong. Units
    of the file decide, names of columns where it has none; options say it where a guess is wrong. The case has a remark
    behind each line that was guessed.

    Exit status 0 when the case can be used; 2 where a role cannot be told, or the recording cannot be used: then the
    message says which option helps.
    """
    from lostmotion.preparation.beginning import begun
    from lostmotion.recording.outline import GivenRoles

    if out.exists() and not force:
        raise click.UsageError(f"{out} is there already: give another --out, or --force")
    wishes = GivenRoles(roles["time"], roles["rate"], roles["drive"], roles["response"], dict(_pairs(units, "--unit")))
    gains = {name: _number(name, value) for name, value in _pairs(factors, "--factor")}
    draft = begun(recording, out, wishes, registry_of(ctx), model, gains)
    for line in draft.found:
        click.echo(plain(line))
    for note in draft.notes:
        click.echo(f"  look at this: {plain(note)}")
    click.echo(f"{out} is written. Check it, then: lostmotion diagnose {shlex.quote(str(out))} --out result")


def _pairs(given: tuple[str, ...], option: str) -> list[tuple[str, str]]:
    pairs = [text.rpartition("=") for text in given]
    for text, (name, mark, value) in zip(given, pairs, strict=True):
        if not (name and mark and value):
            raise click.UsageError(f"{option} {text!r} is not understood: wanted COLUMN=VALUE, as {option} F=1")
    return [(name, value) for name, _, value in pairs]


def _number(name: str, value: str) -> float:
    try:
        return float(value)
    except ValueError as err:
        raise click.UsageError(f"--factor {name}={value}: {value!r} is no number") from err
