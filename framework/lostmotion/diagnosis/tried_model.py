"""A model at values that a user tries: how it would predict a recording. Nothing is fitted."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.compare import SEGMENT, count_transient
from lostmotion.errors import CaseError, ContractError, nearest
from lostmotion.inference.setup import choose_steps, make_posterior
from lostmotion.likelihood.noise_levels import LEVELS_TRIED, compute_random_level
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import choose_horizon, forecast_pieces
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.stepped import make_system
from lostmotion.preparation.prepare import Prepared
from lostmotion.settings import DEFAULT, Settings

MOST = 50_000
"""The greatest number of samples that are predicted: a user waits for them."""


@dataclass(frozen=True, eq=False)
class TriedPrediction:
    """Free-running predictions of a recording in SI units, each from a filtered state at a restart.

    `time` (n,) is in s, `readings` and `predicted` are (n, sensors), and `predicted` is NaN before the first of the
    `restarts` (k,), in s. `errors` (sensors,) are rms errors over the standard deviation of the readings.
    """

    time: Array
    readings: Array
    predicted: Array
    restarts: Array
    errors: Array
    sensors: tuple[Sensor, ...]


@dataclass(frozen=True, eq=False)
class TriedModel:
    """The model of a case with all terms that can act in it, on one of its recordings."""

    posterior: Posterior

    @classmethod
    def of(cls, prepared: Prepared, *, number: int = 0, end: bool = False, settings: Settings = DEFAULT) -> TriedModel:
        """Return the model of a prepared case on a recording, the first one unless its `number` is given.

        Of a long recording it has `MOST` samples: the first ones, or the last ones with `end`.
        """
        observation = prepared.observations[number]
        first = max(observation.samples - MOST, 0) if end else 0
        part = observation.part(first, min(first + MOST, observation.samples))
        system = make_system(prepared.model, prepared.terms)
        posterior = make_posterior(system, prepared.case, (part,), jobs=1, settings=settings)
        levels = tuple(free for free in posterior.space.free if not free.physical)
        return cls(posterior.over(levels))

    @property
    def values(self) -> dict[str, float]:
        """The values (SI) of the parameters of the model, those to be estimated at the middle of their priors."""
        system, known = self.posterior.system, self.posterior.known
        return {slot.key: float(known[system.index[slot.key]]) for slot in system.slots if slot.term is None}

    def predict(
        self,
        values: Mapping[str, float],
        terms: Collection[str] = (),
        *,
        begin: float | None = None,
        every: float | None = None,
    ) -> TriedPrediction:
        """Return the prediction with some `values` (SI) by parameter, and with `terms` by key.

        It begins `begin` s after the first sample: by default after a short transient, or at once if nothing drives
        the machine. It restarts after `every` s, or by default after some cycles of the motion. Raises `CaseError` for
        a name that the model does not have.
        """
        posterior = self._set_values(values, terms)
        observation = posterior.observations[0]
        transient = 0 if observation.free else count_transient(observation)
        first = transient if begin is None else min(max(round(begin / observation.dt), 0), observation.samples - 2)
        cycle = choose_horizon(observation, float("nan"), posterior.scales.time).unit_time
        length = max(round((SEGMENT * cycle if every is None else every) / observation.dt), 2)
        theta = self._choose_level(posterior)
        states = posterior.filters[0].smooth(theta).filtered[:, : posterior.dynamics.states]
        predicted, restarts = forecast_pieces(posterior, theta, states, first, length)
        off = predicted - observation.readings
        scale = np.nanstd(observation.readings[first:], axis=0)
        with np.errstate(over="ignore"):  # a free run may diverge: its error is infinite then
            errors = np.sqrt(np.nanmean(off[first:] ** 2, axis=0)) / np.where(scale > 0.0, scale, 1.0)
        at = observation.time[restarts > 0.0]
        return TriedPrediction(observation.time, observation.readings, predicted, at, errors, observation.sensors)

    def _set_values(self, values: Mapping[str, float], terms: Collection[str]) -> Posterior:
        system = self.posterior.system
        for key in terms:
            if key not in system.keys:
                raise CaseError(f"no term {key!r} can act in this case{nearest(key, system.keys)}")
        try:
            held = {system.slot(name).key: value for name, value in values.items()}
        except ContractError as err:
            raise CaseError(str(err)) from err
        posterior = self.posterior.hold_values(held).acting(terms)
        return choose_steps(posterior, posterior.space.start)

    def _choose_level(self, posterior: Posterior) -> Array:
        """Return the coordinates with the most likely of some levels of the random force: the filter follows then."""
        tried = np.repeat(posterior.space.start[None], len(LEVELS_TRIED), axis=0)
        random = [free.parameter == RANDOM for free in posterior.space.free]
        for row, share in zip(tried, LEVELS_TRIED, strict=True):
            row[random] = compute_random_level(posterior.observations, posterior.scales, share)
        tried = posterior.space.clip(tried)
        chosen: Array = tried[int(np.argmax(posterior.log_likelihood(tried)))]
        return chosen
