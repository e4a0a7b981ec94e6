"""What is not missing: the upper bound of each term of the library that the diagnosed model does not have."""

from __future__ import annotations

import math
from collections.abc import Iterable

from lostmotion.contracts import place_of
from lostmotion.diagnosis.search import SearchResult, list_fitted_keys
from lostmotion.evidence.bounds import ALIKE, NONLINEAR, SizeBound, bound_absent
from lostmotion.evidence.hypothesis import WAVE
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.system import key_of
from lostmotion.report.words import angles_in, format_size, sentence, to_words
from lostmotion.results import percent
from lostmotion.results.absent import AbsentTerm, UnlimitedTerm
from lostmotion.results.diagnosis import Mechanism, OpenTerm

Absence = tuple[tuple[AbsentTerm, ...], tuple[UnlimitedTerm, ...]]


def list_absent(d: SearchResult, found: Iterable[Mechanism], rest: Iterable[OpenTerm], angle: str = "rad") -> Absence:
    """Return the bounds of absent terms, the largest share of the drive last, and the terms without a bound.

    Terms that were `found` or remain open (`rest`), terms that no recording can tell from them, and alternatives with a
    probability are left out: they are not absent.
    """
    present = {(one.mechanism, one.at) for one in (*found, *rest)}
    same = {name for key in d.named for name in find_term(d.after.problem, key)[0].equals}
    problem = d.explained.best.frame.problem
    keys = [
        key_of(term)
        for term in problem.system.terms
        if key_of(term) in set(list_fitted_keys(d.before.problem.system))
        and (term.name, term.at) not in present
        and term.name not in same
        and key_of(term) not in d.explained.terms
        and d.explained.inclusion(key_of(term)) <= d.settings.name.worth
    ]
    bounds = bound_absent(d.explained.best, keys)
    with angles_in(angle):
        told = [_make_absent(d, bound) for bound in bounds if not bound.why]
    limited = {(one.mechanism, one.at) for one in told}
    others = {one.key: one for one in bounds if one.why and _get_name(d, one.key) not in limited}
    told.sort(key=lambda one: (one.share_of_drive is None, one.share_of_drive or 0.0))
    return tuple(told), tuple(_make_unlimited(d, one) for one in others.values())


def _get_name(d: SearchResult, key: str) -> tuple[str, str]:
    """Return name and place of a term."""
    term, _ = find_term(d.before.problem, key)
    return term.name, term.at


def _make_absent(d: SearchResult, bound: SizeBound) -> AbsentTerm:
    term, slots = find_term(d.before.problem, bound.key)
    slot = bound.slots[0]
    wave = slot.param.name in WAVE
    words = {s.param.name: s for s in slots if s.key in bound.shape and not s.param.words}
    given = {name: bound.shape[s.key] for name, s in words.items()}
    shown = ", ".join(f"{to_words(name)} {format_size(given[name], s.unit)}" for name, s in words.items())
    alone = sum(s.param.null is not None for s in slots) == len(bound.slots)
    name = "" if alone else f" with {_add_article('amplitude' if wave else to_words(slot.param.name))}"
    share = bound.force if math.isfinite(bound.force) else None
    drive = f" ({percent(share)} of {d.yardstick})" if share is not None else ""
    return AbsentTerm(
        mechanism=term.name,
        at=term.at,
        parameter="amplitude" if wave else slot.param.name,
        upper=bound.upper,
        unit=slot.unit,
        share_of_drive=share,
        given=given,
        says=f"no {to_words(term.name)}{_name_place(d, bound.key)}{name} above"
        f" {format_size(bound.upper, slot.unit)}{drive}" + (f", for {shown}" if shown else ""),
    )


def _add_article(text: str) -> str:
    """Return words with the indefinite article."""
    return f"{'an' if text[0] in 'aeiou' else 'a'} {text}"


def _name_place(d: SearchResult, key: str) -> str:
    """Return the place of a term, where the machine has several of its kind."""
    term, _ = find_term(d.before.problem, key)
    model, first = d.before.problem.system.model, d.shown
    places = {"sensor": len(first.sensors), "drive": len(first.driven or ("",))}
    if places.get(term.acts, len(model.interfaces)) < 2:
        return ""
    return f" at the {place_of(model, term).name if term.acts == 'motion' else term.at}"


def _make_unlimited(d: SearchResult, bound: SizeBound) -> UnlimitedTerm:
    term, _ = find_term(d.before.problem, bound.key)
    why = {
        ALIKE: "what is in the model has the same effect on this recording",
        NONLINEAR: "its effect is not proportional to its size where it is small",
    }.get(bound.why, "it would hardly show in this recording")
    name = f"{to_words(term.name)}{_name_place(d, bound.key)}"
    return UnlimitedTerm(term.name, term.at, f"{sentence(name)} has no bound: {why}.")
