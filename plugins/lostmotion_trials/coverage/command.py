"""`lostmotion calibrate`: test whether the intervals of `identify` cover the truth as often as they state."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lostmotion.cli import examples
from lostmotion.cli.options import add_case_options, add_maps_option, add_terms_option
from lostmotion.progress import show_count

if TYPE_CHECKING:
    from lostmotion_trials.coverage.results import ParameterCheck


@click.command(
    epilog=examples(
        "lostmotion calibrate case.toml --drive harmonic:amplitude=100,omega=40 --duration 4.712 --rate 636.6 \\",
        "    --noise 0.01 --out calibration",
        "lostmotion calibrate case.toml --drive harmonic:amplitude=100,omega=40 --duration 4.712 --rate 636.6 \\",
        "    --noise 0.01 --hide coulomb_friction:force=1 --machines 100 --out lie",
        "lostmotion simulate --help     lists the drives",
    )
)
@add_case_options
@click.option(
    "--drive",
    "drives",
    metavar="KIND:KEY=VALUE,...",
    multiple=True,
    required=True,
    help="Drive of the machines, as in `simulate`; each one that is given makes one recording.",
)
@click.option(
    "--duration", type=float, required=True, metavar="S", help="Duration of each recording, after an equal run-up."
)
@click.option("--rate", type=float, required=True, metavar="HZ", help="Samples per second.")
@click.option(
    "--noise", type=float, required=True, metavar="SHARE", help="Noise of the position over its standard deviation."
)
@click.option(
    "--excitation-noise",
    type=float,
    default=1e-3,
    show_default=True,
    metavar="SHARE",
    help="Noise of the recorded excitation over its amplitude; the true excitation acts on the machine.",
)
@click.option(
    "--hide",
    metavar="NAME[@PLACE]:PARAM=VALUE,...",
    multiple=True,
    help="Term that acts in every machine, whether it is fitted or not.",
)
@add_terms_option
@click.option(
    "--route",
    type=click.Choice(["trajectory", "quantifiers"]),
    default="trajectory",
    show_default=True,
    help="Method that computes the posterior.",
)
@add_maps_option
@click.option("--machines", default=200, show_default=True, type=click.IntRange(1), help="How many machines to draw.")
@click.option("--ess", default=300.0, show_default=True, type=click.FloatRange(100), help="Effective draws for each.")
@click.option("--max-steps", default=2000, show_default=True, type=click.IntRange(10), help="Largest number of steps.")
@click.option("--fresh", is_flag=True, help="Delete an existing campaign instead of continuing it.")
@click.pass_context
def command(ctx: click.Context, /, case: Path, out: Path, drives: tuple[str, ...], **given: Any) -> None:
    """Test by simulation whether the intervals of `identify` cover the truth as often as they state.

    Machines are drawn from the priors of the case, simulated by an integrator that shares no code with the fit, and
    identified; the case needs no recordings. If the posterior is correct, the rank of the truth among its draws is
    uniform, and central intervals cover the truth with their nominal probability (Talts et al. 2018).

    Writes calibration.json, machines.csv and report.html into DIR. The same command continues a campaign that was
    interrupted at any time, or enlarges it with a larger --machines; the files depend neither on that nor on --jobs.
    The exit status is 0 when the campaign was completed, passed or not, and 2 for unusable input.
    """
    from lostmotion.identification.sampling import SamplingPlan
    from lostmotion_trials.coverage.design import Design
    from lostmotion_trials.coverage.machines import Stand
    from lostmotion_trials.coverage.run import run_calibration

    bench = Stand(drives, given["duration"], given["rate"], given["noise"], given["excitation_noise"])
    plan = SamplingPlan(ess=given["ess"], max_steps=given["max_steps"])
    plugins = tuple(str(Path(file).absolute()) for file in ctx.find_root().params.get("plugin") or ())
    maps = tuple(path.absolute() for path in given["maps"])
    chosen = {key: given[key] for key in ("hide", "terms", "route", "seed")}
    design = Design(case.absolute(), bench, plan=plan, plugins=plugins, maps=maps, **chosen)
    with show_count("calibrate", given["machines"], "machines", quiet=given["quiet"]) as say:
        options = {key: given[key] for key in ("machines", "jobs", "fresh")}
        content = run_calibration(design, out, say=say, **options)
    for line in (*_format_table(content.summary.parameters), *content.summary.says):
        click.echo(line)
    click.echo(str(out / "report.html"))


def _format_table(rows: Mapping[str, ParameterCheck]) -> list[str]:
    """Return one line for each parameter: the tests of its ranks, and how many truths its intervals cover."""
    width = max(map(len, rows), default=0)
    return [f"{name:<{width}}  {_format_row(row)}" for name, row in rows.items()]


def _format_row(row: ParameterCheck) -> str:
    covered = ", ".join(f"{share} % {one.inside}/{one.of}" for share, one in row.coverage.items())
    chi2 = "" if math.isnan(row.chi2_p) else f"chi2 p {row.chi2_p:.3f}, "
    tested = f"{chi2}ecdf p {row.ecdf_p:.3f}" if row.drawn else "not drawn"
    return f"{tested}  inside {covered}  rms z {row.rms_z:.2f}"
