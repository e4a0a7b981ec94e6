"""`lostmotion settings`: list the thresholds of all decisions, each with its reason and its source."""

from __future__ import annotations

import json

import click

from lostmotion.cli._lazy import examples
from lostmotion.cli.options import add_settings_option
from lostmotion.settings import Settings


@click.command(
    epilog=examples(
        "lostmotion settings",
        "lostmotion settings select",
        "lostmotion settings --set select.decisive=4 --json     the form stored in results",
    )
)
@click.argument("stage", required=False, default="")
@click.option("--json", "as_json", is_flag=True, help="Write JSON, for programs.")
@add_settings_option
def command(stage: str, as_json: bool, settings: Settings) -> None:
    """List the thresholds of one STAGE or of all: what is significant, named and converged.

    `--set` of diagnose, identify and analyse changes them, and each result contains the values it was made with. Exit
    status 0; 2 for a setting or a stage that does not exist, or a value outside of its range.
    """
    stages = settings.as_dict()
    if stage and stage not in stages:
        raise click.BadParameter(f"there is no stage {stage!r}: there are {', '.join(stages)}", param_hint="STAGE")
    if as_json:
        click.echo(json.dumps({stage: stages[stage]} if stage else stages, indent=1))
        return
    for one in settings:
        if one.key.startswith(f"{stage}." if stage else ""):
            changed = "" if one.value == one.default else f"   (default {one.default:.6g})"
            unit = "" if one.unit == "1" else f" {one.unit}"
            click.secho(f"{one.key} = {one.value:.6g}{unit}{changed}", bold=True)
            source = f" Source: {one.source}." if one.source else ""
            click.echo(click.wrap_text(one.why + source, 100, "    ", "    "))
