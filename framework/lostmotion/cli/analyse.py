"""`lostmotion analyse`: what kind of motion a recording shows, and how sure that is."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from lostmotion.cli._lazy import PluginName, examples, registry_of
from lostmotion.cli.options import on_a_trial, settable
from lostmotion.cli.progress import progress
from lostmotion.defaults import EMBEDDER
from lostmotion.results import rounded

if TYPE_CHECKING:
    from lostmotion.results.analysis import Analysis, Measure

RATES = ("1/s", "bit/s", "1/period", "bit/period")


@click.command(
    epilog=examples(
        "lostmotion analyse recording.csv --column position --out result",
        "lostmotion analyse case.toml --out result",
        "lostmotion analyse case.toml --out result --unit bit/s --surrogate iaaft --draws 199",
        "lostmotion plugins     the embedders, quantifiers, surrogates and denoisers there are",
    )
)
@click.argument("recording", metavar="CASE.toml|RECORDING", type=click.Path(path_type=Path))
@click.option(
    "--column",
    "columns",
    multiple=True,
    metavar="NAME",
    help="Which column of the recording, or which recording of the case. Several, or NAME[*], are joined in order.",
)
@click.option("--rate", type=float, metavar="HZ", help="The sampling rate, where there is no column 'time'.")
@click.option("--every", default=1, show_default=True, type=click.IntRange(1), help="Keep one sample of so many.")
@click.option("--period", type=float, metavar="S", help="The period of the drive, where it was not recorded.")
@click.option("--embedder", type=PluginName("embedder"), default=EMBEDDER, show_default=True)
@click.option(
    "--denoiser",
    type=PluginName("denoiser"),
    help="How noise is taken off; 'none' leaves it. If not given, what suits the noise.",
)
@click.option("--quantifier", "quantifiers", type=PluginName("quantifier"), multiple=True, help="A further measure.")
@click.option("--surrogate", "surrogates", type=PluginName("surrogate"), multiple=True, help="A null to be tested.")
@click.option("--draws", default=99, show_default=True, type=click.IntRange(19, 9999), help="Surrogates for each test.")
@click.option("--unit", default="1/s", show_default=True, type=click.Choice(RATES), help="Unit of the exponents.")
@settable
@on_a_trial
@click.pass_context
def command(ctx: click.Context, /, recording: Path, out: Path, quiet: bool, **asked: object) -> None:
    """Tell whether a recorded motion is periodic, chaotic, or noise that looks like it, and how sure that is.

    Delay, dimension, noise reduction, largest exponent, correlation dimension and surrogate tests, in this order.
    Writes analysis.json, analysis.nc and report.html into DIR. Exit status 0 when the chain ran to its end, whatever
    it says; 2 for a recording that cannot be used.
    """
    from lostmotion.analysis.run import AnalysisRequest, run_analysis

    with progress("analyse", quiet=quiet) as say:
        found = run_analysis(recording, out, registry_of(ctx), AnalysisRequest(**asked), say)  # type: ignore[arg-type]
    likely = "probably " if found.strength == "likely" else ""
    click.echo(f"{likely}{found.verdict}: {found.says}")
    for line in (*_numbers(found), *found.notes):
        click.echo(line)
    click.echo(str(out / "report.html"))


def _numbers(found: Analysis) -> list[str]:
    """Return one line for each number that was measured."""
    named = (
        ("largest exponent", found.lyapunov),
        ("correlation dimension", found.d2),
        ("correlation entropy", found.k2),
    )
    return [f"{what:<22} {_measure_line(one)}" for what, one in named]


def _measure_line(found: Measure) -> str:
    if found.value != found.value:
        return f"no number: {found.says}"
    unit = "" if found.unit == "1" else f" {found.unit}"
    return (
        f"{rounded(found.value, 3)}{unit}  95 % [{rounded(found.low, 3)}, {rounded(found.high, 3)}]  {found.says}"
    ).rstrip()
