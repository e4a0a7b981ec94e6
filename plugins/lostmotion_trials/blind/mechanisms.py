"""What a blind trial may hide in a machine, where it can act, and how large it is drawn."""

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
"""A hidden force has at the most this share of the inertial force, rms."""
GAIN = (5.0, 1000.0)


@dataclass(frozen=True)
class HiddenMechanism:
    """How a mechanism is planned; where it can act ("own": where the gap is; "": any); which machines it fits.

    `kin` are those of which one machine has one at the most; `tone`: it needs a drive whose frequency stays.
    """

    plan: Plan
    kin: str
    at: tuple[str, ...] = ("",)
    models: tuple[str, ...] = (*GAP_MODELS, "linear_oscillator", "rigid_drive")
    tone: bool = False
    signed: bool = False

    def fits(self, rig: BlindMachine) -> bool:
        """Return whether the mechanism is something else there than what is estimated anyway."""
        return rig.model in self.models and bool(self.spots(rig)) and not (self.tone and rig.signal.sweep)

    def spots(self, rig: BlindMachine) -> tuple[str, ...]:
        """Return the places where it can act."""
        own = {"own": "base" if rig.based else "ground"}
        return tuple(p for p in (own.get(a, a) for a in self.at) if not p or p in rig.places)


ANYWHERE = ("ground", "base")
SPRUNG = (*GAP_MODELS, "linear_oscillator")
TABLE: Mapping[str, HiddenMechanism] = {
    "coulomb_friction": HiddenMechanism(plans.one("force", lambda _, v: np.sign(v)), "rub", ANYWHERE),
    "stribeck_friction": HiddenMechanism(plans.stribeck, "rub", ANYWHERE),
    "dahl_friction": HiddenMechanism(plans.bristle(low=0.05, high=0.5), "rub", ANYWHERE),
    "lugre_friction": HiddenMechanism(plans.bristle(excess=True), "rub", ANYWHERE),
    "bouc_wen_hysteresis": HiddenMechanism(plans.bristle(name="travel", low=0.1, high=1.0), "rub", ANYWHERE),
    "viscous_damping": HiddenMechanism(plans.one("coefficient", lambda _, v: v), "drag", ("ground",), ("robot_joint",)),
    "quadratic_damping": HiddenMechanism(plans.one("coefficient", lambda _, v: v * np.abs(v)), "drag", ANYWHERE),
    "contact_damping": HiddenMechanism(plans.contact_drag, "contact", ("own",), GAP_MODELS),
    "linear_stiffness": HiddenMechanism(
        plans.one("coefficient", lambda x, _: x), "spring", ANYWHERE, (*GAP_MODELS, "rigid_drive")
    ),
    "cubic_stiffness": HiddenMechanism(
        plans.one("coefficient", lambda x, _: x**3), "spring", ANYWHERE, SPRUNG, signed=True
    ),
    "asymmetric_gap": HiddenMechanism(plans.asymmetric, "gap", ("own",), GAP_MODELS, signed=True),
    "gap_drift": HiddenMechanism(plans.drift, "gap", ("",), GAP_MODELS),
    "offset_force": HiddenMechanism(
        plans.one("force", lambda x, _: np.ones_like(x)), "push", ("",), SPRUNG, signed=True
    ),
    "parametric_stiffness": HiddenMechanism(plans.parametric, "wave", ("",), SPRUNG, tone=True),
    "excitation_harmonic": HiddenMechanism(plans.harmonic, "wave", ("",), tone=True),
    "excitation_delay": HiddenMechanism(plans.late_drive, "late"),
    "excitation_gain": HiddenMechanism(plans.more_drive, "more", ("",), SPRUNG, signed=True),
    "sensor_delay": HiddenMechanism(plans.late_sensor, "late"),
    "sensor_gain": HiddenMechanism(plans.more_sensor, "more", ("",), SPRUNG, signed=True),
    "sensor_quantisation": HiddenMechanism(lambda p, _a, _r: EffectDraft(p.q, lambda s: {"step": s}), "round"),
    "random_force": HiddenMechanism(lambda p, _a, _r: EffectDraft(p.q, lambda s: {"rms": s}), "chance"),
    "backlash": HiddenMechanism(plans.play, "gap", ("",), ("linear_oscillator",)),
    "end_stop": HiddenMechanism(plans.stop, "gap", ("ground",), ("linear_oscillator", "robot_joint")),
    "hunt_crossley_contact": HiddenMechanism(plans.crushed, "contact", ("own",), GAP_MODELS),
    "hertz_contact": HiddenMechanism(plans.curved, "spring", ("own",), GAP_MODELS),
    "bilinear_stiffness": HiddenMechanism(
        plans.one("difference", lambda x, _: -0.5 * np.abs(x)), "spring", ("ground",), SPRUNG, signed=True
    ),
    "quadratic_stiffness": HiddenMechanism(
        plans.one("coefficient", lambda x, _: -(x**2)), "spring", ("ground",), SPRUNG, signed=True
    ),
    "hidden_mode": HiddenMechanism(plans.rattling, "mass", ("ground",)),
    "inertia_change": HiddenMechanism(plans.heavier, "mass", ("ground",), signed=True),
    "directional_friction": HiddenMechanism(plans.two_ways, "rub", ANYWHERE),
    "position_dependent_friction": HiddenMechanism(plans.wavy, "rub", ANYWHERE),
    "load_dependent_friction": HiddenMechanism(
        plans.loaded, "rub", ("own",), ("robot_joint", "linear_oscillator", "rigid_drive")
    ),
    "friction_drift": HiddenMechanism(plans.warming, "rub", ANYWHERE),
    "directional_damping": HiddenMechanism(
        plans.one("difference", lambda _, v: -0.5 * np.abs(v)), "drag", ("ground",), signed=True
    ),
    "damping_drift": HiddenMechanism(plans.aging, "drag", ("ground",), signed=False),
    "cogging": HiddenMechanism(plans.magnets, "wave", ("ground",)),
    "position_ripple": HiddenMechanism(plans.sensor_wave, "round"),
    "actuator_lag": HiddenMechanism(plans.behind, "late"),
    "sensor_lag": HiddenMechanism(plans.sensor_behind, "late", ("",), GAP_MODELS),
    "drive_saturation": HiddenMechanism(plans.limited, "more"),
    "drive_dead_zone": HiddenMechanism(plans.dead, "more"),
}
UNKNOWN: Mapping[str, HiddenMechanism] = {
    "wave over position that narrows": HiddenMechanism(plans.narrowing, "unknown"),
    "friction that depends on position": HiddenMechanism(plans.rough, "unknown"),
    "bump at one position": HiddenMechanism(plans.bump, "unknown"),
    "drag that grows with position": HiddenMechanism(plans.mixed, "unknown", models=SPRUNG),
}
"""What no library has."""
NAMES = (*TABLE, "unknown")
NOISY: Mapping[str, Callable[[Pilot, float], float]] = {
    "sensor_quantisation": lambda pilot, share: pilot.noise * 10.0 ** (1.2 * share),
    "random_force": lambda pilot, share: pilot.usual * 3.2 * 10.0 ** (0.7 * share),
}
"""Sizes of what has no force that could be foretold, from a share between 0 and 1."""


def draw_sized_effect(name: str, pilot: Pilot, rng: np.random.Generator) -> Effect:
    """Return a mechanism of a size at which it should show in `pilot` as well as a random gain in log-likelihood."""
    what = str(rng.choice(list(UNKNOWN))) if name == "unknown" else ""
    mechanism = UNKNOWN[what] if what else TABLE[name]
    at = str(rng.choice(mechanism.spots(pilot.rig)))
    draft = mechanism.plan(pilot, at, rng)
    wanted = math.exp(rng.uniform(math.log(GAIN[0]), math.log(GAIN[1])))
    if name in NOISY:
        return Effect(name, at, draft.parameters(NOISY[name](pilot, float(rng.random()))))
    size = math.sqrt(wanted / max(pilot.gain(draft), 1e-300))
    loud = size * float(np.std(draft.felt)) / (float(np.std(pilot.q)) if draft.shown else pilot.inertial)
    size *= min(1.0, LARGEST / max(loud, 1e-300)) * (rng.choice([-1.0, 1.0]) if mechanism.signed else 1.0)
    return Effect(name, at, draft.parameters(float(size)), what)
