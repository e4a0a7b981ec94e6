"""Many independent trials in processes or on a cluster; each result is stored, so that a killed campaign continues.

A trial depends only on its number, so neither order, processes nor machines change a byte of the results.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import platform
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

from lostmotion.campaigns.cluster import compute_on_cluster
from lostmotion.codec import from_plain, to_plain
from lostmotion.errors import DataError
from lostmotion.recording.subprocess_reader import ALONE
from lostmotion.storage import folder_for, held, load_json, save_json, writing

SCHEMA = "lostmotion.campaign/1"
PLAN = "campaign.json"
"""The file that identifies the folder of a campaign: it describes how its trials are made."""
TRIALS = "trials"
RENEWED = 100
"""The number of trials per process: each compiled kernel keeps 35 MiB of memory, one from the cache hardly any."""

T = TypeVar("T")
Trial = Callable[[int], T]
"""A picklable function from the number of a trial to its outcome, a frozen dataclass that the codec can write."""
Say = Callable[[int, int], None]
"""A function that is called with the number of completed trials and the number of all trials."""


@dataclass(frozen=True)
class Campaign(Generic[T]):
    """Trials 0 to `count` - 1, made by `trial`; `identity` describes them in plain JSON values, without their number.

    `kind` is the class of an outcome, used to read it from its file. With `apart`, trials never run in this process,
    even if only one is left. A trial whose process is killed, for instance for lack of memory, has the outcome `lost`;
    without that function it ends the campaign, and so it does on a cluster after several workers were lost with it.
    """

    trial: Trial[T]
    kind: type[T]
    count: int
    identity: Mapping[str, object]
    apart: bool = False
    lost: Trial[T] | None = None

    def run(
        self,
        folder: Path,
        jobs: int,
        say: Say = lambda _done, _of: None,
        *,
        fresh: bool = False,
        cluster: str = "",
    ) -> list[T]:
        """Return the outcome of every trial in order; outcomes that exist in `folder` are not computed again.

        Trials run in up to `jobs` processes, or on the workers of the dask cluster at the address `cluster`. These must
        see `folder`, an absolute path, and all paths of the trial. `DataError` is raised when they do not, and when the
        folder contains a campaign of another identity, unless `fresh` is true.
        """
        with held(folder_for(folder)):
            self._claim(folder, fresh)
            missing = [k for k in range(self.count) if not self._is_stored(folder, k)]
            say(self.count - len(missing), self.count)
            with closing(self._make_missing(folder, missing, jobs, cluster)) as numbers:
                for done, _ in enumerate(numbers, start=self.count - len(missing) + 1):
                    say(done, self.count)
        return [self._outcome(folder, k) for k in range(self.count)]

    def _outcome(self, folder: Path, number: int) -> T:
        """Return the stored outcome of a trial."""
        path = _file_of(folder, number)
        return from_plain(self.kind, load_json(path, "run the same command again"), str(path))

    def _is_stored(self, folder: Path, number: int) -> bool:
        """Return whether the outcome of a trial is stored and can be read."""
        try:
            self._outcome(folder, number)
        except DataError:
            return False
        return True

    def _claim(self, folder: Path, fresh: bool) -> None:
        """Prepare the folder for this campaign; raise `DataError` if it belongs to another one."""
        plan, trials = folder / PLAN, folder / TRIALS
        found = _read_plan(plan)
        if found is None and (plan.exists() or trials.exists()):
            raise DataError(f"{folder} holds {trials.name} and is not a campaign: choose another place")
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

    def _make_missing(self, folder: Path, missing: list[int], jobs: int, cluster: str) -> Generator[int, None, None]:
        """Yield the number of each trial after it was made and stored."""
        if missing and cluster:
            return self._make_on_cluster(folder, missing, cluster)
        make = partial(_run_and_store, self.trial, folder)
        if not missing or (not self.apart and (jobs == 1 or len(missing) < 2)):
            return (make(k) for k in missing)
        return _run_parallel(
            make, missing, min(jobs, len(missing)), self.lost and partial(_run_and_store, self.lost, folder)
        )

    def _make_on_cluster(self, folder: Path, missing: list[int], address: str) -> Generator[int, None, None]:
        """Yield the number of each trial after a worker of a cluster made it and its outcome was stored here."""
        with closing(compute_on_cluster(partial(_run_elsewhere, self.trial, folder), missing, address)) as made:
            for index, outcome in made:
                save_json(_file_of(folder, missing[index]), outcome)
                yield missing[index]


def _read_plan(path: Path) -> Mapping[str, object] | None:
    """Return the description of the campaign in a folder, or None where there is no campaign."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) and found.get("schema") == SCHEMA else None


def _file_of(folder: Path, number: int) -> Path:
    return folder / TRIALS / f"{number:05d}.json"


def _run_and_store(trial: Trial[T], folder: Path, number: int) -> int:
    """Return the number of a trial after its outcome was stored."""
    save_json(_file_of(folder, number), to_plain(trial(number)))
    return number


_TURN = threading.Lock()
"""Held by the trial that runs: two of them in threads of one process would change its settings for each other."""


def _run_elsewhere(trial: Trial[T], folder: Path, number: int) -> dict[str, object]:
    """Return the outcome of a trial in plain JSON values, on a worker of a cluster that sees the folder."""
    if _read_plan(folder / PLAN) is None:
        raise DataError(
            f"the worker on {platform.node()} does not see {folder}: choose an --out in a folder that all workers share"
            " at the same path, or leave --cluster out"
        )
    with _TURN:
        plain: dict[str, object] = to_plain(trial(number))
    return plain


def _run_parallel(
    make: Callable[[int], int], numbers: list[int], jobs: int, lose: Callable[[int], int] | None
) -> Generator[int, None, None]:
    """Yield each number when its trial is complete; trials that ran when a process was killed are repeated one by one.

    Processes are replaced after some trials, so that memory does not grow with the compiled kernels.
    """
    while numbers:
        waiting, numbers = numbers[: RENEWED * jobs][::-1], numbers[RENEWED * jobs :]
        suspects = yield from _run_pool(make, waiting, jobs)
        numbers = waiting[::-1] + numbers
        if suspects and lose is None:
            raise DataError(
                "a process of the campaign was killed, perhaps for lack of memory: run the same command again, with"
                " fewer --jobs; completed trials are kept"
            )
        for number in suspects:
            if (yield from _run_pool(make, [number], 1)) and lose:
                yield lose(number)


def _run_pool(make: Callable[[int], int], waiting: list[int], jobs: int) -> Generator[int, None, list[int]]:
    """Yield the numbers in `waiting`, last first, when they are complete; return those on which a process was killed.

    The processes end at once when this process is interrupted, closed or killed.
    """
    spawn = multiprocessing.get_context("spawn")
    receiver, sender = spawn.Pipe(duplex=False)
    before = {name: os.environ.get(name) for name in ALONE}
    os.environ.update(ALONE)  # one process per core: further threads would only wait for each other
    pool = ProcessPoolExecutor(jobs, mp_context=spawn, initializer=_follow_parent, initargs=(receiver,))
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
            sender.close()
        pool.shutdown(cancel_futures=True)
        sender.close()
        receiver.close()
        _restore_environment(before)


def _restore_environment(before: Mapping[str, str | None]) -> None:
    """Restore variables of the environment to their former values, or remove them."""
    for name, value in before.items():
        os.environ.pop(name, None)
        if value is not None:
            os.environ[name] = value


def _follow_parent(receiver: Connection) -> None:
    """Ignore Ctrl-C in a worker, and end the worker when the parent process ends and its end of the pipe closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def hear() -> None:
        try:
            receiver.recv_bytes()
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
