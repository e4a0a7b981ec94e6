"""Proposals for a load cell: a force of the library that is the main part of the readings.

Without it, the nominal model explains such readings with values far from its prior, and its random force follows the
recording sample by sample. Slopes at this fit are nearly blind, and a fit that starts there stops at a local
maximum. So the fit starts at the centre of the prior of the model.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from lostmotion.contracts import Array
from lostmotion.inference.candidates import add_term
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, restart
from lostmotion.inference.natural import compute_size, sort_slots
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM
from lostmotion.quantities import FORCE

SHARE = 0.7
"""The first size of the force, in amplitudes of the measured one."""
LEVELS = (2.0, 6.0, 9.0)
"""The first random forces, in log intensity above the usual."""


def fit_loads(bare: Fit, keys: Sequence[str], say: Callable[[str], None]) -> Iterator[Fit]:
    """Yield the best fit of each force with one amplitude, where all sensors are load cells."""
    if any(sensor.channel != "force" for o in bare.posterior.observations for sensor in o.sensors):
        return
    for key in keys:
        if (load := _guess_load(bare.posterior, key)) is not None:
            say(f"fit with a large {key}")
            posterior = add_term(restart(bare), key, load)
            starts = [posterior.space.start, *(_begin_at_prior(posterior, level) for level in LEVELS)]
            found = [
                fit for start in starts if (fit := maximise(posterior, start, tolerance=ROUGHLY)).status != "diverged"
            ]
            yield from sorted(found, key=lambda fit: fit.local.log_posterior)[-1:]


def _guess_load(posterior: Posterior, key: str) -> dict[str, float] | None:
    """Return a start at which a term is most of the measured force; None for one that is no force of one amplitude."""
    amplitudes, shapes = sort_slots(posterior, key)
    if len(amplitudes) != 1 or amplitudes[0].param.dimension != FORCE or amplitudes[0].param.low < 0.0:
        return None
    usual = {s.key: compute_size(s.param, posterior.scales) for s in shapes}
    return {amplitudes[0].key: SHARE * posterior.scales.force, **usual}


def _begin_at_prior(posterior: Posterior, level: float) -> Array:
    """Return the start of a posterior with each parameter of the model at the centre of its prior."""
    theta, model = posterior.space.start.copy(), {param.name for param in posterior.system.model.params}
    for i, free in enumerate(posterior.space.free):
        if free.parameter == RANDOM:
            theta[i] = posterior.scales.usual + level
        elif free.parameter in model:
            theta[i] = free.mean if math.isfinite(free.sd) else 0.5 * (free.low + free.high)
    return posterior.space.clip(theta)
