"""What commands have in common: the case, where the results go, seed, cores, silence."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from lostmotion.cli._lazy import PluginName
from lostmotion.settings import DEFAULT, Settings

Command = Callable[..., Any]


def usual_folder() -> Path:
    """Return the folder in which the results of the running command go where nobody says: `lostmotion-diagnose`."""
    return Path(f"lostmotion-{click.get_current_context().info_name}")


_CASE = click.argument("case", metavar="CASE.toml", type=click.Path(path_type=Path))
_COMMON = (
    click.option(
        "--out",
        default=usual_folder,
        show_default="lostmotion-COMMAND",
        metavar="DIR",
        type=click.Path(file_okay=False, path_type=Path),
        help="Where the results go.",
    ),
    click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="The same seed, the same bytes."),
    click.option("--jobs", default=2, show_default=True, type=click.IntRange(1), help="How many cores to use."),
    click.option("--quiet", is_flag=True, help="Show no progress."),
)


def _settings(ctx: click.Context, option: click.Parameter, given: tuple[str, ...]) -> Settings:
    """Return the settings that are meant by words of the form STAGE.NAME=VALUE."""
    pairs = [text.partition("=") for text in given]
    for text, (_, sign, value) in zip(given, pairs, strict=True):
        if not sign or not value:
            raise click.BadParameter(
                f"{text!r} is not of the form STAGE.NAME=VALUE: write for instance select.decisive=4"
            )
    return DEFAULT.changed({key.strip(): value for key, _, value in pairs})


def settable(command: Command) -> Command:
    """Return the command with the option --set, which changes thresholds that decide: `settings` is what it gets."""
    return click.option(
        "--set",
        "settings",
        metavar="STAGE.NAME=VALUE",
        multiple=True,
        callback=_settings,
        help="Change a threshold that decides, such as select.decisive=4; `lostmotion settings` lists them.",
    )(command)


def with_terms(command: Command) -> Command:
    """Return the command with the option --term, terms that are added to the model that is fitted: `terms`."""
    return click.option(
        "--term",
        "terms",
        metavar="NAME[@PLACE]",
        type=PluginName("term"),
        multiple=True,
        help="A term to add to the model that is fitted.",
    )(command)


def with_maps(command: Command) -> Command:
    """Return the command with the option --map, maps that the route by quantifiers looks things up in: `maps`."""
    return click.option(
        "--map",
        "maps",
        metavar="FILE.nc|FILE.zarr",
        multiple=True,
        type=click.Path(exists=True, path_type=Path),
        help="A map for the route by quantifiers, of `lostmotion map`; made in DIR if not given.",
    )(command)


def on_a_case(command: Command) -> Command:
    """Return the command with the argument CASE.toml and the options --out, --seed, --jobs and --quiet."""
    return on_a_trial(_CASE(command))


def on_a_trial(command: Command) -> Command:
    """Return the command with the options --out, --seed, --jobs and --quiet."""
    for option in reversed(_COMMON):
        command = option(command)
    return command
