"""Compute a map chunk by chunk on the cores of this machine or on a cluster; an interrupted map is continued."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.campaigns.cluster import compute_on_cluster
from lostmotion.kernels.threads import cores
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
            return compute_on_cluster(partial(compute_cells, study), pieces, self.address)
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
