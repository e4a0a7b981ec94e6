"""The command line: `main` knows its commands by name and imports one when it runs.

Packages add commands by a hook: `demo`, `prove`, `calibrate` and `reproduce` of `lostmotion_trials` come so.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import click

from lostmotion import __version__
from lostmotion.cli._lazy import LazyGroup, PluginName, examples, registry_of
from lostmotion.registry import default

__all__ = ["PluginName", "examples", "main", "registry_of"]


class _Commands(LazyGroup):
    table: ClassVar[Mapping[str, tuple[str, str]]] = {
        "analyse": ("lostmotion.cli.analyse:command", "Tell whether a recorded motion is periodic, chaotic or noise."),
        "diagnose": ("lostmotion.cli.diagnose:command", "Find the physics that the model of a case leaves out."),
        "identify": ("lostmotion.cli.identify:command", "Estimate the parameters of a case, with their intervals."),
        "init": ("lostmotion.cli.init:command", "Look at a recording and write a first case for it."),
        "map": ("lostmotion.cli.map:command", "Map an exponent, or anything else, over parameters."),
        "settings": ("lostmotion.cli.settings:command", "List the thresholds that decide, each with its reason."),
        "simulate": ("lostmotion.cli.simulate:command", "Simulate a machine with or without extra terms."),
        "plugins": ("lostmotion.cli.plugins:command", "List, show and check the models, terms and methods."),
    }


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog=examples(
        "lostmotion demo",
        "lostmotion diagnose CASE.toml --out DIR",
        "lostmotion --plugin my_terms.py diagnose CASE.toml --out DIR",
        'eval "$(_LOSTMOTION_COMPLETE=bash_source lostmotion)"     the Tab key, in bash',
    ),
)
@click.version_option(__version__, prog_name="lostmotion", message="%(prog)s %(version)s")
@click.option(
    "--plugin",
    metavar="FILE.py",
    multiple=True,
    type=click.Path(dir_okay=False),
    help="Use the models and terms written in this Python file too; may be given several times.",
)
@click.pass_context
def main(ctx: click.Context, plugin: tuple[str, ...]) -> None:
    """Find the physics that a machine model leaves out."""
    ctx.obj = default()
    for path in plugin:
        ctx.obj.add_file(path)
