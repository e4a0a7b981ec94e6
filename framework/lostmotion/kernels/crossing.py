"""How the states of a filter go over one sample, at many parameter points in lock-step; for a model of `N` states.

A sample is crossed in one step where the force is straight, and in halves of it, down to the fine grid, where it bends
within sqrt(3) standard deviations of the way: while second differences of the force, along the way, in its middle and
at its end, would move the state by more than `BENDS` times that width, or the step is long against the motion
(h^2 |A^2| > `LONG`). The states of laws that bound their own pace by the step may be off by `OWN` of that share of what
they are (with all of it a posterior gets so rough that no chain mixes), and a step is long for them beyond `PACED`.
Each point halves by its own tests alone and waits while others do, so that its result does not depend on them. The
linearisation at hand makes RK4 one of fifth order; noise enters at two Gauss points.

A block is an array (rows, STRIDE), rows by the names below; the functions of a model read and write a block of their
own (`space`), of which `wires` begins with the rows of time, states, derivatives, inputs and channels. Between two
calls of a model there is one loop over the points.
"""

from __future__ import annotations

from lostmotion.kernels.inputs import (
    PACES,
    STEP,
    driven,
    mirrored,
)  # fmt: skip
from lostmotion.kernels.vector import (
    WIDTH,
    call,
    jit,
    load,
    root,
    select,
    size,
    some,
    store,
    top,
    value,
)  # fmt: skip

N = 2
BENDS, LONG, PACED, OWN = 0.0023, 0.05, 1.05, 0.1
TINY = 1e-14
SOON = 0.21132486540518712
"""The first of two Gauss points on a step of one."""

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
WANT = AT + 1
WISH = WANT + 1
ALIVE = WISH + 1
HOPE = ALIVE + 1
EXPECTED = HOPE + 1
SEEN = EXPECTED + 1
LOOSE = SEEN + 1
NOISE = LOOSE + 1
"""Intensities of the noise that enters the states: as many rows as there are sources; behind them the slow noise."""


@jit
def staged(space, wires, work, slopes, share, target, lanes):  # type: ignore[no-untyped-def]
    """Note derivatives as `slopes`, and go a step of length `share` along them from `Y` to `target`."""
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            slope = load(space, wires[2] + a, o)
            y = load(work, Y + a, o) + share * slope
            store(work, slopes + a, o, slope)
            store(work, target + a, o, y)
            store(space, wires[1] + a, o, y)


@jit
def beside(space, wires, work, slopes, side, lanes):  # type: ignore[no-untyped-def]
    """Note derivatives as `slopes`, and go a reach to one side of `END`."""
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            store(work, slopes + a, o, load(space, wires[2] + a, o))
            store(space, wires[1] + a, o, load(work, END + a, o) + side * load(work, REACH + a, o))


@jit
def borne(work, a, o, paced):  # type: ignore[no-untyped-def]
    """Return how far off a state may be: a share of its reach, and for a paced one of what it is."""
    reach = load(work, REACH + a, o)
    if (paced >> a) & 1:
        reach = reach + OWN * size(load(work, Y + a, o))
    return BENDS * reach


@jit
def hopeful(space, wires, work, place, wide, h, lanes):  # type: ignore[no-untyped-def]
    """Note how far the force bends about `END`, and go to `MIDDLE`; return whether any point may take the step."""
    hope = False
    for o in range(0, lanes, WIDTH):
        good = (load(work, AT, o) == place) & (load(work, WANT, o) == wide)
        for a in range(N):
            far = size(0.5 * (load(work, UP + a, o) + load(space, wires[2] + a, o)) - load(work, K4 + a, o))
            good = good & (h * far <= borne(work, a, o, wires[PACES]))
            store(work, FAR + a, o, far)
            store(space, wires[1] + a, o, load(work, MIDDLE + a, o))
        good = good | (load(work, ALIVE, o) < 0.5)
        store(work, HOPE, o, select(good, 1.0, 0.0))
        hope = hope or some(good)
    return hope


@jit
def probing(space, wires, work, c, lanes):  # type: ignore[no-untyped-def]
    """Go from `MIDDLE` a reach up in one state."""
    for o in range(0, lanes, WIDTH):
        y = load(work, MIDDLE + c, o)
        store(space, wires[1] + c, o, y + (load(work, REACH + c, o) + TINY * (1.0 + size(y))))


@jit
def probed(space, wires, work, c, lanes):  # type: ignore[no-untyped-def]
    """Note derivatives above `MIDDLE`, and go as far below."""
    for o in range(0, lanes, WIDTH):
        y = load(work, MIDDLE + c, o)
        store(space, wires[1] + c, o, y - (load(work, REACH + c, o) + TINY * (1.0 + size(y))))
        for a in range(N):
            store(work, UP + a, o, load(space, wires[2] + a, o))


@jit
def sloped(space, wires, work, c, lanes):  # type: ignore[no-untyped-def]
    """Note the slopes over one state in `A`, and what the force bends in `BEND`; go up in the next state."""
    for o in range(0, lanes, WIDTH):
        y = load(work, MIDDLE + c, o)
        half = 0.5 / (load(work, REACH + c, o) + TINY * (1.0 + size(y)))
        share = 2.0 * load(work, P + c * N + c, o) * half * half
        for a in range(N):
            up, down = load(work, UP + a, o), load(space, wires[2] + a, o)
            bent = (up + down - 2.0 * load(work, K2 + a, o)) * share
            store(work, A + a * N + c, o, (up - down) * half)
            store(work, BEND + a, o, bent if c == 0 else load(work, BEND + a, o) + bent)
        store(space, wires[1] + c, o, y)
        if c + 1 < N:
            y = load(work, MIDDLE + c + 1, o)
            store(space, wires[1] + c + 1, o, y + (load(work, REACH + c + 1, o) + TINY * (1.0 + size(y))))


@jit
def attempted(derive, space, wires, work, u, which, begin, k, place, wide, nsub, dt, lanes):  # type: ignore[no-untyped-def]
    """Try a step of `wide` fine ones from the states `Y`; return a failure.

    It begins at `place` of the `nsub` fine ones of sample `k`. `HOPE` tells which points may take it, `KINK` how far
    the derivatives at both ends are off those in the middle.
    """
    share, width = place / nsub, wide / nsub
    h = width * dt
    for o in range(0, lanes, WIDTH):
        store(space, wires[STEP], o, h)
        for a in range(N):
            store(space, wires[1] + a, o, load(work, Y + a, o))
    driven(space, wires, u, which, begin, k, share, dt, lanes)
    failed = call(derive, space, wires, lanes)
    staged(space, wires, work, K1, 0.5 * h, MIDDLE, lanes)
    driven(space, wires, u, which, begin, k, share + 0.5 * width, dt, lanes)
    failed |= call(derive, space, wires, lanes)
    staged(space, wires, work, K2, 0.5 * h, END, lanes)
    failed |= call(derive, space, wires, lanes)
    staged(space, wires, work, K3, h, END, lanes)
    driven(space, wires, u, which, begin, k, share + width, dt, lanes)
    failed |= call(derive, space, wires, lanes)
    if wide > 1:
        beside(space, wires, work, K4, 1.0, lanes)
        failed |= call(derive, space, wires, lanes)
        beside(space, wires, work, UP, -1.0, lanes)
        failed |= call(derive, space, wires, lanes)
        if not hopeful(space, wires, work, place, wide, h, lanes):
            return failed
        mirrored(space, wires, u, which, k, share, width, lanes)
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
    driven(space, wires, u, which, begin, k, share + 0.5 * width, dt, lanes)
    probing(space, wires, work, 0, lanes)
    for c in range(N):
        failed |= call(derive, space, wires, lanes)
        probed(space, wires, work, c, lanes)
        failed |= call(derive, space, wires, lanes)
        sloped(space, wires, work, c, lanes)
    return failed


@jit
def accepted(work, o, place, wide, h, paced):  # type: ignore[no-untyped-def]
    """Note which points take the step that was tried, where they wait, and how far they would go next: twice as far.

    They do not wish for a step of which it can be told now that it will be too long against the motion.
    `F` holds the square of the slopes `A`. Return a mask of the points that take it.
    """
    at = load(work, AT, o)
    waits = (at == place) & (load(work, WANT, o) == wide)
    taken, wish = waits, 2.0 * wide + 0.0 * at
    for a in range(N):
        if not (paced >> a) & 1:
            wish = select(4.0 * h * h * size(load(work, F + a * N + a, o)) <= LONG, wish, wide)
    if wide > 1:
        taken = waits & (load(work, HOPE, o) > 0.5)
        dead = load(work, ALIVE, o) < 0.5
        for a in range(N):
            kink = load(work, KINK + a, o)
            for c in range(N):
                way = load(work, Y + c, o) + load(work, END + c, o) - 2.0 * load(work, MIDDLE + c, o)
                kink = kink - load(work, A + a * N + c, o) * way
            bent = load(work, NEAR + a, o) + load(work, FAR + a, o) + 3.0 * size(load(work, BEND + a, o))
            taken = taken & ((h * (size(kink) + bent) <= borne(work, a, o, paced)) | dead)
            limit = PACED if (paced >> a) & 1 else LONG
            taken = taken & ((h * h * size(load(work, F + a * N + a, o)) <= limit) | dead)
    store(work, AT, o, select(taken, place + wide, at))
    store(work, WANT, o, select(waits, 0.5 * wide, load(work, WANT, o)))
    store(work, WISH, o, select(taken, wish, load(work, WISH, o)))
    return taken


@jit
def product(work, into, left, right, o):  # type: ignore[no-untyped-def]
    """Write the product of two matrices into a third."""
    for a in range(N):
        for b in range(N):
            s = load(work, left + a * N, o) * load(work, right + b, o)
            for c in range(1, N):
                s = s + load(work, left + a * N + c, o) * load(work, right + c * N + b, o)
            store(work, into + a * N + b, o, s)


@jit
def moved(work, o, taken, wide, h):  # type: ignore[no-untyped-def]
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
def transition(work, o, h):  # type: ignore[no-untyped-def]
    """Write the transition over the step into `G`: the exponential of h A, to fourth order."""
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
def kicked(work, o, sources, h):  # type: ignore[no-untyped-def]
    """Write what is left at the end of the step of kicks at its two Gauss points, for each source of noise."""
    soon, late = SOON * h, h - SOON * h
    for source in range(sources):
        row = int(value(work, NOISE + 2 * source, 0))
        first = NOISE + 2 * sources + 2 * N * source
        for a in range(N):
            unit = 1.0 if a == row else 0.0
            slope, square = load(work, A + a * N + row, o), load(work, F + a * N + row, o)
            store(work, first + a, o, unit + soon * (slope + 0.5 * soon * square))
            store(work, first + N + a, o, unit + late * (slope + 0.5 * late * square))


@jit
def widened(work, o, taken, sources, h):  # type: ignore[no-untyped-def]
    """Carry the covariance of the points that take the step, by the transition `G`, and add the noise."""
    product(work, F, G, P, o)
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
def carried(work, slow, sources, many, paced, h, wide, place, keep, lanes):  # type: ignore[no-untyped-def]
    """Carry all that is known over the step that was tried, at those points that take it: they go on from its end."""
    for o in range(0, lanes, WIDTH):
        product(work, F, A, A, o)
        taken = accepted(work, o, place, wide, h, paced)
        if not some(taken):
            continue
        moved(work, o, taken, wide, h)
        kicked(work, o, sources, h)
        transition(work, o, h)
        widened(work, o, taken, sources, h)
        for j in range(many):
            first = j * (1 + N + many) + 1
            for a in range(N):
                s = load(work, G + a * N, o) * load(slow, first, o)
                for c in range(1, N):
                    s = s + load(work, G + a * N + c, o) * load(slow, first + c, o)
                store(work, UP + a, o, s)
            for a in range(N):
                store(slow, first + a, o, select(taken, load(work, UP + a, o), load(slow, first + a, o)))
        if keep:
            product(work, F, G, T, o)
            for a in range(N * N):
                store(work, T + a, o, load(work, F + a, o))


@jit
def wanted(work, place, aligned, step, paced, lanes):  # type: ignore[no-untyped-def]
    """Write how far the points at `place` would step, by how the force bends there; return the farthest of them."""
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            store(work, REACH + a, o, root(3.0 * load(work, P + a * N + a, o)))
        want = load(work, WISH, o)
        want = select(want > aligned, aligned, want)
        wide = aligned
        while wide > 1:
            bent = want < 0.0
            for a in range(N):
                bent = bent | (wide * step * load(work, NEAR + a, o) > borne(work, a, o, paced))
            want = select(bent & (want == wide) & (load(work, ALIVE, o) > 0.5), 0.5 * wide, want)
            wide = wide // 2
        store(work, WANT, o, want)
    return widest(work, place, lanes)


@jit
def widest(work, place, lanes):  # type: ignore[no-untyped-def]
    """Return the widest step that a point which waits at `place` would take, 0 where none waits there."""
    most = 0.0
    for o in range(0, lanes, WIDTH):
        most = max(most, top(select(load(work, AT, o) == place, load(work, WANT, o), 0.0)))
    return int(most)


@jit
def crossed(derive, space, wires, work, slow, u, which, begin, k, nsub, dt, sources, many, keep, lanes):  # type: ignore[no-untyped-def]
    """Carry all points over sample `k`, of which `u` holds the inputs; return a failure."""
    failed, place, step = 0, 0 * nsub, dt / nsub  # numba compiles a call anew for a literal
    for o in range(0, lanes, WIDTH):
        store(work, AT, o, 0.0)
    while place < nsub:
        aligned = place & -place if place else nsub
        waiting = place == 0
        for o in range(0, lanes, WIDTH):
            waiting = waiting or some(load(work, AT, o) == place)
        if not waiting:
            place += aligned
            continue
        wide = wanted(work, place, aligned, step, wires[PACES], lanes)
        done = wide
        while wide > 0:
            failed |= attempted(derive, space, wires, work, u, which, begin, k, place, wide, nsub, dt, lanes)
            carried(work, slow, sources, many, wires[PACES], wide * step, wide, place, keep, lanes)
            done = wide
            wide = widest(work, place, lanes)
        place += done
    return failed
