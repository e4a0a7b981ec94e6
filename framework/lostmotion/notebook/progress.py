"""Progress of a long call, shown in a terminal or a notebook."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def show_progress(what: str, wanted: bool) -> Iterator[Callable[[str], None]]:
    """Yield a callback that shows each step as a line in a terminal or a notebook."""
    if not (wanted and _is_watched()):
        yield lambda _step: None
        return
    from tqdm.auto import tqdm

    with tqdm(desc=what, unit=" steps", leave=False, bar_format="{desc} {elapsed} · {n} steps{postfix}") as bar:

        def say(step: str) -> None:
            bar.set_postfix_str(step, refresh=False)
            bar.update()

        yield say


def _is_watched() -> bool:
    """Return whether a line of progress is visible: in a terminal or a notebook, but not in a log file."""
    shell = sys.modules.get("IPython")
    return sys.stderr.isatty() or (shell is not None and shell.get_ipython() is not None)
