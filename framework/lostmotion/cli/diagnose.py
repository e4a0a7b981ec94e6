"""`lostmotion diagnose`: find the physics that the model of one case, or of each of several cases, does not include."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lostmotion.cli._lazy import examples, flatten_text, registry_of
from lostmotion.cli.options import add_common_options, add_model_option, add_settings_option, prepare_case
from lostmotion.progress import show_count, show_progress

if TYPE_CHECKING:
    from lostmotion.settings import Settings

BUDGET = "Processor time of the search; it tells what it did not try. Default: by the length of the recording."


@click.command(
    epilog=examples(
        "lostmotion diagnose case.toml --out result",
        "lostmotion --plugin my_terms.py diagnose case.toml --out result --seed 1",
        "lostmotion diagnose case.toml --set select.decisive=5     require odds of 150 instead of 20 for a term",
        "lostmotion diagnose case.toml --budget 60     search for at most one minute of processor time",
        "lostmotion diagnose pump.toml crane.toml --out results --jobs 2",
        "lostmotion diagnose run1.csv --model lin_backlash     write a case first, as `init` does",
        "lostmotion diagnose run1.csv --model \"m*x'' + c*x' + k*x = force\"",
    )
)
@click.argument("cases", metavar="CASE.toml...", nargs=-1, required=True, type=click.Path(path_type=Path))
@add_model_option
@click.option("--budget", type=click.FloatRange(min=0.0), default=None, metavar="SECONDS", help=BUDGET)
@add_settings_option
@add_common_options
@click.pass_context
def command(
    ctx: click.Context, /, cases: tuple[Path, ...], out: Path, model: str, budget: float | None, **given: Any
) -> None:
    """Locate the mismatch, name the missing physics, model it, and show that the fit improves.

    Writes diagnosis.json, arrays.nc and report.html into DIR. No fit uses the last 30 % of the recording, or of the
    list of several recordings. Exit status 0 when a diagnosis was reached, 2 for a case that cannot be used.

    Ctrl+C during the search ends the search, and the result is the best explanation so far; a second one ends the
    command.

    Instead of one case, a recording with clear column names can be given: then DIR/case.toml is written first, with the
    guesses of `lostmotion init`. Check this file: it has wide priors and a default model.

    With several cases, each has a folder in DIR with the name of its file (prefixed with the names of parent folders
    where names are equal), and DIR/summary.csv has a line for each. --jobs cases are diagnosed at the same time, each
    on one core. Cases that cannot be used are set aside and listed, and the others are diagnosed. The same command
    continues an interrupted batch, and repeats cases that were set aside or have changed; the bytes depend neither on
    interruptions nor on --jobs. Exit status 0 when every case reached a diagnosis, 1 when some were set aside, 2 when
    none could be used.
    """
    if budget is not None:
        given["settings"] = replace(given["settings"], select=replace(given["settings"].select, budget=budget))
    if len(cases) > 1:
        _diagnose_many(ctx, cases, out, **given)
    else:
        _diagnose_one(ctx, prepare_case(ctx, cases[0], out, model), out, **given)


def _diagnose_one(
    ctx: click.Context, case: Path, out: Path, *, quiet: bool, seed: int, jobs: int, settings: Settings
) -> None:
    from lostmotion.case.reading import parse_case
    from lostmotion.simulators import INVERSE

    model = parse_case(case).get("model")
    if isinstance(model, dict) and {INVERSE, *registry_of(ctx).names("simulator")} & model.keys():
        _diagnose_robot(ctx, case, out, quiet=quiet, settings=settings)
        return
    from lostmotion.case import GUESSED
    from lostmotion.diagnosis.diagnosis_run import run_diagnosis

    with show_progress("diagnose", quiet=quiet) as say:
        found = run_diagnosis(case, out, registry_of(ctx), seed=seed, jobs=jobs, say=say, settings=settings)
    for sentence in (*found.says, *(note for note in found.notes if note.startswith(GUESSED))):
        click.echo(sentence)
    click.echo(str(out / "report.html"))


def _diagnose_robot(ctx: click.Context, case: Path, out: Path, *, quiet: bool, settings: Settings) -> None:
    from lostmotion.robots.arm_run import run_robot

    with show_progress("diagnose", quiet=quiet) as say:
        found = run_robot(case, out, registry_of(ctx), budget=settings.select.budget or None, say=say)
    for sentence in found.says:
        click.echo(sentence)
    click.echo(str(out / "report.html"))


def _diagnose_many(
    ctx: click.Context, cases: tuple[Path, ...], out: Path, *, quiet: bool, seed: int, jobs: int, settings: Settings
) -> None:
    from lostmotion.campaigns.batch import Batch, name_cases, run_batch
    from lostmotion.campaigns.summary import ASIDE, SUMMARY, format_summary

    plugins = tuple(str(Path(file).absolute()) for file in ctx.find_root().params.get("plugin") or ())
    batch = Batch(name_cases(cases), out.absolute(), plugins, seed, settings)
    with show_count("diagnose", len(batch.cases), "cases", quiet=quiet) as say:
        rows = run_batch(batch, jobs=jobs, say=say)
    aside = [row for row in rows if row.status == ASIDE]
    for row in aside:
        click.echo(f"lostmotion: {flatten_text(row.case)} is set aside: {flatten_text(row.says)}", err=True)
    for line in (*format_summary(rows), str(out / SUMMARY)):
        click.echo(line)
    if aside:
        ctx.exit(2 if len(aside) == len(rows) else 1)
