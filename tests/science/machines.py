"""Two real machines as cases: the EMPS carriage, and the friction damper with backlash; used by tests and benchmarks.

The damper's recordings are thinned from 1024 Hz to 32 Hz behind a low-pass filter. While it slides, the band sings at
40 to 50 Hz, which no law of friction here foretells, and close to where it opens its contact is rounded. In the
recording as it is, one-step errors are about nothing else, and a random force of 12 kN explains them better than the
gap does. At 32 Hz what is left over is nearly white, and the loop of force over travel is what is fitted.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.signal import decimate

from lostmotion.identification.sampling import SampledPosterior, SamplingPlan, identify
from lostmotion.identification.trajectory import SampledCase, choose_terms, make_trajectory_task, sample_case
from lostmotion.inference.fit import Fit, compute_robust_covariance, maximise
from lostmotion.inference.modes import select_modes
from lostmotion.inference.setup import choose_steps, make_posterior, separate_levels
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import filter_recording, observe_states, simulate_run
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.system import System
from lostmotion.noises import NOISE
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default

EMPS_FILES = ("DATA_EMPS", "DATA_EMPS_PULSES")
EMPS = """
[[recordings]]
file = "{file}"
time = "t"
hold = "step"
excitation = {{ column = "vir", quantity = "force", unit = "N", factor = 35.15065 }}
response = {{ column = "qm", quantity = "position", unit = "m" }}
"""
CARRIAGE = """
[model]
name = "rigid_drive"
[model.estimate]
m = { low = 10.0, high = 1000.0, scale = "log" }
c = { low = 1.0, high = 10000.0, scale = "log" }
"""
FRICTION, OFFSET = "coulomb_friction.force", "offset_force.force"
PUBLISHED = {"m": (95.1089, 0.1085), "c": (203.5034, 1.1460), FRICTION: (20.3935, 0.1012), OFFSET: (3.1648, 0.0444)}
"""Value and standard deviation: Janot, Gautier, Brunot, Nonlinear System Identification Benchmarks (2019), IDIM-LS. The
sign of the offset is that of our term, a force on the carriage and not a resistance."""

STARTS = 6
DAMPER = """
[[recordings]]
file = "{name}.npz"
name = "{name}"
rate = 32.0
t_start = {start}
t_end = {end}
excitation = {{ column = "displacement", quantity = "base_position", unit = "inch" }}
response = {{ column = "force", quantity = "force", unit = "kip" }}
"""
BAND = """
[model]
name = "backlash_slider"
[model.known]
"dahl_friction.deflection" = 1e-4
[model.estimate]
m = {{ median = 150.0, sd_log = 1.0 }}
c = {{ low = 1e3, high = 1e5, scale = "log" }}
k0 = {{ median = 5e6, sd_log = 1.0 }}
x0 = {{ median = 2e-3, sd_log = 0.7 }}
"dahl_friction.force" = {{ median = 1e4, sd_log = 0.7{each} }}
"offset_force.force" = {{ mean = 0.0, sd = 2000.0{each} }}
"""
"""Priors by order of magnitude, as read off a loop of force over travel; a mass of 60 kg on that contact would sing at
45 Hz. The bristles are given as far stiffer than the contact, 100 MN/m, so that the band sticks."""
LEVEL = 4448.22 * 0.5 * (2.25 + 1.99)
"""The plateau (N) of the damper at 30 lb: mean size of the medians in either direction, at 1 Hz and 1 inch."""
SPANS = {0.25: (4.6, 24.0), 0.5: (2.3, 12.0), 1.0: (1.15, 6.0)}
"""From when to when (s), by frequency (Hz): it begins while the band slides, so that the gap is shut."""


@dataclass(frozen=True)
class Found:
    """A posterior, the fit it was drawn around, and how the fit does when it runs free from the first sample."""

    result: SampledPosterior
    fit: Fit
    free_error: float

    def index(self, key: str) -> int:
        """Return which coordinate a parameter is."""
        return self.fit.posterior.space.keys.index(key)

    def deviations(self, key: str) -> tuple[float, float]:
        """Return the standard deviation of a coordinate by the likelihood, and by its scores over blocks (sandwich).

        The second allows for leftovers with a memory, and is never the smaller one.
        """
        i = self.index(key)
        usual, robust = (
            float(np.sqrt(c[i, i])) for c in (self.fit.local.covariance, compute_robust_covariance(self.fit))
        )
        return usual, robust


def emps(folder: Path, data: Path, files: Iterable[str] = EMPS_FILES, plan: SamplingPlan | None = None) -> Found:
    """Return what is found of the EMPS carriage in one recording or in several together; `data` is where they lie."""
    case = folder / "emps.toml"
    texts = [EMPS.format(file=(data / f"{name}.mat").resolve()) for name in files]
    case.write_text("".join(texts) + CARRIAGE)
    registry = default()
    prepared = prepare(case, registry)
    terms = choose_terms(prepared, ("coulomb_friction", "offset_force"), registry)
    return found(sample_case(prepared, terms, plan or SamplingPlan(), rng=np.random.default_rng(0), jobs=2))


def damper(folder: Path, data: Path, names: tuple[str, ...], plan: SamplingPlan | None = None) -> Found:
    """Return what is found of the damper in one recording, or in several that share gap, contact and damping."""
    texts, several = [thinned(folder, data, name) for name in names], len(names) > 1
    case = folder / "damper.toml"
    case.write_text("".join(texts) + BAND.format(each=", each = true" if several else ""))
    registry = default()
    prepared = prepare(case, registry)
    terms = choose_terms(prepared, (), registry)
    rng, system = np.random.default_rng(0), System(prepared.model, terms)
    posterior = make_posterior(system, prepared.case, prepared.observations).acting(system.keys)
    fits = [separate_levels(fit, prepared.case.sensor) for fit in hills(posterior, rng)]
    return found(SampledCase(identify(make_trajectory_task(prepared, fits, terms), rng=rng, plan=plan), tuple(fits)))


def hills(posterior: Posterior, rng: np.random.Generator) -> list[Fit]:
    """Return the distinct maxima that are reached from draws of the priors, best first; what is wrong starts as noise.

    The search of `identify` starts with a large random force, which is right for chaos. Here it would end on a hill
    where that force explains everything, of log evidence lower by a hundred. So the measurement noise starts at 5 % of
    the response, the random force at what is usual, and the rest within a third of the priors' widths.
    """
    starts = np.repeat(posterior.space.start[None], STARTS, axis=0)
    for i, free in enumerate(posterior.space.free):
        if free.key == NOISE:
            starts[:, i] = np.log(0.05 * posterior.scales.force)
        elif free.key == RANDOM:
            starts[:, i] = posterior.scales.usual
        else:
            starts[1:, i] = [free.quantile(share) for share in rng.uniform(1 / 3, 2 / 3, STARTS - 1)]
    fits = [maximise(choose_steps(posterior, start), start) for start in posterior.space.clip(starts)]
    best = max((fit.posterior for fit in fits), key=lambda p: p.dynamics.nsub)
    return select_modes(
        [f if f.posterior.dynamics.nsub == best.dynamics.nsub else maximise(best, f.theta) for f in fits], 20.0
    )


def thinned(folder: Path, data: Path, name: str) -> str:
    """Write a recording of the damper at 32 Hz, and return what the case says of it."""
    columns = np.load(data / f"{name}.npz")["data"][:, 1:3]
    for step in (4, 8):
        columns = decimate(columns, step, axis=0, zero_phase=True)
    np.savez(folder / f"{name}.npz", displacement=columns[:, 0], force=columns[:, 1])
    start, end = SPANS[float(name.split("_")[1].removesuffix("Hz"))]
    return DAMPER.format(name=name, start=start, end=end)


def found(sample: SampledCase) -> Found:
    """Return a posterior with the free run of its best fit, its error (rms) a share of the scatter of the response."""
    fit = sample.fits[0]
    posterior, theta = fit.posterior, fit.theta
    observation = posterior.observations[0]
    states = simulate_run(posterior, theta, filter_recording(posterior, theta).states[0], 0, observation.samples)
    error = observe_states(posterior, theta, states) - observation.response
    return Found(sample.result, fit, float(np.sqrt(np.nanmean(error**2)) / np.nanstd(observation.response)))


def travel(seen: Found, name: str = "") -> np.ndarray:
    """Return draws of the travel (m) from a reversal to half of the plateau: contact opens, gap, contact to half."""
    draws = dict(zip(seen.result.keys, seen.result.draws.T, strict=True))
    return 2.0 * draws["x0"] + 1.5 * draws["dahl_friction.force" + name] / draws["k0"]
