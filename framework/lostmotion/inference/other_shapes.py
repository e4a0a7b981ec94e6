"""Several maxima of one posterior: a wave over position, a stop or a resonance often fits at several shapes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import HOPELESS, ROUGHLY, Fit, hold_free, maximise, raise_random_force, use_one_core
from lostmotion.inference.natural import collect_shapes, sort_slots
from lostmotion.kernels.threads import each
from lostmotion.likelihood.posterior import Posterior

Late = Callable[[], bool]
"""Whether the time for this work is used up."""
FACTORS = (0.7, 0.85, 0.93, 1.08, 1.2, 1.4)
"""Shapes that are tried, over the fitted one: a wave that has one period more or less within the travel fits next."""
RAISES = (0.0, 3.0)
"""Each shape is tried with the random force of the fit, and with a larger one, which makes maxima wider."""
AGAIN = 3
"""The search from other shapes is repeated at most so often, each time from the best maximum."""
BETTER = 2.0
"""It goes on only from a maximum whose log evidence is higher by more than this."""
VARIED = 8.0
"""The widths of two maxima make their log evidences differ from their log posteriors by up to this."""
NEAR = 0.03
"""Maxima with shapes that differ by less, as a logarithm, are the same one."""


def has_other_shapes(posterior: Posterior) -> bool:
    """Return whether an active term has a shape with a range to be scanned, or with choices."""
    return any(s.param.prior.choices or s.param.prior.scan for s in collect_shapes(posterior, posterior.active))


def list_scanned_shapes(posterior: Posterior) -> list[int]:
    """Return the indices among the free parameters of the shapes of active terms that have a range to be scanned."""
    slots = collect_shapes(posterior, posterior.active)
    keys = {s.key for s in slots if s.param.prior.scan and s.param.scale == "log" and not s.param.prior.choices}
    return [i for i, key in enumerate(posterior.space.keys) if key in keys]


def find_modes(fit: Fit, *, reach: float = math.inf, is_late: Late = lambda: False) -> list[Fit]:
    """Return the maxima that are found from other shapes, best first, including the fit itself.

    Those whose log evidence is below the best by more than `reach` are left out. A fit without a scanned shape is
    returned alone. No further shape is changed once `is_late`.
    """
    at = list_scanned_shapes(fit.posterior)
    if not at or fit.status == "diverged":
        return [fit]
    single = use_one_core(fit)
    kept, found = [fit], list[Fit]()
    hopeless = fit.local.log_posterior - min(HOPELESS, reach + VARIED)
    for i in at:
        starts = [_scale_shape(single, i, factor, up) for factor in FACTORS for up in RAISES]
        found += [] if is_late() else _maximise_each([single.posterior] * len(starts), starts, fit, hopeless)
    for other in sorted(found, key=lambda one: -one.local.log_posterior):
        if all(_are_apart(other, one, at) for one in kept):
            kept.append(other)
    best = max(one.log_evidence for one in kept)
    return sorted((one for one in kept if one.log_evidence > best - reach), key=lambda one: -one.log_evidence)


def refit_shapes(fit: Fit, is_late: Late = lambda: False) -> Fit:
    """Return the best fit of a set of terms from other shapes, and with other choices of them; not all if `is_late`."""
    for _ in range(AGAIN):
        before, fit = fit, find_modes(fit, reach=BETTER, is_late=is_late)[0]
        if not fit.log_evidence > before.log_evidence + BETTER:
            break
    return refit_choices(fit, fit.posterior.active)


def refit_choices(fit: Fit, keys: Iterable[str]) -> Fit:
    """Return the best fit of a set of terms with each choice of the shapes of some of them.

    The score test at the nominal model may choose the wrong side of a stop, or the wrong harmonic.
    """
    single, posterior = use_one_core(fit), fit.posterior
    posteriors = []
    for s in collect_shapes(posterior, keys):
        if s.key in posterior.space.keys:
            continue
        now = float(posterior.recordings[0].full(fit.theta)[posterior.system.index[s.key]])
        posteriors += [single.posterior.hold_values({s.key: v}) for v in s.param.prior.choices or () if v != now]
    starts = [raise_random_force(one, fit.theta, max(RAISES)) for one in posteriors]
    hopeless = fit.local.log_posterior - HOPELESS
    return max([fit, *_maximise_each(posteriors, starts, fit, hopeless)], key=lambda found: found.log_evidence)


def refit_complete(fit: Fit) -> list[Fit]:
    """Return the fit of each law that is complete: an amplitude of an active term is held at its greatest value."""
    posterior, found = fit.posterior, list[Fit]()
    for slot in (s for key in sorted(posterior.active) for s in sort_slots(posterior, key)[0]):
        if math.isfinite(slot.param.high) and slot.key in posterior.space.keys:
            at = posterior.space.keys.index(slot.key)
            held = hold_free(posterior, at, slot.param.high)
            found.append(maximise(held, held.space.clip(np.delete(fit.theta, at))))
    return [one for one in found if one.status == "converged"]


def _maximise_each(posteriors: Sequence[Posterior], starts: Sequence[Array], fit: Fit, hopeless: float) -> list[Fit]:
    """Return the converged fits, in order; those that would stay below a log posterior are abandoned."""
    climb = partial(maximise, hopeless=hopeless, tolerance=ROUGHLY, patience=1)
    found = each(lambda pair: climb(*pair), list(zip(posteriors, starts, strict=True)), fit.posterior.jobs)
    return [f for f in found if f.status == "converged"]


def _scale_shape(fit: Fit, at: int, factor: float, more: float) -> Array:
    """Return the coordinates of a fit with one shape multiplied by a factor, and with a larger random force."""
    theta = raise_random_force(fit.posterior, fit.theta, more)
    theta[at] += math.log(factor)
    return fit.posterior.space.clip(theta)


def _are_apart(one: Fit, other: Fit, at: list[int]) -> bool:
    """Return whether two fits are different maxima, by their shapes."""
    return any(abs(one.theta[i] - other.theta[i]) > NEAR for i in at)
