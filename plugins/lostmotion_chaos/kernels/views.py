"""An array view without a reference count."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray


@intrinsic
def view(typingctx: Any, array: Any, start: Any, size: Any) -> Any:
    """Return `array[start:start + size]` of a contiguous vector; the vector must outlive the view.

    An ordinary slice counts references with atomic operations, which cost more than a force law.
    """
    signature = array(array, types.intp, types.intp)

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        kind = signature.args[0]
        source = context.make_array(kind)(context, builder, args[0])
        window = context.make_array(kind)(context, builder)
        item = context.get_constant(types.intp, context.get_abi_sizeof(context.get_data_type(kind.dtype)))
        context.populate_array(
            window,
            data=builder.gep(source.data, [args[1]]),
            shape=_packed(builder, args[2]),
            strides=_packed(builder, item),
            itemsize=item,
            meminfo=None,
        )
        return window._getvalue()

    return signature, codegen


def _packed(builder: Any, value: Any) -> Any:
    return cgutils.pack_array(builder, [value])


def slow_view(array: NDArray[np.float64], start: int, size: int) -> NDArray[np.float64]:
    """Return the same view in plain Python."""
    return array[start : start + size]
