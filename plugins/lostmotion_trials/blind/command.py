"""`lostmotion prove`: a blind trial; one process conceals, another diagnoses, a third opens the truths and scores."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lostmotion.cli import PluginName, examples
from lostmotion.cli.options import add_common_options
from lostmotion.progress import show_count

if TYPE_CHECKING:
    from lostmotion_trials.blind.results import Target


SAMPLES = 20_000
"""The usual length of the longest recording."""


@click.command(
    epilog=examples(
        "lostmotion prove --cases 200 --out proof",
        "lostmotion prove --cases 40 --only coulomb_friction --only lugre_friction --out friction",
        "lostmotion prove --cases 300 --clean --out clean     false alarms, some with coloured noise and outliers",
        "lostmotion prove --world imperfect --cases 200 --samples 3000 --out rough     no model is exactly right",
        "lostmotion prove --world arms --cases 100 --wrong 0.05 --out arms     robot arms, with wrong inertias",
        "lostmotion prove --cases 10000 --cluster tcp://host:8786 --out shared/proof     on the workers of a cluster",
    )
)
@click.option("--cases", default=200, show_default=True, type=click.IntRange(1), help="How many cases to conceal.")
@click.option(
    "--only",
    metavar="NAME",
    type=PluginName("term"),
    multiple=True,
    help="Hide only this mechanism; may be given several times.",
)
@click.option("--clean", is_flag=True, help="Hide nothing: a study of false alarms.")
@click.option(
    "--world",
    default="perfect",
    show_default=True,
    type=click.Choice(["perfect", "imperfect", "arms"]),
    help="In an imperfect world machines have imperfections that no term describes, five kinds of drives alternate, and"
    " mechanisms named with a probability above 0.95 are counted. The third world has robot arms with their logs; three"
    " of five hide an effect at one joint.",
)
@click.option(
    "--samples",
    type=click.IntRange(500),
    help="Samples of the longest recording.  [default: 20000; 5000 of each arm]",
)
@click.option("--joints", default=2, show_default=True, type=click.IntRange(2, 7), help="Joints of an arm.")
@click.option("--effects", default=1, show_default=True, type=click.IntRange(1, 3), help="Effects in an arm.")
@click.option(
    "--wrong",
    default=0.0,
    show_default=True,
    type=click.FloatRange(0.0, 0.2),
    help="Share (sd) by which masses, centres, inertias and damping of an arm differ from those of its model.",
)
@click.option(
    "--cluster",
    default="",
    metavar="ADDRESS",
    help="Conceal and diagnose on the workers of a dask cluster. All of them need this version of lostmotion, and DIR"
    " and the plugin files in a shared folder, at the same path on each machine.",
)
@click.option("--fresh", is_flag=True, help="Delete an existing trial instead of continuing it.")
@add_common_options
@click.pass_context
def command(ctx: click.Context, /, out: Path, only: tuple[str, ...], **given: Any) -> None:
    """Run a blind trial of `diagnose` on simulated machines with hidden effects.

    Machines are drawn at random and simulated by an integrator that shares no code with the fit. Their true parameters
    are sealed: digests are published before the first diagnosis. Processes that read only the cases diagnose them. Then
    the truths are opened, checked against the digests, and compared with the answers and with the fit of the true
    model.

    Writes cases/, sealed/, seal.json, proof.json and, except for arms, report.html into DIR. The same command continues
    a trial that was interrupted at any time, or enlarges it with a larger --cases; the files depend neither on that nor
    on --jobs or --cluster. The exit status is 0 when the trial was completed, whatever its result, and 2 for unusable
    input or a truth that differs from the sealed one.
    """
    options = {key: given[key] for key in ("cases", "jobs", "fresh", "cluster")}
    if given["world"] == "arms":
        _prove_arms(out, only, given, options)
        return
    from lostmotion_trials.blind.commitment import Blind
    from lostmotion_trials.blind.run import run_proof

    plugins = tuple(str(Path(file).absolute()) for file in ctx.find_root().params.get("plugin") or ())
    blind = Blind(given["seed"], given["samples"] or SAMPLES, only, given["clean"], given["world"])
    with show_count("prove", given["cases"], "cases", quiet=given["quiet"]) as show:
        content = run_proof(blind, out, plugins=plugins, say=lambda step, done, of: show(done, of, step), **options)
    for line in (*content.summary.says, *map(_format_target, content.summary.targets)):
        click.echo(line)
    click.echo(str(out / "report.html"))


def _prove_arms(out: Path, only: tuple[str, ...], given: dict[str, Any], options: dict[str, Any]) -> None:
    """Run a trial on robot arms, and print its tables."""
    from lostmotion_trials.arms.trial import SAMPLES, ArmsPlan, format_arms, run_arms

    plan = ArmsPlan(
        given["seed"], given["samples"] or SAMPLES, only, given["clean"], given["joints"], given["effects"],
        given["wrong"],
    )  # fmt: skip
    with show_count("prove", given["cases"], "arms", quiet=given["quiet"]) as show:
        content = run_arms(plan, out, say=lambda step, done, of: show(done, of, step), **options)
    for line in format_arms(content):
        click.echo(line)
    click.echo(str(out / "proof.json"))


def _format_target(target: Target) -> str:
    """Return the line about one target and the share that was reached."""
    found = target.rate
    if not found.of:
        return f"{target.state:<9}  {target.what}"
    from lostmotion.results import percent

    share = f"{found.hits}/{found.of} = {percent(found.share)} [{percent(found.low)}, {percent(found.high)}]"
    return (
        f"{target.state:<9}  {target.what}: {share}, expected {percent(target.at_least)} to {percent(target.at_most)}"
    )
