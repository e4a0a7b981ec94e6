"""`lostmotion identify`: the joint posterior of the parameters of a case."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from lostmotion.cli._lazy import examples, registry_of
from lostmotion.cli.options import (
    add_case_options,
    add_maps_option,
    add_model_option,
    add_settings_option,
    add_terms_option,
    prepare_case,
)
from lostmotion.progress import show_count

if TYPE_CHECKING:
    from lostmotion.identification.identification_run import Identified
    from lostmotion.results.identification import Parameter
    from lostmotion.settings import Settings


@click.command(
    epilog=examples(
        "lostmotion identify case.toml --out result",
        "lostmotion identify case.toml --out result --term coulomb_friction --term viscous_damping@base",
        "lostmotion identify levels.toml --route quantifiers --out result",
        "lostmotion plugins     list the available terms",
    )
)
@add_settings_option
@add_model_option
@add_case_options
@click.option(
    "--route",
    type=click.Choice(["trajectory", "quantifiers"]),
    help="Fit the recordings, or invert chaos measures at levels of the drive; the case decides if not given.",
)
@add_terms_option
@add_maps_option
@click.option("--walkers", type=click.IntRange(1), help="Number of walkers; 16 or more if not given.")
@click.option("--max-steps", default=2000, show_default=True, type=click.IntRange(10), help="Largest number of steps.")
@click.option(
    "--ess", default=1000.0, show_default=True, type=click.FloatRange(1), help="Wanted number of effective draws."
)
@click.option("--fresh", is_flag=True, help="Discard the chain of an earlier run in DIR.")
@click.pass_context
def command(
    ctx: click.Context, /, case: Path, out: Path, model: str, seed: int, jobs: int, quiet: bool, settings: Settings,
    **given: object,
) -> None:  # fmt: skip
    """Estimate the parameters of a case jointly: posterior draws and 95 % intervals.

    The route "trajectory" fits all recordings together. The route "quantifiers" inverts exponents and dimensions at
    several levels of the drive, read from recordings or given as [[levels]], through maps of the model.

    Instead of a case, a recording with clear column names can be given, as for `diagnose`: DIR/case.toml is then
    written first. Check this file.

    Writes identification.json, posterior.nc (for ArviZ), chain.h5 (for emcee) and report.html into DIR. An interrupted
    run continues where it stopped. Exit status 0 when the sampling has ended, converged or not (a chain that has not
    converged gives no intervals); 2 for a case that cannot be used.
    """
    from lostmotion.identification.identification_run import run_identification
    from lostmotion.identification.routes import IdentificationRequest
    from lostmotion.identification.sampling import SamplingPlan

    plan = SamplingPlan(**{key: given.pop(key) for key in ("ess", "max_steps", "walkers")}, limits=settings.chain)  # type: ignore[arg-type]
    order = IdentificationRequest(seed=seed, jobs=jobs, plan=plan, settings=settings, **given)  # type: ignore[arg-type]
    case = prepare_case(ctx, case, out, model)
    with show_count("identify", plan.max_steps, "steps", quiet=quiet) as say:
        steps = 0

        def watch(more: int, says: str) -> None:
            nonlocal steps
            steps += more
            say(steps, plan.max_steps, says)

        done = run_identification(case, out, registry_of(ctx), order, watch)
    if done.posterior.replaced:
        click.echo("The stored chain belongs to another case or to other settings: a new chain was begun.", err=True)
    for line in (*_format_table(done), *done.result.says, *done.result.notes, _format_speed(done)):
        click.echo(line)
    click.echo(str(out / "report.html"))


def _format_table(done: Identified) -> list[str]:
    """Return one line for each parameter, noise levels included, with its interval if there is one."""
    rows = done.result.rows
    width = max(map(len, rows))
    return [f"{name:<{width}}  {_format_row(row)}" for name, row in rows.items()]


def _format_row(row: Parameter) -> str:
    reached = f"ESS {row.ess:.0f}, R-hat {row.rhat:.3f}, tau {row.tau:.1f}"
    if row.median != row.median:
        return f"no interval  ({reached})"
    digits = _count_digits(row.high - row.low, row.median)
    low, median, high = (f"{value:.{digits}g}" for value in (row.low, row.median, row.high))
    return f"{median} {row.unit}  95 % [{low}, {high}]  ({reached})"


def _count_digits(width: float, value: float) -> int:
    """Return the number of significant digits of a value that shows two digits of the interval width."""
    import math

    if not width > 0.0 or value == 0.0:
        return 4
    return max(3, min(12, 2 + math.ceil(math.log10(abs(value) / width))))


def _format_speed(done: Identified) -> str:
    runs, ess = done.posterior.evaluations, float(done.posterior.quality.ess.min())
    return (
        f"{runs} evaluations of the likelihood in {done.seconds:.1f} s: {runs / done.seconds:.0f} per second,"
        f" {ess / done.seconds:.1f} effective draws per second."
    )
