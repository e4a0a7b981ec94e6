"""Work on the workers of a dask cluster. This is the only module that imports distributed."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import CancelledError
from itertools import islice
from typing import Any, TypeVar

from lostmotion.errors import DataError
from lostmotion.registry import import_texts, sources

In = TypeVar("In")
Out = TypeVar("Out")
AHEAD = 1000
"""The number of pieces that the scheduler holds at a time: enough for the workers, little memory for a million."""
RETRIES = 3
"""How often a piece that raised an exception is repeated; that of a lost worker is, by the configuration of dask."""
PATIENCE = 30.0
"""The time (s) after which it is asked whether any worker is left."""


def compute_on_cluster(
    work: Callable[[In], Out], pieces: Sequence[In], address: str
) -> Generator[tuple[int, Out], None, None]:
    """Yield the index of each piece and `work(piece)` when it is computed; another worker takes that of a lost one.

    `work` must be picklable. It travels as bytes, and so do the plugin files that are imported here, so that workers
    need only lostmotion and the installed plugins. `DataError` is raised when there is no cluster at `address`, or when
    its workers cannot do the work.
    """
    try:
        from distributed import Client, as_completed
    except ImportError as err:
        raise DataError("--cluster needs the package distributed: pip install 'lostmotion[cluster]'") from err
    try:
        client = Client(address, timeout="5s", set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as err:
        raise DataError(f"there is no cluster at {address} ({err}): start one, or leave --cluster out") from err
    with client:
        finished = as_completed(loop=client.loop, with_results=False)  # type: ignore[no-untyped-call]
        # A worker unpickles the work itself, after it has imported the plugin files, which it may not have.
        packed, texts = pickle.dumps(work), sources()
        waiting, numbers = enumerate(pieces), {}

        def submit(count: int) -> None:
            for number, piece in islice(waiting, count):
                future = client.submit(_compute_remotely, texts, packed, piece, pure=False, retries=RETRIES)
                numbers[future.key] = number
                finished.add(future)  # type: ignore[no-untyped-call]

        submit(AHEAD)
        for future in finished:
            yield numbers.pop(future.key), _get_result(client, future)
            future.release()
            submit(1)


def _compute_remotely(texts: Mapping[str, str], packed: bytes, piece: Any) -> Any:
    """Return the result of a piece, on a worker of a cluster."""
    import_texts(texts)
    return pickle.loads(packed)(piece)  # noqa: S301 - bytes from the client of this cluster


def _get_result(client: Any, future: Any) -> Any:
    """Return the result of a worker, or raise `DataError` when the workers cannot do the work at all."""
    from distributed import KilledWorker

    try:
        return _wait_for_result(client, future)
    except (ImportError, KilledWorker) as err:
        raise DataError(
            f"the workers of the cluster cannot do this work ({' '.join(str(err).split())[:200]}): "
            "install lostmotion and its plugins on each, or leave --cluster out"
        ) from err
    except CancelledError as err:
        raise DataError("the cluster was lost: start it and run the same command again, which continues") from err


def _wait_for_result(client: Any, future: Any) -> Any:
    """Return the result of a worker, which may have to be computed again; raise `DataError` if no worker is left."""
    while True:
        try:
            return future.result(timeout=PATIENCE)
        except TimeoutError as err:
            if future.status == "error":
                raise
            if not client.scheduler_info()["workers"]:
                raise DataError(
                    "the workers of the cluster cannot do this work (none is left): start new ones and run the same"
                    " command again, which continues"
                ) from err
