"""`lostmotion diagnose`: find the physics that the model of a case leaves out."""

from __future__ import annotations

from pathlib import Path

import click

from lostmotion.cli._lazy import examples, registry_of
from lostmotion.cli._progress import progress


@click.command(
    epilog=examples(
        "lostmotion diagnose case.toml --out result",
        "lostmotion --plugin my_terms.py diagnose case.toml --out result --seed 1",
    )
)
@click.argument("case", metavar="CASE.toml", type=click.Path(path_type=Path))
@click.option(
    "--out",
    required=True,
    metavar="DIR",
    type=click.Path(file_okay=False, path_type=Path),
    help="Where the results go.",
)
@click.option("--seed", default=0, show_default=True, help="Seed of the starting points and of the posterior draws.")
@click.option("--jobs", default=2, show_default=True, type=click.IntRange(1), help="How many cores to use.")
@click.option("--quiet", is_flag=True, help="Show no progress.")
@click.pass_context
def command(ctx: click.Context, case: Path, out: Path, seed: int, jobs: int, quiet: bool) -> None:
    """Locate the mismatch, say which physics was left out, model it, show that the fit improves.

    Writes diagnosis.json, arrays.nc and report.html into DIR. The last 30 % of the recording (or of several
    recordings) is seen by no fit. Exit status 0 when a diagnosis was reached, 2 for a case that cannot be used.
    """
    from lostmotion.workflow.diagnose import run_diagnosis

    with progress("diagnose", quiet=quiet) as say:
        content = run_diagnosis(case, out, registry_of(ctx), seed=seed, jobs=jobs, say=say)
    for sentence in content["says"]:
        click.echo(sentence)
    click.echo(str(out / "report.html"))
