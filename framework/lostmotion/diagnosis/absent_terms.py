"""What is not missing: the upper bound of each term of the library that the diagnosed model does not have."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from dataclasses import replace

from lostmotion.diagnosis.expected_findings import (
    describe_place,
    describe_shape,
    describe_share,
    describe_size,
    describe_term,
    list_shape,
    name_amplitude,
    name_term,
)
from lostmotion.diagnosis.stages import SearchResult, list_fitted_keys
from lostmotion.evidence.bounds import ALIKE, NONLINEAR, SizeBound, bound_absent
from lostmotion.inference.learned import LearnedTerm
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import key_of
from lostmotion.report.words import angles_in, sentence
from lostmotion.results.absent import AbsentTerm, UnlimitedTerm
from lostmotion.results.diagnosis import Mechanism, OpenTerm

LEARNED = "learned"
"""Why a law has no bound: a curve was learned at its place."""
Absence = tuple[tuple[AbsentTerm, ...], tuple[UnlimitedTerm, ...]]


def list_absent(d: SearchResult, found: Iterable[Mechanism], rest: Iterable[OpenTerm], angle: str = "rad") -> Absence:
    """Return the bounds of absent terms, the largest share of the drive last, and the terms without a bound.

    Terms that were `found` or remain open (`rest`), terms that no recording can tell from them, and alternatives with a
    probability are left out: they are not absent. A law that acts where a curve was learned has no bound.
    """
    present = {(one.mechanism, one.at) for one in found} | {(one.mechanism, one.at) for one in rest}
    same = {name for key in d.named for name in find_term(d.after.posterior, key)[0].equals}
    posterior = d.explained.best.frame.posterior
    keys = [
        key_of(term)
        for term in posterior.system.terms
        if key_of(term) in set(list_fitted_keys(d.before.posterior.system))
        and (term.name, term.at) not in present
        and term.name not in same
        and key_of(term) not in d.explained.terms
        and d.explained.inclusion(key_of(term)) <= d.settings.name.worth
    ]
    after = d.after.posterior
    curved = {one.at for one in after.system.terms if isinstance(one, LearnedTerm) and key_of(one) in after.active}
    bounds = [
        replace(bound, why=LEARNED) if _is_within(d.before.posterior, bound.key, curved) else bound
        for bound in bound_absent(d.explained.best, keys)
    ]
    with angles_in(angle):
        told = [_make_absent(d, bound) for bound in bounds if not bound.why]
    limited = {(one.mechanism, one.at) for one in told}
    others = {one.key: one for one in bounds if one.why and name_term(d.before.posterior, one.key) not in limited}
    told.sort(key=lambda one: (one.share_of_drive is None, one.share_of_drive or 0.0))
    return tuple(told), tuple(_make_unlimited(d, one) for one in others.values())


def _is_within(posterior: Posterior, key: str, curved: Collection[str]) -> bool:
    """Return whether a term is a law of the motion at a place where a curve was learned, which may contain it."""
    term, _ = find_term(posterior, key)
    return term.acts == "motion" and term.at in curved


def _make_absent(d: SearchResult, bound: SizeBound) -> AbsentTerm:
    posterior = d.before.posterior
    term, slots = find_term(posterior, bound.key)
    shape, unit = list_shape(slots, bound.shape), bound.slots[0].unit
    share = bound.force if math.isfinite(bound.force) else None
    return AbsentTerm(
        mechanism=term.name,
        at=term.at,
        parameter=name_amplitude(bound.slots),
        upper=bound.upper,
        unit=unit,
        share_of_drive=share,
        given={slot.param.name: bound.shape[slot.key] for slot in shape},
        says=f"no {describe_term(posterior, bound.key, bound.slots)}"
        f" above {describe_size(posterior, bound.key, bound.slots, bound.upper)}"
        f"{describe_share(share, d.yardstick)}{describe_shape(shape, bound.shape)}",
    )


def _make_unlimited(d: SearchResult, bound: SizeBound) -> UnlimitedTerm:
    posterior = d.before.posterior
    term, _ = find_term(posterior, bound.key)
    why = {
        ALIKE: "what is in the model has the same effect on this recording",
        LEARNED: "the learned force may contain it",
        NONLINEAR: "its effect is not proportional to its size where it is small",
    }.get(bound.why, "it would hardly show in this recording")
    return UnlimitedTerm(term.name, term.at, f"{sentence(describe_place(posterior, bound.key))} has no bound: {why}.")
