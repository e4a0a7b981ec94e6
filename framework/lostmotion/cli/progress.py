"""A line on standard error that says what is being done and for how long."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

LONGEST = 120
COMPILING = "compiling, which this machine has to do once"


SELDOM = 20.0
"""Seconds between two lines where nobody watches a terminal."""


@contextmanager
def counted(what: str, total: int, unit: str, *, quiet: bool) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that is told how many are done of how many; what was done before the start costs no time.

    Off a terminal a line is written now and then, with the time to go.
    """
    from tqdm import tqdm

    with tqdm(desc=what, total=total, unit=f" {unit}", leave=False, disable=True if quiet else None) as bar:
        lines, first = _Lines(what), -1

        def say(done: int, _of: int) -> None:
            nonlocal first
            first = done if first < 0 else first
            if not bar.n:
                bar.initial = done
            bar.n = done
            bar.refresh()
            if bar.disable and not quiet:
                lines.say(f"{done} of {total} {unit}{lines.to_go(done - first, total - done)}")

        yield say


@contextmanager
def progress(what: str, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Yield a function that is told each step; off a terminal it writes a line now and then, when `quiet` nothing."""
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
            yield _Lines(what).say
        else:
            with _compiling(lambda busy: bar.set_postfix_str(f"{last} · {COMPILING}" if busy else last)):
                yield say


class _Lines:
    """Lines on standard error, one in `SELDOM` seconds at most: short work leaves none."""

    def __init__(self, what: str) -> None:
        self.what, self.begin = what, time.monotonic()
        self.last = self.begin

    def say(self, step: str) -> None:
        """Write what is being done, if the last line is long enough ago."""
        now = time.monotonic()
        if now - self.last >= SELDOM:
            self.last = now
            sys.stderr.write(f"{self.what}: {_minutes(now - self.begin)}: {_shorten(step)}\n")
            sys.stderr.flush()

    def to_go(self, done: int, left: int) -> str:
        """Return the time to go in words, where so many were done since the beginning and so many are left."""
        if done <= 0:
            return ""
        return f", about {_minutes((time.monotonic() - self.begin) / done * left)} to go"


def _shorten(step: str) -> str:
    """Return a step on a line that is not too long: what is cut off at a comma is told by dots."""
    return step if len(step) <= LONGEST else f"{step[:LONGEST].rpartition(', ')[0] or step[:LONGEST]}, ..."


def _minutes(seconds: float) -> str:
    """Return a time as people say it, for instance 3 min 20 s."""
    whole = round(seconds)
    return f"{whole // 60} min {whole % 60} s" if whole >= 60 else f"{whole} s"


@contextmanager
def _compiling(told: Callable[[bool], None]) -> Iterator[None]:
    """Tell when a kernel begins to be compiled, and when it is."""
    from numba.core import event

    class Listener(event.Listener):
        def on_start(self, event: event.Event) -> None:
            told(True)

        def on_end(self, event: event.Event) -> None:
            told(False)

    with event.install_listener("numba:compile", Listener()):
        yield
