"""The time of the likelihood of a model that is written down over that of the same model written by hand.

python benchmarks/written.py
"""

from __future__ import annotations

import math
import time

import numpy as np

from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion.noises import NOISE
from lostmotion.registry import default
from lostmotion.written import model_of

SAMPLES, POINTS, ROUNDS = 6000, 32, 15
CASES = {
    "lin_backlash": (
        "m*(x'' + base_acceleration) + c*x' + k1*x + gap(x, k0, x0) = force",
        {"m": 1.0, "c": 8.0, "k1": 100.0, "k0": 4000.0, "x0": 5e-3},
    ),
    "clearance_chain": (
        (
            "m1*(x1'' + base_acceleration) + c1*x1' + k1*x1 + c0*(x1' - x2') + gap(x1 - x2, k0, x0) = force",
            "m2*(x2'' + base_acceleration) + c2*x2' + k2*x2 = c0*(x1'-x2') + gap(x1-x2, k0, x0) + second_force",
        ),
        {"m1": 1.0, "c1": 8.0, "k1": 400.0, "m2": 0.5, "c2": 2.0, "k2": 900.0, "k0": 4e3, "c0": 1.0, "x0": 2e-3},
    ),
}


def posterior_of(model, values) -> Posterior:
    """Return the likelihood of a recording of noise under a model with these values."""
    rng = np.random.default_rng(0)
    drive = np.zeros((SAMPLES, len(model.inputs)))
    drive[:, list(model.inputs).index("force")] = 20.0 * np.sin(0.05 * np.arange(SAMPLES))
    observation = Observation.of("noise", 5e-3 * rng.standard_normal(SAMPLES), drive, 2e-3, "position")
    system = System(model)
    free = (
        FreeParameter(RANDOM, "1", math.log(1e-3), -math.inf, math.inf),
        FreeParameter(NOISE, "1", math.log(5e-3), -math.inf, math.inf),
    )
    space, running = ParameterSpace(free), Lanes(system, nsub=2)
    return Posterior(space, (observation,), running, Scales(20.0, 5e-3, 0.05), system.vector(values))


def main() -> None:
    """Print the ratio of the least times, both taken in turn."""
    for name, (texts, values) in CASES.items():
        posteriors = [posterior_of(m, values) for m in (default().make("model", name), model_of(texts)())]
        theta = np.tile([f.start for f in posteriors[0].space.free], (POINTS, 1))
        told = [posterior.log_likelihood(theta) for posterior in posteriors]
        times: list[list[float]] = [[], []]
        for _ in range(ROUNDS):
            for k, posterior in enumerate(posteriors):
                begin = time.perf_counter()
                posterior.log_likelihood(theta)
                times[k].append(time.perf_counter() - begin)
        least = [min(own) for own in times]
        apart = float(np.abs(told[0] - told[1]).max() / np.abs(told[0]).max())
        print(f"{name}: {least[1] / least[0]:.3f} times the time ({least[0]:.3f} s), values differ by {apart:.0e}")


if __name__ == "__main__":
    main()
