"""Compute a map chunk by chunk on the cores of this machine or on a cluster; an interrupted map is continued."""

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
from lostmotion.registry import import_texts, sources
from lostmotion_chaos.maps.cells import Columns, Study, compute_cells
from lostmotion_chaos.maps.layout import MapLayout
from lostmotion_chaos.maps.store import open_store

Cells = NDArray[np.int64]
ProgressCallback = Callable[[int, int], None]
"""Called with the number of finished cells and the number of all cells."""


@dataclass(frozen=True)
class Workers:
    """`jobs` threads of this process (0: one for each core), or the workers of the dask cluster at `address`."""

    jobs: int = 0
    address: str = ""

    def compute(self, study: Study, pieces: list[Cells]) -> Iterator[tuple[int, Columns]]:
        """Yield the index of a piece and its columns when it is finished."""
        if self.address:
            return _compute_on_cluster(study, pieces, self.address)
        return _compute_on_threads(study, pieces, self.jobs or cores())


def sweep(path: Path, layout: MapLayout, workers: Workers, say: ProgressCallback, *, fresh: bool = False) -> None:
    """Compute the chunks of the map `layout` that the store at `path` lacks, and write each when it is finished."""
    with open_store(path, layout, fresh=fresh) as store:
        pending = store.pending
        total = int(np.prod(layout.shape))
        pieces = [layout.list_cells(chunk) for chunk in pending]
        done = total - sum(map(len, pieces))
        say(done, total)
        with closing(workers.compute(layout.study, pieces)) as finished:  # type: ignore[type-var]
            for number, columns in finished:
                store.write(pending[number], columns)
                done += len(pieces[number])
                say(done, total)


def _compute_on_threads(study: Study, pieces: list[Cells], jobs: int) -> Iterator[tuple[int, Columns]]:
    """Yield finished pieces from threads; the kernels release the interpreter lock."""
    waiting = list(enumerate(pieces))[::-1]
    with ThreadPoolExecutor(jobs) as pool:
        running: dict[Future[Columns], int] = {}
        try:
            while waiting or running:
                while waiting and len(running) < jobs + 1:
                    number, cells = waiting.pop()
                    running[pool.submit(compute_cells, study, cells)] = number
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(future), future.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _compute_on_cluster(study: Study, pieces: list[Cells], address: str) -> Iterator[tuple[int, Columns]]:
    """Yield finished pieces from the workers of a cluster; the piece of a lost worker is computed by another one."""
    try:
        from distributed import Client, as_completed
    except ImportError as err:
        raise DataError("--dask needs the package distributed: pip install 'lostmotion[cluster]'") from err
    try:
        client = Client(address, timeout="5s", set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as err:
        raise DataError(f"there is no cluster at {address} ({err}): start one, or leave --dask out") from err
    with client:
        finished = as_completed(loop=client.loop, with_results=False)  # type: ignore[no-untyped-call]
        # A worker unpickles the study itself, after it has imported the plugin files, which it may not have.
        packed, texts = pickle.dumps(study), sources()
        futures = [client.submit(_compute_remotely, texts, packed, cells, pure=False, retries=3) for cells in pieces]
        numbers = {future.key: number for number, future in enumerate(futures)}
        for future in futures:
            finished.add(future)  # type: ignore[no-untyped-call]
        del futures
        for future in finished:
            yield numbers[future.key], _get_result(future)
            future.release()


def _compute_remotely(texts: Mapping[str, str], packed: bytes, cells: Cells) -> Columns:
    """Return the columns of some cells, on a worker of a cluster."""
    import_texts(texts)
    return compute_cells(pickle.loads(packed), cells)  # noqa: S301 - bytes from the client of this cluster


def _get_result(future: Any) -> Columns:
    """Return the result of a worker, or raise `DataError` when the workers cannot compute the map at all."""
    from distributed import KilledWorker

    try:
        columns: Columns = future.result()
    except (ImportError, KilledWorker) as err:
        raise DataError(
            f"the workers of the cluster cannot compute this map ({' '.join(str(err).split())[:200]}): "
            "install lostmotion and its plugins on each, or leave --dask out"
        ) from err
    return columns
