"""`lostmotion init`: from an unprepared recording to a case that can be diagnosed."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Any

import click

from lostmotion.cli._lazy import PluginName, examples, flatten_text, registry_of


@click.command(
    epilog=examples(
        "lostmotion init run1.csv",
        "lostmotion init run1.csv --drive F --response enc --model lin_backlash --out case.toml",
        "lostmotion init emps.mat --drive vir --response qm --unit vir=N --factor vir=35.15 --unit qm=m",
        "lostmotion init log.csv --mujoco arm.xml --torque motor",
        "lostmotion init decay.csv --rate 2048 --drive none --response acc --unit acc=g",
    )
)
@click.argument("recording", metavar="RECORDING", type=click.Path(path_type=Path))
@click.option("--out", default="case.toml", show_default=True, type=click.Path(dir_okay=False, path_type=Path),
              metavar="FILE", help="Path of the new case file.")  # fmt: skip
@click.option("--time", metavar="COLUMN", help="Column of time, if the automatic choice is wrong.")
@click.option("--rate", metavar="HZ", type=click.FloatRange(0.0, min_open=True), help="Samples per second, instead of a"
              " time column.")  # fmt: skip
@click.option("--drive", metavar="COLUMN", help="Column of the excitation, or `none`.")
@click.option("--response", metavar="COLUMN", help="Column of the measured motion.")
@click.option("--unit", "units", metavar="COLUMN=UNIT", multiple=True, help="Unit of a column; may be repeated.")
@click.option("--factor", "factors", metavar="COLUMN=NUMBER", multiple=True, help="Factor on a column before its"
              " unit, such as newtons per volt.")  # fmt: skip
@click.option("--differences", metavar="COLUMN", multiple=True, help="Column of changes since the row before, such as"
              " counts of an encoder: they are summed.")  # fmt: skip
@click.option("--model", type=PluginName("model"), default="", help="Model of the machine (`plugins` lists them),"
              " or equations of motion separated by semicolons.")  # fmt: skip
@click.option("--mujoco", metavar="FILE", type=click.Path(path_type=Path), help="MJCF file of a robot, whose joints are"
              " matched with columns by name.")  # fmt: skip
@click.option("--urdf", metavar="FILE", type=click.Path(path_type=Path), help="The same for a URDF file.")
@click.option("--torque", type=click.Choice(["motor", "link"]), help="The side of the gear where the torque of a robot"
              " was measured: motor for currents and commands, link for a sensor behind the gear.")  # fmt: skip
@click.option("--force", is_flag=True, help="Overwrite an existing case.")
@click.pass_context
def command(
    ctx: click.Context, /, recording: Path, out: Path, units: tuple[str, ...], factors: tuple[str, ...], model: str,
    differences: tuple[str, ...], force: bool, **roles: Any,
) -> None:  # fmt: skip
    """Inspect a recording and write a first case for it: columns, units, rate, a model, wide priors.

    Reports which column is time, which is the excitation and which is the response, and possible errors in the data.
    The units in the file decide, or the column names where there are no units; options correct a wrong guess. Each
    guessed line of the case has a comment.

    With --mujoco or --urdf it is a case of a robot: each joint gets the columns that have its name or its number.

    Exit status 0 when the case can be used; 2 when a role cannot be determined or the recording cannot be used. The
    message then names the option that helps.
    """
    from lostmotion.preparation.beginning import write_first_case
    from lostmotion.recording.outline import GivenRoles

    if out.exists() and not force:
        raise click.UsageError(f"{out} exists already: give another --out, or --force")
    gains = {name: _parse_number(name, value) for name, value in _split_pairs(factors, "--factor")}
    stated = dict(_split_pairs(units, "--unit"))
    robots = {kind: file for kind in ("mujoco", "urdf") if (file := roles[kind]) is not None}
    if robots:
        _write_robot_case(ctx, recording, out, robots, {**roles, "model": model}, stated, gains)
        return
    if roles["torque"]:
        raise click.UsageError("--torque belongs to a robot: give --mujoco FILE or --urdf FILE too")
    wishes = GivenRoles(
        roles["time"],
        roles["rate"],
        roles["drive"],
        roles["response"],
        stated,
        differences,
    )
    draft = write_first_case(recording, out, wishes, registry_of(ctx), model, gains)
    for line in draft.found:
        click.echo(flatten_text(line))
    for note in draft.notes:
        click.echo(f"  please check: {flatten_text(note)}")
    click.echo(f"{out} is written. Check it, then run: lostmotion diagnose {shlex.quote(str(out))} --out result")


def _write_robot_case(
    ctx: click.Context, log: Path, out: Path, robots: dict[str, Path], roles: dict[str, Any], units: dict[str, str],
    factors: dict[str, float],
) -> None:  # fmt: skip
    from lostmotion.robots.arm_first_case import RobotRoles, write_robot_case

    for name in ("model", "drive", "response"):
        if roles[name]:
            raise click.UsageError(f"--{name} does not belong to a robot: leave it out, or --mujoco and --urdf")
    if len(robots) > 1:
        raise click.UsageError("--mujoco and --urdf name two models: give one of them")
    ((kind, file),) = robots.items()
    given = RobotRoles(roles["time"], roles["rate"], roles["torque"], units, factors)
    draft = write_robot_case(log, out, kind, file, given, registry_of(ctx))
    for line in draft.found:
        click.echo(flatten_text(line))
    for note in draft.notes:
        click.echo(f"  please check: {flatten_text(note)}")
    if not roles["torque"]:
        click.echo('  please add: torque = "motor" or "link", the side of the gear where the torque was measured')
    click.echo(f"{out} is written. Check it, then run: lostmotion diagnose {shlex.quote(str(out))} --out result")


def _split_pairs(given: tuple[str, ...], option: str) -> list[tuple[str, str]]:
    pairs = [text.rpartition("=") for text in given]
    for text, (name, mark, value) in zip(given, pairs, strict=True):
        if not (name and mark and value):
            raise click.UsageError(f"{option} {text!r} is not understood: expected COLUMN=VALUE, as {option} F=1")
    return [(name, value) for name, _, value in pairs]


def _parse_number(name: str, value: str) -> float:
    try:
        return float(value)
    except ValueError as err:
        raise click.UsageError(f"--factor {name}={value}: {value!r} is not a number") from err
