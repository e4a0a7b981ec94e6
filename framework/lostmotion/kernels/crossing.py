"""Steps of the filter within a sample, at many parameter points in lock-step, for a model of `N` states.

A sample is crossed in one step where the force is close to linear, and in halved steps, down to the fine grid, where it
bends within sqrt(3) standard deviations of the path. A step is halved while second differences of the force (along the
path, in its middle and at its end) would move the state by more than `BEND_LIMIT` times that width, or while the step
is long compared with the motion (h^2 |A^2| > `STEP_LIMIT`). States of laws that limit their own rate by the step may in
addition be wrong by `BEND_LIMIT * PACED_SHARE` of their value (with the full value, a posterior becomes so rough that
no chain mixes), and their limit on the length of a step is `PACED_LIMIT`. Each point is halved by its own tests alone
and waits while others are halved, so its result does not depend on the other points. The Jacobian, which is computed
anyway, raises RK4 to fifth order. Process noise enters at two Gauss points.

A block is an array (rows, STRIDE) with the rows named below. The functions of a model read and write a block of their
own (`space`); `wires` begins with its rows of time, states, derivatives, inputs and channels. Between two calls of a
model there is one loop over the points.
"""

from __future__ import annotations

from lostmotion.kernels.inputs import (
    PACES,
    STEP,
    set_inputs,
    set_mirrored_inputs,
)  # fmt: skip
from lostmotion.kernels.vector import (
    WIDTH,
    absolute,
    any_lane,
    call,
    jit,
    load,
    select,
    store,
)  # fmt: skip

N = 2
BEND_LIMIT, STEP_LIMIT, PACED_LIMIT, PACED_SHARE = 0.0023, 0.05, 1.05, 0.1
TINY = 1e-11
"""The least reach of a difference of the force, for states of about one: rounding stays below a part in 1e4 of it."""
GAUSS_POINT = 0.21132486540518712
"""The first of the two Gauss points on a step of length one."""

# Rows of the work block.
Y = 0
P = Y + N
A = P + N * N
F = A + N * N
G = F + N * N
T = G + N * N
K1 = T + N * N
K2 = K1 + N
K3 = K2 + N
K4 = K3 + N
MIDDLE = K4 + N
END = MIDDLE + N
REACH = END + N
NEAR = REACH + N
FAR = NEAR + N
KINK = FAR + N
BEND = KINK + N
UP = BEND + N
H = UP + N
AT = H + N
TRIAL_STEP = AT + 1
NEXT_STEP = TRIAL_STEP + 1
ALIVE = NEXT_STEP + 1
STRAIGHT = ALIVE + 1
EXPECTED = STRAIGHT + 1
SEEN = EXPECTED + 1
LOOSE = SEEN + 1
TAKEN = LOOSE + 1
"""The number of steps that were computed, in its first lane: those of all lanes together."""
NOISE = TAKEN + 1
"""Intensities of the process noise that enters the states, two rows for each source; then the impulse responses."""


@jit
def take_stage(space, wires, work, slopes, share, target, lanes):  # type: ignore[no-untyped-def]
    """Store derivatives as `slopes`, and write the state a step of length `share` along them from `Y` into `target`."""
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            slope = load(space, wires[2] + a, o)
            y = load(work, Y + a, o) + share * slope
            store(work, slopes + a, o, slope)
            store(work, target + a, o, y)
            store(space, wires[1] + a, o, y)


@jit
def probe_end(space, wires, work, slopes, side, lanes):  # type: ignore[no-untyped-def]
    """Store derivatives as `slopes`, and set the state one reach to one side of `END`."""
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            store(work, slopes + a, o, load(space, wires[2] + a, o))
            store(space, wires[1] + a, o, load(work, END + a, o) + side * load(work, REACH + a, o))


@jit
def compute_tolerance(work, a, o, paced):  # type: ignore[no-untyped-def]
    """Return the error that a state may have: a share of its reach, and for a paced state also a share of its value."""
    reach = load(work, REACH + a, o)
    if (paced >> a) & 1:
        reach = reach + PACED_SHARE * absolute(load(work, Y + a, o))
    return BEND_LIMIT * reach


@jit
def check_end(space, wires, work, place, wide, h, lanes):  # type: ignore[no-untyped-def]
    """Store how far the force bends about `END`, set the state to `MIDDLE`; return whether any point may step."""
    possible = False
    for o in range(0, lanes, WIDTH):
        good = (load(work, AT, o) == place) & (load(work, TRIAL_STEP, o) == wide)
        for a in range(N):
            far = absolute(0.5 * (load(work, UP + a, o) + load(space, wires[2] + a, o)) - load(work, K4 + a, o))
            good = good & (h * far <= compute_tolerance(work, a, o, wires[PACES]))
            store(work, FAR + a, o, far)
            store(space, wires[1] + a, o, load(work, MIDDLE + a, o))
        good = good | (load(work, ALIVE, o) < 0.5)
        store(work, STRAIGHT, o, select(good, 1.0, 0.0))
        possible = possible or any_lane(good)
    return possible


@jit
def probe_above(space, wires, work, c, lanes):  # type: ignore[no-untyped-def]
    """Set the state to `MIDDLE` with state `c` one reach higher."""
    for o in range(0, lanes, WIDTH):
        y = load(work, MIDDLE + c, o)
        store(space, wires[1] + c, o, y + (load(work, REACH + c, o) + TINY * (1.0 + absolute(y))))


@jit
def probe_below(space, wires, work, c, lanes):  # type: ignore[no-untyped-def]
    """Store the derivatives above `MIDDLE`, and set the state as far below it."""
    for o in range(0, lanes, WIDTH):
        y = load(work, MIDDLE + c, o)
        store(space, wires[1] + c, o, y - (load(work, REACH + c, o) + TINY * (1.0 + absolute(y))))
        for a in range(N):
            store(work, UP + a, o, load(space, wires[2] + a, o))


@jit
def store_slopes(space, wires, work, c, lanes):  # type: ignore[no-untyped-def]
    """Store the derivatives over one state in `A` and the curvature of the force in `BEND`; go up in the next state."""
    for o in range(0, lanes, WIDTH):
        y = load(work, MIDDLE + c, o)
        half = 0.5 / (load(work, REACH + c, o) + TINY * (1.0 + absolute(y)))
        share = 2.0 * load(work, P + c * N + c, o) * half * half
        for a in range(N):
            up, down = load(work, UP + a, o), load(space, wires[2] + a, o)
            bent = (up + down - 2.0 * load(work, K2 + a, o)) * share
            store(work, A + a * N + c, o, (up - down) * half)
            store(work, BEND + a, o, bent if c == 0 else load(work, BEND + a, o) + bent)
        store(space, wires[1] + c, o, y)
        if c + 1 < N:
            y = load(work, MIDDLE + c + 1, o)
            store(space, wires[1] + c + 1, o, y + (load(work, REACH + c + 1, o) + TINY * (1.0 + absolute(y))))


@jit
def try_step(derive, space, wires, work, u, which, begin, k, place, wide, nsub, dt, lanes):  # type: ignore[no-untyped-def]
    """Try a step of `wide` fine steps from the states `Y`; return nonzero if a law raised an error.

    It begins at fine step `place` of the `nsub` ones of sample `k`. `STRAIGHT` marks the points that may take it;
    `KINK` is the difference between the derivatives at both ends and those in the middle.
    """
    share, width = place / nsub, wide / nsub
    h = width * dt
    for o in range(0, lanes, WIDTH):
        store(space, wires[STEP], o, h)
        for a in range(N):
            store(space, wires[1] + a, o, load(work, Y + a, o))
    set_inputs(space, wires, u, which, begin, k, share, dt, lanes)
    failed = call(derive, space, wires, lanes)
    take_stage(space, wires, work, K1, 0.5 * h, MIDDLE, lanes)
    set_inputs(space, wires, u, which, begin, k, share + 0.5 * width, dt, lanes)
    failed |= call(derive, space, wires, lanes)
    take_stage(space, wires, work, K2, 0.5 * h, END, lanes)
    failed |= call(derive, space, wires, lanes)
    take_stage(space, wires, work, K3, h, END, lanes)
    set_inputs(space, wires, u, which, begin, k, share + width, dt, lanes)
    failed |= call(derive, space, wires, lanes)
    if wide > 1:
        probe_end(space, wires, work, K4, 1.0, lanes)
        failed |= call(derive, space, wires, lanes)
        probe_end(space, wires, work, UP, -1.0, lanes)
        failed |= call(derive, space, wires, lanes)
        if not check_end(space, wires, work, place, wide, h, lanes):
            return failed
        set_mirrored_inputs(space, wires, u, which, k, share, width, lanes)
        failed |= call(derive, space, wires, lanes)
        for o in range(0, lanes, WIDTH):
            for a in range(N):
                ends = load(work, K1 + a, o) + load(work, K4 + a, o)
                store(work, KINK + a, o, ends - load(work, K2 + a, o) - load(space, wires[2] + a, o))
    else:
        for o in range(0, lanes, WIDTH):
            for a in range(N):
                store(work, K4 + a, o, load(space, wires[2] + a, o))
                store(space, wires[1] + a, o, load(work, MIDDLE + a, o))
    set_inputs(space, wires, u, which, begin, k, share + 0.5 * width, dt, lanes)
    probe_above(space, wires, work, 0, lanes)
    for c in range(N):
        failed |= call(derive, space, wires, lanes)
        probe_below(space, wires, work, c, lanes)
        failed |= call(derive, space, wires, lanes)
        store_slopes(space, wires, work, c, lanes)
    return failed


@jit
def accept_step(work, o, place, wide, h, paced):  # type: ignore[no-untyped-def]
    """Store which points take the step that was tried, where they wait, and their next step: twice as long.

    The next step is not doubled where the limit on its length would reject it. `F` holds the square of the Jacobian
    `A`. Return a mask of the points that take the step.
    """
    at = load(work, AT, o)
    waits = (at == place) & (load(work, TRIAL_STEP, o) == wide)
    taken, following = waits, 2.0 * wide + 0.0 * at
    for a in range(N):
        if not (paced >> a) & 1:
            following = select(4.0 * h * h * absolute(load(work, F + a * N + a, o)) <= STEP_LIMIT, following, wide)
    if wide > 1:
        taken = waits & (load(work, STRAIGHT, o) > 0.5)
        dead = load(work, ALIVE, o) < 0.5
        for a in range(N):
            kink = load(work, KINK + a, o)
            for c in range(N):
                way = load(work, Y + c, o) + load(work, END + c, o) - 2.0 * load(work, MIDDLE + c, o)
                kink = kink - load(work, A + a * N + c, o) * way
            bent = load(work, NEAR + a, o) + load(work, FAR + a, o) + 3.0 * absolute(load(work, BEND + a, o))
            taken = taken & ((h * (absolute(kink) + bent) <= compute_tolerance(work, a, o, paced)) | dead)
            limit = PACED_LIMIT if (paced >> a) & 1 else STEP_LIMIT
            taken = taken & ((h * h * absolute(load(work, F + a * N + a, o)) <= limit) | dead)
    store(work, AT, o, select(taken, place + wide, at))
    store(work, TRIAL_STEP, o, select(waits, 0.5 * wide, load(work, TRIAL_STEP, o)))
    store(work, NEXT_STEP, o, select(taken, following, load(work, NEXT_STEP, o)))
    return taken
