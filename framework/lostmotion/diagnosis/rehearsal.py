"""Simulated new recordings, with all noise, and the log evidence of each model for them given the old recordings."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.excitations import Excitation
from lostmotion.inference.fit import Fit
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.inference.sensitivity import compute_sensitivity
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import observe_states, simulate_kicked
from lostmotion.likelihood.space import RANDOM

PIECE = 4
"""Samples between two impulses of the random force."""
RANDOM_FORCE_STEPS = (0.0, 2.0, 4.0, 6.0)
"""Increments of the log random force at the start of a fit: a wrong model needs a larger random force."""
HALVINGS = 4


@dataclass(frozen=True)
class RehearsedModel:
    """A model with its posterior after the old recordings.

    The posterior is normal about the estimate, with the information matrix `precision`. The random force of a new
    recording has its prior only, because it differs between recordings.
    """

    fit: Fit
    precision: Array

    @classmethod
    def of(cls, fit: Fit) -> RehearsedModel:
        """Return the model of a fit."""
        shared = np.array([f.parameter != RANDOM for f in fit.posterior.space.free])
        precision = np.diag([1.0 / min(f.sd, f.high - f.low) ** 2 for f in fit.posterior.space.free])
        known = fit.local.covariance[np.ix_(shared, shared)]
        precision[np.ix_(shared, shared)] = solve_scaled(known, np.eye(int(shared.sum())))
        return cls(fit, 0.5 * (precision + precision.T))

    def pose(self, excitation: Excitation, z: Array | None = None) -> Posterior:
        """Return the posterior of a new recording; the noise of the excitation grows with its level."""
        posterior, old = self.fit.posterior, self.fit.posterior.observations[0]
        seen = np.zeros((len(excitation.inputs), len(old.sensors))) if z is None else z
        bare = replace(old, name="experiment", begin=0, harmonic=excitation.harmonic)
        observation = replace(bare, readings=seen, inputs=excitation.inputs)
        shift = self._compute_shift(excitation)
        frees = [
            replace(f, start=f.start + shift, low=f.low + shift, high=f.high + shift, mean=f.mean + shift)
            if f.parameter == RANDOM
            else f
            for f in posterior.space.free
        ]
        return replace(posterior, observations=(observation,), jobs=1).over(frees)

    def get_coordinates(self, excitation: Excitation) -> Array:
        """Return the coordinates under an excitation."""
        random = np.array([f.parameter == RANDOM for f in self.fit.posterior.space.free])
        return np.asarray(self.fit.theta + self._compute_shift(excitation) * random, dtype=float)

    def _compute_shift(self, excitation: Excitation) -> float:
        return 2.0 * math.log(max(excitation.level, 1e-300) / max(self.fit.posterior.observations[0].travel, 1e-300))


def simulate_recording(model: RehearsedModel, excitation: Excitation, rng: np.random.Generator) -> Array | None:
    """Return simulated readings (samples, sensors) of a model with its noise levels; None if it diverges."""
    posterior, theta = model.pose(excitation), model.get_coordinates(excitation)
    system, recording = posterior.system, posterior.recordings[0]
    full = recording.full(theta)
    drive = recording.drive(full)
    kick = math.sqrt(recording.random_force(theta) * PIECE * drive.dt) * system.kick(full, system.model.first_place)
    kicks = np.zeros((drive.samples, posterior.dynamics.states))
    kicked = [min(start + PIECE, drive.samples - 1) for start in range(0, drive.samples - 1, PIECE)]
    kicks[kicked, : len(kick)] = rng.standard_normal((len(kicked), 1)) * kick
    begun = model.fit.posterior.recordings[0].points(model.fit.theta[None]).mean[0]
    states = simulate_kicked(posterior, theta, begun, kicks)
    if not np.all(np.isfinite(states)):
        return None
    shown = []
    for sensor in range(len(posterior.observations[0].sensors)):
        seen = observe_states(posterior, theta, states, sensor=sensor)
        shown.append(seen + recording.noise(theta, sensor).draw(np.gradient(seen, drive.dt), rng))
    return np.stack(shown, axis=1)


@dataclass(frozen=True)
class EvidenceBudget:
    """How evidence is computed: log-likelihoods times `share`, and at most `rounds` rounds of Fisher scoring."""

    share: float
    rounds: int


def compute_evidence(model: RehearsedModel, excitation: Excitation, z: Array, asked: EvidenceBudget) -> float:
    """Return the log evidence of a new recording, given the old ones, by Laplace's method; -inf if it diverges.

    With zero rounds, the maximum is predicted from the first step.
    """
    posterior, middle = model.pose(excitation, z), model.get_coordinates(excitation)
    task = _NewPosterior(posterior, middle, model.precision, asked.share)
    point, height = task.find_start()
    if not math.isfinite(height):
        return -math.inf
    steps = model.fit.local.steps
    for turn in range(asked.rounds + 1):
        slopes = compute_sensitivity(posterior, point, steps)
        information = asked.share * slopes.information()
        gradient = asked.share * slopes.gradient() - model.precision @ (point - middle)
        whole = information + model.precision
        if not (np.all(np.isfinite(gradient)) and np.all(np.isfinite(whole))):
            return -math.inf
        step = solve_scaled(whole, gradient)
        promise = 0.5 * float(gradient @ step)
        if turn == asked.rounds or promise < 0.05:
            break
        moved = task.climb(point, height, step)
        if moved is None:
            promise = 0.0
            break
        point, height = moved
    # The gain of a fit from noise does not grow with the length of the recording: it is counted once.
    spare = 0.5 * (asked.share - 1.0) * float(np.trace(solve_scaled(whole, information)))
    return height + max(promise, 0.0) - spare - 0.5 * _compute_log_ratio(whole, model.precision)


@dataclass(frozen=True)
class _NewPosterior:
    """The log posterior of a new recording, counted `share` times, with the old posterior as prior."""

    posterior: Posterior
    middle: Array
    precision: Array
    share: float

    def log_densities(self, thetas: Array) -> Array:
        """Return the log posterior (points,) at coordinates (points, n)."""
        away = thetas - self.middle
        log_likelihoods = self.posterior.log_likelihood(thetas)
        return np.asarray(self.share * log_likelihoods - 0.5 * np.einsum("pi,ij,pj->p", away, self.precision, away))

    def find_start(self) -> tuple[Array, float]:
        """Return the start with the highest log posterior over several levels of the random force."""
        random = np.array([f.parameter == RANDOM for f in self.posterior.space.free])
        starts = self.posterior.space.clip(self.middle + np.outer(RANDOM_FORCE_STEPS, random))
        log_densities = self.log_densities(starts)
        best = int(np.argmax(log_densities))
        return starts[best], float(log_densities[best])

    def climb(self, point: Array, height: float, step: Array) -> tuple[Array, float] | None:
        """Return a point with a higher log posterior along a step, or None."""
        trials = self.posterior.space.clip(point + np.outer(0.5 ** np.arange(HALVINGS), step))
        reached = self.log_densities(trials)
        higher = np.flatnonzero(reached > height)
        return (trials[higher[0]], float(reached[higher[0]])) if len(higher) else None


def _compute_log_ratio(a: Array, b: Array) -> float:
    """Return the logarithm of the ratio of two determinants."""
    return float(np.linalg.slogdet(a)[1] - np.linalg.slogdet(b)[1])
