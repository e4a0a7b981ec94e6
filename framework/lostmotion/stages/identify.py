"""Identify: the joint posterior of a fit's parameters, drawn by an ensemble of walkers."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, DataError
from lostmotion.inference.fit import Fit
from lostmotion.inference.problem import NOISE, PACE, RANDOM, Free
from lostmotion.results import Interval
from lostmotion.stages._chains import Quality, autocorrelation, inference_data, quality_of
from lostmotion.stages._sampling import Cloud, Density, sampler_of, state_of

WALKERS = 16
PILOT = 32
PILOTS = 4
ACCEPTED = 0.3
"""Pilot runs end when this share of the proposals is accepted."""
BLOCK = 10
BURN = 3.0
"""The burn-in in autocorrelation times; the pilot runs before it are thrown away altogether."""
NOISES = {RANDOM: "random_force", PACE: "random_pace", NOISE: "measurement_noise"}
"""What the noise levels are called once they are numbers and no longer logarithms."""

Watch = Callable[[int, str], None]
"""Is told how many steps were taken since the last time, and how the chain stands."""


@dataclass(frozen=True)
class Plan:
    """How long to sample: until the effective sample size `ess` is reached, at most `max_steps` of each walker.

    With `walkers` None there are 16, or twice as many as parameters and two.
    """

    ess: float = 1000.0
    max_steps: int = 2000
    walkers: int | None = None


@dataclass(frozen=True)
class Identification:
    """The posterior of the parameters `keys`, in SI `units`: draws, intervals, and whether they may be believed.

    `chain` is (walkers, steps, parameters) without the burn-in, `log_density` (walkers, steps); `maximum` holds the
    parameters at the maximum from which the walkers started. `lacks` says what keeps the chain from being believed.
    """

    keys: tuple[str, ...]
    units: tuple[str, ...]
    chain: Array
    log_density: Array
    maximum: Mapping[str, float]
    quality: Quality
    lacks: tuple[str, ...]
    burn_in: int
    acceptance: float
    evaluations: int

    @property
    def converged(self) -> bool:
        """Whether the chain may be believed."""
        return not self.lacks

    @property
    def draws(self) -> Array:
        """The draws of all walkers together, (draws, parameters)."""
        return self.chain.reshape(-1, len(self.keys))

    @property
    def intervals(self) -> dict[str, Interval]:
        """Median and central 95 % interval of each parameter; empty when the chain has not converged."""
        if not self.converged:
            return {}
        low, median, high = np.quantile(self.draws, [0.025, 0.5, 0.975], axis=0).tolist()
        return {k: Interval(median[i], low[i], high[i], self.units[i]) for i, k in enumerate(self.keys)}

    @property
    def sd(self) -> dict[str, float]:
        """The standard deviation of each parameter; empty when the chain has not converged."""
        return dict(zip(self.keys, self.draws.std(axis=0).tolist(), strict=True)) if self.converged else {}

    def inference_data(self, attrs: Mapping[str, Any]) -> Any:
        """Return the draws as ArviZ's `InferenceData`, groups posterior and sample_stats, with `attrs` on both."""
        columns = {k: np.ascontiguousarray(self.chain[:, :, i]) for i, k in enumerate(self.keys)}
        return inference_data(columns, self.log_density, dict(zip(self.keys, self.units, strict=True)), attrs)


def identify(
    fit: Fit, *, rng: np.random.Generator, plan: Plan | None = None, watch: Watch = lambda _steps, _says: None
) -> Identification:
    """Return the posterior around the maximum `fit`, sampled with emcee as `plan` says.

    The walkers start from the normal approximation. Pilot runs fit the density from which most proposals are drawn;
    it stays as it is while the draws that count are made. Nothing depends on the number of cores.
    """
    if not math.isfinite(fit.local.log_posterior):
        raise DataError("the model cannot follow this recording from any start: check units, known values and priors")
    return _Course(fit, plan or Plan(), rng, watch).run()


class _Course:
    """One sampling from its pilot runs to its end."""

    def __init__(self, fit: Fit, plan: Plan, rng: np.random.Generator, watch: Watch) -> None:
        self.fit, self.plan, self.rng, self.watch = fit, plan, rng, watch
        self.free = fit.problem.free
        self.walkers = _walkers(plan, len(self.free))
        self.density = Density(fit.problem)

    def run(self) -> Identification:
        """Return the posterior, converged or not."""
        cloud, points = self._pilots()
        sampler, state = sampler_of(cloud, self.density, self.walkers), state_of(points, self.rng)
        lacks: tuple[str, ...] = ("no step was taken",)
        before = math.inf
        while lacks and sampler.iteration < self.plan.max_steps:
            size = min(BLOCK, self.plan.max_steps - sampler.iteration)
            state = sampler.run_mcmc(state, size)
            quality = quality_of(_kept(sampler)[0])
            lacks, before = quality.lacks(self.plan.ess, before), quality.slowest
            self.watch(size, f"tau {quality.slowest:.1f} · ESS {quality.ess.min():.0f} of {self.plan.ess:g}")
        return self._result(sampler, lacks)

    def _pilots(self) -> tuple[Cloud, Array]:
        """Return a density to propose from and where the walkers stand after the pilot runs."""
        cloud = Cloud.about(self.fit.theta, self.fit.local.covariance, self.free)
        points = cloud.draw(self.walkers, np.random.RandomState(int(self.rng.integers(2**32))))
        for _ in range(PILOTS):
            sampler = sampler_of(cloud, self.density, self.walkers)
            points = sampler.run_mcmc(state_of(points, self.rng), PILOT).coords
            late = sampler.get_chain(flat=True, discard=PILOT // 3)
            accepted = float(np.mean(sampler.acceptance_fraction))
            cloud = Cloud.around(late, self.free)
            self.watch(0, f"pilot run, {accepted:.0%} accepted")
            if accepted > ACCEPTED:
                break
        return cloud, points

    def _result(self, sampler: Any, lacks: tuple[str, ...]) -> Identification:
        coordinates, burn = _kept(sampler)
        shown = [_shown(f, self.fit) for f in self.free]
        return Identification(
            keys=tuple(one.name for one in shown),
            units=tuple(one.unit for one in shown),
            chain=_values(shown, coordinates),
            log_density=np.ascontiguousarray(sampler.get_log_prob(discard=burn).T),
            maximum={one.name: float(v) for one, v in zip(shown, _values(shown, self.fit.theta), strict=True)},
            quality=quality_of(coordinates),
            lacks=lacks,
            burn_in=burn,
            acceptance=float(np.mean(sampler.acceptance_fraction)),
            evaluations=self.density.evaluations,
        )


def _walkers(plan: Plan, parameters: int) -> int:
    least = max(8, 2 * parameters)
    if plan.walkers is not None and plan.walkers < least:
        raise CaseError(f"{plan.walkers} walkers are too few for {parameters} parameters: give {least} or more")
    return plan.walkers or max(WALKERS, least + 2)


def _kept(sampler: Any) -> tuple[Array, int]:
    """Return the chain (walkers, steps, parameters) after the burn-in, and the length of that in steps."""
    chain = np.swapaxes(sampler.get_chain(), 0, 1)
    slowest = float(np.max(autocorrelation(chain)))
    burn = int(min(math.ceil(BURN * slowest), chain.shape[1] // 2)) if math.isfinite(slowest) else chain.shape[1] // 2
    return np.ascontiguousarray(chain[:, burn:]), burn


@dataclass(frozen=True)
class _Shown:
    """How a coordinate is told: `exp(power * coordinate) * factor` in `unit`, or as it is where `power` is 0."""

    name: str
    unit: str
    power: float
    factor: float = 1.0

    def value(self, coordinate: Array) -> Array:
        """Return numbers in SI units of coordinates of any shape."""
        return np.asarray(self.factor * np.exp(self.power * coordinate) if self.power else coordinate)


def _values(shown: list[_Shown], coordinates: Array) -> Array:
    """Return coordinates (..., parameters) as numbers in SI units."""
    return np.stack([one.value(coordinates[..., i]) for i, one in enumerate(shown)], axis=-1)


def _shown(free: Free, fit: Fit) -> _Shown:
    """Return how a parameter is told; a random force as the rms (N, N m) of one that is held from sample to sample."""
    if free.key not in NOISES:
        return _Shown(free.key, free.unit, 1.0 if free.log else 0.0)
    name, track = NOISES[free.key], fit.problem.tracks[0]
    rotation = fit.problem.system.model.motion == "rotation"
    if free.key == RANDOM:
        return _Shown(name, "N m" if rotation else "N", 0.5, track.dt**-0.5)
    per = {"position": "", "velocity": "/s", "acceleration": "/s^2"}[track.channel]
    return _Shown(name, "1/s" if free.key == PACE else ("rad" if rotation else "m") + per, 1.0)
