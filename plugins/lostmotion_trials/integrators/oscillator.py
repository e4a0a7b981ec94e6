"""A mass behind a gap by leapfrog, with friction that is set-valued: it makes data for the models, and is none of them.

The friction impulse of a step is whatever holds the parts together, up to its bound, so the mass truly sticks (Moreau's
time stepping; Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems (2008)).
"""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.stored import stored


@stored(nogil=True)
def rattle(push, lean, still, numbers, state, every):  # type: ignore[no-untyped-def]
    """Return the position (samples,) relative to the base before every `every` steps; `state` moves on to the end.

    Each step has the acceleration `push` that the drive gives, the position `lean` of the base, both at its middle, and
    the relative velocity `still` at its end at which the friction holds. `numbers` are step (s), damping (1/s), spring
    and contact (1/s^2), half gap, friction and weight (both as accelerations).
    """
    step, damping, spring, contact, gap, friction, weight = numbers
    x, v = state[0], state[1]
    loss, bound = 0.5 * step * damping, step * friction
    seen = np.zeros(len(push) // every)
    for k in range(len(seen) * every):
        if k % every == 0:
            seen[k // every] = x
        middle = x + 0.5 * step * v
        pressed = middle - min(max(middle, -gap), gap)
        pull = push[k] - spring * middle - contact * pressed - weight * math.sin(lean[k] + middle)
        slip = (v * (1.0 - loss) + step * pull) / (1.0 + loss) - still[k]
        v = still[k] + slip - min(max(slip, -bound), bound)
        x = middle + 0.5 * step * v
    state[0] = x
    state[1] = v
    return seen
