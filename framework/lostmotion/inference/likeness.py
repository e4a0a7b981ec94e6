"""Similar laws: laws of the library, at any shape, that approximate a learned force along the recorded motion.

It is a proposal in words. The likelihood has rejected these laws, at the shapes that were tried, or because a smooth
force explains as much.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.learned import LearnedTerm
from lostmotion.inference.natural import find_term, list_tried_values, sort_slots
from lostmotion.inference.shape_scan import MOST_SAMPLES, SmoothedMotion, list_shapes
from lostmotion.likelihood.posterior import Posterior

MOST_SHAPES = 40
KEPT = 6
"""The number of best single laws that are tried in pairs."""


@dataclass(frozen=True)
class Likeness:
    """Laws of the library by key that together approximate a learned force, and their share of its variance."""

    keys: tuple[str, ...]
    share: float


def find_likeness(posterior: Posterior, theta: Array, states: Array, force: Array) -> Likeness | None:
    """Return the law, or the pair of laws, that approximates a learned force (samples,) along `states` (samples, n).

    None where there is none. The posterior is of the one recording along which the force is given.
    """
    kept = slice(0, MOST_SAMPLES)
    whole = posterior.observations[0]
    short = posterior.on((whole.part(0, min(whole.samples, MOST_SAMPLES)),))
    moved = np.ascontiguousarray(states[kept, : len(posterior.system.model.states)])
    motion, aim = SmoothedMotion(short, theta, moved, np.zeros(0)), force[kept] - np.mean(force[kept])
    if not float(aim @ aim) > 0.0:
        return None
    alone = {key: _find_closest(motion, key, aim) for key in _list_static(short)}
    ranked = sorted(alone, key=lambda key: -alone[key][0])[:KEPT]
    if not ranked:
        return None
    if alone[ranked[0]][0] > posterior.settings.unknown.alike:
        return Likeness((ranked[0],), alone[ranked[0]][0])
    pairs = {
        (a, b): _compute_share(np.hstack([alone[a][1], alone[b][1]]), aim) for a, b in itertools.combinations(ranked, 2)
    }
    best = max(pairs, key=lambda pair: pairs[pair], default=None)
    return Likeness(best, pairs[best]) if best and pairs[best] > posterior.settings.unknown.alike_two else None


def _list_static(posterior: Posterior) -> list[str]:
    """Return the keys of the forces of the library without states, which are functions of the motion alone."""
    found = []
    for key in posterior.system.keys:
        term = find_term(posterior, key)[0]
        if (
            term.acts == "motion"
            and not term.states
            and not isinstance(term, LearnedTerm)
            and "acceleration" not in term.needs
        ):
            found.append(key)
    return found


def _find_closest(motion: SmoothedMotion, key: str, aim: Array) -> tuple[float, Array]:
    """Return the largest share of a force that a law explains at any shape, and its columns (samples, amplitudes)."""
    best, columns = 0.0, np.zeros((len(aim), 0))
    posterior = motion.posterior
    shapes = sort_slots(posterior, key)[1]
    usual = {s.key: float(list_tried_values(s.param, posterior.scales)[0]) for s in shapes}
    tried = list_shapes(posterior, key) or [usual]
    for law in motion.compute_columns(key, tried[:: max(1, len(tried) // MOST_SHAPES)]):
        share = _compute_share(law, aim) if np.all(np.isfinite(law)) else 0.0
        if share > best:
            best, columns = share, law
    return best, columns


def _compute_share(columns: Array, aim: Array) -> float:
    """Return the share of the variance of a force that columns explain, after subtraction of the means."""
    centred = columns - columns.mean(axis=0)
    size = np.sqrt(np.sum(centred**2, axis=0))
    centred = centred[:, size > 0.0] / size[size > 0.0]
    if not centred.shape[1]:
        return 0.0
    left = aim - centred @ np.linalg.lstsq(centred, aim, rcond=1e-10)[0]
    return 1.0 - float(left @ left) / float(aim @ aim)
