"""`lostmotion analyse`: classify the motion in a recording, with the strength of the evidence."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from lostmotion.cli._lazy import PluginName, examples, registry_of
from lostmotion.cli.options import add_common_options, add_settings_option
from lostmotion.progress import show_progress
from lostmotion_chaos.defaults import EMBEDDER

if TYPE_CHECKING:
    from lostmotion_chaos.results import Analysis, Measure

RATES = ("1/s", "bit/s", "1/period", "bit/period")


@click.command(
    epilog=examples(
        "lostmotion analyse recording.csv --column position --out result",
        "lostmotion analyse case.toml --out result",
        "lostmotion analyse case.toml --out result --unit bit/s --surrogate iaaft --draws 199",
        "lostmotion plugins     list the available embedders, quantifiers, surrogates and denoisers",
    )
)
@click.argument("recording", metavar="CASE.toml|RECORDING", type=click.Path(path_type=Path))
@click.option(
    "--column",
    "columns",
    multiple=True,
    metavar="NAME",
    help="Column of the recording, or recording or sensor of the case. Several, or NAME[*], are joined in order.",
)
@click.option("--time", metavar="COLUMN", help="Column of time, if the automatic choice is wrong.")
@click.option("--rate", type=float, metavar="HZ", help="Samples per second, instead of a time column.")
@click.option("--every", default=1, show_default=True, type=click.IntRange(1), help="Keep every n-th sample.")
@click.option("--period", type=float, metavar="S", help="Period of the drive, if the drive was not recorded.")
@click.option(
    "--embedder",
    type=PluginName("embedder"),
    default=EMBEDDER,
    show_default=True,
    help="How delay and dimension are chosen.",
)
@click.option(
    "--denoiser",
    type=PluginName("denoiser"),
    help="How noise is reduced; 'none' leaves it. If not given, the noise level decides.",
)
@click.option(
    "--quantifier", "quantifiers", type=PluginName("quantifier"), multiple=True, help="A further quantity to estimate."
)
@click.option(
    "--surrogate", "surrogates", type=PluginName("surrogate"), multiple=True, help="A null hypothesis to test."
)
@click.option("--draws", default=99, show_default=True, type=click.IntRange(19, 9999), help="Surrogates for each test.")
@click.option("--unit", default="1/s", show_default=True, type=click.Choice(RATES), help="Unit of the exponents.")
@add_settings_option
@add_common_options
@click.pass_context
def command(ctx: click.Context, /, recording: Path, out: Path, quiet: bool, **asked: object) -> None:
    """Classify a recorded motion as periodic, quasiperiodic, chaotic or noise, with the strength of the evidence.

    The steps are: delay, dimension, noise reduction, largest exponent, correlation dimension, entropy and surrogate
    tests. Writes analysis.json, analysis.nc and report.html into DIR. Exit status 0 when the analysis has finished,
    with any verdict; 2 for a recording that cannot be used.
    """
    from lostmotion_chaos.analysis.run import AnalysisRequest, run_analysis

    with show_progress("analyse", quiet=quiet) as say:
        found = run_analysis(recording, out, registry_of(ctx), AnalysisRequest(**asked), say)  # type: ignore[arg-type]
    likely = "probably " if found.strength == "likely" else ""
    click.echo(f"{likely}{found.verdict}: {found.says}")
    for line in (*_format_numbers(found), *found.notes):
        click.echo(line)
    click.echo(str(out / "report.html"))


def _format_numbers(found: Analysis) -> list[str]:
    """Return one line for each measured quantity."""
    named = (
        ("largest exponent", found.lyapunov),
        ("correlation dimension", found.d2),
        ("correlation entropy", found.k2),
    )
    return [f"{what:<22} {_format_measure(one)}" for what, one in named]


def _format_measure(found: Measure) -> str:
    from lostmotion.results import rounded

    if found.value != found.value:
        return f"no value: {found.says}"
    unit = "" if found.unit == "1" else f" {found.unit}"
    value, low, high = (rounded(number, 3) for number in (found.value, found.low, found.high))
    return f"{value}{unit}  95 % [{low}, {high}]  {found.says}".rstrip()
