"""Fits with a term added or replaced."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array, place_of
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, raise_random_force, restart
from lostmotion.inference.late import refine_change, refine_onset
from lostmotion.inference.natural import compute_size, find_term, is_choice, make_free_parameters
from lostmotion.inference.rounding import find_shortest_wave
from lostmotion.likelihood.posed import LATEST
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import ALWAYS, Slot, onset_key
from lostmotion.quantities import FORCE, TIME

CREEP, FINEST = 0.02, 32
SHARES = (1.0, 0.3, 0.01)
"""Fits begin with these shares of the predicted amplitude."""
MOST_BEGUN, KEPT = 3, 0.5
"""A law that replaces a simpler one is fitted from so many points at most, until it gains this share of its promise."""
SPREAD = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0)
"""Starting values of the shape of a law that replaces a simpler related law, in units of its typical value."""
RAISED = 2.0
"""The increase of the log random force where a fit begins far from its maximum."""


def add_term(posterior: Posterior, key: str, start: Mapping[str, float]) -> Posterior:
    """Return a posterior with one more term, in steps that are fine enough for its sticking."""
    wider = join_term(posterior, key, start)
    return wider.stepped(max(wider.dynamics.nsub, count_steps_for_sticking(wider, wider.space.start)))


def join_term(posterior: Posterior, key: str, start: Mapping[str, float]) -> Posterior:
    """Return a posterior with one more term that begins at `start`, its choices held at the values there."""
    _, slots = find_term(posterior, key)
    choices = {s.key: start[s.key] for s in slots if s.key in start and is_choice(s, start)}
    if onset_key(key) in posterior.system.index:
        choices[onset_key(key)] = start.get(onset_key(key), ALWAYS)
    return posterior.hold_values(choices).extend(make_term_parameters(posterior, key, slots, start), {key})


def make_term_parameters(
    posterior: Posterior, key: str, slots: list[Slot], start: Mapping[str, float]
) -> tuple[FreeParameter, ...]:
    """Return the free parameters of a term of a posterior; the delay of one of several sensors is bounded.

    A wave of a sensor is longer than its rounding.
    """
    frees, (term, _) = make_free_parameters(slots, posterior.scales, start), find_term(posterior, key)
    if any(f.log for f in frees) and (least := find_shortest_wave(posterior, key)) > 0.0:
        low = math.log(least)
        frees = tuple(replace(f, low=max(f.low, low), start=max(f.start, low)) if f.log else f for f in frees)
    if term.acts != "sensor" or len(posterior.observations[0].sensors) == 1:
        return frees
    most = LATEST * posterior.scales.time
    late = {s.key for s in slots if s.param.dimension == TIME}
    return tuple(replace(f, high=min(f.high, most), start=min(f.start, most)) if f.key in late else f for f in frees)


def count_steps_for_sticking(posterior: Posterior, theta: Array, *, creep: float = CREEP) -> int:
    """Return the steps between samples at which a law that jumps at rest hardly creeps during sticking.

    Its creep is at most `force * mobility`, which is limited to the share `creep` of the velocity of the motion.
    """
    system, most, full = posterior.system, 1.0, posterior.recordings[0].full(theta)
    for key in posterior.active:
        term, slots = find_term(posterior, key)
        if "mobility" in term.needs:
            inertia = system.inertia(full, place_of(system.model, term))
            force = sum(abs(full[system.index[s.key]]) for s in slots if s.param.dimension == FORCE)
            width = force * max(t.dt for t in posterior.observations) / inertia
            most = max(most, width / (creep * posterior.scales.velocity))
    return min(math.ceil(most), FINEST)


def fit_term(fit: Fit, key: str, start: Mapping[str, float]) -> Fit:
    """Return the best fit with one more term, started at predicted values or at shares of its amplitudes.

    Without the term the likelihood is that of the given fit; a fit that ends lower has failed.
    """
    _, slots = find_term(fit.posterior, key)
    begun = restart(fit)
    posteriors = [add_term(begun, key, _scale_start(key, start, slots, factor)) for factor in SHARES]
    log_densities = [p.log_density(p.space.clip(p.space.start)) for p in posteriors[:2]]
    order = (*np.argsort(log_densities)[::-1], *range(2, len(SHARES)))
    fits: list[Fit] = []
    for i in order:
        fits.append(maximise(posteriors[i], tolerance=ROUGHLY))
        if fits[-1].status == "converged" and fits[-1].log_likelihood > fit.log_likelihood - 1.0:
            break
    best = max(fits, key=lambda f: f.local.log_posterior)
    return refine_change(refine_onset(best, key), key)


def replace_term(fit: Fit, simpler: str, key: str, start: Mapping[str, float], gain: float) -> Fit:
    """Return the fit with a term in place of a simpler one, started from shared parameters; it promises `gain`."""
    values = fit.values
    _, slots = find_term(fit.posterior, key)
    shared = {s.key: values.get(f"{simpler}.{s.param.name}") for s in slots}
    begin = {**start, **{name: value for name, value in shared.items() if value is not None}}
    posterior = add_term(restart(fit).remove_term(simpler, values), key, begin)
    own = [s for s in slots if shared[s.key] is None]
    begins = np.array(
        [posterior.space.start, *_list_shape_starts(posterior, own), *_list_smaller_starts(posterior, own)]
    )
    begins = posterior.space.clip(
        np.vstack([begins, [raise_random_force(posterior, theta, RAISED) for theta in begins]])
    )
    fits: list[Fit] = []
    for i in np.argsort(-posterior.log_density(begins))[:MOST_BEGUN].tolist():
        fits.append(maximise(posterior, begins[i], tolerance=ROUGHLY))
        if fits[-1].log_likelihood > fit.log_likelihood + max(KEPT * gain, 1.0):
            break
    return max(fits, key=lambda one: one.local.log_posterior)


def _list_shape_starts(posterior: Posterior, slots: Sequence[Slot]) -> Iterator[Array]:
    """Yield the start of a posterior with one of the shapes among `slots` changed over a thousandfold range.

    A shape with a scan is not changed: the scan has covered its range already.
    """
    for slot in slots:
        if (
            slot.param.null is None
            and slot.param.scale == "log"
            and not (slot.param.prior.choices or slot.param.prior.scan)
        ):
            at = posterior.space.keys.index(slot.key)
            for factor in SPREAD:
                theta = posterior.space.start.copy()
                theta[at] = math.log(factor * compute_size(slot.param, posterior.scales))
                yield theta


def _list_smaller_starts(posterior: Posterior, slots: Sequence[Slot]) -> Iterator[Array]:
    """Yield the start of a posterior with smaller amplitudes among `slots`: slopes overestimate some of them."""
    at = [
        posterior.space.keys.index(s.key) for s in slots if s.param.null is not None and s.key in posterior.space.keys
    ]
    for share in SHARES[1:] if at else ():
        theta = posterior.space.start.copy()
        theta[at] *= share
        yield theta


def _scale_start(key: str, start: Mapping[str, float], slots: list[Slot], factor: float) -> dict[str, float]:
    """Return starting values of a term with its amplitudes scaled."""
    shapes = {s.key for s in slots if s.param.null is None} | {onset_key(key)}
    return {name: value if name in shapes else factor * value for name, value in start.items()}
