"""`lostmotion diagnose`: find the physics that the model of a case leaves out."""

from __future__ import annotations

from pathlib import Path

import click

from lostmotion.cli._lazy import examples, registry_of
from lostmotion.cli._options import on_a_case
from lostmotion.cli._progress import progress


@click.command(
    epilog=examples(
        "lostmotion diagnose case.toml --out result",
        "lostmotion --plugin my_terms.py diagnose case.toml --out result --seed 1",
    )
)
@on_a_case
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
