"""Vector lanes: one value for each of `WIDTH` parameter points, in one vector register where the processor has one.

A kernel that is written with these computes `WIDTH` points in lock-step with the same instructions, so the result of
one point depends neither on the other points nor on its position among them. A block of memory is an array (rows,
`STRIDE`) of doubles: each row holds one quantity of up to `STRIDE` points. `plain.py` has the same names for NumPy:
with those, the same source runs as plain Python.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model

from lostmotion.kernels.stored import stored

WIDTH = 8
"""Points in one vector of a kernel."""
STRIDE = 32
"""Points in one row of a block: the most that a kernel computes at once."""
BARE: dict[str, Any] = {"error_model": "numpy", "nogil": True, "_nrt": False}
"""Compiled without numba's run time: a kernel cannot allocate and counts no references, which makes it eight times
faster."""
INNER: dict[str, Any] = {**BARE, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""A function that only compiled code calls needs no wrapper for calls from Python."""

jit = numba.njit(**INNER)
"""Compiles a function of a kernel that other compiled functions call."""
whole = stored(**BARE)
"""Compiles a kernel that Python calls; it is cached on disk."""


class LanesType(types.Type):
    """The numba type of `WIDTH` doubles."""

    def __init__(self) -> None:
        super().__init__(name=f"Lanes{WIDTH}")


class MaskType(types.Type):
    """The numba type of `WIDTH` truth values."""

    def __init__(self) -> None:
        super().__init__(name=f"Mask{WIDTH}")


LANES, MASK = LanesType(), MaskType()
_DOUBLES = ir.VectorType(ir.DoubleType(), WIDTH)
_BITS = ir.VectorType(ir.IntType(1), WIDTH)
_INDEX = ir.IntType(32)


def _register_type(kind: type[Any], content: ir.Type) -> None:
    """Register a numba type whose values are held in registers."""

    def begin(self: Any, manager: Any, kind: Any) -> None:
        models.PrimitiveModel.__init__(self, manager, kind, content)

    register_model(kind)(type(f"{kind.__name__}Model", (models.PrimitiveModel,), {"__init__": begin}))


_register_type(LanesType, _DOUBLES)
_register_type(MaskType, _BITS)


def _splat(builder: Any, value: Any) -> Any:
    """Return a vector with the same double in every lane."""
    empty = ir.Constant(_DOUBLES, ir.Undefined)
    one = builder.insert_element(empty, value, ir.Constant(_INDEX, 0))
    return builder.shuffle_vector(one, empty, ir.Constant(ir.VectorType(_INDEX, WIDTH), [0] * WIDTH))


def _lanes(builder: Any, kind: Any, value: Any) -> Any:
    """Return a value of any number type as a vector."""
    if isinstance(kind, LanesType | MaskType):
        return value
    if isinstance(kind, types.Integer):
        value = builder.sitofp(value, ir.DoubleType())
    return _splat(builder, value)


def _call_llvm(builder: Any, name: str, *values: Any) -> Any:
    """Return the result of an LLVM intrinsic on vectors."""
    label = f"llvm.{name}.v{WIDTH}f64"
    kind = ir.FunctionType(_DOUBLES, [_DOUBLES] * len(values))
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, label), values)


def _make_function(make: Callable[..., Any], result: Any, count: int) -> Any:
    """Return an intrinsic of one or two vectors; a plain number stands for the same number in every lane."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return make(builder, *(_lanes(builder, k, v) for k, v in zip(signature.args, args, strict=True)))

    if count == 1:

        @intrinsic
        def unary(typingctx: Any, a: Any) -> Any:
            return result(a), codegen

        return unary

    @intrinsic
    def binary(typingctx: Any, a: Any, b: Any) -> Any:
        return result(a, b), codegen

    return binary


def _define_operator(symbol: Any, kind: Any, make: Callable[..., Any], result: Any) -> None:
    """Define an operator of Python for vectors or masks."""
    plain = (types.Float, types.Integer)

    class Between(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            known = [a for a in args if isinstance(a, kind)]
            if known and len(args) == 2 and all(isinstance(a, (kind, *plain)) for a in args):
                return signature(result, *(types.unliteral(a) for a in args))
            return None

    def lower(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return make(builder, *(_lanes(builder, k, v) for k, v in zip(signature.args, args, strict=True)))

    infer_global(symbol)(Between)
    for pair in ((kind, kind), *((kind, p) for p in plain), *((p, kind) for p in plain)):
        lower_builtin(symbol, *pair)(lower)


for _symbol, _name in (
    (operator.add, "fadd"),
    (operator.sub, "fsub"),
    (operator.mul, "fmul"),
    (operator.truediv, "fdiv"),
):
    _define_operator(_symbol, LanesType, lambda b, x, y, name=_name: getattr(b, name)(x, y), LANES)
for _symbol, _name in ((operator.le, "<="), (operator.lt, "<"), (operator.gt, ">"), (operator.eq, "==")):
    _define_operator(_symbol, LanesType, lambda b, x, y, name=_name: b.fcmp_ordered(name, x, y), MASK)
for _symbol, _name in ((operator.and_, "and_"), (operator.or_, "or_")):
    _define_operator(_symbol, MaskType, lambda b, x, y, name=_name: getattr(b, name)(x, y), MASK)

square_root = _make_function(lambda b, x: _call_llvm(b, "sqrt", x), LANES, 1)
"""The square root of each lane."""
absolute = _make_function(lambda b, x: _call_llvm(b, "fabs", x), LANES, 1)
"""The absolute value of each lane."""
larger = _make_function(lambda b, x, y: b.select(b.fcmp_ordered(">", x, y), x, y), LANES, 2)
"""The larger of two numbers in each lane; the second where one is not a number."""
is_finite = _make_function(
    lambda b, x: b.fcmp_ordered("<", _call_llvm(b, "fabs", x), _splat(b, ir.Constant(ir.DoubleType(), float("inf")))),
    MASK,
    1,
)
"""Whether each lane holds a finite number."""


@intrinsic
def select(typingctx: Any, mask: Any, yes: Any, no: Any) -> Any:
    """Return in each lane `yes` where the mask is set, else `no`."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        both = (_lanes(builder, k, v) for k, v in zip(signature.args[1:], args[1:], strict=True))
        return builder.select(args[0], *both)

    return LANES(mask, yes, no), codegen


@intrinsic
def any_lane(typingctx: Any, mask: Any) -> Any:
    """Return whether the mask is set in any lane."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        bits = builder.bitcast(args[0], ir.IntType(WIDTH))
        return builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(WIDTH), 0))

    return types.boolean(mask), codegen


@intrinsic
def largest_lane(typingctx: Any, value: Any) -> Any:
    """Return the largest of the numbers in all lanes."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        kind = ir.FunctionType(ir.DoubleType(), [_DOUBLES])
        reduce = cgutils.get_or_insert_function(builder.module, kind, f"llvm.vector.reduce.fmax.v{WIDTH}f64")
        return builder.call(reduce, args)

    return types.float64(value), codegen


@intrinsic
def pointer(typingctx: Any, array: Any) -> Any:
    """Return the memory of a contiguous array: a pointer needs one register, an array seven."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return context.make_array(signature.args[0])(context, builder, args[0]).data

    return types.CPointer(array.dtype)(array), codegen


def find_address(builder: Any, args: Any, item: Any) -> Any:
    """Return the address of lane `args[2]` of row `args[1]` of the block at `args[0]`."""
    place = builder.add(builder.mul(args[1], ir.Constant(args[1].type, STRIDE)), args[2])
    return builder.bitcast(builder.gep(args[0], [place], inbounds=True), item.as_pointer())


@intrinsic
def load(typingctx: Any, block: Any, row: Any, first: Any) -> Any:
    """Return the lanes from `first` on of a row of a block."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.load(find_address(builder, args, _DOUBLES), align=8)

    return LANES(block, types.intp, types.intp), codegen


@intrinsic
def store(typingctx: Any, block: Any, row: Any, first: Any, value: Any) -> Any:
    """Write a number in lanes into a row of a block, from lane `first` on."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        lanes = _lanes(builder, signature.args[3], args[3])
        builder.store(lanes, find_address(builder, args, _DOUBLES), align=8)
        return context.get_dummy_value()

    return types.void(block, types.intp, types.intp, value), codegen


@intrinsic
def value(typingctx: Any, block: Any, row: Any, lane: Any) -> Any:
    """Return the number in one lane of a row."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.load(find_address(builder, args, ir.DoubleType()))

    return types.float64(block, types.intp, types.intp), codegen


@intrinsic
def assign(typingctx: Any, block: Any, row: Any, lane: Any, number: Any) -> Any:
    """Write the number in one lane of a row."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        builder.store(args[3], find_address(builder, args, ir.DoubleType()))
        return context.get_dummy_value()

    return types.void(block, types.intp, types.intp, types.float64), codegen


def call_address(builder: Any, place: Any, *args: Any) -> Any:
    """Return the status of a compiled function without result at an address: 0, or nonzero where it raised an error."""
    byte = ir.IntType(8).as_pointer()
    kind = ir.FunctionType(ir.IntType(32), [byte.as_pointer(), byte.as_pointer(), *(arg.type for arg in args)])
    spare = [cgutils.alloca_once(builder, byte) for _ in range(2)]
    return builder.call(builder.inttoptr(place, kind.as_pointer()), [*spare, *args])


@intrinsic
def call(typingctx: Any, address: Any, block: Any, wires: Any, lanes: Any) -> Any:
    """Call a compiled function of a model at `address` on a block; return 0, or nonzero where it raised an error."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return call_address(builder, *args)

    return types.int32(types.intp, block, wires, types.intp), codegen
