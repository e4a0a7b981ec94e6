"""Trials of lostmotion: a demonstration, a blind trial, a calibration of intervals, and the paper done again.

They use the framework as any other package could: all that they add to the command line comes by a hook.
"""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_trials"


@hookimpl
def lostmotion_commands() -> dict[str, tuple[str, str]]:
    """Return the commands of the trials."""
    return {
        "calibrate": (f"{_HERE}.coverage.command:command", "See whether the intervals of identify hold the truth."),
        "demo": (f"{_HERE}.demo.command:command", "See it work: a robot joint hides friction, and it is found."),
        "prove": (f"{_HERE}.blind.command:command", "Hide effects from it in a blind trial, and score what it finds."),
        "reproduce": (f"{_HERE}.paper.command:command", "Redo the paper of 2007: its figures and tables."),
    }
