"""How sharp and how fast identify is.

    python benchmarks/identification.py sharpness [--draws 500]    posterior deviations over the Cramer-Rao bounds
    python benchmarks/identification.py speed [--samples 24000]    likelihoods and draws a second, ours over plain NumPy
    python benchmarks/identification.py peers [--samples 24000]    the same posterior by other samplers (extra: peers)

Recordings are made by leapfrog, which shares nothing with the framework: Case 1 of the paper, position with 1 % noise.
Times come out right only on a quiet machine; ratios come from one run.
"""

from __future__ import annotations

import argparse
import importlib
import math
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, identify, make_task
from lostmotion.inference.fit import Fit, maximise
from lostmotion.inference.setup import choose_steps, find_modes, make_posterior, polish_modes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.system import System
from studies import TRUE, case_of, system_of

from cramer_rao import bounds  # isort: skip - beside the tests, as `studies` has made known
from independent import Machine, Recording, recording  # isort: skip
from reference import Reference  # isort: skip

LEVELS = {"periodic, 1/alpha 2.6": 200.0 / 2.6, "periodic, 1/alpha 4.1": 200.0 / 4.1, "chaotic": 100.0}
"""Amplitudes of the force (N) on Case 1."""
PERIODS, PER_PERIOD, PIECES = 100, 200, 10
NOISE_SHARE, FINEST = 0.01, 0.005
WIDTH, MOST = 8.0, 60_000
"""Other samplers look so many deviations about the maximum, and compute the likelihood so often at most."""


def measured(machine: Machine, periods: int, seed: int, excitation: float) -> tuple[Recording, Observation]:
    """Return a recording and its observation, the force measured with noise of `excitation` times its amplitude."""
    seen = recording(machine, periods=periods, noise=NOISE_SHARE, seed=seed)
    noise = excitation * machine.amplitude * np.random.default_rng([seed, 1]).standard_normal(len(seen.force))
    return seen, Observation.of(
        "recording", seen.position, (seen.force + noise)[:, None], float(seen.time[1]), "position"
    )


def posed(observation: Observation, jobs: int = 2) -> Posterior:
    """Return the posterior of c, x0 and both noise levels, started at the truth."""
    posterior = make_posterior(System(system_of().model, ()), case_of(("c", "x0")), (observation,), jobs=jobs)
    start = {"c": math.log(TRUE["c"]), "x0": math.log(TRUE["x0"])}
    frees = tuple(replace(f, start=start.get(f.key, f.start)) for f in posterior.space.free)
    return posterior.over(frees)


def fitted(posterior: Posterior) -> Fit:
    """Return the maximum near the truth with steps finer than those of identify, so that these are not measured."""
    return maximise(choose_steps(posterior, maximise(posterior).theta, accuracy=FINEST))


def sharpness(draws: float) -> None:
    """Print for each level, with and without noise in the force, posterior deviations (relative) beside the bounds.

    Chaos followed as one motion gives away its parameters without limit: for it the motion is cut into pieces.
    """
    print(f"{'relative deviations of c and x0, times 1e-6':<46}{'posterior':>16}{'bound':>16}{'ratio':>12}")
    for name, amplitude in LEVELS.items():
        for excitation in (0.0, 1e-3):
            shown = f"{name}, force noise {excitation:.1%}"
            print(f"{shown:<46}" + _sharp(Machine(amplitude=amplitude), excitation, draws), flush=True)


def _sharp(machine: Machine, excitation: float, draws: float) -> str:
    seen, observation = measured(machine, PERIODS, 1, excitation)
    fit = fitted(posed(observation))
    found = identify(make_task([fit]), rng=np.random.default_rng(0), plan=SamplingPlan(ess=draws))
    logs = np.log(found.draws[:, :2])
    sd, sigma = logs.std(axis=0), NOISE_SHARE * float(seen.states[:, 0].std())
    pieces = PIECES * PER_PERIOD if machine.amplitude == LEVELS["chaotic"] and not excitation else None
    least = bounds(machine, seen, sigma, (excitation * machine.amplitude) ** 2 * observation.dt, window=pieces)
    at_least = bounds(
        machine, seen, sigma, math.exp(fit.posterior.space.free[fit.posterior.space.keys.index(RANDOM)].low)
    )
    missed = (logs.mean(axis=0) - np.log([TRUE["c"], TRUE["x0"]])) / sd
    told = f"{_pair(1e6 * sd)}{_pair(1e6 * least)}{_pair(sd / least)}  misses by {missed[0]:+.1f} {missed[1]:+.1f} sd"
    told += f"; over the bound with the least random force {_pair(sd / at_least)}" if not excitation else ""
    told += f"; pieces of {PIECES} periods" if pieces else ""
    return told + ("" if found.converged else "; NOT CONVERGED")


def _pair(values: Any) -> str:
    return f"{values[0]:8.3g}{values[1]:8.3g}"


def speed(samples: int) -> None:
    """Print likelihood runs and effective draws a second, and what a plain NumPy filter would do of both."""
    begin = time.perf_counter()
    _, observation = measured(Machine(), round(samples / PER_PERIOD), 1, 1e-3)
    posterior = posed(observation)
    posterior.innovations(posterior.space.start)
    begin = time.perf_counter()
    fits = polish_modes(find_modes(posterior, np.random.default_rng(0)))
    searched = time.perf_counter() - begin
    posterior = fits[0].posterior
    theta = fits[0].theta
    alone, both = runs_a_second(replace(posterior, jobs=1), theta), runs_a_second(posterior, theta)
    print(
        f"{observation.samples} samples, {len(theta)} unknowns, {posterior.dynamics.nsub} steps at most between samples"
    )
    print(f"search and fits of {len(fits)} mode(s)            {searched:10.1f} s")
    print(
        f"likelihood runs a second, one core      {alone:10.1f}   {1e9 / alone / observation.samples:.0f} ns a sample"
    )
    print(f"likelihood runs a second, two cores     {both:10.1f}")
    plain, apart = against_plain(posterior, theta)
    print(f"the same by plain NumPy, one core       {plain:10.4f}   (log-likelihood apart by {apart:.1e})")
    print(f"ours over plain NumPy, one core         {alone / plain:10.0f}")
    begin = time.perf_counter()
    found = identify(make_task(fits), rng=np.random.default_rng(1), plan=SamplingPlan())
    taken = time.perf_counter() - begin
    ess = float(found.quality.ess.min())
    print(f"identify: sampling to ESS {ess:.0f}           {taken:10.1f} s   {found.evaluations} runs {found.lacks}")
    print(f"effective draws a second                {ess / taken:10.1f}   {ess / found.evaluations:.3f} a run")
    print(f"with the plain filter on {os.cpu_count()} cores        {ess / found.evaluations * plain * 2.0:10.4f}")
    print(f"whole identify                          {taken + searched:10.1f} s   (wanted: less than 90 s)")


def runs_a_second(posterior: Posterior, theta: Any, seconds: float = 2.0) -> float:
    """Return how often a second the likelihood is computed, as many at a time as the sampler hands over."""
    points = np.repeat(theta[None], 8, axis=0)
    posterior.log_likelihood(points)
    begin, done = time.perf_counter(), 0
    while time.perf_counter() - begin < seconds:
        posterior.log_likelihood(points)
        done += len(points)
    return done / (time.perf_counter() - begin)


def against_plain(posterior: Posterior, theta: Any, samples: int = 2000) -> tuple[float, float]:
    """Return runs a second of the plain filter over the whole recording, timed on its beginning, and how far it is off.

    The second is relative to the log-likelihood of that beginning.
    """
    part = posterior.on((posterior.observations[0].part(0, samples),))
    ours = part.innovations(theta).log_likelihood
    begin = time.perf_counter()
    plain = (
        replace(part, dynamics=Reference(part.system, part.active, part.dynamics.nsub))
        .innovations(theta)
        .log_likelihood
    )
    taken = (time.perf_counter() - begin) * posterior.observations[0].samples / samples
    return 1.0 / taken, abs(plain - ours) / abs(ours)


@dataclass
class Counted:
    """A posterior in a box of `WIDTH` deviations about its maximum, which counts the runs of its likelihood."""

    fit: Fit
    runs: int = 0

    def __post_init__(self) -> None:
        posterior, reach = self.fit.posterior, WIDTH * np.array(list(self.fit.sd.values()))
        self.low = np.maximum(posterior.space.clip(np.full(len(reach), -np.inf)), self.fit.theta - reach)
        self.high = np.minimum(posterior.space.clip(np.full(len(reach), np.inf)), self.fit.theta + reach)

    def spread(self, cube: Any) -> Any:
        """Return coordinates of points of the unit cube."""
        return self.low + np.asarray(cube) * (self.high - self.low)

    def heights(self, points: Any) -> Any:
        """Return log posterior densities (count,); very low ones outside of the bounds."""
        points, posterior = np.atleast_2d(points), self.fit.posterior
        found = np.array([posterior.space.log_prior(p) for p in points])
        inside = np.isfinite(found)
        self.runs += int(inside.sum())
        if inside.any():
            found[inside] += posterior.log_likelihood(points[inside])
        return np.maximum(found, -1e300)


def peers(samples: int, only: str) -> None:
    """Print effective draws a run and a second of our sampler and of others, on one posterior about one maximum."""
    _, observation = measured(Machine(), round(samples / PER_PERIOD), 1, 1e-3)
    fits = polish_modes([fitted(posed(observation))])
    truth: Any = None
    print(f"{'':<34}{'runs':>9}{'s':>9}{'effective':>11}{'a run':>9}{'a second':>10}   mean of log x0, deviation")
    for name, call in _samplers(fits):
        if only not in name:
            continue
        try:
            begin = time.perf_counter()
            counted, ess, draws = call()
            taken = time.perf_counter() - begin
        except ImportError as err:
            print(f"{name:<34}   absent ({err.name or err})")
            continue
        truth = draws[:, 1].mean() if truth is None else truth
        shown = f"{draws[:, 1].mean():.6f} {draws[:, 1].std():.2e}"
        print(
            f"{name:<34}{counted:9d}{taken:9.1f}{ess:11.0f}{ess / counted:9.4f}{ess / taken:10.2f}   {shown}",
            flush=True,
        )


Result = tuple[int, float, Any]


def _samplers(fits: list[Fit]) -> Iterator[tuple[str, Callable[[], Result]]]:
    fit, parameters = fits[0], len(fits[0].theta)

    def ours() -> Result:
        found: SampledPosterior = identify(make_task(fits), rng=np.random.default_rng(1), plan=SamplingPlan())
        return found.evaluations, float(found.quality.ess.min()), np.log(found.draws)

    def zeus(steps: int = 400, walkers: int = 16) -> Result:
        module, posterior = importlib.import_module("zeus"), Counted(fit)
        np.random.seed(0)  # noqa: NPY002 - zeus draws from nowhere else
        sampler = module.EnsembleSampler(walkers, parameters, posterior.heights, vectorize=True, verbose=False)
        sampler.run_mcmc(_about(fit, walkers), steps, progress=False)
        chain = sampler.get_chain(discard=steps // 4)
        return posterior.runs, _ess(chain), chain.reshape(-1, parameters)

    def nautilus() -> Result:
        module, posterior = importlib.import_module("nautilus"), Counted(fit)
        sampler = module.Sampler(
            posterior.spread, posterior.heights, parameters, n_live=400, n_networks=1, vectorized=True, seed=0,
            pass_dict=False,
        )  # fmt: skip
        sampler.run(n_eff=1000, n_like_max=MOST, verbose=False)
        points, weights, _ = sampler.posterior()
        return posterior.runs, float(sampler.n_eff), _resampled(points, np.exp(weights))

    def dynesty() -> Result:
        module, posterior = importlib.import_module("dynesty"), Counted(fit)
        sampler = module.NestedSampler(
            lambda p: float(posterior.heights(p)[0]), posterior.spread, parameters, nlive=250, sample="rwalk",
            rstate=np.random.default_rng(0),
        )  # fmt: skip
        sampler.run_nested(dlogz=0.1, maxcall=MOST, print_progress=False)
        weights = np.exp(sampler.results.logwt - sampler.results.logz[-1])
        ess = float(weights.sum() ** 2 / np.sum(weights**2))
        return posterior.runs, ess, _resampled(sampler.results.samples, weights)

    yield "ours (emcee, proposals fitted)", ours
    yield "zeus", zeus
    yield "nautilus", nautilus
    yield "dynesty", dynesty


def _about(fit: Fit, count: int) -> Any:
    rng = np.random.default_rng(2)
    points = rng.multivariate_normal(fit.theta, fit.local.covariance, count)
    low, high = (np.array([getattr(f, end) for f in fit.posterior.space.free]) for end in ("low", "high"))
    return np.clip(points, low + 1e-6, high - 1e-6)


def _ess(chain: Any) -> float:
    import arviz_stats

    columns = (np.ascontiguousarray(chain[:, :, i].T) for i in range(chain.shape[2]))
    return float(min(arviz_stats.ess(one, method="bulk", chain_axis=0, draw_axis=1) for one in columns))


def _resampled(points: Any, weights: Any) -> Any:
    share = weights / weights.sum()
    return points[np.random.default_rng(3).choice(len(points), size=20_000, p=share)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("sharpness", "speed", "peers"))
    parser.add_argument("--samples", type=int, default=24_000)
    parser.add_argument("--draws", type=float, default=500.0)
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    {
        "sharpness": lambda: sharpness(args.draws),
        "speed": lambda: speed(args.samples),
        "peers": lambda: peers(args.samples, args.only),
    }[args.what]()


if __name__ == "__main__":
    main()
