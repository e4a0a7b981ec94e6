"""`lostmotion diagnose`: find the physics that the model of a case, or of each of many cases, leaves out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lostmotion.cli._lazy import PluginName, examples, plain, registry_of
from lostmotion.cli.options import on_a_trial, settable
from lostmotion.cli.progress import counted, progress

if TYPE_CHECKING:
    from lostmotion.settings import Settings


@click.command(
    epilog=examples(
        "lostmotion diagnose case.toml --out result",
        "lostmotion --plugin my_terms.py diagnose case.toml --out result --seed 1",
        "lostmotion diagnose case.toml --set select.decisive=5     odds of 150 for a name, in place of 20",
        "lostmotion diagnose pump.toml crane.toml --out results --jobs 2",
        "lostmotion diagnose run1.csv --model lin_backlash     a case is written first, as `init` does",
        "lostmotion diagnose run1.csv --model \"m*x'' + c*x' + k*x = force\"",
    )
)
@click.argument("cases", metavar="CASE.toml...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--model", type=PluginName("model"), default="", help="The model, or equations of"
              " motion, where a recording is given.")  # fmt: skip
@settable
@on_a_trial
@click.pass_context
def command(ctx: click.Context, /, cases: tuple[Path, ...], out: Path, model: str, **given: Any) -> None:
    """Locate the mismatch, say which physics was left out, model it, show that the fit improves.

    Writes diagnosis.json, arrays.nc and report.html into DIR. The last 30 % of the recording (or of several
    recordings) is seen by no fit. Exit status 0 when a diagnosis was reached, 2 for a case that cannot be used.

    In place of one case there may be a recording whose columns are clear: then DIR/case.toml is written first, with
    what `lostmotion init` guesses. Check it: wide priors and a usual model stand there.

    Of several cases each has a folder in DIR under the name of its file, with those of the folders above in front
    where names clash, and DIR/summary.csv has a line for each. --jobs of them are diagnosed at a time, each on one
    core. Those that cannot be used are set aside and listed, and the rest is done. The same command goes on with a
    batch that was killed, and does anew what was set aside or has changed; the bytes depend neither on that nor on
    --jobs. Exit status 0 when every case reached a diagnosis, 1 when some were set aside, 2 when none could be used.
    """
    if len(cases) > 1:
        _many(ctx, cases, out, **given)
    else:
        _one(ctx, _begun(ctx, cases[0], out, model), out, **given)


def _begun(ctx: click.Context, case: Path, out: Path, model: str) -> Path:
    """Return a case; where a recording was given, one that is written for it into the folder of the results."""
    from lostmotion.preparation.beginning import begun
    from lostmotion.recording import ENDINGS
    from lostmotion.recording.outline import GivenRoles

    if case.suffix[1:].lower() not in ENDINGS:
        if model:
            raise click.UsageError(f"--model goes with a recording: {case.name} is a case, and has its [model]")
        return case
    out.mkdir(parents=True, exist_ok=True)
    draft = begun(case, out / "case.toml", GivenRoles(None, None, None, None, {}), registry_of(ctx), model, {})
    for line in (*draft.found, *(f"look at this: {note}" for note in draft.notes)):
        click.echo(plain(line), err=True)
    return out / "case.toml"


def _one(ctx: click.Context, case: Path, out: Path, *, quiet: bool, seed: int, jobs: int, settings: Settings) -> None:
    from lostmotion.diagnosis.run import run_diagnosis

    with progress("diagnose", quiet=quiet) as say:
        found = run_diagnosis(case, out, registry_of(ctx), seed=seed, jobs=jobs, say=say, settings=settings)
    for sentence in found.says:
        click.echo(sentence)
    click.echo(str(out / "report.html"))


def _many(
    ctx: click.Context, cases: tuple[Path, ...], out: Path, *, quiet: bool, seed: int, jobs: int, settings: Settings
) -> None:
    from lostmotion.campaigns.batch import Batch, named, run_batch
    from lostmotion.campaigns.table import ASIDE, SUMMARY, lines_of

    plugins = tuple(str(Path(file).absolute()) for file in ctx.find_root().params.get("plugin") or ())
    batch = Batch(named(cases), out.absolute(), plugins, seed, settings)
    with counted("diagnose", len(batch.cases), "cases", quiet=quiet) as say:
        rows = run_batch(batch, jobs=jobs, say=say)
    aside = [row for row in rows if row.status == ASIDE]
    for row in aside:
        click.echo(f"lostmotion: {plain(row.case)} is set aside: {plain(row.says)}", err=True)
    for line in (*lines_of(rows), str(out / SUMMARY)):
        click.echo(line)
    if aside:
        ctx.exit(2 if len(aside) == len(rows) else 1)
