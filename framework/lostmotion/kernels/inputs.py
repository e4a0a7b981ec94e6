"""The inputs of a model at many points in lock-step: cubics between samples, written with the time into its block.

Part of the text that `lostmotion.likelihood.kernels` compiles. `space` is the block of a model; `wires` begins with its
rows of time, states, derivatives, inputs and channels.
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
"""Positions in the wires: numbers of noise sources, of redrawn forces, of inputs and of drives; the row of the step;
and, as bits, the states of laws that limit their own rate by the step."""


@jit
def interpolate_input(u, sample, inputs, i, share):  # type: ignore[no-untyped-def]
    """Return input `i` at a share of the way through a sample; `u` holds its cubics (samples, 4, inputs)."""
    at = sample * 4 * inputs + i
    return u[at] + share * (u[at + inputs] + share * (u[at + 2 * inputs] + share * u[at + 3 * inputs]))


@jit
def set_inputs(space, wires, u, which, begin, k, share, dt, lanes):  # type: ignore[no-untyped-def]
    """Write the inputs at a share of the way through sample `k`, and the time, into the block of the model."""
    inputs = wires[INPUTS]
    for i in range(inputs):
        if wires[DRIVES] == 1:
            for o in range(0, lanes, WIDTH):
                store(space, wires[3] + i, o, interpolate_input(u, k, inputs, i, share))
        else:
            for lane in range(lanes):
                assign(space, wires[3] + i, lane, interpolate_input(u, which[lane] + k, inputs, i, share))
    for o in range(0, lanes, WIDTH):
        store(space, wires[0], o, load(begin, 0, o) + (k + share) * dt)


@jit
def set_mirrored_inputs(space, wires, u, which, k, share, width, lanes):  # type: ignore[no-untyped-def]
    """Write the inputs at both ends of a step, added up, less those in its middle."""
    inputs = wires[INPUTS]
    drives = lanes if wires[DRIVES] > 1 else 1
    for i in range(inputs):
        for lane in range(drives):
            row = which[lane] + k
            ends = interpolate_input(u, row, inputs, i, share) + interpolate_input(u, row, inputs, i, share + width)
            both = ends - interpolate_input(u, row, inputs, i, share + 0.5 * width)
            if drives > 1:
                assign(space, wires[3] + i, lane, both)
            else:
                for o in range(0, lanes, WIDTH):
                    store(space, wires[3] + i, o, both)
