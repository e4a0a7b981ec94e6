"""The names of `vector.py` and `windows.py` for NumPy: with these the source of a kernel runs as plain Python."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.vector import STRIDE, WIDTH

Array = NDArray[Any]
square_root, absolute, larger, is_finite = np.sqrt, np.abs, np.fmax, np.isfinite
select, any_lane, largest_lane = np.where, np.any, np.max


def jit(function: Any) -> Any:
    """Return the function as it is."""
    return function


whole = jit


def load(block: Array, row: int, first: int) -> Array:
    """Return the lanes from `first` on of a row of a block, (WIDTH,)."""
    return block[row, first : first + WIDTH].copy()


def store(block: Array, row: int, first: int, value: Array | float) -> None:
    """Write a number in lanes into a row of a block, from lane `first` on."""
    block[row, first : first + WIDTH] = value


def call(function: Any, block: Array, wires: Array, lanes: int) -> int:
    """Call a function of a model on a block."""
    function(block, wires, lanes)
    return 0


def column(block: Array, row: int, lane: int, count: int) -> Array:
    """Return the values of one lane in `count` rows from `row` on, as an array (count,) on the block itself."""
    return block[row : row + count, lane]


def offset_rows(block: Array, row: int) -> Array:
    """Return the block from a row on."""
    return block[row:]


def pointer(array: Array) -> Array:
    """Return the memory of an array: the array itself where it is a block, else its values in one dimension."""
    return array if array.ndim == 2 and array.shape[1] == STRIDE else array.reshape(-1)


def assign(block: Array, row: int, lane: int, number: float) -> None:
    """Write the number in one lane of a row."""
    block[row, lane] = number


def value(block: Array, row: int, lane: int) -> float:
    """Return the number in one lane of a row."""
    return float(block[row, lane])


def add(block: Array, row: int, lane: int, more: float) -> None:
    """Add a number to that in one lane of a row."""
    block[row, lane] += more


SPACE = {name: made for name, made in list(globals().items()) if not name.startswith("_")}
"""The names that the source of a kernel finds."""
STRIDE = STRIDE
