"""Options that several commands share: the case, the folder of the results, seed, cores, quiet mode."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from lostmotion.cli._lazy import PluginName, flatten_text, registry_of
from lostmotion.settings import DEFAULT, Settings

Command = Callable[..., Any]


def make_default_folder() -> Path:
    """Return the default folder for the results of the running command, such as `lostmotion-diagnose`."""
    return Path(f"lostmotion-{click.get_current_context().info_name}")


_CASE = click.argument("case", metavar="CASE.toml", type=click.Path(path_type=Path))
_COMMON = (
    click.option(
        "--out",
        default=make_default_folder,
        show_default="lostmotion-COMMAND",
        metavar="DIR",
        type=click.Path(file_okay=False, path_type=Path),
        help="Folder for the results.",
    ),
    click.option(
        "--seed", default=0, show_default=True, type=click.IntRange(0), help="The same seed gives the same bytes."
    ),
    click.option("--jobs", default=2, show_default=True, type=click.IntRange(1), help="Number of cores."),
    click.option("--quiet", is_flag=True, help="Show no progress."),
)


def _parse_settings(ctx: click.Context, option: click.Parameter, given: tuple[str, ...]) -> Settings:
    """Return the settings from texts of the form STAGE.NAME=VALUE."""
    pairs = [text.partition("=") for text in given]
    for text, (_, sign, value) in zip(given, pairs, strict=True):
        if not sign or not value:
            raise click.BadParameter(
                f"{text!r} is not of the form STAGE.NAME=VALUE: write for example select.decisive=4"
            )
    return DEFAULT.changed({key.strip(): value for key, _, value in pairs})


def add_settings_option(command: Command) -> Command:
    """Return the command with the option --set, which changes thresholds; the command gets them as `settings`."""
    return click.option(
        "--set",
        "settings",
        metavar="STAGE.NAME=VALUE",
        multiple=True,
        callback=_parse_settings,
        help="Change a threshold, such as select.decisive=4; `lostmotion settings` lists all of them.",
    )(command)


def add_terms_option(command: Command) -> Command:
    """Return the command with the option --term for terms that are added to the fitted model, as `terms`."""
    return click.option(
        "--term",
        "terms",
        metavar="NAME[@PLACE]",
        type=PluginName("term"),
        multiple=True,
        help="A term to add to the fitted model.",
    )(command)


def add_maps_option(command: Command) -> Command:
    """Return the command with the option --map for maps of the quantifier route, as `maps`."""
    return click.option(
        "--map",
        "maps",
        metavar="FILE.nc|FILE.zarr",
        multiple=True,
        type=click.Path(exists=True, path_type=Path),
        help="A map from `lostmotion map` for the quantifier route; made in DIR if not given.",
    )(command)


def add_model_option(command: Command) -> Command:
    """Return the command with the option --model for a recording that is given in place of a case."""
    return click.option(
        "--model",
        type=PluginName("model"),
        default="",
        help="The model, or equations of motion, if a recording is given.",
    )(command)


def prepare_case(ctx: click.Context, case: Path, out: Path, model: str) -> Path:
    """Return the path of the case; for a recording, a case is written into the folder of the results first."""
    from lostmotion.preparation.beginning import write_first_case
    from lostmotion.recording.formats import is_recording
    from lostmotion.recording.outline import GivenRoles

    if not is_recording(case):
        if model:
            raise click.UsageError(f"--model needs a recording: {case.name} is a case and has its own [model]")
        return case
    out.mkdir(parents=True, exist_ok=True)
    draft = write_first_case(case, out / "case.toml", GivenRoles(), registry_of(ctx), model)
    for line in (*draft.found, *(f"please check: {note}" for note in draft.notes)):
        click.echo(flatten_text(line), err=True)
    return out / "case.toml"


def add_case_options(command: Command) -> Command:
    """Return the command with the argument CASE.toml and the options --out, --seed, --jobs and --quiet."""
    return add_common_options(_CASE(command))


def add_common_options(command: Command) -> Command:
    """Return the command with the options --out, --seed, --jobs and --quiet."""
    for option in reversed(_COMMON):
        command = option(command)
    return command
