"""Draws of the parameters after a diagnosis, averaged over all explanations.

If two explanations fit equally well, for instance a wrong gain of the drive and a wrong gain of the sensor, each leads
to different parameters of the machine: an interval from one of them alone is too narrow.
"""

from __future__ import annotations

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.outcome import DRAWS, draw_parameters
from lostmotion.diagnosis.stages import SearchResult, list_physical_keys
from lostmotion.evidence.posterior_draws import find_middle
from lostmotion.inference.origin import shift_origin


def draw_mixture(d: SearchResult, rng: np.random.Generator, stretches: Array | None = None) -> Array:
    """Return draws (draws, keys) of the parameters of the model after the diagnosis.

    They are those of the hypotheses, in which the discrepancy is integrated. Where the draws about the fit without a
    discrepancy are wider, as the profile of a parameter may be (`stretches`, as `measure_stretches` returns them),
    they are taken in their place, moved from the maximum of that fit to the one of the best hypothesis.
    """
    after, keys = d.after, list_physical_keys(d.after)
    made = d.explained.draw(keys, DRAWS, rng)
    alone = draw_parameters(after, rng, stretches, find_middle(d.explained.best))
    lost = ~np.isfinite(made)
    made[lost] = alone[lost]
    flat = np.flatnonzero(np.std(alone, axis=0) > np.std(made, axis=0))
    made[:, flat] = alone[:, flat]
    return shift_origin(after, made, keys, rng)
