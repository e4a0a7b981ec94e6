"""Small work arrays on the stack of a kernel: the compiler keeps them in registers, as it can no others."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray


def _on_stack(dimensions: int) -> Any:
    """Return an intrinsic that makes an array of `size` (a literal) along each dimension, with nothing in it yet."""

    @intrinsic(prefer_literal=True)
    def stacked(typingctx: Any, size: Any) -> Any:
        if not isinstance(size, types.IntegerLiteral):
            return None
        kind = types.Array(types.float64, dimensions, "C")
        count = int(size.literal_value)

        def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            double = context.get_data_type(types.float64)
            item = context.get_abi_sizeof(double)

            def number(value: int) -> Any:
                return context.get_constant(types.intp, value)

            made = context.make_array(kind)(context, builder)
            context.populate_array(
                made,
                data=cgutils.alloca_once(builder, double, size=number(count**dimensions)),  # type: ignore[no-untyped-call]
                shape=[number(count)] * dimensions,
                strides=[number(item * count**i) for i in reversed(range(dimensions))],
                itemsize=number(item),
                meminfo=None,
            )
            return made._getvalue()

        return kind(size), codegen

    return stacked


vector, square = _on_stack(1), _on_stack(2)


def slow_vector(size: int) -> NDArray[np.float64]:
    """Return an array (size,) in plain Python, filled with what betrays that it was read before it was written."""
    return np.full(size, np.nan)


def slow_square(size: int) -> NDArray[np.float64]:
    """Return the same as an array (size, size)."""
    return np.full((size, size), np.nan)
