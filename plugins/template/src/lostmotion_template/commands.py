"""A command of your own, which uses lostmotion as a notebook would."""

from __future__ import annotations

import click

import lostmotion


@click.command(epilog="\b\nExample:\n  lostmotion crest recording.csv --time t --sensor position=x --unit position=mm")
@click.argument("recording", type=click.Path(exists=True, dir_okay=False))
@click.option("--time", metavar="COLUMN", required=True, help="The column of the time.")
@click.option("--sensor", "sensors", metavar="QUANTITY=COLUMN", multiple=True, required=True, help="What to look at.")
@click.option("--unit", "units", metavar="QUANTITY=UNIT", multiple=True, help="The unit of a column that tells none.")
def crest(recording: str, time: str, sensors: tuple[str, ...], units: tuple[str, ...]) -> None:
    """Tell how far the peaks of a recording reach beyond its rms: the crest factor.

    A machine that rattles has a larger one than a machine that swings.
    """
    columns = dict(map(_pair, sensors))
    read = lostmotion.Recording.read(recording, time=time, sensors=columns, units=dict(map(_pair, units)))
    for sensor in read.sensors:
        swing = sensor - sensor.mean()
        factor = float(abs(swing).max() / (swing**2).mean() ** 0.5)
        click.echo(f"{sensor.attrs['long_name']}: crest factor {factor:.2f} (a sine has 1.41)")


def _pair(text: str) -> tuple[str, str]:
    """Return the two sides of `text`, or raise the error that the command line shows."""
    name, sign, value = text.partition("=")
    if not sign or not value:
        raise click.BadParameter(f"{text!r} is not of the form NAME=VALUE: write for instance position=x")
    return name, value
