"""`lostmotion settings`: the thresholds that decide, each with its reason and its source."""

from __future__ import annotations

import json

import click

from lostmotion.cli._lazy import examples
from lostmotion.cli.options import settable
from lostmotion.settings import Settings


@click.command(
    epilog=examples(
        "lostmotion settings",
        "lostmotion settings select",
        "lostmotion settings --set select.decisive=4 --json     as a result would keep them",
    )
)
@click.argument("stage", required=False, default="")
@click.option("--json", "as_json", is_flag=True, help="Write JSON, for machines.")
@settable
def command(stage: str, as_json: bool, settings: Settings) -> None:
    """List the thresholds that decide what is significant, named and believed, of one STAGE or of all.

    `--set` of diagnose, identify and analyse changes them, and each result keeps those that it was made with.
    """
    told = settings.as_dict()
    if stage and stage not in told:
        raise click.BadParameter(f"there is no stage {stage!r}: there are {', '.join(told)}", param_hint="STAGE")
    if as_json:
        click.echo(json.dumps({stage: told[stage]} if stage else told, indent=1))
        return
    for one in settings:
        if one.key.startswith(f"{stage}." if stage else ""):
            changed = "" if one.value == one.default else f"   (usually {one.default:.6g})"
            click.secho(f"{one.key} = {one.value:.6g}{changed}", bold=True)
            source = f" Source: {one.source}." if one.source else ""
            click.echo(click.wrap_text(one.why + source, 100, "    ", "    "))
