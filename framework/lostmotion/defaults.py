"""The plugins that are used by default: the only file of the framework that knows plugins by name."""

from __future__ import annotations

from collections.abc import Mapping

OSCILLATOR, CARRIAGE, JOINT, SLIDER = "linear_oscillator", "rigid_drive", "robot_joint", "backlash_slider"
"""The textbook models for a first case: with a spring; without one; with a base that turns; with a base that shifts."""
ATTRACTORS, QUANTIFIERS = "attractors", "quantifiers"
"""The measure of motions in a diagnosis; the route from measures of chaos to parameters."""
_CHAOS = "lostmotion_chaos"
STEPS = ("denoise", "embed", "quantify", "surrogate_test")
SOURCES: Mapping[str, str] = dict.fromkeys(("analyse", "map", "reproduce", *STEPS, ATTRACTORS, QUANTIFIERS), _CHAOS)
"""The package of commands and functions that are documented as parts of lostmotion, for messages where it is absent."""
PLAY, INERTIA_CHANGE = "backlash", "inertia_change"
"""The mechanisms of a robot that are terms of other machines as well, under the same names."""
RARE_IN_JOINTS: Mapping[str, float] = {
    "bilinear_stiffness": 2.0, "cubic_stiffness": 1.0, "quadratic_stiffness": 1.5,  # a joint rarely has any spring
    "gravity_pendulum": 1.0,  # a wrong mass shows as inertia too
    "damping_drift": 1.0, "friction_drift": 1.0, "friction_drift_twice": 2.0,  # minutes, where logs take seconds
    "directional_damping": 1.0, "end_stop": 1.0, "position_dependent_friction": 1.0,  # special mechanisms
    "drive_saturation": 1.0, "drive_dead_zone": 1.0,  # a recorded torque is limited already
}  # fmt: skip
"""The log odds against laws that are rarer in the joints of robots than friction, damping, ripple or a delay."""
USUAL = (
    "coulomb_friction", "backlash", "linear_stiffness", "excitation_delay", "viscous_damping", "cubic_stiffness",
    "offset_force", "quadratic_damping", "stribeck_friction", "asymmetric_gap", "cogging", "gap_drift",
)  # fmt: skip
"""The terms that engineers ask for first: those of most machines, the most common first."""
