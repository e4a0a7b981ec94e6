"""`lostmotion map`: map quantities of a machine over its parameters; an interrupted map is continued."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lostmotion.cli._lazy import PluginName, examples, registry_of
from lostmotion.progress import show_count

if TYPE_CHECKING:
    from lostmotion_chaos.maps.map import Map

_AXIS = "NAME=LOW:HIGH:N[:log|inverse]"


@click.command(
    epilog=examples(
        "lostmotion map --model lin_backlash --x alpha=0.1:0.67:128:inverse --y zeta=0.005:0.05:128 --out map.zarr",
        "lostmotion map --model lin_backlash --x alpha=0.1:0.67:33:inverse --y zeta=0.005:0.05:33 --refine 3 \\",
        "    --unit bit --figure --out fine.zarr",
        "lostmotion map --model lin_backlash --set zeta=0.02 --set alpha=0.244 --starts 1 \\",
        "    --x start.position=-3:3:100 --y start.velocity=-1:1:100 --out basins.nc",
        "lostmotion map --model lin_backlash --set m=1 --set c=8 --set k0=4e4 --set x0=0.005 \\",
        "    --term coulomb_friction --drive harmonic:omega=40 \\",
        "    --x coulomb_friction.force=0:10:20 --y drive.amplitude=50:300:20 --out friction.zarr",
    )
)
@click.option("--model", required=True, type=PluginName("model"), help="Model of the machine.")
@click.option(
    "--motion",
    type=click.Choice(["translation", "rotation"]),
    default=None,
    help="Use N and m, or N m and rad, if the model allows both (see `plugins show`).",
)
@click.option("--x", "x", metavar=_AXIS, help="The first axis; `inverse` spaces 1/NAME evenly.")
@click.option("--y", "y", metavar=_AXIS, help="The second axis.")
@click.option("--axis", "more", metavar=_AXIS, multiple=True, help="A further axis; may be given several times.")
@click.option("--set", "sets", metavar="NAME=VALUE", multiple=True, help="A fixed value; the same names as for axes.")
@click.option(
    "--term",
    "terms",
    metavar="NAME[@PLACE][:PARAM=VALUE,...]",
    type=PluginName("term"),
    multiple=True,
    help="A term to add to the model.",
)
@click.option("--drive", default="", metavar="harmonic:KEY=VALUE,...", help="amplitude, omega or frequency, phase.")
@click.option("--periods", default=600, show_default=True, type=click.IntRange(40), help="Periods that are evaluated.")
@click.option(
    "--transient", default=200, show_default=True, type=click.IntRange(0), help="Periods before these, not evaluated."
)
@click.option(
    "--starts", default=4, show_default=True, type=click.IntRange(1, 10_000), help="Initial states in each cell."
)
@click.option(
    "--quantity",
    "--quantifier",
    "quantities",
    metavar="NAME",
    type=PluginName("quantifier"),
    multiple=True,
    help="A further quantifier, such as kaplan_yorke, or d2, which takes about a second for each start.",
)
@click.option("--unit", default="nat", show_default=True, type=click.Choice(["nat", "bit"]), help="Unit of exponents.")
@click.option(
    "--refine",
    default=0,
    metavar="LEVELS",
    type=click.IntRange(0),
    help="Number of halvings of squares at the boundary of chaos.",
)
@click.option(
    "--seed", default=0, show_default=True, type=click.IntRange(0), help="The same seed gives the same bytes."
)
@click.option("--jobs", default=0, metavar="N", type=click.IntRange(0), help="Threads; one for each core if not given.")
@click.option("--cluster", "address", default="", metavar="ADDRESS", help="Compute on the workers of a dask cluster.")
@click.option(
    "--out", required=True, metavar="FILE.zarr|FILE.nc", type=click.Path(path_type=Path), help="Path of the map."
)
@click.option("--figure", is_flag=True, help="Also draw the map, as FILE.png.")
@click.option("--fresh", is_flag=True, help="Discard an existing map instead of continuing it.")
@click.option("--quiet", is_flag=True, help="Show no progress.")
@click.pass_context
def command(
    ctx: click.Context,
    /,
    x: str | None,
    y: str | None,
    more: tuple[str, ...],
    out: Path,
    **settings: object,
) -> None:
    """Map the largest Lyapunov exponent of a machine over its parameters, cell by cell, from several starts.

    \b
    An axis may be
      alpha, zeta, ...             a dimensionless number of the model
      c, coulomb_friction.force    a parameter of the model or of a term
      drive.amplitude, drive.omega, drive.phase
      start.position, ...          an initial state, for a map of basins of attraction

    If no parameter of the model is named, the model is normalised: all parameters that set a scale are one, omega is
    0.2 unless given, and exponents are per t_bar. The same command continues an interrupted map; the bytes depend
    neither on interruptions nor on the number of workers. Exit status 0 when the map is complete, 2 when it cannot be
    made.
    """  # noqa: D301 - click wants the character itself
    from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
    from lostmotion_chaos.maps.sweep import Workers

    own = {key: settings.pop(key) for key in ("refine", "jobs", "address", "figure", "fresh", "quiet")}
    axes = tuple(text for text in (x, y, *more) if text)
    study = make_study(Request(axes=axes, **settings), registry_of(ctx))  # type: ignore[arg-type]
    options = RunOptions(Workers(own["jobs"], own["address"]), own["refine"], own["fresh"])  # type: ignore[arg-type]
    begin = time.perf_counter()
    with show_count("map", 0, "cells", quiet=bool(own["quiet"])) as show:
        done = last = of = 0

        def say(finished: int, total: int) -> None:
            nonlocal done, last, of
            if total == of and finished >= last:  # otherwise another pass begins, with what was done before
                done += finished - last
            last, of = finished, total
            show(finished, total)

        found = make_map(study, out, options, say)
    click.echo(_format_summary(out, found))
    for name in study.further:
        _report_failures(name, found)
    if done:
        seconds = time.perf_counter() - begin
        each = seconds / (done * study.starts * (study.periods + study.transient))
        click.echo(f"{done} cells computed in {seconds:.1f} s, {1e6 * each:.2f} us per cell and period")
    if own["figure"]:
        from lostmotion_chaos.maps.figure import save

        click.echo(str(save(found.dataset, out.with_suffix(".png"))))


def _report_failures(name: str, found: Map) -> None:
    """Report on standard error for how many motions a further quantifier failed."""
    from lostmotion_chaos.maps.cells import CODES

    flags = found.dataset[f"{name}_status"].to_numpy()
    if failed := int((flags == CODES["failed"]).sum()):
        says = f"{name} has no value for {failed} of {flags.size} motions: it failed there"
        click.echo(f"lostmotion: warning: {says} (`lostmotion plugins check {name}`)", err=True)


def _format_summary(out: Path, found: Map) -> str:
    """Return one line about a finished map."""
    shape = " x ".join(f"{found.dataset.sizes[name]} {name}" for name in found.axes)
    flags = found.dataset["status"].to_numpy()
    share = 100.0 * float(found.share.mean())
    doubtful = 100.0 * float((flags != 0).mean())
    return f"{out}: {shape}, {found.dataset.sizes['start']} starts; {share:.0f} % chaotic, {doubtful:.0f} % uncertain"
