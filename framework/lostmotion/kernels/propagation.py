"""The time update of the filter over one sample: steps are chosen, and what the filter knows is carried over them.

Part of the text that `lostmotion.likelihood.kernels` compiles, with the blocks of `crossing.py`, which tries steps.
"""

from __future__ import annotations

from lostmotion.kernels.crossing import (
    ALIVE,
    AT,
    BEND,
    FAR,
    GAUSS_POINT,
    K1,
    K2,
    K3,
    K4,
    NEAR,
    NEXT_STEP,
    NOISE,
    REACH,
    TAKEN,
    TRIAL_STEP,
    UP,
    A,
    F,
    G,
    N,
    P,
    T,
    Y,
    accept_step,
    compute_tolerance,
    try_step,
)  # fmt: skip
from lostmotion.kernels.inputs import (
    PACES,
)  # fmt: skip
from lostmotion.kernels.vector import (
    WIDTH,
    any_lane,
    assign,
    jit,
    largest_lane,
    load,
    select,
    square_root,
    store,
    value,
)  # fmt: skip


@jit
def multiply(work, into, left, right, o):  # type: ignore[no-untyped-def]
    """Write the product of two matrices (N, N) into a third."""
    for a in range(N):
        for b in range(N):
            s = load(work, left + a * N, o) * load(work, right + b, o)
            for c in range(1, N):
                s = s + load(work, left + a * N + c, o) * load(work, right + c * N + b, o)
            store(work, into + a * N + b, o, s)


@jit
def move_states(work, o, taken, wide, h):  # type: ignore[no-untyped-def]
    """Move the states of the points that take the step."""
    for a in range(N):
        s = load(work, F + a * N, o) * (load(work, K3, o) - load(work, K2, o))
        for c in range(1, N):
            s = s + load(work, F + a * N + c, o) * (load(work, K3 + c, o) - load(work, K2 + c, o))
        mean = load(work, K1 + a, o) + 2.0 * load(work, K2 + a, o) + 2.0 * load(work, K3 + a, o) + load(work, K4 + a, o)
        store(work, UP + a, o, h * (mean * (1.0 / 6.0) + h * h / 30.0 * s + load(work, BEND + a, o)))
    for a in range(N):
        y, near = load(work, Y + a, o), load(work, NEAR + a, o)
        store(work, Y + a, o, select(taken, y + load(work, UP + a, o), y))
        store(work, NEAR + a, o, select(taken, load(work, FAR + a, o) if wide > 1 else 0.0 * y, near))


@jit
def compute_transition(work, o, h):  # type: ignore[no-untyped-def]
    """Write the transition matrix over the step into `G`: the exponential of h A, to fourth order."""
    for a in range(N):
        for b in range(N):
            third = load(work, F + a * N, o) * load(work, A + b, o)
            fourth = load(work, F + a * N, o) * load(work, F + b, o)
            for c in range(1, N):
                third = third + load(work, F + a * N + c, o) * load(work, A + c * N + b, o)
                fourth = fourth + load(work, F + a * N + c, o) * load(work, F + c * N + b, o)
            tail = load(work, F + a * N + b, o) + h / 3.0 * (third + h / 4.0 * fourth)
            change = h * (load(work, A + a * N + b, o) + h / 2.0 * tail)
            store(work, G + a * N + b, o, change + 1.0 if a == b else change)


@jit
def propagate_impulses(work, o, sources, h):  # type: ignore[no-untyped-def]
    """Write the responses at the end of the step to unit impulses at its two Gauss points, for each source of noise."""
    soon, late = GAUSS_POINT * h, h - GAUSS_POINT * h
    for source in range(sources):
        row = int(value(work, NOISE + 2 * source, 0))
        first = NOISE + 2 * sources + 2 * N * source
        for a in range(N):
            unit = 1.0 if a == row else 0.0
            slope, square = load(work, A + a * N + row, o), load(work, F + a * N + row, o)
            store(work, first + a, o, unit + soon * (slope + 0.5 * soon * square))
            store(work, first + N + a, o, unit + late * (slope + 0.5 * late * square))


@jit
def propagate_covariance(work, o, taken, sources, h):  # type: ignore[no-untyped-def]
    """Propagate the covariance of the points that take the step by the transition `G`, and add the process noise."""
    multiply(work, F, G, P, o)
    for a in range(N):
        for b in range(a, N):
            s = load(work, F + a * N, o) * load(work, G + b * N, o)
            for c in range(1, N):
                s = s + load(work, F + a * N + c, o) * load(work, G + b * N + c, o)
            for source in range(sources):
                first = NOISE + 2 * sources + 2 * N * source
                pairs = load(work, first + a, o) * load(work, first + b, o)
                pairs = pairs + load(work, first + N + a, o) * load(work, first + N + b, o)
                s = s + 0.5 * h * load(work, NOISE + 2 * source + 1, o) * pairs
            s = select(taken, s, load(work, P + a * N + b, o))
            store(work, P + a * N + b, o, s)
            store(work, P + b * N + a, o, s)


@jit
def carry_step(work, noises, sources, many, paced, h, wide, place, keep, led, lanes):  # type: ignore[no-untyped-def]
    """Carry states, covariances and noise of sensors over the step that was tried, at those points that accept it."""
    for o in range(0, lanes, WIDTH):
        multiply(work, F, A, A, o)
        taken = accept_step(work, o, place, wide, h, paced)
        if led:
            for row in range(AT, NEXT_STEP + 1):
                store(work, row, o, value(work, row, 0) + 0.0 * load(work, row, o))
            taken = load(work, AT, o) == place + wide
        if not any_lane(taken):
            continue
        move_states(work, o, taken, wide, h)
        propagate_impulses(work, o, sources, h)
        compute_transition(work, o, h)
        propagate_covariance(work, o, taken, sources, h)
        for j in range(many):
            first = j * (1 + N + many) + 1
            for a in range(N):
                s = load(work, G + a * N, o) * load(noises, first, o)
                for c in range(1, N):
                    s = s + load(work, G + a * N + c, o) * load(noises, first + c, o)
                store(work, UP + a, o, s)
            for a in range(N):
                store(noises, first + a, o, select(taken, load(work, UP + a, o), load(noises, first + a, o)))
        if keep:
            multiply(work, F, G, T, o)
            for a in range(N * N):
                store(work, T + a, o, select(taken, load(work, F + a, o), load(work, T + a, o)))


@jit
def choose_step(work, place, aligned, step, paced, led, lanes):  # type: ignore[no-untyped-def]
    """Write the step of each point at `place`, limited by the last curvature of the force; return the longest."""
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            store(work, REACH + a, o, square_root(3.0 * load(work, P + a * N + a, o)))
        want = load(work, NEXT_STEP, o)
        want = select(want > aligned, aligned, want)
        wide = aligned
        while wide > 1:
            bent = want < 0.0
            for a in range(N):
                bent = bent | (wide * step * load(work, NEAR + a, o) > compute_tolerance(work, a, o, paced))
            want = select(bent & (want == wide) & (load(work, ALIVE, o) > 0.5), 0.5 * wide, want)
            wide = wide // 2
        store(work, TRIAL_STEP, o, want)
        if led:
            store(work, TRIAL_STEP, o, value(work, TRIAL_STEP, 0) + 0.0 * want)
    return find_widest(work, place, lanes)


@jit
def find_widest(work, place, lanes):  # type: ignore[no-untyped-def]
    """Return the longest step of the points that wait at `place`, 0 where none waits there."""
    most = 0.0
    for o in range(0, lanes, WIDTH):
        most = max(most, largest_lane(select(load(work, AT, o) == place, load(work, TRIAL_STEP, o), 0.0)))
    return int(most)


@jit
def cross_sample(derive, space, wires, work, noises, u, which, begin, k, nsub, dt, sources, many, keep, led, lanes):  # type: ignore[no-untyped-def]
    """Carry all points over sample `k`, with the inputs in `u`; return nonzero if a law raised an error."""
    failed, place, step = 0, 0 * nsub, dt / nsub  # numba compiles a call anew for a literal
    for o in range(0, lanes, WIDTH):
        store(work, AT, o, 0.0)
    while place < nsub:
        aligned = place & -place if place else nsub
        waiting = place == 0
        for o in range(0, lanes, WIDTH):
            waiting = waiting or any_lane(load(work, AT, o) == place)
        if not waiting:
            place += aligned
            continue
        wide = choose_step(work, place, aligned, step, wires[PACES], led, lanes)
        done = wide
        while wide > 0:
            failed |= try_step(derive, space, wires, work, u, which, begin, k, place, wide, nsub, dt, lanes)
            carry_step(work, noises, sources, many, wires[PACES], wide * step, wide, place, keep, led, lanes)
            assign(work, TAKEN, 0, value(work, TAKEN, 0) + lanes)
            done = wide
            wide = find_widest(work, place, lanes)
        place += done
    return failed
