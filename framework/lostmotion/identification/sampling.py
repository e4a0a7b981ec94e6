"""Identify: the joint posterior of what is unknown, drawn by an ensemble of walkers, and whether it may be believed."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, DataError
from lostmotion.identification.chains import Quality, autocorrelation, inference_data, quality_of
from lostmotion.identification.checkpoint import Kept, cleared, fingerprint, load, save
from lostmotion.identification.moves import FEWER, JUMPS, Density, moves, sampler_of, state_of
from lostmotion.identification.population import Population, adapted, refitted
from lostmotion.identification.t_mixture import TMixture
from lostmotion.identification.task import NOISES, ShownCoordinate, Task, task_of
from lostmotion.provenance import origin_of
from lostmotion.results import Interval
from lostmotion.settings import DEFAULT, ChainSettings

__all__ = [
    "NOISES",
    "SampledPosterior",
    "SamplingPlan",
    "ShownCoordinate",
    "TMixture",
    "Task",
    "Watch",
    "identify",
    "task_of",
]

WALKERS = 16
TRIAL = 60
"""Steps after which it is seen whether the mixture is good; also after twice as many, four times and so on."""
STICKY = 8.0
"""With a longer autocorrelation time the mixture is fitted to the chain, which begins anew, up to `FITS` times."""
FITS = 4
BLOCK = 10
GROWTH = 0.05
"""Convergence is checked after each block, and in a long chain after this share of it."""
BURN = 3.0
"""The burn-in in autocorrelation times; the pilot draws before it are thrown away altogether."""
EVERY = 2.0
"""A growing chain goes to the disk every so many seconds."""

Watch = Callable[[int, str], None]
"""Is told how many steps were taken since the last time, and how the chain stands."""


@dataclass(frozen=True)
class SamplingPlan:
    """How long to sample: until the effective sample size `ess` is reached, at most `max_steps` of each walker.

    With `walkers` None there are 16, or twice as many as parameters and two.
    """

    ess: float = 1000.0
    max_steps: int = 2000
    walkers: int | None = None
    limits: ChainSettings = DEFAULT.chain


@dataclass(frozen=True)
class SampledPosterior:
    """The posterior of the parameters `keys`, in SI `units`: draws, intervals, and whether they may be believed.

    `chain` is (walkers, steps, parameters) without the burn-in, `log_density` (walkers, steps); `maximum` holds the
    parameters at the highest maximum. `lacks` says what keeps the chain from being believed. `evaluations` counts the
    runs of the likelihood, those of the pilots too. `resumed`: a kept chain was continued; `replaced`: a chain of
    another case, of other settings or another version was kept there, and this one took its place.
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
    resumed: bool = field(default=False, compare=False)
    replaced: bool = field(default=False, compare=False)

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

    def inference_data(self, attrs: Mapping[str, str | int]) -> Any:
        """Return the draws as ArviZ's `InferenceData`, groups posterior and sample_stats, with `attrs` on both."""
        columns = {k: np.ascontiguousarray(self.chain[:, :, i]) for i, k in enumerate(self.keys)}
        return inference_data(columns, self.log_density, dict(zip(self.keys, self.units, strict=True)), attrs)


def identify(
    task: Task,
    *,
    rng: np.random.Generator,
    plan: SamplingPlan | None = None,
    watch: Watch = lambda _steps, _says: None,
    keep: Path | None = None,
) -> SampledPosterior:
    """Return the posterior of a task, sampled with emcee as `plan` says.

    Weighted pilot draws fit the mixture from which most proposals come; it stays as it is while the draws that count
    are made. With `keep` the chain is kept in that HDF5 file, which emcee reads, and a run that was cut short goes on
    from there to the same end. Nothing depends on the number of cores, nor on how often the run was cut short.
    """
    return _Course(task, plan or SamplingPlan(), int(rng.integers(2**63)), watch).run(keep)


class _Course:
    """One sampling from its pilot draws to its end."""

    def __init__(self, task: Task, plan: SamplingPlan, seed: int, watch: Watch) -> None:
        self.task, self.plan, self.seed, self.watch = task, plan, seed, watch
        self.walkers = _walkers(plan, len(task.posterior.free))
        self.density = Density(task.posterior)
        self.height = float(self.density(np.atleast_2d(task.maximum))[0])
        if not math.isfinite(self.height):
            raise DataError("the posterior has no density at the maximum it came with: look for that again")

    def run(self, keep: Path | None) -> SampledPosterior:
        """Return the posterior, converged or not."""
        there = keep is not None and keep.exists()
        found = load(keep, self.digest) if keep and there else None
        shelf = _Shelf(keep, self, found or self._begun())
        self.watch(shelf.kept.backend.iteration, "a kept chain is continued" if found else "the chain begins")
        while True:
            kept = shelf.kept
            sampler = sampler_of(moves(kept.mixture, FEWER if kept.fits else JUMPS), self.density, kept.backend)
            lacks = self._chain(sampler, shelf)
            if lacks is not None:
                return self._result(sampler, lacks, resumed=found is not None, replaced=there and found is None)
            shelf.change(self._fitted(sampler, kept))

    @property
    def digest(self) -> str:
        """The digest of all that the chain depends on, its length left out."""
        task, mixture = self.task, self.task.mixture
        arrays = (
            task.maximum,
            mixture.weights,
            mixture.centres,
            mixture.roots,
            mixture.scale.middle,
            mixture.scale.breadth,
        )
        versions = origin_of("identify", {}, self.seed, {}).versions
        texts = (versions, task.digest, task.posterior.free, task.shown, self.seed, self.walkers)
        return fingerprint([*texts, self.height, *arrays])

    def _begun(self) -> Kept:
        """Return a chain without a step: the mixture that the pilots fit, and walkers where it is probable."""
        rng = np.random.default_rng(self.seed)
        population = Population.empty(self.density, self.task.mixture.size)
        mixture = adapted(self.task.mixture, population, rng, self.watch)
        start = state_of(*population.chosen(self.walkers, rng), rng)
        return Kept(self._blank(), mixture, start, self.density.evaluations, 0)

    def _blank(self) -> Any:
        """Return emcee's backend without a step."""
        from emcee.backends import Backend

        backend = Backend()
        backend.reset(self.walkers, self.task.mixture.size)
        return backend

    def _fitted(self, sampler: Any, kept: Kept) -> Kept:
        """Return a chain without a step, whose mixture is fitted to a chain that mixed badly."""
        half = sampler.iteration // 2
        points, log_densities = (
            sampler.get_chain(flat=True, discard=half),
            sampler.get_log_prob(flat=True, discard=half),
        )
        mixture = refitted(kept.mixture, points, log_densities)
        last = sampler.get_last_sample()
        start = state_of(last.coords, last.log_prob, np.random.default_rng([self.seed, kept.fits + 1]))
        self.watch(0, "the chain mixes badly: it begins anew, with proposals fitted to it")
        return Kept(self._blank(), mixture, start, self.density.evaluations, kept.fits + 1)

    def _chain(self, sampler: Any, shelf: _Shelf) -> tuple[str, ...] | None:
        """Let the walkers walk until the chain may be believed or its time is up; return what it lacks.

        Returns None when the chain mixes so badly that its mixture had better be fitted again.
        """
        state, says = shelf.kept.state, "no check yet"
        while True:
            done, check = sampler.iteration, _next_check(sampler.iteration - 1)
            if self._sticks(sampler, shelf.kept.fits):
                return None
            if done and (done == check or done >= self.plan.max_steps):
                lacks, says = self._convergence(sampler)
                self.watch(0, says)
                if not lacks or done >= self.plan.max_steps:
                    shelf.put()
                    return lacks
            size = min(BLOCK, _next_check(done) - done, self.plan.max_steps - done)
            state = sampler.run_mcmc(state, size, skip_initial_state_check=True)
            self.watch(size, says)
            shelf.put(EVERY)

    def _sticks(self, sampler: Any, fits: int) -> bool:
        """Return whether the chain has come to a step where its mixture is tried, and shows that it is not good."""
        trials = [_next_check(TRIAL * 2**i - 1) for i in range(6)]
        if fits >= FITS or sampler.iteration not in trials:
            return False
        return not float(np.max(autocorrelation(_kept(sampler, sampler.iteration)[0]))) < STICKY

    def _convergence(self, sampler: Any) -> tuple[tuple[str, ...], str]:
        """Return what the chain lacks, and how it stands; this depends on the chain and on nothing else."""
        quality = quality_of(_kept(sampler, sampler.iteration)[0])
        earlier = _last_check(sampler.iteration)
        before = float(np.max(autocorrelation(_kept(sampler, earlier)[0]))) if earlier else math.inf
        says = f"tau {quality.slowest:.1f} · ESS {quality.ess.min():.0f} of {self.plan.ess:g}"
        return quality.lacks(self.plan.ess, before, self.plan.limits), says

    def _result(self, sampler: Any, lacks: tuple[str, ...], **flags: bool) -> SampledPosterior:
        coordinates, burn = _kept(sampler, sampler.iteration)
        task = self.task
        names = tuple(one.name for one in task.shown)
        return SampledPosterior(
            keys=names,
            units=tuple(one.unit for one in task.shown),
            chain=task.values(coordinates),
            log_density=np.ascontiguousarray(sampler.get_log_prob(discard=burn).T),
            maximum=dict(zip(names, task.values(np.asarray(task.maximum)).tolist(), strict=True)),
            quality=quality_of(coordinates),
            lacks=lacks,
            burn_in=burn,
            acceptance=float(np.mean(sampler.acceptance_fraction)),
            evaluations=self.density.evaluations,
            **flags,
        )


class _Shelf:
    """Where a chain is kept, if anywhere, and when it was put there last."""

    def __init__(self, path: Path | None, course: _Course, kept: Kept) -> None:
        self.path, self.course = path, course
        if path is not None:
            cleared(path)
        self.change(kept)

    def change(self, kept: Kept) -> None:
        """Take another chain, and keep it at once."""
        self.kept, self.last = kept, -math.inf
        self.course.density.evaluations = kept.evaluations
        self.put()

    def put(self, every: float = 0.0) -> None:
        """Keep the chain as it is now, unless that was done less than `every` seconds ago."""
        if self.path is None or time.monotonic() - self.last < every:
            return
        course = self.course
        keys = tuple(f.key for f in course.task.posterior.free)
        save(self.path, course.digest, keys, self.kept, course.density.evaluations)
        self.last = time.monotonic()


def _walkers(plan: SamplingPlan, parameters: int) -> int:
    least = max(8, 2 * parameters)
    if plan.walkers is not None and plan.walkers < least:
        raise CaseError(f"{plan.walkers} walkers are too few for {parameters} parameters: give {least} or more")
    if plan.max_steps < 1:
        raise CaseError(f"at most {plan.max_steps} steps are allowed: give 1 or more")
    return plan.walkers or max(WALKERS, least + 2)


def _next_check(done: int) -> int:
    """Return after how many steps convergence is checked next; which those are does not depend on where a run began."""
    check = 0
    while check <= done:
        check += BLOCK * max(1, math.ceil(GROWTH * check / BLOCK))
    return check


def _last_check(done: int) -> int:
    """Return the number of steps at the check before the one after `done` steps, or 0."""
    check = before = 0
    while check < done:
        before, check = check, _next_check(check)
    return before


def _kept(sampler: Any, steps: int) -> tuple[Array, int]:
    """Return the first `steps` of the chain (walkers, steps, parameters) after the burn-in, and that in steps."""
    chain = np.swapaxes(sampler.get_chain()[:steps], 0, 1)
    slowest = float(np.max(autocorrelation(chain)))
    burn = int(min(math.ceil(BURN * slowest), steps // 2)) if math.isfinite(slowest) else steps // 2
    return np.ascontiguousarray(chain[:, burn:]), burn
