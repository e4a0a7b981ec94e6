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
