"""Laws whose shape lies far from the usual are found by a look along the missing force, and only where there is one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from test_unknown_force import CLEAN, RIPPLE, fitted
from truths import case_of, fit_oscillator

from lostmotion.contracts import Param, Term
from lostmotion.diagnosis.stages import diagnose
from lostmotion.evidence.effects import list_bare_promises
from lostmotion.inference import rounding
from lostmotion.inference.candidates import fit_term
from lostmotion.inference.natural import compute_range, compute_size, sort_slots
from lostmotion.inference.shape_scan import BLOCKS, TOGETHER, SmoothedMotion, measure_steadiness, scan_shapes
from lostmotion.likelihood.latent import smooth_expected_force
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.preparation.candidate_terms import candidates_of
from lostmotion.quantities import FORCE, LENGTH
from lostmotion.registry import default

PITCH = 0.002
"""Thirteen periods over the travel, a fifth of the half gap."""


@dataclass(frozen=True)
class Ratchet(Term):
    """The example of the README: a force that pulls a motor from pole to pole."""

    at: str = "ground"
    name = "ratchet"
    physics = "Cogging of {force}, from pole to pole over {pitch}, acts"
    formula = "-force * sin(2 pi x / pitch)"
    paper = "Zhu, Howe, IEEE Trans. Energy Conversion 15 (2000) 407-412"
    params = (
        Param("force", "largest cogging force", FORCE, null=0.0),
        Param("pitch", "travel from pole to pole", LENGTH, low=0.0, scale="log"),
    )

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * math.sin(2.0 * math.pi * x / p[1])


def with_ratchet(fit, *more):
    """Return a fit of the nominal model in a system that has cogging too."""
    model, registry = fit.posterior.system.model, default()
    system = System(model, candidates_of(model, [Ratchet, *(registry.load("term", name) for name in more)]))
    known = system.vector({q.name: fit.posterior.known[i] for i, q in enumerate(model.params)})
    dynamics = replace(fit.posterior.dynamics, system=system)
    return replace(fit, posterior=replace(fit.posterior, dynamics=dynamics, known=known))


def test_a_level_of_the_drive_is_searched_up_to_its_largest_value():
    """Impacts have twenty times the amplitude (sqrt(2) rms) of their drive: a limit lies between the two."""
    fit = with_ratchet(fitted(RIPPLE), "drive_saturation", "drive_dead_zone")
    observation = fit.posterior.observations[0]
    hits = observation.inputs.copy()
    hits[100, observation.lead] = largest = 20.0 * fit.posterior.scales.force
    posterior = fit.posterior.on((replace(observation, inputs=hits),))
    for key in ("drive_saturation", "drive_dead_zone"):
        for used, high in ((fit.posterior, 2.8), (posterior, 20.0)):
            level = sort_slots(used, key)[1][0].param
            assert compute_range(level, used.scales)[1] <= 1.001 * high * used.scales.force
        assert compute_range(level, used.scales)[1] == pytest.approx(largest)


def test_a_pitch_far_shorter_than_the_travel_is_scouted():
    found = scan_shapes(with_ratchet(fitted(RIPPLE)))
    assert list(found) == ["ratchet"]
    assert found["ratchet"][0]["ratchet.pitch"] == pytest.approx(PITCH, rel=0.03)


def test_where_nothing_is_missing_a_scouted_shape_promises_nothing():
    fit = with_ratchet(fitted(CLEAN))
    assert not [promise for promise in list_bare_promises(fit, ["ratchet"], scan_shapes(fit)) if promise.gain > 0.0]
    fit = with_ratchet(fitted(RIPPLE))
    assert list_bare_promises(fit, ["ratchet"], scan_shapes(fit))[0].gain > 30.0


def test_many_shapes_together_give_what_each_gives_alone():
    """The laws of many pitches in one call, and their correlation with the gradient part by part, in plain loops."""
    fit = with_ratchet(fitted(RIPPLE))
    states, gradient = smooth_expected_force(fit.posterior, fit.theta)
    motion = SmoothedMotion(fit.posterior, fit.theta, np.ascontiguousarray(states[:, :2]), gradient)
    shapes = [{"ratchet.pitch": pitch} for pitch in np.geomspace(1e-3, 1e-2, TOGETHER + 3)]
    steady = measure_steadiness(motion, "ratchet", shapes)
    for shape, found in list(zip(shapes, steady, strict=True))[::17]:
        size = compute_size(Ratchet.params[0], fit.posterior.scales)
        full = fit.posterior.recordings[0].full(fit.theta)
        mass = full[fit.posterior.system.index["m"]]
        law = np.array([Ratchet.force(0.0, x, 0.0, None, (size, *shape.values()), ()) for x in states[:, 0]]) / mass
        parts = np.array_split((law - law.mean()) * gradient, np.linspace(0, len(law), BLOCKS + 1).astype(int)[1:-1])
        sums = [part.sum() for part in parts]
        assert found == pytest.approx(abs(np.mean(sums)) / (np.std(sums, ddof=1) / math.sqrt(BLOCKS)), rel=1e-6)


@pytest.mark.slow
def test_a_short_pitch_is_named_with_its_size():
    """1 N with thirteen periods over the travel, hidden by an integrator of its own; it was learned as a curve."""
    fit = with_ratchet(fitted(RIPPLE), "coulomb_friction", "cubic_stiffness", "linear_stiffness", "quadratic_damping")
    found = diagnose(
        case_of(("c", "x0")), fit.posterior.observations, fit.posterior.system, rng=np.random.default_rng(0)
    )
    assert found.named == ("ratchet",)
    assert found.learned is None
    values = found.after.values
    assert values["ratchet.force"] == pytest.approx(-1.0, abs=0.1)
    assert values["ratchet.pitch"] == pytest.approx(PITCH, rel=0.01)


def clipped(limit, term="drive_saturation", step=0.0):
    """Return the fit of a linear oscillator to its motion under three tones of which only `limit` acts, by leapfrog.

    Readings are rounded to a `step` (m).
    """
    rng, dt, fine, samples = np.random.default_rng(5), 0.01, 50, 3000
    times = dt / fine * (np.arange(samples * fine) + 0.5)
    tones = sum(np.cos(w * times + 1.7 * w) for w in (7.0, 13.0, 19.0))
    x, v, seen = 0.0, 0.0, np.zeros(samples)
    for k, push in enumerate(np.clip(tones, -limit, limit)):
        if k % fine == 0:
            seen[k // fine] = x
        v += dt / fine * (push - 2.0 * v - 400.0 * x)
        x += dt / fine * v
    force = sum(np.cos(w * dt * np.arange(samples) + 1.7 * w) for w in (7.0, 13.0, 19.0))
    z = seen + 0.01 * seen.std() * rng.standard_normal(samples)
    z = step * np.round(z / step) if step else z
    observation = Observation.of("seen", z, force[:, None], dt, "position")
    return fit_oscillator(observation, rng, terms=(term, "sensor_quantisation"))


@pytest.mark.parametrize("limit", [2.2, 2.5])
def test_the_limit_of_a_drive_that_saturates_is_scanned_for(limit):
    """Three tones of 1 N add up to 3 N; the usual values of the limit are 60 % apart."""
    found = scan_shapes(clipped(limit))
    assert found["drive_saturation"][0]["drive_saturation.limit"] == pytest.approx(limit, rel=0.15)


def test_a_drive_that_does_not_saturate_has_no_limit():
    assert scan_shapes(clipped(9.0)) == {}


def test_the_rounding_of_stored_values_is_no_wave_of_the_sensor(monkeypatch):
    """Its errors have the pitch of the step; a wave of that pitch was named beside the quantisation."""
    fit = clipped(9.0, "position_ripple", step=1e-3)
    assert scan_shapes(fit) == {}
    third = {"position_ripple": [{"position_ripple.pitch": 1e-3 / 3.0}]}
    (promise,) = list_bare_promises(fit, ["position_ripple"], third)
    assert promise.start["position_ripple.pitch"] > 1e-3
    assert fit_term(fit, promise.key, promise.start).values["position_ripple.pitch"] >= 1.5e-3 * (1.0 - 1e-9)
    monkeypatch.setattr(rounding, "ROUNDED", 0.0)
    assert scan_shapes(fit)["position_ripple"][0]["position_ripple.pitch"] == pytest.approx(1e-3, rel=0.01)
    assert list_bare_promises(fit, ["position_ripple"], third)[0].gain > promise.gain + 10.0
