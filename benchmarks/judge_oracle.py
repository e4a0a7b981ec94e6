"""The oracle of the imperfect world: which effect an observer names who knows the laws and sizes of the flaws.

The observer of `judge_machine` asks only *which effect*. He knows what no diagnosis can know: the trajectory, the laws
of all flaws with the prior of the generator, and the noise of drive and sensor. The trial is held in the space of
forces along the true trajectory, where almost everything is linear:

- The data are the true missing force (hidden effect and flaws) plus one draw of the noise with which drive and sensor
  hide it. The covariance of the noise is Q + A R A', A the linearised equation of motion (mass, damping and the
  stiffness at each sample) by central differences, R that of the sensor (white, slow, hum, rounding), Q that of the
  recorded drive. The noise of the recording itself is not used: central differences of real readings would have an
  error of their own as large as small effects.
- Flaws have a Gaussian prior with the variance of the generator's: waves of the smooth forces (with their true sizes),
  wrong known values, bend of the sensor, foot, far mode. Damping, gap and stiffness are nearly free. All of these are
  integrated in closed form. The shape of the friction over the speed is integrated for friction only, in proportion to
  its level.
- A candidate is each mechanism that the trial can hide, at each place, with the generator's prior of its size, which is
  integrated numerically. Its shape (a pitch, a velocity) is sought: draws of the generator, then steps about the best
  one. Each shape parameter costs 0.5 log(1 + 2 gain), which is Laplace's factor for a prior one unit wide.
  The parameters of the hidden effect are one of the starts, so that its own search does not fail.
- The prior is the one of the trial: the mechanisms are equally frequent, and one machine of four hides nothing.

So the oracle says what these recordings allow at most. It knows the trajectory, so it is better than any observer of
the readings. Quantisation and a random force have no force of this kind and are left out.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.linalg import cholesky, solve_triangular, toeplitz

from judge_forces import compute_effect_force, compute_flaw_columns, compute_true_flaws
from judge_sets import find_names, is_friction
from judge_truth import load_truth
from lostmotion.codec import from_plain
from lostmotion_trials.blind.commitment import CLEAN, RARE
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.imperfect import EFFECT_SIZES, World, fit_line, simulate_imperfect
from lostmotion_trials.blind.imperfect import draw_effect as draw_random
from lostmotion_trials.blind.mechanisms import NOISY, TABLE, UNKNOWN, Effect, Pilot
from lostmotion_trials.blind.sealed import SealedTruth
from lostmotion_trials.blind.simulator import EXCITATION_NOISE
from lostmotion_trials.integrators.imperfect import REACH

DRAWS, STEPS = 60, 60
"""Shapes that are drawn for each candidate, and steps about the best one."""
NODES = np.geomspace(*EFFECT_SIZES, 200)
"""Sizes over which the likelihood is integrated."""
CUTS = ("drive_saturation", "drive_dead_zone")
"""Mechanisms whose size is a level, on which the shape of their force depends."""
SEED = 4404


@dataclass(frozen=True)
class View:
    """What the observer sees of a machine: the whitened missing force, and the factor that whitens."""

    pilot: Pilot
    world: World
    operator: np.ndarray
    factor: np.ndarray
    seen: np.ndarray

    def whiten(self, force: np.ndarray) -> np.ndarray:
        """Return forces (samples,) or (samples, columns) in units of the noise and of the flaws."""
        return np.asarray(solve_triangular(self.factor, force[1:-1], lower=True, check_finite=False))

    @cached_property
    def friction_waves(self) -> np.ndarray:
        """Return the shape of a friction over the speed (samples, 8), of unit level, with its usual sizes.

        A constant level is the friction itself, a slope is viscous damping.
        """
        z = np.abs(self.pilot.v) / self.world.flaws["velocity"]
        waves = [fit_line(w(0.5 * math.pi * k * z) / k, z)[1] for k in range(1, 5) for w in (np.cos, np.sin)]
        return 0.12 / math.sqrt(1.42) * np.stack(waves, axis=1)


def make_operator(pilot: Pilot) -> np.ndarray:
    """Return the linearised equation of motion (samples - 2, samples): forces per displacement."""
    body, n, rate = pilot.rig.body, len(pilot.q), pilot.rig.rate
    stiff = body.k + body.k0 * np.abs(pilot.contact_sign)
    rows = np.arange(n - 2)
    operator = np.zeros((n - 2, n))
    operator[rows, rows] = body.m * rate**2 - 0.5 * body.c * rate
    operator[rows, rows + 1] = stiff[1:-1] - 2.0 * body.m * rate**2
    operator[rows, rows + 2] = body.m * rate**2 + 0.5 * body.c * rate
    return operator


def make_noise(pilot: Pilot, world: World, noise: float, operator: np.ndarray) -> np.ndarray:
    """Return the covariance (samples - 2, samples - 2) of the force noise due to drive and sensor."""
    lags = np.arange(len(pilot.q))
    white = 1.0 - world.slow + world.step**2 / 12.0
    sensor = toeplitz(
        world.slow * world.memory**lags + 0.5 * world.hum**2 * np.cos(world.hum_pace * lags / pilot.rig.rate)
    )
    sensor[lags, lags] += white
    covariance = noise**2 * operator @ sensor @ operator.T
    size = EXCITATION_NOISE * pilot.rig.signal.amplitude
    drive = pilot.rig.body.k0 * np.abs(pilot.contact_sign[1:-1]) if pilot.rig.based else np.ones(len(lags) - 2)
    covariance[np.diag_indices_from(covariance)] += (size * drive) ** 2
    return covariance


def simulate_truth(sealed: SealedTruth, rng: np.random.Generator) -> tuple[Pilot, World]:
    """Return the true motion of a machine, and its flaws."""
    rig, world = sealed.machine, sealed.world
    if world is None:
        raise ValueError("the machine is one of the perfect world")
    return Pilot(rig, simulate_imperfect(rig, convert_effects(rig, sealed.effects), world, rng)), world


def open_view(sealed: SealedTruth) -> View:
    """Return what the observer sees of a machine."""
    rig, rng = sealed.machine, np.random.default_rng(SEED)
    pilot, world = simulate_truth(sealed, rng)
    operator = make_operator(pilot)
    covariance = make_noise(pilot, world, rig.measurement_noise, operator)
    lost = cholesky(covariance, lower=True) @ rng.standard_normal(len(covariance))
    force = compute_true_flaws(pilot, world, operator)
    force += sum(compute_true_force(effect, (pilot, world), operator) for effect in sealed.effects)
    columns = compute_flaw_columns(pilot, world, operator)[1:-1]
    factor = cholesky(covariance + columns @ columns.T, lower=True)
    return View(pilot, world, operator, factor, solve_triangular(factor, force[1:-1] + lost, lower=True))


def compute_true_force(effect: Effect, view_of: tuple[Pilot, World], operator: np.ndarray) -> np.ndarray:
    """Return the force (samples,) of a hidden effect along the trajectory, with the true shape of dry friction."""
    pilot, world = view_of
    force = compute_effect_force(effect, pilot, operator)[0]
    if not is_friction(effect):
        return force
    curve = world.curves["friction"]
    z = np.linspace(-REACH, REACH, len(curve))
    return force * np.interp(np.abs(pilot.v) / world.flaws["velocity"], z, curve)


def list_candidates(view: View) -> Iterator[tuple[str, str, float]]:
    """Yield each mechanism that the trial can hide in a machine, with a kind outside the library, and its prior."""
    rig, kind = view.pilot.rig, view.world.kind
    fitting = [n for n, m in TABLE.items() if n not in NOISY and m.fits(rig) and (kind == "cycle" or not m.tone)]
    total = len(fitting) + RARE
    for name in fitting:
        yield name, "", (1.0 - CLEAN) / total
    kinds = [what for what, mechanism in UNKNOWN.items() if mechanism.fits(rig)]
    for what in kinds:
        yield "unknown", what, (1.0 - CLEAN) * RARE / total / len(kinds)


def draw_candidate(name: str, what: str, view: View, rng: np.random.Generator) -> Effect:
    """Return a random effect of a mechanism, or of a kind outside the library."""
    while True:
        effect = draw_random(name, view.pilot, rng)
        if effect.what == what:
            return effect


def measure_effect(effect: Effect, pilot: Pilot, operator: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Return the force (samples,) of an effect, its size and its reference, both as rms in the same unit.

    They are those of the force and of the force of inertia, or of the error of a sensor and of the motion.
    """
    force, shown = compute_effect_force(effect, pilot, operator)
    reference = float(np.std(pilot.q)) if shown is not None else pilot.inertial_force
    return force, float(np.sqrt(np.mean((force if shown is None else shown) ** 2))), reference


def measure_shares(sealed: SealedTruth) -> list[float | None]:
    """Return the size of each hidden effect over its reference along the true motion; None where it is no force."""
    pilot, _ = simulate_truth(sealed, np.random.default_rng(SEED))
    operator = make_operator(pilot)
    measured = [None if e.mechanism in NOISY else measure_effect(e, pilot, operator)[1:] for e in sealed.effects]
    return [one and one[0] / one[1] for one in measured]


def weigh(effect: Effect, view: View) -> tuple[float, float]:
    """Return the log evidence of an effect with any size over nothing hidden, and the gain at the best size."""
    force, size, reference = measure_effect(effect, view.pilot, view.operator)
    if not (math.isfinite(size) and size > 0.0):
        return -math.inf, 0.0
    unit = view.whiten(force * reference / size)
    slope, curvature, offset = float(unit @ view.seen), float(unit @ unit), 0.0
    if is_friction(effect):
        level = float(np.clip(slope / max(curvature, 1e-300), *EFFECT_SIZES))
        waves = view.whiten(view.friction_waves * (force * reference / size)[:, None]) * level
        slope, curvature, offset = project(unit, view.seen, waves)
    signs = (1.0, -1.0) if effect.mechanism not in TABLE or TABLE[effect.mechanism].signed else (1.0,)
    told = np.concatenate([s * slope * NODES - 0.5 * curvature * NODES**2 for s in signs])
    top = float(told.max())
    return offset + top + math.log(float(np.mean(np.exp(told - top)))), max(top, 0.0)


def project(unit: np.ndarray, seen: np.ndarray, waves: np.ndarray) -> tuple[float, float, float]:
    """Return slope, curvature and offset of a log-likelihood after waves with a unit prior are integrated."""
    gram = np.eye(waves.shape[1]) + waves.T @ waves
    own, other = waves.T @ unit, waves.T @ seen
    slope = float(unit @ seen - own @ np.linalg.solve(gram, other))
    curvature = float(unit @ unit - own @ np.linalg.solve(gram, own))
    offset = 0.5 * float(other @ np.linalg.solve(gram, other)) - 0.5 * float(np.linalg.slogdet(gram)[1])
    return slope, curvature, offset


def search_shape(name: str, what: str, view: View, true: Effect | None) -> float:
    """Return the log evidence of a mechanism over nothing hidden, at its best shape and place.

    The parameters of the hidden effect, if it is this mechanism, are one of the starts.
    """
    rng = np.random.default_rng([SEED, len(name)])
    first = draw_candidate(name, what, view, rng)
    places = len((UNKNOWN[what] if what else TABLE[name]).find_places(view.pilot.rig))
    shapes = len(first.parameters) - (0 if name in CUTS else 1)
    draws = DRAWS if shapes else 6 * places if places > 1 else 2
    drawn = [first, *(draw_candidate(name, what, view, rng) for _ in range(draws - 1)), *([true] if true else [])]
    told = [(*weigh(effect, view), effect) for effect in drawn]
    evidence, gain, best = max(told, key=lambda one: one[0])
    width = 0.3
    for _ in range(STEPS if shapes else STEPS // 3):
        near = {k: v * math.exp(width * rng.standard_normal()) for k, v in best.parameters.items()}
        near |= {k: best.parameters[k] for k in ("ratio", "side") if k in best.parameters}
        tried = replace(best, parameters=near)
        more, least = weigh(tried, view)
        if more > evidence:
            evidence, gain, best, width = more, least, tried, width * 1.3
        else:
            width = max(0.9 * width, 1e-3)
    return evidence - 0.5 * shapes * math.log1p(2.0 * gain) - (math.log(places) if places > 1 else 0.0)


def compare_mechanisms(view: View, effects: Sequence[Effect]) -> dict[str, float]:
    """Return the probability of each mechanism, of `unknown` (a law that the library lacks) and of nothing hidden."""
    scores = {"nothing_missing": math.log(CLEAN)}
    for name, what, prior in list_candidates(view):
        true = next((e for e in effects if (e.mechanism, e.what) == (name, what)), None)
        value = search_shape(name, what, view, true) + math.log(prior)
        scores[name] = float(np.logaddexp(scores.get(name, -math.inf), value))
    top = max(scores.values())
    total = sum(math.exp(value - top) for value in scores.values())
    return {name: math.exp(value - top) / total for name, value in scores.items()}


def group_names(shares: Mapping[str, float], accept: Sequence[str]) -> dict[str, float]:
    """Return the probability of each group of names that count as one; those that are right are the group `true`."""
    groups: dict[str, float] = {}
    for name, share in shares.items():
        key = name if name in ("unknown", "nothing_missing") else min(find_names(name, rough=True))
        key = "true" if name in accept else key
        groups[key] = groups.get(key, 0.0) + share
    return groups


def judge_machine(folder: Path) -> dict:
    """Return the probabilities of the observer for one machine; `true` is the group of the names that are right."""
    sealed = from_plain(SealedTruth, json.loads(folder.with_name(f"{folder.name}.sealed.json").read_text()), "sealed")
    if any(effect.mechanism in NOISY for effect in sealed.effects):
        return {"status": "no force"}
    shares = compare_mechanisms(open_view(sealed), sealed.effects)
    accept = [name for effect in load_truth(folder)["effects"] for name in effect["accept"]]
    groups = group_names(shares, accept)
    best = sorted(groups, key=lambda key: -groups[key])[:6]
    first = sorted(shares, key=lambda key: -shares[key])[:6]
    return {
        "status": "ok",
        "best": {key: round(groups[key], 4) for key in best},
        "names": {key: round(shares[key], 4) for key in first},
        "probability_of_truth": groups.get("true", 0.0),
    }
