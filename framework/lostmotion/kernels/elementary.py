"""Elementary functions that the compiler can turn into vector instructions; calls into the C library cannot be.

They replace the functions of `math` in the laws of models and terms when these are compiled. Errors, relative to the
larger of the value and 1e-300, over the stated ranges: `exp` 3e-16 (results below 1e-307 become 0), `tanh` 2e-15, `sin`
and `cos` 3e-16 relative to one for arguments up to 1e6.
"""

from __future__ import annotations

import math
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload

from lostmotion.kernels.vector import BARE

_part = numba.njit(**BARE, forceinline=True)
_SHIFT = 6755399441055744.0
"""1.5 * 2^52: adding it to a double moves the nearest whole number into the lowest bits."""


def _raise_two(k):  # type: ignore[no-untyped-def]
    """Return 2^k for a whole number k from -1022 to 1023."""
    return math.ldexp(1.0, int(k))


def _round_down(x):  # type: ignore[no-untyped-def]
    """Return the largest whole number that is not greater than x."""
    return float(math.floor(x))


@intrinsic
def _build_power(typingctx: Any, k: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        bits = ir.IntType(64)
        moved = builder.fadd(args[0], ir.Constant(ir.DoubleType(), _SHIFT + 1023.0))
        return builder.bitcast(builder.shl(builder.bitcast(moved, bits), ir.Constant(bits, 52)), ir.DoubleType())

    return types.float64(types.float64), codegen


@intrinsic
def _floor(typingctx: Any, x: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        kind = ir.FunctionType(ir.DoubleType(), [ir.DoubleType()])
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, "llvm.floor.f64"), args)

    return types.float64(types.float64), codegen


@overload(_raise_two)  # type: ignore[untyped-decorator]
def _compile_raise_two(k):  # type: ignore[no-untyped-def]
    return lambda k: _build_power(k)


@overload(_round_down)  # type: ignore[untyped-decorator]
def _compile_round_down(x):  # type: ignore[no-untyped-def]
    return lambda x: _floor(x)


@_part
def exp(x: float) -> float:
    """Return e^x."""
    y = min(max(x, -708.0), 709.7)
    k = _round_down(y * 1.4426950408889634 + 0.5)
    r = (y - k * 6.93145751953125e-1) - k * 1.42860682030941723212e-6
    s = 1.0 / 6227020800.0
    s = s * r + 1.0 / 479001600.0
    s = s * r + 1.0 / 39916800.0
    s = s * r + 1.0 / 3628800.0
    s = s * r + 1.0 / 362880.0
    s = s * r + 1.0 / 40320.0
    s = s * r + 1.0 / 5040.0
    s = s * r + 1.0 / 720.0
    s = s * r + 1.0 / 120.0
    s = s * r + 1.0 / 24.0
    s = s * r + 1.0 / 6.0
    s = s * r + 0.5
    half = _round_down(0.5 * k)
    grown = (1.0 + (r + s * r * r)) * _raise_two(half) * _raise_two(k - half)
    grown = grown if x > -708.0 else 0.0
    grown = grown if x < 709.7 else math.inf
    return grown if x == x else x


@_part
def _compute_sine(x: float, quarter: float) -> float:
    """Return the sine of x plus a number of quarter turns."""
    q = _round_down(x * 0.6366197723675814 + 0.5)
    r = ((x - q * 1.57079632673412561417) - q * 6.07710050630396597660e-11) - q * 2.02226624879595063154e-21
    q = q + quarter
    odd = q - 2.0 * _round_down(0.5 * q)
    down = 0.5 * q - 0.5 * odd
    down = down - 2.0 * _round_down(0.5 * down)
    z = r * r
    s = -1.0 / 1307674368000.0
    s = s * z + 1.0 / 6227020800.0
    s = s * z - 1.0 / 39916800.0
    s = s * z + 1.0 / 362880.0
    s = s * z - 1.0 / 5040.0
    s = s * z + 1.0 / 120.0
    s = s * z - 1.0 / 6.0
    s = r + r * z * s
    c = 1.0 / 20922789888000.0
    c = c * z - 1.0 / 87178291200.0
    c = c * z + 1.0 / 479001600.0
    c = c * z - 1.0 / 3628800.0
    c = c * z + 1.0 / 40320.0
    c = c * z - 1.0 / 720.0
    c = c * z + 1.0 / 24.0
    c = 1.0 - (0.5 * z - z * z * c)
    value = c if odd > 0.5 else s
    return -value if down > 0.5 else value


@_part
def sin(x: float) -> float:
    """Return the sine of x (rad)."""
    return _compute_sine(x, 0.0)


@_part
def cos(x: float) -> float:
    """Return the cosine of x (rad)."""
    return _compute_sine(x, 1.0)


@_part
def tanh(x: float) -> float:
    """Return the hyperbolic tangent of x."""
    z = x * x
    far = 1.0 - 2.0 / (exp(2.0 * min(abs(x), 20.0)) + 1.0)
    s = 21844.0 / 6081075.0
    s = s * z - 1382.0 / 155925.0
    s = s * z + 62.0 / 2835.0
    s = s * z - 17.0 / 315.0
    s = s * z + 2.0 / 15.0
    s = s * z - 1.0 / 3.0
    near = x + x * z * s
    if z < 0.01:
        return near
    return far if x > 0.0 else -far


QUICK = {math.exp: exp, math.sin: sin, math.cos: cos, math.tanh: tanh}
"""The replacement for each function of `math` in a compiled law."""
