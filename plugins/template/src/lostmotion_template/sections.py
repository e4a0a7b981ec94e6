"""A section of your own on the page of a diagnosis: it reads the result and its arrays, and computes little."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from lostmotion.report.pages import Grid, PageSection

PARTS = 4


def make_power_section() -> PageSection[Any]:
    """Return the section; the page leaves it out where one of the arrays that it requires is absent."""
    return PageSection(
        "power",
        "Power of the missing force",
        table=make_table,
        words=write_words,
        requires=("missing_force", "velocity", "time"),
    )


def make_table(shown: Any) -> Grid:
    """Return the mean power (W) of the missing force in successive parts of the recording."""
    arrays = shown.arrays
    power, time = arrays["missing_force"] * arrays["velocity"], arrays["time"]
    ends = [len(time) * k // PARTS for k in range(PARTS + 1)]
    rows = [
        [f"{time[begin]:.3g} to {time[end - 1]:.3g} s", f"{power[begin:end].mean():.3g} W"]
        for begin, end in pairwise(ends)
    ]
    return Grid(["Part of the recording", "Mean power"], rows)


def write_words(shown: Any) -> str:
    """Return a sentence on the sign of the mean power."""
    power = float((shown.arrays["missing_force"] * shown.arrays["velocity"]).mean())
    verb = "takes energy from" if power < 0.0 else "adds energy to"
    return f"On average, the missing force {verb} the machine."
