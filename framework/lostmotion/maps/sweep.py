"""A map computed on the cores of this machine, or on a cluster, chunk by chunk, and continued where it was left."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.kernels.threads import cores
from lostmotion.maps.cells import Columns, Study, computed
from lostmotion.maps.layout import MapLayout
from lostmotion.maps.store import opened
from lostmotion.registry import import_texts, sources

Cells = NDArray[np.int64]
Say = Callable[[int, int], None]
"""Told how many cells are done, and how many there are."""


@dataclass(frozen=True)
class Crew:
    """Who computes: `jobs` threads of this process (0: one to each core), or the workers behind a dask `address`."""

    jobs: int = 0
    address: str = ""

    def work(self, study: Study, pieces: list[Cells]) -> Iterator[tuple[int, Columns]]:
        """Yield the number of a piece and its columns, as they are finished."""
        if self.address:
            return _cluster(study, pieces, self.address)
        return _threads(study, pieces, self.jobs or cores())


def sweep(path: Path, layout: MapLayout, crew: Crew, say: Say, *, fresh: bool = False) -> None:
    """Compute what the store at `path` lacks of the map `layout`, writing each chunk as it is finished."""
    with opened(path, layout, fresh=fresh) as store:
        pending = store.pending
        total = int(np.prod(layout.shape))
        pieces = [layout.places(chunk) for chunk in pending]
        done = total - sum(map(len, pieces))
        say(done, total)
        with closing(crew.work(layout.study, pieces)) as finished:  # type: ignore[type-var]
            for number, columns in finished:
                store.write(pending[number], columns)
                done += len(pieces[number])
                say(done, total)


def _threads(study: Study, pieces: list[Cells], jobs: int) -> Iterator[tuple[int, Columns]]:
    """Yield finished pieces from threads: the kernels let go of the interpreter."""
    waiting = list(enumerate(pieces))[::-1]
    with ThreadPoolExecutor(jobs) as pool:
        running: dict[Future[Columns], int] = {}
        try:
            while waiting or running:
                while waiting and len(running) < jobs + 1:
                    number, cells = waiting.pop()
                    running[pool.submit(computed, study, cells)] = number
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(future), future.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _cluster(study: Study, pieces: list[Cells], address: str) -> Iterator[tuple[int, Columns]]:
    """Yield finished pieces from the workers of a cluster; what a lost worker had is computed by another."""
    try:
        from distributed import Client, as_completed
    except ImportError as err:
        raise DataError("--dask needs the package distributed: pip install 'lostmotion[cluster]'") from err
    try:
        client = Client(address, timeout="5s", set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as err:
        raise DataError(f"no cluster answers at {address} ({err}): start one, or leave --dask out") from err
    with client:
        finished = as_completed(loop=client.loop, with_results=False)  # type: ignore[no-untyped-call]
        # A worker unpacks the study itself, once it has the files of plugins, which it may not know.
        packed, texts = pickle.dumps(study), sources()
        futures = [client.submit(_far, texts, packed, cells, pure=False, retries=3) for cells in pieces]
        numbers = {future.key: number for number, future in enumerate(futures)}
        for future in futures:
            finished.add(future)  # type: ignore[no-untyped-call]
        del futures
        for future in finished:
            yield numbers[future.key], _result(future)
            future.release()


def _far(texts: Mapping[str, str], packed: bytes, cells: Cells) -> Columns:
    """Return the columns of some cells, on a worker of a cluster."""
    import_texts(texts)
    return computed(pickle.loads(packed), cells)  # noqa: S301 - our own bytes, from the client of this cluster


def _result(future: Any) -> Columns:
    """Return what a worker computed, or raise a sentence when the workers cannot do it at all."""
    from distributed import KilledWorker

    try:
        columns: Columns = future.result()
    except (ImportError, KilledWorker) as err:
        raise DataError(
            f"the workers of the cluster cannot compute this map ({' '.join(str(err).split())[:200]}): "
            "install lostmotion and its plugins on each, or leave --dask out"
        ) from err
    return columns
