"""The mechanisms that a blind trial can hide in a machine: where each can act, and how its size is drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from lostmotion_trials.blind import plans
from lostmotion_trials.blind.pilot import Effect, EffectDraft, Pilot
from lostmotion_trials.blind.plans import Plan
from lostmotion_trials.blind.simulator import GAP_MODELS, BlindMachine

__all__ = [
    "GAIN",
    "NAMES",
    "NOISY",
    "SPRUNG",
    "TABLE",
    "UNKNOWN",
    "Effect",
    "HiddenMechanism",
    "Pilot",
    "draw_sized_effect",
]

LARGEST = 0.3
"""A hidden force is at most this share of the force of inertia (rms). Chosen by experience; no measurement recorded."""
GAIN = (5.0, 1000.0)
"""Range of the expected gain in log-likelihood of a hidden mechanism."""


@dataclass(frozen=True)
class HiddenMechanism:
    """The plan of a mechanism, the places at which it can act, and the models in which it can be hidden.

    The place "own" is that of the gap, and "" any place. One machine has at most one mechanism of each `kin`. `tone`
    states that the mechanism needs a drive of constant frequency, `signed` that its size can be negative.
    """

    plan: Plan
    kin: str
    at: tuple[str, ...] = ("",)
    models: tuple[str, ...] = (*GAP_MODELS, "linear_oscillator", "rigid_drive")
    tone: bool = False
    signed: bool = False

    def fits(self, rig: BlindMachine) -> bool:
        """Return whether the mechanism can be hidden in a machine."""
        return rig.model in self.models and bool(self.find_places(rig)) and not (self.tone and rig.signal.sweep)

    def find_places(self, rig: BlindMachine) -> tuple[str, ...]:
        """Return the places at which it can act in a machine."""
        own = {"own": "base" if rig.based else "ground"}
        return tuple(p for p in (own.get(a, a) for a in self.at) if not p or p in rig.places)


ANYWHERE = ("ground", "base")
SPRUNG = (*GAP_MODELS, "linear_oscillator")
TABLE: Mapping[str, HiddenMechanism] = {
    "coulomb_friction": HiddenMechanism(plans.make_force_plan("force", lambda _, v: np.sign(v)), "rub", ANYWHERE),
    "stribeck_friction": HiddenMechanism(plans.plan_stribeck, "rub", ANYWHERE),
    "dahl_friction": HiddenMechanism(plans.make_bristle_plan(low=0.05, high=0.5), "rub", ANYWHERE),
    "lugre_friction": HiddenMechanism(plans.make_bristle_plan(excess=True), "rub", ANYWHERE),
    "bouc_wen_hysteresis": HiddenMechanism(plans.make_bristle_plan(name="travel", low=0.1, high=1.0), "rub", ANYWHERE),
    "viscous_damping": HiddenMechanism(
        plans.make_force_plan("coefficient", lambda _, v: v), "drag", ("ground",), ("robot_joint",)
    ),
    "quadratic_damping": HiddenMechanism(
        plans.make_force_plan("coefficient", lambda _, v: v * np.abs(v)), "drag", ANYWHERE
    ),
    "contact_damping": HiddenMechanism(plans.plan_contact_damping, "contact", ("own",), GAP_MODELS),
    "linear_stiffness": HiddenMechanism(
        plans.make_force_plan("coefficient", lambda x, _: x), "spring", ANYWHERE, (*GAP_MODELS, "rigid_drive")
    ),
    "cubic_stiffness": HiddenMechanism(
        plans.make_force_plan("coefficient", lambda x, _: x**3), "spring", ANYWHERE, SPRUNG, signed=True
    ),
    "asymmetric_gap": HiddenMechanism(plans.plan_gap_shift, "gap", ("own",), GAP_MODELS, signed=True),
    "gap_drift": HiddenMechanism(plans.plan_gap_drift, "gap", ("",), GAP_MODELS),
    "offset_force": HiddenMechanism(
        plans.make_force_plan("force", lambda x, _: np.ones_like(x)), "push", ("",), SPRUNG, signed=True
    ),
    "parametric_stiffness": HiddenMechanism(plans.plan_parametric_stiffness, "wave", ("",), SPRUNG, tone=True),
    "excitation_harmonic": HiddenMechanism(plans.plan_drive_harmonic, "wave", ("",), tone=True),
    "excitation_delay": HiddenMechanism(plans.plan_drive_delay, "late"),
    "excitation_gain": HiddenMechanism(plans.plan_drive_gain, "more", ("",), SPRUNG, signed=True),
    "sensor_delay": HiddenMechanism(plans.plan_sensor_delay, "late"),
    "sensor_gain": HiddenMechanism(plans.plan_sensor_gain, "more", ("",), SPRUNG, signed=True),
    "sensor_quantisation": HiddenMechanism(lambda p, _a, _r: EffectDraft(p.q, lambda s: {"step": s}), "round"),
    "random_force": HiddenMechanism(lambda p, _a, _r: EffectDraft(p.q, lambda s: {"rms": s}), "chance"),
    "backlash": HiddenMechanism(plans.plan_backlash, "gap", ("",), ("linear_oscillator",)),
    "end_stop": HiddenMechanism(plans.plan_end_stop, "gap", ("ground",), ("linear_oscillator", "robot_joint")),
    "hunt_crossley_contact": HiddenMechanism(plans.plan_hunt_crossley, "contact", ("own",), GAP_MODELS),
    "hertz_contact": HiddenMechanism(plans.plan_hertz, "spring", ("own",), GAP_MODELS),
    "bilinear_stiffness": HiddenMechanism(
        plans.make_force_plan("difference", lambda x, _: -0.5 * np.abs(x)), "spring", ("ground",), SPRUNG, signed=True
    ),
    "quadratic_stiffness": HiddenMechanism(
        plans.make_force_plan("coefficient", lambda x, _: -(x**2)), "spring", ("ground",), SPRUNG, signed=True
    ),
    "hidden_mode": HiddenMechanism(plans.plan_hidden_mode, "mass", ("ground",)),
    "inertia_change": HiddenMechanism(plans.plan_inertia_change, "mass", ("ground",), signed=True),
    "directional_friction": HiddenMechanism(plans.plan_directional_friction, "rub", ANYWHERE),
    "position_dependent_friction": HiddenMechanism(plans.plan_position_friction, "rub", ANYWHERE),
    "load_dependent_friction": HiddenMechanism(
        plans.plan_load_friction, "rub", ("own",), ("robot_joint", "linear_oscillator", "rigid_drive")
    ),
    "friction_drift": HiddenMechanism(plans.plan_friction_drift, "rub", ANYWHERE),
    "directional_damping": HiddenMechanism(
        plans.make_force_plan("difference", lambda _, v: -0.5 * np.abs(v)), "drag", ("ground",), signed=True
    ),
    "damping_drift": HiddenMechanism(plans.plan_damping_drift, "drag", ("ground",), signed=False),
    "cogging": HiddenMechanism(plans.plan_cogging, "wave", ("ground",)),
    "position_ripple": HiddenMechanism(plans.plan_sensor_ripple, "round"),
    "actuator_lag": HiddenMechanism(plans.plan_actuator_lag, "late"),
    "sensor_lag": HiddenMechanism(plans.plan_sensor_lag, "late", ("",), GAP_MODELS),
    "drive_saturation": HiddenMechanism(plans.plan_saturation, "more"),
    "drive_dead_zone": HiddenMechanism(plans.plan_dead_zone, "more"),
}
UNKNOWN: Mapping[str, HiddenMechanism] = {
    "wave over position that narrows": HiddenMechanism(plans.plan_narrowing_wave, "unknown"),
    "friction that depends on position": HiddenMechanism(plans.plan_rough_friction, "unknown"),
    "bump at one position": HiddenMechanism(plans.plan_bump, "unknown"),
    "drag that grows with position": HiddenMechanism(plans.plan_position_drag, "unknown", models=SPRUNG),
}
"""Mechanisms that the library does not contain; a diagnosis should call them unknown."""
NAMES = (*TABLE, "unknown")
NOISY: Mapping[str, Callable[[Pilot, float], float]] = {
    "sensor_quantisation": lambda pilot, share: pilot.noise * 10.0 ** (1.2 * share),
    "random_force": lambda pilot, share: pilot.usual_force * 3.2 * 10.0 ** (0.7 * share),
}
"""Size of mechanisms whose force cannot be computed in advance, from a share between 0 and 1."""


def draw_sized_effect(name: str, pilot: Pilot, rng: np.random.Generator) -> Effect:
    """Return a mechanism of the size whose expected gain in log-likelihood is a random number in `GAIN`."""
    what = str(rng.choice(list(UNKNOWN))) if name == "unknown" else ""
    mechanism = UNKNOWN[what] if what else TABLE[name]
    at = str(rng.choice(mechanism.find_places(pilot.rig)))
    draft = mechanism.plan(pilot, at, rng)
    gain = math.exp(rng.uniform(math.log(GAIN[0]), math.log(GAIN[1])))
    if name in NOISY:
        return Effect(name, at, draft.parameters(NOISY[name](pilot, float(rng.random()))))
    size = math.sqrt(gain / max(pilot.expect_gain(draft), 1e-300))
    loud = size * float(np.std(draft.force)) / (float(np.std(pilot.q)) if draft.on_sensor else pilot.inertial_force)
    size *= min(1.0, LARGEST / max(loud, 1e-300)) * (rng.choice([-1.0, 1.0]) if mechanism.signed else 1.0)
    return Effect(name, at, draft.parameters(float(size)), what)
