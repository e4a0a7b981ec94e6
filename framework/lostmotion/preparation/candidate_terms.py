"""The candidate terms of a machine with their places, given the recordings."""

from __future__ import annotations

from collections.abc import Sequence

from lostmotion.contracts import DriveTerm, Machine, SensorTerm, Term
from lostmotion.defaults import AT_GROUND
from lostmotion.likelihood.observation import Observation

BESIDE = (DriveTerm, SensorTerm)
"""Terms that act on a channel, beside the motion."""


def candidates_of(
    model: Machine, terms: Sequence[type[Term]], observations: Sequence[Observation] = ()
) -> tuple[Term, ...]:
    """Return each term at each place of the model where it can act, given the drives of the recordings.

    Of terms that are equal to each other only the first is returned.
    """
    tried = [
        term(at=place.name)  # type: ignore[call-arg]
        for place in model.places
        for term in terms
        if not issubclass(term, BESIDE)
        and (term.name not in AT_GROUND or place.name == "ground" or len(model.places) == 1)
    ]
    tried += [
        term(at=at, **_channel_of(term, at, observations))  # type: ignore[call-arg]
        for term in terms
        if issubclass(term, BESIDE)
        for at in _places_beside(term, observations)
    ]
    driven = all(observation.harmonic.omega > 0.0 for observation in observations)
    tried = [term for term in tried if term.fits(model) and (driven or "omega" not in term.needs)]
    names = [term.name for term in tried]
    several = any(len(observation.sensors) > 1 for observation in observations)
    return tuple(t for i, t in enumerate(tried) if several or not set(t.equals) & set(names[:i]))


def _channel_of(term: type[Term], at: str, observations: Sequence[Observation]) -> dict[str, str]:
    """Return the field `channel` for a sensor term with states, else no field."""
    if not term.states or not issubclass(term, SensorTerm) or not observations:
        return {}
    return {"channel": next(sensor.channel for sensor in observations[0].sensors if sensor.place == at)}


def _places_beside(term: type[Term], observations: Sequence[Observation]) -> tuple[str, ...]:
    """Return the places of a drive term or a sensor term: each recorded input, or each sensor."""
    if not observations:
        return ("drive" if issubclass(term, DriveTerm) else "sensor",)
    first = observations[0]
    if issubclass(term, DriveTerm):
        return ("drive",) if first.driven is None or len(first.driven) == 1 else first.driven
    alone = len(first.sensors) == 1
    return () if alone and getattr(term, "relative", False) else tuple(sensor.place for sensor in first.sensors)
