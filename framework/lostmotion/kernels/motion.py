"""Free simulation of a model from many starts at once, and its derivatives at many points, without a filter.

Written with the vector lanes of `vector.py`; `lostmotion.likelihood.kernels` compiles it once. `space` is the block of
a model; `wires` begins with its rows of time, states, derivatives, inputs and channels.
"""

from __future__ import annotations

import math

from lostmotion.kernels.inputs import (
    set_inputs,
)  # fmt: skip
from lostmotion.kernels.vector import (
    WIDTH,
    assign,
    call,
    jit,
    load,
    pointer,
    store,
    value,
    whole,
)  # fmt: skip


@jit
def add_slope(derive, space, wires, work, n, share, base, weight, lanes):  # type: ignore[no-untyped-def]
    """Call the model, add `weight` times the slopes to the sum, and go a step `share` along them from `base`."""
    failed = call(derive, space, wires, lanes)
    for a in range(n):
        for o in range(0, lanes, WIDTH):
            k = load(space, wires[2] + a, o)
            store(work, n + a, o, load(work, n + a, o) + weight * k)
            store(space, wires[1] + a, o, load(work, base + a, o) + share * k)
    return failed


@whole
def run_freely(functions, blocks, wiring, inputs, drives, dt, nsub, states, kicks, reached, lanes):  # type: ignore[no-untyped-def]
    """Write the states (lanes, steps, n) of free runs by RK4, `nsub` steps to a sample; return 0 unless a law raised.

    They begin at the first row of `states`; `kicks`, of the same shape or with no steps at all, are added at the other
    samples. `blocks` are those of the model, of work (2 n rows), and of the time of each lane at its first sample (1
    row); `inputs` (rows, 4, inputs) holds a cubic for each sample, `drives` (lanes,) the row at which each lane begins.
    `reached` (lanes,) counts the samples with finite states.
    """
    derive = functions[0]
    space, work, begin = pointer(blocks[0]), pointer(blocks[1]), pointer(blocks[2])
    wires, u, which = pointer(wiring), pointer(inputs), pointer(drives)
    count, steps, n = states.shape
    h = dt / nsub
    for lane in range(lanes):
        for a in range(n):
            assign(work, a, lane, states[min(lane, count - 1), 0, a])
    failed = 0
    for k in range(steps):
        living = False
        for lane in range(count):
            good = reached[lane] == k
            for a in range(n):
                if 0 < k < kicks.shape[1]:
                    assign(work, a, lane, value(work, a, lane) + kicks[lane, k, a])
                states[lane, k, a] = value(work, a, lane)
                good = good and math.isfinite(states[lane, k, a])
            if good:
                reached[lane] = k + 1
                living = True
        if failed != 0 or not living or k == steps - 1:
            break
        for j in range(nsub):
            for a in range(n):
                for o in range(0, lanes, WIDTH):
                    store(space, wires[1] + a, o, load(work, a, o))
                    store(work, n + a, o, 0.0)
            set_inputs(space, wires, u, which, begin, k, j / nsub, dt, lanes)
            failed |= add_slope(derive, space, wires, work, n, 0.5 * h, 0, 1.0, lanes)
            set_inputs(space, wires, u, which, begin, k, (j + 0.5) / nsub, dt, lanes)
            failed |= add_slope(derive, space, wires, work, n, 0.5 * h, 0, 2.0, lanes)
            failed |= add_slope(derive, space, wires, work, n, h, 0, 2.0, lanes)
            set_inputs(space, wires, u, which, begin, k, (j + 1.0) / nsub, dt, lanes)
            failed |= add_slope(derive, space, wires, work, n, 0.0, 0, 1.0, lanes)
            for a in range(n):
                for o in range(0, lanes, WIDTH):
                    store(work, a, o, load(work, a, o) + h / 6.0 * load(work, n + a, o))
    return failed


@whole
def evaluate(functions, blocks, wiring, times, states, inputs, rates, seen):  # type: ignore[no-untyped-def]
    """Write derivatives (points, n) and channels (points, channels) at `times` (points,), `states`, `inputs`.

    The parameters in the block of the model are the same for all points; `inputs` is (points, inputs). Return 0 unless
    a law raised an error.
    """
    derive, observe = functions[0], functions[1]
    space, wires = pointer(blocks[0]), pointer(wiring)
    points, n = states.shape
    most = blocks[0].shape[1]
    failed = 0
    for first in range(0, points, most):
        for lane in range(most):
            k = min(first + lane, points - 1)
            assign(space, wires[0], lane, times[k])
            for a in range(n):
                assign(space, wires[1] + a, lane, states[k, a])
            for i in range(inputs.shape[1]):
                assign(space, wires[3] + i, lane, inputs[k, i])
        failed = call(derive, space, wires, most) | call(observe, space, wires, most)
        if failed != 0:
            break
        for lane in range(min(most, points - first)):
            for a in range(n):
                rates[first + lane, a] = value(space, wires[2] + a, lane)
            for c in range(seen.shape[1]):
                seen[first + lane, c] = value(space, wires[4] + c, lane)
    return failed
