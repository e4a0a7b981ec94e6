"""The command line: `main` has a table of its commands and imports a command only when it runs.

Packages add commands by a hook; `demo` and `prove` come from `lostmotion_trials`, `analyse` and `map` from
`lostmotion_chaos` in this way.
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
        "check": ("lostmotion.cli.check:command", "Tell what a recording can tell, before the fit."),
        "diagnose": ("lostmotion.cli.diagnose:command", "Find the physics that the model of a case does not include."),
        "identify": ("lostmotion.cli.identify:command", "Estimate the parameters of a case, with intervals."),
        "init": ("lostmotion.cli.init:command", "Inspect a recording and write a first case for it."),
        "settings": ("lostmotion.cli.settings:command", "List the thresholds of all decisions, with reasons."),
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
        'eval "$(_LOSTMOTION_COMPLETE=bash_source lostmotion)"     activate Tab completion in bash',
    ),
)
@click.version_option(__version__, prog_name="lostmotion", message="%(prog)s %(version)s")
@click.option(
    "--plugin",
    metavar="FILE.py",
    multiple=True,
    type=click.Path(dir_okay=False),
    help="Also load the models and terms in this Python file; may be given several times.",
)
@click.pass_context
def main(ctx: click.Context, plugin: tuple[str, ...]) -> None:
    """Find the physics that a machine model does not include.

    Exit status 0 when a command has finished, 2 for an input that cannot be used, 130 when it was interrupted. The help
    of each command describes its own exit status.
    """
    ctx.obj = default()
    for path in plugin:
        ctx.obj.add_file(path)
