"""`lostmotion demo`: friction is hidden in a simulated robot joint, and found."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import click

from lostmotion.cli import examples, registry_of
from lostmotion.progress import show_progress

NOT_FOUND = 1


@click.command(
    epilog=examples(
        "lostmotion demo",
        "lostmotion demo --clean --out clean       nothing is hidden, so nothing must be found",
        "lostmotion diagnose lostmotion-demo/case/case.toml --out again",
    )
)
@click.option(
    "--out",
    default=Path("lostmotion-demo"),
    show_default=True,
    metavar="DIR",
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for the case and the results.",
)
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="Seed of the recording.")
@click.option("--clean", is_flag=True, help="Hide nothing, and test that nothing is found.")
@click.option("--quick", is_flag=True, help="Make the recording half as long.")
@click.option("--no-open", is_flag=True, help="Do not open the report in a browser.")
@click.option("--jobs", default=2, show_default=True, type=click.IntRange(1), help="How many cores to use.")
@click.option("--quiet", is_flag=True, help="Show no progress.")
@click.pass_context
def command(
    ctx: click.Context, out: Path, seed: int, clean: bool, quick: bool, no_open: bool, jobs: int, quiet: bool
) -> None:
    """Hide friction in a simulated robot joint, and find it.

    The recording comes from an integrator that is independent of the models, and encoders add noise. The case is
    written into DIR/case and diagnosed like any other case. The exit status is 0 when exactly the hidden friction was
    found, else 1.
    """
    from lostmotion_trials.demo.run import DemoSetting, run_demo

    begin = time.perf_counter()
    with show_progress("demo", quiet=quiet) as say:
        told = run_demo(out, registry_of(ctx), DemoSetting(seed, clean, quick, jobs), say=say)
    report = out / "report.html"
    click.echo("\n".join(told.lines))
    click.echo(f"took       {time.perf_counter() - begin:.0f} s")
    click.echo(str(report))
    if not no_open and _has_display():
        click.launch(report.resolve().as_uri())
    if not told.right:
        ctx.exit(NOT_FOUND)


def _has_display() -> bool:
    """Return whether the command runs in a terminal with a display, not in a pipe or over a network connection."""
    if os.environ.get("CI") or not sys.stdout.isatty():
        return False
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
