"""The oscillator with backlash solved piece by piece: closed form between contacts, contact times to rounding.

The acceleration of a damped linear oscillator under a harmonic force has a bound M from any time on: with the energy
E = g^2 + w^2 h^2 of its free part (position h, velocity g), which never grows,
M = sqrt(4 a^2 + w^2) sqrt(E) + B omega^2. So the motion cannot reach a boundary at distance d, approached at rate r,
before d = r t + M t^2 / 2: it can advance by this time and be checked again, and no crossing is missed. Where
r^2 >= 2 M d it must cross, once and with a velocity that keeps its sign; that crossing is found by roots of local
parabolas in a bracket.
"""

from __future__ import annotations

import math
from typing import Any

import numba

_FAST: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy"}
_MOST_ADVANCES = 1_000_000
"""Advances between two recorded states beyond which a motion is refused as too stiff."""


@numba.njit(**_FAST)
def propagate_free(kind, a, wd, tau):  # type: ignore[no-untyped-def]
    """Return e^(-a tau) cos(wd tau) and e^(-a tau) sin(wd tau) / wd, or their forms for strong or critical damping."""
    if kind > 0:
        fade = math.exp(-a * tau)
        return fade * math.cos(wd * tau), fade * math.sin(wd * tau) / wd
    if kind == 0:
        fade = math.exp(-a * tau)
        return fade, fade * tau
    slow, fast = math.exp((wd - a) * tau), math.exp(-(wd + a) * tau)
    if wd * tau < 1.0:
        return 0.5 * (slow + fast), 0.5 * fast * math.expm1(2.0 * wd * tau) / wd
    return 0.5 * (slow + fast), 0.5 * (slow - fast) / wd


@numba.njit(**_FAST)
def solve_piece(m, c, k, amplitude, omega):  # type: ignore[no-untyped-def]
    """Return kind, a, wd, w^2 of a linear piece of stiffness k, and real and imaginary part of its forced response."""
    a, stiff = 0.5 * c / m, k / m
    rest = stiff - a * a
    kind = 1 if rest > 0.0 else (-1 if rest < 0.0 else 0)
    real, imaginary = stiff - omega * omega, 2.0 * a * omega
    size = (real * real + imaginary * imaginary) * m
    if amplitude == 0.0:
        return kind, a, math.sqrt(abs(rest)), stiff, 0.0, 0.0
    return kind, a, math.sqrt(abs(rest)), stiff, amplitude * real / size, -amplitude * imaginary / size


@numba.njit(**_FAST)
def bound_advance(d, r, bound):  # type: ignore[no-untyped-def]
    """Return the time before which a boundary at distance d >= 0, approached at rate r, cannot be reached."""
    root = math.sqrt(r * r + 2.0 * bound * d)
    return 2.0 * d / (r + root) if r > 0.0 else (root - r) / bound


@numba.njit(**_FAST)
def evaluate_piece(law, angle, h0, g0, tau):  # type: ignore[no-untyped-def]
    """Return propagator, free part (h, g), position, velocity, acceleration a time `tau` after the last crossing."""
    kind, a, wd, w2, re, im, middle, omega = law
    whole, part = propagate_free(kind, a, wd, tau)
    h = h0 * (whole + a * part) + g0 * part
    g = g0 * (whole - a * part) - w2 * h0 * part
    cosine, sine = math.cos(angle + omega * tau), math.sin(angle + omega * tau)
    forced = re * cosine - im * sine
    v = g - omega * (re * sine + im * cosine)
    return whole, part, h, g, h + forced + middle, v, -2.0 * a * g - w2 * h - omega * omega * forced


@numba.njit(**_FAST)
def find_crossing(law, angle, h0, g0, to, sense, x0, now, early, late):  # type: ignore[no-untyped-def]
    """Return propagator, velocity and time of the one crossing between `early` and `late` of the boundary to * x0.

    `sense` is 1 where to * x grows and -1 where it falls; `now` is a first guess of the time.
    """
    tau = min(max(now, early), late)
    for _ in range(100):
        whole, part, h, _, x, v, push = evaluate_piece(law, angle, h0, g0, tau)
        d, r, b = sense * (x0 - to * x), sense * to * v, sense * to * push
        if d > 0.0:
            early = tau
        else:
            late = tau
        if abs(d) <= 4e-16 * (x0 + abs(h) + abs(x - h)) or late - early <= 2e-16 * late:
            break
        root = math.sqrt(max(r * r + 2.0 * b * d, 0.0))
        ahead = tau + 2.0 * d / (r + root) if r + root > 0.0 else early
        if abs(ahead - tau) <= 1e-16 * tau:
            break
        tau = ahead if early < ahead < late else 0.5 * (early + late)
    return whole, part, v, tau


@numba.njit(**_FAST)
def follow_piece(law, angle, x, v, side, x0, left, most):  # type: ignore[no-untyped-def]
    """Return time, propagator, position and velocity where the motion leaves a side, and the boundary crossed there.

    The boundary is 0.0 where none is crossed within the time `left`. The last value is how many of `most` advances
    remain, -1 where they did not suffice.
    """
    _, a, _, w2, re, im, middle, omega = law
    cosine, sine = math.cos(angle), math.sin(angle)
    forced = re * cosine - im * sine
    h = h0 = x - middle - forced
    g = g0 = v + omega * (re * sine + im * cosine)
    push = -2.0 * a * g - w2 * h - omega * omega * forced
    swing = math.sqrt(re * re + im * im) * omega * omega
    rough = math.sqrt(4.0 * a * a + w2)
    tau, whole, part = 0.0, 1.0, 0.0
    sense = 1.0 if side == 0.0 else -1.0
    if math.isinf(x0):
        whole, part, _, _, x, v, _ = evaluate_piece(law, angle, h0, g0, left)
        return left, whole, part, x, v, 0.0, most
    for spare in range(most - 1, -1, -1):
        to = side if side != 0.0 else (1.0 if v > 0.0 else -1.0)
        d, r = sense * (x0 - to * x), sense * to * v
        if d <= 0.0 and r > 0.0:
            return tau, whole, part, to * x0, v, to, spare
        d = max(d, 0.0)
        bound = rough * math.sqrt(g * g + w2 * h * h) + swing + 1e-300
        sure = r > 0.0 and r * r >= 2.0 * bound * d
        hop = bound_advance(d, r, bound)
        if sure and tau + hop < left:
            late = tau + 2.0 * d / (r + math.sqrt(r * r - 2.0 * bound * d))
            guess = tau + 2.0 * d / (r + math.sqrt(max(r * r + 2.0 * sense * to * push * d, 0.0)))
            if late > left:
                late = left
                whole, part, h, g, x, v, push = evaluate_piece(law, angle, h0, g0, left)
                if sense * (x0 - to * x) > 0.0:
                    return left, whole, part, x, v, 0.0, spare
            whole, part, v, tau = find_crossing(law, angle, h0, g0, to, sense, x0, guess, tau + hop, late)
            return tau, whole, part, to * x0, v, to, spare
        if side == 0.0:
            hop = min(hop, bound_advance(max(x0 + to * x, 0.0), -r, bound))
        tau += max(hop, math.sqrt((2e-16 * x0 + 1e-150) / bound), 1e-12 * left)
        over = tau >= left
        tau = min(tau, left)
        whole, part, h, g, x, v, push = evaluate_piece(law, angle, h0, g0, tau)
        if over:
            return left, whole, part, x, v, 0.0, spare
    return math.nan, whole, part, math.nan, math.nan, 0.0, -1


@numba.njit(**_FAST)
def strobe(start, numbers, looks, states, growth):  # type: ignore[no-untyped-def]
    """Write `states` (periods * looks + 1, 2) and the logarithms of tangent growth (periods, tangents).

    Return how many states were reached, how often a boundary was crossed, and whether the limit of advances was
    exceeded. The force is continuous, so the tangent is the product of the propagators. Areas contract at exactly the
    rate c / m, which gives the second exponent.
    """
    m, c, k1, k0, x0, amplitude, omega, phase = numbers
    if x0 == 0.0:
        k1, k0, x0 = k1 + k0, 0.0, math.inf
    kind, a, wd, w2, re, im = solve_piece(m, c, k1, amplitude, omega)
    free = (kind, a, wd, w2, re, im, 0.0, omega)
    kind, a, wd, w2, re, im = solve_piece(m, c, k1 + k0, amplitude, omega)
    shift = k0 * x0 / (k1 + k0) if k0 > 0.0 else 0.0
    upper, lower = (kind, a, wd, w2, re, im, shift, omega), (kind, a, wd, w2, re, im, -shift, omega)
    span = 2.0 * math.pi / omega / looks
    patience = 300.0 / a if a > 0.0 else math.inf
    x, v = start[0], start[1]
    side = 1.0 if x > x0 else (-1.0 if x < -x0 else 0.0)
    p, q = math.sqrt(0.5), math.sqrt(0.5)
    crossings = 0
    for n in range(states.shape[0]):
        states[n, 0], states[n, 1] = x, v
        if not (math.isfinite(x) and math.isfinite(v)):
            return n, crossings, False
        if n == states.shape[0] - 1:
            break
        theta, begun = phase + 2.0 * math.pi * (n % looks) / looks, 0.0
        spare = _MOST_ADVANCES
        while True:
            law = free if side == 0.0 else (upper if side > 0.0 else lower)
            last = span - begun <= patience
            ahead = span - begun if last else patience
            tau, whole, part, x, v, to, spare = follow_piece(law, theta + omega * begun, x, v, side, x0, ahead, spare)
            if spare < 0:
                return n, crossings, True
            # As E p = (whole + a part) p + part q, and with -w2 part and whole - a part in the second row.
            p, q = (whole + a * part) * p + part * q, (whole - a * part) * q - law[3] * part * p
            begun += tau
            ended = last and to == 0.0
            if growth.shape[1] > 0 and (ended or abs(p) + abs(q) < 1e-100):
                size = math.hypot(p, q)
                p, q = p / size, q / size
                growth[n // looks, 0] += math.log(size)
            if ended:
                break
            if to != 0.0:
                side = to if side == 0.0 else 0.0
                crossings += 1
    if growth.shape[1] > 1:
        for n in range(growth.shape[0]):
            growth[n, 1] = -c / m * span * looks - growth[n, 0]
    return states.shape[0], crossings, False
