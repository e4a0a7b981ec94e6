"""Work divided over the cores: kernels that release the interpreter lock run in threads, each on a slice."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import pairwise
from typing import TypeVar

In = TypeVar("In")
Out = TypeVar("Out")


def cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def hold_linear_algebra() -> Iterator[None]:
    """Let products of matrices use one thread, as a context or a decorator.

    The matrices are small, and the work is divided over the cores elsewhere. On a busy machine, threads that wait for
    each other make the product of 79 by 16,800 derivatives fifty times slower.
    """
    from threadpoolctl import threadpool_limits  # not needed by the commands that only show help

    with threadpool_limits(limits=1, user_api="blas"):
        yield


def each(work: Callable[[In], Out], items: Sequence[In], jobs: int) -> list[Out]:
    """Return the results of `work` for each item, in order, computed in up to `jobs` threads.

    It is useful where the work spends its time in kernels that release the interpreter lock.
    """
    if jobs < 2 or len(items) < 2:
        return [work(item) for item in items]
    with ThreadPoolExecutor(min(jobs, len(items))) as pool:
        return list(pool.map(work, items))


def spread(work: Callable[[int, int], None], n: int, *, jobs: int = 0, slices: int = 0) -> None:
    """Call `work(begin, end)` for slices of 0..n in threads; `work` must write to its own slice only.

    The result does not depend on the number of threads if each item is computed independently.
    """
    many = jobs or cores()
    pieces = min(n, slices or 4 * many)
    if many == 1 or pieces <= 1:
        work(0, n)
        return
    ends = [n * k // pieces for k in range(pieces + 1)]
    with ThreadPoolExecutor(many) as pool:
        for done in [pool.submit(work, a, b) for a, b in pairwise(ends)]:
            done.result()
