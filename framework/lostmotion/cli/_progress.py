"""A line on standard error that says what is being done and for how long."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


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

        def say(step: str) -> None:
            bar.set_postfix_str(step, refresh=False)
            bar.update()
            bar.refresh()

        yield say
