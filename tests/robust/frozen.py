"""Answers that must not change: `python tests/robust/frozen.py` prints them as `frozen.json` holds them.

A change here is no accident of rounding: the tolerances in `test_same_answer.py` are far above it. Whoever changes a
method on purpose prints them anew and says why in the commit.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

import numpy as np

import lostmotion
from lostmotion.case import CaseFile, Prior
from lostmotion.inference.setup import make_posterior
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.registry import default

MACHINE = {"m": 1.0, "c": 8.0, "k0": 4e4, "x0": 0.005}
DRIVE = "harmonic:amplitude=100,omega=40"
AXES = ("alpha=0.1:0.5:2:inverse", "zeta=0.02:0.05:2")


def answers(jobs: int = 1) -> dict[str, list[float]]:
    """Return positions (m) of a chaotic slider, log-likelihoods of its recording, exponents of a map, lag and dim."""
    table = lostmotion.simulate(
        "lin_backlash", terms="coulomb_friction:force=3", drives=DRIVE, values=MACHINE, duration=3.0, rate=640.0,
        noise=0.01, seed=3,
    )  # fmt: skip
    force, position = table.columns["force"], table.columns["position"]
    plain = lostmotion.simulate("lin_backlash", drives=DRIVE, values=MACHINE, duration=1.0, rate=640.0)
    series = lostmotion.embed(position, default().make("embedder", "ami_cao"), dt=1 / 640, period=np.pi / 20)
    return {
        "position": [float(x) for x in plain.columns["position"][::64]],
        "likelihood": likelihoods(force, position, jobs),
        "exponent": exponents(jobs),
        "embedding": [float(series.embedding.lag), float(series.embedding.dim)],
    }


def likelihoods(force: np.ndarray, position: np.ndarray, jobs: int) -> list[float]:
    """Return the log-likelihood at the start of the search and at two neighbours of it."""
    system = System(default().make("model", "lin_backlash"), ())
    known = {"m": 1.0, "k0": 4e4, "k1": 0.0}
    estimate = {"c": Prior(0.8, 80.0, "log"), "x0": Prior(1e-3, 2e-2, "log")}
    case = CaseFile("study", Path(), (), "lin_backlash", known, estimate, {}, (), "")
    observation = Observation.of("seen", position, force[:, None], 1 / 640, "position")
    posterior = make_posterior(system, case, (observation,), jobs=jobs)
    start = posterior.space.start
    return [float(x) for x in posterior.log_likelihood(np.stack([start, start + 0.01, start - 0.01]))]


def exponents(jobs: int) -> list[float]:
    """Return the largest exponents (1/s) of a small map, and after them their standard errors."""
    with tempfile.TemporaryDirectory() as folder:
        asked = {"periods": 200, "transient": 50, "starts": 1, "jobs": jobs}
        found = lostmotion.map("lin_backlash", Path(folder) / "map.nc", axes=AXES, **asked)
        values = [*found["lyapunov_max"].values.ravel(), *found["lyapunov_stderr"].values.ravel()]
        return [float(x) for x in values]


def told(ear: object, jobs: int) -> None:
    """Send the answers of this process."""
    ear.send(answers(jobs))  # type: ignore[attr-defined]


if __name__ == "__main__":
    sys.stdout.write(json.dumps(answers(), indent=1) + "\n")
