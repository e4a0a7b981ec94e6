"""Batches of points: equal points are filtered once, points with the same sensor delays together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.likelihood.engine import Innovations


def realign(found: Innovations, late: Sequence[int]) -> Innovations:
    """Return innovations in the order of the readings, where those of sensor i came `late[i]` samples early."""
    errors, variances = found.errors.copy(), found.variances.copy()
    for sensor, lag in enumerate(late):
        errors[..., sensor] = np.roll(errors[..., sensor], lag, axis=1)
        variances[..., sensor] = np.roll(variances[..., sensor], lag, axis=1)
    return replace(found, errors=errors, variances=variances)


def group_rows(rows: NDArray[np.intp], views: Sequence[tuple[Any, ...]]) -> list[NDArray[np.intp]]:
    """Return the rows in groups with the same view of the readings: equal shifts and idle lags."""
    groups: dict[tuple[Any, ...], list[int]] = {}
    for row, shift in zip(rows.tolist(), views, strict=True):
        groups.setdefault(shift, []).append(row)
    return [np.array(some, dtype=np.intp) for some in groups.values()]


def find_distinct(used: Array) -> tuple[NDArray[np.intp], NDArray[np.intp] | None]:
    """Return the first of each set of equal rows of `used` (points, n), and that of each point; None if all differ."""
    _, rows, inverse = np.unique(used, axis=0, return_index=True, return_inverse=True)
    if len(rows) == len(used):
        return np.arange(len(used)), None
    order = np.argsort(rows)
    place = np.empty(len(rows), dtype=np.intp)
    place[order] = np.arange(len(rows))
    return rows[order], place[inverse.reshape(-1)]


def join_innovations(parts: Sequence[Innovations]) -> Innovations:
    """Return the innovations of all parts, one after the other."""
    errors, variances, finite = (
        np.concatenate([getattr(p, name) for p in parts]) for name in ("errors", "variances", "finite")
    )
    return Innovations(errors, variances, finite)
