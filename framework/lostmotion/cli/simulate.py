"""`lostmotion simulate`: write a table of the simulated motion of a machine, with or without additional terms."""

from __future__ import annotations

from pathlib import Path

import click

from lostmotion.cli._lazy import PluginName, examples, registry_of

_JOINT_PARAMETERS = "--set m=0.05 --set c=0.15 --set k0=180 --set x0=0.0131"


@click.command(
    epilog=examples(
        "lostmotion simulate lin_backlash --set m=1 --set c=8 --set k0=4e4 --set x0=0.005 \\",
        "    --term coulomb_friction:force=3 --drive harmonic:amplitude=100,omega=40 \\",
        "    --duration 15 --rate 1000 --noise 0.01 --out friction.csv",
        f"lostmotion simulate robot_joint {_JOINT_PARAMETERS} \\",
        "    --term coulomb_friction@base:force=0.03 --drive harmonic:amplitude=0.05236,frequency=1.54 \\",
        "    --initial position=0.05 --duration 39 --rate 200 --out joint.nc",
        "lostmotion plugins show lin_backlash     show its parameters with units",
    )
)
@click.argument("model", type=PluginName("model"))
@click.option("--set", "sets", metavar="NAME=VALUE", multiple=True, help="A parameter of the model or of a term.")
@click.option(
    "--term",
    "terms",
    metavar="NAME[@PLACE][:PARAM=VALUE,...]",
    type=PluginName("term"),
    multiple=True,
    help="A term to add; it acts at the ground unless a PLACE of the model is given.",
)
@click.option(
    "--motion",
    type=click.Choice(["translation", "rotation"]),
    default=None,
    help="Use N and m, or N m and rad, if the model allows both (see `plugins show`).",
)
@click.option(
    "--drive",
    "drives",
    metavar="KIND:KEY=VALUE,...",
    multiple=True,
    required=True,
    help="The excitation: a force (N, N m), or a motion of the base (m, rad) if the model has one. Several are added. "
    "The kinds are listed above.",
)
@click.option("--duration", type=float, required=True, metavar="S", help="Duration in s.")
@click.option("--rate", type=float, required=True, metavar="HZ", help="Samples per second.")
@click.option("--initial", metavar="STATE=VALUE", multiple=True, help="Initial value of a state; zero if not given.")
@click.option("--noise", type=float, default=0.0, metavar="SHARE", help="Noise of each channel, relative to its sd.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="The same seed gives the same file.")
@click.option(
    "--out",
    type=click.Path(dir_okay=False, path_type=Path),
    required=True,
    metavar="FILE.csv|FILE.nc",
    help="File for `time`, the inputs and the channels.",
)
@click.pass_context
def command(
    ctx: click.Context,
    /,
    model: str,
    sets: tuple[str, ...],
    terms: tuple[str, ...],
    motion: str | None,
    initial: tuple[str, ...],
    out: Path,
    **settings: object,
) -> None:
    """Simulate MODEL, and write its inputs and its channels as a table.

    \b
    Drives:
      harmonic   amplitude, omega (rad/s) or frequency (Hz), phase, harmonics=SHARE2/SHARE3/...
      sweep      amplitude, start, stop (Hz): a sine from one to the other over the duration
      multisine  rms, low, high (Hz), lines: equal lines with random phases
      step       size, at, rise (s)
      noise      rms, bandwidth (Hz)

    A parameter of the model that may be zero, such as k1 or mgl, is zero when it is not set. Exit status 0 when the
    table is written, 2 for an input that cannot be used.
    """  # noqa: D301
    from lostmotion.simulation.simulated_machine import Plan, assembly_of, simulate
    from lostmotion.storage import require_ending

    require_ending(out)
    registry = registry_of(ctx)
    assembly, values = assembly_of(registry, model, terms, motion)
    used = [("model", model), *(("term", term.name) for term in assembly.terms)]
    values |= _parse_numbers(sets, "--set")
    start, origins = _parse_numbers(initial, "--initial"), registry.origins(*used)
    plan = Plan(assembly, values, initial=start, origins=origins, **settings)  # type: ignore[arg-type]
    table = simulate(plan)
    table.save(out)
    rows = len(table.columns["time"])
    click.echo(f"{out}: {rows} samples of {assembly.label} at {plan.rate:g} Hz ({table.nsub} steps between samples)")


def _parse_numbers(texts: tuple[str, ...], option: str) -> dict[str, float]:
    """Return the values of an option NAME=VALUE that may be repeated; commas separate several in one text."""
    from lostmotion.simulation.drive_signals import parse_number, parse_pairs

    found = parse_pairs(",".join(texts), option)
    return {name: parse_number(value, f"{name} of {option}") for name, value in found.items()}
