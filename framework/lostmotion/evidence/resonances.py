"""A scan of resonances, such as the frequency of a hidden mass, over their whole range.

A law with states has no force along the recorded motion, so its shapes are tested by the filter. A resonance is found
only if its frequency is tried to within its width.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from lostmotion.evidence.effects import list_bare_promises
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import compute_range, compute_size, find_term, sort_slots
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import Slot
from lostmotion.quantities import FREQUENCY

APART = 0.1
"""The spacing of frequencies in logarithms: the width of a resonance with 5 % of critical damping."""
MOST_SAMPLES = 3000


def scan_resonances(fit: Fit) -> dict[str, list[dict[str, float]]]:
    """Return for each idle law with a resonance the shape that promises most on the beginning of a recording."""
    idle = [key for key in fit.posterior.system.keys if key not in fit.posterior.active]
    keys = [key for key in idle if find_term(fit.posterior, key)[0].states and _list_resonances(fit.posterior, key)]
    if not keys:
        return {}
    first = fit.posterior.observations[0]
    part = replace(fit, posterior=fit.posterior.on((first.part(0, min(first.samples, MOST_SAMPLES)),)))
    shapes = {key: _list_shapes(part.posterior, key) for key in keys}
    promises = list_bare_promises(part, keys, shapes)
    return {p.key: [{name: p.start[name] for name in shapes[p.key][0]}] for p in promises if p.gain > 0.0}


def _list_resonances(posterior: Posterior, key: str) -> list[Slot]:
    """Return the shapes of a law that are frequencies with a scan."""
    return [s for s in sort_slots(posterior, key)[1] if s.param.dimension == FREQUENCY and s.param.prior.scan]


def _list_shapes(posterior: Posterior, key: str) -> list[Mapping[str, float]]:
    """Return each frequency over its range, with the other shapes at their typical values.

    A mode with a third or three times the typical damping keeps most of its gain.
    """
    fine = {s.key for s in _list_resonances(posterior, key)}
    shapes = sort_slots(posterior, key)[1]
    grids = [_make_grid(s, posterior) if s.key in fine else [compute_size(s.param, posterior.scales)] for s in shapes]
    return [dict(zip((s.key for s in shapes), values, strict=True)) for values in itertools.product(*grids)]


def _make_grid(slot: Slot, posterior: Posterior) -> list[float]:
    """Return the frequencies (Hz) that are tried."""
    low, high = compute_range(slot.param, posterior.scales)
    values: list[float] = np.geomspace(low, high, math.ceil(math.log(high / low) / APART) + 1).tolist()
    return values
