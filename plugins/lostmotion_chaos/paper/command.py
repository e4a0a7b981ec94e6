"""`lostmotion reproduce`: the figures and tables of the paper from our own simulations."""

from __future__ import annotations

from pathlib import Path

import click

from lostmotion.cli import examples, registry_of
from lostmotion.progress import show_progress


@click.command(
    epilog=examples(
        "lostmotion reproduce --out paper                     everything",
        "lostmotion reproduce fig6 table2 --out paper --quick",
    )
)
@click.argument("names", metavar="[all|table1|fig3|...]...", nargs=-1)
@click.option(
    "--out",
    required=True,
    metavar="DIR",
    type=click.Path(file_okay=False, path_type=Path),
    help="Directory for figures, tables and the page.",
)
@click.option("--quick", is_flag=True, help="Shorter runs and coarser sweeps, within two minutes.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="The same seed, the same numbers.")
@click.option("--jobs", default=2, show_default=True, type=click.IntRange(1), help="How many cores to use.")
@click.option("--quiet", is_flag=True, help="Show no progress.")
@click.pass_context
def command(ctx: click.Context, /, names: tuple[str, ...], out: Path, quiet: bool, **asked: object) -> None:
    """Reproduce the paper of Tjahjowidodo, Al-Bender and Van Brussel (2007): figures 3 to 23, tables 1 and 2, and more.

    Each figure has a verdict (reproduced, reproduced in part, not reproduced) and a sentence with the reason. Writes
    PNG and PDF, tables as CSV and Markdown, reproduce.json with the key figures, and index.html with everything into
    DIR. Exit status 0 when the work has finished, whatever the verdicts are; 2 for a name that does not exist or a DIR
    that cannot be used.
    """
    from lostmotion_chaos.paper.run import make_laboratory, reproduce

    lab = make_laboratory(registry_of(ctx), **asked)  # type: ignore[arg-type]
    with show_progress("reproduce", quiet=quiet) as say:
        content = reproduce(names, out, lab, say)
    for name, item in content.items.items():
        click.echo(f"{name:<12} {item.verdict}")
    click.echo(str(out / "index.html"))
