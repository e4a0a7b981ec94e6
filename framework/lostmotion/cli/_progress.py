"""A line on standard error that says what is being done and for how long."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

COMPILING = "compiling, which this machine has to do once"


@contextmanager
def counted(what: str, total: int, unit: str, *, quiet: bool) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that is told how many are done of how many; what was done before the start costs no time."""
    from tqdm import tqdm

    with tqdm(desc=what, total=total, unit=f" {unit}", leave=False, disable=True if quiet else None) as bar:

        def say(done: int, _of: int) -> None:
            if not bar.n:
                bar.initial = done
            bar.n = done
            bar.refresh()

        yield say


@contextmanager
def progress(what: str, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Yield a function that is told each step; it shows nothing when `quiet` or when nobody watches."""
    from tqdm import tqdm

    with tqdm(
        desc=what,
        unit=" steps",
        leave=False,
        disable=True if quiet else None,
        bar_format="{desc} {elapsed} · {n} steps · {postfix}",
    ) as bar:
        last = ""

        def say(step: str) -> None:
            nonlocal last
            last = step
            bar.set_postfix_str(step, refresh=False)
            bar.update()
            bar.refresh()

        if bar.disable:
            yield say
        else:
            with _compiling(lambda busy: bar.set_postfix_str(f"{last} · {COMPILING}" if busy else last)):
                yield say


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
