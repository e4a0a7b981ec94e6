"""The posterior density that every fit and every sampler uses: free parameters, recordings, and a running system."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.likelihood.drive import pad_inputs
from lostmotion.likelihood.innovations import Innovations, join_recordings
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posed import PosedRecording
from lostmotion.likelihood.recording_filter import RecordingFilter, filter_recordings
from lostmotion.likelihood.running import Random, RunningSystem
from lostmotion.likelihood.space import PACE, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion.settings import DEFAULT, Settings


@dataclass(frozen=True)
class Posterior:
    """What is free (`space`), what was recorded, and the system that runs; `known` is the full vector of the others.

    A key such as `c[run 1]` is the parameter `c` of the recording "run 1" alone; without brackets all share it.

    The random force (process noise) is white, or, when `PACE` is among the free parameters, an Ornstein-Uhlenbeck force
    of the same intensity at low frequency. It represents what no term explains; with a memory it also absorbs slow
    residuals, which would otherwise count as evidence. Where a sensor shows forces, it is held over each sample.
    """

    space: ParameterSpace
    observations: tuple[Observation, ...]
    dynamics: RunningSystem
    scales: Scales
    known: Array
    jobs: int = 2
    settings: Settings = DEFAULT

    def __post_init__(self) -> None:
        """Pad the inputs that a recording lacks with zeros, and choose how the random force acts."""
        count, given = len(self.system.model.inputs), self.observations
        whole = (o if o.inputs.shape[1] >= count else replace(o, inputs=pad_inputs(o.inputs, count)) for o in given)
        object.__setattr__(self, "observations", tuple(whole))
        random: Random = "white"
        if any(f.parameter == PACE for f in self.space.free):
            random = "latent"
        elif self.system.holds_forces(s.channel for o in self.observations for s in o.sensors):
            random = "held"
        if random != self.dynamics.random:
            object.__setattr__(self, "dynamics", replace(self.dynamics, random=random))

    @property
    def system(self) -> System:
        """The model with all terms that may act."""
        return self.dynamics.system

    @property
    def active(self) -> frozenset[str]:
        """The keys of the terms that act."""
        return self.dynamics.active

    @property
    def samples(self) -> int:
        """The number of samples of all recordings."""
        return sum(observation.samples for observation in self.observations)

    @cached_property
    def recordings(self) -> tuple[PosedRecording, ...]:
        """What coordinates mean in each recording."""
        return tuple(PosedRecording(o, self.space, self.dynamics, self.scales, self.known) for o in self.observations)

    @cached_property
    def filters(self) -> tuple[RecordingFilter, ...]:
        """The filter over each recording."""
        return tuple(RecordingFilter(recording) for recording in self.recordings)

    def log_density(self, theta: Array) -> Any:
        """Return log-likelihood plus log prior at one point (n,), or at many (points, n); -inf outside of the prior."""
        thetas = np.atleast_2d(theta)
        found = np.array(self.space.log_prior(thetas))
        inside = np.isfinite(found)
        if inside.any():
            found[inside] += self.log_likelihood(thetas[inside])
        return found if np.ndim(theta) > 1 else float(found[0])

    def log_likelihood(self, theta: Array) -> Any:
        """Return the log-likelihood at one point (n,), or at many (points, n); minus infinity where it diverges."""
        parts = filter_recordings(self.filters, np.atleast_2d(theta), self.jobs)
        found = np.asarray(sum(part.log_likelihood for part in parts))
        return found if np.ndim(theta) > 1 else float(found[0])

    def innovations(self, theta: Array) -> Innovations:
        """Return the one-step errors at one point (n,), (readings,), or at many, (points, readings).

        The readings of all recordings are in a row.
        """
        found = join_recordings(filter_recordings(self.filters, np.atleast_2d(theta), self.jobs))
        return found if np.ndim(theta) > 1 else found[0]

    def on(self, observations: tuple[Observation, ...]) -> Posterior:
        """Return the same posterior on other recordings, or on parts of them."""
        return replace(self, observations=observations)

    def over(self, free: Iterable[FreeParameter]) -> Posterior:
        """Return the posterior over other free parameters."""
        return replace(self, space=ParameterSpace(tuple(free)))

    def acting(self, active: Iterable[str]) -> Posterior:
        """Return the posterior with these terms acting."""
        return replace(self, dynamics=replace(self.dynamics, active=frozenset(active)))

    def stepped(self, nsub: int) -> Posterior:
        """Return the posterior with at most this many steps to a sample."""
        return replace(self, dynamics=replace(self.dynamics, nsub=nsub))

    def extend(self, more: Iterable[FreeParameter], active: Iterable[str]) -> Posterior:
        """Return the posterior with further free parameters and terms."""
        return self.over((*self.space.free, *more)).acting(self.active | frozenset(active))

    def hold_values(self, values: Mapping[str, float]) -> Posterior:
        """Return the posterior with further parameters held at `values`."""
        known = self.known.copy()
        known[[self.system.index[key] for key in values]] = list(values.values())
        return replace(self, known=known)

    def remove_term(self, key: str, values: Mapping[str, float]) -> Posterior:
        """Return the posterior without the term `key`; `values` become the new starting points."""
        kept = (f for f in self.space.free if not f.key.startswith(key + "."))
        begun = (replace(f, start=f.coordinate(values.get(f.key, f.value(f.start)))) for f in kept)
        return self.over(begun).acting(self.active - {key})
