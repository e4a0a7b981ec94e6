"""Sample the joint posterior of the unknown parameters with an ensemble of walkers, and check its convergence."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, DataError
from lostmotion.identification.checkpoint import StoredChain, compute_digest, load, remove_temporary_files, save
from lostmotion.identification.convergence import (
    ChainQuality,
    compute_autocorrelation,
    make_groups_of_draws,
    measure_quality,
)
from lostmotion.identification.moves import (
    JUMP_SHARE,
    JUMP_SHARE_AFTER_FIT,
    Density,
    make_moves,
    make_sampler,
    make_state,
)
from lostmotion.identification.population import Population, adapt_mixture, refit_mixture
from lostmotion.identification.t_mixture import TMixture
from lostmotion.identification.task import NOISES, ShownCoordinate, Task, make_task
from lostmotion.provenance import origin_of
from lostmotion.results import Interval
from lostmotion.settings import DEFAULT, ChainSettings

if TYPE_CHECKING:
    import xarray as xr

__all__ = [
    "NOISES",
    "SampledPosterior",
    "SamplingPlan",
    "ShownCoordinate",
    "TMixture",
    "Task",
    "Watch",
    "identify",
    "make_task",
]

DEFAULT_WALKERS = 16
FIRST_TRIAL = 60
"""Steps after which the mixture is tested; also after twice, four times ... as many."""
TRIAL_MAX_TAU = 8.0
"""With a longer autocorrelation time the mixture is fitted to the chain, and a new chain begins (`MAX_FITS` times)."""
MAX_FITS = 4
CHECK_INTERVAL = 10
CHECK_GROWTH = 0.05
"""Convergence is checked every `CHECK_INTERVAL` steps, and in a long chain after this share of its length."""
BURN_IN_TIMES = 3.0
"""Burn-in in autocorrelation times; the pilot draws before the chain are not used for results."""
SAVE_INTERVAL = 2.0
"""Seconds between two writes of a growing chain to the disk."""

Watch = Callable[[int, str], None]
"""Called with the number of steps since the last call, and a text about the state of the chain."""


@dataclass(frozen=True)
class SamplingPlan:
    """How long to sample: until the effective sample size `ess` is reached, at most `max_steps` of each walker.

    With `walkers` None the number of walkers is 16, or two more than twice the number of parameters if that is larger.
    """

    ess: float = 1000.0
    max_steps: int = 2000
    walkers: int | None = None
    limits: ChainSettings = DEFAULT.chain


@dataclass(frozen=True)
class SampledPosterior:
    """The posterior of the parameters `keys`, in SI `units`: draws, intervals, and convergence.

    `chain` is (walkers, steps, parameters) without the burn-in, `log_density` is (walkers, steps); `maximum` holds the
    parameters at the highest maximum. `lacks` lists the convergence criteria that are not met. `evaluations` counts the
    evaluations of the likelihood, those of the pilot draws included. `resumed`: a stored chain was continued;
    `replaced`: a stored chain of another case, other settings or another version was overwritten.
    """

    keys: tuple[str, ...]
    units: tuple[str, ...]
    chain: Array
    log_density: Array
    maximum: Mapping[str, float]
    quality: ChainQuality
    lacks: tuple[str, ...]
    burn_in: int
    acceptance: float
    evaluations: int
    resumed: bool = field(default=False, compare=False)
    replaced: bool = field(default=False, compare=False)

    @property
    def converged(self) -> bool:
        """Whether the chain meets all convergence criteria."""
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

    def groups(self, attrs: Mapping[str, str | int]) -> dict[str, xr.Dataset]:
        """Return the draws as the groups `posterior` and `sample_stats` of ArviZ, with `attrs` on both."""
        columns = {k: np.ascontiguousarray(self.chain[:, :, i]) for i, k in enumerate(self.keys)}
        return make_groups_of_draws(columns, self.log_density, dict(zip(self.keys, self.units, strict=True)), attrs)


def identify(
    task: Task,
    *,
    rng: np.random.Generator,
    plan: SamplingPlan | None = None,
    watch: Watch = lambda _steps, _says: None,
    keep: Path | None = None,
) -> SampledPosterior:
    """Return the posterior of a task, sampled with emcee as `plan` says.

    Weighted pilot draws fit the mixture from which most proposals come; it stays fixed while the chain is sampled. With
    `keep` the chain is stored in that HDF5 file, which emcee can read, and an interrupted run continues from it to the
    same result. The result depends neither on the number of cores nor on interruptions.
    """
    return _SamplingRun(task, plan or SamplingPlan(), int(rng.integers(2**63)), watch).run(keep)


class _SamplingRun:
    """One sampling run, from the pilot draws to the end of the chain."""

    def __init__(self, task: Task, plan: SamplingPlan, seed: int, watch: Watch) -> None:
        self.task, self.plan, self.seed, self.watch = task, plan, seed, watch
        self.walkers = _count_walkers(plan, len(task.posterior.space.free))
        self.density = Density(task.posterior)
        self.log_density = float(self.density(np.atleast_2d(task.maximum))[0])
        if not math.isfinite(self.log_density):
            raise DataError("the posterior density is zero at the given maximum: search for the maximum again")

    def run(self, keep: Path | None) -> SampledPosterior:
        """Return the posterior, converged or not."""
        there = keep is not None and keep.exists()
        found = load(keep, self.digest) if keep and there else None
        stored = _ChainFile(keep, self, found or self._begin())
        self.watch(stored.kept.backend.iteration, "a stored chain is continued" if found else "the chain begins")
        while True:
            kept = stored.kept
            sampler = make_sampler(
                make_moves(kept.mixture, JUMP_SHARE_AFTER_FIT if kept.fits else JUMP_SHARE), self.density, kept.backend
            )
            lacks = self._run_chain(sampler, stored)
            if lacks is not None:
                return self._make_result(sampler, lacks, resumed=found is not None, replaced=there and found is None)
            stored.replace(self._refit(sampler, kept))

    @property
    def digest(self) -> str:
        """The digest of everything that the chain depends on, except its length."""
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
        texts = (versions, task.digest, task.posterior.space.free, task.shown, self.seed, self.walkers)
        return compute_digest([*texts, self.log_density, *arrays])

    def _begin(self) -> StoredChain:
        """Return an empty chain, with the mixture fitted to pilot draws, and walkers drawn from these."""
        rng = np.random.default_rng(self.seed)
        population = Population.empty(self.density, self.task.mixture.size)
        mixture = adapt_mixture(self.task.mixture, population, rng, self.watch)
        start = make_state(*population.choose_points(self.walkers, rng), rng)
        return StoredChain(self._make_backend(), mixture, start, self.density.evaluations, 0)

    def _make_backend(self) -> Any:
        """Return an empty backend of emcee."""
        from emcee.backends import Backend

        backend = Backend()
        backend.reset(self.walkers, self.task.mixture.size)
        return backend

    def _refit(self, sampler: Any, kept: StoredChain) -> StoredChain:
        """Return an empty chain whose mixture is fitted to a chain that mixed badly."""
        half = sampler.iteration // 2
        points, log_densities = (
            sampler.get_chain(flat=True, discard=half),
            sampler.get_log_prob(flat=True, discard=half),
        )
        mixture = refit_mixture(kept.mixture, points, log_densities)
        last = sampler.get_last_sample()
        start = make_state(last.coords, last.log_prob, np.random.default_rng([self.seed, kept.fits + 1]))
        self.watch(0, "the chain mixes badly: a new chain begins, with proposals fitted to the old one")
        return StoredChain(self._make_backend(), mixture, start, self.density.evaluations, kept.fits + 1)

    def _run_chain(self, sampler: Any, stored: _ChainFile) -> tuple[str, ...] | None:
        """Run the chain until it converges or reaches the step limit; return the criteria that are not met.

        Returns None when the chain mixes so badly that its mixture must be fitted again.
        """
        state, says = stored.kept.state, "no check yet"
        while True:
            done, check = sampler.iteration, _find_next_check(sampler.iteration - 1)
            if self._needs_refit(sampler, stored.kept.fits):
                return None
            if done and (done == check or done >= self.plan.max_steps):
                lacks, says = self._check_convergence(sampler)
                self.watch(0, says)
                if not lacks or done >= self.plan.max_steps:
                    stored.save()
                    return lacks
            size = min(CHECK_INTERVAL, _find_next_check(done) - done, self.plan.max_steps - done)
            state = sampler.run_mcmc(state, size, skip_initial_state_check=True)
            self.watch(size, says)
            stored.save(SAVE_INTERVAL)

    def _needs_refit(self, sampler: Any, fits: int) -> bool:
        """Return whether the mixture is tested at this step and the chain mixes too slowly with it."""
        trials = [_find_next_check(FIRST_TRIAL * 2**i - 1) for i in range(6)]
        if fits >= MAX_FITS or sampler.iteration not in trials:
            return False
        return not float(np.max(compute_autocorrelation(_drop_burn_in(sampler, sampler.iteration)[0]))) < TRIAL_MAX_TAU

    def _check_convergence(self, sampler: Any) -> tuple[tuple[str, ...], str]:
        """Return the criteria that are not met, and a progress text; both depend on the chain only."""
        quality = measure_quality(_drop_burn_in(sampler, sampler.iteration)[0])
        earlier = _find_last_check(sampler.iteration)
        before = float(np.max(compute_autocorrelation(_drop_burn_in(sampler, earlier)[0]))) if earlier else math.inf
        says = f"tau {quality.slowest:.1f} · ESS {quality.ess.min():.0f} of {self.plan.ess:g}"
        return quality.find_shortcomings(self.plan.ess, before, self.plan.limits), says

    def _make_result(self, sampler: Any, lacks: tuple[str, ...], **flags: bool) -> SampledPosterior:
        coordinates, burn = _drop_burn_in(sampler, sampler.iteration)
        task = self.task
        names = tuple(one.name for one in task.shown)
        return SampledPosterior(
            keys=names,
            units=tuple(one.unit for one in task.shown),
            chain=task.values(coordinates),
            log_density=np.ascontiguousarray(sampler.get_log_prob(discard=burn).T),
            maximum=dict(zip(names, task.values(np.asarray(task.maximum)).tolist(), strict=True)),
            quality=measure_quality(coordinates),
            lacks=lacks,
            burn_in=burn,
            acceptance=float(np.mean(sampler.acceptance_fraction)),
            evaluations=self.density.evaluations,
            **flags,
        )


class _ChainFile:
    """The file in which a chain is stored, if any, and the time of the last write."""

    def __init__(self, path: Path | None, course: _SamplingRun, kept: StoredChain) -> None:
        self.path, self.course = path, course
        if path is not None:
            remove_temporary_files(path)
        self.replace(kept)

    def replace(self, kept: StoredChain) -> None:
        """Take another chain and store it at once."""
        self.kept, self.last = kept, -math.inf
        self.course.density.evaluations = kept.evaluations
        self.save()

    def save(self, every: float = 0.0) -> None:
        """Store the current chain, unless that was done less than `every` seconds ago."""
        if self.path is None or time.monotonic() - self.last < every:
            return
        course = self.course
        keys = tuple(f.key for f in course.task.posterior.space.free)
        save(self.path, course.digest, keys, self.kept, course.density.evaluations)
        self.last = time.monotonic()


def _count_walkers(plan: SamplingPlan, parameters: int) -> int:
    least = max(8, 2 * parameters)
    if plan.walkers is not None and plan.walkers < least:
        raise CaseError(f"{plan.walkers} walkers are too few for {parameters} parameters: give {least} or more")
    if plan.max_steps < 1:
        raise CaseError(f"at most {plan.max_steps} steps are allowed: give 1 or more")
    return plan.walkers or max(DEFAULT_WALKERS, least + 2)


def _find_next_check(done: int) -> int:
    """Return the number of steps at the next check; it does not depend on where a run was continued."""
    check = 0
    while check <= done:
        check += CHECK_INTERVAL * max(1, math.ceil(CHECK_GROWTH * check / CHECK_INTERVAL))
    return check


def _find_last_check(done: int) -> int:
    """Return the number of steps at the check before the one after `done` steps, or 0."""
    check = before = 0
    while check < done:
        before, check = check, _find_next_check(check)
    return before


def _drop_burn_in(sampler: Any, steps: int) -> tuple[Array, int]:
    """Return the first `steps` of the chain without burn-in (walkers, steps, parameters), and the burn-in in steps."""
    chain = np.swapaxes(sampler.get_chain()[:steps], 0, 1)
    slowest = float(np.max(compute_autocorrelation(chain)))
    burn = int(min(math.ceil(BURN_IN_TIMES * slowest), steps // 2)) if math.isfinite(slowest) else steps // 2
    return np.ascontiguousarray(chain[:, burn:]), burn
