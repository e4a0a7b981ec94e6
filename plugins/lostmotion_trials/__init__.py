"""Trials of lostmotion: a demonstration, a blind trial and a calibration of intervals.

They use the framework as any other package could: their commands are registered by a hook.
"""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_trials"


@hookimpl
def lostmotion_commands() -> dict[str, tuple[str, str]]:
    """Return the commands of the trials."""
    return {
        "calibrate": (f"{_HERE}.coverage.command:command", "Test whether the intervals of identify cover the truth."),
        "demo": (f"{_HERE}.demo.command:command", "Hide friction in a simulated robot joint, and find it."),
        "prove": (f"{_HERE}.blind.command:command", "Run a blind trial of diagnose on machines with hidden effects."),
    }
