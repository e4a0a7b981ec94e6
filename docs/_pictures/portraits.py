"""Portraits of the models: the first `lostmotion simulate` of each page of the gallery, velocity over position."""

from __future__ import annotations

import re
import shlex
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from click.testing import CliRunner

from lostmotion.cli import main

GALLERY = Path(__file__).resolve().parents[1] / "gallery"
COMMAND = re.compile(r"^```sh\n(?:.*\n)*?(?:lostmotion simulate )((?:.*\\\n)*.*)", re.MULTILINE)
COLUMNS = 3
FINER = 8
"""How many samples are drawn for each one that the page asks for."""
CYCLES = 50


def draw():
    """Return the figure, one panel to each page that simulates."""
    found = dict(sorted(find_commands().items()))
    rows = -(-len(found) // COLUMNS)
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(7.2, 2.3 * rows), squeeze=False)
    for axis, (name, arguments) in zip(axes.flat, found.items(), strict=False):
        table = run_simulation(arguments)
        part = slice(find_last_cycles(table["velocity"]), None)
        axis.plot(table["position"][part], table["velocity"][part], color="#0072b2", lw=0.4)
        axis.set_title(name, fontsize=9, family="monospace")
        axis.ticklabel_format(scilimits=(-3, 3))
    for axis in axes.flat[len(found) :]:
        axis.axis("off")
    figure.supxlabel("position (m or rad)", fontsize=9)
    figure.supylabel("velocity (m/s or rad/s)", fontsize=9)
    return figure


def find_commands():
    """Return the arguments of the first simulation on each page, by the name of the page."""
    pages = {path.stem: COMMAND.search(path.read_text(encoding="utf-8")) for path in GALLERY.glob("*.md")}
    return {name: shlex.split(found[1].replace("\\\n", " ")) for name, found in pages.items() if found}


def run_simulation(arguments):
    """Return the table (samples,) with named columns that a command line writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.csv"
        rate = FINER * float(arguments[arguments.index("--rate") + 1])
        given = [*arguments, "--rate", str(rate), "--noise", "0", "--out", str(path)]
        done = CliRunner().invoke(main, ["simulate", *given], catch_exceptions=False)
        if done.exit_code:
            raise RuntimeError(done.output)
        return np.genfromtxt(path, delimiter=",", names=True)


def find_last_cycles(velocity):
    """Return the index at which the last cycles begin, counted by the turns of the motion."""
    turns = np.flatnonzero((velocity[:-1] < 0) & (velocity[1:] >= 0))
    return turns[-CYCLES - 1] if len(turns) > CYCLES else 0
