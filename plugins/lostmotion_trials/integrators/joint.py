"""A second way to move a body in a gap, which shares nothing with the composed kernels: it checks them, and feeds them.

The friction is set-valued: in each step the impulse is whatever holds the parts together, up to its bound, so the
body truly sticks (Moreau's time stepping; Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems (2008)).
"""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.stored import stored


@stored(nogil=True)
def slide(push, base, numbers, start, every):  # type: ignore[no-untyped-def]
    """Return relative position (deg), relative velocity (deg/s) and share of time stuck, (samples, 3), in a joint.

    `push` (steps,) is the inertial pull of the moving base (deg/s^2) and `base` (steps,) its angle (deg), both at the
    middle of each step; `numbers` are step (s), damping (1/s), contact (1/s^2), half gap (deg), friction and weight
    (deg/s^2). One sample is kept before every `every` steps.
    """
    step, damping, contact, gap, friction, weight = numbers
    x, v = start
    loss, bound = 0.5 * step * damping, step * friction
    seen = np.zeros((len(push) // every, 3))
    for k in range(len(seen) * every):
        if k % every == 0:
            seen[k // every, 0] = x
            seen[k // every, 1] = v
        middle = x + 0.5 * step * v
        pressed = middle - min(max(middle, -gap), gap)
        pull = push[k] - contact * pressed - weight * math.sin(math.radians(base[k] + middle))
        free = (v * (1.0 - loss) + step * pull) / (1.0 + loss)
        v = free - min(max(free, -bound), bound)
        if friction > 0.0 and v == 0.0:
            seen[k // every, 2] += 1.0 / every
        x = middle + 0.5 * step * v
    return seen
