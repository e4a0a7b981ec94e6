"""The search for forces that repeat over the position of a joint: a score test at each pitch."""

from __future__ import annotations

import numpy as np

from lostmotion.parts import Array
from lostmotion.robots.arm import Column, FilteredLog, TapedArm

FEWEST, MOST, FINE = 3.0, 150.0, 0.4
"""The numbers of waves within the travel of a joint that are tried, and their distance."""
FASTEST = 0.25
"""The largest part of a wave that a joint may pass within a sample."""
KEPT = 2
"""The number of pitches of a joint that are kept."""


def find_pitches(arm: TapedArm, kept: FilteredLog, joint: int) -> tuple[float, ...]:
    """Return the pitches (rad or m) at which a wave of force at a joint would gain most, beside a filtered model.

    Shorter waves than the joint passes in a few samples are not tried.
    """
    q, v = arm.tape.path.q[:, joint], arm.tape.path.v[:, joint]
    travel = float(np.ptp(q))
    most = min(MOST, FASTEST * travel / max(float(np.max(np.abs(v))) * arm.log.dt, 1e-300))
    waves = np.arange(FEWEST, most, FINE) / max(travel, 1e-300)
    if not len(waves):
        return ()
    gains = np.concatenate([_weigh(arm, kept, joint, part) for part in np.array_split(waves, -(-len(waves) // 32))])
    found: list[float] = []
    for _ in range(KEPT):
        best = int(np.argmax(gains))
        found.append(1.0 / float(waves[best]))
        gains[np.abs(waves - waves[best]) < 1.5 / travel] = -np.inf
    return tuple(found)


def _weigh(arm: TapedArm, kept: FilteredLog, joint: int, waves: Array) -> Array:
    """Return the gain in log-likelihood of a cosine and a sine at each number of waves per unit of position."""
    angle = 2.0 * np.pi * np.outer(waves, arm.tape.path.q[:, joint])
    columns = [Column("wave", joint, f(a)) for a in angle for f in (np.cos, np.sin)]
    slopes = arm.differentiate(kept, columns, {}).reshape(len(waves), 2, -1)
    e, v = kept.seen.errors.ravel(), kept.seen.variances.ravel()
    gradient = slopes @ (-e / v)
    information = np.einsum("wik,wjk->wij", slopes / v, slopes) + 1e-12 * np.eye(2)
    return np.asarray(0.5 * np.einsum("wi,wi->w", gradient, np.linalg.solve(information, gradient[..., None])[..., 0]))
