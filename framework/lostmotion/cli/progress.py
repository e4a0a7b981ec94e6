"""Progress on standard error: the current step and the elapsed time."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

MAX_LINE_LENGTH = 120
COMPILING = "compiling (only once on this machine)"
LINE_INTERVAL = 20.0
"""Smallest number of seconds between two lines when standard error is not a terminal."""


@contextmanager
def show_count(what: str, total: int, unit: str, *, quiet: bool) -> Iterator[Callable[[int, int], None]]:
    """Yield a callback for the finished and the total number; the first call counts as done before the start.

    Outside of a terminal, a line with the remaining time is written from time to time.
    """
    from tqdm import tqdm

    with tqdm(desc=what, total=total, unit=f" {unit}", leave=False, disable=True if quiet else None) as bar:
        lines, first = _LineWriter(what), -1

        def say(done: int, _of: int) -> None:
            nonlocal first
            first = done if first < 0 else first
            if not bar.n:
                bar.initial = done
            bar.n = done
            bar.refresh()
            if bar.disable and not quiet:
                lines.write(f"{done} of {total} {unit}{lines.format_remaining(done - first, total - done)}")

        yield say


@contextmanager
def show_progress(what: str, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Yield a callback for each step; outside of a terminal it writes a line from time to time, if `quiet` nothing."""
    from tqdm import tqdm

    with tqdm(
        desc=what,
        unit=" steps",
        leave=False,
        disable=True if quiet else None,
        bar_format="{desc} {elapsed} · {n} steps{postfix}",
    ) as bar:
        last = ""

        def say(step: str) -> None:
            nonlocal last
            last = step
            bar.set_postfix_str(step, refresh=False)
            bar.update()
            bar.refresh()

        if quiet:
            yield say
        elif bar.disable:
            yield _LineWriter(what).write
        else:
            with _watch_compilation(lambda busy: bar.set_postfix_str(f"{last} · {COMPILING}" if busy else last)):
                yield say


class _LineWriter:
    """Lines on standard error, at most one in `LINE_INTERVAL` seconds: short work writes none."""

    def __init__(self, what: str) -> None:
        self.what, self.begin = what, time.monotonic()
        self.last = self.begin

    def write(self, step: str) -> None:
        """Write the current step, if the last line is long enough ago."""
        now = time.monotonic()
        if now - self.last >= LINE_INTERVAL:
            self.last = now
            sys.stderr.write(f"{self.what}: {_format_duration(now - self.begin)}: {_shorten_step(step)}\n")
            sys.stderr.flush()

    def format_remaining(self, done: int, left: int) -> str:
        """Return the remaining time in words, from the numbers done since the beginning and left."""
        if done <= 0:
            return ""
        return f", about {_format_duration((time.monotonic() - self.begin) / done * left)} to go"


def _shorten_step(step: str) -> str:
    """Return a step as a text of limited length, cut at a comma and marked with dots."""
    return (
        step
        if len(step) <= MAX_LINE_LENGTH
        else f"{step[:MAX_LINE_LENGTH].rpartition(', ')[0] or step[:MAX_LINE_LENGTH]}, ..."
    )


def _format_duration(seconds: float) -> str:
    """Return a duration as text, for example 3 min 20 s."""
    whole = round(seconds)
    return f"{whole // 60} min {whole % 60} s" if whole >= 60 else f"{whole} s"


@contextmanager
def _watch_compilation(report: Callable[[bool], None]) -> Iterator[None]:
    """Call `report` with True when the compilation of a kernel begins, and with False when it ends."""
    from numba.core import event

    class Listener(event.Listener):
        def on_start(self, event: event.Event) -> None:
            report(True)

        def on_end(self, event: event.Event) -> None:
            report(False)

    with event.install_listener("numba:compile", Listener()):
        yield
