"""Noise of sensors with states of its own, beside the filter through a model: its means, covariances and parameters.

Part of the text that `lostmotion.likelihood.kernels` compiles. `noises` holds for each of the `many` noise states of
all sensors its mean, its covariance with the states of the model (N rows) and with all noise states (`many` rows); then
`many` rows for intermediate values. `blocks` holds for each noise state what it adds to the reading of its sensor, and
its rows of transition, driving noise and first covariance (`many` each). The noise states of a sensor are those from
`begin` to `end`; all others are independent of them.
"""

from __future__ import annotations

from lostmotion.kernels.crossing import (
    LOOSE,
    UP,
    H,
    N,
    Y,
)  # fmt: skip
from lostmotion.kernels.inputs import (
    set_inputs,
)  # fmt: skip
from lostmotion.kernels.vector import (
    WIDTH,
    call,
    jit,
    load,
    store,
)  # fmt: skip


@jit
def initialise_noises(noises, blocks, many, lanes):  # type: ignore[no-untyped-def]
    """Set the noise states to zero, with their first covariances."""
    wide, rows = 1 + N + many, 1 + 3 * many
    for o in range(0, lanes, WIDTH):
        for j in range(many * wide + many):
            store(noises, j, o, 0.0)
        for j in range(many):
            for i in range(many):
                store(noises, j * wide + 1 + N + i, o, load(blocks, j * rows + 1 + 2 * many + i, o))


@jit
def update_noises(work, noises, blocks, gauge, many, begin, end, precision, miss, o):  # type: ignore[no-untyped-def]
    """Update the noise states of all sensors by one reading; `UP` holds its covariance with the states."""
    wide, rows = 1 + N + many, 1 + 3 * many
    for j in range(many):
        s = 0.0 * gauge
        for a in range(N):
            s = s + gauge * load(work, H + a, o) * load(noises, j * wide + 1 + a, o)
        for i in range(begin, end):
            s = s + load(blocks, i * rows, o) * load(noises, j * wide + 1 + N + i, o)
        store(noises, many * wide + j, o, s)
    for j in range(many):
        share = load(noises, many * wide + j, o) * precision
        store(noises, j * wide, o, load(noises, j * wide, o) + share * miss)
        for a in range(N):
            row = j * wide + 1 + a
            store(noises, row, o, load(noises, row, o) - share * load(work, UP + a, o))
        for i in range(many):
            row = j * wide + 1 + N + i
            store(noises, row, o, load(noises, row, o) - share * load(noises, many * wide + i, o))


@jit
def propagate_noises(noises, blocks, many, begin, end, lanes):  # type: ignore[no-untyped-def]
    """Propagate the noise states of a sensor over one sample, and add their driving noise."""
    wide, rows, spare = 1 + N + many, 1 + 3 * many, many * (1 + N + many)
    for o in range(0, lanes, WIDTH):
        for c in range(wide):
            for j in range(begin, end):
                s = load(blocks, j * rows + 1 + begin, o) * load(noises, begin * wide + c, o)
                for i in range(begin + 1, end):
                    s = s + load(blocks, j * rows + 1 + i, o) * load(noises, i * wide + c, o)
                store(noises, spare + j, o, s)
            for j in range(begin, end):
                store(noises, j * wide + c, o, load(noises, spare + j, o))
        for k in range(many):
            first = k * wide + 1 + N
            for j in range(begin, end):
                s = load(blocks, j * rows + 1 + begin, o) * load(noises, first + begin, o)
                for i in range(begin + 1, end):
                    s = s + load(blocks, j * rows + 1 + i, o) * load(noises, first + i, o)
                store(noises, spare + j, o, s)
            for j in range(begin, end):
                store(noises, first + j, o, load(noises, spare + j, o))
        for j in range(begin, end):
            for i in range(begin, end):
                row = j * wide + 1 + N + i
                store(noises, row, o, load(noises, row, o) + load(blocks, j * rows + 1 + many + i, o))


@jit
def add_clock_noise(derive, space, wires, work, levels, row, inputs, lanes):  # type: ignore[no-untyped-def]
    """Add the variance of stamps that jitter to `LOOSE`: theirs (s^2), in `levels`, times the squared modelled speed.

    `H` holds the slopes of the channel over the states; return nonzero if a law raised an error.
    """
    u, which, begin, k, dt = inputs
    set_inputs(space, wires, u, which, begin, k, 0.0, dt, lanes)
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            store(space, wires[1] + a, o, load(work, Y + a, o))
    failed = call(derive, space, wires, lanes)
    for o in range(0, lanes, WIDTH):
        speed = load(work, H, o) * load(space, wires[2], o)
        for a in range(1, N):
            speed = speed + load(work, H + a, o) * load(space, wires[2] + a, o)
        store(work, LOOSE, o, load(work, LOOSE, o) + load(levels, row, o) * speed * speed)
    return failed
