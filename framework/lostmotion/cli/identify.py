"""`lostmotion identify`: the joint posterior of the parameters of a case."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lostmotion.cli._lazy import examples, registry_of
from lostmotion.cli.options import on_a_case, settable, with_maps, with_terms

if TYPE_CHECKING:
    from lostmotion.identification.run import Identified
    from lostmotion.results.identification import Parameter
    from lostmotion.settings import Settings


@click.command(
    epilog=examples(
        "lostmotion identify case.toml --out result",
        "lostmotion identify case.toml --out result --term coulomb_friction --term viscous_damping@base",
        "lostmotion identify levels.toml --route quantifiers --out result",
        "lostmotion plugins     the terms there are",
    )
)
@settable
@on_a_case
@click.option(
    "--route",
    type=click.Choice(["trajectory", "quantifiers"]),
    help="By the recordings themselves, or by chaos measures at levels of the drive; the case decides if not given.",
)
@with_terms
@with_maps
@click.option("--walkers", type=click.IntRange(1), help="Walkers of the ensemble; 16 or more if not given.")
@click.option("--max-steps", default=2000, show_default=True, type=click.IntRange(10), help="Steps at the most.")
@click.option(
    "--ess", default=1000.0, show_default=True, type=click.FloatRange(1), help="Effective draws of each parameter."
)
@click.option("--fresh", is_flag=True, help="Throw away a chain that an earlier run left in DIR.")
@click.pass_context
def command(
    ctx: click.Context, /, case: Path, out: Path, seed: int, jobs: int, quiet: bool, settings: Settings, **given: object
) -> None:
    """Estimate the parameters of a case jointly, with intervals that hold what was recorded.

    By trajectory the recordings themselves are fitted, all of them together. By quantifiers exponents and dimensions
    at several levels of the drive, read from recordings or typed in as [[levels]], are inverted through maps of the
    model.

    Writes identification.json, posterior.nc (for ArviZ), chain.h5 (for emcee) and report.html into DIR. A run that was
    cut short goes on where it stopped. Exit status 0 when the sampling ended, converged or not; no interval is given of
    a chain that has not converged. 2 for a case that cannot be used.
    """
    from lostmotion.identification.run import IdentificationRequest, run_identification
    from lostmotion.identification.sampling import SamplingPlan

    plan = SamplingPlan(**{key: given.pop(key) for key in ("ess", "max_steps", "walkers")}, limits=settings.chain)  # type: ignore[arg-type]
    order = IdentificationRequest(seed=seed, jobs=jobs, plan=plan, settings=settings, **given)  # type: ignore[arg-type]
    with _bar(plan.max_steps, quiet=quiet) as watch:
        done = run_identification(case, out, registry_of(ctx), order, watch)
    if done.posterior.replaced:
        click.echo("The chain that was kept there belongs to another case or to other settings: begun anew.", err=True)
    for line in (*_table(done), *done.result.says, *done.result.notes, _speed(done)):
        click.echo(line)
    click.echo(str(out / "report.html"))


@contextmanager
def _bar(most: int, *, quiet: bool) -> Iterator[Callable[[int, str], None]]:
    """Yield a function that is told how many steps were taken and how the chain stands."""
    from tqdm import tqdm

    with tqdm(desc="identify", total=most, unit="step", leave=False, disable=True if quiet else None) as bar:

        def watch(steps: int, says: str) -> None:
            bar.set_postfix_str(says, refresh=False)
            bar.update(steps)
            bar.refresh()

        yield watch


def _table(done: Identified) -> list[str]:
    """Return one line for each parameter, noise levels included: its interval, or that there is none."""
    rows = done.result.rows
    width = max(map(len, rows))
    return [f"{name:<{width}}  {_line(row)}" for name, row in rows.items()]


def _line(row: Parameter) -> str:
    reached = f"ESS {row.ess:.0f}, R-hat {row.rhat:.3f}, tau {row.tau:.1f}"
    if row.median != row.median:
        return f"no interval  ({reached})"
    digits = _digits(row.high - row.low, row.median)
    low, median, high = (f"{value:.{digits}g}" for value in (row.low, row.median, row.high))
    return f"{median} {row.unit}  95 % [{low}, {high}]  ({reached})"


def _digits(width: float, value: float) -> int:
    """Return how many figures show two of the width of an interval."""
    import math

    if not width > 0.0 or value == 0.0:
        return 4
    return max(3, min(12, 2 + math.ceil(math.log10(abs(value) / width))))


def _speed(done: Identified) -> str:
    runs, ess = done.posterior.evaluations, float(done.posterior.quality.ess.min())
    return (
        f"{runs} runs of the likelihood in {done.seconds:.1f} s: {runs / done.seconds:.0f} a second,"
        f" {ess / done.seconds:.1f} effective draws a second."
    )
