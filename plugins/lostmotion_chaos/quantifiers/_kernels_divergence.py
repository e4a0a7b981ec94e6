"""Compiled loops behind exponents from recordings: neighbours at one drive phase, and pairs followed in time."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.stored import stored

LOG, FAR, NEAR, COUNT = 0, 1, 2, 3
"""The sums of `follow`: logarithm of the distance, distance, share of pairs within the noise, number of references."""
MANTISSA, ONE, ROOT = 0x000FFFFFFFFFFFFF, 0x3FF0000000000000, math.sqrt(2.0)


@stored(nogil=True)
def compute_square(points, i, j, flow):  # type: ignore[no-untyped-def]
    """Return the squared distance of two points; with `flow` only the part perpendicular to the mean motion.

    Along the flow neighbours neither diverge nor converge; this part would hide the divergence across the flow.
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


@stored(nogil=True)
def _insert(found, far, j, d):  # type: ignore[no-untyped-def]
    """Insert j with the distance d into the sorted lists and drop the farthest entry."""
    p = len(found) - 1
    while p > 0 and far[p - 1] > d:
        far[p] = far[p - 1]
        found[p] = found[p - 1]
        p -= 1
    far[p] = d
    found[p] = j


@stored(nogil=True)
def find_same_phase(points, wanted, phase, found, skipped):  # type: ignore[no-untyped-def]
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


@stored(nogil=True)
def select_visits(near, apart, limit, found):  # type: ignore[no-untyped-def]
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


@stored(nogil=True, error_model="numpy")
def take_logarithms(values, bits):  # type: ignore[no-untyped-def]
    """Replace values (t,) > 0 by their natural logarithms, to 1e-15; `bits` (t,) is work space for integers.

    It is a series in (m - 1)/(m + 1) of the mantissa m, which the compiler can vectorise, unlike the function of libm.
    """
    raw, mantissa = values.view(np.int64), bits.view(np.float64)
    for t in range(len(values)):
        bits[t] = (raw[t] & MANTISSA) | ONE
    for t in range(len(values)):
        power = float((raw[t] >> 52) - 1023)
        m = mantissa[t]
        large = m > ROOT
        m = 0.5 * m if large else m
        power = power + 1.0 if large else power
        s = (m - 1.0) / (m + 1.0)
        z = s * s
        tail = z * (1.0 / 13.0 + z * (1.0 / 15.0 + z * (1.0 / 17.0 + z * (1.0 / 19.0 + z / 21.0))))
        series = 1.0 + z * (1.0 / 3.0 + z * (0.2 + z * (1.0 / 7.0 + z * (1.0 / 9.0 + z * (1.0 / 11.0 + tail)))))
        values[t] = power * 0.6931471805599453 + 2.0 * s * series


@stored(nogil=True, error_model="numpy")
def _fill_squares(points, i, j, total):  # type: ignore[no-untyped-def]
    """Fill `total` (t,) with the squared distances of the paths (dim, n) from i and from j on."""
    total[:] = 0.0
    for q in range(len(points)):
        here, there = points[q, i : i + len(total)], points[q, j : j + len(total)]
        for t in range(len(total)):
            total[t] += (here[t] - there[t]) ** 2


@stored(nogil=True, error_model="numpy")
def _remove_along(points, motion, i, j, total, room):  # type: ignore[no-untyped-def]
    """Remove from the squares `total` (t,) the part along the mean direction of `motion` (dim, n)."""
    along, speed = room
    along[:] = 0.0
    speed[:] = 0.0
    for q in range(len(points)):
        here, there = points[q, i : i + len(total)], points[q, j : j + len(total)]
        one, other = motion[q, i : i + len(total)], motion[q, j : j + len(total)]
        for t in range(len(total)):
            f = one[t] + other[t]
            along[t] += (here[t] - there[t]) * f
            speed[t] += f * f
    for t in range(len(total)):
        part = along[t] * along[t] / speed[t] if speed[t] > 0.0 else 0.0
        total[t] = max(total[t] - part, 0.0)


@stored(nogil=True, error_model="numpy")
def _add_pair(total, law, sums, bits):  # type: ignore[no-untyped-def]
    """Add squared distances (t,) of one pair to sums (4, t); those of repeats and of paths that touch are left out.

    There is one loop for each row, with two arrays only: with more arrays, which might overlap, it is not vectorised.
    """
    least, noise = law
    near, many, far, log = sums[NEAR], sums[COUNT], sums[FAR], sums[LOG]
    for t in range(len(total)):
        near[t] += 1.0 if least < total[t] < noise else 0.0
    for t in range(len(total)):
        many[t] += 1.0 if total[t] > least else 0.0
    for t in range(len(total)):
        far[t] += math.sqrt(total[t] if total[t] > least else 0.0)
    for t in range(len(total)):
        total[t] = total[t] if total[t] > least else 1.0
    take_logarithms(total, bits)
    for t in range(len(total)):
        log[t] += 0.5 * total[t]


@stored(nogil=True, error_model="numpy")
def _add_reference(one, sums, before, total, bits):  # type: ignore[no-untyped-def]
    """Add the means over one reference's neighbours, from their sums `one` (4, t), to the `sums` (4, t) of all."""
    many = one[COUNT]
    for k in range(COUNT):
        row, into = one[k], sums[k]
        if k == LOG and before:
            for t in range(len(total)):
                total[t] = one[FAR, t] / many[t] if many[t] > 0.0 else 1.0
            take_logarithms(total, bits)
            for t in range(len(total)):
                into[t] += total[t]
        else:
            for t in range(len(total)):
                into[t] += row[t] / max(many[t], 1.0)
    for t in range(len(total)):
        sums[COUNT, t] += min(many[t], 1.0)


@stored(nogil=True, error_model="numpy")
def follow(points, motion, wanted, groups, law, sums):  # type: ignore[no-untyped-def]
    """Add up over references: `sums` (g, 4, times) of ln distance, distance, share within the noise, and number.

    `points` (dim, n) are paths, `motion` (dim, n) their velocities, or (0, n) to take distances whole. `groups`
    (q, g, m) are neighbours, -1 for none. `law` is (whether a group holds those before it too, whether distances are
    averaged before the logarithm, squared distance of a repeat, that of the noise). A reference counts once in a
    group, however many neighbours it has there.
    """
    grows, before, least, noise = law
    steps = sums.shape[2]
    total, bits, room = np.empty(steps), np.empty(steps, np.int64), (np.empty(steps), np.empty(steps))
    one = np.zeros((4, steps))
    for a in range(len(wanted)):
        one[:] = 0.0
        for g in range(groups.shape[1]):
            if not grows:
                one[:] = 0.0
            for j in groups[a, g]:
                if j >= 0:
                    _fill_squares(points, wanted[a], j, total)
                    if len(motion):
                        _remove_along(points, motion, wanted[a], j, total, room)
                    _add_pair(total, (least, noise), one, bits)
            _add_reference(one, sums[g], before, total, bits)


@stored(nogil=True)
def walk(points, near, rules, gained):  # type: ignore[no-untyped-def]
    """Fill `gained` (pieces, 3) along Wolf's chain of pairs, and return the number of pieces.

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
            begin, end = compute_square(points, i, j, False), compute_square(points, i + steps, j + steps, False)
            half = compute_square(points, i + steps // 2, j + steps // 2, False)
            if min(begin, half, end) > least:
                gained[many, 0] = 0.5 * math.log(half / begin)
                gained[many, 1] = 0.5 * math.log(end / begin)
                gained[many, 2] = math.sqrt(end)
                many += 1
                old = points[j + steps] - points[i + steps]
        i += steps
    return many
