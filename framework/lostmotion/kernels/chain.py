"""The filter of a chain of joints along a tape, and the derivatives of its one-step errors.

The multibody part is linear along the recorded path, tau = M a + h + Kq (q - q0) + Kv (v - v0), so one step of the
filter is that of a Kalman filter. Forces of laws at joints follow the step: their mean, slope and remaining variance
under the uncertainty of the state are found by Gauss-Hermite quadrature (statistical linearisation). A dry friction
that is a line of width `force * mobility` around zero velocity then is the impulse that holds the joint, as in time
stepping with set-valued friction (Moreau, 1988), averaged over the uncertainty.

States are the positions (n,), the velocities (n,), position and velocity of each motor behind a gear, and the inner
state of each law that has one.
"""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.inner_states import FORCE, RATE, follow_law, place_law
from lostmotion.kernels.joint_laws import average_laws, clip_moments, find_push
from lostmotion.kernels.stored import stored
from lostmotion.kernels.vector import STRIDE

STEEP = 0.01
"""A law takes the fine steps while it slows its joint down by more than this share within a sample."""
RUNAWAY = 1e6
"""A velocity (SI) that no machine reaches: the filter has diverged."""


@stored(nogil=True, error_model="numpy")
def filter_chain(  # type: ignore[no-untyped-def]
    z, picks, dt, coarse, fine, inverses, Kq, KV, h, q0, v0, tau, S, R, motors, gears, joints, slots, between,
    addresses, firsts, widths, needs, numbers, begin, x0, P0, errors, variances, states, accelerations, gains, moves,
    pushes,
):  # fmt: skip
    """Write one-step errors and their variances, (samples, readings); return the number of samples that were filtered.

    `z` (samples, readings) may hold NaN, `picks` are the states that are read. A sample has `coarse` steps, or
    `fine` ones while a law is steep or may change its sign; `inverses` (2, samples, n, n) are those of M + hs / 2 KV
    for the two lengths hs of a step. `h` already holds - Kv v0. `tau` (samples, n) acts over the sample that follows,
    `S` (n,) is the intensity of the random force (N m)^2 s and `R` (readings,) the variance of readings.
    `motors` (n,) is the position of the motor of a joint in the state, or -1; `gears` (n, 5) holds half of its play,
    stiffness, damping, one over its inertia, and its viscous damping. Laws have a joint, an address, numbers, and in
    `slots` the place of their inner state, or -1; those `between` motor and link have one, and depend on the motion of
    the motor relative to its link. The time of the first sample is `begin` (s). Where `moves` has a row for each
    sample, `states`, `gains`, `accelerations` (samples, 2n) of links and of what the drives turn, and the transitions
    `moves` (samples, L, L) and `pushes` (samples, L, 2n) by torques of the drives and on the links are written too.
    """
    N, m = z.shape
    n = Kq.shape[1]
    L = len(x0)
    keep = len(moves) == N
    x, P = x0.copy(), P0.copy()
    A, T, F, E = np.zeros((L, L)), np.zeros((L, L)), np.zeros((L, L)), np.zeros((L, 2 * n))
    Y, y, g, d, f, up = np.zeros((n, L)), np.zeros(n), np.zeros(L), np.zeros(L), np.zeros(L), np.zeros(L)
    own, desk, noise = np.zeros((16, STRIDE)), np.zeros((8, STRIDE)), np.zeros((n, n))
    last = L
    active = np.zeros(n, dtype=np.bool_)
    for a in range(len(joints)):
        if slots[a] < 0:
            active[joints[a]] = True
        else:
            last = min(last, slots[a])
    places = np.concatenate((np.arange(n), np.arange(2 * n, last, 2)))
    rates = np.concatenate((np.arange(n, 2 * n), np.arange(2 * n + 1, last, 2)))
    ends, room = np.zeros(5, dtype=np.int64), np.zeros((2, max(L, 2 * n)))
    table = (addresses, firsts, widths, needs, numbers)
    past, bends, eases = np.zeros(n), np.zeros(n), np.zeros(n)
    shares, turns = np.zeros((n, 2 * n)), np.zeros((n, 2 * n))
    for k in range(N):
        for i in range(m):
            if z[k, i] != z[k, i]:
                errors[k, i], variances[k, i] = 0.0, 1.0 / (2.0 * math.pi)
                if keep:
                    gains[k, i, :] = 0.0
                continue
            c = picks[i]
            s, e = P[c, c] + R[i], z[k, i] - x[c]
            errors[k, i], variances[k, i] = e, s
            for a in range(L):
                g[a] = P[a, c] / s
            if keep:
                gains[k, i, :] = g
            for a in range(L):
                x[a] += g[a] * e
                for b in range(a + 1):
                    P[a, b] -= g[a] * g[b] * s
                    P[b, a] = P[a, b]
        if keep:
            states[k] = x
        if not abs(x[n]) < RUNAWAY:
            return k
        if k == N - 1:
            break
        if keep:
            F[:] = 0.0
            E[:] = 0.0
            for a in range(L):
                F[a, a] = 1.0
            for i in range(n):
                accelerations[k, i] = -x[n + i] / dt
                accelerations[k, n + i] = accelerations[k, i] if motors[i] < 0 else -x[motors[i] + 1] / dt
        steps, W = coarse, inverses[0]
        if last < L:
            steps, W = fine, inverses[1]
        elif fine > coarse:
            for i in range(n):
                c = n + i if motors[i] < 0 else motors[i] + 1
                if active[i] and (bends[i] > STEEP or abs(x[c]) < 2.0 * abs(x[c] - past[i])):
                    steps, W = fine, inverses[1]
                past[i] = x[c]
        hs = dt / steps
        for s in range(steps):
            off = ((s + 0.5) / steps - 0.5) * dt
            for a in range(len(joints)):
                if slots[a] >= 0:
                    place_law(ends, joints[a], n, motors[joints[a]], slots[a], between[a])
                    g[:] = 0.0
                    g[slots[a]] = hs
                    now = begin + (k + s / steps) * dt
                    follow_law(now, x, P, F, E, keep, ends, RATE, g, hs, a, table, own, desk, room)
            for i in range(n):
                r = tau[k, i] - h[k, i]
                for b in range(L):
                    Y[i, b] = 0.0
                for j in range(n):
                    r -= Kq[k, i, j] * (x[j] + 0.5 * hs * x[n + j] - q0[k, j] - off * v0[k, j]) + KV[k, i, j] * x[n + j]
                    Y[i, j] -= Kq[k, i, j]
                    Y[i, n + j] -= KV[k, i, j] + 0.5 * hs * Kq[k, i, j]
                y[i] = r
            A[:] = 0.0
            f[:] = 0.0
            for i in range(n):
                w = motors[i]
                if w < 0:
                    continue
                play, stiff, loss, light, drag = gears[i]
                twist = x[w] + 0.5 * hs * x[w + 1] - x[i] - 0.5 * hs * x[n + i]
                spread = math.sqrt(max(P[w, w] + P[i, i] - 2.0 * P[w, i], 1e-24))
                mid, p, left = clip_moments(twist, spread, play)
                share = 1.0 - p
                pull = stiff * (twist - mid) + loss * share * (x[w + 1] - x[n + i])
                y[i] += pull - tau[k, i]
                a1, a2 = stiff * share, loss * share + 0.5 * hs * stiff * share
                Y[i, w] += a1
                Y[i, i] -= a1
                Y[i, w + 1] += a2
                Y[i, n + i] -= a2
                f[w + 1] = light * (tau[k, i] - drag * x[w + 1] - pull)
                A[w + 1, w] = -hs * light * a1
                A[w + 1, i] = hs * light * a1
                A[w + 1, w + 1] = 1.0 - hs * light * (drag + a2)
                A[w + 1, n + i] = hs * light * a2
                up[i], eases[i] = stiff * stiff * left, 0.5 * hs * loss * share
            if keep:  # what torques of drives and forces on links give to links, and to motors
                shares[:] = 0.0
                turns[:] = 0.0
                for i in range(n):
                    shares[i, n + i] = 1.0
                    if motors[i] < 0:
                        shares[i, i] = 1.0
                    else:
                        turns[i, i] = gears[i, 3]
            for i in range(n):  # the damping of a gear acts in the middle of the step, not at its beginning
                w = motors[i]
                if w < 0 or eases[i] == 0.0:
                    continue
                light = gears[i, 3]
                ease = eases[i] / (1.0 + eases[i] * (light + W[k, i, i]))
                apart = f[w + 1]
                for b in range(L):
                    d[b] = A[w + 1, b] / hs
                d[w + 1] -= 1.0 / hs
                for j in range(n):
                    apart -= W[k, i, j] * y[j]
                    for b in range(L):
                        d[b] -= W[k, i, j] * Y[j, b]
                y[i] += ease * apart
                f[w + 1] -= light * ease * apart
                for b in range(L):
                    Y[i, b] += ease * d[b]
                    A[w + 1, b] -= hs * light * ease * d[b]
                if keep:
                    for c in range(2 * n):
                        push = turns[i, c]
                        for j in range(n):
                            push -= W[k, i, j] * shares[j, c]
                        shares[i, c] += ease * push
                        turns[i, c] -= light * ease * push
            for i in range(n):
                for j in range(n):
                    r = W[k, i, j]
                    f[n + i] += r * y[j]
                    r *= hs
                    for b in range(L):
                        A[n + i, b] += r * Y[j, b]
                A[n + i, n + i] += 1.0
            for i in range(n):
                for b in range(L):
                    A[i, b] = 0.5 * hs * A[n + i, b]
                A[i, i] += 1.0
                A[i, n + i] += 0.5 * hs
                x[i] += hs * (x[n + i] + 0.5 * hs * f[n + i])
                x[n + i] += hs * f[n + i]
                w = motors[i]
                if w >= 0:
                    for b in range(L):
                        A[w, b] = 0.5 * hs * A[w + 1, b]
                    A[w, w] += 1.0
                    A[w, w + 1] += 0.5 * hs
                    x[w] += hs * (x[w + 1] + 0.5 * hs * f[w + 1])
                    x[w + 1] += hs * f[w + 1]
            for b in range(last, L):
                A[b, b] = 1.0
            for i in range(len(rates)):  # P = A P A', of which only the rows of velocities in A are full
                u, p = rates[i], places[i]
                for b in range(L):
                    T[u, b] = 0.0
                for c in range(L):
                    r = A[u, c]
                    for b in range(L):
                        T[u, b] += r * P[c, b]
                for b in range(L):
                    T[p, b] = 0.5 * hs * (T[u, b] + P[u, b]) + P[p, b]
            for i in range(len(rates)):
                u = rates[i]
                for j in range(i + 1):
                    r = 0.0
                    for c in range(L):
                        r += T[u, c] * A[rates[j], c]
                    P[u, rates[j]] = r
                    P[rates[j], u] = r
            for i in range(len(rates)):
                for j in range(len(rates)):
                    p, u = places[i], rates[j]
                    P[p, u] = 0.5 * hs * (P[rates[i], u] + T[u, rates[i]]) + T[u, p]
                    P[u, p] = P[p, u]
                for j in range(i + 1):
                    p, q = places[i], places[j]
                    P[p, q] = 0.5 * hs * (P[p, rates[j]] + T[p, rates[j]]) + T[p, q]
                    P[q, p] = P[p, q]
                for b in range(last, L):
                    for a in (places[i], rates[i]):
                        P[a, b] = T[a, b]
                        P[b, a] = T[a, b]
            if keep:
                T[:] = A @ F
                F[:] = T
                E[:] = A @ E
            noise[:] = 0.0
            for i in range(n):
                w = motors[i]
                force = S[i] * hs
                if w >= 0:
                    light = gears[i, 3]
                    more = light * light * (force + up[i] * hs * hs)
                    P[w + 1, w + 1] += more
                    P[w, w] += more * hs * hs / 3.0
                    P[w, w + 1] += 0.5 * more * hs
                    P[w + 1, w] += 0.5 * more * hs
                    force = up[i] * hs * hs
                if keep:
                    for c in range(2 * n):
                        if w >= 0:
                            E[w + 1, c] += hs * turns[i, c]
                            E[w, c] += 0.5 * hs * hs * turns[i, c]
                        for a in range(n):
                            E[n + a, c] += hs * W[k, a, i] * shares[i, c]
                            E[a, c] += 0.5 * hs * hs * W[k, a, i] * shares[i, c]
                for a in range(n):
                    r = W[k, a, i] * force
                    for b in range(n):
                        noise[a, b] += r * W[k, b, i]
            for a in range(n):
                for b in range(n):
                    more = noise[a, b]
                    P[n + a, n + b] += more
                    P[a, b] += more * hs * hs / 3.0
                    P[a, n + b] += 0.5 * more * hs
                    P[n + a, b] += 0.5 * more * hs
            for i in range(n):
                if not active[i]:
                    continue
                w = motors[i]
                b, c = (i, n + i) if w < 0 else (w, w + 1)
                ease = W[k, i, i] if w < 0 else gears[i, 3]
                sq, sv = math.sqrt(max(P[b, b], 1e-24)), math.sqrt(max(P[c, c], 1e-24))
                mean, slant, slope, left = average_laws(
                    begin + (k + (s + 0.5) / steps) * dt, x[b] - 0.5 * hs * x[c], x[c], hs * f[c], sq, sv, i,
                    hs * ease, hs, joints, slots, addresses, firsts, widths, needs, numbers, own, desk)  # fmt: skip
                find_push(g, k, W, i, w, gears[i, 3], hs, False)
                bends[i] = abs(slope) * ease * dt
                inner = slant * slant * P[b, b] + 2.0 * slant * slope * P[b, c] + slope * slope * P[c, c] + left
                for a in range(L):
                    x[a] += g[a] * mean
                    d[a] = slant * P[a, b] + slope * P[a, c]
                for a in range(L):
                    for j in range(L):
                        P[a, j] += g[a] * d[j] + d[a] * g[j] + inner * g[a] * g[j]
                if keep:
                    for a in range(L):
                        d[a] = slant * F[b, a] + slope * F[c, a]
                    for a in range(L):
                        for j in range(L):
                            F[a, j] += g[a] * d[j]
                    for j in range(2 * n):
                        push = slant * E[b, j] + slope * E[c, j]
                        for a in range(L):
                            E[a, j] += g[a] * push
            for a in range(len(joints)):
                if slots[a] < 0:
                    continue
                i = joints[a]
                w = motors[i]
                place_law(ends, i, n, w, slots[a], between[a])
                find_push(g, k, W, i, w, gears[i, 3], hs, between[a])
                now = begin + (k + (s + 0.5) / steps) * dt
                follow_law(now, x, P, F, E, keep, ends, FORCE, g, hs, a, table, own, desk, room)
        if keep:
            moves[k] = F
            pushes[k] = E
            for i in range(n):
                accelerations[k, i] += x[n + i] / dt
                accelerations[k, n + i] += (x[n + i] if motors[i] < 0 else x[motors[i] + 1]) / dt
    return N


@stored(nogil=True, error_model="numpy")
def differentiate_errors(picks, gains, moves, pushes, links, drives, begins, shifts, found):  # type: ignore[no-untyped-def]
    """Write the derivatives of one-step errors with respect to coefficients of forces into `found`.

    The first coefficients have forces `links` (samples, n, count) on all links, the others forces by one drive:
    `drives` (samples, count), in the order of their joints, of which j has the columns from `begins[j]` to
    `begins[j + 1]`. `shifts` (coefficients, readings) are shifts of the readings by a unit coefficient. `found` is
    (coefficients, samples, readings). The gains of the filter are held: they do not depend on forces as long as the
    laws are linear. The inner loops run over coefficients, whose numbers are neighbours in memory.
    """
    N, m, L = gains.shape
    n, wide = links.shape[1], links.shape[2]
    count, turning = wide + drives.shape[1], len(begins) - 1
    D, T, e = np.zeros((L, count)), np.zeros((L, count)), np.zeros((m, count))
    for k in range(N):
        for i in range(m):
            c = picks[i]
            for b in range(count):
                e[i, b] = shifts[b, i] - D[c, b]
            for a in range(L):
                r = gains[k, i, a]
                for b in range(count):
                    D[a, b] += r * e[i, b]
        for b in range(count):
            for i in range(m):
                found[b, k, i] = e[i, b]
        if k == N - 1:
            break
        for a in range(L):
            for b in range(count):
                T[a, b] = 0.0
            for c in range(L):
                r = moves[k, a, c]
                for b in range(count):
                    T[a, b] += r * D[c, b]
            for i in range(n):
                r = pushes[k, a, turning + i]
                for b in range(wide):
                    T[a, b] += r * links[k, i, b]
            for j in range(turning):
                r = pushes[k, a, j]
                for b in range(begins[j], begins[j + 1]):
                    T[a, wide + b] += r * drives[k, b]
        D, T = T, D
