"""The zero of the position where nothing shows it: the phase of a wave over the travel is then unknown."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array, Term
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.initial import shows_place
from lostmotion.quantities import quantity_of

STATES, SAME = 32, 1e-9
"""The number of states at which a force is compared after a shift, and the relative difference by rounding."""
FAR = 1e3
"""Shifts are drawn from zero to this number of amplitudes: many waves, however long one is."""


def list_unlocated(fit: Fit) -> list[str]:
    """Return the keys of active terms whose parameters depend on a zero of the position that nothing shows.

    No sensor shows the position, and the motion is the same if the machine is moved and these terms with it: nothing
    else pulls it towards a place.
    """
    posterior = fit.posterior
    waves = [key for key in sorted(posterior.active) if type(find_term(posterior, key)[0]).shifted is not Term.shifted]
    located = any(shows_place(observation) for observation in posterior.observations)
    return waves if waves and not located and _is_free(fit, waves) else []


def list_shifted(term: Term, values: Mapping[str, float], by: float) -> list[str]:
    """Return the names of the parameters that depend on the zero of the position; `values` maps those of the term."""
    p = tuple(values[q.name] for q in term.params)
    return [q.name for q, old, new in zip(term.params, p, term.shifted(p, by), strict=True) if old != new]


def _is_free(fit: Fit, waves: list[str]) -> bool:
    """Return whether the derivatives are the same after a shift of all bodies and of the waves."""
    posterior, rng = fit.posterior, np.random.default_rng(0)
    system, scales = posterior.system, posterior.scales
    places = [quantity_of(name) == "position" for name in system.model.states]
    full = posterior.recordings[0].full(fit.theta[None])[0]
    states = scales.length * rng.standard_normal((STATES, system.states(posterior.active)))
    inputs = posterior.observations[0].inputs[rng.integers(0, posterior.observations[0].samples, STATES)]
    by = scales.length * float(rng.uniform(0.5, 1.5))
    moved, there = states.copy(), full.copy()
    moved[:, np.flatnonzero(places)] -= by
    for key in waves:
        at = [system.index[slot.key] for slot in find_term(posterior, key)[1]]
        there[at] = find_term(posterior, key)[0].shifted(tuple(full[at]), by)
    here, then = (
        system.compute_derivatives(posterior.active, system.pack(p[None], posterior.observations[0].dt), y, inputs)[0]
        for p, y in ((full, states), (there, moved))
    )
    return bool(np.allclose(here, then, rtol=SAME, atol=SAME * float(np.max(np.abs(here)))))


def shift_origin(fit: Fit, draws: Array, keys: list[str], rng: np.random.Generator) -> Array:
    """Return draws (draws, keys) of the posterior in which the zero of the position is anywhere, if nothing shows it.

    Otherwise the draws are returned unchanged. A fit begins at one position, and its phase of a wave belongs to that.
    """
    made, posterior = draws.copy(), fit.posterior
    unlocated = list_unlocated(fit)
    shifts = rng.uniform(0.0, FAR * posterior.scales.length, len(draws)) if unlocated else draws[:, 0]
    for key in unlocated:
        term, slots = find_term(posterior, key)
        held = [float(posterior.known[posterior.system.index[slot.key]]) for slot in slots]
        columns = [keys.index(slot.key) if slot.key in keys else -1 for slot in slots]
        for row, by in zip(made, shifts, strict=True):
            own = tuple(row[c] if c >= 0 else value for c, value in zip(columns, held, strict=True))
            for c, value in zip(columns, term.shifted(own, by), strict=True):
                if c >= 0:
                    row[c] = value
    return made
