"""Progress of long work, in a terminal, a notebook or a log: the current step and the elapsed time.

Each step is also written to the file that the environment variable `LOSTMOTION_PROGRESS` names, as a line of JSON with
`seconds` since the beginning and the `step`: other programs follow a command in this way. A `Step` has further keys.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from typing import Any

MAX_LINE_LENGTH = 120
COMPILING = "compiling (only once on this machine)"
LINE_INTERVAL = 20.0
"""Smallest number of seconds between two lines where no bar is visible."""


class Step(str):
    """A step of progress in words, with `data` for programs that follow: keys and values of JSON."""

    __slots__ = ("data",)
    data: Mapping[str, Any]

    def __new__(cls, words: str, **data: Any) -> Step:
        """Return the step with its data."""
        made = super().__new__(cls, words)
        made.data = data
        return made


@contextmanager
def show_count(what: str, total: int, unit: str, *, quiet: bool) -> Iterator[Callable[..., None]]:
    """Yield a callback `say(done, of, step="")` for the finished and the total number and the current step.

    The first call counts as done before the start, and so does one with another total or with less done than before.
    Where no bar is visible, a line with the remaining time is written from time to time, if `quiet` nothing.
    """
    with _make_bar(what, quiet, total=total, unit=f" {unit}") as bar:
        lines, first, last = _LineWriter(what), -1, -1

        def say(done: int, of: int, step: str = "") -> None:
            nonlocal first, last
            if of != bar.total or done < last or first < 0:
                bar.reset(of)
                bar.initial = first = done
            bar.n = last = done
            bar.set_postfix_str(step, refresh=False)
            bar.refresh()
            if bar.disable and not quiet:
                lines.write(f"{step}{': ' * bool(step)}{done} of {of} {unit}{lines.remaining(done - first, of - done)}")

        yield say


@contextmanager
def show_progress(what: str, *, quiet: bool, lines: bool = True) -> Iterator[Callable[[str], None]]:
    """Yield a callback for each step; where no bar is visible, `lines` are written from time to time."""
    with _show_steps(what, quiet=quiet, lines=lines) as say, _write_steps(say) as write:
        yield write


@contextmanager
def _write_steps(say: Callable[[str], None]) -> Iterator[Callable[[str], None]]:
    """Yield a callback that also writes each step to the file for other programs, if there is one."""
    path, begin = os.environ.get("LOSTMOTION_PROGRESS"), time.monotonic()
    if not path:
        yield say
        return
    with open(path, "a", encoding="utf-8") as file:

        def write(step: str) -> None:
            more = step.data if isinstance(step, Step) else {}
            file.write(json.dumps({"seconds": round(time.monotonic() - begin, 2), "step": step, **more}) + "\n")
            file.flush()
            say(step)

        yield write


@contextmanager
def _show_steps(what: str, *, quiet: bool, lines: bool) -> Iterator[Callable[[str], None]]:
    with _make_bar(what, quiet, unit=" steps", bar_format="{desc} {elapsed} · {n} steps{postfix}") as bar:
        last = ""

        def say(step: str) -> None:
            nonlocal last
            last = step
            bar.set_postfix_str(step, refresh=False)
            bar.update()
            bar.refresh()

        if bar.disable:
            yield _LineWriter(what).write if lines and not quiet else say
        else:
            with _watch_compilation(lambda busy: bar.set_postfix_str(f"{last} · {COMPILING}" if busy else last)):
                yield say


def _make_bar(what: str, quiet: bool, **options: Any) -> Any:
    """Return a bar of tqdm for a terminal or a notebook; elsewhere, or if `quiet`, it is disabled."""
    shell = sys.modules.get("IPython")
    notebook = shell is not None and shell.get_ipython() is not None
    seen = not quiet and (notebook or sys.stderr.isatty())
    module = import_module("tqdm.auto" if notebook else "tqdm")
    return module.tqdm(desc=what, leave=False, disable=not seen, **options)


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

    def remaining(self, done: int, left: int) -> str:
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
