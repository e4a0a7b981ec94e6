"""`lostmotion check`: what the recording of a case can tell, before the fit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from lostmotion.cli._lazy import examples, registry_of
from lostmotion.cli.options import add_common_options, add_model_option, add_settings_option, prepare_case
from lostmotion.errors import CaseError
from lostmotion.progress import show_progress


@click.command(
    epilog=examples(
        "lostmotion check case.toml",
        "lostmotion check case.toml --out checked     the folder for check.json and check.html",
        "lostmotion check case.toml --json     the same as JSON, for programs",
        "lostmotion check run1.csv --model lin_backlash     write a case first, as `init` does",
    )
)
@click.argument("case", metavar="CASE.toml", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Write JSON, for programs.")
@add_model_option
@add_settings_option
@add_common_options
@click.pass_context
def command(ctx: click.Context, /, case: Path, out: Path, model: str, as_json: bool, quiet: bool, **given: Any) -> None:
    """Tell what a recording can tell before terms are fitted, in seconds.

    From the nominal model, the recorded drive and the noise: the expected 95 % interval of each estimated parameter,
    parameters and terms that this recording cannot tell apart, the smallest size of each missing term that would be
    named with a probability of 90 %, and changes of the experiment that would help.

    For the case of a robot: what is looked at before a diagnosis fits anything, such as signs, units, the order of
    joints, gravity and clocks; it writes no files.

    Writes check.json and check.html into DIR. Exit status 0 when the check was made, 2 for a case that cannot be used.
    """
    path = prepare_case(ctx, case, out, model)
    from lostmotion.robots import is_robot_case

    if is_robot_case(path, registry_of(ctx)):
        if as_json:
            raise CaseError(f"{path.name} is the case of a robot, whose check has no JSON: leave out --json")
        _check_robot(path, ctx, quiet=quiet)
        return
    from lostmotion.codec import to_plain
    from lostmotion.diagnosis.recording_check import run_check

    with show_progress("check", quiet=quiet or as_json) as say:
        found = run_check(path, out, registry_of(ctx), say=say, **given)
    if as_json:
        click.echo(json.dumps(to_plain(found), indent=1))
        return
    for sentence in (*found.says, *found.notes):
        click.echo(sentence)
    click.echo(str(out / "check.html"))


def _check_robot(path: Path, ctx: click.Context, *, quiet: bool) -> None:
    """Print what is looked at before any fit of the case of a robot."""
    from lostmotion.robots.arm_run import check_robot

    with show_progress("check", quiet=quiet) as say:
        say("tape")
        found = check_robot(path, registry_of(ctx))
    for sentence in found:
        click.echo(sentence)
