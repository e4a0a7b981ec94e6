"""Many independent trials over the cores of this machine, each kept as it ends: a campaign that is killed goes on.

A trial knows its number and nothing of the others, so neither their order nor the number of processes changes a byte.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import shutil
import signal
import threading
from collections.abc import Callable, Generator, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Generic, TypeVar

from lostmotion.codec import from_plain, to_plain
from lostmotion.errors import DataError
from lostmotion.recording.subprocess_reader import ALONE
from lostmotion.storage import folder_for, held, load_json, save_json, writing

SCHEMA = "lostmotion.campaign/1"
PLAN = "campaign.json"
"""What a folder of a campaign is known by: how its trials are made."""
TRIALS = "trials"
RENEWED = 100
"""Trials that a process makes: a kernel it compiles holds 35 MiB for good, and one from the cache next to nothing."""

T = TypeVar("T")
Trial = Callable[[int], T]
"""Makes the outcome of one trial, a frozen dataclass that the codec writes, from its number; it can be pickled."""
Say = Callable[[int, int], None]
"""Told how many trials are done, and how many there are."""


@dataclass(frozen=True)
class Campaign(Generic[T]):
    """Trials 0 to `count` - 1 and what makes them: `identity`, plain as JSON knows it, without the number of trials.

    `kind` is the class of an outcome, as which it is read from its file. With `apart` no trial is made in this process,
    even if a single one is left. A trial whose process is killed, by a system that runs out of memory for instance, has
    the outcome `lost`; without that it ends the campaign.
    """

    trial: Trial[T]
    kind: type[T]
    count: int
    identity: Mapping[str, object]
    apart: bool = False
    lost: Trial[T] | None = None

    def run(self, folder: Path, jobs: int, say: Say = lambda _done, _of: None, *, fresh: bool = False) -> list[T]:
        """Return the outcome of every trial in order; those that `folder` already holds are not made again.

        Raises `DataError` when the folder holds a campaign of another identity, unless a `fresh` one is wanted.
        """
        with held(folder_for(folder)):
            self._claim(folder, fresh)
            missing = [k for k in range(self.count) if not self._stands(folder, k)]
            say(self.count - len(missing), self.count)
            with closing(self._made(folder, missing, jobs)) as numbers:
                for done, _ in enumerate(numbers, start=self.count - len(missing) + 1):
                    say(done, self.count)
        return [self._outcome(folder, k) for k in range(self.count)]

    def _outcome(self, folder: Path, number: int) -> T:
        """Return the outcome of a trial that is kept."""
        path = _file(folder, number)
        return from_plain(self.kind, load_json(path, "run the same command again"), str(path))

    def _stands(self, folder: Path, number: int) -> bool:
        """Return whether the outcome of a trial is kept; one that cannot be read is made again."""
        try:
            self._outcome(folder, number)
        except DataError:
            return False
        return True

    def _claim(self, folder: Path, fresh: bool) -> None:
        """Make the folder this campaign's, or refuse one that is another's."""
        plan, trials = folder / PLAN, folder / TRIALS
        found = _plan(plan)
        if found is None and (plan.exists() or trials.exists()):
            raise DataError(f"{folder} holds {trials.name} and is no campaign of ours: choose another place")
        if found and fresh:
            shutil.rmtree(trials, ignore_errors=True)
        wanted = {"schema": SCHEMA, **self.identity}
        if found and not fresh:
            _require_same(folder, found, json.loads(json.dumps(wanted)))
        save_json(plan, wanted)
        with writing(trials):
            trials.mkdir(exist_ok=True)
        for spare in trials.glob(".*"):
            spare.unlink()

    def _made(self, folder: Path, missing: list[int], jobs: int) -> Generator[int, None, None]:
        """Yield the number of each trial that was made and kept."""
        make = partial(_kept, self.trial, folder)
        if not missing or (not self.apart and (jobs == 1 or len(missing) < 2)):
            return (make(k) for k in missing)
        return _spread(make, missing, min(jobs, len(missing)), self.lost and partial(_kept, self.lost, folder))


def _plan(path: Path) -> Mapping[str, object] | None:
    """Return what made the campaign of a folder, or None where there is none of ours."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) and found.get("schema") == SCHEMA else None


def _file(folder: Path, number: int) -> Path:
    return folder / TRIALS / f"{number:05d}.json"


def _kept(trial: Trial[T], folder: Path, number: int) -> int:
    """Return the number of a trial, once its outcome is on the disk."""
    save_json(_file(folder, number), to_plain(trial(number)))
    return number


def _spread(
    make: Callable[[int], int], numbers: list[int], jobs: int, lose: Callable[[int], int] | None
) -> Generator[int, None, None]:
    """Yield each number as it is made; what was under way when a process was killed is tried again, one at a time.

    Processes give way to fresh ones after a while, so that memory does not grow with all that they have compiled.
    """
    while numbers:
        waiting, numbers = numbers[: RENEWED * jobs][::-1], numbers[RENEWED * jobs :]
        suspects = yield from _together(make, waiting, jobs)
        numbers = waiting[::-1] + numbers
        if suspects and lose is None:
            raise DataError(
                "a process of the campaign was killed, perhaps for want of memory: run the same command again, with"
                " fewer --jobs; what is done is kept"
            )
        for number in suspects:
            if (yield from _together(make, [number], 1)) and lose:
                yield lose(number)


def _together(make: Callable[[int], int], waiting: list[int], jobs: int) -> Generator[int, None, list[int]]:
    """Yield the numbers that are `waiting`, last first, as they are made; return those on which a process was killed.

    The processes end at once when this one is interrupted, closed or killed.
    """
    spawn = multiprocessing.get_context("spawn")
    ear, mouth = spawn.Pipe(duplex=False)
    before = {name: os.environ.get(name) for name in ALONE}
    os.environ.update(ALONE)  # as many processes as cores: threads of their own would only wait for one another
    pool = ProcessPoolExecutor(jobs, mp_context=spawn, initializer=_listen, initargs=(ear,))
    running: dict[Future[int], int] = {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                number = waiting.pop()
                try:
                    running[pool.submit(make, number)] = number
                except BrokenProcessPool:
                    return sorted([number, *running.values()])
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                if isinstance(future.exception(), BrokenProcessPool):
                    return sorted(running.values())
                yield future.result()
                del running[future]
        return []
    finally:
        if running or waiting:
            mouth.close()
        pool.shutdown(cancel_futures=True)
        mouth.close()
        ear.close()
        _restore(before)


def _restore(before: Mapping[str, str | None]) -> None:
    """Set each of these variables of the environment to what it was, or to nothing."""
    for name, value in before.items():
        os.environ.pop(name, None)
        if value is not None:
            os.environ[name] = value


def _listen(ear: Connection) -> None:
    """Leave Ctrl-C to the parent, and end with it: its end of the pipe closes however it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def hear() -> None:
        try:
            ear.recv_bytes()
        except (EOFError, OSError):
            os._exit(1)

    threading.Thread(target=hear, daemon=True).start()


def _require_same(folder: Path, old: Mapping[str, object], new: Mapping[str, object]) -> None:
    if old == new:
        return
    said = "; ".join(_differences(old, new))
    raise DataError(
        f"{folder} holds a campaign made otherwise ({said}): give the same settings to continue it, another --out,"
        " or --fresh to start over"
    )


def _differences(old: Mapping[str, object], new: Mapping[str, object]) -> Iterator[str]:
    """Yield what two nested tables differ in, entry by entry."""
    for key in sorted({*old, *new}):
        was, now = old.get(key), new.get(key)
        if isinstance(was, Mapping) and isinstance(now, Mapping):
            yield from _differences(was, now)
        elif was != now:
            yield f"{key} {was}, now {now}"
