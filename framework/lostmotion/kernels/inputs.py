"""The inputs of a model at many points in lock-step: cubics between samples, handed over with the time.

Part of the text that `lostmotion.likelihood.kernels` compiles. `space` is the block of a model, of which `wires` begins
with the rows of time, states, derivatives, inputs and channels.
"""

from __future__ import annotations

from lostmotion.kernels.vector import (
    WIDTH,
    assign,
    jit,
    load,
    store,
)  # fmt: skip

SOURCES, DRAWN, INPUTS, DRIVES, STEP, PACES = 5, 6, 7, 8, 9, 10
"""Where the wires tell how many sources of noise there are, forces drawn anew, inputs and drives; the row of the step;
and, bit by bit, which states belong to laws that bound their own pace by the step."""


@jit
def between(u, sample, inputs, i, share):  # type: ignore[no-untyped-def]
    """Return input `i` at a share of the way through a sample, of which `u` holds the cubic (samples, 4, inputs)."""
    at = sample * 4 * inputs + i
    return u[at] + share * (u[at + inputs] + share * (u[at + 2 * inputs] + share * u[at + 3 * inputs]))


@jit
def driven(space, wires, u, which, begin, k, share, dt, lanes):  # type: ignore[no-untyped-def]
    """Hand the inputs at a share of the way through sample `k`, and the time, to the model."""
    inputs = wires[INPUTS]
    for i in range(inputs):
        if wires[DRIVES] == 1:
            for o in range(0, lanes, WIDTH):
                store(space, wires[3] + i, o, between(u, k, inputs, i, share))
        else:
            for lane in range(lanes):
                assign(space, wires[3] + i, lane, between(u, which[lane] + k, inputs, i, share))
    for o in range(0, lanes, WIDTH):
        store(space, wires[0], o, load(begin, 0, o) + (k + share) * dt)


@jit
def mirrored(space, wires, u, which, k, share, width, lanes):  # type: ignore[no-untyped-def]
    """Hand over the inputs at both ends of a step less those in its middle: with the middle they make up both ends."""
    inputs = wires[INPUTS]
    drives = lanes if wires[DRIVES] > 1 else 1
    for i in range(inputs):
        for lane in range(drives):
            row = which[lane] + k
            ends = between(u, row, inputs, i, share) + between(u, row, inputs, i, share + width)
            both = ends - between(u, row, inputs, i, share + 0.5 * width)
            if drives > 1:
                assign(space, wires[3] + i, lane, both)
            else:
                for o in range(0, lanes, WIDTH):
                    store(space, wires[3] + i, o, both)
