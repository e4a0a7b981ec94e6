"""The plugins that are used where nobody names one: the only file of the framework that knows any by name."""

from __future__ import annotations

EMBEDDER = "ami_cao"
EXPONENT = "lyapunov_kantz"
EXPONENT_CHECKS = ("lyapunov_rosenstein",)
"""Measured beside the exponent, so that two methods can be compared."""
DIMENSION, ENTROPY = "correlation_dimension", "correlation_entropy"
METER, DENOISER = "noise_level", "local_projective"
"""What measures the noise of a series, and what takes it off."""
STATISTIC = "prediction_error"
"""The number that is asked of a recording and of its surrogates."""
SURROGATE, SURROGATE_OF_CYCLES = "iaaft", "pseudo_periodic"
FLOW_EXPONENT, SECTION_DIMENSION = "lyapunov_max", "section_dimension"
"""What maps of models hold."""
OSCILLATOR, CARRIAGE, JOINT, SLIDER = "linear_oscillator", "rigid_drive", "robot_joint", "backlash_slider"
"""The textbook models of a first case: with a spring, without, and moved at a base that turns or shifts."""
