"""Compiled loops behind exponents from recordings: neighbours at one drive phase, and pairs followed in time."""

from __future__ import annotations

import math

import numba
import numpy as np

LOG, FAR, NEAR, COUNT = 0, 1, 2, 3
"""What `follow` sums: the logarithm of the distance, the distance, the share of pairs in the noise, the references."""


@numba.njit(cache=True, nogil=True)
def square(points, i, j, flow):  # type: ignore[no-untyped-def]
    """Return the squared distance of two points; with `flow` only what stands across the mean direction of motion.

    Along the flow neighbours neither part nor close up: left in, it hides how those across it part.
    """
    total, along, speed = 0.0, 0.0, 0.0
    for q in range(points.shape[1]):
        d = points[i, q] - points[j, q]
        total += d * d
        if flow:
            f = points[i + 1, q] - points[i - 1, q] + points[j + 1, q] - points[j - 1, q]
            along += d * f
            speed += f * f
    return max(total - along * along / speed, 0.0) if speed > 0.0 else total


@numba.njit(cache=True, nogil=True)
def _insert(found, far, j, d):  # type: ignore[no-untyped-def]
    """Put j into its place in the sorted lists, the farthest drops out."""
    p = len(found) - 1
    while p > 0 and far[p - 1] > d:
        far[p] = far[p - 1]
        found[p] = found[p - 1]
        p -= 1
    far[p] = d
    found[p] = j


@numba.njit(cache=True, nogil=True)
def same_phase(points, wanted, phase, found, skipped):  # type: ignore[no-untyped-def]
    """Fill `found` (q, k) with the nearest points that lie whole drive periods away, to half a sample.

    `phase` is (period in samples, Theiler window, squared distance of a repeat, last point that may be a neighbour).
    """
    period, theiler, least, limit = phase
    far = np.empty(found.shape[1])
    for a in range(len(wanted)):
        i = wanted[a]
        far[:] = np.inf
        for turn in range(-int(i / period) - 1, int((limit - i) / period) + 2):
            j = round(i + turn * period)
            if j < 1 or j >= limit or abs(j - i) <= theiler:
                continue
            d = 0.0
            for q in range(points.shape[1]):
                d += (points[i, q] - points[j, q]) ** 2
                if d >= far[-1]:
                    break
            if d <= least:
                skipped[a] = True
            elif d < far[-1]:
                _insert(found[a], far, j, d)


@numba.njit(cache=True, nogil=True)
def visits(near, apart, limit, found):  # type: ignore[no-untyped-def]
    """Fill `found` (q, k) with those of the sorted neighbours `near` (q, m) that belong to different visits."""
    for a in range(len(near)):
        many = 0
        for b in range(near.shape[1]):
            j = near[a, b]
            fresh = 1 <= j < limit
            for q in range(many):
                fresh = fresh and abs(found[a, q] - j) > apart
            if fresh:
                found[a, many] = j
                many += 1
                if many == found.shape[1]:
                    break


@numba.njit(cache=True, nogil=True)
def follow(points, wanted, groups, law, sums):  # type: ignore[no-untyped-def]
    """Add up over references: `sums` (g, times, 4) of ln distance, distance, share within the noise, and number.

    `groups` (q, g, m) are neighbours, -1 for none. `law` is (flow, whether distances are averaged before the
    logarithm, squared distance of a repeat, that of the noise). A reference counts once in a group, however many
    neighbours it has there.
    """
    flow, before, least, noise = law
    for a in range(len(wanted)):
        i = wanted[a]
        for g in range(groups.shape[1]):
            for t in range(sums.shape[1]):
                log, far, near, many = 0.0, 0.0, 0.0, 0
                for j in groups[a, g]:
                    if j < 0:
                        continue
                    d = square(points, i + t, j + t, flow)
                    if d <= least:
                        continue
                    log += 0.5 * math.log(d)
                    far += math.sqrt(d)
                    near += d < noise
                    many += 1
                if many > 0:
                    sums[g, t, 0] += math.log(far / many) if before else log / many
                    sums[g, t, 1] += far / many
                    sums[g, t, 2] += near / many
                    sums[g, t, 3] += 1.0


@numba.njit(cache=True, nogil=True)
def walk(points, near, rules, gained):  # type: ignore[no-untyped-def]
    """Fill `gained` (pieces, 3) along Wolf's chain of pairs, and return how many pieces there are.

    The columns are the growth of ln distance to the middle of the piece, to its end, and the distance there.
    `near` (n, k) are neighbours, the nearest first; `rules` (steps followed, squared distance of a repeat). A new
    neighbour is the one whose direction is closest to the old one's.
    """
    steps, least = rules
    i, many, j = 1, 0, -1
    old = np.zeros(points.shape[1])
    while i + steps < len(near) and many < len(gained):
        best, j = -2.0, -1
        for b in range(near.shape[1]):
            c = near[i, b]
            if c < 0 or c + steps >= len(points):
                continue
            d = points[c] - points[i]
            size = math.sqrt((d * d).sum() * max((old * old).sum(), 1e-300))
            turn = (d * old).sum() / size if many > 0 else -float(b)
            if j < 0 or turn > best:
                best, j = turn, c
        if j >= 0:
            begin, end = square(points, i, j, False), square(points, i + steps, j + steps, False)
            half = square(points, i + steps // 2, j + steps // 2, False)
            if min(begin, half, end) > least:
                gained[many, 0] = 0.5 * math.log(half / begin)
                gained[many, 1] = 0.5 * math.log(end / begin)
                gained[many, 2] = math.sqrt(end)
                many += 1
                old = points[j + steps] - points[i + steps]
        i += steps
    return many
