"""Comparison of two measures of fit over the gap: the error of a free run, and the likelihood of one-step errors."""

from __future__ import annotations

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from lostmotion.inference.setup import choose_steps, make_posterior
from lostmotion.likelihood.predict import filter_recording, observe_states, simulate_run
from lostmotion.likelihood.system import System
from lostmotion.noises import NOISE
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from lostmotion.simulation.simulated_machine import Plan, assembly_of, simulate

TRUTH = {"m": 1.0, "c": 8.0, "k0": 4e4, "x0": 5e-3}
CASE = """
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 4e4
c = 8.0
[model.estimate]
x0 = { low = 5e-4, high = 5e-2, scale = "log" }
"""
GAPS = np.linspace(4.5e-3, 5.5e-3, 201)


def draw():
    """Return the figure: the gap that is tried over both measures of fit."""
    free, likelihood = compute_measures()
    figure, axes = plt.subplots(1, 2, figsize=(7.2, 2.6))
    axes[0].plot(1e3 * GAPS, free, color="#d55e00", lw=0.9)
    axes[0].set(xlabel="gap tried, x0 (mm)", ylabel="error of a free run\n(share of the response)")
    axes[1].plot(1e3 * GAPS, likelihood - likelihood.max(), color="#0072b2", lw=1.2)
    axes[1].set(xlabel="gap tried, x0 (mm)", ylabel="log-likelihood of\none-step errors")
    for axis in axes:
        axis.axvline(1e3 * TRUTH["x0"], color="0.6", lw=0.8, zorder=0)
    print(f"Left: {count_minima(free)} minima. Right: {count_minima(-likelihood)}.")
    return figure


def compute_measures():
    """Return the error of a free run, a share of the response, and the log-likelihood, each over `GAPS`."""
    registry = default()
    assembly, _ = assembly_of(registry, "lin_backlash", [])
    drive = ("harmonic:amplitude=100,omega=40",)
    plan = Plan(assembly, TRUTH, drive, duration=5.0, rate=640.0, noise=0.01)
    with tempfile.TemporaryDirectory() as folder:
        simulate(plan).save(Path(folder) / "recording.csv")
        (Path(folder) / "case.toml").write_text(CASE, encoding="utf-8")
        prepared = prepare(Path(folder) / "case.toml", registry)
    posterior = make_posterior(System(prepared.model, ()), prepared.case, prepared.observations)
    posterior = choose_steps(posterior, posterior.space.start)
    observation = prepared.observations[0]
    theta = posterior.space.start.copy()
    gap, noise = posterior.space.keys.index("x0"), posterior.space.keys.index(NOISE)
    theta[noise] = np.log(0.01 * np.std(observation.response))
    free, likelihood = [], []
    for value in np.log(GAPS):
        theta[gap] = value
        begin = filter_recording(posterior, theta).states[0]
        states = simulate_run(posterior, theta, begin, 0, observation.samples)
        free.append(
            np.sqrt(np.mean((observe_states(posterior, theta, states) - observation.response) ** 2))
            / np.std(observation.response)
        )
        likelihood.append(posterior.innovations(theta).log_likelihood)
    return np.array(free), np.array(likelihood)


def count_minima(curve):
    """Return the number of inner minima of a curve."""
    return int(np.sum((curve[1:-1] < curve[:-2]) & (curve[1:-1] < curve[2:])))
