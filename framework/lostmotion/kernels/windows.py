"""Views for the laws of models and terms on a block of vector lanes: the values of one point, as plain arrays.

The blocks of `vector.py` have a row for each quantity and a lane for each point; a view is one column of a block.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from lostmotion.kernels.vector import STRIDE, call_address, find_address

BLOCK, NUMBERS = types.CPointer(types.float64), types.CPointer(types.int64)
_WINDOW = types.Array(types.float64, 1, "A")


@intrinsic
def column(typingctx: Any, block: Any, row: Any, lane: Any, count: Any) -> Any:
    """Return the values of one lane in `count` rows from `row` on, as an array (count,) on the block itself."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        made = context.make_array(_WINDOW)(context, builder)
        context.populate_array(
            made,
            data=find_address(builder, args, ir.DoubleType()),
            shape=cgutils.pack_array(builder, [args[3]]),
            strides=cgutils.pack_array(builder, [context.get_constant(types.intp, 8 * STRIDE)]),
            itemsize=context.get_constant(types.intp, 8),
            meminfo=None,
        )
        return made._getvalue()

    return _WINDOW(block, types.intp, types.intp, types.intp), codegen


@intrinsic
def add(typingctx: Any, block: Any, row: Any, lane: Any, more: Any) -> Any:
    """Add a number to that in one lane of a row."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = find_address(builder, args[:3], ir.DoubleType())
        builder.store(builder.fadd(builder.load(place), args[3]), place)
        return context.get_dummy_value()

    return types.void(block, types.intp, types.intp, types.float64), codegen


@intrinsic
def offset_rows(typingctx: Any, block: Any, row: Any) -> Any:
    """Return the block from a row on."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return find_address(builder, [*args, ir.Constant(args[1].type, 0)], ir.DoubleType())

    return block(block, types.intp), codegen


@intrinsic
def invoke_law(typingctx: Any, wires: Any, at: Any, own: Any, desk: Any, lanes: Any) -> Any:
    """Call the compiled law whose address is in a wire; return 0, or nonzero where it raised an error."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = builder.load(builder.gep(args[0], [args[1]]))
        return call_address(builder, place, args[2], args[3], args[4])

    return types.int32(wires, types.intp, own, desk, types.intp), codegen
