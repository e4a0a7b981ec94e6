"""The plugins that are used by default: the only file of the framework that knows plugins by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

OSCILLATOR, CARRIAGE, JOINT, SLIDER = "linear_oscillator", "rigid_drive", "robot_joint", "backlash_slider"
"""The textbook models for a first case: with a spring; without one; with a base that turns; with a base that shifts."""
ATTRACTORS, QUANTIFIERS = "attractors", "quantifiers"
"""The measure of motions in a diagnosis; the route from measures of chaos to parameters."""
_CHAOS = "lostmotion_chaos"
STEPS = ("denoise", "embed", "quantify", "surrogate_test")
SOURCES: Mapping[str, str] = dict.fromkeys(("analyse", "map", "reproduce", *STEPS, ATTRACTORS, QUANTIFIERS), _CHAOS)
"""The package of commands and functions that are documented as parts of lostmotion, for messages where it is absent."""
PLAY, INERTIA_CHANGE, HYSTERETIC = "backlash", "inertia_change", "bouc_wen_hysteresis"
"""The mechanisms of a robot that are terms of other machines as well, under the same names."""


class Rarity(NamedTuple):
    """The log odds against a cause that is rarer than friction, play, stiffness or damping, with the reason."""

    odds: float
    why: str


_DELAY = Rarity(1.5, "most acquisition systems sample their channels together, within a tenth of a sample")
_WAVE = Rarity(3.0, "each multiple of the frequency of the drive is a further chance to fit a periodic force")
RARE: Mapping[str, Rarity] = {
    "excitation_delay": _DELAY, "sensor_delay": _DELAY, "actuator_lag": _DELAY, "sensor_lag": _DELAY,
    "excitation_harmonic": _WAVE, "parametric_stiffness": _WAVE,
    "directional_friction": Rarity(3.0, "dry friction with one level and a constant force are more common"),
    "friction_drift_twice": Rarity(1.0, "one time constant describes most machines that warm up"),
    "end_stop": Rarity(1.0, "most machines do not reach their stops in a recording"),
}  # fmt: skip
"""The prior odds of terms in any machine: those that are not listed are equally common."""
AT_GROUND = ("offset_force", "hidden_mode", "inertia_change")
"""Terms whose effect is the same at every place of a machine: they are tried at the ground only."""
LINEAR_FORCES = ("offset_force", "linear_stiffness", "viscous_damping")
"""Forces that are constant, or linear in position or velocity: smooth forces have little of their forms."""
DRY_FRICTION = "coulomb_friction"
"""The law that friction with a soft onset in a joint contains."""
SLIDING = (DRY_FRICTION, "stribeck_friction")
"""Laws that a simulation of a robot has as dry friction, of one level `force`."""
RARE_IN_JOINTS: Mapping[str, float] = {
    "bilinear_stiffness": 2.0, "cubic_stiffness": 1.0, "quadratic_stiffness": 1.5,  # a joint rarely has any spring
    "gravity_pendulum": 1.0,  # a wrong mass shows as inertia too
    "damping_drift": 1.0, "friction_drift": 1.0, "friction_drift_twice": 2.0,  # minutes, where logs take seconds
    "directional_damping": 1.0, "end_stop": 1.0, "position_dependent_friction": 1.0,  # special mechanisms
    "drive_saturation": 1.0, "drive_dead_zone": 1.0,  # a recorded torque is limited already
}  # fmt: skip
"""The log odds against laws that are rarer in the joints of robots than friction, damping, ripple or a delay."""
BEFORE_GEARS = ("drive_saturation", "drive_dead_zone")
"""Terms between the command of a drive and its torque: a sensor behind the gear shows what they have left."""
USUAL = (
    "coulomb_friction", "backlash", "linear_stiffness", "excitation_delay", "viscous_damping", "cubic_stiffness",
    "offset_force", "quadratic_damping", "stribeck_friction", "asymmetric_gap", "cogging", "gap_drift",
)  # fmt: skip
"""The terms that engineers ask for first: those of most machines, the most common first."""
